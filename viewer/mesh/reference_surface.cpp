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

void take_larger(Departure& most, const Departure& other) {
  most.distance = std::max(most.distance, other.distance);
  most.share = std::max(most.share, other.share);
}

template <class Visit>
void for_each_sample(const std::array<Point, 3>& corners, Visit visit) {
  for (unsigned i = 0; i <= kSide; ++i) {
    for (unsigned j = 0; i + j <= kSide; ++j) {
      visit(Point(corners[0] + (corners[1] - corners[0]) * i / kSide +
                  (corners[2] - corners[0]) * j / kSide));
    }
  }
}

std::array<Point, 3> turned(const std::array<Point, 3>& corners) {
  return {corners[0], corners[2], corners[1]};
}

bool has_triangle(const TriangleSet& set, const std::array<Point, 3>& corners) {
  return set.contains(corners) || set.contains(turned(corners));
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
  const bool is_share = number.ends_with('%');
  if (is_share || number.ends_with('!'))
    number.remove_suffix(1);  // "1!" as improve --surface has it
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
  if (has_triangle(set_, corners)) return most;
  for_each_sample(corners, [&](const Point& p) { take_larger(most, of_point(p)); });
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
  Departure most = found != known_.end() ? found->second : keep(corners, of_triangle(corners));
  if (const auto back = back_.find(corners); back != back_.end()) take_larger(most, back->second);
  return most;
}

Departure ReferenceSurface::largest_seen() const {
  Departure most = largest_;
  if (both_ways_) take_larger(most, largest_back_);
  return most;
}

/// Fills back_. Some samples of a triangle may be nearest to one face, others to another.
Departure ReferenceSurface::measure_back(const TetMesh& mesh) {
  std::vector<Corners> faces;
  for_each_surface_face(mesh, [&](HalfFace face) { faces.push_back(corners_of(mesh, face)); });
  const TriangleSet present(faces);
  std::vector<Element> elements(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) elements[i].points = faces[i];
  const std::vector<std::uint32_t> one(elements.size(), 0);
  const ElementTree tree(elements, one, 1);
  std::vector<const Element*> fresh;
  Box all;
  for (const Element& element : elements_) {
    all.extend(box_of(element.points));
    if (!has_triangle(present, element.points)) fresh.push_back(&element);
  }
  const double rounding = 1e-12 * all.diagonal().norm();
  using Landings = std::vector<std::pair<std::uint32_t, Departure>>;
  std::vector<Landings> landings(fresh.size());
  const auto land = [&](std::size_t i) {
    for_each_sample(fresh[i]->points, [&](const Point& p) {
      const auto nearest = tree.nearest(elements, 0, p);
      Departure departure{std::sqrt(nearest.distance2), 0};
      if (departure.distance < rounding) return;  // a face that it is on may be unchanged
      if (allowance_.is_known()) departure.share = departure.distance / fresh[i]->tolerance;
      departure.distance = scale_.to_file(departure.distance);
      auto& list = landings[i];
      const auto same = [&](const auto& each) { return each.first == nearest.element; };
      const auto found = std::find_if(list.begin(), list.end(), same);
      if (found != list.end()) {
        take_larger(found->second, departure);
      } else {
        list.emplace_back(nearest.element, departure);
      }
    });
  };
  constexpr std::size_t kTriangles = 256;
  for_chunks(
      fresh.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) land(i);
      },
      kTriangles);
  Departure most;
  for (const Landings& list : landings) {
    for (const auto& [element, departure] : list) {
      take_larger(most, departure);
      take_larger(back_[faces[element]], departure);
    }
  }
  return most;
}

SurfaceDeparture ReferenceSurface::measure(const TetMesh& mesh, bool both_ways) {
  build();
  both_ways_ = both_ways;
  back_.clear();
  SurfaceDeparture all;
  if (elements_.empty()) return all;
  std::vector<Corners> fresh;
  const auto add = [&](const Corners& corners, const Departure& departure) {
    take_larger(all.most, departure);
    all.others += has_triangle(set_, corners) ? 0 : 1;
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
  if (both_ways && all.triangles > 0) {
    all.back = measure_back(mesh);
    take_larger(largest_back_, *all.back);
  }
  return all;
}

void ReferenceSurface::forget() {
  known_.clear();
  largest_ = {};
  back_.clear();
  largest_back_ = {};
}

}  // namespace tetmend::viewer
