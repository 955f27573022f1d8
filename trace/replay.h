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

#include "trace/playback.h"
#include "trace/trace_file.h"
#include "trace/vertex_tets.h"

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

  const SlotMesh& mesh() const { return playback_.mesh(); }
  /// The mesh at that position, where this goes; but stays where it is if the file has the mesh, as it
  /// has that at its end.
  const SlotMesh& mesh_at(std::uint64_t position);
  /// What event number position() - 1 did.
  Cavity cavity() const;
  /// The slots that were written on the way here.
  const ChangeLog& changes() const { return playback_.changes(); }
  /// Tets that contain all of these vertices, by slot. Cost: that of what changed since the last
  /// question; each of the first few times, a look at all tets, and then once a list of them by vertex.
  std::vector<TetHandle> tets_around(std::span<const VertexHandle> vertices);
  /// The mesh at event 0 as one that knows its neighbours: tets_around() then costs little from the
  /// first question on. It must stay as it is, and be lent again where it has moved.
  /// Precondition, the first time: at event 0.
  void lend(const TetMesh& start);

 private:
  struct Keyframe {
    std::uint64_t position;
    SlotMesh mesh;  // of the first one nothing: the file has it
  };

  void take_keyframes(std::size_t memory);
  void thin_keyframes();
  void restore(const Keyframe& keyframe);
  void forward_to(std::uint64_t position);
  void shorten_log();
  bool add_tets_of(VertexHandle v, std::vector<TetHandle>& tets);
  const TraceFile& file_;
  std::uint64_t distance_;  // of keyframes
  EventCursor cursor_;
  Playback playback_;
  std::uint64_t position_ = 0;
  std::vector<Keyframe> keyframes_;
  VertexTets vertex_tets_;
  unsigned looks_ = 0;              // at all tets
  const TetMesh* start_ = nullptr;  // at event 0
  ChangeLog::Mark lent_;            // what was written then
};

}  // namespace tetmend
