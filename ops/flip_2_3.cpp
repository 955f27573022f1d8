// SPDX-License-Identifier: MIT
//        r                    r          Seen along ab. The face p q r parts the tets of its two
//       / \                  /|\         apexes a and b. Afterwards the edge ab runs through it,
//      /   \                / | \        with the three tets
//     / a,b \      ->      /  ab \         (a, b, p, q), (a, b, q, r), (a, b, r, p).
//    /       \            / /   \ \    One face gives way to three.
//   p---------q          p---------q
#include <algorithm>

#include "kernel/workspace.h"
#include "ops/builtin_operators.h"

namespace tetmend {

namespace {

/// Target: a face. Replaces its two tets by three around the edge between their apexes
/// ([chen, Fig. 1a]). Refuses boundary and constrained faces.
class Flip23 final : public OperatorOf<Replacement> {
 public:
  explicit Flip23(const ParameterValues&) : OperatorOf(flip_2_3_info()) {}

 protected:
  Verdict precondition(const OperatorContext& context, Target target, Replacement&) const override {
    return context.mesh.is_free(target.face()) ? Verdict::accepted : Verdict::constrained;
  }
  Verdict evaluate(OperatorContext& context, Target target,
                   Replacement& replacement) const override {
    const TetMesh& mesh = context.mesh;
    const HalfFace face = target.face();
    const HalfFace twin = mesh.twin(face);
    const VertexHandle a = mesh.vertices(face.tet())[face.face()];
    const VertexHandle b = mesh.vertices(twin.tet())[twin.face()];
    if (!context.workspace.holds(b)) return Verdict::deferred;
    const Quality worst = std::min(mesh.quality(face.tet()), mesh.quality(twin.tet()));
    const double floor = std::max(context.judge->floor(worst), 0.0);
    const auto ring = mesh.vertices(face);
    replacement.old_tets.assign({face.tet(), twin.tet()});
    replacement.new_tets.clear();
    for (unsigned i = 0; i < 3; ++i) {
      const TetVertices tet = {a, b, ring[i], ring[(i + 1) % 3]};
      if (mesh.evaluate(tet) <= floor) return Verdict::no_improvement;
      replacement.new_tets.push_back(tet);
    }
    return Verdict::accepted;
  }
  Verdict apply(OperatorContext&, Target, Transaction& transaction,
                Replacement& replacement) const override {
    return replacement.make(transaction);
  }
};

}  // namespace

const OperatorInfo& flip_2_3_info() {
  static constexpr OperatorInfo kInfo =
      describe<Flip23>("flip_2_3", TargetKind::face, "replace the two tets of a face by three");
  return kInfo;
}

}  // namespace tetmend
