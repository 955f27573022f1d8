// SPDX-License-Identifier: MIT
// Files that are read slice by slice: no process ever has all of one in memory.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "kernel/formats/file_bytes.h"
#include "pieces/divided_mesh.h"
#include "pieces/row_source.h"

namespace tetmend::pieces {

using formats::FileBytes;

/// What a file has.
struct FileCounts {
  std::uint64_t vertices = 0;
  std::uint64_t tets = 0;
  std::uint64_t triangles = 0;
  std::uint64_t edges = 0;
  std::uint64_t required_vertices = 0;
};

/// An element whose vertices have their numbers in the file.
template <class Element>
struct FileElement {
  Element element;
  std::array<VertexId, std::tuple_size_v<decltype(Element::vertices)>> vertices{};
};

template <std::size_t N>
bool has_repeated(std::array<VertexId, N> vertices) {
  std::sort(vertices.begin(), vertices.end());
  return std::adjacent_find(vertices.begin(), vertices.end()) != vertices.end();
}

/// Adds the numbers of their vertices to `ids`.
template <class Element>
void note_ids(const std::vector<FileElement<Element>>& elements, std::vector<VertexId>& ids) {
  for (const auto& each : elements)
    ids.insert(ids.end(), each.vertices.begin(), each.vertices.end());
}

/// Names vertices by their places among `ids`, which ascend.
template <class Element>
void take_elements(const std::vector<FileElement<Element>>& from, const std::vector<VertexId>& ids,
                   std::vector<Element>& to) {
  to.reserve(from.size());
  for (const auto& each : from) {
    Element element = each.element;
    for (std::size_t i = 0; i < each.vertices.size(); ++i) {
      const auto found = std::lower_bound(ids.begin(), ids.end(), each.vertices[i]);
      element.vertices[i] = static_cast<std::uint32_t>(found - ids.begin());
    }
    to.push_back(element);
  }
}

/// Those of a slice.
struct FileElements {
  std::vector<FileElement<PieceTet>> tets;
  std::vector<FileElement<MeshData::Triangle>> triangles;
  std::vector<FileElement<MeshData::Edge>> edges;
};

/// @throws Error: a file is not any more what it was when it was opened
[[noreturn]] void fail_changed(const std::filesystem::path& file);

class FileSlices : public RowSource {
 public:
  const FileCounts& counts() const { return counts_; }
  /// All ranks: each adds its share, about so many tets at a time. Without end_slices().
  /// @throws Error when the file has changed, or has a number out of range
  void add_to(DividedMesh& mesh, std::size_t tets_of_slice) const;
  /// What read_mesh() would say of it, but for vertices and elements: of these only some that have
  /// the labels and parts that there are.
  virtual MeshData digest() const { return {}; }
  /// There are triangles that the file does not name: walls between parts of one label.
  virtual bool has_walls() const { return false; }

  /// Rows and the name of the labels' array tell all that the file holds besides its mesh.
  virtual bool has_all_in_rows() const { return false; }
  /// The same, and rows are arrays of the file.
  virtual bool has_only_arrays() const { return false; }
  std::uint64_t slice_count(std::size_t tets_of_slice, const Ranks& ranks) const override;
  /// Those that add_to() adds.
  void for_row_slices(
      std::size_t tets_of_slice, const Ranks& ranks,
      const std::function<void(std::uint64_t number, RowSlice slice)>& use) const override;

 protected:
  /// The elements of a slice, in their order. `of` has its range of each kind, and of vertices.
  struct Share {
    FileRange vertices, tets, triangles, edges;
  };
  virtual void read_elements(const Share& of, FileElements& elements) const = 0;
  /// Gives points, labels and marks to a piece that has ids, ascending; but for kOwn.
  virtual void read_vertices(Piece& slice) const = 0;
  /// Appends the rows of these elements, in their order, and of points by ascending numbers.
  virtual void read_rows(const Share&, const std::vector<VertexId>&, ByKind<std::string>&) const {}

  FileCounts counts_;

 private:
  Share share_of(std::uint64_t i, std::uint64_t slices) const;
  Piece read_slice(std::uint64_t i, std::uint64_t slices) const;
};

/// Opens a file of a format that can be read so: `.meshb`, `.msh`, `.vtu`. All ranks.
/// @param label_array as for read_mesh()
/// @returns null for any other file, and for one that only read_mesh() understands or complains of
std::unique_ptr<FileSlices> open_slices(const std::filesystem::path& file,
                                        const std::string& label_array, Ranks& ranks);

}  // namespace tetmend::pieces
