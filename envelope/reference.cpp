// SPDX-License-Identifier: MIT
#include "envelope/reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "envelope/envelope.h"
#include "kernel/compensated_sum.h"

namespace tetmend {

namespace {

/// The shortest way from triangle a to triangle b, of those that end in a corner of one or lead
/// between two sides: of disjoint triangles one of these is the shortest.
Point shortest_way(const Element& a, const Element& b) {
  Point best = Point::Constant(std::numeric_limits<double>::max());
  const auto offer = [&](const Point& way) {
    if (way.squaredNorm() < best.squaredNorm()) best = way;
  };
  best = nearest_point(b, a.points[0]) - a.points[0];
  for (unsigned i = 0; i < 3; ++i) {
    offer(nearest_point(b, a.points[i]) - a.points[i]);
    offer(b.points[i] - nearest_point(a, b.points[i]));
    for (unsigned k = 0; k < 3; ++k) {
      // The nearest points of two segments: project to and fro, a few times.
      const Point& p = a.points[i];
      const Point& q = a.points[(i + 1) % 3];
      const Point& r = b.points[k];
      const Point& s = b.points[(k + 1) % 3];
      const Point u = q - p;
      const Point v = s - r;
      const double uu = u.squaredNorm();
      const double vv = v.squaredNorm();
      const double uv = u.dot(v);
      const double det = uu * vv - uv * uv;
      double t = 0.5;
      if (det > 1e-12 * uu * vv) {
        t = std::clamp((uv * v.dot(p - r) - vv * u.dot(p - r)) / det, 0.0, 1.0);
      }
      const Point on_second = nearest_on_segment(r, s, p + t * u);
      const Point on_first = nearest_on_segment(p, q, on_second);
      offer(nearest_on_segment(r, s, on_first) - on_first);
    }
  }
  return best;
}

/// The way from a to b leads outward from a and inward to b. Not so through the mesh, or along the
/// surface round a sharp ridge.
bool face_each_other(const Element& a, const Element& b, const Point& way, double touching) {
  constexpr double kSlack = 0.1;
  const double gap = way.norm();
  if (a.normal.dot(b.normal) > -0.02) return false;
  return gap <= touching ||
         (way.dot(a.normal) >= -kSlack * gap && way.dot(b.normal) <= kSlack * gap);
}

std::vector<double> patch_areas(std::span<const TriangleSet::Corners> corners,
                                const SurfaceFeatures& features) {
  std::vector<CompensatedSum> sums(features.patches.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    sums[features.faces[i].patch].add(triangle_area(corners[i]));
  }
  std::vector<double> areas;
  for (const CompensatedSum& sum : sums) areas.push_back(sum.value());
  return areas;
}

}  // namespace

Reference::Reference(std::span<const Point> points, double flat, const SurfaceFeatures& features,
                     const EnvelopeOptions& options)
    : patches(features.patches),
      lines(features.lines),
      share(options.share),
      length(options.length),
      flatness(flat) {
  std::vector<TriangleSet::Corners> corners;
  corners.reserve(features.faces.size());
  for (const auto& face : features.faces) {
    const auto& v = face.vertices;
    corners.push_back({points[v[0].index()], points[v[1].index()], points[v[2].index()]});
  }
  areas = patch_areas(corners, features);
  triangles = TriangleSet(std::move(corners));
  if (options.is_flat()) return;
  add_faces(points, features, options);
  hold_close_parts(features);
  add_segments(points, features);
  tolerances.assign(patches.size() + lines.size(), 0);
  std::vector<std::uint32_t> sheet_of;
  for (Element& element : elements) {
    // The normal of a needle means nothing where its height is within the tolerance.
    const auto& [p, q, r] = element.points;
    const double longest = std::max({(q - p).norm(), (r - q).norm(), (p - r).norm()});
    const double thin = element.corners == 2 ? 0 : std::min(element.tolerance, 0.02 * longest);
    element.normal = normal_of(element.points, element.corners, thin);
    sheet_of.push_back(element.sheet);
    tolerances[element.sheet] = std::max(tolerances[element.sheet], element.tolerance);
  }
  tree = ElementTree(elements, sheet_of, tolerances.size());
}

void Reference::add_faces(std::span<const Point> points, const SurfaceFeatures& features,
                          const EnvelopeOptions& options) {
  faces = features.faces.size();
  const double most = 0.01 * flatness / 1e-13;  // 1 % of the diagonal
  for (const auto& face : features.faces) {
    const auto& v = face.vertices;
    Element element;
    element.points = {points[v[0].index()], points[v[1].index()], points[v[2].index()]};
    element.sheet = face.patch;
    const double asked = options.length > 0
                             ? options.length
                             : std::min(options.share * mean_edge(element.points), most);
    // Cuts round; and what is compared with the tolerance is rounded.
    element.tolerance = std::max(0.0, asked * (1 - 1e-9) - flatness / 10);
    element.normal = normal_of(element.points, 3, 0);
    elements.push_back(element);
  }
}

void Reference::add_segments(std::span<const Point> points, const SurfaceFeatures& features) {
  std::map<std::pair<VertexHandle, VertexHandle>, double> at_edge;
  for (const auto& edge : features.edges) {
    at_edge[std::minmax(edge.vertices[0], edge.vertices[1])] =
        std::numeric_limits<double>::infinity();
  }
  for (std::uint32_t i = 0; i < faces; ++i) {
    const auto& v = features.faces[i].vertices;
    for (unsigned k = 0; k < 3; ++k) {
      const auto at = at_edge.find(std::minmax(v[k], v[(k + 1) % 3]));
      if (at != at_edge.end()) at->second = std::min(at->second, elements[i].tolerance);
    }
  }
  for (const auto& edge : features.edges) {
    const auto& v = edge.vertices;
    Element element;
    element.points = {points[v[0].index()], points[v[1].index()], points[v[1].index()]};
    element.corners = 2;
    element.sheet = sheet_of_line(edge.line);
    element.tolerance = at_edge.at(std::minmax(v[0], v[1]));
    elements.push_back(element);
  }
}

/// Positive tets do not keep two parts of the boundary from passing through each other across a gap
/// outside the mesh. So each of them gets less than half of the gap.
void Reference::hold_close_parts(const SurfaceFeatures& features) {
  const std::vector<std::uint32_t> one(faces, 0);
  const ElementTree all(elements, one, 1);
  std::vector<double> least(faces, std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < faces; ++i) {
    const Element& a = elements[i];
    if (patches[a.sheet].interior) continue;
    near.clear();
    all.find(elements, 0, box_around(a), near);
    for (const std::uint32_t j : near) {
      const Element& b = elements[j];
      const auto& v = features.faces[i].vertices;
      const auto& w = features.faces[j].vertices;
      if (j <= i || patches[b.sheet].interior) continue;
      if (std::find_first_of(v.begin(), v.end(), w.begin(), w.end()) != v.end()) continue;
      const Point way = shortest_way(a, b);
      const double gap = way.norm();
      if (gap <= a.tolerance + b.tolerance && face_each_other(a, b, way, flatness)) {
        least[i] = std::min(least[i], gap);
        least[j] = std::min(least[j], gap);
      }
    }
  }
  for (std::uint32_t i = 0; i < faces; ++i) {
    double& tolerance = elements[i].tolerance;
    tolerance = std::min(tolerance, std::max(0.49 * least[i], flatness));
  }
}

}  // namespace tetmend
