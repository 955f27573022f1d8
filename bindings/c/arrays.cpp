// SPDX-License-Identifier: MIT
// The part of the C interface that has to do with arrays: in, checked and copied, and out.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <span>
#include <string_view>
#include <utility>
#include <variant>

#include "bindings/c/handle.h"

namespace tetmend::c {

namespace {

constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();

/// The arrays of a mesh that may be changed.
MeshArrays& draft_of(tetmend_mesh& handle) {
  if (handle.is_from_file) {
    throw WrongCall("the mesh is from a file: tetmend_set_points() begins a new one");
  }
  if (!handle.is_draft) {
    handle.draft = std::move(handle.mesh).take_arrays();
    handle.is_draft = true;
  }
  return handle.draft;
}

std::string counted_from(std::int32_t first) {
  return ", counted from " + std::to_string(first);
}

/// "there are 12"
std::string there_are(std::size_t count) {
  return (count == 1 ? "there is " : "there are ") + std::to_string(count);
}

std::string place(const char* list, std::size_t i, std::int32_t first) {
  return std::string(list) + "[" + std::to_string(i + static_cast<std::size_t>(first)) + "]: ";
}

/// The number of a point as the library has it.
/// @throws Error with the place
std::uint32_t read_number(std::int32_t number, std::size_t points, const std::string& where,
                          std::int32_t first) {
  const std::int64_t index = std::int64_t{number} - first;
  if (index >= 0 && index < static_cast<std::int64_t>(points)) {
    return static_cast<std::uint32_t>(index);
  }
  throw Error(where + "no point " + std::to_string(number) + ", " + there_are(points) +
              counted_from(first));
}

template <std::size_t N>
std::string list_of(const std::int32_t* numbers) {
  std::string text = "(";
  for (std::size_t k = 0; k < N; ++k) text += (k == 0 ? "" : ", ") + std::to_string(numbers[k]);
  return text + "): ";
}

/// Into a list of its own, so that the old one stays when this fails.
template <std::size_t N>
std::vector<std::array<std::uint32_t, N>> read_elements(const char* name,
                                                        const std::int32_t* numbers, std::size_t n,
                                                        std::size_t points, std::int32_t first) {
  need(numbers, name, n > 0);
  if (n > kMost) throw WrongCall(std::string(name) + ": more than 2^31 - 1");
  std::vector<std::array<std::uint32_t, N>> elements(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t* const given = numbers + i * N;
    auto& element = elements[i];
    const auto is_known = [&](std::int32_t number) {
      const std::int64_t index = std::int64_t{number} - first;
      return index >= 0 && index < static_cast<std::int64_t>(points);
    };
    if (!std::all_of(given, given + N, is_known)) {
      const std::string where = place(name, i, first) + list_of<N>(given);
      for (std::size_t k = 0; k < N; ++k) read_number(given[k], points, where, first);
    }
    for (std::size_t k = 0; k < N; ++k) element[k] = static_cast<std::uint32_t>(given[k] - first);
    auto sorted = element;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) continue;
    throw Error(place(name, i, first) + list_of<N>(given) + "the same vertex twice" +
                counted_from(first));
  }
  return elements;
}

std::vector<std::int32_t> read_labels(const std::int32_t* labels, std::size_t n) {
  if (labels == nullptr) return {};
  return {labels, labels + n};
}

/// One kind of element into the draft; its data and groups, which belonged to the old ones, go.
template <std::size_t N>
void set_elements(tetmend_mesh& handle, const char* name, const std::int32_t* numbers,
                  std::size_t n, const std::int32_t* labels,
                  std::vector<std::array<std::uint32_t, N>> MeshArrays::*elements,
                  std::vector<std::int32_t> MeshArrays::*label_list,
                  std::vector<DataArray> MeshArrays::*data,
                  std::vector<std::int32_t> MeshArrays::*parts) {
  MeshArrays& draft = draft_of(handle);
  auto made = read_elements<N>(name, numbers, n, draft.points.size(), handle.first_number);
  auto made_labels = read_labels(labels, n);
  draft.*elements = std::move(made);
  draft.*label_list = std::move(made_labels);
  (draft.*data).clear();
  (draft.*parts).clear();
  std::erase_if(draft.groups,
                [](const Group& group) { return group.dimension == static_cast<int>(N) - 1; });
  handle.result.reset();
}

template <std::size_t N>
void get_elements(std::span<const std::array<std::uint32_t, N>> elements,
                  std::span<const std::int32_t> from_labels, const char* name,
                  std::int32_t* numbers, std::int32_t* labels, std::size_t n, std::int32_t first) {
  need_room(n, elements.size());
  need(numbers, name, !elements.empty());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    for (std::size_t k = 0; k < N; ++k) {
      numbers[i * N + k] = static_cast<std::int32_t>(elements[i][k]) + first;
    }
  }
  if (labels != nullptr) std::copy(from_labels.begin(), from_labels.end(), labels);
}

const char* name_of(tetmend_place place) {
  constexpr std::array<const char*, 4> kNames = {"points", "edges", "triangles", "tets"};
  return kNames[static_cast<std::size_t>(place)];
}

void check(tetmend_place place) {
  if (place < TETMEND_POINTS || place > TETMEND_TETS) throw WrongCall("there is no such place");
}

std::vector<DataArray>& data_of(MeshArrays& arrays, tetmend_place place) {
  const std::array lists = {&arrays.point_data, &arrays.edge_data, &arrays.triangle_data,
                            &arrays.tet_data};
  return *lists[static_cast<std::size_t>(place)];
}

const std::vector<DataArray>& data_of(const tetmend_mesh& handle, tetmend_place place) {
  if (handle.is_draft) return data_of(const_cast<MeshArrays&>(handle.draft), place);
  const std::array lists = {&handle.mesh.point_data(), &handle.mesh.edge_data(),
                            &handle.mesh.triangle_data(), &handle.mesh.tet_data()};
  return *lists[static_cast<std::size_t>(place)];
}

std::size_t count_of(const tetmend_mesh& handle, tetmend_place place) {
  const MeshArrays& draft = handle.draft;
  const Mesh& mesh = handle.mesh;
  const std::array counts = handle.is_draft ? std::array{draft.points.size(), draft.edges.size(),
                                                         draft.triangles.size(), draft.tets.size()}
                                            : std::array{mesh.point_count(), mesh.edge_count(),
                                                         mesh.triangle_count(), mesh.tet_count()};
  return counts[static_cast<std::size_t>(place)];
}

const std::vector<Group>& groups_of(const tetmend_mesh& handle) {
  return handle.is_draft ? handle.draft.groups : handle.mesh.groups();
}

const Group& group_of(const tetmend_mesh& handle, std::size_t i) {
  const std::vector<Group>& groups = groups_of(handle);
  if (i < groups.size()) return groups[i];
  throw WrongCall("no group " + std::to_string(i) + ", " + there_are(groups.size()) +
                  ", counted from 0");
}

/// @throws Error with the place
std::vector<std::uint32_t> read_members(const int32_t* members, std::size_t n, std::size_t count,
                                        tetmend_place of, std::int32_t first) {
  if (n > count) {  // one of them would come twice
    throw WrongCall(std::to_string(n) + " members of the " + name_of(of) + ", but " +
                    there_are(count));
  }
  std::vector<std::uint32_t> made(n);
  std::vector<bool> is_in(count, false);
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t index = std::int64_t{members[i]} - first;
    if (index < 0 || index >= static_cast<std::int64_t>(count)) {
      throw Error(place("members", i, first) + "no " + std::to_string(members[i]) + " of the " +
                  name_of(of) + ", " + there_are(count) + counted_from(first));
    }
    if (is_in[static_cast<std::size_t>(index)]) {
      throw Error(place("members", i, first) + std::to_string(members[i]) + " twice" +
                  counted_from(first));
    }
    is_in[static_cast<std::size_t>(index)] = true;
    made[i] = static_cast<std::uint32_t>(index);
  }
  return made;
}

template <class Value>
DataArray::Values copied(const void* values, std::size_t n) {
  const Value* const first = static_cast<const Value*>(values);
  return std::vector<Value>(first, first + n);
}

DataArray::Values copied(tetmend_type type, const void* values, std::size_t n) {
  switch (type) {
    case TETMEND_INT32:
      return copied<std::int32_t>(values, n);
    case TETMEND_INT64:
      return copied<std::int64_t>(values, n);
    case TETMEND_FLOAT:
      return copied<float>(values, n);
    case TETMEND_DOUBLE:
      return copied<double>(values, n);
  }
  throw WrongCall("there is no such type");
}

}  // namespace

}  // namespace tetmend::c

using namespace tetmend;
using namespace tetmend::c;

tetmend_status tetmend_set_points(tetmend_mesh* mesh, const double* xyz, size_t n) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    need(xyz, "xyz", n > 0);
    if (n > kMost) throw WrongCall("points: more than 2^31 - 1");
    MeshArrays arrays;
    arrays.points.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double* const p = xyz + 3 * i;
      arrays.points[i] = {p[0], p[1], p[2]};
      if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])) continue;
      throw Error(place("points", i, handle.first_number) + "not finite" +
                  counted_from(handle.first_number));
    }
    handle.mesh = Mesh();
    handle.draft = std::move(arrays);
    handle.is_draft = true;
    handle.is_from_file = false;
    handle.result.reset();
    handle.notes.clear();
  });
}

tetmend_status tetmend_set_tets(tetmend_mesh* mesh, const int32_t* tets, size_t n,
                                const int32_t* labels) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    set_elements<4>(handle, "tets", tets, n, labels, &MeshArrays::tets, &MeshArrays::tet_labels,
                    &MeshArrays::tet_data, &MeshArrays::tet_parts);
  });
}

tetmend_status tetmend_set_triangles(tetmend_mesh* mesh, const int32_t* triangles, size_t n,
                                     const int32_t* labels) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    set_elements<3>(handle, "triangles", triangles, n, labels, &MeshArrays::triangles,
                    &MeshArrays::triangle_labels, &MeshArrays::triangle_data,
                    &MeshArrays::triangle_parts);
  });
}

tetmend_status tetmend_set_edges(tetmend_mesh* mesh, const int32_t* edges, size_t n,
                                 const int32_t* labels) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    set_elements<2>(handle, "edges", edges, n, labels, &MeshArrays::edges, &MeshArrays::edge_labels,
                    &MeshArrays::edge_data, &MeshArrays::edge_parts);
  });
}

tetmend_status tetmend_set_point_labels(tetmend_mesh* mesh, const int32_t* labels) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    MeshArrays& draft = draft_of(handle);
    need(labels, "labels", !draft.points.empty());
    draft.point_labels = read_labels(labels, draft.points.size());
  });
}

tetmend_status tetmend_set_required_vertices(tetmend_mesh* mesh, const int32_t* vertices,
                                             size_t n) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    MeshArrays& draft = draft_of(handle);
    need(vertices, "vertices", n > 0);
    if (n > kMost) throw WrongCall("required vertices: more than 2^31 - 1");
    const std::int32_t first = handle.first_number;
    std::vector<std::uint32_t> made(n);
    for (std::size_t i = 0; i < n; ++i) {
      made[i] = read_number(vertices[i], draft.points.size(), place("required_vertices", i, first),
                            first);
    }
    draft.required_vertices = std::move(made);
  });
}

tetmend_status tetmend_set_data(tetmend_mesh* mesh, tetmend_place place, const char* name,
                                tetmend_type type, size_t components, const void* values) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    check(place);
    need(name, "name");
    MeshArrays& draft = draft_of(handle);
    const std::size_t count = count_of(handle, place);
    need(values, "values", count > 0);
    if (components == 0 || components > kMost) {
      throw WrongCall(std::string("data '") + name + "' have no sensible number of components");
    }
    DataArray made{name, components, copied(type, values, count * components)};
    std::vector<DataArray>& list = data_of(draft, place);
    const auto old = std::find_if(list.begin(), list.end(),
                                  [&](const DataArray& array) { return array.name == name; });
    if (old == list.end()) {
      list.push_back(std::move(made));
    } else {
      *old = std::move(made);
    }
  });
}

tetmend_status tetmend_set_group(tetmend_mesh* mesh, tetmend_place place, int32_t number,
                                 const char* name, const int32_t* members, size_t n) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    check(place);
    need(name, "name");
    need(members, "members", n > 0);
    MeshArrays& draft = draft_of(handle);
    Group made;
    made.dimension = static_cast<int>(place);
    made.number = number;
    made.name = name;
    made.members = read_members(members, n, count_of(handle, place), place, handle.first_number);
    for (Group& group : draft.groups) {
      if (group.dimension != made.dimension || group.number != number) continue;
      if (group.name == made.name) {
        group = std::move(made);
        return;
      }
      if (number == 0) continue;
      throw Error("group '" + made.name + "': number " + std::to_string(number) +
                  " is that of group '" + group.name + "'");
    }
    draft.groups.push_back(std::move(made));
  });
}

size_t tetmend_count(const tetmend_mesh* mesh, tetmend_place place) {
  if (mesh == nullptr || place < TETMEND_POINTS || place > TETMEND_TETS) return 0;
  return count_of(*mesh, place);
}

tetmend_status tetmend_get_points(tetmend_mesh* mesh, double* xyz, size_t n) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    const auto points = settle(handle).points();
    need_room(n, points.size());
    need(xyz, "xyz", !points.empty());
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::copy(points[i].begin(), points[i].end(), xyz + 3 * i);
    }
  });
}

tetmend_status tetmend_get_tets(tetmend_mesh* mesh, int32_t* tets, int32_t* labels, size_t n) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    const Mesh& settled = settle(handle);
    get_elements(settled.tets(), settled.tet_labels(), "tets", tets, labels, n,
                 handle.first_number);
  });
}

tetmend_status tetmend_get_triangles(tetmend_mesh* mesh, int32_t* triangles, int32_t* labels,
                                     size_t n) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    const Mesh& settled = settle(handle);
    get_elements(settled.triangles(), settled.triangle_labels(), "triangles", triangles, labels, n,
                 handle.first_number);
  });
}

tetmend_status tetmend_get_edges(tetmend_mesh* mesh, int32_t* edges, int32_t* labels, size_t n) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    const Mesh& settled = settle(handle);
    get_elements(settled.edges(), settled.edge_labels(), "edges", edges, labels, n,
                 handle.first_number);
  });
}

tetmend_status tetmend_get_point_labels(tetmend_mesh* mesh, int32_t* labels, size_t n) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    const Mesh& settled = settle(handle);
    need_room(n, settled.point_count());
    need(labels, "labels", settled.point_count() > 0);
    const auto all = settled.point_labels();
    if (all.empty()) {
      std::fill_n(labels, settled.point_count(), 0);
    } else {
      std::copy(all.begin(), all.end(), labels);
    }
  });
}

size_t tetmend_data_count(const tetmend_mesh* mesh, tetmend_place place) {
  if (mesh == nullptr || place < TETMEND_POINTS || place > TETMEND_TETS) return 0;
  return data_of(*mesh, place).size();
}

tetmend_status tetmend_data_info(tetmend_mesh* mesh, tetmend_place place, size_t i,
                                 const char** name, tetmend_type* type, size_t* components) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    check(place);
    const std::vector<DataArray>& list = data_of(handle, place);
    if (i >= list.size()) {
      throw WrongCall("no array " + std::to_string(i) + " of " + name_of(place) + ", " +
                      there_are(list.size()) + ", counted from 0");
    }
    if (name != nullptr) *name = list[i].name.c_str();
    if (type != nullptr) *type = static_cast<tetmend_type>(list[i].values.index());
    if (components != nullptr) *components = list[i].components;
  });
}

tetmend_status tetmend_get_data(tetmend_mesh* mesh, tetmend_place place, const char* name,
                                tetmend_type type, void* values, size_t n) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    check(place);
    need(name, "name");
    const std::vector<DataArray>& list = data_of(handle, place);
    const auto array = std::find_if(list.begin(), list.end(),
                                    [&](const DataArray& each) { return each.name == name; });
    if (array == list.end()) {
      throw WrongCall(std::string(name_of(place)) + " have no data '" + name + "'");
    }
    if (static_cast<std::size_t>(type) != array->values.index()) {
      throw WrongCall(std::string("data '") + name + "' are of another type");
    }
    need_room(n, array->size());
    need(values, "values", array->size() > 0);
    std::visit(
        [&](const auto& numbers) {
          if (!numbers.empty()) {
            std::memcpy(values, numbers.data(), numbers.size() * sizeof(numbers[0]));
          }
        },
        array->values);
  });
}

size_t tetmend_group_count(const tetmend_mesh* mesh) {
  return mesh == nullptr ? 0 : groups_of(*mesh).size();
}

tetmend_status tetmend_group_info(tetmend_mesh* mesh, size_t i, tetmend_place* place,
                                  int32_t* number, const char** name, size_t* count) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    const Mesh& settled = settle(handle);
    const Group& group = group_of(handle, i);
    if (place != nullptr) *place = static_cast<tetmend_place>(group.dimension);
    if (number != nullptr) *number = group.number;
    if (name != nullptr) *name = group.name.c_str();
    if (count != nullptr) *count = settled.members(group).size();
  });
}

tetmend_status tetmend_get_group(tetmend_mesh* mesh, size_t i, int32_t* members, size_t n) {
  return guarded(mesh, [&](tetmend_mesh& handle) {
    const Mesh& settled = settle(handle);
    const std::vector<std::uint32_t> found = settled.members(group_of(handle, i));
    need_room(n, found.size());
    need(members, "members", !found.empty());
    std::transform(found.begin(), found.end(), members, [&](std::uint32_t member) {
      return static_cast<std::int32_t>(member) + handle.first_number;
    });
  });
}
