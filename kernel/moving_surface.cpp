// SPDX-License-Identifier: MIT
// The lists of what the file names, where a guard lets the surface change.
//
// Between two calls of renew_surface() a new face of the boundary has the number of some triangle of
// its patch. That tells what to write of it, and workers need no numbers of their own.
#include <algorithm>
#include <unordered_map>

#include "kernel/in_order.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

namespace {

/// What is new takes the places of what is gone, each within its own kind; what is left of the new
/// follows, what is left of the gone is dropped.
template <class Value>
struct Refill {
  std::vector<Value>& values;
  std::vector<std::uint32_t>& origins;
  const std::vector<std::uint32_t>& kinds;  // of the old values

  void operator()(const std::vector<char>& is_gone, const std::vector<Value>& fresh,
                  const std::vector<std::uint32_t>& fresh_kinds) const {
    std::unordered_map<std::uint32_t, std::vector<std::size_t>> places;  // the first last
    for (std::size_t i = values.size(); i-- > 0;) {
      if (is_gone[i]) places[kinds[i]].push_back(i);
    }
    std::vector<char> dropped = is_gone;
    std::vector<Value> rest;
    for (std::size_t k = 0; k < fresh.size(); ++k) {
      std::vector<std::size_t>& free = places[fresh_kinds[k]];
      if (free.empty()) {
        rest.push_back(fresh[k]);
        continue;
      }
      values[free.back()] = fresh[k];
      origins[free.back()] = TetMesh::kNotFromFile;
      dropped[free.back()] = 0;
      free.pop_back();
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (dropped[i]) continue;
      values[kept] = values[i];
      origins[kept++] = origins[i];
    }
    values.resize(kept);
    values.insert(values.end(), rest.begin(), rest.end());
    origins.resize(kept);
    origins.resize(values.size(), TetMesh::kNotFromFile);
  }
};

}  // namespace

void TetMesh::set_surface_guard(std::unique_ptr<SurfaceGuard> guard) {
  renew_surface();
  guard_ = SurfaceGuardHolder(std::move(guard));
  surface_origin_.clear();
  surface_patch_.clear();
  named_edge_origin_.clear();
  named_edge_line_.clear();
  if (surface_guard() == nullptr) return;
  for (std::uint32_t i = 0; i < surface_.size(); ++i) surface_origin_.push_back(i);
  for (std::uint32_t i = 0; i < named_edges_.size(); ++i) named_edge_origin_.push_back(i);
  find_attributes();
}

/// A triangle of each patch and a named edge of each line: from them new ones have their labels.
void TetMesh::find_attributes() {
  const SurfaceGuard& guard = *surface_guard();
  const auto note = [](std::vector<std::uint32_t>& of, std::uint32_t kind, std::uint32_t number) {
    if (kind == SurfaceGuard::kNone) return;
    if (kind >= of.size()) of.resize(kind + 1, SurfaceGuard::kNone);
    if (of[kind] == SurfaceGuard::kNone) of[kind] = number;
  };
  patch_triangle_.clear();
  line_edge_.clear();
  surface_patch_.assign(surface_.size(), SurfaceGuard::kNone);
  named_edge_line_.assign(named_edges_.size(), SurfaceGuard::kNone);
  for (std::uint32_t i = 0; i < surface_.size(); ++i) {
    if (surface_[i].loose) continue;
    surface_patch_[i] = guard.patch(surface_[i].vertices);
    note(patch_triangle_, surface_patch_[i], i);
  }
  for (std::uint32_t i = 0; i < named_edges_.size(); ++i) {
    const auto& [a, b] = named_edges_[i].vertices;
    named_edge_line_[i] = guard.line(a, b);
    note(line_edge_, named_edge_line_[i], i);
  }
}

void TetMesh::renew_surface() {
  if (surface_guard() == nullptr || !renew_triangles()) return;
  renew_edges();
  find_attributes();
}

/// True if there are others than before.
bool TetMesh::renew_triangles() {
  std::vector<FaceKey> keys(surface_.size());
  std::vector<std::pair<FaceKey, std::uint32_t>> inside;  // constrained faces
  for (std::uint32_t i = 0; i < surface_.size(); ++i) {
    keys[i] = in_order(surface_[i].vertices);
    if (surface_[i].interior && !surface_[i].loose) inside.emplace_back(keys[i], i);
  }
  std::sort(inside.begin(), inside.end());
  constexpr std::uint32_t kNone = SurfaceGuard::kNone;
  const auto find_inside = [&](const FaceKey& key) {
    const auto at =
        std::lower_bound(inside.begin(), inside.end(), std::pair(key, std::uint32_t{0}));
    return at != inside.end() && at->first == key ? at->second : kNone;
  };
  std::vector<char> gone(surface_.size());
  for (std::size_t i = 0; i < surface_.size(); ++i) gone[i] = surface_[i].loose ? 0 : 1;
  std::vector<HalfFace> fresh;
  for (std::uint32_t i = 0; i < 4 * cells_.size(); ++i) {
    const HalfFace f = HalfFace::from_code(i);
    if (is_deleted(f.tet())) continue;
    const HalfFace other = twin(f);
    std::uint32_t number = kNone;
    if (other.is_outside()) {
      if (in_order(vertices(f)) == keys[other.surface_triangle()])
        number = other.surface_triangle();
    } else if (is_constrained(f) && label(f.tet()) <= label(other.tet())) {
      number = find_inside(in_order(vertices(f)));
    } else {
      continue;
    }
    if (number == kNone) {
      fresh.push_back(f);
    } else {
      gone[number] = 0;
    }
  }
  if (fresh.empty() && std::count(gone.begin(), gone.end(), 1) == 0) return false;
  take_triangles(gone, fresh);
  return true;
}

void TetMesh::take_triangles(const std::vector<char>& gone, const std::vector<HalfFace>& fresh) {
  std::vector<SurfaceTriangle> triangles;
  std::vector<std::uint32_t> patches;
  for (const HalfFace f : fresh) {
    const std::uint32_t patch = surface_guard()->patch(vertices(f));
    SurfaceTriangle triangle = surface_[patch_triangle_[patch]];
    triangle.vertices = vertices(f);
    triangles.push_back(triangle);
    patches.push_back(patch);
  }
  Refill<SurfaceTriangle>{surface_, surface_origin_, surface_patch_}(gone, triangles, patches);
  std::vector<std::pair<FaceKey, std::uint32_t>> numbers;
  for (std::uint32_t i = 0; i < surface_.size(); ++i) {
    if (!surface_[i].interior && !surface_[i].loose) {
      numbers.emplace_back(in_order(surface_[i].vertices), i);
    }
  }
  std::sort(numbers.begin(), numbers.end());
  for (std::uint32_t i = 0; i < 4 * cells_.size(); ++i) {
    const HalfFace f = HalfFace::from_code(i);
    if (is_deleted(f.tet()) || !twin(f).is_outside()) continue;
    const auto at = std::lower_bound(numbers.begin(), numbers.end(),
                                     std::pair(in_order(vertices(f)), std::uint32_t{0}));
    cells_[f.tet().index()].neighbours[f.face()] = HalfFace::outside(at->second);
  }
}

/// An edge that the file names stays named while it lies on its line.
void TetMesh::renew_edges() {
  if (named_edges_.empty()) return;
  const SurfaceGuard& guard = *surface_guard();
  constexpr std::uint32_t kNone = SurfaceGuard::kNone;
  std::vector<char> gone(named_edges_.size(), 0);
  std::vector<EdgeKey> known;
  for (std::size_t i = 0; i < named_edges_.size(); ++i) {
    const auto& [a, b] = named_edges_[i].vertices;
    gone[i] = named_edge_line_[i] != kNone && guard.line(a, b) != named_edge_line_[i];
    if (!gone[i]) known.push_back(in_order(named_edges_[i].vertices));
  }
  std::sort(known.begin(), known.end());
  std::vector<std::pair<EdgeKey, std::uint32_t>> found;
  for (const SurfaceTriangle& triangle : surface_) {
    for (unsigned k = 0; k < 3 && !triangle.loose; ++k) {
      const EdgeKey edge = in_order(EdgeKey{triangle.vertices[k], triangle.vertices[(k + 1) % 3]});
      const std::uint32_t line = guard.line(edge[0], edge[1]);
      if (line >= line_edge_.size() || line_edge_[line] == kNone) continue;  // kNone too
      if (!std::binary_search(known.begin(), known.end(), edge)) found.emplace_back(edge, line);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::vector<NamedEdge> fresh;
  std::vector<std::uint32_t> lines;
  for (const auto& [edge, line] : found) {
    fresh.push_back({edge, named_edges_[line_edge_[line]].label});
    lines.push_back(line);
  }
  Refill<NamedEdge>{named_edges_, named_edge_origin_, named_edge_line_}(gone, fresh, lines);
}

}  // namespace tetmend
