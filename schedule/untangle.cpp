// SPDX-License-Identifier: MIT
// The pass that moves the vertices of tangles, each tangle as a whole.
//
//   find tangles -> for each: points and tets -> Untangler -> one edit of all moves -> judge
#include <algorithm>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/star.h"
#include "kernel/workspace.h"
#include "schedule/passes.h"
#include "schedule/tangle.h"
#include "search/untangler.h"

namespace tetmend {

namespace {

/// Points and tets of a tangle; vertices that stay get their numbers as they are met.
TangledPatch make_patch(const TetMesh& mesh, const Tangle& tangle) {
  TangledPatch patch;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;
  const auto number = [&](VertexHandle v) {
    const auto [found, is_new] =
        numbers.emplace(v.index(), static_cast<std::uint32_t>(patch.points.size()));
    if (is_new) patch.points.push_back(mesh.point(v));
    return found->second;
  };
  for (const VertexHandle v : tangle.free) number(v);
  patch.free_count = tangle.free.size();
  patch.tets.reserve(tangle.tets.size());
  for (const TetHandle t : tangle.tets) {
    const TetVertices& v = mesh.vertices(t);
    // In a braced list: numbers are given from left to right.
    patch.tets.push_back({number(v[0]), number(v[1]), number(v[2]), number(v[3])});
  }
  return patch;
}

/// The moves of the vertices of a tangle, and the links that they need.
struct Moves {
  std::vector<HalfFace> links;
  std::vector<VertexMove> moves;

  Moves(const TetMesh& mesh, const Tangle& tangle, std::span<const Point> points) {
    std::vector<std::size_t> ends;
    for (std::size_t i = 0; i < tangle.free.size(); ++i) {
      const VertexHandle v = tangle.free[i];
      if (points[i] == mesh.point(v)) continue;
      const auto around = link(mesh, v);
      links.insert(links.end(), around.begin(), around.end());
      ends.push_back(links.size());
      moves.push_back({v, points[i], {}});
    }
    const std::span<const HalfFace> all = links;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < moves.size(); ++i) {
      moves[i].link = all.subspan(begin, ends[i] - begin);
      begin = ends[i];
    }
  }
};

class Untangling {
 public:
  Untangling(Run& run, const UntangleOptions& options) : run_(run), options_(options) {}

  void work_on(const Tangle& tangle) {
    before_ += count_inverted(tangle);
    OperatorContext& context = run_.worker().context();
    if (context.trace != nullptr) {
      context.trace->attempt_begins({.operator_name = kUntanglingName,
                                     .target = run_.mesh().vertices(tangle.worst),
                                     .settings = {}});
    }
    const Verdict verdict = run_.worker().count(attempt(tangle));
    if (context.trace != nullptr) report_end(context, verdict);
    now_ += count_inverted(tangle);
  }
  std::string summary() const {
    return fmt::format("untangle: {} of {} inverted or flat tets are left where they were many",
                       now_, before_);
  }

 private:
  Verdict attempt(const Tangle& tangle) {
    OperatorContext& context = run_.worker().context();
    Comparison& comparison = context.states.comparison;
    comparison.forget();
    Untangler untangler(make_patch(run_.mesh(), tangle));
    untangler.untangle({.looks = options_.looks}, [&](std::size_t looks) {
      const double share = static_cast<double>(looks) / static_cast<double>(options_.looks);
      run_.check_time();
      run_.report_progress("untangle", std::min(1.0, share));
      return !run_.cancelled();
    });
    if (run_.cancelled()) return Verdict::no_improvement;
    if (context.trace != nullptr) context.trace->candidate_found();
    const Moves moves(run_.mesh(), tangle, untangler.points());
    if (run_.cancelled()) return Verdict::no_improvement;
    Transaction transaction(run_.mesh(), run_.worker().workspace());
    const EditResult result = transaction.rearrange_vertices(moves.moves);
    if (result != EditResult::made) return to_verdict(result);
    if (!Judge::untangles().accepts({transaction, comparison})) return Verdict::no_improvement;
    transaction.keep();
    return Verdict::accepted;
  }

  std::size_t count_inverted(const Tangle& tangle) const {
    const auto is_inverted = [&](TetHandle t) { return run_.mesh().quality(t) <= 0; };
    return static_cast<std::size_t>(
        std::count_if(tangle.tets.begin(), tangle.tets.end(), is_inverted));
  }

  Run& run_;
  const UntangleOptions& options_;
  std::size_t before_ = 0;
  std::size_t now_ = 0;
};

}  // namespace

void untangle(Run& run, const UntangleOptions& options) {
  const std::vector<Tangle> tangles = find_tangles(run.mesh(), options.where, [&] {
    run.check_time();
    return !run.cancelled();
  });
  if (tangles.empty()) return;
  PassScope scope(run, "untangle");
  run.begin_sweep("untangle");
  Untangling untangling(run, options);
  for (const Tangle& tangle : tangles) {
    if (run.cancelled()) break;
    scope.expect(tangle.tets.size());
    untangling.work_on(tangle);
  }
  scope.take_verdicts(run.worker());
  scope.finish();
  run.note(untangling.summary());
}

}  // namespace tetmend
