// SPDX-License-Identifier: MIT
// What one worker needs besides the mesh: free slots, journal, visit marks, scratch buffers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <tetmend/api.h>

#include "kernel/edit.h"
#include "kernel/face_table.h"
#include "kernel/index_set.h"
#include "kernel/territory.h"
#include "kernel/tet_batch.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

/// What a transaction has changed, for those who ask.
struct TransactionPast {
  struct Place {
    VertexHandle vertex;
    Point point;  // of a vertex that moved or went; any for a new one
  };
  std::vector<Place> displaced;
  std::vector<TetHandle> made;  // slots whose tet was not there
  std::vector<TetVertices> removed;
  std::vector<TetHandle> changed;  // live
  std::vector<std::array<Point, 4>> before;
  std::vector<std::array<Point, 4>> now;
  std::vector<TetVertices> vertices_before;
  std::vector<TetVertices> vertices_now;

  std::vector<Place>::const_iterator find(VertexHandle v) const {
    return std::find_if(displaced.begin(), displaced.end(),
                        [v](const Place& place) { return place.vertex == v; });
  }
  bool is_displaced(VertexHandle v) const { return find(v) != displaced.end(); }
  bool was_made(TetHandle t) const { return std::find(made.begin(), made.end(), t) != made.end(); }
};

/// The working memory of one worker. The mesh holds nothing of the kind, so any thread may read it.
/// A workspace belongs to one mesh; garbage collection and sorting of the mesh make it invalid.
class TETMEND_API Workspace {
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
  /// A transaction has refused an edit that reaches out of the territory, since the last call. Whoever
  /// asks for one has not asked where the territory ends.
  bool take_reached_out() { return std::exchange(reached_out_, false); }
  void note_reached_out() { met_border_ = reached_out_ = true; }

  /// Slots without a tet or vertex, of which a mesh makes new ones.
  struct FreeSlots {
    std::vector<TetHandle> tets;
    std::vector<VertexHandle> vertices;
  };
  static constexpr std::size_t kAnyNumber = std::numeric_limits<std::size_t>::max();
  /// From now on judges refuse what makes the mesh grow beyond that many tets.
  void set_most_tets(std::size_t tets) { most_tets_ = tets; }
  std::size_t most_tets() const { return most_tets_; }
  /// No judge accepts one more tet.
  bool is_full(const TetMesh& mesh) const {
    if (territory_.is_whole()) return mesh.tet_count_ >= most_tets_;
    return static_cast<std::ptrdiff_t>(more_tets_ - most_more_tets_) >= 0;
  }

  /// From now on the worker keeps to a territory and makes new tets and vertices of these slots
  /// only; the mesh does not grow. Exchanges the free slots of the workspace for `slots`. Judges
  /// refuse what makes the territory grow by more than `more_tets`. Precondition: no transaction is
  /// open.
  void enter(const Territory& territory, FreeSlots& slots, std::size_t more_tets = kAnyNumber);
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
  std::vector<HalfFace> search_buffer;

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
  bool has_too_many_tets(const TetMesh& mesh) const {
    if (territory_.is_whole()) return mesh.tet_count_ > most_tets_;
    return static_cast<std::ptrdiff_t>(more_tets_ - most_more_tets_) > 0;
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
  bool reached_out_ = false;
  // What a territory's work changes the counts of the mesh by; modulo 2^64.
  std::size_t more_tets_ = 0;
  std::size_t more_vertices_ = 0;
  std::size_t most_tets_ = kAnyNumber;  // of the whole mesh
  std::size_t most_more_tets_ = 0;      // what more_tets_ may become in the territory
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
  TransactionPast past_;
  TetBatch batch_;  // the tets that an edit makes or moves
  std::vector<std::uint16_t> created_flags_;
  std::vector<std::array<VertexHandle, 2>> constrained_edges_;
  std::vector<Point> moved_points_;

  // Of a surface that may change.
  /// Made when it is first needed; a copy of the workspace makes its own.
  struct OwnJournal : std::unique_ptr<SurfaceJournal> {
    OwnJournal() = default;
    OwnJournal(const OwnJournal&) : std::unique_ptr<SurfaceJournal>() {}
    OwnJournal(OwnJournal&&) noexcept = default;
    OwnJournal& operator=(const OwnJournal&) { return *this; }
    OwnJournal& operator=(OwnJournal&&) noexcept = default;
    using std::unique_ptr<SurfaceJournal>::operator=;
  };
  OwnJournal surface_journal_;
  std::vector<SurfaceFace> faces_before_, faces_after_;
  std::vector<std::uint8_t> is_interface_;  // of each face after
  std::vector<std::uint32_t> outer_faces_;  // of the new tets, by number
  std::vector<Journal::VertexFlags> new_flags_;
};

}  // namespace tetmend
