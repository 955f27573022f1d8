// SPDX-License-Identifier: MIT
//   rows of all ranks, where the formats have what rows tell; else the first rank has both meshes
#include "pieces/mesh_output.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "face/carry.h"
#include "face/surface_marks.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/formats/vtk_roles.h"
#include "kernel/mesh_view.h"
#include "pieces/carried_rows.h"
#include "pieces/file_slices.h"
#include "pieces/gmsh_output.h"
#include "pieces/gmsh_slices.h"
#include "pieces/medit_slices.h"
#include "pieces/partitioned_files.h"
#include "pieces/row_source.h"
#include "pieces/share_slices.h"
#include "pieces/slices.h"
#include "pieces/vtu_output.h"

namespace tetmend::pieces {

namespace {

/// Of elements, where a mesh has other arrays: else readers of .vtu might take one of these for
/// labels.
constexpr const char* kElementLabels = "CellEntityIds";

/// All ranks: on the first one the file that was read.
MeshData read_source(const WriteDetails& details, Ranks& ranks) {
  const ArrayFiles* const files = details.array_files;
  if (files != nullptr && files->is_one(details.source)) {
    return gather_mesh(details.source, *files, details.label_array, ranks);
  }
  return ranks.is_first() ? read_mesh(details.source, details.label_array) : MeshData();
}

/// On the first rank. @param before null: it holds nothing besides the mesh
face::Carried write_whole(const std::filesystem::path& file, const DividedMesh& mesh,
                          const WriteDetails& details, const MeshData* before) {
  Joined joined = join(mesh, details.vertices);
  face::Carried carried;
  if (before != nullptr) {
    const Maps maps = maps_of(joined, before->points.size(), before->tets.size());
    const face::SurfaceMarks marks =
        details.surface_moves ? face::mark_surface(*before) : face::SurfaceMarks();
    carried = face::carry(*before, maps.vertices, maps.tets, details.conserve, joined.data,
                          details.surface_moves ? &marks : nullptr);
  }
  MeshView view(joined.data);
  view.set_variant(details.variant);
  write_mesh(file, view);
  return carried;
}

/// Its arrays, with none for the walls that were put between its parts.
RankShare share_of_whole(const MeshData& data) {
  RankShare share = all_of(data);
  const std::vector<MeshData::Triangle> walls = face::walls_between_parts(data);
  for (const MeshData::Triangle& wall : walls) {
    auto& made = share.triangles.emplace_back();
    std::copy(wall.vertices.begin(), wall.vertices.end(), made.vertices.begin());
  }
  for (DataArray& array : share.arrays[RowKind::triangle]) {
    append_nothing(walls.size() * array.components, array);
  }
  return share;
}

CarriedRows carry_rows(const RowSource& source, std::uint64_t tets, const DividedMesh& mesh,
                       const WriteDetails& details, Shelf& memory) {
  return {source,
          mesh,
          tets_of_slice(tets, details.pieces),
          details.pieces,
          details.conserve,
          details.shelf != nullptr ? *details.shelf : memory};
}

/// What the file that was read has in arrays.
struct OpenedRows {
  std::unique_ptr<FileSlices> file;
  RankShare share;
  std::unique_ptr<ShareSlices> slices;  // of the share
  std::uint64_t tets = 0;
  std::string label_array;

  const RowSource& source() const { return file ? static_cast<const RowSource&>(*file) : *slices; }
};

/// All ranks. @param arrays_are_all  what there is besides is not written in any case
/// @returns nothing where rows are not all that is to be brought over
std::optional<OpenedRows> open_rows(const WriteDetails& details, bool arrays_are_all,
                                    Ranks& ranks) {
  OpenedRows rows;
  const ArrayFiles* const files = details.array_files;
  if (files != nullptr && files->is_one(details.source)) {
    rows.share = files->read(details.source, details.label_array);
    if (!rows.share.arrays[RowKind::tet].empty()) rows.label_array = kElementLabels;
  } else {
    rows.file = open_slices(details.source, details.label_array, ranks);
    if (rows.file && rows.file->has_only_arrays()) {
      rows.tets = rows.file->counts().tets;
      rows.label_array = rows.file->digest().label_array;
      return rows;
    }
    if (!arrays_are_all) return {};
    rows.file.reset();
    if (ranks.is_first()) {
      rows.share = share_of_whole(read_mesh(details.source, details.label_array));
    }
    share_outlines(rows.share.arrays, ranks);
  }
  rows.tets = count_all(rows.share, ranks).tets;
  return rows;
}

/// No rank has all of it. Nothing where more than rows is to be brought over.
std::optional<std::vector<CarriedArray>> write_with_rows(const std::filesystem::path& file,
                                                         const DividedMesh& mesh,
                                                         const WriteDetails& details) {
  Ranks& ranks = mesh.ranks();
  const ArrayFiles* const files = details.array_files;
  const bool is_of_ranks = files != nullptr && files->is_one(file);
  std::optional<OpenedRows> opened = open_rows(details, is_of_ranks, ranks);
  if (!opened) return {};
  if (!opened->file) opened->slices = std::make_unique<ShareSlices>(opened->share, ranks);
  MemoryShelf memory;
  const CarriedRows rows = carry_rows(opened->source(), opened->tets, mesh, details, memory);
  opened->slices.reset();
  opened->share = {};
  if (is_of_ranks) {
    files->write_stored(file, mesh, &rows);
  } else {
    write_vtu_slices(file, mesh, {&rows, opened->label_array});
  }
  return ranks.is_first() ? rows.report() : std::vector<CarriedArray>();
}

/// No rank has all of it. False where the file that was read is of another format.
bool write_medit_with_marks(const std::filesystem::path& file, const DividedMesh& mesh,
                            const WriteDetails& details) {
  const auto opened = open_slices(details.source, details.label_array, mesh.ranks());
  const auto* const source = dynamic_cast<const MeditSlices*>(opened.get());
  if (source == nullptr) return false;
  MemoryShelf memory;
  const CarriedRows rows = carry_rows(*source, source->counts().tets, mesh, details, memory);
  write_medit_slices(file, mesh, &rows);
  return true;
}

/// The same, of a file with entities that are in its list. False for any other.
bool write_gmsh_with_entities(const std::filesystem::path& file, const DividedMesh& mesh,
                              const WriteDetails& details) {
  const auto opened = open_slices(details.source, details.label_array, mesh.ranks());
  const auto* const source = dynamic_cast<const GmshSlices*>(opened.get());
  if (source == nullptr || !source->has_all_in_rows()) return false;
  const GmshExtras extras = source->extras();
  const std::string& variant = details.variant.empty() ? extras.head.variant : details.variant;
  if (variant.starts_with("2.2")) return false;
  MemoryShelf memory;
  const CarriedRows rows = carry_rows(*source, source->counts().tets, mesh, details, memory);
  const CarriedEntities carried{rows, extras};
  write_gmsh_slices(file, mesh, variant != "4.1 ASCII", &carried);
  return true;
}

}  // namespace

MeshData gather_mesh(const std::filesystem::path& file, const ArrayFiles& files,
                     const std::string& label_array, Ranks& ranks) {
  RankShare share = files.read(file, label_array);
  const std::uint64_t vertices = count_all(share, ranks).points;
  MemoryShelf shelf;
  DividedMesh pieces(shelf, ranks, vertices);
  add_arrays(share, pieces);
  KindArrays arrays = gather_arrays(share.arrays, ranks);
  share = {};
  pieces.bring_to_first();
  if (!ranks.is_first()) return {};
  MeshData data = join(pieces, vertices).data;
  data.point_data = std::move(arrays[RowKind::point]);
  data.tet_data = std::move(arrays[RowKind::tet]);
  data.triangle_data = std::move(arrays[RowKind::triangle]);
  data.edge_data = std::move(arrays[RowKind::edge]);
  if (!data.tet_data.empty()) data.label_array = kElementLabels;
  return data;
}

face::Carried write_pieces(const std::filesystem::path& file, DividedMesh& mesh,
                           const WriteDetails& details) {
  const ArrayFiles* const files = details.array_files;
  const bool is_of_ranks = files != nullptr && files->is_one(file);
  if (is_of_ranks && details.parts > 0 && files->is_in_parts(file)) {
    divide_into_parts(mesh, details.parts);
  }
  const bool is_vtu = file.extension() == ".vtu" && details.variant != formats::kVtkAscii;
  const bool takes_rows = is_of_ranks || is_vtu;
  if (takes_rows && !details.source.empty() && !details.surface_moves) {
    if (auto carried = write_with_rows(file, mesh, details)) return {std::move(*carried), {}};
  }
  if (is_of_ranks) {
    files->write_stored(file, mesh, nullptr);
    return {};
  }
  if (file.extension() == ".meshb" && details.source.empty()) {
    write_medit_slices(file, mesh);
    return {};
  }
  if (file.extension() == ".meshb" && !details.surface_moves) {
    if (write_medit_with_marks(file, mesh, details)) return {};
  }
  if (is_vtu && details.source.empty()) {
    write_vtu_slices(file, mesh);
    return {};
  }
  const bool is_msh_2 = details.variant.starts_with("2.2");
  if (file.extension() == ".msh" && details.source.empty() && !is_msh_2) {
    write_gmsh_slices(file, mesh, details.variant != "4.1 ASCII");
    return {};
  }
  if (file.extension() == ".msh" && !details.source.empty() && !details.surface_moves &&
      !is_msh_2) {
    if (write_gmsh_with_entities(file, mesh, details)) return {};
  }
  const bool has_source = !details.source.empty();
  const MeshData before = has_source ? read_source(details, mesh.ranks()) : MeshData();
  mesh.bring_to_first();
  face::Carried carried;
  if (mesh.ranks().is_first()) {
    carried = write_whole(file, mesh, details, has_source ? &before : nullptr);
  }
  mesh.ranks().meet();
  return carried;
}

}  // namespace tetmend::pieces
