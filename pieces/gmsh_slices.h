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

 protected:
  void read_elements(const Share& of, FileElements& elements) const override;
  void read_vertices(Piece& slice) const override;

 private:
  bool share_layout(Ranks& ranks);
  bool look_at(formats::GmshLayout::Kind kind, Ranks& ranks);
  bool is_finer_than_labels(formats::GmshLayout::Kind kind) const;
  template <class Element>
  void read_kind(formats::GmshLayout::Kind kind, const FileRange& range,
                 std::vector<FileElement<Element>>& elements) const;

  std::filesystem::path file_;
  formats::GmshLayout layout_;
  std::array<std::vector<NumberFacts>, 4> facts_;  // by kind and chunk
  std::array<NumberOrder, 4> orders_;              // by kind
};

}  // namespace tetmend::pieces
