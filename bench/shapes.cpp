// SPDX-License-Identifier: MIT
#include "bench/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "bench/boundary.h"

namespace tetmend::bench {

namespace {

constexpr double kSteep = 70 * std::numbers::pi / 180;

struct Shape {
  double mean_ratio = 0;
  double radius_ratio = 0;
  double edge_ratio = 0;
};

/// The map that takes the edges of a regular tet at one corner to the axes.
Eigen::Matrix3d from_regular() {
  Eigen::Matrix3d edges;
  edges.col(0) = Point(1, 0, 0);
  edges.col(1) = Point(0.5, std::sqrt(3) / 2, 0);
  edges.col(2) = Point(0.5, std::sqrt(3) / 6, std::sqrt(2.0 / 3));
  return edges.inverse();
}

double edge_ratio(const std::array<Point, 4>& p) {
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0;
  for (unsigned i = 0; i < 4; ++i) {
    for (unsigned j = i + 1; j < 4; ++j) {
      const double length = (p[i] - p[j]).norm();
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
    }
  }
  return shortest > 0 ? longest / shortest : std::numeric_limits<double>::max();
}

/// The mean ratio is that of the map from the regular tet: 3 det^(2/3) / |S|^2. The circumcentre
/// solves three equations: it is as far from each corner as from the first.
Shape shape(const std::array<Point, 4>& p, double orientation) {
  static const Eigen::Matrix3d kFromRegular = from_regular();
  Shape result;
  result.edge_ratio = edge_ratio(p);
  Eigen::Matrix3d edges;
  for (unsigned i = 0; i < 3; ++i) edges.col(i) = p[i + 1] - p[0];
  const double determinant = orientation * edges.determinant();
  if (!(determinant > 0)) return result;

  const Eigen::Matrix3d map = edges * kFromRegular;
  const double stretch = std::cbrt(orientation * map.determinant());
  result.mean_ratio = 3 * stretch * stretch / map.squaredNorm();

  double area = (p[2] - p[1]).cross(p[3] - p[1]).norm() / 2;
  for (unsigned i = 0; i < 3; ++i) area += edges.col(i).cross(edges.col((i + 1) % 3)).norm() / 2;
  const double inradius = determinant / 2 / area;
  const Point squares = edges.colwise().squaredNorm().transpose() / 2;
  const double circumradius = edges.transpose().fullPivLu().solve(squares).norm();
  result.radius_ratio = 3 * inradius / circumradius;
  return result;
}

// --- faces ---------------------------------------------------------------------------------------

struct Side {
  Face key;
  std::uint32_t tet;
  std::uint32_t opposite;  // vertex
};

std::vector<Side> sorted_sides(const MeshData& mesh) {
  std::vector<Side> sides;
  sides.reserve(4 * mesh.tets.size());
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& v = mesh.tets[t].vertices;
    for (unsigned i = 0; i < 4; ++i) {
      const Face face{v[(i + 1) % 4], v[(i + 2) % 4], v[(i + 3) % 4]};
      sides.push_back({face_key(face), t, v[i]});
    }
  }
  std::ranges::sort(sides, {}, &Side::key);
  return sides;
}

Point centroid(const MeshData& mesh, std::uint32_t tet) {
  Point sum = Point::Zero();
  for (const std::uint32_t v : mesh.tets[tet].vertices) sum += mesh.points[v];
  return sum / 4;
}

/// Between the normal of a face, away from the first tet, and the line from centroid to centroid.
double non_orthogonality(const MeshData& mesh, const Side& here, const Side& there) {
  const Point& a = mesh.points[here.key[0]];
  Point normal = (mesh.points[here.key[1]] - a).cross(mesh.points[here.key[2]] - a);
  if (normal.dot(mesh.points[here.opposite] - a) > 0) normal = -normal;
  const Point line = centroid(mesh, there.tet) - centroid(mesh, here.tet);
  return std::atan2(normal.cross(line).norm(), normal.dot(line));
}

void add_faces(const MeshData& mesh, Shapes& result) {
  const std::vector<Side> sides = sorted_sides(mesh);
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t last = first + 1;
    while (last < sides.size() && sides[last].key == sides[first].key) ++last;
    if (last - first == 2) {
      ++result.inner_faces;
      const double angle = non_orthogonality(mesh, sides[first], sides[first + 1]);
      result.faces_above_70 += angle > kSteep ? 1 : 0;
    }
    first = last;
  }
}

}  // namespace

Shapes shapes(const MeshData& mesh, double orientation) {
  Shapes result;
  if (mesh.tets.empty()) return result;
  result.worst_mean_ratio = result.worst_radius_ratio = 1;
  for (const MeshData::Tet& tet : mesh.tets) {
    std::array<Point, 4> p;
    for (unsigned i = 0; i < 4; ++i) p[i] = mesh.points[tet.vertices[i]];
    const Shape own = shape(p, orientation);
    result.worst_mean_ratio = std::min(result.worst_mean_ratio, own.mean_ratio);
    result.worst_radius_ratio = std::min(result.worst_radius_ratio, own.radius_ratio);
    result.worst_edge_ratio = std::max(result.worst_edge_ratio, own.edge_ratio);
    result.mean_mean_ratio += own.mean_ratio;
    result.mean_radius_ratio += own.radius_ratio;
    result.mean_edge_ratio += own.edge_ratio;
  }
  const auto tets = static_cast<double>(mesh.tets.size());
  result.mean_mean_ratio /= tets;
  result.mean_radius_ratio /= tets;
  result.mean_edge_ratio /= tets;
  add_faces(mesh, result);
  return result;
}

}  // namespace tetmend::bench
