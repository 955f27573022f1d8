// SPDX-License-Identifier: MIT
#include "pieces/part_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/error.h"
#include "kernel/formats/cell_arrays.h"
#include "kernel/formats/gmsh.h"
#include "kernel/formats/mesh_io.h"
#include "pieces/bytes.h"

namespace tetmend::pieces {

namespace {

constexpr const char* kGhosts = "vtkGhostType";
// VTK's bits: a copy of another part's cell, one that finer cells replace, a hidden one.
constexpr std::uint64_t kNotOfThisPart = 1 | 8 | 32;
constexpr std::array<std::string_view, 3> kKnownIds = {kPointIds, "GlobalNodeIds",
                                                       "GlobalPointIds"};

/// The array of that name, out of the list; nothing if there is none.
std::optional<DataArray> take_array(std::vector<DataArray>& arrays, std::string_view name) {
  const auto found = std::find_if(arrays.begin(), arrays.end(),
                                  [&](const DataArray& array) { return array.name == name; });
  if (found == arrays.end()) return std::nullopt;
  DataArray array = std::move(*found);
  arrays.erase(found);
  return array;
}

/// Numbers of an array; nothing if one of them is no number from 0.
std::vector<std::uint64_t> whole_numbers(const DataArray& array) {
  constexpr double kEnd = 9007199254740992.0;  // doubles have all whole numbers up to there
  std::vector<std::uint64_t> numbers;
  const auto add = [&](const auto value) {
    const auto real = static_cast<double>(value);
    if (!(real >= 0 && real < kEnd) || real != std::floor(real)) return false;
    numbers.push_back(static_cast<std::uint64_t>(value));
    return true;
  };
  const auto add_all = [&](const auto& values) {
    return std::all_of(values.begin(), values.end(), add);
  };
  if (!std::visit(add_all, array.values)) numbers.clear();
  return numbers;
}

/// Leaves out the elements that are copies of those of another part.
template <class Element>
void drop_ghosts(std::vector<DataArray>& arrays, std::vector<Element>& elements) {
  const std::optional<DataArray> ghosts = take_array(arrays, kGhosts);
  if (!ghosts) return;
  const std::vector<std::uint64_t> marks = whole_numbers(*ghosts);
  if (marks.size() != elements.size()) return;
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < elements.size(); ++i) {
    if ((marks[i] & kNotOfThisPart) == 0) kept.push_back(i);
  }
  if (kept.size() == elements.size()) return;
  for (DataArray& array : arrays) array = formats::selected_rows(array, kept);
  for (std::size_t i = 0; i < kept.size(); ++i) elements[i] = elements[kept[i]];
  elements.resize(kept.size());
}

template <class Element, std::size_t N>
void add_elements(const std::vector<Element>& from, std::uint64_t first,
                  std::vector<RankShare::Element<N>>& to) {
  for (const Element& element : from) {
    auto& made = to.emplace_back();
    for (std::size_t i = 0; i < N; ++i) made.vertices[i] = first + element.vertices[i];
    made.label = element.label;
  }
}

}  // namespace

bool is_of_parts(RowKind kind, std::string_view name) {
  const bool is_id = std::find(kKnownIds.begin(), kKnownIds.end(), name) != kKnownIds.end();
  return name == kGhosts || (kind == RowKind::point && is_id);
}

void PartReader::read_vtu(const std::filesystem::path& file, std::uint64_t part,
                          const std::string& label_array) {
  MeshData data = read_mesh(file, label_array);
  // Marks of ghosts may be the only whole numbers that there are.
  if (label_array.empty() && data.label_array == kGhosts) data = read_mesh(file, "none");
  add(file, data, part);
}

void PartReader::read_msh(const std::filesystem::path& file, std::uint64_t part) {
  MeshData data = formats::read_gmsh_part(file);
  drop_arrays(data);
  data.point_data.push_back({kPointIds, 1, std::move(data.point_numbers)});
  if (!data.groups.empty() || !data.entities.empty() || !data.periodic.empty()) {
    share_.notes.emplace_back("groups and entities are not kept: parts have labels alone");
  }
  add(file, data, part);
}

void PartReader::add(const std::filesystem::path& file, MeshData& data, std::uint64_t part) {
  if (!data.mid_nodes.empty() || !data.other_elements.empty()) {
    throw Error(fmt::format("{}: a part may have tets, triangles and edges of first order alone",
                            file.string()));
  }
  if (!data.tets.empty()) label_arrays_.insert(data.label_array);
  take_ids(file, data);
  drop_ghosts(data.tet_data, data.tets);
  drop_ghosts(data.triangle_data, data.triangles);
  drop_ghosts(data.edge_data, data.edges);
  take_array(data.point_data, kGhosts);
  for (const std::string& text : data.notes) share_.notes.push_back(text);
  arrays_[RowKind::point].add(std::move(data.point_data), data.points.size());
  arrays_[RowKind::tet].add(std::move(data.tet_data), data.tets.size());
  arrays_[RowKind::triangle].add(std::move(data.triangle_data), data.triangles.size());
  arrays_[RowKind::edge].add(std::move(data.edge_data), data.edges.size());
  const std::uint64_t first = points_.points.size();
  add_elements(data.tets, first, share_.tets);
  add_elements(data.triangles, first, share_.triangles);
  add_elements(data.edges, first, share_.edges);
  points_.points.insert(points_.points.end(), data.points.begin(), data.points.end());
  points_.part_of.resize(points_.points.size(), part);
  if (data.point_labels.empty()) data.point_labels.assign(data.points.size(), 0);
  points_.labels.insert(points_.labels.end(), data.point_labels.begin(), data.point_labels.end());
}

RankShare PartReader::finish(Ranks& ranks) {
  check_label_arrays(ranks);
  if (ranks.any(has_part_without_ids_)) points_.ids.clear();
  MergedPoints merged = merge_points(points_, ranks);
  const auto renumber = [&](auto& elements) {
    for (auto& element : elements) {
      for (std::uint64_t& v : element.vertices) v = merged.numbers[v];
    }
  };
  renumber(share_.tets);
  renumber(share_.triangles);
  renumber(share_.edges);
  constexpr std::array<std::string_view, 4> kNames = {"points", "tets", "triangles", "edges"};
  for (const RowKind kind : kRowKinds) {
    share_.arrays[kind] =
        arrays_[kind].finish(ranks, kNames[static_cast<std::size_t>(kind)], share_.notes);
  }
  share_.arrays[RowKind::point] = merge_point_arrays(merged, share_.arrays[RowKind::point], ranks);
  share_.points = std::move(merged.points);
  share_.point_labels = std::move(merged.labels);
  return std::move(share_);
}

void PartReader::check_label_arrays(Ranks& ranks) const {
  std::string mine;
  for (const std::string& name : label_arrays_) put(name, mine);
  std::set<std::string> all;
  for (const std::string& from : ranks.gather(mine)) {
    for (std::string_view rest = from; !rest.empty();) {
      std::string name;
      pieces::take(rest, name);
      all.insert(name.empty() ? "none" : std::move(name));
    }
  }
  if (all.size() <= 1) return;
  throw Error(
      fmt::format("the labels of parts are in different arrays: '{}'; --label-array says which",
                  fmt::join(all, "', '")));
}

void PartReader::take_ids(const std::filesystem::path& file, MeshData& data) {
  std::vector<std::uint64_t> ids;
  for (const std::string_view name : kKnownIds) {
    const std::optional<DataArray> array = take_array(data.point_data, name);
    if (array && ids.empty()) ids = whole_numbers(*array);
  }
  if (ids.size() != data.points.size()) {
    has_part_without_ids_ = true;
    return;
  }
  std::vector<std::uint64_t> ascending = ids;
  std::sort(ascending.begin(), ascending.end());
  const auto twice = std::adjacent_find(ascending.begin(), ascending.end());
  if (twice != ascending.end()) {
    throw Error(fmt::format("{}: two points have the number {}", file.string(), *twice));
  }
  points_.ids.insert(points_.ids.end(), ids.begin(), ids.end());
}

/// Names them, and drops them.
void PartReader::drop_arrays(MeshData& data) {
  const auto note_and_drop = [&](std::vector<DataArray>& arrays, std::string_view on) {
    for (const DataArray& array : arrays) {
      share_.notes.push_back(
          fmt::format("the array '{}' of {} is not kept: parts have labels alone", array.name, on));
    }
    arrays.clear();
  };
  note_and_drop(data.point_data, "points");
  note_and_drop(data.tet_data, "tets");
  note_and_drop(data.triangle_data, "triangles");
  note_and_drop(data.edge_data, "edges");
}

}  // namespace tetmend::pieces
