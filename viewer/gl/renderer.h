// SPDX-License-Identifier: MIT
// Draws the scene of a document into the current framebuffer.
#pragma once

#include "viewer/document.h"
#include "viewer/gl/program.h"

namespace tetmend::viewer::gl {

/// What a picture is drawn for.
struct Surface {
  /// Pixels of a unit of length on a screen: what lines of width 1 take.
  float scale = 1;
  /// Where nothing is drawn, alpha is 0, if the view asks for that. Colours are then multiplied by
  /// alpha. Otherwise a transparent background is white.
  bool has_alpha = false;
};

/// Needs a current OpenGL 3.3 core context for its whole life.
class Renderer {
 public:
  Renderer();

  /// Fills the canvas of the document, and clears the rest of its window. Uploads what has changed
  /// since the last call. Leaves blending and depth test off.
  void draw(Document& document, const Surface& surface);

 private:
  void upload(Document& document);
  void draw_background(const Document& document, bool is_clear) const;
  void draw_lines(const Document& document, const glm::mat4& view, const glm::mat4& projection,
                  float scale);
  void draw_surface(const Buffer& buffer, float opacity, float edges) const;
  void draw_once_per_pixel(const Buffer& buffer, float opacity, float edges) const;

  Program background_;
  Program surface_;
  Program lines_;
  Buffer nothing_;
  Buffer surface_vertices_;
  Buffer through_vertices_;
  Buffer ghost_vertices_;
  Buffer highlight_vertices_;
  Buffer highlight_lines_;
  unsigned scene_revision_ = 0;
  unsigned highlight_revision_ = 0;
};

}  // namespace tetmend::viewer::gl
