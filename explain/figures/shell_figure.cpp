// SPDX-License-Identifier: MIT
// The tets of a call by themselves, drawn apart a little, before and after, seen from one place.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "explain/figures/figure_parts.h"
#include "explain/figures/figures.h"
#include "explain/figures/painter.h"
#include "kernel/error.h"

namespace tetmend::explain {

using figure::Colour;
using figure::Drawing;
using figure::Font;
using figure::Pen;
using figure::Place;
using figure::Text;

namespace {

constexpr double kPanel = 210;
constexpr double kShrink = 0.1;
constexpr Colour kHiddenColour{205, 208, 213, 255};
constexpr Pen kSide{{40, 44, 52, 255}, 0.4};
constexpr Pen kSkirtPen{figure::kSkirtColour, 1.6};
constexpr Pen kEdgePen{figure::kSupportingEdgeColour, 1.4, true};

/// Where it is seen from, without perspective.
struct Sight {
  Point right, up, forward;
};

Sight sight_of(const Look& look) {
  const double y = look.yaw * std::numbers::pi / 180;
  const double p = look.pitch * std::numbers::pi / 180;
  Sight sight;
  sight.forward = -Point(std::cos(p) * std::cos(y), std::cos(p) * std::sin(y), std::sin(p));
  sight.right = Point(-std::sin(y), std::cos(y), 0);
  sight.up = sight.right.cross(sight.forward);
  return sight;
}

using Corners = std::map<std::uint32_t, Point>;  // by vertex

Corners corners_of(const std::vector<LocalTet>& tets) {
  Corners corners;
  for (const LocalTet& tet : tets) {
    for (unsigned i = 0; i < 4; ++i) corners[tet.vertices[i].index()] = tet.corners[i];
  }
  return corners;
}

/// The least distance of two corners in the picture, squared.
double clearance(const Corners& corners, const Sight& sight) {
  std::vector<Eigen::Vector2d> flat;
  for (const auto& [vertex, p] : corners) flat.emplace_back(sight.right.dot(p), sight.up.dot(p));
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < flat.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, (flat[i] - flat[j]).squaredNorm());
  }
  return least;
}

/// Around the axis, from a little above: the direction with the largest clearance.
Sight clearest_sight(const Corners& corners, const Point& axis) {
  constexpr unsigned kTries = 72;
  constexpr double kAbove = 24 * std::numbers::pi / 180;
  const Point up = axis.normalized();
  const Point aside = up.unitOrthogonal();
  Sight best;
  double most = -1;
  for (unsigned i = 0; i < kTries; ++i) {
    const double angle = 2 * std::numbers::pi * i / kTries;
    const Point outwards = std::cos(angle) * aside + std::sin(angle) * up.cross(aside);
    Sight sight;
    sight.forward = -(std::cos(kAbove) * outwards + std::sin(kAbove) * up);
    sight.right = sight.forward.cross(up).normalized();
    sight.up = sight.right.cross(sight.forward);
    const double clear = clearance(corners, sight);
    if (clear <= most) continue;
    most = clear;
    best = sight;
  }
  return best;
}

/// What the corners of a shell are called: a, b, p with a small number.
struct Name {
  std::string letter, index;
};
using Names = std::map<std::uint32_t, Name>;  // by vertex

Names names_of(const CallStudy& study) {
  Names names;
  if (!study.picture) return names;
  names[study.picture->a.index()] = {"a", ""};
  names[study.picture->b.index()] = {"b", ""};
  for (std::size_t i = 0; i < study.picture->ring.size(); ++i) {
    names[study.picture->ring[i].index()] = {"p", fmt::format("{}", i + 1)};
  }
  return names;
}

/// From points of the mesh to places of a panel.
struct Projection {
  Sight sight;
  Point centre;
  double scale = 1;
  Place middle;

  Place operator()(const Point& p) const {
    const Point away = p - centre;
    return {middle.x + scale * sight.right.dot(away), middle.y - scale * sight.up.dot(away)};
  }
};

/// One state of the tets.
class ShellPanel {
 public:
  ShellPanel(Drawing& drawing, const Projection& to_page) : drawing_(drawing), to_page_(to_page) {}

  void tets(const std::vector<LocalTet>& tets, const CallStudy& study) {
    std::vector<TetCorners> drawn;
    for (const LocalTet& tet : tets) drawn.push_back(shrunk(tet));
    for (const std::size_t i : paint_order(drawn, to_page_.sight.forward)) {
      skirt(tets[i], study, false);
      faces(drawn[i], tet_colour(tets[i].quality));
      skirt(tets[i], study, true);
    }
    drawn_ = std::move(drawn);
  }

  void supporting_edge(const Point& a, const Point& b) {
    drawing_.line(to_page_(a), to_page_(b), kEdgePen);
  }

  void labels(const Corners& corners, const Names& names) {
    LabelPlacer placer;
    for (const auto& [vertex, p] : corners) {
      const Place at = to_page_(p);
      placer.occupy({at.x - 2, at.x + 2, at.y - 2, at.y + 2});
      drawing_.add(figure::Dot{at, 1.6, is_hidden(p) ? kHiddenColour : figure::kBlack});
    }
    for (const auto& [vertex, p] : corners) {
      const auto name = names.find(vertex);
      label(to_page_(p), name == names.end() ? Name{} : name->second, vertex, placer);
    }
  }

 private:
  static TetCorners shrunk(const LocalTet& tet) {
    const Point centre = (tet.corners[0] + tet.corners[1] + tet.corners[2] + tet.corners[3]) / 4;
    TetCorners corners;
    for (unsigned i = 0; i < 4; ++i) corners[i] = (1 - kShrink) * tet.corners[i] + kShrink * centre;
    return corners;
  }

  /// Some tet lies in front of it: the ray to the eye enters one.
  bool is_hidden(const Point& p) const {
    const Point to_eye = -to_page_.sight.forward;
    return std::any_of(drawn_.begin(), drawn_.end(), [&](const TetCorners& tet) {
      double from = 1e-9;
      double to = std::numeric_limits<double>::infinity();
      for (unsigned f = 0; f < 4; ++f) {
        const Point normal = outward_normal(tet, f);
        const double outside = normal.dot(p - tet[kFaceVertices[f][0]]);
        const double along = normal.dot(to_eye);
        if (along == 0 && outside > 0) return false;
        if (along > 0) to = std::min(to, -outside / along);
        if (along < 0) from = std::max(from, -outside / along);
      }
      return from < to;
    });
  }

  /// Of unit length, out of the tet.
  static Point outward_normal(const TetCorners& tet, unsigned f) {
    const Point& p = tet[kFaceVertices[f][0]];
    Point normal = (tet[kFaceVertices[f][1]] - p).cross(tet[kFaceVertices[f][2]] - p);
    if (normal.dot(tet[f] - p) > 0) normal = -normal;
    return normal.normalized();
  }

  void faces(const TetCorners& tet, const Colour& full) {
    constexpr double kDarkest = 0.75;
    for (unsigned f = 0; f < 4; ++f) {
      const double towards = -outward_normal(tet, f).dot(to_page_.sight.forward);
      if (!(towards > 0)) continue;
      const double light = kDarkest + (1 - kDarkest) * towards;
      const auto dim = [&](std::uint8_t x) { return static_cast<std::uint8_t>(light * x); };
      figure::Area area{{}, {dim(full.red), dim(full.green), dim(full.blue), 255}, kSide};
      for (const auto i : kFaceVertices[f]) area.corners.push_back(to_page_(tet[i]));
      drawing_.add(std::move(area));
    }
  }

  /// The sides of the skirt polygon at a tet: those behind it before it is drawn, the others after.
  void skirt(const LocalTet& tet, const CallStudy& study, bool in_front) {
    if (!study.picture) return;
    const auto& ring = study.picture->ring;
    for (unsigned i = 0; i < 4; ++i) {
      for (unsigned j = 0; j < i; ++j) {
        const auto at = std::find(ring.begin(), ring.end(), tet.vertices[i]);
        const auto to = std::find(ring.begin(), ring.end(), tet.vertices[j]);
        if (at == ring.end() || to == ring.end()) continue;
        const auto steps = static_cast<std::size_t>(std::abs(at - to));
        if (steps != 1 && steps + 1 != ring.size()) continue;  // a chord
        // The faces at the edge are those opposite of the other two vertices.
        bool is_seen = false;
        for (unsigned f = 0; f < 4; ++f) {
          if (f == i || f == j) continue;
          is_seen = is_seen || outward_normal(tet.corners, f).dot(to_page_.sight.forward) < 0;
        }
        if (is_seen != in_front) continue;
        drawing_.line(to_page_(tet.corners[i]), to_page_(tet.corners[j]), kSkirtPen);
      }
    }
  }

  /// "p" with a small number, and the number of the vertex in grey; away from the middle.
  void label(Place at, const Name& name, std::uint32_t vertex, LabelPlacer& placer) {
    const std::string number = fmt::format("{}", vertex);
    const double letter_width = figure::text_width(name.letter, kTitleSize, Font::oblique);
    const double index_width = figure::text_width(name.index, kNumberSize - 1);
    const double gap = name.letter.empty() ? 0 : 2.5;
    const double width =
        letter_width + index_width + gap + figure::text_width(number, kNumberSize - 0.5);
    const auto box = [&](const Place& middle) {
      return figure::Box{middle.x - width / 2 - 1, middle.x + width / 2 + 1, middle.y - 5,
                         middle.y + 5};
    };
    const Place middle = clear_place(at, width, placer, box);
    placer.occupy(box(middle));
    drawing_.rectangle({box(middle).left, middle.y - 5}, width + 2, 10, {255, 255, 255, 190});
    double x = middle.x - width / 2;
    const double base = middle.y + 3;
    if (!name.letter.empty()) {
      drawing_.add(Text{{x, base}, name.letter, kTitleSize, Font::oblique});
      x += letter_width;
      drawing_.add(Text{{x, base + 1.5}, name.index, kNumberSize - 1});
      x += index_width + gap;
    }
    drawing_.add(Text{{x, base},
                      number,
                      kNumberSize - 0.5,
                      Font::regular,
                      figure::Anchor::start,
                      name.letter.empty() ? figure::kBlack : figure::kGrey});
  }

  /// Outwards first, then to the sides, then farther away.
  template <class BoxAt>
  Place clear_place(const Place& at, double width, const LabelPlacer& placer,
                    const BoxAt& box) const {
    const double outwards = std::atan2(at.y - to_page_.middle.y, at.x - to_page_.middle.x);
    Place best;
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    for (const double away : {8.0, 13.0, 19.0}) {
      for (const double turn : {0.0, 0.5, -0.5, 1.0, -1.0, 1.6, -1.6, 2.4, -2.4, 3.14}) {
        const double angle = outwards + turn;
        const Place place{at.x + (away + width / 2 - 4) * std::cos(angle),
                          at.y + away * std::sin(angle)};
        const std::size_t count = placer.touched(box(place));
        if (count >= fewest) continue;
        fewest = count;
        best = place;
      }
    }
    return best;
  }

  Drawing& drawing_;
  const Projection& to_page_;
  std::vector<TetCorners> drawn_;
};

/// The box of all corners as they are seen.
Projection projection_of(const Sight& sight, const CallStudy& study) {
  constexpr double kRoomForLabels = 26;
  Point low = Point::Constant(std::numeric_limits<double>::max());
  Point high = -low;
  for (const auto* tets : {&study.before, &study.after}) {
    for (const LocalTet& tet : *tets) {
      for (const Point& p : tet.corners) {
        const Point seen(sight.right.dot(p), sight.up.dot(p), sight.forward.dot(p));
        low = low.cwiseMin(seen);
        high = high.cwiseMax(seen);
      }
    }
  }
  const Point middle = (low + high) / 2;
  Projection projection;
  projection.sight = sight;
  projection.centre = middle.x() * sight.right + middle.y() * sight.up + middle.z() * sight.forward;
  const double widest = std::max({high.x() - low.x(), high.y() - low.y(), 1e-300});
  projection.scale = (kPanel - 2 * kRoomForLabels) / widest;
  return projection;
}

struct PanelState {
  std::string name;
  const std::vector<LocalTet>* tets = nullptr;
};

void draw_panel(Drawing& drawing, const CallStudy& study, Projection& to_page,
                const PanelState& state) {
  const Corners corners = corners_of(*state.tets);
  ShellPanel panel(drawing, to_page);
  panel.tets(*state.tets, study);
  const auto has_edge = [&](const LocalTet& tet) {
    return contains(tet.vertices, study.picture->a) && contains(tet.vertices, study.picture->b);
  };
  if (study.picture && std::any_of(state.tets->begin(), state.tets->end(), has_edge)) {
    panel.supporting_edge(corners.at(study.picture->a.index()),
                          corners.at(study.picture->b.index()));
  }
  panel.labels(corners, names_of(study));
}

}  // namespace

Drawing draw_shell(const TraceFile& file, const CallStudy& study, const std::optional<Look>& look) {
  const std::size_t most = std::max(study.before.size(), study.after.size());
  if (study.before.empty()) {
    throw Error(fmt::format("call {} has no tets to draw: its target was gone", study.call));
  }
  if (most > kMostShellTets) {
    throw Error(fmt::format("call {} has {} tets, too many for a figure, which has {} at most",
                            study.call, most, kMostShellTets));
  }
  const Corners corners = corners_of(study.before);
  const Point axis =
      study.picture
          ? Point(corners.at(study.picture->b.index()) - corners.at(study.picture->a.index()))
          : Point(0, 0, 1);
  Projection to_page = projection_of(look ? sight_of(*look) : clearest_sight(corners, axis), study);
  std::vector<PanelState> states = {{"Before", &study.before}};
  if (!study.after.empty()) states.push_back({study.undone ? "Tried" : "After", &study.after});
  if (study.after.size() == study.before.size() && !file.calls()[study.call].accepted() &&
      !study.undone) {
    states.pop_back();  // nothing was tried
  }
  constexpr double kBetween = 16;
  Drawing drawing;
  drawing.title = figure_title(file, study.call);
  drawing.width = figure_width(drawing.title, states.size(), kPanel, kBetween);
  const double inside = drawing.width - 2 * kMargin;
  const double top =
      add_paragraph(drawing, {kMargin, kMargin}, inside, drawing.title, kTitleSize, Font::bold);
  double bottom = top;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double left = kMargin + static_cast<double>(i) * (kPanel + kBetween);
    to_page.middle = {left + kPanel / 2, top + kPanel / 2};
    draw_panel(drawing, study, to_page, states[i]);
    const std::string caption = fmt::format("{}: {} tets, worst {:.4f}", states[i].name,
                                            states[i].tets->size(), worst_of(*states[i].tets));
    bottom = std::max(bottom, add_paragraph(drawing, {left, top + kPanel}, kPanel, caption));
  }
  std::vector<LegendEntry> legend;
  if (study.picture) legend = {{kSkirtPen, "skirt polygon"}, {kEdgePen, "supporting edge"}};
  bottom = add_legend(drawing, {kMargin, bottom + 6}, inside, legend);
  drawing.height = add_quality_bar(drawing, {kMargin, bottom + 4}) + kMargin;
  return drawing;
}

}  // namespace tetmend::explain
