// SPDX-License-Identifier: MIT
#include "ops/joint_smoothing.h"

#include <algorithm>

#include "kernel/star.h"

namespace tetmend {

namespace {

/// Vertices of enormous balls are not worth the time.
constexpr std::size_t kMaxTets = 1000;

class JointSmoothing final : public Operator {
 public:
  explicit JointSmoothing(const ParameterValues& values)
      : Operator(joint_smoothing_info()),
        rings_(values.integer("rings")),
        desperate_(values.real("desperate")),
        goal_(values.real("goal")),
        least_gain_(values.real("least_gain")) {
    limits_.steps = values.integer("steps");
  }

 protected:
  Verdict precondition(const OperatorContext& context, Target target) const override {
    const TetMesh& mesh = context.mesh;
    const TetVertices& corners = mesh.vertices(target.tet());
    const bool all_fixed = std::all_of(corners.begin(), corners.end(),
                                       [&](VertexHandle v) { return mesh.is_fixed(v); });
    return all_fixed ? Verdict::constrained : Verdict::accepted;
  }

  Verdict evaluate(OperatorContext& context, Target target) const override {
    std::size_t number = 0;
    const Verdict verdict = load_patch(context, target.tet(), number);
    if (verdict != Verdict::accepted) return verdict;
    PatchOptimiser& patch = context.scratch.patch;
    if (goal_ > 0) return lift(context, target.tet(), number);
    const double start = patch.worst();
    if (start >= kBadThreshold) return Verdict::not_applicable;
    const double start_deficit = patch.total_deficit();
    const double reached = patch.optimise(limits_);
    if (!(reached > start + least_gain_)) return Verdict::no_improvement;
    // DEVIATION: as in smoothing, a small gain of the worst tet must not be paid by many others.
    const bool worth_it = start < desperate_ || patch.total_deficit() < start_deficit;
    return worth_it ? Verdict::accepted : Verdict::no_improvement;
  }

  Verdict apply(OperatorContext& context, Target, Transaction& transaction) const override {
    Scratch& scratch = context.scratch;
    for (std::size_t v = 0; v < scratch.moves.size(); ++v) {
      scratch.moves[v].point = scratch.patch.point(v);
    }
    return to_verdict(transaction.move_vertices(scratch.moves));
  }

  /// A goal may lie above what the others keep, which are good enough then: it suffices that no bad
  /// tet is worse or new.
  bool is_improvement(const Transaction& transaction, Scratch& scratch) const override {
    const bool better = is_better(transaction, scratch);
    if (!(goal_ > 0) || better || transaction.empty()) return better;
    std::sort(scratch.before.begin(), scratch.before.end());
    std::sort(scratch.now.begin(), scratch.now.end());
    const std::ptrdiff_t bad = count_bad(scratch.before);
    return count_bad(scratch.now) <= bad &&
           std::equal(scratch.before.begin(), scratch.before.begin() + bad, scratch.now.begin(),
                      [](Quality was, Quality is) { return is > was - kQualityTolerance; });
  }

 private:
  /// Others may get worse for the tet, but none bad.
  Verdict lift(OperatorContext& context, TetHandle t, std::size_t number) const {
    constexpr PatchOptimiser::Limits kPatient = {.steps = 200, .least_gain = 1e-6};
    if (context.mesh.quality(t) >= goal_) return Verdict::not_applicable;
    const bool reached = context.scratch.patch.lift(number, goal_, kBadThreshold, kPatient);
    return reached ? Verdict::accepted : Verdict::no_improvement;
  }

  /// Puts the free vertices and their links into the moves of the scratch, and the tets around them
  /// into the patch, where t has the given number then.
  Verdict load_patch(OperatorContext& context, TetHandle t, std::size_t& number) const {
    const TetMesh& mesh = context.mesh;
    Scratch& scratch = context.scratch;
    scratch.neighbours.clear();
    scratch.set.clear();
    scratch.patch.clear();
    const auto take = [&](VertexHandle v) {
      if (mesh.is_fixed(v) || !scratch.set.insert(v.index())) return;
      scratch.neighbours.push_back(v);
      scratch.patch.add_vertex(mesh.point(v));
    };
    for (const VertexHandle v : mesh.vertices(t)) take(v);
    std::size_t first = 0;
    for (int ring = 0; ring < rings_; ++ring) {
      const std::size_t last = scratch.neighbours.size();
      for (; first < last; ++first) {
        const VertexHandle v = scratch.neighbours[first];
        if (!collect_link(mesh, v, context.workspace, scratch.link)) return Verdict::deferred;
        for (const HalfFace f : scratch.link) {
          for (const VertexHandle w : mesh.vertices(f)) take(w);
        }
      }
    }
    return load_tets(context, t, number);
  }

  static Verdict load_tets(OperatorContext& context, TetHandle t, std::size_t& t_number) {
    const TetMesh& mesh = context.mesh;
    Scratch& scratch = context.scratch;
    const auto& free = scratch.neighbours;
    const auto number = [&](VertexHandle v) {
      if (mesh.is_fixed(v)) return PatchOptimiser::kFixed;
      const auto at = std::find(free.begin(), free.end(), v);
      return at == free.end() ? PatchOptimiser::kFixed : static_cast<int>(at - free.begin());
    };
    scratch.links.clear();
    scratch.moves.clear();
    scratch.set.clear();
    for (const VertexHandle v : free) {
      if (!collect_link(mesh, v, context.workspace, scratch.link)) return Verdict::deferred;
      scratch.links.insert(scratch.links.end(), scratch.link.begin(), scratch.link.end());
      scratch.moves.push_back({v, mesh.point(v), {}});
      for (const HalfFace f : scratch.link) {
        if (!scratch.set.insert(f.tet().index())) continue;
        if (scratch.patch.tet_count() == kMaxTets) return Verdict::not_applicable;
        if (f.tet() == t) t_number = scratch.patch.tet_count();
        const TetVertices& tv = mesh.vertices(f.tet());
        scratch.patch.add_tet(
            {mesh.point(tv[0]), mesh.point(tv[1]), mesh.point(tv[2]), mesh.point(tv[3])},
            {number(tv[0]), number(tv[1]), number(tv[2]), number(tv[3])});
      }
    }
    // The links have their place now. Each ends where the next vertex has its first.
    auto begin = scratch.links.begin();
    for (VertexMove& move : scratch.moves) {
      const auto end = std::find_if(begin, scratch.links.end(), [&](HalfFace f) {
        return mesh.vertices(f.tet())[f.face()] != move.vertex;
      });
      move.link = {begin, end};
      begin = end;
    }
    return Verdict::accepted;
  }

  int rings_;
  double desperate_;
  double goal_;
  double least_gain_;
  PatchOptimiser::Limits limits_;
};

constexpr std::array<ParameterSpec, 5> kParameters = {{
    {"rings", ParameterSpec::Kind::integer, 0, 1, 0, "1: the vertices next to them move as well"},
    {"desperate", ParameterSpec::Kind::real, -1, 1, kDesperate,
     "below this worst quality, new bad tets are no reason to refuse"},
    {"goal", ParameterSpec::Kind::real, 0, 1, 0,
     "if not 0: the tet is to become as good as this; others may get worse, but not bad"},
    {"least_gain", ParameterSpec::Kind::real, kQualityTolerance, 1, 1e-3,
     "least gain of the worst quality around the vertices"},
    {"steps", ParameterSpec::Kind::integer, 1, 1000, 20,
     "most directions that the optimisation follows for each norm"},
}};

}  // namespace

const OperatorInfo& joint_smoothing_info() {
  static const OperatorInfo kInfo = {
      "joint_smoothing", TargetKind::tet, "move all free vertices of a tet together", kParameters,
      [](const ParameterValues& values) -> std::unique_ptr<Operator> {
        return std::make_unique<JointSmoothing>(values);
      }};
  return kInfo;
}

}  // namespace tetmend
