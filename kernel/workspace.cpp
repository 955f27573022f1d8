// SPDX-License-Identifier: MIT
#include "kernel/workspace.h"

namespace tetmend {

Workspace::Workspace(const TetMesh& mesh) {
  // From the back, so that low slots are used first.
  for (std::size_t i = mesh.tet_slots(); i-- > 0;) {
    const TetHandle t(static_cast<std::uint32_t>(i));
    if (mesh.is_deleted(t)) {
      free_tets_.push_back(t);
    } else if (!(mesh.quality(t) > 0)) {
      may_overlap_ = true;
    }
  }
  for (std::size_t i = mesh.vertex_slots(); i-- > 0;) {
    const VertexHandle v(static_cast<std::uint32_t>(i));
    if (mesh.is_deleted(v)) free_vertices_.push_back(v);
  }
}

}  // namespace tetmend
