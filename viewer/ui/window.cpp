// SPDX-License-Identifier: MIT
#include "viewer/ui/window.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>
#include <string>

#include <epoxy/gl.h>
//
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <fmt/format.h>
#include <imgui.h>

#include "kernel/error.h"
#include "viewer/controller.h"
#include "viewer/gl/offscreen.h"
#include "viewer/gl/renderer.h"
#include "viewer/ui/interface.h"

namespace tetmend::viewer {

namespace {

/// Starts GLFW and ends it.
struct Library {
  Library() {
    if (glfwInit() == GLFW_TRUE) return;
    const char* reason = nullptr;
    glfwGetError(&reason);
    throw Error(fmt::format("cannot open a window ({}); --render and --script need none",
                            reason == nullptr ? "no reason given" : reason));
  }
  ~Library() { glfwTerminate(); }
};

/// What the screen asks for; screens of very many pixels that do not ask get it too.
float scale_of_screen(GLFWwindow* window) {
  constexpr float kUsualHeight = 1080;
  float x = 1;
  float y = 1;
  glfwGetWindowContentScale(window, &x, &y);
  const GLFWvidmode* mode = nullptr;
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) mode = glfwGetVideoMode(monitor);
  const float by_height = mode == nullptr ? 1 : static_cast<float>(mode->height) / kUsualHeight;
  return std::clamp(std::max(x, by_height), 1.0F, 3.0F);
}

class Window : public Host {
 public:
  Window(Document& document, float scale)
      : document_(document), session_{document, *this}, controller_(session_) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_SAMPLES, 4);
    window_ = glfwCreateWindow(document.window.width, document.window.height, "tetmend-view",
                               nullptr, nullptr);
    if (window_ == nullptr) throw Error("cannot open a window with OpenGL 3.3");
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    glfwSetWindowUserPointer(window_, this);
    set_callbacks();
    renderer_ = std::make_unique<gl::Renderer>();
    interface_ = std::make_unique<ui::Interface>(scale > 0 ? scale : scale_of_screen(window_));
    ImGui_ImplGlfw_InitForOpenGL(window_, true);  // calls the callbacks from above, too
  }
  ~Window() override {
    ImGui_ImplGlfw_Shutdown();
    interface_.reset();
    renderer_.reset();
    glfwDestroyWindow(window_);
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Draws only after events: a few times, because panels take their sizes from the last frame.
  /// While a run is at work it draws now and then.
  void run(bool fit) {
    constexpr int kFrames = 3;
    fit_first_ = fit && document_.has_mesh();
    while (glfwWindowShouldClose(window_) == GLFW_FALSE && !document_.quit) {
      const int frames = document_.awaits_live() ? 1 : kFrames;
      for (int i = 0; i < frames && !document_.quit; ++i) {
        frame();
        glfwSwapBuffers(window_);
        glfwPollEvents();
      }
      if (!document_.quit) wait();
    }
  }

  void arrange(Document& document) override { interface_->arrange(document); }
  Image render(Document&) override {
    frame();
    return gl::read_framebuffer(document_.window);
  }
  void set_clipboard(const std::string& text) override {
    glfwSetClipboardString(window_, text.c_str());
  }
  std::string clipboard() override {
    const char* text = glfwGetClipboardString(window_);
    if (text == nullptr) throw Error("there is no text on the clipboard");
    return text;
  }

 private:
  /// For events, or, while a trace plays, for its next step.
  void wait() {
    constexpr double kLook = 0.1;  // seconds
    Debugger* debugger = document_.debugger();
    if (debugger == nullptr || !debugger->playing) {
      played_ = glfwGetTime();
      return document_.awaits_live() ? glfwWaitEventsTimeout(kLook) : glfwWaitEvents();
    }
    constexpr double kLongest = 0.1;
    glfwWaitEventsTimeout(std::min(1 / debugger->speed, kLongest));
    const double now = glfwGetTime();
    if (debugger->advance(now - played_)) document_.show_trace();
    played_ = now;
  }

  void frame() {
    document_.follow_live();
    glfwGetFramebufferSize(window_, &document_.window.width, &document_.window.height);
    document_.window.width = std::max(document_.window.width, 1);
    document_.window.height = std::max(document_.window.height, 1);
    interface_->arrange(document_);
    if (fit_first_) document_.fit();  // for the space that the panels leave
    fit_first_ = false;
    ImGui_ImplGlfw_NewFrame();
    interface_->build(session_);
    interface_->arrange(document_);
    renderer_->draw(document_);
    interface_->draw();
  }

  static Window& self(GLFWwindow* window) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
  }
  /// What ImGui wants is known from the last frame only; the mouse may have come here since.
  bool panels_take_mouse() const {
    const glm::dvec2 at = document_.to_canvas(mouse_.x, mouse_.y);
    return ImGui::GetIO().WantCaptureMouse || at.x < 0 || at.y < 0 ||
           at.x >= document_.canvas.width || at.y >= document_.canvas.height;
  }
  static bool panels_take_keys() {
    return ImGui::GetIO().WantTextInput || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
  }

  /// Units of the window system to pixels.
  glm::dvec2 to_pixels(double x, double y) const {
    int width = 1;
    int height = 1;
    glfwGetWindowSize(window_, &width, &height);
    return {x * document_.window.width / std::max(width, 1),
            y * document_.window.height / std::max(height, 1)};
  }

  void on_button(int button, int action, int mods) {
    const glm::dvec2 at = mouse_;
    if (action == GLFW_RELEASE) {
      controller_.release(at.x, at.y, glfwGetTime());
    } else if (!panels_take_mouse()) {
      const Button which = button == GLFW_MOUSE_BUTTON_LEFT    ? Button::left
                           : button == GLFW_MOUSE_BUTTON_RIGHT ? Button::right
                                                               : Button::middle;
      controller_.press(which, at.x, at.y, (mods & GLFW_MOD_SHIFT) != 0);
    }
  }

  /// Keys without a character, and those with Ctrl; the others come as characters.
  void on_key(int key, int code, int action, int mods) {
    if (action == GLFW_RELEASE || panels_take_keys()) return;
    if (key == GLFW_KEY_ESCAPE) return controller_.key("Escape");
    constexpr std::array<std::pair<int, const char*>, 12> kNamed = {
        {{GLFW_KEY_TAB, "Tab"},
         {GLFW_KEY_RIGHT, "Right"},
         {GLFW_KEY_LEFT, "Left"},
         {GLFW_KEY_DOWN, "Down"},
         {GLFW_KEY_UP, "Up"},
         {GLFW_KEY_PAGE_DOWN, "PageDown"},
         {GLFW_KEY_PAGE_UP, "PageUp"},
         {GLFW_KEY_HOME, "Home"},
         {GLFW_KEY_END, "End"},
         {GLFW_KEY_ENTER, "Enter"},
         {GLFW_KEY_KP_ENTER, "Enter"},
         {GLFW_KEY_BACKSPACE, "Backspace"}}};
    for (const auto& named : kNamed) {
      if (key == named.first) return controller_.key(named.second);
    }
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) {
      return controller_.key(fmt::format("F{}", key - GLFW_KEY_F1 + 1));
    }
    const char* name = glfwGetKeyName(key, code);
    if ((mods & GLFW_MOD_CONTROL) == 0 || name == nullptr) return;
    controller_.key(fmt::format("Ctrl+{:c}", std::toupper(static_cast<unsigned char>(*name))));
  }

  void on_character(unsigned code) {
    constexpr unsigned kAscii = 127;
    if (code >= kAscii || panels_take_keys()) return;
    const auto c = static_cast<int>(code);
    if (c == ' ') return controller_.key("Space");
    controller_.key(fmt::format("{}{:c}", std::isupper(c) != 0 ? "Shift+" : "", std::toupper(c)));
  }

  void set_callbacks() {
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int mods) {
      self(w).on_button(button, action, mods);
    });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
      self(w).mouse_ = self(w).to_pixels(x, y);
      self(w).controller_.move(self(w).mouse_.x, self(w).mouse_.y);
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double steps) {
      const glm::dvec2 at = self(w).mouse_;
      if (!self(w).panels_take_mouse()) self(w).controller_.scroll(steps, at.x, at.y);
    });
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int code, int action, int mods) {
      self(w).on_key(key, code, action, mods);
    });
    glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned code) { self(w).on_character(code); });
    glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** files) {
      for (int i = 0; i < count; ++i) self(w).controller_.drop(files[i]);
    });
  }

  Document& document_;
  Session session_;
  Controller controller_;
  glm::dvec2 mouse_{0};  // where it was at the event at hand; GLFW tells only where it is now
  bool fit_first_ = false;
  double played_ = 0;  // when a trace was played up to where it is
  GLFWwindow* window_ = nullptr;
  std::unique_ptr<gl::Renderer> renderer_;
  std::unique_ptr<ui::Interface> interface_;
};

}  // namespace

void run_window(Document& document, float scale, bool fit) {
  const Library library;
  Window(document, scale).run(fit);
}

}  // namespace tetmend::viewer
