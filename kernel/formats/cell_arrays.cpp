// SPDX-License-Identifier: MIT
// Arrays that a file gives over all of its cells.
#include "kernel/formats/cell_arrays.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/error.h"
#include "kernel/formats/element_checks.h"
#include "kernel/formats/vtk_roles.h"
#include "kernel/parts.h"

namespace tetmend::formats {
namespace {

// Names, as plain_name() has them, under which mesh tools store labels; the first that a file has is
// taken.
constexpr std::array<std::string_view, 57> kLabelNames = {"cellentityids",
                                                          "label",
                                                          "labels",
                                                          "medit:ref",
                                                          "gmsh:physical",
                                                          "tetgen:ref",
                                                          "region",
                                                          "regionid",
                                                          "elemregion",
                                                          "elementregion",
                                                          "modelregionid",
                                                          "material",
                                                          "materialids",
                                                          "materialid",
                                                          "matid",
                                                          "mat",
                                                          "physicalids",
                                                          "physical",
                                                          "physicalgroup",
                                                          "physicalgroups",
                                                          "tag",
                                                          "tags",
                                                          "celltags",
                                                          "celltag",
                                                          "cellscalars",
                                                          "domain",
                                                          "domainid",
                                                          "domainids",
                                                          "subdomain",
                                                          "attribute",
                                                          "attributes",
                                                          "subdomainid",
                                                          "subdomainids",
                                                          "elementblockids",
                                                          "elementblockid",
                                                          "blockid",
                                                          "blockids",
                                                          "objectid",
                                                          "partid",
                                                          "partids",
                                                          "bodyid",
                                                          "bodyids",
                                                          "cellmarkers",
                                                          "cellmarker",
                                                          "markers",
                                                          "elementmarkers",
                                                          "elementtag",
                                                          "elementtags",
                                                          "propertyid",
                                                          "groupid",
                                                          "elset",
                                                          "zoneid",
                                                          "zone",
                                                          "zones",
                                                          "geometryids",
                                                          "geometry",
                                                          "gmsh:geometrical"};

// How a mesh was divided among processes, and which cells belong to another: no regions.
constexpr std::array<std::string_view, 9> kDivisionNames = {
    "vtkghosttype", "vtkghostlevels", "vtkprocessid", "processid",   "process_id",
    "mpi_rank",     "rank",           "partition",    "partition_id"};

std::string in_lower_case(std::string_view name) {
  std::string lower(name.substr(0, 30));
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

/// "Region ID", "region_id" and "RegionId" are one name.
std::string plain_name(std::string_view name) {
  std::string plain = in_lower_case(name);
  std::erase_if(plain, [](char c) { return c == '_' || c == ' ' || c == '-'; });
  return plain;
}

std::size_t rank_of(std::string_view name) {
  const auto* found = std::find(kLabelNames.begin(), kLabelNames.end(), plain_name(name));
  return static_cast<std::size_t>(found - kLabelNames.begin());
}

bool tells_division(std::string_view name) {
  const std::string lower = in_lower_case(name);
  return std::find(kDivisionNames.begin(), kDivisionNames.end(), lower) != kDivisionNames.end();
}

bool is_integral(const DataArray& array) {
  return std::visit(
      [](const auto& values) {
        return std::is_integral_v<typename std::decay_t<decltype(values)>::value_type>;
      },
      array.values);
}

bool has_fractions(const DataArray& array) {
  if (is_integral(array)) return false;
  for (std::size_t i = 0; i < array.size(); ++i) {
    const double value = real_value(array, i);
    if (value != std::floor(value)) return true;  // also NaN
  }
  return false;
}

bool looks_like_labels(const DataArray& array) {
  std::set<double> values;
  for (std::size_t i = 0; i < array.size(); ++i) {
    values.insert(real_value(array, i));
    if (!is_few_labels(values.size(), array.size())) return false;
  }
  return true;
}

bool is_constant(const DataArray& array) {
  for (std::size_t k = 1; k < array.size(); ++k) {
    if (real_value(array, k) != real_value(array, 0)) return false;
  }
  return true;
}

/// The array of labels among those with a known name, and others of them that might tell more apart.
RegionArrays find_known_names(const std::vector<ArrayFacts>& arrays) {
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    const bool is_known = rank_of(arrays[i].name) < kLabelNames.size();
    if (is_known && arrays[i].components == 1 && !arrays[i].has_fractions()) known.push_back(i);
  }
  if (known.empty()) return {};
  const auto rank = [&](std::size_t i) { return rank_of(arrays[i].name); };
  std::stable_sort(known.begin(), known.end(),
                   [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  RegionArrays found{known.front(), {known.begin() + 1, known.end()}};
  std::erase_if(found.parts, [&](std::size_t i) {
    return arrays[i].is_constant() || !arrays[i].looks_like_labels();
  });
  return found;
}

/// Arrays whose name says nothing, but whose numbers could be labels: integers before others.
std::vector<std::size_t> find_candidates(const std::vector<ArrayFacts>& arrays) {
  std::vector<std::size_t> found;
  for (const bool integers : {true, false}) {
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      if (arrays[i].components != 1 || arrays[i].is_integral != integers) continue;
      if (!arrays[i].has_fractions() && arrays[i].looks_like_labels()) found.push_back(i);
    }
  }
  return found;
}

/// The array of labels, if only one can be meant; else all that might be one, which is noted.
RegionArrays guess_regions(const std::vector<ArrayFacts>& arrays, std::vector<std::string>& notes) {
  std::vector<std::size_t> candidates = find_candidates(arrays);
  const auto tells = [&](std::size_t i) { return !tells_division(arrays[i].name); };
  if (std::any_of(candidates.begin(), candidates.end(), tells)) {
    std::erase_if(candidates, [&](std::size_t i) { return !tells(i); });
  }
  const auto is_number = [&](std::size_t i) { return arrays[i].is_integral; };
  const auto integers = std::count_if(candidates.begin(), candidates.end(), is_number);
  if (integers == 1) return {candidates.front(), {}};
  // One value for all tells nothing apart.
  std::erase_if(candidates, [&](std::size_t i) { return arrays[i].is_constant(); });
  // Integers before others.
  if (std::any_of(candidates.begin(), candidates.end(), is_number)) {
    std::erase_if(candidates, [&](std::size_t i) { return !is_number(i); });
  }
  if (candidates.empty()) return {};
  if (candidates.size() == 1) return {candidates.front(), {}};
  std::vector<std::string> names;
  for (const std::size_t i : candidates) names.push_back(fmt::format("'{}'", arrays[i].name));
  notes.push_back(fmt::format(
      "no array has the name of labels: {} might hold them, so faces between different values of "
      "any of them stay; --label-array NAME says which one does, 'none' that none does",
      fmt::join(names, ", ")));
  return {std::nullopt, std::move(candidates)};
}

std::size_t find_wanted(const std::vector<ArrayFacts>& arrays, const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    if (arrays[i].name == name && arrays[i].components == 1) return i;
    names.push_back(arrays[i].name);
  }
  throw Error(fmt::format("no array of one number for each cell has the name '{}': there {} {}",
                          name, names.empty() ? "are" : "is",
                          names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

ArrayFacts facts_of(const DataArray& array) {
  return {array.name,
          array.components,
          is_integral(array),
          [&array] { return has_fractions(array); },
          [&array] { return looks_like_labels(array); },
          [&array] { return is_constant(array); }};
}

std::vector<Label> to_labels(const std::vector<DataArray>& arrays, std::size_t which,
                             const ArrayFailure& fail) {
  const DataArray& array = arrays[which];
  std::vector<Label> labels(array.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const double value = real_value(array, i);
    if (value != std::floor(value)) {
      fail(which, i, fmt::format("{} is no label: expected an integer", value));
    }
    if (!(value >= INT32_MIN && value <= INT32_MAX)) {
      fail(which, i,
           fmt::format("the label {} is out of range: expected {} to {}", value, INT32_MIN,
                       INT32_MAX));
    }
    labels[i] = static_cast<Label>(value);
  }
  return labels;
}

template <class Element>
void set_labels(std::vector<Element>& elements, std::span<const std::uint32_t> cells,
                const std::vector<Label>& labels) {
  for (std::size_t i = 0; i < elements.size(); ++i) elements[i].label = labels[cells[i]];
}

/// A part for each combination of values, in the order in which they come.
void set_parts(MeshData& mesh, const std::vector<DataArray>& arrays,
               std::span<const std::size_t> which, const CellNumbers& numbers) {
  if (which.empty()) return;
  std::map<std::vector<double>, Label> parts;
  std::vector<double> values(which.size());
  for (const std::uint32_t cell : numbers.tets) {
    for (std::size_t k = 0; k < which.size(); ++k) values[k] = real_value(arrays[which[k]], cell);
    const auto next = static_cast<Label>(parts.size() + 1);
    mesh.tet_parts.push_back(parts.try_emplace(values, next).first->second);
  }
}

/// Puts `count` numbers of `array`, or as many that say "none", behind those of `joined`.
void append_values(DataArray& joined, const DataArray* array, std::size_t count) {
  std::visit(
      [&](auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        if (array != nullptr) {
          const auto& more = std::get<std::vector<Value>>(array->values);
          values.insert(values.end(), more.begin(), more.end());
        } else {
          values.resize(values.size() + count, std::numeric_limits<Value>::quiet_NaN());
        }
      },
      joined.values);
}

/// Arrays, to be found by name, width and type, and which it is of those that are alike in these.
class ArrayIndex {
 public:
  explicit ArrayIndex(const std::vector<DataArray>& arrays) {
    for (const DataArray& array : arrays) alike_[key_of(array)].push_back(&array);
  }
  using Key = std::tuple<std::string_view, std::size_t, std::size_t>;
  static Key key_of(const DataArray& array) {
    return {array.name, array.components, array.values.index()};
  }
  /// Null: there is none.
  const DataArray* find_like(const DataArray& model, std::size_t which) const {
    const auto found = alike_.find(key_of(model));
    return found == alike_.end() || which >= found->second.size() ? nullptr : found->second[which];
  }

 private:
  std::map<Key, std::vector<const DataArray*>> alike_;
};

}  // namespace

bool is_few_labels(std::size_t different, std::size_t size) {
  return different <= std::min(kMostLabels, size / 2 + 1);
}

RegionArrays choose_region_arrays(const std::vector<ArrayFacts>& arrays, const std::string& wanted,
                                  std::vector<std::string>& notes) {
  if (!wanted.empty()) {
    const auto is_wanted = [&](const ArrayFacts& array) { return array.name == wanted; };
    if (wanted == "none" && std::none_of(arrays.begin(), arrays.end(), is_wanted)) return {};
    return {find_wanted(arrays, wanted), {}};
  }
  RegionArrays known = find_known_names(arrays);
  return known.labels ? known : guess_regions(arrays, notes);
}

bool is_point_label_array(std::string_view name) {
  return name == "CellEntityIds" || name == "medit:ref";
}

void adopt_cell_arrays(MeshData& mesh, std::vector<DataArray> arrays, const CellNumbers& numbers,
                       const LabelChoice& choice) {
  std::vector<ArrayFacts> facts;
  for (const DataArray& array : arrays) facts.push_back(facts_of(array));
  for (const VtkRole& role : roles_of(mesh)) {
    if (role.of_points || !is_id_role(role.role)) continue;
    for (ArrayFacts& array : facts) {
      if (array.name == role.array) array.looks_like_labels = [] { return false; };
    }
  }
  const RegionArrays regions = choose_region_arrays(facts, choice.wanted, mesh.notes);
  set_parts(mesh, arrays, regions.parts, numbers);
  if (const std::optional<std::size_t> which = regions.labels) {
    const std::vector<Label> labels = to_labels(arrays, *which, choice.fail);
    set_labels(mesh.tets, numbers.tets, labels);
    set_labels(mesh.triangles, numbers.triangles, labels);
    set_labels(mesh.edges, numbers.edges, labels);
    for (std::size_t k = 0; k < mesh.other_elements.size(); ++k) {
      for (std::size_t i = 0; i < numbers.others[k].size(); ++i) {
        mesh.other_elements[k].labels[i] = labels[numbers.others[k][i]];
      }
    }
    mesh.label_array = arrays[*which].name;
    if (!are_finer_than_labels(mesh.tets, mesh.tet_parts)) {
      mesh.tet_parts.clear();
    } else {
      std::vector<std::string> names;
      for (const std::size_t i : regions.parts)
        names.push_back(fmt::format("'{}'", arrays[i].name));
      mesh.notes.push_back(
          fmt::format("labels are those of '{}'; faces between different values of {} stay, too",
                      mesh.label_array, fmt::join(names, ", ")));
    }
    arrays.erase(arrays.begin() + static_cast<std::ptrdiff_t>(*which));
  }
  for (const DataArray& array : arrays) {
    if (!mesh.tets.empty()) mesh.tet_data.push_back(selected_rows(array, numbers.tets));
    if (!mesh.triangles.empty())
      mesh.triangle_data.push_back(selected_rows(array, numbers.triangles));
    if (!mesh.edges.empty()) mesh.edge_data.push_back(selected_rows(array, numbers.edges));
    for (std::size_t k = 0; k < mesh.other_elements.size(); ++k) {
      mesh.other_elements[k].data.push_back(selected_rows(array, numbers.others[k]));
    }
  }
}

void adopt_point_arrays(MeshData& mesh, std::vector<DataArray> arrays, const ArrayFailure& fail) {
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    if (!is_point_label_array(arrays[i].name) || arrays[i].components != 1 ||
        !is_integral(arrays[i]))
      continue;
    mesh.point_labels = to_labels(arrays, i, fail);
    drop_zero_point_labels(mesh);
    arrays.erase(arrays.begin() + static_cast<std::ptrdiff_t>(i));
    break;
  }
  mesh.point_data = std::move(arrays);
}

std::vector<DataArray> join_cell_arrays(const MeshData& mesh) {
  struct Kind {
    std::size_t count;
    const std::vector<DataArray>* arrays;
    ArrayIndex index;
  };
  std::vector<Kind> kinds;
  const auto add = [&](std::size_t count, const std::vector<DataArray>& arrays) {
    kinds.push_back({count, &arrays, ArrayIndex(arrays)});
  };
  add(mesh.tets.size(), mesh.tet_data);
  add(mesh.triangles.size(), mesh.triangle_data);
  add(mesh.edges.size(), mesh.edge_data);
  for (const OtherElements& other : mesh.other_elements) add(other.labels.size(), other.data);
  std::vector<DataArray> joined;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    std::map<ArrayIndex::Key, std::size_t> seen;
    for (const DataArray& model : *kinds[k].arrays) {
      const std::size_t which = seen[ArrayIndex::key_of(model)]++;
      const auto is_like = [&](const Kind& kind) {
        return kind.index.find_like(model, which) != nullptr;
      };
      const auto before = kinds.begin() + static_cast<std::ptrdiff_t>(k);
      if (std::any_of(kinds.begin(), before, is_like)) continue;
      DataArray& all = joined.emplace_back(DataArray{model.name, model.components, model.values});
      std::visit([](auto& values) { values.clear(); }, all.values);
      for (const Kind& kind : kinds) {
        append_values(all, kind.index.find_like(model, which), kind.count * model.components);
      }
    }
  }
  return joined;
}

DataArray selected_rows(const DataArray& array, std::span<const std::uint32_t> rows) {
  DataArray part{array.name, array.components, {}};
  std::visit(
      [&](const auto& all) {
        std::decay_t<decltype(all)> values;
        values.reserve(rows.size() * array.components);
        for (const std::uint32_t row : rows) {
          const auto* from = all.data() + row * array.components;
          values.insert(values.end(), from, from + array.components);
        }
        part.values = std::move(values);
      },
      array.values);
  return part;
}

double real_value(const DataArray& array, std::size_t i) {
  return std::visit([i](const auto& values) { return static_cast<double>(values[i]); },
                    array.values);
}

}  // namespace tetmend::formats
