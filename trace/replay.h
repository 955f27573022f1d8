// SPDX-License-Identifier: MIT
// The mesh of a run at any event of its trace, forwards and backwards. Needs no operator.
//
//   TraceFile file("run.tetrace");
//   Replay replay(file);
//   replay.seek(file.calls()[7].events.begin);   // the mesh that call 7 found
//   replay.mesh(), replay.cavity()
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trace/slot_mesh.h"
#include "trace/trace_file.h"

namespace tetmend {

/// A tet of a cavity; its vertices tell more than its slot, which may be in use again.
struct CavityTet {
  TetHandle tet;
  TetVertices vertices;
};

/// What the last event did to the mesh; all empty if it did nothing.
struct Cavity {
  /// Of a moved vertex: its star, in both.
  std::vector<CavityTet> removed, created;
  struct VertexChange {
    VertexHandle vertex;
    bool was_there = false, is_there = false;
    Point before = Point::Zero(), after = Point::Zero();
  };
  std::vector<VertexChange> vertices;  ///< at most one: added, removed or moved
};

class Replay {
 public:
  static constexpr std::size_t kDefaultMemory = std::size_t{256} << 20;
  static constexpr std::uint64_t kDefaultDistance = 1 << 15;

  /// Plays the trace once and takes keyframes on the way: copies of the mesh, in about `memory`
  /// bytes altogether, and at least `distance` events apart. At event 0 then.
  /// Precondition: `file` outlives this. Cost: about a microsecond an event.
  explicit Replay(const TraceFile& file, std::size_t memory = kDefaultMemory,
                  std::uint64_t distance = kDefaultDistance);

  /// How many events the mesh has seen: the mesh is as it was before event number position().
  std::uint64_t position() const { return position_; }
  /// Precondition: at most file.event_count(). Cost: the copy of a keyframe, and a microsecond for
  /// each event from there; one step back or forth costs little more than its edit.
  void seek(std::uint64_t position);

  const SlotMesh& mesh() const { return mesh_; }
  /// What event number position() - 1 did.
  Cavity cavity() const;

 private:
  struct TetChange {
    TetHandle tet;
    TetVertices before, after;
    Label label_before, label_after;
  };
  // What one event did; the parts lie in the arrays of the log.
  struct Step {
    std::uint64_t event;
    std::uint32_t tets_begin, tets_end;
    std::uint32_t vertices_begin, vertices_end;
    EventKind kind;
    std::uint32_t undone;  // by an undo: that step
  };
  // Steps since a keyframe or a later chunk, to go back by.
  struct Log {
    std::uint64_t begin = 0;
    std::vector<Step> steps;
    std::vector<TetChange> tets;
    std::vector<Cavity::VertexChange> vertices;
    std::vector<Standard> standards;  // before each change of it
    std::vector<std::uint32_t> open;  // steps that may still be undone
  };
  struct Keyframe {
    std::uint64_t position;
    SlotMesh mesh;
  };

  void take_keyframes(std::size_t memory);
  void restore(const Keyframe& keyframe);
  void forward_to(std::uint64_t position);
  void back_to(std::uint64_t position);
  void forget_log();
  void play(const TraceEvent& event);
  void log_cavity(const TraceEvent& event);
  void log_vertex(const TraceEvent& event);
  void log_undo();
  TetVertices content(TetHandle t) const;
  void redo(const Step& step);
  void revert(const Step& step);

  const TraceFile& file_;
  std::uint64_t distance_;  // of keyframes
  EventCursor cursor_;
  SlotMesh mesh_;
  std::uint64_t position_ = 0;
  std::vector<Keyframe> keyframes_;
  Log log_;
};

}  // namespace tetmend
