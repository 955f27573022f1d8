// SPDX-License-Identifier: MIT
// tetmend trace: looks into a recorded run.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tetmend/catalogue.h>

#include "apps/commands.h"
#include "apps/files.h"
#include "apps/standard_streams.h"
#include "explain/figures/call_figure.h"
#include "explain/lesson_guide.h"
#include "explain/page.h"
#include "figure/drawing_file.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/formats/output_file.h"
#include "kernel/formats/vtk_legacy.h"
#include "kernel/printable.h"
#include "trace/call_extract.h"
#include "trace/call_script.h"
#include "trace/call_tree.h"
#include "trace/history.h"
#include "trace/ledger.h"
#include "trace/replay.h"
#include "trace/run_comparison.h"
#include "trace/trace_file.h"
#include "trace/trace_summary.h"

namespace tetmend::apps {
namespace {

struct TraceOptions {
  std::filesystem::path file;
  std::filesystem::path output;
  std::optional<std::uint32_t> tree;
  std::optional<std::uint32_t> dot;
  std::optional<std::uint64_t> at;
  std::optional<std::uint32_t> extract;
  std::string history;
  bool ledger = false;
  std::filesystem::path against;
  bool json = false;  // of a ledger or a comparison
  bool all = false;   // the calls of a history
  bool slices = false;
  bool html = false;
  std::string html_call;  // a number; empty: of the whole trace
  std::string figure;
  std::optional<std::uint32_t> call;
  std::vector<double> look;  // yaw and pitch
};

void check_call(const TraceFile& file, std::uint32_t call) {
  if (call < file.calls().size()) return;
  throw Error(fmt::format("there is no call {}; the trace has {}, counted from 0", call,
                          file.calls().size()));
}

/// To the file that was asked for, or to standard output.
void put_text(const TraceOptions& options, std::string_view text) {
  if (options.output.empty()) {
    say(stdout, text);
    return;
  }
  OutputFile out(options.output);
  out.put(text);
  out.commit();
}

void write_slices(const TraceOptions& options, const TraceFile& file) {
  if (options.output.empty()) {
    tetmend::write_slices(file, [](std::string_view text) { say(stdout, text); });
    return;
  }
  OutputFile out(options.output);
  tetmend::write_slices(file, [&](std::string_view text) { out.put(text); });
  out.commit();
}

/// 1: created by the last event; 2: removed by the next one; 3: both.
std::vector<std::int32_t> cavity_field(const TraceFile& file, Replay& replay) {
  std::vector<std::int32_t> by_slot(replay.mesh().tet_slots(), 0);
  for (const CavityTet& t : replay.cavity().created) by_slot[t.tet.index()] |= 1;
  const std::uint64_t here = replay.position();
  if (here < file.event_count()) {
    replay.seek(here + 1);
    for (const CavityTet& t : replay.cavity().removed) by_slot[t.tet.index()] |= 2;
    replay.seek(here);
  }
  std::vector<std::int32_t> live;
  for (std::uint32_t i = 0; i < by_slot.size(); ++i) {
    if (!replay.mesh().is_deleted(TetHandle(i))) live.push_back(by_slot[i]);
  }
  return live;
}

/// The values of a measure of a program, as an array with its name.
void add_own_measure(const SlotMesh& mesh, MeshData& data) {
  const OwnMeasure* own = mesh.standard().own();
  if (own == nullptr) return;
  std::vector<double> values;
  for (const Quality q : qualities_of_tets(mesh)) values.push_back(q * own->good);
  data.tet_data.push_back({.name = own->name, .values = std::move(values)});
}

void write_mesh_at(const TraceOptions& options, const TraceFile& file) {
  if (*options.at > file.event_count()) {
    throw Error(fmt::format("--at {}: the trace has {} events", *options.at, file.event_count()));
  }
  Replay replay(file, 0);
  replay.seek(*options.at);
  MeshData data = replay.mesh().to_data();
  add_own_measure(replay.mesh(), data);
  if (options.output.extension() != ".vtk") return write_mesh(options.output, data);
  const std::vector<std::int32_t> cavity = cavity_field(file, replay);
  const formats::TetField field{"cavity", cavity};
  formats::write_vtk_legacy(options.output, MeshView(data), {&field, 1});
}

std::string history(const TraceOptions& options, const TraceFile& file) {
  Replay replay(file, 0);
  const HistorySubject subject = find_subject(file, replay, options.history);
  try {
    constexpr std::size_t kMostCalls = 20;
    const History found = history_of(file, replay, subject);
    return options.all ? history_text(file, found) : history_text(file, found, kMostCalls);
  } catch (const Error& error) {
    throw Error(fmt::format("--history {}: {}", options.history, error.what()));
  }
}

std::string ledger(const TraceOptions& options, const TraceFile& file) {
  const Ledger made = make_ledger(file);
  return options.json ? ledger_json(file, made) : format_ledger(made);
}

std::string comparison(const TraceOptions& options, const TraceFile& file) {
  const TraceFile other(options.against);
  if (!other.damage().empty()) complain(kSuccess, "warning: " + other.damage());
  const RunComparison made = compare_runs(file, other);
  return options.json ? comparison_json(file, other, made) : format_comparison(file, other, made);
}

void write_text(const std::filesystem::path& file, std::string_view text) {
  OutputFile out(file);
  out.put(text);
  out.commit();
}

/// The name of a file, fit for a comment of one line.
std::string name_of(const std::filesystem::path& file) {
  return printable(file.filename().string());
}

constexpr std::array<const char*, 3> kExtracted = {"call.mesh", "call.lua", "README.txt"};

/// A folder with all that repeating one call needs.
void write_extract(const TraceOptions& options, const TraceFile& file) {
  check_call(file, *options.extract);
  Replay replay(file, 0);
  const CallExtract kit = extract_call(file, replay, *options.extract);
  const Call& call = file.calls()[kit.call];
  const std::string script = script_of_call(file, call);
  const Goal& goal = kit.standard.goal();
  std::error_code failed;
  std::filesystem::create_directories(options.output, failed);
  write_mesh(options.output / kExtracted[0], kit.mesh);
  write_text(
      options.output / kExtracted[1],
      fmt::format("-- Call {} of {}: {} -> {}\n"
                  "goal{{min = {}, max = {}}}\njudge_by{{measure = \"{}\", price = {}}}\n"
                  "attempt({}, {{{}}}{})\n",
                  kit.call, name_of(options.file), describe_call(file, kit.call),
                  call.verdict_text(), goal.min_angle, goal.max_angle, kit.standard.measure_name(),
                  kit.standard.price(), script, fmt::join(kit.target, ", "),
                  kit.tet.empty() ? "" : fmt::format(", {{{}}}", fmt::join(kit.tet, ", "))));
  write_text(options.output / kExtracted[2],
             fmt::format("Repeats call {} of a run of {}\n\n"
                         "  tetmend improve call.mesh -o out.mesh --schedule call.lua --layers "
                         "improve --goal {},{}{} --trace out.trace\n"
                         "  tetmend trace out.trace --tree 0\n\nIn the run:\n\n{}",
                         kit.call, file.header().program, kit.goal.min_angle, kit.goal.max_angle,
                         kit.frozen ? fmt::format(" --protect label:{}", *kit.frozen) : "",
                         call_tree_text(file, kit.call)));
}

/// The option is text, because CLI11 takes a number that is not there for 0.
std::uint32_t read_call(const std::string& text) {
  std::uint32_t call = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), call);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw UsageError(fmt::format("--html: '{}' is no number of a call", text));
  }
  return call;
}

/// A call, or the whole trace with the lesson that may lie beside it.
void write_html(const TraceOptions& options, const TraceFile& file) {
  constexpr std::uint64_t kMostEvents = 30000;
  std::optional<Lesson> lesson;
  explain::PageRequest request{.title = name_of(file.header().input),
                               .range = {0, file.event_count()},
                               .program = fmt::format("tetmend {}", version())};
  if (!options.html_call.empty()) {
    const std::uint32_t call = read_call(options.html_call);
    check_call(file, call);
    request.title = explain::title_of_call(file, call);
    request.range = explain::range_of_call(file, call);
  } else if ((lesson = explain::lesson_of(options.file, file.event_count()))) {
    request.title = lesson->title;
    request.lesson = &*lesson;
  }
  if (request.range.end - request.range.begin > kMostEvents) {
    throw Error(
        fmt::format("{} events are too many for a page, which has {} at most: choose a call; "
                    "the largest are {}",
                    request.range.end - request.range.begin, kMostEvents,
                    fmt::join(summarize(file).largest, ", ")));
  }
  Replay replay(file);
  const explain::Page page = explain::write_page(file, replay, request);
  if (page.deepest) {
    complain(kSuccess, fmt::format("note: calls with more than {} calls around them are one step "
                                   "each, to keep the page below {} MB",
                                   *page.deepest, explain::kLargestPage / 1'000'000));
  }
  put_text(options, page.html);
}

/// The options of --figure, and --call and --look, which are nothing without it.
void check_figure(const TraceOptions& options) {
  if (options.figure.empty()) {
    if (options.call) throw UsageError("--call is for --figure");
    if (!options.look.empty()) throw UsageError("--look is for --figure shell");
    return;
  }
  if (options.output.empty()) throw UsageError("--figure needs -o, a .svg, .pdf or .tex file");
  explain::FigureKind kind{};
  try {
    kind = explain::find_figure_kind(options.figure);
    figure::check_drawing_name(options.output);
  } catch (const Error& error) {
    throw UsageError(fmt::format("--figure: {}", error.what()));
  }
  if (!options.call && kind != explain::FigureKind::timeline) {
    throw UsageError(fmt::format("--figure {} needs --call", options.figure));
  }
  if (!options.look.empty() && kind != explain::FigureKind::shell) {
    throw UsageError("--look is for --figure shell");
  }
}

void write_figure(const TraceOptions& options, const TraceFile& file) {
  explain::FigureRequest request{explain::find_figure_kind(options.figure), options.call, {}};
  if (!options.look.empty()) request.look = explain::Look{options.look[0], options.look[1]};
  Replay replay(file, 0);
  figure::write_drawing(options.output, explain::draw_call(file, replay, request));
}

void check_outputs(const TraceOptions& options) {
  using enum NamedFile::Kind;
  std::vector<NamedFile> inputs = {{"FILE", options.file}};
  if (!options.against.empty()) inputs.push_back({"the trace of --against", options.against});
  if (!options.history.empty()) {
    inputs.push_back({"the mesh of --history", file_of_question(options.history), mesh});
  }
  if (options.html && options.html_call.empty()) {
    inputs.push_back({"the lesson", explain::lesson_beside(options.file).value_or("")});
  }
  if (options.extract) {
    std::vector<NamedFile> outputs;
    for (const char* name : kExtracted) outputs.push_back({name, options.output / name});
    check_distinct(inputs, outputs, nullptr);
  } else if (!options.output.empty()) {
    const NamedFile output = {"-o", options.output, options.at ? mesh : plain};
    prepare_files(inputs, {&output, 1}, nullptr);
  }
}

int run_trace(const TraceOptions& options) {
  check_figure(options);
  if (options.all && options.history.empty()) throw UsageError("--all is for --history");
  if (options.json && !options.ledger && options.against.empty()) {
    throw UsageError("--json is for --ledger and --against");
  }
  if (!options.html_call.empty()) read_call(options.html_call);
  if (options.at) {
    if (options.output.empty()) throw UsageError("--at needs -o, a file for the mesh");
    check_mesh_extension(options.output);
  }
  if (options.extract && options.output.empty()) {
    throw UsageError("--extract needs -o, a folder for the files");
  }
  check_outputs(options);
  const TraceCheck check = options.ledger ? TraceCheck::events : TraceCheck::mesh;
  const TraceFile file(options.file, check);
  if (!file.damage().empty()) complain(kSuccess, "warning: " + file.damage());
  if (options.at) {
    write_mesh_at(options, file);
  } else if (options.extract) {
    write_extract(options, file);
  } else if (!options.history.empty()) {
    put_text(options, history(options, file));
  } else if (options.ledger) {
    put_text(options, ledger(options, file));
  } else if (!options.against.empty()) {
    put_text(options, comparison(options, file));
  } else if (!options.figure.empty()) {
    write_figure(options, file);
  } else if (options.html) {
    write_html(options, file);
  } else if (options.slices) {
    write_slices(options, file);
  } else if (options.tree) {
    check_call(file, *options.tree);
    put_text(options, call_tree_text(file, *options.tree));
  } else if (options.dot) {
    check_call(file, *options.dot);
    put_text(options, call_tree_dot(file, *options.dot));
  } else {
    put_text(options, format_summary(file, summarize(file)));
  }
  return 0;
}

void add_figure_options(CLI::App& command, CLI::Option_group& what, TraceOptions& options) {
  what.add_option(
          "--figure", options.figure,
          "A figure for papers, -o x.svg, x.pdf or x.tex: the ring of a\ncall, its tree, the "
          "timeline or the isolated shell")
      ->type_name("KIND");
  command.add_option("--call", options.call, "The call of a figure; a timeline may be without")
      ->type_name("CALL");
  command
      .add_option("--look", options.look,
                  "Where a shell is seen from, in degrees; without it,\nwhere its corners are far "
                  "from each other")
      ->type_name("YAW,PITCH")
      ->delimiter(',')
      ->expected(2);
}

void add_history_options(CLI::App& command, CLI::Option_group& what, TraceOptions& options) {
  what.add_option("--history", options.history,
                  "Why a tet is still there: who aimed at it or its\nparts, and what was missing")
      ->type_name("WHAT");
  command.add_flag("--all", options.all, "Of a history, every call instead of the 20 nearest");
}

void add_ledger_options(CLI::App& command, CLI::Option_group& what, TraceOptions& options) {
  what.add_flag("--ledger", options.ledger, "Who was asked how often, how that ended and why");
  what.add_option(
          "--against", options.against,
          "Two runs side by side: ledgers, time, tets that are\nbad in FILE and good in the "
          "other")
      ->type_name("TRACE");
  command.add_flag("--json", options.json, "Ledger or comparison as JSON");
}

}  // namespace

void add_trace(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<TraceOptions>();
  CLI::App* command = app.add_subcommand("trace", "Look into a run that was recorded");
  command->add_option("FILE", options->file, "What 'tetmend improve --trace FILE' wrote")
      ->required()
      ->type_name("");
  command->add_option("-o,--output", options->output, "File for the output, instead of the screen")
      ->type_name("OUT");
  CLI::Option_group* what = command->add_option_group("what");
  what->add_option("--tree", options->tree, "A call and all calls in it, as text")
      ->type_name("CALL");
  what->add_option("--dot", options->dot, "The same as a graph for Graphviz")->type_name("CALL");
  CLI::Option* html =
      what->add_option("--html", options->html_call,
                       "A page for a browser that steps through a call, or\nthrough all of a small "
                       "trace")
          ->type_name("[CALL]")
          ->expected(0, 1);
  what->add_flag("--slices", options->slices,
                 "The whole trace as JSON for Perfetto and\nchrome://tracing");
  what->add_option("--at", options->at, "Mesh after the first N events; needs -o")->type_name("N");
  what->add_option("--extract", options->extract,
                   "A folder (-o) with a small mesh and a schedule\nthat repeat a call")
      ->type_name("CALL");
  add_history_options(*command, *what, *options);
  add_ledger_options(*command, *what, *options);
  what->require_option(0, 1);
  add_figure_options(*command, *what, *options);
  command->footer(R"(Without an option: a summary, with the numbers of the largest calls. Calls and
events are counted from 0; vertices are named by their handle numbers. Of
--at N -o mesh.vtk the field 'cavity' is 1 for tets that event N - 1 created, 2
for those that event N removes, 3 for both. WHAT is tet:N, tet:worst, edge:A,B,
face:A,B,C or vertex:N, in the numbers of the trace at its end, or with @MESH
behind in those of the file that the run wrote or read, counted from 1; of a tet
that is gone, tet:A,B,C,D. KIND is ring, tree, timeline or shell. A trace that
is cut off or damaged is read up to there, with a warning.

Examples:
  tetmend improve part.mesh -o better.mesh --trace run.trace
  tetmend trace run.trace
  tetmend trace run.trace --ledger
  tetmend trace shell.trace --against thorough.trace
  tetmend trace run.trace --tree 17
  tetmend trace run.trace --dot 17 | dot -Tsvg -o call.svg
  tetmend trace run.trace --html 17 -o call.html
  tetmend trace run.trace --figure ring --call 17 -o ring.svg
  tetmend trace run.trace --figure timeline -o timeline.pdf
  tetmend trace run.trace --slices -o run.json
  tetmend trace run.trace --at 1200 -o then.vtk
  tetmend trace run.trace --extract 17 -o report
  tetmend trace run.trace --history tet:worst
  tetmend trace run.trace --history tet:1234@better.mesh

Exit status: 0 success, 1 the work failed, 2 wrong usage)");
  command->callback([options, html, &invocation] {
    options->html = html->count() > 0;
    invocation.action = [options] { return run_trace(*options); };
  });
}

}  // namespace tetmend::apps
