// SPDX-License-Identifier: MIT
// A mesh in pieces: stored ones, of which each element is in one, and gathered ones, of which each
// has all tets around its vertices.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "pieces/parting.h"
#include "pieces/piece.h"
#include "pieces/piece_task.h"
#include "pieces/ranks.h"
#include "pieces/sealed_shelf.h"
#include "pieces/side_by_side.h"

namespace tetmend::pieces {

/// What all pieces have in common between two steps: little, and all that a step needs besides them.
struct DivisionState {
  Point low = Point::Zero();   ///< of the box around the mesh
  Point high = Point::Zero();  ///< likewise
  VertexId first_id = 0;       ///< of the first vertex of the file
  VertexId in_file = 0;        ///< how many the file has
  VertexId next_id = 0;        ///< of the next vertex that is added
  std::uint64_t stored = 0;    ///< number of stored pieces; 0: they are gathered
  /// By stored piece: the id of the first vertex that it has added.
  std::vector<VertexId> first_added;
  Parting parting;  ///< of the gathered pieces

  double side() const { return (high - low).maxCoeff(); }
};

void append(const DivisionState& state, std::string& bytes);
/// @throws Error when the bytes end too early, or contradict themselves.
DivisionState take_state(std::string_view& bytes);

/// What one division took.
struct Traffic {
  std::uint64_t tets = 0;      ///< that were divided
  std::uint64_t received = 0;  ///< bytes that came from other ranks
  double seconds = 0;
};

/// Stored pieces go when they are divided, gathered ones when they are stored again. Nothing but
/// the content of pieces and their number enters: not who works on them, nor when. Each piece is on
/// the shelf of one rank.
class DividedMesh {
 public:
  /// @param vertices in the file
  /// @param first_id of them; it cannot show in the result
  DividedMesh(Shelf& shelf, Ranks& ranks, VertexId vertices, VertexId first_id = 0)
      : shelf_(&shelf), ranks_(ranks) {
    state_.first_id = first_id;
    state_.in_file = vertices;
    state_.next_id = first_id + vertices;
  }
  /// Of pieces that are there: each rank has a range of them, see own().
  DividedMesh(Shelf& shelf, Ranks& ranks, DivisionState state);

  const DivisionState& state() const { return state_; }
  /// Of the box around the mesh.
  double diagonal() const { return (state_.high - state_.low).stableNorm(); }
  Ranks& ranks() const { return ranks_; }
  /// Ids from that on are of vertices that were added.
  VertexId first_added() const { return state_.first_id + state_.in_file; }
  /// How many pieces are read and divided at a time; one, unless that is set. For one rank, and a shelf
  /// that may be read by several threads.
  void set_side_by_side(std::size_t most) { side_by_side_ = SideBySide(most); }
  /// The pieces of this rank, ascending: the stored ones, or where there are none the gathered ones.
  const std::vector<std::size_t>& own() const { return own_; }

  /// A slice of the file, whose ids are numbers in the file. Their numbers, from 0 on, are in their
  /// order there, whoever adds them. Each vertex is marked as its own in one.
  void add_slice(std::size_t number, Piece slice);
  /// Called with each slice before it is added: may mark its tets.
  void set_slice_marker(std::function<void(Piece&)> marker) { marker_ = std::move(marker); }
  /// All ranks, when all slices are there.
  void end_slices();
  /// All ranks: cuts the shifted curve into stretches with as many vertices of the stored pieces.
  Parting cut(std::size_t pieces, unsigned shift) const;
  /// All ranks: divides the stored pieces by the shifted curve.
  /// @param next where the gathered pieces go; the stored ones stay where they are then. Null: they go.
  void divide(std::size_t pieces, unsigned shift, Shelf* next = nullptr);
  /// The same, but what is not so many edges from a border of the last division, or nearer, stays with
  /// the part that has it: see rest(). Precondition: it has been divided in as many pieces.
  void divide_near_borders(unsigned shift, unsigned rings, Shelf* next = nullptr);
  /// Likewise: what is in no zone stays.
  void divide_zones(ZoneMap zones, Shelf* next = nullptr);
  std::size_t parts() const { return state_.parting.parts(); }
  /// Precondition: it has been divided, and this one was not stored since.
  Piece gathered(std::size_t part) const;
  /// What has stayed with that part in the last division, in several pieces.
  std::vector<Piece> rest(std::size_t part) const;
  /// All that this part has: gathered and the rest, or stored and what it has kept.
  std::vector<Piece> all_of(std::size_t part) const;
  /// Beside the gathered piece of that number, which stays until it is removed.
  void store(std::size_t part, const Piece& piece);
  void remove_gathered(std::size_t part);
  /// After all are stored: their new vertices get numbers. `added` is by part.
  void number_added(const std::vector<std::uint64_t>& added);
  /// A stored piece; of several where something has stayed, the one that was worked on.
  Piece stored(std::size_t part) const;
  /// The ids of its vertices, ascending.
  std::vector<VertexId> stored_ids(std::size_t part) const;
  /// Its vertices from the one that is `begin` of these to `end`, without what lies between them.
  Piece stored_vertices(std::size_t part, std::size_t begin = 0,
                        std::size_t end = std::numeric_limits<std::size_t>::max()) const;
  /// Copies the stored pieces of this rank.
  void copy_stored(Shelf& to) const;
  /// Copies the pieces of this rank, stored or gathered, from a shelf that has those of all.
  /// @throws Error when one is not there, or damaged.
  void take_from(const SealedShelf& from);
  /// All ranks: vertices of the whole mesh by the ball of the zones that they lie in; last, how many
  /// there are in all. Precondition: its pieces are stored.
  std::vector<std::int64_t> count_vertices(const ZoneMap& zones) const;
  /// All ranks: the first has all stored pieces then.
  void bring_to_first();
  /// Of this rank, by division.
  const std::vector<Traffic>& traffic() const { return traffic_; }

 private:
  struct Message {
    std::size_t target = 0;
    bool is_rest = false;
    std::string bytes;
  };
  /// All that a stored part sends.
  struct SentPart {
    std::size_t part = 0;
    std::uint64_t tets = 0;
    std::vector<Message> messages = {};
  };
  std::vector<Point> points_of(std::size_t part) const;
  std::size_t most_own() const;
  void send_all(Parting parting, unsigned rings, Shelf* next);
  SentPart messages_of(std::size_t part, unsigned rings) const;
  std::vector<std::string> send_out(std::vector<Message> messages,
                                    const std::vector<std::uint32_t>& owners, Shelf& next) const;
  std::vector<Piece> all_stored(std::size_t part) const;
  void keep(std::string_view messages, Shelf& next);
  void number(std::size_t part, std::vector<VertexId>& ids) const;
  void own_those_of(const std::vector<std::uint32_t>& owners);

  Shelf* shelf_;
  Ranks& ranks_;
  DivisionState state_;
  std::vector<std::size_t> own_;
  std::function<void(Piece&)> marker_;
  bool has_box_ = false;
  SideBySide side_by_side_;
  std::vector<Traffic> traffic_;
};

/// Which rank has which part: neighbours on the curve together, zones where least is.
std::vector<std::uint32_t> owners_of(const Parting& parting, std::size_t ranks);

}  // namespace tetmend::pieces
