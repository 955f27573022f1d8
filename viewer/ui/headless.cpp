// SPDX-License-Identifier: MIT
#include "viewer/ui/headless.h"

#include "viewer/gl/offscreen.h"
#include "viewer/gl/renderer.h"

namespace tetmend::viewer {

namespace {

class HeadlessHost : public Host {
 public:
  Image render(Document& document) override {
    const gl::OffscreenPicture picture(document.window);
    renderer_.draw(document);
    return picture.read();
  }
  void set_clipboard(const std::string& text) override { clipboard_ = text; }
  std::string clipboard() override { return clipboard_; }

 private:
  gl::HeadlessContext context_;
  gl::Renderer renderer_;
  std::string clipboard_;
};

}  // namespace

std::unique_ptr<Host> make_headless_host() {
  return std::make_unique<HeadlessHost>();
}

}  // namespace tetmend::viewer
