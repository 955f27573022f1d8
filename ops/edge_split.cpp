// SPDX-License-Identifier: MIT
#include "ops/edge_split.h"

#include <algorithm>

#include "ops/shell_search.h"
#include "ops/smoothing.h"
#include "kernel/star.h"
#include <cstdlib>
#include <cmath>

namespace tetmend {

namespace {

class EdgeSplit final : public Operator {
 public:
  explicit EdgeSplit(const ParameterValues& values)
      : Operator(edge_split_info()),
        least_gain_(values.real("least_gain")),
        max_degree_(static_cast<unsigned>(values.integer("max_degree"))) {
    limits_.steps = values.integer("steps");
  }

 protected:
  Verdict precondition(const OperatorContext& context, Target target) const override {
    const Verdict verdict = find_searchable_shell(context.mesh, target.edge(), context.scratch.shell);
    if (verdict != Verdict::accepted) return verdict;
    return context.scratch.shell.degree <= max_degree_ ? Verdict::accepted : Verdict::not_applicable;
  }

  /// Places the vertex before it exists: the ball of the new vertex is the shell.
  Verdict evaluate(OperatorContext& context, Target) const override {
    const TetMesh& mesh = context.mesh;
    Scratch& scratch = context.scratch;
    const Shell& shell = scratch.shell;
    const Point& a = mesh.point(shell.a);
    const Point& b = mesh.point(shell.b);
    scratch.ball.clear();
    Quality floor = mesh.quality(shell.tets[0]);
    for (unsigned i = 0; i < shell.degree; ++i) {
      const Point& p = mesh.point(shell.ring[i]);
      const Point& q = mesh.point(shell.next(i));
      scratch.ball.add(a, q, p);
      scratch.ball.add(b, p, q);
      floor = std::min(floor, mesh.quality(shell.tets[i]));
    }
    scratch.point = 0.5 * (a + b);
    const double reached = scratch.ball.optimise(scratch.point, limits_);
    return reached > (neighbours_ ? 0.5 * floor : floor + least_gain_) ? Verdict::accepted : Verdict::no_improvement;
  }

  Verdict apply(OperatorContext& context, Target, Transaction& transaction) const override {
    Scratch& scratch = context.scratch;
    const Shell& shell = scratch.shell;
    const VertexHandle v = transaction.add_vertex(scratch.point);
    scratch.old_tets.assign(shell.tets.begin(), shell.tets.begin() + shell.degree);
    scratch.new_tets.clear();
    for (unsigned i = 0; i < shell.degree; ++i) {
      scratch.new_tets.push_back({shell.a, v, shell.ring[i], shell.next(i)});
      scratch.new_tets.push_back({v, shell.b, shell.ring[i], shell.next(i)});
    }
    const Verdict verdict = to_verdict(transaction.replace_cavity(scratch.old_tets, scratch.new_tets));
    if (verdict != Verdict::accepted) return verdict;
    Shell sh = shell;
    std::array<VertexHandle, 40> vs; unsigned n = 0;
    for (int rep = 0; rep < neighbours_; ++rep) {
    n=0;
    vs[n++] = sh.a; vs[n++] = sh.b; for (unsigned i = 0; i < sh.degree; ++i) vs[n++] = sh.ring[i]; vs[n++] = v;
    for (unsigned i = 0; i < n; ++i) {
      const VertexHandle w = vs[i];
      if (context.mesh.is_fixed(w)) continue;
      collect_link(context.mesh, w, context.workspace, scratch.link);
      load_ball(context.mesh, scratch.link, scratch.ball);
      const double start = scratch.ball.worst(context.mesh.point(w));
      if (start > 0.6) continue;
      Point p = context.mesh.point(w);
      if (scratch.ball.optimise(p, limits_) > start) transaction.move_vertex(w, p, scratch.link);
    }}
    transaction.compare(scratch.before, scratch.now);
    if (guard_ && !fewer(scratch)) return Verdict::no_improvement;
    return Verdict::accepted;
  }

  bool fewer(Scratch& s) const {
    if (s.before[0] < gf_) return true;
    double b = 0, n = 0; int nb = 0, nn = 0;
    for (Quality q : s.before) { b += std::pow(std::max(0.0, 0.5 - (double)q), pw_); nb += q < 0.5f; }
    for (Quality q : s.now) { n += std::pow(std::max(0.0, 0.5 - (double)q), pw_); nn += q < 0.5f; }
    return guard_ == 1 ? n < b : guard_ == 2 ? nn <= nb : nn <= nb && n < b;
  }

 private:
  double least_gain_;
  double pw_ = getenv("PW") ? atof(getenv("PW")) : 1;
  float gf_ = getenv("GF") ? atof(getenv("GF")) : 0;
  int guard_ = getenv("GU") ? atoi(getenv("GU")) : 0;
  int neighbours_ = getenv("NB") ? atoi(getenv("NB")) : 0;
  unsigned max_degree_;
  BallOptimiser::Limits limits_;
};

constexpr std::array<ParameterSpec, 3> kParameters = {{
    {"least_gain", ParameterSpec::Kind::real, 0, 1, 1e-4, "least gain of the worst quality"},
    {"max_degree", ParameterSpec::Kind::integer, 3, kMaxSearchRing, 12, "largest shell that is split"},
    {"steps", ParameterSpec::Kind::integer, 1, 1000, 8, "most directions that the placement follows"},
}};

}  // namespace

const OperatorInfo& edge_split_info() {
  static const OperatorInfo kInfo = {
      "edge_split", TargetKind::edge, "insert a vertex on an edge and smooth it", kParameters,
      [](const ParameterValues& values) -> std::unique_ptr<Operator> { return std::make_unique<EdgeSplit>(values); }};
  return kInfo;
}

}  // namespace tetmend
