// SPDX-License-Identifier: MIT
// An example of a plugin: moves a vertex towards where the ball would be an optimal Delaunay
// triangulation (ODT), the volume-weighted mean of the circumcentres around it
// ([alliez_variational]).
//
// Where `smoothing` asks for the best worst tet, ODT asks for a good shape of the whole ball. The
// judge of every operator decides all the same: a move stays only if the worst tet gains.
#include <algorithm>
#include <array>
#include <limits>
#include <memory>

// All that a plugin needs: operators, their registry, the mesh and the walks on it.
#include <tetmend/plugin.h>

namespace {

using namespace tetmend;

// Forward: the class and its description refer to each other.
const OperatorInfo& odt_smoothing_info();

// What a stage leaves for the next. It belongs to the thread and is kept from attempt to attempt, so
// that its vector grows once and not each time.
struct State {
  std::vector<HalfFace> link;
  Point point = Point::Zero();
};

class OdtSmoothing final : public OperatorOf<State> {
 public:
  // An instance is shared by all threads: it holds parameters, nothing that an attempt changes.
  explicit OdtSmoothing(const ParameterValues& values)
      : OperatorOf(odt_smoothing_info()),
        halvings_(values.integer("halvings")),
        least_gain_(values.real("least_gain")) {}

 protected:
  // Stage 1, cheap: is there anything to do here at all? Fixed vertices are the boundary and the
  // constraints; the kernel would refuse to move them, but asking first is quicker.
  Verdict precondition(const OperatorContext& context, Target target, State&) const override {
    const VertexHandle v = target.vertex();
    if (context.mesh.is_deleted(v) || !context.mesh.tet_of(v).is_valid()) {
      return Verdict::not_applicable;
    }
    return context.mesh.is_fixed(v) ? Verdict::constrained : Verdict::accepted;
  }

  // Stage 2: decide, without touching the mesh. The proposal goes to the state.
  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    const TetMesh& mesh = context.mesh;
    const Point start = mesh.point(target.vertex());
    // The walk stops at the border of the part of the mesh that this thread may touch. Then another
    // thread's work would be in the way: try again later.
    const StarKind kind = find_star(mesh, target.vertex(), context.workspace, state.link);
    if (kind != StarKind::whole) return to_verdict(kind);
    // What the judge will ask for, and the gain that this operator asks for itself.
    const double worst = worst_in_ball(mesh, state.link, start);
    const double least = context.judge->floor(worst, least_gain_);
    const Point way = way_to_optimum(mesh, state.link, start);
    double share = 1;
    for (int i = 0; i <= halvings_; ++i, share /= 2) {
      state.point = start + share * way;
      if (worst_in_ball(mesh, state.link, state.point) > least) {
        return Verdict::accepted;
      }
    }
    return Verdict::no_improvement;
  }

  // Stage 3: edit, through the transaction only. It checks that no tet turns over; attempt(), which
  // calls the stages, asks a judge whether the mesh got better, and undoes everything if it did not.
  Verdict apply(OperatorContext&, Target target, Transaction& transaction,
                State& state) const override {
    return to_verdict(transaction.move_vertex(target.vertex(), state.point, state.link));
  }

 private:
  /// Smallest quality of the ball, its vertex at p. A half-face lists its vertices
  /// counterclockwise as seen from outside, so (p, a, b, c) is positive for a p inside.
  static double worst_in_ball(const TetMesh& mesh, std::span<const HalfFace> link, const Point& p) {
    double worst = std::numeric_limits<double>::infinity();
    for (const HalfFace f : link) {
      const auto corners = mesh.vertices(f);
      worst =
          std::min(worst, mesh.standard().quality(p, mesh.point(corners[0]), mesh.point(corners[1]),
                                                  mesh.point(corners[2])));
    }
    return worst;
  }

  /// From p to the mean of the circumcentres, weighted by volume. The circumcentre of a tet lies at
  /// p + (|u|^2 v x w + |v|^2 w x u + |w|^2 u x v) / (12 V). Weighted by V, it needs no division by
  /// the volume of a single tet, which may be 0.
  static Point way_to_optimum(const TetMesh& mesh, std::span<const HalfFace> link, const Point& p) {
    Point sum = Point::Zero();
    double volume = 0;
    for (const HalfFace f : link) {
      const auto corners = mesh.vertices(f);
      const Point u = mesh.point(corners[0]) - p;
      const Point v = mesh.point(corners[1]) - p;
      const Point w = mesh.point(corners[2]) - p;
      sum += u.squaredNorm() * v.cross(w) + v.squaredNorm() * w.cross(u) +
             w.squaredNorm() * u.cross(v);
      volume += u.dot(v.cross(w)) / 6;
    }
    return volume > 0 ? Point(sum / (12 * volume)) : Point(Point::Zero());
  }

  int halvings_;
  double least_gain_;
};

// name, kind, low, high, default, help. Checked before the operator is made, and tried at both ends
// of its range by `tetmend check-plugin`.
constexpr std::array<ParameterSpec, 2> kParameters = {{
    {"halvings", ParameterSpec::Kind::integer, 0, 20, 3,
     "how often the way is halved if going all of it does not help"},
    {"least_gain", ParameterSpec::Kind::real, kQualityTolerance, 1, 2e-3,
     "least gain of the worst quality of the ball"},
}};

const OperatorInfo& odt_smoothing_info() {
  static constexpr OperatorInfo kInfo = describe<OdtSmoothing>(
      "odt_smoothing", TargetKind::vertex,
      "move a vertex towards the volume-weighted mean of the circumcentres around it", kParameters);
  return kInfo;
}

}  // namespace

TETMEND_PLUGIN(registry) {
  registry.add(odt_smoothing_info());
}
