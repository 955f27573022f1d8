// SPDX-License-Identifier: MIT
// Regions, interior faces, edges and vertices, and frozen tets through the whole schedule, judged
// from plain arrays before and after: no mark of the mesh is believed.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/formats/mesh_io.h"
#include "kernel/integrity.h"
#include "kernel/statistics.h"
#include "schedule/schedule.h"
#include "tests/support/assets.h"
#include "tests/support/registry.h"
#include "tests/support/threads.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

// ---- Meshes -------------------------------------------------------------------------------------

Point centre(const MeshData& data, const MeshData::Tet& tet) {
  Point sum = Point::Zero();
  for (const std::uint32_t v : tet.vertices) sum += data.points[v] / 4;
  return sum;
}

/// The unit cube, its points inside moved, with slivers.
MeshData cube_with_slivers() {
  return kuhn_cube(8, 0.33, 5);
}

/// Names the faces between tets on the two sides of a rough cut, as far as `is_part` says.
template <class IsAbove, class IsPart>
void add_sheet(MeshData& data, Label label, IsAbove&& is_above, IsPart&& is_part) {
  const TetMesh mesh(data);
  for (const TetHandle t : live_tets(mesh)) {
    if (is_above(centre(data, data.tets[t.index()]))) continue;
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace twin = mesh.twin(HalfFace(t, f));
      if (twin.is_outside() || !is_above(centre(data, data.tets[twin.tet().index()]))) continue;
      const auto [a, b, c] = mesh.vertices(HalfFace(t, f));
      if (is_part((mesh.point(a) + mesh.point(b) + mesh.point(c)) / 3)) {
        data.triangles.push_back({{a.index(), b.index(), c.index()}, label});
      }
    }
  }
}

/// A sheet with a hole and a free rim, all within one region.
MeshData cube_with_sheet() {
  MeshData data = cube_with_slivers();
  const auto radius = [](const Point& p) { return (p - Point(0.5, 0.5, 0.5)).norm(); };
  add_sheet(
      data, 10, [](const Point& p) { return p.x() + 0.4 * p.y() > 0.7; },
      [&](const Point& p) { return radius(p) > 0.15 && radius(p) < 0.4; });
  return data;
}

/// Two regions with a slanted border, one with a sheet that ends at the border.
MeshData two_regions_with_sheet() {
  MeshData data = cube_with_slivers();
  const auto above = [](const Point& p) { return p.z() > 0.35 + 0.3 * p.x(); };
  for (MeshData::Tet& tet : data.tets) tet.label = above(centre(data, tet)) ? 4 : 9;
  add_sheet(
      data, 3, [](const Point& p) { return p.y() > 0.5; }, above);
  return data;
}

/// Edges in no face, chains of them, and required vertices, strewn over a region.
MeshData cube_with_edges_and_vertices() {
  MeshData data = cube_with_slivers();
  for (std::size_t i = 0; i < data.tets.size(); ++i) {
    const auto& v = data.tets[i].vertices;
    if (i % 37 == 5) data.edges.push_back({{v[1], v[3]}, 6});
    if (i % 97 == 5) data.edges.push_back({{v[3], v[0]}, 7});
    if (i % 53 == 7) data.required_vertices.push_back(v[2]);
  }
  return data;
}

/// Anything anywhere: single faces, edges and vertices in a ball of three regions.
MeshData strewn_ball() {
  MeshData data = delaunay_ball(700, 21);
  for (std::size_t i = 0; i < data.tets.size(); ++i) {
    const auto& v = data.tets[i].vertices;
    const Point c = centre(data, data.tets[i]);
    data.tets[i].label = c.x() < 0 ? 1 : c.y() < 0 ? 2 : -3;
    if (i % 61 == 3) data.triangles.push_back({{v[0], v[1], v[2]}, 5});
    if (i % 47 == 5) data.edges.push_back({{v[1], v[3]}, 6});
    if (i % 71 == 7) data.required_vertices.push_back(v[2]);
  }
  return data;
}

std::vector<NamedMesh> constrained_meshes() {
  return {{"sheet.mesh", read_mesh(asset("sheet.mesh"))},
          {"folded_sheet.mesh", read_mesh(asset("folded_sheet.mesh"))},
          {"two_materials.mesh", read_mesh(asset("two_materials.mesh"))},
          {"cube_with_sheet", cube_with_sheet()},
          {"two_regions_with_sheet", two_regions_with_sheet()},
          {"cube_with_edges_and_vertices", cube_with_edges_and_vertices()},
          {"strewn_ball", strewn_ball()}};
}

// ---- What must be kept --------------------------------------------------------------------------

using Coordinates = std::array<double, 3>;
using Places = std::vector<Coordinates>;

Coordinates at(const MeshData& data, std::uint32_t v) {
  const Point& p = data.points[v];
  return {p.x(), p.y(), p.z()};
}

template <class Vertices>
Places places_of(const MeshData& data, const Vertices& vertices) {
  Places all;
  for (const std::uint32_t v : vertices) all.push_back(at(data, v));
  return all;
}

Places unordered(Places all) {
  std::sort(all.begin(), all.end());
  return all;
}

struct Content {
  std::map<Label, long double> volumes;
  long double absolute = 0;
  std::map<Label, std::multiset<Places>> surfaces;  // of each region, outwards
  std::vector<std::pair<Places, Label>> triangles;
  std::vector<std::pair<Places, Label>> edges;
  std::vector<Coordinates> required;
  std::set<Places> named_faces;  // triangles that are faces of tets, corners sorted
  std::set<Places> named_edges;  // edges of tets
  std::size_t bad = 0;
};

Content content_of(const MeshData& data) {
  Content p;
  for (const auto& triangle : data.triangles)
    p.triangles.emplace_back(places_of(data, triangle.vertices), triangle.label);
  for (const auto& edge : data.edges)
    p.edges.emplace_back(places_of(data, edge.vertices), edge.label);
  for (const std::uint32_t v : data.required_vertices) p.required.push_back(at(data, v));
  std::sort(p.required.begin(), p.required.end());
  p.required.erase(std::unique(p.required.begin(), p.required.end()), p.required.end());

  std::map<std::array<std::uint32_t, 3>, std::vector<std::pair<Label, Places>>> sides;
  std::set<std::array<std::uint32_t, 2>> tet_edges;
  const auto sorted = [](auto vertices) {
    std::sort(vertices.begin(), vertices.end());
    return vertices;
  };
  for (const MeshData::Tet& tet : data.tets) {
    const auto& v = tet.vertices;
    std::array<Point, 4> x;
    for (std::size_t i = 0; i < 4; ++i) x[i] = data.points[v[i]];
    const long double volume = volume6(x[0], x[1], x[2], x[3]);
    p.volumes[tet.label] += volume;
    p.absolute += std::abs(volume);
    p.bad += minimum_sine(x[0], x[1], x[2], x[3]) < 0.5;
    for (const auto& local : kFaceVertices) {
      const std::array<std::uint32_t, 3> face = {v[local[0]], v[local[1]], v[local[2]]};
      Places outwards = places_of(data, face);
      std::rotate(outwards.begin(), std::min_element(outwards.begin(), outwards.end()),
                  outwards.end());
      sides[sorted(face)].emplace_back(tet.label, outwards);
    }
    for (const auto& local : kEdgeVertices) {
      tet_edges.insert(sorted(std::array<std::uint32_t, 2>{v[local[0]], v[local[1]]}));
    }
  }
  for (const auto& [face, tets] : sides) {
    if (tets.size() == 2 && tets[0].first == tets[1].first) continue;
    for (const auto& [label, outwards] : tets) p.surfaces[label].insert(outwards);
  }
  for (const auto& triangle : data.triangles) {
    if (sides.contains(sorted(triangle.vertices)))
      p.named_faces.insert(unordered(places_of(data, triangle.vertices)));
  }
  for (const auto& edge : data.edges) {
    if (tet_edges.contains(sorted(edge.vertices)))
      p.named_edges.insert(unordered(places_of(data, edge.vertices)));
  }
  return p;
}

void check_content_kept(const Content& now, const Content& before) {
  REQUIRE(now.volumes.size() == before.volumes.size());
  for (const auto& [label, volume] : before.volumes) {
    REQUIRE(now.volumes.contains(label));
    CHECK(std::abs(now.volumes.at(label) - volume) <= 1e-12L * before.absolute);
  }
  CHECK(now.surfaces == before.surfaces);
  CHECK(now.triangles == before.triangles);
  CHECK(now.edges == before.edges);
  CHECK(now.required == before.required);
  CHECK(now.named_faces == before.named_faces);
  CHECK(now.named_edges == before.named_edges);
}

/// The whole schedule, in that many blocks.
void improve_in_blocks(TetMesh& mesh, std::size_t blocks) {
  on_threads(2, [&] {
    Run run(mesh, kRegistry);
    run.set_block_count(blocks);
    improve(run);
  });
  CHECK(to_string(check_integrity(mesh)) == "");
}

using Cells = std::multiset<std::pair<Label, Places>>;

Cells frozen_cells(const TetMesh& mesh) {
  Cells all;
  for (const TetHandle t : live_tets(mesh)) {
    if (!mesh.is_frozen(t)) continue;
    Places of_tet;
    for (const VertexHandle v : mesh.vertices(t)) {
      of_tet.push_back({mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()});
    }
    all.emplace(mesh.label(t), of_tet);
  }
  return all;
}

/// What the tets that are not frozen lack to be good.
double free_deficit(const TetMesh& mesh) {
  double sum = 0;
  for (const TetHandle t : live_tets(mesh)) {
    if (!mesh.is_frozen(t)) sum += deficit(mesh.quality(t));
  }
  return sum;
}

}  // namespace

TEST_CASE("the schedule keeps each region, and all that a file names, in any number of blocks") {
  for (const NamedMesh& named : constrained_meshes()) {
    CAPTURE(named.name);
    const Content before = content_of(named.data);
    for (const std::size_t blocks : {1, 2, 7}) {
      CAPTURE(blocks);
      TetMesh mesh = TetMesh::sorted(named.data);
      improve_in_blocks(mesh, blocks);
      const Content now = content_of(mesh.to_data());
      check_content_kept(now, before);
      CHECK(now.bad < before.bad);
    }
  }
}

TEST_CASE("the meshes of these tests have what they are meant to test") {
  const auto loose = [](const MeshData& data) {
    BuildReport report;
    const TetMesh mesh(data, &report);
    return report.loose_triangles + report.loose_edges;
  };
  const auto free_standing = [](const MeshData& data) {
    BuildReport report;
    const TetMesh mesh(data, &report, InteriorConstraints::dropped);
    return std::array<std::size_t, 3>{report.dropped_triangles, report.dropped_edges,
                                      report.dropped_vertices};
  };
  for (const NamedMesh& named : constrained_meshes()) {
    if (named.name != "strewn_ball") CHECK(loose(named.data) == 0);
  }
  CHECK(free_standing(read_mesh(asset("sheet.mesh")))[0] == 94);
  CHECK(free_standing(read_mesh(asset("folded_sheet.mesh")))[0] == 252);
  CHECK(free_standing(read_mesh(asset("two_materials.mesh")))[0] == 0);
  CHECK(free_standing(cube_with_sheet())[0] > 40);
  CHECK(free_standing(two_regions_with_sheet())[0] > 40);
  const auto strewn = free_standing(cube_with_edges_and_vertices());
  CHECK(strewn[1] > 40);
  CHECK(strewn[2] > 20);
  const auto ball = free_standing(strewn_ball());
  CHECK(std::min({ball[0], ball[1], ball[2]}) > 20);
}

TEST_CASE("without interior constraints regions and surface are kept all the same") {
  for (const NamedMesh& named : constrained_meshes()) {
    CAPTURE(named.name);
    TetMesh mesh = TetMesh::sorted(named.data, nullptr, InteriorConstraints::dropped);
    const Content before = content_of(mesh.to_data());
    CHECK(before.surfaces == content_of(named.data).surfaces);
    improve_in_blocks(mesh, 2);
    check_content_kept(content_of(mesh.to_data()), before);
  }
}

TEST_CASE("a sharply folded sheet is kept at a price that a run without it does not pay") {
  const MeshData data = read_mesh(asset("folded_sheet.mesh"));
  TetMesh respected = TetMesh::sorted(data);
  TetMesh ignored = TetMesh::sorted(data, nullptr, InteriorConstraints::dropped);
  improve_in_blocks(respected, 1);
  improve_in_blocks(ignored, 1);
  // The halves meet at 18 degrees, and triangulation makes that hardly more.
  CHECK(compute_statistics(respected).theta_min < 18.5);
  CHECK(compute_statistics(respected).n_bad > 20);
  CHECK(compute_statistics(ignored).theta_min > 28);
  CHECK(compute_statistics(ignored).n_bad < 5);
}

TEST_CASE("frozen tets go through the schedule untouched, and the others get better") {
  for (const NamedMesh& named : constrained_meshes()) {
    CAPTURE(named.name);
    const Content before = content_of(named.data);
    for (const std::size_t blocks : {1, 5}) {
      CAPTURE(blocks);
      TetMesh mesh = TetMesh::sorted(named.data);
      Point middle = Point::Zero();
      for (const VertexHandle v : live_vertices(mesh)) middle += mesh.point(v);
      middle /= static_cast<double>(mesh.vertex_count());
      const std::size_t frozen = mesh.freeze([&](TetHandle t) {
        return mesh.point(mesh.vertices(t)[0]).x() + mesh.point(mesh.vertices(t)[1]).y() <
               middle.x() + middle.y();
      });
      const Cells cells = frozen_cells(mesh);
      REQUIRE(frozen > 100);
      REQUIRE(cells.size() == frozen);
      const QualityIndicators free_before = quality_indicators(mesh);
      const double deficit_before = free_deficit(mesh);
      improve_in_blocks(mesh, blocks);
      CHECK(frozen_cells(mesh) == cells);
      check_content_kept(content_of(mesh.to_data()), before);
      // Among so many fixed vertices a better worst tet may be paid for with mild bad ones.
      CHECK(quality_indicators(mesh).q_worst >= free_before.q_worst);
      CHECK(free_deficit(mesh) < 0.9 * deficit_before);
    }
  }
}

TEST_CASE("no pass tries a frozen tet or one of its vertices") {
  TetMesh mesh(cube_with_slivers());
  mesh.freeze([&](TetHandle t) { return mesh.quality(t) < kBadThreshold; });
  const TetMesh before = mesh;
  Run run(mesh, kRegistry);
  local_reconnection(run, {});
  insert_points(run, {});
  smooth(run, {});
  suppress_points(run, {});
  for (const PassRecord& pass : run.records) CHECK(pass.items == 0);
  improve(run);
  CHECK(mesh == before);
}

TEST_CASE("a small part is improved as far as if the rest had no bad tets") {
  // Progress is judged by the part alone: the many bad tets outside must not end the run early.
  const MeshData data = kuhn_cube(12, 0.33, 3);
  TetMesh mesh = TetMesh::sorted(data);
  mesh.freeze([&](TetHandle t) {
    const TetVertices& tv = mesh.vertices(t);
    return std::any_of(tv.begin(), tv.end(),
                       [&](VertexHandle v) { return mesh.point(v).maxCoeff() > 0.45; });
  });
  const QualityIndicators before = quality_indicators(mesh);
  TetMesh whole = TetMesh::sorted(data);
  REQUIRE(before.n_bad * 10 < quality_indicators(whole).n_bad);
  improve_in_blocks(mesh, 1);
  CHECK(quality_indicators(mesh).n_bad * 5 < before.n_bad);
}
