// SPDX-License-Identifier: MIT
// Small solids of all kinds, for trials of what moves the surface.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "contract/zoo.h"

namespace tetmend::test {

struct Solid {
  std::string name;
  MeshData data;
};

class RandomSolids {
 public:
  /// Points are moved by at most `jitter` cells: those of the surface along it.
  explicit RandomSolids(std::uint64_t seed, double jitter = 0) : random_(seed), jitter_(jitter) {}

  Solid next() {
    Solid solid;
    switch (random_.index(8)) {
      case 0:
        solid = box("box", {random_.real(0.5, 2), random_.real(0.5, 2), random_.real(0.5, 2)});
        break;
      case 1:
        solid = box("plate", {1, random_.real(0.5, 1), 0.01});
        break;
      case 2:
        solid = cone();
        break;
      case 3:
        solid = ball();
        break;
      case 4:
        solid = two_materials();
        break;
      case 5:
        solid = contact();
        break;
      case 6:
        solid = slit();
        break;
      default:
        solid = dented();
    }
    if (random_.index(2) == 0) turn(solid.data);
    return solid;
  }

 private:
  MeshData grid(unsigned nx, unsigned ny, unsigned nz, const Point& size) {
    // The cells of a cube, of which some are left out.
    const unsigned n = std::max({nx, ny, nz});
    MeshData data = contract::kuhn_cube(n, 0, 1);
    std::vector<MeshData::Tet> kept;
    const auto is_in = [&](const Point& p) {
      return p.x() < static_cast<double>(nx) / n && p.y() < static_cast<double>(ny) / n &&
             p.z() < static_cast<double>(nz) / n;
    };
    for (const MeshData::Tet& tet : data.tets) {
      Point middle = Point::Zero();
      for (const auto v : tet.vertices) middle += data.points[v] / 4;
      if (is_in(middle)) kept.push_back(tet);
    }
    data.tets = kept;
    drop_unused(data);
    for (Point& p : data.points) {
      const Point most(static_cast<double>(nx) / n, static_cast<double>(ny) / n,
                       static_cast<double>(nz) / n);
      for (Eigen::Index k = 0; k < 3; ++k) {
        // Sides stay, and so does the middle, where slits and other materials are.
        const bool stays =
            p[k] == 0 || std::abs(p[k] - most[k]) < 1e-9 || std::abs(p[k] - most[k] / 2) < 1e-9;
        if (!stays) p[k] += random_.real(-jitter_, jitter_) / n;
      }
      p = Point(p.x() * n / nx * size.x(), p.y() * n / ny * size.y(), p.z() * n / nz * size.z());
    }
    return data;
  }

  static void drop_unused(MeshData& data) {
    std::vector<std::uint32_t> number(data.points.size(), 0xFFFFFFFFu);
    std::vector<Point> points;
    for (MeshData::Tet& tet : data.tets) {
      for (auto& v : tet.vertices) {
        if (number[v] == 0xFFFFFFFFu) {
          number[v] = static_cast<std::uint32_t>(points.size());
          points.push_back(data.points[v]);
        }
        v = number[v];
      }
    }
    data.points = points;
  }

  unsigned cells() { return 2 + static_cast<unsigned>(random_.index(3)); }

  Solid box(const char* name, const Point& size) {
    const unsigned z = cells(), y = cells(), x = cells();  // one after another with any compiler
    return {name, grid(x, y, z, size)};
  }

  static Point into_disk(double x, double y) {  // the square [-1, 1]^2
    const double most = std::max(std::abs(x), std::abs(y));
    const double length = std::hypot(x, y);
    const double scale = length > 0 ? most / length : 1;
    return {x * scale, y * scale, 0};
  }

  Solid cone() {
    Solid solid{"cone", grid(4, 4, cells(), {2, 2, 1})};
    const double top = random_.real(0.1, 0.9);
    for (Point& p : solid.data.points) {
      Point disk = into_disk(p.x() - 1, p.y() - 1);
      disk *= 1 + (top - 1) * p.z();
      p = Point(disk.x(), disk.y(), 1.5 * p.z());
    }
    return solid;
  }

  Solid ball() {
    const unsigned n = 4 + static_cast<unsigned>(random_.index(2));
    Solid solid{"ball", grid(n, n, n, {2, 2, 2})};
    for (Point& p : solid.data.points) {
      p -= Point(1, 1, 1);
      if (p.norm() > 0) p *= p.cwiseAbs().maxCoeff() / p.norm();
    }
    return solid;
  }

  Solid two_materials() {
    Solid solid{"two materials", grid(4, 3, 3, {1, 1, 1})};
    const double tilt = random_.index(2) == 0 ? 0 : 0.3;
    for (MeshData::Tet& tet : solid.data.tets) {
      Point middle = Point::Zero();
      for (const auto v : tet.vertices) middle += solid.data.points[v] / 4;
      tet.label = middle.x() + tilt * middle.y() < 0.5 + tilt / 2 ? 1 : 2;
    }
    return solid;
  }

  /// Two boxes, a small gap or none between them.
  Solid contact() {
    Solid solid{"contact", grid(3, 3, 2, {1, 1, 0.6})};
    const MeshData second = grid(2, 3, 3, {0.7, 1, 0.8});
    const double gap = random_.index(2) == 0 ? 0 : random_.real(0.001, 0.02);
    const auto first = static_cast<std::uint32_t>(solid.data.points.size());
    for (const Point& p : second.points) solid.data.points.push_back(p + Point(1 + gap, 0.1, 0));
    for (MeshData::Tet tet : second.tets) {
      for (auto& v : tet.vertices) v += first;
      solid.data.tets.push_back(tet);
    }
    return solid;
  }

  /// A box with a cut half through it, opened a little or not at all.
  Solid slit() {
    Solid solid{"slit", grid(4, 4, 2, {1, 1, 0.5})};
    MeshData& data = solid.data;
    const double width = random_.index(2) == 0 ? 0 : random_.real(0.001, 0.02);
    std::map<std::uint32_t, std::uint32_t> other;  // of a vertex of the cut, that behind it
    const std::size_t n = data.points.size();
    for (std::uint32_t v = 0; v < n; ++v) {
      const Point p = data.points[v];
      if (p.x() != 0.5 || p.y() >= 0.5) continue;
      other[v] = static_cast<std::uint32_t>(data.points.size());
      const Point away((0.5 - p.y()) * width, 0, 0);
      data.points.push_back(p + away);
      data.points[v] = p - away;
    }
    for (MeshData::Tet& tet : data.tets) {
      Point middle = Point::Zero();
      for (const auto v : tet.vertices) middle += data.points[v] / 4;
      if (middle.x() < 0.5) continue;
      for (auto& v : tet.vertices) {
        const auto at = other.find(v);
        if (at != other.end()) v = at->second;
      }
    }
    return solid;
  }

  /// A box with a rough surface.
  Solid dented() {
    const unsigned n = cells() + 1;
    Solid solid{"dented", grid(n, n, n, {1, 1, 1})};
    const double depth = random_.real(0.005, 0.12) / n;
    for (Point& p : solid.data.points) p += random_.in_ball(depth);
    return solid;
  }

  void turn(MeshData& data) {
    const Point axis = random_.in_ball(1).normalized();
    const Eigen::AngleAxisd rotation(random_.real(0, 3), axis);
    for (Point& p : data.points) p = rotation * p;
  }

  contract::Random random_;
  double jitter_;
};

}  // namespace tetmend::test
