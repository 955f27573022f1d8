// SPDX-License-Identifier: MIT
// The one routine that judges every improver: quality of a mesh, and whether its surface is still
// that of the input. Prints JSON.
//
//   measure MESH            statistics
//   measure BEFORE AFTER    statistics of both, and what became of the surface
//
// It shares the readers with tetmend and nothing else. Angles, shapes, volumes and surfaces come
// from plain arrays by formulas of its own, so that a mistake in the kernel's statistics cannot hide
// here.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <iostream>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "bench/boundary.h"
#include "bench/shapes.h"
#include "kernel/formats/mesh_io.h"

namespace {

using namespace tetmend;
using bench::Face;
using Json = nlohmann::ordered_json;

constexpr double kDegrees = 180 / std::numbers::pi;

/// Points of two surfaces count as the same within this part of the diagonal. Programs change the
/// last bits when they scale a mesh to work on it, or write 15 digits.
constexpr double kSamePoint = 1e-9;

double signed_volume(const MeshData& mesh, const MeshData::Tet& tet) {
  const Point& a = mesh.points[tet.vertices[0]];
  const Point b = mesh.points[tet.vertices[1]] - a;
  const Point c = mesh.points[tet.vertices[2]] - a;
  const Point d = mesh.points[tet.vertices[3]] - a;
  return b.cross(c).dot(d) / 6;
}

struct Angle {
  double degrees;
  double sine;
};

/// Between the two faces that meet in the edge pq and contain r and s, from their normals.
Angle dihedral_angle(const Point& p, const Point& q, const Point& r, const Point& s) {
  const Point edge = q - p;
  const Point n = edge.cross(r - p);
  const Point m = edge.cross(s - p);
  const double across = n.cross(m).norm();
  const double norms = n.norm() * m.norm();
  return {std::atan2(across, n.dot(m)) * kDegrees, norms > 0 ? across / norms : 0};
}

class Statistics {
 public:
  explicit Statistics(const MeshData& mesh) {
    std::vector<double> volumes;
    volumes.reserve(mesh.tets.size());
    for (const auto& tet : mesh.tets) volumes.push_back(signed_volume(mesh, tet));
    // Some formats list the vertices of a tet the other way round: most tets decide.
    const auto negative = std::ranges::count_if(volumes, [](double v) { return v < 0; });
    const double sign = 2 * negative > std::ssize(volumes) ? -1 : 1;
    for (std::size_t i = 0; i < mesh.tets.size(); ++i) add(mesh, mesh.tets[i], sign * volumes[i]);
    points_ = used_points(mesh);
    shapes_ = bench::shapes(mesh, sign);
  }

  Json to_json() const {
    const double percent = 100 / std::max(1.0, 6.0 * static_cast<double>(tets_));
    Json bands = Json::array();
    std::size_t extreme = 0;
    for (const std::size_t band : bands_) {
      bands.push_back(percent * static_cast<double>(band));
      extreme += band;
    }
    Json angle_percent = Json::array();
    for (const std::size_t bin : bins_) {
      angle_percent.push_back(percent * static_cast<double>(bin));
    }
    return {{"tets", tets_},
            {"points", points_},
            {"theta_min", theta_min_},
            {"theta_max", theta_max_},
            {"lambda", percent * static_cast<double>(extreme)},
            {"lambda_bands", bands},
            {"angle_percent", angle_percent},
            {"n_bad", bad_},
            {"worst_sine", worst_sine_},
            {"inverted", inverted_},
            {"flat", flat_},
            {"volume", volume_},
            {"rulers", rulers()}};
  }

 private:
  /// Named as in the report of tetmend.
  Json rulers() const {
    const auto ruler = [](double worst, double mean) -> Json {
      return {{"worst", worst}, {"mean", mean}};
    };
    return {{"mean_ratio", ruler(shapes_.worst_mean_ratio, shapes_.mean_mean_ratio)},
            {"radius_ratio", ruler(shapes_.worst_radius_ratio, shapes_.mean_radius_ratio)},
            {"edge_ratio", ruler(shapes_.worst_edge_ratio, shapes_.mean_edge_ratio)},
            {"inner_faces", shapes_.inner_faces},
            {"faces_above_70", shapes_.faces_above_70}};
  }

  void add(const MeshData& mesh, const MeshData::Tet& tet, double volume) {
    ++tets_;
    volume_ += volume;
    inverted_ += volume < 0 ? 1 : 0;
    flat_ += volume == 0 ? 1 : 0;
    std::array<Point, 4> p;
    for (unsigned i = 0; i < 4; ++i) p[i] = mesh.points[tet.vertices[i]];
    double least = std::numeric_limits<double>::infinity();
    for (unsigned i = 0; i < 4; ++i) {
      for (unsigned j = i + 1; j < 4; ++j) {
        const unsigned k = i != 0 ? 0 : j != 1 ? 1 : 2;
        const unsigned l = 6 - i - j - k;
        const Angle angle = dihedral_angle(p[i], p[j], p[k], p[l]);
        count(angle.degrees);
        least = std::min(least, angle.sine);
      }
    }
    if (volume < 0) least = -least;
    bad_ += least < 0.5 ? 1 : 0;
    worst_sine_ = std::min(worst_sine_, least);
  }

  void count(double degrees) {
    theta_min_ = std::min(theta_min_, degrees);
    theta_max_ = std::max(theta_max_, degrees);
    ++bins_[std::min<std::size_t>(59, static_cast<std::size_t>(degrees / 3))];
    const double distance = std::min(degrees, 180 - degrees);
    // Bands of 6 degrees; 30 itself belongs to the last.
    if (distance <= 30) ++bands_[std::min<std::size_t>(4, static_cast<std::size_t>(distance / 6))];
  }

  static std::size_t used_points(const MeshData& mesh) {
    std::vector<bool> used(mesh.points.size());
    for (const auto& tet : mesh.tets) {
      for (const std::uint32_t v : tet.vertices) used[v] = true;
    }
    return static_cast<std::size_t>(std::ranges::count(used, true));
  }

  std::size_t tets_ = 0;
  std::size_t points_ = 0;
  std::size_t bad_ = 0;
  std::size_t inverted_ = 0;
  std::size_t flat_ = 0;
  std::array<std::size_t, 5> bands_{};  // angles outside 30 to 150 degrees, worst first
  std::array<std::size_t, 60> bins_{};  // all angles, 3 degrees each
  double theta_min_ = 180;
  double theta_max_ = 0;
  double worst_sine_ = std::numeric_limits<double>::infinity();
  double volume_ = 0;
  bench::Shapes shapes_;
};

// --- surfaces ------------------------------------------------------------------------------------

using Corner = std::array<double, 3>;

std::vector<std::array<Corner, 3>> triangle_corners(const MeshData& mesh,
                                                    std::span<const Face> faces) {
  std::vector<std::array<Corner, 3>> triangles;
  triangles.reserve(faces.size());
  for (const Face& face : faces) {
    std::array<Corner, 3> corners;
    for (unsigned i = 0; i < 3; ++i) {
      const Point& p = mesh.points[face[i]];
      corners[i] = {p.x(), p.y(), p.z()};
    }
    std::ranges::sort(corners);
    triangles.push_back(corners);
  }
  std::ranges::sort(triangles);
  return triangles;
}

std::vector<std::uint32_t> surface_vertices(std::span<const Face> faces) {
  std::vector<std::uint32_t> vertices;
  for (const Face& face : faces) vertices.insert(vertices.end(), face.begin(), face.end());
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// The surface vertices of a mesh by place. They are sorted along a direction in which few points
/// of a plane or a lattice coincide, so a search looks at a handful.
class SurfaceSearch {
 public:
  SurfaceSearch(const MeshData& mesh, std::span<const Face> faces, double tolerance)
      : mesh_(mesh), tolerance_(tolerance), vertices_(surface_vertices(faces)) {
    std::ranges::sort(vertices_, {}, [this](std::uint32_t v) { return height(mesh_.points[v]); });
  }

  struct Match {
    std::uint32_t vertex;
    double distance;
  };

  /// The nearest vertex within the tolerance, of several in one place always the same.
  std::optional<Match> nearest(const Point& p) const {
    const auto height_of = [this](std::uint32_t v) { return height(mesh_.points[v]); };
    auto it = std::ranges::lower_bound(vertices_, height(p) - tolerance_, {}, height_of);
    std::optional<Match> best;
    for (; it != vertices_.end() && height_of(*it) <= height(p) + tolerance_; ++it) {
      const double distance = (mesh_.points[*it] - p).norm();
      if (distance <= tolerance_ && (!best || distance < best->distance)) best = {*it, distance};
    }
    return best;
  }

 private:
  static double height(const Point& p) {
    return 0.5773 * p.x() + 0.6180339 * p.y() + 0.5336179 * p.z();  // nearly a unit vector
  }

  const MeshData& mesh_;
  double tolerance_;
  std::vector<std::uint32_t> vertices_;
};

struct MatchedFaces {
  std::vector<Face> keys;  // ascending; only of faces with all corners on the surface searched
  double distance = 0;     // largest of a corner from its match
};

MatchedFaces match_faces(const MeshData& mesh, std::span<const Face> faces,
                         const SurfaceSearch& search) {
  MatchedFaces matched;
  for (const Face& face : faces) {
    Face match{};
    double distance = 0;
    unsigned corners = 0;
    for (; corners < 3; ++corners) {
      const auto vertex = search.nearest(mesh.points[face[corners]]);
      if (!vertex) break;
      match[corners] = vertex->vertex;
      distance = std::max(distance, vertex->distance);
    }
    if (corners < 3) continue;
    matched.keys.push_back(bench::face_key(match));
    matched.distance = std::max(matched.distance, distance);
  }
  std::ranges::sort(matched.keys);
  return matched;
}

double diagonal(const MeshData& mesh) {
  Eigen::AlignedBox3d box;
  for (const Point& p : mesh.points) box.extend(p);
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

/// "identical": the same triangles with the same coordinates, bit for bit; "moved": the same
/// triangles, corners moved by rounding only; else "changed". `lost` counts triangles of the input
/// that are gone.
Json compare_surfaces(const MeshData& before, const MeshData& after) {
  const std::vector<Face> old_faces = bench::boundary_faces(before);
  const std::vector<Face> new_faces = bench::boundary_faces(after);
  Json result = {{"triangles_before", old_faces.size()}, {"triangles_after", new_faces.size()}};
  if (triangle_corners(before, old_faces) == triangle_corners(after, new_faces)) {
    result.update({{"surface", "identical"}, {"lost", 0}, {"distance", 0}});
    return result;
  }

  const SurfaceSearch search(before, old_faces, kSamePoint * diagonal(before));
  // The old faces too, for their vertices may lie in one place.
  const MatchedFaces old_matched = match_faces(before, old_faces, search);
  const MatchedFaces new_matched = match_faces(after, new_faces, search);
  const auto lost = std::ranges::count_if(old_matched.keys, [&new_matched](const Face& key) {
    return !std::ranges::binary_search(new_matched.keys, key);
  });
  const bool same = lost == 0 && new_faces.size() == old_faces.size();
  result.update({{"surface", same ? "moved" : "changed"},
                 {"lost", lost},
                 {"distance", new_matched.distance}});
  return result;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2 && count != 3) {
    std::cerr << "usage: measure BEFORE [AFTER]\n";
    return 2;
  }
  try {
    const MeshData before = read_mesh(arguments[1]);
    Json result = {{"before", Statistics(before).to_json()}};
    if (count == 3) {
      const MeshData after = read_mesh(arguments[2]);
      result["after"] = Statistics(after).to_json();
      result["surface"] = compare_surfaces(before, after);
    }
    std::cout << result.dump(2) << '\n';
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "measure: " << error.what() << '\n';
    return 1;
  }
}
