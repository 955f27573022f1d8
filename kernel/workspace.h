// SPDX-License-Identifier: MIT
// What one worker needs beside the mesh: free slots, journal, visit marks, scratch buffers.
#pragma once

#include <span>
#include <vector>

#include "kernel/edit.h"
#include "kernel/face_table.h"
#include "kernel/index_set.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

/// Scratch of one worker. The mesh holds nothing of the kind, so reading it is safe from any
/// thread. A workspace belongs to one mesh; garbage collection and sorting of the mesh make it
/// invalid.
class Workspace {
 public:
  /// Collects the free slots of the mesh; notes whether it has tets that are not positive. Cost:
  /// linear in the slots.
  explicit Workspace(const TetMesh& mesh);

  /// The date that commits write to the vertices around a change.
  Date date() const { return date_; }
  /// Precondition: no transaction is open.
  void set_date(Date date) { date_ = date; }

  // Buffers of the walks in star.h.
  IndexSet star_set;
  std::vector<HalfFace> link_buffer;
  std::vector<HalfFace> search_buffer;
  std::vector<TetHandle> star_buffer;
  std::vector<VertexHandle> ring_buffer;

 private:
  friend class Transaction;

  Date date_ = 1;
  Journal journal_;
  unsigned depth_ = 0;  // open transactions
  std::vector<TetHandle> free_tets_;
  std::vector<VertexHandle> free_vertices_;
  bool may_overlap_ =
      false;  // the mesh had tets of no positive quality when the workspace was made

  // Buffers of Transaction.
  IndexSet cavity_set_;
  IndexSet vertex_set_;
  IndexSet touched_set_;
  FaceTable face_table_;
  struct Gluing {
    HalfFace twin;  // of a new face: number and face of another new tet if local, else what lies
                    // outside the cavity
    bool local;
    bool constrained;
  };
  std::vector<Gluing> gluing_;
  std::vector<Quality> created_quality_;
  std::vector<std::uint16_t> created_flags_;
  std::vector<std::array<VertexHandle, 2>> constrained_edges_;
};

}  // namespace tetmend
