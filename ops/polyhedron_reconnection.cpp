// SPDX-License-Identifier: MIT
#include "ops/polyhedron_reconnection.h"

#include <algorithm>

#include "ops/refilling.h"

namespace tetmend {

namespace {

class PolyhedronReconnection final : public Operator {
 public:
  explicit PolyhedronReconnection(const ParameterValues& values)
      : Operator(polyhedron_reconnection_info()),
        min_vertices_(static_cast<std::size_t>(values.integer("min_vertices"))),
        max_vertices_(static_cast<std::size_t>(values.integer("max_vertices"))),
        limits_{static_cast<unsigned>(values.integer("max_nodes")),
                static_cast<Quality>(values.real("desperate"))} {}

 protected:
  Verdict precondition(const OperatorContext& context, Target target) const override {
    return context.mesh.is_frozen(target.tet()) ? Verdict::constrained : Verdict::accepted;
  }

  Verdict evaluate(OperatorContext& context, Target target) const override {
    const TetMesh& mesh = context.mesh;
    Scratch& scratch = context.scratch;
    Polyhedron& polyhedron = scratch.polyhedron;
    PolyhedronSearch& search = scratch.polyhedron_search;
    const bool may_overlap = context.workspace.mesh_may_overlap();
    polyhedron.start(mesh, target.tet());
    search.clear();
    while (polyhedron.vertices().size() < min_vertices_ &&
           polyhedron.grow(mesh, context.workspace, max_vertices_)) {
    }
    Verdict verdict = Verdict::no_improvement;
    do {
      for (std::size_t n = search.size(); n < polyhedron.vertices().size(); ++n) {
        search.add(mesh.point(polyhedron.vertices()[n]));
      }
      if (may_overlap && !polyhedron.is_embedded(mesh, search.table())) break;
      verdict = refill(context, polyhedron.inside(), limits_);
    } while (verdict != Verdict::accepted &&
             polyhedron.grow(mesh, context.workspace, max_vertices_));
    return verdict;
  }

  Verdict apply(OperatorContext& context, Target, Transaction& transaction) const override {
    return to_verdict(
        transaction.replace_cavity(context.scratch.old_tets, context.scratch.new_tets));
  }

 private:
  std::size_t min_vertices_;
  std::size_t max_vertices_;
  RefillLimits limits_;
};

constexpr std::array<ParameterSpec, 4> kParameters = {{
    {"min_vertices", ParameterSpec::Kind::integer, 5, SideTable::kMaxPoints, 7,
     "vertices of the smallest polyhedron that is searched"},
    {"max_vertices", ParameterSpec::Kind::integer, 5, SideTable::kMaxPoints, 20,
     "most vertices of the polyhedron"},
    {"max_nodes", ParameterSpec::Kind::integer, 1, 100000, 500,
     "most tets that each search places on its way"},
    {"desperate", ParameterSpec::Kind::real, -1, 1, kDesperate,
     "below this worst quality, new bad tets are no reason to refuse"},
}};

}  // namespace

const OperatorInfo& polyhedron_reconnection_info() {
  static const OperatorInfo kInfo = {
      "polyhedron_reconnection", TargetKind::tet,
      "replace a small polyhedron around a tet by its best tetrahedralisation", kParameters,
      [](const ParameterValues& values) -> std::unique_ptr<Operator> {
        return std::make_unique<PolyhedronReconnection>(values);
      }};
  return kInfo;
}

}  // namespace tetmend
