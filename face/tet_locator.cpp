// SPDX-License-Identifier: MIT
// Which of many tets holds a place: a tree of boxes.
#include "face/tet_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/LU>

namespace tetmend::face {

namespace {

constexpr std::uint32_t kTetsOfLeaf = 8;

double smallest(const std::array<double, 4>& weights) {
  return *std::min_element(weights.begin(), weights.end());
}

}  // namespace

struct TetLocator::Best {
  TetPlace place;
  double smallest_weight = -std::numeric_limits<double>::infinity();  // 0: none is below
  double distance2 = std::numeric_limits<double>::infinity();  // of the box, where none holds it

  bool is_inside() const { return smallest_weight >= 0; }
  /// Of several that hold the place the first, so that only the tets there decide.
  bool is_better(std::uint32_t tet, double weight, double to_tet) const {
    if (to_tet != distance2) return to_tet < distance2;
    if (weight != smallest_weight) return weight > smallest_weight;
    return tet < place.tet;
  }
};

TetLocator::TetLocator(const MeshData& data, std::vector<std::uint32_t> tets)
    : data_(data), tets_(std::move(tets)) {
  std::vector<Box> boxes(data.tets.size());
  for (const std::uint32_t t : tets_) boxes[t] = box_of(t);
  nodes_.reserve(tets_.size() / 2 + 1);
  if (!tets_.empty()) build(0, static_cast<std::uint32_t>(tets_.size()), boxes);
}

TetLocator::Box TetLocator::box_of(std::uint32_t tet) const {
  Box box;
  for (const std::uint32_t v : data_.tets[tet].vertices) box.extend(data_.points[v]);
  return box;
}

std::uint32_t TetLocator::build(std::uint32_t begin, std::uint32_t end,
                                std::span<const Box> boxes) {
  const auto number = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Box box;
  Box centres;
  for (std::uint32_t i = begin; i < end; ++i) {
    box.extend(boxes[tets_[i]]);
    centres.extend(boxes[tets_[i]].center());
  }
  std::uint32_t right = 0;
  if (end - begin > kTetsOfLeaf) {
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    const std::uint32_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::uint32_t i) { return tets_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(boxes[a].center()[axis], a) < std::pair(boxes[b].center()[axis], b);
    });
    build(begin, middle, boxes);
    right = build(middle, end, boxes);
  }
  nodes_[number] = {box, begin, end, right};
  return number;
}

TetPlace TetLocator::find(const Point& place) const {
  Best best;
  search(0, place, best);
  return best.place;
}

/// Looks into a box if it holds the place, or if no tet does so far and it is no farther than the best.
void TetLocator::search(std::uint32_t node, const Point& place, Best& best) const {
  const Node& here = nodes_[node];
  const double distance2 = here.box.squaredExteriorDistance(place);
  if (distance2 > best.distance2) return;
  if (here.right != 0) {
    std::uint32_t near = node + 1;
    std::uint32_t far = here.right;
    if (nodes_[far].box.squaredExteriorDistance(place) <
        nodes_[near].box.squaredExteriorDistance(place)) {
      std::swap(near, far);
    }
    search(near, place, best);
    search(far, place, best);
    return;
  }
  for (std::uint32_t i = here.begin; i < here.end; ++i) {
    const double to_tet = box_of(tets_[i]).squaredExteriorDistance(place);
    if (to_tet > best.distance2 || (best.is_inside() && tets_[i] > best.place.tet)) continue;
    const std::array<double, 4> weights = weights_in(data_, tets_[i], place);
    const double weight = std::min(smallest(weights), 0.0);
    if (best.is_better(tets_[i], weight, to_tet)) best = {{tets_[i], weights}, weight, to_tet};
  }
}

std::vector<std::uint32_t> TetLocator::near(const std::array<Point, 4>& tet) const {
  Box box;
  for (const Point& p : tet) box.extend(p);
  std::vector<std::uint32_t> found;
  if (!nodes_.empty()) search(0, box, found);
  std::sort(found.begin(), found.end());
  return found;
}

void TetLocator::search(std::uint32_t node, const Box& box,
                        std::vector<std::uint32_t>& found) const {
  const Node& here = nodes_[node];
  if (!here.box.intersects(box)) return;
  if (here.right != 0) {
    search(node + 1, box, found);
    search(here.right, box, found);
    return;
  }
  for (std::uint32_t i = here.begin; i < here.end; ++i) {
    if (box_of(tets_[i]).intersects(box)) found.push_back(tets_[i]);
  }
}

std::array<double, 4> weights_in(const MeshData& data, std::uint32_t tet, const Point& place) {
  const auto& v = data.tets[tet].vertices;
  std::array<double, 4> weights{};
  Eigen::Matrix3d edges;
  for (Eigen::Index k = 0; k < 3; ++k) {
    edges.col(k) = data.points[v[static_cast<std::size_t>(k) + 1]] - data.points[v[0]];
  }
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(edges);
  if (!solver.isInvertible()) {
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < 4; ++k) {
      const auto distance = [&](std::size_t i) {
        return (data.points[v[i]] - place).squaredNorm();
      };
      if (distance(k) < distance(nearest)) nearest = k;
    }
    weights[nearest] = 1;
    return weights;
  }
  const Point offset = place - data.points[v[0]];
  Point w = solver.solve(offset);
  w += solver.solve(offset - edges * w);  // a flat tet loses digits, which this gives back
  for (std::size_t k = 0; k < 3; ++k) weights[k + 1] = w[static_cast<Eigen::Index>(k)];
  weights[0] = 1 - w.sum();
  return weights;
}

}  // namespace tetmend::face
