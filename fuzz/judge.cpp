// SPDX-License-Identifier: MIT
#include "fuzz/judge.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "fuzz/target.h"

namespace tetmend::fuzz {

namespace {

__extension__ using Wide = __float128;  // 113 bits: a determinant of doubles of like size is exact

using Corner = std::array<std::uint64_t, 3>;  // the bits of a point
using Triangle = std::array<Corner, 3>;
using Sides = std::vector<std::int32_t>;  // labels

constexpr double kDegrees = 180 / std::numbers::pi;

Corner corner(const MeshArrays& mesh, std::uint32_t v) {
  Corner bits;
  for (unsigned axis = 0; axis < 3; ++axis)
    bits[axis] = std::bit_cast<std::uint64_t>(mesh.points[v][axis]);
  return bits;
}

std::int32_t label(const MeshArrays& mesh, std::size_t t) {
  return mesh.tet_labels.empty() ? 0 : mesh.tet_labels[t];
}

/// Sorts, and removes two of each label as often as there are two.
void drop_pairs(Sides& sides) {
  std::ranges::sort(sides);
  Sides left;
  for (const std::int32_t side : sides) {
    if (!left.empty() && left.back() == side) {
      left.pop_back();
    } else {
      left.push_back(side);
    }
  }
  sides = std::move(left);
}

/// Faces of one tet, and those between two labels.
std::map<Triangle, Sides> walls(const MeshArrays& mesh) {
  std::map<Triangle, Sides> faces;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (unsigned away = 0; away < 4; ++away) {
      Triangle face;
      for (unsigned i = 0, at = 0; i < 4; ++i) {
        if (i != away) face[at++] = corner(mesh, mesh.tets[t][i]);
      }
      std::ranges::sort(face);
      faces[face].push_back(label(mesh, t));
    }
  }
  // Vertices may share a place, and so do faces then: what has the same label on both sides counts
  // for nothing, however many lie there.
  for (auto& entry : faces) drop_pairs(entry.second);
  std::erase_if(faces, [](const auto& entry) { return entry.second.empty(); });
  return faces;
}

Wide six_volumes(const MeshArrays& mesh, const std::array<std::uint32_t, 4>& tet) {
  std::array<std::array<Wide, 3>, 3> e;
  for (unsigned i = 0; i < 3; ++i) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      e[i][axis] = static_cast<Wide>(mesh.points[tet[i + 1]][axis]) -
                   static_cast<Wide>(mesh.points[tet[0]][axis]);
    }
  }
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
         e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

struct Figures {
  std::map<std::int32_t, Wide> volumes;  // by label, six times
  Wide size = 0;                         // sum of absolute volumes
  std::size_t not_positive = 0;
  double smallest = 180;             // degrees
  std::size_t below = 0, above = 0;  // tets that miss a goal a little more, a little less strict
};

/// The smallest and the largest of the angles between the faces of a tet.
std::pair<double, double> angles(const MeshArrays& mesh, const std::array<std::uint32_t, 4>& tet) {
  using Vector = std::array<long double, 3>;
  const auto minus = [&](std::uint32_t a, std::uint32_t b) {
    Vector d;
    for (unsigned i = 0; i < 3; ++i)
      d[i] = static_cast<long double>(mesh.points[a][i]) - mesh.points[b][i];
    return d;
  };
  const auto cross = [](const Vector& a, const Vector& b) {
    return Vector{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const auto dot = [](const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  double least = 180;
  double most = 0;
  for (unsigned i = 0; i < 4; ++i) {
    for (unsigned j = i + 1; j < 4; ++j) {
      const unsigned k = i != 0 ? 0 : j != 1 ? 1 : 2;
      const unsigned l = 6 - i - j - k;
      const Vector edge = minus(tet[j], tet[i]);
      const Vector n = cross(edge, minus(tet[k], tet[i]));
      const Vector m = cross(edge, minus(tet[l], tet[i]));
      const Vector both = cross(n, m);
      const auto angle =
          static_cast<double>(std::atan2(std::sqrt(dot(both, both)), dot(n, m))) * kDegrees;
      least = std::min(least, angle);
      most = std::max(most, angle);
    }
  }
  return {least, most};
}

Figures figures(const MeshArrays& mesh, const Goal& goal) {
  constexpr double kRounding = 1e-7;  // degrees
  Figures all;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Wide volume = six_volumes(mesh, mesh.tets[t]);
    all.volumes[label(mesh, t)] += volume;
    all.size += volume < 0 ? -volume : volume;
    const bool positive = volume > 0;
    all.not_positive += positive ? 0 : 1;
    const auto range = angles(mesh, mesh.tets[t]);
    const double least = positive ? range.first : -range.first;
    const double most = range.second;
    all.smallest = std::min(all.smallest, least);
    const auto misses = [&](double rounding) {
      return !positive || least < goal.min_angle - rounding || most > goal.max_angle + rounding;
    };
    all.below += misses(kRounding) ? 1 : 0;
    all.above += misses(-kRounding) ? 1 : 0;
  }
  return all;
}

}  // namespace

void require_same_space(const MeshArrays& before, const MeshArrays& after) {
  require(walls(before) == walls(after),
          "the surface and the faces between labels stay bit for bit");
  const Figures old = figures(before, {});
  const Figures now = figures(after, {});
  for (const auto& entry : old.volumes) {
    const auto same = now.volumes.find(entry.first);
    const Wide change = entry.second - (same == now.volumes.end() ? 0 : same->second);
    require((change < 0 ? -change : change) <= 1e-9 * old.size, "every label has its volume");
  }
  require(now.not_positive <= old.not_positive, "no more tets without positive volume");
}

void require_promises(const MeshArrays& before, const MeshArrays& after, const Goal& goal) {
  require_same_space(before, after);
  const Figures old = figures(before, goal);
  const Figures now = figures(after, goal);
  require(now.below <= old.above, "no more tets miss the goal");
  require(now.smallest >= old.smallest - 1e-7, "the smallest angle is no smaller");
}

MeshArrays small_mesh() {
  MeshArrays mesh;
  for (int v = 0; v < 27; ++v)
    mesh.points.push_back({1.0 * (v % 3), 1.0 * (v / 3 % 3), 1.0 * (v / 9)});
  // Six tets around the diagonal of each cube: a path from corner 0 to 7 by each order of the axes.
  constexpr std::array<std::array<std::uint32_t, 2>, 6> kPaths = {
      {{1, 4}, {3, 4}, {3, 12}, {9, 12}, {9, 10}, {1, 10}}};
  for (std::uint32_t cube = 0; cube < 8; ++cube) {
    const std::uint32_t low = cube % 2 + 3 * (cube / 2 % 2) + 9 * (cube / 4);
    for (std::size_t path = 0; path < 6; ++path) {
      std::array<std::uint32_t, 4> tet = {low, low + kPaths[path][0], low + kPaths[path][1],
                                          low + 13};
      if (path % 2 == 1) std::swap(tet[0], tet[1]);
      mesh.tets.push_back(tet);
      mesh.tet_labels.push_back(cube % 2 == 0 ? 1 : 2);
    }
  }
  return mesh;
}

}  // namespace tetmend::fuzz
