// SPDX-License-Identifier: MIT
// The fixed order of an attempt.
#include "ops/operator.h"

#include <new>

#include <fmt/format.h>

#include "kernel/workspace.h"
#include "ops/attempt_watch.h"

namespace tetmend {

namespace {

/// The tet of a target; invalid for a vertex.
TetHandle tet_of(Target target) {
  switch (target.kind) {
    case TargetKind::tet:
      return target.tet();
    case TargetKind::edge:
      return target.edge().tet();
    case TargetKind::face:
      return target.face().tet();
    case TargetKind::vertex:
      break;
  }
  return {};
}

}  // namespace

bool has_no_room(const OperatorContext& context) {
  return context.judge->kind() != Judge::Kind::opening && context.workspace.is_full(context.mesh);
}

TargetVertices::TargetVertices(const TetMesh& mesh, Target target) {
  const auto take = [&](const auto& vertices) {
    for (const VertexHandle v : vertices) vertices_[count_++] = v;
  };
  switch (target.kind) {
    case TargetKind::tet:
      take(mesh.vertices(target.tet()));
      break;
    case TargetKind::edge:
      take(mesh.vertices(target.edge()));
      break;
    case TargetKind::face:
      take(mesh.vertices(target.face()));
      break;
    case TargetKind::vertex:
      take(std::array{target.vertex()});
  }
}

OperatorState& OperatorStates::of(const Operator& op) {
  const std::type_info* type = &typeid(op);
  for (const Entry& entry : entries_) {
    if (entry.type == type) return *entry.state;
  }
  return *entries_.emplace_back(Entry{type, op.make_state()}).state;
}

Error Operator::failure(Target target, std::string_view reason) const {
  return Error(fmt::format("operator '{}'{}{} failed at {} {}: {}", info_.name,
                           origin_.empty() ? "" : " of ", origin_, to_string(target.kind),
                           target.code, reason));
}

Verdict Operator::try_target(OperatorContext& context, Target target) const {
  context.workspace.forget_border();
  Verdict verdict{};
  try {
    verdict = run_stages(context, target);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw failure(target, error.what());
  } catch (...) {
    throw failure(target, "an exception of an unknown type");
  }
  const bool crosses = verdict != Verdict::accepted && context.workspace.met_border();
  return crosses ? Verdict::deferred : verdict;
}

Verdict Operator::run_stages(OperatorContext& context, Target target) const {
  OperatorState& state = context.states.of(*this);
  const Judge* const judge = context.judge;
  context.states.comparison.forget();
  // Open from the start: edits of the first two stages, which must make none, are undone as well.
  Transaction transaction(context.mesh, context.workspace);
  Verdict verdict = precondition_in(context, target, state);
  if (verdict == Verdict::accepted) verdict = evaluate_in(context, target, state);
  if (!transaction.empty()) throw Error("it edits the mesh before apply()");
  if (verdict != Verdict::accepted) return verdict;
  context.judge = judge;  // whatever a stage made of it
  if (context.trace != nullptr) context.trace->candidate_found();
  verdict = try_proposals(context, target, transaction, state);
  if (verdict == Verdict::accepted) transaction.keep();
  return verdict;
}

/// The one place where a judge is asked.
Verdict Operator::try_proposals(OperatorContext& context, Target target, Transaction& transaction,
                                OperatorState& state) const {
  const TetHandle tet = tet_of(target);
  const TetVertices corners = tet.is_valid() ? context.mesh.vertices(tet) : TetVertices{};
  Comparison& comparison = context.states.comparison;
  const Judge& judge = *context.judge;
  for (;;) {
    Verdict verdict = apply_in(context, target, transaction, state);
    if (verdict != Verdict::accepted) {
      comparison.forget();  // of what apply() compared on its way
    } else if (!judge.accepts({transaction, comparison, tet, corners})) {
      verdict = Verdict::no_improvement;
    }
    if (verdict == Verdict::accepted || verdict == Verdict::deferred) return verdict;
    transaction.undo();
    if (!propose_next_in(context, target, state)) return verdict;
    if (!transaction.empty()) throw Error("it edits the mesh before apply()");
  }
}

void report_end(OperatorContext& context, Verdict verdict) {
  Comparison& comparison = context.states.comparison;
  if (verdict == Verdict::accepted || verdict == Verdict::no_improvement) {
    context.trace->attempt_ends(verdict, comparison.before(), comparison.now());
  } else {
    context.trace->attempt_ends(verdict, {}, {});
  }
}

Verdict Operator::attempt(OperatorContext& outer, Target target) const {
  OperatorContext context = outer;
  if (context.judge == nullptr) context.judge = &judge_;
  const AttemptMark mark(*this, target);
  if (context.trace == nullptr) return try_target(context, target);

  const TargetVertices vertices(context.mesh, target);
  context.trace->attempt_begins({info_.name, vertices.all(), context.level, settings_});
  const Verdict verdict = try_target(context, target);
  report_end(context, verdict);
  return verdict;
}

}  // namespace tetmend
