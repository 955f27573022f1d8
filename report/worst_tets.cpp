// SPDX-License-Identifier: MIT
#include "report/worst_tets.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "explain/page_text.h"
#include "kernel/handles.h"
#include "kernel/quality.h"
#include "report/svg.h"

namespace tetmend::report {

namespace {

using explain::escaped;
using Corners = std::array<Eigen::Vector3d, 4>;
using Projection = std::array<Eigen::Vector2d, 4>;

constexpr double kTetWidth = 180;
constexpr double kTetHeight = 140;

/// Places on the drawing. It lies in the two directions in which the corners spread most, turned a
/// little, so that a flat tet is not seen as a flat quadrilateral.
Projection project(const Corners& corners) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : corners) centre += p / 4;
  double size = 0;
  for (const Eigen::Vector3d& p : corners) size = std::max(size, (p - centre).norm());
  if (!(size > 0)) size = 1;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : corners) {
    const Eigen::Vector3d q = (p - centre) / size;
    spread += q * q.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  constexpr double kTilt = 0.42;
  const Eigen::Vector3d right = axes.eigenvectors().col(2);
  const Eigen::Vector3d up =
      std::cos(kTilt) * axes.eigenvectors().col(1) + std::sin(kTilt) * axes.eigenvectors().col(0);
  Projection places;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d q = (corners[i] - centre) / size;
    places[i] = {q.dot(right), -q.dot(up)};
  }
  return places;
}

/// The same within the drawing.
Projection fitted(Projection places) {
  Eigen::Vector2d low = places[0];
  Eigen::Vector2d high = places[0];
  for (const Eigen::Vector2d& p : places) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  constexpr double kMargin = 22;
  const Eigen::Vector2d extent = (high - low).cwiseMax(1e-9);
  const double scale =
      std::min((kTetWidth - 2 * kMargin) / extent.x(), (kTetHeight - 2 * kMargin) / extent.y());
  const Eigen::Vector2d middle(kTetWidth / 2, kTetHeight / 2);
  for (Eigen::Vector2d& p : places) p = middle + scale * (p - (low + high) / 2);
  return places;
}

std::string draw_faces(const Projection& p) {
  std::string text;
  for (const auto& [i, j, k] : kFaceVertices) {
    text += fmt::format(R"(<polygon class="face" points="{},{} {},{} {},{}"/>)",
                        coordinate(p[i].x()), coordinate(p[i].y()), coordinate(p[j].x()),
                        coordinate(p[j].y()), coordinate(p[k].x()), coordinate(p[k].y()));
  }
  return text;
}

Eigen::Vector2d label_place(const Projection& p, std::size_t edge) {
  const auto& [i, j] = kEdgeVertices[edge];
  const Eigen::Vector2d at = (p[i] + p[j]) / 2;
  return {std::clamp(at.x(), 24.0, kTetWidth - 24), std::clamp(at.y() + 4, 14.0, kTetHeight - 6)};
}

/// The angle at an edge; beside the middle of the edge if another text is there.
std::string angle_label(const Projection& p, std::size_t edge, double degrees,
                        const Eigen::Vector2d* other) {
  const Eigen::Vector2d at = label_place(p, edge);
  double y = at.y();
  if (other != nullptr && std::abs(at.x() - other->x()) < 44 && std::abs(y - other->y()) < 15) {
    y = other->y() + (other->y() > kTetHeight / 2 ? -15 : 15);
  }
  return text_at(at.x(), y, "middle", "angle", fmt::format("{:.3g}\u00b0", degrees));
}

std::string number_of(const nlohmann::json& tet) {
  return tet.at("tet").is_number() ? fmt::format("Tet {}", tet.at("tet").get<std::int64_t>())
                                   : "A new tet";
}

std::string list_item(const Figures& figures, std::size_t i) {
  const std::string path = fmt::format("worst_tets.{}", i);
  const nlohmann::json& tet = figures.at(path);
  Corners corners;
  for (std::size_t c = 0; c < 4; ++c) {
    for (int axis = 0; axis < 3; ++axis) {
      const Figures of(tet);
      corners[c][axis] = of.number(fmt::format("corners.{}.{}", c, axis));
    }
  }
  const auto is_free = tet.at("may_move").get<std::array<bool, 4>>();
  std::string centre;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0) centre += ' ';
    centre += figures.shown_digits(fmt::format("{}.centre.{}", path, axis), 6);
  }
  return fmt::format(
      "<li>{}<div><h3>{}, region {}</h3><p>{} to {} degrees{}</p><p class=\"reason\">{}</p>"
      "<p class=\"place\">at {}</p><button type=\"button\" class=\"show\" data-tet=\"{}\">Show"
      "</button></div></li>\n",
      tet_picture(corners, is_free,
                  {figures.number("goal.min_angle"), figures.number("goal.max_angle")}),
      escaped(number_of(tet)), figures.shown_digits(path + ".region", 12),
      figures.shown(path + ".theta_min", 3), figures.shown(path + ".theta_max", 3),
      figures.number(path + ".quality") < 0 ? ", inverted" : "",
      figures.shown_text(path + ".reason"), centre, i);
}

}  // namespace

std::string tet_picture(const Corners& corners, const std::array<bool, 4>& is_free,
                        std::array<double, 2> goal) {
  const Projection p = fitted(project(corners));
  const auto angles = dihedral_angles(corners[0], corners[1], corners[2], corners[3]);
  std::string text = draw_faces(p);
  for (std::size_t e = 0; e < 6; ++e) {
    const auto& [i, j] = kEdgeVertices[e];
    const bool is_bad = angles[e] < goal[0] || angles[e] > goal[1];
    text += line_between(p[i].x(), p[i].y(), p[j].x(), p[j].y(), is_bad ? "edge bad" : "edge");
  }
  for (std::size_t i = 0; i < 4; ++i) {
    text += fmt::format(R"(<circle class="{}" cx="{}" cy="{}" r="4"/>)",
                        is_free[i] ? "free" : "fixed", coordinate(p[i].x()), coordinate(p[i].y()));
  }
  const auto [least, greatest] = std::minmax_element(angles.begin(), angles.end());
  const auto first = static_cast<std::size_t>(least - angles.begin());
  const Eigen::Vector2d place = label_place(p, first);
  text += angle_label(p, first, *least, nullptr);
  text += angle_label(p, static_cast<std::size_t>(greatest - angles.begin()), *greatest, &place);
  return drawing(kTetWidth, kTetHeight, "tet",
                 fmt::format("A tet with angles from {:.3g} to {:.3g} degrees", *least, *greatest),
                 text);
}

std::string worst_tets(const Figures& figures) {
  const std::size_t shown = figures.at("worst_tets").size();
  if (figures.count("after.n_bad") == 0 || shown == 0) return "<p>No bad tet is left.</p>\n";
  std::string items;
  for (std::size_t i = 0; i < shown; ++i) items += list_item(figures, i);
  return fmt::format(
      "<p>The worst {} of {} by their angles, counted from 1 as in the file; tetmend-view counts "
      "from 0. "
      "Edges whose angle misses the goal are red; a ring is a vertex that may move, a dot one that "
      "stays.</p>\n<ol class=\"worst\">\n{}</ol>\n",
      shown, figures.shown_count("after.n_bad"), items);
}

std::string reasons(const Figures& figures) {
  if (figures.count("after.n_bad") == 0) return {};
  struct Reason {
    std::string_view name, text, help;
  };
  static constexpr std::array<Reason, 5> kReasons = {{
      {"frozen", "protected", "no --protect or --only, or --layers improve"},
      {"surface", "where the surface forces a bad tet", "a better surface"},
      {"constraint", "held by a face or edge that must stay", "--ignore-interior"},
      {"no_free_vertex", "all vertices on the surface", "a finer mesh, or a lower goal"},
      {"search", "no obstacle is known", "--schedule thorough"},
  }};
  std::string rows;
  for (const Reason& reason : kReasons) {
    const std::string path = fmt::format("limit.bad.{}", reason.name);
    if (figures.count(path) == 0) continue;
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>\n", reason.text,
                        figures.shown_count(path), reason.help);
  }
  if (rows.empty()) return "<p>The run ended before it was found out why they are left.</p>\n";
  std::string text = fmt::format(
      "<table class=\"reasons\"><thead><tr><th>why bad tets are left</th><th>tets</th>"
      "<th>what helps</th></tr></thead><tbody>\n{}</tbody></table>\n",
      rows);
  if (figures.has("limit.theta_min")) {
    text += fmt::format(
        "<p>Proved: no mesh of this surface has a smallest angle above {} degrees.</p>\n",
        figures.shown("limit.theta_min", 3));
  }
  return text;
}

}  // namespace tetmend::report
