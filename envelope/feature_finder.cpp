// SPDX-License-Identifier: MIT
// Faces, sides and patches.
#include "envelope/feature_finder.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include "kernel/chunks.h"
#include "kernel/grouping.h"

namespace tetmend {

void FeatureFinder::note_vertices() {
  found_.places.assign(points_.size(), SurfacePlace::inside);
  for (const auto& face : found_.faces) {
    for (const VertexHandle v : face.vertices) found_.places[v.index()] = SurfacePlace::smooth;
  }
}

/// They are patches of their own.
void FeatureFinder::hold_faces() {
  std::sort(held_.begin(), held_.end());
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    kinds_[i].held = are_held(found_.faces[i].vertices);
  }
}

void FeatureFinder::sort_named_edges() {
  std::sort(walls_.begin(), walls_.end());
  for (Named& edge : named_) edge.vertices = ends_of(edge.vertices[0], edge.vertices[1]);
  std::sort(named_.begin(), named_.end(), [](const Named& a, const Named& b) {
    return std::tie(a.vertices, a.label) < std::tie(b.vertices, b.label);
  });
  for (std::size_t i = 1; i < named_.size(); ++i) {  // named twice: which one counts is open
    if (named_[i].vertices == named_[i - 1].vertices) {
      for (const VertexHandle v : named_[i].vertices) keep(v);
    }
  }
}

namespace {

bool same_kind(const SurfaceInput::Kind& a, const SurfaceInput::Kind& b) {
  return std::tie(a.sides, a.label, a.named, a.interior, a.held) ==
         std::tie(b.sides, b.label, b.named, b.interior, b.held);
}

}  // namespace

/// By ends, then by face: in groups of the lower end first, which have few sides each.
void FeatureFinder::sort_sides() {
  std::vector<Side> sides;
  sides.reserve(3 * found_.faces.size());
  std::vector<std::uint32_t> lower;
  lower.reserve(sides.capacity());
  for (std::uint32_t i = 0; i < found_.faces.size(); ++i) {
    const auto& v = found_.faces[i].vertices;
    for (unsigned k = 0; k < 3; ++k) {
      const VertexHandle a = v[k];
      const VertexHandle b = v[(k + 1) % 3];
      sides.push_back({ends_of(a, b), i, a < b});
      lower.push_back(sides.back().ends[0].index());
    }
  }
  const Grouping groups = group_by_key(lower, static_cast<std::uint32_t>(points_.size()));
  sides_.reserve(sides.size());
  for (const std::uint32_t i : groups.order) sides_.push_back(sides[i]);
  for_chunks(points_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      std::sort(sides_.begin() + groups.begin[v], sides_.begin() + groups.begin[v + 1],
                [](const Side& a, const Side& b) {
                  return std::tie(a.ends[1], a.face) < std::tie(b.ends[1], b.face);
                });
    }
  });
  for (std::uint32_t i = 0; i < sides_.size(); ++i) {
    if (i == 0 || sides_[i].ends != sides_[i - 1].ends) group_.push_back(i);
  }
  group_.push_back(static_cast<std::uint32_t>(sides_.size()));
}

/// Of an edge, given by its sides: no feature, as far as the two faces tell.
bool FeatureFinder::is_smooth(std::size_t begin, std::size_t end) const {
  if (end - begin != 2) return false;
  const Side& a = sides_[begin];
  const Side& b = sides_[begin + 1];
  if (a.up == b.up || !same_kind(kinds_[a.face], kinds_[b.face])) return false;
  if (std::binary_search(walls_.begin(), walls_.end(), a.ends)) return false;
  if (!kinds_[a.face].held && are_held(a.ends)) return false;
  const auto at =
      std::lower_bound(named_.begin(), named_.end(), a.ends,
                       [](const Named& x, const Ends& ends) { return x.vertices < ends; });
  if (at != named_.end() && at->vertices == a.ends) return false;
  return normal(a.face).dot(normal(b.face)) >= least_cosine_;
}

void FeatureFinder::join_faces() {
  neighbours_.resize(3 * found_.faces.size());
  for (std::uint32_t i = 0; i < neighbours_.size(); ++i) neighbours_[i] = i / 3;
  const auto slot = [&](const Side& side) {
    const auto& v = found_.faces[side.face].vertices;
    const VertexHandle from = side.ends[side.up ? 0 : 1];
    return 3 * side.face + (v[0] == from ? 0 : v[1] == from ? 1 : 2);
  };
  for (std::size_t g = 0; g + 1 < group_.size(); ++g) {
    smooth_.push_back(is_smooth(group_[g], group_[g + 1]));
    if (!smooth_.back()) continue;
    const Side& a = sides_[group_[g]];
    const Side& b = sides_[group_[g] + 1];
    neighbours_[slot(a)] = b.face;
    neighbours_[slot(b)] = a.face;
  }
}

void FeatureFinder::add_patch(std::uint32_t face, const Plane& plane) {
  const Kind& kind = kinds_[face];
  found_.patches.push_back(
      {kind.sides, kind.label, kind.named, kind.interior, kind.held, plane.origin, plane.normal});
}

void FeatureFinder::number_patches() {
  std::vector<char> seen(found_.faces.size(), 0);
  std::vector<std::uint32_t> queue;
  for (std::uint32_t first = 0; first < found_.faces.size(); ++first) {
    if (seen[first]) continue;
    const auto patch = static_cast<std::uint32_t>(found_.patches.size());
    add_patch(first, {});
    queue.assign(1, first);
    seen[first] = 1;
    while (!queue.empty()) {
      const std::uint32_t i = queue.back();
      queue.pop_back();
      found_.faces[i].patch = patch;
      for (unsigned k = 0; k < 3; ++k) {
        const std::uint32_t next = neighbours_[3 * i + k];
        if (!std::exchange(seen[next], 1)) queue.push_back(next);
      }
    }
  }
}

void FeatureFinder::split_by_planes() {
  std::vector<std::array<Point, 3>> triangles;
  triangles.reserve(found_.faces.size());
  for (const auto& face : found_.faces) {
    const auto& v = face.vertices;
    triangles.push_back({point(v[0]), point(v[1]), point(v[2])});
  }
  const Planes planes = find_planes(triangles, neighbours_, flatness_);
  std::vector<std::uint32_t> first(planes.planes.size(), 0);
  for (std::uint32_t i = 0; i < found_.faces.size(); ++i) {
    found_.faces[i].patch = planes.plane_of[i];
    first[planes.plane_of[i]] = i;
    if (planes.planes[planes.plane_of[i]].normal.isZero()) {  // no area: nothing holds its vertices
      for (const VertexHandle v : found_.faces[i].vertices) keep(v);
    }
  }
  for (std::size_t p = 0; p < planes.planes.size(); ++p) add_patch(first[p], planes.planes[p]);
  for (std::size_t g = 0; g + 1 < group_.size(); ++g) {
    if (!smooth_[g]) continue;
    const Side* sides = &sides_[group_[g]];
    smooth_[g] = planes.plane_of[sides[0].face] == planes.plane_of[sides[1].face];
  }
}

}  // namespace tetmend
