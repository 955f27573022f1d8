// SPDX-License-Identifier: MIT
#include "explain/figures/painter.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "kernel/handles.h"

namespace tetmend::explain {

namespace {

constexpr double kFlat = 1e-9;  // of a normal against the direction of sight

enum class Order : unsigned char { unknown, none, first_is_nearer, second_is_nearer };

Point centre_of(const TetCorners& tet) {
  return (tet[0] + tet[1] + tet[2] + tet[3]) / 4;
}

/// By planes through the faces of the first.
Order order_by_faces(const TetCorners& tet, const TetCorners& other, const Point& forward) {
  for (unsigned f = 0; f < 4; ++f) {
    const Point& p = tet[kFaceVertices[f][0]];
    Point normal = (tet[kFaceVertices[f][1]] - p).cross(tet[kFaceVertices[f][2]] - p);
    if (!(normal.norm() > 0)) continue;
    normal.normalize();
    if (normal.dot(tet[f] - p) > 0) normal = -normal;  // outwards
    const double tolerance = 1e-9 * (tet[f] - p).norm();
    const bool is_apart = std::all_of(other.begin(), other.end(), [&](const Point& v) {
      return normal.dot(v - p) >= -tolerance;
    });
    if (!is_apart) continue;
    const double away = normal.dot(forward);
    if (std::abs(away) < kFlat) return Order::none;  // side by side
    return away > 0 ? Order::first_is_nearer : Order::second_is_nearer;
  }
  return Order::unknown;
}

Order order_of(const TetCorners& first, const TetCorners& second, const Point& forward) {
  const Order order = order_by_faces(first, second, forward);
  if (order != Order::unknown) return order;
  switch (order_by_faces(second, first, forward)) {
    case Order::first_is_nearer:
      return Order::second_is_nearer;
    case Order::second_is_nearer:
      return Order::first_is_nearer;
    case Order::none:
      return Order::none;
    case Order::unknown:
      break;
  }
  return forward.dot(centre_of(first) - centre_of(second)) < 0 ? Order::first_is_nearer
                                                               : Order::second_is_nearer;
}

}  // namespace

std::vector<std::size_t> paint_order(std::span<const TetCorners> tets, const Point& forward) {
  const std::size_t n = tets.size();
  std::vector<std::vector<std::size_t>> covers(n);  // those that are painted after it
  std::vector<std::size_t> waits_for(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const Order order = order_of(tets[i], tets[j], forward);
      if (order == Order::none) continue;
      const bool i_is_nearer = order == Order::first_is_nearer;
      covers[i_is_nearer ? j : i].push_back(i_is_nearer ? i : j);
      ++waits_for[i_is_nearer ? i : j];
    }
  }
  std::vector<std::size_t> left(n);
  for (std::size_t i = 0; i < n; ++i) left[i] = i;
  // The farthest of those that wait for the fewest: for none, unless they go round in a circle.
  const auto is_next = [&](std::size_t i, std::size_t j) {
    if (waits_for[i] != waits_for[j]) return waits_for[i] < waits_for[j];
    return forward.dot(centre_of(tets[i]) - centre_of(tets[j])) > 0;
  };
  std::vector<std::size_t> order;
  while (!left.empty()) {
    const auto next = std::min_element(left.begin(), left.end(), is_next);
    order.push_back(*next);
    for (const std::size_t i : covers[*next]) --waits_for[i];
    left.erase(next);
  }
  return order;
}

}  // namespace tetmend::explain
