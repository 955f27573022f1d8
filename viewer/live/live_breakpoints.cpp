// SPDX-License-Identifier: MIT
#include "viewer/live/live_breakpoints.h"

#include <algorithm>
#include <utility>

namespace tetmend::viewer {

namespace {

bool edit_touches(const Journal& journal, const Edit& edit, const Condition::Term& term) {
  if (term.kind == Condition::Kind::vertex) {
    return edit.kind != Edit::Kind::replace_cavity && edit.vertex == VertexHandle(term.numbers[0]);
  }
  const TetHandle tet(term.numbers[0]);
  if (edit.kind == Edit::Kind::move_vertex) {
    for (std::uint32_t k = edit.qualities_begin; k < edit.qualities_end; ++k) {
      if (journal.qualities[k].tet == tet) return true;
    }
  }
  if (edit.kind != Edit::Kind::replace_cavity) return false;
  for (std::uint32_t k = edit.removed_begin; k < edit.removed_end; ++k) {
    if (journal.removed[k].tet == tet) return true;
  }
  for (std::uint32_t k = edit.created_begin; k < edit.created_end; ++k) {
    if (journal.created[k] == tet) return true;
  }
  return false;
}

}  // namespace

void LiveBreakpoints::set(std::vector<Condition> conditions) {
  conditions_ = std::move(conditions);
  hit_.reset();
  hit_for_good_.reset();
}

void LiveBreakpoints::note(const Condition& condition) {
  auto& hit = condition.for_good ? hit_for_good_ : hit_;
  if (!hit) hit = to_text(condition);
}

void LiveBreakpoints::look(const TetMesh& mesh, const Call& call, std::optional<Verdict> verdict,
                           double worst) {
  const ConditionCall asked{call.operator_name, call.level, call.target, verdict, worst};
  const PlaceOf place_of = [&](VertexHandle v) -> std::optional<Point> {
    if (v.index() >= mesh.vertex_slots() || mesh.is_deleted(v)) return std::nullopt;
    return mesh.point_in_file(v);
  };
  for (const Condition& condition : conditions_) {
    const auto& terms = condition.terms;
    const bool at_end = std::any_of(terms.begin(), terms.end(), is_about_end);
    if (at_end != verdict.has_value()) continue;
    const bool all = std::all_of(terms.begin(), terms.end(), [&](const Condition::Term& term) {
      return holds(term, asked, place_of);
    });
    if (all) note(condition);
  }
}

void LiveBreakpoints::attempt_begins(const TetMesh& mesh, const AttemptEvent& event) {
  open_.push_back({std::string(event.operator_name),
                   {event.target.begin(), event.target.end()},
                   event.level,
                   visited_});
  look(mesh, open_.back(), std::nullopt, open_.back().worst);
}

void LiveBreakpoints::attempt_ends(const TetMesh& mesh, Verdict verdict, double worst_before) {
  look(mesh, open_.back(), verdict, worst_before != 0 ? worst_before : open_.back().worst);
  open_.pop_back();
}

void LiveBreakpoints::edit_made(const Journal& journal) {
  const Edit& edit = journal.edits.back();
  const PlaceOf nowhere = [](VertexHandle) { return std::optional<Point>(); };
  for (const Condition& condition : conditions_) {
    const auto& terms = condition.terms;
    if (std::none_of(terms.begin(), terms.end(), is_about_edit)) continue;
    const bool all = std::all_of(terms.begin(), terms.end(), [&](const Condition::Term& term) {
      if (is_about_edit(term)) return edit_touches(journal, edit, term);
      if (open_.empty()) return false;
      const Call& call = open_.back();
      return holds(term, {call.operator_name, call.level, call.target, {}, call.worst}, nowhere);
    });
    if (all) note(condition);
  }
}

std::optional<std::string> LiveBreakpoints::take(bool accepted) {
  auto hit = std::exchange(hit_, std::nullopt);
  auto lasting = std::exchange(hit_for_good_, std::nullopt);
  return hit ? hit : accepted ? lasting : std::nullopt;
}

}  // namespace tetmend::viewer
