// SPDX-License-Identifier: MIT
//   forward: check an event -> log what it changes, before and after -> change the mesh
//   back:    the log in reverse
//   An undo is a step like any other: that of the edit, before and after exchanged.
#include "trace/playback.h"

#include <algorithm>

#include <fmt/format.h>

namespace tetmend {

namespace {

constexpr TetVertices kNoTet = {};

std::uint32_t size32(const auto& list) {
  return static_cast<std::uint32_t>(list.size());
}

void check_live(const SlotMesh& mesh, TetHandle t) {
  if (!mesh.is_deleted(t)) return;
  throw ByteReader::Damage(fmt::format("a tet in slot {}, where there is none", t.index()));
}

/// First slot that nothing new lies in. Threads that share a pass get free slots each, more of them
/// for a larger mesh; slots far beyond would only cost memory.
std::size_t end_of_slots(const SlotMesh& mesh, std::size_t slots) {
  return std::max(slots + 1, (std::size_t{1} << 16) + 16 * mesh.tet_count());
}

/// A new tet or vertex lies in a free slot.
void check_free(bool is_free, std::uint32_t slot, std::size_t end) {
  if (!is_free) {
    throw ByteReader::Damage(fmt::format("slot {} for something new; it is in use", slot));
  }
  if (slot < end) return;
  throw ByteReader::Damage(fmt::format("slot {} for something new; {} are the most", slot, end));
}

}  // namespace

void Playback::reset(const SlotMesh& mesh, std::uint64_t position) {
  mesh_ = mesh;
  forget_log(position);
  changes_.note_everything();
}

void Playback::forget_log(std::uint64_t position) {
  log_begin_ = position;
  steps_.clear();
  tets_.clear();
  vertices_.clear();
  standards_.clear();
  open_.clear();
}

void Playback::shorten_log(std::uint64_t position) {
  std::size_t kept = 0;
  std::size_t standards = 0;
  while (kept < steps_.size() && steps_[kept].event < position) {
    standards += steps_[kept].kind == EventKind::standard_changes ? 1 : 0;
    ++kept;
  }
  const auto end = [](auto& list, std::size_t n) {
    return list.begin() + static_cast<std::ptrdiff_t>(n);
  };
  const std::uint32_t tets = kept < steps_.size() ? steps_[kept].tets_begin : size32(tets_);
  const std::uint32_t vertices =
      kept < steps_.size() ? steps_[kept].vertices_begin : size32(vertices_);
  steps_.erase(steps_.begin(), end(steps_, kept));
  tets_.erase(tets_.begin(), end(tets_, tets));
  vertices_.erase(vertices_.begin(), end(vertices_, vertices));
  standards_.erase(standards_.begin(), end(standards_, standards));
  const auto number = static_cast<std::uint32_t>(kept);
  for (Step& step : steps_) {
    step.tets_begin -= tets;
    step.tets_end -= tets;
    step.vertices_begin -= vertices;
    step.vertices_end -= vertices;
    step.undone -= step.kind == EventKind::undo ? number : 0;
  }
  std::erase_if(open_, [&](std::uint32_t step) { return step < number; });
  for (std::uint32_t& step : open_) step -= number;
  log_begin_ = position;
}

void Playback::note(const Step& step) {
  if (step.kind == EventKind::standard_changes) return changes_.note_everything();
  changes_.keep_short();
  for (std::uint32_t k = step.tets_begin; k < step.tets_end; ++k) changes_.note(tets_[k].tet);
  for (std::uint32_t k = step.vertices_begin; k < step.vertices_end; ++k) {
    changes_.note(vertices_[k].vertex);
  }
}

TetVertices Playback::content(TetHandle t) const {
  return mesh_.is_deleted(t) ? kNoTet : mesh_.vertices(t);
}

bool Playback::prepare(const TraceEvent& event, std::uint64_t position) {
  if (!changes_mesh(event.kind) && event.kind != EventKind::standard_changes) return false;
  Step step{};
  step.event = position;
  step.tets_begin = size32(tets_);
  step.vertices_begin = size32(vertices_);
  step.kind = event.kind;
  if (step.kind == EventKind::undo) {
    if (open_.empty()) throw ByteReader::Damage("an undo, and there is nothing to undo");
    step.undone = open_.back();
    log_undo(step.undone);
  } else if (step.kind == EventKind::standard_changes) {
    next_standard_ = event.standard;
  } else if (event.kind == EventKind::replace_cavity) {
    log_cavity(event);
  } else {
    log_vertex(event);
  }
  step.tets_end = size32(tets_);
  step.vertices_end = size32(vertices_);
  steps_.push_back(step);
  return true;
}

void Playback::log_cavity(const TraceEvent& event) {
  if (event.removed.empty() || event.created.empty()) {
    throw ByteReader::Damage("a cavity without tets");
  }
  const std::size_t kept = event.removed.size();
  const std::size_t end = end_of_slots(mesh_, mesh_.tet_slots() + event.created.size());
  for (const TetHandle t : event.removed) check_live(mesh_, t);
  for (const TetVertices& tet : event.created_vertices) mesh_.check_corners(tet);
  for (std::size_t k = kept; k < event.created.size(); ++k) {
    const TetHandle t = event.created[k];
    check_free(mesh_.is_deleted(t), t.index(), end);
  }
  const Label label = mesh_.label(event.removed.front());
  const auto label_of = [&](std::size_t k) {
    return event.created_labels.empty() ? label : event.created_labels[k];
  };
  for (std::size_t k = 0; k < std::max(kept, event.created.size()); ++k) {
    const bool made = k < event.created.size();
    const TetHandle t = made ? event.created[k] : event.removed[k];
    tets_.push_back({t, content(t), made ? event.created_vertices[k] : kNoTet,
                     mesh_.is_deleted(t) ? 0 : mesh_.label(t), made ? label_of(k) : 0});
  }
}

void Playback::log_vertex(const TraceEvent& event) {
  const VertexHandle v = event.vertices.front();
  const bool was_there = !mesh_.is_deleted(v);
  const bool is_there = event.kind != EventKind::remove_vertex;
  if (event.kind == EventKind::add_vertex) {
    check_free(!was_there, v.index(), end_of_slots(mesh_, mesh_.vertex_slots()));
  } else if (!was_there) {
    throw ByteReader::Damage(fmt::format("vertex {}, which is none of the mesh", v.index()));
  }
  if (is_there) mesh_.check_place(event.point);
  if (event.kind == EventKind::move_vertex) log_star(event);
  vertices_.push_back({v, was_there, is_there, was_there ? mesh_.point(v) : Point::Zero(),
                       is_there ? event.point : Point::Zero()});
}

void Playback::log_star(const TraceEvent& event) {
  const VertexHandle v = event.vertices.front();
  for (const TetHandle t : event.removed) {
    check_live(mesh_, t);
    const TetVertices& vertices = mesh_.vertices(t);
    if (std::count(vertices.begin(), vertices.end(), v) == 0) {
      throw ByteReader::Damage(
          fmt::format("vertex {} moves, and tet {} is not of its star", v.index(), t.index()));
    }
    tets_.push_back({t, vertices, vertices, mesh_.label(t), mesh_.label(t)});
  }
}

void Playback::log_undo(std::uint32_t undone) {
  const Step edit = steps_[undone];
  for (std::uint32_t k = edit.tets_end; k-- > edit.tets_begin;) {
    const TetChange change = tets_[k];
    tets_.push_back(
        {change.tet, change.after, change.before, change.label_after, change.label_before});
  }
  for (std::uint32_t k = edit.vertices_begin; k < edit.vertices_end; ++k) {
    const VertexChange change = vertices_[k];
    vertices_.push_back(
        {change.vertex, change.is_there, change.was_there, change.after, change.before});
  }
}

void Playback::make() {
  const Step& step = steps_.back();
  note(step);
  if (step.kind == EventKind::undo) {
    open_.pop_back();
  } else if (step.kind == EventKind::standard_changes) {
    standards_.push_back(mesh_.standard());
    mesh_.set_standard(next_standard_);
  } else {
    open_.push_back(size32(steps_) - 1);
  }
  for (std::uint32_t k = step.tets_begin; k < step.tets_end; ++k) {
    mesh_.set_tet(tets_[k].tet, tets_[k].after, tets_[k].label_after);
  }
  for (std::uint32_t k = step.vertices_begin; k < step.vertices_end; ++k) {
    mesh_.set_vertex(vertices_[k].vertex, vertices_[k].is_there, vertices_[k].after);
  }
}

void Playback::revert(const Step& step) {
  note(step);
  for (std::uint32_t k = step.tets_end; k-- > step.tets_begin;) {
    mesh_.set_tet(tets_[k].tet, tets_[k].before, tets_[k].label_before);
  }
  for (std::uint32_t k = step.vertices_end; k-- > step.vertices_begin;) {
    mesh_.set_vertex(vertices_[k].vertex, vertices_[k].was_there, vertices_[k].before);
  }
  if (step.kind == EventKind::undo) {
    open_.push_back(step.undone);
  } else if (step.kind == EventKind::standard_changes) {
    mesh_.set_standard(standards_.back());
    standards_.pop_back();
  } else {
    open_.pop_back();
  }
}

void Playback::back_to(std::uint64_t position) {
  while (!steps_.empty() && steps_.back().event >= position) {
    const Step step = steps_.back();
    revert(step);
    steps_.pop_back();
    tets_.resize(step.tets_begin);
    vertices_.resize(step.vertices_begin);
  }
}

bool Playback::ends_at(std::uint64_t position) const {
  return !steps_.empty() && steps_.back().event + 1 == position;
}

std::span<const TetChange> Playback::tet_changes(std::uint64_t position) const {
  if (!ends_at(position)) return {};
  return std::span(tets_).subspan(steps_.back().tets_begin);
}

std::span<const VertexChange> Playback::vertex_changes(std::uint64_t position) const {
  if (!ends_at(position)) return {};
  return std::span(vertices_).subspan(steps_.back().vertices_begin);
}

}  // namespace tetmend
