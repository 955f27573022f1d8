// SPDX-License-Identifier: MIT
#include "schedule/run.h"

#include <algorithm>
#include <numeric>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "kernel/first_failure.h"
#include "kernel/workspace.h"

namespace tetmend {

namespace {

// A block is large enough that most operations stay inside one. More blocks than that only help
// machines that have hundreds of cores; larger blocks defer less.
constexpr std::size_t kVerticesPerBlock = 6000;
constexpr std::size_t kEnoughBlocks = 256;
constexpr std::size_t kMostBlocks = 65535;
constexpr std::size_t kTicksBetweenReports = 256;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

std::size_t PassRecord::attempts() const {
  return std::accumulate(verdicts.begin(), verdicts.end(), std::size_t{0});
}

Run::Run(TetMesh& mesh, const Registry& registry)
    : mesh_(mesh), registry_(registry), worker_(mesh, Workspace(mesh)) {
  divide_by_size();
  worker_.set_stop([this] { return is_to_stop(); });
}

bool Run::is_to_stop() {
  check_time();
  return cancelled();
}

void Run::set_standard(const Standard& standard) {
  if (standard == mesh_.standard()) return;
  mesh_.set_standard(standard);
  last_sweep_.clear();
  is_measured_ = false;
  if (trace_ != nullptr) trace_->standard_changed(standard);
}

void Run::hold_parameter(std::string_view operator_name, std::string_view parameter, double value) {
  if (!holding_) holding_ = std::make_unique<Registry>(registry_);
  holding_->hold(operator_name, parameter, value);
  last_sweep_.clear();
}

QualityIndicators Run::indicators() const {
  return is_measured_ ? records.back().after : quality_indicators(mesh_);
}

void Run::set_trace(TraceSink* trace) {
  trace_ = trace;
  worker_.context().trace = trace;
  worker_.workspace().set_listener(trace);
}

void Run::set_inspector(AttemptInspector* inspector) {
  inspector_ = inspector;
  worker_.set_inspector(inspector);
}

void Run::set_time_limit(double seconds) {
  using Clock = std::chrono::steady_clock;
  constexpr double kForever = 1e9;
  deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                 std::chrono::duration<double>(std::min(seconds, kForever)));
  check_time();
}

void Run::check_time() {
  using Clock = std::chrono::steady_clock;
  if (deadline_ != Clock::time_point::max() && Clock::now() >= deadline_) out_of_time_ = true;
}

void Run::note(const std::string& text) {
  notes.push_back(text);
  held_bytes_ += sizeof(text) + text.size();
  if (listener_ != nullptr) listener_->noted(text);
}

double Run::seconds() const {
  return seconds_since(start_);
}

void Run::divide_by_size() {
  set_block_count(std::min(kEnoughBlocks, mesh_.vertex_count() / kVerticesPerBlock));
}

void Run::set_block_count(std::size_t blocks) {
  if (registry_.needs_whole_mesh()) blocks = 1;
  block_count_ = std::clamp<std::size_t>(blocks, 1, kMostBlocks);
  partitions_ = {};
}

void Run::set_first_date(Date date) {
  first_date_ = date;
  worker_.workspace().set_date(date);
}

Date Run::begin_sweep(std::string_view calendar) {
  Workspace& workspace = worker_.workspace();
  const Date now = workspace.date() + 1;
  workspace.set_date(now);
  for (auto& [name, date] : last_sweep_) {
    if (name == calendar) return std::exchange(date, now);
  }
  last_sweep_.emplace_back(calendar, now);
  held_bytes_ += sizeof(last_sweep_.back()) + calendar.size();
  return first_date_;
}

Partition& Run::partition(PassScope& scope, unsigned shift) {
  const PassScope::Scan timed(scope);
  auto& [partition, added] = partitions_[shift];
  if (!partition) {
    partition = std::make_unique<Partition>(mesh_, block_count_, shift);
  } else {
    partition->include(mesh_, added);
  }
  added.clear();
  return *partition;
}

void Run::on_all_threads(const std::function<void(Worker&)>& work) {
  const auto work_here = [&] {
    std::unique_ptr<Worker>& mine = workers_.local();
    if (!mine) {
      mine = std::make_unique<Worker>(mesh_, Workspace::without_slots(worker_.workspace()));
    }
    mine->context().trace = trace_;
    mine->workspace().set_listener(trace_);
    mine->set_inspector(inspector_);
    mine->set_stop([this] { return is_to_stop(); });
    mine->workspace().set_date(worker_.workspace().date());
    work(*mine);
  };
  if (trace_ != nullptr || inspector_ != nullptr) return work_here();
  const int threads = tbb::this_task_arena::max_concurrency();
  FirstFailure failure;
  tbb::parallel_for(
      0, threads, [&](int) { failure.guard(work_here); }, tbb::simple_partitioner());
  failure.rethrow();
}

void Run::collect_from_workers(PassScope& scope) {
  for (std::unique_ptr<Worker>& worker : workers_) {
    if (!worker) continue;
    worker->workspace().settle(mesh_);
    scope.take_verdicts(*worker);
  }
  for (std::unique_ptr<Worker>& worker : workers_) {
    if (worker) note_added_vertices(*worker);
  }
}

void Run::note_added_vertices(Worker& worker) {
  std::vector<VertexHandle>& added = worker.workspace().added_vertices();
  // Whoever is noted twice does no harm.
  for (ShiftedBlocks& blocks : partitions_) {
    if (blocks.partition) blocks.added.insert(blocks.added.end(), added.begin(), added.end());
  }
  added.clear();
}

void Run::report_progress(std::string_view phase, double share) {
  if (listener_ == nullptr) return;
  const std::unique_lock<std::mutex> lock(listener_busy_, std::try_to_lock);
  if (lock) listener_->progress(phase, round, share);
}

void Run::report_done(const PassRecord& record) {
  if (listener_ != nullptr) listener_->pass_done(record.name, record.round, record.after);
}

void Run::report_blocks(std::span<const double> seconds) {
  if (listener_ != nullptr) listener_->blocks_done(seconds);
}

PassScope::PassScope(Run& run, std::string_view name)
    : run_(run), start_(std::chrono::steady_clock::now()) {
  record_.name = name;
  record_.round = run.round;
  if (run.is_measured_) {
    record_.after = run.records.back().after;
    measured_ = true;
  }
  if (run_.trace() != nullptr) run_.trace()->pass_begins(record_.name, record_.round);
}

PassScope::~PassScope() {
  if (finished_) return;
  run_.is_measured_ = false;
  run_.worker_.verdicts = {};
  run_.last_sweep_.clear();  // what it did not come to has not been tried
}

void PassScope::finish() {
  indicators();
  record_.seconds = seconds_since(start_);
  const PassRecord& record = run_.records.emplace_back(std::move(record_));
  run_.held_bytes_ += sizeof(record) + record.name.size();
  finished_ = true;
  run_.is_measured_ = true;
  if (run_.records.size() >= run_.most_passes_) run_.stop();
  if (run_.trace() != nullptr) run_.trace()->pass_ends(record.after);
  run_.report_done(record);
}

PassScope::Scan::~Scan() {
  scope_.record_.seconds_in_scans += seconds_since(start_);
}

const QualityIndicators& PassScope::indicators() {
  if (!measured_) {
    const Scan timed(*this);
    record_.after = quality_indicators(run_.mesh());
    measured_ = true;
  }
  return record_.after;
}

void PassScope::expect(std::size_t items) {
  record_.items += items;
  measured_ = measured_ && items == 0;
  expected_ = items;
  ticks_ = 0;
}

bool PassScope::proceed(std::size_t n) {
  const bool goes_on = !run_.is_to_stop();  // asked each time, for one item may take long
  if (n % kTicksBetweenReports == 0) {
    const std::size_t done = ticks_.fetch_add(kTicksBetweenReports);
    run_.report_progress(record_.name, std::min(1.0, static_cast<double>(done) /
                                                         static_cast<double>(expected_ + 1)));
  }
  return goes_on;
}

void PassScope::take_verdicts(Worker& worker) {
  std::size_t attempts = 0;
  for (std::size_t i = 0; i < kVerdictCount; ++i) {
    attempts += worker.verdicts[i];
    record_.verdicts[i] += std::exchange(worker.verdicts[i], 0);
  }
  run_.attempts_left_ -= std::min(attempts, run_.attempts_left_);
}

void PassScope::note_blocks(std::span<const double> seconds) {
  record_.seconds_in_blocks += std::accumulate(seconds.begin(), seconds.end(), 0.0);
  run_.report_blocks(seconds);
}

}  // namespace tetmend
