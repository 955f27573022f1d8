// SPDX-License-Identifier: MIT
//      q-----p              q-----p      A cavity, as a picture in the plane: the tets whose
//     / '-.   \            / \   / \     circumspheres hold v give way to those between v and the
//    /     '-. \          /   \ /   \    outer faces of the cavity.
//   r-----------o   ->   r-----v-----o
//    \     .-' /          \   / \   /      walk to the tet that holds v -> add neighbours
//     \ .-'   /            \ /   \ /       -> drop tets until v sees all outer faces
//      s-----t              s-----t
#include <algorithm>
#include <array>

#include "kernel/index_set.h"
#include "kernel/workspace.h"
#include "ops/builtin_operators.h"
#include "ops/cavity.h"
#include "ops/vertex_ball.h"
#include "search/mean_ratio_ball.h"

namespace tetmend {

namespace {

struct VertexInsertionState {
  BallState ball;  // link: the outer faces of the cavity
  MeanRatioBall mean_ball;
  IndexSet inside;
  Replacement replacement;
};

/// Positive if the point lies on the inner side of the face.
double height_over(const TetMesh& mesh, HalfFace f, const Point& point) {
  const auto [a, b, c] = mesh.vertices(f);
  return volume6(point, mesh.point(a), mesh.point(b), mesh.point(c));
}

bool sees(const TetMesh& mesh, HalfFace f, const Point& point) {
  const auto [a, b, c] = mesh.vertices(f);
  return certified_positive(point, mesh.point(a), mesh.point(b), mesh.point(c));
}

/// The lifted determinant: positive if the point lies inside the circumsphere of a positive tet.
/// Rounding may answer wrongly near the sphere, see trim_cavity().
bool is_in_circumsphere(const TetMesh& mesh, TetHandle t, const Point& point) {
  const TetVertices& v = mesh.vertices(t);
  const Point a = mesh.point(v[0]) - point;
  const Point b = mesh.point(v[1]) - point;
  const Point c = mesh.point(v[2]) - point;
  const Point d = mesh.point(v[3]) - point;
  const Point cd = c.cross(d);
  const Point ab = a.cross(b);
  return a.squaredNorm() * b.dot(cd) - b.squaredNorm() * a.dot(cd) + c.squaredNorm() * d.dot(ab) -
             d.squaredNorm() * c.dot(ab) >
         0;
}

bool is_wall(const TetMesh& mesh, HalfFace f) {
  return mesh.is_boundary(f) || mesh.is_constrained(f);
}

/// The vertex behind a face that is no wall.
VertexHandle apex_across(const TetMesh& mesh, HalfFace f) {
  const HalfFace twin = mesh.twin(f);
  return mesh.vertices(twin.tet())[twin.face()];
}

/// Walks from `start` through the faces that part it from the point, to the tet that holds it.
/// Leaves that as the only tet of the cavity.
Verdict locate_point(OperatorContext& context, TetHandle start, VertexInsertionState& state) {
  constexpr unsigned kMaxSteps = 64;
  const TetMesh& mesh = context.mesh;
  const Point& point = state.ball.point;
  TetHandle t = start;
  for (unsigned step = 0; step < kMaxSteps; ++step) {
    HalfFace way_out;
    double lowest = 0;
    for (unsigned f = 0; f < 4; ++f) {
      const double height = height_over(mesh, HalfFace(t, f), point);
      if (height >= lowest) continue;
      lowest = height;
      way_out = HalfFace(t, f);
    }
    if (lowest == 0) {
      state.replacement.old_tets.assign(1, t);
      return Verdict::accepted;
    }
    if (is_wall(mesh, way_out)) return Verdict::constrained;
    if (!context.workspace.holds(apex_across(mesh, way_out))) return Verdict::deferred;
    t = mesh.twin(way_out).tet();
  }
  return Verdict::not_applicable;
}

/// Adds the tets whose circumspheres hold the point, neighbour by neighbour.
Verdict grow_cavity(OperatorContext& context, std::size_t max_tets, VertexInsertionState& state) {
  const TetMesh& mesh = context.mesh;
  IndexSet& inside = state.inside;
  auto& cavity = state.replacement.old_tets;
  inside.clear();
  for (const TetHandle t : cavity) inside.insert(t.index());
  for (std::size_t i = 0; i < cavity.size(); ++i) {
    for (unsigned f = 0; f < 4; ++f) {
      if (cavity.size() >= max_tets) return Verdict::accepted;
      const HalfFace face(cavity[i], f);
      if (is_wall(mesh, face)) continue;
      const TetHandle next = mesh.twin(face).tet();
      if (inside.contains(next.index())) continue;
      if (!context.workspace.holds(apex_across(mesh, face))) return Verdict::deferred;
      if (!is_in_circumsphere(mesh, next, state.ball.point)) continue;
      inside.insert(next.index());
      cavity.push_back(next);
    }
  }
  return Verdict::accepted;
}

/// Removes tets from the cavity until the point sees all outer faces, and lists these. Rounding in
/// the steps before can cost quality, but never validity: here the sight is certified.
Verdict trim_cavity(const TetMesh& mesh, VertexInsertionState& state) {
  IndexSet& inside = state.inside;
  auto& cavity = state.replacement.old_tets;
  auto& link = state.ball.link;
  const TetHandle holder = cavity[0];
  const auto is_outer = [&](HalfFace f) {
    return mesh.is_boundary(f) || !inside.contains(mesh.twin(f).tet().index());
  };
  const auto must_go = [&](TetHandle t) {
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      if (is_outer(face) && !sees(mesh, face, state.ball.point)) return true;
    }
    return false;
  };
  do {
    inside.clear();
    for (const TetHandle t : cavity) inside.insert(t.index());
  } while (std::erase_if(cavity, must_go) > 0);
  if (cavity.empty() || cavity[0] != holder) return Verdict::inverted;

  link.clear();
  for (const TetHandle t : cavity) {
    for (unsigned f = 0; f < 4; ++f) {
      if (is_outer(HalfFace(t, f))) link.push_back(HalfFace(t, f));
    }
  }
  return Verdict::accepted;
}

/// The 1-4 flip, if `max_tets` is 1: it seldom improves anything, for it divides each angle of the
/// tet.
Point centroid(const TetMesh& mesh, TetHandle t) {
  Point sum = Point::Zero();
  for (const VertexHandle v : mesh.vertices(t)) sum += mesh.point(v);
  return sum / 4;
}

/// The step of Delaunay refinement. Often in another tet, and outside the mesh for flat tets at the
/// boundary: then the verdict is `constrained`.
Point circumcentre(const TetMesh& mesh, TetHandle t) {
  const auto& v = mesh.vertices(t);
  const Point& origin = mesh.point(v[0]);
  const Point a = mesh.point(v[1]) - origin;
  const Point b = mesh.point(v[2]) - origin;
  const Point c = mesh.point(v[3]) - origin;
  const Point sum =
      a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b);
  return origin + sum / (2 * a.dot(b.cross(c)));
}

/// Target: a tet. Inserts a vertex at a place for it, as in Delaunay refinement ([chen, 2.3]). It
/// replaces the tets around whose circumspheres hold the vertex, except where the vertex would not
/// see the faces behind them. The cavity crosses no constrained face and holds `max_tets` at most.
/// With `smooth`, the vertex then moves to where the worst new tet is best.
///
/// Refuses as `not_applicable` a target that is not certified positive, or whose vertex lies more
/// than 64 tets away. Refuses as `constrained` when boundary or a constrained face parts the target
/// from the vertex, or when the cavity would swallow a fixed vertex. Refuses as `no_improvement`
/// when the target would stay, or when the worst tet would be no better, or only at the price of
/// many new bad tets (as edge_split). Cost: the way to the vertex, the square of the size of the
/// cavity at worst, and the smoothing of one vertex.
/// @tparam place where the vertex goes, of a tet that is certified positive
template <const OperatorInfo& (*description)(), Point (*place)(const TetMesh&, TetHandle)>
class VertexInsertion final : public OperatorOf<VertexInsertionState> {
 public:
  explicit VertexInsertion(const ParameterValues& values)
      : OperatorOf(description(), Judge::fair({.desperate = values.real("desperate")})),
        max_tets_(static_cast<std::size_t>(values.integer("max_tets"))),
        smooth_(values.flag("smooth")) {}

 protected:
  using State = VertexInsertionState;

  Verdict precondition(const OperatorContext& context, Target target, State&) const override {
    const TetMesh& mesh = context.mesh;
    if (has_no_room(context)) return Verdict::no_improvement;
    return mesh.is_certified_positive(mesh.vertices(target.tet())) ? Verdict::accepted
                                                                   : Verdict::not_applicable;
  }

  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    const TetMesh& mesh = context.mesh;
    auto& [ball, link, point] = state.ball;
    const auto& cavity = state.replacement.old_tets;
    point = place(mesh, target.tet());
    Verdict verdict = locate_point(context, target.tet(), state);
    if (verdict == Verdict::accepted) verdict = grow_cavity(context, max_tets_, state);
    if (verdict == Verdict::accepted) verdict = trim_cavity(mesh, state);
    if (verdict != Verdict::accepted) return verdict;
    if (std::find(cavity.begin(), cavity.end(), target.tet()) == cavity.end()) {
      return Verdict::no_improvement;
    }
    const Judge& judge = *context.judge;
    if (judge.looks_at_mean() && !raises_mean(mesh, judge.usual(), state)) {
      return Verdict::no_improvement;
    }
    if (!is_sphere(mesh, link)) return Verdict::inverted;
    if (judge.looks_at_mean()) return Verdict::accepted;
    load_ball(mesh, link, ball);
    const double reached = smooth_ ? ball.optimise(point, limits_) : ball.worst(point);
    return reached > context.judge->floor(worst_quality(mesh, cavity)) ? Verdict::accepted
                                                                       : Verdict::no_improvement;
  }

  Verdict apply(OperatorContext& context, Target, Transaction& transaction,
                State& state) const override {
    const VertexHandle v = transaction.add_vertex(state.ball.point);
    if (!v.is_valid()) return Verdict::deferred;
    state.replacement.new_tets.clear();
    for (const HalfFace f : state.ball.link) {
      const auto [a, b, c] = context.mesh.vertices(f);
      state.replacement.new_tets.push_back({v, a, b, c});
    }
    return state.replacement.make(transaction);
  }

 private:
  /// Moves the vertex to where the new tets are round on average. False if their mean ratios, each less
  /// the usual one, have no larger sum than those of the cavity.
  static bool raises_mean(const TetMesh& mesh, double usual, State& state) {
    double before = 0;
    for (const TetHandle t : state.replacement.old_tets) {
      const TetVertices& v = mesh.vertices(t);
      before += mean_ratio(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])) -
                usual;
    }
    Point& point = state.ball.point;
    state.mean_ball.clear(point);
    for (const HalfFace f : state.ball.link) {
      const auto [a, b, c] = mesh.vertices(f);
      state.mean_ball.add(mesh.point(a), mesh.point(b), mesh.point(c));
    }
    const auto count = static_cast<double>(state.ball.link.size());
    constexpr double kMostGain = 0.1;  // of the mean, by moving the point: rarely more
    if (count * (state.mean_ball.mean(point) + kMostGain - usual) <= before) return false;
    constexpr int kSteps = 2;
    point = state.mean_ball.descend(point, kSteps);
    return count * (state.mean_ball.mean(point) - usual) > before;
  }

  std::size_t max_tets_;
  bool smooth_;
  BallOptimiser::Limits limits_;
};

constexpr std::array<ParameterSpec, 3> kVertexInsertionParameters = {{
    {"max_tets", ParameterSpec::Kind::integer, 1, 256, 64,
     "most tets that give way; 1: only the one that holds the vertex"},
    {"smooth", ParameterSpec::Kind::flag, 0, 1, 1, "move the vertex before judging"},
    {"desperate", ParameterSpec::Kind::real, -1, 2, kDesperate,
     "below this worst quality, a gain of 0.002 pays for one more bad tet"},
}};

}  // namespace

const OperatorInfo& centroid_insertion_info() {
  static constexpr OperatorInfo kInfo =
      describe<VertexInsertion<centroid_insertion_info, centroid>>(
          "centroid_insertion", TargetKind::tet, "insert a vertex at the centroid of a tet",
          kVertexInsertionParameters);
  return kInfo;
}

const OperatorInfo& circumcentre_insertion_info() {
  static constexpr OperatorInfo kInfo =
      describe<VertexInsertion<circumcentre_insertion_info, circumcentre>>(
          "circumcentre_insertion", TargetKind::tet, "insert a vertex at the circumcentre of a tet",
          kVertexInsertionParameters);
  return kInfo;
}

}  // namespace tetmend
