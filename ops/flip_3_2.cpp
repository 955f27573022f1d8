// SPDX-License-Identifier: MIT
//        r                    r          Seen along the edge ab. Its three tets give way to the two
//       /|\                  / \         at the triangle of the ring,
//      / | \                /   \          (a, p, q, r), (p, q, r, b).
//     /  ab \      ->      / a,b \
//    / /   \ \            /       \
//   p---------q          p---------q
#include "ops/flip_3_2.h"

#include <algorithm>

#include "ops/shell_search.h"

namespace tetmend {

namespace {

class Flip32 final : public Operator {
 public:
  explicit Flip32(const ParameterValues&) : Operator(flip_3_2_info()) {}

 protected:
  Verdict precondition(const OperatorContext& context, Target target) const override {
    const Verdict verdict = find_searchable_shell(context, target.edge(), context.scratch.shell);
    if (verdict != Verdict::accepted) return verdict;
    return context.scratch.shell.degree == 3 ? Verdict::accepted : Verdict::not_applicable;
  }
  Verdict evaluate(OperatorContext& context, Target) const override {
    const TetMesh& mesh = context.mesh;
    Scratch& scratch = context.scratch;
    const Shell& shell = scratch.shell;
    const auto& ring = shell.ring;
    scratch.old_tets.assign(shell.tets.begin(), shell.tets.begin() + 3);
    scratch.new_tets.assign(
        {{shell.a, ring[0], ring[1], ring[2]}, {ring[0], ring[1], ring[2], shell.b}});
    Quality floor = mesh.quality(shell.tets[0]);
    for (unsigned i = 1; i < 3; ++i) floor = std::min(floor, mesh.quality(shell.tets[i]));
    for (const TetVertices& tet : scratch.new_tets) {
      const Quality quality = mesh.evaluate(tet);
      if (quality <= 0) return Verdict::inverted;
      if (quality <= floor) return Verdict::no_improvement;
    }
    return Verdict::accepted;
  }
  Verdict apply(OperatorContext& context, Target, Transaction& transaction) const override {
    return to_verdict(
        transaction.replace_cavity(context.scratch.old_tets, context.scratch.new_tets));
  }
};

}  // namespace

const OperatorInfo& flip_3_2_info() {
  static const OperatorInfo kInfo = {
      "flip_3_2",
      TargetKind::edge,
      "replace the three tets of an edge by two",
      {},
      [](const ParameterValues& values) -> std::unique_ptr<Operator> {
        return std::make_unique<Flip32>(values);
      }};
  return kInfo;
}

}  // namespace tetmend
