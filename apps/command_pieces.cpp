// SPDX-License-Identifier: MIT
// tetmend pieces: a run in pieces as programs that any task engine can start.
#include <array>
#include <charconv>
#include <memory>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tetmend/option_text.h>

#include "apps/command_improve.h"
#include "apps/commands.h"
#include "apps/files.h"
#include "apps/help_formatter.h"
#include "apps/improve_options.h"
#include "apps/improve_report.h"
#include "apps/improve_watched.h"
#include "apps/mesh_formats.h"
#include "apps/number_check.h"
#include "apps/standard_streams.h"
#include "explain/json_text.h"
#include "kernel/formats/output_file.h"
#include "pieces/folder_run.h"
#include "pieces/improve.h"
#include "platform/platform.h"

namespace tetmend::apps {
namespace {

struct PiecesOptions {
  std::string step;
  std::filesystem::path folder;
  std::vector<std::string> more;
  std::string share;
  ImproveOptions improve;
};

std::size_t to_number(const std::string& text, std::string_view what) {
  std::size_t number = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end || text.empty()) {
    throw UsageError(fmt::format("{}: '{}' is not a number", what, text));
  }
  return number;
}

constexpr const char* kPlan = "plan.json";

/// The meshes of the run and what is in its folder, and what a step writes besides.
/// @throws UsageError where these are the same
void check_step(const PiecesOptions& options, const pieces::FolderRun& run,
                std::vector<NamedFile> outputs, const Invocation& invocation) {
  using enum NamedFile::Kind;
  const std::array inputs = {NamedFile{"IN", run.saved().input, mesh, true},
                             NamedFile{"FOLDER", options.folder / kPlan}};
  outputs.insert(outputs.begin(),
                 {{"FOLDER", options.folder, run_folder}, {"OUT", run.saved().output, mesh, true}});
  check_distinct(inputs, outputs, invocation.array_files);
}

/// For people and task engines: what is to be done next.
void write_plan(const std::filesystem::path& folder, const pieces::FolderRun& run) {
  nlohmann::json plan = {{"input", run.saved().input},
                         {"output", run.saved().output},
                         {"finished", run.is_finished()}};
  if (!run.is_finished()) {
    const pieces::Round round = run.round();
    plan["round"] = round.number;
    plan["name"] = round.name;
    plan["pieces"] = round.pieces.size();
  }
  OutputFile out(folder / kPlan);
  out.put(explain::json_text(plan, 2) + '\n');
  out.commit();
}

void say_round(const pieces::FolderRun& run) {
  const pieces::Round round = run.round();
  say(stdout, fmt::format("round {}, {}: pieces 0 to {}\n", round.number, round.name,
                          round.pieces.size() - 1));
}

int split(PiecesOptions& options, Invocation& invocation) {
  reuse_memory();
  ImproveOptions& improve = options.improve;
  if (options.more.size() != 1)
    throw UsageError("pieces split FOLDER IN: IN, one mesh, is missing");
  if (improve.output.empty()) throw UsageError("pieces split: -o OUT is missing");
  if (improve.pieces.pieces < 2)
    throw UsageError("pieces split: --pieces N, 2 or more, is missing");
  improve.input = options.more.front();
  check_formats(improve.input, improve.output, improve.carry, invocation.array_files);
  using enum NamedFile::Kind;
  std::vector<NamedFile> inputs = files_of_options(improve.run);
  inputs.insert(inputs.begin(), {"IN", improve.input, mesh, true});
  const std::array outputs = {NamedFile{"-o", improve.output, mesh, true},
                              NamedFile{"FOLDER", options.folder, run_folder},
                              NamedFile{"FOLDER", options.folder / kPlan}};
  check_distinct(inputs, outputs, invocation.array_files);
  prepare_files({}, {outputs.data(), 1}, invocation.array_files);  // the folder is yet to be made
  complete(improve);
  pieces::Division division;
  division.pieces = improve.pieces.pieces;
  std::vector<std::string> notes;
  pieces::OutOfCore files;
  files.array_files = invocation.array_files;
  files.input = improve.input;
  files.output = improve.output;
  files.label_array = improve.carry.label_array;
  files.variant = improve.carry.variant;
  files.asks_for_goal = !improve.goal.empty();
  files.tell_lost = [&](const std::vector<std::string>& lost) {
    tell_lost(improve.input, lost, improve.carry, notes);
  };
  try {
    pieces::FolderRun::split(files, options.folder, improve.run, division);
  } catch (const OptionError& error) {
    throw Error("--" + message_of(error));
  }
  invocation.wrote_files = true;
  const pieces::FolderRun run(options.folder);
  write_plan(options.folder, run);
  const pieces::SavedRun& saved = run.saved();
  if (saved.division.pieces < division.pieces) {
    complain(kSuccess, pieces::why_fewer_pieces(division.pieces, saved.division.pieces,
                                                saved.before.figures.statistics.tets));
  }
  if (!improve.quiet) say_round(run);
  return kSuccess;
}

/// The pieces of this call: those that are named, or of all that are open those of a share.
std::vector<std::size_t> chosen(const PiecesOptions& options, const pieces::FolderRun& run) {
  std::vector<std::size_t> numbers;
  for (const std::string& text : options.more) numbers.push_back(to_number(text, "pieces improve"));
  if (!numbers.empty() || run.is_finished()) return numbers;
  std::size_t which = 0;
  std::size_t count = 1;
  if (!options.share.empty()) {
    const std::size_t slash = options.share.find('/');
    if (slash == std::string::npos) {
      throw UsageError(fmt::format("--share: '{}' is not of the form I/N", options.share));
    }
    which = to_number(options.share.substr(0, slash), "--share");
    count = to_number(options.share.substr(slash + 1), "--share");
    if (which >= count) {
      throw UsageError(fmt::format("--share {}: shares are counted from 0 to {}", options.share,
                                   count == 0 ? 0 : count - 1));
    }
  }
  for (const std::size_t part : run.round().open) {
    if (part % count == which) numbers.push_back(part);
  }
  return numbers;
}

int improve(PiecesOptions& options, Invocation& invocation) {
  reuse_memory();
  pieces::FolderRun run(options.folder);
  const std::vector<std::size_t> numbers = chosen(options, run);
  if (run.is_finished())
    return kSuccess;  // rounds are planned before it is known how many there are
  check_step(options, run, {{"--trace", options.improve.run.trace}}, invocation);
  ProgressLine line(!options.improve.quiet);
  std::optional<Interruption> interruption;
  std::size_t done = 0;
  std::string trace_trouble;
  bool is_told_to_stop = false;
  improve_watched(options.improve, line, interruption, [&](const Options& watched) {
    done = run.improve(numbers, watched, &trace_trouble);
    is_told_to_stop = watched.cancel->load();
    return Result();
  });
  line.clear();
  invocation.wrote_files = true;
  if (!options.improve.quiet) {
    say(stdout, fmt::format("{}: {} {} finished\n", run.round().name, done,
                            done == 1 ? "piece" : "pieces"));
  }
  if (!trace_trouble.empty()) {
    return complain(kFailed, fmt::format("{}: finished the piece, and no trace", trace_trouble));
  }
  if (is_told_to_stop) return complain(kInterrupted, "interrupted: finished pieces are kept");
  return kSuccess;
}

int join(PiecesOptions& options, Invocation& invocation) {
  reuse_memory();
  ImproveOptions& improve = options.improve;
  pieces::FolderRun run(options.folder, invocation.array_files);
  if (run.is_finished()) {
    if (!improve.quiet) say(stdout, fmt::format("finished: {}\n", run.saved().output));
    return kSuccess;
  }
  for (const std::filesystem::path& report : improve.reports) {
    if (lower_extension(report) != ".json") {
      throw UsageError(fmt::format("--report {}: a run in pieces has its report as .json alone",
                                   report.string()));
    }
  }
  std::vector<NamedFile> reports;
  for (const std::filesystem::path& report : improve.reports) {
    reports.push_back({"--report", report});
  }
  check_step(options, run, reports, invocation);
  face::Portrait portrait;
  const std::optional<Result> result =
      run.join(improve.run, improve.reports.empty() ? nullptr : &portrait);
  invocation.wrote_files = true;
  write_plan(options.folder, run);
  if (!result) {
    if (!improve.quiet) say_round(run);
    return kSuccess;
  }
  improve.input = run.saved().input;
  improve.output = run.saved().output;
  for (const auto& [name, value] : run.saved().options) {
    set_option(improve.run, name, value);
    if (name == "goal" && run.saved().asks_for_goal) improve.goal = value;
  }
  ImproveReport report{.arguments = invocation.arguments, .options = improve};
  report.result = *result;
  report.portrait = std::move(portrait);
  report.peak_memory = platform::peak_memory();
  write_reports(improve.reports, report);
  if (!improve.quiet) say(stdout, format_outcome(report));
  return goal_status(improve, report.result);
}

int run_pieces(PiecesOptions& options, Invocation& invocation) {
  const Options& run = options.improve.run;
  if (options.step != "improve" && (!run.trace.empty() || run.check_operators)) {
    throw UsageError("pieces: --trace and --check-operators are options of improve");
  }
  if (options.step == "split") return split(options, invocation);
  const bool has_more = !options.improve.output.empty() || options.improve.pieces.pieces != 0;
  if (has_more) throw UsageError("pieces: -o and --pieces are options of split");
  if (options.step == "improve") return improve(options, invocation);
  if (!options.more.empty()) throw UsageError("pieces join FOLDER: nothing may follow");
  return join(options, invocation);
}

void add_steps(CLI::App& command, PiecesOptions& options) {
  command.add_option("STEP", options.step, "split, improve or join")
      ->required()
      ->type_name("")
      ->check(CLI::Validator(
          [](const std::string& step) {
            const bool is_one = step == "split" || step == "improve" || step == "join";
            return is_one ? std::string()
                          : fmt::format("'{}' is none of split, improve, join", step);
          },
          ""));
  command.add_option("FOLDER", options.folder, "Folder of the run; new for split")
      ->required()
      ->type_name("");
  command
      .add_option(
          "MORE", options.more,
          "split: the mesh. improve: numbers of pieces\n(default: all that are not finished)")
      ->type_name("");
  command
      .add_option("-o,--output", options.improve.output,
                  "split: file for the improved mesh, which the\nlast join writes")
      ->type_name("OUT");
  command
      .add_option("--pieces", options.improve.pieces.pieces,
                  "split: into how many pieces, 2 to 65535;\nthe result depends on it")
      ->check(number_from(std::size_t{2}, std::size_t{65'535}))
      ->type_name("N");
  command
      .add_option("--share", options.share,
                  "improve: of the pieces that are not finished\nthose whose number leaves I when "
                  "divided by N")
      ->type_name("I/N");
}

}  // namespace

void add_pieces(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<PiecesOptions>();
  CLI::App* command =
      app.add_subcommand("pieces", "Improve a mesh in pieces, by tasks over the files of a folder");
  add_steps(*command, *options);
  add_options_of_pieces(*command, options->improve);
  group_options(*command);
  command->footer(
      R"(A run has rounds: three divisions of the mesh, then up to four rounds of zones
around the worst tets. 'split' divides the mesh for the first round. 'improve'
works on pieces of the round, any number of times at once, on any machine that
has the folder. 'join' begins the next round when all pieces are finished; in
the end it checks everything and writes OUT. OUT has the bytes of
'tetmend improve --pieces N' with the same options, which 'split' takes: they
are the run's from then on, but for --threads. A SPEC is what it is there.

FOLDER/plan.json says what is to be done: "round", its "name", its number of
"pieces", which count from 0, and whether all is "finished". Each program may be
killed and started again; a piece that is finished is not worked on again. After
the last round improve and join do nothing, so that seven rounds may be
scheduled beforehand.

Examples:
  tetmend pieces split work part.meshb -o better.meshb --pieces 8
  tetmend pieces improve work 3            piece 3 of this round
  tetmend pieces improve work --share 0/4  a quarter of its pieces
  tetmend pieces join work                 begins the next round, or writes OUT

Exit status: 0 success, 1 the work failed, or join finds that a piece is
missing, 2 wrong usage, 3 the last join wrote OUT, and tets miss the goal that
'split' was given, 4 interrupted: the pieces that were finished are kept)");
  command->callback([options, &invocation] {
    invocation.action = [options, &invocation] { return run_pieces(*options, invocation); };
  });
}

}  // namespace tetmend::apps
