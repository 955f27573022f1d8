// SPDX-License-Identifier: MIT
// Gmsh's format `.msh` of version 4.1, as text or bytes, read slice by slice.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "kernel/formats/gmsh_layout.h"
#include "pieces/file_slices.h"
#include "pieces/number_order.h"

namespace tetmend::pieces {

/// A file as scan_gmsh() knows it. Nodes and elements may stand in any order: their numbers decide,
/// as in read_gmsh().
class GmshSlices final : public FileSlices {
 public:
  /// All ranks: each looks at some of the file, to see whether all of it can be read.
  /// @returns null for another file, or a damaged one: read_mesh() tells what is wrong
  static std::unique_ptr<FileSlices> open(const std::filesystem::path& file, Ranks& ranks);

  MeshData digest() const override;
  bool has_walls() const override { return !walls_.empty(); }

 protected:
  void read_elements(const Share& of, FileElements& elements) const override;
  void read_vertices(Piece& slice) const override;

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
  template <class Element>
  void read_kind(formats::GmshLayout::Kind kind, const FileRange& range,
                 std::vector<FileElement<Element>>& elements) const;

  std::filesystem::path file_;
  formats::GmshLayout layout_;
  std::array<std::vector<NumberFacts>, 4> facts_;  // by kind and chunk
  std::array<NumberOrder, 4> orders_;              // by kind
  std::vector<std::array<VertexId, 3>> walls_;     // behind the triangles of the file
};

}  // namespace tetmend::pieces
