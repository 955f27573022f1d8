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

std::vector<std::int32_t> given_labels(const Arrays& given, const std::string& name,
                                       std::size_t count) {
  const auto array = find(given, name);
  return array ? read_labels(name, *array, count) : std::vector<std::int32_t>();
}

template <std::size_t N>
void read(const Arrays& given, const char* name, const char* label_name, std::size_t points,
          std::vector<std::array<std::uint32_t, N>>& elements, std::vector<std::int32_t>& labels) {
  if (const auto array = find(given, name)) elements = read_elements<N>(name, *array, points);
  labels = given_labels(given, label_name, elements.size());
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

/// Ends of the edges of a tet of second order, in the order of their nodes: that of VTK.
constexpr std::array<std::array<std::size_t, 2>, 6> kEdges = {
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// (m, 4), or (m, 10) of second order.
void read_tets(const py::array& tets, std::size_t points, MeshArrays& arrays) {
  if (tets.ndim() != 2 || tets.shape(1) != 10) {
    arrays.tets = read_elements<4>("tets", tets, points);
    return;
  }
  const auto rows = read_elements<10>("tets", tets, points);
  arrays.tets.reserve(rows.size());
  arrays.mid_nodes.reserve(6 * rows.size());
  for (const auto& row : rows) {
    arrays.tets.push_back({row[0], row[1], row[2], row[3]});
    for (std::size_t e = 0; e < kEdges.size(); ++e) {
      const auto [a, b] = std::minmax(row[kEdges[e][0]], row[kEdges[e][1]]);
      arrays.mid_nodes.push_back({a, b, row[4 + e]});
    }
  }
}

using SecondOrderTets = std::vector<std::array<std::uint32_t, 10>>;

/// The nodes of all tets, in VTK's order; empty unless each of their edges has one.
SecondOrderTets with_mid_nodes(const Mesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> edges(mesh.mid_nodes().begin(), mesh.mid_nodes().end());
  for (auto& edge : edges) {
    if (edge[0] > edge[1]) std::swap(edge[0], edge[1]);
  }
  std::sort(edges.begin(), edges.end());
  SecondOrderTets made;
  made.reserve(mesh.tet_count());
  for (const auto& tet : mesh.tets()) {
    auto& row = made.emplace_back();
    std::copy(tet.begin(), tet.end(), row.begin());
    for (std::size_t e = 0; e < kEdges.size(); ++e) {
      const auto [a, b] = std::minmax(tet[kEdges[e][0]], tet[kEdges[e][1]]);
      const std::array<std::uint32_t, 3> first = {a, b, 0};
      const auto found = std::lower_bound(edges.begin(), edges.end(), first);
      if (found == edges.end() || (*found)[0] != a || (*found)[1] != b) return {};
      row[4 + e] = (*found)[2];
    }
  }
  return made;
}

/// The form in which tets are given and taken: (m, 4), or (m, 10) of second order.
py::array tet_array(const Mesh& mesh, const py::object& self) {
  if (mesh.mid_nodes().empty()) return view(mesh.tets(), self);
  auto kept = std::make_unique<SecondOrderTets>(with_mid_nodes(mesh));
  if (kept->empty()) return view(mesh.tets(), self);
  const std::span<const std::array<std::uint32_t, 10>> rows = *kept;
  const py::capsule owner(kept.release(), [](void* memory) {
    const std::unique_ptr<SecondOrderTets> last(static_cast<SecondOrderTets*>(memory));
  });
  return view(rows, owner);
}

/// Copies all arrays, once.
std::shared_ptr<Mesh> make_mesh(const py::array& points, const py::array& tets, const Arrays& given,
                                const std::vector<py::tuple>& groups) {
  MeshArrays arrays;
  arrays.points = read_points(points);
  const std::size_t n = arrays.points.size();
  read_tets(tets, n, arrays);
  arrays.tet_labels = given_labels(given, "labels", arrays.tets.size());
  arrays.tet_parts = given_labels(given, "parts", arrays.tets.size());
  arrays.point_labels = given_labels(given, "point_labels", n);
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
          made[to_text(array.name)] =
              view(py::dtype::of<Number>(), std::move(shape), numbers.data(), owner);
        },
        array.values);
  }
  return made;
}

/// As (dimension, number, name, members), those by label or part worked out.
py::list groups_of(const Mesh& mesh) {
  py::list made;
  for (const Group& group : mesh.groups()) {
    made.append(py::make_tuple(group.dimension, group.number, to_text(group.name),
                               to_array(mesh.members(group))));
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
  add_view(type, "tets", [](const Mesh& m, const py::object& self) { return tet_array(m, self); });
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
      .def_property_readonly("notes", [](const Mesh& mesh) { return to_texts(mesh.notes()); })
      .def_property_readonly("file",
                             [](const Mesh& mesh) { return to_text(mesh.file().string()); });
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
          notes = not_saved(file, mesh, variant);
          save(file, mesh, threads, variant);
        });
        return to_texts(notes);
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
