// SPDX-License-Identifier: MIT
// tetmend improve: a mesh goes in, a better one comes out.
//
//   check names and folders | read | improve | write
//   Ctrl-C while the schedule runs: it stops at the next consistent state, the rest is as usual;
//   later: what is left to do is done
#include "apps/command_improve.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <set>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tetmend/catalogue.h>
#include <tetmend/improve.h>
#include <tetmend/option_text.h>

#include "apps/commands.h"
#include "apps/files.h"
#include "apps/improve_options.h"
#include "apps/improve_report.h"
#include "apps/improve_watched.h"
#include "apps/interruption.h"
#include "apps/mesh_formats.h"
#include "apps/progress_line.h"
#include "apps/standard_streams.h"
#include "face/mesh_access.h"
#include "face/portrait.h"
#include "face/recorded.h"
#include "kernel/formats/standard_stream.h"
#include "kernel/grouped.h"
#include "kernel/printable.h"
#include "kernel/stopwatch.h"
#include "pieces/bytes.h"
#include "pieces/improve.h"
#include "pieces/mesh_files.h"
#include "pieces/out_of_core.h"
#include "platform/platform.h"

namespace tetmend::apps {
namespace {

constexpr std::array<std::string_view, 3> kReportExtensions = {".json", ".html", ".htm"};

/// Where the mesh goes, or would go in a dry run without OUT: it is as good as written in place.
const std::filesystem::path& would_be(const ImproveOptions& options) {
  return options.output.empty() ? options.input : options.output;
}

/// What would stop the run at its end is better found at its beginning.
void check_files(const ImproveOptions& options, const Invocation& invocation) {
  const pieces::ArrayFiles* const known = invocation.array_files;
  check_formats(options.input, would_be(options), options.carry, known);
  for (const std::filesystem::path& report : options.reports) {
    check_extension(report, kReportExtensions);
  }
  std::vector<NamedFile> inputs = files_of_options(options.run);
  inputs.insert(inputs.begin(), {"IN", options.input, NamedFile::Kind::mesh, true});
  inputs.push_back({"options of the folder", invocation.folder_file});
  std::vector<NamedFile> outputs;
  for (const std::filesystem::path& report : options.reports)
    outputs.push_back({"--report", report});
  outputs.push_back({"-o", options.output, NamedFile::Kind::mesh, true});
  outputs.push_back({"--trace", options.run.trace});
  outputs.push_back({"--checkpoint", options.pieces.checkpoint, NamedFile::Kind::run_folder});
  prepare_files(inputs, outputs, known);
}

/// Runs from file to file: those of several processes, and where not all is in memory.
bool is_by_files(const ImproveOptions& options, const Invocation& invocation) {
  const pieces::ArrayFiles* const known = invocation.array_files;
  const bool is_in_parts =
      known != nullptr && (known->is_one(options.input) || known->is_one(options.output));
  return invocation.ranks != nullptr || options.pieces.memory > 0 ||
         !options.pieces.checkpoint.empty() || is_in_parts;
}

/// What pieces cannot have is better found before the mesh is read.
void check_pieces(const ImproveOptions& options, const Invocation& invocation) {
  const std::size_t count = options.pieces.pieces;  // 0: nobody knows yet
  try {
    pieces::check_memory(options.pieces.memory);
    if (is_by_files(options, invocation)) pieces::check_for_files(options.run);
  } catch (const OptionError& error) {
    throw UsageError("--" + message_of(error));
  }
  const bool is_whole = count == 1 || (count == 0 && !is_by_files(options, invocation));
  if (is_whole && !options.run.trace_piece.empty()) {
    throw UsageError("--trace-piece: the run is not in pieces, see --pieces");
  }
  if (count <= 1) return;
  pieces::Division division;
  division.pieces = count;
  try {
    pieces::check(options.run, division);
  } catch (const OptionError& error) {
    throw UsageError("--" + message_of(error));
  }
}

/// A run from file to file never has the whole mesh that the page draws.
void check_reports(const ImproveOptions& options, const Invocation& invocation) {
  if (!is_by_files(options, invocation)) return;
  for (const std::filesystem::path& file : options.reports) {
    if (lower_extension(file) == ".json") continue;
    throw UsageError(fmt::format(
        "--report {}: a run from file to file has its report as .json alone", file.string()));
  }
}

/// Where pieces lie: beside the output unless told otherwise.
std::filesystem::path scratch_parent(const ImproveOptions& options) {
  if (!options.pieces.scratch.empty()) return options.pieces.scratch;
  const std::filesystem::path folder = options.output.parent_path();
  return folder.empty() ? std::filesystem::path(".") : folder;
}

/// Reads, improves and writes with no more than a piece in memory, or with its share of each rank.
void improve_out_of_core(const ImproveOptions& options, ProgressLine& line,
                         std::optional<Interruption>& interruption, ImproveReport& report,
                         const Invocation& invocation) {
  if (formats::is_standard_stream(options.input) || formats::is_standard_stream(options.output)) {
    throw UsageError("a mesh in pieces is read from and written to files");
  }
  Ranks* const ranks = invocation.ranks;
  pieces::OutOfCore files;
  files.array_files = invocation.array_files;
  std::optional<pieces::ScratchFolder> scratch;
  if (ranks == nullptr || !options.pieces.scratch.empty()) {
    files.scratch = scratch.emplace(scratch_parent(options)).path();
  }
  files.input = options.input;
  files.output = options.output;
  files.memory = options.pieces.memory;
  files.checkpoint = options.pieces.checkpoint;
  files.label_array = options.carry.label_array;
  files.variant = options.carry.variant;
  files.tell_lost = [&](const std::vector<std::string>& lost) {
    tell_lost(options.input, lost, options.carry, report.file_notes);
  };
  files.costs = &report.costs;
  if (!options.reports.empty()) files.portrait = &report.portrait;
  files.first_id = invocation.first_vertex_id;
  files.needs_trace = true;
  pieces::Division division;
  division.pieces = options.pieces.pieces;
  OneRank alone;
  report.result = improve_watched(options, line, interruption, [&](const Options& run) {
    return pieces::improve_files(files, run, division,
                                 ranks != nullptr ? *ranks : static_cast<Ranks&>(alone));
  });
  report.writing = report.costs.writing;
}

/// Mesh, reports and trace: all are complete before any has its name.
/// @param trace null: there is none
void save_all(const ImproveOptions& options, const Mesh& mesh, ImproveReport& report,
              TraceRecorder* trace) {
  std::vector<std::unique_ptr<OutputFile>> reports;
  std::optional<Stopwatch> watch(report.writing);
  const auto complete_others = [&] {
    watch.reset();
    report.peak_memory = platform::peak_memory();
    reports = make_reports(options.reports, report);
    std::vector<formats::PendingFile*> files;
    for (const auto& each : reports) {
      if (each->pending() != nullptr) files.push_back(each->pending());
    }
    if (trace != nullptr) files.push_back(&trace->complete());
    return files;
  };
  face::save(options.output, mesh, options.run.threads, options.carry.variant, complete_others);
  for (const auto& each : reports) {
    if (each->pending() == nullptr) each->commit();
  }
}

void improve_in_core(const ImproveOptions& options, ProgressLine& line,
                     std::optional<Interruption>& interruption, ImproveReport& report) {
  std::unique_ptr<TraceRecorder> trace;
  const int threads = options.run.threads;
  Mesh mesh;
  {
    const Stopwatch watch(report.reading);
    line.show(fmt::format("reading {}", options.input.string()));
    line.clear();
    mesh = load_for(options.input, options.output, threads, options.carry, report.file_notes);
  }
  report.result = improve_watched(options, line, interruption, [&](const Options& run) {
    face::Portrait* const portrait = options.reports.empty() ? nullptr : &report.portrait;
    const bool shows_all = options.verbose || portrait != nullptr;
    if (!options.pieces.is_divided()) {
      return face::improve(mesh, run, trace, portrait,
                           shows_all ? face::Figures::all : face::Figures::judging);
    }
    pieces::Division division;
    division.pieces = options.pieces.pieces;
    return pieces::improve(mesh, run, division, {}, portrait, &trace);
  });
  face::number_tets(report.portrait, mesh);
  if (!report.result.trace_trouble.empty()) throw Error(report.result.trace_trouble);
  line.show(fmt::format("writing {}", options.output.string()));
  save_all(options, mesh, report, trace.get());
}

/// Of all ranks.
void note_peaks(ImproveReport& report, Ranks* ranks) {
  report.peak_memory = platform::peak_memory();
  if (ranks == nullptr) return;
  std::string bytes;
  pieces::put(std::uint64_t{report.peak_memory}, bytes);
  for (const std::string& from : ranks->gather(bytes)) {
    std::string_view rest = from;
    std::uint64_t peak = 0;
    pieces::take(rest, peak);
    report.peaks_of_ranks.push_back(peak);
    report.peak_memory = std::max<std::size_t>(report.peak_memory, peak);
  }
}

constexpr const char* kFolderFileHelp =
    R"(A file tetmend.conf of the folder in which the command runs holds options, a
line each: "goal = 35", "keep-size = true", and comments behind #. What the
command line says prevails, a line on standard error says what was taken, and
--no-config takes nothing. Options that name files to be written, and --plugin,
cannot stand there.

)";

/// "2, by the array 'part'"
std::string regions_in_words(const MeshData& data) {
  std::set<Label> labels;
  for (const MeshData::Tet& tet : data.tets) labels.insert(tet.label);
  const std::string count = grouped(labels.size());
  if (data.label_array.empty()) return count;
  return fmt::format("{}, by the array '{}'", count, printable(data.label_array));
}

/// The run with a schedule that tries nothing: all that is looked at before the first attempt, and
/// nothing written.
int run_dry(const ImproveOptions& options, const Invocation& invocation) {
  if (options.pieces.is_divided() || is_by_files(options, invocation)) {
    throw UsageError("--dry-run: it takes one file, and none of --pieces, --memory, --checkpoint");
  }
  ProgressLine progress(!options.quiet);
  ImproveReport report{.arguments = invocation.arguments, .options = options};
  Mesh mesh = load_for(options.input, would_be(options), options.run.threads, options.carry,
                       report.file_notes);
  report.regions = regions_in_words(MeshAccess::data(mesh));
  Options nothing = options.run;
  nothing.script = "-- nothing is tried";
  nothing.set.clear();
  nothing.trace.clear();
  report.result = tetmend::improve(mesh, nothing);
  progress.clear();
  if (options.quiet) return kSuccess;
  say(stream_beside(options.output),
      fmt::format("tetmend {}: {}, nothing is written\n{}", version(), options.input.string(),
                  format_prospect(report)));
  return kSuccess;
}

}  // namespace

int run_improve(ImproveOptions& options, Invocation& invocation) {
  const bool has_output = !options.output.empty();
  if (!has_output && !options.dry_run) throw UsageError("--output: OUT is missing");
  name_streams(options.format, options.input, has_output ? &options.output : nullptr);
  const bool is_first = invocation.ranks == nullptr || invocation.ranks->is_first();
  if (is_first) check_files(options, invocation);
  complete(options);
  if (options.dry_run) return run_dry(options, invocation);
  check_reports(options, invocation);
  check_pieces(options, invocation);
  if (options.pieces.is_divided() || invocation.ranks != nullptr) reuse_memory();
  if (!is_first) options.quiet = true;
  ProgressLine progress(!options.quiet);
  ImproveReport report{.arguments = invocation.arguments, .options = options};
  std::optional<Interruption> interruption;  // until all is written
  if (is_by_files(options, invocation)) {
    improve_out_of_core(options, progress, interruption, report, invocation);
    note_peaks(report, invocation.ranks);
    if (!is_first) return kSuccess;
    write_reports(options.reports, report);
  } else {
    improve_in_core(options, progress, interruption, report);
  }
  invocation.wrote_files = true;
  progress.clear();
  if (!options.quiet) {
    say(stream_beside(options.output), format_outcome(report));
  }
  if (report.result.ending == Ending::cancelled) {
    return complain(kInterrupted, "interrupted: wrote the mesh as improved so far");
  }
  return goal_status(options, report.result);
}

int goal_status(const ImproveOptions& options, const Result& result) {
  const std::size_t n_bad = result.after.n_bad;
  if (options.goal.empty() || n_bad == 0) return kSuccess;
  return complain(kGoalMissed,
                  fmt::format("the goal {} is missed by {} {}: wrote the mesh", options.goal,
                              grouped(n_bad), n_bad == 1 ? "tet" : "tets"));
}

void add_improve(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<ImproveOptions>();
  CLI::App* command = app.add_subcommand("improve", "Improve a mesh and keep its surface");
  add_improve_options(*command, *options);
  const bool alone = invocation.ranks == nullptr;
  if (alone) {
    add_dry_run_option(*command, *options);
    add_folder_option(*command);
  }
  command->footer(fmt::format(
      R"(Removes slivers and raises the worst dihedral angles. Checks that the surface is
untouched and no tet got inverted, and prints the main figures before and after;
with -v all of them and the time of each pass. On a terminal a line shows the
progress, and how long a pass that takes long still needs.

{}An operator of a plugin that does not come back is named; two seconds after the
time limit or Ctrl-C it ends the run with exit status 1, and no mesh is written.
Mesh, reports and trace appear together: where one cannot be written, none is.
Where the mesh goes from file to file (--memory, --checkpoint, parts), the trace
comes before it and reports after it.

Ctrl-C, SIGTERM, SIGUSR1, SIGXCPU and their like stop the work: OUT is still
written, with the mesh as improved so far, and the exit status is 4. The second
time, or while IN is read, they end the program at once, and nothing is written.
A time limit stops the work likewise, with exit status 0. A mistake in a script
ends it with exit status 1, and nothing is written.
OUT appears only when it is complete; an older file of that name stays until
then, and hands down owner and permissions. OUT may be IN, in the same format;
all other files that are read or written must differ, also parts of meshes and
what decks include. The same input gives the same output, byte for byte.

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
{}  mesher | tetmend improve - -o - --format msh | solver

Exit status: 0 success, 1 the work failed and OUT is as it was (but see above),
2 wrong usage, 3 written, but tets miss the goal that --goal asked for, 4
written, but interrupted)",
      alone ? kFolderFileHelp : "", region_help(), mesh_format_list(),
      alone ? "  tetmend improve part.mesh --dry-run\n" : ""));
  command->callback([options, &invocation] {
    invocation.action = [options, &invocation] { return run_improve(*options, invocation); };
  });
}

}  // namespace tetmend::apps
