// SPDX-License-Identifier: MIT
// Draws the scene of a document into the current framebuffer.
#pragma once

#include <array>
#include <cstdint>

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

/// The triangles of a scene on the graphics card.
class SceneBuffers {
 public:
  SceneBuffers();

  /// Writes what is another since the last call.
  void follow(const Scene& scene);
  std::uint64_t number() const { return number_; }
  const Buffer& surface() const { return buffers_[0]; }
  const Buffer& through() const { return buffers_[1]; }
  const Buffer& ghosts() const { return buffers_[2]; }

 private:
  std::array<Buffer, 3> buffers_;
  std::array<std::size_t, 3> seen_{};  // of Scene::rewritten
  std::uint64_t number_ = 0;           // of the scene
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
  void draw_outline(const Document& document, const glm::mat4& view, const glm::mat4& projection);
  void draw_lines(const Document& document, const glm::mat4& view, const glm::mat4& projection,
                  float scale);
  void draw_surface(const Buffer& buffer, float opacity, float edges) const;
  void draw_once_per_pixel(const Buffer& buffer, float opacity, float edges) const;

  Program background_;
  Program surface_;
  Program outline_;
  Program lines_;
  Buffer nothing_;
  SceneBuffers whole_, isolated_;  // a trace has both in turn
  SceneBuffers around_;            // the outline of the mesh
  Buffer highlight_vertices_;
  Buffer highlight_lines_;
  const SceneBuffers* scene_ = nullptr;  // what is drawn
  bool has_outline_ = false;             // around it
  unsigned highlight_revision_ = 0;
};

}  // namespace tetmend::viewer::gl
