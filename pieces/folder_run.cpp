// SPDX-License-Identifier: MIT
//   split: slices -> step-1/gathered-*
//   improve: step-1/gathered-3 -> step-1/stored-3, then step-1/outcome-3
//   join: all step-1/stored-* -> step-2/gathered-*, then the file `run`: from now on it is round 2
#include "pieces/folder_run.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tetmend/option_text.h>

#include "face/arena.h"
#include "face/plan.h"
#include "face/watcher.h"
#include "face/worse.h"
#include "pieces/bytes.h"
#include "pieces/improve.h"
#include "pieces/mesh_output.h"
#include "pieces/piece_trace.h"

namespace tetmend::pieces {

namespace {

std::string outcome_name(std::size_t part) {
  return fmt::format("outcome-{}", part);
}

/// The options that a round needs, looked through.
class Tools {
 public:
  explicit Tools(const Options& options)
      : options_(options),
        plan_(options),
        watcher_(options),
        settings_(plan_.schedule, plan_.settings),
        task_{plan_.registry, plan_.schedule, settings_, plan_.standard} {
    task_.check_operators = options.check_operators;
    task_.watcher = &watcher_;
  }

  const TaskOptions& task() const { return task_; }
  void record(PieceTrace& trace) { task_.trace = &trace; }
  face::Plan& plan() { return plan_; }
  face::Watcher& watcher() { return watcher_; }
  bool is_to_stop() const {
    return watcher_.stopped() || (options_.cancel != nullptr && options_.cancel->load());
  }

 private:
  const Options& options_;
  face::Plan plan_;
  face::Watcher watcher_;
  AimSettings settings_;
  TaskOptions task_;
};

/// What a run is of, before anything is known of the mesh.
SavedRun begun(const OutOfCore& files, const Options& options, const Division& division) {
  SavedRun saved;
  saved.input = std::filesystem::absolute(files.input).string();
  saved.output = std::filesystem::absolute(files.output).string();
  saved.label_array = files.label_array;
  saved.variant = files.variant;
  saved.asks_for_goal = files.asks_for_goal;
  saved.options = texts_of(options);
  saved.division = division;
  saved.run.is_divided = true;
  return saved;
}

}  // namespace

FolderRun::FolderRun(const std::filesystem::path& folder, const ArrayFiles* array_files)
    : folder_(folder), saved_(folder_.load()), array_files_(array_files) {
  for (const auto& [name, value] : saved_.options) {
    if (name != "size") continue;
    throw Error(fmt::format("{}: has a run of 'tetmend adapt': repeat the command that began it",
                            folder_.path().string()));
  }
}

/// Others may have gone on since the state was loaded.
void FolderRun::load_again() {
  SavedRun now = folder_.load();
  if (RunFolder::step_of(now.run) != RunFolder::step_of(saved_.run) ||
      now.is_finished != saved_.is_finished) {
    throw Error(fmt::format("{}: another program has ended this round", folder_.path().string()));
  }
  saved_ = std::move(now);
}

void FolderRun::split(const OutOfCore& files, const std::filesystem::path& folder,
                      const Options& options, const Division& division) {
  check_for_files(options);
  check(options, division);
  if (division.pieces < 2) throw OptionError("pieces", "pieces: at least 2 are needed");
  const RunFolder run_folder(folder);
  const auto check_empty = [&] {
    std::error_code ignored;
    if (run_folder.is_empty() || !std::filesystem::exists(folder, ignored)) return;
    throw Error(fmt::format("{}: is not empty: a new folder is needed", folder.string()));
  };
  check_empty();
  const FolderLock lock(folder, platform::Sharing::none);
  check_empty();  // what another program has made meanwhile
  face::on_threads(face::threads_of(options), [&] {
    Tools tools(options);
    OneRank ranks;
    SavedRun saved = begun(files, options, division);
    try {
      InputMesh mesh_file(files.input, ranks, files.array_files, files.label_array);
      if (!tools.plan().surface.is_fixed()) mesh_file.set_surface_moves();
      saved.division.pieces = limited_pieces(division.pieces, mesh_file.tets());
      saved.input_content = identify(files.input, ranks);
      saved.vertices = mesh_file.vertices();
      saved.holds_more = mesh_file.holds_more(files.output);
      mesh_file.check_conserve(options.conserve);
      if (files.tell_lost) files.tell_lost(mesh_file.lost_in(files.output));
      FolderShelf slices(run_folder.make_step(0));
      DividedMesh mesh(slices, ranks, saved.vertices);
      add_protected(mesh_file, options, mesh, saved.division.pieces);
      PieceRun steps(mesh, saved.division, tools.task());
      SealedShelf first = run_folder.new_step(1, saved);
      saved.before = steps.measure_before({.rulers = true,
                                           .histograms = true,
                                           .vertices = saved.vertices,
                                           .tets = mesh_file.tets()},
                                          &first);
      if (!tools.plan().surface.is_fixed()) {
        tools.plan().surface.check_length(mesh.diagonal());
        run_folder.save_surface(
            saved, steps.hold_surface(tools.plan().surface.envelope_options(), &first));
      }
      check_before(saved.before.figures, options, files.input);
      const MeshStatistics& before = saved.before.figures.statistics;
      saved.run.limits = {before.tets, before.n_bad,
                          tools.plan().growth.most(before.tets).value_or(RunLimits().most_tets)};
      saved.run.bounds = steps.state().bounds;
      saved.mesh = mesh.state();
      run_folder.save(saved);
    } catch (...) {
      run_folder.clear();
      throw;
    }
  });
}

Options FolderRun::options_of_run(const Options& options) const {
  Options all = options;
  for (const auto& [name, value] : saved_.options) set_option(all, name, value);
  return all;
}

/// A checkpoint is between two rounds: its next one is begun.
void FolderRun::open() {
  if (saved_.run.is_divided || saved_.is_finished) return;
  const Options options = options_of_run({});
  Tools tools(options);
  OneRank ranks;
  SealedShelf from = folder_.pieces_of(saved_);
  SealedShelf to = folder_.new_step(RunFolder::step_of(saved_.run) + 1, saved_);
  DividedMesh mesh(from, ranks, saved_.mesh);
  PieceRun steps(mesh, saved_.division, tools.task(), saved_.run);
  if (!steps.begin_step(&to)) return;
  saved_.run = steps.state();
  saved_.mesh = mesh.state();
  folder_.save(saved_);
}

Round FolderRun::round() const {
  Round round;
  round.number = RunFolder::step_of(saved_.run);
  const std::size_t divisions = saved_.division.divisions;
  round.name = round.number <= divisions ? fmt::format("division {}", round.number)
                                         : fmt::format("zones {}", round.number - divisions);
  if (!saved_.run.is_divided) return round;
  const SealedShelf pieces = folder_.pieces_of(saved_);
  for (std::size_t part = 0; part < saved_.mesh.parting.parts(); ++part) {
    round.pieces.push_back(part);
    if (!pieces.has(outcome_name(part))) round.open.push_back(part);
  }
  return round;
}

/// Of one piece that is to be recorded.
void FolderRun::check_trace(const std::vector<std::size_t>& pieces) const {
  if (pieces.size() != 1) throw Error("trace: it is of one piece, which must be named");
  const std::size_t part = pieces.front();
  const std::size_t stretches = saved_.mesh.parting.stretches();
  if (saved_.run.records.size() >= saved_.division.divisions && part < stretches) {
    throw Error(
        fmt::format("trace: piece {} is not worked on in this round: its zones count from {}", part,
                    stretches));
  }
  if (folder_.pieces_of(saved_).has(outcome_name(part))) {
    throw Error(fmt::format("trace: piece {} is finished already", part));
  }
}

std::size_t FolderRun::improve(const std::vector<std::size_t>& pieces, const Options& options,
                               std::string* trace_trouble) {
  const FolderLock lock(folder_.path(), platform::Sharing::others);
  load_again();
  const std::size_t parts = saved_.run.is_divided ? saved_.mesh.parting.parts() : 0;
  for (const std::size_t part : pieces) {
    if (part < parts) continue;
    throw Error(fmt::format("there is no piece {} in this round: it has {}", part, parts));
  }
  if (!options.trace.empty()) check_trace(pieces);
  const Options all = options_of_run(options);
  return face::on_threads(face::threads_of(options), [&] {
    Tools tools(all);
    tools.watcher().begin(Stage::improving);
    OneRank ranks;
    SealedShelf from = folder_.pieces_of(saved_);
    DividedMesh mesh(from, ranks, saved_.mesh);
    PieceTrace trace(all, tools.plan(), saved_.input);
    if (trace.is_wanted()) {
      trace.choose(static_cast<unsigned>(RunFolder::step_of(saved_.run)),
                   static_cast<std::uint32_t>(pieces.front()));
      trace.locate(mesh, pieces.front());
      tools.record(trace);
    }
    PieceRun steps(mesh, saved_.division, tools.task(), saved_.run);
    hold_surface(tools.plan().surface, steps);
    const std::optional<StepRecord> record = steps.begin_step();
    std::size_t finished = 0;
    for (const std::size_t part : pieces) {
      if (from.has(outcome_name(part))) continue;
      if (tools.is_to_stop()) break;
      const PartOutcome outcome = steps.work_on_part(part, *record);
      if (tools.is_to_stop()) break;  // it is not what it would have been
      std::string bytes;
      append(outcome, bytes);
      from.put(outcome_name(part), bytes);
      ++finished;
    }
    const std::string trouble = trace.finish_all(ranks);
    if (trace_trouble != nullptr) *trace_trouble = trouble;
    tools.watcher().rethrow();
    return finished;
  });
}

std::optional<Result> FolderRun::join(const Options& options, face::Portrait* portrait) {
  const FolderLock lock(folder_.path(), platform::Sharing::none);
  load_again();
  const Round now = round();
  if (!now.open.empty()) {
    throw Error(fmt::format("{}: {} of {} pieces are not finished yet: {}", now.name,
                            now.open.size(), now.pieces.size(), fmt::join(now.open, ", ")));
  }
  const Options all = options_of_run(options);
  return face::on_threads(face::threads_of(options), [&]() -> std::optional<Result> {
    if (saved_.run.is_divided) {
      Tools tools(all);
      OneRank ranks;
      SealedShelf from = folder_.pieces_of(saved_);
      DividedMesh mesh(from, ranks, saved_.mesh);
      PieceRun steps(mesh, saved_.division, tools.task(), saved_.run);
      std::vector<PartOutcome> outcomes;
      for (const std::size_t part : now.pieces) {
        const std::string bytes = from.read(outcome_name(part));
        from.parse(outcome_name(part), [&] {
          std::string_view rest = bytes;
          outcomes.push_back(take_outcome(rest));
          if (!rest.empty() || outcomes.back().part != part) throw Error("it is of another piece");
        });
      }
      std::optional<StepRecord> record = steps.begin_step();
      steps.end_step(std::move(*record), std::move(outcomes));
      saved_.run = steps.state();
      saved_.mesh = mesh.state();
    }
    open();
    if (saved_.run.is_divided) return std::nullopt;
    return finish(all, portrait);
  });
}

void FolderRun::hold_surface(const face::SurfaceTolerance& surface, PieceRun& steps) const {
  if (surface.is_fixed()) return;
  steps.hold_surface(surface.envelope_options(), folder_.load_surface(saved_));
}

Result FolderRun::finish(const Options& options, face::Portrait* portrait) {
  Tools tools(options);
  OneRank ranks;
  SealedShelf from = folder_.pieces_of(saved_);
  const std::size_t last = RunFolder::step_of(saved_.run) + 1;
  FolderShelf to(folder_.make_step(last));
  DividedMesh mesh(from, ranks, saved_.mesh);
  PieceRun steps(mesh, saved_.division, tools.task(), saved_.run);
  Result result;
  result.goal = options.goal;
  for (const StepRecord& record : saved_.run.records) result.passes.push_back(to_pass(record));
  hold_surface(tools.plan().surface, steps);
  const Measured after = steps.measure_after(
      {.rulers = true, .histograms = true, .holders = true, .vertices = saved_.vertices},
      saved_.before, &to);
  result.surface_change = steps.surface_change();
  check_after(saved_.before, after, kept_by(tools.plan().surface), saved_.mesh.side(), result);
  if (portrait != nullptr) {
    portrait->rulers_before = saved_.before.histograms;
    portrait->rulers_after = after.histograms;
    portrait->bad_after = after.worst_tets;
  }
  result.notes = face::advice_on(after.held, options, result);
  const std::filesystem::path output = saved_.output;
  WriteDetails details = {.vertices = saved_.vertices,
                          .array_files = array_files_,
                          .variant = saved_.variant,
                          .source = saved_.holds_more ? saved_.input : "",
                          .label_array = saved_.label_array,
                          .conserve = options.conserve,
                          .surface_moves = !tools.plan().surface.is_fixed(),
                          .shelf = &to,
                          .pieces = saved_.division.pieces};
  if (face::worse_for_nothing(result).empty()) {
    face::Carried carried = write_pieces(output, mesh, details);
    result.carried = std::move(carried.arrays);
    for (std::string& text : carried.notes) result.notes.push_back(std::move(text));
  } else {
    std::optional<SurfaceChange> unchanged;
    if (steps.surface() != nullptr) unchanged = steps.surface()->unchanged();
    result.notes.push_back(stay_as_it_was(unchanged, result));
    if (portrait != nullptr) {
      portrait->rulers_after = saved_.before.histograms;
      portrait->bad_after.clear();
    }
    FolderShelf again(folder_.make_step(last + 1));
    DividedMesh slices(again, ranks, saved_.vertices);
    details.parts = saved_.division.pieces;
    InputMesh(saved_.input, ranks, array_files_, saved_.label_array)
        .add_to(slices, saved_.division.pieces);
    result.carried = write_pieces(output, slices, details).arrays;
  }
  saved_.is_finished = true;
  folder_.save(saved_);
  return result;
}

}  // namespace tetmend::pieces
