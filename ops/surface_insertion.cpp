// SPDX-License-Identifier: MIT
//   surface    a----*----b       Places for the vertex on a face of the surface: its centroid, and the
//               \\   |   /         middles of its edges inside the patch.
//                \\  *  /
//    inside       \\ | /         at each: cavity -> best place in the plane of the face -> cavity there
//                  c             at the most promising: fill the cavity, surface included -> relax
#include "ops/surface_insertion.h"

#include <algorithm>
#include <array>

#include "ops/cavity.h"
#include "ops/relaxation.h"
#include "ops/surface_replacement.h"
#include "ops/surface_vertex.h"

namespace tetmend {

namespace {

/// Until the vertex exists: the plane of a face.
class InPlane final : public PlaceRestriction {
 public:
  InPlane(const Point& origin, const Point& normal) : origin_(origin), normal_(normal) {}
  void turn_along(const Point&, std::span<Point> vectors) const override {
    for (Point& vector : vectors) vector = along(vector);
  }
  Point nearest(const Point& p) const override { return origin_ + along(p - origin_); }

 private:
  Point along(const Point& vector) const { return vector - normal_.dot(vector) * normal_; }

  Point origin_, normal_;
};

/// A place, and the face that it lies on.
struct Site {
  Point point;
  Point normal;
  std::uint32_t patch;
};

struct Choice {
  Site site;
  double worst;
};

struct State {
  std::vector<Site> sites;
  std::vector<Choice> choices;  // the best first
  std::size_t next = 0;         // choice to be tried
  VertexCavity cavity;
  BallOptimiser ball;
  SurfaceReplacement replacement;
  RelaxationState relaxation;
};

class SurfaceInsertion final : public OperatorOf<State> {
 public:
  explicit SurfaceInsertion(const ParameterValues& values)
      : OperatorOf(surface_insertion_info(), Judge::fair({.exponent = values.real("exponent"),
                                                          .desperate = values.real("desperate")})),
        tries_(static_cast<std::size_t>(values.integer("tries"))),
        relax_(values.flag("relax")) {
    growth_.max_tets = static_cast<std::size_t>(values.integer("max_tets"));
    limits_.steps = values.integer("steps");
  }

 protected:
  Verdict precondition(const OperatorContext& context, Target target, State& state) const override {
    const TetMesh& mesh = context.mesh;
    if (mesh.surface_guard() == nullptr || mesh.is_frozen(target.tet())) {
      return Verdict::constrained;
    }
    list_sites(mesh, target.tet(), state.sites);
    return state.sites.empty() ? Verdict::constrained : Verdict::accepted;
  }

  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    state.choices.clear();
    state.next = 0;
    const double least = least_promise(context, target);
    for (const Site& site : state.sites) {
      constexpr double kBeforeSmoothing = 0.4;
      begin(target, kBeforeSmoothing * least, site, state.cavity);
      Verdict verdict = state.cavity.offer(context.mesh, context.workspace, site.point);
      constexpr int kTurns = 2;
      for (int turn = 0; turn < kTurns && verdict == Verdict::accepted; ++turn) {
        verdict = settle(context, site, state);
      }
      if (verdict == Verdict::deferred) return verdict;
      if (state.cavity.worst() > least) {
        state.choices.push_back(
            {{state.cavity.point(), site.normal, site.patch}, state.cavity.worst()});
      }
    }
    std::sort(state.choices.begin(), state.choices.end(),
              [](const auto& a, const auto& b) { return a.worst > b.worst; });
    if (state.choices.size() > tries_) state.choices.resize(tries_);
    return state.choices.empty() ? Verdict::no_improvement : Verdict::accepted;
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
  static void list_sites(const TetMesh& mesh, TetHandle t, std::vector<Site>& sites) {
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
    constexpr double kBeforeRelaxation = 0.5;
    const Quality quality = context.mesh.quality(target.tet());
    const double floor = relax_ ? kBeforeRelaxation * quality : quality;
    return std::max(0.0, std::min(floor, context.judge->floor(quality)));
  }

  Verdict settle(OperatorContext& context, const Site& site, State& state) const {
    load_ball(context.mesh, state.cavity.faces(), state.ball);
    Point point = state.cavity.point();
    const InPlane plane(site.point, site.normal);
    state.ball.restrict_to(plane);
    const double worst = state.ball.optimise(point, limits_);
    state.cavity.move(point, worst);
    return state.cavity.offer(context.mesh, context.workspace, point);
  }

  Verdict insert(OperatorContext& context, Transaction& transaction, State& state) const {
    const VertexCavity& cavity = state.cavity;
    const VertexHandle v = transaction.add_vertex(cavity.point());
    if (!v.is_valid()) return Verdict::deferred;
    state.replacement.clear();
    state.replacement.old_tets.assign(cavity.tets().begin(), cavity.tets().end());
    for (const HalfFace f : cavity.faces()) {
      const auto [a, b, c] = context.mesh.vertices(f);
      state.replacement.add({v, a, b, c}, context.mesh.label(f.tet()));
    }
    const Verdict verdict = state.replacement.make(transaction);
    if (verdict != Verdict::accepted) return verdict;
    if (relax_) {
      relax(context, transaction, v, limits_, state.relaxation, true);
    } else {
      climb_at_surface(context, transaction, v, limits_, state.relaxation.ball);
    }
    return Verdict::accepted;
  }

  std::size_t tries_;
  bool relax_;
  VertexCavity::Limits growth_;
  BallOptimiser::Limits limits_;
};

constexpr std::array<ParameterSpec, 6> kParameters = {{
    {"max_tets", ParameterSpec::Kind::integer, 1, 256, 64, "most tets that give way"},
    {"tries", ParameterSpec::Kind::integer, 1, 16, 4,
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

const OperatorInfo& surface_insertion_info() {
  static const OperatorInfo kInfo = {
      "surface_insertion", TargetKind::tet,
      "insert a vertex on a surface that may change into the cavity that makes the worst new tet "
      "best",
      kParameters, [](const ParameterValues& values) -> std::unique_ptr<Operator> {
        return std::make_unique<SurfaceInsertion>(values);
      }};
  return kInfo;
}

}  // namespace tetmend
