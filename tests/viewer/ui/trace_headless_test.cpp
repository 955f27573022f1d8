// SPDX-License-Identifier: MIT
// Pictures and scripts of traces without a display, by the real program.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/apps/program.h"
#include "tests/support/example_traces.h"
#include "tests/viewer/png.h"
#include "viewer/debugger/debugger.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

test::Outcome run_trace_script(const TempFolder& folder, const std::filesystem::path& trace,
                               const std::string& text) {
  ::unsetenv("DISPLAY");
  std::ofstream(folder / "script.lua") << text;
  return run_program({"--script", (folder / "script.lua").string(), trace.string()});
}

/// An accepted call that has bad tets before, and none after.
std::uint32_t find_cure(const std::filesystem::path& trace) {
  viewer::Debugger debugger(trace);
  const auto is_bad = [](const viewer::LocalTet& tet) { return tet.quality < 0.9F; };
  const auto is_good = [](const viewer::LocalTet& tet) { return tet.quality > 1; };
  for (std::uint32_t k = 0; k < debugger.file().calls().size(); ++k) {
    if (!debugger.file().calls()[k].accepted()) continue;
    debugger.enter(k);
    const viewer::CallStudy& study = *debugger.study();
    if (std::any_of(study.before.begin(), study.before.end(), is_bad) &&
        std::all_of(study.after.begin(), study.after.end(), is_good)) {
      return k;
    }
  }
  return kNoCall;
}

}  // namespace

TEST_CASE("the picture is red where the bad tet is, and not after the step that removes it") {
  const TracedBall trace;
  const TempFolder folder;
  const std::uint32_t call = find_cure(trace.path());
  REQUIRE(call != kNoCall);
  const test::Outcome outcome = run_trace_script(folder, trace.path(),
                                                 fmt::format(R"lua(
    size(300, 240)
    enter({})
    expect(view().isolate, "isolated")
    fit()
    deselect()
    expect(red_pixels() > 100, "red before")
    step_out()
    deselect()
    expect(state().trace.call.verdict == "accepted", "accepted")
    expect(red_pixels() == 0, "no red after")
    back_out()
    step_into()
    deselect()
    expect(red_pixels() > 100, "red again on the way back")
  )lua",
                                                             call));
  CHECK(outcome.err == "");
  CHECK(outcome.status == 0);
}

TEST_CASE("--at shows the mesh after so many events, and the report tells the place") {
  ::unsetenv("DISPLAY");
  const TracedBall trace;
  const TempFolder folder;
  const std::string report = (folder / "report.json").string();
  const std::string picture = (folder / "out.png").string();
  const auto red_at = [&](std::uint64_t event) {
    const test::Outcome outcome =
        run_program({"--render", picture, "--size", "320x240", "--at", std::to_string(event),
                     "--report", report, trace.path().string()});
    CHECK(outcome.err == "");
    REQUIRE(outcome.status == 0);
    const auto state = nlohmann::json::parse(read_text(report));
    CHECK(state["trace"]["position"] == event);
    return viewer::count_red(read_png(picture));
  };
  const std::uint64_t end = TraceFile(trace.path()).event_count();
  CHECK(red_at(0) > 4 * red_at(end));
  const test::Outcome beyond =
      run_program({"--render", picture, "--at", std::to_string(end + 1), trace.path().string()});
  CHECK(beyond.status == 1);
  CHECK(beyond.err.find("events") != std::string::npos);
}

TEST_CASE("panels of a trace are drawn in both themes: tree, polygon, timeline") {
  const TracedBall trace;
  const TempFolder folder;
  const test::Outcome outcome =
      run_trace_script(folder, trace.path(),
                       fmt::format(R"lua(
    size(1300, 850)
    panels()
    enter({})
    -- The curve of bad tets in the strip: red on the background of the panels.
    expect(red_pixels(520, 640, 60) > 10, "curve")
    theme("dark")
    expect(pixel(20, 840).red < 80, "dark")
    blend(0.5)
    step_out()
    screenshot("{}")
  )lua",
                                   find_cure(trace.path()), (folder / "a.png").string()));
  CHECK(outcome.err == "");
  CHECK(outcome.status == 0);
  CHECK(read_png(folder / "a.png").width == 1300);
}

TEST_CASE("what is pointed at lights up in the picture and in the ring") {
  const TempFolder folder;
  const auto picture = [&](const char* name) { return (folder / name).string(); };
  const test::Outcome outcome =
      run_trace_script(folder, TETMEND_SOURCE_DIR "/assets/lessons/2-two-shells.trace",
                       fmt::format(R"lua(
    size(1500, 940)
    panels()
    seek(9)
    screenshot("{}")
    point_at("vertex 1")
    screenshot("{}")
    point_at("call 2")
    screenshot("{}")
    teaching()
    point_at()
    screenshot("{}")
    point_at("call 2")
    screenshot("{}")
  )lua",
                                   picture("a.png"), picture("b.png"), picture("c.png"),
                                   picture("d.png"), picture("e.png")));
  CHECK(outcome.err == "");
  REQUIRE(outcome.status == 0);
  const auto lit = [](const viewer::Image& image, int left, int right) {
    std::size_t count = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = left; x < right; ++x) {
        const viewer::Colour& c = image.at(x, y);
        if (c.red > 240 && c.green > 200 && c.blue < 60) ++count;
      }
    }
    return count;
  };
  const int column = 1500 * 62 / 100;  // of the layout for teaching
  const viewer::Image before = read_png(folder / "a.png");
  CHECK(lit(before, 0, 1500) == 0);
  CHECK(lit(read_png(folder / "b.png"), 0, column) > 20);  // in the picture
  CHECK(lit(read_png(folder / "c.png"), 0, column) > 20);  // the target of the call
  CHECK(lit(read_png(folder / "e.png"), 450, 1050) > 20);  // likewise, between the columns
  CHECK(lit(read_png(folder / "d.png"), 450, 1050) == 0);
}

namespace {

/// Width and height of what has the colour of the skirt polygon between two columns of pixels.
std::array<int, 2> extent_of_ring(const viewer::Image& image, int from = 0, int to = 450) {
  const auto is_skirt = [](const viewer::Colour& c) {
    constexpr int kNear = 4;
    return std::abs(c.red - 20) < kNear && std::abs(c.green - 120) < kNear &&
           std::abs(c.blue - 220) < kNear;
  };
  int left = image.width, right = 0, top = image.height, bottom = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = from; x < to; ++x) {
      if (!is_skirt(image.at(x, y))) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
  }
  return {right - left, bottom - top};
}

}  // namespace

TEST_CASE("the whole ring is in sight in small windows, without scrolling") {
  const TempFolder folder;
  const std::array<const char*, 3> names = {"large.png", "small.png", "least.png"};
  const auto picture = [&](std::size_t i) { return (folder / names[i]).string(); };
  const test::Outcome outcome =
      run_trace_script(folder, TETMEND_SOURCE_DIR "/assets/lessons/2-two-shells.trace",
                       fmt::format(R"lua(
    panels()
    if state().teaching then teaching() end
    seek(9)
    size(1300, 1500)
    screenshot("{}")
    size(1300, 850)
    screenshot("{}")
    size(1300, 720)
    screenshot("{}")
  )lua",
                                   picture(0), picture(1), picture(2)));
  CHECK(outcome.err == "");
  REQUIRE(outcome.status == 0);
  const auto whole = extent_of_ring(read_png(picture(0)));
  CHECK(whole[0] > 100);
  CHECK(whole[1] > 100);
  // A little smaller, for there is a bar for scrolling beside it; a ring that is cut off has other proportions.
  for (const std::size_t i : {1, 2}) {
    CAPTURE(i);
    const auto extent = extent_of_ring(read_png(picture(i)));
    CHECK(extent[0] == doctest::Approx(whole[0]).epsilon(0.1));
    CHECK(extent[1] * whole[0] == doctest::Approx(extent[0] * whole[1]).epsilon(0.02));
  }
}

TEST_CASE("the ring of a lesson has the room that its text leaves in a window of 1280 x 720") {
  const TempFolder folder;
  const auto picture = [&](const char* name) { return (folder / name).string(); };
  const test::Outcome outcome =
      run_trace_script(folder, TETMEND_SOURCE_DIR "/assets/lessons/1-core.trace",
                       fmt::format(R"lua(
    size(1280, 720)
    panels()
    seek(2) screenshot("{}") -- beside the picture
    seek(6) screenshot("{}") -- alone
  )lua",
                                   picture("a.png"), picture("b.png")));
  CHECK(outcome.err == "");
  REQUIRE(outcome.status == 0);
  CHECK(extent_of_ring(read_png(folder / "a.png"), 800, 1280)[1] > 270);
  CHECK(extent_of_ring(read_png(folder / "b.png"), 560, 1280)[1] > 330);
}

namespace {

/// Top and height of the lowest bar that marks a line in the right column; panels above it have
/// heads of the same colour.
std::array<int, 2> marked_line(const viewer::Image& image, double column) {
  const auto is_marked = [&](int y) {
    int count = 0;
    for (int x = static_cast<int>(column * image.width); x < image.width; ++x) {
      const viewer::Colour& c = image.at(x, y);
      if (std::abs(c.red - 189) < 8 && std::abs(c.green - 215) < 8 && c.blue > 240) ++count;
    }
    return count > 0.15 * image.width;
  };
  int y = image.height - 1;
  while (y >= 0 && !is_marked(y)) --y;
  const int last = y;
  while (y >= 0 && is_marked(y)) --y;
  return {y + 1, last - y};
}

}  // namespace

TEST_CASE(
    "an algorithm that has its column alone begins at the top, and a small mesh fills its "
    "picture") {
  const TempFolder folder;
  const std::string picture = (folder / "a.png").string();
  std::string script = "size(1920, 1080) panels()\n";
  for (int i = 0; i < 4; ++i) script += "next_lesson_step()\n";
  script += fmt::format("screenshot(\"{}\")\n", picture);
  const test::Outcome outcome =
      run_trace_script(folder, TETMEND_SOURCE_DIR "/assets/lessons/4-tables.trace", script);
  CHECK(outcome.err == "");
  REQUIRE(outcome.status == 0);
  const viewer::Image image = read_png(picture);
  CHECK(marked_line(image, 0.7)[0] < 0.3 * image.height);  // line 8 of Algorithm 3
  // The tets are grey, on a ground that is blue or white.
  int left = image.width, right = 0;
  for (int y = 0; y < image.height * 3 / 5; ++y) {
    for (int x = 0; x < image.width * 2 / 5; ++x) {
      const viewer::Colour& c = image.at(x, y);
      if (c.red < 190 && c.red > c.blue && c.red > 100) {
        left = std::min(left, x);
        right = std::max(right, x);
      }
    }
  }
  CHECK(right - left > 0.13 * image.width);
}

TEST_CASE("the line of the algorithm is marked, moves with the call, and is always in sight") {
  const TempFolder folder;
  const auto picture = [&](const std::string& name) { return (folder / (name + ".png")).string(); };
  // 5: line 6 of Algorithm 3, 6: line 8; 13: line 5 of Algorithm 4, and a line of its caller.
  const std::array<std::uint64_t, 3> positions = {5, 6, 13};
  std::string script = "panels() if state().teaching then teaching() end\n";
  for (const auto& [name, size] :
       {std::pair{"large", "1300, 1100"}, std::pair{"small", "800, 600"}}) {
    script += fmt::format("size({})\n", size);
    for (const std::uint64_t p : positions) {
      script += fmt::format("seek({}) screenshot(\"{}\") print(state().trace.call.line)\n", p,
                            picture(fmt::format("{}{}", name, p)));
    }
  }
  script +=
      fmt::format("teaching() size(1280, 720) seek(6) screenshot(\"{}\")\n", picture("teach"));
  const test::Outcome outcome =
      run_trace_script(folder, TETMEND_SOURCE_DIR "/assets/lessons/2-two-shells.trace", script);
  CHECK(outcome.err == "");
  REQUIRE(outcome.status == 0);
  CHECK(outcome.out == "6\n8\n5\n6\n8\n5\n");
  constexpr int kLine = 17;  // a text line and the gap
  const auto line = [&](const std::string& name, double column) {
    return marked_line(read_png(picture(name)), column);
  };
  const auto at_6 = line("large5", 0.66);
  const auto at_8 = line("large6", 0.66);
  CHECK(std::abs(at_8[0] - at_6[0] - 2 * kLine) <= 2);
  for (const std::uint64_t p : positions) {
    for (const auto& layout : {std::pair{"large", 0.66}, std::pair{"small", 0.46}}) {
      const std::string name = layout.first;
      CAPTURE(name);
      CAPTURE(p);
      const auto [top, height] = line(fmt::format("{}{}", name, p), layout.second);
      CHECK(top > (name == "small" ? 360 : 700));  // below all heads of panels
      CHECK(std::abs(height - kLine) <= 3);        // not cut
    }
  }
  const auto [top, height] = line("teach", 0.64);
  CHECK(top > 250);
  CHECK(height > kLine + 3);  // the text is larger
}
