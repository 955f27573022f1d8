// SPDX-License-Identifier: MIT
#include "viewer/overlay.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "viewer/mesh/tet_values.h"

namespace tetmend::viewer {

using figure::Anchor;
using figure::Drawing;
using figure::Pen;
using figure::Place;
using figure::Text;

namespace {

constexpr double kTextSize = 15;
constexpr double kTitleSize = 20;
constexpr double kMargin = 18;
constexpr double kLine = 22;

/// Puts words and bars into the corners of the part of the window that shows the mesh.
class OverlayDrawer {
 public:
  OverlayDrawer(Document& document, double scale)
      : document_(document),
        scale_(scale),
        left_(document.canvas_corner.x),
        top_(document.canvas_corner.y),
        right_(left_ + document.canvas.width),
        bottom_(top_ + document.canvas.height) {
    const bool on_dark =
        document.view.theme == "dark" && document.view.background == Background::gradient;
    ink_ = on_dark ? figure::kWhite : figure::kBlack;
    drawing_.width = document.window.width;
    drawing_.height = document.window.height;
  }

  void title() {
    Text text = figure::centred({(left_ + right_) / 2, top_ + (kMargin + 4) * scale_},
                                document_.view.title, kTitleSize * scale_);
    text.colour = ink_;
    drawing_.add(std::move(text));
  }

  /// At the right side: a column of colours with the numbers beside it, the best on top.
  void colour_bar() {
    constexpr double kWidth = 16;
    constexpr unsigned kSteps = 128;
    constexpr unsigned kTicks = 5;
    const SceneSettings& scene = document_.view.scene;
    if (scene.colour == "region") return regions();
    const Range& range = find_tet_value(scene.colour).range;
    const ColourMap& map = find_colour_map(scene.map);
    const double height = std::round(0.42 * (bottom_ - top_));
    const double upper = std::round((top_ + bottom_ - height) / 2);
    const double left = std::round(right_ - (kMargin + kWidth + 44) * scale_);
    const double wide = std::round(kWidth * scale_);
    words({left + wide, upper - 14 * scale_}, scene.colour, Anchor::end);
    for (unsigned i = 0; i < kSteps; ++i) {
      const double from = std::round(upper + height * i / kSteps);
      // Down to the end, lest the mesh shows between two of them.
      drawing_.rectangle({left, from}, wide, upper + height - from, map.at(1 - (i + 0.5) / kSteps));
    }
    for (const double value : figure::ticks(range.low, range.high, kTicks)) {
      const double y = upper + height * (range.high - value) / (range.high - range.low);
      const double x = left + wide;
      drawing_.line({x, y}, {x + 4 * scale_, y}, Pen{ink_, scale_});
      words({x + 8 * scale_, y}, figure::tick_text(value), Anchor::start);
    }
    if (scene.bad) swatch(left, upper + height + kLine * scale_, kBadColour, "bad");
  }

  /// At the lower left.
  void scale_bar() {
    constexpr double kMost = 0.22;  // of the width
    const double most = kMost * (right_ - left_);
    const double length = scale_bar_length(document_, most);
    const double pixels = document_.mesh().scale().to_work(length) * document_.canvas.height /
                          document_.view.camera.height_at_target();
    const double x = left_ + kMargin * scale_;
    const double y = bottom_ - kMargin * scale_;
    const Pen pen{ink_, 2 * scale_};
    drawing_.line({x, y}, {x + pixels, y}, pen);
    for (const double end : {x, x + pixels}) {
      drawing_.line({end, y - 4 * scale_}, {end, y + 4 * scale_}, pen);
    }
    words({x + pixels / 2, y - 14 * scale_},
          figure::tick_text(length) + (document_.view.camera.orthographic ? "" : " at the middle"),
          Anchor::middle);
  }

  Drawing take() { return std::move(drawing_); }

 private:
  void words(Place middle, std::string text, Anchor anchor) {
    Text words = figure::centred(middle, std::move(text), kTextSize * scale_);
    words.anchor = anchor;
    words.colour = ink_;
    drawing_.add(std::move(words));
  }

  void swatch(double left, double y, const Colour& colour, std::string text) {
    const double side = 14 * scale_;
    drawing_.rectangle({left, y - side / 2}, side, side, colour);
    words({left + 22 * scale_, y}, std::move(text), Anchor::start);
  }

  /// The legend of colours that stand for no numbers.
  void regions() {
    constexpr std::size_t kMost = 8;
    const auto& labels = document_.regions();
    const std::size_t shown = std::min(labels.size(), kMost);
    const double left = right_ - (kMargin + 110) * scale_;
    double y = (top_ + bottom_) / 2 - kLine * scale_ * static_cast<double>(shown) / 2;
    for (std::size_t i = 0; i < shown; ++i, y += kLine * scale_) {
      swatch(left, y, region_colour(labels[i]), fmt::format("region {}", labels[i]));
    }
    if (labels.size() > shown) {
      words({left + 22 * scale_, y}, fmt::format("and {} more", labels.size() - shown),
            Anchor::start);
      y += kLine * scale_;
    }
    if (document_.view.scene.bad) swatch(left, y, kBadColour, "bad");
  }

  Document& document_;
  double scale_;
  double left_, top_, right_, bottom_;
  Colour ink_;
  Drawing drawing_;
};

}  // namespace

double scale_bar_length(const Document& document, double most) {
  const double longest = document.mesh().scale().to_file(
      most * document.view.camera.height_at_target() / document.canvas.height);
  const double power = std::pow(10, std::floor(std::log10(longest)));
  const double share = longest / power;
  return power * (share >= 5 ? 5 : share >= 2 ? 2 : 1);
}

Drawing draw_overlay(Document& document, double scale) {
  OverlayDrawer drawer(document, scale);
  if (document.has_mesh()) {
    if (!document.view.title.empty()) drawer.title();
    if (document.view.colour_bar) drawer.colour_bar();
    if (document.view.scale_bar) drawer.scale_bar();
  }
  return drawer.take();
}

}  // namespace tetmend::viewer
