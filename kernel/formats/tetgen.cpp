// SPDX-License-Identifier: MIT
// TetGen's files `.node`, `.ele`, `.face` and `.edge`: one mesh in up to four files of one stem.
#include "kernel/formats/tetgen.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/formats/cell_arrays.h"
#include "kernel/formats/element_checks.h"
#include "kernel/formats/output_rows.h"
#include "kernel/formats/text_reader.h"

namespace tetmend::formats {
namespace {

constexpr std::array<std::string_view, 4> kTetgenExtensions = {".node", ".ele", ".face", ".edge"};

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

/// Behind the vertices of a tet: where the node of each edge stands, in VTK's order of the edges.
constexpr std::array<std::size_t, 6> kTetgenNodes = {2, 3, 5, 1, 4, 0};

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

class TetgenReader {
 public:
  TetgenReader(const std::filesystem::path& file, TetPlace* question)
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
    std::vector<std::vector<double>> values(static_cast<std::size_t>(attributes));
    for (std::size_t i = 0; i < count; ++i) {
      table.begin_row("vertex");
      if (i == 0) {
        base_ = table.integer("the number of the first vertex", 0, 1);
        mesh_.variant = base_ == 1 ? kTetgenFromOne : kTetgenFromZero;
      }
      const auto number = static_cast<std::int64_t>(i) + base_;
      if (i > 0) table.integer("the next vertex", number, number);
      for (int axis = 0; axis < 3; ++axis) mesh_.points[i][axis] = table.real("a coordinate");
      for (auto& column : values) column.push_back(table.real("an attribute of a vertex"));
      if (markers != 0) {
        mesh_.point_labels[i] =
            static_cast<Label>(table.integer("a boundary marker", INT32_MIN, INT32_MAX));
      }
      table.end_row("a vertex");
    }
    table.end("vertex");
    keep_attributes(values, 1, mesh_.point_data);
  }

  /// The first column has the number `first`.
  static void keep_attributes(std::vector<std::vector<double>>& values, std::size_t first,
                              std::vector<DataArray>& data) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      data.push_back({fmt::format("{}{}", kTetgenArrays, first + k), 1, std::move(values[k])});
    }
  }

  void read_tets() {
    Table table(sibling(file_, ".ele"));
    table.begin("tetrahedra");
    const std::size_t count =
        table.text().count("tetrahedra", std::string_view("0 0 1 2 3\n").size());
    const auto corners =
        table.integer_or(4, "the number of vertices of a tetrahedron", 1, INT32_MAX);
    if (corners != 4 && corners != 10) {
      table.text().fail(fmt::format(
          "tetrahedra with {} vertices cannot be read: expected 4, or 10 of second order",
          corners));
    }
    is_second_order_ = corners == 10;
    const auto attributes = table.integer_or(0, "the number of attributes", 0, kMostAttributes);
    table.end_row("the counts");
    mesh_.tets.resize(count);
    std::vector<std::array<std::uint32_t, 6>> nodes;
    std::vector<std::vector<double>> values(
        attributes > 1 ? static_cast<std::size_t>(attributes) - 1 : 0);
    for (MeshData::Tet& tet : mesh_.tets) {
      read_corners(table, tet);
      if (is_second_order_) read_nodes_between(table, nodes.emplace_back());
      if (is_asked_for(question_, mesh_.tets, tet)) {
        question_->place = table.text().place_of(table.text().last_word());
      }
      for (std::int64_t k = 0; k < attributes; ++k) {
        const double value = table.real("an attribute of a tetrahedron");
        if (k == 0) {
          tet.label = rounded_label(table, value);
        } else {
          values[static_cast<std::size_t>(k) - 1].push_back(value);
        }
      }
      table.end_row("a tetrahedron");
    }
    table.end("tetrahedron");
    keep_attributes(values, 2, mesh_.tet_data);
    if (is_second_order_) take_nodes_between(nodes);
  }

  template <std::size_t N>
  void read_nodes_between(Table& table, std::array<std::uint32_t, N>& nodes) {
    const auto last = static_cast<std::int64_t>(mesh_.points.size()) - 1 + base_;
    for (std::uint32_t& node : nodes) {
      node = static_cast<std::uint32_t>(
          table.integer("the number of a node of an edge", base_, last) - base_);
    }
  }

  void take_nodes_between(const std::vector<std::array<std::uint32_t, 6>>& nodes) {
    OtherElements& others = mesh_.other_elements.emplace_back();
    others.vtk_type = 24;
    others.vertex_count = 10;
    others.data = std::move(mesh_.tet_data);
    for (std::size_t t = 0; t < nodes.size(); ++t) {
      const MeshData::Tet& tet = mesh_.tets[t];
      others.vertices.insert(others.vertices.end(), tet.vertices.begin(), tet.vertices.end());
      for (const std::size_t place : kTetgenNodes) others.vertices.push_back(nodes[t][place]);
      others.labels.push_back(tet.label);
    }
    mesh_.tets.clear();
    mesh_.tet_data.clear();
  }

  static Label rounded_label(Table& table, double value) {
    const double label = std::round(value);
    if (!(label >= INT32_MIN && label <= INT32_MAX)) {
      table.text().fail(fmt::format("the region attribute {} is out of range: expected {} to {}",
                                    value, INT32_MIN, INT32_MAX));
    }
    return static_cast<Label>(label);
  }

  /// The columns behind the marker are not ours: TetGen's switch -nn adds the adjacent tets.
  template <class Element>
  void read_markers(std::string_view extension, std::vector<Element>& elements,
                    std::string_view what) {
    const std::filesystem::path file = sibling(file_, extension);
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return;
    Table table(file);
    table.begin(what);
    constexpr std::size_t kCorners = std::tuple_size_v<decltype(Element::vertices)>;
    const std::size_t count = table.text().count(what, 2 * (kCorners + 1));
    elements.reserve(count);
    const auto markers = table.integer_or(0, "the number of boundary markers", 0, 1);
    table.end_row("the counts");
    const TetParts<kCorners> of_tets =
        is_second_order_ ? parts_of_tets<kCorners>() : TetParts<kCorners>();
    OtherElements loose;
    for (std::size_t i = 0; i < count; ++i) {
      Element element;
      read_corners(table, element);
      std::array<std::uint32_t, kCorners == 3 ? 3 : 1> between{};
      if (is_second_order_) read_nodes_between(table, between);
      if (markers != 0) {
        element.label =
            static_cast<Label>(table.integer("a boundary marker", INT32_MIN, INT32_MAX));
      }
      if (!is_second_order_ || is_part(of_tets, element.vertices)) {
        elements.push_back(element);
        if (is_asked_for(question_, elements, elements.back())) {
          question_->place = table.text().place_of(table.text().last_word());
        }
      } else {
        loose.vertices.insert(loose.vertices.end(), element.vertices.begin(),
                              element.vertices.end());
        loose.vertices.insert(loose.vertices.end(), between.begin(), between.end());
        loose.labels.push_back(element.label);
      }
      while (!table.text().word_on_line().empty()) {
      }
    }
    table.end(what);
    if (loose.labels.empty()) return;
    loose.vtk_type = kCorners == 3 ? 22 : 21;
    loose.vertex_count = kCorners == 3 ? 6 : 3;
    mesh_.other_elements.push_back(std::move(loose));
  }

  /// Faces or edges of the tets of second order, sorted: whatever is one of these has their nodes
  /// between its corners.
  template <std::size_t N>
  using TetParts = std::vector<std::array<std::uint32_t, N>>;

  template <std::size_t N>
  TetParts<N> parts_of_tets() const {
    TetParts<N> parts;
    const OtherElements& tets = mesh_.other_elements.front();
    for (std::size_t t = 0; t < tets.labels.size(); ++t) {
      std::array<std::uint32_t, 4> v;
      std::copy_n(&tets.vertices[10 * t], 4, v.begin());
      std::sort(v.begin(), v.end());
      if constexpr (N == 3) {
        for (std::size_t k = 0; k < 4; ++k)
          parts.push_back({v[k == 0], v[1 + (k <= 1)], v[2 + (k <= 2)]});
      } else {
        for (std::size_t i = 0; i < 4; ++i) {
          for (std::size_t j = i + 1; j < 4; ++j) parts.push_back({v[i], v[j]});
        }
      }
    }
    std::sort(parts.begin(), parts.end());
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    return parts;
  }
  template <std::size_t N>
  static bool is_part(const TetParts<N>& parts, std::array<std::uint32_t, N> vertices) {
    std::sort(vertices.begin(), vertices.end());
    return std::binary_search(parts.begin(), parts.end(), vertices);
  }

  template <class Element>
  void read_corners(Table& table, Element& element) {
    table.begin_row(element_name(element));
    table.integer("the number of the line", INT64_MIN, INT64_MAX);
    const auto last = static_cast<std::int64_t>(mesh_.points.size()) - 1 + base_;
    for (std::uint32_t& vertex : element.vertices) {
      vertex = static_cast<std::uint32_t>(table.integer("a vertex number", base_, last) - base_);
    }
  }

  std::filesystem::path file_;
  TetPlace* question_;
  std::int64_t base_ = 0;
  bool is_second_order_ = false;
  MeshData mesh_;
};

// TetGen's own files end with a comment as well; a file cut short lacks at least its line break.
constexpr std::string_view kLastLine = "# Generated by tetmend\n";

using Columns = std::vector<const DataArray*>;

/// The arrays that are attributes.
Columns attributes_of(const std::vector<DataArray>& data) {
  Columns columns;
  for (const DataArray& array : data) {
    if (array.name.starts_with(kTetgenArrays)) columns.push_back(&array);
  }
  return columns;
}
std::size_t width_of(const Columns& columns) {
  std::size_t width = 0;
  for (const DataArray* array : columns) width += array->components;
  return width;
}

void write_attributes(OutputBuffer& out, const Columns& columns, std::size_t row) {
  for (const DataArray* array : columns) {
    for (std::size_t k = 0; k < array->components; ++k) {
      out.put(' ');
      out.put_real(real_value(*array, row * array->components + k));
    }
  }
}

/// Of the first vertex and the first element.
std::size_t base_of(const MeshView& mesh) {
  return mesh.variant() == kTetgenFromOne ? 1 : 0;
}

void write_nodes(OutputFile& out, const MeshView& mesh) {
  const bool marked = mesh.has_point_labels();
  const Columns columns =
      mesh.data() == nullptr ? Columns() : attributes_of(mesh.data()->point_data);
  const std::size_t base = base_of(mesh);
  out.put(fmt::format("{} 3 {} {}\n", mesh.point_count(), width_of(columns), marked ? 1 : 0));
  put_rows(out, mesh.point_count(), [&](std::size_t i, OutputBuffer& buffer) {
    buffer.put_integer(static_cast<std::int64_t>(i + base));
    for (int axis = 0; axis < 3; ++axis) {
      buffer.put(' ');
      buffer.put_real(mesh.point(i)[axis]);
    }
    write_attributes(buffer, columns, i);
    if (marked) {
      buffer.put(' ');
      buffer.put_integer(mesh.point_label(i));
    }
    buffer.put('\n');
  });
  out.put(kLastLine);
}

/// A row without its end. @param number,vertices from 0
void write_numbers(OutputBuffer& out, std::size_t base, std::size_t number,
                   std::span<const std::uint32_t> vertices) {
  out.put_integer(static_cast<std::int64_t>(number + base));
  for (const std::uint32_t vertex : vertices) {
    out.put(' ');
    out.put_integer(static_cast<std::int64_t>(vertex + base));
  }
}

void write_end(OutputBuffer& out, const Label* label, const Columns& columns, std::size_t row) {
  if (label != nullptr) {
    out.put(' ');
    out.put_integer(*label);
  }
  write_attributes(out, columns, row);
  out.put('\n');
}

void write_tets(OutputFile& out, const MeshView& mesh) {
  std::vector<MeshData::Tet> buffer;
  const Columns columns = mesh.data() == nullptr ? Columns() : attributes_of(mesh.data()->tet_data);
  bool labelled = !columns.empty();  // they come behind the label
  for (std::size_t block = 0; block < mesh.tet_blocks() && !labelled; ++block) {
    const auto tets = mesh.tets(block, buffer);
    labelled = std::any_of(tets.begin(), tets.end(),
                           [](const MeshData::Tet& tet) { return tet.label != 0; });
  }
  out.put(fmt::format("{} 4 {}\n", mesh.tet_count(), width_of(columns) + (labelled ? 1 : 0)));
  const std::size_t base = base_of(mesh);
  put_tets(out, mesh, [&](std::size_t number, const MeshData::Tet& tet, OutputBuffer& rows) {
    write_numbers(rows, base, number, tet.vertices);
    write_end(rows, labelled ? &tet.label : nullptr, columns, number);
  });
  out.put(kLastLine);
}

/// The elements of second order of a kind; null if there are none.
const OtherElements* second_order(const MeshView& mesh, int vtk_type) {
  if (mesh.data() == nullptr) return nullptr;
  for (const OtherElements& others : mesh.data()->other_elements) {
    if (others.vtk_type == vtk_type) return &others;
  }
  return nullptr;
}

void write_second_order_tets(OutputFile& out, std::size_t base, const OtherElements& tets) {
  const Columns columns = attributes_of(tets.data);
  out.put(fmt::format("{} 10 {}\n", tets.labels.size(), 1 + width_of(columns)));
  put_rows(out, tets.labels.size(), [&](std::size_t i, OutputBuffer& buffer) {
    std::array<std::uint32_t, 10> row;
    std::copy_n(&tets.vertices[10 * i], 4, row.begin());
    for (std::size_t e = 0; e < 6; ++e) row[4 + kTetgenNodes[e]] = tets.vertices[10 * i + 4 + e];
    write_numbers(buffer, base, i, row);
    write_end(buffer, &tets.labels[i], columns, i);
  });
  out.put(kLastLine);
}

/// Of first order, or of second if the mesh is: a file has rows of one length.
template <class Element>
void write_tetgen_elements(OutputFile& out, std::size_t base, std::span<const Element> elements,
                           bool is_second_order, const OtherElements* second) {
  if (is_second_order) elements = {};
  const std::size_t count = second == nullptr ? elements.size() : second->labels.size();
  out.put(fmt::format("{} 1\n", count));
  put_rows(out, count, [&](std::size_t i, OutputBuffer& buffer) {
    if (second == nullptr) {
      write_numbers(buffer, base, i, elements[i].vertices);
    } else {
      const std::size_t width = second->vertex_count;
      write_numbers(buffer, base, i, std::span(second->vertices).subspan(i * width, width));
    }
    write_end(buffer, second == nullptr ? &elements[i].label : &second->labels[i], {}, i);
  });
  out.put(kLastLine);
}

}  // namespace

MeshData read_tetgen(const std::filesystem::path& node_or_ele, TetPlace* question) {
  return TetgenReader(node_or_ele, question).read();
}

void write_tetgen(const std::filesystem::path& node_or_ele, const MeshView& mesh) {
  OutputFile nodes(sibling(node_or_ele, ".node"));
  OutputFile tets(sibling(node_or_ele, ".ele"));
  OutputFile faces(sibling(node_or_ele, ".face"));
  std::optional<OutputFile> edges;
  std::error_code ignored;
  const std::filesystem::path edge_file = sibling(node_or_ele, ".edge");
  const bool has_edges = !mesh.edges().empty() || second_order(mesh, 21) != nullptr;
  if (has_edges || std::filesystem::exists(edge_file, ignored)) edges.emplace(edge_file);

  const std::size_t base = base_of(mesh);
  write_nodes(nodes, mesh);
  const OtherElements* second = second_order(mesh, 24);
  if (second != nullptr) {
    write_second_order_tets(tets, base, *second);
  } else {
    write_tets(tets, mesh);
  }
  write_tetgen_elements(faces, base, mesh.triangles(), second != nullptr, second_order(mesh, 22));
  if (edges) {
    write_tetgen_elements(*edges, base, mesh.edges(), second != nullptr, second_order(mesh, 21));
  }
  std::vector<OutputFile*> all = {&faces, &nodes, &tets};
  if (edges) all.push_back(&*edges);
  OutputFile::commit_all(all, mesh.companions());
}

std::vector<std::filesystem::path> tetgen_files(const std::filesystem::path& node_or_ele) {
  std::vector<std::filesystem::path> files = {node_or_ele};
  for (const std::string_view extension : kTetgenExtensions) {
    const std::filesystem::path file = sibling(node_or_ele, extension);
    if (file != node_or_ele) files.push_back(file);
  }
  return files;
}

}  // namespace tetmend::formats
