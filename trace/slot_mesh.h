// SPDX-License-Identifier: MIT
// A mesh by slots, without adjacency: what replay changes and viewers draw.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/mesh_data.h"
#include "kernel/tet_mesh.h"
#include "trace/byte_stream.h"

namespace tetmend {

/// The same handle numbers as in the TetMesh that it shows. Reading is safe from any thread.
class SlotMesh {
 public:
  SlotMesh() = default;
  explicit SlotMesh(const TetMesh& mesh);

  std::size_t tet_slots() const { return tets_.size(); }
  std::size_t vertex_slots() const { return points_.size(); }
  std::size_t tet_count() const { return tet_count_; }
  std::size_t vertex_count() const { return vertex_count_; }
  /// True also for slots beyond the last.
  bool is_deleted(TetHandle t) const {
    return t.index() >= tets_.size() || !tets_[t.index()][0].is_valid();
  }
  bool is_deleted(VertexHandle v) const { return v.index() >= points_.size() || !live_[v.index()]; }
  const TetVertices& vertices(TetHandle t) const { return tets_[t.index()]; }
  /// In lengths that are worked with: see scale().
  const Point& point(VertexHandle v) const { return points_[v.index()]; }
  /// As of the TetMesh.
  const Scale& scale() const { return scale_; }
  Label label(TetHandle t) const { return labels_[t.index()]; }
  /// By which tets are judged.
  const Standard& standard() const { return standard_; }
  void set_standard(const Standard& standard) { standard_ = standard; }
  /// Computed from the points, or what the trace noted of them: the bits that TetMesh::quality()
  /// had.
  Quality quality(TetHandle t) const;

  /// What the file of the mesh named: these never change. Vertices by slot.
  std::span<const MeshData::Triangle> triangles() const { return triangles_; }
  std::span<const MeshData::Edge> edges() const { return edges_; }
  std::span<const std::uint32_t> required_vertices() const { return required_vertices_; }
  /// Tets that the user wants to stay as they are, by slot, ascending: these never change, either.
  std::span<const std::uint32_t> frozen_tets() const { return frozen_tets_; }

  /// Live vertices and tets in the order of their slots, with what the file named; points as a file
  /// has them.
  MeshData to_data() const;
  /// The tets listed and what they need; of what the file named, the part all of whose vertices
  /// are there. `vertex_slots` gets the slot of each point.
  MeshData extract(std::span<const TetHandle> tets,
                   std::vector<std::uint32_t>* vertex_slots = nullptr) const;

  /// By a measure of a program: the qualities of all tets, by slot, as the run had them when it
  /// began. Else empty, and of older traces.
  std::span<const Quality> noted_qualities() const { return noted_qualities_; }
  void forget_noted_qualities() { noted_qualities_ = {}; }

  /// A number that tells meshes apart: of handles, points and labels of all that is live.
  std::uint64_t fingerprint() const;
  std::size_t bytes() const;

  void encode(ByteWriter& out) const;
  /// Every tet has four live vertices. That they fit together is for TraceAudit to see.
  /// @throws ByteReader::Damage
  static SlotMesh decode(ByteReader& in);
  /// @throws ByteReader::Damage unless these are four live vertices, each another.
  void check_corners(const TetVertices& tet) const;
  /// @throws ByteReader::Damage where a place is beyond the doubles in lengths of the file.
  void check_place(const Point& point) const;

  // For replay: contents of slots, which come into being as needed. An invalid first vertex
  // deletes a tet.
  void set_tet(TetHandle t, const TetVertices& vertices, Label label);
  void set_vertex(VertexHandle v, bool live, const Point& point);

 private:
  void decode_vertices(ByteReader& in);
  void decode_tets(ByteReader& in);
  void decode_noted_qualities(ByteReader& in);

  Standard standard_ = Standard(Goal{});
  std::vector<TetVertices> tets_;
  std::vector<Label> labels_;
  Scale scale_;
  std::vector<Point> points_;
  std::vector<std::uint8_t> live_;
  std::size_t tet_count_ = 0;
  std::size_t vertex_count_ = 0;
  std::vector<MeshData::Triangle> triangles_;
  std::vector<MeshData::Edge> edges_;
  std::vector<std::uint32_t> required_vertices_;
  std::vector<std::uint32_t> frozen_tets_;
  std::vector<Quality> noted_qualities_;
};

/// By which tets are drawn that were never made: a measure of a program is known of those that
/// were.
Standard standard_of_drawings(const SlotMesh& mesh);

/// Of all live tets, by slot.
std::vector<Quality> qualities_of_tets(const TetMesh& mesh);
std::vector<Quality> qualities_of_tets(const SlotMesh& mesh);

/// As of a TetMesh.
bool misses_goal(const SlotMesh& mesh, TetHandle t);

}  // namespace tetmend
