// SPDX-License-Identifier: MIT
//      q-----p              q-----p      The ball of v, as a picture in the plane: it is
//     / \   / \            /|\    |\     filled with the best tets between the vertices of
//    /   \ /   \          / | \   | \    its surface.
//   r-----v-----o   ->   r  |  \  |  o
//    \   / \   /          \ |   \ | /
//     \ /   \ /            \|    \|/
//      s-----t              s-----t
#include "kernel/star.h"
#include "kernel/workspace.h"
#include "ops/builtin_operators.h"
#include "ops/refilling.h"
#include "ops/where.h"

namespace tetmend {

namespace {

struct VertexRemovalState {
  std::vector<HalfFace> link;
  RefillingState refilling;
};

/// Target: a vertex. Replaces its ball by the best tetrahedralisation between the vertices around
/// it ([chen, 2.3]). Edge contraction connects them all to one of them; this connects them in any
/// way. Refuses fixed vertices. Refuses as `not_applicable` more than 32 neighbours, and all
/// vertices of a mesh that had inverted tets. Cost: cubic in the neighbours for the tables, and the
/// search.
class VertexRemoval final : public OperatorOf<VertexRemovalState> {
 public:
  explicit VertexRemoval(const ParameterValues& values)
      // A gain of a desperate tet is worth any number of bad ones.
      : OperatorOf(
            vertex_removal_info(),
            Judge::fair({.desperate = values.real("desperate"), .price = 0, .more_bad = false})),
        max_nodes_(static_cast<unsigned>(values.integer("max_nodes"))) {}

 protected:
  Verdict precondition(const OperatorContext& context, Target target,
                       VertexRemovalState&) const override {
    // What fills a ball that overlaps itself need not be a mesh.
    if (context.workspace.mesh_may_overlap()) return Verdict::not_applicable;
    return check_vertex(context.mesh, target.vertex(), Where::inside);
  }

  Verdict evaluate(OperatorContext& context, Target target,
                   VertexRemovalState& state) const override {
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

  Verdict apply(OperatorContext&, Target, Transaction& transaction,
                VertexRemovalState& state) const override {
    return state.refilling.replacement.make(transaction);
  }

 private:
  unsigned max_nodes_;
};

constexpr std::array<ParameterSpec, 2> kVertexRemovalParameters = {{
    {"max_nodes", ParameterSpec::Kind::integer, 1, 100000, 500,
     "most tets that the search places on its way"},
    {"desperate", ParameterSpec::Kind::real, -1, 2, kDesperate,
     "below this worst quality, new bad tets are no reason to refuse"},
}};

}  // namespace

const OperatorInfo& vertex_removal_info() {
  static constexpr OperatorInfo kInfo = describe<VertexRemoval>(
      "vertex_removal", TargetKind::vertex,
      "remove a vertex: best tetrahedralisation of its ball without it", kVertexRemovalParameters);
  return kInfo;
}

}  // namespace tetmend
