// SPDX-License-Identifier: MIT
#include "explain/outcome_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tetmend::explain {

using figure::Place;

namespace {

using Line = std::vector<Place>;
using Mark = std::vector<Line>;

Line circle(double radius) {
  constexpr unsigned kCorners = 20;
  Line line;
  for (unsigned i = 0; i <= kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    line.push_back({0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle)});
  }
  return line;
}

/// A half circle open below, the shackle of a lock.
Line shackle() {
  Line line = {{0.3, 0.5}};
  constexpr unsigned kCorners = 8;
  for (unsigned i = 0; i <= kCorners; ++i) {
    const double angle = std::numbers::pi * (1 + static_cast<double>(i) / kCorners);
    line.push_back({0.5 + 0.2 * std::cos(angle), 0.3 + 0.2 * std::sin(angle)});
  }
  line.push_back({0.7, 0.5});
  return line;
}

std::array<Mark, kOutcomeCount> make_marks() {
  std::array<Mark, kOutcomeCount> marks;
  const auto mark = [&](Outcome outcome) -> Mark& {
    return marks[static_cast<std::size_t>(outcome)];
  };
  mark(Outcome::unfinished) = {circle(0.32)};
  mark(Outcome::accepted) = {{{0.12, 0.55}, {0.4, 0.82}, {0.88, 0.2}}};
  mark(Outcome::undone) = {
      {{0.4, 0.14}, {0.12, 0.4}, {0.4, 0.66}},
      {{0.12, 0.4}, {0.64, 0.4}, {0.84, 0.5}, {0.88, 0.68}, {0.78, 0.84}, {0.5, 0.86}}};
  mark(Outcome::no_improvement) = {{{0.12, 0.5}, {0.88, 0.5}}};
  mark(Outcome::limit) = {circle(0.4), {{0.5, 0.24}, {0.5, 0.5}, {0.7, 0.6}}};
  mark(Outcome::constrained) = {{{0.18, 0.5}, {0.82, 0.5}, {0.82, 0.9}, {0.18, 0.9}, {0.18, 0.5}},
                                shackle()};
  mark(Outcome::rejected) = {{{0.18, 0.18}, {0.82, 0.82}}, {{0.82, 0.18}, {0.18, 0.82}}};
  mark(Outcome::not_applicable) = {{{0.26, 0.86}, {0.74, 0.14}}};
  mark(Outcome::deferred) = {{{0.34, 0.16}, {0.34, 0.84}}, {{0.68, 0.16}, {0.68, 0.84}}};
  return marks;
}

}  // namespace

figure::Colour outcome_colour(Outcome outcome) {
  switch (outcome) {
    case Outcome::unfinished:
      return {240, 190, 40, 255};
    case Outcome::accepted:
      return {46, 150, 84, 255};
    case Outcome::undone:
      return {124, 190, 148, 255};
    case Outcome::no_improvement:
      return {128, 136, 148, 255};
    case Outcome::limit:
      return {150, 90, 190, 255};
    case Outcome::constrained:
      return {60, 120, 200, 255};
    case Outcome::rejected:
      return {205, 110, 60, 255};
    case Outcome::not_applicable:
      return {160, 160, 120, 255};
    case Outcome::deferred:
      return {30, 150, 165, 255};
  }
  return {};
}

std::span<const std::vector<Place>> outcome_mark(Outcome outcome) {
  static const std::array<Mark, kOutcomeCount> kMarks = make_marks();
  return kMarks[static_cast<std::size_t>(outcome)];
}

void add_mark(figure::Drawing& drawing, Outcome outcome, Place corner, double side) {
  constexpr double kPen = 0.17;  // of the side
  for (const std::vector<Place>& line : outcome_mark(outcome)) {
    figure::Stroke stroke{{}, {outcome_colour(outcome), kPen * side}};
    for (const Place& at : line) {
      stroke.places.push_back({corner.x + side * at.x, corner.y + side * at.y});
    }
    drawing.add(std::move(stroke));
  }
}

void add_hatching(figure::Drawing& drawing, Place corner, double width, double height) {
  const figure::Pen pen{{255, 255, 255, 190}, 0.12 * height};
  for (double from = -height; from < width; from += 0.7 * height) {
    const double begin = std::max(from, 0.0);
    const double end = std::min(from + height, width);
    if (end <= begin) continue;
    drawing.line({corner.x + begin, corner.y + height - (begin - from)},
                 {corner.x + end, corner.y + height - (end - from)}, pen);
  }
}

void add_shares(figure::Drawing& drawing, std::span<const std::uint32_t, kOutcomeCount> ended,
                Place corner, double width, double height) {
  double all = 0;
  for (const std::uint32_t count : ended) all += count;
  double y = corner.y;
  for (std::size_t i = 0; i < kOutcomeCount; ++i) {
    if (ended[i] == 0) continue;
    const double part = height * ended[i] / all;
    drawing.rectangle({corner.x, y}, width, part, outcome_colour(static_cast<Outcome>(i)));
    y += part;
  }
}

}  // namespace tetmend::explain
