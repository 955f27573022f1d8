// SPDX-License-Identifier: MIT
//   evaluate: grow to the full size, only to know that nobody else is in the way; start again
//   apply:    search, replace, smooth; after a refusal, grow and try again
#include <algorithm>

#include "kernel/workspace.h"
#include "ops/builtin_operators.h"
#include "ops/refilling.h"
#include "ops/vertex_ball.h"

namespace tetmend {

namespace {

/// Corners of the target in the numbers of the polyhedron that starts with it.
constexpr PointMask kTarget = 15;

Point mean(const TetMesh& mesh, std::span<const VertexHandle> vertices) {
  Point sum = Point::Zero();
  for (const VertexHandle v : vertices) sum += mesh.point(v);
  return sum / static_cast<double>(vertices.size());
}

struct ReconnectionState {
  RefillingState refilling;
  BallState ball;
};

/// Target: a tet. Grows a polyhedron around it, vertex by vertex, and searches its best
/// tetrahedralisation until one is better ([liu_spr]; the growing cavity is that of
/// [marot_quality]). By itself it keeps all vertices where they are. With `relax` it takes any
/// tetrahedralisation without the target, and smooths the vertices of the polyhedron before the
/// change is judged. With `insert` there is one vertex more, and the search finds the best cavity
/// for it. With `remove`, vertices inside may vanish.
///
/// A change is kept if the quality vector is better, there are no more bad tets, and they lack no
/// more in sum. The last two do not count when the old worst tet is desperate and gains 0.002 for
/// each new bad one. Refuses as `no_improvement` when no size brings that, as `budget_spent` when
/// the search of the largest was cut short, as `not_applicable` where tets overlap. Cost: a search
/// for each size, see PolyhedronSearch, and with `relax` the smoothing of its vertices.
class PolyhedronReconnection final : public OperatorOf<ReconnectionState> {
 public:
  explicit PolyhedronReconnection(const ParameterValues& values)
      : OperatorOf(polyhedron_reconnection_info(),
                   Judge::fair({.desperate = values.real("desperate"), .more_bad = false})),
        insert_(values.flag("insert")),
        remove_(values.flag("remove")),
        relax_(values.flag("relax")),
        rounds_(values.integer("rounds")),
        min_vertices_(static_cast<std::size_t>(values.integer("min_vertices"))),
        max_vertices_(static_cast<std::size_t>(values.integer("max_vertices") - insert_)),
        step_(values.integer("step")),
        max_nodes_(static_cast<unsigned>(values.integer("max_nodes"))) {}

 protected:
  using State = ReconnectionState;

  Verdict precondition(const OperatorContext& context, Target target, State&) const override {
    return context.mesh.is_frozen(target.tet()) ? Verdict::constrained : Verdict::accepted;
  }

  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    auto& [polyhedron, search, replacement] = state.refilling;
    polyhedron.start(context.mesh, target.tet());
    while (grow(context, state)) {
    }
    if (context.workspace.met_border()) return Verdict::deferred;
    polyhedron.start(context.mesh, target.tet());
    while (polyhedron.vertices().size() < min_vertices_ && grow(context, state)) {
    }
    search.clear(context.mesh.standard());
    return Verdict::accepted;
  }

  /// Fills the polyhedron as it is now.
  Verdict apply(OperatorContext& context, Target, Transaction& transaction,
                State& state) const override {
    const TetMesh& mesh = context.mesh;
    auto& [polyhedron, search, replacement] = state.refilling;
    VertexHandle added;
    if (insert_) {
      added = transaction.add_vertex(mean(mesh, polyhedron.vertices()));
      if (!added.is_valid()) return Verdict::deferred;
    }
    load_points(mesh, added, state.refilling);
    if (context.workspace.mesh_may_overlap() && !polyhedron.is_embedded(mesh, search.table())) {
      return Verdict::not_applicable;
    }
    Verdict verdict = refill(make_problem(context, polyhedron), state.refilling, added);
    if (verdict != Verdict::accepted) return verdict;
    verdict = replacement.make(transaction);
    if (verdict == Verdict::accepted && relax_) smooth(context, transaction, added, state);
    return verdict;
  }

  bool propose_next(OperatorContext& context, Target, State& state) const override {
    int grown = 0;
    while (grown < step_ && grow(context, state)) ++grown;
    return grown > 0;
  }

 private:
  bool grow(OperatorContext& context, State& state) const {
    return state.refilling.polyhedron.grow(context.mesh, context.workspace, max_vertices_);
  }

  /// A vertex to be added has the number after those of the polyhedron, so with it the table is
  /// built again for each size.
  void load_points(const TetMesh& mesh, VertexHandle added, RefillingState& state) const {
    const auto vertices = state.polyhedron.vertices();
    PolyhedronSearch& search = state.search;
    if (insert_) search.clear(mesh.standard());
    while (search.size() < vertices.size()) search.add(mesh.point(vertices[search.size()]));
    if (insert_) search.add(mesh.point(added));
  }

  PolyhedronProblem make_problem(const OperatorContext& context,
                                 const Polyhedron& polyhedron) const {
    const TetMesh& mesh = context.mesh;
    // What smoothing can make good of is limited.
    constexpr Quality kRelaxedShare = 0.5;
    PolyhedronProblem problem = better_filling(mesh, polyhedron, *context.judge);
    problem.max_nodes = max_nodes_;
    const auto vertices = polyhedron.vertices();
    for (unsigned n = 0; n < vertices.size(); ++n) {
      const PointMask bit = PointMask{1} << n;
      if (!remove_ || mesh.is_fixed(vertices[n])) problem.kept |= polyhedron.inside() & bit;
    }
    if (insert_) problem.kept |= PointMask{1} << vertices.size();
    if (relax_) {
      problem.floor *= kRelaxedShare;
      problem.deficit_limit = std::numeric_limits<double>::infinity();
      problem.banned = kTarget;
    }
    return problem;
  }

  void smooth(OperatorContext& context, Transaction& transaction, VertexHandle added,
              State& state) const {
    for (int round = 0; round < rounds_; ++round) {
      if (added.is_valid()) climb(context, transaction, added, limits_, state.ball);
      for (const VertexHandle v : state.refilling.polyhedron.vertices()) {
        if (!context.mesh.is_deleted(v)) climb(context, transaction, v, limits_, state.ball);
      }
    }
  }

  bool insert_;
  bool remove_;
  bool relax_;
  int rounds_;
  std::size_t min_vertices_;
  std::size_t max_vertices_;
  int step_;
  unsigned max_nodes_;
  BallOptimiser::Limits limits_;
};

constexpr std::array<ParameterSpec, 9> kReconnectionParameters = {{
    {"insert", ParameterSpec::Kind::flag, 0, 1, 0,
     "with a new vertex, at the mean of those of the polyhedron"},
    {"remove", ParameterSpec::Kind::flag, 0, 1, 0, "vertices inside the polyhedron may vanish"},
    {"relax", ParameterSpec::Kind::flag, 0, 1, 0,
     "fill it without the target, as well as can be, and smooth before judging"},
    {"rounds", ParameterSpec::Kind::integer, 1, 100, 3,
     "rounds of smoothing over the vertices of the polyhedron"},
    {"min_vertices", ParameterSpec::Kind::integer, 5, SideTable::kMaxPoints, 7,
     "vertices of the smallest polyhedron that is searched"},
    {"max_vertices", ParameterSpec::Kind::integer, 5, SideTable::kMaxPoints, 20,
     "most vertices of the polyhedron, the new one included"},
    {"step", ParameterSpec::Kind::integer, 1, SideTable::kMaxPoints, 1,
     "vertices by which it grows between two searches"},
    {"max_nodes", ParameterSpec::Kind::integer, 1, 100000, 100,
     "most tets that each search places on its way"},
    {"desperate", ParameterSpec::Kind::real, -1, 2, kDesperate,
     "below this worst quality, a gain of 0.002 pays for one more bad tet"},
}};

}  // namespace

const OperatorInfo& polyhedron_reconnection_info() {
  static constexpr OperatorInfo kInfo = describe<PolyhedronReconnection>(
      "polyhedron_reconnection", TargetKind::tet,
      "replace a small polyhedron around a tet by its best tetrahedralisation",
      kReconnectionParameters);
  return kInfo;
}

}  // namespace tetmend
