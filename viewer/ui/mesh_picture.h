// SPDX-License-Identifier: MIT
// A small flat picture of a mesh among widgets, without OpenGL of its own.
#pragma once

#include <vector>

#include <imgui.h>

#include "kernel/tet_mesh.h"

namespace tetmend::viewer::ui {

class MeshPicture {
 public:
  enum class Look {
    solid,  ///< the surface, lit from the eye
    glass   ///< seen through, with its edges and the bad tets in it
  };
  MeshPicture() = default;
  /// As it is seen first. Cost: n log n in the triangles.
  MeshPicture(const TetMesh& mesh, Look look);

  bool is_empty() const { return triangles_.empty(); }
  /// In the middle of a rectangle of the current window.
  void draw(const ImVec2& corner, const ImVec2& size) const;

 private:
  struct Triangle {
    ImVec2 corners[3];  // 0 to 1
    ImU32 colour;
    double depth;
  };
  std::vector<Triangle> triangles_;  // the farthest first
  Look look_ = Look::solid;
};

}  // namespace tetmend::viewer::ui
