// SPDX-License-Identifier: MIT
// --trace and its filters: whether a run is recorded, and what of it.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/schedule_options.h"
#include "trace/recorder.h"

namespace CLI {
class App;
}

namespace tetmend::apps {

/// As the user wrote them.
struct TraceOptions {
  std::filesystem::path file;  ///< empty: no trace
  std::string around;          ///< TET, TET,RADIUS or X,Y,Z,RADIUS; empty: everywhere
  std::vector<std::string> operators;
  int depth = -1;     ///< negative: any
  std::string limit;  ///< 500M; empty: none
};

void add_trace_options(CLI::App& command, TraceOptions& options);

/// What of a run is to be recorded. A tet is named by its number in the file, so it must be looked
/// up before the mesh is sorted.
class TracePlan {
 public:
  /// @throws UsageError for a mistake in the options; Error when the file cannot be written.
  TracePlan(const TraceOptions& options, const Registry& registry);
  /// Finds the tet of --trace-around. @throws Error when the mesh has no such tet.
  void locate(const MeshData& data);
  /// Null when no trace is wanted. @throws Error when the file cannot be written.
  std::unique_ptr<TraceRecorder> start(const TetMesh& mesh, const std::filesystem::path& input,
                                       const ChosenSchedule& chosen) const;

 private:
  std::filesystem::path file_;
  TraceFilter filter_;
  std::optional<std::uint64_t> tet_;
};

}  // namespace tetmend::apps
