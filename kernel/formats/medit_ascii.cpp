// SPDX-License-Identifier: MIT
// MEDIT's text format `.mesh` (also known as GMF: Gamma Mesh Format).
#include "kernel/formats/medit_ascii.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/element_checks.h"
#include "kernel/formats/medit_binary.h"
#include "kernel/formats/medit_elements.h"
#include "kernel/formats/medit_marks.h"
#include "kernel/formats/medit_vectors.h"
#include "kernel/formats/mfem.h"
#include "kernel/formats/output_rows.h"
#include "kernel/formats/text_reader.h"
#include "kernel/formats/text_rows.h"
#include "kernel/formats/word_list.h"

namespace tetmend::formats {
namespace {

constexpr std::array<std::string_view, 5> kEptSections = {"Vertices", "Edges", "Triangles",
                                                          "Tetrahedra", "RequiredVertices"};

// Volume elements that the library cannot use. To skip them would tear holes into the mesh.
constexpr std::array<std::string_view, 12> kForeignVolumes = {
    "Polyhedra",   "PrismsP2",    "PyramidsP2", "HexahedraQ2", "TetrahedraP3", "TetrahedraP4",
    "HexahedraQ3", "HexahedraQ4", "PyramidsP3", "PyramidsP4",  "PrismsP3",     "PrismsP4"};

// Sections of rows that may hold any words, one row to a line.
constexpr std::array<std::string_view, 2> kTextSections = {"Comments", "IRefGroups"};

// The other section names of libMeshb 7; families are recognized by their beginning or end in
// `is_section`.
constexpr std::array<std::string_view, 52> kPassedSections = {
    "RequiredQuadrilaterals",
    "TangentAtEdgeVertices",
    "NormalAtTriangleVertices",
    "NormalAtQuadrilateralVertices",
    "AngleOfCornerBound",
    "TrianglesP3",
    "TrianglesP4",
    "EdgesP3",
    "EdgesP4",
    "QuadrilateralsQ2",
    "QuadrilateralsQ3",
    "QuadrilateralsQ4",
    "SubDomainFromGeom",
    "SubDomainFromMesh",
    "Fault_NearTri",
    "Fault_Inter",
    "Fault_FreeEdge",
    "Fault_Overlap",
    "Fault_BadShape",
    "Fault_SmallTri",
    "ExtraVerticesAtEdges",
    "ExtraVerticesAtTriangles",
    "ExtraVerticesAtQuadrilaterals",
    "ExtraVerticesAtTetrahedra",
    "ExtraVerticesAtPrisms",
    "ExtraVerticesAtHexahedra",
    "VerticesOnGeometricVertices",
    "VerticesOnGeometricEdges",
    "VerticesOnGeometricTriangles",
    "VerticesOnGeometricQuadrilaterals",
    "EdgesOnGeometricEdges",
    "TrianglesOnGeometricTriangles",
    "TrianglesOnGeometricQuadrilaterals",
    "QuadrilateralsOnGeometricTriangles",
    "QuadrilateralsOnGeometricQuadrilaterals",
    "Polygons",
    "BoundingBox",
    "PrivateTable",
    "Iterations",
    "Time",
    "CoarseHexahedra",
    "PeriodicVertices",
    "PeriodicEdges",
    "PeriodicTriangles",
    "PeriodicQuadrilaterals",
    "BezierBasis",
    "ByteFlow",
    "FloatingPointPrecision",
    "BoundaryLayers",
    "Geometry",
    "Identifier"};

const MeditMark* find_mark(std::string_view word) {
  const auto* found = std::find_if(kMeditMarks.begin(), kMeditMarks.end(),
                                   [&](const MeditMark& mark) { return mark.section == word; });
  return found == kMeditMarks.end() ? nullptr : found;
}

bool is_section(std::string_view word) {
  return word == "End" || is_medit_vectors(word) || contains(kEptSections, word) ||
         contains(kForeignVolumes, word) || contains(kTextSections, word) ||
         contains(kPassedSections, word) || find_mark(word) != nullptr ||
         find_medit_elements(word) != nullptr || word.starts_with("SolAt") ||
         word.starts_with("ISolAt") || word.starts_with("DSolAt") || word.starts_with("HOSolAt") ||
         word.ends_with("Ordering") || word.ends_with("ReferenceElement");
}

bool is_number_word(std::string_view word) {
  std::string lower(word.substr(0, 3));
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower == "nan" || lower == "inf" || !std::isalpha(static_cast<unsigned char>(word[0]));
}

class MeditAsciiReader {
 public:
  MeditAsciiReader(const InputFile& file, TetPlace* question)
      : text_(file, '#'), question_(question) {}

  MeshData read() {
    read_header();
    while (read_section(text_.word())) {
    }
    const char* end = text_.position();
    if (!seen("Vertices")) fail_without("Vertices", end);
    for (const auto& [name, content] : postponed_) {
      text_.seek(content);
      read_kept_section(name);
    }
    // What they mark has been counted now.
    for (const auto& [name, content] : marks_) {
      text_.seek(content);
      const MeditMark* mark = find_mark(name);
      if (mark == nullptr) continue;
      if (is_optional(*mark)) {
        read_or_drop(in_quotes(name), [&] { read_marks(*mark); });
      } else {
        read_marks(*mark);
      }
    }
    for (const MeditVectors& kind : kMeditVectors) {
      read_or_drop(fmt::format("'{}' with '{}'", kind.at, kind.vectors),
                   [&] { read_vectors(kind); });
    }
    if (!seen("Tetrahedra") && !has_second_order_tets(mesh_)) fail_without("Tetrahedra", end);
    drop_zero_point_labels(mesh_);
    return std::move(mesh_);
  }

 private:
  struct Section {
    std::string_view name;
    const char* content;
  };

  void read_header() {
    if (looks_like_medit_binary({text_.position(), text_.bytes_left()})) {
      text_.fail("this looks like a binary MEDIT file: its name should end in .meshb");
    }
    const std::string_view first = text_.word();
    if (first != "MeshVersionFormatted") {
      if (first == "%" && text_.word() == "GETFEM") {
        text_.fail("this is a mesh of GetFEM, not of MEDIT: GetFEM exports it as .vtk or .vtu");
      }
      if (first == "mesh3d") {
        text_.fail("this is a mesh of Netgen, not of MEDIT: its name should end in .vol");
      }
      text_.fail(first.empty() ? "the file is empty: expected MeshVersionFormatted"
                               : fmt::format("{} is not the beginning of a MEDIT file: expected "
                                             "MeshVersionFormatted",
                                             in_quotes(first)));
    }
    text_.integer("the version of the format", 1, 4);
    const std::string_view second = text_.expect_word("Dimension");
    if (second != "Dimension")
      text_.fail(fmt::format("{} is not expected here: expected Dimension", in_quotes(second)));
    if (text_.integer("the dimension", 1, 3) != 3) {
      text_.fail("the mesh is not three-dimensional: expected Dimension 3");
    }
  }

  /// False at the end of the mesh.
  bool read_section(std::string_view name) {
    has_end_ = name == "End";
    if (name.empty() || has_end_) return false;
    if (!is_section(name) && !is_unknown_section(name)) {
      text_.fail(
          fmt::format("{} is not expected here: expected the name of a section, such as "
                      "Vertices, Triangles, Tetrahedra or End",
                      in_quotes(name)));
    }
    const bool is_mark = find_mark(name) != nullptr || is_medit_vectors(name);
    const bool is_kept = contains(kEptSections, name) || find_medit_elements(name) != nullptr;
    if (is_mark || is_kept) {
      if (seen(name)) text_.fail(fmt::format("{} appears for the second time", in_quotes(name)));
      seen_.push_back(name);
    }
    if (is_kept) {
      if (name != "Vertices" && !seen("Vertices")) {
        postponed_.push_back({name, text_.position()});
        pass_over(name);
      } else {
        read_kept_section(name);
      }
    } else if (is_mark) {
      marks_.push_back({name, text_.position()});
      pass_over(name);
    } else {
      if (contains(kForeignVolumes, name)) refuse_volumes(name);
      const char* content = text_.position();
      pass_over(name);
      if (!is_empty(content)) {
        mesh_.notes.push_back(fmt::format("the section {} is not kept", in_quotes(name)));
      }
    }
    return true;
  }

  /// Programs add sections of their own: a word with a capital, then a number.
  bool is_unknown_section(std::string_view name) {
    if (std::isupper(static_cast<unsigned char>(name[0])) == 0) return false;
    const char* content = text_.position();
    const std::string_view next = text_.word();
    text_.seek(content);
    return !next.empty() && std::isdigit(static_cast<unsigned char>(next[0])) != 0;
  }

  /// True if the section says that it has no rows.
  bool is_empty(const char* content) {
    const char* end = text_.position();
    text_.seek(content);
    const bool is_zero = text_.word() == "0";
    text_.seek(end);
    return is_zero;
  }

  /// Programs write sections wrong that no mesh needs. But a file without an end may be cut there.
  template <class Read>
  void read_or_drop(std::string_view section, const Read& read) {
    try {
      read();
    } catch (const Error& error) {
      if (!has_end_) throw;
      mesh_.notes.push_back(fmt::format("the section {} is not kept: {}", section, error.what()));
    }
  }

  void read_marks(const MeditMark& mark) {
    Group group{mark.dimension, 0, std::string(mark.section), {}, {}};
    const auto most = static_cast<std::int64_t>(count_of_dimension(mesh_, mark.dimension));
    group.members.resize(text_.count("marks", 2));
    for (std::uint32_t& member : group.members) {
      member =
          static_cast<std::uint32_t>(text_.integer("the number of what is marked", 1, most) - 1);
    }
    if (!group.members.empty()) mesh_.groups.push_back(std::move(group));
  }

  void read_vectors(const MeditVectors& kind) {
    VectorsAtVertices read;
    for (const auto& [name, content] : marks_) {
      if (name != kind.vectors) continue;
      text_.seek(content);
      read.vectors.resize(text_.count("vectors", 6));
      for (auto& vector : read.vectors) {
        for (double& x : vector) x = text_.real("a coordinate of a vector");
      }
    }
    const auto most = static_cast<std::int64_t>(read.vectors.size());
    for (const auto& [name, content] : marks_) {
      if (name != kind.at) continue;
      text_.seek(content);
      read.at.resize(text_.count("vertices with a vector", 4));
      for (auto& [vertex, vector] : read.at) {
        vertex = read_vertex_number(text_);
        vector = static_cast<std::uint32_t>(text_.integer("the number of a vector", 1, most) - 1);
      }
    }
    read.add_to(mesh_, kind);
  }

  void read_kept_section(std::string_view name) {
    if (name == "Vertices") read_vertices();
    if (name == "Edges") read_elements(mesh_.edges, "edges");
    if (name == "Triangles") read_elements(mesh_.triangles, "triangles");
    if (name == "Tetrahedra") read_elements(mesh_.tets, "tetrahedra");
    if (name == "RequiredVertices") read_required_vertices();
    if (const MeditElements* kind = find_medit_elements(name)) read_others(*kind);
  }

  void read_others(const MeditElements& kind) {
    const std::size_t count = text_.count(kind.section, 2 * (kind.width + 1));
    if (count == 0) return;
    OtherElements others = medit_elements(kind, count);
    read_rows(text_, count, [&](TextReader& text, std::size_t i) {
      for (std::size_t k = 0; k < kind.width; ++k) {
        others.vertices[i * kind.width + k] = read_vertex_number(text);
      }
      others.labels[i] = text.label("the reference of an element");
    });
    mesh_.other_elements.push_back(std::move(others));
  }

  void refuse_volumes(std::string_view name) {
    const char* word = text_.last_word();
    if (text_.integer(fmt::format("the number of {}", name), 0, INT64_MAX) > 0) {
      text_.fail_at(word,
                    fmt::format("{} cannot be read: expected a mesh of Tetrahedra with 4 vertices",
                                in_quotes(name)));
    }
  }

  // Numbers are not counted, only passed over to the next word: that holds for sections of every
  // shape.
  void pass_over(std::string_view name) {
    if (contains(kTextSections, name)) return pass_over_lines();
    for (;;) {
      const char* before = text_.position();
      const std::string_view word = text_.word();
      if (word.empty()) return;
      if (is_number_word(word)) continue;
      text_.seek(before);
      return;
    }
  }

  void pass_over_lines() {
    const std::size_t count = text_.count("lines", 1);
    text_.skip_line();
    for (std::size_t i = 0; i < count; ++i) text_.skip_line();
  }

  void read_vertices() {
    const std::size_t count = text_.count("vertices", std::string_view("0 0 0 0\n").size());
    if (count > kMostVertices) text_.fail(fmt::format("{} vertices are too many", count));
    mesh_.points.resize(count);
    mesh_.point_labels.resize(count);
    read_rows(text_, count, [this](TextReader& text, std::size_t i) {
      Point& point = mesh_.points[i];
      for (int axis = 0; axis < 3; ++axis) point[axis] = text.real("a coordinate of a vertex");
      mesh_.point_labels[i] = text.label("the reference of a vertex");
    });
  }

  std::uint32_t read_vertex_number(TextReader& text) const {
    const auto count = static_cast<std::int64_t>(mesh_.points.size());
    return static_cast<std::uint32_t>(text.integer("a vertex number", 1, count) - 1);
  }

  template <class Element>
  void read_elements(std::vector<Element>& elements, std::string_view what) {
    constexpr std::size_t kNumbers = std::tuple_size_v<decltype(Element::vertices)> + 1;
    elements.resize(text_.count(what, 2 * kNumbers));
    read_rows(text_, elements.size(), [&](TextReader& text, std::size_t i) {
      Element& element = elements[i];
      for (std::uint32_t& vertex : element.vertices) vertex = read_vertex_number(text);
      if (is_asked_for(question_, elements, element)) {
        question_->place = text.place_of(text.last_word());
      }
      element.label = text.label("the reference of an element");
    });
  }

  void read_required_vertices() {
    mesh_.required_vertices.resize(text_.count("required vertices", 2));
    for (std::uint32_t& vertex : mesh_.required_vertices) vertex = read_vertex_number(text_);
  }

  bool seen(std::string_view name) const {
    return std::find(seen_.begin(), seen_.end(), name) != seen_.end();
  }

  [[noreturn]] void fail_without(std::string_view name, const char* end) const {
    text_.fail_at(end, fmt::format("the section {} is missing", name));
  }

  TextReader text_;
  TetPlace* question_;
  MeshData mesh_;
  bool has_end_ = false;
  std::vector<std::string_view> seen_;
  // What came before Vertices, of which the number was not known yet.
  std::vector<Section> postponed_;
  std::vector<Section> marks_;
};

template <class Element>
void write_row(OutputBuffer& out, const Element& element) {
  for (const std::uint32_t vertex : element.vertices) {
    out.put_integer(std::int64_t{vertex} + 1);
    out.put(' ');
  }
  out.put_integer(element.label);
  out.put('\n');
}

void write_vertex(OutputBuffer& out, const Point& point, Label label) {
  for (int axis = 0; axis < 3; ++axis) {
    out.put_real(point[axis]);
    out.put(' ');
  }
  out.put_integer(label);
  out.put('\n');
}

void begin_section(OutputFile& out, std::string_view name, std::size_t count) {
  out.put(fmt::format("{}\n{}\n", name, count));
}

void end_file(OutputFile& out, const MeshView& mesh) {
  out.put("End\n");
  out.commit(mesh.companions());
}

void write_vectors(OutputFile& out, const MeshView& mesh, const MeditVectors& kind) {
  const VectorsAtVertices all = VectorsAtVertices::of(mesh, kind);
  if (all.at.empty()) return;
  begin_section(out, kind.vectors, all.vectors.size());
  put_rows(out, all.vectors.size(), [&](std::size_t i, OutputBuffer& buffer) {
    for (const double x : all.vectors[i]) {
      buffer.put_real(x);
      buffer.put(' ');
    }
    buffer.put('\n');
  });
  begin_section(out, kind.at, all.at.size());
  put_rows(out, all.at.size(), [&](std::size_t i, OutputBuffer& buffer) {
    buffer.put_integer(std::int64_t{all.at[i][0]} + 1);
    buffer.put(' ');
    buffer.put_integer(std::int64_t{all.at[i][1]} + 1);
    buffer.put('\n');
  });
}

template <class Element>
void write_medit_elements(OutputFile& out, std::string_view name,
                          std::span<const Element> elements) {
  if (elements.empty()) return;
  begin_section(out, name, elements.size());
  put_rows(out, elements.size(),
           [&](std::size_t i, OutputBuffer& buffer) { write_row(buffer, elements[i]); });
}

}  // namespace

MeshData read_medit_ascii(const std::filesystem::path& file, TetPlace* question) {
  const InputFile input(file);
  if (looks_like_mfem(input)) return read_mfem(input, question);
  return MeditAsciiReader(input, question).read();
}

void write_medit_ascii(const std::filesystem::path& file, const MeshView& mesh) {
  OutputFile out(file);
  out.put("MeshVersionFormatted 2\nDimension 3\n");
  begin_section(out, "Vertices", mesh.point_count());
  put_rows(out, mesh.point_count(), [&](std::size_t i, OutputBuffer& buffer) {
    write_vertex(buffer, mesh.point(i), mesh.point_label(i));
  });
  write_medit_elements(out, "Edges", mesh.edges());
  write_medit_elements(out, "Triangles", mesh.triangles());
  if (!mesh.required_vertices().empty()) {
    begin_section(out, "RequiredVertices", mesh.required_vertices().size());
    for (const std::uint32_t vertex : mesh.required_vertices()) {
      out.put_integer(std::int64_t{vertex} + 1);
      out.put('\n');
    }
  }
  for (const MeditMark& mark : kMeditMarks) {
    const Group* marked = find_marks(mesh, mark);
    if (marked == nullptr) continue;
    begin_section(out, mark.section, marked->members.size());
    for (const std::uint32_t member : marked->members) {
      out.put_integer(std::int64_t{member} + 1);
      out.put('\n');
    }
  }
  for (const MeditVectors& kind : kMeditVectors) write_vectors(out, mesh, kind);
  for_medit_elements(mesh, [&](const MeditElements& kind, const OtherElements& others) {
    begin_section(out, kind.section, others.labels.size());
    put_rows(out, others.labels.size(), [&](std::size_t i, OutputBuffer& buffer) {
      for (std::size_t k = 0; k < kind.width; ++k) {
        buffer.put_integer(std::int64_t{others.vertices[i * kind.width + k]} + 1);
        buffer.put(' ');
      }
      buffer.put_integer(others.labels[i]);
      buffer.put('\n');
    });
  });
  const bool is_second = mesh.data() != nullptr && has_second_order_tets(*mesh.data());
  if (is_second && mesh.tet_count() == 0) return end_file(out, mesh);
  begin_section(out, "Tetrahedra", mesh.tet_count());
  put_tets(out, mesh, [](std::size_t, const MeshData::Tet& tet, OutputBuffer& buffer) {
    write_row(buffer, tet);
  });
  end_file(out, mesh);
}

}  // namespace tetmend::formats
