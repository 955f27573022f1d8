// SPDX-License-Identifier: MIT
#include "face/size_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <tbb/parallel_sort.h>

#include "kernel/chunks.h"

namespace tetmend::face {

namespace {

std::uint64_t key_of_edge(VertexHandle a, VertexHandle b) {
  if (b < a) std::swap(a, b);
  return std::uint64_t{a.index()} << 32 | b.index();
}

/// Ascending, each once.
void sort_once(std::vector<std::uint64_t>& keys) {
  tbb::parallel_sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

double tets_wanted(const TetMesh& mesh, const std::vector<double>& wanted, const SizeScope& scope) {
  const double regular = std::sqrt(2.0) / 12;  // volume of a regular tet of length 1
  double sum = 0;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t) || (scope.has_tet && !scope.has_tet(t))) continue;
    const TetVertices& v = mesh.vertices(t);
    const Point& p = mesh.point(v[0]);
    const double volume =
        std::abs((mesh.point(v[1]) - p).dot((mesh.point(v[2]) - p).cross(mesh.point(v[3]) - p))) /
        6;
    double density = 0;
    for (const VertexHandle w : v) density += std::pow(wanted[w.index()], -3) / 4;
    sum += volume * density;
  }
  return sum / regular;
}

void count(SizeCounts& sizes, double length) {
  ++sizes.edges;
  const auto& bounds = SizeStatistics::kBounds;
  const auto bin = std::upper_bound(bounds.begin(), bounds.end(), length) - bounds.begin();
  ++sizes.histogram[static_cast<std::size_t>(bin)];
  if (WantedLengths::fit(length) >= 1) ++sizes.in_range;
  if (length >= 0.5 && length <= 2) ++sizes.within_two;
  sizes.shortest = std::min(sizes.shortest, length);
  sizes.longest = std::max(sizes.longest, length);
}

std::vector<double> lengths_at_vertices(const TetMesh& mesh, const WantedLengths& wanted) {
  std::vector<double> lengths(mesh.vertex_slots(), 0);
  for_chunks(lengths.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const VertexHandle v(static_cast<std::uint32_t>(i));
      if (!mesh.is_deleted(v)) lengths[i] = wanted.length(mesh.point(v));
    }
  });
  return lengths;
}

/// Keys of edges, each once.
struct EdgeKeys {
  std::vector<std::uint64_t> all;
  std::vector<std::uint64_t> on_surface;  ///< or on another wall

  EdgeKeys(const TetMesh& mesh, const SizeScope& scope) {
    const auto add = [&](VertexHandle a, VertexHandle b, std::vector<std::uint64_t>& keys) {
      if (!scope.has_edge || scope.has_edge(a, b)) keys.push_back(key_of_edge(a, b));
    };
    for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
      const TetHandle t(i);
      if (mesh.is_deleted(t)) continue;
      const TetVertices& v = mesh.vertices(t);
      for (const auto& [j, k] : kEdgeVertices) add(v[j], v[k], all);
      for (unsigned f = 0; f < 4; ++f) {
        const HalfFace face(t, f);
        if (!mesh.is_boundary(face) && !mesh.is_constrained(face)) continue;
        const auto [a, b, c] = mesh.vertices(face);
        add(a, b, on_surface);
        add(b, c, on_surface);
        add(c, a, on_surface);
      }
    }
    sort_once(all);
    sort_once(on_surface);
  }
};

}  // namespace

void SizeCounts::add(const SizeCounts& other) {
  edges += other.edges;
  for (std::size_t i = 0; i < histogram.size(); ++i) histogram[i] += other.histogram[i];
  in_range += other.in_range;
  within_two += other.within_two;
  shortest = std::min(shortest, other.shortest);
  longest = std::max(longest, other.longest);
  on_surface += other.on_surface;
  between_walls += other.between_walls;
  tets_wanted += other.tets_wanted;
}

SizeStatistics SizeCounts::statistics() const {
  const auto all = static_cast<double>(std::max<std::uint64_t>(edges, 1));
  SizeStatistics sizes{.edges = edges,
                       .in_range = static_cast<double>(in_range) / all,
                       .within_two = static_cast<double>(within_two) / all,
                       .shortest = edges == 0 ? 0 : shortest,
                       .longest = longest,
                       .on_surface = on_surface,
                       .between_walls = between_walls,
                       .tets_wanted = tets_wanted};
  std::copy(histogram.begin(), histogram.end(), sizes.histogram.begin());
  return sizes;
}

SizeCounts count_sizes(const TetMesh& mesh, const WantedLengths& wanted, const SizeScope& scope) {
  const std::vector<double> lengths = lengths_at_vertices(mesh, wanted);
  const EdgeKeys keys(mesh, scope);
  const auto is_wall = [&](VertexHandle v) {
    return mesh.is_fixed(v) && (!scope.has_vertex || scope.has_vertex(v));
  };
  SizeCounts sizes;
  for (const std::uint64_t key : keys.all) {
    const VertexHandle a(static_cast<std::uint32_t>(key >> 32));
    const VertexHandle b(static_cast<std::uint32_t>(key));
    const double length = WantedLengths::relative_length((mesh.point(a) - mesh.point(b)).norm(),
                                                         lengths[a.index()], lengths[b.index()]);
    count(sizes, length);
    if (WantedLengths::fit(length) >= 1) continue;
    if (std::binary_search(keys.on_surface.begin(), keys.on_surface.end(), key)) {
      ++sizes.on_surface;
    } else if (is_wall(a) && is_wall(b)) {
      ++sizes.between_walls;
    }
  }
  sizes.tets_wanted = tets_wanted(mesh, lengths, scope);
  return sizes;
}

SizeStatistics size_statistics(const TetMesh& mesh) {
  return count_sizes(mesh, *mesh.size_field()->wanted()).statistics();
}

std::vector<std::string> remarks_on(const SizeStatistics& before, const Options& options) {
  constexpr double kMost = 1e9;  // what handles can name
  const double tets = before.tets_wanted;
  if (tets > kMost && options.tets.empty()) {  // a slip of a digit: more than any memory holds
    throw OptionError("size", fmt::format("size: so short edges make about {:.2g} tets, and a mesh "
                                          "has at most {:.0g}",
                                          tets, kMost));
  }
  if (tets >= 1) return {};
  return {
      "one tet of the wanted size is larger than the whole mesh: is --size a length of this file?"};
}

}  // namespace tetmend::face
