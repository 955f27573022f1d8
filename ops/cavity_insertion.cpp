// SPDX-License-Identifier: MIT
//          2               Sites for the vertex: the centroids of the tet, its faces and its edges;
//         / \              in the plane, these four.
//        *   *
//       /  *  \              at each site: cavity -> best place in it -> cavity there -> ...
//      /       \             at the most promising places: fill the cavity with the tets between
//     0----*----1              the vertex and its outer faces -> relax -> take the first that is
//                              worth it
#include "ops/cavity_insertion.h"

#include <algorithm>
#include <array>

#include "ops/cavity.h"
#include "ops/relaxation.h"

namespace tetmend {

namespace {

struct State {
  VertexCavity cavity;
  std::vector<VertexCavity::Place> places;  // the best first
  std::size_t next = 0;                     // place to be tried
  BallOptimiser ball;
  std::vector<TetVertices> new_tets;
  RelaxationState relaxation;
};

class CavityInsertion final : public OperatorOf<State> {
 public:
  explicit CavityInsertion(const ParameterValues& values)
      : OperatorOf(cavity_insertion_info(), Judge::fair({.exponent = values.real("exponent"),
                                                         .desperate = values.real("desperate")})),
        tries_(static_cast<std::size_t>(values.integer("tries"))),
        relax_(values.flag("relax")) {
    growth_.max_tets = static_cast<std::size_t>(values.integer("max_tets"));
    limits_.steps = values.integer("steps");
  }

 protected:
  Verdict precondition(const OperatorContext& context, Target target, State&) const override {
    if (has_no_room(context)) return Verdict::no_improvement;
    return context.mesh.is_frozen(target.tet()) ? Verdict::constrained : Verdict::accepted;
  }

  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    const TetMesh& mesh = context.mesh;
    VertexCavity& cavity = state.cavity;
    auto& places = state.places;
    places.clear();
    state.next = 0;
    const double least = least_promise(context, target);
    for (const Point& site : list_sites(mesh, mesh.vertices(target.tet()))) {
      // Smoothing of the one vertex gains that factor at most, as a rule.
      constexpr double kBeforeSmoothing = 0.4;
      cavity.begin(target.tet(), kBeforeSmoothing * least, growth_);
      Verdict verdict = cavity.offer(mesh, context.workspace, site);
      constexpr int kTurns = 2;
      for (int turn = 0; turn < kTurns && verdict == Verdict::accepted; ++turn) {
        verdict = settle(context, state);
      }
      if (verdict == Verdict::deferred) return verdict;
      if (cavity.worst() > least) places.push_back({cavity.point(), cavity.worst()});
    }
    std::sort(places.begin(), places.end(),
              [](const auto& a, const auto& b) { return a.worst > b.worst; });
    // Different sites may have led to the same place.
    const auto is_same = [](const auto& a, const auto& b) { return a.worst - b.worst < 2e-3; };
    places.erase(std::unique(places.begin(), places.end(), is_same), places.end());
    if (places.size() > tries_) places.resize(tries_);
    return places.empty() ? Verdict::no_improvement : Verdict::accepted;
  }

  Verdict apply(OperatorContext& context, Target target, Transaction& transaction,
                State& state) const override {
    VertexCavity& cavity = state.cavity;
    cavity.begin(target.tet(), 0, growth_);
    const Point& point = state.places[state.next].point;
    const Verdict verdict = cavity.offer(context.mesh, context.workspace, point);
    return verdict == Verdict::accepted ? insert(context, transaction, state) : verdict;
  }

  bool propose_next(OperatorContext&, Target, State& state) const override {
    return ++state.next < state.places.size();
  }

 private:
  using Sites = std::array<Point, 11>;

  /// The centroids of the tet, its faces and its edges.
  static Sites list_sites(const TetMesh& mesh, const TetVertices& tet) {
    std::array<Point, 4> p;
    for (unsigned i = 0; i < 4; ++i) p[i] = mesh.point(tet[i]);
    const Point sum = p[0] + p[1] + p[2] + p[3];
    Sites sites;
    std::size_t count = 0;
    sites[count++] = sum / 4;
    for (unsigned f = 0; f < 4; ++f) sites[count++] = (sum - p[f]) / 3;
    for (const auto& [i, j] : kEdgeVertices) sites[count++] = (p[i] + p[j]) / 2;
    return sites;
  }

  /// The worst new tet must promise to become better than the target.
  double least_promise(const OperatorContext& context, Target target) const {
    constexpr double kBeforeRelaxation = 0.75;
    const Quality quality = context.mesh.quality(target.tet());
    const double floor = relax_ ? kBeforeRelaxation * quality : quality;
    return std::max(0.0, std::min(floor, context.judge->floor(quality)));
  }

  /// Moves the vertex to the best place in its cavity, and looks for a better cavity there.
  Verdict settle(OperatorContext& context, State& state) const {
    VertexCavity& cavity = state.cavity;
    load_ball(context.mesh, cavity.faces(), state.ball);
    Point point = cavity.point();
    const double worst = state.ball.optimise(point, limits_);
    cavity.move(point, worst);
    return cavity.offer(context.mesh, context.workspace, point);
  }

  /// Makes the cavity and the vertex real.
  Verdict insert(OperatorContext& context, Transaction& transaction, State& state) const {
    const VertexCavity& cavity = state.cavity;
    if (context.workspace.mesh_may_overlap() && !is_sphere(context.mesh, cavity.faces())) {
      return Verdict::inverted;
    }
    const VertexHandle v = transaction.add_vertex(cavity.point());
    if (!v.is_valid()) return Verdict::deferred;
    state.new_tets.clear();
    for (const HalfFace f : cavity.faces()) {
      const auto [a, b, c] = context.mesh.vertices(f);
      state.new_tets.push_back({v, a, b, c});
    }
    const Verdict verdict = to_verdict(transaction.replace_cavity(cavity.tets(), state.new_tets));
    if (verdict != Verdict::accepted) return verdict;
    if (relax_) relax(context, transaction, v, limits_, state.relaxation);
    return Verdict::accepted;
  }

  std::size_t tries_;
  bool relax_;
  VertexCavity::Limits growth_;
  BallOptimiser::Limits limits_;
};

constexpr std::array<ParameterSpec, 6> kParameters = {{
    {"max_tets", ParameterSpec::Kind::integer, 1, 256, 64, "most tets that give way"},
    {"tries", ParameterSpec::Kind::integer, 1, 11, 2,
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

}  // namespace

const OperatorInfo& cavity_insertion_info() {
  static const OperatorInfo kInfo = {
      "cavity_insertion", TargetKind::tet,
      "insert a vertex into the cavity that makes the worst new tet best", kParameters,
      [](const ParameterValues& values) -> std::unique_ptr<Operator> {
        return std::make_unique<CavityInsertion>(values);
      }};
  return kInfo;
}

}  // namespace tetmend
