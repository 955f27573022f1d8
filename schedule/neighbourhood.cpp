// SPDX-License-Identifier: MIT
#include "schedule/neighbourhood.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <unordered_map>
#include <utility>

#include "kernel/star.h"

namespace tetmend {

namespace {

/// Grows a neighbourhood: first all tets by rings of vertices, then those of them that hang together.
class Growth {
 public:
  Growth(const TetMesh& mesh, Workspace& workspace, NeighbourhoodMarks& marks)
      : mesh_(mesh), workspace_(workspace), marks_(marks) {
    if (marks.size() < mesh.tet_slots()) marks.resize(mesh.tet_slots(), 0);
  }

  std::vector<TetHandle> near(TetHandle middle, unsigned rings, std::size_t most) {
    std::vector<TetHandle> tets;
    std::unordered_map<std::uint32_t, char> seen;  // vertices
    std::vector<VertexHandle> front, next;
    const auto meet = [&](TetHandle t) {
      for (const VertexHandle v : mesh_.vertices(t)) {
        if (seen.emplace(v.index(), 1).second) next.push_back(v);
      }
    };
    add(middle, middle, tets);
    meet(middle);
    std::vector<HalfFace> around;
    for (unsigned ring = 0; ring < rings && tets.size() < most; ++ring) {
      front.swap(next);
      next.clear();
      for (const VertexHandle v : front) {
        if (find_star(mesh_, v, workspace_, around) != StarKind::whole) continue;
        for (const HalfFace f : around) {
          if (add(f.tet(), middle, tets)) meet(f.tet());
        }
      }
    }
    return tets;
  }

  /// Of the marked ones, in the order of a walk over faces.
  std::vector<TetHandle> connected(TetHandle middle, std::uint32_t number) {
    std::vector<TetHandle> tets = {middle};
    marks_[middle.index()] = number;
    for (std::size_t i = 0; i < tets.size(); ++i) {
      for (unsigned f = 0; f < 4; ++f) {
        const HalfFace face(tets[i], f);
        const HalfFace twin = mesh_.twin(face);
        if (twin.is_outside() || mesh_.is_constrained(face)) continue;
        std::uint32_t& mark = marks_[twin.tet().index()];
        if (mark != kNear) continue;
        mark = number;
        tets.push_back(twin.tet());
      }
    }
    return tets;
  }

  void forget(std::span<const TetHandle> near) {
    for (const TetHandle t : near) {
      if (marks_[t.index()] == kNear) marks_[t.index()] = 0;
    }
  }

 private:
  static constexpr std::uint32_t kNear = 0xFFFFFFFFu;

  bool add(TetHandle t, TetHandle middle, std::vector<TetHandle>& tets) {
    std::uint32_t& mark = marks_[t.index()];
    if (mark != 0 || mesh_.is_frozen(t) || mesh_.label(t) != mesh_.label(middle)) return false;
    if (!(mesh_.quality(t) > 0)) return false;
    mark = kNear;
    tets.push_back(t);
    return true;
  }

  const TetMesh& mesh_;
  Workspace& workspace_;
  NeighbourhoodMarks& marks_;
};

void list_vertices(const TetMesh& mesh, const NeighbourhoodMarks& marks, std::uint32_t number,
                   Neighbourhood& out) {
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;
  const auto number_of = [&](VertexHandle v) {
    const auto [found, is_new] =
        numbers.emplace(v.index(), static_cast<std::uint32_t>(out.vertices.size()));
    if (is_new) {
      out.vertices.push_back(v);
      out.stays.push_back(mesh.is_fixed(v) ? 1 : 0);
    }
    return found->second;
  };
  for (const TetHandle t : out.tets) {
    for (const VertexHandle v : mesh.vertices(t)) number_of(v);
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace twin = mesh.twin(HalfFace(t, f));
      if (!twin.is_outside() && marks[twin.tet().index()] == number) continue;
      for (const VertexHandle v : mesh.vertices(HalfFace(t, f))) out.stays[number_of(v)] = 1;
    }
  }
}

/// A permutation of 0..size; 0 gives that in order. By a generator that is the same everywhere.
std::vector<std::uint32_t> permutation(std::size_t size, std::uint64_t seed) {
  std::vector<std::uint32_t> order(size);
  std::iota(order.begin(), order.end(), 0u);
  if (seed == 0) return order;
  std::mt19937_64 random(seed);
  for (std::size_t i = size; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

}  // namespace

Neighbourhood find_neighbourhood(const TetMesh& mesh, Workspace& workspace, TetHandle middle,
                                 unsigned rings, std::size_t most, std::uint32_t number,
                                 NeighbourhoodMarks& marks) {
  Neighbourhood found;
  Growth growth(mesh, workspace, marks);
  const std::vector<TetHandle> near = growth.near(middle, rings, most);
  if (near.empty()) return found;
  found.tets = growth.connected(middle, number);
  growth.forget(near);
  list_vertices(mesh, marks, number, found);
  return found;
}

NeighbourhoodCopy copy_neighbourhood(const TetMesh& mesh, const Neighbourhood& neighbourhood,
                                     const NeighbourhoodMarks& marks, std::uint32_t variant) {
  NeighbourhoodCopy copy;
  copy.vertex = permutation(neighbourhood.vertices.size(), std::uint64_t{2} * variant);
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;
  for (std::size_t i = 0; i < copy.vertex.size(); ++i) {
    const VertexHandle v = neighbourhood.vertices[copy.vertex[i]];
    numbers.emplace(v.index(), static_cast<std::uint32_t>(i));
    copy.data.points.push_back(mesh.point(v));
    if (mesh.is_fixed(v)) copy.data.required_vertices.push_back(static_cast<std::uint32_t>(i));
  }
  const auto number = [&](VertexHandle v) { return numbers.at(v.index()); };
  const std::uint64_t seed = variant == 0 ? 0 : std::uint64_t{2} * variant + 1;
  for (const std::uint32_t i : permutation(neighbourhood.tets.size(), seed)) {
    const TetHandle t = neighbourhood.tets[i];
    const TetVertices& v = mesh.vertices(t);
    copy.data.tets.push_back({{number(v[0]), number(v[1]), number(v[2]), number(v[3])}, 0});
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      const HalfFace twin = mesh.twin(face);
      if (!mesh.is_constrained(face) || twin.is_outside()) continue;
      if (marks[twin.tet().index()] != marks[t.index()] || twin.tet() < t) continue;
      const auto w = mesh.vertices(face);
      copy.data.triangles.push_back({{number(w[0]), number(w[1]), number(w[2])}, 0});
    }
    for (unsigned e = 0; e < kEdgeVertices.size(); ++e) {
      if (!mesh.is_constrained(TetEdge(t, e))) continue;
      const auto w = mesh.vertices(TetEdge(t, e));
      copy.data.edges.push_back({{number(w[0]), number(w[1])}, 0});
    }
  }
  return copy;
}

}  // namespace tetmend
