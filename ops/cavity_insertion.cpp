// SPDX-License-Identifier: MIT
//          2               Sites for the vertex: the centroids of the tet, its faces and its edges;
//         / \              in the plane, these four.
//        *   *
//       /  *  \              at each site: cavity -> best place in it -> cavity there -> ...
//      /       \             at the most promising places: fill the cavity with the tets between
//     0----*----1              the vertex and its outer faces -> relax -> take the first that is
//                              worth it
//
//   surface    a----*----b       At a surface that may change: the centroids of its faces, and the
//               \\   |   /        middles of their edges inside the patch. The vertex stays in the
//                \\  *  /         plane of the face, and the cavity takes in the surface.
//    inside       \\ | /
//                  c
#include <algorithm>
#include <array>

#include "kernel/workspace.h"
#include "ops/builtin_operators.h"
#include "ops/cavity.h"
#include "ops/relaxation.h"

namespace tetmend {

namespace {

/// A place for the vertex; at the surface with the face that it lies on.
struct Site {
  Point point;
  Point normal = Point::Zero();
  std::uint32_t patch = SurfaceGuard::kNone;
};

struct Choice {
  Site site;
  double worst;
};

struct InsertionState {
  std::vector<Site> sites;
  std::vector<Choice> choices;  // the best first
  std::size_t next = 0;         // choice to be tried
  VertexCavity cavity;
  BallOptimiser ball;
  LabelledReplacement replacement;
  RelaxationState relaxation;
};

/// Target: a tet. Replaces it by tets at a new vertex, together with those tets around it whose
/// removal makes the worst new tet best ([klingner_shewchuk]; see VertexCavity). Places for the
/// vertex are the centroids of the tet, its faces and its edges. At each, the vertex moves to the
/// best place in its cavity, and the cavity is chosen again. The `tries` most promising places are
/// tried one after the other until one is worth it. With `relax`, the tets around are smoothed and
/// reconnected before that is judged (see relaxation.h). The rule is that of edge_split with an
/// `exponent` of its own for what bad tets lack. With 4, as there, places are given up that need
/// mild bad tets on the way. Without the rule, or with a larger `desperate`, more and more such
/// tets appear. At the surface the places lie on the faces of the tet that may change; the vertex
/// moves in their plane, and the cavity takes in faces of that patch, with the tets of both sides.
///
/// DEVIATION: the source tries one place for a vertex; stubborn tets need others.
///
/// Refuses as `no_improvement` also when all cavities promise less than half of the quality of the
/// target. Refuses as `constrained` when a cavity would swallow a fixed vertex or a constrained
/// edge.
/// Cost: the growth of some 30 cavities and the smoothing of one vertex in each, and a relaxation
/// for each try.
template <Where At>
class CavityInsertion final : public OperatorOf<InsertionState> {
 public:
  explicit CavityInsertion(const ParameterValues& values)
      : OperatorOf(kInside ? cavity_insertion_info() : surface_insertion_info(),
                   Judge::fair({.exponent = values.real("exponent"),
                                .desperate = values.real("desperate")})),
        tries_(static_cast<std::size_t>(values.integer("tries"))),
        relax_(values.flag("relax")) {
    growth_.max_tets = static_cast<std::size_t>(values.integer("max_tets"));
    limits_.steps = values.integer("steps");
  }

 protected:
  using State = InsertionState;

  Verdict precondition(const OperatorContext& context, Target target, State& state) const override {
    const TetMesh& mesh = context.mesh;
    if (kInside && has_no_room(context)) return Verdict::no_improvement;
    if (mesh.is_frozen(target.tet())) return Verdict::constrained;
    if (kInside) return Verdict::accepted;
    if (mesh.surface_guard() == nullptr) return Verdict::constrained;
    list_sites_on_surface(mesh, target.tet(), state.sites);
    return state.sites.empty() ? Verdict::constrained : Verdict::accepted;
  }

  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    VertexCavity& cavity = state.cavity;
    auto& choices = state.choices;
    choices.clear();
    state.next = 0;
    if (kInside) list_sites(context.mesh, target.tet(), state.sites);
    const double least = least_promise(context, target);
    for (const Site& site : state.sites) {
      // Smoothing of the one vertex gains that factor at most, as a rule.
      constexpr double kBeforeSmoothing = 0.4;
      begin(target, kBeforeSmoothing * least, site, cavity);
      Verdict verdict = cavity.offer(context.mesh, context.workspace, site.point);
      constexpr int kTurns = 2;
      for (int turn = 0; turn < kTurns && verdict == Verdict::accepted; ++turn) {
        verdict = settle(context, site, state);
      }
      if (verdict == Verdict::deferred) return verdict;
      if (cavity.worst() > least) {
        choices.push_back({{cavity.point(), site.normal, site.patch}, cavity.worst()});
      }
    }
    std::sort(choices.begin(), choices.end(),
              [](const auto& a, const auto& b) { return a.worst > b.worst; });
    if (kInside) {  // different sites may have led to the same place
      const auto is_same = [](const auto& a, const auto& b) { return a.worst - b.worst < 2e-3; };
      choices.erase(std::unique(choices.begin(), choices.end(), is_same), choices.end());
    }
    if (choices.size() > tries_) choices.resize(tries_);
    return choices.empty() ? Verdict::no_improvement : Verdict::accepted;
  }

  Verdict apply(OperatorContext& context, Target target, Transaction& transaction,
                State& state) const override {
    const Site& site = state.choices[state.next].site;
    begin(target, 0, site, state.cavity);
    const Verdict verdict = state.cavity.offer(context.mesh, context.workspace, site.point);
    return verdict == Verdict::accepted ? insert(context, transaction, state) : verdict;
  }

  bool propose_next(OperatorContext&, Target, State& state) const override {
    return ++state.next < state.choices.size();
  }

 private:
  static constexpr bool kInside = At == Where::inside;

  /// The centroids of the tet, its faces and its edges.
  static void list_sites(const TetMesh& mesh, TetHandle t, std::vector<Site>& sites) {
    const TetVertices& tet = mesh.vertices(t);
    std::array<Point, 4> p;
    for (unsigned i = 0; i < 4; ++i) p[i] = mesh.point(tet[i]);
    const Point sum = p[0] + p[1] + p[2] + p[3];
    sites.clear();
    sites.push_back({sum / 4});
    for (unsigned f = 0; f < 4; ++f) sites.push_back({(sum - p[f]) / 3});
    for (const auto& [i, j] : kEdgeVertices) sites.push_back({(p[i] + p[j]) / 2});
  }

  /// The centroids of its faces on patches, and of their edges inside the patch.
  static void list_sites_on_surface(const TetMesh& mesh, TetHandle t, std::vector<Site>& sites) {
    const SurfaceGuard& guard = *mesh.surface_guard();
    sites.clear();
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      if (mesh.is_free(face)) continue;
      const auto v = mesh.vertices(face);
      const std::uint32_t patch = guard.patch(v);
      if (patch == SurfaceGuard::kNone) continue;
      std::array<Point, 3> p;
      for (unsigned i = 0; i < 3; ++i) p[i] = mesh.point(v[i]);
      const Point normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
      if (!normal.allFinite()) continue;
      sites.push_back({(p[0] + p[1] + p[2]) / 3, normal, patch});
      for (unsigned i = 0; i < 3; ++i) {
        const unsigned j = (i + 1) % 3;
        if (!guard.is_feature(v[i], v[j])) sites.push_back({(p[i] + p[j]) / 2, normal, patch});
      }
    }
  }

  void begin(Target target, double least, const Site& site, VertexCavity& cavity) const {
    VertexCavity::Limits growth = growth_;
    growth.patch = site.patch;
    cavity.begin(target.tet(), least, growth);
  }

  /// The worst new tet must promise to become better than the target.
  double least_promise(const OperatorContext& context, Target target) const {
    constexpr double kBeforeRelaxation = kInside ? 0.75 : 0.5;
    const Quality quality = context.mesh.quality(target.tet());
    const double floor = relax_ ? kBeforeRelaxation * quality : quality;
    return std::max(0.0, std::min(floor, context.judge->floor(quality)));
  }

  /// Moves the vertex to the best place in its cavity, and looks for a better cavity there.
  Verdict settle(OperatorContext& context, const Site& site, State& state) const {
    VertexCavity& cavity = state.cavity;
    load_ball(context.mesh, cavity.faces(), state.ball);
    Point point = cavity.point();
    const OnLineOrPlane plane(site.point, site.normal, false);
    if (!kInside) state.ball.restrict_to(plane);
    const double worst = state.ball.optimise(point, limits_);
    cavity.move(point, worst);
    return cavity.offer(context.mesh, context.workspace, point);
  }

  /// Makes the cavity and the vertex real.
  Verdict insert(OperatorContext& context, Transaction& transaction, State& state) const {
    const TetMesh& mesh = context.mesh;
    const VertexCavity& cavity = state.cavity;
    if (kInside && context.workspace.mesh_may_overlap() && !is_sphere(mesh, cavity.faces())) {
      return Verdict::inverted;
    }
    const VertexHandle v = transaction.add_vertex(cavity.point());
    if (!v.is_valid()) return Verdict::deferred;
    state.replacement.clear();
    state.replacement.old_tets.assign(cavity.tets().begin(), cavity.tets().end());
    for (const HalfFace f : cavity.faces()) {
      const auto [a, b, c] = mesh.vertices(f);
      state.replacement.add({v, a, b, c}, mesh.label(f.tet()));
    }
    const Verdict verdict = state.replacement.make(transaction, At);
    if (verdict != Verdict::accepted) return verdict;
    if (relax_) {
      relax(context, transaction, v, limits_, state.relaxation, At);
    } else if (!kInside) {
      climb(context, transaction, v, limits_, state.relaxation.ball, At);
    }
    return Verdict::accepted;
  }

  std::size_t tries_;
  bool relax_;
  VertexCavity::Limits growth_;
  BallOptimiser::Limits limits_;
};

constexpr std::array<ParameterSpec, 6> insertion_parameters(double most_tries, double tries) {
  return {{
      {"max_tets", ParameterSpec::Kind::integer, 1, 256, 64, "most tets that give way"},
      {"tries", ParameterSpec::Kind::integer, 1, most_tries, tries,
       "most places at which the vertex is inserted and judged, the most promising first"},
      {"relax", ParameterSpec::Kind::flag, 0, 1, 1,
       "smooth and reconnect around the new vertex before judging"},
      {"desperate", ParameterSpec::Kind::real, -1, 2, kDesperate,
       "below this worst quality, a gain of 0.002 pays for one more bad tet"},
      {"exponent", ParameterSpec::Kind::real, 1, 64, 4,
       "the sum of (1 - q)^exponent over the bad tets must fall; large: mild ones hardly count"},
      {"steps", ParameterSpec::Kind::integer, 1, 1000, 8,
       "most directions that each placement follows"},
  }};
}

constexpr auto kInsertionInside = insertion_parameters(11, 2);
constexpr auto kInsertionAtSurface = insertion_parameters(16, 4);

}  // namespace

const OperatorInfo& cavity_insertion_info() {
  static constexpr OperatorInfo kInfo = describe<CavityInsertion<Where::inside>>(
      "cavity_insertion", TargetKind::tet,
      "insert a vertex into the cavity that makes the worst new tet best", kInsertionInside);
  return kInfo;
}

const OperatorInfo& surface_insertion_info() {
  static constexpr OperatorInfo kInfo = describe<CavityInsertion<Where::at_surface>>(
      "surface_insertion", TargetKind::tet,
      "insert a vertex on a surface that may change into the cavity that makes the worst new tet "
      "best",
      kInsertionAtSurface);
  return kInfo;
}

}  // namespace tetmend
