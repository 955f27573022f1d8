// SPDX-License-Identifier: MIT
// Second order in, second order out.
#include "kernel/second_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include <doctest/doctest.h>
#include <tetmend/check.h>
#include <tetmend/improve.h>

#include "contract/zoo.h"
#include "face/mesh_access.h"
#include "kernel/curved.h"
#include "tests/support/second_order.h"

using namespace tetmend;

namespace {

using Key = std::array<double, 3>;

Key key_of(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

std::set<Key> fixed_nodes(const MeshData& data) {
  const auto fixed = find_fixed_mid_nodes(data, true).is_fixed;
  std::set<Key> nodes;
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    if (fixed[i]) nodes.insert(key_of(data.points[data.mid_nodes[i][2]]));
  }
  return nodes;
}

CurvedStatistics statistics_of(const MeshData& data) {
  return curved_statistics(data, TetMesh(data));
}

void check_second_order(const MeshData& data) {
  const MidNodes nodes(data.mid_nodes);
  std::set<std::uint32_t> used;
  for (const MeshData::Tet& tet : data.tets) {
    const auto of = nodes.of(tet.vertices);
    CHECK(of.size() == 6);
    used.insert(of.begin(), of.end());
    used.insert(tet.vertices.begin(), tet.vertices.end());
  }
  CHECK(used.size() == data.points.size());
}

/// A sheet of 6 x 2 x 1 cubes of six tets, thinner than its curved faces bulge.
MeshData curved_sheet(double bulge) {
  constexpr std::uint32_t kLong = 6;
  constexpr std::uint32_t kWide = 2;
  constexpr double kThick = 0.08;
  MeshData flat;
  for (std::uint32_t i = 0; i <= kLong; ++i) {
    for (std::uint32_t j = 0; j <= kWide; ++j) {
      for (std::uint32_t k = 0; k < 2; ++k) flat.points.push_back({0.5 * i, 0.5 * j, kThick * k});
    }
  }
  const auto number = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return (i * (kWide + 1) + j) * 2 + k;
  };
  constexpr std::array<std::array<std::uint32_t, 3>, 6> kOrders = {
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  for (std::uint32_t cell = 0; cell < kLong * kWide; ++cell) {
    for (const auto& order : kOrders) {
      std::array<std::uint32_t, 3> at = {cell / kWide, cell % kWide, 0};
      MeshData::Tet tet;
      tet.vertices[0] = number(at[0], at[1], at[2]);
      for (std::size_t s = 0; s < 3; ++s) {
        ++at[order[s]];
        tet.vertices[s + 1] = number(at[0], at[1], at[2]);
      }
      flat.tets.push_back(tet);
    }
  }
  for (MeshData::Tet& tet : flat.tets) {
    const auto& v = tet.vertices;
    const Point a = flat.points[v[0]];
    if ((flat.points[v[1]] - a).cross(flat.points[v[2]] - a).dot(flat.points[v[3]] - a) < 0) {
      std::swap(tet.vertices[0], tet.vertices[1]);
    }
  }
  MeshData mesh = test::second_order(flat, 0);
  // Nodes of the surface rise between their vertices, those of edges inside do not.
  const std::vector<bool> is_surface = find_fixed_mid_nodes(mesh, true).is_fixed;
  for (std::size_t i = 0; i < mesh.mid_nodes.size(); ++i) {
    const auto& [a, b, node] = mesh.mid_nodes[i];
    Point along = mesh.points[b] - mesh.points[a];
    along.z() = 0;
    if (is_surface[i]) mesh.points[node].z() += bulge * along.squaredNorm();
  }
  return mesh;
}

std::set<Key> surface_nodes(const MeshData& data) {
  const FixedMidNodes fixed = find_fixed_mid_nodes(data, true);
  std::set<std::array<std::uint32_t, 2>> inside;
  for (const MeshData::Edge& edge : fixed.inside) inside.insert(edge.vertices);
  std::set<Key> nodes;
  for (std::size_t i = 0; i < data.mid_nodes.size(); ++i) {
    const auto& [a, b, node] = data.mid_nodes[i];
    if (fixed.is_fixed[i] && !inside.contains({a, b})) nodes.insert(key_of(data.points[node]));
  }
  return nodes;
}

}  // namespace

TEST_CASE("a mesh of second order made of arrays is improved like the one that they are from") {
  const MeshData given = test::second_order(contract::delaunay_ball(350, 1), 0.1);
  Mesh original = MeshAccess::make(given);
  Mesh made(MeshArrays(original.arrays()));
  CHECK(made.mid_nodes().size() == given.mid_nodes.size());
  improve(original);
  const Result result = improve(made);
  CHECK(result.after.n_bad < result.before.n_bad);
  REQUIRE(result.curved_after.has_value());
  CHECK(result.curved_after->curved > 100);
  CHECK(made.arrays().points == original.arrays().points);
  CHECK(made.arrays().tets == original.arrays().tets);
  auto mid_nodes = std::pair(made.arrays().mid_nodes, original.arrays().mid_nodes);
  std::sort(mid_nodes.first.begin(), mid_nodes.first.end());
  std::sort(mid_nodes.second.begin(), mid_nodes.second.end());
  CHECK(mid_nodes.first == mid_nodes.second);
}

TEST_CASE("a curved surface keeps its nodes, no tet is nearer to turning over") {
  for (const double strength : {0.02, 0.1, 0.25}) {
    for (const unsigned seed : {1u, 2u}) {
      CAPTURE(strength);
      CAPTURE(seed);
      MeshData before = test::second_order(contract::delaunay_ball(350, seed), strength);
      std::vector<double> field;
      for (const Point& p : before.points) field.push_back(1 + p.x() - 2 * p.y() + 0.5 * p.z());
      before.point_data = {{"field", 1, field}};
      const CurvedStatistics was = statistics_of(before);
      CHECK(was.curved > 100);
      Mesh mesh = MeshAccess::make(before);
      const Result result = improve(mesh, {.schedule = seed == 1 ? "thorough" : "shell"});
      const MeshData& after = MeshAccess::data(mesh);
      CHECK(result.after.n_bad < result.before.n_bad);
      check_second_order(after);
      CHECK(surface_nodes(after) == surface_nodes(before));
      const CurvedStatistics is = statistics_of(after);
      CHECK(is.worst.at_nodes >= was.worst.at_nodes - 1e-9);
      CHECK(is.worst.bound >= was.worst.bound - 1e-9);
      CHECK(is.turned_over <= was.turned_over);
      REQUIRE(result.curved_after.has_value());
      CHECK(result.curved_after->mid_nodes == after.mid_nodes.size());
      CHECK(result.curved_after->worst.at_nodes == doctest::Approx(is.worst.at_nodes));
      CHECK(result.after.vertices == after.points.size());
      const auto fixed = find_fixed_mid_nodes(after, true).is_fixed;
      for (std::size_t i = 0; i < fixed.size(); ++i) {
        const auto& [a, b, node] = after.mid_nodes[i];
        const Point middle = (after.points[a] + after.points[b]) / 2;
        if (!fixed[i] && result.curved_edges == 0) {
          CHECK((after.points[node] - middle).norm() < 1e-12);
        }
      }
      const auto& now = std::get<std::vector<double>>(after.point_data[0].values);
      for (std::size_t i = 0; i < now.size(); ++i) {
        const Point& p = after.points[i];
        CHECK(now[i] == doctest::Approx(1 + p.x() - 2 * p.y() + 0.5 * p.z()).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("a clearly curved edge within the volume stays as it is") {
  MeshData before = test::second_order(contract::delaunay_ball(400, 4), 0.1);
  const auto fixed = find_fixed_mid_nodes(before, true).is_fixed;
  std::set<Key> curved;
  for (std::size_t i = 0; i < fixed.size() && curved.size() < 5; i += 7) {
    if (fixed[i]) continue;
    const auto& [a, b, node] = before.mid_nodes[i];
    before.points[node] += 0.02 * (before.points[b] - before.points[a]).cross(Point(0, 0, 1));
    curved.insert(key_of(before.points[node]));
  }
  Mesh mesh = MeshAccess::make(before);
  improve(mesh);
  const MeshData& after = MeshAccess::data(mesh);
  check_second_order(after);
  CHECK(fixed_nodes(after) == fixed_nodes(before));
  const std::set<Key> now = fixed_nodes(after);
  CHECK(std::includes(now.begin(), now.end(), curved.begin(), curved.end()));
  CHECK(after.edges.empty());
}

TEST_CASE("edges within the volume give way to a curved surface, whose nodes stay") {
  const MeshData before = curved_sheet(0.4);
  const CurvedStatistics was = statistics_of(before);
  CHECK(was.turned_over > 10);
  Mesh mesh = MeshAccess::make(before);
  const Result result = improve(mesh);
  const MeshData& after = MeshAccess::data(mesh);
  check_second_order(after);
  CHECK(surface_nodes(after) == surface_nodes(before));
  CHECK(result.curved_edges > 0);
  CHECK(result.straightened_edges == 0);
  const CurvedStatistics is = statistics_of(after);
  CHECK(is.turned_over == 0);
  CHECK(result.curved_after->turned_over == is.turned_over);
  CHECK(is.worst.at_nodes >= was.worst.at_nodes);
  CHECK(is.worst.bound >= was.worst.bound);
  const bool is_told = std::any_of(result.notes.begin(), result.notes.end(), [](const auto& note) {
    return note.find("edges within the volume that are curved at the end: ") != std::string::npos;
  });
  CHECK(is_told);
  for (const Fact& fact : compare(MeshAccess::make(before), mesh)) {
    CAPTURE(fact.text);
    CHECK(fact.holds);
  }
}

TEST_CASE(
    "what no inner edge can help is told, and made straight on request, as little as it takes") {
  // A tet alone has no inner edge.
  MeshData before;
  before.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  before.tets = {{{0, 1, 2, 3}, 1}};
  before = test::second_order(before, 0);
  for (const auto& [a, b, node] : before.mid_nodes) {
    if (before.points[a].z() == 0 && before.points[b].z() == 0) before.points[node].z() += 0.6;
  }
  CHECK(statistics_of(before).turned_over == 1);
  Mesh kept = MeshAccess::make(before);
  const Result as_it_was = improve(kept);
  CHECK(MeshAccess::data(kept).points == before.points);
  CHECK(as_it_was.curved_after->turned_over == 1);
  const bool is_told =
      std::any_of(as_it_was.notes.begin(), as_it_was.notes.end(), [](const auto& note) {
        return note.find("stay turned over: 1; nodes on edges that stay hold them: 3") !=
                   std::string::npos &&
               note.find("--straighten") != std::string::npos;
      });
  CHECK(is_told);
  Mesh straight = MeshAccess::make(before);
  const Result result = improve(straight, {.straighten = true});
  CHECK(result.curved_after->turned_over == 0);
  CHECK(result.straightened_edges > 0);
  CHECK(result.straightened_edges < 3);
  const MeshData& after = MeshAccess::data(straight);
  for (const std::uint32_t v : after.tets[0].vertices) {
    CHECK(std::count(before.points.begin(), before.points.end(), after.points[v]) == 1);
  }
}

TEST_CASE("tets that are protected keep their nodes, though they are turned over") {
  const MeshData before = curved_sheet(0.4);
  Mesh mesh = MeshAccess::make(before);
  const Result result = improve(mesh, {.protect = {"label:0"}, .straighten = true});
  CHECK(MeshAccess::data(mesh).points.size() == before.points.size());
  CHECK(statistics_of(MeshAccess::data(mesh)).turned_over == statistics_of(before).turned_over);
  CHECK(result.straightened_edges == 0);
  const bool is_told = std::any_of(result.notes.begin(), result.notes.end(), [](const auto& note) {
    return note.find("of tets or points that are kept") != std::string::npos;
  });
  CHECK(is_told);
}

TEST_CASE("a straight mesh of second order is improved like one of first order") {
  const MeshData first = contract::delaunay_ball(400, 6);
  Mesh straight = MeshAccess::make(first);
  Mesh second = MeshAccess::make(test::second_order(first, 0));
  const Result a = improve(straight);
  const Result b = improve(second);
  CHECK(a.after.n_bad == b.after.n_bad);
  CHECK(b.curved_after->curved == 0);
  CHECK(b.curved_after->worst.at_nodes == 1);
  check_second_order(MeshAccess::data(second));
}

TEST_CASE("nodes of curved triangles without a tet and of prisms beside the tets stay") {
  MeshData before = test::second_order(contract::delaunay_ball(400, 4), 0.1);
  // A triangle of its own, far away, with curved edges.
  const auto first = static_cast<std::uint32_t>(before.points.size());
  for (const Point& p : {Point(9, 0, 0), Point(10, 0, 0), Point(9, 1, 0), Point(9.5, -0.2, 0),
                         Point(9.6, 0.6, 0), Point(8.8, 0.5, 0)}) {
    before.points.push_back(p);
  }
  before.triangles.push_back({{first, first + 1, first + 2}, 3});
  before.mid_nodes.push_back({first, first + 1, first + 3});
  before.mid_nodes.push_back({first + 1, first + 2, first + 4});
  before.mid_nodes.push_back({first, first + 2, first + 5});
  // An element of another kind that has the nodes of some edges of the tets for its own.
  OtherElements others;
  others.vtk_type = 26;
  others.vertex_count = 15;
  for (std::size_t i = 0; i < 15; ++i) {
    others.vertices.push_back(before.mid_nodes[i / 3][i % 3]);
  }
  others.labels = {1};
  before.other_elements = {others};
  std::vector<Point> places;
  for (const std::uint32_t v : others.vertices) {
    before.required_vertices.push_back(v);
    places.push_back(before.points[v]);
  }
  Mesh mesh = MeshAccess::make(before);
  improve(mesh);
  const MeshData& after = MeshAccess::data(mesh);
  REQUIRE(after.triangles.size() == 1);
  const auto nodes = MidNodes(after.mid_nodes).of(after.triangles[0].vertices);
  REQUIRE(nodes.size() == 3);
  CHECK(after.points[nodes[0]] == Point(9.5, -0.2, 0));
  CHECK(after.points[nodes[1]] == Point(9.6, 0.6, 0));
  CHECK(after.points[nodes[2]] == Point(8.8, 0.5, 0));
  REQUIRE(after.other_elements.size() == 1);
  for (std::size_t i = 0; i < 15; ++i) {
    REQUIRE(after.other_elements[0].vertices[i] < after.points.size());
    CHECK(after.points[after.other_elements[0].vertices[i]] == places[i]);
  }
}
