// SPDX-License-Identifier: MIT
// Meshes with prism layers along walls, and others that look a little like them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "tests/support/zoo.h"

namespace tetmend::test {

/// A triangulated wall, and where its lines lead: unit vectors. Edges are about 1 long.
struct Wall {
  std::vector<Point> points;
  std::vector<Point> directions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A grid of unit squares, each cut in two.
inline Wall grid_wall(std::uint32_t width, std::uint32_t length, bool closed) {
  Wall wall;
  const std::uint32_t columns = closed ? width : width + 1;
  for (std::uint32_t y = 0; y <= length; ++y) {
    for (std::uint32_t x = 0; x < columns; ++x) {
      wall.points.emplace_back(x, y, 0);
      wall.directions.emplace_back(0, 0, 1);
    }
  }
  for (std::uint32_t y = 0; y < length; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::uint32_t next = (x + 1) % columns;
      const std::array<std::uint32_t, 4> v = {y * columns + x, y * columns + next,
                                              (y + 1) * columns + x, (y + 1) * columns + next};
      wall.triangles.push_back({v[0], v[1], v[3]});
      wall.triangles.push_back({v[0], v[3], v[2]});
    }
  }
  return wall;
}

inline Wall plane_wall(std::uint32_t side) {
  return grid_wall(side, side, false);
}

/// The inside of a pipe along y; its ends are open.
inline Wall pipe_wall(std::uint32_t around, std::uint32_t length) {
  Wall wall = grid_wall(around, length, true);
  const double radius = around / (2 * std::numbers::pi);
  for (std::size_t v = 0; v < wall.points.size(); ++v) {
    const double angle = wall.points[v].x() / radius;
    wall.directions[v] = {-std::cos(angle), 0, -std::sin(angle)};
    wall.points[v] = Point(0, wall.points[v].y(), 0) - radius * wall.directions[v];
  }
  return wall;
}

/// The outside of a ball: an octahedron, its edges halved that many times.
inline Wall ball_wall(unsigned halvings) {
  Wall wall;
  std::vector<Point>& p = wall.directions;
  p = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (std::uint32_t i = 0; i < 8; ++i) {
    wall.triangles.push_back({i & 1, 2 + (i >> 1 & 1), 4 + (i >> 2 & 1)});
  }
  for (unsigned n = 0; n < halvings; ++n) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, is_new] =
          middles.emplace(std::minmax(a, b), static_cast<std::uint32_t>(p.size()));
      if (is_new) p.push_back((p[a] + p[b]).normalized());
      return at->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : wall.triangles) {
      const std::uint32_t ab = middle(a, b);
      const std::uint32_t bc = middle(b, c);
      const std::uint32_t ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    wall.triangles = std::move(finer);
  }
  const double radius = std::ldexp(1, static_cast<int>(halvings)) * 2 / std::numbers::pi;
  for (const Point& direction : p) wall.points.push_back(radius * direction);
  return wall;
}

/// What stands on a wall.
struct Stack {
  std::vector<double> heights;  ///< of its prisms, from the wall on
  std::vector<double> core;     ///< heights above; a point in the middle of each prism cuts these
  double jitter = 0;            ///< largest displacement of the core's inner vertices
  std::uint64_t seed = 1;
};

/// Heights that grow from prism to prism.
inline std::vector<double> growing_heights(std::size_t count, double first, double growth) {
  std::vector<double> heights(count, first);
  for (std::size_t i = 1; i < count; ++i) heights[i] = growth * heights[i - 1];
  return heights;
}

struct LayeredMesh {
  MeshData data;
  std::size_t layer_tets = 0;  ///< the first tets of `data`
  std::size_t layer_points = 0;
};

/// Eight tets around a new vertex in the middle of a prism: three vertices below, three above.
inline void cut_around_middle(MeshData& data, const std::array<std::uint32_t, 6>& v) {
  constexpr std::array<std::array<std::size_t, 3>, 8> kFaces = {
      {{0, 1, 2}, {3, 4, 5}, {0, 1, 3}, {1, 3, 4}, {1, 2, 4}, {2, 4, 5}, {0, 2, 3}, {2, 3, 5}}};
  const auto middle = static_cast<std::uint32_t>(data.points.size());
  Point sum = Point::Zero();
  for (const std::uint32_t i : v) sum += data.points[i];
  data.points.emplace_back(sum / 6);
  for (const auto& [a, b, c] : kFaces) data.tets.push_back({{v[a], v[b], v[c], middle}, 0});
}

/// Builds the stack over every triangle of the wall. Each prism is cut as a new random order of the
/// vertices says: in all ways that fit to the neighbours.
inline LayeredMesh make_layered(const Wall& wall, const Stack& stack) {
  LayeredMesh mesh;
  MeshData& data = mesh.data;
  Random random(stack.seed);
  const auto count = static_cast<std::uint32_t>(wall.points.size());
  std::vector<double> heights = stack.heights;
  heights.insert(heights.end(), stack.core.begin(), stack.core.end());
  double z = 0;
  for (std::size_t level = 0; level <= heights.size(); ++level) {
    const bool moves = level > stack.heights.size() && level < heights.size();
    for (std::uint32_t v = 0; v < count; ++v) {
      data.points.push_back(wall.points[v] + z * wall.directions[v]);
      if (moves) data.points.back() += random.in_ball(stack.jitter);
    }
    if (level < heights.size()) z += heights[level];
  }
  std::vector<std::uint32_t> rank(count);
  std::iota(rank.begin(), rank.end(), 0u);
  for (std::uint32_t level = 0; level < heights.size(); ++level) {
    for (std::uint32_t i = count; i > 1; --i) std::swap(rank[i - 1], rank[random.index(i)]);
    for (auto triangle : wall.triangles) {
      std::sort(triangle.begin(), triangle.end(),
                [&](std::uint32_t a, std::uint32_t b) { return rank[a] < rank[b]; });
      std::array<std::uint32_t, 6> v{};  // three below, three above
      for (std::size_t i = 0; i < 3; ++i) {
        v[i] = level * count + triangle[i];
        v[i + 3] = v[i] + count;
      }
      if (level < stack.heights.size()) {
        for (std::size_t i = 0; i < 3; ++i) {
          data.tets.push_back({{v[i], v[i + 1], v[i + 2], v[i + 3]}, 0});
        }
      } else {
        cut_around_middle(data, v);
      }
    }
  }
  mesh.layer_tets = 3 * wall.triangles.size() * stack.heights.size();
  mesh.layer_points = count * (stack.heights.size() + 1);
  return mesh;
}

/// A box of cells between these coordinates, six tets each. Inner vertices are moved by at most
/// `jitter` in shares of the shorter cell beside them, in each direction.
inline MeshData make_lattice(const std::vector<double>& x, const std::vector<double>& y,
                             const std::vector<double>& z, double jitter = 0,
                             std::uint64_t seed = 1) {
  MeshData data;
  Random random(seed);
  const std::array<const std::vector<double>*, 3> axes = {&x, &y, &z};
  const auto number = [&](const std::array<std::size_t, 3>& at) {
    return static_cast<std::uint32_t>((at[2] * y.size() + at[1]) * x.size() + at[0]);
  };
  std::array<std::size_t, 3> at{};
  for (at[2] = 0; at[2] < z.size(); ++at[2]) {
    for (at[1] = 0; at[1] < y.size(); ++at[1]) {
      for (at[0] = 0; at[0] < x.size(); ++at[0]) {
        Point p;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::vector<double>& axis = *axes[k];
          const std::size_t i = at[k];
          const bool inner = i > 0 && i + 1 < axis.size();
          const double gap = inner ? std::min(axis[i] - axis[i - 1], axis[i + 1] - axis[i]) : 0;
          p[static_cast<Eigen::Index>(k)] = axis[i] + jitter * gap * random.real(-1, 1);
        }
        data.points.push_back(p);
      }
    }
  }
  constexpr std::array<std::array<std::size_t, 3>, 6> kOrders = {
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (at[2] = 0; at[2] + 1 < z.size(); ++at[2]) {
    for (at[1] = 0; at[1] + 1 < y.size(); ++at[1]) {
      for (at[0] = 0; at[0] + 1 < x.size(); ++at[0]) {
        for (const auto& order : kOrders) {
          std::array<std::size_t, 3> corner = at;
          MeshData::Tet tet;
          tet.vertices[0] = number(corner);
          for (std::size_t k = 0; k < 3; ++k) {
            ++corner[order[k]];
            tet.vertices[k + 1] = number(corner);
          }
          data.tets.push_back(tet);
        }
      }
    }
  }
  return data;
}

/// Coordinates of cells with these widths.
inline std::vector<double> axis_of(const std::vector<double>& widths) {
  std::vector<double> axis = {0};
  for (const double width : widths) axis.push_back(axis.back() + width);
  return axis;
}

}  // namespace tetmend::test
