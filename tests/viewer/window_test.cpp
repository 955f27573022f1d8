// SPDX-License-Identifier: MIT
// The window under a display in memory, with real keys and mouse events.
#include <cstdlib>
#include <fstream>
#include <thread>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/apps/program.h"
#include "tests/viewer/png.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

bool has_program(const std::string& name) {
  return std::system(("command -v " + name + " >/dev/null").c_str()) == 0;
}

/// An X server without a screen, while it lives.
class Display {
 public:
  Display() {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    pid_ = ::fork();
    if (pid_ == 0) {
      const auto out = fmt::format("{}", ends[1]);
      const int nowhere = ::open("/dev/null", O_WRONLY);
      ::dup2(nowhere, STDERR_FILENO);
      ::execlp("Xvfb", "Xvfb", "-displayfd", out.c_str(), "-screen", "0", "1000x700x24",
               static_cast<char*>(nullptr));
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

void type(const std::string& events) {
  REQUIRE(std::system(("xdotool " + events).c_str()) == 0);
}

/// Waits until a file is complete.
void wait_for(const std::filesystem::path& file) {
  for (int i = 0; i < 600 && !std::filesystem::exists(file); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  REQUIRE(std::filesystem::exists(file));
}

/// The picture of the whole window: key P writes it into the current folder.
viewer::Image take_picture(const std::filesystem::path& folder) {
  std::filesystem::remove(folder / "tetmend-view.png");
  type("key p");
  wait_for(folder / "tetmend-view.png");
  return read_png(folder / "tetmend-view.png");
}

}  // namespace

TEST_CASE("keys and mouse work in the window") {
  for (const char* name : {"Xvfb", "xdotool"}) {
    if (has_program(name)) continue;
    MESSAGE("tetmend: skipped, because " << name << " is not installed (see script/bootstrap)");
    return;
  }
  const Display display;
  const TempFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder / ".");
  const int err = ::open((folder / "err").c_str(), O_WRONLY | O_CREAT, 0666);
  const Program program({"--size", "1000x700", "--scale", "1", "--report", "report.json",
                         TETMEND_SOURCE_DIR "/assets/meshes/sheet.mesh"},
                        folder / "out", err);
  type("search --sync --onlyvisible --name tetmend-view >/dev/null");
  type("mousemove 500 350");
  const viewer::Image whole = take_picture(".");
  CHECK(whole.width == 1000);
  CHECK(viewer::count_red(whole, 500, 350, 150) > 100);

  type("mousemove 480 380 click 1");
  type("key b");  // no red any more
  CHECK(viewer::count_red(take_picture("."), 500, 350, 150) == 0);
  type("key b key x key bracketright");
  type("mousemove 500 350 mousedown 1 mousemove 520 360 mousemove 560 380 mouseup 1 sleep 0.5");
  // The histogram: the upper left corner of the window.
  type("mousemove 40 140 sleep 0.3 mousedown 1 sleep 0.3 mousemove 100 140 sleep 0.3");
  type("mousemove 150 140 sleep 0.3 mouseup 1 sleep 0.3 mousemove 500 350");
  const viewer::Image last = take_picture(".");
  CHECK(last.pixels != whole.pixels);
  type("key ctrl+q");
  CHECK(program.wait() == 0);
  ::close(err);

  const auto state = nlohmann::json::parse(test::read_text("report.json"));
  std::filesystem::current_path(before);
  CHECK(state["view"]["cut_1"]["on"] == true);
  CHECK(static_cast<double>(state["view"]["cut_1"]["position"]) == doctest::Approx(0.02));
  CHECK(static_cast<double>(state["view"]["camera"]["yaw"]) != -55);
  CHECK(state["selection"]["kind"] != "nothing");
  CHECK(state["view"]["filtered"] == true);
  CHECK(state["view"]["range"][1] > state["view"]["range"][0]);
  CHECK(state["shown"] < state["tets"]);
}
