// SPDX-License-Identifier: MIT
// A TetMesh that goes where a replay goes, by what changes on the way.
#pragma once

#include <vector>

#include "kernel/tet_mesh.h"
#include "trace/replay.h"

namespace tetmend::viewer {

/// What has become of a mesh.
struct MeshStep {
  bool anew = false;            ///< anything may be another
  std::vector<TetHandle> tets;  ///< slots whose tet came, went, or changed its shape; ascending
};

/// Remembers where a mesh has been brought to.
class TraceMesh {
 public:
  /// The mesh of now. Cost: linear.
  TetMesh begin(const Replay& replay);
  /// follow() will be given the mesh of now.
  void know(const Replay& replay) { seen_ = replay.changes().mark(); }
  /// Makes `mesh`, which was the replay's at the last call, the one of now.
  /// Cost: that of the tets that were written on the way; a pass over the slots after a jump to a
  /// keyframe, and a build of the whole where more than an eighth of the tets are others.
  MeshStep follow(Replay& replay, TetMesh& mesh);

 private:
  ChangeLog::Mark seen_;
};

/// The mesh with the slots that it has. Tets of a trace are oriented already.
TetMesh to_tet_mesh(const SlotMesh& mesh);

}  // namespace tetmend::viewer
