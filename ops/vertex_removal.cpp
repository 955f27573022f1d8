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

class VertexRemoval final : public Operator {
 public:
  explicit VertexRemoval(const ParameterValues& values)
      : Operator(vertex_removal_info()),
        max_nodes_(static_cast<unsigned>(values.integer("max_nodes"))),
        desperate_(static_cast<Quality>(values.real("desperate"))) {}

 protected:
  Verdict precondition(const OperatorContext& context, Target target) const override {
    const VertexHandle v = target.vertex();
    // What fills a ball that overlaps itself need not be a mesh.
    if (context.mesh.is_deleted(v) || !context.mesh.tet_of(v).is_valid() ||
        context.workspace.mesh_may_overlap()) {
      return Verdict::not_applicable;
    }
    return context.mesh.is_fixed(v) ? Verdict::constrained : Verdict::accepted;
  }

  Verdict evaluate(OperatorContext& context, Target target) const override {
    const TetMesh& mesh = context.mesh;
    Scratch& scratch = context.scratch;
    if (!collect_link(mesh, target.vertex(), context.workspace, scratch.link)) {
      return Verdict::deferred;
    }
    if (!scratch.polyhedron.start_at_ball(mesh, scratch.link)) return Verdict::not_applicable;
    scratch.polyhedron_search.clear();
    for (const VertexHandle v : scratch.polyhedron.vertices()) {
      scratch.polyhedron_search.add(mesh.point(v));
    }
    PolyhedronProblem problem = better_filling(mesh, scratch.polyhedron, desperate_);
    problem.max_nodes = max_nodes_;
    return refill(context, problem);
  }

  Verdict apply(OperatorContext& context, Target, Transaction& transaction) const override {
    return to_verdict(
        transaction.replace_cavity(context.scratch.old_tets, context.scratch.new_tets));
  }

 private:
  unsigned max_nodes_;
  Quality desperate_;
};

constexpr std::array<ParameterSpec, 2> kParameters = {{
    {"max_nodes", ParameterSpec::Kind::integer, 1, 100000, 500,
     "most tets that the search places on its way"},
    {"desperate", ParameterSpec::Kind::real, -1, 1, kDesperate,
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
