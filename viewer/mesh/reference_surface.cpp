// SPDX-License-Identifier: MIT
#include "viewer/mesh/reference_surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "kernel/chunks.h"
#include "kernel/error.h"
#include "kernel/from_chars.h"

namespace tetmend::viewer {

namespace {

constexpr unsigned kSide = 4;  // samples along a side of a triangle, less one

double mean_edge(const std::array<Point, 3>& p) {
  return ((p[1] - p[0]).norm() + (p[2] - p[1]).norm() + (p[0] - p[2]).norm()) / 3;
}

void take_larger(Departure& most, const Departure& other) {
  most.distance = std::max(most.distance, other.distance);
  most.share = std::max(most.share, other.share);
}

}  // namespace

bool is_surface_face(const TetMesh& mesh, HalfFace face) {
  const HalfFace twin = mesh.twin(face);
  return twin.is_outside() || mesh.label(twin.tet()) != mesh.label(face.tet());
}

Allowance Allowance::parse(std::string_view text) {
  Allowance allowance;
  if (text == "flat" || text == "fixed") return allowance;
  std::string_view number = text;
  const bool is_share = !number.empty() && number.back() == '%';
  if (is_share) number.remove_suffix(1);
  double value = 0;
  const auto [end, error] = from_chars(number.data(), number.data() + number.size(), value);
  const bool is_number = error == std::errc() && end == number.data() + number.size();
  if (!is_number || !std::isfinite(value) || value <= 0 || (is_share && value > 100)) {
    throw Error(
        fmt::format("tolerance: '{}' is neither a share of the lengths of edges such as 1%, above "
                    "0 and up to 100%, nor a length above 0 such as 0.01",
                    text));
  }
  (is_share ? allowance.share : allowance.length) = is_share ? value / 100 : value;
  return allowance;
}

ReferenceSurface::ReferenceSurface(const TetMesh& mesh, const Allowance& allowance,
                                   std::string name)
    : name_(std::move(name)), allowance_(allowance), scale_(mesh.scale()) {
  std::vector<Corners> corners;
  for_each_surface_face(mesh, [&](HalfFace face) {
    const auto v = mesh.vertices(face);
    corners.push_back({mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2])});
  });
  set_ = TriangleSet(std::move(corners));
}

std::vector<ReferenceSurface::Corners> ReferenceSurface::triangles(const Scale& scale) const {
  std::vector<Corners> triangles(set_.list().begin(), set_.list().end());
  if (scale == scale_) return triangles;
  for (Corners& corners : triangles) {
    for (Point& p : corners) p = scale.to_work(scale_.to_file(p));
  }
  return triangles;
}

/// As envelope/reference.cpp has tolerances, but for parts that face each other closely.
void ReferenceSurface::build() {
  if (!elements_.empty() || set_.list().empty()) return;
  Box all;
  for (const Corners& corners : set_.list()) all.extend(box_of(corners));
  const double most = 0.01 * all.diagonal().norm();
  for (const Corners& corners : set_.list()) {
    Element element;
    element.points = corners;
    element.tolerance = allowance_.length > 0
                            ? scale_.to_work(allowance_.length)
                            : std::min(allowance_.share * mean_edge(corners), most);
    elements_.push_back(element);
  }
  const std::vector<std::uint32_t> one(elements_.size(), 0);
  tree_ = ElementTree(elements_, one, 1);
}

Departure ReferenceSurface::of_point(const Point& p) const {
  const auto nearest = tree_.nearest(elements_, 0, p);
  Departure departure;
  departure.distance = std::sqrt(nearest.distance2);
  if (!allowance_.is_known() || departure.distance == 0) return departure;
  departure.share = departure.distance / elements_[nearest.element].tolerance;
  if (allowance_.length > 0) return departure;
  // A triangle farther away may have a larger tolerance.
  std::vector<std::uint32_t> near;
  tree_.find(elements_, 0, Box(p), near);
  for (const std::uint32_t i : near) {
    const double away = (nearest_point(elements_[i], p) - p).norm();
    departure.share = std::min(departure.share, away / elements_[i].tolerance);
  }
  return departure;
}

Departure ReferenceSurface::of_triangle(const Corners& corners) const {
  Departure most;
  if (set_.contains(corners)) return most;
  const Corners turned = {corners[0], corners[2], corners[1]};
  if (set_.contains(turned)) return most;
  for (unsigned i = 0; i <= kSide; ++i) {
    for (unsigned j = 0; i + j <= kSide; ++j) {
      take_larger(most, of_point(corners[0] + (corners[1] - corners[0]) * i / kSide +
                                 (corners[2] - corners[0]) * j / kSide));
    }
  }
  most.distance = scale_.to_file(most.distance);
  return most;
}

ReferenceSurface::Corners ReferenceSurface::corners_of(const TetMesh& mesh, HalfFace face) const {
  Corners corners;
  const auto v = mesh.vertices(face);
  for (unsigned i = 0; i < 3; ++i) {
    const Point& p = mesh.point(v[i]);
    corners[i] = mesh.scale() == scale_ ? p : scale_.to_work(mesh.scale().to_file(p));
  }
  return corners;
}

std::size_t ReferenceSurface::Hash::operator()(const Corners& corners) const {
  std::uint64_t hash = 0;
  for (const Point& p : corners) {
    for (int i = 0; i < 3; ++i) {
      constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15U;
      hash = (std::rotl(hash, 23) ^ std::bit_cast<std::uint64_t>(p[i] + 0.0)) * kOdd;
    }
  }
  return static_cast<std::size_t>(hash ^ (hash >> 32U));
}

const Departure& ReferenceSurface::keep(const Corners& corners, const Departure& departure) {
  constexpr std::size_t kMost = std::size_t{1} << 21;  // some 300 MB
  if (known_.size() >= kMost) known_.clear();
  take_larger(largest_, departure);
  return known_.insert_or_assign(corners, departure).first->second;
}

Departure ReferenceSurface::of(const TetMesh& mesh, HalfFace face) {
  build();
  if (elements_.empty()) return {};
  const Corners corners = corners_of(mesh, face);
  const auto found = known_.find(corners);
  return found != known_.end() ? found->second : keep(corners, of_triangle(corners));
}

SurfaceDeparture ReferenceSurface::measure(const TetMesh& mesh) {
  build();
  SurfaceDeparture all;
  if (elements_.empty()) return all;
  std::vector<Corners> fresh;
  const auto add = [&](const Corners& corners, const Departure& departure) {
    take_larger(all.most, departure);
    const Corners turned = {corners[0], corners[2], corners[1]};
    all.others += set_.contains(corners) || set_.contains(turned) ? 0 : 1;
  };
  for_each_surface_face(mesh, [&](HalfFace face) {
    ++all.triangles;
    const Corners corners = corners_of(mesh, face);
    const auto found = known_.find(corners);
    if (found != known_.end()) return add(corners, found->second);
    fresh.push_back(corners);
  });
  constexpr std::size_t kTriangles = 256;
  std::vector<Departure> departures(fresh.size());
  for_chunks(
      fresh.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) departures[i] = of_triangle(fresh[i]);
      },
      kTriangles);
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    add(fresh[i], departures[i]);
    keep(fresh[i], departures[i]);
  }
  return all;
}

void ReferenceSurface::forget() {
  known_.clear();
  largest_ = {};
}

}  // namespace tetmend::viewer
