// SPDX-License-Identifier: MIT
// tetmend improve: a mesh goes in, a better one comes out.
//
//   check names and folders | read | build | measure | run the schedule | measure | compare | write
//   Ctrl-C while the schedule runs: it stops at the next consistent state, the rest is as usual
#include <chrono>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "apps/commands.h"
#include "apps/files.h"
#include "apps/improve_report.h"
#include "apps/interruption.h"
#include "apps/plugins.h"
#include "apps/progress_line.h"
#include "apps/regions.h"
#include "apps/schedule_options.h"
#include "apps/threads.h"
#include "apps/trace_options.h"
#include "kernel/chunks.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/formats/output_file.h"
#include "kernel/formats/tet_mesh_io.h"
#include "kernel/integrity.h"
#include "kernel/mesh_view.h"
#include "kernel/surface.h"

namespace tetmend::apps {
namespace {

struct Options {
  std::filesystem::path input;
  std::filesystem::path output;
  std::filesystem::path report;  ///< empty: none
  ScheduleOptions schedule;
  std::vector<std::filesystem::path> plugins;
  int threads = 1;
  RegionOptions regions;
  TraceOptions trace;
  bool quiet = false;
};

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

/// What would stop the run at its end is better found at its beginning.
void check(const Options& options) {
  check_regions(options.regions);
  check_mesh_extension(options.input);
  check_mesh_extension(options.output);
  if (!options.report.empty()) {
    constexpr std::string_view kJson = ".json";
    check_extension(options.report, {&kJson, 1});
    check_writable(options.report);
  }
  check_writable(options.output);
}

MeshCheck measure(const TetMesh& mesh) {
  return {.statistics = compute_statistics(mesh),
          .surface_fingerprint = surface_fingerprint(mesh),
          .not_positive = count_not_positive(mesh)};
}

TetMesh load(const Options& options, TracePlan& tracing, ProgressLine& progress,
             ImproveReport& report) {
  MeshData data;
  {
    const Stopwatch watch(report.seconds.reading);
    progress.show(fmt::format("reading {}", options.input.string()));
    data = read_mesh(options.input);
    tracing.locate(data);
  }
  const Stopwatch watch(report.seconds.building);
  progress.show("building the mesh");
  TetMesh mesh = build_tet_mesh(options.input, std::move(data), MeshOrder::spatial, &report.build,
                                options.regions.interior());
  report.protected_part = protect_regions(mesh, options.regions);
  return mesh;
}

void run_schedule(const ChosenSchedule& chosen, double time_limit, const Registry& registry,
                  TetMesh& mesh, TraceRecorder* trace, ProgressLine& progress,
                  ImproveReport& report) {
  const Interruption interruption;
  Run run(mesh, registry);
  run.set_listener(&progress);
  run.set_cancel_flag(&interruption.requested());
  run.set_trace(trace);
  progress.set_indicators(quality_indicators(mesh));
  {
    const Stopwatch watch(report.seconds.improving);
    if (time_limit > 0) run.set_time_limit(time_limit);
    improve(run, chosen.schedule, chosen.settings);
  }
  report.out_of_time = run.out_of_time();
  report.interrupted = run.cancelled() && !run.out_of_time();
  report.passes = std::move(run.records);
  report.notes = std::move(run.notes);
}

double touched_share(const TetMesh& mesh) {
  const std::size_t touched =
      count_in_chunks(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
        std::size_t count = 0;
        for (std::size_t i = begin; i < end; ++i) {
          const TetHandle t(static_cast<std::uint32_t>(i));
          if (!mesh.is_deleted(t) && mesh.is_touched(t)) ++count;
        }
        return count;
      });
  return static_cast<double>(touched) / static_cast<double>(mesh.tet_count());
}

/// A broken promise would be a bug of tetmend. The user's file must not suffer from it.
void check_promises(const ImproveReport& report) {
  constexpr double kMostVolumeChange = 1e-9;
  std::string_view broken;
  if (!report.surface_unchanged()) broken = "the surface changed";
  if (report.after.not_positive > report.before.not_positive) broken = "a tet got inverted";
  if (report.before.not_positive == 0 && report.volume_change() > kMostVolumeChange) {
    broken = "the volume changed";
  }
  if (broken.empty()) return;
  throw Error(
      fmt::format("{}: nothing was written, for {}: this is a bug of tetmend, please report it",
                  report.output.string(), broken));
}

void write_report(const std::filesystem::path& file, const ImproveReport& report) {
  OutputFile out(file);
  out.put(to_json(report).dump(2));
  out.put('\n');
  out.commit();
}

std::size_t peak_memory() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

int run_improve(const Options& options, const Invocation& invocation) {
  check(options);
  const Registry registry = load_operators(options.plugins);
  const ChosenSchedule chosen = choose_schedule(options.schedule);
  TracePlan tracing(options.trace, registry);
  const ThreadLimit limit(options.threads);
  ProgressLine progress(!options.quiet);
  ImproveReport report;
  report.arguments = invocation.arguments;
  report.input = options.input;
  report.output = options.output;
  report.schedule = options.schedule.schedule;
  report.settings = chosen.settings;
  report.threads = options.threads;
  TetMesh mesh = load(options, tracing, progress, report);
  {
    const Stopwatch watch(report.seconds.measuring);
    progress.show("measuring");
    report.before = measure(mesh);
  }
  const auto trace = tracing.start(mesh, options.input, chosen);
  run_schedule(chosen, options.schedule.time_limit, registry, mesh, trace.get(), progress, report);
  {
    const Stopwatch watch(report.seconds.measuring);
    progress.show("measuring");
    report.after = measure(mesh);
    report.limit = compute_surface_limit(mesh);
    report.touched_share = touched_share(mesh);
  }
  check_promises(report);
  {
    const Stopwatch watch(report.seconds.writing);
    progress.show(fmt::format("writing {}", options.output.string()));
    write_mesh(options.output, MeshView(mesh));
  }
  if (trace) trace->finish();
  report.peak_memory = peak_memory();
  if (!options.report.empty()) write_report(options.report, report);
  progress.clear();
  if (!options.quiet) {
    fmt::print("tetmend {}: {} -> {}\n\n{}", TETMEND_VERSION, options.input.string(),
               options.output.string(), format_report(report));
  }
  if (report.interrupted) throw Error("interrupted: wrote the mesh as improved so far");
  return 0;
}

}  // namespace

void add_improve(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("improve", "Improve a mesh and keep its surface");
  command->add_option("IN", options->input, "Mesh to improve")->required()->type_name("");
  command->add_option("-o,--output", options->output, "File for the improved mesh; may be IN")
      ->required()
      ->type_name("OUT");
  add_schedule_options(*command, options->schedule);
  add_plugin_option(*command, options->plugins);
  add_threads_option(*command, options->threads);
  add_region_options(*command, options->regions);
  add_trace_options(*command, options->trace);
  command->add_option("--report", options->report, "Write all that is printed, and more, as JSON")
      ->type_name("FILE.json");
  command->add_flag("-q,--quiet", options->quiet, "Print nothing but errors");
  command->footer(fmt::format(
      R"(Removes slivers and raises the worst dihedral angles. Prints the statistics
before and after and the time of each pass, and checks that the surface is
untouched and no tet got inverted. On a terminal a line shows the progress.

Ctrl-C stops the work: OUT is still written, with the mesh as improved so far,
and the exit status is 1. Ctrl-C again ends the program at once. A time limit
stops the work in the same way, with exit status 0. A mistake in a script ends
it with exit status 1, and nothing is written.
OUT appears only when it is complete; an older file of that name stays until
then. The same input gives the same output, byte for byte.

{}

Formats, by extension:
{}
Examples:
  tetmend improve part.mesh -o better.mesh
  tetmend improve part.ele -o better.vtk --report better.json --quiet
  tetmend improve part.mesh -o better.mesh --schedule my.lua --time-limit 60
  tetmend improve part.mesh -o better.mesh --protect label:3

Exit status: 0 success, 1 the work failed or was interrupted, 2 wrong usage)",
      region_help(), mesh_format_list()));
  command->callback([options, &invocation] {
    invocation.action = [options, &invocation] { return run_improve(*options, invocation); };
  });
}

}  // namespace tetmend::apps
