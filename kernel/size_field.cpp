// SPDX-License-Identifier: MIT
#include "kernel/size_field.h"

#include <algorithm>
#include <limits>

#include "kernel/tet_mesh.h"

namespace tetmend {

struct UsualLengths::Nearest {
  const Point& place;
  double square = std::numeric_limits<double>::infinity();
  const Node* node = nullptr;

  void look_at(const Node& other) {
    const double distance2 = (other.point - place).squaredNorm();
    if (node != nullptr &&
        (distance2 > square || (distance2 == square && other.number > node->number))) {
      return;
    }
    square = distance2;
    node = &other;
  }
};

UsualLengths::UsualLengths(const TetMesh& mesh) {
  const std::vector<double> lengths = local_lengths(mesh);
  for (std::uint32_t i = 0; i < lengths.size(); ++i) {
    if (lengths[i] > 0) nodes_.push_back({mesh.point(VertexHandle(i)), lengths[i], i});
  }
  axes_.resize(nodes_.size());
  arrange(0, nodes_.size());
}

void UsualLengths::arrange(std::size_t begin, std::size_t end) {
  if (end - begin < 2) return;
  Point low = nodes_[begin].point;
  Point high = low;
  for (std::size_t i = begin; i < end; ++i) {
    low = low.cwiseMin(nodes_[i].point);
    high = high.cwiseMax(nodes_[i].point);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return nodes_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [axis](const Node& p, const Node& q) {
    return p.point[axis] != q.point[axis] ? p.point[axis] < q.point[axis] : p.number < q.number;
  });
  axes_[middle] = static_cast<std::uint8_t>(axis);
  arrange(begin, middle);
  arrange(middle + 1, end);
}

void UsualLengths::search(std::size_t begin, std::size_t end, Nearest& nearest) const {
  if (begin == end) return;
  const std::size_t middle = begin + (end - begin) / 2;
  nearest.look_at(nodes_[middle]);
  const Eigen::Index axis = axes_[middle];
  const double ahead = nearest.place[axis] - nodes_[middle].point[axis];
  const bool is_low = ahead < 0;
  search(is_low ? begin : middle + 1, is_low ? middle : end, nearest);
  if (ahead * ahead <= nearest.square) {
    search(is_low ? middle + 1 : begin, is_low ? end : middle, nearest);
  }
}

double UsualLengths::length(const Point& p) const {
  Nearest nearest{p};
  search(0, nodes_.size(), nearest);
  return nearest.node->length;
}

bool UsualLengths::admits(std::span<const EdgePlaces> /*before*/,
                          std::span<const EdgePlaces> now) const {
  constexpr double kFactor = 2;
  return std::all_of(now.begin(), now.end(), [&](const EdgePlaces& edge) {
    const auto& [a, b] = edge;
    const double length = (b - a).norm();
    const double usual = this->length((a + b) / 2);
    return length * kFactor >= usual && length <= kFactor * usual;
  });
}

std::vector<double> local_lengths(const TetMesh& mesh) {
  std::vector<double> lengths(mesh.vertex_slots(), 0);
  std::vector<std::uint32_t> counts(mesh.vertex_slots(), 0);
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    if (mesh.is_deleted(TetHandle(i))) continue;
    const TetVertices& tet = mesh.vertices(TetHandle(i));
    for (const auto& [j, k] : kEdgeVertices) {
      const double length = (mesh.point(tet[j]) - mesh.point(tet[k])).norm();
      for (const VertexHandle v : {tet[j], tet[k]}) {
        lengths[v.index()] += length;
        ++counts[v.index()];
      }
    }
  }
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (counts[i] > 0) lengths[i] /= counts[i];
  }
  return lengths;
}

}  // namespace tetmend
