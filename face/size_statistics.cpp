// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <tbb/parallel_sort.h>

#include "face/sizes.h"
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

double tets_wanted(const TetMesh& mesh, const std::vector<double>& wanted) {
  const double regular = std::sqrt(2.0) / 12;  // volume of a regular tet of length 1
  double sum = 0;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t)) continue;
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

void count(SizeStatistics& sizes, double length) {
  ++sizes.edges;
  const auto& bounds = SizeStatistics::kBounds;
  const auto bin = std::upper_bound(bounds.begin(), bounds.end(), length) - bounds.begin();
  ++sizes.histogram[static_cast<std::size_t>(bin)];
  if (length >= 0.5 && length <= 2) ++sizes.within_two;
  sizes.shortest = std::min(sizes.shortest, length);
  sizes.longest = std::max(sizes.longest, length);
}

}  // namespace

SizeStatistics size_statistics(const TetMesh& mesh) {
  const WantedLengths& field = *mesh.size_field()->wanted();
  std::vector<double> wanted(mesh.vertex_slots(), 0);
  for_chunks(wanted.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const VertexHandle v(static_cast<std::uint32_t>(i));
      if (!mesh.is_deleted(v)) wanted[i] = field.length(mesh.point(v));
    }
  });
  std::vector<std::uint64_t> edges;
  std::vector<std::uint64_t> on_surface;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t)) continue;
    const TetVertices& v = mesh.vertices(t);
    for (const auto& [j, k] : kEdgeVertices) edges.push_back(key_of_edge(v[j], v[k]));
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      if (!mesh.is_boundary(face) && !mesh.is_constrained(face)) continue;
      const auto [a, b, c] = mesh.vertices(face);
      for (const std::uint64_t key : {key_of_edge(a, b), key_of_edge(b, c), key_of_edge(c, a)}) {
        on_surface.push_back(key);
      }
    }
  }
  sort_once(edges);
  sort_once(on_surface);
  SizeStatistics sizes;
  sizes.shortest = edges.empty() ? 0 : std::numeric_limits<double>::infinity();
  std::size_t in_range = 0;
  for (const std::uint64_t key : edges) {
    const VertexHandle a(static_cast<std::uint32_t>(key >> 32));
    const VertexHandle b(static_cast<std::uint32_t>(key));
    const double length = WantedLengths::relative_length((mesh.point(a) - mesh.point(b)).norm(),
                                                         wanted[a.index()], wanted[b.index()]);
    count(sizes, length);
    if (WantedLengths::fit(length) >= 1) {
      ++in_range;
    } else if (std::binary_search(on_surface.begin(), on_surface.end(), key)) {
      ++sizes.on_surface;
    } else if (mesh.is_fixed(a) && mesh.is_fixed(b)) {
      ++sizes.between_walls;
    }
  }
  const auto all = static_cast<double>(std::max<std::size_t>(edges.size(), 1));
  sizes.in_range = static_cast<double>(in_range) / all;
  sizes.within_two /= all;
  sizes.tets_wanted = tets_wanted(mesh, wanted);
  return sizes;
}

}  // namespace tetmend::face
