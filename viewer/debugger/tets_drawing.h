// SPDX-License-Identifier: MIT
// Small heaps of tets as drawings without depth.
#pragma once

#include <optional>
#include <span>

#include "explain/call_study.h"
#include "explain/figures/linked_drawing.h"
#include "viewer/debugger/explained.h"
#include "viewer/mesh/camera.h"
#include "viewer/mesh/colour_map.h"

namespace tetmend::viewer {

/// A square of a drawing.
struct Square {
  figure::Place middle;
  double half = 1;  ///< of its side
};

/// Tets, drawn apart a little, as the camera sees them; the ball fills the square. Bad ones red,
/// the others by quality. `opacity` from 0 to 1.
LinkedDrawing draw_tets(std::span<const LocalTet> tets, const Camera& camera, const Ball& ball,
                        const Square& square, const ColourMap& map, double opacity);

/// Ball around the corners of the tets; nothing without tets.
std::optional<Ball> ball_around(std::span<const LocalTet> tets);
/// Of a call, before and after.
std::optional<Ball> ball_around(const CallStudy& study);

}  // namespace tetmend::viewer
