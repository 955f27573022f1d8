// SPDX-License-Identifier: MIT
// Reads meshes of MFEM.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/element_checks.h"
#include "kernel/formats/element_rows.h"
#include "kernel/formats/mfem.h"
#include "kernel/formats/mfem_numbering.h"
#include "kernel/formats/text_reader.h"

namespace tetmend::formats {
namespace {

struct AttributeSet {
  std::string name;
  std::vector<Label> attributes;
};

class MfemReader {
 public:
  MfemReader(const InputFile& file, TetPlace* question)
      : file_(file), text_(file, '#'), question_(question), sorter_(mesh_) {}

  MeshData read() {
    read_head();
    last_vertex_ = std::min<std::int64_t>(find_vertex_count(), kMostVertices) - 1;
    while (read_section()) {
    }
    for (const std::string_view name : {"dimension", "elements", "boundary", "vertices"}) {
      if (!seen_.contains(name)) text_.fail(fmt::format("the section {} is missing", name));
    }
    add_sets(3, sets_[1], mesh_.tets, mesh_.tet_parts);
    add_sets(2, sets_[0], mesh_.triangles, mesh_.triangle_parts);
    if (!seen_.contains("mfem_mesh_end") && file_.end()[-1] != '\n') {
      mesh_.notes.emplace_back("the last line has no end: is the file complete?");
    }
    mesh_.variant = kMfem;
    return std::move(mesh_);
  }

 private:
  void read_head() {
    if (text_.at_end()) text_.fail("the file is empty: expected 'MFEM mesh v1.0'");
    const std::string_view line = text_.skip_line();
    constexpr std::array<std::string_view, 3> kKnown = {"MFEM mesh v1.0", "MFEM mesh v1.2",
                                                        "MFEM mesh v1.3"};
    const auto is_head = [&](std::string_view head) {
      return line.starts_with(head) &&
             line.find_first_not_of(" \t\r\n", head.size()) == std::string_view::npos;
    };
    if (std::any_of(kKnown.begin(), kKnown.end(), is_head)) return;
    text_.fail_at(
        line.data(),
        fmt::format("{} cannot be read: expected 'MFEM mesh v1.0', v1.2 or v1.3; no NURBS, "
                    "no hanging nodes, no parts",
                    in_quotes(line.substr(0, line.find_last_not_of(" \r\n") + 1))));
  }

  /// Elements come before the vertices that they name. Not checked.
  std::int64_t find_vertex_count() const {
    const std::string_view text(file_.begin(), file_.size());
    constexpr std::string_view kSection = "\nvertices";
    const std::size_t at = text.find(kSection);
    if (at == std::string_view::npos) return 0;
    TextReader ahead = text_;
    ahead.seek(text.data() + at + kSection.size());
    const std::string_view word = ahead.word();
    std::int64_t count = 0;
    std::from_chars(word.data(), word.data() + word.size(), count);
    return count;
  }

  /// False at the end of the mesh.
  bool read_section() {
    if (text_.at_end()) return false;
    const std::string_view name = text_.word();
    if (!seen_.insert(name).second) {
      text_.fail(fmt::format("{} appears for the second time", in_quotes(name)));
    }
    if (name == "mfem_mesh_end") return false;
    if (name == "dimension") {
      if (text_.integer("the dimension", 1, 3) != 3) {
        text_.fail("the mesh is not three-dimensional: expected dimension 3");
      }
    } else if (name == "elements") {
      read_elements(3);
    } else if (name == "boundary") {
      read_elements(2);
    } else if (name == "attribute_sets" || name == "bdr_attribute_sets") {
      read_sets(sets_[name == "attribute_sets" ? 1 : 0]);
    } else if (name == "vertices") {
      read_vertices();
    } else {
      text_.fail(
          fmt::format("{} is not expected here: expected the name of a section", in_quotes(name)));
    }
    return true;
  }

  void read_elements(int dimension) {
    const auto read = [&](TextReader& text, ElementRow& row) {
      row.label = text.label("an attribute");
      row.place = text.last_word();
      const std::int64_t type =
          text.integer("the geometry of an element", 0, kMfemTypes.size() - 1);
      row.kind = element_kind(kMfemTypes[static_cast<std::size_t>(type)]);
      if (row.kind->dimension != dimension) {
        text.fail(fmt::format("elements of geometry {} are not expected here: expected {}", type,
                              dimension == 3 ? "4 (tetrahedron), 5, 6 or 7" : "2 (triangle) or 3"));
      }
      for (std::size_t k = 0; k < row.kind->width; ++k) {
        row.vertices[k] =
            static_cast<std::uint32_t>(text.integer("a vertex number", 0, last_vertex_));
      }
    };
    const std::size_t count = text_.count("elements", std::string_view("1 2 0 1 2\n").size());
    if (count > 0 && last_vertex_ < 0)
      text_.fail("no vertices follow the elements: is the file complete?");
    read_element_rows(text_, count, read, [this](const ElementRow& row) {
      sorter_.add(row);
      answer(question_, mesh_, text_, row);
    });
  }

  /// Each a line: "NAME" COUNT ATTRIBUTE...
  void read_sets(std::vector<AttributeSet>& sets) {
    const std::size_t count = text_.count("sets", std::string_view("\"\" 0\n").size());
    for (std::size_t i = 0; i < count; ++i) {
      const std::string_view first = text_.expect_word("a name in quotes");
      const char* begin = first.data();
      const auto left = static_cast<std::size_t>(file_.end() - begin) - 1;
      const auto* end =
          first[0] == '"' ? static_cast<const char*>(std::memchr(begin + 1, '"', left)) : nullptr;
      if (end == nullptr) {
        text_.fail(fmt::format("{} is not a name in quotes", in_quotes(first)));
      }
      AttributeSet& set = sets.emplace_back();
      set.name = std::string(begin + 1, end);
      text_.seek(end + 1);
      set.attributes.resize(text_.count("attributes", std::string_view("1 ").size()));
      for (Label& attribute : set.attributes) attribute = text_.label("an attribute");
    }
  }

  /// Attributes are the parts of the elements.
  template <class Element>
  void add_sets(int dimension, const std::vector<AttributeSet>& sets,
                const std::vector<Element>& elements, std::vector<Label>& parts) {
    std::set<Label> there;
    for (const Element& element : elements) there.insert(element.label);
    for (const OtherElements& others : mesh_.other_elements) {
      if (element_kind(others.vtk_type)->dimension != dimension) continue;
      there.insert(others.labels.begin(), others.labels.end());
    }
    Label number = 0;
    for (const AttributeSet& set : sets) {
      std::vector<Label> used;
      for (const Label attribute : std::set<Label>(set.attributes.begin(), set.attributes.end())) {
        if (there.contains(attribute)) used.push_back(attribute);
      }
      if (used.empty()) {
        mesh_.notes.push_back(
            fmt::format("the set {} has no elements: not kept", in_quotes(set.name)));
        continue;
      }
      mesh_.groups.push_back({dimension, ++number, set.name, std::move(used), {}});
    }
    if (number == 0) return;
    for (const Element& element : elements) parts.push_back(element.label);
    for (OtherElements& others : mesh_.other_elements) {
      if (element_kind(others.vtk_type)->dimension == dimension) others.parts = others.labels;
    }
  }

  void read_vertices() {
    const std::size_t count = text_.count("vertices", std::string_view("0 0 0\n").size());
    if (count > kMostVertices) text_.fail(fmt::format("{} vertices are too many", count));
    const std::string_view word = text_.expect_word("the dimension of space or nodes");
    if (word == "nodes") return read_nodes(count);
    text_.seek(word.data());
    if (text_.integer("the dimension of space", 1, 3) != 3) {
      text_.fail("the vertices are not in space: expected 3 coordinates");
    }
    check_room(count, 3);
    mesh_.points.resize(count);
    read_rows(text_, count, [this](TextReader& text, std::size_t i) {
      for (int axis = 0; axis < 3; ++axis) mesh_.points[i][axis] = text.real("a coordinate");
    });
  }

  void check_room(std::size_t count, std::size_t numbers_each) const {
    if (count <= text_.bytes_left() / (2 * numbers_each) + 1) return;
    text_.fail(
        fmt::format("{} points cannot fit into the rest of the file: the count is wrong or the "
                    "file is truncated",
                    count));
  }

  void expect(std::string_view wanted) {
    if (const std::string_view word = text_.expect_word(wanted); word != wanted) {
      text_.fail(fmt::format("{} is not expected here: expected {}", in_quotes(word), wanted));
    }
  }

  /// A function of the coordinates of all points, with one value for each vertex, then for each edge.
  void read_nodes(std::size_t vertices) {
    expect("FiniteElementSpace");
    expect("FiniteElementCollection:");
    const std::string_view collection = text_.expect_word("the name of a collection");
    const bool is_second = collection == "H1_3D_P2" || collection == "Quadratic";
    if (!is_second && collection != "H1_3D_P1" && collection != "Linear") {
      text_.fail(
          fmt::format("nodes of {} cannot be read: expected H1_3D_P1 or H1_3D_P2; MFEM saves a "
                      "mesh as straight after SetCurvature(1)",
                      in_quotes(collection)));
    }
    if (is_second && !mesh_.other_elements.empty()) {
      const auto is_volume = [](const OtherElements& others) {
        return element_kind(others.vtk_type)->dimension == 3;
      };
      if (std::any_of(mesh_.other_elements.begin(), mesh_.other_elements.end(), is_volume)) {
        text_.fail(
            "nodes of second order are read of tetrahedra alone: the mesh has other volumes");
      }
    }
    expect("VDim:");
    if (text_.integer("the dimension of space", 1, 3) != 3) {
      text_.fail("the nodes are not in space: expected VDim: 3");
    }
    expect("Ordering:");
    const bool is_by_point = text_.integer("the ordering of nodes", 0, 1) == 1;
    MfemEdges edges;
    for (const MeshData::Tet& tet : mesh_.tets) {
      if (!is_second) break;
      for (const auto& [a, b] : kMfemEdgesOfTet) edges.add(tet.vertices[a], tet.vertices[b]);
    }
    const std::size_t count = vertices + edges.ends.size();
    check_room(count, 3);
    mesh_.points.resize(count);
    for (std::size_t i = 0; i < 3 * count; ++i) {
      const std::size_t point = is_by_point ? i / 3 : i % count;
      const std::size_t axis = is_by_point ? i % 3 : i / count;
      mesh_.points[point][static_cast<Eigen::Index>(axis)] = text_.real("a coordinate");
    }
    for (std::size_t e = 0; e < edges.ends.size(); ++e) {
      mesh_.mid_nodes.push_back(
          {edges.ends[e][0], edges.ends[e][1], static_cast<std::uint32_t>(vertices + e)});
    }
  }

  const InputFile& file_;
  TextReader text_;
  TetPlace* question_;
  MeshData mesh_;
  ElementSorter sorter_;
  std::int64_t last_vertex_ = -1;
  std::set<std::string_view> seen_;
  std::array<std::vector<AttributeSet>, 2> sets_;  // of triangles, of volumes
};

}  // namespace

bool looks_like_mfem(const InputFile& file) {
  return std::string_view(file.begin(), file.size()).starts_with("MFEM ");
}

MeshData read_mfem(const InputFile& file, TetPlace* question) {
  return MfemReader(file, question).read();
}

MeshData read_mfem(const std::filesystem::path& file, TetPlace* question) {
  const InputFile input(file);
  return read_mfem(input, question);
}

}  // namespace tetmend::formats
