// SPDX-License-Identifier: MIT
//            a             A sandwiched face F makes a tet with a above it and one with b below.
//          / | \           Across an edge pq of F, the tets beyond (a, p, q) and (b, p, q) may
//     p --- F --- q ..w    share their fourth vertex w. Then (p, w, q) is sandwiched as well, and
//          \ | /           w enters the polygon between p and q. A vertex enters once, so the faces
//            b             stay a disc without inner vertices.
#include <algorithm>

#include "kernel/workspace.h"
#include "ops/builtin_operators.h"
#include "ops/shell_search.h"

namespace tetmend {

namespace {

/// The polygon around the sandwiched faces. Side i runs from vertex i to vertex i + 1.
struct Sandwich {
  VertexHandle a;
  VertexHandle b;
  unsigned size = 0;
  std::array<VertexHandle, kMaxSearchRing> ring;
  std::array<TetHandle, kMaxSearchRing> upper;  // tet with apex a at side i
  std::array<TetHandle, kMaxSearchRing> lower;

  void insert(unsigned side, VertexHandle w, TetHandle above, TetHandle below) {
    for (unsigned i = size; i > side + 1; --i) {
      ring[i] = ring[i - 1];
      upper[i] = upper[i - 1];
      lower[i] = lower[i - 1];
    }
    ring[side + 1] = w;
    upper[side] = upper[side + 1] = above;
    lower[side] = lower[side + 1] = below;
    ++size;
  }
};

/// The tet beyond the face (apex, p, q) of t, unless boundary, constraint or border is in the way.
TetHandle beyond(const OperatorContext& context, TetHandle t, VertexHandle apex, VertexHandle p,
                 VertexHandle q) {
  const TetMesh& mesh = context.mesh;
  const TetVertices& tv = mesh.vertices(t);
  unsigned f = 0;
  while (tv[f] == apex || tv[f] == p || tv[f] == q) ++f;
  const HalfFace face(t, f);
  if (!mesh.is_free(face)) return {};
  const HalfFace twin = mesh.twin(face);
  if (!context.workspace.holds(mesh.vertices(twin.tet())[twin.face()])) return {};
  return twin.tet();
}

VertexHandle fourth(const TetMesh& mesh, TetHandle t, VertexHandle x, VertexHandle y,
                    VertexHandle z) {
  for (const VertexHandle v : mesh.vertices(t)) {
    if (v != x && v != y && v != z) return v;
  }
  return {};
}

struct FaceRemovalState {
  CoveringSearch search;
  Replacement replacement;
};

/// Target: a face. It and the faces connected to it that both apexes a and b of its two tets see
/// form a polygon. Their tets are replaced by the best covering of the virtual shell of ab: with a
/// core (ab appears) or without (re-triangulation) ([chen, 5.4]; [shewchuk_two]). Refuses boundary
/// and constrained faces. Cost: O(m^3) for m polygon vertices.
class MultiFaceRemoval final : public OperatorOf<FaceRemovalState> {
 public:
  explicit MultiFaceRemoval(const ParameterValues& values)
      : OperatorOf(multi_face_removal_info()),
        max_polygon_(static_cast<unsigned>(values.integer("max_polygon"))) {}

 protected:
  Verdict precondition(const OperatorContext& context, Target target,
                       FaceRemovalState&) const override {
    return context.mesh.is_free(target.face()) ? Verdict::accepted : Verdict::constrained;
  }

  Verdict evaluate(OperatorContext& context, Target target,
                   FaceRemovalState& state) const override {
    const TetMesh& mesh = context.mesh;
    auto& [old_tets, new_tets] = state.replacement;
    const HalfFace twin = mesh.twin(target.face());
    if (!context.workspace.holds(mesh.vertices(twin.tet())[twin.face()])) return Verdict::deferred;
    const Sandwich sandwich = grow(context, target.face(), old_tets);
    if (context.judge->looks_at_mean()) {
      list_fan(sandwich, new_tets);
      if (!may_raise_mean(mesh, *context.judge, state.replacement)) return Verdict::no_improvement;
    }

    std::array<Point, kMaxSearchRing> ring;
    for (unsigned i = 0; i < sandwich.size; ++i) ring[i] = mesh.point(sandwich.ring[i]);
    CoveringProblem problem;
    problem.standard = mesh.standard();
    problem.a = mesh.point(sandwich.a);
    problem.b = mesh.point(sandwich.b);
    problem.ring = {ring.data(), sandwich.size};
    problem.floor = static_cast<Quality>(context.judge->floor(worst_quality(mesh, old_tets)));
    Covering covering;
    if (!state.search.run(problem, covering)) return Verdict::no_improvement;
    list_new_tets(
        covering, sandwich.a, sandwich.b, sandwich.ring, [](unsigned, unsigned) { return false; },
        new_tets);
    return Verdict::accepted;
  }

  Verdict apply(OperatorContext&, Target, Transaction& transaction,
                FaceRemovalState& state) const override {
    return state.replacement.make(transaction);
  }

 private:
  /// The tets around the new edge ab if all faces go.
  static void list_fan(const Sandwich& s, std::vector<TetVertices>& tets) {
    tets.clear();
    for (unsigned i = 0; i < s.size; ++i) {
      tets.push_back({s.a, s.b, s.ring[i], s.ring[i + 1 == s.size ? 0 : i + 1]});
    }
  }

  /// Lists the tets of the sandwich.
  Sandwich grow(const OperatorContext& context, HalfFace face, std::vector<TetHandle>& tets) const {
    const TetMesh& mesh = context.mesh;
    const HalfFace twin = mesh.twin(face);
    Sandwich s;
    s.a = mesh.vertices(face.tet())[face.face()];
    s.b = mesh.vertices(twin.tet())[twin.face()];
    // Counterclockwise seen from b's side: (a, ring[0], ring[1], ring[2]) is positive.
    const auto corners = mesh.vertices(face);
    s.size = 3;
    for (unsigned i = 0; i < 3; ++i) {
      s.ring[i] = corners[i];
      s.upper[i] = face.tet();
      s.lower[i] = twin.tet();
    }
    tets.assign({face.tet(), twin.tet()});
    for (unsigned i = 0; i < s.size && s.size < max_polygon_;) {
      const VertexHandle p = s.ring[i];
      const VertexHandle q = s.ring[i + 1 == s.size ? 0 : i + 1];
      const TetHandle above = beyond(context, s.upper[i], s.a, p, q);
      const TetHandle below = beyond(context, s.lower[i], s.b, p, q);
      const VertexHandle w = above.is_valid() ? fourth(mesh, above, s.a, p, q) : VertexHandle();
      const auto end = s.ring.begin() + s.size;
      const bool grows = above.is_valid() && below.is_valid() && above != below &&
                         fourth(mesh, below, s.b, p, q) == w && w != s.b &&
                         std::find(s.ring.begin(), end, w) == end;
      if (!grows) {
        ++i;
        continue;
      }
      s.insert(i, w, above, below);
      tets.push_back(above);
      tets.push_back(below);
    }
    return s;
  }

  unsigned max_polygon_;
};

constexpr std::array<ParameterSpec, 1> kFaceRemovalParameters = {{
    {"max_polygon", ParameterSpec::Kind::integer, 3, kMaxSearchRing, 8,
     "most vertices of the polygon of sandwiched faces"},
}};

}  // namespace

const OperatorInfo& multi_face_removal_info() {
  static constexpr OperatorInfo kInfo = describe<MultiFaceRemoval>(
      "multi_face_removal", TargetKind::face, "remove the faces sandwiched between two vertices",
      kFaceRemovalParameters);
  return kInfo;
}

}  // namespace tetmend
