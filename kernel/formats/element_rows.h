// SPDX-License-Identifier: MIT
// Elements of any kind, row by row: where a reader puts them, and how a writer sees them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/formats/element_kinds.h"
#include "kernel/formats/tet_place.h"
#include "kernel/formats/text_reader.h"
#include "kernel/formats/text_rows.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"

namespace tetmend::formats {

/// One element as it stands in a file.
struct ElementRow {
  const ElementKind* kind = nullptr;
  Label label = 0;
  std::int64_t number = 0;
  const char* place = nullptr;  ///< in the file
  std::array<std::uint32_t, kMostVerticesOfElement> vertices{};
};

/// Puts elements where MeshData has their kind.
class ElementSorter {
 public:
  explicit ElementSorter(MeshData& mesh) : mesh_(mesh) { place_of_kind_.fill(kNone); }

  /// Numbers are kept if `with_numbers`, all or none.
  void add(const ElementRow& row, bool with_numbers = false);
  /// The list of a kind that is no tet, triangle or edge of first order; made if need be.
  OtherElements& others(const ElementKind& kind);

 private:
  static constexpr std::size_t kNone = SIZE_MAX;

  MeshData& mesh_;
  std::array<std::size_t, kElementKinds.size()> place_of_kind_{};
};

/// Reads `count` rows, several at once: read(text, row) fills each, take(row) gets them in order.
template <class Read, class Take>
void read_element_rows(TextReader& text, std::size_t count, const Read& read, const Take& take) {
  constexpr std::size_t kAtOnce = std::size_t{1} << 16;
  std::vector<ElementRow> rows(std::min(count, kAtOnce));
  for (std::size_t done = 0; done < count; done += rows.size()) {
    rows.resize(std::min(rows.size(), count - done));
    read_rows(text, rows.size(), [&](TextReader& line, std::size_t i) { read(line, rows[i]); });
    for (const ElementRow& row : rows) take(row);
  }
}

/// True if the element that was added last, of that kind, is the one that is asked for. `question`
/// may be null.
inline bool is_last_asked_for(const TetPlace* question, const MeshData& mesh, int vtk_type) {
  if (question == nullptr) return false;
  const std::size_t last = question->tet + 1;
  switch (question->dimension) {
    case 3:
      return vtk_type == vtk_tet && mesh.tets.size() == last;
    case 2:
      return vtk_type == vtk_triangle && mesh.triangles.size() == last;
    default:
      return vtk_type == vtk_edge && mesh.edges.size() == last;
  }
}

/// Says where the element that was added last stands, if that is the question. `question` may be
/// null.
inline void answer(TetPlace* question, const MeshData& mesh, const TextReader& text,
                   const ElementRow& row) {
  if (is_last_asked_for(question, mesh, row.kind->vtk_type)) {
    question->place = text.place_of(row.place);
  }
}

/// All elements of one kind.
struct ElementList {
  ElementKind kind;
  std::size_t count = 0;
  std::span<const MeshData::Tet> tets;  ///< only one of these four is there
  std::span<const MeshData::Triangle> triangles;
  std::span<const MeshData::Edge> edges;
  const OtherElements* others = nullptr;
  const std::vector<Label>* parts = nullptr;  ///< null: none
  const std::vector<std::int64_t>* numbers = nullptr;
  const std::vector<DataArray>* data = nullptr;

  std::span<const std::uint32_t> vertices(std::size_t i) const {
    if (!tets.empty()) return tets[i].vertices;
    if (!triangles.empty()) return triangles[i].vertices;
    if (!edges.empty()) return edges[i].vertices;
    return std::span(others->vertices).subspan(i * kind.width, kind.width);
  }
  Label label(std::size_t i) const {
    if (!tets.empty()) return tets[i].label;
    if (!triangles.empty()) return triangles[i].label;
    if (!edges.empty()) return edges[i].label;
    return others->labels[i];
  }
};

/// The lists of a mesh that are not empty, the highest dimension first, without kinds that
/// element_kind() does not know. The mesh must outlive it.
class ElementLists {
 public:
  explicit ElementLists(const MeshView& mesh);
  ElementLists(const ElementLists&) = delete;
  ElementLists& operator=(const ElementLists&) = delete;

  std::span<const ElementList> all() const { return lists_; }
  std::vector<const ElementList*> of_dimension(int dimension) const;
  /// See MeshData::taken_element_numbers.
  std::span<const NumberRange> taken_numbers() const { return taken_numbers_; }

 private:
  std::vector<MeshData::Tet> own_tets_;  // of a TetMesh
  std::vector<ElementList> lists_;
  std::span<const NumberRange> taken_numbers_;
};

}  // namespace tetmend::formats
