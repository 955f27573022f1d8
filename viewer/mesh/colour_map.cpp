// SPDX-License-Identifier: MIT
#include "viewer/mesh/colour_map.h"

namespace tetmend::viewer {

Colour region_colour(Label label) {
  const auto n = static_cast<std::uint32_t>(label) - 1U;  // most files count from 1
  const auto colours = figure::region_colours();
  return colours[n % colours.size()];
}

}  // namespace tetmend::viewer
