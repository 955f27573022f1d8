// SPDX-License-Identifier: MIT
// A mesh in pieces: stored ones, of which each element is in one, and gathered ones, of which each
// has all tets around its vertices.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "pieces/parting.h"
#include "pieces/piece.h"
#include "pieces/piece_task.h"
#include "pieces/shelf.h"

namespace tetmend::pieces {

/// What all pieces have in common between two steps: little, and all that a step needs besides them.
struct DivisionState {
  Point low = Point::Zero();   ///< of the box around the mesh
  Point high = Point::Zero();  ///< likewise
  VertexId next_id = 0;        ///< of the next vertex that is added
  std::uint64_t stored = 0;    ///< number of stored pieces
  /// By stored piece: the id of the first vertex that it has added.
  std::vector<VertexId> first_added;
  Parting parting;  ///< of the gathered pieces
};

/// Stored pieces go when they are divided, gathered ones when they are stored again. Nothing but
/// the content of pieces and their number enters: not who works on them, nor when.
class DividedMesh {
 public:
  /// @param vertices in the file
  DividedMesh(Shelf& shelf, VertexId vertices) : shelf_(shelf) { state_.next_id = vertices; }
  DividedMesh(Shelf& shelf, DivisionState state) : shelf_(shelf), state_(std::move(state)) {}

  const DivisionState& state() const { return state_; }

  /// A slice of the file; slices come in their order. Each vertex is marked as its own in one.
  void add_slice(const Piece& slice);
  /// Divides the stored pieces by the shifted curve, and zones where there are any.
  void divide(std::size_t pieces, unsigned shift, ZoneMap zones = {});
  std::size_t parts() const { return state_.parting.parts(); }
  /// Precondition: it has been divided, and this one was not stored since.
  Piece gathered(std::size_t part) const;
  /// In the place of the gathered piece of that number.
  void store(std::size_t part, const Piece& piece);
  /// After all are stored: their new vertices get numbers. `added` is by part.
  void number_added(const std::vector<std::uint64_t>& added);
  /// A stored piece.
  Piece stored(std::size_t part) const;

 private:
  Parting make_parting(std::size_t pieces, unsigned shift, ZoneMap zones) const;
  void send(const Piece& piece);

  Shelf& shelf_;
  DivisionState state_;
};

}  // namespace tetmend::pieces
