// SPDX-License-Identifier: MIT
#include "pieces/mesh_files.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "envelope/kept_points.h"
#include "face/carry.h"
#include "face/regions.h"
#include "face/surface_marks.h"
#include "kernel/formats/medit_marks.h"
#include "kernel/formats/medit_vectors.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/mesh_view.h"
#include "pieces/bytes.h"
#include "pieces/carried_rows.h"
#include "pieces/gmsh_output.h"
#include "pieces/gmsh_slices.h"
#include "pieces/medit_slices.h"
#include "pieces/partitioned_files.h"
#include "pieces/row_source.h"
#include "pieces/rows.h"
#include "pieces/share_slices.h"
#include "pieces/slices.h"
#include "pieces/vtu_output.h"

namespace tetmend::pieces {

namespace {

/// Of elements, where a mesh has other arrays: else readers of .vtu might take one of these for
/// labels.
constexpr const char* kElementLabels = "CellEntityIds";

/// Of all ranks, each once.
std::vector<std::string> gather_notes(const std::vector<std::string>& mine, Ranks& ranks) {
  std::string bytes;
  for (const std::string& note : mine) put(note, bytes);
  std::set<std::string> all;
  for (const std::string& from : ranks.gather(bytes)) {
    for (std::string_view rest = from; !rest.empty();) {
      std::string note;
      pieces::take(rest, note);
      all.insert(std::move(note));
    }
  }
  return {all.begin(), all.end()};
}

const std::vector<DataArray>& arrays_of(const MeshData& data, RowKind kind) {
  return kind == RowKind::point      ? data.point_data
         : kind == RowKind::tet      ? data.tet_data
         : kind == RowKind::triangle ? data.triangle_data
                                     : data.edge_data;
}

bool has_any_array(const MeshData& data) {
  return std::any_of(kRowKinds.begin(), kRowKinds.end(),
                     [&](RowKind kind) { return !arrays_of(data, kind).empty(); });
}

/// For so many pieces.
std::size_t tets_of_slice(std::uint64_t tets, std::size_t pieces) {
  return std::min<std::size_t>(kTetsOfSlice, 1 + tets / pieces);
}

}  // namespace

InputMesh::InputMesh(const std::filesystem::path& file, Ranks& ranks, const ArrayFiles* files,
                     const std::string& label_array)
    : file_(file), label_array_(label_array), files_(files) {
  if (files != nullptr && files->is_one(file)) {
    read_share(file, ranks, label_array);
    return;
  }
  slices_ = open_slices(file, label_array, ranks);
  if (slices_) {
    tets_ = slices_->counts().tets;
    vertices_ = slices_->counts().vertices;
    required_vertices_ = slices_->counts().required_vertices;
    data_ = slices_->digest();
    holds_more_ = face::holds_more(data_);
    has_arrays_ = has_any_array(data_);
    return;
  }
  is_elsewhere_ = !ranks.is_first();
  std::string facts;
  if (ranks.is_first()) {
    read_whole(file, label_array);
    put(std::uint64_t{data_.tets.size()}, facts);
    put(std::uint64_t{data_.points.size()}, facts);
    put(holds_more_, facts);
    put(has_arrays_, facts);
  }
  const std::vector<std::string> all = ranks.gather(facts);
  std::string_view rest = all.front();
  pieces::take(rest, tets_);
  pieces::take(rest, vertices_);
  pieces::take(rest, holds_more_);
  pieces::take(rest, has_arrays_);
}

/// Values of arrays go: they are read again when they are needed.
void InputMesh::read_share(const std::filesystem::path& file, Ranks& ranks,
                           const std::string& label_array) {
  is_share_ = true;
  arrays_ = files_->read(file, label_array);
  const ArrayCounts counts = count_all(*arrays_, ranks);
  tets_ = counts.tets;
  vertices_ = counts.points;
  required_vertices_ = counts.required_vertices;
  data_.notes = gather_notes(arrays_->notes, ranks);
  has_arrays_ = holds_more_ = has_arrays(arrays_->arrays);
  data_.point_data = nothing_of(arrays_->arrays[RowKind::point]);
  data_.tet_data = nothing_of(arrays_->arrays[RowKind::tet]);
  data_.triangle_data = nothing_of(arrays_->arrays[RowKind::triangle]);
  data_.edge_data = nothing_of(arrays_->arrays[RowKind::edge]);
  arrays_->arrays = {};
}

void InputMesh::read_whole(const std::filesystem::path& file, const std::string& label_array) {
  data_ = read_mesh(file, label_array);
  if (!data_.mid_nodes.empty()) {
    throw Error(fmt::format("{}: a mesh of second order cannot be divided", file.string()));
  }
  holds_more_ = face::holds_more(data_);
  has_arrays_ = has_any_array(data_);
  required_vertices_ = data_.required_vertices.size();
}

namespace {

/// What neither labels, constraints nor arrays are.
bool holds_more_than_arrays(const MeshData& data) {
  const auto any = [](const auto&... lists) { return (!lists.empty() || ...); };
  return any(data.tet_parts, data.triangle_parts, data.edge_parts, data.point_entities, data.groups,
             data.entities, data.periodic, data.other_elements, data.point_numbers,
             data.tet_numbers, data.deck);
}

/// Names the arrays that are not carried.
void note_lost_arrays(const MeshData& data,
                      const std::function<bool(RowKind, const DataArray&)>& is_carried,
                      std::vector<std::string>& lost) {
  constexpr std::array<std::string_view, 4> kNames = {"points", "tets", "triangles", "edges"};
  for (const RowKind kind : kRowKinds) {
    for (const DataArray& array : arrays_of(data, kind)) {
      if (is_carried(kind, array)) continue;
      lost.push_back(fmt::format("the array '{}' of {} is not written", array.name,
                                 kNames[static_cast<std::size_t>(kind)]));
    }
  }
}

}  // namespace

bool InputMesh::is_of_ranks(const std::filesystem::path& output) const {
  return files_ != nullptr && files_->is_one(output);
}

/// Where all ranks read or write together, arrays are carried for a fixed surface alone.
bool InputMesh::carries_arrays(const std::filesystem::path& output) const {
  return !surface_moves_ || (!is_share_ && !is_of_ranks(output));
}

std::vector<std::string> InputMesh::lost_in(const std::filesystem::path& output) const {
  std::vector<std::string> lost = data_.notes;
  const bool is_together = is_of_ranks(output);
  const bool carries = carries_arrays(output);
  note_lost_arrays(
      data_,
      [&](RowKind kind, const DataArray& array) {
        return carries && (!is_together || files_->takes(output, kind, array));
      },
      lost);
  if (!is_together && carries) {
    for (std::string& text : not_written(output, data_)) lost.push_back(std::move(text));
  }
  if (is_together && holds_more_than_arrays(data_)) {
    lost.emplace_back(
        "groups and whatever there is besides arrays, labels and constraints are not written");
  }
  if (is_together && required_vertices_ > 0 && !files_->has_required_vertices(output)) {
    lost.emplace_back("required vertices are not written");
  }
  return lost;
}

bool InputMesh::holds_more(const std::filesystem::path& output) const {
  if (!carries_arrays(output)) return false;
  if (is_of_ranks(output)) return has_arrays_ && files_->takes(output, RowKind::tet, DataArray());
  const bool has_no_walls =
      is_share_ || (slices_ && !slices_->has_walls());  // they are not written
  if (has_no_walls && output.extension() == ".vtu") {
    return has_arrays_ || !data_.other_elements.empty() || !data_.label_array.empty();
  }
  if (!has_no_walls || output.extension() != ".meshb") return holds_more_;
  // Of all that these may hold besides, MEDIT's format has a place for marks and vectors alone.
  const auto any = [&](const auto& named) {
    return std::any_of(named.begin(), named.end(),
                       [&](const auto& each) { return formats::is_medit_mark(each.name); });
  };
  return any(data_.groups) || any(data_.point_data);
}

void InputMesh::check_conserve(const std::vector<std::string>& names) const {
  if (!is_elsewhere_) face::check_conserve(data_, names);
}

void InputMesh::add_to(DividedMesh& mesh, std::size_t pieces) {
  if (arrays_) {
    add_arrays(*arrays_, mesh);
    arrays_.reset();
    return;
  }
  if (slices_ && surface_moves_ && holds_more_) {
    slices_.reset();  // what marks the surface is not in slices
    if (mesh.ranks().is_first()) read_whole(file_, label_array_);
  }
  if (slices_) {
    slices_->add_to(mesh, tets_of_slice(tets_, pieces));
  } else if (mesh.ranks().is_first()) {
    const std::vector<MeshData::Triangle> walls = face::walls_between_parts(data_);
    std::vector<char> is_kept;
    if (surface_moves_) {
      face::put_marks(face::mark_surface(data_), data_);
      is_kept = find_kept_points(data_);
    }
    data_.triangles.insert(data_.triangles.end(), walls.begin(), walls.end());
    add_slices(data_, {}, mesh, is_kept);
    data_ = {};
  }
  mesh.end_slices();
}

namespace {

/// Over all ranks.
face::Regions::Seen gather_seen(const face::Regions::Seen& mine, Ranks& ranks) {
  std::string bytes;
  put(mine.labels, bytes);
  for (const Point& corner : mine.box) {
    for (const double x : corner) put(x, bytes);
  }
  put(mine.found, bytes);
  face::Regions::Seen all;
  for (const std::string& from : ranks.gather(bytes)) {
    std::string_view rest = from;
    face::Regions::Seen other;
    pieces::take(rest, other.labels);
    for (Point& corner : other.box) {
      for (double& x : corner) pieces::take(rest, x);
    }
    pieces::take(rest, other.found);
    all.merge(other);
  }
  return all;
}

}  // namespace

void add_protected(InputMesh& input, const Options& options, DividedMesh& mesh,
                   std::size_t pieces) {
  if (!options.surface.empty() && options.surface != "fixed") input.set_surface_moves();
  const face::Regions regions(options);
  if (!regions.are_there()) return input.add_to(mesh, pieces);
  face::Regions::Seen seen;
  mesh.set_slice_marker([&](Piece& slice) {
    for (PieceTet& tet : slice.tets) {
      std::array<Point, 4> corners;
      for (std::size_t i = 0; i < 4; ++i) corners[i] = slice.points[tet.vertices[i]];
      regions.see(tet.label, corners, seen);
      if (regions.protect(tet.label, corners)) tet.origin |= PieceTet::kProtected;
    }
  });
  input.add_to(mesh, pieces);
  mesh.set_slice_marker({});
  regions.check(gather_seen(seen, mesh.ranks()));
}

namespace {

/// All ranks: on the first one the file that was read.
MeshData read_source(const WriteDetails& details, Ranks& ranks) {
  const ArrayFiles* const files = details.array_files;
  if (files != nullptr && files->is_one(details.source)) {
    return gather_mesh(details.source, *files, details.label_array, ranks);
  }
  return ranks.is_first() ? read_mesh(details.source, details.label_array) : MeshData();
}

/// On the first rank. @param before null: it holds nothing besides the mesh
std::vector<CarriedArray> write_whole(const std::filesystem::path& file, const DividedMesh& mesh,
                                      const WriteDetails& details, const MeshData* before) {
  Joined joined = join(mesh, details.vertices);
  std::vector<CarriedArray> carried;
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

std::vector<CarriedArray> write_pieces(const std::filesystem::path& file, DividedMesh& mesh,
                                       const WriteDetails& details) {
  const ArrayFiles* const files = details.array_files;
  const bool is_of_ranks = files != nullptr && files->is_one(file);
  if (is_of_ranks && details.parts > 0 && files->is_in_parts(file)) {
    divide_into_parts(mesh, details.parts);
  }
  const bool takes_rows = is_of_ranks || file.extension() == ".vtu";
  if (takes_rows && !details.source.empty() && !details.surface_moves) {
    if (auto carried = write_with_rows(file, mesh, details)) return std::move(*carried);
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
  if (file.extension() == ".vtu" && details.source.empty()) {
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
  std::vector<CarriedArray> carried;
  if (mesh.ranks().is_first()) {
    carried = write_whole(file, mesh, details, has_source ? &before : nullptr);
  }
  mesh.ranks().meet();
  return carried;
}

void check_for_files(const Options& options) {
  const auto refuse = [](bool given, const char* name, std::string_view option) {
    if (!given) return;
    throw OptionError(name, fmt::format("{}: needs the whole mesh in memory", option));
  };
  refuse(options.keep_size, "keep_size", "keep-size");
  refuse(options.ignore_interior, "ignore_interior", "ignore-interior");
}

void check_before(const Figures& before, const Options& options,
                  const std::filesystem::path& file) {
  const auto fail = [&](std::string_view what) {
    throw Error(fmt::format("{}: {}", file.string(), what));
  };
  if (before.peculiar > 0) {
    fail("some tets are inverted, flat or turned round, which needs the whole mesh in memory");
  }
  if (before.layer_tets > 0 && options.layers == Layers::keep) {
    fail(
        "has boundary layers: keeping them needs the whole mesh in memory; 'layers improve' "
        "gives them up");
  }
}

Kept kept_by(const face::SurfaceTolerance& surface) {
  return surface.is_fixed() ? Kept::all : surface.is_flat() ? Kept::shape : Kept::nearness;
}

void check_after(const Figures& before, const Figures& after, Kept kept, Result& result) {
  result.before = before.statistics;
  result.not_positive_before = before.not_positive;
  result.protected_tets = before.protected_tets;
  result.protected_bad_tets = before.protected_bad_tets;
  result.after = after.statistics;
  result.surface_fingerprint_before = before.surface;
  result.surface_fingerprint = after.surface;
  result.not_positive_after = after.not_positive;
  constexpr double kMostVolumeChange = 1e-9;
  const bool keeps_surface =
      kept != Kept::all || (after.surface == before.surface &&
                            result.after.boundary_triangles == result.before.boundary_triangles);
  const bool fits = keeps_surface && after.misfits == 0 &&
                    result.not_positive_after <= result.not_positive_before &&
                    (kept == Kept::nearness || result.volume_change() <= kMostVolumeChange);
  if (!fits) throw Error("the pieces do not fit: this is a bug of tetmend, please report it");
}

std::string why_as_it_was(const Result& result) {
  return fmt::format("the mesh is as it was: at the end there was {}",
                     fmt::join(result.worse(), "; "));
}

OptionTexts texts_of(const Options& options) {
  OptionTexts texts;
  const auto add = [&](std::string_view name, std::string value) {
    if (!value.empty()) texts.emplace_back(name, std::move(value));
  };
  const std::filesystem::path schedule = options.schedule;
  if (!options.script.empty()) {
    add("script", options.script);
  } else if (schedule.extension() == ".lua") {
    std::ifstream in(schedule, std::ios::binary);
    add("script", {std::istreambuf_iterator<char>(in), {}});
    if (in.bad() || !in.is_open()) throw Error(fmt::format("cannot read {}", schedule.string()));
  } else {
    add("schedule", options.schedule);
  }
  for (const auto& [name, value] : options.set) add("set", fmt::format("{}={}", name, value));
  for (const std::filesystem::path& plugin : options.plugin) {
    add("plugin", std::filesystem::absolute(plugin).string());
  }
  add("goal", fmt::format("{},{}", options.goal.min_angle, options.goal.max_angle));
  add("measure", options.measure);
  add("surface", options.surface);
  if (!options.surface.empty()) add("feature-angle", fmt::format("{}", options.feature_angle));
  add("layers", options.layers == Layers::keep ? "keep" : "improve");
  add("tets", options.tets);
  for (const std::string& region : options.protect) add("protect", region);
  for (const std::string& region : options.only) add("only", region);
  for (const std::string& name : options.conserve) add("conserve", name);
  return texts;
}

}  // namespace tetmend::pieces
