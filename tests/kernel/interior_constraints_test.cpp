// SPDX-License-Identifier: MIT
// What a file names inside a region constrains the mesh, or is dropped on demand; what lies on the
// boundary or between labels never is.
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/integrity.h"
#include "kernel/shell.h"
#include "kernel/tet_mesh.h"
#include "kernel/workspace.h"
#include "tests/support/mesh_parts.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

using Triple = std::array<std::uint32_t, 3>;

/// Two regions, split at z = 1/2, with vertices at the corners of a grid of 4 cells a side.
MeshData layered_cube() {
  MeshData data = kuhn_cube(4, 0, 1);
  for (MeshData::Tet& tet : data.tets) {
    double z = 0;
    for (const std::uint32_t v : tet.vertices) z += data.points[v].z() / 4;
    tet.label = z < 0.5 ? 1 : 2;
  }
  return data;
}

std::size_t constrained_edges(const TetMesh& mesh) {
  std::set<std::array<VertexHandle, 2>> edges;
  for (const TetHandle t : live_tets(mesh)) {
    for (unsigned e = 0; e < 6; ++e) {
      auto ends = mesh.vertices(TetEdge(t, e));
      std::sort(ends.begin(), ends.end());
      if (mesh.is_constrained(TetEdge(t, e))) edges.insert(ends);
    }
  }
  return edges.size();
}

}  // namespace

TEST_CASE("dropping takes what lies inside a region, and nothing of boundary and borders") {
  MeshData data = layered_cube();
  const auto at = [&](double x, double y, double z) { return vertex_at(data, Point(x, y, z)); };
  // On the boundary, between the labels, inside the lower region; each an edge of the grid.
  const std::uint32_t outer = at(0.25, 0.25, 0), outer_x = at(0.5, 0.25, 0),
                      outer_xy = at(0.5, 0.5, 0);
  const std::uint32_t between = at(0.25, 0.25, 0.5), between_x = at(0.5, 0.25, 0.5),
                      between_xy = at(0.5, 0.5, 0.5);
  const std::uint32_t inner = at(0.25, 0.25, 0.25), inner_x = at(0.5, 0.25, 0.25),
                      inner_xy = at(0.5, 0.5, 0.25);
  const Triple on_boundary = {outer, outer_x, outer_xy};
  const Triple on_border = {between, between_x, between_xy};
  data.triangles = {{{inner, inner_x, inner_xy}, 5},
                    {on_boundary, 6},
                    {{outer, between, inner_xy}, 7},  // no face; a vertex inside
                    {on_border, 8},
                    {{inner, inner_x, inner_xy}, 9},    // once more
                    {{outer, between, outer_xy}, 10}};  // no face; no vertex inside
  data.edges = {{{outer, outer_x}, 1},    {{between, between_x}, 2},
                {{inner, inner_x}, 3},    {{inner, outer}, 4},  // leaves the boundary
                {{outer, between_xy}, 5},                       // no edge; no end inside
                {{outer, inner_xy}, 6},                         // an edge through a cell
                {{outer_xy, between}, 7}};                      // no edge
  data.required_vertices = {outer, between, inner};

  BuildReport kept_report;
  const TetMesh kept(data, &kept_report);
  CHECK(kept_report.dropped_triangles + kept_report.dropped_edges + kept_report.dropped_vertices ==
        0);
  CHECK(kept.to_data().triangles == data.triangles);
  CHECK(kept.to_data().edges == data.edges);
  CHECK(kept.to_data().required_vertices.size() == 3);

  for (const bool sorted : {false, true}) {
    BuildReport report;
    const TetMesh mesh = sorted ? TetMesh::sorted(data, &report, InteriorConstraints::dropped)
                                : TetMesh(data, &report, InteriorConstraints::dropped);
    CHECK(to_string(check_integrity(mesh)) == "");
    CHECK(report.dropped_triangles == 3);
    CHECK(report.dropped_edges == 3);
    CHECK(report.dropped_vertices == 1);
    CHECK(report.loose_triangles == 1);
    CHECK(report.loose_edges == 2);
    CHECK(report.constrained_faces == 32);
    const MeshData out = mesh.to_data();
    const std::vector<MeshData::Triangle> triangles = {data.triangles[1], data.triangles[3],
                                                       data.triangles[5]};
    CHECK(out.triangles == triangles);
    const std::vector<MeshData::Edge> edges = {data.edges[0], data.edges[1], data.edges[4],
                                               data.edges[6]};
    CHECK(out.edges == edges);
    CHECK(out.required_vertices == std::vector<std::uint32_t>{outer, between});
    CHECK(constrained_edges(mesh) == 2);
    // Free is exactly what would be free without anything named.
    MeshData plain = data;
    plain.triangles.clear();
    plain.edges.clear();
    plain.required_vertices.clear();
    std::multiset<std::array<double, 3>> free, free_of_plain;
    const auto collect = [](const TetMesh& of, std::multiset<std::array<double, 3>>& into) {
      for (const VertexHandle v : live_vertices(of)) {
        const Point& p = of.point(v);
        if (!of.is_fixed(v)) into.insert({p.x(), p.y(), p.z()});
      }
    };
    collect(mesh, free);
    collect(TetMesh(plain), free_of_plain);
    CHECK(free == free_of_plain);
    CHECK(free.size() == 18);
  }
}

TEST_CASE("an edge whose ends lie on the boundary is dropped where it runs inside") {
  MeshData data = shell_mesh({.degree = 5});
  data.edges = {{{0, 1}, 4}, {{2, 3}, 5}};
  BuildReport report;
  const TetMesh mesh(data, &report, InteriorConstraints::dropped);
  CHECK(report.dropped_edges == 1);
  CHECK(report.loose_edges == 0);
  CHECK(mesh.to_data().edges == std::vector<MeshData::Edge>{data.edges[1]});
  Shell shell;
  const auto edge = edge_in(mesh, TetHandle(0), VertexHandle(0), VertexHandle(1));
  REQUIRE(edge);
  CHECK(find_shell(mesh, *edge, shell, Territory()) == ShellKind::closed);
}

TEST_CASE("an edge is constrained in each of two parts that touch at its end") {
  // A walk around the common vertex meets the tets of one part only.
  const MeshData plain = touching_at_vertex();
  const TetMesh mesh(plain);
  std::map<std::uint32_t, std::set<std::uint32_t>> inner_neighbours;
  for (const MeshData::Tet& tet : plain.tets) {
    for (const std::uint32_t v : tet.vertices) {
      for (const std::uint32_t w : tet.vertices) {
        if (!mesh.is_boundary(VertexHandle(v)) && v != w) inner_neighbours[w].insert(v);
      }
    }
  }
  const auto common =
      std::find_if(inner_neighbours.begin(), inner_neighbours.end(),
                   [](const auto& neighbours) { return neighbours.second.size() == 2; });
  REQUIRE(common != inner_neighbours.end());
  for (const std::uint32_t inner : common->second) {
    for (const bool from_common : {false, true}) {
      MeshData data = plain;
      data.edges = {from_common ? MeshData::Edge{{common->first, inner}, 1}
                                : MeshData::Edge{{inner, common->first}, 1}};
      BuildReport report;
      const TetMesh named(data, &report);
      CHECK(report.loose_edges == 0);
      CHECK(constrained_edges(named) == 1);
      CHECK(to_string(check_integrity(named)) == "");
    }
  }
}
