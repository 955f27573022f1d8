// SPDX-License-Identifier: MIT
// The tasks of task.h by CGAL's Triangulation_data_structure_3, which is a sphere: cells with one more vertex lie
// outside of the boundary.
#include <cstddef>
#include <map>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_3.h>
#include <CGAL/Triangulation_data_structure_3.h>
#include <CGAL/Triangulation_vertex_base_3.h>

#include "bench/kernel/task.h"

namespace {

using namespace tetmend::bench;

class CgalKernel {
 public:
  using Traits = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Structure = CGAL::Triangulation_data_structure_3<CGAL::Triangulation_vertex_base_3<Traits>,
                                                         CGAL::Triangulation_cell_base_3<Traits>>;
  using Vertex = Structure::Vertex_handle;
  using Cell = Structure::Cell_handle;
  using List = std::span<const std::array<std::uint32_t, 2>>;

  explicit CgalKernel(const Arrays& arrays) {
    structure_.set_dimension(3);
    outside_ = structure_.create_vertex();
    for (const auto& p : arrays.points) {
      vertices_.push_back(structure_.create_vertex());
      vertices_.back()->set_point({p[0], p[1], p[2]});
    }
    for (const auto& v : arrays.tets) {
      add({vertices_[v[0]], vertices_[v[1]], vertices_[v[2]], vertices_[v[3]]});
    }
    close();
    open_ = {};
  }

  double volume() const {
    double sum = 0;
    for (auto c = structure_.cells_begin(); c != structure_.cells_end(); ++c) {
      if (c->has_vertex(outside_)) continue;
      sum += CGAL::volume(c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point(),
                          c->vertex(3)->point());
    }
    return sum;
  }
  std::size_t neighbours() const {
    std::size_t sum = 0;
    for (auto c = structure_.cells_begin(); c != structure_.cells_end(); ++c) {
      if (c->has_vertex(outside_)) continue;
      for (int i = 0; i < 4; ++i) sum += c->neighbor(i)->has_vertex(outside_) ? 0 : 1;
    }
    return sum;
  }
  std::size_t stars() {
    std::size_t sum = 0;
    for (const Vertex v : vertices_) {
      around_.clear();
      structure_.incident_cells(v, std::back_inserter(around_));
      for (const Cell c : around_) sum += c->has_vertex(outside_) ? 0 : 1;
    }
    return sum;
  }
  std::size_t one_rings() {
    std::size_t sum = 0;
    std::vector<Vertex> ring;
    for (const Vertex v : vertices_) {
      ring.clear();
      structure_.adjacent_vertices(v, std::back_inserter(ring));
      for (const Vertex w : ring) sum += w == outside_ ? 0 : 1;
    }
    return sum;
  }
  std::size_t edges() {
    edges_.clear();
    for (auto e = structure_.edges_begin(); e != structure_.edges_end(); ++e) {
      const auto [c, i, j] = *e;
      if (c->vertex(i) != outside_ && c->vertex(j) != outside_) edges_.push_back(*e);
    }
    return edges_.size();
  }
  std::size_t rings() const {
    std::size_t sum = 0;
    for (const Structure::Edge& e : edges_) {
      auto cell = structure_.incident_cells(e);
      const auto first = cell;
      do {
        sum += cell->has_vertex(outside_) ? 0 : 1;
      } while (++cell != first);
    }
    return sum;
  }
  std::size_t flip(List list) {
    std::size_t made = 0;
    for (const auto& [a, b] : list) {
      Cell c;
      int i = 0, j = 0;
      if (structure_.is_edge(vertices_[a], vertices_[b], c, i, j) && structure_.flip(c, i, j)) {
        ++made;
      }
    }
    return made;
  }

 private:
  using Face = std::array<Vertex, 3>;
  struct FaceHash {
    std::size_t operator()(const Face& face) const {
      std::size_t sum = 0;
      for (const Vertex& v : face) sum = 31 * sum + reinterpret_cast<std::size_t>(&*v) / 16;
      return sum;
    }
  };

  /// Joins it to the cell behind each of its faces, if that is there.
  void add(const std::array<Vertex, 4>& v) {
    const Cell c = structure_.create_cell(v[0], v[1], v[2], v[3]);
    for (int i = 0; i < 4; ++i) {
      c->vertex(i)->set_cell(c);
      Face face;
      for (int k = 0, n = 0; k < 4; ++k) {
        if (k != i) face[static_cast<std::size_t>(n++)] = c->vertex(k);
      }
      std::sort(face.begin(), face.end());
      const auto [other, is_new] = open_.try_emplace(face, c, i);
      if (is_new) continue;
      structure_.set_adjacency(c, i, other->second.first, other->second.second);
      open_.erase(other);
    }
  }
  void close() {
    const auto boundary = open_;
    for (const auto& [face, side] : boundary) {
      const auto& [c, i] = side;
      std::array<Vertex, 4> v = {c->vertex(0), c->vertex(1), c->vertex(2), c->vertex(3)};
      v[static_cast<std::size_t>(i)] = outside_;
      std::swap(v[static_cast<std::size_t>((i + 1) % 4)], v[static_cast<std::size_t>((i + 2) % 4)]);
      add(v);
    }
  }

  Structure structure_;
  Vertex outside_;
  std::vector<Vertex> vertices_;
  std::unordered_map<Face, std::pair<Cell, int>, FaceHash> open_;
  std::vector<Structure::Edge> edges_;
  std::vector<Cell> around_;
};

}  // namespace

int main(int argc, char** argv) {
  return run<CgalKernel>(argc, argv);
}
