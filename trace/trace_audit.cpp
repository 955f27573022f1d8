// SPDX-License-Identifier: MIT
#include "trace/trace_audit.h"

#include <fmt/format.h>

namespace tetmend {

namespace {

std::string text_of(const TetVertices& tet) {
  return fmt::format("{} {} {} {}", tet[0].index(), tet[1].index(), tet[2].index(), tet[3].index());
}

bool is_same(const TetVertices& a, const TetVertices& b) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2] && a[3] == b[3];
}

[[noreturn]] void fail_at(const TetVertices& tet) {
  throw ByteReader::Damage(
      fmt::format("tet {} lies on the same side of a face as another", text_of(tet)));
}

}  // namespace

TraceAudit::TraceAudit(const SlotMesh& mesh)
    : playback_(mesh), tets_of_(mesh.vertex_slots(), 0), last_changed_(mesh.tet_slots(), 0) {
  faces_.reserve(mesh.tet_count());
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    if (!mesh.is_deleted(TetHandle(i))) add_tet(mesh.vertices(TetHandle(i)));
  }
}

void TraceAudit::add_tet(const TetVertices& tet) {
  for (unsigned f = 0; f < 4; ++f) {
    if (!faces_.add(tet, f)) fail_at(tet);
  }
  for (const VertexHandle v : tet) ++tets_of_[v.index()];
}

void TraceAudit::follow(const TraceEvent& event) {
  check_names(event);
  ++position_;
  if (!playback_.prepare(event, position_ - 1)) return;
  const auto tets = playback_.tet_changes(position_);
  follow_tets(event, tets);
  follow_vertices(playback_.vertex_changes(position_));
  playback_.make();
}

/// What an attempt aims at and what a visit is of may be gone, but have a slot.
void TraceAudit::check_names(const TraceEvent& event) const {
  if (event.kind != EventKind::attempt_begins && event.kind != EventKind::visit_begins) return;
  for (const VertexHandle v : event.vertices) {
    if (v.index() < playback_.mesh().vertex_slots()) continue;
    throw ByteReader::Damage(fmt::format("a target with vertex {}; the mesh has slots for {}",
                                         v.index(), playback_.mesh().vertex_slots()));
  }
}

/// Each slot once, and all tets that a cavity inside takes have one label.
void TraceAudit::check_slots(std::span<const TetChange> changes, bool at_surface) {
  for (const TetChange& change : changes) {
    const std::size_t i = change.tet.index();
    if (i >= last_changed_.size()) last_changed_.resize(i + 1, 0);
    if (last_changed_[i] == position_) {
      throw ByteReader::Damage(fmt::format("a cavity with tet {} twice", i));
    }
    last_changed_[i] = position_;
    if (!at_surface && change.before[0].is_valid() &&
        change.label_before != changes.front().label_before) {
      throw ByteReader::Damage("a cavity with tets of two labels");
    }
  }
}

/// Those of the tets removed and created.
void TraceAudit::list_faces(std::span<const TetChange> changes, bool is_cavity) {
  faces_.list_none(changes.size());
  for (const TetChange& change : changes) {
    if (!is_cavity && is_same(change.before, change.after)) continue;  // a move is undone
    for (unsigned f = 0; f < 4; ++f) {
      if (change.before[0].is_valid()) faces_.list_gone(change.before, f);
      if (change.after[0].is_valid() && !faces_.list_come(change.after, f)) {
        throw ByteReader::Damage(fmt::format(
            "new tet {} lies on the same side of a face as another", text_of(change.after)));
      }
    }
  }
}

/// The open faces of the tets removed and created are the same, but for those of the boundary where
/// that may change.
void TraceAudit::check_hull(bool at_surface) {
  if (!(at_surface ? faces_.keep_hull_inside() : faces_.keep_hull())) {
    throw ByteReader::Damage("the new tets do not fill the cavity of the old ones");
  }
}

/// What is undone was looked at when it was done.
void TraceAudit::follow_tets(const TraceEvent& event, std::span<const TetChange> changes) {
  const bool is_cavity = event.kind == EventKind::replace_cavity;
  const bool at_surface = !event.created_labels.empty();
  const bool is_undo = event.kind == EventKind::undo;
  const bool is_move = event.kind == EventKind::move_vertex;
  if (changes_mesh(event.kind) && !is_undo) faces_.begin_edit(is_move ? 0 : changes.size());
  if (is_move) return;
  if (is_undo && faces_.undo()) return count_tets(changes);
  if (is_cavity) check_slots(changes, at_surface);
  list_faces(changes, is_cavity);
  if (is_cavity) check_hull(at_surface);
  if (!faces_.make()) fail_at(changes.back().after);
  count_tets(changes);
}

void TraceAudit::count_tets(std::span<const TetChange> changes) {
  for (const TetChange& change : changes) {
    if (change.before[0].is_valid()) {
      for (const VertexHandle v : change.before) --tets_of_[v.index()];
    }
    if (change.after[0].is_valid()) {
      for (const VertexHandle v : change.after) ++tets_of_[v.index()];
    }
  }
}

void TraceAudit::follow_vertices(std::span<const VertexChange> changes) {
  for (const VertexChange& change : changes) {
    const std::size_t v = change.vertex.index();
    if (v >= tets_of_.size()) tets_of_.resize(v + 1, 0);
    if (change.is_there || tets_of_[v] == 0) continue;
    throw ByteReader::Damage(fmt::format("vertex {} goes, and {} tets have it", v, tets_of_[v]));
  }
}

}  // namespace tetmend
