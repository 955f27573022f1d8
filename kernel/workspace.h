// SPDX-License-Identifier: MIT
// What one worker needs besides the mesh: free slots, journal, visit marks, scratch buffers.
#pragma once

#include <span>
#include <vector>

#include "kernel/edit.h"
#include "kernel/face_table.h"
#include "kernel/index_set.h"
#include "kernel/territory.h"
#include "kernel/tet_batch.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

/// The working memory of one worker. The mesh holds nothing of the kind, so any thread may read it.
/// A workspace belongs to one mesh; garbage collection and sorting of the mesh make it invalid.
class Workspace {
 public:
  /// Collects the free slots of the mesh; notes whether it has tets that are not positive. Cost:
  /// linear in the slots.
  explicit Workspace(const TetMesh& mesh);
  /// A further one for the same mesh, without free slots: for work in territories only.
  static Workspace without_slots(const Workspace& first);

  /// The date that commits write to the vertices around a change.
  Date date() const { return date_; }
  /// Precondition: no transaction is open.
  void set_date(Date date) { date_ = date; }

  /// Told of every edit from now on. Null: nobody. Precondition: no transaction is open.
  void set_listener(EditListener* listener) { listener_ = listener; }

  /// Where this worker may work.
  const Territory& territory() const { return territory_; }
  /// The same questions as to the territory; a "no" is noted.
  bool holds(VertexHandle v) {
    if (territory_.holds(v)) return true;
    met_border_ = true;
    return false;
  }
  bool holds(const TetVertices& tet) {
    return territory_.is_whole() ||
           (holds(tet[0]) && holds(tet[1]) && holds(tet[2]) && holds(tet[3]));
  }
  /// An answer depends on what lies outside the territory, since the last forget_border().
  bool met_border() const { return met_border_; }
  bool mesh_may_overlap() const { return may_overlap_; }
  void note_border() { met_border_ = true; }
  void forget_border() { met_border_ = false; }

  /// Slots without a tet or vertex, of which a mesh makes new ones.
  struct FreeSlots {
    std::vector<TetHandle> tets;
    std::vector<VertexHandle> vertices;
  };
  /// From now on the worker keeps to a territory and makes new tets and vertices of these slots
  /// only; the mesh does not grow. Exchanges the free slots of the workspace for `slots`.
  /// Precondition: no transaction is open.
  void enter(const Territory& territory, FreeSlots& slots);
  /// Back to the whole mesh, and to the own free slots. `slots` gets those of the territory. The
  /// counts of tets and vertices of the mesh are right only after settle().
  void leave(FreeSlots& slots);
  /// Adds to the counts of the mesh what work in territories has changed them by. Precondition: no
  /// other worker is active.
  void settle(TetMesh& mesh);

  /// Free slots of the whole mesh. Precondition: no territory.
  FreeSlots& free_slots() { return free_; }
  /// Vertices that were added since the list was last cleared; some may be deleted again.
  std::vector<VertexHandle>& added_vertices() { return added_vertices_; }

  // Buffers of the walks in star.h.
  IndexSet star_set;
  std::vector<HalfFace> link_buffer;
  std::vector<HalfFace> search_buffer;
  std::vector<TetHandle> star_buffer;
  std::vector<VertexHandle> ring_buffer;

  /// Adds free slots to the mesh so that it has at least that many. Precondition: no territory.
  void provide(TetMesh& mesh, std::size_t tets, std::size_t vertices);

 private:
  friend class Transaction;

  Workspace() = default;

  std::size_t& tet_count(TetMesh& mesh) {
    return territory_.is_whole() ? mesh.tet_count_ : more_tets_;
  }
  std::size_t& vertex_count(TetMesh& mesh) {
    return territory_.is_whole() ? mesh.vertex_count_ : more_vertices_;
  }
  bool has_room_for(std::size_t created, std::size_t removed) {
    if (territory_.is_whole() || created <= removed + free_.tets.size()) return true;
    met_border_ = true;
    return false;
  }

  Date date_ = 1;
  Journal journal_;
  EditListener* listener_ = nullptr;
  unsigned depth_ = 0;  // open transactions
  FreeSlots free_;
  Territory territory_;
  bool met_border_ = false;
  // What a territory's work changes the counts of the mesh by; modulo 2^64.
  std::size_t more_tets_ = 0;
  std::size_t more_vertices_ = 0;
  std::vector<VertexHandle> added_vertices_;
  // The mesh had tets of no positive quality when the workspace was made.
  bool may_overlap_ = false;

  // Buffers of Transaction.
  IndexSet cavity_set_;
  IndexSet vertex_set_;
  IndexSet touched_set_;
  FaceTable face_table_;
  struct Gluing {
    // Of a new face: number and face of another new tet if local, else what lies outside.
    HalfFace twin;
    bool local;
    bool constrained;
  };
  std::vector<Gluing> gluing_;
  TetBatch batch_;  // the tets that an edit makes or moves
  std::vector<std::uint16_t> created_flags_;
  std::vector<std::array<VertexHandle, 2>> constrained_edges_;
  std::vector<Point> moved_points_;
};

}  // namespace tetmend
