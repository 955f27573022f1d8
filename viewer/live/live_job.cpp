// SPDX-License-Identifier: MIT
#include "viewer/live/live_job.h"

#include <new>
#include <utility>

#include <fmt/format.h>

#include "face/mesh_access.h"
#include "kernel/error.h"
#include "viewer/live/carried_data.h"

namespace tetmend::viewer {

namespace {

double to_seconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double>(d).count();
}

/// What went wrong in `step`, or nothing.
template <class Step>
std::string trouble_of(const Step& step) {
  try {
    step();
  } catch (const std::bad_alloc&) {
    return "out of memory";
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace

std::string ParameterHold::text() const {
  return fmt::format("{}: {} = {}", operator_name, parameter, value);
}

LiveJob::LiveJob(MeshData mesh, const Standard& shown, LivePlan plan)
    : data_(std::move(mesh)),
      has_more_(holds_more_than_mesh(data_)),
      shown_by_(shown),
      plan_(std::move(plan)),
      demand_(plan_.paused ? Demand::pause : Demand::go_on),
      speed_(plan_.speed),
      thread_([this] { work(); }) {}

LiveJob::~LiveJob() {
  ask(Demand::stop);
  thread_.join();
}

// ---- Any thread ---------------------------------------------------------------------------------

void LiveJob::ask(Demand demand) {
  {
    const std::lock_guard lock(lock_);
    if (demand_ == Demand::stop || is_over_) return;
    demand_ = demand;
    if (demand == Demand::stop) cancel_ = true;
  }
  changed_.notify_all();
}

void LiveJob::set_speed(double changes_a_second) {
  {
    const std::lock_guard lock(lock_);
    speed_ = changes_a_second;
  }
  changed_.notify_all();
}

void LiveJob::set_breakpoints(std::vector<Condition> conditions) {
  const std::lock_guard lock(lock_);
  new_breakpoints_ = std::move(conditions);
  has_new_breakpoints_ = true;
}

void LiveJob::hold_parameter(ParameterHold change) {
  const std::lock_guard lock(lock_);
  shown_.held_parameters.push_back(change.text());
  parameters_.push_back(std::move(change));
}

LiveState LiveJob::state_now() const {
  if (is_over_) return shown_.state;
  if (demand_ == Demand::stop) return LiveState::stopping;
  return is_held_ && demand_ == Demand::pause ? LiveState::paused : LiveState::running;
}

double LiveJob::seconds_until(Clock::time_point now) const {
  const Clock::time_point last = is_over_ ? end_ : is_held_ ? held_since_ : now;
  return to_seconds(last - start_ - held_);
}

LiveState LiveJob::state() const {
  const std::lock_guard lock(lock_);
  return state_now();
}

LiveProgress LiveJob::progress() const {
  const std::lock_guard lock(lock_);
  LiveProgress progress = shown_;
  progress.state = state_now();
  progress.seconds = seconds_until(Clock::now());
  return progress;
}

LiveState LiveJob::wait(double seconds) const {
  std::unique_lock lock(lock_);
  changed_.wait_for(lock, std::chrono::duration<double>(seconds),
                    [&] { return is_over_ || state_now() == LiveState::paused; });
  return state_now();
}

std::unique_ptr<MeasuredMesh> LiveJob::take_snapshot() {
  const std::lock_guard lock(lock_);
  return std::move(snapshot_);
}

/// Under the lock: a thread that is held waits for it before it goes on.
void LiveJob::need_rest() const {
  if (!is_over_ && state_now() != LiveState::paused) {
    throw Error("the run is still at work: pause it first");
  }
}

std::string LiveJob::last_calls() const {
  const std::lock_guard lock(lock_);
  need_rest();
  return memory_.look();
}

std::shared_ptr<const MeshData> LiveJob::whole_data() const {
  if (!has_more_) return nullptr;
  const std::lock_guard lock(lock_);
  need_rest();
  return is_over_ ? result_ : std::make_shared<const MeshData>(so_far_());
}

// ---- The thread ---------------------------------------------------------------------------------

void LiveJob::work() {
  std::string trouble = trouble_of([&] { run(); });
  run_ = nullptr;
  mesh_ = nullptr;
  so_far_ = nullptr;
  const auto then = [&](const auto& step) {
    const std::string more = trouble_of(step);
    if (trouble.empty()) trouble = more;
  };
  // A run that failed has a trace, too: it shows the way there.
  then([&] {
    if (recorder_) recorder_->finish();
  });
  const bool has_trace = recorder_ && trouble.empty();
  recorder_.reset();
  std::shared_ptr<const MeshData> whole;
  then([&] {
    if (has_more_) whole = std::make_shared<const MeshData>(data_);
    TetMesh result = TetMesh::build(data_, {.sorted = false});
    result.set_standard(shown_by_);
    snap(std::move(result));
  });
  {
    const std::lock_guard lock(lock_);
    is_over_ = true;
    end_ = Clock::now();
    result_ = std::move(whole);
    shown_.error = trouble;
    if (has_trace) shown_.trace = plan_.trace.string();
    shown_.state = !trouble.empty() ? LiveState::failed
                   : cancel_        ? LiveState::stopped
                                    : LiveState::finished;
  }
  changed_.notify_all();
}

/// `data_` is as the run leaves it, also when it fails.
void LiveJob::run() {
  Options options = plan_.options;
  options.cancel = &cancel_;
  options.maps = false;
  options.progress = [this](const Progress& progress) { return show(progress), true; };
  options.note = [this](std::string_view text) { show_note(text); };
  Mesh mesh = MeshAccess::make(std::move(data_));
  try {
    face::improve(mesh, options, *this);
  } catch (...) {
    data_ = MeshAccess::take(mesh);
    throw;
  }
  data_ = MeshAccess::take(mesh);
}

TraceSink* LiveJob::follow(Run& run, const face::DataSoFar& so_far) {
  run_ = &run;
  so_far_ = so_far;
  mesh_ = &run.mesh();
  const QualityIndicators before = quality_indicators(*mesh_);
  parameters_held_ = 0;
  attempts_ = accepted_ = 0;
  calls_.clear();
  last_.reset();
  last_accepted_.reset();
  {
    const std::lock_guard lock(lock_);
    shown_.before = before;
    shown_.passes.clear();
  }
  publish();
  recorder_.reset();
  begin_traces();
  breakpoints_.set(plan_.breakpoints);
  last_snapshot_ = Clock::now();
  come_to(Event::start);
  return this;
}

void LiveJob::begin_traces() {
  TraceHeader header;
  header.program = "tetmend-view";
  header.input = plan_.input.string();
  header.schedule = plan_.schedule.name();
  header.schedule_text = plan_.schedule.text();
  header.settings = plan_.options.set;
  memory_.begin(*mesh_, header);
  if (plan_.trace.empty()) return;
  recorder_ = std::make_unique<TraceRecorder>(plan_.trace, *mesh_, std::move(header));
}

/// Both traces.
void LiveJob::tell(const auto& event) {
  event(memory_);
  if (recorder_) event(*recorder_);
}

/// Where a pass begins.
void LiveJob::take_parameters() {
  const std::lock_guard lock(lock_);
  for (; parameters_held_ < parameters_.size(); ++parameters_held_) {
    const ParameterHold& change = parameters_[parameters_held_];
    run_->hold_parameter(change.operator_name, change.parameter, change.value);
    tell([&](auto& sink) { sink.parameter_changed(change.text()); });
  }
}

void LiveJob::take_breakpoints() {
  if (!has_new_breakpoints_ || !(calls_.empty() || breakpoints_.is_following())) return;
  const std::lock_guard lock(lock_);
  breakpoints_.set(std::move(new_breakpoints_));
  has_new_breakpoints_ = false;
}

void LiveJob::come_to(Event event) {
  const Demand demand = demand_.load(std::memory_order_relaxed);
  const bool is_call = event == Event::accepted_call || event == Event::refused_call;
  take_breakpoints();
  std::optional<std::string> hit;
  if (is_call && breakpoints_.is_following())
    hit = breakpoints_.take(event == Event::accepted_call);
  const bool is_due = hit || demand == Demand::pause ||
                      (demand == Demand::to_next_call && is_call) ||
                      (demand == Demand::to_next_accepted && event == Event::accepted_call) ||
                      (demand == Demand::to_next_pass && event == Event::pass_end);
  if (is_due) {
    {
      const std::lock_guard lock(lock_);
      shown_.breakpoint = hit.value_or("");
    }
    return hold(demand);
  }
  const double speed = speed_;
  if (event == Event::accepted_call && speed > 0 && demand != Demand::stop) dwell(1 / speed);
}

/// Lets the user look at a change.
void LiveJob::dwell(double seconds) {
  const Clock::time_point since = Clock::now();
  snap();
  publish();
  std::unique_lock lock(lock_);
  const Demand demand = demand_;
  const double speed = speed_;
  changed_.wait_until(
      lock,
      since + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds)),
      [&] { return demand_ != demand || speed_ != speed; });
  held_ += Clock::now() - since;
}

void LiveJob::hold(Demand demand) {
  const Clock::time_point since = Clock::now();
  snap();
  publish();
  std::unique_lock lock(lock_);
  // A step is done, or a breakpoint met; what was asked since counts.
  if (demand_ == demand && demand != Demand::stop) demand_ = Demand::pause;
  is_held_ = true;
  held_since_ = since;
  changed_.notify_all();
  changed_.wait(lock, [&] { return demand_ != Demand::pause; });
  is_held_ = false;
  shown_.breakpoint.clear();
  held_ += Clock::now() - since;
}

/// Copies the mesh for the window. In a pass the counts of the mesh lag behind; those of the copy
/// are right.
void LiveJob::snap() {
  const Clock::time_point start = Clock::now();
  TetMesh copy = *mesh_;
  copy.collect_garbage();
  snap(std::move(copy));
  snapshot_cost_ = last_snapshot_ - start;
}

void LiveJob::snap(TetMesh mesh) {
  auto snapshot = std::make_unique<MeasuredMesh>(std::move(mesh));
  last_snapshot_ = Clock::now();
  const std::lock_guard lock(lock_);
  snapshot_.swap(snapshot);
}

void LiveJob::publish() {
  const std::lock_guard lock(lock_);
  shown_.attempts = attempts_;
  shown_.accepted = accepted_;
  shown_.last_accepted = last_accepted_;
  shown_.last = last_;
}

// ---- What the run tells -------------------------------------------------------------------------

void LiveJob::pass_begins(std::string_view name, unsigned round) {
  take_parameters();
  tell([&](auto& sink) { sink.pass_begins(name, round); });
  pass_ = LivePass{.name = std::string(name), .round = round, .after = {}};
  pass_start_ = Clock::now();
  const std::lock_guard lock(lock_);
  held_before_pass_ = held_;
  shown_.phase = name;
  shown_.round = round;
  shown_.share = 0;
}

void LiveJob::pass_ends(const QualityIndicators& now) {
  tell([&](auto& sink) { sink.pass_ends(now); });
  show_pass(now);
}

void LiveJob::visit_begins(const TetVertices& tet, Quality quality) {
  tell([&](auto& sink) { sink.visit_begins(tet, quality); });
  breakpoints_.visit_begins(quality);
}

void LiveJob::visit_ends() {
  tell([&](auto& sink) { sink.visit_ends(); });
}

void LiveJob::standard_changed(const Standard& standard) {
  tell([&](auto& sink) { sink.standard_changed(standard); });
}

void LiveJob::attempt_begins(const AttemptEvent& event) {
  tell([&](auto& sink) { sink.attempt_begins(event); });
  take_breakpoints();
  if (breakpoints_.is_following()) breakpoints_.attempt_begins(*mesh_, event);
  const bool is_asked = calls_.empty() || breakpoints_.is_following();
  calls_.push_back(is_asked ? call_of(event) : LiveCall());
  come_to_condition(calls_.back());
}

LiveCall LiveJob::call_of(const AttemptEvent& event) const {
  LiveCall call;
  call.operator_name = event.operator_name;
  call.number = attempts_ + 1;
  call.level = event.level;
  call.is_inside = !calls_.empty();
  call.is_under_way = true;
  for (const VertexHandle v : event.target) {
    call.place += mesh_->point(v);
    call.target.push_back(mesh_->point(v));
  }
  call.place /= static_cast<double>(event.target.size());
  return call;
}

/// A condition holds in a call that goes on: the run is held there, with the mesh as the call has
/// it.
void LiveJob::come_to_condition(const LiveCall& call) {
  auto hit = breakpoints_.take_now();
  const Demand demand = demand_;
  if (!hit || demand == Demand::stop) return;
  {
    const std::lock_guard lock(lock_);
    shown_.breakpoint = std::move(*hit);
  }
  last_ = call;
  hold(demand);
  take_breakpoints();
}

void LiveJob::candidate_found() {
  tell([&](auto& sink) { sink.candidate_found(); });
}

void LiveJob::attempt_ends(Verdict verdict, std::span<const Quality> before,
                           std::span<const Quality> now) {
  tell([&](auto& sink) { sink.attempt_ends(verdict, before, now); });
  if (breakpoints_.is_following()) {
    breakpoints_.attempt_ends(*mesh_, verdict, before.empty() ? 0 : before.front());
  }
  LiveCall call = std::move(calls_.back());
  calls_.pop_back();
  call.is_under_way = false;
  call.verdict = verdict;
  if (!before.empty()) call.before = before.front();
  if (!now.empty()) call.after = now.front();
  if (!calls_.empty()) return come_to_condition(call);
  last_ = std::move(call);
  ++attempts_;
  ++pass_.attempts;
  if (verdict != Verdict::accepted) return come_to(Event::refused_call);
  ++accepted_;
  ++pass_.accepted;
  last_accepted_ = last_;
  come_to(Event::accepted_call);
}

void LiveJob::edit_made(const TetMesh& mesh, const Journal& journal) noexcept {
  tell([&](auto& sink) { sink.edit_made(mesh, journal); });
  if (breakpoints_.is_following()) breakpoints_.edit_made(journal);
}

void LiveJob::edit_undone() noexcept {
  tell([&](auto& sink) { sink.edit_undone(); });
}

/// All that is done, also before and after the passes.
void LiveJob::show(const Progress& progress) {
  publish();
  const std::lock_guard lock(lock_);
  shown_.phase = progress.stage == Stage::building    ? "building"
                 : progress.stage == Stage::measuring ? "measuring"
                                                      : progress.phase;
  shown_.round = progress.round;
  shown_.share = progress.share;
}

void LiveJob::show_pass(const QualityIndicators& now) {
  constexpr int kShare = 10;  // of the time may go into snapshots: one part in so many
  publish();
  pass_.after = now;
  {
    const std::lock_guard lock(lock_);
    pass_.seconds = to_seconds(Clock::now() - pass_start_ - (held_ - held_before_pass_));
    shown_.passes.push_back(pass_);
    shown_.share = 1;
  }
  if (Clock::now() - last_snapshot_ > kShare * snapshot_cost_) snap();
  come_to(Event::pass_end);
}

void LiveJob::show_note(std::string_view text) {
  const std::lock_guard lock(lock_);
  shown_.notes.emplace_back(text);
}

}  // namespace tetmend::viewer
