// SPDX-License-Identifier: MIT
// An operator in a territory: what it changes lies inside, what it refuses or leaves for later
// leaves no trace. Without that, threads would write over each other's work.
#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "contract/trials.h"
#include "contract/zoo.h"
#include "kernel/error.h"
#include "kernel/integrity.h"
#include "kernel/star.h"
#include "kernel/workspace.h"

namespace tetmend::contract {

namespace {

/// A worker in the part of a mesh where x is below a bound.
class Side {
 public:
  Side(const TetMesh& start, double bound) : mesh(start), workspace_(mesh) {
    workspace_.provide(mesh, 400, 40);
    blocks_.assign(mesh.vertex_slots(), 1);
    for (const VertexHandle v : live_vertices(mesh)) {
      if (mesh.point(v).x() < bound) blocks_[v.index()] = 0;
    }
    slots_ = std::exchange(workspace_.free_slots(), {});
    workspace_.enter(Territory(blocks_, 0), slots_);
  }

  bool holds(VertexHandle v) const { return blocks_[v.index()] == 0; }
  template <class Vertices>
  bool holds_all(const Vertices& vertices) const {
    return std::all_of(vertices.begin(), vertices.end(),
                       [this](VertexHandle v) { return holds(v); });
  }
  Verdict attempt(const Operator& op, Target target) { return op.attempt(context_, target); }
  bool reached_out() { return workspace_.take_reached_out(); }
  void leave() {
    workspace_.leave(slots_);
    workspace_.settle(mesh);
  }

  TetMesh mesh;

 private:
  Workspace workspace_;
  Workspace::FreeSlots slots_;
  std::vector<BlockId> blocks_;
  OperatorStates states_;
  OperatorContext context_{mesh, workspace_, states_};
};

std::vector<Target> targets_at(const TetMesh& mesh, TetHandle t, TargetKind kind) {
  std::vector<Target> targets;
  if (kind == TargetKind::tet) targets.push_back(Target::of(t));
  for (unsigned e = 0; e < 6 && kind == TargetKind::edge; ++e) {
    targets.push_back(Target::of(TetEdge(t, e)));
  }
  for (unsigned f = 0; f < 4 && kind == TargetKind::face; ++f) {
    targets.push_back(Target::of(HalfFace(t, f)));
  }
  for (unsigned i = 0; i < 4 && kind == TargetKind::vertex; ++i) {
    targets.push_back(Target::of(mesh.vertices(t)[i]));
  }
  return targets;
}

/// Nothing outside differs, but for what lies across a face of the territory.
bool is_outside_untouched(const Side& side, const TetMesh& before) {
  for (std::uint32_t i = 0; i < before.vertex_slots(); ++i) {
    const VertexHandle v(i);
    if (side.holds(v)) continue;
    if (before.is_deleted(v) != side.mesh.is_deleted(v)) return false;
    if (!before.is_deleted(v) && before.point(v) != side.mesh.point(v)) return false;
  }
  for (std::uint32_t i = 0; i < before.tet_slots(); ++i) {
    const TetHandle t(i);
    const bool was = !before.is_deleted(t);
    if (!was || side.holds_all(before.vertices(t))) {
      if (!side.mesh.is_deleted(t) && !side.holds_all(side.mesh.vertices(t))) return false;
      continue;
    }
    if (before.vertices(t) != side.mesh.vertices(t)) return false;
    if (before.quality(t) != side.mesh.quality(t)) return false;
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      if (before.twin(face) != side.mesh.twin(face) && !side.holds_all(before.vertices(face))) {
        return false;
      }
    }
  }
  return true;
}

/// The mesh with other points where x is above `bound` and no tet reaches back below it. Another
/// thread may be changing these, and nobody here may look at them.
TetMesh with_other_points_beyond(const TetMesh& start, double bound) {
  TetMesh mesh = start;
  Workspace workspace(mesh);
  for (const VertexHandle v : live_vertices(mesh)) {
    if (mesh.is_fixed(v) || !mesh.tet_of(v).is_valid()) continue;
    const auto ring = one_ring(mesh, v);
    const auto is_beyond = [&](VertexHandle w) { return !(mesh.point(w).x() < bound); };
    if (!is_beyond(v) || !std::all_of(ring.begin(), ring.end(), is_beyond)) continue;
    const Point moved = mesh.point(v) + 0.1 * (mesh.point(ring[0]) - mesh.point(v));
    if (moved.x() < bound) continue;
    Transaction transaction(mesh, workspace);
    if (transaction.move_vertex(v, moved, link(mesh, v)) == EditResult::made) {
      transaction.keep();
    }
  }
  return mesh;
}

/// The territories of both hold the same.
bool is_same_inside(const Side& a, const Side& b) {
  if (a.mesh.tet_slots() != b.mesh.tet_slots()) return false;
  for (std::uint32_t i = 0; i < a.mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (a.mesh.is_deleted(t) != b.mesh.is_deleted(t)) return false;
    if (a.mesh.is_deleted(t)) continue;
    const TetVertices& tet = a.mesh.vertices(t);
    if (!a.holds_all(tet)) continue;
    if (tet != b.mesh.vertices(t)) return false;
    for (const VertexHandle v : tet) {
      if (a.mesh.point(v) != b.mesh.point(v)) return false;
    }
  }
  return true;
}

/// At most so many tets of the territory. First those beside tets that nobody owns: what reaches out
/// does so there.
std::vector<TetHandle> choose_tets(const Side& side, std::size_t count) {
  std::vector<TetHandle> at_border;
  std::vector<TetHandle> inside;
  for (const TetHandle t : live_tets(side.mesh)) {
    if (!side.holds_all(side.mesh.vertices(t))) continue;
    const auto& faces = side.mesh.neighbours(t);
    const bool is_at_border = std::any_of(faces.begin(), faces.end(), [&](HalfFace twin) {
      return !twin.is_outside() && !side.holds_all(side.mesh.vertices(twin.tet()));
    });
    (is_at_border ? at_border : inside).push_back(t);
  }
  const auto thin_out = [](std::vector<TetHandle>& tets, std::size_t most) {
    const std::size_t all = tets.size();
    if (all <= most) return;
    for (std::size_t i = 0; i < most; ++i) tets[i] = tets[i * all / most];
    tets.resize(most);
  };
  thin_out(at_border, std::max(count / 2, count - std::min(count, inside.size())));
  thin_out(inside, count - at_border.size());
  at_border.insert(at_border.end(), inside.begin(), inside.end());
  std::sort(at_border.begin(), at_border.end());
  return at_border;
}

/// One attempt; what was wrong with it.
std::string attempt_and_judge(Side& side, const Operator& op, Target target, Outcome& outcome) {
  const TetMesh before = side.mesh;
  ++outcome.attempts;
  try {
    const Verdict verdict = side.attempt(op, target);
    if (side.reached_out()) return std::string(kReachedOut);
    if (verdict == Verdict::accepted) {
      ++outcome.accepted;
      return is_outside_untouched(side, before) ? "" : "something outside the territory changed";
    }
    if (verdict == Verdict::deferred) ++outcome.deferred;
  } catch (const Error& error) {
    return error.what();
  }
  return side.mesh == before ? "" : "the refusal left a trace";
}

}  // namespace

double bound_below(const TetMesh& mesh, double share) {
  std::vector<double> places;
  for (const VertexHandle v : live_vertices(mesh)) places.push_back(mesh.point(v).x());
  if (places.empty()) return 0;
  const auto at = std::min(places.size() - 1,
                           static_cast<std::size_t>(share * static_cast<double>(places.size())));
  const auto nth = places.begin() + static_cast<std::ptrdiff_t>(at);
  std::nth_element(places.begin(), nth, places.end());
  return *nth;
}

Outcome try_in_territory(const Operator& op, const TetMesh& start, double bound,
                         std::size_t count) {
  Outcome outcome;
  Side side(start, bound);
  Side elsewhere(with_other_points_beyond(start, bound), bound);
  Outcome unseen;
  for (const TetHandle t : choose_tets(side, count)) {
    const TetVertices at_first = side.mesh.vertices(t);
    const auto is_there = [&] {
      return !side.mesh.is_deleted(t) && side.mesh.vertices(t) == at_first;
    };
    if (!is_there() || !side.holds_all(at_first)) continue;
    for (const Target target : targets_at(side.mesh, t, op.info().target)) {
      std::string about = attempt_and_judge(side, op, target, outcome);
      attempt_and_judge(elsewhere, op, target, unseen);
      if (about.empty() &&
          (outcome.accepted != unseen.accepted || outcome.deferred != unseen.deferred)) {
        about = "the answer depends on what lies outside the territory";
      }
      if (!about.empty()) {
        outcome.complaint =
            fmt::format("in a territory, {} {}, attempt {}: {}", to_string(target.kind),
                        target.code, outcome.attempts, about);
        return outcome;
      }
      if (!is_there()) break;
    }
  }
  if (!is_same_inside(side, elsewhere)) {
    outcome.complaint = "in a territory: edits depend on what lies outside";
    return outcome;
  }
  side.leave();
  side.mesh.renew_surface();
  if (const auto findings = check_integrity(side.mesh); !findings.empty()) {
    outcome.complaint = "after work in a territory: " + to_string(findings);
  } else if (side.mesh.tet_count() != live_tets(side.mesh).size() ||
             side.mesh.vertex_count() != live_vertices(side.mesh).size()) {
    outcome.complaint = "after work in a territory: the counts of the mesh are wrong";
  }
  return outcome;
}

}  // namespace tetmend::contract
