// SPDX-License-Identifier: MIT
#include "contract/inspector.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "contract/changed_tets.h"
#include "contract/portrait.h"
#include "contract/trials.h"
#include "kernel/workspace.h"

namespace tetmend::contract {

namespace {

Breach breach(const Operator& op, Target target, std::string_view complaint) {
  return Breach(fmt::format("operator '{}' of {} breaks the contract at {} {}: {}", op.info().name,
                            op.origin(), to_string(target.kind), target.code, complaint));
}

/// What was compared without having changed; nothing if a change is missing there.
bool find_rest(std::span<const Quality> seen, const std::vector<NamedTet>& changed,
               std::vector<Quality>& rest) {
  std::vector<Quality> qualities;
  for (const NamedTet& tet : changed) qualities.push_back(tet.second);
  std::sort(qualities.begin(), qualities.end());
  std::set_difference(seen.begin(), seen.end(), qualities.begin(), qualities.end(),
                      std::back_inserter(rest));
  return std::includes(seen.begin(), seen.end(), qualities.begin(), qualities.end());
}

/// A tet that was touched and came out the same is in both vectors.
bool has_seen(Comparison& comparison, const ChangedTets& changed) {
  std::vector<Quality> same_before;
  std::vector<Quality> same_now;
  return find_rest(comparison.before(), changed.before, same_before) &&
         find_rest(comparison.now(), changed.now, same_now) && same_before == same_now;
}

bool lies_in(const Territory& territory, const std::vector<NamedTet>& tets) {
  if (territory.is_whole()) return true;
  return std::all_of(tets.begin(), tets.end(), [&](const NamedTet& tet) {
    return std::all_of(tet.first.begin(), tet.first.end(),
                       [&](VertexHandle v) { return territory.holds(v); });
  });
}

}  // namespace

Verdict Inspector::attempt(const Operator& op, OperatorContext& context, Target target) {
  if (op.origin().empty()) return op.attempt(context, target);
  before_ = context.mesh;
  context.workspace.take_reached_out();
  Verdict verdict{};
  try {
    verdict = op.attempt(context, target);
  } catch (const std::exception& error) {  // also std::bad_alloc
    if (context.mesh == before_) throw;
    throw breach(op, target, fmt::format("the error left a trace: {}", error.what()));
  }
  std::string complaint;
  if (context.workspace.take_reached_out()) {
    complaint = kReachedOut;
  } else if (verdict == Verdict::accepted) {
    complaint = complaint_about_accepted(op, context);
  } else if (!(context.mesh == before_)) {
    complaint = "the refusal left a trace";
  }
  if (!complaint.empty()) throw breach(op, target, complaint);
  return verdict;
}

std::string Inspector::complaint_about_accepted(const Operator& op,
                                                OperatorContext& context) const {
  const Judge& judge = context.judge == nullptr ? op.judge() : *context.judge;
  if (context.judge == nullptr && judge.kind() == Judge::Kind::opening) {
    return "its own judge is that of an opening, and nobody judges the whole";
  }
  const ChangedTets changed = changed_tets(before_, context.mesh);
  const Territory& territory = context.workspace.territory();
  if (!lies_in(territory, changed.before) || !lies_in(territory, changed.now)) {
    return "something outside the territory changed";
  }
  if (!has_seen(context.states.comparison, changed)) {
    return "something changed that the judge did not see";
  }
  TetMesh now = context.mesh;
  Workspace(context.workspace).settle(now);  // of a copy: in a territory the counts wait
  const Portrait known = portrait(before_);
  const bool asks_for_better =
      judge.kind() == Judge::Kind::strict || judge.kind() == Judge::Kind::fair;
  return asks_for_better ? complaint_about(known, now) : complaint_about_loss(known, now);
}

}  // namespace tetmend::contract
