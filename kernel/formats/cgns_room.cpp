// SPDX-License-Identifier: MIT
// What CGNS has no place for.
#include <algorithm>

#include <fmt/format.h>

#include "kernel/formats/cgns.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/label_names.h"
#include "kernel/printable.h"

namespace tetmend::formats {

bool is_cgns_name(std::string_view name) {
  return fits(name, kCgnsNames);
}

UniqueNames cgns_array_names() {
  UniqueNames names(kCgnsNames);
  names.take(kCgnsLocation);
  return names;
}

std::size_t cgns_pieces_to_miss(const MeshData& mesh) {
  return static_cast<std::size_t>(
      std::count_if(mesh.deck.begin(), mesh.deck.end(),
                    [](const std::string& piece) { return !piece.starts_with("name "); }));
}

std::vector<std::string> not_in_cgns(const std::filesystem::path&, const MeshData& mesh) {
  std::vector<std::string> notes;
  const MeshView view(mesh);
  const ElementLists lists(view);
  const auto volumes = lists.of_dimension(3);
  const auto is_everywhere = [&](const DataArray& array) {
    return std::all_of(volumes.begin(), volumes.end(), [&](const ElementList* list) {
      return list->data != nullptr && find_like(*list->data, array) != nullptr;
    });
  };
  note_component_arrays(mesh.point_data, kCgnsAxes, cgns_array_names(), ".cgns", notes);
  for (const ElementList* list : volumes) {
    if (list->data == nullptr) continue;
    note_component_arrays(*list->data, kCgnsAxes, cgns_array_names(), ".cgns", notes);
    for (const DataArray& array : *list->data) {
      if (is_everywhere(array)) continue;
      notes.push_back(fmt::format("the array '{}' is not kept: not all volumes have it",
                                  printable(array.name)));
    }
  }
  const LabelNames names(mesh);
  std::size_t lost = 0;
  for (const int dimension : {1, 3}) {
    const auto named = names.named(dimension);
    for (const Group& group : mesh.groups) {
      if (group.dimension != dimension || group.name.empty()) continue;
      lost += std::none_of(named.begin(), named.end(),
                           [&](const auto& each) { return each.second == &group; });
    }
  }
  std::size_t twice = 0;
  for (const Group& points : mesh.groups) {
    if (points.dimension != 0) continue;
    twice += std::any_of(mesh.groups.begin(), mesh.groups.end(), [&](const Group& group) {
      return group.dimension == 2 && group.name == points.name;
    });
  }
  if (twice > 0) {
    notes.push_back(
        fmt::format("{} names of groups of points get a number: .cgns has each name once", twice));
  }
  if (lost > 0) {
    notes.push_back(fmt::format(
        "{} groups, with their names, are not kept: .cgns has names of whole labels", lost));
  }
  return notes;
}

}  // namespace tetmend::formats
