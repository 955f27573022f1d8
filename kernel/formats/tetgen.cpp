// SPDX-License-Identifier: MIT
// TetGen's files `.node`, `.ele`, `.face` and `.edge`: one mesh in up to four files of one stem.
#include "kernel/formats/tetgen.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/element_checks.h"
#include "kernel/formats/output_rows.h"
#include "kernel/formats/text_reader.h"

namespace tetmend::formats {
namespace {

/// The file of the same stem with another extension, in the case of the one given (MESH.NODE goes
/// with MESH.ELE).
std::filesystem::path sibling(const std::filesystem::path& file, std::string_view extension) {
  const std::string given = file.extension().string();
  std::string wanted(extension);
  if (std::none_of(given.begin(), given.end(), [](unsigned char c) { return std::islower(c); })) {
    std::transform(wanted.begin(), wanted.end(), wanted.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  }
  return std::filesystem::path(file).replace_extension(wanted);
}

/// One file: a line of counts, then numbered rows of one line each.
class Table {
 public:
  explicit Table(const std::filesystem::path& file) : input_(file), text_(input_, '#') {}

  TextReader& text() { return text_; }

  void begin(std::string_view what) {
    if (text_.at_end())
      text_.fail(fmt::format("the file is empty: expected the number of {}", what));
  }
  /// A number of the present line; `what` must not be on the next one.
  std::int64_t integer(std::string_view what, std::int64_t low, std::int64_t high) {
    require(what);
    return text_.integer(what, low, high);
  }
  std::int64_t integer_or(std::int64_t otherwise, std::string_view what, std::int64_t low,
                          std::int64_t high) {
    return text_.at_line_end() ? otherwise : text_.integer(what, low, high);
  }
  double real(std::string_view what) {
    require(what);
    return text_.real(what);
  }
  void begin_row(std::string_view what) {
    if (text_.at_end()) text_.fail(fmt::format("the file ends where a {} is expected", what));
  }
  void end_row(std::string_view what) {
    const std::string_view word = text_.word_on_line();
    if (!word.empty()) {
      text_.fail(
          fmt::format("{} is too much: expected the end of the line of {}", in_quotes(word), what));
    }
  }
  void end(std::string_view what) {
    const std::string_view word = text_.word();
    if (!word.empty()) {
      text_.fail(fmt::format(
          "{} follows the last {}: expected the end of the file; the count in its first "
          "line is too small",
          in_quotes(word), what));
    }
  }

 private:
  void require(std::string_view what) {
    if (text_.at_line_end()) text_.fail(fmt::format("the line ends where {} is expected", what));
  }

  InputFile input_;
  TextReader text_;
};

class Reader {
 public:
  Reader(const std::filesystem::path& file, TetPlace* question)
      : file_(file), question_(question) {}

  MeshData read() {
    read_nodes();
    read_tets();
    read_markers(".face", mesh_.triangles, "triangle");
    read_markers(".edge", mesh_.edges, "edge");
    drop_zero_point_labels(mesh_);
    return std::move(mesh_);
  }

 private:
  static constexpr std::int64_t kMostAttributes = 1000;

  void read_nodes() {
    Table table(sibling(file_, ".node"));
    table.begin("vertices");
    const std::size_t count = table.text().count("vertices", std::string_view("0 0 0 0\n").size());
    if (count > kMostVertices) table.text().fail(fmt::format("{} vertices are too many", count));
    if (table.integer_or(3, "the dimension", 1, 3) != 3) {
      table.text().fail("the mesh is not three-dimensional: expected dimension 3");
    }
    const auto attributes = table.integer_or(0, "the number of attributes", 0, kMostAttributes);
    const auto markers = table.integer_or(0, "the number of boundary markers", 0, 1);
    table.end_row("the counts");
    mesh_.points.resize(count);
    mesh_.point_labels.resize(markers == 0 ? 0 : count);
    for (std::size_t i = 0; i < count; ++i) {
      table.begin_row("vertex");
      if (i == 0) base_ = table.integer("the number of the first vertex", 0, 1);
      const auto number = static_cast<std::int64_t>(i) + base_;
      if (i > 0) table.integer("the next vertex", number, number);
      for (int axis = 0; axis < 3; ++axis) mesh_.points[i][axis] = table.real("a coordinate");
      for (auto k = attributes; k > 0; --k) table.real("an attribute of a vertex");
      if (markers != 0) {
        mesh_.point_labels[i] =
            static_cast<Label>(table.integer("a boundary marker", INT32_MIN, INT32_MAX));
      }
      table.end_row("a vertex");
    }
    table.end("vertex");
  }

  void read_tets() {
    Table table(sibling(file_, ".ele"));
    table.begin("tetrahedra");
    const std::size_t count =
        table.text().count("tetrahedra", std::string_view("0 0 1 2 3\n").size());
    const auto corners =
        table.integer_or(4, "the number of vertices of a tetrahedron", 1, INT32_MAX);
    if (corners != 4) {
      table.text().fail(fmt::format("tetrahedra with {} vertices{} cannot be read: expected 4",
                                    corners, corners == 10 ? " (second order)" : ""));
    }
    const auto attributes = table.integer_or(0, "the number of attributes", 0, kMostAttributes);
    table.end_row("the counts");
    mesh_.tets.resize(count);
    for (MeshData::Tet& tet : mesh_.tets) {
      read_corners(table, tet);
      if (is_asked_for(question_, mesh_.tets, tet)) {
        question_->place = table.text().place_of(table.text().last_word());
      }
      for (std::int64_t k = 0; k < attributes; ++k) {
        const double value = table.real("an attribute of a tetrahedron");
        if (k == 0) tet.label = rounded_label(table, value);
      }
      table.end_row("a tetrahedron");
    }
    table.end("tetrahedron");
  }

  static Label rounded_label(Table& table, double value) {
    const double label = std::round(value);
    if (!(label >= INT32_MIN && label <= INT32_MAX)) {
      table.text().fail(fmt::format("the region attribute {} is out of range: expected {} to {}",
                                    value, INT32_MIN, INT32_MAX));
    }
    return static_cast<Label>(label);
  }

  /// The columns behind the marker are not ours: TetGen's switch -nn adds the adjacent tets, -o2
  /// the middle vertices.
  template <class Element>
  void read_markers(std::string_view extension, std::vector<Element>& elements,
                    std::string_view what) {
    const std::filesystem::path file = sibling(file_, extension);
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return;
    Table table(file);
    table.begin(what);
    constexpr std::size_t kNumbers = std::tuple_size_v<decltype(Element::vertices)> + 1;
    elements.resize(table.text().count(what, 2 * kNumbers));
    const auto markers = table.integer_or(0, "the number of boundary markers", 0, 1);
    table.end_row("the counts");
    for (Element& element : elements) {
      read_corners(table, element);
      if (markers != 0) {
        element.label =
            static_cast<Label>(table.integer("a boundary marker", INT32_MIN, INT32_MAX));
      }
      while (!table.text().word_on_line().empty()) {
      }
    }
    table.end(what);
  }

  template <class Element>
  void read_corners(Table& table, Element& element) {
    table.begin_row(element_name(element));
    table.integer("the number of the line", INT64_MIN, INT64_MAX);
    const auto last = static_cast<std::int64_t>(mesh_.points.size()) - 1 + base_;
    for (std::uint32_t& vertex : element.vertices) {
      vertex = static_cast<std::uint32_t>(table.integer("a vertex number", base_, last) - base_);
    }
    if (has_repeated_vertex(element.vertices)) {
      table.text().fail(repeated_vertex_message(element, static_cast<std::uint32_t>(base_)));
    }
  }

  std::filesystem::path file_;
  TetPlace* question_;
  std::int64_t base_ = 0;
  MeshData mesh_;
};

// TetGen's own files end with a comment as well; a file cut short lacks at least its line break.
constexpr std::string_view kLastLine = "# Generated by tetmend\n";

void write_nodes(OutputFile& out, const MeshView& mesh) {
  const bool marked = mesh.has_point_labels();
  out.put(fmt::format("{} 3 0 {}\n", mesh.point_count(), marked ? 1 : 0));
  put_rows(out, mesh.point_count(), [&](std::size_t i, OutputBuffer& buffer) {
    buffer.put_integer(static_cast<std::int64_t>(i));
    for (int axis = 0; axis < 3; ++axis) {
      buffer.put(' ');
      buffer.put_real(mesh.point(i)[axis]);
    }
    if (marked) {
      buffer.put(' ');
      buffer.put_integer(mesh.point_label(i));
    }
    buffer.put('\n');
  });
  out.put(kLastLine);
}

template <class Element>
void write_row(OutputBuffer& out, std::size_t number, const Element& element, bool with_label) {
  out.put_integer(static_cast<std::int64_t>(number));
  for (const std::uint32_t vertex : element.vertices) {
    out.put(' ');
    out.put_integer(vertex);
  }
  if (with_label) {
    out.put(' ');
    out.put_integer(element.label);
  }
  out.put('\n');
}

void write_tets(OutputFile& out, const MeshView& mesh) {
  std::vector<MeshData::Tet> buffer;
  bool labelled = false;
  for (std::size_t block = 0; block < mesh.tet_blocks() && !labelled; ++block) {
    const auto tets = mesh.tets(block, buffer);
    labelled = std::any_of(tets.begin(), tets.end(),
                           [](const MeshData::Tet& tet) { return tet.label != 0; });
  }
  out.put(fmt::format("{} 4 {}\n", mesh.tet_count(), labelled ? 1 : 0));
  put_tets(out, mesh, [&](std::size_t number, const MeshData::Tet& tet, OutputBuffer& rows) {
    write_row(rows, number, tet, labelled);
  });
  out.put(kLastLine);
}

template <class Element>
void write_elements(OutputFile& out, std::span<const Element> elements) {
  out.put(fmt::format("{} 1\n", elements.size()));
  put_rows(out, elements.size(),
           [&](std::size_t i, OutputBuffer& buffer) { write_row(buffer, i, elements[i], true); });
  out.put(kLastLine);
}

}  // namespace

MeshData read_tetgen(const std::filesystem::path& node_or_ele, TetPlace* question) {
  return Reader(node_or_ele, question).read();
}

void write_tetgen(const std::filesystem::path& node_or_ele, const MeshView& mesh) {
  OutputFile nodes(sibling(node_or_ele, ".node"));
  OutputFile tets(sibling(node_or_ele, ".ele"));
  OutputFile faces(sibling(node_or_ele, ".face"));
  std::optional<OutputFile> edges;
  std::error_code ignored;
  const std::filesystem::path edge_file = sibling(node_or_ele, ".edge");
  if (!mesh.edges().empty() || std::filesystem::exists(edge_file, ignored))
    edges.emplace(edge_file);

  write_nodes(nodes, mesh);
  write_tets(tets, mesh);
  write_elements(faces, mesh.triangles());
  if (edges) {
    write_elements(*edges, mesh.edges());
    edges->finish();
  }
  nodes.finish();
  tets.finish();
  faces.finish();

  if (edges) edges->commit();
  faces.commit();
  nodes.commit();
  tets.commit();
}

}  // namespace tetmend::formats
