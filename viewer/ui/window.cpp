// SPDX-License-Identifier: MIT
#include "viewer/ui/window.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include <epoxy/gl.h>
//
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <fmt/format.h>
#include <imgui.h>

#include "kernel/error.h"
#include "viewer/commands/controller.h"
#include "viewer/gl/offscreen.h"
#include "viewer/gl/renderer.h"
#include "viewer/ui/interface.h"
#include "viewer/ui/remembered.h"

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
    constexpr bool kWithCallbacks = false;  // those of below call them
    ImGui_ImplGlfw_InitForOpenGL(window_, kWithCallbacks);
  }
  ~Window() override {
    ImGui_ImplGlfw_Shutdown();
    interface_.reset();
    renderer_.reset();
    glfwDestroyWindow(window_);
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Draws only after events. While a run is at work it draws now and then.
  void run(const Then& then) {
    while (document_.opening() != nullptr && !document_.quit) wait_for_file();
    if (document_.quit) return;
    fit_first_ = then(document_) && document_.has_mesh();
    while (!document_.quit) {
      if (glfwWindowShouldClose(window_) == GLFW_TRUE) {
        glfwSetWindowShouldClose(window_, GLFW_FALSE);
        run_from_window(find_command("quit"), session_);
      }
      guarded(document_, [&] {
        while (document_.opening() != nullptr && !document_.quit) wait_for_file();
      });
      deliver_inputs();
      if (document_.quit) break;
      frame();
      tell_title();
      glfwSwapBuffers(window_);
      if (!inputs_.empty()) continue;
      keep_view();
      wait();
    }
  }

  void arrange(Document& document) override { interface_->arrange(document); }
  Image render(Document&) override {
    frame();
    if (document_.view.background != Background::transparent) {
      return gl::read_framebuffer(document_.window);
    }
    const gl::OffscreenPicture picture(document_.window);  // a window has no alpha
    constexpr bool kHasAlpha = true;
    renderer_->draw(document_, {interface_->scale(), kHasAlpha});
    interface_->draw();
    return picture.read(kHasAlpha);
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
  /// Shows a bar. What is typed meanwhile is for the file that comes; the window can be closed.
  void wait_for_file() {
    constexpr double kLook = 0.05;  // seconds
    frame();
    glfwSwapBuffers(window_);
    glfwPollEvents();
    if (glfwWindowShouldClose(window_) == GLFW_TRUE) document_.quit = true;
    document_.follow_opening(kLook);
  }

  /// For undo: not in the middle of a drag.
  void keep_view() {
    const bool is_held = std::find(buttons_.begin(), buttons_.end(), true) != buttons_.end();
    if (!is_held && !ImGui::IsAnyItemActive()) document_.keep_view();
  }

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
    guarded(document_, [&] {
      if (debugger->advance(now - played_)) document_.show_trace();
    });
    played_ = now;
  }

  /// Drawing may take longer than a user takes to click and type. So what comes meanwhile waits,
  /// and panels see one button and one key at a time: they decide by the last layout whose it is.
  void deliver_inputs() {
    while (!inputs_.empty() && !document_.quit && document_.opening() == nullptr) {
      const Input input = std::move(inputs_.front());
      inputs_.pop_front();
      if (input.is_button) lay_out();  // for the place of the mouse
      const bool is_for_panels = input.is_button || panels_take_keys();
      const bool showed_keys = document_.show_keys;
      guarded(document_, input.deliver);
      if (is_for_panels) lay_out();
      // The next key may be the answer, however soon it comes.
      const bool has_field = document_.show_keys && !showed_keys;
      if (document_.question != FileQuestion::none || document_.waiting || has_field) settle();
    }
  }

  void lay_out() {
    // A question is asked of what is shown; and no panel may come up behind its window.
    const bool asks = document_.waiting || document_.question != FileQuestion::none;
    if (!asks) guarded(document_, [&] { document_.follow_live(); });
    glfwGetFramebufferSize(window_, &document_.window.width, &document_.window.height);
    document_.window.width = std::max(document_.window.width, 1);
    document_.window.height = std::max(document_.window.height, 1);
    interface_->arrange(document_);
    if (fit_first_) document_.fit();  // for the space that the panels leave
    fit_first_ = false;
    ImGui_ImplGlfw_NewFrame();
    tell_mouse();
    interface_->build(session_);
    interface_->arrange(document_);
  }

  void tell_title() {
    std::string title = document_.title();
    if (title == title_) return;
    title_ = std::move(title);
    glfwSetWindowTitle(window_, title_.c_str());
  }

  /// Panels take their sizes from the last layout, and dialogs the keys from the one before.
  void settle() {
    constexpr int kLayouts = 3;
    for (int i = 0; i < kLayouts; ++i) lay_out();
  }

  void frame() {
    settle();
    guarded(document_, [&] { renderer_->draw(document_, {interface_->scale(), false}); });
    interface_->draw();
  }

  /// As it was at the input at hand; the backend of ImGui tells how it is now.
  void tell_mouse() const {
    ImGuiIO& io = ImGui::GetIO();
    std::copy(buttons_.begin(), buttons_.end(), std::begin(io.MouseDown));
    const bool is_inside = ImGui::IsMousePosValid(&io.MousePos);
    if (is_inside) io.MousePos = {static_cast<float>(pointer_.x), static_cast<float>(pointer_.y)};
  }

  static Window& self(GLFWwindow* window) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
  }
  /// What ImGui wants is known from the last frame only; the mouse may have come here since.
  bool panels_take_mouse() const {
    const glm::dvec2 pixel = to_pixels(pointer_);
    const glm::dvec2 at = document_.to_canvas(pixel.x, pixel.y);
    return ImGui::GetIO().WantCaptureMouse || at.x < 0 || at.y < 0 ||
           at.x >= document_.canvas.width || at.y >= document_.canvas.height;
  }
  static bool panels_take_keys() {
    return ImGui::GetIO().WantTextInput || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
  }

  /// Units of the window system to pixels.
  glm::dvec2 to_pixels(const glm::dvec2& at) const {
    int width = 1;
    int height = 1;
    glfwGetWindowSize(window_, &width, &height);
    return {at.x * document_.window.width / std::max(width, 1),
            at.y * document_.window.height / std::max(height, 1)};
  }

  void on_button(int button, int action, int mods, double time) {
    const glm::dvec2 at = to_pixels(pointer_);
    if (static_cast<std::size_t>(button) < buttons_.size()) {
      buttons_[static_cast<std::size_t>(button)] = action == GLFW_PRESS;
    }
    if (action == GLFW_RELEASE) {
      controller_.release(at.x, at.y, time);
    } else if (!panels_take_mouse()) {
      const Button which = button == GLFW_MOUSE_BUTTON_LEFT    ? Button::left
                           : button == GLFW_MOUSE_BUTTON_RIGHT ? Button::right
                                                               : Button::middle;
      controller_.press(which, at.x, at.y, (mods & GLFW_MOD_SHIFT) != 0);
    }
  }

  void on_move(const glm::dvec2& at) {
    pointer_ = at;
    const glm::dvec2 pixel = to_pixels(at);
    controller_.move(pixel.x, pixel.y);
  }

  void on_scroll(double x, double y) {
    const glm::dvec2 at = to_pixels(pointer_);
    if (panels_take_mouse()) return ImGui_ImplGlfw_ScrollCallback(window_, x, y);
    controller_.scroll(y, at.x, at.y);
  }

  /// The letter that answers a question may come as a character when the question is gone already.
  void note_key_of_panel(int key) {
    constexpr double kSeconds = 0.3;
    key_of_panel_ = key;  // letters have the numbers of their capitals
    end_of_key_ = glfwGetTime() + kSeconds;
  }

  /// Keys without a character, and those with Ctrl; the others come as characters.
  void on_key(int key, int code, int action, int mods) {
    if (action != GLFW_RELEASE && panels_take_keys()) note_key_of_panel(key);
    const bool is_function_key = key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12;
    const bool is_for_panels =
        is_function_key ? ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup) : panels_take_keys();
    if (action == GLFW_RELEASE || is_for_panels) return;
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
      const bool shift = (mods & GLFW_MOD_SHIFT) != 0;
      return controller_.key(fmt::format("{}F{}", shift ? "Shift+" : "", key - GLFW_KEY_F1 + 1));
    }
    const char* name = glfwGetKeyName(key, code);
    if ((mods & GLFW_MOD_CONTROL) == 0 || name == nullptr) return;
    controller_.key(fmt::format("Ctrl+{:c}", std::toupper(static_cast<unsigned char>(*name))));
  }

  void on_character(unsigned code) {
    constexpr unsigned kAscii = 127;
    if (panels_take_keys()) return ImGui_ImplGlfw_CharCallback(window_, code);
    if (code >= kAscii) return;
    const auto c = static_cast<int>(code);
    if (std::toupper(c) == key_of_panel_ && glfwGetTime() < end_of_key_) return;
    const std::string keys =
        c == ' ' ? "Space"
                 : fmt::format("{}{:c}", std::isupper(c) != 0 ? "Shift+" : "", std::toupper(c));
    controller_.letter(static_cast<char>(c), keys, glfwGetTime());
  }

  template <class Deliver>
  static void keep(GLFWwindow* window, bool is_button, const Deliver& deliver) {
    self(window).inputs_.push_back({[window, deliver] { deliver(self(window)); }, is_button});
  }

  void set_callbacks() {
    glfwSetWindowFocusCallback(window_, ImGui_ImplGlfw_WindowFocusCallback);
    glfwSetCursorEnterCallback(window_, ImGui_ImplGlfw_CursorEnterCallback);
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int mods) {
      const double now = glfwGetTime();
      keep(w, true, [=](Window& s) { s.on_button(button, action, mods, now); });
    });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
      keep(w, false, [=](Window& s) { s.on_move({x, y}); });
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double x, double y) {
      keep(w, false, [=](Window& s) { s.on_scroll(x, y); });
    });
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int code, int action, int mods) {
      keep(w, false, [=](Window& s) {
        s.on_key(key, code, action, mods);
        ImGui_ImplGlfw_KeyCallback(s.window_, key, code, action, mods);
      });
    });
    glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned code) {
      keep(w, false, [=](Window& s) { s.on_character(code); });
    });
    glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** files) {
      for (const std::string file : std::span(files, static_cast<std::size_t>(count))) {
        keep(w, false, [=](Window& s) { s.controller_.drop(file); });
      }
    });
  }

  struct Input {
    std::function<void()> deliver;
    bool is_button;
  };

  Document& document_;
  Session session_;
  Controller controller_;
  int key_of_panel_ = GLFW_KEY_UNKNOWN;
  double end_of_key_ = 0;
  std::deque<Input> inputs_;
  glm::dvec2 pointer_{0};             // where the mouse was at the input at hand, in units of GLFW
  std::array<bool, 5> buttons_ = {};  // those of ImGui
  std::string title_;
  bool fit_first_ = false;
  double played_ = 0;  // when a trace was played up to where it is
  GLFWwindow* window_ = nullptr;
  std::unique_ptr<gl::Renderer> renderer_;
  std::unique_ptr<ui::Interface> interface_;
};

}  // namespace

void run_window(Document& document, float scale, const std::filesystem::path& file,
                const Then& then) {
  ui::recall(document);
  document.debugs_pauses = true;
  document.opens_in_background = true;
  if (!file.empty()) document.begin_to_open(file);  // what cannot be read needs no window
  const Library library;
  Window(document, scale).run(then);
  ui::remember(document);
}

}  // namespace tetmend::viewer
