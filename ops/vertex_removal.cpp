// SPDX-License-Identifier: MIT
//      q-----p              q-----p      The ball of v, as a picture in the plane: it is
//     / \   / \            /|\    |\     filled with the best tets between the vertices of
//    /   \ /   \          / | \   | \    its surface.
//   r-----v-----o   ->   r  |  \  |  o
//    \   / \   /          \ |   \ | /
//     \ /   \ /            \|    \|/
//      s-----t              s-----t
#include "ops/vertex_removal.h"

#include "kernel/star.h"
#include "ops/refilling.h"

namespace tetmend {

namespace {

struct State {
  std::vector<HalfFace> link;
  RefillingState refilling;
};

class VertexRemoval final : public OperatorOf<State> {
 public:
  explicit VertexRemoval(const ParameterValues& values)
      // A gain of a desperate tet is worth any number of bad ones.
      : OperatorOf(
            vertex_removal_info(),
            Judge::fair({.desperate = values.real("desperate"), .price = 0, .more_bad = false})),
        max_nodes_(static_cast<unsigned>(values.integer("max_nodes"))) {}

 protected:
  Verdict precondition(const OperatorContext& context, Target target, State&) const override {
    const VertexHandle v = target.vertex();
    // What fills a ball that overlaps itself need not be a mesh.
    if (context.mesh.is_deleted(v) || !context.mesh.tet_of(v).is_valid() ||
        context.workspace.mesh_may_overlap()) {
      return Verdict::not_applicable;
    }
    return context.mesh.is_fixed(v) ? Verdict::constrained : Verdict::accepted;
  }

  Verdict evaluate(OperatorContext& context, Target target, State& state) const override {
    const TetMesh& mesh = context.mesh;
    auto& [polyhedron, search, replacement] = state.refilling;
    const StarKind kind = find_star(mesh, target.vertex(), context.workspace, state.link);
    if (kind != StarKind::whole) return to_verdict(kind);
    if (!polyhedron.start_at_ball(mesh, state.link)) return Verdict::not_applicable;
    search.clear(mesh.standard());
    for (const VertexHandle v : polyhedron.vertices()) search.add(mesh.point(v));
    PolyhedronProblem problem = better_filling(mesh, polyhedron, *context.judge);
    problem.max_nodes = max_nodes_;
    return refill(problem, state.refilling);
  }

  Verdict apply(OperatorContext&, Target, Transaction& transaction, State& state) const override {
    return state.refilling.replacement.make(transaction);
  }

 private:
  unsigned max_nodes_;
};

constexpr std::array<ParameterSpec, 2> kParameters = {{
    {"max_nodes", ParameterSpec::Kind::integer, 1, 100000, 500,
     "most tets that the search places on its way"},
    {"desperate", ParameterSpec::Kind::real, -1, 2, kDesperate,
     "below this worst quality, new bad tets are no reason to refuse"},
}};

}  // namespace

const OperatorInfo& vertex_removal_info() {
  static const OperatorInfo kInfo = {
      "vertex_removal", TargetKind::vertex,
      "remove a vertex: best tetrahedralisation of its ball without it", kParameters,
      [](const ParameterValues& values) -> std::unique_ptr<Operator> {
        return std::make_unique<VertexRemoval>(values);
      }};
  return kInfo;
}

}  // namespace tetmend
