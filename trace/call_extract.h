// SPDX-License-Identifier: MIT
// The part of a mesh that one call saw: for a report of a bug, or an example.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kernel/mesh_data.h"
#include "trace/replay.h"

namespace tetmend {

struct CallExtract {
  std::uint32_t call = 0;             ///< the outermost call around the one asked for
  MeshData mesh;                      ///< as the call found it, and the tets that bound its own
  std::vector<std::uint32_t> target;  ///< vertices of the target, by their numbers in `mesh`
  std::vector<std::uint32_t>
      tet;                      ///< the tet visited, which names the target; empty: none, or gone
  std::optional<Label> frozen;  ///< label that tets have here which the run had to keep
  Standard standard;            ///< by which the call judged tets
  Goal goal;                    ///< that the run began with
};

/// All tets around the targets of the call and of those in it and around what these changed, and
/// two more layers of tets. Their outer faces are the boundary now. Apart from them lie up to five
/// tets that the run began with: no new tet may be of a worse shape, see Bounds. Leaves the replay
/// where the call begins. Precondition: there is such a call, and `replay` is of `file`.
/// @throws Error when a vertex of the target was gone before the call began
/// Cost: a few passes over the tets.
CallExtract extract_call(const TraceFile& file, Replay& replay, std::uint32_t call);

}  // namespace tetmend
