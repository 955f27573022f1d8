// SPDX-License-Identifier: MIT
// tetmend improve: a mesh goes in, a better one comes out.
//
//   check names and folders | read | improve | write
//   Ctrl-C while the schedule runs: it stops at the next consistent state, the rest is as usual;
//   later: what is left to do is done
#include <array>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tetmend/catalogue.h>
#include <tetmend/improve.h>
#include <tetmend/option_text.h>

#include "apps/commands.h"
#include "apps/files.h"
#include "apps/improve_options.h"
#include "apps/improve_report.h"
#include "apps/interruption.h"
#include "apps/plugin_watch.h"
#include "apps/progress_line.h"
#include "apps/standard_streams.h"
#include "face/mesh_access.h"
#include "face/recorded.h"
#include "kernel/formats/output_file.h"
#include "platform/platform.h"
#include "report/page.h"

namespace tetmend::apps {
namespace {

/// Adds the time from its making to its end to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() {
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

constexpr std::array<std::string_view, 3> kReportExtensions = {".json", ".html", ".htm"};

/// What would stop the run at its end is better found at its beginning.
void check_files(const ImproveOptions& options) {
  check_mesh_extension(options.input);
  check_mesh_extension(options.output);
  check_variant(options.output, options.carry);
  for (const std::filesystem::path& report : options.reports) {
    check_extension(report, kReportExtensions);
  }
  const std::filesystem::path schedule = options.run.schedule;
  const std::array inputs = {
      NamedFile{"IN", options.input, true},
      NamedFile{"--schedule", schedule.extension() == ".lua" ? schedule : ""}};
  std::vector<NamedFile> outputs;
  for (const std::filesystem::path& report : options.reports)
    outputs.push_back({"--report", report});
  outputs.push_back({"-o", options.output, true});
  outputs.push_back({"--trace", options.run.trace});
  prepare_files(inputs, outputs);
}

/// Before the schedule signals end the program: there is nothing to be saved yet.
/// @param interruption begins then
/// @param portrait null, or is drawn
Result improve_watched(Mesh& mesh, const ImproveOptions& all, ProgressLine& line,
                       std::optional<Interruption>& interruption,
                       std::unique_ptr<TraceRecorder>& trace, face::Portrait* portrait) {
  Options options = all.run;
  std::mutex line_busy;  // the watch has a thread of its own
  std::optional<PluginWatch> watch;
  if (!options.plugin.empty()) {
    note_crashes();
    watch.emplace(all.attempt_limit, options.time_limit, [&](std::string_view text) {
      const std::lock_guard lock(line_busy);
      line.clear();
      complain(kSuccess, text);
    });
  }
  options.cancel = &Interruption::requested();
  options.progress = [&](const Progress& progress) {
    if (progress.stage == Stage::improving && !interruption) interruption.emplace();
    if (watch) watch->show(progress.stage);
    const std::lock_guard lock(line_busy);
    line.show(progress);
    return true;
  };
  options.note = [&](std::string_view text) {
    const std::lock_guard lock(line_busy);
    line.note(text);
  };
  try {
    return face::improve(mesh, options, trace, portrait);
  } catch (const OptionError& error) {
    throw Error("--" + message_of(error));
  }
}

void write_reports(const std::vector<std::filesystem::path>& files, const ImproveReport& report) {
  if (files.empty()) return;
  const nlohmann::json json = to_json(report);
  for (const std::filesystem::path& file : files) {
    OutputFile out(file);
    out.put(lower_extension(file) == ".json" ? json.dump(2) + '\n'
                                             : report::write_page(json, report.portrait));
    out.commit();
  }
}

/// The worst tets by the numbers that the file of the mesh gives them.
void number_tets(face::Portrait& portrait, const Mesh& mesh) {
  const std::vector<std::int64_t>& numbers = MeshAccess::data(mesh).tet_numbers;
  if (numbers.empty()) return;
  for (face::DrawnTet& tet : portrait.bad_after) tet.facts.number = numbers[tet.facts.tet];
}

/// What went wrong; empty: nothing. Null: there is no trace.
std::string finish(TraceRecorder* trace) {
  try {
    if (trace != nullptr) trace->finish();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

int run_improve(ImproveOptions& options, Invocation& invocation) {
  name_streams(options.format, options.input, &options.output);
  check_files(options);
  complete(options);
  const int threads = options.run.threads;
  ProgressLine progress(!options.quiet);
  ImproveReport report{.arguments = invocation.arguments, .options = options};
  Mesh mesh;
  {
    const Stopwatch watch(report.reading);
    progress.show(fmt::format("reading {}", options.input.string()));
    progress.clear();
    mesh = load_for(options.input, options.output, threads, options.carry, report.file_notes);
  }
  std::optional<Interruption> interruption;  // until all is written
  std::unique_ptr<TraceRecorder> trace;
  report.result = improve_watched(mesh, options, progress, interruption, trace,
                                  options.reports.empty() ? nullptr : &report.portrait);
  number_tets(report.portrait, mesh);
  {
    const Stopwatch watch(report.writing);
    progress.show(fmt::format("writing {}", options.output.string()));
    save(options.output, mesh, threads, options.carry.variant);
  }
  report.peak_memory = platform::peak_memory();
  write_reports(options.reports, report);
  invocation.wrote_files = true;
  const std::string trace_trouble = finish(trace.get());  // last: without a mesh it is worth little
  progress.clear();
  if (!options.quiet) {
    say(stream_beside(options.output),
        fmt::format("tetmend {}: {} -> {}\n\n{}", version(), options.input.string(),
                    options.output.string(), format_report(report)));
  }
  if (!trace_trouble.empty()) {
    return complain(kFailed, fmt::format("{}: wrote the mesh, and no trace", trace_trouble));
  }
  if (report.result.ending == Ending::cancelled) {
    return complain(kInterrupted, "interrupted: wrote the mesh as improved so far");
  }
  const std::size_t n_bad = report.result.after.n_bad;
  if (!options.goal.empty() && n_bad > 0) {
    return complain(kGoalMissed,
                    fmt::format("the goal {} is missed by {} {}: wrote the mesh", options.goal,
                                grouped(n_bad), n_bad == 1 ? "tet" : "tets"));
  }
  return kSuccess;
}

}  // namespace

void add_improve(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<ImproveOptions>();
  CLI::App* command = app.add_subcommand("improve", "Improve a mesh and keep its surface");
  add_improve_options(*command, *options);
  command->footer(fmt::format(
      R"(Removes slivers and raises the worst dihedral angles. Prints the statistics
before and after and the time of each pass, and checks that the surface is
untouched and no tet got inverted. On a terminal a line shows the progress.

An operator of a plugin that does not come back is named; two seconds after the
time limit it ends the run with exit status 1, and no mesh is written. If the
trace cannot be written, the mesh is all the same, and the exit status is 1.

Ctrl-C, SIGTERM, SIGUSR1, SIGXCPU and their like stop the work: OUT is still
written, with the mesh as improved so far, and the exit status is 4. The second
time, or while IN is read, they end the program at once, and nothing is written.
A time limit stops the work likewise, with exit status 0. A mistake in a script
ends it with exit status 1, and nothing is written.
OUT appears only when it is complete; an older file of that name stays until
then, and hands down owner and permissions. OUT may be IN; other files that are
named must differ. The same input gives the same output, byte for byte.

Named arrays come over: of points linearly in the old mesh, of tets from the old
tet at the centroid. What of IN cannot be kept is named on standard error and in
the report.

{}

Formats, by extension:
{}
Examples:
  tetmend improve part.mesh -o better.mesh
  tetmend improve part.ele -o better.vtk --report better.html --quiet
  tetmend improve part.mesh -o better.mesh --schedule my.lua --time-limit 60
  tetmend improve part.mesh -o better.mesh --protect label:3
  mesher | tetmend improve - -o - --format msh | solver

Exit status: 0 success, 1 the work failed and nothing was written, 2 wrong
usage, 3 written, but tets miss the goal that --goal asked for, 4 written, but
interrupted)",
      region_help(), mesh_format_list()));
  command->callback([options, &invocation] {
    invocation.action = [options, &invocation] { return run_improve(*options, invocation); };
  });
}

}  // namespace tetmend::apps
