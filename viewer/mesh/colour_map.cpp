// SPDX-License-Identifier: MIT
#include "viewer/mesh/colour_map.h"

#include <array>

namespace tetmend::viewer {

Colour region_colour(Label label) {
  constexpr std::array<Colour, 8> kRegions = {{{196, 206, 218},
                                               {226, 206, 158},
                                               {156, 196, 178},
                                               {188, 176, 214},
                                               {212, 220, 150},
                                               {150, 190, 214},
                                               {222, 190, 204},
                                               {178, 178, 168}}};
  const auto n = static_cast<std::uint32_t>(label) - 1U;  // most files count from 1
  return kRegions[n % kRegions.size()];
}

}  // namespace tetmend::viewer
