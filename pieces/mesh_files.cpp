// SPDX-License-Identifier: MIT
#include "pieces/mesh_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "envelope/kept_points.h"
#include "face/carry.h"
#include "face/regions.h"
#include "face/sizes.h"
#include "face/surface_marks.h"
#include "face/worse.h"
#include "kernel/formats/medit_vectors.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/formats/vtk_roles.h"
#include "kernel/printable.h"
#include "kernel/shared_parts.h"
#include "kernel/volume_rounding.h"
#include "pieces/bytes.h"
#include "pieces/rows.h"
#include "pieces/slices.h"

namespace tetmend::pieces {

namespace {

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
             data.tet_numbers) ||
         (!data.deck.empty() && !formats::has_only_roles(data));
}

/// Names the arrays that are not carried, and those that get other names.
void note_lost_arrays(const MeshData& data, bool names_are_text,
                      const std::function<bool(RowKind, const DataArray&)>& is_carried,
                      std::vector<std::string>& lost) {
  constexpr std::array<std::string_view, 4> kNames = {"points", "tets", "triangles", "edges"};
  for (const RowKind kind : kRowKinds) {
    for (const DataArray& array : arrays_of(data, kind)) {
      const std::string_view of = kNames[static_cast<std::size_t>(kind)];
      if (!is_carried(kind, array)) {
        lost.push_back(
            fmt::format("the array '{}' of {} is not written", printable(array.name), of));
      } else if (names_are_text && !is_printable(array.name)) {
        lost.push_back(fmt::format("the name of the array '{}' of {} is not kept as it is",
                                   printable(array.name), of));
      }
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
      data_, is_together,
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
    hold_shared_inside(data_);
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

void check_for_files(const Options& options) {
  const auto refuse = [](bool given, const char* name, std::string_view option) {
    if (!given) return;
    throw OptionError(name, fmt::format("{}: needs the whole mesh in memory", option));
  };
  refuse(options.keep_size, "keep_size", "keep-size");
  const std::string size = face::Sizes(options).of_mesh();
  refuse(!size.empty(), "size", fmt::format("size {}", size));
  refuse(options.ignore_interior, "ignore_interior", "ignore-interior");
  refuse(options.straighten, "straighten", "straighten");
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

void check_after(const Measured& measured_before, const Measured& measured_after, Kept kept,
                 double side, Result& result) {
  const Figures& before = measured_before.figures;
  const Figures& after = measured_after.figures;
  result.rulers_before = measured_before.rulers;
  result.rulers_after = measured_after.rulers;
  if (measured_before.rulers && measured_after.rulers) {
    result.size_drift = measured_before.lengths.drift_to(measured_after.lengths);
  }
  if (before.sizes.edges > 0) {
    result.sizes_before = before.sizes.statistics();
    result.sizes_after = after.sizes.statistics();
  }
  result.before = before.statistics;
  result.not_positive_before = before.not_positive;
  result.build.constrained_faces = before.constrained_faces;
  result.protected_tets = before.protected_tets;
  result.protected_bad_tets = before.protected_bad_tets;
  result.after = after.statistics;
  result.touched_tets = after.touched;
  result.surface_fingerprint_before = before.surface;
  result.surface_fingerprint = after.surface;
  result.not_positive_after = after.not_positive;
  const bool keeps_surface =
      kept != Kept::all || (after.surface == before.surface &&
                            result.after.boundary_triangles == result.before.boundary_triangles);
  const bool fits = keeps_surface && after.misfits == 0 &&
                    result.not_positive_after <= result.not_positive_before &&
                    (kept == Kept::nearness ||
                     is_rounding(result.volume_change(), result.before.scaled_volume,
                                 [&] { return std::ldexp(side, -result.before.scale); }));
  if (!fits) throw Error("the pieces do not fit: this is a bug of tetmend, please report it");
}

void forget_rulers(Result& result) {
  result.rulers_before = result.rulers_after = std::nullopt;
  result.size_drift.reset();
}

std::string stay_as_it_was(const std::optional<SurfaceChange>& surface, Result& result) {
  std::string why = fmt::format("the mesh is as it was: at the end there was {}",
                                fmt::join(face::worse_for_nothing(result), "; "));
  result.after = result.before;
  result.rulers_after = result.rulers_before;
  if (result.size_drift) result.size_drift = SizeDrift();
  result.touched_tets = 0;
  result.surface_fingerprint = result.surface_fingerprint_before;
  result.surface_change = surface;
  return why;
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
  for (const std::string& size : options.size) add("size", size);
  if (!options.size.empty()) {
    add("gradation", fmt::format("{}", options.gradation));
    add("smallest", fmt::format("{}", options.smallest));
    add("largest", fmt::format("{}", options.largest));
  }
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
