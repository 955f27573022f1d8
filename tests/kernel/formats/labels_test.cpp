// SPDX-License-Identifier: MIT
// Labels of tets, triangles and edges, the same or different ones, through every format: each is
// there again, or a note says which are not.
#include <algorithm>
#include <array>
#include <map>
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

using Labels = std::array<Label, 2>;

/// Which labels the elements of each dimension have in turn.
struct Row {
  const char* what;
  Labels tets, triangles, edges;
  int names = 0;  ///< of how many of the two labels
};

/// Two prisms and two quadrilaterals beside the rest.
void add_others(MeshData& mesh, const Row& row) {
  OtherElements prisms{13, 6, {}, {}, {}, {}, {}};
  OtherElements quads{9, 4, {}, {}, {}, {}, {}};
  for (std::uint32_t k = 0; k < 2; ++k) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const double z : {9., 10.}) {
      for (const auto& [x, y] : {std::pair(0., 0.), std::pair(1., 0.), std::pair(0., 1.)})
        mesh.points.push_back({x, y, z + 2 * k});
    }
    for (std::uint32_t v = 0; v < 6; ++v) prisms.vertices.push_back(first + v);
    for (const std::uint32_t v : {0, 1, 4, 3}) quads.vertices.push_back(first + v);
    prisms.labels.push_back(row.tets[k]);
    quads.labels.push_back(row.triangles[k]);
  }
  mesh.other_elements = {prisms, quads};
}

/// A cube with faces of tets and triangles that no tet has, and edges of both kinds.
MeshData labelled_cube(const Row& row) {
  MeshData mesh = contract::kuhn_cube(2, 0, 1);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.tets[t].label = row.tets[t % 2];
  for (std::uint32_t k = 0; k < 4; ++k) {
    const auto& v = mesh.tets[5 * k].vertices;
    mesh.triangles.push_back({{v[0], v[1], v[2]}, row.triangles[k % 2]});
    mesh.edges.push_back({{v[0], v[3]}, row.edges[k % 2]});
  }
  for (std::uint32_t k = 0; k < 4; ++k) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const auto& [x, y] : {std::pair(0., 0.), std::pair(1., 0.), std::pair(0., 1.)})
      mesh.points.push_back({x, y, 2. + k});
    mesh.triangles.push_back({{first, first + 1, first + 2}, row.triangles[k % 2]});
    mesh.edges.push_back({{first, first + 1}, row.edges[k % 2]});
  }
  add_others(mesh, row);
  const std::array<Labels, 3> all = {row.edges, row.triangles, row.tets};
  for (int dimension = 1; dimension <= 3; ++dimension) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(row.names); ++k) {
      const Label label = all[static_cast<std::size_t>(dimension) - 1][1 - k];
      mesh.groups.push_back({dimension, label, fmt::format("dim{}no{}", dimension, label), {}, {}});
    }
  }
  return mesh;
}

/// As far as their label goes.
struct Other {
  std::vector<std::uint32_t> vertices;
  Label label;
};
std::vector<Other> others_of(const MeshData& mesh, int vtk_type) {
  std::vector<Other> found;
  for (const OtherElements& others : mesh.other_elements) {
    if (others.vtk_type != vtk_type) continue;
    for (std::size_t i = 0; i < others.labels.size(); ++i) {
      const auto begin =
          others.vertices.begin() + static_cast<std::ptrdiff_t>(i * others.vertex_count);
      found.push_back(
          {{begin, begin + static_cast<std::ptrdiff_t>(others.vertex_count)}, others.labels[i]});
    }
  }
  return found;
}

struct Named {
  Label label = 0;
  std::string name;
};
/// Of each element by the places of its corners.
template <class Element>
std::map<std::string, Named> labels_by_name(const MeshData& mesh, int dimension,
                                            const std::vector<Element>& elements) {
  const formats::LabelNames names(mesh);
  const auto named = names.named(dimension);
  std::map<std::string, Named> labels;
  for (const Element& element : elements) {
    std::vector<std::string> corners;
    for (const std::uint32_t v : element.vertices) {
      const Point& p = mesh.points[v];
      corners.push_back(fmt::format("({} {} {})", p[0], p[1], p[2]));
    }
    std::sort(corners.begin(), corners.end());
    const auto name = named.find(element.label);
    labels[fmt::format("{}", fmt::join(corners, ""))] = {
        element.label, name == named.end() ? std::string() : name->second->name};
  }
  return labels;
}

/// What `after` lacks of `before`, but for what a note names: a name is as good as a number.
void check_labels(const MeshData& before, const MeshData& after,
                  const std::vector<std::string>& notes) {
  const auto check = [&](const std::string& what, const auto& labels, const auto& again) {
    const bool is_volume = what.ends_with("13");
    for (const std::string& note : notes) {
      if (note.find(" " + what + " are") != std::string::npos) return;
      if (note.find(" " + what + ", and groups of them, are") != std::string::npos) return;
      for (const std::string& told :
           {std::string("labels change"), std::string("without a label"),
            std::string(is_volume ? "labels of tets" : "labels of " + what)}) {
        if (note.find(told) != std::string::npos) return;
      }
    }
    // One label for all tells nothing apart, and is as good as none.
    const auto is_one = [](const auto& all) {
      return std::all_of(all.begin(), all.end(), [&](const auto& each) {
        return each.second.label == all.begin()->second.label;
      });
    };
    const auto is_none = [](const auto& all) { return all.begin()->second.label == 0; };
    const bool are_as_good = labels.size() == again.size() && is_one(labels) && is_one(again) &&
                             (is_none(labels) || is_none(again));
    if (are_as_good) return;
    std::string wrong;
    for (const auto& [element, label] : labels) {
      const auto found = again.find(element);
      const bool is_right =
          found != again.end() && (found->second.label == label.label ||
                                   (!label.name.empty() && found->second.name == label.name));
      if (is_right || !wrong.empty()) continue;
      wrong = fmt::format("{}: {} instead of {}", element,
                          found == again.end() ? "none" : fmt::format("{}", found->second.label),
                          label.label);
    }
    INFO(what);
    CHECK(wrong == "");
  };
  check("tets", labels_by_name(before, 3, before.tets), labels_by_name(after, 3, after.tets));
  check("triangles", labels_by_name(before, 2, before.triangles),
        labels_by_name(after, 2, after.triangles));
  check("edges", labels_by_name(before, 1, before.edges), labels_by_name(after, 1, after.edges));
  check("elements of VTK's type 13", labels_by_name(before, 3, others_of(before, 13)),
        labels_by_name(after, 3, others_of(after, 13)));
  check("elements of VTK's type 9", labels_by_name(before, 2, others_of(before, 9)),
        labels_by_name(after, 2, others_of(after, 9)));
}

constexpr std::array<Row, 13> kRows = {{
    {"the same labels", {1, 2}, {1, 2}, {1, 2}},
    {"the same labels, named", {1, 2}, {1, 2}, {1, 2}, 2},
    {"different labels", {1, 2}, {3, 4}, {5, 6}},
    {"different labels, named", {1, 2}, {3, 4}, {5, 6}, 2},
    {"some labels in common", {2, 3}, {1, 2}, {3, 4}},
    {"labels that are gone through twice", {7, 5}, {5, 7}, {7, 5}},
    {"one label", {1, 1}, {1, 1}, {1, 1}},
    {"one label each", {4, 4}, {9, 9}, {4, 4}},
    {"tets without labels", {0, 0}, {1, 2}, {1, 2}},
    {"some names", {1, 2}, {1, 2}, {1, 2}, 1},
    {"some other names", {1, 2}, {3, 4}, {5, 6}, 1},
    {"some without a label", {0, 2}, {0, 3}, {0, 4}},
    {"triangles without labels", {1, 2}, {0, 0}, {0, 0}},
}};

}  // namespace

TEST_CASE("no point of a file of second order that tetmend wrote is held when it is read again") {
  MeshData mesh = test::second_order(contract::kuhn_cube(2, 0, 1), 0);
  const auto& first = mesh.tets[0].vertices;
  mesh.triangles = {{{first[0], first[1], first[2]}, 3}};
  mesh.groups = {{2, 3, "wall", {}, {}}};
  for (const MeshFormat& format : mesh_formats()) {
    CAPTURE(format.extension);
    const TempFolder folder;
    const std::filesystem::path file = folder / ("a" + std::string(format.extension));
    write_mesh(file, mesh);
    CHECK(read_mesh(file).required_vertices.empty());
  }
}

TEST_CASE("labels of tets, triangles and edges come back from every format, or a note says which") {
  for (const Row& row : kRows) {
    const MeshData mesh = labelled_cube(row);
    for (const MeshFormat& format : mesh_formats()) {
      CAPTURE(std::string(row.what));
      CAPTURE(format.extension);
      const TempFolder folder;
      const auto file = [&](const std::string& name) {
        return folder / (name + std::string(format.extension));
      };
      write_mesh(file("a"), mesh);
      const MeshData once = read_mesh(file("a"));
      check_labels(mesh, once, not_written(file("a"), mesh));
      CHECK(once.required_vertices.empty());
      write_mesh(file("b"), once);
      const MeshData twice = read_mesh(file("b"));
      check_labels(once, twice, not_written(file("b"), once));
      CHECK(twice.required_vertices.empty());
    }
  }
}
