// SPDX-License-Identifier: MIT
//   first rank: where things stand | each rank: some points, cells and values, and are they sound
//   | which array has labels | each slice: the cells and points that it has some of
#include "pieces/vtu_slices.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/cell_arrays.h"
#include "kernel/printable.h"
#include "pieces/bytes.h"
#include "pieces/number_order.h"

namespace tetmend::pieces {

using formats::VtuColumn;
using formats::VtuRows;

namespace {

constexpr std::uint64_t kRowsOfChunk = std::uint64_t{1} << 15;

std::size_t chunks_of(std::uint64_t rows) {
  return static_cast<std::size_t>((rows + kRowsOfChunk - 1) / kRowsOfChunk);
}

std::size_t rows_of_chunk(std::uint64_t rows, std::size_t chunk) {
  return static_cast<std::size_t>(std::min(kRowsOfChunk, rows - chunk * kRowsOfChunk));
}

/// Three coordinates of each.
std::vector<Point> as_points(const DataArray::Values& values) {
  std::vector<Point> points;
  std::visit(
      [&](const auto& numbers) {
        for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
          points.emplace_back(static_cast<double>(numbers[i]), static_cast<double>(numbers[i + 1]),
                              static_cast<double>(numbers[i + 2]));
        }
      },
      values);
  return points;
}

/// Precondition: all are labels.
std::vector<Label> as_labels(const DataArray::Values& values) {
  return std::visit(
      [](const auto& numbers) {
        std::vector<Label> labels;
        labels.reserve(numbers.size());
        for (const auto number : numbers) labels.push_back(static_cast<Label>(number));
        return labels;
      },
      values);
}

}  // namespace

/// Reads cells, some at a time.
class VtuSlices::Cells {
 public:
  explicit Cells(const VtuSlices& file)
      : file_(file),
        offsets_(file.rows_of(file.layout_.offsets, file.layout_.cells)),
        types_(file.rows_of(file.layout_.types, file.layout_.cells)),
        connectivity_(file.rows_of(file.layout_.connectivity, file.corners_)) {}

  /// False where one of them is none that is known. The vertices of a cell are sound.
  bool read(std::uint64_t first, std::size_t count) {
    offsets = first > 0 ? offsets_.integers(first - 1, count + 1) : offsets_.integers(0, count);
    if (first == 0) offsets.insert(offsets.begin(), 0);
    const std::vector<std::int64_t> types = types_.integers(first, count);
    kinds.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t size = offsets[i + 1] - offsets[i];
      if (offsets[i] < 0 || offsets[i + 1] > static_cast<std::int64_t>(file_.corners_))
        return false;
      if (types[i] == 10 && size == 4) {
        kinds[i] = VtuSlices::tets;
      } else if (types[i] == 5 && size == 3) {
        kinds[i] = VtuSlices::triangles;
      } else if (types[i] == 3 && size == 2) {
        kinds[i] = VtuSlices::edges;
      } else if (types[i] == 1 && size == 1) {
        kinds[i] = VtuSlices::points;
      } else {
        return false;
      }
    }
    corners = connectivity_.integers(static_cast<std::uint64_t>(offsets[0]),
                                     static_cast<std::size_t>(offsets[count] - offsets[0]));
    return are_vertices_sound();
  }
  /// Those of one that was read.
  const std::int64_t* corners_of(std::size_t i) const {
    return corners.data() + (offsets[i] - offsets[0]);
  }

  std::vector<Kind> kinds;
  std::vector<std::int64_t> offsets, corners;

 private:
  bool are_vertices_sound() const {
    const auto vertices = static_cast<std::int64_t>(file_.layout_.points);
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      const std::int64_t* const v = corners_of(i);
      const std::int64_t size = offsets[i + 1] - offsets[i];
      for (std::int64_t k = 0; k < size; ++k) {
        if (v[k] < 0 || v[k] >= vertices || std::find(v, v + k, v[k]) != v + k) return false;
      }
    }
    return true;
  }

  const VtuSlices& file_;
  VtuRows offsets_, types_, connectivity_;
};

std::unique_ptr<FileSlices> VtuSlices::open(const std::filesystem::path& file,
                                            const std::string& label_array, Ranks& ranks) {
  auto slices = std::make_unique<VtuSlices>();
  slices->file_ = file;
  if (!slices->share_outline(ranks)) return nullptr;
  std::optional<formats::VtuLayout> layout = formats::lay_out_vtu(slices->outline_);
  if (!layout) return nullptr;  // on all ranks: they have the same outline
  slices->layout_ = std::move(*layout);
  slices->notes_ = slices->layout_.notes;
  if (!slices->look_at_cells(ranks)) return nullptr;
  if (ranks.any(!slices->look_at_points(ranks))) return nullptr;
  if (!slices->choose_labels(label_array, ranks)) return nullptr;
  if (!slices->collect_labels(ranks)) return nullptr;
  return slices;
}

/// The first rank looks for it.
bool VtuSlices::share_outline(Ranks& ranks) {
  std::string bytes;
  if (ranks.is_first()) {
    if (const std::optional<formats::VtuOutline> found = formats::outline_vtu(file_)) {
      put(found->xml, bytes);
      put(std::uint64_t{found->contents.size()}, bytes);
      for (const auto& content : found->contents) {
        put(content.begin, bytes);
        put(content.end, bytes);
        put(content.words, bytes);
        put(content.steps, bytes);
      }
      put(found->appended, bytes);
      put(found->size, bytes);
    }
  }
  const std::vector<std::string> all = ranks.gather(bytes);
  if (all.front().empty()) return false;
  std::string_view rest = all.front();
  std::uint64_t contents = 0;
  take(rest, outline_.xml);
  take(rest, contents);
  outline_.contents.resize(contents);
  for (auto& content : outline_.contents) {
    take(rest, content.begin);
    take(rest, content.end);
    take(rest, content.words);
    take(rest, content.steps);
  }
  take(rest, outline_.appended);
  take(rest, outline_.size);
  return true;
}

bool VtuSlices::look_at_points(const Ranks& ranks) const {
  try {
    VtuRows places = rows_of(layout_.places, layout_.points);
    const ChunkShare share(chunks_of(layout_.points), ranks);
    for (std::size_t i = share.begin; i < share.end; ++i) {
      const auto values = places.read(i * kRowsOfChunk, rows_of_chunk(layout_.points, i));
      for (const Point& point : as_points(values)) {
        if (!point.allFinite()) return false;
      }
    }
    return true;
  } catch (const Error&) {
    return false;
  }
}

bool VtuSlices::look_at_cells(Ranks& ranks) {
  std::vector<CellChunk> mine;
  const auto look = [&] {
    const std::int64_t last =
        rows_of(layout_.offsets, layout_.cells).integers(layout_.cells - 1, 1).front();
    if (last < 0) return false;
    corners_ = static_cast<std::uint64_t>(last);
    Cells cells(*this);
    const ChunkShare share(chunks_of(layout_.cells), ranks);
    for (std::size_t i = share.begin; i < share.end; ++i) {
      CellChunk& chunk = mine.emplace_back();
      chunk.first = i * kRowsOfChunk;
      chunk.count = rows_of_chunk(layout_.cells, i);
      if (!cells.read(chunk.first, chunk.count)) return false;
      for (const Kind kind : cells.kinds) ++chunk.of_kind[kind];
    }
    return true;
  };
  bool is_good = false;
  try {
    is_good = look();
  } catch (const Error&) {
    is_good = false;
  }
  if (ranks.any(!is_good)) return false;
  std::string bytes;
  put(mine, bytes);
  std::array<std::uint64_t, 4> all{};
  for (const std::string& from : ranks.gather(bytes)) {
    std::string_view rest = from;
    std::vector<CellChunk> others;
    take(rest, others);
    for (const CellChunk& chunk : others) {
      for (std::size_t k = 0; k < all.size(); ++k) all[k] += chunk.of_kind[k];
    }
    chunks_.insert(chunks_.end(), others.begin(), others.end());
  }
  counts_ = {layout_.points, all[tets], all[triangles], all[edges], 0};
  loose_points_ = all[points];
  return all[tets] > 0;
}

void VtuSlices::ArrayKnowledge::join(const ArrayKnowledge& other) {
  has_fractions |= other.has_fractions;
  is_no_label |= other.is_no_label;
  is_beyond |= other.is_beyond;
  others_than_0 += other.others_than_0;
  range = {std::min(range[0], other.range[0]), std::max(range[1], other.range[1])};
}

/// Of each array, by all ranks.
std::vector<VtuSlices::ArrayKnowledge> VtuSlices::look_at_arrays(
    const std::vector<VtuColumn>& columns, std::uint64_t rows, Ranks& ranks, bool& is_good) const {
  std::string bytes;
  for (const VtuColumn& column : columns) {
    ArrayKnowledge known;
    std::set<double> values;
    const auto see = [&](const auto number) {
      using Number = std::decay_t<decltype(number)>;
      const auto real = static_cast<double>(number);
      const bool is_whole = std::is_integral_v<Number> || real == std::floor(real);
      if (!is_whole) known.has_fractions = 1;
      if (!is_whole || !(real >= INT32_MIN && real <= INT32_MAX)) known.is_no_label = 1;
      if (number < 0 && column.type->name == "UInt64") known.is_beyond = 1;
      known.others_than_0 += real != 0 ? 1 : 0;
      known.range = {std::min(known.range[0], real), std::max(known.range[1], real)};
      if (column.components == 1 && is_whole && values.size() <= formats::kMostLabels) {
        values.insert(real);
      }
    };
    try {
      VtuRows from = rows_of(column, rows);
      const ChunkShare share(chunks_of(rows), ranks);
      for (std::size_t i = share.begin; i < share.end; ++i) {
        std::visit([&](const auto& numbers) { std::for_each(numbers.begin(), numbers.end(), see); },
                   from.read(i * kRowsOfChunk, rows_of_chunk(rows, i)));
      }
    } catch (const Error&) {
      is_good = false;
    }
    known.values.assign(values.begin(), values.end());
    put(known.has_fractions, bytes);
    put(known.is_no_label, bytes);
    put(known.is_beyond, bytes);
    put(known.others_than_0, bytes);
    put(known.range, bytes);
    put(known.values, bytes);
  }
  std::vector<ArrayKnowledge> all(columns.size());
  std::vector<std::set<double>> values(columns.size());
  for (const std::string& from : ranks.gather(bytes)) {
    std::string_view rest = from;
    for (std::size_t i = 0; i < all.size(); ++i) {
      ArrayKnowledge other;
      take(rest, other.has_fractions);
      take(rest, other.is_no_label);
      take(rest, other.is_beyond);
      take(rest, other.others_than_0);
      take(rest, other.range);
      take(rest, other.values);
      all[i].join(other);
      values[i].insert(other.values.begin(), other.values.end());
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].values.assign(values[i].begin(), values[i].end());
    is_good = is_good && all[i].is_beyond == 0;
  }
  return all;
}

/// Where no rank has all numbers, none can tell which are taken.
void VtuSlices::note_identifiers(const std::vector<VtuColumn>& columns, std::uint64_t rows,
                                 const std::vector<ArrayKnowledge>& known) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const VtuColumn& column = columns[i];
    const bool is_integral = column.type->kind != formats::VtuType::Kind::real;
    if (!is_integral || column.components != 1 || !known[i].may_be_identifiers(rows)) continue;
    notes_.push_back(fmt::format(
        "the array '{}' may number points or elements: in pieces its numbers may come twice",
        printable(column.name)));
  }
}

/// As adopt_cell_arrays() and adopt_point_arrays() do it.
bool VtuSlices::choose_labels(const std::string& label_array, Ranks& ranks) {
  bool is_good = true;
  const auto of_cells = look_at_arrays(layout_.cell_data, layout_.cells, ranks, is_good);
  const auto of_points = look_at_arrays(layout_.point_data, layout_.points, ranks, is_good);
  if (ranks.any(!is_good)) return false;
  std::vector<formats::ArrayFacts> facts;
  for (std::size_t i = 0; i < of_cells.size(); ++i) {
    const VtuColumn& column = layout_.cell_data[i];
    const ArrayKnowledge& known = of_cells[i];
    const std::size_t cells = layout_.cells;
    facts.push_back({column.name, column.components,
                     column.type->kind != formats::VtuType::Kind::real,
                     [&known] { return known.has_fractions != 0; },
                     [&known, cells] { return formats::is_few_labels(known.values.size(), cells); },
                     [&known] { return known.values.size() <= 1; }});
  }
  try {
    const formats::RegionArrays regions = formats::choose_region_arrays(facts, label_array, notes_);
    if (!regions.parts.empty()) return false;  // their walls are found in the whole mesh
    cell_labels_ = regions.labels;
  } catch (const Error&) {
    return false;
  }
  if (cell_labels_ && of_cells[*cell_labels_].is_no_label != 0) return false;
  note_identifiers(layout_.cell_data, layout_.cells, of_cells);
  note_identifiers(layout_.point_data, layout_.points, of_points);
  for (std::size_t i = 0; i < of_points.size(); ++i) {
    const VtuColumn& column = layout_.point_data[i];
    const bool is_it = formats::is_point_label_array(column.name) && column.components == 1 &&
                       column.type->kind != formats::VtuType::Kind::real;
    if (!is_it) continue;
    point_labels_ = i;
    labelled_points_ = of_points[i].others_than_0;
    return of_points[i].is_no_label == 0;
  }
  return true;
}

/// Which labels each kind of element has.
bool VtuSlices::collect_labels(Ranks& ranks) {
  std::string bytes;
  bool is_good = true;
  if (!cell_labels_) return true;
  std::array<std::set<Label>, 4> mine;
  try {
    VtuRows labels = rows_of(layout_.cell_data[*cell_labels_], layout_.cells);
    Cells cells(*this);
    const ChunkShare share(chunks_.size(), ranks);
    for (std::size_t i = share.begin; i < share.end; ++i) {
      const std::vector<Label> of_chunk =
          as_labels(labels.read(chunks_[i].first, chunks_[i].count));
      is_good = is_good && cells.read(chunks_[i].first, chunks_[i].count);
      for (std::size_t k = 0; is_good && k < of_chunk.size(); ++k) {
        mine[cells.kinds[k]].insert(of_chunk[k]);
      }
    }
  } catch (const Error&) {
    is_good = false;
  }
  for (const std::set<Label>& labels : mine) {
    put(std::vector<Label>(labels.begin(), labels.end()), bytes);
  }
  for (const std::string& from : ranks.gather(bytes)) {
    std::string_view rest = from;
    for (std::set<Label>& labels : labels_) {
      std::vector<Label> others;
      take(rest, others);
      labels.insert(others.begin(), others.end());
    }
  }
  return !ranks.any(!is_good);
}

/// For each chunk that has some of these elements, begin(chunk); then for each of them act(kind, cell of the
/// chunk, cells).
template <class Begin, class Act>
void VtuSlices::for_cells(const Share& of, const Begin& begin, const Act& act) const {
  Cells cells(*this);
  const std::array<FileRange, 3> ranges = {of.tets, of.triangles, of.edges};
  std::array<std::uint64_t, 4> next{};  // of each kind
  std::uint64_t found = 0;
  for (const CellChunk& chunk : chunks_) {
    bool is_needed = false;
    for (std::size_t k = 0; k < ranges.size(); ++k) {
      is_needed = is_needed || (ranges[k].size() > 0 && next[k] < ranges[k].end &&
                                next[k] + chunk.of_kind[k] > ranges[k].begin);
    }
    if (!is_needed) {
      for (std::size_t k = 0; k < next.size(); ++k) next[k] += chunk.of_kind[k];
      continue;
    }
    if (!cells.read(chunk.first, chunk.count)) fail_changed(file_);
    begin(chunk);
    for (std::size_t i = 0; i < cells.kinds.size(); ++i) {
      const Kind kind = cells.kinds[i];
      const std::uint64_t number = next[kind]++;
      if (kind == points || !ranges[kind].has(number)) continue;
      act(kind, i, cells);
      ++found;
    }
  }
  if (found != of.tets.size() + of.triangles.size() + of.edges.size()) fail_changed(file_);
}

void VtuSlices::read_elements(const Share& of, FileElements& elements) const {
  std::optional<VtuRows> labels;
  if (cell_labels_) labels.emplace(rows_of(layout_.cell_data[*cell_labels_], layout_.cells));
  std::vector<Label> labels_of_chunk;
  const auto add = [&](const Cells& cells, std::size_t cell, auto& to) {
    auto& made = to.emplace_back();
    const std::int64_t* const corners = cells.corners_of(cell);
    for (std::size_t k = 0; k < made.vertices.size(); ++k) {
      made.vertices[k] = static_cast<VertexId>(corners[k]);
    }
    if (labels) made.element.label = labels_of_chunk[cell];
  };
  for_cells(
      of,
      [&](const CellChunk& chunk) {
        if (labels) labels_of_chunk = as_labels(labels->read(chunk.first, chunk.count));
      },
      [&](Kind kind, std::size_t cell, const Cells& cells) {
        if (kind == tets) add(cells, cell, elements.tets);
        if (kind == triangles) add(cells, cell, elements.triangles);
        if (kind == edges) add(cells, cell, elements.edges);
      });
}

/// act(first, count, ids): rows of the file, and those of the ids, as a range, that are among them.
template <class Act>
void VtuSlices::for_points(const std::vector<VertexId>& ids, const Act& act) const {
  for (std::size_t k = 0; k < ids.size();) {
    const auto chunk = static_cast<std::size_t>(ids[k] / kRowsOfChunk);
    const std::uint64_t first = chunk * kRowsOfChunk;
    const std::size_t count = rows_of_chunk(layout_.points, chunk);
    std::size_t end = k;
    while (end < ids.size() && ids[end] < first + count) ++end;
    act(first, count, std::span(ids).subspan(k, end - k));
    k = end;
  }
}

void VtuSlices::read_vertices(Piece& slice) const {
  VtuRows places = rows_of(layout_.places, layout_.points);
  std::optional<VtuRows> labels;
  const bool has_labels = point_labels_ && labelled_points_ > 0;
  if (has_labels) labels.emplace(rows_of(layout_.point_data[*point_labels_], layout_.points));
  slice.marks.assign(slice.ids.size(), 0);
  for_points(slice.ids, [&](std::uint64_t first, std::size_t count, std::span<const VertexId> ids) {
    const std::vector<Point> points_of_chunk = as_points(places.read(first, count));
    std::vector<Label> labels_of_chunk;
    if (has_labels) labels_of_chunk = as_labels(labels->read(first, count));
    for (const VertexId id : ids) {
      const auto row = static_cast<std::size_t>(id - first);
      if (!points_of_chunk[row].allFinite()) fail_changed(file_);
      slice.points.push_back(points_of_chunk[row]);
      if (has_labels) slice.labels.push_back(labels_of_chunk[row]);
    }
  });
}

/// Of the arrays of points or cells those that hold no labels.
std::vector<const VtuColumn*> VtuSlices::columns(bool of_points) const {
  const std::vector<VtuColumn>& all = of_points ? layout_.point_data : layout_.cell_data;
  const std::optional<std::size_t>& labels = of_points ? point_labels_ : cell_labels_;
  std::vector<const VtuColumn*> columns;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (labels != i) columns.push_back(&all[i]);
  }
  return columns;
}

void VtuSlices::read_rows(const Share& of, const std::vector<VertexId>& ids,
                          ByKind<std::string>& rows) const {
  const ByKind<RowLayout> layouts = row_layouts();
  const auto open = [&](bool of_points) {
    std::vector<VtuRows> arrays;
    for (const VtuColumn* const column : columns(of_points)) {
      arrays.push_back(rows_of(*column, of_points ? layout_.points : layout_.cells));
    }
    return arrays;
  };
  const auto read_all = [](std::vector<VtuRows>& arrays, std::uint64_t first, std::size_t count) {
    std::vector<DataArray::Values> values;
    for (VtuRows& array : arrays) values.push_back(array.read(first, count));
    return values;
  };
  const auto append = [](const RowLayout& layout, const std::vector<DataArray::Values>& values,
                         std::size_t from, std::string& to) {
    to.resize(to.size() + layout.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      layout.set(i, values[i], from, to.data() + to.size() - layout.size());
    }
  };
  if (layouts[RowKind::point].size() > 0) {
    std::vector<VtuRows> arrays = open(true);
    for_points(ids, [&](std::uint64_t first, std::size_t count, std::span<const VertexId> some) {
      const std::vector<DataArray::Values> values = read_all(arrays, first, count);
      for (const VertexId id : some) {
        append(layouts[RowKind::point], values, static_cast<std::size_t>(id - first),
               rows[RowKind::point]);
      }
    });
  }
  if (layouts[RowKind::tet].size() == 0) return;
  std::vector<VtuRows> arrays = open(false);
  std::vector<DataArray::Values> values;
  for_cells(
      of, [&](const CellChunk& chunk) { values = read_all(arrays, chunk.first, chunk.count); },
      [&](Kind kind, std::size_t cell, const Cells&) {
        const RowKind of_kind = kind == tets        ? RowKind::tet
                                : kind == triangles ? RowKind::triangle
                                                    : RowKind::edge;
        append(layouts[of_kind], values, cell, rows[of_kind]);
      });
}

namespace {

/// An array of that name and type, without numbers.
DataArray nothing_of(const VtuColumn& column) {
  return {column.name, column.components, formats::decode_vtu({}, *column.type, 0, false)};
}

}  // namespace

bool VtuSlices::has_all_in_rows() const {
  return loose_points_ == 0;
}

ByKind<RowLayout> VtuSlices::row_layouts() const {
  const auto layout_of = [&](bool of_points) {
    std::vector<DataArray> arrays;
    for (const VtuColumn* const column : columns(of_points)) arrays.push_back(nothing_of(*column));
    return RowLayout(std::move(arrays));
  };
  ByKind<RowLayout> layouts;
  layouts[RowKind::point] = layout_of(true);
  for (const RowKind kind : {RowKind::tet, RowKind::triangle, RowKind::edge}) {
    layouts[kind] = layout_of(false);
  }
  return layouts;
}

MeshData VtuSlices::digest() const {
  MeshData data;
  data.notes = notes_;
  const auto add = [&](Kind kind, auto& elements) {
    for (const Label label : labels_[kind]) elements.emplace_back().label = label;
  };
  add(tets, data.tets);
  add(triangles, data.triangles);
  data.edges.resize(
      counts_.edges);  // messages have their number, as that of the points with labels
  data.point_labels.assign(labelled_points_, 1);
  if (cell_labels_) data.label_array = layout_.cell_data[*cell_labels_].name;
  const ByKind<RowLayout> layouts = row_layouts();
  data.tet_data = layouts[RowKind::tet].arrays();
  if (counts_.triangles > 0) data.triangle_data = data.tet_data;
  if (counts_.edges > 0) data.edge_data = data.tet_data;
  data.point_data = layouts[RowKind::point].arrays();
  if (loose_points_ > 0) {
    data.other_elements.push_back({1, 1, {}, std::vector<Label>(loose_points_, 0), {}, {}, {}});
  }
  return data;
}

}  // namespace tetmend::pieces
