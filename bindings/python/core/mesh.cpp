// SPDX-License-Identifier: MIT
// A mesh: of arrays, from a file, to a file, and as read-only views of its arrays.
#include "bindings/python/core/mesh.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <tetmend/io.h>
#include <tetmend/mesh.h>

#include "bindings/python/core/arrays.h"
#include "bindings/python/core/detached.h"

namespace tetmend::python {

using namespace py::literals;

namespace {

using Arrays = std::map<std::string, py::object>;  ///< by the name of the argument; none: left out

/// @returns nothing where the array was left out
std::optional<py::array> find(const Arrays& given, const std::string& name) {
  const auto found = given.find(name);
  if (found == given.end() || found->second.is_none()) return {};
  return found->second.cast<py::array>();
}

std::vector<std::int32_t> labels_of(const Arrays& given, const std::string& name,
                                    std::size_t count) {
  const auto array = find(given, name);
  return array ? read_labels(name, *array, count) : std::vector<std::int32_t>();
}

template <std::size_t N>
void read(const Arrays& given, const char* name, const char* label_name, std::size_t points,
          std::vector<std::array<std::uint32_t, N>>& elements, std::vector<std::int32_t>& labels) {
  if (const auto array = find(given, name)) elements = read_elements<N>(name, *array, points);
  labels = labels_of(given, label_name, elements.size());
}

std::vector<DataArray> data_of(const Arrays& given, const std::string& name) {
  std::vector<DataArray> made;
  const auto found = given.find(name);
  if (found == given.end() || found->second.is_none()) return made;
  for (const auto& [key, values] : found->second.cast<py::dict>()) {
    made.push_back(read_data(py::str(key), values.cast<py::array>()));
  }
  return made;
}

const char* plural_of(int dimension) {
  constexpr std::array<const char*, 4> kNames = {"points", "edges", "triangles", "tets"};
  return kNames[static_cast<std::size_t>(dimension)];
}

Group to_group(const py::tuple& given, std::size_t i, const MeshArrays& arrays) {
  Group group;
  group.dimension = given[0].cast<int>();
  group.number = given[1].cast<std::int32_t>();
  group.name = given[2].cast<std::string>();
  const std::string place = "groups[" + std::to_string(i) + "]";
  if (group.dimension < 0 || group.dimension > 3) {
    throw Error(place + ": dimension " + std::to_string(group.dimension) + ", expected 0 to 3");
  }
  if (given[3].is_none()) return group;
  const std::array counts = {arrays.points.size(), arrays.edges.size(), arrays.triangles.size(),
                             arrays.tets.size()};
  group.members =
      read_indices(place + ".members", given[3].cast<py::array>(),
                   counts[static_cast<std::size_t>(group.dimension)], plural_of(group.dimension));
  return group;
}

/// Copies all arrays, once.
std::shared_ptr<Mesh> make_mesh(const py::array& points, const py::array& tets, const Arrays& given,
                                const std::vector<py::tuple>& groups) {
  MeshArrays arrays;
  arrays.points = read_points(points);
  const std::size_t n = arrays.points.size();
  arrays.tets = read_elements<4>("tets", tets, n);
  arrays.tet_labels = labels_of(given, "labels", arrays.tets.size());
  arrays.tet_parts = labels_of(given, "parts", arrays.tets.size());
  arrays.point_labels = labels_of(given, "point_labels", n);
  read<3>(given, "triangles", "triangle_labels", n, arrays.triangles, arrays.triangle_labels);
  read<2>(given, "edges", "edge_labels", n, arrays.edges, arrays.edge_labels);
  if (const auto required = find(given, "required")) {
    arrays.required_vertices = read_indices("required", *required, n, "points");
  }
  arrays.point_data = data_of(given, "point_data");
  arrays.tet_data = data_of(given, "cell_data");
  arrays.triangle_data = data_of(given, "triangle_data");
  arrays.edge_data = data_of(given, "edge_data");
  for (std::size_t i = 0; i < groups.size(); ++i) {
    arrays.groups.push_back(to_group(groups[i], i, arrays));
  }
  std::shared_ptr<Mesh> mesh;
  run_detached([&] { mesh = std::make_shared<Mesh>(std::move(arrays)); });
  return mesh;
}

py::dict view_data(const std::vector<DataArray>& list, const py::handle& owner) {
  py::dict made;
  for (const DataArray& array : list) {
    std::visit(
        [&](const auto& numbers) {
          using Number = typename std::decay_t<decltype(numbers)>::value_type;
          const auto n = static_cast<py::ssize_t>(numbers.size() / array.components);
          std::vector<py::ssize_t> shape = {n};
          if (array.components != 1) shape.push_back(static_cast<py::ssize_t>(array.components));
          made[py::str(array.name)] =
              view(py::dtype::of<Number>(), std::move(shape), numbers.data(), owner);
        },
        array.values);
  }
  return made;
}

/// As (dimension, number, name, members or None), members by label or part worked out.
py::list groups_of(const Mesh& mesh) {
  py::list made;
  if (mesh.groups().empty()) return made;
  const MeshArrays& arrays = mesh.arrays();
  const std::array parts = {static_cast<const std::vector<std::int32_t>*>(nullptr),
                            &arrays.edge_parts, &arrays.triangle_parts, &arrays.tet_parts};
  const std::array labels = {&arrays.point_labels, &arrays.edge_labels, &arrays.triangle_labels,
                             &arrays.tet_labels};
  for (const Group& group : mesh.groups()) {
    std::vector<std::uint32_t> members = group.members;
    const auto d = static_cast<std::size_t>(group.dimension);
    if (members.empty()) {
      const bool by_part = !group.parts.empty() && parts[d] != nullptr;
      const std::vector<std::int32_t>& words = by_part ? *parts[d] : *labels[d];
      for (std::size_t i = 0; i < words.size(); ++i) {
        const bool is_in = by_part ? std::find(group.parts.begin(), group.parts.end(), words[i]) !=
                                         group.parts.end()
                                   : words[i] == group.number && group.parts.empty();
        if (is_in) members.push_back(static_cast<std::uint32_t>(i));
      }
    }
    made.append(
        py::make_tuple(group.dimension, group.number, group.name, to_array(std::move(members))));
  }
  return made;
}

const Mesh& mesh_of(const py::object& self) {
  return *self.cast<std::shared_ptr<Mesh>>();
}

/// Adds a property whose arrays are views that keep the mesh alive.
template <class Get>
void add_view(py::class_<Mesh, std::shared_ptr<Mesh>>& type, const char* name, const Get& get) {
  type.def_property_readonly(
      name, [get](const py::object& self) -> py::object { return get(mesh_of(self), self); });
}

void add_views(py::class_<Mesh, std::shared_ptr<Mesh>>& type) {
  add_view(type, "points", [](const Mesh& mesh, const py::object& self) {
    const auto points = mesh.points();
    return view(py::dtype::of<double>(), {static_cast<py::ssize_t>(points.size()), 3},
                points.data(), self);
  });
  add_view(type, "tets",
           [](const Mesh& m, const py::object& self) { return view(m.tets(), self); });
  add_view(type, "triangles",
           [](const Mesh& m, const py::object& self) { return view(m.triangles(), self); });
  add_view(type, "edges",
           [](const Mesh& m, const py::object& self) { return view(m.edges(), self); });
  add_view(type, "labels",
           [](const Mesh& m, const py::object& self) { return view(m.tet_labels(), self); });
  add_view(type, "parts", [](const Mesh& mesh, const py::object& self) {
    return view(std::span(mesh.arrays().tet_parts), self);
  });
  add_view(type, "triangle_labels",
           [](const Mesh& m, const py::object& self) { return view(m.triangle_labels(), self); });
  add_view(type, "edge_labels",
           [](const Mesh& m, const py::object& self) { return view(m.edge_labels(), self); });
  add_view(type, "point_labels",
           [](const Mesh& m, const py::object& self) { return view(m.point_labels(), self); });
  add_view(type, "required", [](const Mesh& mesh, const py::object& self) {
    const auto vertices = mesh.required_vertices();
    return view(py::dtype::of<std::int32_t>(), {static_cast<py::ssize_t>(vertices.size())},
                vertices.data(), self);
  });
  add_view(type, "point_data",
           [](const Mesh& m, const py::object& self) { return view_data(m.point_data(), self); });
  add_view(type, "cell_data",
           [](const Mesh& m, const py::object& self) { return view_data(m.tet_data(), self); });
  add_view(type, "triangle_data", [](const Mesh& m, const py::object& self) {
    return view_data(m.triangle_data(), self);
  });
  add_view(type, "edge_data",
           [](const Mesh& m, const py::object& self) { return view_data(m.edge_data(), self); });
}

}  // namespace

void add_mesh(py::module_& module) {
  py::class_<Mesh, std::shared_ptr<Mesh>> type(module, "Mesh");
  type.def(py::init(&make_mesh), "points"_a, "tets"_a, "arrays"_a, "groups"_a)
      .def("copy",
           [](const Mesh& mesh) {
             std::shared_ptr<Mesh> copy;
             run_detached([&] { copy = std::make_shared<Mesh>(mesh); });
             return copy;
           })
      .def_property_readonly("point_count", &Mesh::point_count)
      .def_property_readonly("tet_count", &Mesh::tet_count)
      .def_property_readonly("groups", &groups_of)
      .def_property_readonly("notes", &Mesh::notes)
      .def_property_readonly("file", [](const Mesh& mesh) { return mesh.file().string(); });
  add_views(type);
  module.def(
      "load",
      [](const std::filesystem::path& file, int threads, const std::string& label_array) {
        std::shared_ptr<Mesh> mesh;
        run_detached([&] { mesh = std::make_shared<Mesh>(load(file, threads, label_array)); });
        return mesh;
      },
      "file"_a, "threads"_a, "label_array"_a);
  module.def(
      "save",
      [](const std::filesystem::path& file, const Mesh& mesh, int threads,
         const std::string& variant) {
        std::vector<std::string> notes;
        run_detached([&] {
          notes = not_saved(file, mesh);
          save(file, mesh, threads, variant);
        });
        return notes;
      },
      "file"_a, "mesh"_a, "threads"_a, "variant"_a);
  module.def("file_formats", [] {
    std::vector<std::pair<std::string, std::string>> made;
    for (const FileFormat& format : file_formats())
      made.emplace_back(format.extension, format.name);
    return made;
  });
}

}  // namespace tetmend::python
