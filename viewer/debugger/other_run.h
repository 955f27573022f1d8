// SPDX-License-Identifier: MIT
// Another recorded run beside the one that is looked at.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "explain/call_study.h"
#include "trace/history.h"
#include "trace/replay.h"
#include "trace/run_comparison.h"
#include "viewer/debugger/explained.h"
#include "viewer/mesh/camera.h"

namespace tetmend::viewer {

/// The same place in both runs, as they left it.
struct PlaceInBoth {
  std::size_t number = 0;             ///< of RunComparison::worse_in_a
  std::vector<LocalTet> here, there;  ///< the bad tet, the good one; then those around
  Ball ball;                          ///< around those here
  std::string told;                   ///< the history of the good tet
};

class OtherRun {
 public:
  /// @throws Error as TraceFile does. Precondition: `here` outlives this. Cost: see compare_runs().
  OtherRun(const TraceFile& here, std::filesystem::path name);
  OtherRun(const OtherRun&) = delete;  // parts of it name others
  OtherRun& operator=(const OtherRun&) = delete;

  const std::filesystem::path& name() const { return name_; }
  const RunComparison& comparison() const { return comparison_; }  ///< `a` is the run here
  /// The place that was looked at last.
  const std::optional<PlaceInBoth>& place() const { return place_; }
  /// Its two tets; null where none was looked at.
  const TetPair* pair() const;
  /// @param here the mesh of the run here, at its end
  /// @throws Error if there is no such pair, and the place stays. Cost: see history_of()
  void look_at(std::size_t number, const SlotMesh& here);

 private:
  std::filesystem::path name_;
  TraceFile file_;
  Replay replay_;
  RunComparison comparison_;
  std::optional<PlaceInBoth> place_;
};

}  // namespace tetmend::viewer
