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
#include "pieces/numbering.h"

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

/// What a vertex of the new file is, in the order of ids. Vertices come from all pieces: ranges of
/// ids at a time, so that memory holds only some.
struct FileVertex {
  VertexId id;
  std::array<double, 3> point;
  Label label;
};

/// Ranges of ids, of which the vertices are written at once: short enough for the memory of the first
/// rank. Each vertex is read once.
class VertexRanges {
 public:
  explicit VertexRanges(const DividedMesh& mesh) {
    constexpr VertexId kLeast = 50'000;
    constexpr VertexId kMost = 500'000;
    const VertexId first = mesh.state().first_id;
    const VertexId all = mesh.state().next_id - first;
    const VertexId at_once = std::clamp<VertexId>(all / (4 * mesh.ranks().count()), kLeast, kMost);
    count_ = static_cast<std::size_t>((all + at_once - 1) / at_once);
    for (const std::size_t part : mesh.own()) {
      const std::vector<VertexId> ids = mesh.stored_ids(part);
      for (std::size_t i = 0; i <= count_; ++i) {
        const auto place = std::lower_bound(ids.begin(), ids.end(), first + i * at_once);
        begins_.push_back(static_cast<std::size_t>(place - ids.begin()));
      }
    }
  }
  std::size_t count() const { return count_; }
  /// Of the vertices of own piece i those of a range: from where to where they are.
  std::pair<std::size_t, std::size_t> of_piece(std::size_t i, std::size_t range) const {
    const std::size_t at = i * (count_ + 1) + range;
    return {begins_[at], begins_[at + 1]};
  }

 private:
  std::size_t count_ = 0;
  std::vector<std::size_t> begins_;  // by own piece and range, and the end of the last one
};

/// The first rank writes what all send it: a piece, or a range of vertices, at a time.
class Writer {
 public:
  /// @param out null on all ranks but the first
  Writer(OutputFile* out, const DividedMesh& mesh)
      : out_(out), mesh_(mesh), ranks_(mesh.ranks()), numbering_(mesh) {}

  void write() {
    count();
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
  void count() {
    std::vector<VertexId> required;
    std::array<std::int64_t, 3> counts{};
    for (const std::size_t i : mesh_.own()) {
      const Piece piece = mesh_.stored(i);
      for (std::size_t v = 0; v < piece.ids.size(); ++v) {
        const bool is_listed = (piece.marks[v] & kOwn) != 0 && (piece.marks[v] & kRequired) != 0;
        if (is_listed) required.push_back(piece.ids[v]);
      }
      counts[0] += static_cast<std::int64_t>(piece.tets.size());
      counts[1] += static_cast<std::int64_t>(piece.triangles.size());
      counts[2] += static_cast<std::int64_t>(piece.edges.size());
    }
    ranks_.add(counts);
    counts_.vertices = numbering_.size();
    counts_.tets = static_cast<std::uint64_t>(counts[0]);
    counts_.triangles = static_cast<std::uint64_t>(counts[1]);
    counts_.edges = static_cast<std::uint64_t>(counts[2]);
    std::string bytes;
    pieces::put(required, bytes);
    for (const std::string& from : ranks_.gather(bytes)) {
      std::string_view rest = from;
      pieces::take(rest, required);
      required_.insert(required_.end(), required.begin(), required.end());
    }
    std::sort(required_.begin(), required_.end());
  }
  /// As write_medit_binary() does.
  void choose_version() {
    const std::uint64_t most = std::max({counts_.vertices, counts_.tets, counts_.triangles,
                                         counts_.edges, std::uint64_t{required_.size()}});
    const std::uint64_t size = 256 + 76 * counts_.vertices + 12 * counts_.edges +
                               16 * counts_.triangles + 4 * required_.size() + 20 * counts_.tets;
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
    begin_rows<Integer>(vertices, counts_.vertices, 24 + sizeof(Integer));
    write_vertices<Integer>();
    write_elements<Integer>(edges, counts_.edges, &Piece::edges);
    write_elements<Integer>(triangles, counts_.triangles, &Piece::triangles);
    if (!required_.empty()) {
      begin_rows<Integer>(required_vertices, required_.size(), sizeof(Integer));
      for (const VertexId id : required_) put(number<Integer>(id));
    }
    write_elements<Integer>(tetrahedra, counts_.tets, &Piece::tets);
  }
  template <class Integer>
  Integer number(VertexId id) const {
    return static_cast<Integer>(numbering_.number(id) + 1);
  }
  /// What the ranks have for the file now, in their order.
  std::vector<std::string> send_to_first(std::string bytes) const {
    std::vector<std::string> to(ranks_.count());
    to[0] = std::move(bytes);
    return ranks_.exchange(std::move(to));
  }

  /// A range of ids at a time, from all pieces.
  template <class Integer>
  void write_vertices() {
    const VertexRanges ranges(mesh_);
    for (std::size_t i = 0; i < ranges.count(); ++i) {
      std::vector<FileVertex> range;
      {
        const std::vector<std::string> came = send_to_first(collect(ranges, i));
        std::size_t bytes = 0;
        for (const std::string& from : came) bytes += from.size();
        range.reserve(bytes / sizeof(FileVertex));
        for (const std::string& from : came) {
          for (std::string_view rest = from; !rest.empty();) {
            pieces::take(rest, range.emplace_back());
          }
        }
      }
      std::sort(range.begin(), range.end(),
                [](const FileVertex& a, const FileVertex& b) { return a.id < b.id; });
      for (const FileVertex& vertex : range) {
        for (const double x : vertex.point) put(x);
        put(static_cast<Integer>(vertex.label));
      }
    }
  }
  std::string collect(const VertexRanges& ranges, std::size_t number) const {
    std::string bytes;
    for (std::size_t i = 0; i < mesh_.own().size(); ++i) {
      const auto [begin, end] = ranges.of_piece(i, number);
      const Piece piece = mesh_.stored_vertices(mesh_.own()[i], begin, end);
      for (std::size_t v = 0; v < piece.ids.size(); ++v) {
        if ((piece.marks[v] & kOwn) == 0) continue;
        const Point& p = piece.points[v];
        pieces::put(FileVertex{piece.ids[v], {p.x(), p.y(), p.z()}, piece.label(v)}, bytes);
      }
    }
    return bytes;
  }
  template <class Integer, class Element>
  void write_elements(std::int32_t keyword, std::uint64_t rows,
                      std::vector<Element> Piece::*elements) {
    if (rows == 0) return;
    constexpr std::size_t kNumbers = std::tuple_size_v<decltype(Element::vertices)> + 1;
    begin_rows<Integer>(keyword, rows, kNumbers * sizeof(Integer));
    for (std::size_t i = 0; i < mesh_.state().stored; ++i) {
      std::string bytes;
      if (std::binary_search(mesh_.own().begin(), mesh_.own().end(), i)) {
        const Piece piece = mesh_.stored(i);
        for (const Element& element : piece.*elements) {
          for (const std::uint32_t v : element.vertices) {
            pieces::put(number<Integer>(piece.ids[v]), bytes);
          }
          pieces::put(static_cast<Integer>(element.label), bytes);
        }
      }
      for (const std::string& from : send_to_first(std::move(bytes))) {
        if (out_ != nullptr) out_->put(from);
      }
    }
  }

  OutputFile* out_;
  const DividedMesh& mesh_;
  Ranks& ranks_;
  Numbering numbering_;
  FileCounts counts_;
  std::vector<VertexId> required_;
  std::int32_t version_ = 2;
  std::uint64_t position_ = 0;
};

}  // namespace

void write_medit_slices(const std::filesystem::path& file, const DividedMesh& mesh) {
  std::optional<OutputFile> out;
  if (mesh.ranks().is_first()) out.emplace(file);
  Writer(out ? &*out : nullptr, mesh).write();
  if (out) out->commit();
  mesh.ranks().meet();
}

}  // namespace tetmend::pieces
