// SPDX-License-Identifier: MIT
#include "viewer/gl/renderer.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "viewer/gl/shaders.h"

namespace tetmend::viewer::gl {

namespace {

// Parts of the depth buffer: what lies in a nearer part is in front of all that lies further.
constexpr double kHighlightDepth = 0.1;
constexpr double kThroughDepth = 0.3;

constexpr glm::vec3 kPaper{1, 1, 1};

struct Look {
  glm::vec3 low;
  glm::vec3 high;
  glm::vec3 edge;
};

Look look_of(const ViewSettings& view) {
  if (view.background != Background::gradient) return {kPaper, kPaper, {0.16F, 0.19F, 0.24F}};
  if (view.theme == "dark")
    return {{0.10F, 0.11F, 0.13F}, {0.17F, 0.19F, 0.22F}, {0.06F, 0.07F, 0.09F}};
  return {{0.89F, 0.91F, 0.94F}, {0.985F, 0.988F, 0.992F}, {0.16F, 0.19F, 0.24F}};
}

std::initializer_list<Attribute> surface_attributes() {
  static constexpr std::initializer_list<Attribute> kAttributes = {
      {3, GL_FLOAT, GL_FALSE, false, offsetof(SurfaceVertex, position)},
      {4, GL_UNSIGNED_BYTE, GL_TRUE, false, offsetof(SurfaceVertex, colour)},
      {3, GL_BYTE, GL_TRUE, false, offsetof(SurfaceVertex, normal)},
      {1, GL_UNSIGNED_BYTE, GL_FALSE, true, offsetof(SurfaceVertex, edges)}};
  return kAttributes;
}

}  // namespace

SceneBuffers::SceneBuffers()
    : buffers_{Buffer(sizeof(SurfaceVertex), surface_attributes(), false),
               Buffer(sizeof(SurfaceVertex), surface_attributes(), false),
               Buffer(sizeof(SurfaceVertex), surface_attributes(), false)} {}

void SceneBuffers::follow(const Scene& scene) {
  const std::array<const std::vector<SurfaceVertex>*, 3> lists = {&scene.surface, &scene.through,
                                                                  &scene.ghosts};
  for (std::size_t i = 0; i < lists.size(); ++i) {
    const std::vector<SurfaceVertex>& vertices = *lists[i];
    if (scene.number != number_ || !buffers_[i].resize(vertices.size())) {
      buffers_[i].fill_with_room(vertices.data(), vertices.size());
      seen_[i] = scene.rewritten[i].size();
      continue;
    }
    std::vector<std::uint32_t> triangles(
        scene.rewritten[i].begin() + static_cast<std::ptrdiff_t>(seen_[i]),
        scene.rewritten[i].end());
    seen_[i] = scene.rewritten[i].size();
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    for (std::size_t k = 0; k < triangles.size();) {  // those in a row at once
      std::size_t end = k + 1;
      while (end < triangles.size() && triangles[end] == triangles[end - 1] + 1) ++end;
      const std::size_t first =
          std::min<std::size_t>(3 * std::size_t{triangles[k]}, vertices.size());
      const std::size_t last = std::min(3 * (std::size_t{triangles[end - 1]} + 1), vertices.size());
      buffers_[i].rewrite(vertices.data(), first, last - first);
      k = end;
    }
  }
  number_ = scene.number;
}

Renderer::Renderer()
    : background_(kBackgroundVertex, kBackgroundFragment),
      surface_(kSurfaceVertex, kSurfaceFragment),
      outline_(kSurfaceVertex, kOutlineFragment),
      lines_(kLineVertex, kLineFragment),
      nothing_(0, {}, false),
      highlight_vertices_(sizeof(SurfaceVertex), surface_attributes(), false),
      highlight_lines_(sizeof(Line),
                       {{3, GL_FLOAT, GL_FALSE, false, offsetof(Line, from)},
                        {3, GL_FLOAT, GL_FALSE, false, offsetof(Line, to)},
                        {4, GL_UNSIGNED_BYTE, GL_TRUE, false, offsetof(Line, colour)},
                        {1, GL_FLOAT, GL_FALSE, false, offsetof(Line, width)}},
                       true) {}

void Renderer::upload(Document& document) {
  const Scene& scene = document.scene();
  SceneBuffers& buffers = document.is_isolated() ? isolated_ : whole_;
  buffers.follow(scene);
  scene_ = &buffers;
  const Scene* outline = document.outline();
  has_outline_ = outline != nullptr;
  if (has_outline_) around_.follow(*outline);
  if (document.highlight_revision() != highlight_revision_) {
    highlight_revision_ = document.highlight_revision();
    const Highlight& shown = document.highlighted();
    highlight_vertices_.fill(shown.faces.data(), shown.faces.size());
    highlight_lines_.fill(shown.lines.data(), shown.lines.size());
  }
}

void Renderer::draw_background(const Document& document, bool is_clear) const {
  if (is_clear) {
    glClearColor(0, 0, 0, 0);
    return glClear(GL_COLOR_BUFFER_BIT);
  }
  const Look look = look_of(document.view);
  background_.use();
  background_.set("low", look.low);
  background_.set("high", look.high);
  nothing_.bind();
  glDepthMask(GL_FALSE);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthMask(GL_TRUE);
}

void Renderer::draw_surface(const Buffer& buffer, float opacity, float edges) const {
  surface_.set("opacity", opacity);
  surface_.set("edges", edges);
  buffer.bind();
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(buffer.count()));
}

/// Blends the nearest triangle at each pixel and no other.
void Renderer::draw_once_per_pixel(const Buffer& buffer, float opacity, float edges) const {
  if (buffer.count() == 0) return;
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw_surface(buffer, opacity, edges);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthFunc(GL_EQUAL);
  glEnable(GL_BLEND);
  draw_surface(buffer, opacity, edges);
  glDisable(GL_BLEND);
  glDepthFunc(GL_LESS);
}

/// Before all else of the mesh, so that it tints nothing that is shown.
void Renderer::draw_outline(const Document& document, const glm::mat4& view,
                            const glm::mat4& projection) {
  constexpr glm::vec3 kOnLight{0.30F, 0.38F, 0.50F};
  constexpr glm::vec3 kOnDark{0.62F, 0.70F, 0.82F};
  const ViewSettings& settings = document.view;
  const bool on_dark = settings.theme == "dark" && settings.background == Background::gradient;
  outline_.use();
  outline_.set("view", view);
  outline_.set("projection", projection);
  outline_.set("tint", on_dark ? kOnDark : kOnLight);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  around_.surface().bind();
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(around_.surface().count()));
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
}

void Renderer::draw_lines(const Document& document, const glm::mat4& view,
                          const glm::mat4& projection, float scale) {
  lines_.use();
  lines_.set("view", view);
  lines_.set("projection", projection);
  lines_.set("canvas", glm::vec2(document.canvas.width, document.canvas.height));
  lines_.set("scale", scale);
  highlight_lines_.bind();
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(highlight_lines_.count()));
}

void Renderer::draw(Document& document, const Surface& surface) {
  upload(document);
  const Canvas& canvas = document.canvas;
  const Look look = look_of(document.view);
  glDisable(GL_SCISSOR_TEST);
  glClearColor(look.high.x, look.high.y, look.high.z, 1);  // under the panels
  glClear(GL_COLOR_BUFFER_BIT);
  // OpenGL counts rows from below.
  const int bottom = document.window.height - document.canvas_corner.y - canvas.height;
  glViewport(document.canvas_corner.x, bottom, canvas.width, canvas.height);
  glEnable(GL_SCISSOR_TEST);
  glScissor(document.canvas_corner.x, bottom, canvas.width, canvas.height);
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glClear(GL_DEPTH_BUFFER_BIT);
  draw_background(document,
                  surface.has_alpha && document.view.background == Background::transparent);

  const glm::mat4 view(document.view.camera.view(document.ball().centre));
  const glm::mat4 projection(document.view.camera.projection(canvas, document.ball()));
  if (has_outline_) draw_outline(document, view, projection);
  surface_.use();
  surface_.set("view", view);
  surface_.set("projection", projection);
  surface_.set("edge_tint", look.edge);
  surface_.set("line_width", 0.6F * surface.scale);
  surface_.set("scale", surface.scale);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthRange(kThroughDepth, 1);
  draw_surface(scene_->surface(), 1, document.view.edges ? 0.75F : 0.0F);
  glDepthMask(GL_FALSE);
  glEnable(GL_BLEND);
  glEnable(GL_CULL_FACE);
  if (document.view.scene.reference > 0) {  // most of it lies on the surface itself
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1, 1);
  }
  draw_surface(scene_->ghosts(), 1, document.view.edges ? 0.5F : 0.0F);
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);

  glDepthRange(kHighlightDepth, kThroughDepth);
  // Over the colours of a measure red must stay faint.
  const bool is_plain = document.view.scene.colour == "region";
  draw_once_per_pixel(scene_->through(), is_plain ? 1.0F : 0.4F, 0.25F);
  glDisable(GL_CULL_FACE);

  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  draw_surface(highlight_vertices_, 1, 0);
  draw_lines(document, view, projection, surface.scale);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glDepthRange(0, 1);
  glBindVertexArray(0);
}

}  // namespace tetmend::viewer::gl
