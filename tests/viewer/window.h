// SPDX-License-Identifier: MIT
// The window of the viewer under a display in memory, with real keys and mouse events.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/prctl.h>

#include "tests/apps/program.h"
#include "tests/viewer/png.h"

namespace tetmend::test {

inline bool has_program(const std::string& name) {
  return std::system(("command -v " + name + " >/dev/null").c_str()) == 0;
}

/// An X server without a screen, while it lives.
class Display {
 public:
  /// @param size of its screen
  explicit Display(const std::string& size) {
    const std::string screen = size + "x24";
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    pid_ = ::fork();
    if (pid_ == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // also when the test is killed
      const auto out = fmt::format("{}", ends[1]);
      const int nowhere = ::open("/dev/null", O_WRONLY);
      ::dup2(nowhere, STDERR_FILENO);
      // Without -r a key that a busy machine lets go of late counts several times.
      ::execlp("Xvfb", "Xvfb", "-displayfd", out.c_str(), "-screen", "0", screen.c_str(),
               "-noreset", "-r", static_cast<char*>(nullptr));
      ::_exit(127);
    }
    ::close(ends[1]);
    std::string number;
    char c = 0;
    while (::read(ends[0], &c, 1) == 1 && c != '\n') number += c;
    ::close(ends[0]);
    if (number.empty()) throw std::runtime_error("Xvfb does not start");
    number.insert(0, 1, ':');
    ::setenv("DISPLAY", number.c_str(), 1);
  }
  ~Display() {
    ::kill(pid_, SIGTERM);
    ::waitpid(pid_, nullptr, 0);
    ::unsetenv("DISPLAY");
  }
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

 private:
  pid_t pid_ = -1;
};

/// Fails instead of waiting for ever.
inline void type(const std::string& events) {
  REQUIRE(std::system(("timeout 60 xdotool " + events).c_str()) == 0);
}

/// Moves the mouse there and presses its left button.
inline void click(int x, int y) {
  type(fmt::format("mousemove {} {} click 1", x, y));
}

/// Waits until a file is there.
inline void wait_for(const std::filesystem::path& file) {
  for (int i = 0; i < 1200 && !std::filesystem::exists(file); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  REQUIRE(std::filesystem::exists(file));
}

/// The picture of the whole window: key P writes it into the current folder. On a busy machine a key
/// that was typed again makes a second one, whose number the window says: with these gone, too, it
/// does not go up with every picture.
inline viewer::Image take_picture(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "tetmend-view.png";
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("tetmend-view") && name.ends_with(".png")) old.push_back(entry.path());
  }
  for (const auto& each : old) std::filesystem::remove(each);
  // While a file opens, keys are those of its bar.
  for (int looks = 40; looks <= 1280 && !std::filesystem::exists(file); looks *= 2) {
    type("key p");
    for (int k = 0; k < looks && !std::filesystem::exists(file); ++k) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
  REQUIRE(std::filesystem::exists(file));
  return read_png(file);
}

inline bool is_same(const viewer::Image& a, const viewer::Image& b) {
  return std::equal(a.pixels.begin(), a.pixels.end(), b.pixels.begin(), b.pixels.end(),
                    [](const viewer::Colour& p, const viewer::Colour& q) {
                      return p.red == q.red && p.green == q.green && p.blue == q.blue;
                    });
}

/// Waits until two pictures in a row are the same.
inline void wait_until_still() {
  viewer::Image last = take_picture(".");
  for (int i = 0; i < 100; ++i) {
    viewer::Image now = take_picture(".");
    if (is_same(last, now)) return;
    last = std::move(now);
  }
  FAIL("the picture goes on changing");
}

/// For what a run does in its own time: waits until these rows of the picture are others than
/// `before`, and it is still.
inline void wait_for_change(const viewer::Image& before, int top, int bottom) {
  const auto rows = [&](const viewer::Image& image) {
    const auto at = [&](int y) { return image.pixels.begin() + std::ptrdiff_t{image.width} * y; };
    return viewer::Image{image.width, bottom - top, {at(top), at(bottom)}};
  };
  const viewer::Image now = rows(before);
  for (int i = 0; i < 100; ++i) {
    if (!is_same(rows(take_picture(".")), now)) return wait_until_still();
  }
  FAIL("the picture does not change");
}

/// False, and a message that CTest understands, when a program of the test is not installed.
inline bool can_test_window() {
  for (const char* name : {"Xvfb", "xdotool"}) {
    if (has_program(name)) continue;
    MESSAGE("tetmend: skipped, because " << name << " is not installed (see script/bootstrap)");
    return false;
  }
  return true;
}

/// The viewer with a mesh of assets/, another file by its whole path, or nothing, in an empty
/// current folder. One at a time.
class Viewer {
 public:
  explicit Viewer(const std::filesystem::path& file, const std::string& size = "1000x700",
                  const std::string& scale = "1", const std::vector<std::string>& more = {})
      : display_(size) {
    const std::filesystem::path meshes = TETMEND_SOURCE_DIR "/assets/meshes";
    std::filesystem::current_path(folder_ / ".");
    ::setenv("XDG_CONFIG_HOME", (folder_ / "settings").c_str(), 1);  // not those of the user
    err_ = ::open("err", O_WRONLY | O_CREAT, 0666);
    std::vector<std::string> arguments = {"--size", size,       "--scale",
                                          scale,    "--report", "report.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    if (!file.empty()) arguments.push_back((meshes / file).string());
    program_.emplace(arguments, "out", err_);
    type("search --sync --onlyvisible --name tetmend-view >/dev/null");
    type("mousemove 500 350");
  }
  ~Viewer() {
    ::close(err_);
    std::filesystem::current_path(before_);
  }
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  /// Ends the program by its key; its last state. Keys are taken in order: so this waits for all
  /// that was typed before. Where something is unsaved, that is let go.
  nlohmann::json quit() {
    type("key ctrl+q");
    for (int i = 0; i < 60 && !std::filesystem::exists("report.json"); ++i) {
      type("key d sleep 0.2");  // a question takes keys from the picture on that it is in
    }
    INFO(read_text("err"));
    wait_for("report.json");
    CHECK(program_->wait() == 0);
    return nlohmann::json::parse(read_text("report.json"));
  }

 private:
  Display display_;
  TempFolder folder_;
  std::filesystem::path before_ = std::filesystem::current_path();
  int err_ = -1;
  std::optional<Program> program_;
};

}  // namespace tetmend::test
