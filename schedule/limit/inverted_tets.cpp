// SPDX-License-Identifier: MIT
#include "schedule/limit/inverted_tets.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "kernel/chunks.h"
#include "kernel/star.h"
#include "search/star_kernel.h"

namespace tetmend {

namespace {

bool sees_its_link(const TetMesh& mesh, VertexHandle v) {
  std::vector<std::array<Point, 3>> faces;
  for (const HalfFace f : link(mesh, v)) {
    // Counterclockwise from outside: turned, so that the vertex is on the positive side.
    const auto corners = mesh.vertices(f);
    faces.push_back({mesh.point(corners[0]), mesh.point(corners[2]), mesh.point(corners[1])});
  }
  return has_kernel(faces);
}

/// Those of the vertices that see all of their link from somewhere. Each is asked once: thousands
/// of tets may share one, and its link then is as large.
class Seers {
 public:
  Seers(const TetMesh& mesh, std::vector<VertexHandle> vertices) : vertices_(std::move(vertices)) {
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    sees_.resize(vertices_.size());
    constexpr std::size_t kAtOnce = 256;
    const auto ask = [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        sees_[i] = sees_its_link(mesh, vertices_[i]);
      }
    };
    for_chunks(vertices_.size(), ask, kAtOnce);
  }

  bool contains(VertexHandle v) const {
    const auto place = std::lower_bound(vertices_.begin(), vertices_.end(), v);
    return place != vertices_.end() && *place == v &&
           sees_[static_cast<std::size_t>(place - vertices_.begin())] != 0;
  }

 private:
  std::vector<VertexHandle> vertices_;  // in order
  std::vector<char> sees_;              // not bool: threads write beside each other
};

}  // namespace

InvertedTets count_inverted(const TetMesh& mesh) {
  constexpr Quality kLeastAboveZero = std::numeric_limits<Quality>::denorm_min();
  std::vector<TetHandle> found;
  mesh.visit_below(kLeastAboveZero, 0, mesh.tet_slots(), [&](TetHandle t) { found.push_back(t); });
  InvertedTets count;
  if (found.empty()) return count;
  const auto is_free = [&](VertexHandle v) { return !mesh.is_fixed(v); };
  std::vector<VertexHandle> free;
  for (const TetHandle t : found) {
    if (mesh.is_frozen(t)) continue;
    const TetVertices& corners = mesh.vertices(t);
    std::copy_if(corners.begin(), corners.end(), std::back_inserter(free), is_free);
  }
  const Seers seers(mesh, std::move(free));
  const auto has_place = [&](VertexHandle v) { return seers.contains(v); };
  for (const TetHandle t : found) {
    const TetVertices& corners = mesh.vertices(t);
    std::size_t& kind = mesh.is_frozen(t)                                        ? count.frozen
                        : std::none_of(corners.begin(), corners.end(), is_free)  ? count.fixed
                        : std::any_of(corners.begin(), corners.end(), has_place) ? count.open
                                                                                 : count.sealed;
    ++kind;
  }
  return count;
}

}  // namespace tetmend
