// SPDX-License-Identifier: MIT
// Colours of numbers and of region labels.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "kernel/mesh_data.h"

namespace tetmend::viewer {

struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  std::uint8_t alpha = 255;
  friend bool operator==(const Colour&, const Colour&) = default;
};

/// A smooth map from [0, 1] to colours, worst first. Stops are evenly spaced.
struct ColourMap {
  std::string_view name;
  std::string_view help;
  std::span<const Colour> stops;

  /// Values outside [0, 1] and not-a-number take the colour of the nearer end, or of 0.
  Colour at(double t) const;
};

/// All maps; the first is the default.
std::span<const ColourMap> colour_maps();
/// @throws Error for an unknown name, with the valid ones.
const ColourMap& find_colour_map(std::string_view name);

/// A quiet colour for each label; the same for equal labels, different for neighbours in number.
Colour region_colour(Label label);

/// Bad tets. No map and no region has a colour close to it.
inline constexpr Colour kBadColour{222, 32, 38, 255};
inline constexpr Colour kConstraintColour{242, 160, 30, 255};

}  // namespace tetmend::viewer
