// SPDX-License-Identifier: MIT
// A run of the schedule layer on a program's mesh: threads, locks, properties, operators of its own.
#include "face/kernel/run.h"

#include <algorithm>
#include <initializer_list>
#include <memory>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <tetmend/catalogue.h>

#include "face/arena.h"
#include "face/kernel/own_operator.h"
#include "kernel/mesh_renewal.h"
#include "kernel/workspace.h"
#include "ops/registry.h"
#include "schedule/run.h"
#include "schedule/schedule.h"
#include "trace/recorder.h"

namespace tetmend::kernel {

namespace {

/// Properties follow the edits of passes, the program looks on, and a trace is written.
class EditTeller final : public TraceSink {
 public:
  EditTeller(PropertyKeeper* keeper, std::initializer_list<TraceSink*> sinks) : keeper_(keeper) {
    for (TraceSink* sink : sinks) {
      if (sink != nullptr) sinks_.push_back(sink);
    }
  }

  bool is_needed() const { return keeper_ != nullptr || !sinks_.empty(); }
  void attempt_begins(const AttemptEvent& event) override {
    for (TraceSink* sink : sinks_) sink->attempt_begins(event);
  }
  void attempt_ends(Verdict verdict, std::span<const Quality> before,
                    std::span<const Quality> now) override {
    for (TraceSink* sink : sinks_) sink->attempt_ends(verdict, before, now);
  }
  void candidate_found() override {
    for (TraceSink* sink : sinks_) sink->candidate_found();
  }
  void pass_begins(std::string_view name, unsigned round) override {
    for (TraceSink* sink : sinks_) sink->pass_begins(name, round);
  }
  void pass_ends(const QualityIndicators& now) override {
    for (TraceSink* sink : sinks_) sink->pass_ends(now);
  }
  void visit_begins(const TetVertices& tet, Quality quality) override {
    for (TraceSink* sink : sinks_) sink->visit_begins(tet, quality);
  }
  void visit_ends() override {
    for (TraceSink* sink : sinks_) sink->visit_ends();
  }
  void standard_changed(const Standard& standard) override {
    for (TraceSink* sink : sinks_) sink->standard_changed(standard);
  }
  void edit_made(const tetmend::TetMesh& mesh, const Journal& journal) noexcept override {
    if (keeper_ != nullptr) keeper_->edit_made(mesh, journal);
    for (TraceSink* sink : sinks_) sink->edit_made(mesh, journal);
  }
  void edit_undone() noexcept override {
    if (keeper_ != nullptr) keeper_->edit_undone();
    for (TraceSink* sink : sinks_) sink->edit_undone();
  }

 private:
  PropertyKeeper* keeper_;
  std::vector<TraceSink*> sinks_;
};

/// Properties of tets, for selections.
class ValuesOfProperties final : public TetValues {
 public:
  explicit ValuesOfProperties(const PropertyTable& tets) : tets_(tets) {}

  Of find(std::string_view name) const override {
    const PropertyArray* array = tets_.find(name);
    if (array == nullptr || !array->has_numbers()) return {};
    were_asked_ = true;
    return [array](const tetmend::TetMesh&, TetHandle t) { return array->number(t.index()); };
  }
  std::vector<std::string> names() const override {
    std::vector<std::string> names;
    for (const auto& array : tets_.all()) {
      if (array->has_numbers()) names.push_back(array->name());
    }
    return names;
  }
  bool were_asked() const { return were_asked_; }

 private:
  const PropertyTable& tets_;
  mutable bool were_asked_ = false;
};

PassDone told_of(const PassRecord& record) {
  return {record.name,    record.attempts(), record.accepted(),
          record.seconds, record.after,      record.verdicts};
}

}  // namespace

struct Run::Inside {
  Inside(TetMesh& mesh_of_program, RunOptions options_of_run)
      : mesh(mesh_of_program), options(options_of_run), attempts_left(options.most_attempts) {
    face::check_threads(options.threads);
    if (options.operators != nullptr) add_to(registry, *options.operators, &mesh);
  }

  /// The trace goes on, or begins with the mesh as it is. @throws Error where the mesh is another
  /// than it knows
  void record() {
    if (options.trace.empty() || is_recorded) return;
    if (recorder && stamp != mesh.stamp_) {
      throw Error(fmt::format("{}: the mesh was changed by something else than passes",
                              options.trace.string()));
    }
    if (recorder) return;
    TraceHeader header;
    header.program = fmt::format("tetmend {}", version());
    header.schedule = "passes of a program";
    recorder = std::make_unique<TraceRecorder>(options.trace, mesh.mesh_, std::move(header));
  }

  TetMesh& mesh;
  const RunOptions options;
  std::unique_ptr<TraceRecorder> recorder;
  bool is_recorded = false;  // the trace is finished
  Registry registry = Registry::builtin();
  std::optional<tetmend::Run> run;  // while the mesh is as its last pass has left it
  std::size_t stamp = 0;            // of the mesh then
  bool values_may_differ = false;  // of properties that it has selected by: the program writes them
  std::size_t attempts_left;
  bool is_over = false;
};

Run::Run(TetMesh& mesh, RunOptions options)
    : inside_(std::make_unique<Inside>(mesh, std::move(options))) {}
Run::~Run() {
  try {
    finish_trace();
  } catch (const Error&) {  // as Run says
  }
}

void Run::finish_trace() {
  if (!inside_->recorder) return;
  const std::unique_ptr<TraceRecorder> recorder = std::move(inside_->recorder);
  inside_->is_recorded = true;
  recorder->finish();
}

/// One pass or several, with all that belongs to the mesh of a program around them.
template <class Pass>
std::vector<PassDone> Run::make(const Pass& pass) {
  Inside& in = *inside_;
  TetMesh& mesh = in.mesh;
  mesh.check_closed("a pass");
  in.record();
  if (!in.run || in.stamp != mesh.stamp_ || in.values_may_differ) {
    in.run.emplace(mesh.mesh_, in.registry);
  }
  tetmend::Run& run = *in.run;
  PropertyKeeper& keeper = *mesh.keeper_;
  EditTeller teller(keeper.is_needed() ? &keeper : nullptr,
                    {in.options.observer, in.recorder.get()});
  const ValuesOfProperties values(keeper.tets);
  run.set_trace(teller.is_needed() ? &teller : nullptr);
  run.set_values(&values);
  run.set_most_tets(in.options.most_tets);
  run.set_most_attempts(in.attempts_left);
  run.set_cancel_flag(in.options.cancel);
  const std::size_t first = run.records.size();
  const auto leave = [&] {
    mesh.is_at_work_ = false;
    run.set_trace(nullptr);
    run.set_values(nullptr);
    in.values_may_differ = values.were_asked();
    hold(mesh.mesh_, {});
    keeper.take_touched_lock();
    keeper.forget();
    mesh.renew_workspace();
    in.stamp = mesh.stamp_;
    in.attempts_left = run.attempts_left();
    in.is_over = run.cancelled();
  };
  keeper.start();
  if (mesh.locks_ != nullptr) hold(mesh.mesh_, [&](VertexHandle v) { return mesh.has_lock(v); });
  mesh.is_at_work_ = true;
  try {
    const int threads = in.options.operators == nullptr ? in.options.threads : 1;
    face::on_threads(threads, [&] { pass(run); });
  } catch (...) {
    leave();
    in.run.reset();
    in.is_recorded = in.is_recorded || in.recorder != nullptr;
    in.recorder.reset();  // a run that fails leaves none
    throw;
  }
  leave();
  if (keeper.has_failed()) {
    in.run.reset();
    keeper.rethrow();
  }
  std::vector<PassDone> done;
  for (std::size_t i = first; i < run.records.size(); ++i) done.push_back(told_of(run.records[i]));
  return done;
}

namespace {

/// The only one; a pass that found nothing to do may have left no record.
PassDone only(std::vector<PassDone> passes, std::string_view name) {
  if (!passes.empty()) return std::move(passes.front());
  PassDone none;
  none.name = name;
  return none;
}

}  // namespace

QualityIndicators Run::indicators() {
  const Inside& in = *inside_;
  if (in.run && in.stamp == in.mesh.stamp_) return in.run->indicators();
  return quality_indicators(in.mesh.mesh_);
}

void Run::set_goal(const Goal& goal) {
  if (!is_sound(goal)) throw OptionError("goal", "goal: no angles of tets");
  const Standard& now = inside_->mesh.mesh_.standard();
  make([&](tetmend::Run& run) { run.set_standard(now.with_goal(goal)); });
}

PassDone Run::local_reconnection(const LocalReconnectionOptions& options) {
  return only(make([&](tetmend::Run& run) { tetmend::local_reconnection(run, options); }),
              "local_reconnection");
}
PassDone Run::smooth(const SmoothOptions& options) {
  return only(make([&](tetmend::Run& run) { tetmend::smooth(run, options); }), "smooth");
}
PassDone Run::suppress_points(const SuppressPointsOptions& options) {
  return only(make([&](tetmend::Run& run) { tetmend::suppress_points(run, options); }),
              "suppress_points");
}
PassDone Run::insert_points(const InsertPointsOptions& options) {
  return only(make([&](tetmend::Run& run) { tetmend::insert_points(run, options); }),
              "insert_points");
}
PassDone Run::polish(const PolishOptions& options) {
  return only(make([&](tetmend::Run& run) { tetmend::polish(run, options); }), "polish");
}
PassDone Run::untangle(const UntangleOptions& options) {
  return only(make([&](tetmend::Run& run) { tetmend::untangle(run, options); }), "untangle");
}
PassDone Run::apply(const ApplyOptions& options) {
  return only(make([&](tetmend::Run& run) { tetmend::apply(run, options); }), options.what.name());
}

std::vector<PassDone> Run::schedule(
    std::string_view name_or_script,
    const std::vector<std::pair<std::string, std::string>>& settings) {
  const auto names = builtin_schedule_names();
  const bool is_name = std::find(names.begin(), names.end(), name_or_script) != names.end();
  const Schedule schedule =
      is_name ? Schedule::builtin(name_or_script) : Schedule("script", std::string(name_or_script));
  return make([&](tetmend::Run& run) { tetmend::improve(run, schedule, settings); });
}

bool Run::is_over() const {
  return inside_->is_over;
}

bool is_progress_over(const QualityIndicators& now, const QualityIndicators& before) {
  return is_progress(before, now);
}

}  // namespace tetmend::kernel
