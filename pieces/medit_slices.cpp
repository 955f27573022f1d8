// SPDX-License-Identifier: MIT
// The layout of the format: kernel/formats/medit_binary.cpp.
#include "pieces/medit_slices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <utility>

#include "kernel/formats/output_file.h"
#include "pieces/bytes.h"
#include "pieces/file_walk.h"

namespace tetmend::pieces {

using formats::kMeditMarks;
using formats::kMeditVectors;

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

/// Bytes of a row of a section.
std::uint64_t row_size(std::int32_t keyword, std::uint64_t integer_size) {
  for (const formats::MeditVectors& kind : kMeditVectors) {
    if (kind.vectors_keyword == keyword) return 3 * sizeof(double);
    if (kind.at_keyword == keyword) return 2 * integer_size;
  }
  return integer_size * (keyword == tetrahedra  ? 5
                         : keyword == triangles ? 4
                         : keyword == edges     ? 3
                                                : 1) +
         (keyword == vertices ? 3 * sizeof(double) : 0);
}

template <class Value>
bool read_value(std::ifstream& in, Value& value) {
  in.read(reinterpret_cast<char*>(&value), sizeof(value));
  return static_cast<bool>(in);
}

}  // namespace

std::unique_ptr<FileSlices> MeditSlices::open(const std::filesystem::path& file, Ranks& ranks) {
  auto slices = std::make_unique<MeditSlices>();
  slices->file_ = file;
  if (!slices->list_sections()) return nullptr;
  slices->counts_ = {slices->vertices_.rows, slices->tets_.rows, slices->triangles_.rows,
                     slices->edges_.rows, slices->required_.rows};
  if (slices->counts_.tets == 0 || !slices->are_marks_sound()) return nullptr;
  const bool are_sound = slices->are_vertices_sound(ranks) &&
                         slices->are_elements_sound(slices->tets_, 4, ranks) &&
                         slices->are_elements_sound(slices->triangles_, 3, ranks) &&
                         slices->are_elements_sound(slices->edges_, 2, ranks);
  if (ranks.any(!are_sound)) return nullptr;
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
    if (Section* const section = section_of(keyword)) {
      if (section->begin != 0 || !read_number(version_ == 4, section->rows)) return false;
      section->begin = static_cast<std::uint64_t>(in.tellg());
      const std::uint64_t per_row = row_size(keyword, integer_size());
      if (next > size || section->rows * per_row != next - section->begin) return false;
    } else if (keyword != dimension) {
      return false;
    }
    in.seekg(static_cast<std::streamoff>(next));
  }
  return true;
}

/// Null for a keyword of which nothing is kept.
MeditSlices::Section* MeditSlices::section_of(std::int32_t keyword) {
  switch (keyword) {
    case vertices:
      return &vertices_;
    case edges:
      return &edges_;
    case triangles:
      return &triangles_;
    case tetrahedra:
      return &tets_;
    case required_vertices:
      return &required_;
    default:
      break;
  }
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    if (kMeditMarks[i].keyword == keyword) return &marks_[i];
  }
  for (std::size_t i = 0; i < vectors_.size(); ++i) {
    if (kMeditVectors[i].vectors_keyword == keyword) return &vectors_[i].vectors;
    if (kMeditVectors[i].at_keyword == keyword) return &vectors_[i].at;
  }
  return nullptr;
}

/// Of a section of integers, `width` in a row.
std::vector<std::uint64_t> MeditSlices::numbers(const Section& section, std::size_t width) const {
  std::vector<std::uint64_t> numbers(section.rows * width);
  if (numbers.empty()) return numbers;
  FileBytes bytes(file_);
  const char* at = bytes.read(section.begin, numbers.size() * integer_size());
  for (std::uint64_t& number : numbers) {
    number = static_cast<std::uint64_t>(version_ == 4 ? value_at<std::int64_t>(at)
                                                      : value_at<std::int32_t>(at));
    at += integer_size();
  }
  return numbers;
}

/// All numbers are of something that is there, and no vertex has two vectors of a kind.
bool MeditSlices::are_marks_sound() const {
  const auto is_among = [](std::uint64_t most) {
    return [most](std::uint64_t number) { return number >= 1 && number <= most; };
  };
  const std::vector<std::uint64_t> required = numbers(required_, 1);
  if (!std::all_of(required.begin(), required.end(), is_among(vertices_.rows))) return false;
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    const int dimension = kMeditMarks[i].dimension;
    const std::uint64_t most = dimension == 0   ? vertices_.rows
                               : dimension == 1 ? edges_.rows
                                                : triangles_.rows;
    const std::vector<std::uint64_t> all = numbers(marks_[i], 1);
    if (!std::all_of(all.begin(), all.end(), is_among(most))) return false;
  }
  for (const VectorSections& sections : vectors_) {
    const std::vector<std::uint64_t> all = numbers(sections.at, 2);
    std::vector<std::uint64_t> at;
    for (std::size_t i = 0; i < all.size(); i += 2) {
      if (!is_among(vertices_.rows)(all[i]) || !is_among(sections.vectors.rows)(all[i + 1])) {
        return false;
      }
      at.push_back(all[i]);
    }
    std::sort(at.begin(), at.end());
    if (std::adjacent_find(at.begin(), at.end()) != at.end()) return false;
  }
  return true;
}

namespace {

constexpr std::uint64_t kRowsAtOnce = std::uint64_t{1} << 16;

bool is_label(std::int64_t number) {
  return number >= INT32_MIN && number <= INT32_MAX;
}

}  // namespace

/// Of this rank's share: places are finite, and labels have 32 bits.
bool MeditSlices::are_vertices_sound(const Ranks& ranks) const {
  constexpr std::uint64_t kPlace = 3 * sizeof(double);
  const FileRange mine = FileRange::of_slice(vertices_.rows, ranks.number(), ranks.count());
  const std::uint64_t size = row_size(vertices, integer_size());
  FileBytes bytes(file_);
  for (std::uint64_t i = mine.begin; i < mine.end; i += kRowsAtOnce) {
    const std::uint64_t count = std::min(kRowsAtOnce, mine.end - i);
    const char* at = bytes.read(vertices_.begin + i * size, count * size);
    for (const char* const end = at + count * size; at != end; at += size) {
      const Point place(value_at<double>(at), value_at<double>(at + 8), value_at<double>(at + 16));
      const std::int64_t label =
          version_ == 4 ? value_at<std::int64_t>(at + kPlace) : value_at<std::int32_t>(at + kPlace);
      if (!place.allFinite() || !is_label(label)) return false;
    }
  }
  return true;
}

/// Of this rank's share of a section: all numbers are of vertices, no element has one twice, and labels
/// have 32 bits.
bool MeditSlices::are_elements_sound(const Section& section, std::size_t vertices,
                                     const Ranks& ranks) const {
  const FileRange mine = FileRange::of_slice(section.rows, ranks.number(), ranks.count());
  const std::size_t width = vertices + 1;
  for (std::uint64_t i = mine.begin; i < mine.end; i += kRowsAtOnce) {
    const Section some{section.begin + i * width * integer_size(),
                       std::min(kRowsAtOnce, mine.end - i)};
    const std::vector<std::uint64_t> rows = numbers(some, width);
    for (std::size_t at = 0; at < rows.size(); at += width) {
      const std::uint64_t* const row = rows.data() + at;
      for (std::size_t k = 0; k < vertices; ++k) {
        if (row[k] < 1 || row[k] > vertices_.rows) return false;
        if (std::find(row, row + k, row[k]) != row + k) return false;
      }
      if (!is_label(static_cast<std::int64_t>(row[vertices]))) return false;
    }
  }
  return true;
}

namespace {

/// Of a kind of marks, or behind those of a kind of vectors.
constexpr std::int32_t bit_of_mark(std::size_t kind) {
  return 1 << kind;
}
constexpr std::int32_t bit_of_vector(std::size_t kind) {
  return bit_of_mark(kMeditMarks.size() + kind);
}

void set_mark(std::int32_t bit, std::size_t i, std::string& rows) {
  std::int32_t marks = value_at<std::int32_t>(rows.data() + i * sizeof(bit));
  marks |= bit;
  std::memcpy(rows.data() + i * sizeof(bit), &marks, sizeof(marks));
}

}  // namespace

bool MeditSlices::has_marks(int dimension) const {
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    if (kMeditMarks[i].dimension == dimension && marks_[i].rows > 0) return true;
  }
  return dimension == 0 &&
         std::any_of(vectors_.begin(), vectors_.end(),
                     [](const VectorSections& sections) { return sections.at.rows > 0; });
}

ByKind<RowLayout> MeditSlices::row_layouts() const {
  const RowLayout marks({{"marks", 1, std::vector<std::int32_t>()}});
  ByKind<RowLayout> layouts;
  if (has_marks(0)) layouts[RowKind::vertex] = marks;
  if (has_marks(1)) layouts[RowKind::edge] = marks;
  if (has_marks(2)) layouts[RowKind::triangle] = marks;
  layouts[RowKind::point] = RowLayout(digest().point_data);
  return layouts;
}

std::string MeditSlices::row_of_new_vertex() const {
  std::string row;
  if (has_marks(0)) put(std::int32_t{0}, row);
  return row;
}

MeshData MeditSlices::digest() const {
  MeshData data;
  const auto add_group = [&](int dimension, std::string_view name, std::uint64_t count) {
    if (count == 0) return;
    data.groups.push_back({dimension, 0, std::string(name), {}, std::vector<std::uint32_t>(count)});
  };
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    add_group(kMeditMarks[i].dimension, kMeditMarks[i].section, marks_[i].rows);
  }
  for (std::size_t i = 0; i < vectors_.size(); ++i) {
    if (vectors_[i].at.rows == 0) continue;
    add_group(0, kMeditVectors[i].at, vectors_[i].at.rows);
    data.point_data.push_back({std::string(kMeditVectors[i].vectors), 3, std::vector<double>()});
  }
  return data;
}

void MeditSlices::read_rows(const Share& of, const std::vector<VertexId>& ids,
                            ByKind<std::string>& rows) const {
  const ByKind<RowLayout> layouts = row_layouts();
  rows[RowKind::vertex].resize(ids.size() * layouts[RowKind::vertex].size());
  rows[RowKind::point].resize(ids.size() * layouts[RowKind::point].size());
  rows[RowKind::edge].resize(of.edges.size() * layouts[RowKind::edge].size());
  rows[RowKind::triangle].resize(of.triangles.size() * layouts[RowKind::triangle].size());
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    const int dimension = kMeditMarks[i].dimension;
    const FileRange range = dimension == 1 ? of.edges : of.triangles;
    std::string& to = rows[dimension == 1 ? RowKind::edge : RowKind::triangle];
    for (const std::uint64_t number : numbers(marks_[i], 1)) {
      if (dimension > 0) {
        if (range.has(number - 1)) set_mark(bit_of_mark(i), number - 1 - range.begin, to);
        continue;
      }
      const auto id = std::lower_bound(ids.begin(), ids.end(), number - 1);
      if (id == ids.end() || *id != number - 1) continue;
      set_mark(bit_of_mark(i), static_cast<std::size_t>(id - ids.begin()), rows[RowKind::vertex]);
    }
  }
  for (std::size_t i = 0; i < vectors_.size(); ++i) add_vectors(i, ids, rows);
}

void MeditSlices::add_vectors(std::size_t kind, const std::vector<VertexId>& ids,
                              ByKind<std::string>& rows) const {
  constexpr std::size_t kSize = 3 * sizeof(double);
  const VectorSections& sections = vectors_[kind];
  if (sections.at.rows == 0) return;
  const RowLayout layout(digest().point_data);
  const std::size_t place = kind > 0 && vectors_[0].at.rows > 0 ? layout.place(1) : layout.place(0);
  const std::vector<std::uint64_t> at = numbers(sections.at, 2);
  FileBytes bytes(file_);
  for (std::size_t k = 0; k < at.size(); k += 2) {
    const auto id = std::lower_bound(ids.begin(), ids.end(), at[k] - 1);
    if (id == ids.end() || *id != at[k] - 1) continue;
    const auto i = static_cast<std::size_t>(id - ids.begin());
    set_mark(bit_of_vector(kind), i, rows[RowKind::vertex]);
    const char* const vector = bytes.read(sections.vectors.begin + (at[k + 1] - 1) * kSize, kSize);
    std::copy_n(vector, kSize, rows[RowKind::point].data() + i * layout.size() + place);
  }
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
      if (has_repeated(element.vertices)) fail_changed(file_);
      element.element.label = static_cast<Label>(value_at<Integer>(at));
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
        const Point p(value_at<double>(here), value_at<double>(here + 8),
                      value_at<double>(here + 16));
        if (!p.allFinite()) fail_changed(file_);
        slice.points.push_back(p);
        labels.push_back(static_cast<Label>(value_at<Integer>(here + 24)));
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
    const Integer value = value_at<Integer>(at);
    if (value < 1 || static_cast<std::uint64_t>(value) > vertices_) fail_changed(file_);
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
  Writer(OutputFile* out, const DividedMesh& mesh, const CarriedRows* rows)
      : out_(out), ranks_(mesh.ranks()), walk_(mesh), rows_(rows) {}

  void write() {
    collect_marks();
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
  struct Vector {
    std::uint64_t vertex;
    std::array<double, 3> vector;
  };

  /// On the first rank, what is marked, by its numbers from 0.
  void collect_marks() {
    if (rows_ == nullptr) return;
    collect_vertices();
    collect_elements(RowKind::edge, 1, &Piece::edges);
    collect_elements(RowKind::triangle, 2, &Piece::triangles);
    std::uint64_t count = 0;
    for (const auto& marked : marked_) count += marked.size();
    std::string bytes;
    pieces::put(count, bytes);
    const std::vector<std::string> all = ranks_.gather(bytes);
    std::string_view first = all.front();
    take(first, marks_);
  }
  bool has(RowKind kind) const { return rows_ != nullptr && rows_->layout(kind).size() > 0; }
  void collect_vertices() {
    if (!has(RowKind::vertex)) return;
    const std::size_t arrays = rows_->layout(RowKind::point).arrays().size();
    const std::size_t size = sizeof(std::int32_t) + rows_->layout(RowKind::point).size();
    const auto pack = [&](std::size_t part, std::size_t begin, const Piece& vertices) {
      const std::size_t end = begin + vertices.ids.size();
      const std::string marks = rows_->column(RowKind::vertex, part, 0, begin, end);
      std::vector<std::string> vectors;
      for (std::size_t i = 0; i < arrays; ++i) {
        vectors.push_back(rows_->column(RowKind::point, part, i, begin, end));
      }
      std::string bytes;
      for (std::size_t v = 0; v < vertices.ids.size(); ++v) {
        bytes.append(marks, v * sizeof(std::int32_t), sizeof(std::int32_t));
        for (const std::string& of_kind : vectors) {
          bytes.append(of_kind, v * 3 * sizeof(double), 3 * sizeof(double));
        }
      }
      return bytes;
    };
    std::uint64_t number = 0;
    walk_.vertex_bytes(size, pack, [&](std::string_view bytes) {
      for (; !bytes.empty(); ++number) see_vertex(number, bytes);
    });
  }
  void see_vertex(std::uint64_t number, std::string_view& bytes) {
    std::int32_t marks = 0;
    take(bytes, marks);
    see(marks, 0, number);
    for (const DataArray& array : rows_->layout(RowKind::point).arrays()) {
      Vector vector{number, {}};
      take(bytes, vector.vector);
      const std::size_t kind = array.name == kMeditVectors[0].vectors ? 0 : 1;
      if ((marks & bit_of_vector(kind)) != 0) vectors_[kind].push_back(vector);
    }
  }
  template <class Element>
  void collect_elements(RowKind kind, int of_dimension, std::vector<Element> Piece::*list) {
    if (!has(kind)) return;
    std::uint64_t number = 0;
    walk_.pieces(
        [&](std::size_t part, std::string& bytes) {
          bytes = rows_->column(kind, part, 0, 0, walk_.count(part, list));
        },
        [&](std::string_view bytes) {
          for (std::int32_t marks = 0; !bytes.empty(); ++number) {
            take(bytes, marks);
            see(marks, of_dimension, number);
          }
        });
  }
  void see(std::int32_t marks, int of_dimension, std::uint64_t number) {
    for (std::size_t i = 0; i < kMeditMarks.size(); ++i) {
      const bool is_marked = (marks & bit_of_mark(i)) != 0;
      if (is_marked && kMeditMarks[i].dimension == of_dimension) marked_[i].push_back(number);
    }
  }
  template <class Integer>
  void write_marks() {
    for (std::size_t i = 0; i < kMeditMarks.size(); ++i) {
      if (marked_[i].empty()) continue;
      begin_rows<Integer>(kMeditMarks[i].keyword, marked_[i].size(), sizeof(Integer));
      for (const std::uint64_t number : marked_[i]) put(static_cast<Integer>(number + 1));
    }
    for (std::size_t i = 0; i < kMeditVectors.size(); ++i) {
      if (vectors_[i].empty()) continue;
      begin_rows<Integer>(kMeditVectors[i].vectors_keyword, vectors_[i].size(), 3 * sizeof(double));
      for (const Vector& vector : vectors_[i]) {
        for (const double x : vector.vector) put(x);
      }
      begin_rows<Integer>(kMeditVectors[i].at_keyword, vectors_[i].size(), 2 * sizeof(Integer));
      for (std::size_t k = 0; k < vectors_[i].size(); ++k) {
        put(static_cast<Integer>(vectors_[i][k].vertex + 1));
        put(static_cast<Integer>(k + 1));
      }
    }
  }

  /// As write_medit_binary() does.
  void choose_version() {
    const FileWalk::Counts& counts = walk_.counts();
    const std::uint64_t required = walk_.required().size();
    const std::uint64_t most =
        std::max({counts.vertices, counts.tets, counts.triangles, counts.edges, required});
    const std::uint64_t size = 256 + 76 * counts.vertices + 12 * counts.edges +
                               16 * counts.triangles + 4 * required + 20 * counts.tets + 4 * marks_;
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
    write_marks<Integer>();
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
  Ranks& ranks_;
  const FileWalk walk_;
  const CarriedRows* rows_;  // null: none
  std::array<std::vector<std::uint64_t>, kMeditMarks.size()> marked_;
  std::array<std::vector<Vector>, kMeditVectors.size()> vectors_;
  std::uint64_t marks_ = 0;  // how many, on all ranks
  std::int32_t version_ = 2;
  std::uint64_t position_ = 0;
};

}  // namespace

void write_medit_slices(const std::filesystem::path& file, const DividedMesh& mesh,
                        const CarriedRows* rows) {
  write_by_first(file, mesh.ranks(), [&](OutputFile* out) { Writer(out, mesh, rows).write(); });
}

}  // namespace tetmend::pieces
