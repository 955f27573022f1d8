// SPDX-License-Identifier: MIT
// Jacobians of curved tets, against their definition.
#include "kernel/curved.h"

#include <algorithm>
#include <random>

#include <doctest/doctest.h>

#include "contract/zoo.h"
#include "kernel/second_order.h"
#include "kernel/tet_mesh.h"
#include "tests/support/second_order.h"

using namespace tetmend;

namespace {

/// The map of a tet of second order, by its shape functions.
Point place(const std::array<Point, 4>& v, const std::array<Point, 6>& bends,
            const std::array<double, 4>& w) {
  Point p = Point::Zero();
  for (std::size_t i = 0; i < 4; ++i) p += w[i] * (2 * w[i] - 1) * v[i];
  for (std::size_t e = 0; e < 6; ++e) {
    const auto& [i, j] = kMidNodeEdges[e];
    p += 4 * w[i] * w[j] * ((v[i] + v[j]) / 2 + bends[e]);
  }
  return p;
}

double jacobian(const std::array<Point, 4>& v, const std::array<Point, 6>& bends,
                const std::array<double, 4>& w) {
  constexpr double kStep = 1e-4;  // the map is quadratic: central differences are exact
  std::array<Point, 3> columns;
  for (std::size_t k = 0; k < 3; ++k) {
    auto ahead = w;
    auto behind = w;
    ahead[k + 1] += kStep;
    ahead[0] -= kStep;
    behind[k + 1] -= kStep;
    behind[0] += kStep;
    columns[k] = (place(v, bends, ahead) - place(v, bends, behind)) / (2 * kStep);
  }
  return columns[0].dot(columns[1].cross(columns[2]));
}

CurvedStatistics statistics_of(const MeshData& data) {
  return curved_statistics(data, TetMesh(data));
}

}  // namespace

TEST_CASE("the Jacobian ratio is that of the determinants at the ten nodes, bounded from below") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-0.12, 0.12);
  std::uniform_real_distribution<double> share(0, 1);
  const auto shift = [&] { return Point(noise(random), noise(random), noise(random)); };
  bool bound_matters = false;
  for (int n = 0; n < 200; ++n) {
    std::array<Point, 4> v = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1)};
    for (Point& p : v) p += shift();
    std::array<Point, 6> bends;
    for (Point& bend : bends) bend = shift();
    std::vector<double> values;
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<double, 4> w{};
      w[i] = 1;
      values.push_back(jacobian(v, bends, w));
    }
    for (const auto& [i, j] : kMidNodeEdges) {
      std::array<double, 4> w{};
      w[i] = w[j] = 0.5;
      values.push_back(jacobian(v, bends, w));
    }
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    const JacobianRatio ratio = jacobian_ratio(v, bends);
    CHECK(ratio.at_nodes == doctest::Approx(std::max(*least / *greatest, -1.0)).epsilon(1e-7));
    for (int k = 0; k < 50; ++k) {
      std::array<double, 4> w{share(random), share(random), share(random), share(random)};
      const double sum = w[0] + w[1] + w[2] + w[3];
      for (double& x : w) x /= sum;
      values.push_back(jacobian(v, bends, w));
    }
    const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
    CHECK(ratio.bound <= std::max(*lowest / *highest, -1.0) + 1e-7);
    bound_matters |= ratio.bound < ratio.at_nodes - 0.01;
  }
  CHECK(bound_matters);
}

TEST_CASE("a straight tet has a Jacobian ratio of 1") {
  const std::array<Point, 4> v = {Point(0, 0, 0), Point(2, 0, 0), Point(0, 3, 0), Point(0, 1, 1)};
  std::array<Point, 6> none;
  none.fill(Point::Zero());
  CHECK(jacobian_ratio(v, none).at_nodes == doctest::Approx(1));
  CHECK(jacobian_ratio(v, none).bound == doctest::Approx(1));
}

TEST_CASE("curved tets are counted whichever way a file lists their vertices") {
  MeshData mesh = test::second_order(contract::kuhn_cube(3, 0.1, 1), 0.1);
  const CurvedStatistics one = statistics_of(mesh);
  CHECK(one.mid_nodes == mesh.mid_nodes.size());
  CHECK(one.curved > 0);
  CHECK(one.worst.at_nodes < 1);
  CHECK(one.worst.bound <= one.worst.at_nodes);
  for (MeshData::Tet& tet : mesh.tets) std::swap(tet.vertices[0], tet.vertices[1]);
  const CurvedStatistics other = statistics_of(mesh);
  CHECK(other.curved == one.curved);
  CHECK(other.worst.at_nodes == doctest::Approx(one.worst.at_nodes));
  CHECK(other.worst.bound == doctest::Approx(one.worst.bound));
  // A node pushed through the tet turns it over.
  mesh.points[mesh.mid_nodes[0][2]] += Point(1, 1, 1);
  CHECK(statistics_of(mesh).turned_over > 0);
}

TEST_CASE("a tet at curved edges is refused when it would be nearer to turning over") {
  MeshData data = test::second_order(contract::kuhn_cube(3, 0.1, 1), 0.1);
  const TetMesh mesh(data);
  const CurvedEdges edges(data, mesh, true);
  CHECK_FALSE(edges.is_empty());
  const CurvedStatistics figures = curved_statistics(data, mesh);
  CHECK(edges.statistics(mesh).curved == figures.curved);
  CHECK(edges.statistics(mesh).worst.at_nodes == doctest::Approx(figures.worst.at_nodes));
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    CHECK(edges.admit(mesh, mesh.vertices(TetHandle(slot))));
  }
  // The same edges in a mesh whose worst tet is better than some of its tets.
  TetMesh moved = mesh;
  std::size_t refused = 0;
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    TetVertices turned = mesh.vertices(TetHandle(slot));
    std::swap(turned[0], turned[1]);
    refused += !edges.admit(mesh, turned);
  }
  CHECK(refused == figures.curved);
}

TEST_CASE("nodes of the surface, of walls and of what is named are fixed") {
  MeshData data = test::second_order(contract::kuhn_cube(2, 0, 1), 0.1);
  const auto count = [](const MeshData& mesh, bool with_interior) {
    const auto fixed = find_fixed_mid_nodes(mesh, with_interior).is_fixed;
    return std::count(fixed.begin(), fixed.end(), true);
  };
  const auto surface = count(data, true);
  CHECK(surface == 72);  // 48 triangles, 3 edges each, each shared by two
  MeshData halves = data;
  for (MeshData::Tet& tet : halves.tets) {
    double x = 0;
    for (const std::uint32_t v : tet.vertices) x += data.points[v].x();
    tet.label = x > 4 * data.points[0].x() + 2 ? 1 : 2;
  }
  CHECK(count(halves, true) > surface);
  const auto fixed = find_fixed_mid_nodes(data, true).is_fixed;
  const std::size_t inside =
      static_cast<std::size_t>(std::find(fixed.begin(), fixed.end(), false) - fixed.begin());
  MeshData required = data;
  required.required_vertices = {data.mid_nodes[inside][2]};
  CHECK(count(required, true) == surface + 1);
  CHECK(find_fixed_mid_nodes(required, true).inside.size() == 1);
  CHECK(count(required, false) == surface);
  MeshData curved = data;
  curved.points[data.mid_nodes[inside][2]] += Point(0.1, 0, 0);
  CHECK(count(curved, true) == surface + 1);
}
