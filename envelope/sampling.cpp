// SPDX-License-Identifier: MIT
// What samples say of the distance: no proof, but a number that people can compare.
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "envelope/envelope.h"
#include "kernel/chunks.h"

namespace tetmend {

namespace {

using Corners = TriangleSet::Corners;

double farthest(std::span<const Corners> from, std::span<const Corners> to, unsigned side) {
  std::vector<Element> elements;
  elements.reserve(to.size());
  for (const Corners& points : to) {
    Element element;
    element.points = points;
    elements.push_back(element);
  }
  const std::vector<std::uint32_t> one(elements.size(), 0);
  const ElementTree tree(elements, one, 1);
  constexpr std::size_t kTriangles = 256;
  const auto parts = map_chunks<double>(
      from.size(),
      [&](std::size_t begin, std::size_t end) {
        double most = 0;
        for (const Corners& t : from.subspan(begin, end - begin)) {
          for (unsigned i = 0; i <= side; ++i) {
            for (unsigned j = 0; i + j <= side; ++j) {
              const Point p = t[0] + (t[1] - t[0]) * i / side + (t[2] - t[0]) * j / side;
              most = std::max(most, tree.nearest(elements, 0, p).distance2);
            }
          }
        }
        return most;
      },
      kTriangles);
  double most = 0;
  for (const double distance2 : parts) most = std::max(most, distance2);
  return std::sqrt(most);
}

}  // namespace

double Envelope::sampled_distance(unsigned side) const {
  std::vector<Corners> now;
  for (std::uint32_t i = 0; i < present_.slots(); ++i) {
    const VertexHandle v(i);
    if (present_.find(v) == nullptr) continue;
    for (const auto& corner : present_.find(v)->corners) {
      if (corner.next < v || corner.previous < v) continue;
      now.push_back(
          {present_.point(v), present_.point(corner.next), present_.point(corner.previous)});
    }
  }
  const TriangleSet& was = reference_->triangles;
  const TriangleSet is(std::move(now));
  std::vector<Corners> came;
  std::vector<Corners> gone;
  for (const Corners& t : is.list()) {
    if (!was.contains(t)) came.push_back(t);
  }
  for (const Corners& t : was.list()) {
    if (!is.contains(t)) gone.push_back(t);
  }
  return std::max(farthest(came, was.list(), side), farthest(gone, is.list(), side));
}

}  // namespace tetmend
