// SPDX-License-Identifier: MIT
#include "viewer/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "kernel/grouped.h"
#include "viewer/mesh/tet_values.h"
#include "viewer/mesh/visibility.h"

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
constexpr double kAxis = 30;               // of the triad
constexpr double kMostScaleBar = 0.22;     // of the width
constexpr std::size_t kMostNumbers = 300;  // of vertices that are seen

/// Puts words and bars into the corners of the part of the window that shows the mesh.
class OverlayDrawer {
 public:
  OverlayDrawer(Document& document, const OverlayLook& look)
      : document_(document),
        look_(look),
        scale_(look.scale),
        left_(document.canvas_corner.x),
        top_(document.canvas_corner.y),
        right_(left_ + document.canvas.width),
        bottom_(top_ + document.canvas.height) {
    const bool on_dark =
        document.view.theme == "dark" && document.view.background == Background::gradient;
    on_dark_ = on_dark;
    ink_ = on_dark ? figure::kWhite : figure::kBlack;
    ground_ = on_dark ? Colour{33, 36, 41, 255} : Colour{246, 247, 249, 255};
    drawing_.width = document.window.width;
    drawing_.height = document.window.height;
  }

  /// Those of the call or of the selection, all that the picture has: at any side of their vertices, or
  /// away from them at the end of a line. Of very many, the last ones only where there is room.
  void names() {
    constexpr std::size_t kMost = 40;
    const auto& all = document_.names();
    Place middle{};
    std::vector<Place> places;
    for (const NamedVertex& name : all) {
      const auto at = pixel_of(name.vertex);
      middle.x += at.value_or(Place{}).x / static_cast<double>(all.size());
      middle.y += at.value_or(Place{}).y / static_cast<double>(all.size());
      if (at && is_in_picture(*at)) places.push_back(*at);
    }
    places.resize(std::min(places.size(), kMost));
    for (const Place& at : places) dots_.push_back(box_around(at, 0.3 * look_.text_size));
    keep_edge_clear();
    for (std::size_t i = 0; i < all.size(); ++i) {
      name_at(all[i], i < kMost ? std::optional(middle) : std::nullopt);
    }
  }
  /// Names lie on the supporting edge only where there is no other place.
  void keep_edge_clear() {
    std::array<std::optional<Place>, 2> ends;
    for (const NamedVertex& name : document_.names()) {
      if (name.role == "a") ends[0] = pixel_of(name.vertex);
      if (name.role == "b") ends[1] = pixel_of(name.vertex);
    }
    if (!ends[0] || !ends[1]) return;
    for (const double t : {0.3, 0.5, 0.7}) {
      const Place at = {ends[0]->x + t * (ends[1]->x - ends[0]->x),
                        ends[0]->y + t * (ends[1]->y - ends[0]->y)};
      dots_.push_back(box_around(at, 0.15 * look_.text_size));
    }
  }

  /// Numbers that would cover others are left out.
  void numbers_of_seen() {
    for (const VertexHandle v : seen_vertices(document_, kMostNumbers)) {
      name_at({v, {}}, std::nullopt);
    }
  }

  void pointed() {
    std::vector<Place> pixels;
    for (const VertexHandle v : document_.pointed().vertices) {
      const auto at = is_there(v) ? pixel_of(v) : std::nullopt;
      if (!at) return;
      pixels.push_back(*at);
    }
    const double text = look_.text_size;
    if (pixels.size() == 3)
      drawing_.add(figure::Area{pixels, figure::faint(kPointedColour, 0.27), {}});
    constexpr std::size_t kMost = 4;
    for (std::size_t i = 0; i < pixels.size() && pixels.size() <= kMost; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        drawing_.line(pixels[i], pixels[j], Pen{kPointedColour, text / 3});
      }
      circle(pixels[i], 0.6 * text, Pen{kPointedColour, text / 4});
    }
  }

  /// At the lower left, or in the corner where it lies on the fewest vertices of the call; smaller
  /// in a small picture. Names keep away from it.
  void reserve_legend() {
    double widest = 0;
    for (const LegendEntry& entry : document_.legend()) {
      widest = std::max(widest, look_.text_width(entry.text, look_.text_size));
    }
    const double full = look_.text_size;
    const auto count = static_cast<double>(document_.legend().size());
    const double shrunk = legend_scale(widest + kBeside * full, (kLegendLine * count + 0.5) * full);
    const double text = shrunk * full;
    const double width = shrunk * widest + kBeside * text;
    const double height = (kLegendLine * count + 0.5) * text;
    legend_ = {emptiest_corner(width, height, 0.3 * text), text};
    taken_.push_back(legend_.box);
  }

  /// Precondition: it has its place.
  void legend() {
    const auto& [box, text] = legend_;
    const double line = kLegendLine * text;
    drawing_.rectangle({box.left, box.top}, box.right - box.left, box.bottom - box.top,
                       figure::faint(ground_, 0.8));
    double y = box.top + 0.3 * text;
    for (const LegendEntry& entry : document_.legend()) {
      const double left = box.left + 0.3 * text;
      drawing_.rectangle({left, y + 0.2 * text}, 1.4 * text, 0.8 * text, entry.colour);
      words({left + 1.8 * text, y + line / 2}, entry.text, Anchor::start, text);
      y += line;
    }
  }

  void title() {
    Text text = figure::centred({(left_ + right_) / 2, top_ + (kMargin + 4) * scale_},
                                document_.view.title, kTitleSize * scale_);
    text.colour = ink_;
    drawing_.add(std::move(text));
  }

  /// At the right side: a column of colours with the numbers beside it, the best on top; of
  /// distances, the largest.
  void colour_bar() {
    const SceneSettings& scene = document_.view.scene;
    if (scene.colour == "region") return regions();
    if (scene.colour == kDistance) return distance_bar();
    const ColourMap& map = find_colour_map(scene.map);
    const Column column = colour_column([&](double t) { return map.at(t); });
    const TetValue& value = find_tet_value(scene.colour);
    words_on_ground({right_ - kMargin / 2 * scale_, column.upper - 14 * scale_}, value.title(),
                    Anchor::end);
    numbers(column, value.range);
  }

  /// At the lower left.
  void scale_bar() {
    const double most = kMostScaleBar * (right_ - left_);
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
    const std::string text =
        figure::tick_text(length) + (document_.view.camera.orthographic ? "" : " at the middle");
    const double half = look_.text_width(text, kTextSize * scale_) / 2;
    words({std::max(x + pixels / 2, left_ + kMargin / 2 * scale_ + half), y - 14 * scale_}, text,
          Anchor::middle);
  }

  /// What has a place of its own, so that words keep away from it.
  void reserve() {
    constexpr double kLetters = 1.6;  // behind the ends of the axes
    const ViewSettings& view = document_.view;
    const double margin = kMargin * scale_;
    const double line = kLine * scale_;
    if (has_triad()) fixed_.push_back(box_around(triad_middle(), kLetters * kAxis * scale_));
    if (view.colour_bar) {
      const double half = 0.21 * (bottom_ - top_) + 2 * line;
      const double middle = (top_ + bottom_) / 2;
      fixed_.push_back({right_ - margin - 60 * scale_, right_, middle - half, middle + half});
    }
    if (view.scale_bar) {
      const double width = margin + kMostScaleBar * (right_ - left_);
      fixed_.push_back({left_, left_ + width, bottom_ - 2 * line, bottom_});
    }
    if (!view.title.empty()) fixed_.push_back({left_, right_, top_, top_ + 2 * line});
    taken_ = fixed_;
  }

  /// In a small picture legend and names want the room.
  bool has_triad() const {
    constexpr double kLeast = 8 * kAxis;
    return look_.has_triad && std::min(right_ - left_, bottom_ - top_) >= kLeast * scale_;
  }

  /// In a lower corner that nothing else has.
  Place triad_middle() const {
    const double length = kAxis * scale_;
    const bool is_taken = document_.view.colour_bar;  // the lower right
    const bool is_over_scale = is_taken && document_.view.scale_bar;
    return {is_taken ? left_ + 2 * length : right_ - 2 * length,
            bottom_ - (is_over_scale ? 3 : 2) * length};
  }

  /// Directions of the axes; those that point away come first, so that the others lie over them.
  void triad() {
    if (!has_triad()) return;
    const Camera& camera = document_.view.camera;
    const double length = kAxis * scale_;
    const Place middle = triad_middle();
    struct Axis {
      glm::dvec3 direction;
      Colour colour;
      const char* name;
    };
    std::array<Axis, 3> axes = {{{{1, 0, 0}, {205, 60, 60, 255}, "x"},
                                 {{0, 1, 0}, {50, 150, 60, 255}, "y"},
                                 {{0, 0, 1}, {60, 95, 210, 255}, "z"}}};
    std::sort(axes.begin(), axes.end(), [&](const Axis& a, const Axis& b) {
      return glm::dot(a.direction, camera.forward()) > glm::dot(b.direction, camera.forward());
    });
    for (const Axis& axis : axes) {
      const double x = glm::dot(axis.direction, camera.right());
      const double y = -glm::dot(axis.direction, camera.up());
      drawing_.line(middle, {middle.x + length * x, middle.y + length * y},
                    Pen{axis.colour, 2.5 * scale_});
      Text text = figure::centred({middle.x + 1.35 * length * x, middle.y + 1.35 * length * y},
                                  axis.name, 0.9 * kTextSize * scale_);
      text.colour = ink_;
      drawing_.add(std::move(text));
    }
  }

  Drawing take() { return std::move(drawing_); }

 private:
  static constexpr double kLegendLine = 1.25;  // in heights of its text
  static constexpr double kBeside = 2.6;  // the swatches and the gaps beside the text, likewise

  /// How much smaller a legend has to be that would be so large.
  double legend_scale(double width, double height) const {
    constexpr double kMostWidth = 0.5, kMostHeight = 0.34;  // of the picture
    constexpr double kLeast = 0.62;
    const double room =
        std::min(kMostWidth * (right_ - left_) / width, kMostHeight * (bottom_ - top_) / height);
    return std::clamp(room, kLeast, 1.0);
  }

  /// The lower left one among equals.
  figure::Box emptiest_corner(double width, double height, double margin) const {
    const double left = left_ + margin, right = right_ - margin - width;
    const double top = top_ + margin, bottom = bottom_ - margin - height;
    const std::array<Place, 4> corners = {
        {{left, bottom}, {right, bottom}, {left, top}, {right, top}}};
    figure::Box best{};
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    for (const Place& corner : corners) {
      const figure::Box box = {corner.x, corner.x + width, corner.y, corner.y + height};
      const std::size_t covered = covered_by(box);
      if (covered >= fewest) continue;
      best = box;
      fewest = covered;
    }
    return best;
  }

  /// Vertices of the call, words that stand there already, and worse: what has no other place.
  std::size_t covered_by(const figure::Box& box) const {
    constexpr std::size_t kFixed = 20;
    std::size_t covered = 0;
    for (const figure::Box& other : fixed_) covered += box.overlaps(other) ? kFixed : 0;
    for (const NamedVertex& name : document_.names()) {
      const auto at = pixel_of(name.vertex);
      const bool is_inside =
          at && at->x > box.left && at->x < box.right && at->y > box.top && at->y < box.bottom;
      covered += is_inside ? 1 : 0;
    }
    return covered + static_cast<std::size_t>(std::count_if(
                         taken_.begin(), taken_.end(),
                         [&](const figure::Box& other) { return box.overlaps(other); }));
  }

  void words(Place middle, std::string text, Anchor anchor) {
    words(middle, std::move(text), anchor, kTextSize * scale_);
  }
  void words(Place middle, std::string text, Anchor anchor, double size) {
    Text words = figure::centred(middle, std::move(text), size);
    words.anchor = anchor;
    words.colour = ink_;
    drawing_.add(std::move(words));
  }

  /// Can be read where the mesh is behind them; papers have them on nothing.
  void words_on_ground(Place middle, std::string text, Anchor anchor) {
    const double size = kTextSize * scale_;
    if (document_.view.background == Background::gradient) {
      const double width = look_.text_width(text, size);
      const double left = anchor == Anchor::end ? middle.x - width : middle.x;
      drawing_.rectangle({left - 0.2 * size, middle.y - 0.62 * size}, width + 0.4 * size,
                         1.24 * size, figure::faint(ground_, 0.75));
    }
    words(middle, std::move(text), anchor);
  }

  bool is_there(VertexHandle v) const {
    const TetMesh& mesh = document_.mesh();
    return v.index() < mesh.vertex_slots() && !mesh.is_deleted(v);
  }
  std::optional<Place> pixel_of(VertexHandle v) const {
    const auto at =
        document_.view.camera.project(to_glm(document_.mesh().point(v)), document_.canvas);
    if (!at) return std::nullopt;
    return Place{left_ + at->x, top_ + at->y};
  }

  void circle(const Place& middle, double radius, const Pen& pen) {
    constexpr int kCorners = 24;
    figure::Stroke stroke{{}, pen};
    for (int i = 0; i <= kCorners; ++i) {
      const double angle = 2 * std::numbers::pi * i / kCorners;
      stroke.places.push_back(
          {middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle)});
    }
    drawing_.add(std::move(stroke));
  }

  bool is_in_picture(const Place& at) const {
    return at.x >= left_ && at.x <= right_ && at.y >= top_ && at.y <= bottom_;
  }

  static figure::Box box_around(const Place& middle, double half) {
    return {middle.x - half, middle.x + half, middle.y - half, middle.y + half};
  }

  /// Of a text of that width, with its middle there.
  figure::Box box_of_text(const Place& middle, double width) const {
    const double half = 0.6 * look_.text_size;
    return {middle.x - width / 2, middle.x + width / 2, middle.y - half, middle.y + half};
  }

  /// How bad a place for a text is: far from its vertex, over other vertices, behind a line that
  /// crosses other words, and worst of all over these or cut by the border.
  double cost_of(const figure::Box& box, const Place& at, bool has_line) const {
    constexpr double kDot = 3, kCrossed = 4, kCovered = 1000;
    const auto count = [&](const std::vector<figure::Box>& boxes, const auto& holds) {
      return static_cast<double>(std::count_if(boxes.begin(), boxes.end(), holds));
    };
    const auto overlaps = [&](const figure::Box& other) { return box.overlaps(other); };
    double cost = kCovered * count(taken_, overlaps) + kDot * count(dots_, overlaps);
    const bool is_whole =
        box.left > left_ && box.right < right_ && box.top > top_ && box.bottom < bottom_;
    if (!is_whole) cost += kCovered / 2;
    if (!has_line) return cost;
    const Place end = end_of_line(box, at);
    cost += std::hypot(end.x - at.x, end.y - at.y) / look_.text_size;
    return cost + kCrossed * count(taken_, [&](const figure::Box& other) {
                    return is_crossed(other, at, end);
                  });
  }

  static Place end_of_line(const figure::Box& box, const Place& at) {
    return {std::clamp(at.x, box.left, box.right), (box.top + box.bottom) / 2};
  }

  static bool is_crossed(const figure::Box& box, const Place& from, const Place& to) {
    constexpr int kSteps = 16;
    for (int i = 1; i < kSteps; ++i) {
      const double t = static_cast<double>(i) / kSteps;
      const double x = from.x + t * (to.x - from.x);
      const double y = from.y + t * (to.y - from.y);
      if (x > box.left && x < box.right && y > box.top && y < box.bottom) return true;
    }
    return false;
  }

  /// At the upper right of a vertex, if that is free.
  std::optional<figure::Box> box_beside(const Place& at, double width) const {
    const figure::Box box = box_of_text(corner_places(at, width).front(), width);
    if (!is_free(box)) return std::nullopt;
    return box;
  }

  /// Middles of texts at the four corners of a vertex, the upper right one first.
  std::array<Place, 4> corner_places(const Place& at, double width) const {
    const double text = look_.text_size;
    const double away = 0.35 * text + width / 2;
    return {{{at.x + away, at.y - 0.6 * text},
             {at.x + away, at.y + 0.6 * text},
             {at.x - away, at.y - 0.6 * text},
             {at.x - away, at.y + 0.6 * text}}};
  }

  struct Chosen {
    figure::Box box;
    double cost = std::numeric_limits<double>::infinity();
    bool has_line = false;
  };

  /// The best place near a vertex; at the end of a line at first away from `middle`. There is always
  /// one.
  Chosen best_box(const Place& at, double width, const Place& middle) const {
    constexpr int kRings = 12;
    constexpr int kDirections = 24;
    const double text = look_.text_size;
    Chosen best;
    const auto consider = [&](const Place& place, bool has_line) {
      const figure::Box box = box_of_text(place, width);
      const double cost = cost_of(box, at, has_line);
      if (cost < best.cost) best = {box, cost, has_line};
    };
    for (const Place& corner : corner_places(at, width)) consider(corner, false);
    if (best.cost == 0) return best;
    const double outwards = std::atan2(at.y - middle.y, at.x - middle.x);
    for (int ring = 1; ring <= kRings && best.cost > 1.5 * (ring - 1); ++ring) {
      for (int k = 0; k < kDirections; ++k) {  // to both sides in turn
        const double turn = 2 * std::numbers::pi * ((k + 1) / 2) / kDirections;
        const double angle = outwards + (k % 2 == 0 ? turn : -turn);
        const double away = 1.5 * text * ring;
        consider({at.x + (away + width / 2) * std::cos(angle), at.y + away * std::sin(angle)},
                 true);
      }
    }
    constexpr double kCovers = 500;
    if (best.cost < kCovers) return best;
    for (double y = top_ + text; y < bottom_; y += text) {  // anywhere
      for (double x = left_ + width; x < right_; x += width) consider({x, y}, true);
    }
    return best;
  }

  bool is_free(const figure::Box& box) const {
    return std::none_of(taken_.begin(), taken_.end(),
                        [&](const figure::Box& other) { return box.overlaps(other); });
  }

  /// The role, if there is one, then the number, beside a dot at the vertex. With a middle to be away
  /// from, at the end of a line where there is no room beside it; without, nothing then.
  void name_at(const NamedVertex& name, const std::optional<Place>& middle_of_all) {
    const auto at = pixel_of(name.vertex);
    if (!at || !is_in_picture(*at)) return;
    const double text = look_.text_size;
    const std::string number = fmt::format("{}", name.vertex.index());
    const std::string role = name.role.empty() ? "" : name.role + " ";
    const double role_width = look_.text_width(role, text);
    const double width = role_width + look_.text_width(number, text);
    std::optional<figure::Box> box;
    if (middle_of_all) {
      const Chosen chosen = best_box(*at, width, *middle_of_all);
      box = chosen.box;
      if (chosen.has_line) {
        drawing_.line(*at, end_of_line(chosen.box, *at), Pen{ink_, text / 16});
      }
    } else {
      box = box_beside(*at, width);
    }
    if (!box) return;
    taken_.push_back(*box);
    const double left = box->left;
    const double middle = (box->top + box->bottom) / 2;
    drawing_.add(figure::Dot{*at, 0.16 * text, ink_});
    drawing_.rectangle({left - 2, box->top}, box->right - left + 4, box->bottom - box->top,
                       figure::faint(ground_, 0.75));
    const bool is_end = name.role == "a" || name.role == "b" || name.role == "v";
    Text role_text = figure::centred({left, middle}, role, text);
    role_text.anchor = Anchor::start;
    role_text.colour = readable(is_end ? kSupportingEdgeColour : kSkirtColour);
    if (!role.empty()) drawing_.add(std::move(role_text));
    words({left + role_width, middle}, number, Anchor::start, text);
  }

  /// A colour of lines, for words.
  Colour readable(Colour colour) const {
    if (!on_dark_) return colour;
    constexpr int kWhite = 255;
    for (std::uint8_t* part : {&colour.red, &colour.green, &colour.blue}) {
      *part = static_cast<std::uint8_t>((*part + kWhite) / 2);
    }
    return colour;
  }

  /// Of colours, in the middle of the right side.
  struct Column {
    double left, upper, wide, height;
  };
  /// `colour` is asked for places from 0, below, to 1.
  template <class ColourAt>
  Column colour_column(ColourAt colour) {
    constexpr double kWidth = 16;
    constexpr unsigned kSteps = 128;
    Column column{};
    column.height = std::round(0.42 * (bottom_ - top_));
    column.upper = std::round((top_ + bottom_ - column.height) / 2);
    column.left = std::round(right_ - (kMargin + kWidth + 44) * scale_);
    column.wide = std::round(kWidth * scale_);
    for (unsigned i = 0; i < kSteps; ++i) {
      const double from = std::round(column.upper + column.height * i / kSteps);
      // Down to the end, lest the mesh shows between two of them.
      drawing_.rectangle({column.left, from}, column.wide, column.upper + column.height - from,
                         colour(1 - (i + 0.5) / kSteps));
    }
    return column;
  }

  /// Right of the column, or left of it.
  void numbers(const Column& column, const Range& range, Anchor side = Anchor::start) {
    constexpr unsigned kTicks = 5;
    const bool is_right = side == Anchor::start;
    const double x = is_right ? column.left + column.wide : column.left;
    const double out = is_right ? scale_ : -scale_;
    for (const double value : figure::ticks(range.low, range.high, kTicks)) {
      const double y =
          column.upper + column.height * (range.high - value) / (range.high - range.low);
      drawing_.line({x, y}, {x + 4 * out, y}, Pen{ink_, scale_});
      words_on_ground({x + 8 * out, y}, figure::tick_text(value), side);
    }
  }

  /// Lengths at the right; where the tolerance is the same everywhere, parts of it at the left.
  void distance_bar() {
    const ReferenceSurface* reference = document_.reference();
    if (reference == nullptr) return;
    const ColourMap& map = find_colour_map(document_.view.scene.map);
    const Column column = colour_column([&](double t) { return map.at(1 - t); });
    const double right = right_ - kMargin / 2 * scale_;
    const bool both_ways = document_.view.scene.both_ways;
    words_on_ground({right, column.upper - 14 * scale_},
                    both_ways ? "larger distance of both ways" : "distance from the reference",
                    Anchor::end);
    numbers(column, document_.distance_range());
    if (reference->allowance().length > 0) {
      numbers(column, {0, 1}, Anchor::end);
      words_on_ground(
          {column.left - 8 * scale_, column.upper + column.height + 0.8 * kLine * scale_},
          "of the tolerance", Anchor::end);
    }
    double y = column.upper + column.height + 1.8 * kLine * scale_;
    for (std::string& line : departure_in_words(document_)) {
      words_on_ground({right, y}, std::move(line), Anchor::end);
      y += kLine * scale_;
    }
    const double left = right - 110 * scale_;
    swatch(left, y, kUnchangedColour, "unchanged");
    if (document_.view.scene.reference > 0) {
      swatch(left, y + kLine * scale_, kReferenceColour, "reference");
    }
  }

  void swatch(double left, double y, const Colour& colour, std::string text) {
    const double side = 14 * scale_;
    drawing_.rectangle({left, y - side / 2}, side, side, colour);
    words_on_ground({left + 22 * scale_, y}, std::move(text), Anchor::start);
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
      words_on_ground({left + 22 * scale_, y}, fmt::format("and {} more", labels.size() - shown),
                      Anchor::start);
      y += kLine * scale_;
    }
    if (document_.view.scene.bad) swatch(left, y, kBadColour, "bad");
  }

  Document& document_;
  const OverlayLook& look_;
  double scale_;
  double left_, top_, right_, bottom_;
  bool on_dark_ = false;
  Colour ink_, ground_;
  Drawing drawing_;
  std::vector<figure::Box> fixed_;  // by axes and bars
  std::vector<figure::Box> taken_;  // by these, the legend and numbers
  struct Legend {
    figure::Box box;
    double text;
  } legend_{};
  std::vector<figure::Box> dots_;  // vertices that have a name
};

}  // namespace

std::vector<std::string> departure_in_words(Document& document) {
  const SurfaceDeparture& departure = document.departure();
  const bool has_tolerance = document.reference()->allowance().is_known();
  std::vector<std::string> lines;
  const auto add = [&](const std::string& before, const Departure& most) {
    lines.push_back(before + figure::tick_text(most.distance));
    if (has_tolerance) lines.push_back(fmt::format("{:.2g} of the tolerance", most.share));
  };
  add(departure.back ? "to the reference at most " : "at most ", departure.most);
  if (departure.back) add("from the reference at most ", *departure.back);
  lines.push_back(fmt::format("{} of {} triangles changed", grouped(departure.others),
                              grouped(departure.triangles)));
  return lines;
}

double scale_bar_length(const Document& document, double most) {
  const double longest = document.mesh().scale().to_file(
      most * document.view.camera.height_at_target() / document.canvas.height);
  const double power = std::pow(10, std::floor(std::log10(longest)));
  const double share = longest / power;
  return power * (share >= 5 ? 5 : share >= 2 ? 2 : 1);
}

std::vector<VertexHandle> seen_vertices(Document& document, std::size_t most) {
  const Scene& scene = document.scene();
  const TetMesh& mesh = document.mesh();
  const Camera& camera = document.view.camera;
  std::set<std::uint32_t> numbers;
  for (const TetHandle t : scene.surface_tets) {
    for (const VertexHandle v : mesh.vertices(t)) numbers.insert(v.index());
  }
  std::vector<std::pair<double, VertexHandle>> near;  // by depth
  for (const std::uint32_t number : numbers) {
    const VertexHandle v(number);
    const auto at = camera.project(to_glm(mesh.point(v)), document.canvas);
    const bool is_inside = at && at->x >= 0 && at->y >= 0 && at->x < document.canvas.width &&
                           at->y < document.canvas.height;
    if (!is_inside) continue;
    near.emplace_back(glm::dot(to_glm(mesh.point(v)) - camera.eye(), camera.forward()), v);
  }
  std::sort(near.begin(), near.end());
  // So many triangles are looked at: a picture of a large mesh must not take seconds.
  constexpr std::size_t kMostTests = 40'000'000;
  const std::size_t tries = kMostTests / std::max<std::size_t>(scene.surface_tets.size(), 1);
  std::vector<VertexHandle> seen;
  for (std::size_t i = 0; i < std::min(near.size(), tries) && seen.size() < most; ++i) {
    const glm::dvec3 point = to_glm(mesh.point(near[i].second));
    const auto at = camera.project(point, document.canvas);
    const Ray ray = camera.ray(at->x, at->y, document.canvas);
    const auto hit = cast(scene, ray);
    constexpr double kNear = 1e-6;  // of the distance: the triangles at the vertex itself
    const double away = glm::distance(ray.origin, point);
    const bool is_hidden = hit && glm::distance(ray.origin, hit->point) < (1 - kNear) * away;
    if (!is_hidden) seen.push_back(near[i].second);
  }
  return seen;
}

bool has_overlay(Document& document) {
  if (!document.has_mesh()) return false;
  const ViewSettings& view = document.view;
  return view.colour_bar || view.scale_bar || view.all_numbers || !view.title.empty() ||
         (view.numbers && !document.names().empty()) || !document.pointed().is_nothing();
}

Drawing draw_overlay(Document& document, const OverlayLook& look) {
  OverlayDrawer drawer(document, look);
  if (!document.has_mesh()) return drawer.take();
  const ViewSettings& view = document.view;
  const bool has_calls = document.debugger() != nullptr || document.live.is_active();
  const bool has_legend =
      view.legend && document.show_panels && has_calls && !document.legend().empty();
  drawer.reserve();
  if (has_legend) drawer.reserve_legend();
  drawer.pointed();
  if (view.numbers) drawer.names();
  if (view.all_numbers) drawer.numbers_of_seen();
  if (has_legend) drawer.legend();
  if (!view.title.empty()) drawer.title();
  if (view.colour_bar) drawer.colour_bar();
  if (view.scale_bar) drawer.scale_bar();
  drawer.triad();
  return drawer.take();
}

}  // namespace tetmend::viewer
