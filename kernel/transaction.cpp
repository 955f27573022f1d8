// SPDX-License-Identifier: MIT
// Edits with their checks, and the way back.
//
//   replace_cavity: check old tets, vertices and constraints -> evaluate new tets -> glue faces
//                   -> make room -> save -> take slots -> fill -> link
//                   up to here memory may run out; from the first write on nothing can fail
//   undo: the edits in reverse; slots go back to where they came from, in reverse too, so that the
//         free lists are what they were
#include "kernel/transaction.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "kernel/exact_orientation.h"
#include "kernel/make_room.h"
#include "kernel/star.h"
#include "kernel/territory_check.h"
#include "kernel/workspace.h"

namespace tetmend {

namespace {

/// Slots that another workspace has filled since, or that a renumbering took away, are not free: of so
/// many as are needed none may be, or all such go.
void drop_taken(auto& free, std::size_t needed, std::size_t slots, const auto& is_deleted) {
  const auto is_taken = [&](auto handle) { return handle.index() >= slots || !is_deleted(handle); };
  const auto count = static_cast<std::ptrdiff_t>(std::min(needed, free.size()));
  if (std::any_of(free.end() - count, free.end(), is_taken)) std::erase_if(free, is_taken);
}

template <class T>
std::uint32_t size32(const std::vector<T>& values) {
  return static_cast<std::uint32_t>(values.size());
}

void add_to_batch(const TetMesh& mesh, const TetVertices& tet, TetBatch& batch) {
  batch.add(mesh.point(tet[0]), mesh.point(tet[1]), mesh.point(tet[2]), mesh.point(tet[3]));
}

}  // namespace

bool holds_all(const TetMesh& mesh, std::span<const TetHandle> tets, Workspace& workspace) {
  const bool holds = workspace.territory().is_whole() ||
                     std::all_of(tets.begin(), tets.end(),
                                 [&](TetHandle t) { return workspace.holds(mesh.vertices(t)); });
  if (!holds) workspace.note_reached_out();
  return holds;
}

bool holds_all(const TetMesh& mesh, std::span<const VertexMove> moves, Workspace& workspace) {
  const auto holds_link = [&](const VertexMove& move) {
    return workspace.holds(move.vertex) &&
           std::all_of(move.link.begin(), move.link.end(),
                       [&](HalfFace f) { return workspace.holds(mesh.vertices(f.tet())); });
  };
  const bool holds =
      workspace.territory().is_whole() || std::all_of(moves.begin(), moves.end(), holds_link);
  if (!holds) workspace.note_reached_out();
  return holds;
}

bool holds_new(VertexHandle v, Workspace& workspace) {
  const bool holds = workspace.holds(v);
  if (!holds) workspace.note_reached_out();
  return holds;
}

Transaction::Transaction(TetMesh& mesh, Workspace& workspace)
    : mesh_(mesh),
      workspace_(workspace),
      first_edit_(workspace.journal_.edits.size()),
      tets_before_(workspace.tet_count(mesh)) {
  ++workspace_.depth_;
}

Transaction::~Transaction() {
  if (!kept_) undo();
  --workspace_.depth_;
}

bool Transaction::empty() const {
  return workspace_.journal_.edits.size() == first_edit_;
}

void Transaction::keep() noexcept {
  kept_ = true;
  if (workspace_.depth_ == 1) commit();
}

std::span<const TetHandle> Transaction::created() const {
  const Journal& journal = workspace_.journal_;
  for (std::size_t i = journal.edits.size(); i-- > first_edit_;) {
    const Edit& edit = journal.edits[i];
    if (edit.kind == Edit::Kind::replace_cavity) {
      return {journal.created.data() + edit.created_begin, edit.created_end - edit.created_begin};
    }
  }
  return {};
}

/// Writes an edit that was just made into the journal.
void Transaction::note(const Edit& edit) {
  workspace_.journal_.edits.push_back(edit);
  if (workspace_.listener_ != nullptr) {
    workspace_.listener_->edit_made(mesh_, workspace_.journal_);
  }
}

// --- replace_cavity ------------------------------------------------------------------------------

/// Fills cavity_set_ and constrained_edges_; refuses a cavity that another worker may be changing,
/// one with a frozen tet, or with a constrained face or a label border inside.
EditResult Transaction::check_old(std::span<const TetHandle> old) {
  if (!holds_all(mesh_, old, workspace_)) return EditResult::no_room;
  workspace_.cavity_set_.clear();
  workspace_.constrained_edges_.clear();
  for (const TetHandle t : old) workspace_.cavity_set_.insert(t.index());
  for (const TetHandle t : old) {
    if (mesh_.label(t) != mesh_.label(old[0])) return EditResult::constrained;
    if (!mesh_.has_constraints(t)) continue;
    if (mesh_.is_frozen(t)) return EditResult::constrained;
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace twin = mesh_.neighbours(t)[f];
      if (mesh_.is_constrained(HalfFace(t, f)) &&
          workspace_.cavity_set_.contains(twin.tet().index())) {
        return EditResult::constrained;
      }
    }
    for (unsigned e = 0; e < 6; ++e) {
      if (!mesh_.is_constrained(TetEdge(t, e))) continue;
      auto edge = mesh_.vertices(TetEdge(t, e));
      if (edge[1] < edge[0]) std::swap(edge[0], edge[1]);
      auto& known = workspace_.constrained_edges_;
      if (std::find(known.begin(), known.end(), edge) == known.end()) known.push_back(edge);
    }
  }
  return EditResult::made;
}

/// A vertex that vanishes must not be fixed; one that appears must be this worker's, and not have tets
/// elsewhere. Leaves all vertices in vertex_set_.
EditResult Transaction::check_vertices(std::span<const TetHandle> old,
                                       std::span<const TetVertices> created) {
  IndexSet& set = workspace_.vertex_set_;
  set.clear();
  for (const TetVertices& tet : created) {
    for (const VertexHandle v : tet) set.insert(v.index());
  }
  for (const TetHandle t : old) {
    for (const VertexHandle v : mesh_.vertices(t)) {
      if (!set.contains(v.index()) && mesh_.is_fixed(v)) return EditResult::constrained;
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

EditResult Transaction::evaluate(std::span<const TetVertices> created) {
  TetBatch& batch = workspace_.batch_;
  batch.clear();
  for (const TetVertices& tet : created) add_to_batch(mesh_, tet, batch);
  batch.evaluate(mesh_.standard());
  for (std::size_t k = 0; k < created.size(); ++k) {
    if (!batch.is_certified_positive(k)) return EditResult::inverted;
  }
  return EditResult::made;
}

/// Finds for each face of each new tet what lies behind it, and checks that the outer surfaces
/// agree.
EditResult Transaction::glue(std::span<const TetHandle> old, std::span<const TetVertices> created) {
  FaceTable& table = workspace_.face_table_;
  auto& gluing = workspace_.gluing_;
  table.clear();
  gluing.assign(4 * created.size(), {});
  std::size_t open = 0;
  bool even = false;
  for (std::uint32_t i = 0; i < 4 * created.size(); ++i) {
    const TetVertices& tet = created[i / 4];
    const auto& local = kFaceVertices[i % 4];
    const auto [entry, is_new] =
        table.find_or_insert({tet[local[0]], tet[local[1]], tet[local[2]]}, even);
    if (is_new) {
      entry->value = i;
      ++open;
      continue;
    }
    if (entry->paired || entry->even == even) return EditResult::not_closed;
    entry->paired = true;
    --open;
    gluing[i] = {HalfFace::from_code(entry->value), true, false};
    gluing[entry->value] = {HalfFace::from_code(i), true, false};
  }
  for (const TetHandle t : old) {
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      const HalfFace twin = mesh_.twin(face);
      if (!twin.is_outside() && workspace_.cavity_set_.contains(twin.tet().index())) continue;
      const auto [entry, is_new] = table.find_or_insert(mesh_.vertices(face), even);
      if (is_new || entry->paired || entry->even != even) return EditResult::not_closed;
      entry->paired = true;
      --open;
      gluing[entry->value] = {twin, false, mesh_.is_constrained(face)};
    }
  }
  return open == 0 ? EditResult::made : EditResult::not_closed;
}

/// Where tets overlap, a cavity can be filled by positive tets one of whose faces exists elsewhere
/// already; such a face would have four tets. Without overlaps that cannot happen.
bool Transaction::repeats_a_face(std::span<const TetVertices> created) {
  const auto exists_outside = [&](const TetVertices& tet, unsigned f) {
    const auto& local = kFaceVertices[f];
    auto& around = workspace_.search_buffer;
    unsigned i = 0;  // any corner will do
    StarKind kind{};
    do {
      kind = find_star(mesh_, tet[local[i]], workspace_, around);
    } while (kind == StarKind::too_large && ++i < 3);
    if (kind != StarKind::whole) return true;  // cannot tell
    const VertexHandle y = tet[local[(i + 1) % 3]];
    const VertexHandle z = tet[local[(i + 2) % 3]];
    return std::any_of(around.begin(), around.end(), [&](HalfFace opposite) {
      const TetHandle t = opposite.tet();
      return mesh_.local_index(t, y) < 4 && mesh_.local_index(t, z) < 4 &&
             !workspace_.cavity_set_.contains(t.index());
    });
  };
  for (unsigned i = 0; i < 4 * created.size(); ++i) {
    if (workspace_.gluing_[i].local && exists_outside(created[i / 4], i % 4)) return true;
  }
  return false;
}

/// False if a constrained edge is missing among the new tets.
bool Transaction::mark_constrained_edges(std::span<const TetVertices> created) {
  auto& flags = workspace_.created_flags_;
  flags.assign(created.size(), TetMesh::kTetTouched | TetMesh::kTetCreated);
  for (const auto& edge : workspace_.constrained_edges_) {
    bool found = false;
    for (std::size_t k = 0; k < created.size(); ++k) {
      for (unsigned e = 0; e < 6; ++e) {
        const VertexHandle a = created[k][kEdgeVertices[e][0]];
        const VertexHandle b = created[k][kEdgeVertices[e][1]];
        if (std::min(a, b) != edge[0] || std::max(a, b) != edge[1]) continue;
        flags[k] = static_cast<std::uint16_t>(flags[k] | (16u << e));
        found = true;
      }
    }
    if (!found) return false;
  }
  for (std::size_t i = 0; i < workspace_.gluing_.size(); ++i) {
    if (workspace_.gluing_[i].constrained) {
      flags[i / 4] = static_cast<std::uint16_t>(flags[i / 4] | (1u << (i % 4)));
    }
  }
  return true;
}

EditResult Transaction::replace_cavity(std::span<const TetHandle> old,
                                       std::span<const TetVertices> created) {
  assert(!kept_ && !old.empty() && !created.empty());
  for (const EditResult result :
       {check_old(old), check_vertices(old, created), evaluate(created)}) {
    if (result != EditResult::made) return result;
  }
  if (const EditResult result = glue(old, created); result != EditResult::made) return result;
  if (!workspace_.has_room_for(created.size(), old.size())) return EditResult::no_room;
  if (workspace_.may_overlap_ && repeats_a_face(created)) return EditResult::inverted;
  if (!mark_constrained_edges(created)) return EditResult::constrained;

  workspace_.new_flags_.clear();
  Edit edit;
  edit.kind = Edit::Kind::replace_cavity;
  edit.appended = make_room(old.size(), created.size());
  const Label label = mesh_.label(old[0]);
  write_cavity(old, created, {&label, 1}, edit);
  return EditResult::made;
}

/// For all that replacing a cavity and undoing it write. Returns how many slots the mesh grew by.
/// Precondition: vertex_set_ holds the vertices of old and new tets.
std::uint32_t Transaction::make_room(std::size_t old, std::size_t created) {
  Journal& journal = workspace_.journal_;
  auto& [free_tets, free_vertices] = workspace_.free_;
  const std::size_t vertices = workspace_.vertex_set_.size();
  make_room_for(1 + vertices, journal.edits);
  make_room_for(old, journal.removed);
  make_room_for(created, journal.created);
  make_room_for(vertices, journal.links);
  make_room_for(workspace_.new_flags_.size(), journal.flagged);
  make_room_for(vertices, journal.removed_vertices);
  make_room_for(vertices, free_vertices);
  if (old > created) make_room_for(old - created, free_tets);
  if (created > old) {
    drop_taken(free_tets, created - old, mesh_.tet_slots(),
               [this](TetHandle t) { return mesh_.is_deleted(t); });
  }
  const std::size_t slots = old + free_tets.size();
  if (created <= slots) return 0;
  mesh_.grow_tets(created - slots);  // last: nothing that may fail follows
  return static_cast<std::uint32_t>(created - slots);
}

/// @param labels one for each new tet, or one for all
void Transaction::write_cavity(std::span<const TetHandle> old, std::span<const TetVertices> created,
                               std::span<const Label> labels, Edit edit) noexcept {
  save_removed(old, edit);
  take_slots(old, created.size(), edit);
  fill_slots(created, labels, edit);
  link_vertices(created, edit);
  set_flags(edit);
  workspace_.tet_count(mesh_) += created.size();
  workspace_.tet_count(mesh_) -= old.size();
  note(edit);
  remove_isolated(edit);
}

/// Copies the old tets into the journal and unlinks their vertices.
void Transaction::save_removed(std::span<const TetHandle> old, Edit& edit) {
  Journal& journal = workspace_.journal_;
  edit.removed_begin = size32(journal.removed);
  edit.links_begin = size32(journal.links);
  for (const TetHandle t : old) {
    const std::uint32_t i = t.index();
    const TetMesh::Cell& cell = mesh_.cells_[i];
    journal.removed.push_back({t, cell.vertices, cell.neighbours, mesh_.quality_[i],
                               mesh_.label_[i], mesh_.tet_flags_[i]});
    for (const VertexHandle v : cell.vertices) {
      if (mesh_.vertex_tet_[v.index()] != t) continue;
      journal.links.push_back({v, t});
      mesh_.vertex_tet_[v.index()] = TetHandle();
    }
  }
  edit.removed_end = size32(journal.removed);
  edit.links_end = size32(journal.links);
}

/// Deleted slots all look the same, so that undo can bring them back.
void Transaction::clear_slot(TetHandle t) {
  const std::uint32_t i = t.index();
  mesh_.cells_[i] = TetMesh::Cell();
  mesh_.quality_[i] = TetMesh::kDeletedQuality;
  mesh_.label_[i] = 0;
  mesh_.tet_flags_[i] = 0;
}

void Transaction::clear_slot(VertexHandle v) {
  const std::uint32_t i = v.index();
  mesh_.points_[i] = Point::Zero();
  mesh_.vertex_tet_[i] = TetHandle();
  mesh_.vertex_flags_[i] = TetMesh::kVertexDeleted;
  mesh_.vertex_dates_[i] = {};
  mesh_.vertex_origin_[i] = TetMesh::kNotFromFile;
}

/// New tets first take the slots of the old, then free ones, then those that the mesh grew by. Slots
/// left over become free.
void Transaction::take_slots(std::span<const TetHandle> old, std::size_t count, Edit& edit) {
  Journal& journal = workspace_.journal_;
  edit.created_begin = size32(journal.created);
  auto next = static_cast<std::uint32_t>(mesh_.cells_.size() - edit.appended);
  for (std::size_t k = 0; k < count; ++k) {
    if (k < old.size()) {
      journal.created.push_back(old[k]);
    } else if (!workspace_.free_.tets.empty()) {
      journal.created.push_back(workspace_.free_.tets.back());
      workspace_.free_.tets.pop_back();
    } else {
      journal.created.push_back(TetHandle(next++));
    }
  }
  edit.created_end = size32(journal.created);
  for (std::size_t k = count; k < old.size(); ++k) {
    clear_slot(old[k]);
    workspace_.free_.tets.push_back(old[k]);
  }
}

void Transaction::fill_slots(std::span<const TetVertices> created, std::span<const Label> labels,
                             const Edit& edit) {
  const TetHandle* slots = workspace_.journal_.created.data() + edit.created_begin;
  for (std::size_t k = 0; k < created.size(); ++k) {
    const std::uint32_t i = slots[k].index();
    TetMesh::Cell& cell = mesh_.cells_[i];
    cell.vertices = created[k];
    mesh_.quality_[i] = workspace_.batch_.quality(k);
    mesh_.label_[i] = labels[labels.size() == 1 ? 0 : k];
    mesh_.tet_flags_[i] = workspace_.created_flags_[k];
    for (unsigned f = 0; f < 4; ++f) {
      const Workspace::Gluing& glued = workspace_.gluing_[4 * k + f];
      if (glued.local) {
        cell.neighbours[f] = HalfFace(slots[glued.twin.tet().index()], glued.twin.face());
      } else {
        cell.neighbours[f] = glued.twin;
        if (!glued.twin.is_outside()) {
          mesh_.cells_[glued.twin.tet().index()].neighbours[glued.twin.face()] =
              HalfFace(slots[k], f);
        }
      }
    }
  }
}

void Transaction::link_vertices(std::span<const TetVertices> created, Edit& edit) {
  Journal& journal = workspace_.journal_;
  const auto known = [&](VertexHandle v) {
    const auto begin = journal.links.begin() + edit.links_begin;
    return std::any_of(begin, journal.links.begin() + edit.links_end,
                       [v](const Journal::VertexLink& link) { return link.vertex == v; });
  };
  for (std::size_t k = 0; k < created.size(); ++k) {
    for (const VertexHandle v : created[k]) {
      TetHandle& link = mesh_.vertex_tet_[v.index()];
      if (link.is_valid()) continue;
      link = journal.created[edit.created_begin + k];
      if (!known(v)) journal.links.push_back({v, TetHandle()});
    }
  }
  edit.links_end = size32(journal.links);
}

/// Deletes the vertices that lost their last tet.
void Transaction::remove_isolated(const Edit& replaced) {
  Journal& journal = workspace_.journal_;
  for (std::uint32_t i = replaced.links_begin; i < replaced.links_end; ++i) {
    const VertexHandle v = journal.links[i].vertex;
    if (mesh_.vertex_tet_[v.index()].is_valid()) continue;
    Edit edit;
    edit.kind = Edit::Kind::remove_vertex;
    edit.vertex = v;
    edit.point = mesh_.points_[v.index()];
    journal.removed_vertices.push_back({mesh_.changed(v), mesh_.moved(v),
                                        mesh_.vertex_origin_[v.index()],
                                        mesh_.vertex_flags_[v.index()]});
    clear_slot(v);
    workspace_.free_.vertices.push_back(v);
    --workspace_.vertex_count(mesh_);
    note(edit);
  }
}

// --- vertices ------------------------------------------------------------------------------------

VertexHandle Transaction::add_vertex(const Point& point) {
  assert(!kept_);
  make_room_for(1, workspace_.journal_.edits);
  make_room_for(1, workspace_.added_vertices_);
  Edit edit;
  edit.kind = Edit::Kind::add_vertex;
  drop_taken(workspace_.free_.vertices, 1, mesh_.vertex_slots(),
             [this](VertexHandle v) { return mesh_.is_deleted(v); });
  if (!workspace_.free_.vertices.empty()) {
    edit.vertex = workspace_.free_.vertices.back();
    workspace_.free_.vertices.pop_back();
  } else if (!workspace_.territory_.is_whole()) {
    workspace_.note_border();
    return {};
  } else {
    edit.vertex = VertexHandle(size32(mesh_.points_));
    edit.appended = 1;
    mesh_.grow_vertices(1);
  }
  // From here on nothing can fail.
  workspace_.territory_.claim(edit.vertex);
  workspace_.added_vertices_.push_back(edit.vertex);
  mesh_.points_[edit.vertex.index()] = point;
  mesh_.vertex_flags_[edit.vertex.index()] = 0;
  ++workspace_.vertex_count(mesh_);
  note(edit);
  return edit.vertex;
}

/// What new_flags_ says.
void Transaction::set_flags(Edit& edit) noexcept {
  std::vector<Journal::VertexFlags>& flagged = workspace_.journal_.flagged;
  edit.flagged_begin = size32(flagged);
  for (const auto& [v, flags] : workspace_.new_flags_) {
    flagged.push_back({v, mesh_.vertex_flags_[v.index()]});
    mesh_.vertex_flags_[v.index()] = flags;
  }
  edit.flagged_end = size32(flagged);
}

EditResult Transaction::move_vertex(VertexHandle v, const Point& point,
                                    std::span<const HalfFace> link) {
  if (link.empty() && mesh_.tet_of(v).is_valid()) return EditResult::not_closed;
  const VertexMove move = {v, point, link};
  return move_vertices({&move, 1});
}

EditResult Transaction::move_vertex(VertexHandle v, const Point& point) {
  if (v.index() >= mesh_.vertex_slots() || mesh_.is_deleted(v)) return EditResult::not_closed;
  const Link around = link(mesh_, v);
  return move_vertex(v, point, {around.data(), around.size()});
}

EditResult Transaction::move_vertices(std::span<const VertexMove> moves) {
  assert(!kept_);
  if (!holds_all(mesh_, moves, workspace_)) return EditResult::no_room;
  if (has_fixed(moves)) return EditResult::constrained;
  place(moves);
  evaluate(moves);
  if (turns_over(moves)) {
    put_back(moves);
    return EditResult::inverted;
  }
  std::size_t evaluated = 0;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    note_move(moves[i], workspace_.moved_points_[i], evaluated);
    evaluated += moves[i].link.size();
  }
  return EditResult::made;
}

EditResult Transaction::rearrange_vertices(std::span<const VertexMove> moves) {
  assert(!kept_);
  if (!holds_all(mesh_, moves, workspace_)) return EditResult::no_room;
  const auto count = [&](const auto& is_positive) {
    IndexSet& seen = workspace_.touched_set_;
    seen.clear();
    std::size_t others = 0;
    for (const VertexMove& move : moves) {
      for (const HalfFace f : move.link) {
        if (!seen.insert(f.tet().index())) continue;
        if (!is_positive(mesh_.vertices(f.tet()))) ++others;
      }
    }
    return others;
  };
  // A tet that is positive after all, though hardly, must not pay for one that turns over.
  const std::size_t before = count([&](const TetVertices& v) {
    return mesh_.is_certified_positive(v) ||
           exact_orientation(mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2]),
                             mesh_.point(v[3])) > 0;
  });
  if (has_fixed(moves)) return EditResult::constrained;
  place(moves);
  if (count([&](const TetVertices& v) { return mesh_.is_certified_positive(v); }) >= before) {
    put_back(moves);
    return EditResult::inverted;
  }
  for (std::size_t i = 0; i < moves.size(); ++i) {
    evaluate(moves.subspan(i, 1));
    note_move(moves[i], workspace_.moved_points_[i], 0);
  }
  return EditResult::made;
}

bool Transaction::has_fixed(std::span<const VertexMove> moves) const {
  return std::any_of(moves.begin(), moves.end(),
                     [&](const VertexMove& move) { return mesh_.is_fixed(move.vertex); });
}

/// Puts the vertices where they are to go, and keeps the places where they were.
void Transaction::place(std::span<const VertexMove> moves) {
  make_room(moves);
  auto& before = workspace_.moved_points_;
  before.clear();
  for (const VertexMove& move : moves) {
    Point& stored = mesh_.points_[move.vertex.index()];
    before.push_back(stored);
    stored = move.point;
  }
}

/// For all that moving the vertices and undoing it write.
void Transaction::make_room(std::span<const VertexMove> moves) {
  std::size_t tets = 0;
  for (const VertexMove& move : moves) tets += move.link.size();
  workspace_.moved_points_.reserve(moves.size());
  workspace_.batch_.reserve(tets);
  make_room_for(moves.size(), workspace_.journal_.edits);
  make_room_for(tets, workspace_.journal_.qualities);
}

void Transaction::put_back(std::span<const VertexMove> moves) {
  for (std::size_t i = 0; i < moves.size(); ++i) {
    mesh_.points_[moves[i].vertex.index()] = workspace_.moved_points_[i];
  }
}

/// The tets of each link in turn, with the vertices in their new places.
void Transaction::evaluate(std::span<const VertexMove> moves) {
  TetBatch& batch = workspace_.batch_;
  batch.clear();
  for (const VertexMove& move : moves) {
    for (const HalfFace f : move.link) add_to_batch(mesh_, mesh_.vertices(f.tet()), batch);
  }
  batch.evaluate(mesh_.standard());
}

/// A tet that was positive is not certified so with the vertices in their new places.
bool Transaction::turns_over(std::span<const VertexMove> moves) const {
  std::size_t k = 0;
  for (const VertexMove& move : moves) {
    for (const HalfFace f : move.link) {
      const bool is_positive = workspace_.batch_.is_certified_positive(k++);
      if (!is_positive && mesh_.quality(f.tet()) > 0) return true;
    }
  }
  return false;
}

/// Brings the qualities around a vertex that was moved up to date and keeps the old ones.
void Transaction::note_move(const VertexMove& move, const Point& before, std::size_t first_of_batch,
                            bool surface) {
  Journal& journal = workspace_.journal_;
  Edit edit;
  edit.surface = surface;
  edit.kind = Edit::Kind::move_vertex;
  edit.vertex = move.vertex;
  edit.point = before;
  edit.qualities_begin = size32(journal.qualities);
  std::size_t k = first_of_batch;
  for (const HalfFace f : move.link) {
    Quality& quality = mesh_.quality_[f.tet().index()];
    journal.qualities.push_back({f.tet(), quality});
    quality = workspace_.batch_.quality(k++);
  }
  edit.qualities_end = size32(journal.qualities);
  note(edit);
}

// --- the way back --------------------------------------------------------------------------------

void Transaction::undo() noexcept {
  auto& edits = workspace_.journal_.edits;
  while (edits.size() > first_edit_) {
    const Edit edit = edits.back();
    edits.pop_back();
    switch (edit.kind) {
      case Edit::Kind::replace_cavity:
        undo_replace(edit);
        break;
      case Edit::Kind::move_vertex:
        undo_move(edit);
        break;
      case Edit::Kind::add_vertex:
        undo_add(edit);
        break;
      case Edit::Kind::remove_vertex:
        undo_remove(edit);
        break;
    }
    if (edit.surface) mesh_.surface_guard()->undo(*workspace_.surface_journal_);
    if (workspace_.listener_ != nullptr) workspace_.listener_->edit_undone();
  }
}

void Transaction::undo_replace(const Edit& edit) {
  Journal& journal = workspace_.journal_;
  const std::uint32_t removed = edit.removed_end - edit.removed_begin;
  const std::uint32_t created = edit.created_end - edit.created_begin;
  for (std::uint32_t k = created; k-- > std::min(created, removed);) {
    const TetHandle t = journal.created[edit.created_begin + k];
    if (k >= created - edit.appended) {
      assert(t.index() + 1 == mesh_.cells_.size());
      mesh_.drop_tet_slot();
    } else {
      clear_slot(t);
      workspace_.free_.tets.push_back(t);
    }
  }
  if (removed > created) {
    workspace_.free_.tets.resize(workspace_.free_.tets.size() - (removed - created));
  }
  for (std::uint32_t k = edit.removed_end; k-- > edit.removed_begin;) {
    const Journal::RemovedTet& saved = journal.removed[k];
    const std::uint32_t i = saved.tet.index();
    mesh_.cells_[i] = {saved.vertices, saved.neighbours};
    mesh_.quality_[i] = saved.quality;
    mesh_.label_[i] = saved.label;
    mesh_.tet_flags_[i] = saved.flags;
  }
  for (std::uint32_t k = edit.removed_begin; k < edit.removed_end; ++k) {
    const Journal::RemovedTet& saved = journal.removed[k];
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace twin = saved.neighbours[f];
      if (!twin.is_outside()) {
        mesh_.cells_[twin.tet().index()].neighbours[twin.face()] = HalfFace(saved.tet, f);
      }
    }
  }
  for (std::uint32_t k = edit.links_end; k-- > edit.links_begin;) {
    mesh_.vertex_tet_[journal.links[k].vertex.index()] = journal.links[k].tet;
  }
  for (std::uint32_t k = edit.flagged_end; k-- > edit.flagged_begin;) {
    mesh_.vertex_flags_[journal.flagged[k].vertex.index()] = journal.flagged[k].flags;
  }
  journal.flagged.resize(edit.flagged_begin);
  workspace_.tet_count(mesh_) += removed;
  workspace_.tet_count(mesh_) -= created;
  journal.removed.resize(edit.removed_begin);
  journal.created.resize(edit.created_begin);
  journal.links.resize(edit.links_begin);
}

void Transaction::undo_move(const Edit& edit) {
  Journal& journal = workspace_.journal_;
  mesh_.points_[edit.vertex.index()] = edit.point;
  for (std::uint32_t k = edit.qualities_begin; k < edit.qualities_end; ++k) {
    mesh_.quality_[journal.qualities[k].tet.index()] = journal.qualities[k].quality;
  }
  journal.qualities.resize(edit.qualities_begin);
}

void Transaction::undo_add(const Edit& edit) {
  --workspace_.vertex_count(mesh_);
  workspace_.added_vertices_.pop_back();
  if (edit.appended != 0) return mesh_.drop_vertex_slot();
  clear_slot(edit.vertex);
  workspace_.free_.vertices.push_back(edit.vertex);
}

void Transaction::undo_remove(const Edit& edit) {
  Journal& journal = workspace_.journal_;
  const std::uint32_t i = edit.vertex.index();
  const Journal::RemovedVertex saved = journal.removed_vertices.back();
  journal.removed_vertices.pop_back();
  mesh_.points_[i] = edit.point;
  mesh_.vertex_dates_[i] = {saved.date, saved.moved};
  mesh_.vertex_origin_[i] = saved.origin;
  mesh_.vertex_flags_[i] = saved.flags;
  workspace_.free_.vertices.pop_back();
  ++workspace_.vertex_count(mesh_);
}

// --- commit -------------------------------------------------------------------------------------

void Transaction::commit() {
  Journal& journal = workspace_.journal_;
  const Date date = workspace_.date_;
  for (const Edit& edit : journal.edits) {
    for (std::uint32_t k = edit.created_begin; k < edit.created_end; ++k) {
      const TetHandle t = journal.created[k];
      if (mesh_.is_deleted(t)) continue;
      for (const VertexHandle v : mesh_.vertices(t)) mesh_.vertex_dates_[v.index()].changed = date;
    }
    if (edit.kind == Edit::Kind::move_vertex) mesh_.vertex_dates_[edit.vertex.index()].moved = date;
    // The star of the moved vertex did not change but for the move: it keeps its date.
    for (std::uint32_t k = edit.qualities_begin; k < edit.qualities_end; ++k) {
      const TetHandle t = journal.qualities[k].tet;
      if (mesh_.is_deleted(t)) continue;
      mesh_.tet_flags_[t.index()] |= TetMesh::kTetTouched;
      for (const VertexHandle v : mesh_.vertices(t)) {
        if (v != edit.vertex) mesh_.vertex_dates_[v.index()].changed = date;
      }
    }
  }
  journal.clear();
  if (workspace_.surface_journal_) workspace_.surface_journal_->clear();
}

}  // namespace tetmend
