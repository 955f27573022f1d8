// SPDX-License-Identifier: MIT
// Follows the mesh of a trace that a stranger may have written: is it a mesh after every event?
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trace/edited_faces.h"
#include "trace/playback.h"

namespace tetmend {

/// Every face has one tet a side at most, a cavity keeps its hull and has one label, a vertex leaves
/// when no tet has it: what TetMesh and Transaction ask for. All errors are ByteReader::Damage.
class TraceAudit {
 public:
  /// Cost: linear; about 70 bytes a tet.
  explicit TraceAudit(const SlotMesh& mesh);

  /// The next event of the trace.
  void follow(const TraceEvent& event);
  /// Nothing before the next event may be undone any more.
  void begin_chunk() {
    playback_.forget_log(position_);
    faces_.settle();
  }
  /// After the last event.
  const SlotMesh& mesh() const { return playback_.mesh(); }
  /// The same, to be asked for last.
  SlotMesh take_mesh() { return playback_.take_mesh(); }

 private:
  void check_names(const TraceEvent& event) const;
  void follow_tets(const TraceEvent& event, std::span<const TetChange> changes);
  void count_tets(std::span<const TetChange> changes);
  void follow_vertices(std::span<const VertexChange> changes);
  void check_slots(std::span<const TetChange> changes, bool at_surface);
  void list_faces(std::span<const TetChange> changes, bool is_cavity);
  void check_hull(bool at_surface);
  void add_tet(const TetVertices& tet);

  Playback playback_;
  std::uint64_t position_ = 0;
  EditedFaces faces_;
  std::vector<std::uint32_t> tets_of_;       // how many, by vertex slot
  std::vector<std::uint64_t> last_changed_;  // by which event, by tet slot
};

}  // namespace tetmend
