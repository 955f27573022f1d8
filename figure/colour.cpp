// SPDX-License-Identifier: MIT
#include "figure/colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/error.h"

namespace tetmend::figure {

namespace {

// Even steps of lightness; colour-blind readers tell the ends apart.
constexpr std::array<Colour, 7> kEmber = {{{122, 24, 70},
                                           {196, 58, 62},
                                           {238, 124, 60},
                                           {250, 196, 104},
                                           {206, 222, 158},
                                           {112, 182, 180},
                                           {48, 112, 164}}};
constexpr std::array<Colour, 6> kDusk = {
    {{52, 20, 84}, {70, 66, 140}, {48, 116, 144}, {46, 160, 132}, {124, 202, 90}, {246, 228, 62}}};
constexpr std::array<Colour, 2> kDarkToLight = {{{40, 40, 44}, {236, 236, 240}}};

constexpr std::array<ColourMap, 3> kMaps = {
    {{"ember", "dark red for the worst, blue for the best", kEmber},
     {"dusk", "violet to yellow", kDusk},
     {"grey", "dark to light", kDarkToLight}}};

std::uint8_t mix(std::uint8_t a, std::uint8_t b, double t) {
  return static_cast<std::uint8_t>(std::lround((1 - t) * a + t * b));
}

}  // namespace

Colour ColourMap::at(double t) const {
  if (!(t > 0)) return stops.front();
  if (t >= 1) return stops.back();
  const double x = t * static_cast<double>(stops.size() - 1);
  const auto i = static_cast<std::size_t>(x);
  const double f = x - static_cast<double>(i);
  const Colour& a = stops[i];
  const Colour& b = stops[i + 1];
  return {mix(a.red, b.red, f), mix(a.green, b.green, f), mix(a.blue, b.blue, f)};
}

std::span<const ColourMap> colour_maps() {
  return kMaps;
}

const ColourMap& find_colour_map(std::string_view name) {
  std::vector<std::string_view> names;
  for (const ColourMap& map : kMaps) {
    if (map.name == name) return map;
    names.push_back(map.name);
  }
  throw Error(
      fmt::format("there is no colour map '{}': expected one of {}", name, fmt::join(names, ", ")));
}

std::span<const Colour> region_colours() {
  static constexpr std::array<Colour, 8> kRegions = {{{196, 206, 218},
                                                      {226, 206, 158},
                                                      {156, 196, 178},
                                                      {188, 176, 214},
                                                      {212, 220, 150},
                                                      {150, 190, 214},
                                                      {222, 190, 204},
                                                      {178, 178, 168}}};
  return kRegions;
}

Colour faint(Colour colour, double opacity) {
  colour.alpha = static_cast<std::uint8_t>(std::lround(255 * std::clamp(opacity, 0.0, 1.0)));
  return colour;
}

}  // namespace tetmend::figure
