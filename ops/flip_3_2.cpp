// SPDX-License-Identifier: MIT
//        r                    r          Seen along the edge ab. Its three tets give way to the two
//       /|\                  / \         at the triangle of the ring,
//      / | \                /   \          (a, p, q, r), (p, q, r, b).
//     /  ab \      ->      / a,b \       Only the edge is gone,
//    / /   \ \            /       \      the outer faces stay.
//   p---------q          p---------q
#include <algorithm>

#include "ops/builtin_operators.h"
#include "ops/shell_search.h"

namespace tetmend {

namespace {

struct Flip32State {
  Shell shell;
  Replacement replacement;
};

/// Target: an edge. Replaces the three tets of its shell by the two at the triangle of its ring
/// ([chen, Fig. 1a]). Refuses boundary and constrained edges, and shells of another degree.
class Flip32 final : public OperatorOf<Flip32State> {
 public:
  explicit Flip32(const ParameterValues&) : OperatorOf(flip_3_2_info()) {}

 protected:
  Verdict precondition(const OperatorContext& context, Target target,
                       Flip32State& state) const override {
    const Verdict verdict = find_searchable_shell(context, target.edge(), state.shell);
    if (verdict != Verdict::accepted) return verdict;
    return state.shell.degree == 3 ? Verdict::accepted : Verdict::not_applicable;
  }
  Verdict evaluate(OperatorContext& context, Target, Flip32State& state) const override {
    const TetMesh& mesh = context.mesh;
    const Shell& shell = state.shell;
    const auto& ring = shell.ring;
    state.replacement.old_tets.assign(shell.tets.begin(), shell.tets.begin() + 3);
    state.replacement.new_tets.assign(
        {{shell.a, ring[0], ring[1], ring[2]}, {ring[0], ring[1], ring[2], shell.b}});
    const double floor = context.judge->floor(worst_quality(mesh, shell));
    for (const TetVertices& tet : state.replacement.new_tets) {
      const Quality quality = mesh.evaluate(tet);
      if (quality <= 0) return Verdict::inverted;
      if (quality <= floor) return Verdict::no_improvement;
    }
    return Verdict::accepted;
  }
  Verdict apply(OperatorContext&, Target, Transaction& transaction,
                Flip32State& state) const override {
    return state.replacement.make(transaction);
  }
};

}  // namespace

const OperatorInfo& flip_3_2_info() {
  static constexpr OperatorInfo kInfo =
      describe<Flip32>("flip_3_2", TargetKind::edge, "replace the three tets of an edge by two");
  return kInfo;
}

}  // namespace tetmend
