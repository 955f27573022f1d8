// SPDX-License-Identifier: MIT
// Layers of prisms are found to the last tet, and nothing else is taken for one.
#include "kernel/boundary_layers.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/formats/mesh_io.h"
#include "tests/support/layered_mesh.h"
#include "tests/support/renumbered.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

std::vector<std::uint32_t> found_in(const TetMesh& mesh) {
  std::vector<std::uint32_t> found;
  for (const TetHandle t : find_boundary_layers(mesh).tets) found.push_back(t.index());
  return found;
}

std::vector<std::uint32_t> first_numbers(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

std::vector<double> even_axis(std::size_t cells, double width) {
  return axis_of(std::vector<double>(cells, width));
}

/// Heights that begin at 0.01 and grow to 0.17, then cells of 0.5.
std::vector<double> graded_axis() {
  std::vector<double> widths = growing_heights(8, 0.01, 1.5);
  widths.resize(16, 0.5);
  return axis_of(widths);
}

}  // namespace

TEST_CASE("layers are found to the last tet, whatever the wall, the heights and the cuts") {
  const std::vector<std::pair<std::string, Wall>> walls = {
      {"plane", plane_wall(8)}, {"pipe", pipe_wall(60, 4)}, {"ball", ball_wall(3)}};
  std::uint64_t seed = 0;
  for (const auto& each : walls) {
    const auto& name = each.first;
    const auto& wall = each.second;
    CAPTURE(name);
    for (const double first : {0.22, 0.1, 0.01, 0.001}) {
      CAPTURE(first);
      for (const double growth : {1.0, 1.1, 1.3, 1.5}) {
        CAPTURE(growth);
        for (const std::size_t count : {1, 2, 3, 6, 12, 20}) {
          CAPTURE(count);
          const std::vector<double> heights = growing_heights(count, first, growth);
          if (heights.back() > 0.8) continue;
          if (std::accumulate(heights.begin(), heights.end(), 0.0) > 3) continue;  // pipe too thin
          const LayeredMesh layered = make_layered(
              wall, {.heights = heights, .core = {0.9, 0.9}, .jitter = 0.1, .seed = ++seed});
          const BoundaryLayers layers = find_boundary_layers(TetMesh(layered.data));
          CHECK(layers.columns == wall.triangles.size());
          CHECK(layers.most_prisms == count);
          const TetMesh mesh(renumbered(layered.data, seed));
          CHECK((found_in(mesh) == first_numbers(layered.layer_tets)));
        }
      }
    }
  }
}

TEST_CASE("layers on both sides of a border between labels are found") {
  const Wall wall = plane_wall(8);
  const LayeredMesh upper =
      make_layered(wall, {.heights = growing_heights(5, 0.02, 1.4), .core = {0.9, 0.9}, .seed = 1});
  const LayeredMesh lower =
      make_layered(wall, {.heights = growing_heights(4, 0.05, 1.2), .core = {0.9, 0.9}, .seed = 2});
  MeshData data = upper.data;
  const auto shared = static_cast<std::uint32_t>(wall.points.size());
  const auto shift = static_cast<std::uint32_t>(data.points.size()) - shared;
  for (std::size_t v = shared; v < lower.data.points.size(); ++v) {
    const Point& p = lower.data.points[v];
    data.points.emplace_back(p.x(), p.y(), -p.z());
  }
  std::vector<std::uint32_t> expected = first_numbers(upper.layer_tets);
  for (std::size_t t = 0; t < lower.data.tets.size(); ++t) {
    if (t < lower.layer_tets) expected.push_back(static_cast<std::uint32_t>(data.tets.size()));
    MeshData::Tet tet = lower.data.tets[t];
    tet.label = 2;
    for (std::uint32_t& v : tet.vertices) v = v < shared ? v : v + shift;
    std::swap(tet.vertices[0], tet.vertices[1]);
    data.tets.push_back(tet);
  }
  CHECK((found_in(TetMesh(data)) == expected));
}

TEST_CASE("layers end where prisms end, be it in terraces") {
  const std::size_t count = 6;
  const Wall wall = pipe_wall(24, 12);
  const Stack stack = {.heights = growing_heights(count, 0.03, 1.3), .core = {0.9}};
  // From the middle on, the upper three prisms are cut otherwise.
  const auto is_cut = [&](std::size_t level, std::size_t triangle) {
    return level >= 3 && triangle >= wall.triangles.size() / 2;
  };
  const LayeredMesh plain = make_layered(wall, stack);
  MeshData data = plain.data;
  std::vector<Point> middles;
  std::vector<std::uint32_t> expected;
  data.tets.clear();
  for (std::size_t t = 0; t < plain.data.tets.size(); ++t) {
    const std::size_t prism = t / 3;
    const bool in_layer = t < plain.layer_tets;
    if (!in_layer || !is_cut(prism / wall.triangles.size(), prism % wall.triangles.size())) {
      if (in_layer) expected.push_back(static_cast<std::uint32_t>(data.tets.size()));
      data.tets.push_back(plain.data.tets[t]);
      continue;
    }
    // Each of the three tets gets a vertex of its own in its middle.
    const auto& v = plain.data.tets[t].vertices;
    Point sum = Point::Zero();
    for (const std::uint32_t i : v) sum += data.points[i];
    const auto middle = static_cast<std::uint32_t>(data.points.size());
    data.points.emplace_back(sum / 4);
    for (std::size_t i = 0; i < 4; ++i) {
      MeshData::Tet part = {v, 0};
      part.vertices[i] = middle;
      data.tets.push_back(part);
    }
  }
  CHECK((found_in(TetMesh(data)) == expected));
}

TEST_CASE("layers at walls that meet are found, nearly to the last tet of the corner") {
  const std::size_t cells = 16;
  const TetMesh mesh(make_lattice(graded_axis(), even_axis(8, 1), graded_axis()));
  std::size_t in_layers = 0;
  std::vector<char> is_in(mesh.tet_slots(), 0);
  for (std::size_t t = 0; t < is_in.size(); ++t) {
    const std::size_t cell = t / 6;
    is_in[t] = cell % cells < 8 || cell / cells / 8 < 8;
    in_layers += is_in[t] ? 1 : 0;
  }
  const std::vector<std::uint32_t> found = found_in(mesh);
  CHECK(static_cast<double>(found.size()) > 0.98 * static_cast<double>(in_layers));
  CHECK(std::all_of(found.begin(), found.end(), [&](std::uint32_t t) { return is_in[t] != 0; }));
}

TEST_CASE("lattices, plates and needles that are stretched throughout have no layers") {
  for (const double ratio : {3., 5., 10., 50., 100.}) {
    CAPTURE(ratio);
    for (const double jitter : {0., 0.1, 0.2}) {
      CAPTURE(jitter);
      const auto count = [&](std::size_t cells, double width) {
        const std::vector<double> unit = even_axis(10, 1);
        const MeshData data = make_lattice(unit, unit, even_axis(cells, width), jitter);
        return found_in(TetMesh(data)).size();
      };
      CHECK(count(10, 1 / ratio) == 0);
      CHECK(count(10, ratio) == 0);
      for (const std::size_t cells : {1, 2, 3}) CHECK(count(cells, 1 / ratio) == 0);
    }
  }
}

TEST_CASE("slivers on walls and flattened Delaunay meshes are no layers") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    MeshData ball = delaunay_ball(300, seed);
    CHECK(found_in(TetMesh(ball)).empty());
    for (Point& p : ball.points) p.z() /= 20;
    CHECK(found_in(TetMesh(ball)).empty());

    // Some of the vertices above the floor are pressed to it: prisms here and there.
    for (const auto& [cells, share] : {std::pair<std::size_t, double>{12, 0.4}, {50, 0.3}}) {
      Random random(seed);
      MeshData pressed = make_lattice(even_axis(cells, 1), even_axis(cells, 1), even_axis(2, 1));
      for (Point& p : pressed.points) {
        if (p.z() == 1 && random.real() < share) p.z() = random.real(0.02, 0.1);
      }
      CHECK(found_in(TetMesh(pressed)).empty());
    }
  }
}

TEST_CASE("meshes without layers have none") {
  const std::string folder = std::string(TETMEND_SOURCE_DIR) + "/assets/meshes/";
  for (const std::string name :
       {"bracket.meshb", "sheet.mesh", "folded_sheet.mesh", "two_materials.mesh"}) {
    CAPTURE(name);
    CHECK(found_in(TetMesh::sorted(read_mesh(folder + name))).empty());
  }
}

TEST_CASE("a few prisms are no layer") {
  const Stack stack = {.heights = growing_heights(5, 0.02, 1.3), .core = {0.9}};
  CHECK(found_in(TetMesh(make_layered(plane_wall(1), stack).data)).empty());
  CHECK(!found_in(TetMesh(make_layered(plane_wall(2), stack).data)).empty());
  const Stack high = {.heights = growing_heights(20, 0.02, 1.2), .core = {0.9}};
  CHECK(found_in(TetMesh(make_layered(plane_wall(1), high).data)).empty());
}
