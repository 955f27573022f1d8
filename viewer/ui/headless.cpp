// SPDX-License-Identifier: MIT
#include "viewer/ui/headless.h"

#include <imgui.h>

#include "viewer/gl/offscreen.h"
#include "viewer/gl/renderer.h"
#include "viewer/overlay.h"
#include "viewer/ui/interface.h"

namespace tetmend::viewer {

namespace {

class HeadlessHost : public Host {
 public:
  explicit HeadlessHost(float scale) : scale_(scale) {}

  void arrange(Document& document) override {
    if (document.show_panels || document.show_keys) prepare_interface();
    if (interface_) interface_->arrange(document);
  }

  Image render(Document& document) override {
    arrange(document);
    const gl::OffscreenPicture picture(document.window);
    const ViewSettings& view = document.view;
    const bool has_interface = document.show_panels || document.show_keys || has_overlay(document);
    if (has_interface) {
      prepare_interface();
      build_interface(document);
    }
    const bool has_alpha = view.background == Background::transparent;
    renderer_.draw(document, {scale_, has_alpha});
    if (has_interface) interface_->draw();
    return picture.read(has_alpha);
  }
  void set_clipboard(const std::string& text) override { clipboard_ = text; }
  std::string clipboard() override { return clipboard_; }

 private:
  void prepare_interface() {
    if (!interface_) interface_ = std::make_unique<ui::Interface>(scale_);
  }

  void build_interface(Document& document) {
    constexpr int kFrames = 3;  // panels take their sizes from the last frame
    prepare_interface();
    ImGui::GetIO().DisplaySize = {static_cast<float>(document.window.width),
                                  static_cast<float>(document.window.height)};
    Session session{document, *this};
    for (int i = 0; i < kFrames; ++i) {
      interface_->arrange(document);
      interface_->build(session);
    }
  }

  float scale_;
  gl::HeadlessContext context_;
  gl::Renderer renderer_;
  std::unique_ptr<ui::Interface> interface_;
  std::string clipboard_;
};

}  // namespace

std::unique_ptr<Host> make_headless_host(float scale) {
  return std::make_unique<HeadlessHost>(scale);
}

}  // namespace tetmend::viewer
