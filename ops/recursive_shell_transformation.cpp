// SPDX-License-Identifier: MIT
// [chen, Alg. 4], with the tail call as a loop:
//
//   reduce(e, f, level):  removes edge e, or at least face f = (e, apex); at level 0 there is no f
//     loop: transform the shell of e; done when e or f is gone; give up at the last level
//           for each supporting face of e with a promising link edge e':
//             reduce(e', that face, level + 1)
//             when the shell of e became smaller: next round of the loop
//           give up when no face helped
#include <algorithm>
#include <optional>

#include "kernel/workspace.h"
#include "ops/builtin_operators.h"
#include "ops/shell_search.h"
#include "trace/algorithm.h"

namespace tetmend {

namespace {

constexpr int kDeepest = 16;

struct RecursionLimits {
  int max_level;
  int budget;
  bool reflex_only;
  bool filter;
};

class Recursion {
 public:
  Recursion(OperatorContext& context, const RecursionLimits& limits, ShellState& state)
      : context_(context),
        mesh_(context.mesh),
        limits_(limits),
        state_(state),
        // Each step improves the mesh by itself, unless the whole opens a sequence.
        judge_(context.judge->kind() == Judge::Kind::opening ? *context.judge : Judge::strict()),
        budget_(limits.budget) {}

  /// Removes the edge of a searchable shell, which may change on the way.
  Verdict remove(Shell& shell) { return reduce(State::found, shell, VertexHandle(), 0); }

 private:
  /// What is left of an edge e and its face f.
  enum class State {
    gone,     ///< e is gone
    reduced,  ///< f is gone
    found,    ///< both are there
    blocked   ///< e is there, but its shell cannot be searched; or the search for e met the border
  };
  Verdict reduce(State state, Shell& shell, VertexHandle apex, int level);
  std::optional<State> reduce_faces(Shell& shell, VertexHandle apex, int level);
  bool reduce_face(const Shell& shell, unsigned i, int level);
  Verdict reduce_link_edge(const Shell& shell, unsigned i, VertexHandle end, int level);
  using Ancestor = std::array<VertexHandle, 2>;

  State locate(VertexHandle a, VertexHandle b, TetHandle hint, VertexHandle apex, Shell& shell);
  State relocate(VertexHandle apex, Shell& shell);
  Verdict transform(const Shell& shell, int level);
  Verdict try_transform(const Shell& shell, int level);
  ShellLocks locks(const Shell& shell, int level) const;
  std::array<VertexHandle, 2> pick_link_edges(const Shell& shell, unsigned i, int level) const;
  VertexHandle promising_end(const Shell& shell, unsigned i) const;
  bool overlaps_ancestor(const Shell& shell, unsigned i, int level) const;

  OperatorContext& context_;
  const TetMesh& mesh_;
  const RecursionLimits& limits_;
  ShellState& state_;
  Judge judge_;
  int budget_;
  bool too_deep_ = false;
  std::size_t changes_ = 0;
  std::array<Ancestor, kDeepest> ancestors_;  // supporting edges of the callers, [0, level)
};

/// Finds the shell of ab, and looks whether the face (a, b, apex) is in it.
Recursion::State Recursion::locate(VertexHandle a, VertexHandle b, TetHandle hint,
                                   VertexHandle apex, Shell& shell) {
  const auto edge = find_edge(mesh_, a, b, context_.workspace, hint);
  if (!edge) return context_.workspace.met_border() ? State::blocked : State::gone;
  if (find_searchable_shell(context_, *edge, shell) != Verdict::accepted) return State::blocked;
  if (shell.a != a) {  // the tet names the edge the other way round: keep the caller's sense
    std::swap(shell.a, shell.b);
    std::reverse(shell.ring.begin(), shell.ring.begin() + shell.degree);
    std::reverse(shell.tets.begin(), shell.tets.begin() + shell.degree - 1);
  }
  const auto end = shell.ring.begin() + shell.degree;
  if (apex.is_valid() && std::find(shell.ring.begin(), end, apex) == end) return State::reduced;
  return State::found;
}

/// As locate(), with the tets of the old shell as hints: often one of them still holds the edge.
Recursion::State Recursion::relocate(VertexHandle apex, Shell& shell) {
  const VertexHandle a = shell.a;
  const VertexHandle b = shell.b;
  TetHandle hint;
  for (unsigned i = 0; i < shell.degree && !hint.is_valid(); ++i) {
    const TetHandle t = shell.tets[i];
    if (t.index() < mesh_.tet_slots() && !mesh_.is_deleted(t) && edge_in(mesh_, t, a, b)) hint = t;
  }
  return locate(a, b, hint, apex, shell);
}

ShellLocks Recursion::locks(const Shell& shell, int level) const {
  return lock_ancestors(shell.a, shell.b, std::span(shell.ring).first(shell.degree),
                        std::span(ancestors_).first(static_cast<std::size_t>(level)));
}

Verdict Recursion::transform(const Shell& shell, int level) {
  if (context_.trace == nullptr) return try_transform(shell, level);
  const std::array<VertexHandle, 2> edge = {shell.a, shell.b};
  context_.trace->attempt_begins(
      {operator_name(Algorithm::shell_transformation), edge, static_cast<unsigned>(level)});
  const Verdict verdict = try_transform(shell, level);
  report_end(context_, verdict);
  return verdict;
}

Verdict Recursion::try_transform(const Shell& shell, int level) {
  --budget_;
  context_.states.comparison.forget();  // nothing is compared yet
  Verdict verdict =
      propose_covering(context_, judge_, shell, locks(shell, level), Core::allowed, state_);
  if (verdict != Verdict::accepted) return verdict;
  if (context_.trace != nullptr) context_.trace->candidate_found();
  verdict = take_step(context_, judge_, state_.replacement);
  if (verdict == Verdict::accepted) ++changes_;
  return verdict;
}

/// A tet at the face that also belongs to the shell of an ancestor must stay ([chen, 5.2 (2)]).
bool Recursion::overlaps_ancestor(const Shell& shell, unsigned i, int level) const {
  for (const VertexHandle fourth : {shell.previous(i), shell.next(i)}) {
    const auto in_tet = [&](VertexHandle v) {
      return v == shell.a || v == shell.b || v == shell.ring[i] || v == fourth;
    };
    for (int n = 0; n < level; ++n) {
      const auto& [x, y] = ancestors_[static_cast<std::size_t>(n)];
      if (in_tet(x) && in_tet(y)) return true;
    }
  }
  return false;
}

/// The ends of the supporting edge from which the link edges to ring vertex i start that are to be
/// removed; invalid ones count for nothing.
std::array<VertexHandle, 2> Recursion::pick_link_edges(const Shell& shell, unsigned i,
                                                       int level) const {
  if (overlaps_ancestor(shell, i, level)) return {};
  if (!limits_.filter) return {shell.a, shell.b};
  return {promising_end(shell, i), VertexHandle()};
}

/// The end whose link edge to p = ring[i] is worth removing, or nothing. The line through the ring
/// neighbours of p meets the plane of the face (a, b, p) in a point. A link edge is *reflex* if the
/// point lies beyond it, or on it. Removing a link edge removes the face only if that edge is the
/// only reflex one, and the point does not lie beyond ab.
VertexHandle Recursion::promising_end(const Shell& shell, unsigned i) const {
  const Point& a = mesh_.point(shell.a);
  const Point& b = mesh_.point(shell.b);
  const Point& p = mesh_.point(shell.ring[i]);
  const Point& before = mesh_.point(shell.previous(i));
  const Point& after = mesh_.point(shell.next(i));
  if (volume6(a, b, before, after) <= 0) return {};
  const bool a_reflex = volume6(a, before, p, after) <= 0;
  const bool b_reflex = volume6(before, p, after, b) <= 0;
  if (a_reflex && b_reflex) return {};
  if (!a_reflex && !b_reflex) return limits_.reflex_only ? VertexHandle() : shell.a;
  return a_reflex ? shell.a : shell.b;
}

/// The recursive call for the supporting face at ring vertex i: removes the link edge from `end`.
Verdict Recursion::reduce_link_edge(const Shell& shell, unsigned i, VertexHandle end, int level) {
  const VertexHandle p = shell.ring[i];
  const VertexHandle other_end = end == shell.a ? shell.b : shell.a;
  ancestors_[static_cast<std::size_t>(level)] = {shell.a, shell.b};
  Shell next;
  const auto reduce_next = [&] {
    const State state = locate(end, p, shell.tets[i], other_end, next);
    return reduce(state, next, other_end, level + 1);
  };
  if (context_.trace == nullptr) return reduce_next();
  const std::array<VertexHandle, 2> edge = {end, p};
  context_.trace->attempt_begins(
      {operator_name(Algorithm::recursion), edge, static_cast<unsigned>(level + 1)});
  const Verdict verdict = reduce_next();
  context_.trace->attempt_ends(verdict, {}, {});
  return verdict;
}

/// Tries the link edges of the supporting face at ring vertex i. True as soon as the mesh is another
/// one; then the shell is out of date.
bool Recursion::reduce_face(const Shell& shell, unsigned i, int level) {
  const std::size_t changes = changes_;
  for (const VertexHandle end : pick_link_edges(shell, i, level)) {
    if (!end.is_valid()) continue;
    reduce_link_edge(shell, i, end, level);
    if (changes_ != changes) return true;
  }
  return false;
}

/// Tries the supporting faces in the order of the ring, until the shell is smaller or not `found`.
/// Nothing if no face helped.
std::optional<Recursion::State> Recursion::reduce_faces(Shell& shell, VertexHandle apex,
                                                        int level) {
  const unsigned degree = shell.degree;
  for (unsigned i = 0; i < shell.degree; ++i) {
    if (!reduce_face(shell, i, level)) continue;
    const State state = relocate(apex, shell);
    if (state != State::found || shell.degree < degree) return state;
  }
  return std::nullopt;
}

Verdict Recursion::reduce(State state, Shell& shell, VertexHandle apex, int level) {
  while (state == State::found) {
    if (budget_ <= 0) return Verdict::budget_spent;
    if (transform(shell, level) == Verdict::accepted) {
      state = relocate(apex, shell);
      if (state != State::found) break;
    }
    if (level >= limits_.max_level) {
      too_deep_ = true;
      return Verdict::depth_spent;
    }
    const std::optional<State> smaller = reduce_faces(shell, apex, level);
    if (!smaller) {
      if (budget_ <= 0) return Verdict::budget_spent;
      return too_deep_ ? Verdict::depth_spent : Verdict::no_improvement;
    }
    state = *smaller;
  }
  return state == State::blocked ? Verdict::constrained : Verdict::accepted;
}

/// Target: an edge. Transforms its shell. While that is not fully reduced, removes supporting faces
/// by recursive calls on their reflex link edges ([chen, Alg. 4, 5.1-5.3]). Each transformation
/// improves the quality vector of its own shell, so partial success is kept.
class RecursiveShellTransformation final : public OperatorOf<ShellState> {
 public:
  explicit RecursiveShellTransformation(const ParameterValues& values)
      : OperatorOf(recursive_shell_transformation_info()),
        limits_{.max_level = values.integer("max_level"),
                .budget = values.integer("budget"),
                .reflex_only = values.flag("reflex_only"),
                .filter = values.flag("filter")} {}

 protected:
  Verdict precondition(const OperatorContext& context, Target target,
                       ShellState& state) const override {
    return find_searchable_shell(context, target.edge(), state.shell);
  }
  /// Nothing to find beforehand: what a step of apply() finds depends on the steps before it.
  Verdict evaluate(OperatorContext&, Target, ShellState&) const override {
    return Verdict::accepted;
  }
  Verdict apply(OperatorContext& context, Target, Transaction& transaction,
                ShellState& state) const override {
    Recursion recursion(context, limits_, state);
    const Verdict verdict = recursion.remove(state.shell);
    // What was reached on the way is an improvement by itself.
    return transaction.empty() ? verdict : Verdict::accepted;
  }

 private:
  RecursionLimits limits_;
};

constexpr std::array<ParameterSpec, 4> kRecursionParameters = {{
    {"max_level", ParameterSpec::Kind::integer, 0, kDeepest - 1, 5,
     "deepest recursion level; 0 means no recursion"},
    {"budget", ParameterSpec::Kind::integer, 1, 1e6, 400,
     "most shell transformations for one target"},
    {"reflex_only", ParameterSpec::Kind::flag, 0, 1, 1, "recurse only on reflex link edges"},
    {"filter", ParameterSpec::Kind::flag, 0, 1, 1,
     "recurse only on link edges whose removal would remove a supporting face"},
}};

}  // namespace

const OperatorInfo& recursive_shell_transformation_info() {
  static constexpr OperatorInfo kInfo = describe<RecursiveShellTransformation>(
      "recursive_shell_transformation", TargetKind::edge,
      "remove an edge by shell transformations on it and, recursively, on edges around it",
      kRecursionParameters);
  return kInfo;
}

}  // namespace tetmend
