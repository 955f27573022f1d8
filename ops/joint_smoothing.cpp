// SPDX-License-Identifier: MIT
#include <algorithm>

#include "kernel/index_set.h"
#include "kernel/star.h"
#include "kernel/workspace.h"
#include "ops/builtin_operators.h"
#include "search/patch_optimiser.h"

namespace tetmend {

namespace {

struct JointSmoothingState {
  PatchOptimiser patch;
  std::vector<VertexMove> moves;
  std::vector<VertexHandle> free;
  std::vector<HalfFace> link;
  std::vector<HalfFace> links;  // of the free vertices, one after the other
  IndexSet set;
};

/// With a goal, the tet may rise above what the others keep, which are good enough then. Without,
/// a gain of a desperate tet is worth any number of bad ones.
Judge judge_for(const ParameterValues& values) {
  const auto goal = static_cast<Quality>(values.real("goal"));
  if (goal > 0) return Judge::reaches(goal);
  return Judge::fair({.desperate = values.real("desperate"), .price = 0});
}

/// Target: a tet. Moves its free vertices together to where the tets around them lack less
/// (PatchOptimiser). This is for tets that no vertex can improve alone. Refuses as `constrained` a
/// tet without a free vertex. Refuses as `not_applicable` a tet around which all is good, or with
/// too many tets around it.
class JointSmoothing final : public OperatorOf<JointSmoothingState> {
 public:
  explicit JointSmoothing(const ParameterValues& values)
      : OperatorOf(joint_smoothing_info(), judge_for(values)),
        rings_(values.integer("rings")),
        goal_(values.real("goal")),
        least_gain_(values.real("least_gain")) {
    limits_.steps = values.integer("steps");
  }

 protected:
  using State = JointSmoothingState;

  Verdict precondition(const OperatorContext& context, Target target, State&) const override {
    const TetMesh& mesh = context.mesh;
    const TetVertices& corners = mesh.vertices(target.tet());
    const bool all_fixed = std::all_of(corners.begin(), corners.end(),
                                       [&](VertexHandle v) { return mesh.is_fixed(v); });
    return all_fixed ? Verdict::constrained : Verdict::accepted;
  }

  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    std::size_t number = 0;
    const Verdict verdict = load_patch(context, target.tet(), number, state);
    if (verdict != Verdict::accepted) return verdict;
    PatchOptimiser& patch = state.patch;
    if (goal_ > 0) return lift(context.mesh, target.tet(), number, patch);
    const double start = patch.worst();
    if (start >= kBadThreshold) return Verdict::not_applicable;
    const double deficit_limit = context.judge->deficit_limit(start, patch.total_deficit());
    const double reached = patch.optimise(limits_);
    if (!(reached > context.judge->floor(start, least_gain_))) return Verdict::no_improvement;
    return patch.total_deficit() < deficit_limit ? Verdict::accepted : Verdict::no_improvement;
  }

  Verdict apply(OperatorContext&, Target, Transaction& transaction, State& state) const override {
    for (std::size_t v = 0; v < state.moves.size(); ++v) {
      state.moves[v].point = state.patch.point(v);
    }
    return to_verdict(transaction.move_vertices(state.moves));
  }

 private:
  /// Others may get worse for the tet, but none bad.
  Verdict lift(const TetMesh& mesh, TetHandle t, std::size_t number, PatchOptimiser& patch) const {
    constexpr PatchOptimiser::Limits kPatient = {.steps = 200, .least_gain = 2e-6};
    if (mesh.quality(t) >= goal_) return Verdict::not_applicable;
    const bool reached = patch.lift(number, goal_, kBadThreshold, kPatient);
    return reached ? Verdict::accepted : Verdict::no_improvement;
  }

  /// Puts the free vertices and their links into the moves, and the tets around them into the
  /// patch, where t has the given number then.
  Verdict load_patch(OperatorContext& context, TetHandle t, std::size_t& number,
                     State& state) const {
    const TetMesh& mesh = context.mesh;
    auto& free = state.free;
    free.clear();
    state.set.clear();
    state.patch.clear(mesh.standard());
    const auto take = [&](VertexHandle v) {
      if (mesh.is_fixed(v) || !state.set.insert(v.index())) return;
      free.push_back(v);
      state.patch.add_vertex(mesh.point(v));
    };
    for (const VertexHandle v : mesh.vertices(t)) take(v);
    std::size_t first = 0;
    for (int ring = 0; ring < rings_; ++ring) {
      const std::size_t last = free.size();
      for (; first < last; ++first) {
        const VertexHandle v = free[first];
        const StarKind kind = find_star(mesh, v, context.workspace, state.link);
        if (kind != StarKind::whole) return to_verdict(kind);
        for (const HalfFace f : state.link) {
          for (const VertexHandle w : mesh.vertices(f)) take(w);
        }
      }
    }
    return load_tets(context, t, number, state);
  }

  static Verdict load_tets(OperatorContext& context, TetHandle t, std::size_t& t_number,
                           State& state) {
    const TetMesh& mesh = context.mesh;
    const auto& free = state.free;
    const auto number = [&](VertexHandle v) {
      if (mesh.is_fixed(v)) return PatchOptimiser::kFixed;
      const auto at = std::find(free.begin(), free.end(), v);
      return at == free.end() ? PatchOptimiser::kFixed : static_cast<int>(at - free.begin());
    };
    state.links.clear();
    state.moves.clear();
    state.set.clear();
    for (const VertexHandle v : free) {
      const StarKind kind = find_star(mesh, v, context.workspace, state.link);
      if (kind != StarKind::whole) return to_verdict(kind);
      state.links.insert(state.links.end(), state.link.begin(), state.link.end());
      state.moves.push_back({v, mesh.point(v), {}});
      for (const HalfFace f : state.link) {
        if (!state.set.insert(f.tet().index())) continue;
        if (state.patch.tet_count() == kMaxStar) return Verdict::not_applicable;
        if (f.tet() == t) t_number = state.patch.tet_count();
        const TetVertices& tv = mesh.vertices(f.tet());
        state.patch.add_tet(
            {mesh.point(tv[0]), mesh.point(tv[1]), mesh.point(tv[2]), mesh.point(tv[3])},
            {number(tv[0]), number(tv[1]), number(tv[2]), number(tv[3])});
      }
    }
    // The links have their place now. Each ends where the next vertex has its first.
    auto begin = state.links.begin();
    for (VertexMove& move : state.moves) {
      const auto end = std::find_if(begin, state.links.end(), [&](HalfFace f) {
        return mesh.vertices(f.tet())[f.face()] != move.vertex;
      });
      move.link = {begin, end};
      begin = end;
    }
    return Verdict::accepted;
  }

  int rings_;
  double goal_;
  double least_gain_;
  PatchOptimiser::Limits limits_;
};

constexpr std::array<ParameterSpec, 5> kJointSmoothingParameters = {{
    {"rings", ParameterSpec::Kind::integer, 0, 1, 0, "1: the vertices next to them move as well"},
    {"desperate", ParameterSpec::Kind::real, -1, 2, kDesperate,
     "below this worst quality, new bad tets are no reason to refuse"},
    {"goal", ParameterSpec::Kind::real, 0, 2, 0,
     "if not 0: the tet is to become as good as this; others may get worse, but not bad"},
    {"least_gain", ParameterSpec::Kind::real, kQualityTolerance, 1, 2e-3,
     "least gain of the worst quality around the vertices"},
    {"steps", ParameterSpec::Kind::integer, 1, 1000, 20,
     "most directions that the optimisation follows for each norm"},
}};

}  // namespace

const OperatorInfo& joint_smoothing_info() {
  static constexpr OperatorInfo kInfo = describe<JointSmoothing>(
      "joint_smoothing", TargetKind::tet, "move all free vertices of a tet together",
      kJointSmoothingParameters);
  return kInfo;
}

}  // namespace tetmend
