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
using figure::kChordColour;
using figure::kConstraintColour;
using figure::kCoreColour;
using figure::kLinkFaceColour;
using figure::kPointedColour;
using figure::kSelectionColour;
using figure::kSkirtColour;
using figure::kSupportingEdgeColour;
using figure::kSupportingFaceColour;
using figure::kWorstColour;

/// A quiet colour for each label; the same for equal labels, different for neighbours in number.
Colour region_colour(Label label);

}  // namespace tetmend::viewer
