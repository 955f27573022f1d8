// SPDX-License-Identifier: MIT
#include "viewer/gl/offscreen.h"

#include <algorithm>

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include "kernel/error.h"

namespace tetmend::viewer::gl {

namespace {

constexpr GLsizei kSamples = 4;

[[noreturn]] void fail(const char* step) {
  throw Error(
      fmt::format("cannot draw without a display: EGL refuses {} (0x{:x}); it needs Mesa "
                  "or another driver with surfaceless contexts",
                  step, eglGetError()));
}

/// As PNG files have it.
void divide_by_alpha(Colour& pixel) {
  if (pixel.alpha == 0 || pixel.alpha == 255) return;
  const auto divided = [&](std::uint8_t x) {
    return static_cast<std::uint8_t>(std::min(255, (255 * x + pixel.alpha / 2) / pixel.alpha));
  };
  pixel.red = divided(pixel.red);
  pixel.green = divided(pixel.green);
  pixel.blue = divided(pixel.blue);
}

[[noreturn]] void fail_without_egl(const char* reason) {
  throw Error(
      fmt::format("cannot draw without a display: {}; install libegl1 and "
                  "libgl1-mesa-dri, or another driver",
                  reason));
}

}  // namespace

HeadlessContext::HeadlessContext() {
  // A function that no library has would end the program.
  if (!epoxy_has_egl()) fail_without_egl("there is no libEGL");
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base") ||
      !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    fail_without_egl("no driver of EGL offers contexts without a surface");
  }
  display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display_ == EGL_NO_DISPLAY) fail("a display");
  if (eglInitialize(display_, nullptr, nullptr) == EGL_FALSE) fail("to start");
  eglBindAPI(EGL_OPENGL_API);
  constexpr EGLint kConfig[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
  constexpr EGLint kContext[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 3,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 3,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglChooseConfig(display_, kConfig, &config, 1, &count) == EGL_FALSE || count == 0) {
    fail("a configuration");
  }
  context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, kContext);
  if (context_ == EGL_NO_CONTEXT) fail("an OpenGL 3.3 context");
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
    fail("a context without surface");
  }
}

HeadlessContext::~HeadlessContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

OffscreenPicture::OffscreenPicture(const Canvas& size) : size_(size) {
  glGenFramebuffers(1, &frame_);
  glGenFramebuffers(1, &plain_frame_);
  glGenRenderbuffers(2, buffers_);
  glGenRenderbuffers(1, &plain_colour_);

  glBindRenderbuffer(GL_RENDERBUFFER, plain_colour_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, size.width, size.height);
  glBindFramebuffer(GL_FRAMEBUFFER, plain_frame_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, plain_colour_);

  glBindRenderbuffer(GL_RENDERBUFFER, buffers_[0]);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, kSamples, GL_RGBA8, size.width, size.height);
  glBindRenderbuffer(GL_RENDERBUFFER, buffers_[1]);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, kSamples, GL_DEPTH_COMPONENT24, size.width,
                                   size.height);
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers_[0]);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers_[1]);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw Error(fmt::format("the graphics driver cannot make a picture of {} x {} pixels",
                            size.width, size.height));
  }
}

OffscreenPicture::~OffscreenPicture() {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDeleteFramebuffers(1, &frame_);
  glDeleteFramebuffers(1, &plain_frame_);
  glDeleteRenderbuffers(2, buffers_);
  glDeleteRenderbuffers(1, &plain_colour_);
}

Image OffscreenPicture::read(bool has_alpha) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, frame_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, plain_frame_);
  glBlitFramebuffer(0, 0, size_.width, size_.height, 0, 0, size_.width, size_.height,
                    GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, plain_frame_);
  Image image = read_framebuffer(size_, has_alpha);
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  return image;
}

Image read_framebuffer(const Canvas& size, bool has_alpha) {
  Image image{size.width, size.height, {}};
  const auto width = static_cast<std::size_t>(size.width);
  image.pixels.resize(width * static_cast<std::size_t>(size.height));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE, image.pixels.data());
  const auto row = [&](int y) {
    return image.pixels.begin() + static_cast<std::ptrdiff_t>(width) * y;
  };
  for (int y = 0; y < size.height / 2; ++y) {
    std::swap_ranges(row(y), row(y + 1), row(size.height - 1 - y));
  }
  for (Colour& pixel : image.pixels) {
    if (has_alpha) {
      divide_by_alpha(pixel);
    } else {
      pixel.alpha = 255;
    }
  }
  return image;
}

}  // namespace tetmend::viewer::gl
