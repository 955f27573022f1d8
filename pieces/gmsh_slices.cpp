// SPDX-License-Identifier: MIT
//   first rank: where things stand | each rank: numbers of some chunks, and are they sound
//   | the order of all numbers | each slice: the chunks that may have some of it
#include "pieces/gmsh_slices.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include <fast_float/fast_float.h>

#include "face/carry.h"
#include "kernel/error.h"
#include "kernel/formats/byte_reader.h"
#include "pieces/bytes.h"

namespace tetmend::pieces {

using formats::GmshChunk;
using formats::GmshLayout;

namespace {

/// Numbers in text, a row on each line. What TextReader reads besides is not understood here.
class TextRows {
 public:
  TextRows(const char* at, std::size_t size) : at_(at), end_(at + size) {}

  bool integer(std::int64_t& value) {
    skip_blanks();
    const auto [stop, error] = std::from_chars(at_, end_, value);
    return error == std::errc() && go_on(stop);
  }
  bool real(double& value) {
    skip_blanks();
    const auto [stop, error] = fast_float::from_chars(at_, end_, value);
    return error == std::errc() && std::isfinite(value) && go_on(stop);
  }
  bool end_of_line() {
    skip_blanks();
    return at_ < end_ && *at_++ == '\n';
  }
  bool is_at_end() const { return at_ == end_; }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
  void skip_blanks() {
    while (at_ < end_ && is_blank(*at_)) ++at_;
  }
  bool go_on(const char* stop) {
    at_ = stop;
    return stop < end_ && (is_blank(*stop) || *stop == '\n');
  }

  const char* at_;
  const char* end_;
};

/// Reads chunks. Functions give false where a row is none.
class ChunkReader {
 public:
  ChunkReader(const std::filesystem::path& file, const GmshLayout& layout)
      : bytes_(file), layout_(layout) {}

  /// `width` numbers of each row.
  bool integers(const GmshChunk& chunk, std::size_t width, std::vector<std::int64_t>& numbers) {
    numbers.resize(chunk.rows * width);
    const char* at = bytes_.read(chunk.at, chunk.size);
    if (layout_.binary) {
      for (std::int64_t& number : numbers) {
        number = formats::load<std::int64_t>(at, layout_.swap);
        at += sizeof(std::int64_t);
      }
      return true;
    }
    TextRows text(at, chunk.size);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (!text.integer(numbers[i])) return false;
      if (i % width == width - 1 && !text.end_of_line()) return false;
    }
    return text.is_at_end();
  }

  bool places(const GmshChunk& chunk, std::vector<Point>& points) {
    points.resize(chunk.rows);
    const std::uint32_t parameters = layout_.blocks[chunk.block].parameters;
    const char* at = bytes_.read(chunk.places_at, chunk.places_size);
    TextRows text(at, chunk.places_size);
    for (Point& point : points) {
      for (std::uint32_t k = 0; k < 3 + parameters; ++k) {
        double value = 0;
        if (layout_.binary) {
          value = formats::load<double>(at, layout_.swap);
          at += sizeof(double);
        } else if (!text.real(value)) {
          return false;
        }
        if (k < 3) point[k] = value;
      }
      if (!point.allFinite() || (!layout_.binary && !text.end_of_line())) return false;
    }
    return layout_.binary || text.is_at_end();
  }

 private:
  FileBytes bytes_;
  const GmshLayout& layout_;
};

/// Numbers of each row: that of the element, then those of its vertices.
std::size_t width_of(GmshLayout::Kind kind) {
  return kind == GmshLayout::nodes ? 1 : static_cast<std::size_t>(kind) + 2;
}

NumberFacts facts_of(const std::vector<std::int64_t>& numbers, std::size_t width) {
  NumberFacts facts{numbers.front(), numbers.front(), numbers.size() / width, 1};
  for (std::size_t i = width; i < numbers.size(); i += width) {
    if (numbers[i] <= numbers[i - width]) facts.ascend = 0;
    facts.least = std::min(facts.least, numbers[i]);
    facts.most = std::max(facts.most, numbers[i]);
  }
  return facts;
}

/// The vertices are nodes, and no two the same.
bool is_sound(const std::int64_t* vertices, std::size_t count, const NumberOrder& nodes) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!nodes.has(vertices[i])) return false;
    if (std::find(vertices, vertices + i, vertices[i]) != vertices + i) return false;
  }
  return true;
}

}  // namespace

std::unique_ptr<FileSlices> GmshSlices::open(const std::filesystem::path& file, Ranks& ranks) {
  auto slices = std::make_unique<GmshSlices>();
  slices->file_ = file;
  if (!slices->share_layout(ranks)) return nullptr;
  using Kind = GmshLayout::Kind;
  for (const Kind kind :
       {GmshLayout::nodes, GmshLayout::edges, GmshLayout::triangles, GmshLayout::tets}) {
    if (!slices->look_at(kind, ranks)) return nullptr;
  }
  slices->share_walls(ranks);
  slices->head_ = formats::read_gmsh_head(slices->layout_.head);
  slices->is_listed_ = slices->look_at_entities();
  const auto& counts = slices->layout_.counts;
  slices->counts_ = {counts[GmshLayout::nodes], counts[GmshLayout::tets],
                     counts[GmshLayout::triangles] + slices->walls_.size(),
                     counts[GmshLayout::edges], 0};
  return slices;
}

/// The first rank looks for it.
bool GmshSlices::share_layout(Ranks& ranks) {
  std::string bytes;
  if (ranks.is_first()) {
    std::optional<GmshLayout> found = formats::scan_gmsh(file_);
    if (found && found->counts[GmshLayout::tets] > 0) {
      put(found->binary, bytes);
      put(found->swap, bytes);
      put(found->head, bytes);
      put(found->blocks, bytes);
      for (const auto& chunks : found->chunks) put(chunks, bytes);
      put(found->counts, bytes);
      put(found->point_elements, bytes);
      put(found->loose_points, bytes);
      put(found->parametric, bytes);
    }
  }
  const std::vector<std::string> all = ranks.gather(bytes);
  if (all.front().empty()) return false;
  std::string_view rest = all.front();
  take(rest, layout_.binary);
  take(rest, layout_.swap);
  take(rest, layout_.head);
  take(rest, layout_.blocks);
  for (auto& chunks : layout_.chunks) take(rest, chunks);
  take(rest, layout_.counts);
  take(rest, layout_.point_elements);
  take(rest, layout_.loose_points);
  take(rest, layout_.parametric);
  return true;
}

/// False where one of the ranks has found what read_gmsh() would read in another way, or complain of.
bool GmshSlices::look_at(GmshLayout::Kind kind, Ranks& ranks) {
  const std::vector<GmshChunk>& chunks = layout_.chunks[kind];
  const std::size_t width = width_of(kind);
  const ChunkShare share(chunks.size(), ranks);
  ChunkReader reader(file_, layout_);
  std::vector<std::int64_t> numbers;
  std::vector<Point> points;
  std::vector<NumberFacts> mine;
  bool is_good = true;
  for (std::size_t i = share.begin; i < share.end && is_good; ++i) {
    is_good = reader.integers(chunks[i], width, numbers);
    if (is_good && kind == GmshLayout::nodes) is_good = reader.places(chunks[i], points);
    for (std::size_t at = 0; kind != GmshLayout::nodes && is_good && at < numbers.size();
         at += width) {
      is_good = is_sound(numbers.data() + at + 1, width - 1, orders_[GmshLayout::nodes]);
    }
    mine.push_back(facts_of(numbers, width));
    is_good = is_good && mine.back().least >= 0;
  }
  if (ranks.any(!is_good)) return false;
  std::string bytes;
  put(mine, bytes);
  for (const std::string& from : ranks.gather(bytes)) {
    std::string_view rest = from;
    std::vector<NumberFacts> others;
    take(rest, others);
    facts_[kind].insert(facts_[kind].end(), others.begin(), others.end());
  }
  const auto list = [&](std::size_t chunk, const std::function<void(std::int64_t)>& add) {
    if (!reader.integers(chunks[chunk], width, numbers)) fail_changed(file_);
    for (std::size_t at = 0; at < numbers.size(); at += width) add(numbers[at]);
  };
  std::optional<NumberOrder> order =
      NumberOrder::make(facts_[kind], list, kind == GmshLayout::nodes, ranks);
  if (!order) return false;
  orders_[kind] = std::move(*order);
  return true;
}

bool GmshSlices::is_finer_than_labels(GmshLayout::Kind kind) const {
  std::map<Label, Label> part_of;
  for (const GmshChunk& chunk : layout_.chunks[kind]) {
    const formats::GmshBlock& block = layout_.blocks[chunk.block];
    if (part_of.emplace(block.label, block.part).first->second != block.part) return true;
  }
  return false;
}

/// The first rank looks for them.
void GmshSlices::share_walls(Ranks& ranks) {
  if (!is_finer_than_labels(GmshLayout::tets)) return;
  std::string bytes;
  if (ranks.is_first()) put(find_walls(), bytes);
  const std::vector<std::string> all = ranks.gather(bytes);
  std::string_view rest = all.front();
  take(rest, walls_);
}

template <class Act>
void GmshSlices::for_rows(GmshLayout::Kind kind, const std::vector<std::size_t>& chunks,
                          const Act& act) const {
  const std::size_t width = width_of(kind);
  const NumberOrder& nodes = orders_[GmshLayout::nodes];
  ChunkReader reader(file_, layout_);
  std::vector<std::int64_t> numbers;
  for (const std::size_t i : chunks) {
    const GmshChunk& chunk = layout_.chunks[kind][i];
    if (!reader.integers(chunk, width, numbers)) fail_changed(file_);
    for (std::size_t at = 0; at < numbers.size(); at += width) {
      if (!is_sound(numbers.data() + at + 1, width - 1, nodes)) fail_changed(file_);
      for (std::size_t k = 1; k < width; ++k) {
        numbers[at + k] = static_cast<std::int64_t>(nodes.place(numbers[at + k]));
      }
      act(numbers.data() + at, layout_.blocks[chunk.block]);
    }
  }
}

/// Those of tets of more than one entity. Takes three bits for each vertex.
std::vector<bool> GmshSlices::vertices_of_several_parts() const {
  std::map<Label, std::vector<std::size_t>> chunks_of_part;
  const std::vector<GmshChunk>& chunks = layout_.chunks[GmshLayout::tets];
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    chunks_of_part[layout_.blocks[chunks[i].block].part].push_back(i);
  }
  std::vector<bool> several(layout_.counts[GmshLayout::nodes]);
  std::vector<bool> before(several.size());  // of parts that are done
  for (const auto& [part, of_part] : chunks_of_part) {
    std::vector<bool> now(several.size());
    for_rows(GmshLayout::tets, of_part, [&](const std::int64_t* row, const auto&) {
      for (int k = 1; k <= 4; ++k) {
        const auto v = static_cast<std::size_t>(row[k]);
        now[v] = true;
        if (before[v]) several[v] = true;
      }
    });
    for (std::size_t v = 0; v < now.size(); ++v) before[v] = before[v] || now[v];
  }
  return several;
}

/// Faces between tets of one label and two entities that no triangle names, as
/// face::walls_between_parts() finds them: among the tets with three vertices of several entities.
std::vector<std::array<VertexId, 3>> GmshSlices::find_walls() const {
  const std::vector<bool> several = vertices_of_several_parts();
  std::vector<FileElement<MeshData::Tet>> tets;
  std::vector<FileElement<MeshData::Triangle>> triangles;
  MeshData near;
  const auto collect = [&](GmshLayout::Kind kind, auto& to, std::vector<Label>& parts) {
    std::vector<std::size_t> chunks(layout_.chunks[kind].size());
    std::iota(chunks.begin(), chunks.end(), std::size_t{0});
    for_rows(kind, chunks, [&](const std::int64_t* row, const formats::GmshBlock& block) {
      const std::int64_t* const end = row + width_of(kind);
      if (std::count_if(row + 1, end,
                        [&](std::int64_t v) { return several[static_cast<std::size_t>(v)]; }) < 3) {
        return;
      }
      auto& made = to.emplace_back();
      std::copy(row + 1, end, made.vertices.begin());
      made.element.label = block.label;
      parts.push_back(block.part);
    });
  };
  collect(GmshLayout::tets, tets, near.tet_parts);
  collect(GmshLayout::triangles, triangles, near.triangle_parts);
  std::vector<VertexId> ids;
  note_ids(tets, ids);
  note_ids(triangles, ids);
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  take_elements(tets, ids, near.tets);
  take_elements(triangles, ids, near.triangles);
  std::vector<std::array<VertexId, 3>> walls;
  for (const MeshData::Triangle& wall : face::walls_between_parts(near)) {
    auto& made = walls.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) made[k] = ids[wall.vertices[k]];
  }
  return walls;
}

template <class Act>
void GmshSlices::for_range(GmshLayout::Kind kind, const FileRange& range, const Act& act) const {
  const NumberOrder& order = orders_[kind];
  const NumberOrder& nodes = orders_[GmshLayout::nodes];
  const std::size_t width = width_of(kind);
  ChunkReader reader(file_, layout_);
  std::vector<std::int64_t> numbers;
  std::uint64_t found = 0;
  for (std::size_t i = 0; i < layout_.chunks[kind].size(); ++i) {
    const GmshChunk& chunk = layout_.chunks[kind][i];
    const bool by_row = order.is_that_of_rows();
    const NumberFacts& facts = facts_[kind][i];
    const std::uint64_t first = by_row ? chunk.first : order.place(facts.least);
    const std::uint64_t last = by_row ? chunk.first + chunk.rows - 1 : order.place(facts.most);
    if (range.size() == 0 || last < range.begin || first >= range.end) continue;
    if (!reader.integers(chunk, width, numbers)) fail_changed(file_);
    for (std::size_t row = 0; row < chunk.rows; ++row) {
      const std::int64_t* const at = numbers.data() + row * width;
      if (!by_row && !order.has(*at)) fail_changed(file_);
      const std::uint64_t place = by_row ? chunk.first + row : order.place(*at);
      if (!range.has(place)) continue;
      if (!is_sound(at + 1, width - 1, nodes)) fail_changed(file_);
      act(place - range.begin, at, layout_.blocks[chunk.block]);
      ++found;
    }
  }
  if (found != range.size()) fail_changed(file_);
}

template <class Element>
void GmshSlices::read_kind(GmshLayout::Kind kind, const FileRange& range,
                           std::vector<FileElement<Element>>& elements) const {
  elements.resize(range.size());
  const NumberOrder& nodes = orders_[GmshLayout::nodes];
  for_range(kind, range,
            [&](std::uint64_t place, const std::int64_t* row, const formats::GmshBlock& block) {
              auto& element = elements[place];
              for (std::size_t k = 0; k < element.vertices.size(); ++k) {
                element.vertices[k] = nodes.place(row[k + 1]);
              }
              element.element.label = block.label;
            });
}

void GmshSlices::read_elements(const Share& of, FileElements& elements) const {
  read_kind(GmshLayout::tets, of.tets, elements.tets);
  const std::uint64_t named = layout_.counts[GmshLayout::triangles];
  read_kind(GmshLayout::triangles,
            {std::min(of.triangles.begin, named), std::min(of.triangles.end, named)},
            elements.triangles);
  for (std::uint64_t i = std::max(of.triangles.begin, named); i < of.triangles.end; ++i) {
    elements.triangles.push_back({{}, walls_[i - named]});
  }
  read_kind(GmshLayout::edges, of.edges, elements.edges);
}

/// read(chunk) comes before its rows, and is false where the chunk cannot be read.
template <class Read, class Act>
void GmshSlices::for_nodes(const std::vector<VertexId>& ids, const Read& read,
                           const Act& act) const {
  const NumberOrder& order = orders_[GmshLayout::nodes];
  ChunkReader reader(file_, layout_);
  std::vector<std::int64_t> numbers;
  std::size_t found = 0;
  for (std::size_t i = 0; i < layout_.chunks[GmshLayout::nodes].size(); ++i) {
    const GmshChunk& chunk = layout_.chunks[GmshLayout::nodes][i];
    const NumberFacts& facts = facts_[GmshLayout::nodes][i];
    auto id = std::lower_bound(ids.begin(), ids.end(), order.place(facts.least));
    if (id == ids.end() || *id > order.place(facts.most)) continue;
    if (!reader.integers(chunk, 1, numbers) || !read(reader, chunk)) fail_changed(file_);
    for (std::size_t row = 0; row < chunk.rows; ++row) {
      if (!order.has(numbers[row])) fail_changed(file_);
      const std::uint64_t place = order.place(numbers[row]);
      if (id == ids.end() || *id != place) id = std::lower_bound(ids.begin(), ids.end(), place);
      if (id == ids.end() || *id != place) continue;
      act(static_cast<std::size_t>(id - ids.begin()), row, chunk);
      ++found;
      ++id;
    }
  }
  if (found != ids.size()) fail_changed(file_);
}

void GmshSlices::read_vertices(Piece& slice) const {
  slice.points.resize(slice.ids.size());
  slice.marks.assign(slice.ids.size(), 0);
  std::vector<Point> points;
  for_nodes(
      slice.ids,
      [&](ChunkReader& reader, const GmshChunk& chunk) { return reader.places(chunk, points); },
      [&](std::size_t i, std::size_t row, const GmshChunk&) { slice.points[i] = points[row]; });
}

namespace {

using Entity = std::array<std::int32_t, 2>;  // dimension and number

template <class Value>
void set_row(const Value& value, std::size_t i, std::string& rows) {
  std::memcpy(rows.data() + i * sizeof(value), &value, sizeof(value));
}

}  // namespace

ByKind<RowLayout> GmshSlices::row_layouts() const {
  const auto integers = [](std::size_t components) {
    return RowLayout({{"entity", components, std::vector<std::int32_t>()}});
  };
  ByKind<RowLayout> layouts;
  layouts[RowKind::vertex] = integers(2);
  const bool has_walls = !walls_.empty();
  if (is_finer_than_labels(GmshLayout::tets)) layouts[RowKind::tet] = integers(1);
  if (has_walls || is_finer_than_labels(GmshLayout::triangles)) {
    layouts[RowKind::triangle] = integers(1);
  }
  if (is_finer_than_labels(GmshLayout::edges)) layouts[RowKind::edge] = integers(1);
  return layouts;
}

std::string GmshSlices::row_of_new_vertex() const {
  std::string row;
  put(Entity{-1, 0}, row);
  return row;
}

void GmshSlices::read_rows(const Share& of, const std::vector<VertexId>& ids,
                           ByKind<std::string>& rows) const {
  rows[RowKind::vertex].resize(ids.size() * sizeof(Entity));
  for_nodes(
      ids, [](ChunkReader&, const GmshChunk&) { return true; },
      [&](std::size_t i, std::size_t, const GmshChunk& chunk) {
        const formats::GmshBlock& block = layout_.blocks[chunk.block];
        set_row(Entity{block.dimension, block.part}, i, rows[RowKind::vertex]);
      });
  const ByKind<RowLayout> layouts = row_layouts();
  const auto read = [&](RowKind to, GmshLayout::Kind kind, FileRange range) {
    if (layouts[to].size() == 0) return;
    const std::uint64_t named = layout_.counts[kind];
    const std::uint64_t all = range.size();
    range = {std::min(range.begin, named), std::min(range.end, named)};
    for (std::uint64_t i = 0; i < all; ++i) put(kWall, rows[to]);
    for_range(kind, range,
              [&](std::uint64_t place, const std::int64_t*, const formats::GmshBlock& block) {
                set_row(block.part, place, rows[to]);
              });
  };
  read(RowKind::tet, GmshLayout::tets, of.tets);
  read(RowKind::triangle, GmshLayout::triangles, of.triangles);
  read(RowKind::edge, GmshLayout::edges, of.edges);
}

bool GmshSlices::is_listed(int dimension, Label entity) const {
  return std::any_of(head_.entities.begin(), head_.entities.end(), [&](const auto& each) {
    return each.dimension == dimension && each.tag == entity && entity != kWall;
  });
}

/// False where one is no vertex of the geometry, or is there twice.
bool GmshSlices::read_point_elements() {
  std::map<std::int64_t, Label> vertices;  // nodes on vertices of the geometry
  ChunkReader reader(file_, layout_);
  std::vector<std::int64_t> numbers;
  for (const GmshChunk& chunk : layout_.chunks[GmshLayout::nodes]) {
    const formats::GmshBlock& block = layout_.blocks[chunk.block];
    if (block.dimension != 0) continue;
    if (!reader.integers(chunk, 1, numbers)) fail_changed(file_);
    for (const std::int64_t number : numbers) vertices[number] = block.part;
  }
  std::map<std::int64_t, GmshPointElement> by_number;
  std::set<VertexId> seen;
  for (const GmshChunk& chunk : layout_.point_elements) {
    const formats::GmshBlock& block = layout_.blocks[chunk.block];
    if (!reader.integers(chunk, 2, numbers)) return false;
    for (std::size_t i = 0; i < numbers.size(); i += 2) {
      const auto vertex = vertices.find(numbers[i + 1]);
      if (vertex == vertices.end() || vertex->second != block.part) return false;
      const VertexId id = orders_[GmshLayout::nodes].place(numbers[i + 1]);
      const bool is_in_group = block.label != 0;
      const bool is_new =
          by_number.emplace(numbers[i], GmshPointElement{id, block.part, is_in_group}).second;
      if (!is_new || !seen.insert(id).second) return false;
    }
  }
  for (const auto& [number, element] : by_number) point_elements_.push_back(element);
  return true;
}

/// Whether all that is not in rows is in the head of the file.
bool GmshSlices::look_at_entities() {
  const bool are_listed =
      std::all_of(layout_.blocks.begin(), layout_.blocks.end(),
                  [&](const auto& block) { return is_listed(block.dimension, block.part); });
  return are_listed && read_point_elements();
}

GmshExtras GmshSlices::extras() const {
  GmshExtras extras{head_, {}, point_elements_};
  for (const auto kind : {GmshLayout::edges, GmshLayout::triangles, GmshLayout::tets}) {
    for (const GmshChunk& chunk : layout_.chunks[kind]) {
      const formats::GmshBlock& block = layout_.blocks[chunk.block];
      extras.entity_of[kind].emplace(block.label, block.part);
    }
  }
  return extras;
}

MeshData GmshSlices::digest() const {
  MeshData data = head_;
  const auto add = [&](GmshLayout::Kind kind, auto& elements, std::vector<Label>& parts,
                       bool has_all) {
    for (const GmshChunk& chunk : layout_.chunks[kind]) {
      const formats::GmshBlock& block = layout_.blocks[chunk.block];
      for (std::uint64_t i = 0; i < (has_all ? chunk.rows : 1); ++i) {
        elements.emplace_back().label = block.label;
        parts.push_back(block.part);
      }
    }
  };
  add(GmshLayout::tets, data.tets, data.tet_parts, false);
  add(GmshLayout::triangles, data.triangles, data.triangle_parts, false);
  add(GmshLayout::edges, data.edges, data.edge_parts, true);  // messages have their number
  if (layout_.loose_points > 0) {
    data.other_elements.push_back(
        {1, 1, {}, std::vector<Label>(layout_.loose_points, 0), {}, {}, {}});
  }
  if (layout_.parametric) data.notes.emplace_back("the parameters of nodes are not kept");
  return data;
}

}  // namespace tetmend::pieces
