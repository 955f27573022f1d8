// SPDX-License-Identifier: MIT
// The fixed order of an attempt.
#include "ops/operator.h"

#include <algorithm>
#include <new>

#include <fmt/format.h>

namespace tetmend {

namespace {

/// What ends without a comparison has none to tell of.
void forget_comparison(Scratch& scratch) {
  scratch.before.clear();
  scratch.now.clear();
}

}  // namespace

bool is_better(const Transaction& transaction, Scratch& scratch) {
  if (transaction.empty()) {
    forget_comparison(scratch);
    return false;
  }
  transaction.list_qualities(scratch.before, scratch.now);
  // The worst tets decide nearly always; then nothing needs to be sorted.
  if (!scratch.before.empty() && !scratch.now.empty()) {
    const Quality worst_before = *std::min_element(scratch.before.begin(), scratch.before.end());
    const Quality worst_now = *std::min_element(scratch.now.begin(), scratch.now.end());
    if (worst_now < worst_before) return false;
    if (worst_now > worst_before + kQualityTolerance) return true;
  }
  std::sort(scratch.before.begin(), scratch.before.end());
  std::sort(scratch.now.begin(), scratch.now.end());
  return improves(scratch.now, scratch.before);
}

bool Operator::is_improvement(const Transaction& transaction, Scratch& scratch) const {
  return is_better(transaction, scratch);
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
  // Open from the start: edits of the first two stages, which must make none, are undone as well.
  Transaction transaction(context.mesh, context.workspace);
  Verdict verdict = precondition(context, target);
  if (verdict == Verdict::accepted) verdict = evaluate(context, target);
  if (!transaction.empty()) throw Error("it edits the mesh before apply()");
  if (verdict == Verdict::accepted) {
    if (context.trace != nullptr) context.trace->candidate_found();
    verdict = apply(context, target, transaction);
  }
  if (verdict != Verdict::accepted) {
    forget_comparison(context.scratch);
    return verdict;
  }
  const bool better = is_improvement(transaction, context.scratch);
  const bool may_stay = better || (context.opening && !transaction.empty());
  if (!may_stay) return Verdict::no_improvement;
  transaction.keep();
  return Verdict::accepted;
}

void report_end(OperatorContext& context, Verdict verdict) {
  Scratch& scratch = context.scratch;
  if (verdict == Verdict::accepted || verdict == Verdict::no_improvement) {
    std::sort(scratch.before.begin(), scratch.before.end());
    std::sort(scratch.now.begin(), scratch.now.end());
    context.trace->attempt_ends(verdict, scratch.before, scratch.now);
  } else {
    context.trace->attempt_ends(verdict, {}, {});
  }
}

Verdict Operator::attempt(OperatorContext& context, Target target) const {
  if (context.trace == nullptr) return try_target(context, target);

  std::array<VertexHandle, 4> vertices;
  std::size_t count = 0;
  const auto take = [&](const auto& of) {
    for (const VertexHandle v : of) vertices[count++] = v;
  };
  switch (target.kind) {
    case TargetKind::tet:
      take(context.mesh.vertices(target.tet()));
      break;
    case TargetKind::edge:
      take(context.mesh.vertices(target.edge()));
      break;
    case TargetKind::face:
      take(context.mesh.vertices(target.face()));
      break;
    case TargetKind::vertex:
      vertices[count++] = target.vertex();
      break;
  }
  context.trace->attempt_begins({info_.name, {vertices.data(), count}, context.level, settings_});
  const Verdict verdict = try_target(context, target);
  report_end(context, verdict);
  return verdict;
}

}  // namespace tetmend
