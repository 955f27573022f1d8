// SPDX-License-Identifier: MIT
// One call of a trace, looked at closely: the tets before and after it, and its shell drawn flat.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "explain/shell_picture.h"
#include "explain/table_filling.h"
#include "trace/replay.h"

namespace tetmend::explain {

/// A tet that needs no mesh.
struct LocalTet {
  TetHandle tet;
  TetVertices vertices;
  std::array<Point, 4> corners;
  Quality quality = 0;
};

/// Of their qualities; infinite if there are none.
Quality worst_of(const std::vector<LocalTet>& tets);

/// What the drawing of a polygon shows.
enum class PolygonStage {
  before,              ///< the old tets, and the chords that the search may use
  found,               ///< the covering that the search has found, not made yet: dashed
  made,                ///< the covering that the call made or tried
  best_triangulation,  ///< after a refusal without a candidate: dashed, with the chords
  earlier,             ///< the old tets, though the shell is gone or cannot be drawn
  now                  ///< the shell as steps of the call have left it, with its chords
};

/// The shell of an edge after a step of the call around it.
struct LaterShell {
  std::uint64_t from = 0;  ///< right after that
  PolygonStage stage = PolygonStage::now;
  std::optional<ShellPicture> picture;   ///< of `now` as it is, of `made` as it was before the step
  std::optional<FlatCovering> covering;  ///< of `made`
};

struct CallStudy {
  std::uint32_t call = kNoCall;
  /// The tets around the target, and those that the call changes, as it found them.
  std::vector<LocalTet> before;
  /// What fills the same place afterwards, or would have: see `undone`. Empty if nothing was tried.
  std::vector<LocalTet> after;
  bool undone = false;  ///< `after` was tried, and was not good enough
  /// Of an edge that has a closed shell, or of faces between two vertices.
  std::optional<ShellPicture> picture;
  /// The covering that the call itself made or tried, and the position right after that. Of a
  /// recursion that of its shell transformation, if nothing was changed before.
  std::optional<FlatCovering> covering;
  std::uint64_t first_edit = 0;
  /// Right after the call told that its search had found `covering`, if it did.
  std::optional<std::uint64_t> found;
  /// Right after something in the call changed the shell, and `covering` does not show that.
  std::uint64_t outdated = std::numeric_limits<std::uint64_t>::max();
  /// What is there from then on, one after another; the first is of `outdated`.
  std::vector<LaterShell> later;
};

/// Leaves the replay where it was. Precondition: there is such a call.
/// Cost: replay of the call, there and back.
CallStudy study_call(const TraceFile& file, Replay& replay, std::uint32_t call);

/// The polygon of a call at a place in the trace. It is valid as long as the study.
struct PolygonView {
  PolygonStage stage = PolygonStage::before;
  const ShellPicture* shell = nullptr;
  const FlatCovering* covering = nullptr;  ///< of `found` and `made`
  std::string caption;
  std::optional<TableCell> cell = {};  ///< of the tables, that was filled last
};
/// `refused`: the call has searched in vain, and has ended. Precondition: the study has a picture.
PolygonView polygon_at(const CallStudy& study, std::uint64_t position, bool refused);

/// Why the call ended as it did, in sentences with the numbers of its shell.
std::string explain_end(const TraceFile& file, const CallStudy& study);

}  // namespace tetmend::explain
