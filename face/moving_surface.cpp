// SPDX-License-Identifier: MIT
#include "face/moving_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "envelope/envelope.h"
#include "envelope/kept_points.h"
#include "kernel/compensated_sum.h"
#include "kernel/from_chars.h"
#include "kernel/geometry.h"

namespace tetmend::face {

SurfaceTolerance::SurfaceTolerance(const Options& options) : feature_angle_(options.feature_angle) {
  if (!(feature_angle_ > 0 && feature_angle_ <= 180)) {
    throw OptionError(
        "feature_angle",
        fmt::format("feature_angle: {} is no angle above 0 and up to 180 degrees", feature_angle_));
  }
  std::string_view text = options.surface;
  if (text.empty() && feature_angle_ != Options().feature_angle) {
    throw OptionError("feature_angle", "feature_angle: it needs the option surface");
  }
  if (text.empty() || text == "fixed") return;
  is_fixed_ = false;
  if (text == "flat") return;
  const bool is_share = text.back() == '%';
  is_meant_ = text.back() == '!';
  if (is_share || is_meant_) text.remove_suffix(1);
  double value = 0;
  const auto [end, error] = from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  if (!is_number || !std::isfinite(value) || value <= 0 || (is_share && value > 100)) {
    throw OptionError("surface",
                      fmt::format("surface: '{}' is none of fixed, flat, a share of the lengths of "
                                  "edges such as 1%, above 0 and up to 100%, and a length above 0 "
                                  "such as 0.01",
                                  options.surface));
  }
  (is_share ? share_ : length_) = is_share ? value / 100 : value;
}

void SurfaceTolerance::check_length(double diagonal) const {
  constexpr double kMostShare = 0.05;
  if (is_meant_ || length_ <= kMostShare * diagonal) return;
  const std::string guess = length_ <= 100 ? fmt::format(": did you mean {}%?", length_) : ".";
  throw OptionError(
      "surface", fmt::format("surface: {} is {:.2g} % of the diagonal of the mesh{} Write {}! if "
                             "that length is meant",
                             length_, 100 * length_ / diagonal, guess, length_));
}

namespace {

/// Of the box around the mesh, as the file has lengths.
double diagonal_of(const TetMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    if (!mesh.is_deleted(VertexHandle(i))) box.extend(mesh.point(VertexHandle(i)));
  }
  return mesh.scale().to_file(box.diagonal().norm());
}

}  // namespace

std::unique_ptr<SurfaceGuard> SurfaceTolerance::guard(const TetMesh& mesh,
                                                      const MeshData& input) const {
  if (!input.mid_nodes.empty()) {
    throw OptionError("surface",
                      "surface: the nodes on the edges of a mesh of second order hold its surface: "
                      "it must stay fixed");
  }
  if (length_ > 0) check_length(diagonal_of(mesh));
  EnvelopeOptions options = envelope_options();
  options.length = mesh.scale().to_work(length_);
  const std::vector<char> kept = find_kept_points(input);
  options.kept = kept_vertices(mesh, kept);
  options.held = held_vertices(mesh, kept);
  return Envelope::of(mesh, options);
}

namespace {

/// Areas of the surface and volumes by label, in lengths of the mesh.
struct Content {
  double area = 0;
  double volume = 0;
};

std::map<Label, Content> contents(const TetMesh& mesh) {
  std::map<Label, std::array<CompensatedSum, 2>> sums;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t)) continue;
    auto& [area, volume] = sums[mesh.label(t)];
    const TetVertices& v = mesh.vertices(t);
    volume.add(volume6(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])) / 6);
    for (unsigned k = 0; k < 4; ++k) {
      const HalfFace f(t, k);
      const HalfFace twin = mesh.twin(f);
      if (!twin.is_outside() && mesh.label(twin.tet()) == mesh.label(t)) continue;
      const auto [a, b, c] = mesh.vertices(f);
      const Point normal = (mesh.point(b) - mesh.point(a)).cross(mesh.point(c) - mesh.point(a));
      area.add(normal.norm() / 2);
    }
  }
  std::map<Label, Content> contents;
  for (const auto& [label, sum] : sums) contents[label] = {sum[0].value(), sum[1].value()};
  return contents;
}

std::size_t count_surface(const TetMesh& mesh) {
  const auto triangles = mesh.surface_triangles();
  return static_cast<std::size_t>(
      std::count_if(triangles.begin(), triangles.end(),
                    [](const SurfaceTriangle& triangle) { return !triangle.loose; }));
}

}  // namespace

SurfaceChange SurfaceTolerance::measure_before(const TetMesh& mesh) {
  SurfaceChange change;
  const double length = mesh.scale().to_file(1.0);
  change.triangles_before = count_surface(mesh);
  for (const auto& [label, content] : contents(mesh)) {
    change.regions.push_back({.label = label,
                              .area_before = content.area * length * length,
                              .volume_before = content.volume * length * length * length});
  }
  return change;
}

void SurfaceTolerance::measure_after(const TetMesh& mesh, SurfaceChange& change) {
  const double length = mesh.scale().to_file(1.0);
  const auto now = contents(mesh);
  for (SurfaceChange::Region& region : change.regions) {
    const Content& content = now.at(region.label);
    region.area_after = content.area * length * length;
    region.volume_after = content.volume * length * length * length;
  }
  change.triangles_after = count_surface(mesh);
  change.touched = 0;
  for (std::size_t i = 0; i < mesh.surface_triangles().size(); ++i) {
    const SurfaceTriangle& triangle = mesh.surface_triangles()[i];
    if (triangle.loose) continue;
    const auto& v = triangle.vertices;
    const bool is_new = mesh.surface_origins()[i] == TetMesh::kNotFromFile;
    const bool moved =
        std::any_of(v.begin(), v.end(), [&](VertexHandle w) { return mesh.moved(w) > 0; });
    change.touched += is_new || moved ? 1 : 0;
  }
  const auto& envelope = dynamic_cast<const Envelope&>(*mesh.surface_guard());
  const auto& tolerances = envelope.reference().tolerances;
  if (tolerances.empty()) return;
  change.tolerance = length * *std::max_element(tolerances.begin(), tolerances.end());
  change.proven = length * envelope.proven_bound().distance;
  constexpr unsigned kSide = 4;  // 15 points of each triangle that has changed
  change.sampled = length * envelope.sampled_distance(kSide);
}

}  // namespace tetmend::face
