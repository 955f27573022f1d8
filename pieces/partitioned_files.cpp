// SPDX-License-Identifier: MIT
//   all ranks: parts -> a folder of drafts | first rank: all get their names, what readers open last
#include "pieces/partitioned_files.h"

#include <algorithm>
#include <cctype>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/cell_arrays.h"
#include "kernel/formats/gmsh.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/formats/pending_file.h"
#include "kernel/formats/vtu_array.h"
#include "kernel/mesh_view.h"
#include "pieces/carried_rows.h"
#include "pieces/improve.h"
#include "pieces/numbering.h"
#include "pieces/part_reader.h"
#include "pieces/piece_task.h"
#include "pieces/pvtu.h"
#include "pieces/rows.h"
#include "pieces/share_slices.h"
#include "pieces/shelf.h"
#include "pieces/slices.h"

namespace tetmend::pieces {

namespace {

constexpr const char* kLabelArray = "CellEntityIds";  // as write_vtu() names them
constexpr std::string_view kNumber = "_%d";

/// Of a stored piece.
MeshData data_of(const Piece& piece, const Numbering& numbering, bool has_labels,
                 bool has_point_labels) {
  MeshData data;
  data.points = piece.points;
  if (has_point_labels) {
    data.point_labels = piece.labels;
    data.point_labels.resize(piece.points.size(), 0);
  }
  for (const PieceTet& tet : piece.tets) data.tets.push_back({tet.vertices, tet.label});
  data.triangles = piece.triangles;
  data.edges = piece.edges;
  if (has_labels) data.label_array = kLabelArray;
  std::vector<std::int64_t> ids;
  for (const VertexId id : piece.ids) {
    ids.push_back(static_cast<std::int64_t>(numbering.number(id)));
  }
  data.point_data.push_back({kPointIds, 1, std::move(ids)});
  return data;
}

/// The arrays of a kind that parts are written with.
std::vector<DataArray> outlines_of(RowKind kind, const CarriedRows* rows) {
  if (rows == nullptr) return {};
  std::vector<DataArray> arrays = nothing_of(rows->layout(kind).arrays());
  std::erase_if(arrays, [&](const DataArray& array) { return is_of_parts(kind, array.name); });
  return arrays;
}

/// Those of a stored piece, with values.
void add_arrays_of(RowKind kind, const CarriedRows* rows, std::size_t part, std::size_t count,
                   std::vector<DataArray>& to) {
  if (rows == nullptr) return;
  const std::vector<DataArray>& arrays = rows->layout(kind).arrays();
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    if (is_of_parts(kind, arrays[i].name)) continue;
    append_values(rows->column(kind, part, i, 0, count), to.emplace_back(nothing_of(arrays[i])));
  }
}

void add_arrays_of_part(const CarriedRows* rows, std::size_t part, MeshData& data) {
  add_arrays_of(RowKind::point, rows, part, data.points.size(), data.point_data);
  add_arrays_of(RowKind::tet, rows, part, data.tets.size(), data.tet_data);
  add_arrays_of(RowKind::triangle, rows, part, data.triangles.size(), data.triangle_data);
  add_arrays_of(RowKind::edge, rows, part, data.edges.size(), data.edge_data);
}

/// What the file that names the parts says of their arrays.
struct PvtuArrays {
  std::vector<PvtuArray> of_points;
  std::vector<PvtuArray> of_cells;

  PvtuArrays(bool has_point_labels, bool has_labels, const CarriedRows* rows) {
    if (has_point_labels) of_points.push_back({kLabelArray, "Int32"});
    of_points.push_back({kPointIds, "Int64"});
    if (has_labels) of_cells.push_back({kLabelArray, "Int32"});
    add(outlines_of(RowKind::point, rows), of_points);
    MeshData outlines;
    outlines.tet_data = outlines_of(RowKind::tet, rows);
    outlines.triangle_data = outlines_of(RowKind::triangle, rows);
    outlines.edge_data = outlines_of(RowKind::edge, rows);
    add(formats::join_cell_arrays(outlines), of_cells);
  }

 private:
  static void add(const std::vector<DataArray>& from, std::vector<PvtuArray>& to) {
    for (const DataArray& array : from) {
      to.push_back({array.name, std::string(formats::vtu_type_of(array)), array.components});
    }
  }
};

/// Other arrays of elements: without labels readers might take one of these for them.
bool has_cell_arrays(const CarriedRows* rows) {
  return !outlines_of(RowKind::tet, rows).empty() ||
         !outlines_of(RowKind::triangle, rows).empty() || !outlines_of(RowKind::edge, rows).empty();
}

/// Whether any of them has a label, of all ranks.
struct LabelsOfAll {
  bool elements = false;
  bool points = false;

  explicit LabelsOfAll(const DividedMesh& mesh) {
    const auto any = [](const auto& list) {
      return std::any_of(list.begin(), list.end(),
                         [](const auto& each) { return each.label != 0; });
    };
    for (const std::size_t part : mesh.own()) {
      const Piece piece = mesh.stored(part);
      elements = elements || any(piece.tets) || any(piece.triangles) || any(piece.edges);
      points = points || std::any_of(piece.labels.begin(), piece.labels.end(),
                                     [](Label label) { return label != 0; });
    }
    elements = mesh.ranks().any(elements);
    points = mesh.ranks().any(points);
  }
};

/// How many elements the parts before each one have.
std::vector<std::uint64_t> elements_before(const DividedMesh& mesh) {
  std::vector<std::int64_t> counts(mesh.state().stored, 0);
  for (const std::size_t part : mesh.own()) {
    const Piece piece = mesh.stored(part);
    counts[part] =
        static_cast<std::int64_t>(piece.tets.size() + piece.triangles.size() + piece.edges.size());
  }
  mesh.ranks().add(counts);
  std::vector<std::uint64_t> before = {0};
  for (const std::int64_t count : counts) {
    before.push_back(before.back() + static_cast<std::uint64_t>(count));
  }
  return before;
}

/// Numbers points as the whole mesh does, and elements from that one on, both from 1.
void number_for_gmsh(MeshData& data, std::uint64_t before) {
  auto& ids = std::get<std::vector<std::int64_t>>(data.point_data.front().values);
  for (std::int64_t& id : ids) ++id;
  data.point_numbers = std::move(ids);
  data.point_data.clear();
  data.label_array.clear();
  auto next = static_cast<std::int64_t>(before);
  const auto number = [&](std::size_t count, std::vector<std::int64_t>& numbers) {
    for (std::size_t i = 0; i < count; ++i) numbers.push_back(++next);
  };
  number(data.edges.size(), data.edge_numbers);
  number(data.triangles.size(), data.triangle_numbers);
  number(data.tets.size(), data.tet_numbers);
}

/// Files of parts that have no names yet; they go unless they get them.
class Drafts {
 public:
  /// All ranks. @param target a file of the mesh: they lie beside it
  Drafts(const std::filesystem::path& target, Ranks& ranks) {
    if (ranks.is_first()) {
      const std::filesystem::path parent = target.parent_path();
      folder_.emplace(parent.empty() ? std::filesystem::path(".") : parent);
    }
    path_ = ranks.gather(folder_ ? folder_->path().string() : std::string()).front();
  }

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  /// First rank: all get their names, or the older files are as they were.
  /// @param index what readers open first, the last of all
  /// @param gone older files that this mesh does not have
  void name_all(const std::filesystem::path& index, const std::vector<std::filesystem::path>& parts,
                const std::vector<std::filesystem::path>& gone) const {
    std::deque<formats::PendingFile> files;
    std::vector<formats::PendingFile*> all;
    for (const std::filesystem::path& part : parts) {
      all.push_back(&files.emplace_back(part, path_ / part.filename()));
    }
    formats::PendingFile first(index, path_ / index.filename());
    formats::PendingFile::commit_behind(first, all, gone);
  }

 private:
  std::optional<ScratchFolder> folder_;  // of the first rank
  std::filesystem::path path_;
};

/// @throws Error when it cannot be made
void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error) return;
  throw Error(fmt::format("cannot make the folder {}: {}", folder.string(), error.message()));
}

/// All ranks: each reads a range of the files.
template <class Read>
RankShare read_parts(std::size_t count, Ranks& ranks, const Read& read) {
  PartReader reader;
  const std::size_t end = count * (ranks.number() + 1) / ranks.count();
  for (std::size_t part = count * ranks.number() / ranks.count(); part < end; ++part) {
    read(reader, part);
  }
  return reader.finish(ranks);
}

/// All ranks: as many parts as a run would make pieces.
void write_arrays(const ArrayFiles& kind, const std::filesystem::path& file,
                  const RankShare& arrays, Ranks& ranks) {
  const ArrayCounts counts = count_all(arrays, ranks);
  MemoryShelf shelf;
  DividedMesh mesh(shelf, ranks, counts.points);
  add_arrays(arrays, mesh);
  divide_into_parts(mesh, usual_pieces(counts.tets));
  if (!has_arrays(arrays.arrays)) return kind.write_stored(file, mesh, nullptr);
  const ShareSlices source(arrays, ranks);
  const CarriedRows rows(source, mesh, kTetsOfSlice, mesh.state().stored, {}, shelf);
  kind.write_stored(file, mesh, &rows);
}

/// A part has a number instead of "%d", from 1.
std::filesystem::path gmsh_part(const std::filesystem::path& file, std::size_t part) {
  std::string name = file.filename().string();
  name.replace(name.rfind(kNumber), kNumber.size(), fmt::format("_{}", part + 1));
  return file.parent_path() / name;
}

/// How many there are, numbered from 1 without a gap.
std::size_t count_gmsh_parts(const std::filesystem::path& file) {
  std::size_t count = 0;
  while (std::filesystem::exists(gmsh_part(file, count))) ++count;
  return count;
}

/// @throws Error when there is a part behind the first `count`, which are all before a gap
void check_for_gap(const std::filesystem::path& file, std::size_t count) {
  const std::string name = file.stem().string();
  const std::string begin = name.substr(0, name.size() - kNumber.size()) + "_";
  const std::filesystem::path parent = file.parent_path();
  std::error_code ignored;
  std::string first;
  for (const auto& entry : std::filesystem::directory_iterator(
           parent.empty() ? std::filesystem::path(".") : parent, ignored)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() != ".msh" || !stem.starts_with(begin)) continue;
    const std::string number = stem.substr(begin.size());
    const bool is_number = !number.empty() && number.front() != '0' &&
                           std::all_of(number.begin(), number.end(),
                                       [](unsigned char c) { return std::isdigit(c) != 0; });
    if (!is_number) continue;
    const bool is_behind = number.size() > 9 || std::stoul(number) > count;
    const std::string other = entry.path().filename().string();
    if (is_behind && (first.empty() || other < first)) first = other;
  }
  if (first.empty()) return;
  throw Error(
      fmt::format("{}: there is no such file, but {}", gmsh_part(file, count).string(), first));
}

/// The folder of the parts.
std::filesystem::path pvtu_folder(const std::filesystem::path& file) {
  return std::filesystem::path(file).replace_extension();
}

/// The name of a part in there.
std::string pvtu_part(const std::filesystem::path& file, std::size_t part) {
  return fmt::format("{}_{}.vtu", pvtu_folder(file).filename().string(), part);
}

/// Parts that the older mesh of that name has, numbered behind these.
std::vector<std::filesystem::path> surplus_parts(const std::filesystem::path& file,
                                                 std::span<const std::filesystem::path> parts) {
  std::vector<std::filesystem::path> older;
  try {
    older = read_pvtu(file);
  } catch (const Error&) {
    return {};  // there is none, or it is of no use to anybody
  }
  const std::filesystem::path folder = pvtu_folder(file);
  std::vector<std::filesystem::path> surplus;
  for (std::size_t part = parts.size(); part < older.size(); ++part) {
    const std::filesystem::path name = folder / pvtu_part(file, part);
    const bool is_of_it = std::find(older.begin(), older.end(), name) != older.end();
    if (is_of_it && std::filesystem::exists(name)) surplus.push_back(name);
  }
  return surplus;
}

}  // namespace

void divide_into_parts(DividedMesh& mesh, std::size_t parts) {
  mesh.divide(parts, 0);
  for (const std::size_t part : mesh.own()) {
    const auto number = static_cast<std::uint32_t>(part);
    mesh.store(part, own_part(mesh.gathered(part), mesh.state().parting, number));
    mesh.remove_gathered(part);
  }
  mesh.number_added(std::vector<std::uint64_t>(mesh.parts(), 0));
}

bool GmshParts::is_one(const std::filesystem::path& file) const {
  return file.extension() == ".msh" && file.stem().string().ends_with(kNumber);
}

RankShare GmshParts::read(const std::filesystem::path& file, const std::string&) const {
  const std::size_t count = count_gmsh_parts(file);
  if (count == 0) {
    throw Error(fmt::format("{}: there is no such file", gmsh_part(file, 0).string()));
  }
  check_for_gap(file, count);
  return read_parts(count, ranks_, [&](PartReader& reader, std::size_t part) {
    reader.read_msh(gmsh_part(file, part), part);
  });
}

void GmshParts::write(const std::filesystem::path& file, const RankShare& arrays) const {
  write_arrays(*this, file, arrays, ranks_);
}

void GmshParts::write_stored(const std::filesystem::path& file, const DividedMesh& mesh,
                             const CarriedRows*) const {
  const std::size_t count = mesh.state().stored;
  const Drafts drafts(file, ranks_);
  const Numbering numbering(mesh);
  const std::vector<std::uint64_t> before = elements_before(mesh);
  for (const std::size_t part : mesh.own()) {
    const Piece piece = mesh.stored(part);
    MeshData data = data_of(piece, numbering, false, !piece.labels.empty());
    number_for_gmsh(data, before[part]);
    formats::write_gmsh_part(drafts / gmsh_part(file, part).filename().string(), data);
  }
  ranks_.meet();
  if (ranks_.is_first()) {
    std::vector<std::filesystem::path> parts;
    for (std::size_t part = 1; part < count; ++part) parts.push_back(gmsh_part(file, part));
    std::vector<std::filesystem::path> gone;
    const std::size_t older = count_gmsh_parts(file);
    for (std::size_t part = count; part < older; ++part) gone.push_back(gmsh_part(file, part));
    drafts.name_all(gmsh_part(file, 0), parts, gone);
  }
  ranks_.meet();
}

formats::FileSet GmshParts::files_read(const std::filesystem::path& file) const {
  formats::FileSet set;
  const std::size_t count = count_gmsh_parts(file);
  for (std::size_t part = 0; part < count; ++part) set.files.push_back(gmsh_part(file, part));
  return set;
}

formats::FileSet GmshParts::files_written(const std::filesystem::path& file) const {
  const std::string stem = file.stem().string();
  return {.files = {gmsh_part(file, 0)},
          .numbered = {{.folder = file.parent_path(),
                        .begin = stem.substr(0, stem.size() - kNumber.size()) + "_",
                        .end = file.extension().string()}}};
}

void GmshParts::check_output(const std::filesystem::path& file) const {
  const std::size_t older = count_gmsh_parts(file);
  for (std::size_t part = 0; part < older; ++part) {
    const formats::PendingFile probe(gmsh_part(file, part));  // vanishes without commit()
  }
}

bool PvtuFiles::is_one(const std::filesystem::path& file) const {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".pvtu";
}

RankShare PvtuFiles::read(const std::filesystem::path& file, const std::string& label_array) const {
  const std::vector<std::filesystem::path> parts = read_pvtu(file);
  return read_parts(parts.size(), ranks_, [&](PartReader& reader, std::size_t part) {
    reader.read_vtu(parts[part], part, label_array);
  });
}

void PvtuFiles::write(const std::filesystem::path& file, const RankShare& arrays) const {
  write_arrays(*this, file, arrays, ranks_);
}

void PvtuFiles::write_stored(const std::filesystem::path& file, const DividedMesh& mesh,
                             const CarriedRows* rows) const {
  const std::filesystem::path folder = pvtu_folder(file);
  const std::string stem = folder.filename().string();
  const auto name_of = [&](std::size_t part) { return pvtu_part(file, part); };
  const Drafts drafts(file, ranks_);
  const Numbering numbering(mesh);
  const LabelsOfAll labels(mesh);
  const bool has_labels = labels.elements || has_cell_arrays(rows);
  for (const std::size_t part : mesh.own()) {
    MeshData data = data_of(mesh.stored(part), numbering, has_labels, labels.points);
    add_arrays_of_part(rows, part, data);
    write_mesh(drafts / name_of(part), data);
  }
  ranks_.meet();
  if (ranks_.is_first()) {
    make_folder(folder);
    std::vector<std::string> pieces;
    std::vector<std::filesystem::path> parts;
    for (std::size_t part = 0; part < mesh.state().stored; ++part) {
      pieces.push_back(fmt::format("{}/{}", stem, name_of(part)));
      parts.push_back(folder / name_of(part));
    }
    const PvtuArrays arrays(labels.points, has_labels, rows);
    write_pvtu(drafts / file.filename().string(), pieces, arrays.of_points, arrays.of_cells);
    drafts.name_all(file, parts, surplus_parts(file, parts));
  }
  ranks_.meet();
}

formats::FileSet PvtuFiles::files_read(const std::filesystem::path& file) const {
  formats::FileSet set{.files = {file}, .numbered = {}};
  try {
    const std::vector<std::filesystem::path> parts = read_pvtu(file);
    set.files.insert(set.files.end(), parts.begin(), parts.end());
  } catch (const Error&) {
    return set;  // who reads it says why
  }
  return set;
}

formats::FileSet PvtuFiles::files_written(const std::filesystem::path& file) const {
  const std::filesystem::path folder = pvtu_folder(file);
  return {
      .files = {file},
      .numbered = {{.folder = folder, .begin = folder.filename().string() + "_", .end = ".vtu"}}};
}

bool PvtuFiles::takes(const std::filesystem::path&, RowKind kind, const DataArray& array) const {
  return !is_of_parts(kind, array.name);
}

void PvtuFiles::check_output(const std::filesystem::path& file) const {
  const std::filesystem::path folder = pvtu_folder(file);
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(folder, ignored);
  if (!std::filesystem::exists(status)) return;
  if (!std::filesystem::is_directory(status)) {
    throw Error(fmt::format(
        "{}: is there and is no folder: the parts of {} would lie in a folder of that name",
        folder.string(), file.filename().string()));
  }
  const formats::PendingFile probe(folder / pvtu_part(file, 0));
}

}  // namespace tetmend::pieces
