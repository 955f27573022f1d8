// SPDX-License-Identifier: MIT
// A mesh that the events of a trace change, with a log to go back by.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "trace/change_log.h"
#include "trace/slot_mesh.h"
#include "trace/trace_event.h"

namespace tetmend {

/// What one event makes of the content of a slot. An invalid first vertex: nothing there.
struct TetChange {
  TetHandle tet;
  TetVertices before, after;
  Label label_before, label_after;
};

struct VertexChange {
  VertexHandle vertex;
  bool was_there = false, is_there = false;
  Point before = Point::Zero(), after = Point::Zero();
};

/// Plays events whoever wrote them: each is checked against the mesh before it changes anything. What
/// one look at slots cannot tell, that tets fit together, is for TraceAudit to see.
class Playback {
 public:
  explicit Playback(const SlotMesh& mesh) : mesh_(mesh) {}

  const SlotMesh& mesh() const { return mesh_; }
  /// To be asked for last.
  SlotMesh take_mesh() { return std::move(mesh_); }
  /// Another mesh, before event `position`; the log is empty then.
  void reset(const SlotMesh& mesh, std::uint64_t position);
  /// Empties the log: what was done cannot be undone. The next event is number `position`.
  void forget_log(std::uint64_t position);
  /// Forgets the steps before event `position`. Precondition: none of them is undone later.
  void shorten_log(std::uint64_t position);
  /// The slots that were written by all this.
  const ChangeLog& changes() const { return changes_; }
  /// The first event that the log may have.
  std::uint64_t log_begin() const { return log_begin_; }
  /// How many of the events in it are steps.
  std::size_t log_size() const { return steps_.size(); }

  /// Logs the step that event number `position` is; false if it is none.
  /// @throws ByteReader::Damage, with the mesh as it was, when the event does not fit the mesh
  bool prepare(const TraceEvent& event, std::uint64_t position);
  /// Makes the step that was prepared.
  void make();
  /// Takes back all steps from event `position` on. Precondition: at least log_begin().
  void back_to(std::uint64_t position);

  /// What event number `position` - 1 did, if the log has it and it is the last; else nothing. Valid
  /// until the next step.
  std::span<const TetChange> tet_changes(std::uint64_t position) const;
  std::span<const VertexChange> vertex_changes(std::uint64_t position) const;

 private:
  // What one event did; the parts lie in the arrays of the log.
  struct Step {
    std::uint64_t event;
    std::uint32_t tets_begin, tets_end;
    std::uint32_t vertices_begin, vertices_end;
    EventKind kind;
    std::uint32_t undone;  // by an undo: that step
  };

  void log_cavity(const TraceEvent& event);
  void log_vertex(const TraceEvent& event);
  void log_star(const TraceEvent& event);
  void log_undo(std::uint32_t undone);
  TetVertices content(TetHandle t) const;
  void revert(const Step& step);
  bool ends_at(std::uint64_t position) const;
  void note(const Step& step);

  SlotMesh mesh_;
  std::uint64_t log_begin_ = 0;
  std::vector<Step> steps_;
  std::vector<TetChange> tets_;
  std::vector<VertexChange> vertices_;
  std::vector<Standard> standards_;  // before each change of it
  std::vector<std::uint32_t> open_;  // steps that may still be undone
  Standard next_standard_;           // of the step that was prepared
  ChangeLog changes_;
};

}  // namespace tetmend
