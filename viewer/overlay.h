// SPDX-License-Identifier: MIT
// What a picture for a paper has on top of the mesh: colour bar, scale bar, title.
#pragma once

#include "figure/drawing.h"
#include "viewer/document.h"

namespace tetmend::viewer {

/// What the view of the document asks for, in pixels of its window. `scale`: 1 for an ordinary
/// screen, 2 for one with twice as many pixels in the same place. Nothing without a mesh.
figure::Drawing draw_overlay(Document& document, double scale);

/// The longest round length, in units of the file, that a scale bar of at most `most` pixels can
/// show; at the target of the camera, as a picture with perspective has no scale elsewhere.
/// Precondition: there is a mesh.
double scale_bar_length(const Document& document, double most);

}  // namespace tetmend::viewer
