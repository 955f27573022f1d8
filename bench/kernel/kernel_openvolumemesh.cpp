// SPDX-License-Identifier: MIT
// The tasks of task.h by OpenVolumeMesh's kernel of tets. Its flips are deletions and additions.
#include <cstddef>
#include <span>
#include <vector>

#include <OpenVolumeMesh/Mesh/TetrahedralMesh.hh>

#include "bench/kernel/task.h"

namespace {

using namespace tetmend::bench;
namespace ovm = OpenVolumeMesh;

class OpenVolumeMeshKernel {
 public:
  using List = std::span<const std::array<std::uint32_t, 2>>;

  explicit OpenVolumeMeshKernel(const Arrays& arrays) {
    mesh_.enable_deferred_deletion(true);
    for (const auto& p : arrays.points) mesh_.add_vertex(ovm::Vec3d(p[0], p[1], p[2]));
    for (const auto& v : arrays.tets)
      mesh_.add_cell(vertex(v[0]), vertex(v[1]), vertex(v[2]), vertex(v[3]));
  }

  double volume() const {
    double sum = 0;
    for (const ovm::CellHandle c : mesh_.cells()) {
      const auto v = mesh_.get_cell_vertices(c);
      const ovm::Vec3d a = mesh_.vertex(v[0]);
      const ovm::Vec3d x = mesh_.vertex(v[1]) - a, y = mesh_.vertex(v[2]) - a,
                       z = mesh_.vertex(v[3]) - a;
      sum += x.dot(y.cross(z)) / 6;
    }
    return sum < 0 ? -sum : sum;
  }
  std::size_t neighbours() const {
    std::size_t sum = 0;
    for (const ovm::CellHandle c : mesh_.cells()) {
      for (const ovm::HalfFaceHandle f : mesh_.cell(c).halffaces()) {
        sum += mesh_.incident_cell(mesh_.opposite_halfface_handle(f)).is_valid() ? 1 : 0;
      }
    }
    return sum;
  }
  std::size_t stars() const {
    std::size_t sum = 0;
    for (const ovm::VertexHandle v : mesh_.vertices()) {
      for (auto c = mesh_.vc_iter(v); c.valid(); ++c) ++sum;
    }
    return sum;
  }
  std::size_t one_rings() const {
    std::size_t sum = 0;
    for (const ovm::VertexHandle v : mesh_.vertices()) {
      for (auto w = mesh_.vv_iter(v); w.valid(); ++w) ++sum;
    }
    return sum;
  }
  std::size_t edges() const {
    std::size_t sum = 0;
    for (const ovm::EdgeHandle e : mesh_.edges()) sum += e.is_valid() ? 1 : 0;
    return sum;
  }
  std::size_t rings() const {
    std::size_t sum = 0;
    for (const ovm::EdgeHandle e : mesh_.edges()) {
      for (auto c = mesh_.hec_iter(mesh_.halfedge_handle(e, 0)); c.valid(); ++c) ++sum;
    }
    return sum;
  }
  std::size_t flip(List list) {
    std::size_t made = 0;
    for (const auto& [a, b] : list) {
      const ovm::HalfEdgeHandle edge = mesh_.find_halfedge(vertex(a), vertex(b));
      std::vector<std::vector<ovm::VertexHandle>> created;
      for (auto c = mesh_.hec_iter(edge); c.valid() && created.size() < 2; ++c) {
        // With the third vertex of the ring in place of one end: both tets follow from one old one.
        if (!created.empty()) break;
        const auto old = mesh_.get_cell_vertices(*c);
        ovm::VertexHandle third;
        for (auto d = mesh_.hec_iter(edge); d.valid(); ++d) {
          for (const ovm::VertexHandle v : mesh_.get_cell_vertices(*d)) {
            if (std::find(old.begin(), old.end(), v) == old.end()) third = v;
          }
        }
        for (const ovm::VertexHandle end : {vertex(a), vertex(b)}) {
          created.push_back(old);
          std::replace(created.back().begin(), created.back().end(), end, third);
        }
      }
      if (created.size() != 2) continue;
      mesh_.delete_edge(mesh_.edge_handle(edge));
      for (const auto& tet : created) mesh_.add_cell(tet);
      ++made;
    }
    return made;
  }
  std::size_t contract(List list) {
    std::size_t made = 0;
    for (const auto& [gone, stays] : list) {
      const ovm::HalfEdgeHandle edge = mesh_.find_halfedge(vertex(gone), vertex(stays));
      if (edge.is_valid() && mesh_.collapse_edge(edge).is_valid()) ++made;
    }
    return made;
  }

 private:
  static ovm::VertexHandle vertex(std::uint32_t number) {
    return ovm::VertexHandle(static_cast<int>(number));
  }
  ovm::GeometricTetrahedralMeshV3d mesh_;
};

}  // namespace

int main(int argc, char** argv) {
  return run<OpenVolumeMeshKernel>(argc, argv);
}
