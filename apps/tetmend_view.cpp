// SPDX-License-Identifier: MIT
// The viewer: reads the command line, then shows a window, draws a picture or runs a script.
#include <charconv>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/description.h"
#include "apps/help_formatter.h"
#include "apps/number_check.h"
#include "apps/plugins.h"
#include "apps/standard_streams.h"
#include "explain/json_text.h"
#include "explain/lesson_guide.h"
#include "kernel/error.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/formats/output_file.h"
#include "kernel/formats/run_files.h"
#include "kernel/formats/temporary_names.h"
#include "platform/platform.h"
#include "viewer/commands/frames.h"
#include "viewer/commands/script.h"
#include "viewer/ui/headless.h"
#include "viewer/ui/window.h"

namespace tetmend::apps {
namespace {

using namespace viewer;

enum Status : int { kSuccess = 0, kFailed = 1, kWrongUsage = 2 };

struct Options {
  std::string file;
  std::string before;
  std::string against;
  std::string reference;
  std::string tolerance;
  bool both_ways = false;
  std::string picture;
  std::string script;
  std::string size;
  std::string view;
  std::string report;
  float scale = 0;
  std::string video;
  std::string frames;
  std::string background;
  std::string title;
  bool colour_bar = false;
  bool numbers = false;
  bool scale_bar = false;
  bool panels = false;
  bool keys = false;
  std::vector<std::filesystem::path> plugins;
  std::optional<std::uint64_t> at;
};

Canvas read_size(const std::string& text) {
  constexpr int kMost = 8192;
  Canvas size;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest) != 2 ||
      size.width < 1 || size.height < 1 || size.width > kMost || size.height > kMost) {
    throw Error(fmt::format("--size must be WIDTHxHEIGHT, up to {} each, not '{}'", kMost, text));
  }
  return size;
}

void go_to(Document& document, std::uint64_t event) {
  Debugger* debugger = document.debugger();
  if (debugger == nullptr) throw Error("--at is for traces: there is none");
  if (event > debugger->end()) {
    throw Error(fmt::format("--at {}: the trace has {} events", event, debugger->end()));
  }
  debugger->seek(event);
  document.show_trace();
}

/// As the script word does; what --view says comes after.
void show_reference(const Options& options, Document& document) {
  if (options.reference.empty()) {
    if (!options.tolerance.empty()) throw Error("--tolerance is for --reference: there is none");
    if (options.both_ways) throw Error("--both-ways is for --reference: there is none");
    return;
  }
  Allowance allowance;
  if (!options.tolerance.empty()) allowance = Allowance::parse(options.tolerance);
  document.set_reference(options.reference, allowance);
  document.view.show_reference(true);
  document.view.scene.both_ways = options.both_ways;
}

void show_against(const Options& options, Document& document) {
  if (options.against.empty()) return;
  Debugger* debugger = document.debugger();
  if (debugger == nullptr) throw Error("--against is for traces: there is none");
  debugger->compare_with(options.against);
}

void prepare(const Options& options, Document& document) {
  document.live.load_plugins(all_plugins(options.plugins));
  if (!options.size.empty()) document.resize(read_size(options.size));
  if (!options.before.empty()) document.compare_with(options.before);
}

/// When the file is open.
void arrange(const Options& options, Document& document) {
  show_against(options, document);
  if (options.at) go_to(document, *options.at);
  show_reference(options, document);
  if (!options.view.empty()) apply_json_text(document.view, options.view);
  if (!options.background.empty()) {
    apply_json(document.view, {{"background", options.background}});
  }
  if (!options.title.empty()) document.view.title = options.title;
  document.view.colour_bar = document.view.colour_bar || options.colour_bar;
  document.view.all_numbers = document.view.all_numbers || options.numbers;
  document.view.scale_bar = document.view.scale_bar || options.scale_bar;
}

/// Otherwise the mesh is to fill the space that the panels leave.
bool has_camera(const Options& options) {
  if (options.view.empty()) return false;
  const auto view = nlohmann::json::parse(options.view, nullptr, false);
  return view.is_object() && view.contains("camera");
}

/// "FROM,TO" or "FROM,TO,EVERY"; nothing of an empty text.
FrameRequest read_frames(const std::string& text) {
  if (text.empty()) return {};
  std::vector<std::uint64_t> numbers;
  const char* at = text.data();
  const char* end = at + text.size();
  for (;;) {
    std::uint64_t number = 0;
    const auto [rest, error] = std::from_chars(at, end, number);
    if (error != std::errc()) break;
    numbers.push_back(number);
    at = rest;
    if (at == end || *at != ',') break;
    ++at;
  }
  if (at != end || numbers.size() < 2 || numbers.size() > 3 || text.back() == ',') {
    throw Error(fmt::format("--frames must be FROM,TO or FROM,TO,EVERY, not '{}'", text));
  }
  FrameRequest request{numbers[0], numbers[1], {}};
  if (numbers.size() == 3) request.every = numbers[2];
  return request;
}

FrameRange range_of_video(const Options& options, const Document& document) {
  if (document.debugger() == nullptr) throw Error("--video is for traces: there is none");
  return frame_range(read_frames(options.frames), document.debugger()->end());
}

void write_report(const std::string& file, Document& document) {
  OutputFile out(file);
  out.put(explain::json_text(state_of(document), 2));
  out.put('\n');
  out.commit();
}

/// @throws CLI::ValidationError when an output is an input or another output.
void check_files(const Options& options) {
  formats::RunFiles files;
  for (const auto& [option, mesh] : {std::pair("FILE", options.file),
                                     {"--before", options.before},
                                     {"--reference", options.reference}}) {
    if (!mesh.empty()) files.read({option, {source_files(mesh), {}}});
  }
  if (const auto lesson = explain::lesson_beside(options.file)) {
    const auto trace = std::filesystem::path(*lesson).replace_extension(".trace");  // of its name
    files.read({"the lesson", {{*lesson, trace}, {}}});
  }
  files.read({"--against", {{options.against}, {}}});
  files.read({"--script", {{options.script}, {}}});
  files.read({"--plugin", {options.plugins, {}}});
  files.write({"--render", {{options.picture}, {}}});
  files.write({"--video", {{options.video}, {}}});
  files.write({"--report", {{options.report}, {}}});
  if (const auto clash = files.clash()) {
    throw CLI::ValidationError(fmt::format("{}: {} and {} would be the same file",
                                           clash->file.string(), clash->option, clash->output));
  }
}

int run(const Options& options) {
  if (options.keys) {
    fmt::print("{}", command_reference());
    return kSuccess;
  }
  Document document;
  prepare(options, document);
  if (options.script.empty() && options.picture.empty() && options.video.empty()) {
    run_window(document, options.scale, options.file, [&](Document& opened) {
      arrange(options, opened);
      return !has_camera(options);
    });
  } else {
    if (!options.file.empty()) document.open(options.file);
    arrange(options, document);
    document.show_panels = options.panels;
    const auto host = make_headless_host(options.scale > 0 ? options.scale : 1);
    Session session{document, *host};
    host->arrange(document);
    if (document.has_mesh() && !has_camera(options)) document.fit_first();
    if (!options.script.empty()) run_script_file(session, options.script);
    if (!options.picture.empty()) write_png(options.picture, host->render(document));
    if (!options.video.empty()) {
      write_video(session, range_of_video(options, document), options.video);
    }
  }
  if (!options.report.empty()) write_report(options.report, document);
  return kSuccess;
}

int complain(Status status, const std::string& message) {
  say(stderr, fmt::format("tetmend-view: {}\n", message));
  return status;
}

/// What stands beside.
void add_others(CLI::App& app, Options& options) {
  app.add_option("--before", options.before, "Mesh whose statistics are shown beside")
      ->type_name("MESH");
  app.add_option("--against", options.against,
                 "Of a trace: another run beside it, with differences")
      ->type_name("TRACE");
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("FILE", options.file, "Mesh or trace to open")->type_name("");
  add_others(app, options);
  app.add_option("--reference", options.reference,
                 "Colour the surface by its distance from that of this\nmesh, which is seen as a "
                 "ghost")
      ->type_name("MESH");
  app.add_option("--tolerance", options.tolerance,
                 "What the surface might move, as improve --surface has\nit: 1%, 0.01; the figures "
                 "are in parts of it, too")
      ->type_name("P%|LENGTH");
  app.add_flag("--both-ways", options.both_ways,
               "Colours and figures also say how far the reference lies\nfrom the mesh: the larger "
               "distance at each place");
  app.add_option("--render", options.picture, "Write a picture (.png) and exit; needs no display")
      ->type_name("FILE.png");
  app.add_option("--video", options.video,
                 "Write a video of a trace (.mp4, .gif) by ffmpeg and exit")
      ->type_name("FILE.mp4");
  app.add_option("--frames", options.frames,
                 "Of a video: a picture after so many events, up to\nso many, in steps; all of the "
                 "trace without")
      ->type_name("FROM,TO[,EVERY]");
  app.add_option("--script", options.script, "Run a Lua script and exit; needs no display")
      ->type_name("FILE.lua");
  app.add_option("--size", options.size, "Size of the picture or window: WIDTHxHEIGHT")
      ->type_name("SIZE");
  app.add_option("--view", options.view, "Settings of the view as JSON: what Ctrl+C copies")
      ->type_name("JSON");
  app.add_flag("--colour-bar", options.colour_bar, "Pictures have a colour bar, with its measure");
  app.add_flag("--scale-bar", options.scale_bar, "Pictures have a scale bar");
  app.add_flag("--numbers", options.numbers,
               "Pictures have the numbers of the vertices that are\nseen, as far as there is room");
  app.add_option("--title", options.title, "Pictures have a title")->type_name("TEXT");
  app.add_option("--background", options.background,
                 "Behind the mesh: gradient, white or transparent")
      ->type_name("NAME");
  app.add_option("--at", options.at, "Of a trace: show the mesh after so many events")
      ->type_name("N");
  app.add_option("--scale", options.scale,
                 "Size of text and panels and width of lines, 0.5 to 4;\n1 is usual, 2 for 4K")
      ->type_name("FACTOR")
      ->check(number_from(0.5, 4.0));
  app.add_option("--report", options.report, "Write the last state as JSON on leaving")
      ->type_name("FILE.json");
  add_plugin_option(app, options.plugins);
  app.add_flag("--panels", options.panels, "Draw the panels into pictures, too");
  app.add_flag("--keys", options.keys, "Print all keys and script words");
  app.footer(R"(Examples:
  tetmend-view part.mesh
  tetmend-view --before part.mesh better.mesh
  tetmend-view --reference part.mesh --tolerance 1% --both-ways moved.mesh
  tetmend-view run.trace
  tetmend-view shell.trace --against thorough.trace
  tetmend-view --render part.png --size 1200x900 part.mesh
  tetmend-view --render fig.png --size 3840x2160 --scale 2 --view '{"colour": "quality"}' --colour-bar --background transparent part.mesh
  tetmend-view --video run.mp4 --size 1280x720 --frames 0,500,5 run.trace

Exit status: 0 success, 1 the work failed, 2 wrong usage)");
}

/// The trace of a run that is under way is unfinished.
void end_without_remains() {
  platform::on_end_signals(platform::EndSignals::terminal, formats::end_by_signal);
}

}  // namespace
}  // namespace tetmend::apps

int main(int argc, char** argv) {
  using namespace tetmend::apps;
  tetmend::platform::reserve_standard_streams();
  end_without_remains();
  Options options;
  CLI::App app(
      "tetmend-view shows a tetrahedral mesh and where it is bad, or a recorded run step by step.",
      "tetmend-view");
  app.set_version_flag("--version", "tetmend " TETMEND_VERSION);
  app.formatter(std::make_shared<HelpFormatter>(
      asks_for_short_help(std::vector<std::string>(argv + 1, argv + argc))));
  add_options(app, options);
  if (argc == 2 && argv[1] == kDescribe) {
    fmt::print("{}\n", describe(app, TETMEND_VERSION).dump(1));
    return kSuccess;
  }
  try {
    app.parse(argc, argv);
    check_files(options);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    return complain(kWrongUsage, fmt::format("{} (see tetmend-view --help)", message_of(error)));
  }
  try {
    return run(options);
  } catch (const std::bad_alloc&) {
    return complain(kFailed, "out of memory");
  } catch (const std::exception& error) {
    return complain(kFailed, error.what());
  }
}
