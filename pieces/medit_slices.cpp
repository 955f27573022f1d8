// SPDX-License-Identifier: MIT
// The layout of the format: kernel/formats/medit_binary.cpp.
#include "pieces/medit_slices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <utility>

#include <fmt/format.h>

#include "kernel/formats/output_file.h"
#include "pieces/bytes.h"
#include "pieces/file_walk.h"

namespace tetmend::pieces {

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

template <class Value>
bool read_value(std::ifstream& in, Value& value) {
  in.read(reinterpret_cast<char*>(&value), sizeof(value));
  return static_cast<bool>(in);
}

template <class Integer>
Integer load(const char* at) {
  Integer value;
  std::memcpy(&value, at, sizeof(value));
  return value;
}

}  // namespace

std::unique_ptr<FileSlices> MeditSlices::open(const std::filesystem::path& file) {
  auto slices = std::make_unique<MeditSlices>();
  slices->file_ = file;
  if (!slices->list_sections()) return nullptr;
  slices->counts_ = {slices->vertices_.rows, slices->tets_.rows, slices->triangles_.rows,
                     slices->edges_.rows, slices->required_.rows};
  if (slices->counts_.tets == 0) return nullptr;
  return slices;
}

/// False for a file that is not as the class says.
bool MeditSlices::list_sections() {
  std::ifstream in(file_, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::uint64_t>(std::max<std::streamoff>(0, in.tellg()));
  in.seekg(0);
  std::int32_t cookie = 0;
  std::int32_t version = 0;
  if (!read_value(in, cookie) || !read_value(in, version) || cookie != 1) return false;
  if (version < 2 || version > 4) return false;
  version_ = version;
  std::int32_t keyword = 0;
  while (read_value(in, keyword) && keyword != end_of_mesh) {
    const auto read_number = [&](bool is_long, std::uint64_t& number) {
      std::int64_t wide = 0;
      std::int32_t narrow = 0;
      const bool done = is_long ? read_value(in, wide) : read_value(in, narrow);
      number = static_cast<std::uint64_t>(is_long ? wide : narrow);
      return done && (is_long ? wide : narrow) >= 0;
    };
    std::uint64_t next = 0;
    if (!read_number(version >= 3, next)) return false;
    if (next == 0) next = size;
    const std::array<std::pair<std::int32_t, Section*>, 5> kept = {
        {{vertices, &vertices_},
         {edges, &edges_},
         {triangles, &triangles_},
         {tetrahedra, &tets_},
         {required_vertices, &required_}}};
    const auto* found = std::find_if(kept.begin(), kept.end(),
                                     [&](const auto& each) { return each.first == keyword; });
    if (found != kept.end()) {
      Section& section = *found->second;
      if (section.begin != 0 || !read_number(version == 4, section.rows)) return false;
      section.begin = static_cast<std::uint64_t>(in.tellg());
      const std::uint64_t per_row = integer_size() * (keyword == tetrahedra  ? 5
                                                      : keyword == triangles ? 4
                                                      : keyword == edges     ? 3
                                                                             : 1) +
                                    (keyword == vertices ? 24 : 0);
      if (next > size || section.rows * per_row != next - section.begin) return false;
    } else if (keyword != dimension) {
      return false;
    }
    in.seekg(static_cast<std::streamoff>(next));
  }
  return true;
}

namespace {

/// Reads rows of a file.
template <class Integer>
class RowReader {
 public:
  RowReader(const std::filesystem::path& file, std::uint64_t vertices)
      : rows_(file), file_(file), vertices_(vertices) {}

  /// Of the elements of a section, those of the range.
  template <class Element>
  void read_elements(std::uint64_t section, const FileRange& range,
                     std::vector<FileElement<Element>>& elements) {
    if (range.size() == 0) return;
    constexpr std::size_t kVertices = std::tuple_size_v<decltype(Element::vertices)>;
    constexpr std::size_t kRow = (kVertices + 1) * sizeof(Integer);
    const char* at = rows_.read(section + range.begin * kRow, range.size() * kRow);
    elements.resize(range.size());
    for (auto& element : elements) {
      for (VertexId& v : element.vertices) v = number(std::exchange(at, at + sizeof(Integer)));
      if (has_repeated(element.vertices)) {
        throw Error(fmt::format("{}: an element has a vertex twice", file_.string()));
      }
      element.element.label = static_cast<Label>(load<Integer>(at));
      at += sizeof(Integer);
    }
  }

  /// Points and labels of all ids of the slice.
  void read_vertices(std::uint64_t section, Piece& slice) {
    constexpr std::size_t kAtOnce = 4096;  // rows between the first and the last that are read
    constexpr std::size_t kRow = 24 + sizeof(Integer);
    std::vector<Label> labels;
    slice.marks.assign(slice.ids.size(), 0);
    for (std::size_t k = 0; k < slice.ids.size();) {
      std::size_t end = k + 1;
      while (end < slice.ids.size() && slice.ids[end] < slice.ids[k] + kAtOnce) ++end;
      const char* at =
          rows_.read(section + slice.ids[k] * kRow, (slice.ids[end - 1] - slice.ids[k] + 1) * kRow);
      for (std::size_t n = k; n < end; ++n) {
        const char* here = at + (slice.ids[n] - slice.ids[k]) * kRow;
        const Point p(load<double>(here), load<double>(here + 8), load<double>(here + 16));
        if (!p.allFinite()) {
          throw Error(fmt::format("{}: a coordinate of vertex {} is not a finite number",
                                  file_.string(), slice.ids[n] + 1));
        }
        slice.points.push_back(p);
        labels.push_back(static_cast<Label>(load<Integer>(here + 24)));
      }
      k = end;
    }
    if (std::any_of(labels.begin(), labels.end(), [](Label label) { return label != 0; })) {
      slice.labels = std::move(labels);
    }
  }

  void read_required(std::uint64_t section, std::uint64_t count, Piece& slice) {
    if (count == 0) return;
    const char* at = rows_.read(section, count * sizeof(Integer));
    for (std::uint64_t r = 0; r < count; ++r) {
      const VertexId id = number(at + r * sizeof(Integer));
      const auto found = std::lower_bound(slice.ids.begin(), slice.ids.end(), id);
      if (found == slice.ids.end() || *found != id) continue;
      std::uint8_t& marks = slice.marks[static_cast<std::size_t>(found - slice.ids.begin())];
      marks = static_cast<std::uint8_t>(marks | kRequired);
    }
  }

 private:
  VertexId number(const char* at) const {
    const Integer value = load<Integer>(at);
    if (value < 1 || static_cast<std::uint64_t>(value) > vertices_) {
      throw Error(fmt::format("{}: {} is out of range: expected a vertex number, 1 to {}",
                              file_.string(), value, vertices_));
    }
    return static_cast<VertexId>(value - 1);
  }

  FileBytes rows_;
  const std::filesystem::path& file_;
  std::uint64_t vertices_;
};

}  // namespace

template <class Integer>
void MeditSlices::read_elements_of(const Share& of, FileElements& elements) const {
  RowReader<Integer> reader(file_, vertices_.rows);
  reader.read_elements(tets_.begin, of.tets, elements.tets);
  reader.read_elements(triangles_.begin, of.triangles, elements.triangles);
  reader.read_elements(edges_.begin, of.edges, elements.edges);
}

void MeditSlices::read_elements(const Share& of, FileElements& elements) const {
  version_ == 4 ? read_elements_of<std::int64_t>(of, elements)
                : read_elements_of<std::int32_t>(of, elements);
}

template <class Integer>
void MeditSlices::read_vertices_of(Piece& slice) const {
  RowReader<Integer> reader(file_, vertices_.rows);
  reader.read_vertices(vertices_.begin, slice);
  reader.read_required(required_.begin, required_.rows, slice);
}

void MeditSlices::read_vertices(Piece& slice) const {
  version_ == 4 ? read_vertices_of<std::int64_t>(slice) : read_vertices_of<std::int32_t>(slice);
}

namespace {

/// The first rank writes what all send it: a piece, or a range of vertices, at a time.
class Writer {
 public:
  /// @param out null on all ranks but the first
  Writer(OutputFile* out, const DividedMesh& mesh) : out_(out), walk_(mesh) {}

  void write() {
    choose_version();
    put(std::int32_t{1});
    put(version_);
    position_ = 2 * sizeof(std::int32_t);
    begin_section(dimension, sizeof(std::int32_t));
    put(std::int32_t{3});
    if (version_ == 4) {
      write_rows<std::int64_t>();
    } else {
      write_rows<std::int32_t>();
    }
    put(std::int32_t{end_of_mesh});
    put_position(0);
  }

 private:
  /// As write_medit_binary() does.
  void choose_version() {
    const FileWalk::Counts& counts = walk_.counts();
    const std::uint64_t required = walk_.required().size();
    const std::uint64_t most =
        std::max({counts.vertices, counts.tets, counts.triangles, counts.edges, required});
    const std::uint64_t size = 256 + 76 * counts.vertices + 12 * counts.edges +
                               16 * counts.triangles + 4 * required + 20 * counts.tets;
    version_ = most > INT32_MAX ? 4 : size > INT32_MAX ? 3 : 2;
  }
  template <class Value>
  void put(Value value) {
    if (out_ != nullptr) out_->put_bytes(value);
  }
  std::size_t position_size() const { return version_ >= 3 ? 8 : 4; }
  void put_position(std::uint64_t position) {
    if (version_ >= 3) return put(static_cast<std::int64_t>(position));
    put(static_cast<std::int32_t>(position));
  }
  void begin_section(std::int32_t keyword, std::uint64_t content_size) {
    position_ += sizeof keyword + position_size() + content_size;
    put(keyword);
    put_position(position_);
  }
  template <class Integer>
  void begin_rows(std::int32_t keyword, std::uint64_t rows, std::uint64_t row_size) {
    begin_section(keyword, sizeof(Integer) + rows * row_size);
    put(static_cast<Integer>(rows));
  }
  template <class Integer>
  void write_rows() {
    const FileWalk::Counts& counts = walk_.counts();
    begin_rows<Integer>(vertices, counts.vertices, 24 + sizeof(Integer));
    walk_.vertices([&](std::span<const FileVertex> some) {
      for (const FileVertex& vertex : some) {
        for (const double x : vertex.point) put(x);
        put(static_cast<Integer>(vertex.label));
      }
    });
    write_elements<Integer>(edges, counts.edges, &Piece::edges);
    write_elements<Integer>(triangles, counts.triangles, &Piece::triangles);
    if (!walk_.required().empty()) {
      begin_rows<Integer>(required_vertices, walk_.required().size(), sizeof(Integer));
      for (const VertexId id : walk_.required()) put(static_cast<Integer>(walk_.number(id) + 1));
    }
    write_elements<Integer>(tetrahedra, counts.tets, &Piece::tets);
  }
  template <class Integer, class Element>
  void write_elements(std::int32_t keyword, std::uint64_t rows,
                      std::vector<Element> Piece::*elements) {
    if (rows == 0) return;
    constexpr std::size_t kNumbers = std::tuple_size_v<decltype(Element::vertices)> + 1;
    begin_rows<Integer>(keyword, rows, kNumbers * sizeof(Integer));
    const auto pack = [](const auto& numbers, Label label, std::string& bytes) {
      for (const std::uint64_t v : numbers) pieces::put(static_cast<Integer>(v + 1), bytes);
      pieces::put(static_cast<Integer>(label), bytes);
    };
    walk_.elements(elements, pack, [&](std::string_view bytes) { out_->put(bytes); });
  }

  OutputFile* out_;
  const FileWalk walk_;
  std::int32_t version_ = 2;
  std::uint64_t position_ = 0;
};

}  // namespace

void write_medit_slices(const std::filesystem::path& file, const DividedMesh& mesh) {
  write_by_first(file, mesh.ranks(), [&](OutputFile* out) { Writer(out, mesh).write(); });
}

}  // namespace tetmend::pieces
