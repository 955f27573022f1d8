// SPDX-License-Identifier: MIT
//   s-------r         s-------r         s-------r     Seen along the edge ab. A diagonal of the
//   | \   / |         |    .' |         | '.    |     ring takes its place: pr, with the tets
//   |  ab   |   ->    |  .'   |    or   |   '.  |       (a, p, q, r), (p, q, r, b),
//   | /   \ |         |.'     |         |     '.|       (a, p, r, s), (p, r, s, b),
//   p-------q         p-------q         p-------q     or qs.
#include <algorithm>
#include <array>

#include "ops/builtin_operators.h"
#include "ops/shell_search.h"

namespace tetmend {

namespace {

using FourTets = std::array<TetVertices, 4>;
using FourQualities = std::array<Quality, 4>;

/// The shell around the diagonal from ring[i] to ring[i + 2].
FourTets tets_around_diagonal(const Shell& shell, unsigned i) {
  const VertexHandle p = shell.ring[i];
  const VertexHandle q = shell.ring[i + 1];
  const VertexHandle r = shell.ring[i + 2];
  const VertexHandle s = shell.ring[(i + 3) % 4];
  return {{{shell.a, p, q, r}, {p, q, r, shell.b}, {shell.a, p, r, s}, {p, r, s, shell.b}}};
}

FourQualities quality_vector(const TetMesh& mesh, const FourTets& tets) {
  FourQualities qualities{};
  for (unsigned i = 0; i < 4; ++i) qualities[i] = mesh.evaluate(tets[i]);
  std::sort(qualities.begin(), qualities.end());
  return qualities;
}

struct Flip44State {
  Shell shell;
  Replacement replacement;
};

/// Target: an edge. Replaces the four tets of its shell by four around one of the two diagonals of
/// its ring, the one with the better quality vector ([chen, Fig. 1b]). Refuses boundary and
/// constrained edges, and shells of another degree.
class Flip44 final : public OperatorOf<Flip44State> {
 public:
  explicit Flip44(const ParameterValues&) : OperatorOf(flip_4_4_info()) {}

 protected:
  Verdict precondition(const OperatorContext& context, Target target,
                       Flip44State& state) const override {
    const Verdict verdict = find_searchable_shell(context, target.edge(), state.shell);
    if (verdict != Verdict::accepted) return verdict;
    return state.shell.degree == 4 ? Verdict::accepted : Verdict::not_applicable;
  }
  Verdict evaluate(OperatorContext& context, Target, Flip44State& state) const override {
    const TetMesh& mesh = context.mesh;
    const Shell& shell = state.shell;
    FourTets best = tets_around_diagonal(shell, 0);
    FourQualities reached = quality_vector(mesh, best);
    const FourTets other = tets_around_diagonal(shell, 1);
    if (const FourQualities qualities = quality_vector(mesh, other); reached < qualities) {
      best = other;
      reached = qualities;
    }
    if (reached[0] <= 0) return Verdict::inverted;
    if (reached[0] <= context.judge->floor(worst_quality(mesh, shell)))
      return Verdict::no_improvement;
    state.replacement.old_tets.assign(shell.tets.begin(), shell.tets.begin() + 4);
    state.replacement.new_tets.assign(best.begin(), best.end());
    return Verdict::accepted;
  }
  Verdict apply(OperatorContext&, Target, Transaction& transaction,
                Flip44State& state) const override {
    return state.replacement.make(transaction);
  }
};

}  // namespace

const OperatorInfo& flip_4_4_info() {
  static constexpr OperatorInfo kInfo = describe<Flip44>(
      "flip_4_4", TargetKind::edge, "replace the four tets of an edge by four at another diagonal");
  return kInfo;
}

}  // namespace tetmend
