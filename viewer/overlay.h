// SPDX-License-Identifier: MIT
// What lies over the picture of a mesh: numbers of vertices, what is pointed at, a legend; for papers
// a colour bar, a scale bar, a title.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "figure/drawing.h"
#include "viewer/document.h"

namespace tetmend::viewer {

/// How large it is, in pixels.
struct OverlayLook {
  double scale = 1;        ///< 1 for an ordinary screen, 2 for one with twice as many pixels
  double text_size = 16;   ///< of numbers and legend
  bool has_triad = false;  ///< the directions of the axes, in a lower corner
  /// Of a text of that size, as it will be painted.
  std::function<double(const std::string&, double)> text_width =
      [](const std::string& text, double size) { return figure::text_width(text, size); };
};

/// What the view of the document asks for, in pixels of its window. Nothing without a mesh.
figure::Drawing draw_overlay(Document& document, const OverlayLook& look);
/// How far the surface has gone from its reference, a line each: "at most 0.0094", "0.61 of the
/// tolerance". Precondition: there is a reference.
std::vector<std::string> departure_in_words(Document& document);

/// draw_overlay() would draw something.
bool has_overlay(Document& document);

/// Vertices that are seen in the picture, the nearest first, at most `most`; of scenes with more
/// than 100,000 triangles fewer are looked for. Cost: for each a pass over the triangles.
std::vector<VertexHandle> seen_vertices(Document& document, std::size_t most);

/// The longest round length, in units of the file, that a scale bar of at most `most` pixels can
/// show; at the target of the camera, as a picture with perspective has no scale elsewhere.
/// Precondition: there is a mesh.
double scale_bar_length(const Document& document, double most);

}  // namespace tetmend::viewer
