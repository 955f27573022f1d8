// SPDX-License-Identifier: MIT
// A mesh goes from each format to each other and back: every value is there again, or its loss was
// named.
#include <algorithm>
#include <bit>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "contract/zoo.h"
#include "kernel/formats/label_names.h"
#include "kernel/formats/mesh_io.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/second_order.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// One value of a mesh, whatever the order of points and elements.
struct Fact {
  std::string what;       ///< as the note says when it is lost
  std::string detail;     ///< with the places of its vertices, bit for bit
  std::string name = {};  ///< says the same: a label with a name may get another number
  friend auto operator<=>(const Fact&, const Fact&) = default;
};

class Facts {
 public:
  explicit Facts(const MeshData& mesh) : mesh_(mesh), names_(mesh) {
    add_points();
    add_elements("tets", 3, mesh.tets, mesh.tet_data);
    add_elements("triangles", 2, mesh.triangles, mesh.triangle_data);
    add_elements("edges", 1, mesh.edges, mesh.edge_data);
    add_others();
    add_groups();
    for (const auto& [a, b, node] : mesh.mid_nodes) {
      facts_.push_back(
          {"mid-side nodes", place(std::min(a, b)) + place(std::max(a, b)) + place(node)});
    }
    for (const std::uint32_t v : mesh.required_vertices)
      facts_.push_back({"required", place(v), {}});
    std::sort(facts_.begin(), facts_.end());
  }
  const std::vector<Fact>& list() const { return facts_; }

 private:
  std::string place(std::uint32_t v) const {
    std::string text;
    for (int axis = 0; axis < 3; ++axis) {
      text += fmt::format("{:016x} ", std::bit_cast<std::uint64_t>(mesh_.points[v][axis]));
    }
    return text;
  }
  template <class Vertices>
  std::string places(const Vertices& vertices) const {
    std::string text;
    for (const std::uint32_t v : vertices) text += place(v);
    return text;
  }
  void add_data(const std::vector<DataArray>& arrays, std::size_t row, const std::string& at) {
    for (const DataArray& array : arrays) {
      if (array.name.starts_with("netgen:"))
        continue;  // of triangles and edges; VTK gives all some
      std::visit(
          [&](const auto& values) {
            for (std::size_t k = 0; k < array.components; ++k) {
              facts_.push_back(
                  {fmt::format("'{}'", array.name),
                   fmt::format("{}[{}] = {}", at, k, values[row * array.components + k])});
            }
          },
          array.values);
    }
  }
  void add_points() {
    for (std::uint32_t v = 0; v < mesh_.points.size(); ++v) {
      const bool is_node = std::any_of(mesh_.mid_nodes.begin(), mesh_.mid_nodes.end(),
                                       [&](const auto& mid) { return mid[2] == v; });
      facts_.push_back({is_node ? "mid-side nodes" : "points", place(v)});
      if (!mesh_.point_labels.empty() && mesh_.point_labels[v] != 0) {
        facts_.push_back(
            {"labels of points", fmt::format("{}: {}", place(v), mesh_.point_labels[v])});
      }
      add_data(mesh_.point_data, v, place(v));
    }
  }
  template <class Element>
  void add_elements(const std::string& what, int dimension, const std::vector<Element>& elements,
                    const std::vector<DataArray>& data) {
    const auto names = names_.named(dimension);
    // One label for all tells nothing apart: formats need not keep it.
    const bool tell_apart = std::any_of(elements.begin(), elements.end(), [&](const Element& one) {
      return one.label != elements.front().label;
    });
    for (std::size_t i = 0; i < elements.size(); ++i) {
      auto vertices = elements[i].vertices;
      // A deck names triangles as faces of tets, whose order has a sense of its own.
      if (dimension == 2) {
        std::sort(vertices.begin(), vertices.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
      }
      const std::string at = places(vertices);
      facts_.push_back({what, at});
      const auto name = names.find(elements[i].label);
      const std::string by_name = name == names.end() ? "" : at + name->second->name;
      if (tell_apart) {
        facts_.push_back(
            {"labels of " + what, fmt::format("{}: {}", at, elements[i].label), by_name});
      }
      add_data(data, i, at);
    }
  }
  void add_others() {
    for (const OtherElements& others : mesh_.other_elements) {
      for (std::size_t i = 0; i < others.labels.size(); ++i) {
        const std::span<const std::uint32_t> vertices(&others.vertices[i * others.vertex_count],
                                                      others.vertex_count);
        facts_.push_back({fmt::format("type {}", others.vtk_type), places(vertices)});
        add_data(others.data, i, places(vertices));
      }
    }
  }
  /// Names alone: how a group has its members depends on the format.
  void add_groups() {
    for (const Group& group : mesh_.groups) {
      if (!group.name.empty())
        facts_.push_back({"groups", fmt::format("{} {}", group.dimension, group.name), {}});
    }
  }

  const MeshData& mesh_;
  formats::LabelNames names_;
  std::vector<Fact> facts_;
};

MeshData rich_mesh() {
  MeshData mesh = contract::kuhn_cube(2, 0.1, 1);
  std::vector<double> heat;
  std::vector<std::int32_t> count;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    heat.push_back(0.1 * static_cast<double>(i));
    heat.push_back(-1.0 / static_cast<double>(i + 3));
    count.push_back(static_cast<std::int32_t>(7 * i));
  }
  mesh.point_data = {{"heat", 2, heat}, {"count", 1, count}};
  std::vector<double> stress;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    mesh.tets[t].label = static_cast<Label>(1 + t % 2);
    stress.push_back(1e-3 * static_cast<double>(t));
  }
  mesh.tet_data = {{"stress", 1, stress}};
  const auto& v = mesh.tets[0].vertices;
  mesh.triangles = {{{v[0], v[1], v[2]}, 4}, {{v[1], v[2], v[3]}, 5}};
  mesh.triangle_data = {{"stress", 1, std::vector<double>{5, 6}}};
  mesh.edges = {{{v[2], v[3]}, 6}};
  mesh.edge_data = {{"stress", 1, std::vector<double>{-1}}};
  mesh.groups = {{3, 1, "steel", {}, {}},
                 {3, 2, "glass", {}, {}},
                 {2, 4, "inlet", {}, {}},
                 {2, 5, "outlet", {}, {}},
                 {1, 6, "rim", {}, {}}};
  return mesh;
}

MeshData with_prism() {
  MeshData mesh = rich_mesh();
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  for (const double z : {2.0, 3.0}) {
    for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(1.0, 0.0), std::pair(0.0, 1.0)}) {
      mesh.points.push_back({x, y, z});
    }
  }
  mesh.point_data.clear();
  mesh.tet_data.clear();
  mesh.triangle_data.clear();
  mesh.edge_data.clear();
  OtherElements prism;
  prism.vtk_type = 13;
  prism.vertex_count = 6;
  for (std::uint32_t k = 0; k < 6; ++k) prism.vertices.push_back(first + k);
  prism.labels = {1};
  mesh.other_elements = {prism};
  return mesh;
}

std::string list_of_missing(const std::vector<Fact>& before, const std::vector<Fact>& after,
                            const std::vector<std::string>& notes) {
  std::set<std::pair<std::string, std::string>> there;
  for (const Fact& fact : after) {
    there.emplace(fact.what, fact.detail);
    there.emplace(fact.what, fact.name);
  }
  std::vector<Fact> missing = before;
  std::erase_if(missing, [&](const Fact& fact) {
    return there.contains({fact.what, fact.detail}) ||
           (!fact.name.empty() && there.contains({fact.what, fact.name}));
  });
  std::erase_if(missing, [&](const Fact& fact) {
    return std::any_of(notes.begin(), notes.end(), [&](const std::string& note) {
      return note.find(fact.what) != std::string::npos;
    });
  });
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(missing.size(), 3); ++i) {
    text += missing[i].what + ": " + missing[i].detail + "\n";
  }
  return text;
}

/// Writes to the format of `file` and reads back; all that is missing must have been named.
MeshData pass(const MeshData& mesh, const std::filesystem::path& file) {
  CAPTURE(file.filename().string());
  const std::vector<std::string> notes = not_written(file, mesh);
  write_mesh(file, mesh);
  const MeshData back = read_mesh(file);
  CHECK(list_of_missing(Facts(mesh).list(), Facts(back).list(), notes) == "");
  return back;
}

}  // namespace

TEST_CASE("of arrays of one name and type none is lost in formats with arrays over all cells") {
  MeshData mesh = contract::two_tets();
  mesh.triangles = {{{0, 1, 2}, 3}};
  mesh.tet_data = {{"stress", 1, std::vector<double>{1.5, 2.5}},
                   {"stress", 1, std::vector<double>{3.5, 4.5}}};
  mesh.triangle_data = {{"stress", 1, std::vector<double>{5.5}}};
  const std::vector<double> heat(mesh.points.size(), 0.5);
  mesh.point_data = {{"heat", 1, heat}, {"heat", 1, std::vector<double>(heat.size(), 7.5)}};
  const TempFolder folder;
  for (const std::string name : {"a.vtu", "a.vtk"}) {
    CAPTURE(name);
    write_mesh(folder / name, mesh);
    const MeshData back = read_mesh(folder / name);
    REQUIRE(back.point_data.size() == 2);
    CHECK(std::get<std::vector<double>>(back.point_data[0].values) == heat);
    REQUIRE(back.tet_data.size() == 2);
    CHECK(std::get<std::vector<double>>(back.tet_data[0].values) == std::vector<double>{1.5, 2.5});
    CHECK(std::get<std::vector<double>>(back.tet_data[1].values) == std::vector<double>{3.5, 4.5});
    CHECK(std::get<std::vector<double>>(back.triangle_data[0].values) == std::vector<double>{5.5});
  }
  CHECK(not_written(folder / "a.msh", mesh) ==
        std::vector<std::string>{
            "the second array 'heat' of points is not kept: .msh has one of a name",
            "the second array 'stress' of tets is not kept: .msh has one of a name"});
  write_mesh(folder / "a.msh", mesh);
  const MeshData back = read_mesh(folder / "a.msh");
  REQUIRE(back.tet_data.size() == 1);
  CHECK(std::get<std::vector<double>>(back.tet_data[0].values) == std::vector<double>{1.5, 2.5});
  CHECK(back.point_data.size() == 1);
  CHECK(back.notes.empty());
}

TEST_CASE("a mesh goes from each format to each other and back, or what is lost is named") {
  const std::vector<std::pair<std::string, MeshData>> meshes = {
      {"plain", contract::kuhn_cube(2, 0.1, 1)},
      {"rich", rich_mesh()},
      {"prism", with_prism()},
      {"second order", test::second_order(contract::kuhn_cube(2, 0.1, 1), 0.1)}};
  for (const auto& [kind, mesh] : meshes) {
    const std::string name = kind;
    for (const MeshFormat& from : mesh_formats()) {
      if (from.name == "LS-DYNA") continue;  // it rounds: lsdyna_test.cpp
      const TempFolder folder;
      CAPTURE(name);
      CAPTURE(from.name);
      const MeshData first = pass(mesh, folder / ("mesh" + std::string(from.extension)));
      for (const MeshFormat& to : mesh_formats()) {
        if (to.name == "LS-DYNA") continue;
        CAPTURE(to.name);
        const MeshData second = pass(first, folder / ("there" + std::string(to.extension)));
        pass(second, folder / ("back" + std::string(from.extension)));
      }
    }
  }
}
