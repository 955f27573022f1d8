// SPDX-License-Identifier: MIT
// Edits that change the boundary, or the faces between labels, where the guard of the surface
// allows it.
//
//   replace_at_surface: check old tets, vertices -> evaluate new tets -> pair faces; what is left
//                       over is the surface before and after -> ask the guard -> as replace_cavity
//   The guard is asked when nothing but memory can stop the edit any more.
//
// That old and new tets are glued to the same tets makes the surfaces before and after have the
// same border: both close the same gap.
#include <algorithm>
#include <cassert>

#include "kernel/in_order.h"
#include "kernel/make_room.h"
#include "kernel/territory_check.h"
#include "kernel/transaction.h"
#include "kernel/workspace.h"

namespace tetmend {

namespace {

bool has_edge(std::span<const SurfaceFace> faces, const std::array<VertexHandle, 2>& edge) {
  return std::any_of(faces.begin(), faces.end(), [&](const SurfaceFace& face) {
    const auto& v = face.vertices;
    return std::find(v.begin(), v.end(), edge[0]) != v.end() &&
           std::find(v.begin(), v.end(), edge[1]) != v.end();
  });
}

bool has_edge(std::span<const TetVertices> tets, const std::array<VertexHandle, 2>& edge) {
  return std::any_of(tets.begin(), tets.end(), [&](const TetVertices& v) {
    return std::find(v.begin(), v.end(), edge[0]) != v.end() &&
           std::find(v.begin(), v.end(), edge[1]) != v.end();
  });
}

}  // namespace

/// About the faces before and after.
bool Transaction::ask_guard() {
  SurfaceGuard& guard = *mesh_.surface_guard();
  auto& journal = workspace_.surface_journal_;
  if (!journal) journal = guard.make_journal();
  journal->territory = workspace_.territory_;
  journal->met_border = false;
  if (guard.replace(workspace_.faces_before_, workspace_.faces_after_, *journal)) return true;
  if (journal->met_border) workspace_.note_border();
  return false;
}

/// May move on the surface, or vanish from it.
bool Transaction::may_change(VertexHandle v) const {
  if (mesh_.is_frozen(v) || mesh_.is_required(v)) return false;
  const SurfacePlace place = mesh_.surface_guard()->place(v);
  return place == SurfacePlace::smooth || place == SurfacePlace::ridge;
}

SurfaceFace Transaction::surface_face(HalfFace f) const {
  const auto v = mesh_.vertices(f);
  return {v, {mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2])}};
}

EditResult Transaction::replace_at_surface(std::span<const TetHandle> old,
                                           std::span<const TetVertices> created,
                                           std::span<const Label> labels) {
  assert(!kept_ && !old.empty() && !created.empty() && labels.size() == created.size());
  SurfaceGuard* const guard = mesh_.surface_guard();
  if (guard == nullptr || workspace_.may_overlap_) return EditResult::constrained;
  for (const EditResult result :
       {check_old_at_surface(old), check_vertices_at_surface(old, created), evaluate(created)}) {
    if (result != EditResult::made) return result;
  }
  workspace_.faces_before_.clear();
  workspace_.faces_after_.clear();
  workspace_.is_interface_.clear();
  EditResult result = pair_new_faces(created, labels);
  if (result == EditResult::made) result = pair_old_faces(old, labels);
  if (result != EditResult::made) return result;
  add_outer_faces(created);
  drop_unchanged_faces();
  if (!workspace_.has_room_for(created.size(), old.size())) return EditResult::no_room;
  result = check_edges_at_surface(created);
  if (result != EditResult::made) return result;

  Edit edit;
  edit.kind = Edit::Kind::replace_cavity;
  edit.surface = !workspace_.faces_before_.empty() || !workspace_.faces_after_.empty();
  if (edit.surface && !ask_guard()) return EditResult::constrained;
  try {
    mark_surface(created);
    edit.appended = make_room(old.size(), created.size());
  } catch (...) {
    if (edit.surface) guard->undo(*workspace_.surface_journal_);
    throw;
  }
  write_cavity(old, created, labels, edit);
  return EditResult::made;
}

/// As check_old(), but faces between labels may lie inside.
EditResult Transaction::check_old_at_surface(std::span<const TetHandle> old) {
  if (!holds_all(mesh_, old, workspace_)) return EditResult::no_room;
  workspace_.cavity_set_.clear();
  workspace_.constrained_edges_.clear();
  for (const TetHandle t : old) workspace_.cavity_set_.insert(t.index());
  for (const TetHandle t : old) {
    if (!mesh_.has_constraints(t)) continue;
    if (mesh_.is_frozen(t)) return EditResult::constrained;
    for (unsigned e = 0; e < 6; ++e) {
      if (!mesh_.is_constrained(TetEdge(t, e))) continue;
      const auto edge = in_order(mesh_.vertices(TetEdge(t, e)));
      auto& known = workspace_.constrained_edges_;
      if (std::find(known.begin(), known.end(), edge) == known.end()) known.push_back(edge);
    }
  }
  return EditResult::made;
}

/// As check_vertices(), but vertices of the surface may vanish.
EditResult Transaction::check_vertices_at_surface(std::span<const TetHandle> old,
                                                  std::span<const TetVertices> created) {
  IndexSet& set = workspace_.vertex_set_;
  set.clear();
  for (const TetVertices& tet : created) {
    for (const VertexHandle v : tet) set.insert(v.index());
  }
  for (const TetHandle t : old) {
    for (const VertexHandle v : mesh_.vertices(t)) {
      if (!set.contains(v.index()) && mesh_.is_fixed(v) && !may_change(v)) {
        return EditResult::constrained;
      }
    }
  }
  set.clear();
  for (const TetHandle t : old) {
    for (const VertexHandle v : mesh_.vertices(t)) set.insert(v.index());
  }
  for (const TetVertices& tet : created) {
    for (const VertexHandle v : tet) {
      if (!set.insert(v.index())) continue;
      if (!holds_new(v, workspace_)) return EditResult::no_room;
      if (mesh_.tet_of(v).is_valid()) return EditResult::not_closed;
    }
  }
  return EditResult::made;
}

/// Face `number` of the new tets is one of the surface.
void Transaction::add_new_face(std::uint32_t number, std::span<const TetVertices> created,
                               bool interface) {
  const TetVertices& tet = created[number / 4];
  const auto& local = kFaceVertices[number % 4];
  const std::array<VertexHandle, 3> v = {tet[local[0]], tet[local[1]], tet[local[2]]};
  workspace_.faces_after_.push_back({v, {mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2])}});
  workspace_.is_interface_.push_back(interface ? 1 : 0);
}

/// With each other; between labels they are faces of the surface, seen from the larger label.
EditResult Transaction::pair_new_faces(std::span<const TetVertices> created,
                                       std::span<const Label> labels) {
  FaceTable& table = workspace_.face_table_;
  auto& gluing = workspace_.gluing_;
  table.clear();
  gluing.assign(4 * created.size(), {});
  bool even = false;
  for (std::uint32_t i = 0; i < 4 * created.size(); ++i) {
    const TetVertices& tet = created[i / 4];
    const auto& local = kFaceVertices[i % 4];
    const auto [entry, is_new] =
        table.find_or_insert({tet[local[0]], tet[local[1]], tet[local[2]]}, even);
    if (is_new) {
      entry->value = i;
      continue;
    }
    if (entry->paired || entry->even == even) return EditResult::not_closed;
    entry->paired = true;
    const std::uint32_t k = entry->value;
    const bool interface = labels[i / 4] != labels[k / 4];
    gluing[i] = {HalfFace::from_code(k), true, interface};
    gluing[k] = {HalfFace::from_code(i), true, interface};
    if (interface) add_new_face(labels[i / 4] < labels[k / 4] ? i : k, created, true);
  }
  return EditResult::made;
}

EditResult Transaction::pair_old_faces(std::span<const TetHandle> old,
                                       std::span<const Label> labels) {
  for (const TetHandle t : old) {
    for (unsigned f = 0; f < 4; ++f) {
      const EditResult result = pair_old_face(HalfFace(t, f), labels);
      if (result != EditResult::made) return result;
    }
  }
  return EditResult::made;
}

EditResult Transaction::pair_old_face(HalfFace f, std::span<const Label> labels) {
  const HalfFace twin = mesh_.twin(f);
  const Label label = mesh_.label(f.tet());
  if (!twin.is_outside() && workspace_.cavity_set_.contains(twin.tet().index())) {
    if (!mesh_.is_constrained(f)) return EditResult::made;
    const Label other = mesh_.label(twin.tet());
    if (label == other) return EditResult::constrained;  // the file names it
    if (label < other) workspace_.faces_before_.push_back(surface_face(f));
    return EditResult::made;
  }
  bool even = false;
  const auto [entry, is_new] = workspace_.face_table_.find_or_insert(mesh_.vertices(f), even);
  if (is_new && twin.is_outside()) {
    entry->paired = true;  // no new tet has it: it goes
    workspace_.faces_before_.push_back(surface_face(f));
    return EditResult::made;
  }
  if (is_new || entry->paired || entry->even != even) return EditResult::not_closed;
  if (labels[entry->value / 4] != label) return EditResult::constrained;
  entry->paired = true;
  workspace_.gluing_[entry->value] = {twin, false, mesh_.is_constrained(f)};
  return EditResult::made;
}

/// What is glued to nothing lies on the boundary.
void Transaction::add_outer_faces(std::span<const TetVertices> created) {
  workspace_.outer_faces_.clear();
  for (std::uint32_t i = 0; i < 4 * created.size(); ++i) {
    const Workspace::Gluing& glued = workspace_.gluing_[i];
    if (glued.local || glued.twin != HalfFace()) continue;
    workspace_.outer_faces_.push_back(i);
    add_new_face(i, created, false);
  }
}

/// Faces between labels that are there before and after.
void Transaction::drop_unchanged_faces() {
  auto& before = workspace_.faces_before_;
  auto& after = workspace_.faces_after_;
  for (std::size_t i = 0; i < after.size();) {
    const auto key = in_order(after[i].vertices);
    const auto same = std::find_if(before.begin(), before.end(), [&](const SurfaceFace& face) {
      return in_order(face.vertices) == key;
    });
    if (workspace_.is_interface_[i] == 0 || same == before.end()) {
      ++i;
      continue;
    }
    before.erase(same);
    after.erase(after.begin() + static_cast<std::ptrdiff_t>(i));
    workspace_.is_interface_.erase(workspace_.is_interface_.begin() +
                                   static_cast<std::ptrdiff_t>(i));
  }
}

/// A constrained edge may vanish only where the guard is asked about it: on the surface. Leaves
/// those that stay.
EditResult Transaction::check_edges_at_surface(std::span<const TetVertices> created) {
  auto& edges = workspace_.constrained_edges_;
  for (std::size_t i = 0; i < edges.size();) {
    if (has_edge(created, edges[i])) {
      ++i;
      continue;
    }
    if (!has_edge(workspace_.faces_before_, edges[i])) return EditResult::constrained;
    edges.erase(edges.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return EditResult::made;
}

/// What the new faces and their edges are marked with, by what the guard now says of them.
void Transaction::mark_surface(std::span<const TetVertices> created) {
  const SurfaceGuard& guard = *mesh_.surface_guard();
  for (const std::uint32_t i : workspace_.outer_faces_) {
    const auto& local = kFaceVertices[i % 4];
    const TetVertices& tet = created[i / 4];
    const std::uint32_t patch = guard.patch({tet[local[0]], tet[local[1]], tet[local[2]]});
    workspace_.gluing_[i].twin = HalfFace::outside(mesh_.patch_triangle_[patch]);
  }
  auto& edges = workspace_.constrained_edges_;
  for (const SurfaceFace& face : workspace_.faces_after_) {
    for (unsigned k = 0; k < 3; ++k) {
      const std::array<VertexHandle, 2> edge =
          in_order(std::array{face.vertices[k], face.vertices[(k + 1) % 3]});
      const std::uint32_t line = guard.line(edge[0], edge[1]);
      const bool is_named =
          line < mesh_.line_edge_.size() && mesh_.line_edge_[line] != SurfaceGuard::kNone;
      if (is_named && std::find(edges.begin(), edges.end(), edge) == edges.end()) {
        edges.push_back(edge);
      }
    }
  }
  mark_constrained_edges(created);
  list_new_flags();
}

/// Vertices that are new on the surface are fixed like those that were there.
void Transaction::list_new_flags() {
  auto& list = workspace_.new_flags_;
  list.clear();
  const auto add = [&](VertexHandle v, TetMesh::VertexFlags flag) {
    const auto at = std::find_if(list.begin(), list.end(), [v](const Journal::VertexFlags& entry) {
      return entry.vertex == v;
    });
    const TetMesh::VertexFlags now = at != list.end() ? at->flags : mesh_.vertex_flags_[v.index()];
    const auto flags = static_cast<TetMesh::VertexFlags>(now | flag);
    if (flags == now) return;
    if (at != list.end()) {
      at->flags = flags;
    } else {
      list.push_back({v, flags});
    }
  };
  for (std::size_t i = 0; i < workspace_.faces_after_.size(); ++i) {
    for (const VertexHandle v : workspace_.faces_after_[i].vertices) {
      add(v, workspace_.is_interface_[i] != 0 ? TetMesh::kVertexConstrained
                                              : TetMesh::kVertexBoundary);
    }
  }
  for (const auto& edge : workspace_.constrained_edges_) {
    for (const VertexHandle v : edge) add(v, TetMesh::kVertexConstrained);
  }
}

// --- moves ---------------------------------------------------------------------------------------

EditResult Transaction::move_at_surface(std::span<const VertexMove> moves) {
  assert(!kept_);
  if (!holds_all(mesh_, moves, workspace_)) return EditResult::no_room;
  SurfaceGuard* const guard = mesh_.surface_guard();
  for (const VertexMove& move : moves) {
    if (!mesh_.is_fixed(move.vertex)) continue;
    if (guard == nullptr || !may_change(move.vertex)) return EditResult::constrained;
  }
  if (!list_faces_of(moves, workspace_.faces_before_)) return EditResult::constrained;
  const bool surface = !workspace_.faces_before_.empty();
  if (surface && workspace_.may_overlap_) return EditResult::constrained;
  workspace_.faces_after_.reserve(workspace_.faces_before_.size());
  place(moves);
  evaluate(moves);
  if (turns_over(moves)) {
    put_back(moves);
    return EditResult::inverted;
  }
  bool allowed = true;
  try {
    if (surface) {
      list_faces_of(moves, workspace_.faces_after_);
      allowed = ask_guard();
    }
  } catch (...) {
    put_back(moves);
    throw;
  }
  if (!allowed) {
    put_back(moves);
    return EditResult::constrained;
  }
  std::size_t evaluated = 0;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    // The first is the last to be undone.
    note_move(moves[i], workspace_.moved_points_[i], evaluated, surface && i == 0);
    evaluated += moves[i].link.size();
  }
  return EditResult::made;
}

/// Of the surface, as they are now, each once. False if one is a face that the file names inside a
/// region.
bool Transaction::list_faces_of(std::span<const VertexMove> moves,
                                std::vector<SurfaceFace>& faces) const {
  faces.clear();
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (!mesh_.is_fixed(moves[i].vertex)) continue;
    for (const HalfFace opposite : moves[i].link) {
      const TetHandle t = opposite.tet();
      for (unsigned k = 0; k < 4; ++k) {
        const HalfFace f(t, k);
        if (k == opposite.face()) continue;
        const HalfFace twin = mesh_.twin(f);
        if (!twin.is_outside()) {
          if (!mesh_.is_constrained(f)) continue;
          const Label other = mesh_.label(twin.tet());
          if (mesh_.label(t) == other) return false;
          if (mesh_.label(t) > other) continue;
        }
        const auto v = mesh_.vertices(f);
        const auto before = moves.first(i);
        const bool is_known = std::any_of(before.begin(), before.end(), [&](const VertexMove& m) {
          return mesh_.is_fixed(m.vertex) && std::find(v.begin(), v.end(), m.vertex) != v.end();
        });
        if (!is_known) faces.push_back(surface_face(f));
      }
    }
  }
  return true;
}

}  // namespace tetmend
