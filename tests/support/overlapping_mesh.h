// SPDX-License-Identifier: MIT
// Solids that lie in each other without a point in common, as parts that were meshed one by one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "contract/zoo.h"
#include "kernel/geometry.h"
#include "kernel/mesh_data.h"

namespace tetmend::test {

/// How two solids are told apart, besides by what hangs together.
enum class ToldBy { nothing, labels, parts };

/// Cubes with slivers, the second shifted by less than its width. All points and tets have the number of
/// their solid, 1 or 2, in arrays of whole and real numbers; two groups have the tets of one each.
inline MeshData two_overlapping(ToldBy told_by, std::uint32_t n = 4) {
  MeshData data;
  std::vector<double> of_points;
  std::vector<double> of_tets;
  std::vector<std::int32_t> numbers;
  for (int solid = 1; solid <= 2; ++solid) {
    const MeshData cube = contract::kuhn_cube(n, 0.35, static_cast<unsigned>(solid));
    const auto first = static_cast<std::uint32_t>(data.points.size());
    const double shift = solid == 1 ? 0 : 0.4;
    Group group;
    group.dimension = 3;
    group.name = "solid" + std::to_string(solid);
    for (const Point& p : cube.points) {
      data.points.push_back(p + Point(shift, shift, shift));
      of_points.push_back(solid);
    }
    for (MeshData::Tet tet : cube.tets) {
      for (std::uint32_t& v : tet.vertices) v += first;
      tet.label = told_by == ToldBy::labels ? solid : 0;
      if (told_by == ToldBy::parts) data.tet_parts.push_back(10 + solid);
      group.members.push_back(static_cast<std::uint32_t>(data.tets.size()));
      data.tets.push_back(tet);
      of_tets.push_back(solid);
      numbers.push_back(solid);
    }
    data.groups.push_back(group);
  }
  data.point_data = {{"temperature", 1, of_points}};
  data.tet_data = {{"young", 1, of_tets}, {"number", 1, numbers}};
  return data;
}

/// By point: which of the solids of an improved mesh it belongs to, from 1, as they hang together.
inline std::vector<int> solids_of(const MeshData& data) {
  std::vector<std::uint32_t> next(data.points.size());
  std::iota(next.begin(), next.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (next[v] != v) v = next[v] = next[next[v]];
    return v;
  };
  for (const MeshData::Tet& tet : data.tets) {
    for (const std::uint32_t v : tet.vertices) {
      const std::uint32_t here = root(tet.vertices[0]);
      const std::uint32_t there = root(v);
      next[std::max(here, there)] = std::min(here, there);
    }
  }
  std::map<std::uint32_t, int> numbers;
  std::vector<int> solids;
  for (std::uint32_t v = 0; v < next.size(); ++v) {
    solids.push_back(
        numbers.try_emplace(root(v), static_cast<int>(numbers.size()) + 1).first->second);
  }
  return solids;
}

/// How many values of an improved mesh of two_overlapping() are of the other solid, or of none.
inline std::size_t count_strange_values(const MeshData& data) {
  const std::vector<int> solids = solids_of(data);
  std::size_t strange = 0;
  const auto& of_points = std::get<std::vector<double>>(data.point_data.at(0).values);
  const auto& of_tets = std::get<std::vector<double>>(data.tet_data.at(0).values);
  const auto& numbers = std::get<std::vector<std::int32_t>>(data.tet_data.at(1).values);
  for (std::size_t v = 0; v < solids.size(); ++v) strange += of_points[v] == solids[v] ? 0 : 1;
  std::vector<int> solid_of_tet;
  for (std::size_t t = 0; t < data.tets.size(); ++t) {
    const int solid = solids[data.tets[t].vertices[0]];
    solid_of_tet.push_back(solid);
    const bool is_near = std::abs(of_tets[t] - solid) < 1e-9;  // a mean is rounded
    strange += is_near && numbers[t] == solid ? 0 : 1;
    if (!data.tet_parts.empty()) strange += data.tet_parts[t] == 10 + solid ? 0 : 1;
  }
  std::size_t members = 0;
  for (std::size_t g = 0; g < data.groups.size(); ++g) {
    for (const std::uint32_t t : data.groups[g].members) {
      strange += solid_of_tet[t] == static_cast<int>(g) + 1 ? 0 : 1;
      ++members;
    }
  }
  if (!data.groups.empty()) strange += members == data.tets.size() ? 0 : 1;
  return strange;
}

}  // namespace tetmend::test
