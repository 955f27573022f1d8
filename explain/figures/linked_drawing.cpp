// SPDX-License-Identifier: MIT
#include "explain/figures/linked_drawing.h"

#include <cmath>
#include <utility>

namespace tetmend::explain {

using figure::Area;
using figure::Place;
using figure::Stroke;
using figure::Text;

namespace {

bool is_at(const Text& text, const Place& place, double reach) {
  const figure::Box box = figure::box_of(text);
  const double x = (box.left + box.right) / 2;
  const double y = (box.top + box.bottom) / 2;
  return std::hypot(x - place.x, y - place.y) < reach;
}

bool is_at(const Stroke& stroke, const Place& place, double reach) {
  constexpr double kEnd = 0.05;  // of its length
  for (std::size_t i = 0; i + 1 < stroke.places.size(); ++i) {
    const Place& a = stroke.places[i];
    const Place& b = stroke.places[i + 1];
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double length = std::hypot(dx, dy);
    if (!(length > 0)) continue;
    const double along = ((place.x - a.x) * dx + (place.y - a.y) * dy) / (length * length);
    const double away = std::abs((place.x - a.x) * dy - (place.y - a.y) * dx) / length;
    if (along > kEnd && along < 1 - kEnd && away < reach) return true;
  }
  return false;
}

bool is_at(const Area& area, const Place& place) {
  bool is_left = false;
  bool is_right = false;
  for (std::size_t i = 0; i < area.corners.size(); ++i) {
    const Place& a = area.corners[i];
    const Place& b = area.corners[(i + 1) % area.corners.size()];
    const double side = (b.x - a.x) * (place.y - a.y) - (b.y - a.y) * (place.x - a.x);
    (side < 0 ? is_left : is_right) = true;
  }
  return is_left != is_right;
}

}  // namespace

void LinkedDrawing::add(figure::Shape shape, Meaning meaning) {
  drawing.add(std::move(shape));
  meanings.push_back(std::move(meaning));
}

const Meaning* meaning_at(const LinkedDrawing& drawing, const Place& place, double reach) {
  const Meaning* word = nullptr;
  const Meaning* line = nullptr;
  const Meaning* area = nullptr;
  for (std::size_t i = 0; i < drawing.meanings.size(); ++i) {
    const Meaning& meaning = drawing.meanings[i];
    if (meaning.is_nothing()) continue;
    const figure::Shape& shape = drawing.drawing.shapes[i];
    if (const auto* text = std::get_if<Text>(&shape)) {
      if (word == nullptr && is_at(*text, place, reach)) word = &meaning;
    } else if (const auto* stroke = std::get_if<Stroke>(&shape)) {
      if (line == nullptr && is_at(*stroke, place, reach / 2)) line = &meaning;
    } else if (const auto* polygon = std::get_if<Area>(&shape)) {
      if (is_at(*polygon, place)) area = &meaning;
    }
  }
  return word != nullptr ? word : line != nullptr ? line : area;
}

}  // namespace tetmend::explain
