// SPDX-License-Identifier: MIT
// Pictures and scripts without a display, by the real program.
#include <algorithm>
#include <cstdlib>
#include <fstream>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "kernel/formats/mesh_io.h"
#include "tests/apps/program.h"
#include "tests/support/assets.h"
#include "tests/support/zoo.h"
#include "tests/viewer/png.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

Outcome run_script(const TempFolder& folder, const std::string& text) {
  ::unsetenv("DISPLAY");
  std::ofstream(folder / "script.lua") << text;
  return run_program({"--script", (folder / "script.lua").string()});
}

std::string in_quotes(const std::filesystem::path& file) {
  return fmt::format("\"{}\"", file.string());
}

}  // namespace

TEST_CASE("a picture of an asset has the size asked for, and the mesh in its middle") {
  ::unsetenv("DISPLAY");
  const TempFolder folder;
  const std::string file = (folder / "out.png").string();
  const Outcome outcome = run_program(
      {"--render", file, "--size", "320x240", "--view", R"({"bad": false})", asset("sheet.mesh")});
  CHECK(outcome.err == "");
  REQUIRE(outcome.status == 0);
  const viewer::Image image = read_png(file);
  CHECK(image.width == 320);
  CHECK(image.height == 240);
  CHECK(image.at(160, 120) != image.at(2, 120));
  CHECK(viewer::count_red(image) == 0);
}

TEST_CASE("the picture is red where the bad tet is, and nowhere when it is gone") {
  const TempFolder folder;
  write_mesh(folder / "bad.mesh", middle_tet(0.1));
  write_mesh(folder / "good.mesh", kuhn_cube(2, 0, 1));
  const Outcome outcome = run_script(folder, R"lua(
    size(300, 240)
    open()lua" + in_quotes(folder / "bad.mesh") + R"lua()
    worst(1)
    local p = locate()
    deselect()
    expect(red_pixels(p.x, p.y, 4) > 20, "red where the worst tet is")
    expect(red_pixels() > 100, "red")
    filter(1, 2)
    expect(red_pixels() == 0, "no red when bad tets are filtered out")
    open()lua" + in_quotes(folder / "good.mesh") +
                                                 R"lua()
    show_all()
    expect(red_pixels() == 0, "no red in a good mesh")
  )lua");
  CHECK(outcome.err == "");
  CHECK(outcome.status == 0);
}

TEST_CASE("a bad tet inside is seen through the surface") {
  const TempFolder folder;
  const Outcome outcome = run_script(folder, R"lua(
    size(300, 240)
    open()lua" + in_quotes(asset("sheet.mesh")) + R"lua()
    bad()
    expect(red_pixels() == 0, "no red on the surface")
    bad()
    local all = red_pixels()
    expect(all > 50, "red through the surface")
    cut(1, {exact = true})
    expect(red_pixels() < 0.9 * all, "an exact cut takes away what lies beyond")
    bad_beyond_cuts()
    expect(red_pixels() > 0.9 * all, "and this shows it, too")
    filter(1, 2)
    expect(red_pixels() == 0, "a filter does")
  )lua");
  CHECK(outcome.err == "");
  CHECK(outcome.status == 0);
}

TEST_CASE("an edge that is picked shows its shell") {
  const TempFolder folder;
  write_mesh(folder / "shell.mesh", shell_mesh({.degree = 6}));
  const Outcome outcome = run_script(folder, R"lua(
    size(300, 240)
    open()lua" + in_quotes(folder / "shell.mesh") +
                                                 R"lua()
    select_edge(0, 1)
    fit()
    local p = locate()
    local c = pixel(p.x, p.y)
    expect(c.red > 150 and c.green < 100, "the supporting edge, drawn over the rest")
    pick_kind("vertex")
    expect(pick(p.x, p.y).kind == "vertex", "a vertex is picked")
  )lua");
  CHECK(outcome.err == "");
  CHECK(outcome.status == 0);
}

TEST_CASE("words that switch take true or false, and no others take an argument in vain") {
  const TempFolder folder;
  write_mesh(folder / "shell.mesh", shell_mesh({.degree = 6}));
  const auto with_mesh = [&](const std::string& words) {
    return run_script(folder, "open(" + in_quotes(folder / "shell.mesh") + ") " + words);
  };
  const Outcome switched = with_mesh(R"lua(
    colour_bar(true)
    colour_bar(true)
    expect(state().view.colour_bar, "on, and on it stays")
    colour_bar(false)
    expect(not state().view.colour_bar, "off")
    colour_bar()
    expect(state().view.colour_bar, "the other way round")
  )lua");
  CHECK(switched.err == "");
  CHECK(switched.status == 0);
  const Outcome wrong = with_mesh("colour_bar(1)");
  CHECK(wrong.status == 1);
  CHECK(wrong.err.find("colour_bar: it takes no argument, or true or false") != std::string::npos);
  const Outcome vain = with_mesh("home(true)");
  CHECK(vain.status == 1);
  CHECK(vain.err.find("home: it takes no argument") != std::string::npos);
}

TEST_CASE("the start screen has no empty columns, in both themes") {
  const TempFolder folder;
  const Outcome outcome = run_script(folder, R"lua(
    size(1000, 700)
    panels()
    for _, name in ipairs{"light", "dark"} do
      theme(name)
      for _, y in ipairs{60, 640} do
        local side, inside = pixel(40, y), pixel(320, y)
        for _, part in ipairs{"red", "green", "blue"} do
          expect(math.abs(side[part] - inside[part]) <= 1, name .. " at " .. y)
        end
      end
      expect((pixel(320, 640).red < 80) == (name == "dark"), name)
    end
  )lua");
  CHECK(outcome.err == "");
  CHECK(outcome.status == 0);
}

TEST_CASE("a live run takes the red away") {
  const TempFolder folder;
  // A run of a second, so that the script is in time to hold it.
  write_mesh(folder / "large.meshb", test::kuhn_cube(32, 0.3, 1));
  const Outcome outcome = run_script(folder, R"lua(
    size(1000, 600)
    panels()
    open()lua" + in_quotes(folder / "large.meshb") +
                                                 R"lua()
    theme("dark")
    local before = state()
    local red = red_pixels()
    expect(red > 50, "red")
    live_run()
    live_step_pass()
    live_wait()
    screenshot()lua" + in_quotes(folder / "paused.png") +
                                                 R"lua()
    live_continue()
    expect(live_wait().state == "finished", "the run ends")
    expect(state().bad < before.bad / 20, "nearly all bad tets are gone")
    expect(red_pixels() < red / 10, "and so is the red")
    save()lua" + in_quotes(folder / "better.mesh") +
                                                 R"lua()
  )lua");
  CHECK(outcome.err == "");
  CHECK(outcome.status == 0);
  CHECK(read_png(folder / "paused.png").width == 1000);
  CHECK(std::filesystem::exists(folder / "better.mesh"));
}

TEST_CASE("an operator of a plugin can be tried live, with its parameters") {
  const TempFolder folder;
  std::ofstream(folder / "script.lua") << R"lua(
    open()lua" << in_quotes(asset("sheet.mesh"))
                                       << R"lua()
    expect(live_plugins()[1] == "odt_smoothing", "its name")
    expect(live_schedule("operator odt_smoothing").halvings == "3", "its parameter")
    live_set("rounds_at_most", 2)
    live_set("halvings", 5)
    live_start()
    expect(live_wait().state == "paused", "before its first call")
    live_step()
    expect(live_wait().last.operator == "odt_smoothing", "stops at what it changes")
    live_continue()
    local run = live_wait()
    expect(run.state == "finished", run.error)
    expect(#run.passes >= 1, "passes")
  )lua";
  const Outcome outcome = run_program({"--plugin", TETMEND_TEST_PLUGINS "/odt_smoothing.so",
                                       "--script", (folder / "script.lua").string()});
  CHECK(outcome.err == "");
  CHECK(outcome.status == 0);
}

TEST_CASE("panels can be part of the picture, in both themes") {
  const TempFolder folder;
  const Outcome outcome = run_script(folder, R"lua(
    size(1000, 600)
    open()lua" + in_quotes(asset("sheet.mesh")) + R"lua()
    local light = pixel(100, 590)
    panels()
    expect(pixel(3, 300).red > 200, "a light panel")
    theme("dark")
    expect(pixel(20, 590).red < 80, "a dark panel")
    keys()
    screenshot()lua" + in_quotes(folder / "keys.png") +
                                                 R"lua()
  )lua");
  CHECK(outcome.err == "");
  CHECK(outcome.status == 0);
  CHECK(read_png(folder / "keys.png").width == 1000);
}

TEST_CASE("--reference colours what has moved, with a bar, and reports how far") {
  const TempFolder folder;
  MeshData cube = kuhn_cube(4, 0, 1);
  write_mesh(folder / "cube.mesh", cube);
  for (Point& p : cube.points) {
    if (p == Point(0.5, 0.5, 1)) p.z() += 0.1;
  }
  write_mesh(folder / "moved.mesh", cube);
  const auto coloured = [&](const std::string& name) {
    const Outcome outcome =
        run_program({"--render", (folder / "out.png").string(), "--size", "400x400", "--background",
                     "white", "--reference", (folder / "cube.mesh").string(), "--tolerance", "0.2",
                     "--view", R"({"colour_bar": false, "reference": 0, "camera": {"pitch": 89}})",
                     "--report", (folder / "report.json").string(), (folder / name).string()});
    CHECK(outcome.err == "");
    REQUIRE(outcome.status == 0);
    const viewer::Image image = read_png((folder / "out.png").string());
    return std::count_if(image.pixels.begin(), image.pixels.end(), [](const viewer::Colour& c) {
      return std::max({c.red, c.green, c.blue}) - std::min({c.red, c.green, c.blue}) > 40;
    });
  };
  CHECK(coloured("cube.mesh") == 0);
  CHECK(coloured("moved.mesh") > 1000);
  const auto told = nlohmann::json::parse(read_text(folder / "report.json"))["reference"];
  CHECK(told["distance"].get<double>() == doctest::Approx(0.1));
  CHECK(told["share_of_tolerance"].get<double>() == doctest::Approx(0.5));
  CHECK(told["changed"] == 6);

  const Outcome alone = run_program({"--render", (folder / "out.png").string(), "--tolerance", "1%",
                                     (folder / "cube.mesh").string()});
  CHECK(alone.status == 1);
  CHECK(alone.err == "tetmend-view: --tolerance is for --reference: there is none\n");

  // The other way: the cube is flat where the reference is not.
  const auto back_with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"--render",
                                          (folder / "out.png").string(),
                                          "--size",
                                          "200x200",
                                          "--reference",
                                          (folder / "moved.mesh").string(),
                                          "--report",
                                          (folder / "report.json").string(),
                                          (folder / "cube.mesh").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    CHECK(run_program(arguments).status == 0);
    return nlohmann::json::parse(read_text(folder / "report.json"))["reference"];
  };
  CHECK(back_with({"--both-ways"})["distance_back"].get<double>() == doctest::Approx(0.1));
  CHECK(back_with({}).count("distance_back") == 0);
  const Outcome both = run_program(
      {"--render", (folder / "out.png").string(), "--both-ways", (folder / "cube.mesh").string()});
  CHECK(both.status == 1);
  CHECK(both.err == "tetmend-view: --both-ways is for --reference: there is none\n");
}

TEST_CASE("a view from the command line sets the camera, and one without a camera does not") {
  const TempFolder folder;
  const auto yaw_with = [&](const std::string& view) {
    const std::string report = (folder / "report.json").string();
    const Outcome outcome =
        run_program({"--render", (folder / "out.png").string(), "--size", "900x200", "--panels",
                     "--view", view, "--report", report, asset("sheet.mesh")});
    CHECK(outcome.err == "");
    const auto camera = nlohmann::json::parse(read_text(report))["view"]["camera"];
    return camera["yaw"].get<double>();
  };
  CHECK(yaw_with(R"({"camera": {"yaw": 10}})") == 10);
  CHECK(yaw_with(R"({"peel": 1})") == -55);
}

TEST_CASE("what is wrong is said in one line, with an exit status") {
  const TempFolder folder;
  const auto fails = [](const std::vector<std::string>& arguments, int status,
                        const std::string& message) {
    const Outcome outcome = run_program(arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.status == status);
    CHECK(outcome.err.find(message) != std::string::npos);
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  };
  const std::string out = (folder / "out.png").string();
  fails({"--render", out, "missing.mesh"}, 1, "missing.mesh: cannot be read: No such file");
  fails({"--render", out, "missing.trace"}, 1, "missing.trace: cannot be read: No such file");
  fails({"--render", out, "missing"}, 1, "missing: cannot be read: No such file");
  fails({"--render", out, "--view", R"({"peal": 1})", asset("sheet.mesh")}, 1, "no setting 'peal'");
  fails({"--render", (folder / "out.gif").string(), asset("sheet.mesh")}, 1, ".png");
  fails({"--render", out, "--size", "12", asset("sheet.mesh")}, 1, "WIDTHxHEIGHT");
  fails({"--script", "missing.lua"}, 1, "missing.lua");
  fails({"--nonsense"}, 2, "--nonsense");
  CHECK_FALSE(std::filesystem::exists(out));
}

TEST_CASE("without a driver of EGL there is one line and status 1") {
  const TempFolder folder;
  ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", (folder / "none.json").c_str(), 1);
  const Outcome outcome =
      run_program({"--render", (folder / "out.png").string(), asset("sheet.mesh")});
  ::unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
  CAPTURE(outcome.err);
  CHECK(outcome.status == 1);
  CHECK(outcome.err.find("cannot draw without a display") != std::string::npos);
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
}

TEST_CASE("in a small window the columns give way to the picture") {
  const TempFolder folder;
  const Outcome outcome = run_script(folder, R"lua(
    panels()
    open()lua" + in_quotes(asset("sheet.mesh")) + R"lua()
    local function middle(width, height)
      size(width, height)
      select_tet(17)
      fit()
      local p = locate()
      return p.x / width, p.y / height
    end
    local x = middle(1400, 800)
    expect(math.abs(x - 0.5) < 0.02, "two columns: in the middle")
    x = middle(640, 400)
    expect(math.abs(x - (640 - 290) / 2 / 640) < 0.02, "one column, at the right")
    x = middle(400, 300)
    expect(math.abs(x - 0.5) < 0.02, "none")
    screenshot()lua" + in_quotes(folder / "small.png") +
                                                 R"lua()
  )lua");
  CHECK(outcome.err == "");
  CHECK(outcome.status == 0);
}
