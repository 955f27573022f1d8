// SPDX-License-Identifier: MIT
//   slices of the file | measure all pieces | divisions and zones | measure all pieces | write
#include "pieces/out_of_core.h"

#include <algorithm>
#include <memory>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <tetmend/io.h>

#include "face/arena.h"
#include "face/mesh_access.h"
#include "face/plan.h"
#include "face/recorded.h"
#include "face/watcher.h"
#include "face/worse.h"
#include "kernel/stopwatch.h"
#include "pieces/bytes.h"
#include "pieces/improve.h"
#include "pieces/mesh_output.h"
#include "pieces/piece_trace.h"
#include "pieces/run_folder.h"
#include "pieces/slices.h"

namespace tetmend::pieces {

namespace {

/// One call of improve_files().
class FileRun {
 public:
  FileRun(const OutOfCore& files, const Options& options, Division& division, Ranks& ranks)
      : files_(files),
        options_(options),
        division_(division),
        ranks_(ranks),
        plan_(options),
        watcher_(options),
        checkpoint_(files.checkpoint),
        trace_(options, plan_, files.input) {
    if (files.scratch.empty()) {
      shelf_ = std::make_unique<MemoryShelf>();
    } else {
      shelf_ = std::make_unique<FolderShelf>(files.scratch);
    }
  }

  Result run();

 private:
  Result improve_whole();
  bool read();
  void tell_rest(std::vector<std::string> notes);
  Wanted wanted() const;
  void work_side_by_side();
  void measure_before();
  void hold_surface();
  void lock();
  bool go_on();
  SavedRun saved() const;
  void save() const;
  void work();
  void measure_after();
  void write();
  void note_costs() const;
  /// False for one.
  bool is_divided(std::size_t tets) {
    if (division_.pieces == 0) {
      division_.pieces = files_.memory > 0 ? pieces_for(tets, files_.memory) : usual_pieces(tets);
    }
    limit_pieces(tets);
    return division_.pieces > 1;
  }
  void limit_pieces(std::size_t tets) {
    const std::size_t asked =
        std::exchange(division_.pieces, limited_pieces(division_.pieces, tets));
    if (asked == division_.pieces) return;
    result_.notes.push_back(why_fewer_pieces(asked, division_.pieces, tets));
    watcher_.noted(result_.notes.back());
  }

  const OutOfCore& files_;
  const Options& options_;
  Division& division_;
  Ranks& ranks_;
  face::Plan plan_;
  face::Watcher watcher_;
  RunFolder checkpoint_;
  std::optional<FolderLock> lock_;  // of the first rank, where there is a checkpoint
  FileIdentity input_content_;      // likewise, as the next
  FileIdentity size_content_;
  PieceTrace trace_;
  std::unique_ptr<Shelf> shelf_;
  std::optional<DividedMesh> mesh_;
  std::optional<PieceRun> steps_;
  std::uint64_t vertices_ = 0;
  std::uint64_t tets_ = 0;
  bool holds_more_ = false;
  bool is_told_ = false;
  std::vector<std::string> told_;  // of what is lost
  Measured before_;
  face::Held held_;
  std::optional<SurfaceChange> unchanged_surface_;
  Result result_;
};

Result FileRun::run() {
  result_.goal = options_.goal;
  const AimSettings settings(plan_.schedule, plan_.settings);
  TaskOptions task{plan_.registry, plan_.schedule, settings, plan_.standard};
  if (plan_.sizes.are_wanted()) task.size_field = plan_.sizes.field_of_places();
  task.fault = files_.fault;
  task.trace = &trace_;
  task.check_operators = options_.check_operators;
  task.watcher = &watcher_;
  watcher_.begin(Stage::building);
  if (!files_.checkpoint.empty()) lock();
  if (go_on()) {
    const SavedRun found = checkpoint_.load();
    steps_.emplace(*mesh_, division_, task, found.run);
    work_side_by_side();
    if (!plan_.surface.is_fixed()) {
      steps_->hold_surface(plan_.surface.envelope_options(), checkpoint_.load_surface(found));
      unchanged_surface_ = steps_->surface()->unchanged();
    }
  } else {
    {
      const Stopwatch watch(result_.building);
      if (!read()) return improve_whole();
    }
    steps_.emplace(*mesh_, division_, task);
    work_side_by_side();
    trace_.locate(*mesh_);
    measure_before();
    hold_surface();
  }
  work();
  measure_after();
  if (files_.costs != nullptr) note_costs();
  if (!trace_.note().empty()) result_.notes.push_back(trace_.note());
  for (std::string& text : face::advice_on(held_, options_, result_)) {
    watcher_.noted(text);
    result_.notes.push_back(std::move(text));
  }
  result_.trace_trouble = trace_.finish_all(ranks_);
  if (files_.needs_trace && !result_.trace_trouble.empty()) throw Error(result_.trace_trouble);
  write();
  if (!options_.rulers) forget_rulers(result_);
  watcher_.rethrow();
  return std::move(result_);
}

/// There is memory enough for all of it.
Result FileRun::improve_whole() {
  const ArrayFiles* known = files_.array_files;
  Mesh mesh;
  if (known != nullptr && known->is_one(files_.input)) {
    MeshData data = gather_mesh(files_.input, *known, files_.label_array, ranks_);
    if (ranks_.is_first()) mesh = MeshAccess::make(std::move(data));
  } else if (ranks_.is_first()) {
    mesh = load(files_.input, options_.threads, files_.label_array);
    tell_rest(mesh.notes());
  }
  Result result;
  if (ranks_.is_first()) result = face::improve(mesh, options_, files_.portrait);
  if (ranks_.is_first() && files_.portrait != nullptr) face::number_tets(*files_.portrait, mesh);
  if (files_.needs_trace && !result.trace_trouble.empty()) throw Error(result.trace_trouble);
  if (known != nullptr && known->is_one(files_.output)) {
    RankShare share;
    if (ranks_.is_first()) share = all_of(MeshAccess::data(mesh));
    share_outlines(share.arrays, ranks_);
    known->write(files_.output, share);
  } else if (ranks_.is_first()) {
    tetmend::save(files_.output, mesh, options_.threads, files_.variant);
  }
  ranks_.meet();
  return result;
}

/// What the reader of a whole file sees, and that of slices does not: that a tet is there twice.
void FileRun::tell_rest(std::vector<std::string> notes) {
  std::erase_if(notes, [this](const std::string& note) {
    return std::find(told_.begin(), told_.end(), note) != told_.end();
  });
  if (!notes.empty() && files_.tell_lost) files_.tell_lost(notes);
}

/// False if one piece is enough.
bool FileRun::read() {
  InputMesh input(files_.input, ranks_, files_.array_files, files_.label_array);
  input.check_conserve(options_.conserve);
  const bool is_in_pieces = is_divided(input.tets());
  if (is_in_pieces && !plan_.surface.is_fixed()) input.set_surface_moves();
  if (ranks_.is_first() && files_.tell_lost && !std::exchange(is_told_, true)) {
    told_ = input.lost_in(files_.output);
    files_.tell_lost(told_);
  }
  if (!is_in_pieces) return false;
  for (const std::string& text : input.remarks()) {
    result_.notes.push_back(text);
    watcher_.noted(text);
  }
  check(options_, division_);
  vertices_ = input.vertices();
  tets_ = input.tets();
  holds_more_ = input.holds_more(files_.output);
  mesh_.emplace(*shelf_, ranks_, vertices_, files_.first_id);
  add_protected(input, options_, *mesh_, division_.pieces);
  return true;
}

void FileRun::measure_before() {
  watcher_.begin(Stage::measuring);
  const Stopwatch watch(result_.measuring);
  Wanted wanted = this->wanted();
  wanted.tets = tets_;
  before_ = steps_->measure_before(wanted);
  const MeshStatistics& before = before_.figures.statistics;
  check_before(before_.figures, options_, files_.input);
  if (before_.figures.sizes.edges > 0) {
    const SizeStatistics sizes = before_.figures.sizes.statistics();
    for (const std::string& text : face::remarks_on(sizes, options_)) {
      result_.notes.push_back(text);
      watcher_.noted(text);
    }
  }
  result_.before = before;
  steps_->set_limits(
      {before.tets, before.n_bad, plan_.growth.most(before.tets).value_or(RunLimits().most_tets)});
}

/// A run that goes on may be asked for what this one is not.
Wanted FileRun::wanted() const {
  const bool is_asked = files_.portrait != nullptr || !files_.checkpoint.empty();
  return {.rulers = true, .histograms = is_asked, .holders = true, .vertices = vertices_};
}

void FileRun::hold_surface() {
  if (plan_.surface.is_fixed()) return;
  plan_.surface.check_length(mesh_->diagonal());
  const std::string held = steps_->hold_surface(plan_.surface.envelope_options());
  unchanged_surface_ = steps_->surface()->unchanged();
  if (!files_.checkpoint.empty() && ranks_.is_first()) checkpoint_.save_surface(saved(), held);
}

/// What a checkpoint must be of to be gone on from.
SavedRun FileRun::saved() const {
  SavedRun run;
  run.input = std::filesystem::absolute(files_.input).string();
  run.output = std::filesystem::absolute(files_.output).string();
  run.input_content = input_content_;
  run.size_content = size_content_;
  run.vertices = vertices_;
  run.holds_more = holds_more_;
  run.label_array = files_.label_array;
  run.variant = files_.variant;
  run.options = texts_of(options_);
  run.division = division_;
  run.before = before_;
  return run;
}

/// All ranks, or none.
void FileRun::lock() {
  if (options_.size_at) {
    throw OptionError("size_at",
                      "size_at: a checkpoint cannot keep a function of a program: "
                      "give size, a script with a function");
  }
  std::string trouble;
  try {
    if (ranks_.is_first()) lock_.emplace(files_.checkpoint, platform::Sharing::none);
  } catch (const Error& error) {
    trouble = error.what();
  }
  const std::string told = ranks_.gather(trouble).front();
  if (!told.empty()) throw Error(told);
  input_content_ = identify(files_.input, ranks_);
  const std::string lengths = plan_.sizes.file_of_places();
  if (!lengths.empty()) size_content_ = identify(lengths, ranks_);
}

/// False: there is nothing to go on from.
bool FileRun::go_on() {
  if (files_.checkpoint.empty() || ranks_.any(!checkpoint_.has_run())) return false;
  const SavedRun found = checkpoint_.load();
  limit_pieces(found.before.figures.statistics.tets);
  const SavedRun mine = saved();
  if (found.input != mine.input || found.input_content != mine.input_content ||
      found.size_content != mine.size_content || found.options != mine.options ||
      found.label_array != mine.label_array || found.is_finished ||
      (division_.pieces != 0 && division_.pieces != found.division.pieces)) {
    throw Error(fmt::format("{}: has a run of another mesh, or with other options",
                            files_.checkpoint.string()));
  }
  division_ = found.division;
  vertices_ = found.vertices;
  holds_more_ = found.holds_more;
  before_ = found.before;
  result_.before = before_.figures.statistics;
  tets_ = result_.before.tets;
  for (const StepRecord& record : found.run.records) result_.passes.push_back(to_pass(record));
  if (!found.run.records.empty()) {
    watcher_.watch(nullptr, found.run.records.back().after.indicators);
  }
  mesh_.emplace(*shelf_, ranks_, found.mesh);
  mesh_->take_from(checkpoint_.pieces_of(found));
  if (trace_.is_wanted() && trace_.round() <= found.run.records.size()) trace_.skip(ranks_);
  trace_.locate(*mesh_);
  return true;
}

/// All ranks: the pieces first, then the state that they are of.
void FileRun::save() const {
  const std::size_t step = RunFolder::step_of(steps_->state());
  if (ranks_.is_first()) checkpoint_.make_step(step);
  ranks_.meet();
  SavedRun run = saved();
  SealedShelf shelf = checkpoint_.step(step, run);
  mesh_->copy_stored(shelf);
  ranks_.meet();
  if (!ranks_.is_first()) return;
  run.run = steps_->state();
  run.mesh = mesh_->state();
  checkpoint_.save(run);
}

/// As far as the memory that was asked for has room.
void FileRun::work_side_by_side() {
  steps_->set_side_by_side(
      pieces_at_a_time(static_cast<std::size_t>(tets_), division_.pieces, files_.memory));
}

void FileRun::work() {
  watcher_.begin(Stage::improving);
  const Stopwatch watch(result_.improving);
  RunLimits limits = steps_->state().limits;
  limits.seconds = options_.time_limit;
  steps_->set_limits(limits);
  steps_->set_stop([&] {
    return watcher_.stopped() || (options_.cancel != nullptr && options_.cancel->load());
  });
  steps_->set_listener([&](const StepRecord& record) {
    watcher_.watch(nullptr, record.after.indicators);
    result_.passes.push_back(to_pass(record));
    if (files_.checkpoint.empty() || steps_->stopped()) return;
    save();
    // What is in the folder is not worked on again.
    if (trace_.round() <= steps_->records().size()) trace_.finish();
  });
  steps_->run();
  if (steps_->stopped()) {
    result_.ending = steps_->out_of_time() ? Ending::time_limit : Ending::cancelled;
  }
}

void FileRun::measure_after() {
  watcher_.begin(Stage::measuring);
  const Stopwatch watch(result_.measuring);
  const Measured after = steps_->measure_after(wanted(), before_);
  held_ = after.held;
  result_.surface_change = steps_->surface_change();
  check_after(before_, after, kept_by(plan_.surface), mesh_->state().side(), result_);
  if (files_.portrait == nullptr) return;
  files_.portrait->rulers_before = before_.histograms;
  files_.portrait->rulers_after = after.histograms;
  files_.portrait->bad_after = after.worst_tets;
}

void FileRun::note_costs() const {
  std::string mine;
  pieces::put(mesh_->traffic(), mine);
  pieces::put(steps_->times(), mine);
  RunCosts& costs = *files_.costs;
  for (const std::string& from : ranks_.gather(mine)) {
    std::string_view rest = from;
    std::vector<Traffic> divisions;
    std::vector<PartTime> parts;
    pieces::take(rest, divisions);
    pieces::take(rest, parts);
    costs.divisions.resize(divisions.size());
    for (std::size_t i = 0; i < divisions.size(); ++i) {
      Traffic& all = costs.divisions[i];
      all.tets += divisions[i].tets;
      all.received += divisions[i].received;
      all.seconds = std::max(all.seconds, divisions[i].seconds);
    }
    costs.parts.insert(costs.parts.end(), parts.begin(), parts.end());
    ++costs.ranks;
  }
}

void FileRun::write() {
  double unasked = 0;
  const Stopwatch watch(files_.costs != nullptr ? files_.costs->writing : unasked);
  std::size_t parts = 0;
  if (!face::worse_for_nothing(result_).empty()) {
    result_.notes.push_back(stay_as_it_was(unchanged_surface_, result_));
    watcher_.noted(result_.notes.back());
    if (files_.portrait != nullptr) {
      files_.portrait->rulers_after = before_.histograms;
      files_.portrait->bad_after.clear();
    }
    if (files_.array_files != nullptr && files_.input == files_.output) return;  // nothing to write
    read();  // slices are pieces, too
    parts = division_.pieces;
  }
  face::Carried carried =
      write_pieces(files_.output, *mesh_,
                   {.vertices = vertices_,
                    .array_files = files_.array_files,
                    .parts = parts,
                    .variant = files_.variant,
                    .source = holds_more_ ? files_.input : std::filesystem::path(),
                    .label_array = files_.label_array,
                    .conserve = options_.conserve,
                    .surface_moves = !plan_.surface.is_fixed(),
                    .shelf = shelf_.get(),
                    .pieces = division_.pieces});
  result_.carried = std::move(carried.arrays);
  for (std::string& text : carried.notes) {
    watcher_.noted(text);
    result_.notes.push_back(std::move(text));
  }
  if (ranks_.is_first() && !files_.checkpoint.empty() && !steps_->stopped()) checkpoint_.clear();
}

}  // namespace

double RunCosts::bytes_a_tet() const {
  double bytes = 0;
  double tets = 0;
  for (const Traffic& division : divisions) {
    bytes += static_cast<double>(division.received);
    tets += static_cast<double>(division.tets);
  }
  return bytes / std::max(tets, 1.0);
}

Result improve_files(const OutOfCore& files, const Options& options, Division& division,
                     Ranks& ranks) {
  check_for_files(options);
  check_memory(files.memory);
  check(options, division);
  return face::on_threads(face::threads_of(options),
                          [&] { return FileRun(files, options, division, ranks).run(); });
}

}  // namespace tetmend::pieces
