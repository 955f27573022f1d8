// SPDX-License-Identifier: MIT
// Colours, and maps from numbers to colours: the same in windows and on paper.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace tetmend::figure {

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

/// The same colour, `opacity` from 0 to 1.
Colour faint(Colour colour, double opacity);

/// Quiet colours of regions, one after the other; then again from the first.
std::span<const Colour> region_colours();

inline constexpr Colour kBlack{0, 0, 0, 255};
inline constexpr Colour kWhite{255, 255, 255, 255};
inline constexpr Colour kGrey{96, 100, 108, 255};  ///< of what is said beside

/// Bad tets. No map and no region has a colour close to it.
inline constexpr Colour kBadColour{222, 32, 38, 255};
inline constexpr Colour kConstraintColour{242, 160, 30, 255};
inline constexpr Colour kWorstColour{20, 120, 220, 255};  ///< of curves of the worst quality

/// What the user points at, in all views.
inline constexpr Colour kPointedColour{255, 214, 10, 255};

/// Parts of a shell, and of what a call makes of it.
inline constexpr Colour kSelectionColour{255, 196, 0, 255};
inline constexpr Colour kSupportingEdgeColour{214, 30, 150, 255};
inline constexpr Colour kSkirtColour{20, 120, 220, 255};
inline constexpr Colour kSupportingFaceColour{214, 30, 150, 90};
inline constexpr Colour kLinkEdgeColour{96, 100, 108, 150};  ///< no colour that means more
inline constexpr Colour kChordColour{0, 150, 136, 255};
inline constexpr Colour kCoreColour{235, 168, 20, 255};
inline constexpr Colour kCellColour{112, 48, 190, 255};  ///< of the tables of Algorithm 2
inline constexpr Colour kFaceToRemoveColour{112, 48, 205, 255};
inline constexpr Colour kGhostColour{100, 110, 125, 255};  ///< of the shell of a caller

}  // namespace tetmend::figure
