// SPDX-License-Identifier: MIT
// Colours as the viewer speaks of them, and those of region labels.
#pragma once

#include "figure/colour.h"
#include "kernel/mesh_data.h"

namespace tetmend::viewer {

using figure::Colour;
using figure::colour_maps;
using figure::ColourMap;
using figure::faint;
using figure::find_colour_map;
using figure::kBadColour;
using figure::kCellColour;
using figure::kChordColour;
using figure::kConstraintColour;
using figure::kCoreColour;
using figure::kLinkEdgeColour;
using figure::kPointedColour;
using figure::kSelectionColour;
using figure::kSkirtColour;
using figure::kSupportingEdgeColour;
using figure::kSupportingFaceColour;
using figure::kWorstColour;

/// The surface that this one is compared with; faces that are as they were there; and what is no
/// surface beside them.
inline constexpr Colour kReferenceColour{140, 70, 190, 255};
inline constexpr Colour kUnchangedColour{206, 209, 214, 255};
inline constexpr Colour kInsideColour{150, 153, 160, 255};

/// A quiet colour for each label; the same for equal labels, different for neighbours in number.
Colour region_colour(Label label);

}  // namespace tetmend::viewer
