// SPDX-License-Identifier: MIT
#include "explain/call_facts.h"

#include <algorithm>
#include <array>
#include <limits>
#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>

#include "explain/slot_shell.h"
#include "kernel/spaced.h"

namespace tetmend::explain {

namespace {

/// The tets at the targets of an outermost call, while replay goes through it.
class Neighbourhood {
 public:
  Neighbourhood(const TraceFile& file, Replay& replay, std::uint32_t root) : mesh_(replay.mesh()) {
    for (std::uint32_t k = root; k < file.calls()[root].subtree_end; ++k) {
      for (const VertexHandle v : file.calls()[k].target()) targets_.insert(v.index());
    }
    for (const std::uint32_t v : targets_) {
      for (const TetHandle t : replay.tets_around(std::array{VertexHandle(v)})) {
        tets_[t.index()] = mesh_.vertices(t);
      }
    }
  }

  void follow(const Cavity& cavity) {
    for (const CavityTet& tet : cavity.removed) tets_.erase(tet.tet.index());
    for (const CavityTet& tet : cavity.created) {
      if (is_near(tet.vertices)) tets_[tet.tet.index()] = tet.vertices;
    }
  }

  struct Around {
    unsigned degree = 0;
    Quality quality = 0;
  };
  Around around(std::span<const VertexHandle> target) const {
    Around result;
    Quality worst = std::numeric_limits<Quality>::infinity();
    for (const auto& entry : tets_) {
      if (!std::all_of(target.begin(), target.end(),
                       [&](VertexHandle v) { return contains(entry.second, v); })) {
        continue;
      }
      ++result.degree;
      worst = std::min(worst, mesh_.quality(TetHandle(entry.first)));
    }
    if (result.degree > 0) result.quality = worst;
    return result;
  }

 private:
  bool is_near(const TetVertices& tet) const {
    return std::any_of(tet.begin(), tet.end(),
                       [&](VertexHandle v) { return targets_.contains(v.index()); });
  }

  const SlotMesh& mesh_;
  std::unordered_set<std::uint32_t> targets_;
  std::unordered_map<std::uint32_t, TetVertices> tets_;  // by slot
};

std::vector<CallFacts> collect(const TraceFile& file, Replay& replay, std::uint32_t root) {
  const auto calls = file.calls();
  std::vector<CallFacts> facts(calls[root].subtree_end - root);
  const std::uint64_t home = replay.position();
  replay.seek(calls[root].events.begin);
  Neighbourhood near(file, replay, root);
  EventCursor cursor(file);
  cursor.move_to(calls[root].events.begin);
  std::uint32_t next = root;
  std::vector<std::uint32_t> open;
  while (cursor.position() < calls[root].events.end) {
    const EventKind kind = cursor.next().kind;
    if (changes_mesh(kind)) {
      replay.seek(cursor.position());
      near.follow(replay.cavity());
    } else if (kind == EventKind::attempt_begins) {
      const auto found = near.around(calls[next].target());
      facts[next - root] = {found.degree, found.degree, found.quality, found.quality};
      open.push_back(next++);
    } else if (kind == EventKind::attempt_ends) {
      const auto found = near.around(calls[open.back()].target());
      facts[open.back() - root].degree_after = found.degree;
      facts[open.back() - root].quality_after = found.quality;
      open.pop_back();
    }
  }
  replay.seek(home);
  return facts;
}

}  // namespace

std::uint32_t root_of(const TraceFile& file, std::uint32_t call) {
  while (file.calls()[call].parent != kNoCall) call = file.calls()[call].parent;
  return call;
}

const CallFacts& FactTable::facts(const TraceFile& file, Replay& replay, std::uint32_t call) {
  const std::uint32_t root = root_of(file, call);
  auto found = by_root_.find(root);
  if (found == by_root_.end()) {
    if (by_root_.size() >= kMostKept) by_root_.clear();
    found = by_root_.emplace(root, collect(file, replay, root)).first;
  }
  return found->second[call - root];
}

std::string format_target(const Call& call) {
  constexpr std::array<std::string_view, 5> kKinds = {"", "vertex", "edge", "face", "tet"};
  std::string text(kKinds[call.target_size]);
  for (const VertexHandle v : call.target()) text += fmt::format(" {}", v.index());
  return text;
}

std::string_view neighbourhood_of(const Call& call) {
  switch (call.algorithm) {
    case Algorithm::multi_face_removal:
      return "Virtual shell";
    case Algorithm::cavity_insertion:
      return "Cavity";
    case Algorithm::polyhedron_reconnection:
      return "Small polyhedron";
    default:
      break;
  }
  switch (call.target_size) {
    case 1:
      return "Ball";
    case 2:
      return "Shell";
    default:
      return "Tets of the call";
  }
}

std::string degree_text(const CallFacts& facts) {
  if (facts.degree_before == facts.degree_after) return fmt::format("{}", facts.degree_before);
  return fmt::format("{} -> {}", facts.degree_before, facts.degree_after);
}

std::string quality_text(const Call& call, const CallFacts& facts) {
  // The worst of a bad mesh are no zeros.
  const auto text = [](double quality) {
    constexpr double kSmall = 0.01;
    const bool is_small = quality != 0 && std::abs(quality) < kSmall;
    return is_small ? fmt::format("{:.4f}", quality) : fmt::format("{:.3f}", quality);
  };
  if (call.accepted() && call.worst_before != 0) {
    return text(call.worst_before) + " -> " + text(call.worst_after);
  }
  const std::string before = text(facts.quality_before);
  if (facts.degree_after == 0) return before + " -> removed";
  if (facts.quality_before == facts.quality_after) return before;
  return before + " -> " + text(facts.quality_after);
}

std::string short_name(std::string_view operator_name) {
  switch (algorithm_of(operator_name)) {
    case Algorithm::recursion:
      return "recursion";
    case Algorithm::shell_transformation:
      return "shell";
    case Algorithm::multi_face_removal:
      return "face removal";
    default:
      break;
  }
  std::string name(operator_name);
  constexpr std::string_view kFlip = "flip_";
  if (name.starts_with(kFlip)) {  // as everybody says: a 3-2 flip
    name.erase(0, kFlip.size());
    std::replace(name.begin(), name.end(), '_', '-');
    return name + " flip";
  }
  return spaced(name);
}

std::string short_name(const TraceFile& file, const Call& call) {
  return short_name(file.name(call.operator_name));
}

Outcome outcome_of(const Call& call) {
  if (!call.verdict) return Outcome::unfinished;
  switch (*call.verdict) {
    case Verdict::accepted:
      return call.undone ? Outcome::undone : Outcome::accepted;
    case Verdict::no_improvement:
      return call.candidate_found ? Outcome::rejected : Outcome::no_improvement;
    case Verdict::inverted:
      return Outcome::rejected;
    case Verdict::depth_spent:
    case Verdict::budget_spent:
      return Outcome::limit;
    case Verdict::constrained:
      return Outcome::constrained;
    case Verdict::not_applicable:
      return Outcome::not_applicable;
    case Verdict::deferred:
      break;
  }
  return Outcome::deferred;
}

std::string_view outcome_name(Outcome outcome) {
  switch (outcome) {
    case Outcome::unfinished:
      return "cut off";
    case Outcome::accepted:
      return "accepted for good";
    case Outcome::undone:
      return "undone with a caller";
    case Outcome::no_improvement:
      return "nothing better found";
    case Outcome::limit:
      return "level or budget spent";
    case Outcome::constrained:
      return "constrained";
    case Outcome::rejected:
      return "tried and undone";
    case Outcome::not_applicable:
      return "not applicable";
    case Outcome::deferred:
      break;
  }
  return "deferred, to be tried again";
}

std::string outcome_text(const Call& call, std::uint64_t position) {
  if (position <= call.events.begin) return "to come";
  return position < call.events.end ? "under way" : call.verdict_in_words();
}

}  // namespace tetmend::explain
