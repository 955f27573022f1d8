// SPDX-License-Identifier: MIT
//   forward: read an event -> log what it changes, before and after -> change the mesh
//   back:    the log in reverse; where it does not reach, the nearest keyframe, then forward
//   An undo is a step like any other: that of the edit, before and after exchanged.
#include "trace/replay.h"

#include <algorithm>

namespace tetmend {

namespace {

/// A log of this many steps is dropped at the next chunk.
constexpr std::uint64_t kLongLog = 1 << 17;

constexpr TetVertices kNoTet = {};

}  // namespace

Replay::Replay(const TraceFile& file, std::size_t memory, std::uint64_t distance)
    : file_(file), distance_(distance), cursor_(file), mesh_(file.initial_mesh()) {
  take_keyframes(memory);
}

void Replay::take_keyframes(std::size_t memory) {
  keyframes_.push_back({0, mesh_});
  const std::uint64_t affordable = std::max<std::size_t>(1, memory / (mesh_.bytes() + 1));
  distance_ = std::max(distance_, file_.event_count() / affordable);
  for (const std::uint64_t begin : file_.chunk_begins()) {
    if (begin < keyframes_.back().position + distance_) continue;
    forward_to(begin);
    forget_log();
    keyframes_.push_back({position_, mesh_});
  }
  restore(keyframes_.front());
}

void Replay::restore(const Keyframe& keyframe) {
  mesh_ = keyframe.mesh;
  position_ = keyframe.position;
  forget_log();
}

void Replay::forget_log() {
  log_.begin = position_;
  log_.steps.clear();
  log_.tets.clear();
  log_.vertices.clear();
  log_.standards.clear();
  log_.open.clear();
}

/// The event before `position` is played or stays in the log, so that cavity() can tell of it.
void Replay::seek(std::uint64_t position) {
  if (position < position_ && position > log_.begin) return back_to(position);
  const auto not_before =
      std::lower_bound(keyframes_.begin(), keyframes_.end(), position,
                       [](const Keyframe& k, std::uint64_t p) { return k.position < p; });
  const Keyframe& keyframe = not_before == keyframes_.begin() ? *not_before : *(not_before - 1);
  if (position < position_ || keyframe.position > position_) restore(keyframe);
  forward_to(position);
}

void Replay::forward_to(std::uint64_t position) {
  if (position == position_) return;
  cursor_.move_to(position_);
  const std::span<const std::uint64_t> begins = file_.chunk_begins();
  while (position_ < position) {
    // Nothing is undone across the border of a chunk.
    if (log_.steps.size() > std::min(kLongLog, 4 * distance_) &&
        std::binary_search(begins.begin(), begins.end(), position_)) {
      forget_log();
    }
    play(cursor_.next());
    ++position_;
  }
}

void Replay::back_to(std::uint64_t position) {
  while (!log_.steps.empty() && log_.steps.back().event >= position) {
    const Step step = log_.steps.back();
    revert(step);
    log_.steps.pop_back();
    log_.tets.resize(step.tets_begin);
    log_.vertices.resize(step.vertices_begin);
    if (step.kind == EventKind::undo) {
      log_.open.push_back(step.undone);
    } else if (step.kind == EventKind::standard_changes) {
      mesh_.set_standard(log_.standards.back());
      log_.standards.pop_back();
    } else {
      log_.open.pop_back();
    }
  }
  position_ = position;
}

TetVertices Replay::content(TetHandle t) const {
  return mesh_.is_deleted(t) ? kNoTet : mesh_.vertices(t);
}

/// Logs and makes the step that an event is, if it is one.
void Replay::play(const TraceEvent& event) {
  if (!changes_mesh(event.kind) && event.kind != EventKind::standard_changes) return;
  Step& step = log_.steps.emplace_back();
  step.event = position_;
  step.tets_begin = static_cast<std::uint32_t>(log_.tets.size());
  step.vertices_begin = static_cast<std::uint32_t>(log_.vertices.size());
  step.kind = event.kind;
  if (step.kind == EventKind::undo) {
    log_undo();
  } else if (step.kind == EventKind::standard_changes) {
    log_.standards.push_back(mesh_.standard());
    mesh_.set_standard(event.standard);
  } else {
    log_.open.push_back(static_cast<std::uint32_t>(log_.steps.size() - 1));
    if (event.kind == EventKind::replace_cavity) {
      log_cavity(event);
    } else {
      log_vertex(event);
    }
  }
  step.tets_end = static_cast<std::uint32_t>(log_.tets.size());
  step.vertices_end = static_cast<std::uint32_t>(log_.vertices.size());
  redo(step);
}

void Replay::log_cavity(const TraceEvent& event) {
  if (event.removed.empty() || mesh_.is_deleted(event.removed.front())) throw ByteReader::Damage();
  const Label label = mesh_.label(event.removed.front());
  for (std::size_t k = 0; k < std::max(event.removed.size(), event.created.size()); ++k) {
    const bool made = k < event.created.size();
    const TetHandle t = made ? event.created[k] : event.removed[k];
    log_.tets.push_back({t, content(t), made ? event.created_vertices[k] : kNoTet,
                         mesh_.is_deleted(t) ? 0 : mesh_.label(t), made ? label : 0});
  }
}

void Replay::log_vertex(const TraceEvent& event) {
  const VertexHandle v = event.vertices.front();
  const bool was_there = !mesh_.is_deleted(v);
  const bool is_there = event.kind != EventKind::remove_vertex;
  log_.vertices.push_back({v, was_there, is_there, was_there ? mesh_.point(v) : Point::Zero(),
                           is_there ? event.point : Point::Zero()});
  if (event.kind != EventKind::move_vertex) return;
  for (const TetHandle t : event.removed) {
    if (mesh_.is_deleted(t)) throw ByteReader::Damage();
    const TetVertices& vertices = mesh_.vertices(t);
    log_.tets.push_back({t, vertices, vertices, mesh_.label(t), mesh_.label(t)});
  }
}

void Replay::log_undo() {
  if (log_.open.empty()) throw ByteReader::Damage();
  const std::uint32_t undone = log_.open.back();
  log_.open.pop_back();
  log_.steps.back().undone = undone;
  const Step edit = log_.steps[undone];
  for (std::uint32_t k = edit.tets_end; k-- > edit.tets_begin;) {
    const TetChange change = log_.tets[k];
    log_.tets.push_back(
        {change.tet, change.after, change.before, change.label_after, change.label_before});
  }
  for (std::uint32_t k = edit.vertices_begin; k < edit.vertices_end; ++k) {
    const Cavity::VertexChange change = log_.vertices[k];
    log_.vertices.push_back(
        {change.vertex, change.is_there, change.was_there, change.after, change.before});
  }
}

void Replay::redo(const Step& step) {
  for (std::uint32_t k = step.tets_begin; k < step.tets_end; ++k) {
    const TetChange& change = log_.tets[k];
    mesh_.set_tet(change.tet, change.after, change.label_after);
  }
  for (std::uint32_t k = step.vertices_begin; k < step.vertices_end; ++k) {
    const Cavity::VertexChange& change = log_.vertices[k];
    mesh_.set_vertex(change.vertex, change.is_there, change.after);
  }
}

void Replay::revert(const Step& step) {
  for (std::uint32_t k = step.tets_end; k-- > step.tets_begin;) {
    const TetChange& change = log_.tets[k];
    mesh_.set_tet(change.tet, change.before, change.label_before);
  }
  for (std::uint32_t k = step.vertices_end; k-- > step.vertices_begin;) {
    const Cavity::VertexChange& change = log_.vertices[k];
    mesh_.set_vertex(change.vertex, change.was_there, change.before);
  }
}

Cavity Replay::cavity() const {
  Cavity cavity;
  if (log_.steps.empty() || log_.steps.back().event + 1 != position_) return cavity;
  const Step& step = log_.steps.back();
  for (std::uint32_t k = step.tets_begin; k < step.tets_end; ++k) {
    const TetChange& change = log_.tets[k];
    if (change.before[0].is_valid()) cavity.removed.push_back({change.tet, change.before});
    if (change.after[0].is_valid()) cavity.created.push_back({change.tet, change.after});
  }
  cavity.vertices.assign(log_.vertices.begin() + step.vertices_begin,
                         log_.vertices.begin() + step.vertices_end);
  return cavity;
}

}  // namespace tetmend
