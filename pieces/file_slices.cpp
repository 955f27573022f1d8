// SPDX-License-Identifier: MIT
#include "pieces/file_slices.h"

#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "kernel/error.h"
#include "pieces/gmsh_slices.h"
#include "pieces/medit_slices.h"
#include "pieces/vtu_slices.h"

namespace tetmend::pieces {

void fail_changed(const std::filesystem::path& file) {
  throw Error(fmt::format("{}: has changed while it was read", file.string()));
}

std::uint64_t FileSlices::slice_count(std::size_t tets_of_slice, const Ranks& ranks) const {
  return std::max<std::uint64_t>(1 + counts_.tets / tets_of_slice, ranks.count());
}

void FileSlices::add_to(DividedMesh& mesh, std::size_t tets_of_slice) const {
  const std::uint64_t slices = slice_count(tets_of_slice, mesh.ranks());
  const FileRange mine = FileRange::of_slice(slices, mesh.ranks().number(), mesh.ranks().count());
  for (std::uint64_t i = mine.begin; i < mine.end; ++i) mesh.add_slice(i, read_slice(i, slices));
}

void FileSlices::for_row_slices(
    std::size_t tets_of_slice, const Ranks& ranks,
    const std::function<void(std::uint64_t number, RowSlice slice)>& use) const {
  const std::uint64_t slices = slice_count(tets_of_slice, ranks);
  const FileRange mine = FileRange::of_slice(slices, ranks.number(), ranks.count());
  for (std::uint64_t i = mine.begin; i < mine.end; ++i) {
    RowSlice slice{read_slice(i, slices), {}};
    read_rows(share_of(i, slices), slice.piece.ids, slice.rows);
    use(i, std::move(slice));
  }
}

FileSlices::Share FileSlices::share_of(std::uint64_t i, std::uint64_t slices) const {
  return {FileRange::of_slice(counts_.vertices, i, slices),
          FileRange::of_slice(counts_.tets, i, slices),
          FileRange::of_slice(counts_.triangles, i, slices),
          FileRange::of_slice(counts_.edges, i, slices)};
}

Piece FileSlices::read_slice(std::uint64_t i, std::uint64_t slices) const {
  const Share of = share_of(i, slices);
  FileElements elements;
  read_elements(of, elements);
  std::uint64_t number = of.tets.begin;
  for (auto& tet : elements.tets) {
    tet.element.origin =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(number++, PieceTet::kNone));
  }
  Piece slice;
  note_ids(elements.tets, slice.ids);
  note_ids(elements.triangles, slice.ids);
  note_ids(elements.edges, slice.ids);
  for (VertexId v = of.vertices.begin; v < of.vertices.end; ++v) slice.ids.push_back(v);
  std::sort(slice.ids.begin(), slice.ids.end());
  slice.ids.erase(std::unique(slice.ids.begin(), slice.ids.end()), slice.ids.end());
  take_elements(elements.tets, slice.ids, slice.tets);
  take_elements(elements.triangles, slice.ids, slice.triangles);
  take_elements(elements.edges, slice.ids, slice.edges);
  elements = {};
  read_vertices(slice);
  for (std::size_t v = 0; v < slice.ids.size(); ++v) {
    if (of.vertices.has(slice.ids[v])) {
      slice.marks[v] = static_cast<std::uint8_t>(slice.marks[v] | kOwn);
    }
  }
  return slice;
}

std::unique_ptr<FileSlices> open_slices(const std::filesystem::path& file,
                                        const std::string& label_array, Ranks& ranks) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return nullptr;
  if (file.extension() == ".meshb") return MeditSlices::open(file, ranks);
  if (file.extension() == ".msh" && label_array.empty()) return GmshSlices::open(file, ranks);
  if (file.extension() == ".vtu") return VtuSlices::open(file, label_array, ranks);
  return nullptr;
}

}  // namespace tetmend::pieces
