// SPDX-License-Identifier: MIT
// How far the surface of one mesh is from that of another, both ways, by samples. Prints JSON.
//
//   surfaces BEFORE AFTER [SIDE]    (SIDE + 1) (SIDE + 2) / 2 points of each triangle
//
// It shares the readers with tetmend and nothing else, above all nothing with envelope/.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <limits>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/boundary.h"
#include "kernel/formats/mesh_io.h"
#include "tests/support/surface_distance.h"

namespace {

using namespace tetmend;
using test::Triangle;

std::vector<Triangle> surface(const MeshData& mesh) {
  std::vector<Triangle> triangles;
  for (const bench::Face& face : bench::boundary_faces(mesh)) {
    triangles.push_back({mesh.points[face[0]], mesh.points[face[1]], mesh.points[face[2]]});
  }
  return triangles;
}

double diagonal(const std::vector<Triangle>& triangles) {
  Point low = Point::Constant(std::numeric_limits<double>::infinity());
  Point high = -low;
  for (const Triangle& t : triangles) {
    for (const Point& p : t) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  return (high - low).norm();
}

double mean_edge(const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    sum += (t[1] - t[0]).norm() + (t[2] - t[1]).norm() + (t[0] - t[2]).norm();
  }
  return sum / (3 * static_cast<double>(triangles.size()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::cerr << "usage: surfaces BEFORE AFTER [SIDE]\n";
    return 2;
  }
  const int side = argc == 4 ? std::atoi(argv[3]) : 13;
  if (side < 1) {
    std::cerr << "surfaces: SIDE must be 1 or more\n";
    return 2;
  }
  try {
    const std::vector<Triangle> before = surface(read_mesh(argv[1]));
    const std::vector<Triangle> after = surface(read_mesh(argv[2]));
    const nlohmann::ordered_json told = {
        {"diagonal", diagonal(before)},
        {"mean_edge", mean_edge(before)},
        {"triangles", {before.size(), after.size()}},
        {"after_to_before", test::sampled_distance(after, before, side)},
        {"before_to_after", test::sampled_distance(before, after, side)},
        {"area", {test::total_area(before), test::total_area(after)}},
        {"volume", {test::enclosed_volume(before), test::enclosed_volume(after)}},
    };
    std::cout << told.dump(2) << '\n';
  } catch (const std::exception& error) {
    std::cerr << "surfaces: " << error.what() << '\n';
    return 1;
  }
}
