// SPDX-License-Identifier: MIT
// Gmsh's format `.msh` of version 4.1, as text or bytes, read slice by slice.
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "kernel/formats/gmsh_layout.h"
#include "pieces/file_slices.h"
#include "pieces/number_order.h"

namespace tetmend::pieces {

/// An element of one node.
struct GmshPointElement {
  VertexId vertex = 0;  ///< number in the file
  Label entity = 0;
  bool is_in_group = false;
};

/// What a file has besides its mesh, as far as that is small. Elements are of the entities that rows name, or
/// where these have none, that of their label.
struct GmshExtras {
  MeshData head;                                    ///< entities and groups
  std::array<std::map<Label, Label>, 4> entity_of;  ///< by dimension and label
  std::vector<GmshPointElement> points;
};

/// The entity that rows have for triangles that the file does not name.
inline constexpr Label kWall = std::numeric_limits<Label>::min();

/// A file as scan_gmsh() knows it. Nodes and elements may stand in any order: their numbers decide,
/// as in read_gmsh().
class GmshSlices final : public FileSlices {
 public:
  /// All ranks: each looks at some of the file, to see whether all of it can be read.
  /// @returns null for another file, or a damaged one: read_mesh() tells what is wrong
  static std::unique_ptr<FileSlices> open(const std::filesystem::path& file, Ranks& ranks);

  MeshData digest() const override;
  bool has_walls() const override { return !walls_.empty(); }

  /// Where all entities are in the list of the file, and points that are elements vertices of it. Rows name
  /// the entities, of vertices with the dimension before.
  bool has_all_in_rows() const override { return is_listed_; }
  ByKind<RowLayout> row_layouts() const override;
  std::string row_of_new_vertex() const override;
  GmshExtras extras() const;

 protected:
  void read_elements(const Share& of, FileElements& elements) const override;
  void read_vertices(Piece& slice) const override;
  void read_rows(const Share& of, const std::vector<VertexId>& ids,
                 ByKind<std::string>& rows) const override;

 private:
  bool share_layout(Ranks& ranks);
  bool look_at(formats::GmshLayout::Kind kind, Ranks& ranks);
  bool is_finer_than_labels(formats::GmshLayout::Kind kind) const;
  void share_walls(Ranks& ranks);
  std::vector<bool> vertices_of_several_parts() const;
  std::vector<std::array<VertexId, 3>> find_walls() const;
  /// Calls act(row, block) for each row of some chunks, where a row is its number and its vertices.
  template <class Act>
  void for_rows(formats::GmshLayout::Kind kind, const std::vector<std::size_t>& chunks,
                const Act& act) const;
  /// Calls act(place, row, block) for each element of a range: its place there, its number and the numbers of
  /// its nodes.
  template <class Act>
  void for_range(formats::GmshLayout::Kind kind, const FileRange& range, const Act& act) const;
  /// Calls act(i, row, chunk) for the nodes with these ids: which of the ids, and which row of a chunk.
  template <class Read, class Act>
  void for_nodes(const std::vector<VertexId>& ids, const Read& read, const Act& act) const;
  template <class Element>
  void read_kind(formats::GmshLayout::Kind kind, const FileRange& range,
                 std::vector<FileElement<Element>>& elements) const;
  bool is_listed(int dimension, Label entity) const;
  bool read_point_elements();
  bool look_at_entities();

  std::filesystem::path file_;
  formats::GmshLayout layout_;
  std::array<std::vector<NumberFacts>, 4> facts_;  // by kind and chunk
  std::array<NumberOrder, 4> orders_;              // by kind
  std::vector<std::array<VertexId, 3>> walls_;     // behind the triangles of the file
  MeshData head_;                                  // entities and groups
  std::vector<GmshPointElement> point_elements_;   // in the order of their numbers
  bool is_listed_ = false;
};

}  // namespace tetmend::pieces
