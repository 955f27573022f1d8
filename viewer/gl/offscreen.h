// SPDX-License-Identifier: MIT
// OpenGL without a display: a context of EGL that belongs to no window, and a picture to draw into.
#pragma once

#include "viewer/mesh/camera.h"
#include "viewer/mesh/image.h"

namespace tetmend::viewer::gl {

/// An OpenGL 3.3 core context, current in this thread for its whole life.
class HeadlessContext {
 public:
  /// @throws Error when there is no EGL that works without a window.
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
};

/// A framebuffer with smooth edges. Current while it lives.
class OffscreenPicture {
 public:
  /// @throws Error when the driver cannot make one of this size.
  explicit OffscreenPicture(const Canvas& size);
  ~OffscreenPicture();
  OffscreenPicture(const OffscreenPicture&) = delete;
  OffscreenPicture& operator=(const OffscreenPicture&) = delete;

  /// @param has_alpha colours are multiplied by alpha, see Surface; without it all is opaque
  Image read(bool has_alpha = false) const;

 private:
  Canvas size_;
  unsigned frame_ = 0;
  unsigned buffers_[2] = {0, 0};  // colour, depth
  unsigned plain_frame_ = 0;
  unsigned plain_colour_ = 0;
};

/// What the framebuffer that is current holds.
Image read_framebuffer(const Canvas& size, bool has_alpha = false);

}  // namespace tetmend::viewer::gl
