// SPDX-License-Identifier: MIT
// A run of the schedule layer on a program's mesh: threads, locks, properties, operators of its own.
#include "face/kernel/run.h"

#include <algorithm>
#include <deque>
#include <optional>

#include <fmt/format.h>

#include "face/arena.h"
#include "face/kernel/own_operator.h"
#include "kernel/mesh_renewal.h"
#include "ops/registry.h"
#include "schedule/run.h"
#include "schedule/schedule.h"

namespace tetmend::kernel {

namespace {

/// Properties follow the edits of passes, and the program looks on.
class EditTeller final : public TraceSink {
 public:
  EditTeller(PropertyKeeper* keeper, TraceSink* observer) : keeper_(keeper), observer_(observer) {}

  bool is_needed() const { return keeper_ != nullptr || observer_ != nullptr; }
  void attempt_begins(const AttemptEvent& event) override {
    if (observer_ != nullptr) observer_->attempt_begins(event);
  }
  void attempt_ends(Verdict verdict, std::span<const Quality> before,
                    std::span<const Quality> now) override {
    if (observer_ != nullptr) observer_->attempt_ends(verdict, before, now);
  }
  void candidate_found() override {
    if (observer_ != nullptr) observer_->candidate_found();
  }
  void pass_begins(std::string_view name, unsigned round) override {
    if (observer_ != nullptr) observer_->pass_begins(name, round);
  }
  void pass_ends(const QualityIndicators& now) override {
    if (observer_ != nullptr) observer_->pass_ends(now);
  }
  void visit_begins(const TetVertices& tet, Quality quality) override {
    if (observer_ != nullptr) observer_->visit_begins(tet, quality);
  }
  void visit_ends() override {
    if (observer_ != nullptr) observer_->visit_ends();
  }
  void standard_changed(const Standard& standard) override {
    if (observer_ != nullptr) observer_->standard_changed(standard);
  }
  void edit_made(const tetmend::TetMesh& mesh, const Journal& journal) noexcept override {
    if (keeper_ != nullptr) keeper_->edit_made(mesh, journal);
    if (observer_ != nullptr) observer_->edit_made(mesh, journal);
  }
  void edit_undone() noexcept override {
    if (keeper_ != nullptr) keeper_->edit_undone();
    if (observer_ != nullptr) observer_->edit_undone();
  }

 private:
  PropertyKeeper* keeper_;
  TraceSink* observer_;
};

PassDone told_of(const PassRecord& record) {
  return {record.name, record.attempts(), record.accepted(), record.seconds, record.after};
}

}  // namespace

Verdict OwnOperator::evaluate(OperatorContext&, Target target, OwnState& state) const {
  state.proposal = {};
  return own_.propose(look_, target, state.proposal);
}

EditResult OwnOperator::make(const OperatorContext& context, tetmend::Transaction& transaction,
                             const Proposal& proposal) const {
  const auto is_there = [&](VertexHandle v) {
    return v.index() < context.mesh.vertex_slots() && !context.mesh.is_deleted(v);
  };
  EditResult result = EditResult::not_closed;
  if (!proposal.old_.empty()) {
    const bool fits =
        std::none_of(proposal.old_.begin(), proposal.old_.end(),
                     [&](TetHandle t) { return look_.is_deleted(t); }) &&
        std::all_of(proposal.created_.begin(), proposal.created_.end(), [&](const TetVertices& v) {
          return std::all_of(v.begin(), v.end(), is_there);
        });
    if (fits) result = transaction.replace_cavity(proposal.old_, proposal.created_);
    if (result != EditResult::made) return result;
  }
  if (!proposal.move_) return result;
  const auto& [v, point] = *proposal.move_;
  if (!is_there(v) || !point.allFinite()) return EditResult::not_closed;
  const Link link = look_.link(v);
  if (link.empty()) return EditResult::not_closed;
  return transaction.move_vertex(v, context.mesh.scale().to_work(point),
                                 {link.data(), link.size()});
}

Verdict OwnOperator::apply(OperatorContext& context, Target, tetmend::Transaction& transaction,
                           OwnState& state) const {
  const EditResult made = make(context, transaction, state.proposal);
  const auto& is_better = own_.judge.criterion();
  if (made != EditResult::made || !is_better) return to_verdict(made);
  const auto to_file = [&](std::span<const std::array<Point, 4>> tets) {
    std::vector<std::array<Point, 4>> corners(tets.begin(), tets.end());
    for (auto& tet : corners) {
      for (Point& p : tet) p = context.mesh.scale().to_file(p);
    }
    return corners;
  };
  const auto changed = transaction.tets();
  const auto before = to_file(changed.before);
  const auto now = to_file(changed.now);
  return is_better(before, now) ? Verdict::accepted : Verdict::no_improvement;
}

struct Run::Inside {
  Inside(TetMesh& mesh_of_program, RunOptions options_of_run)
      : mesh(mesh_of_program), options(options_of_run), attempts_left(options.most_attempts) {
    face::check_threads(options.threads);
    if (options.operators == nullptr) return;
    for (const auto& [name, own] : options.operators->all()) {
      infos.push_back({.name = name,
                       .target = own.target,
                       .help = own.help,
                       .parameters = {},
                       .make = nullptr});
      const OperatorInfo& info = infos.back();
      registry.add(info, [this, &info, &own = own](const ParameterValues&) {
        return std::make_unique<OwnOperator>(info, own, mesh);
      });
    }
  }

  TetMesh& mesh;
  const RunOptions options;
  Registry registry = Registry::builtin();
  std::deque<OperatorInfo> infos;
  std::optional<tetmend::Run> run;  // while the mesh is as its last pass has left it
  std::size_t stamp = 0;            // of the mesh then
  std::size_t attempts_left;
  bool is_over = false;
};

Run::Run(TetMesh& mesh, RunOptions options)
    : inside_(std::make_unique<Inside>(mesh, std::move(options))) {}
Run::~Run() = default;

/// One pass or several, with all that belongs to the mesh of a program around them.
template <class Pass>
std::vector<PassDone> Run::make(const Pass& pass) {
  Inside& in = *inside_;
  TetMesh& mesh = in.mesh;
  mesh.check_closed("a pass");
  if (!in.run || in.stamp != mesh.stamp_) in.run.emplace(mesh.mesh_, in.registry);
  tetmend::Run& run = *in.run;
  PropertyKeeper& keeper = *mesh.keeper_;
  EditTeller teller(keeper.is_needed() ? &keeper : nullptr, in.options.observer);
  run.set_trace(teller.is_needed() ? &teller : nullptr);
  if (in.options.operators != nullptr) run.set_block_count(1);
  run.set_most_tets(in.options.most_tets);
  run.set_most_attempts(in.attempts_left);
  run.set_cancel_flag(in.options.cancel);
  const std::size_t first = run.records.size();
  const auto leave = [&] {
    run.set_trace(nullptr);
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
  try {
    face::on_threads(in.options.threads, [&] { pass(run); });
  } catch (...) {
    leave();
    in.run.reset();
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
  make([&](tetmend::Run& run) { run.set_standard(Standard(goal, now.terms(), now.price())); });
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
