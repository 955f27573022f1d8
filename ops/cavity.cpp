// SPDX-License-Identifier: MIT
// Growth of cavities.
//
//   offer: take the target
//          repeat: find the worst outer face; note the state if it is the best so far;
//                  take the tet behind the face, if there is one and it may be taken
#include "ops/cavity.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <limits>

#include "kernel/quality_of_points.h"
#include "kernel/workspace.h"

namespace tetmend {

namespace {

/// Cavities have 256 tets at most.
constexpr std::size_t kMaxFaces = 1024;

/// Whether a face has the edge in that sense.
bool has_edge(const std::array<VertexHandle, 3>& face, VertexHandle from, VertexHandle to) {
  for (unsigned i = 0; i < 3; ++i) {
    if (face[i] == from && face[(i + 1) % 3] == to) return true;
  }
  return false;
}

std::size_t count_vertices(const TetMesh& mesh, std::span<const HalfFace> faces) {
  std::array<VertexHandle, 3 * kMaxFaces> all;
  std::size_t count = 0;
  for (const HalfFace f : faces) {
    for (const VertexHandle v : mesh.vertices(f)) all[count++] = v;
  }
  const auto end = all.begin() + static_cast<std::ptrdiff_t>(count);
  std::sort(all.begin(), end);
  return static_cast<std::size_t>(std::unique(all.begin(), end) - all.begin());
}

}  // namespace

void VertexCavity::begin(TetHandle target, double least, const Limits& limits) {
  target_ = target;
  limits_ = limits;
  worst_ = least;
  tets_.clear();
  faces_.clear();
}

Verdict VertexCavity::offer(const TetMesh& mesh, Workspace& workspace, const Point& point) {
  const auto is_worse = [](const Face& a, const Face& b) { return a.quality > b.quality; };
  taken_.clear();
  dropped_.clear();
  inside_.clear();
  front_.clear();
  bound_ = std::numeric_limits<double>::infinity();
  take(mesh, target_, point);
  double best = worst_;
  std::size_t best_count = 0;
  std::size_t best_dropped = 0;
  while (bound_ > best && !front_.empty()) {
    const Face face = front_.front();
    const HalfFace twin = mesh.twin(face.face);
    const bool crossable = mesh.is_free(face.face) || is_open(mesh, face.face);
    if (!crossable || twin.is_outside() || !inside_.contains(twin.tet().index())) {
      if (face.quality > best) {
        best = face.quality;
        best_count = taken_.size();
        best_dropped = dropped_.size();
        if (best >= limits_.enough) break;
      }
      if (!crossable || taken_.size() == limits_.max_tets) break;
      if (twin.is_outside()) {
        dropped_.push_back(face.face);
        std::pop_heap(front_.begin(), front_.end(), is_worse);
        front_.pop_back();
        continue;
      }
      if (!workspace.holds(mesh.vertices(twin.tet())[twin.face()])) return Verdict::deferred;
      take(mesh, twin.tet(), point);
      continue;
    }
    std::pop_heap(front_.begin(), front_.end(), is_worse);
    front_.pop_back();
  }
  if (best_count == 0) return Verdict::no_improvement;
  keep(mesh, best_count, best_dropped, point, best);
  return Verdict::accepted;
}

/// A face of the patch, with no frozen tet behind it.
bool VertexCavity::is_open(const TetMesh& mesh, HalfFace face) const {
  if (limits_.patch == SurfaceGuard::kNone) return false;
  const HalfFace twin = mesh.twin(face);
  return mesh.surface_guard()->patch(mesh.vertices(face)) == limits_.patch &&
         (twin.is_outside() || !mesh.is_frozen(twin.tet()));
}

/// Adds a tet, and to the front those of its faces that do not lead back inside.
void VertexCavity::take(const TetMesh& mesh, TetHandle t, const Point& point) {
  const auto is_worse = [](const Face& a, const Face& b) { return a.quality > b.quality; };
  taken_.push_back(t);
  inside_.insert(t.index());
  for (unsigned f = 0; f < 4; ++f) {
    const HalfFace face(t, f);
    const bool crossable = mesh.is_free(face) || is_open(mesh, face);
    if (crossable && !mesh.is_boundary(face) && inside_.contains(mesh.twin(face).tet().index()))
      continue;
    const auto [a, b, c] = mesh.vertices(face);
    const double quality =
        quality_of_points(mesh.standard(), point, mesh.point(a), mesh.point(b), mesh.point(c));
    if (!crossable) bound_ = std::min(bound_, quality);
    front_.push_back({quality, face});
    std::push_heap(front_.begin(), front_.end(), is_worse);
  }
}

/// The first `count` tets taken are the best cavity so far; of the boundary, so many faces give way.
void VertexCavity::keep(const TetMesh& mesh, std::size_t count, std::size_t dropped,
                        const Point& point, double worst) {
  move(point, worst);
  tets_.assign(taken_.begin(), taken_.begin() + static_cast<std::ptrdiff_t>(count));
  if (count < taken_.size()) {
    inside_.clear();
    for (const TetHandle t : tets_) inside_.insert(t.index());
  }
  faces_.clear();
  for (const TetHandle t : tets_) {
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace twin = mesh.neighbours(t)[f];
      const auto end = dropped_.begin() + static_cast<std::ptrdiff_t>(dropped);
      const bool is_outer = twin.is_outside()
                                ? std::find(dropped_.begin(), end, HalfFace(t, f)) == end
                                : !inside_.contains(twin.tet().index());
      if (is_outer) faces_.push_back(HalfFace(t, f));
    }
  }
}

bool is_sphere(const TetMesh& mesh, std::span<const HalfFace> faces) {
  if (faces.size() > kMaxFaces) return false;
  std::bitset<kMaxFaces> reached;
  std::array<std::uint16_t, kMaxFaces> stack{};
  std::size_t depth = 0;
  std::size_t count = 0;
  const auto reach = [&](std::size_t face) {
    if (reached[face]) return;
    reached.set(face);
    stack[depth++] = static_cast<std::uint16_t>(face);
    ++count;
  };
  reach(0);
  while (depth > 0) {
    const auto corners = mesh.vertices(faces[stack[--depth]]);
    for (unsigned i = 0; i < 3; ++i) {
      std::size_t across = 0;
      for (std::size_t k = 0; k < faces.size(); ++k) {
        if (!has_edge(mesh.vertices(faces[k]), corners[(i + 1) % 3], corners[i])) continue;
        reach(k);
        ++across;
      }
      if (across != 1) return false;
    }
  }
  return count == faces.size() && count_vertices(mesh, faces) == faces.size() / 2 + 2;
}

}  // namespace tetmend
