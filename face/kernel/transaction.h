// SPDX-License-Identifier: MIT
// The only way to change a program's mesh: a scope that undoes itself unless it is kept.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

#include <tetmend/api.h>

#include "face/kernel/tet_mesh.h"
#include "kernel/transaction.h"

namespace tetmend::kernel {

/// A scope for edits: undone at its end, bit for bit, unless keep() was called. Transactions nest: one
/// that is opened while another is open on the same mesh is a part of it. The outer surface of what
/// an edit replaces stays, so that of the mesh does; new tets are certified positive.
///
/// An edit that is refused has changed nothing. `inverted`: a tet would not be certified positive.
/// `constrained`: something that must stay, see TetMesh::is_fixed(), would move or vanish.
/// `not_closed`: the tets around are not those that the edit is for, or the handle is of something
/// deleted by now. All edits throw Error for a handle that the mesh never had, in a transaction that
/// was kept, and where one inside is still open; also what a TetRule throws.
class TETMEND_API Transaction {
 public:
  /// Cost: next to nothing.
  explicit Transaction(TetMesh& mesh);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;

  /// Moves a vertex. Tets that are inverted need not become positive.
  EditResult move(VertexHandle v, const Point& point);
  /// The three tets of an edge become two.
  EditResult flip_3_2(TetEdge e);
  /// The two tets of a face become three.
  EditResult flip_2_3(HalfFace f);
  /// The four tets of an edge become four around a diagonal of its ring: that of vertices 0 and 2 of
  /// TetMesh::ring(), or of 1 and 3.
  EditResult flip_4_4(TetEdge e, unsigned diagonal);
  /// Contracts the edge between two vertices: one goes, and its tets with both vanish.
  EditResult contract(VertexHandle gone, VertexHandle stays);
  /// A new vertex within an edge, a face or a tet. Invalid: it was refused, see result().
  VertexHandle split(TetEdge e, const Point& point);
  VertexHandle split(HalfFace f, const Point& point);
  VertexHandle split(TetHandle t, const Point& point);
  /// Replaces tets by others with the same outer surface: all that the above do, by hand. Vertices
  /// that no tet needs any longer go. @param created in positive order
  EditResult replace(std::span<const TetHandle> old, std::span<const TetVertices> created);
  EditResult replace(std::span<const TetHandle> old, std::initializer_list<TetVertices> created) {
    return replace(old, std::span<const TetVertices>(created.begin(), created.size()));
  }
  /// A vertex for replace() to use: keep() throws while no tet has it.
  VertexHandle add_vertex(const Point& point);

  /// What became of the last edit.
  EditResult result() const { return result_; }
  /// The tets that the last replacement or split or flip or contraction made.
  std::vector<TetHandle> created() const;
  /// The corners of all tets that the transaction has touched, as they were when it began, and as
  /// they are now. Cost: quadratic in their number, with a small factor.
  std::vector<std::array<Point, 4>> before() const;
  std::vector<std::array<Point, 4>> after() const;
  /// The live tets among them.
  std::vector<TetHandle> changed() const;

  /// What was done stays: as part of the transaction around this one, or of the mesh. No edit may
  /// follow.
  /// @throws Error where one inside is still open, or a vertex that was added has no tet
  void keep();
  /// Takes back all that was done so far. More edits may follow. @throws Error as edits do
  void undo();

 private:
  friend struct OperatorTools;  // judges what was done
  void check_usable() const;
  template <class Edit>
  EditResult make(const Edit& edit);
  EditResult refuse(EditResult result) { return result_ = result; }
  VertexHandle split(std::span<const TetHandle> old, std::span<const TetVertices> created,
                     const Point& point);
  bool may_use(VertexHandle v) const;
  Point to_work(const Point& point, std::string_view what) const;
  std::vector<std::array<Point, 4>> to_file(std::span<const std::array<Point, 4>> tets) const;

  TetMesh& mesh_;
  tetmend::Transaction inner_;
  unsigned depth_;
  std::vector<VertexHandle> added_;
  EditResult result_ = EditResult::made;
  bool kept_ = false;
};

}  // namespace tetmend::kernel
