// SPDX-License-Identifier: MIT
// MEDIT's binary format `.meshb` (also known as GMF: Gamma Mesh Format).
//
//   int32 1 (the cookie, which shows the byte order)   int32 version
//   then for each section:  int32 keyword   position of the next keyword   [int count]   rows
//
// Positions are int32 in versions 1 and 2, else int64; coordinates float in version 1, else double;
// counts, vertex numbers and references int32 up to version 3, else int64. Keywords, and the
// dimension, are int32 always.
#include "kernel/formats/medit_binary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/byte_reader.h"
#include "kernel/formats/element_checks.h"
#include "kernel/formats/medit_elements.h"
#include "kernel/formats/medit_marks.h"
#include "kernel/formats/medit_vectors.h"
#include "kernel/formats/output_rows.h"

namespace tetmend::formats {
namespace {

enum Keyword : std::int32_t {
  dimension = 3,
  vertices = 4,
  edges = 5,
  triangles = 6,
  tetrahedra = 8,
  required_vertices = 15,
  end_of_mesh = 54
};

// Volume elements that the library cannot use, linear and of higher order.
constexpr std::array<std::int32_t, 12> kForeignVolumeCodes = {33, 46, 86,  87,  96,  97,
                                                              98, 99, 100, 101, 102, 103};

class MeditBinaryReader {
 public:
  MeditBinaryReader(const InputFile& file, TetPlace* question)
      : bytes_(file), question_(question) {}

  MeshData read() {
    read_header();
    list_sections();
    if (version_ == 1) return read_with<float, std::int32_t>();
    return version_ == 4 ? read_with<double, std::int64_t>() : read_with<double, std::int32_t>();
  }

 private:
  struct Section {
    std::int32_t keyword;
    std::size_t begin;  // of its content
    std::size_t size;   // of its content
  };

  void read_header() {
    if (bytes_.size() == 0)
      bytes_.fail_at(std::size_t{0}, "the file is empty: expected the cookie 1");
    if (std::string_view(bytes_.here(), bytes_.size()).starts_with("MeshVersionFormatted")) {
      bytes_.fail_at(std::size_t{0},
                     "this looks like a MEDIT file in text: its name should end in .mesh");
    }
    const auto cookie = bytes_.number<std::int32_t>("the cookie 1");
    if (cookie != 1 && cookie != byte_swapped(std::int32_t{1})) {
      bytes_.fail_at(
          std::size_t{0},
          fmt::format("the cookie {} is not that of a binary MEDIT file: expected 1", cookie));
    }
    bytes_.set_swap(cookie != 1);
    version_ = bytes_.number<std::int32_t>("the version of the format");
    if (version_ < 1 || version_ > kNewestMeditVersion) {
      bytes_.fail_at(bytes_.position() - sizeof version_,
                     fmt::format("version {} of the format is unknown: expected 1 to {}", version_,
                                 kNewestMeditVersion));
    }
  }

  // Each position must lie ahead, so that no chain of positions can go in circles.
  void list_sections() {
    while (bytes_.bytes_left() > 0) {
      const std::size_t at = bytes_.position();
      const auto keyword = bytes_.number<std::int32_t>("a keyword");
      if (keyword == end_of_mesh) return;
      if (keyword < 1)
        bytes_.fail_at(at, fmt::format("{} is not a keyword of the format", keyword));
      const std::size_t position_at = bytes_.position();
      const std::int64_t next = version_ >= 3
                                    ? bytes_.number<std::int64_t>("the position of a keyword")
                                    : bytes_.number<std::int32_t>("the position of a keyword");
      const std::size_t begin = bytes_.position();
      // 0 marks the last section of a file without an end keyword.
      const std::size_t end = next == 0 ? bytes_.size() : static_cast<std::size_t>(next);
      if (next < 0 || end < begin || end > bytes_.size()) {
        bytes_.fail_at(position_at,
                       fmt::format("the position {} of the next keyword is wrong: expected {} "
                                   "to {}; the file may be truncated",
                                   next, begin, bytes_.size()));
      }
      const auto same = [=](const Section& section) { return section.keyword == keyword; };
      if ((is_kept(keyword) || is_mark(keyword)) &&
          std::any_of(sections_.begin(), sections_.end(), same)) {
        bytes_.fail_at(at, fmt::format("the keyword {} appears for the second time", keyword));
      }
      sections_.push_back({keyword, begin, end - begin});
      bytes_.seek(end);
    }
  }

  static bool is_mark(std::int32_t keyword) {
    return std::any_of(kMeditMarks.begin(), kMeditMarks.end(),
                       [&](const MeditMark& mark) { return mark.keyword == keyword; });
  }
  static bool is_kept(std::int32_t keyword) {
    return keyword == dimension || keyword == vertices || keyword == edges ||
           keyword == triangles || keyword == tetrahedra || keyword == required_vertices ||
           find_medit_elements(keyword) != nullptr;
  }

  template <class Real, class Integer>
  MeshData read_with() {
    read_dimension();
    for (const Section& section : sections_) {
      const auto keyword = section.keyword;
      if (std::find(kForeignVolumeCodes.begin(), kForeignVolumeCodes.end(), keyword) !=
          kForeignVolumeCodes.end()) {
        bytes_.seek(section.begin);
        if (bytes_.number<Integer>("a count") > 0) {
          bytes_.fail_at(section.begin,
                         fmt::format("elements of keyword {} cannot be read: expected a mesh "
                                     "of tetrahedra with 4 vertices",
                                     keyword));
        }
      }
    }
    read_vertices<Real, Integer>(find(vertices, "Vertices"));
    for (const Section& section : sections_) {
      if (const auto* kind = find_medit_elements(section.keyword)) {
        read_others<Integer>(section, *kind);
      }
    }
    if (!has_second_order_tets(mesh_)) find(tetrahedra, "Tetrahedra");
    for (const Section& section : sections_) {
      if (section.keyword == tetrahedra) {
        read_elements<Integer>(section, mesh_.tets, "tetrahedra");
      }
      if (section.keyword == edges) read_elements<Integer>(section, mesh_.edges, "edges");
      if (section.keyword == triangles) {
        read_elements<Integer>(section, mesh_.triangles, "triangles");
      }
      if (section.keyword == required_vertices) read_required_vertices<Integer>(section);
    }
    for (const Section& section : sections_) {
      if (!is_kept(section.keyword)) read_marks<Integer>(section);
    }
    for (const MeditVectors& kind : kMeditVectors) {
      read_or_drop(fmt::format("'{}' with '{}'", kind.at, kind.vectors),
                   [&] { read_vectors<Real, Integer>(kind); });
    }
    drop_zero_point_labels(mesh_);
    return std::move(mesh_);
  }

  const Section& find(std::int32_t keyword, std::string_view name) const {
    for (const Section& section : sections_) {
      if (section.keyword == keyword) return section;
    }
    bytes_.fail_at(bytes_.size(), fmt::format("the section {} is missing", name));
  }

  void read_dimension() {
    const Section& section = find(dimension, "Dimension");
    bytes_.seek(section.begin);
    const auto value = bytes_.number<std::int32_t>("the dimension");
    if (value != 3) {
      bytes_.fail_at(section.begin, fmt::format("the dimension is {}: expected 3", value));
    }
  }

  /// Goes to the first row and gives the number of rows, which must fill the section.
  template <class Integer>
  std::size_t count_rows(const Section& section, std::size_t row_size, std::string_view what) {
    bytes_.seek(section.begin);
    if (section.size < sizeof(Integer)) {
      bytes_.fail_at(section.begin,
                     fmt::format("the section ends where the number of {} is expected", what));
    }
    const Integer count = bytes_.number<Integer>("a count");
    const std::size_t room = section.size - sizeof(Integer);
    if (count < 0 || static_cast<std::uint64_t>(count) > room / row_size ||
        static_cast<std::uint64_t>(count) * row_size != room) {
      bytes_.fail_at(section.begin,
                     fmt::format("the count of {} {} does not match the {} bytes of the "
                                 "section: expected {}",
                                 count, what, room, room / row_size));
    }
    return static_cast<std::size_t>(count);
  }

  template <class Real, class Integer>
  void read_vertices(const Section& section) {
    constexpr std::size_t kRowSize = 3 * sizeof(Real) + sizeof(Integer);
    const std::size_t count = count_rows<Integer>(section, kRowSize, "vertices");
    if (count > kMostVertices)
      bytes_.fail_at(section.begin, fmt::format("{} vertices are too many", count));
    mesh_.points.resize(count);
    mesh_.point_labels.resize(count);
    const char* row = bytes_.here();
    for (std::size_t i = 0; i < count; ++i, row += kRowSize) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const char* at = row + axis * sizeof(Real);
        const Real value = load<Real>(at, bytes_.swap());
        if (!std::isfinite(value)) {
          bytes_.fail_at(at,
                         fmt::format("{} is not a finite number: expected a coordinate", value));
        }
        mesh_.points[i][static_cast<Eigen::Index>(axis)] = value;
      }
      mesh_.point_labels[i] = read_label<Integer>(row + 3 * sizeof(Real));
    }
  }

  template <class Integer>
  Label read_label(const char* at) const {
    const Integer value = load<Integer>(at, bytes_.swap());
    if (value < INT32_MIN || value > INT32_MAX) {
      bytes_.fail_at(at, fmt::format("the reference {} is out of range: expected {} to {}", value,
                                     INT32_MIN, INT32_MAX));
    }
    return static_cast<Label>(value);
  }

  template <class Integer>
  std::uint32_t read_vertex_number(const char* at) const {
    const Integer value = load<Integer>(at, bytes_.swap());
    if (value < 1 || static_cast<std::uint64_t>(value) > mesh_.points.size()) {
      bytes_.fail_at(at, fmt::format("{} is out of range: expected a vertex number, 1 to {}", value,
                                     mesh_.points.size()));
    }
    return static_cast<std::uint32_t>(value - 1);
  }

  template <class Integer, class Element>
  void read_elements(const Section& section, std::vector<Element>& elements,
                     std::string_view what) {
    constexpr std::size_t kNumbers = std::tuple_size_v<decltype(Element::vertices)> + 1;
    elements.resize(count_rows<Integer>(section, kNumbers * sizeof(Integer), what));
    const char* row = bytes_.here();
    for (Element& element : elements) {
      const char* at = row;
      for (std::uint32_t& vertex : element.vertices) {
        vertex = read_vertex_number<Integer>(at);
        at += sizeof(Integer);
      }
      if (is_asked_for(question_, elements, element)) question_->place = bytes_.place_of(row);
      element.label = read_label<Integer>(at);
      row += kNumbers * sizeof(Integer);
    }
  }

  template <class Integer>
  void read_others(const Section& section, const MeditElements& kind) {
    const std::size_t row_size = (kind.width + 1) * sizeof(Integer);
    const std::size_t count = count_rows<Integer>(section, row_size, kind.section);
    if (count == 0) return;
    OtherElements others = medit_elements(kind, count);
    const char* at = bytes_.here();
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < kind.width; ++k, at += sizeof(Integer)) {
        others.vertices[i * kind.width + k] = read_vertex_number<Integer>(at);
      }
      others.labels[i] = read_label<Integer>(at);
      at += sizeof(Integer);
    }
    mesh_.other_elements.push_back(std::move(others));
  }

  template <class Integer>
  void read_required_vertices(const Section& section) {
    mesh_.required_vertices.resize(
        count_rows<Integer>(section, sizeof(Integer), "required vertices"));
    const char* at = bytes_.here();
    for (std::uint32_t& vertex : mesh_.required_vertices) {
      vertex = read_vertex_number<Integer>(at);
      at += sizeof(Integer);
    }
  }

  /// Any other section is named in the notes, unless it is empty.
  template <class Integer>
  void read_marks(const Section& section) {
    for (const MeditMark& mark : kMeditMarks) {
      if (mark.keyword != section.keyword) continue;
      if (!is_optional(mark)) return read_marks_of<Integer>(section, mark);
      return read_or_drop(fmt::format("'{}'", mark.section),
                          [&] { read_marks_of<Integer>(section, mark); });
    }
    for (const MeditVectors& kind : kMeditVectors) {
      if (section.keyword == kind.vectors_keyword || section.keyword == kind.at_keyword) return;
    }
    bytes_.seek(section.begin);
    const bool is_empty = section.size < sizeof(Integer) || bytes_.number<Integer>("a count") == 0;
    if (is_empty) return;
    mesh_.notes.push_back(fmt::format("the section of keyword {} is not kept", section.keyword));
  }

  /// Programs write sections wrong that no mesh needs.
  template <class Read>
  void read_or_drop(std::string_view section, const Read& read) {
    try {
      read();
    } catch (const Error& error) {
      mesh_.notes.push_back(fmt::format("the section {} is not kept: {}", section, error.what()));
    }
  }

  template <class Integer>
  void read_marks_of(const Section& section, const MeditMark& mark) {
    Group group{mark.dimension, 0, std::string(mark.section), {}, {}};
    group.members.resize(count_rows<Integer>(section, sizeof(Integer), "marks"));
    const std::size_t most = count_of_dimension(mesh_, mark.dimension);
    const char* at = bytes_.here();
    for (std::uint32_t& member : group.members) {
      const Integer value = load<Integer>(at, bytes_.swap());
      if (value < 1 || static_cast<std::uint64_t>(value) > most) {
        bytes_.fail_at(at, fmt::format("{} is out of range: expected the number of what is "
                                       "marked, 1 to {}",
                                       value, most));
      }
      member = static_cast<std::uint32_t>(value - 1);
      at += sizeof(Integer);
    }
    if (!group.members.empty()) mesh_.groups.push_back(std::move(group));
  }

  template <class Real, class Integer>
  void read_vectors(const MeditVectors& kind) {
    VectorsAtVertices read;
    for (const Section& section : sections_) {
      if (section.keyword != kind.vectors_keyword) continue;
      read.vectors.resize(count_rows<Integer>(section, 3 * sizeof(Real), "vectors"));
      const char* at = bytes_.here();
      for (auto& vector : read.vectors) {
        for (double& x : vector) {
          x = load<Real>(at, bytes_.swap());
          if (!std::isfinite(x)) bytes_.fail_at(at, fmt::format("{} is not a finite number", x));
          at += sizeof(Real);
        }
      }
    }
    for (const Section& section : sections_) {
      if (section.keyword != kind.at_keyword) continue;
      read.at.resize(count_rows<Integer>(section, 2 * sizeof(Integer), "vertices with a vector"));
      const char* at = bytes_.here();
      for (auto& [vertex, vector] : read.at) {
        vertex = read_vertex_number<Integer>(at);
        const Integer number = load<Integer>(at + sizeof(Integer), bytes_.swap());
        if (number < 1 || static_cast<std::uint64_t>(number) > read.vectors.size()) {
          bytes_.fail_at(at, fmt::format("{} is out of range: expected the number of a vector, 1 "
                                         "to {}",
                                         number, read.vectors.size()));
        }
        vector = static_cast<std::uint32_t>(number - 1);
        at += 2 * sizeof(Integer);
      }
    }
    read.add_to(mesh_, kind);
  }

  ByteReader bytes_;
  TetPlace* question_;
  std::int32_t version_ = 0;
  std::vector<Section> sections_;
  MeshData mesh_;
};

class MeditBinaryWriter {
 public:
  MeditBinaryWriter(OutputFile& out, const MeshView& mesh) : out_(out), mesh_(mesh) {}

  void write() {
    version_ = 4;
    if (most_rows() <= INT32_MAX) {
      version_ = 2;
      if (file_size() > INT32_MAX) version_ = 3;
    }
    out_.put_bytes(std::int32_t{1});
    out_.put_bytes(version_);
    position_ = 2 * sizeof(std::int32_t);
    begin_section(dimension, sizeof(std::int32_t));
    out_.put_bytes(std::int32_t{3});
    if (version_ == 4) {
      write_rows<std::int64_t>();
    } else {
      write_rows<std::int32_t>();
    }
    out_.put_bytes(std::int32_t{end_of_mesh});
    put_position(0);
  }

 private:
  std::size_t most_rows() const {
    return std::max({mesh_.point_count(), mesh_.tet_count(), mesh_.triangles().size(),
                     mesh_.edges().size(), mesh_.required_vertices().size()});
  }
  std::size_t position_size() const { return version_ >= 3 ? 8 : 4; }

  /// Not less than the size of the file in version 2.
  std::size_t file_size() const {
    constexpr std::size_t kHeaders = 256;
    return kHeaders + 28 * mesh_.point_count() + 12 * mesh_.edges().size() +
           16 * mesh_.triangles().size() + 4 * mesh_.required_vertices().size() +
           20 * mesh_.tet_count() + 4 * marks() + others_size() + 48 * mesh_.point_count();
  }

  std::size_t marks() const {
    std::size_t count = 0;
    for (const MeditMark& mark : kMeditMarks) {
      const Group* marked = find_marks(mesh_, mark);
      if (marked != nullptr) count += marked->members.size();
    }
    return count;
  }

  std::size_t others_size() const {
    std::size_t size = 0;
    for_medit_elements(mesh_, [&](const MeditElements&, const OtherElements& others) {
      size += 4 * (others.vertices.size() + others.labels.size() + 4);
    });
    return size;
  }

  void put_position(std::size_t position) {
    if (version_ >= 3) return out_.put_bytes(static_cast<std::int64_t>(position));
    out_.put_bytes(static_cast<std::int32_t>(position));
  }

  void begin_section(std::int32_t keyword, std::size_t content_size) {
    position_ += sizeof keyword + position_size() + content_size;
    out_.put_bytes(keyword);
    put_position(position_);
  }
  template <class Integer>
  void begin_rows(std::int32_t keyword, std::size_t rows, std::size_t row_size) {
    begin_section(keyword, sizeof(Integer) + rows * row_size);
    out_.put_bytes(static_cast<Integer>(rows));
  }

  template <class Integer, std::size_t N>
  static void put_row(OutputBuffer& out, const std::array<std::uint32_t, N>& row, Label label) {
    for (const std::uint32_t vertex : row) {
      out.put_bytes(static_cast<Integer>(std::int64_t{vertex} + 1));
    }
    out.put_bytes(static_cast<Integer>(label));
  }

  template <class Integer>
  void write_rows() {
    begin_rows<Integer>(vertices, mesh_.point_count(), 3 * sizeof(double) + sizeof(Integer));
    put_rows(out_, mesh_.point_count(), [&](std::size_t i, OutputBuffer& buffer) {
      for (int axis = 0; axis < 3; ++axis) buffer.put_bytes(mesh_.point(i)[axis]);
      buffer.put_bytes(static_cast<Integer>(mesh_.point_label(i)));
    });
    write_elements<Integer>(edges, mesh_.edges());
    write_elements<Integer>(triangles, mesh_.triangles());
    if (!mesh_.required_vertices().empty()) {
      begin_rows<Integer>(required_vertices, mesh_.required_vertices().size(), sizeof(Integer));
      for (const std::uint32_t vertex : mesh_.required_vertices()) {
        out_.put_bytes(static_cast<Integer>(std::int64_t{vertex} + 1));
      }
    }
    for (const MeditMark& mark : kMeditMarks) {
      const Group* marked = find_marks(mesh_, mark);
      if (marked == nullptr) continue;
      begin_rows<Integer>(mark.keyword, marked->members.size(), sizeof(Integer));
      for (const std::uint32_t member : marked->members) {
        out_.put_bytes(static_cast<Integer>(std::int64_t{member} + 1));
      }
    }
    for (const MeditVectors& kind : kMeditVectors) write_vectors<Integer>(kind);
    for_medit_elements(mesh_, [&](const MeditElements& kind, const OtherElements& others) {
      begin_rows<Integer>(kind.keyword, others.labels.size(), (kind.width + 1) * sizeof(Integer));
      put_rows(out_, others.labels.size(), [&](std::size_t i, OutputBuffer& buffer) {
        for (std::size_t k = 0; k < kind.width; ++k) {
          buffer.put_bytes(
              static_cast<Integer>(std::int64_t{others.vertices[i * kind.width + k]} + 1));
        }
        buffer.put_bytes(static_cast<Integer>(others.labels[i]));
      });
    });
    // Last: a file cut short never passes for a complete one.
    begin_rows<Integer>(tetrahedra, mesh_.tet_count(), 5 * sizeof(Integer));
    put_tets(out_, mesh_, [](std::size_t, const MeshData::Tet& tet, OutputBuffer& buffer) {
      put_row<Integer>(buffer, tet.vertices, tet.label);
    });
  }

  template <class Integer>
  void write_vectors(const MeditVectors& kind) {
    const VectorsAtVertices all = VectorsAtVertices::of(mesh_, kind);
    if (all.at.empty()) return;
    begin_rows<Integer>(kind.vectors_keyword, all.vectors.size(), 3 * sizeof(double));
    for (const auto& vector : all.vectors) {
      for (const double x : vector) out_.put_bytes(x);
    }
    begin_rows<Integer>(kind.at_keyword, all.at.size(), 2 * sizeof(Integer));
    for (const auto& pair : all.at) {
      for (const std::uint32_t i : pair) {
        out_.put_bytes(static_cast<Integer>(std::int64_t{i} + 1));
      }
    }
  }

  template <class Integer, class Element>
  void write_elements(std::int32_t keyword, std::span<const Element> elements) {
    if (elements.empty()) return;
    constexpr std::size_t kNumbers = std::tuple_size_v<decltype(Element::vertices)> + 1;
    begin_rows<Integer>(keyword, elements.size(), kNumbers * sizeof(Integer));
    put_rows(out_, elements.size(), [&](std::size_t i, OutputBuffer& buffer) {
      put_row<Integer>(buffer, elements[i].vertices, elements[i].label);
    });
  }

  OutputFile& out_;
  const MeshView& mesh_;
  std::int32_t version_ = 2;
  std::size_t position_ = 0;
};

}  // namespace

bool looks_like_medit_binary(std::string_view bytes) {
  if (bytes.size() < 2 * sizeof(std::int32_t)) return false;
  const auto cookie = load<std::int32_t>(bytes.data(), false);
  if (cookie != 1 && cookie != byte_swapped(std::int32_t{1})) return false;
  const auto version = load<std::int32_t>(bytes.data() + sizeof cookie, cookie != 1);
  return version >= 1 && version <= kNewestMeditVersion;
}

MeshData read_medit_binary(const std::filesystem::path& file, TetPlace* question) {
  const InputFile input(file);
  return MeditBinaryReader(input, question).read();
}

void write_medit_binary(const std::filesystem::path& file, const MeshView& mesh) {
  OutputFile out(file);
  MeditBinaryWriter(out, mesh).write();
  out.commit(mesh.companions());
}

}  // namespace tetmend::formats
