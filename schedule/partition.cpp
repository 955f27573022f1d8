// SPDX-License-Identifier: MIT
// The borders of the blocks are quantiles of the keys of a sample of the vertices.
#include "schedule/partition.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "kernel/chunks.h"

namespace tetmend {

namespace {

/// A cube around the mesh, shifted by other fractions of its size in each direction, so that the
/// faces between the cells of the curve, large and small, lie elsewhere.
std::array<Point, 2> shifted_box(const TetMesh& mesh, unsigned shift) {
  const auto boxes =
      map_chunks<Eigen::AlignedBox3d>(mesh.vertex_slots(), [&](std::size_t begin, std::size_t end) {
        Eigen::AlignedBox3d box;
        for (std::size_t i = begin; i < end; ++i) {
          const VertexHandle v(static_cast<std::uint32_t>(i));
          if (!mesh.is_deleted(v)) box.extend(mesh.point(v));
        }
        return box;
      });
  Eigen::AlignedBox3d box;
  for (const Eigen::AlignedBox3d& part : boxes) box.extend(part);
  const double side = box.sizes().maxCoeff();
  // Multiples of irrational numbers never fall on the same fraction of a cell again.
  const auto fraction = [shift](double step) { return shift * step - std::floor(shift * step); };
  const Point offset(fraction(0.754877666), fraction(0.569840291), fraction(0.318309886));
  const Point origin = box.min() - side * offset;
  return {origin, origin + Point::Constant(2 * side)};
}

}  // namespace

Partition::Partition(const TetMesh& mesh, std::size_t blocks, unsigned shift)
    : curve_(shifted_box(mesh, shift)), starts_(blocks, 0), block_(mesh.vertex_slots(), 0) {
  if (blocks == 1) return;
  constexpr std::size_t kSamplesPerBlock = 256;
  const std::size_t stride = std::max<std::size_t>(1, block_.size() / (blocks * kSamplesPerBlock));
  std::vector<std::uint64_t> sample;
  sample.reserve(block_.size() / stride + 1);
  for (std::size_t i = 0; i < block_.size(); i += stride) {
    const VertexHandle v(static_cast<std::uint32_t>(i));
    if (!mesh.is_deleted(v)) sample.push_back(curve_.key(mesh.point(v)));
  }
  std::sort(sample.begin(), sample.end());
  for (std::size_t b = 1; b < blocks && !sample.empty(); ++b) {
    starts_[b] = sample[b * sample.size() / blocks];
  }
  for_chunks(block_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const VertexHandle v(static_cast<std::uint32_t>(i));
      if (!mesh.is_deleted(v)) block_[i] = find_block(mesh.point(v));
    }
  });
}

void Partition::include(const TetMesh& mesh, std::span<const VertexHandle> added) {
  block_.resize(mesh.vertex_slots(), 0);
  for_chunks(added.size(), [&](std::size_t begin, std::size_t end) {
    for (const VertexHandle v : added.subspan(begin, end - begin)) {
      if (!mesh.is_deleted(v)) block_[v.index()] = find_block(mesh.point(v));
    }
  });
}

BlockId Partition::find_block(const Point& p) const {
  const auto after = std::upper_bound(starts_.begin() + 1, starts_.end(), curve_.key(p));
  return static_cast<BlockId>(after - starts_.begin() - 1);
}

}  // namespace tetmend
