// SPDX-License-Identifier: MIT
#include "viewer/ui/mesh_picture.h"

#include <algorithm>
#include <array>

#include "viewer/mesh/camera.h"
#include "viewer/mesh/scene.h"

namespace tetmend::viewer::ui {

namespace {

const ImVec4 kSurface = {0.72F, 0.80F, 0.92F, 1};
const ImVec4 kGlass = {0.55F, 0.68F, 0.88F, 0.30F};
const ImVec4 kBad = {0.84F, 0.15F, 0.16F, 0.55F};

/// To the right, down, and towards the eye.
struct View {
  glm::dvec3 right, down, near;
  glm::dvec3 of(const glm::dvec3& p) const {
    return {glm::dot(p, right), glm::dot(p, down), glm::dot(p, near)};
  }
};

View first_view() {
  Camera camera;
  camera.look_from("home");
  const glm::dvec3 ahead = glm::normalize(camera.target - camera.eye());
  const glm::dvec3 up = camera.up();
  return {glm::cross(ahead, up), -up, -ahead};
}

}  // namespace

MeshPicture::MeshPicture(const TetMesh& mesh, Look look) : look_(look) {
  const View view = first_view();
  glm::dvec2 low(1e300);
  glm::dvec2 high(-1e300);
  std::vector<std::array<glm::dvec3, 3>> places;
  const auto add = [&](HalfFace face, ImVec4 colour) {
    std::array<glm::dvec3, 3> c = corners(mesh, face);
    for (glm::dvec3& p : c) {
      p = view.of(p);
      low = glm::min(low, glm::dvec2(p));
      high = glm::max(high, glm::dvec2(p));
    }
    if (look == Look::solid) {
      const glm::dvec3 normal = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
      const auto light = static_cast<float>(0.35 + 0.6 * std::abs(normal.z));
      colour = {colour.x * light, colour.y * light, colour.z * light, 1};
    }
    places.push_back(c);
    triangles_.push_back({{}, ImGui::ColorConvertFloat4ToU32(colour), c[0].z + c[1].z + c[2].z});
  };
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    if (mesh.is_deleted(TetHandle(i))) continue;
    const bool is_bad = look == Look::glass && misses_goal(mesh, TetHandle(i));
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(TetHandle(i), f);
      if (is_bad) add(face, kBad);
      if (mesh.is_boundary(face)) add(face, look == Look::glass ? kGlass : kSurface);
    }
  }
  const glm::dvec2 middle = (low + high) / 2.0;
  const double size = std::max({high.x - low.x, high.y - low.y, 1e-300});
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec2 at = (glm::dvec2(places[i][k]) - middle) / size + 0.5;
      triangles_[i].corners[k] = {static_cast<float>(at.x), static_cast<float>(at.y)};
    }
  }
  std::stable_sort(triangles_.begin(), triangles_.end(),
                   [](const Triangle& a, const Triangle& b) { return a.depth < b.depth; });
}

void MeshPicture::draw(const ImVec2& corner, const ImVec2& size) const {
  const float side = std::min(size.x, size.y);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImDrawListFlags flags = list.Flags;
  list.Flags &= ~ImDrawListFlags_AntiAliasedFill;  // no seams between triangles
  for (const Triangle& triangle : triangles_) {
    ImVec2 at[3];
    for (int k = 0; k < 3; ++k) {
      at[k] = {corner.x + size.x / 2 + (triangle.corners[k].x - 0.5F) * side,
               corner.y + size.y / 2 + (triangle.corners[k].y - 0.5F) * side};
    }
    list.AddTriangleFilled(at[0], at[1], at[2], triangle.colour);
    if (look_ == Look::glass) {
      // One by one: at a sharp corner a closed line ends in a spike.
      for (int k = 0; k < 3; ++k) {
        list.AddLine(at[k], at[(k + 1) % 3], ImGui::GetColorU32(ImGuiCol_Text, 0.45F));
      }
    }
  }
  list.Flags = flags;
}

}  // namespace tetmend::viewer::ui
