// SPDX-License-Identifier: MIT
#include "face/moving_surface.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "envelope/envelope.h"
#include "kernel/from_chars.h"

namespace tetmend::face {

SurfaceTolerance::SurfaceTolerance(const Options& options)
    : feature_angle_(options.feature_angle) {
  if (!(feature_angle_ > 0 && feature_angle_ <= 180)) {
    throw OptionError("feature_angle",
                      fmt::format("feature_angle: {} is no angle above 0 and up to 180 degrees",
                                  feature_angle_));
  }
  std::string_view text = options.surface;
  if (text.empty() || text == "fixed") return;
  is_fixed_ = false;
  if (text == "flat") return;
  const bool is_share = text.back() == '%';
  if (is_share) text.remove_suffix(1);
  double value = 0;
  const auto [end, error] = from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  if (!is_number || !std::isfinite(value) || value <= 0 || (is_share && value > 100)) {
    throw OptionError("surface",
                      fmt::format("surface: '{}' is none of fixed, flat, a share of the lengths of "
                                  "edges such as 1%, and a length such as 0.01",
                                  options.surface));
  }
  (is_share ? share_ : length_) = is_share ? value / 100 : value;
}

std::unique_ptr<SurfaceGuard> SurfaceTolerance::guard(const TetMesh& mesh,
                                                      const MeshData& input) const {
  if (!input.mid_nodes.empty()) {
    throw OptionError("surface",
                      "surface: the nodes on the edges of a mesh of second order hold its surface: "
                      "it must stay fixed");
  }
  EnvelopeOptions options;
  options.share = share_;
  options.length = mesh.scale().to_work(length_);
  options.angle = feature_angle_;
  std::vector<char> paired(input.points.size(), 0);
  for (const PeriodicLink& link : input.periodic) {
    for (const auto& [image, original] : link.points) paired[image] = paired[original] = 1;
  }
  for (const OtherElements& others : input.other_elements) {
    for (const std::uint32_t v : others.vertices) paired[v] = 1;
  }
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    const VertexHandle v(i);
    if (!mesh.is_deleted(v) && paired[mesh.origin(v)] != 0) options.kept.push_back(v);
  }
  return Envelope::of(mesh, options);
}

}  // namespace tetmend::face
