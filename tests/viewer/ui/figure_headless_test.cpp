// SPDX-License-Identifier: MIT
// What pictures for papers have, by the real program: backgrounds, bars, lines by scale, videos.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/apps/program.h"
#include "tests/support/assets.h"
#include "tests/support/example_traces.h"
#include "tests/viewer/png.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

viewer::Image render(const TempFolder& folder, std::vector<std::string> more) {
  ::unsetenv("DISPLAY");
  const std::string file = (folder / "out.png").string();
  more.insert(more.begin(), {"--render", file});
  more.push_back(asset("sheet.mesh"));
  const Outcome outcome = run_program(more);
  CHECK(outcome.err == "");
  REQUIRE(outcome.status == 0);
  return read_png(file);
}

std::size_t different(const viewer::Image& a, const viewer::Image& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] != b.pixels[i] ? 1 : 0;
  return count;
}

}  // namespace

TEST_CASE("the background is white, or transparent where nothing is drawn") {
  const TempFolder folder;
  const auto picture = [&](const std::string& background) {
    return render(folder, {"--size", "200x150", "--background", background});
  };
  CHECK(picture("gradient").at(1, 1) != viewer::Colour{255, 255, 255, 255});
  const viewer::Image white = picture("white");
  CHECK(white.at(1, 1) == viewer::Colour{255, 255, 255, 255});
  const viewer::Image clear = picture("transparent");
  CHECK(clear.at(1, 1).alpha == 0);
  CHECK(clear.at(100, 75).alpha == 255);
  // On white paper both look alike.
  for (std::size_t i = 0; i < clear.pixels.size(); ++i) {
    const viewer::Colour& c = clear.pixels[i];
    const double on_paper = c.green * (c.alpha / 255.0) + 255 - c.alpha;
    REQUIRE(std::abs(on_paper - white.pixels[i].green) <= 3);
  }
}

TEST_CASE("colour bar, scale bar and title are in the picture when they are asked for") {
  const TempFolder folder;
  const std::vector<std::string> plain = {"--size", "400x300", "--view",
                                          R"({"colour": "quality"})"};
  const viewer::Image without = render(folder, plain);
  for (const std::vector<std::string>& option : std::vector<std::vector<std::string>>{
           {"--colour-bar"}, {"--scale-bar"}, {"--title", "Sheet"}}) {
    CAPTURE(option[0]);
    std::vector<std::string> arguments = plain;
    arguments.insert(arguments.end(), option.begin(), option.end());
    const std::size_t changed = different(render(folder, arguments), without);
    CHECK(changed > 50);
    CHECK(changed < 12000);
  }
}

TEST_CASE("twice the size and scale is the same picture, finer") {
  const TempFolder folder;
  const std::vector<std::string> shown = {"--view", R"({"colour": "quality"})", "--colour-bar"};
  const auto picture = [&](const char* size, const char* scale) {
    std::vector<std::string> arguments = shown;
    arguments.insert(arguments.end(), {"--size", size, "--scale", scale});
    return render(folder, arguments);
  };
  const viewer::Image small = picture("400x300", "1");
  const auto difference = [&](const viewer::Image& large) {
    double sum = 0;
    for (int y = 0; y < 300; ++y) {
      for (int x = 0; x < 400; ++x) {
        const auto green = [&](int i, int j) {
          return double{1} * large.at(2 * x + i, 2 * y + j).green;
        };
        const double mean = (green(0, 0) + green(1, 0) + green(0, 1) + green(1, 1)) / 4;
        sum += std::abs(mean - small.at(x, y).green);
      }
    }
    return sum / (400 * 300);
  };
  const double scaled = difference(picture("800x600", "2"));
  const double unscaled = difference(picture("800x600", "1"));
  CHECK(scaled < 4);
  CHECK(scaled < 0.7 * unscaled);
}

TEST_CASE("a video is written by ffmpeg, or one line says that there is none") {
  const TempFolder folder;
  const TracedBall trace;
  const std::string video = (folder / "run.mp4").string();
  const std::vector<std::string> command = {
      "--video", video, "--size", "161x120", "--frames", "0,30,3", trace.path().string()};
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  const Outcome without = run_program(command);
  ::setenv("PATH", path.c_str(), 1);
  CHECK(without.status == 1);
  CHECK(without.err.find("needs the program ffmpeg") != std::string::npos);
  CHECK(std::count(without.err.begin(), without.err.end(), '\n') == 1);
  CHECK(folder.entries() == 0);
  if (std::system("ffprobe -version > /dev/null 2>&1") != 0) {
    std::cout << "tetmend: skipped: no ffmpeg here\n";
    return;
  }
  const Outcome outcome = run_program(command);
  CHECK(outcome.err == "");
  REQUIRE(outcome.status == 0);
  const std::string told = (folder / "told").string();
  REQUIRE(std::system(("ffprobe -v error -count_frames -show_entries "
                       "stream=codec_name,width,height,nb_read_frames -of csv=p=0 " +
                       video + " > " + told)
                          .c_str()) == 0);
  CHECK(read_text(told) == "h264,162,120,11\n");
}

TEST_CASE("what is wrong with frames is one line, and leaves no file") {
  const TempFolder folder;
  const TracedBall trace;
  const std::string video = (folder / "run.mp4").string();
  const auto fails = [&](std::vector<std::string> arguments, const std::string& words) {
    const Outcome outcome = run_program(arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find(words) != std::string::npos);
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(folder.entries() == 0);
  };
  fails({"--video", video, asset("sheet.mesh")}, "--video is for traces");
  fails({"--video", video, "--frames", "0,99999999", trace.path().string()}, "the trace has");
  for (const char* wrong : {"5", "1,2,3,4", "a,b", "1,", "-1,5", "1,2,", "1;2"}) {
    fails({"--video", video, std::string("--frames=") + wrong, trace.path().string()},
          "FROM,TO or FROM,TO,EVERY");
  }
  fails({"--video", (folder / "run.avi").string(), trace.path().string()}, "written as .mp4");
  fails({"--render", (folder / "x.png").string(), "--background", "blue", asset("sheet.mesh")},
        "one of gradient, white, transparent");
}
