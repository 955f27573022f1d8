// SPDX-License-Identifier: MIT
// The tasks of task.h by cinolib's Tetmesh, whose numbers change with what is removed.
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <cinolib/meshes/tetmesh.h>

#include "bench/kernel/task.h"

namespace {

using namespace tetmend::bench;

class CinolibKernel {
 public:
  using List = std::span<const std::array<std::uint32_t, 2>>;

  explicit CinolibKernel(const Arrays& arrays) : mesh_(points_of(arrays), tets_of(arrays)) {
    for (std::uint32_t v = 0; v < arrays.points.size(); ++v) id_.push_back(v);
    number_ = id_;
  }

  double volume() const {
    double sum = 0;
    for (uint t = 0; t < mesh_.num_polys(); ++t) sum += mesh_.poly_volume(t);
    return sum;
  }
  std::size_t neighbours() const {
    std::size_t sum = 0;
    for (uint t = 0; t < mesh_.num_polys(); ++t) sum += mesh_.adj_p2p(t).size();
    return sum;
  }
  std::size_t stars() const {
    std::size_t sum = 0;
    for (uint v = 0; v < mesh_.num_verts(); ++v) sum += mesh_.adj_v2p(v).size();
    return sum;
  }
  std::size_t one_rings() const {
    std::size_t sum = 0;
    for (uint v = 0; v < mesh_.num_verts(); ++v) sum += mesh_.adj_v2v(v).size();
    return sum;
  }
  std::size_t edges() const { return mesh_.num_edges(); }
  std::size_t rings() const {
    std::size_t sum = 0;
    for (uint e = 0; e < mesh_.num_edges(); ++e) sum += mesh_.edge_ordered_poly_ring(e).size();
    return sum;
  }
  std::size_t flip(List list) {
    std::size_t made = 0;
    for (const auto& [a, b] : list) {
      const int e = mesh_.edge_id(a, b);
      if (e >= 0 && mesh_.edge_flip(static_cast<uint>(e))) ++made;
    }
    return made;
  }
  std::size_t contract(List list) {
    std::size_t made = 0;
    for (const auto& [gone, stays] : list) {
      const uint v = id_[gone], w = id_[stays];
      const int e = mesh_.edge_id(v, w);
      if (e < 0 || mesh_.edge_collapse(static_cast<uint>(e), mesh_.vert(w)) < 0) continue;
      // The larger of the two went; the last one has its place.
      const uint removed = std::max(v, w);
      number_[removed] = number_.back();
      id_[number_[removed]] = removed;
      number_.pop_back();
      ++made;
    }
    return made;
  }

 private:
  static std::vector<cinolib::vec3d> points_of(const Arrays& arrays) {
    std::vector<cinolib::vec3d> points;
    for (const auto& p : arrays.points) points.emplace_back(p[0], p[1], p[2]);
    return points;
  }
  static std::vector<std::vector<uint>> tets_of(const Arrays& arrays) {
    std::vector<std::vector<uint>> tets;
    for (const auto& v : arrays.tets) tets.push_back({v[0], v[1], v[2], v[3]});
    return tets;
  }
  cinolib::Tetmesh<> mesh_;
  std::vector<uint> id_, number_;  // of a vertex by its number at the start, and back
};

}  // namespace

int main(int argc, char** argv) {
  return run<CinolibKernel>(argc, argv);
}
