// SPDX-License-Identifier: MIT
// The only way to change a mesh: edits inside a scope that undoes itself unless it is kept.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tetmend/api.h>

#include "kernel/surface_guard.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

class Workspace;
struct Edit;
struct TransactionPast;

/// Why an edit was not made. The mesh is unchanged unless `made`.
enum class EditResult : std::uint8_t {
  made,
  /// A new tet is not certified positive or, in a folded mesh, has a face that exists elsewhere
  /// already. Or a move would turn a positive tet over.
  inverted,
  /// A constrained face, edge or vertex, a frozen tet, or a border between labels would vanish. Or
  /// a fixed vertex would move.
  constrained,
  no_room,  ///< no free slot left in the territory of the workspace, or the edit reaches out of it
  not_closed  ///< old and new tets do not have the same outer surface (a mistake of the caller)
};

/// A vertex, where it is to go, and its link (see star.h).
struct TETMEND_API VertexMove {
  VertexHandle vertex;
  Point point;
  std::span<const HalfFace> link;
};

/// A scope for edits. Transactions nest: one opened while another is open on the same workspace is
/// its child. Undo restores every slot of the mesh bit for bit, handle numbers included. The
/// outermost keep() writes the workspace's date to the vertices around all changes and forgets the
/// journal. Whatever reaches out of the territory of the workspace is refused: `no_room`.
///
/// An edit takes all memory that it and its undo need before its first write. So one that throws,
/// which is std::bad_alloc, has changed nothing, and neither keep() nor undo() can fail.
class TETMEND_API Transaction {
 public:
  Transaction(TetMesh& mesh, Workspace& workspace);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;

  const TetMesh& mesh() const { return mesh_; }

  /// Replaces the tets `old` by new ones that fill the same cavity. Vertices that no tet needs any
  /// longer are deleted; new tets take over the label, the constraints and, where possible, the
  /// slots of the old. New tets must be certified positive. Preconditions: old tets are live and
  /// distinct; new vertices are live, and those that are not in `old` have no tet yet. Cost: linear
  /// in the number of tets; allocates only when a buffer or the mesh outgrows its largest size so
  /// far.
  EditResult replace_cavity(std::span<const TetHandle> old, std::span<const TetVertices> created);

  /// The same where the surface may change, for a mesh that has a guard: the old tets may lie in
  /// several regions, their faces on the boundary and between labels may give way to others, and
  /// vertices there may vanish. `labels` has that of each new tet. `constrained` where the guard
  /// refuses; `not_closed` where the old and new faces do not have the same border.
  EditResult replace_at_surface(std::span<const TetHandle> old,
                                std::span<const TetVertices> created,
                                std::span<const Label> labels);

  /// Handles of the tets that the last successful replace_cavity created, in the order given to it.
  std::span<const TetHandle> created() const;

  /// A new vertex without tets. It becomes part of the mesh by a replace_cavity that uses it.
  /// Invalid when the territory of the workspace has no free slot left.
  VertexHandle add_vertex(const Point& point);

  /// Moves a vertex that is not fixed and updates the qualities of its star, given as the link (see
  /// star.h). A tet of positive quality must stay certified positive.
  /// `not_closed` without a link.
  EditResult move_vertex(VertexHandle v, const Point& point, std::span<const HalfFace> link);
  /// The same, for who has not looked at the link yet.
  EditResult move_vertex(VertexHandle v, const Point& point);
  /// Moves several different vertices at once, all or none: tets need to be positive only when all
  /// are in place.
  EditResult move_vertices(std::span<const VertexMove> moves);
  /// As move_vertices(), for vertices that may lie on a surface whose guard lets them move.
  EditResult move_at_surface(std::span<const VertexMove> moves);
  /// Moves many different vertices at once, all or none. Any tet may turn over, if afterwards fewer
  /// of those around are not certified positive. Cost: linear; asks for exact signs where the
  /// certificate fails.
  EditResult rearrange_vertices(std::span<const VertexMove> moves);

  bool empty() const;

  /// Ascending quality vectors of all that this transaction has touched: as it was when the
  /// transaction began, and as it is now.
  void compare(std::vector<Quality>& before, std::vector<Quality>& now) const;
  /// The live tets among them, each once, in the order in which they were first touched.
  void list_changed(std::vector<TetHandle>& out) const;
  /// The same values in no particular order.
  void list_qualities(std::vector<Quality>& before, std::vector<Quality>& now) const;
  /// The corners of all tets that it has touched, as they were when it began and as they are now.
  struct Tets {
    std::span<const std::array<Point, 4>> before;
    std::span<const std::array<Point, 4>> now;
    std::span<const TetVertices> vertices_before;  // of the same tets
    std::span<const TetVertices> vertices_now;
  };
  /// Valid until the next question or edit. Cost: quadratic in the number of tets, with a small
  /// factor.
  Tets tets() const;
  /// True if it made the mesh grow, to more tets than the workspace allows.
  bool has_too_many_tets() const;
  /// The edges of its new tets that were not there when it began, with both ends in their places;
  /// of these some repeat. Cost: quadratic in the number of tets.
  void list_new_edges(std::vector<std::array<VertexHandle, 2>>& out) const;
  /// By the places of their ends, each once: the edges that were there when it began and are no more,
  /// and those that are there now and were not. One whose end moved is among both. Cost: quadratic in
  /// the number of tets, with a small factor.
  void list_changed_edges(std::vector<std::array<Point, 2>>& before,
                          std::vector<std::array<Point, 2>>& now) const;

  /// Makes the edits part of the enclosing transaction, or of the mesh if there is none. No edit
  /// may follow.
  void keep() noexcept;
  /// Undoes all edits of this scope now. More may follow.
  void undo() noexcept;

 private:
  TransactionPast& past() const;
  EditResult check_old(std::span<const TetHandle> old);
  EditResult check_vertices(std::span<const TetHandle> old, std::span<const TetVertices> created);
  EditResult evaluate(std::span<const TetVertices> created);
  EditResult glue(std::span<const TetHandle> old, std::span<const TetVertices> created);
  bool repeats_a_face(std::span<const TetVertices> created);
  bool mark_constrained_edges(std::span<const TetVertices> created);
  std::uint32_t make_room(std::size_t old, std::size_t created);
  void make_room(std::span<const VertexMove> moves);
  void write_cavity(std::span<const TetHandle> old, std::span<const TetVertices> created,
                    std::span<const Label> labels, Edit edit) noexcept;
  void save_removed(std::span<const TetHandle> old, Edit& edit);
  void take_slots(std::span<const TetHandle> old, std::size_t count, Edit& edit);
  void fill_slots(std::span<const TetVertices> created, std::span<const Label> labels,
                  const Edit& edit);
  void link_vertices(std::span<const TetVertices> created, Edit& edit);
  void remove_isolated(const Edit& edit);
  void note(const Edit& edit);
  void evaluate(std::span<const VertexMove> moves);
  bool turns_over(std::span<const VertexMove> moves) const;
  bool has_fixed(std::span<const VertexMove> moves) const;
  void place(std::span<const VertexMove> moves);
  void put_back(std::span<const VertexMove> moves);
  void note_move(const VertexMove& move, const Point& before, std::size_t first_of_batch,
                 bool surface = false);
  // Where the surface may change.
  bool ask_guard();
  bool may_change(VertexHandle v) const;
  SurfaceFace surface_face(HalfFace f) const;
  EditResult check_old_at_surface(std::span<const TetHandle> old);
  EditResult check_vertices_at_surface(std::span<const TetHandle> old,
                                       std::span<const TetVertices> created);
  EditResult pair_new_faces(std::span<const TetVertices> created, std::span<const Label> labels);
  EditResult pair_old_faces(std::span<const TetHandle> old, std::span<const Label> labels);
  EditResult pair_old_face(HalfFace f, std::span<const Label> labels);
  void add_outer_faces(std::span<const TetVertices> created);
  void add_new_face(std::uint32_t number, std::span<const TetVertices> created, bool interface);
  void drop_unchanged_faces();
  EditResult check_edges_at_surface(std::span<const TetVertices> created);
  void mark_surface(std::span<const TetVertices> created);
  void list_new_flags();
  void set_flags(Edit& edit) noexcept;
  bool list_faces_of(std::span<const VertexMove> moves, std::vector<SurfaceFace>& faces) const;
  void clear_slot(TetHandle t);
  void clear_slot(VertexHandle v);
  void undo_replace(const Edit& edit);
  void undo_move(const Edit& edit);
  void undo_add(const Edit& edit);
  void undo_remove(const Edit& edit);
  void commit();

  TetMesh& mesh_;
  Workspace& workspace_;
  std::size_t first_edit_;
  std::size_t tets_before_;
  bool kept_ = false;
};

}  // namespace tetmend
