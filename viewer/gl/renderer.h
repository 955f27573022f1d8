// SPDX-License-Identifier: MIT
// Draws the scene of a document into the current framebuffer.
#pragma once

#include "viewer/document.h"
#include "viewer/gl/program.h"

namespace tetmend::viewer::gl {

/// Needs a current OpenGL 3.3 core context for its whole life.
class Renderer {
 public:
  Renderer();

  /// Fills the canvas of the document, and clears the rest of its window. Uploads what has changed
  /// since the last call. Leaves blending and depth test off.
  void draw(Document& document);

 private:
  void upload(Document& document);
  void draw_background(const Document& document) const;
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
