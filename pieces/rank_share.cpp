// SPDX-License-Identifier: MIT
#include "pieces/rank_share.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "pieces/bytes.h"
#include "pieces/carried_rows.h"
#include "pieces/numbering.h"
#include "pieces/sent_vertex.h"
#include "pieces/share_slices.h"

namespace tetmend::pieces {

namespace {

template <std::size_t N, class Element>
void append_elements(const std::vector<Element>& from, const std::vector<std::uint64_t>& numbers,
                     std::vector<RankShare::Element<N>>& to) {
  for (const Element& element : from) {
    auto& made = to.emplace_back();
    for (std::size_t k = 0; k < N; ++k) made.vertices[k] = numbers[element.vertices[k]];
    made.label = element.label;
  }
}

/// Puts the vertices that came in the order of their numbers. Behind each is its row.
void place_vertices(const std::vector<std::string>& came, std::uint64_t begin, std::uint64_t end,
                    const RowLayout& layout, RankShare& arrays) {
  arrays.points.resize(end - begin);
  arrays.point_labels.assign(end - begin, 0);
  std::string rows((end - begin) * layout.size(), '\0');
  for (const std::string& from : came) {
    for (std::string_view rest = from; !rest.empty();) {
      SentVertex vertex{};
      take(rest, vertex);
      const std::uint64_t at = vertex.number - begin;
      arrays.points[at] = Point(vertex.point[0], vertex.point[1], vertex.point[2]);
      arrays.point_labels[at] = vertex.label;
      const std::string_view row = take_front(rest, layout.size());
      std::copy(row.begin(), row.end(), rows.data() + at * layout.size());
      if (vertex.is_required != 0) arrays.required_vertices.push_back(vertex.number);
    }
  }
  std::sort(arrays.required_vertices.begin(), arrays.required_vertices.end());
  layout.take_rows(rows, arrays.arrays[RowKind::point]);
}

/// Of the elements of one kind that a stored piece has.
void append_columns(const CarriedRows& rows, RowKind kind, std::size_t part, std::size_t count,
                    RankShare& arrays) {
  std::vector<DataArray>& of_kind = arrays.arrays[kind];
  for (std::size_t i = 0; i < of_kind.size(); ++i) {
    append_values(rows.column(kind, part, i, 0, count), of_kind[i]);
  }
}

/// All numbers of the vertices of a stored piece, array by array.
class PointColumns {
 public:
  PointColumns(const CarriedRows* rows, std::size_t part, std::size_t count) {
    if (rows == nullptr) return;
    const RowLayout& layout = rows->layout(RowKind::point);
    for (std::size_t i = 0; i < layout.arrays().size(); ++i) {
      columns_.push_back(rows->column(RowKind::point, part, i, 0, count));
      widths_.push_back(layout.width(i));
    }
  }
  void append_row(std::size_t v, std::string& bytes) const {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      bytes.append(columns_[i], v * widths_[i], widths_[i]);
    }
  }

 private:
  std::vector<std::string> columns_;
  std::vector<std::size_t> widths_;
};

/// What a rank has when values are still to come.
RankShare share_for(const CarriedRows* rows) {
  RankShare arrays;
  if (rows == nullptr) return arrays;
  for (const RowKind kind : kRowKinds) {
    arrays.arrays[kind] = nothing_of(rows->layout(kind).arrays());
  }
  return arrays;
}

void append_piece(const Piece& piece, const std::vector<std::uint64_t>& numbers,
                  const CarriedRows* rows, std::size_t part, RankShare& arrays) {
  append_elements(piece.tets, numbers, arrays.tets);
  append_elements(piece.triangles, numbers, arrays.triangles);
  append_elements(piece.edges, numbers, arrays.edges);
  if (rows == nullptr) return;
  append_columns(*rows, RowKind::tet, part, piece.tets.size(), arrays);
  append_columns(*rows, RowKind::triangle, part, piece.triangles.size(), arrays);
  append_columns(*rows, RowKind::edge, part, piece.edges.size(), arrays);
}

}  // namespace

void ArrayFiles::write_stored(const std::filesystem::path& file, const DividedMesh& mesh,
                              const CarriedRows* rows) const {
  write(file, take_arrays(mesh, rows));
}

bool SeveralArrayFiles::is_one(const std::filesystem::path& file) const {
  return std::any_of(kinds_.begin(), kinds_.end(),
                     [&](const ArrayFiles* kind) { return kind->is_one(file); });
}

const ArrayFiles& SeveralArrayFiles::of(const std::filesystem::path& file) const {
  return **std::find_if(kinds_.begin(), kinds_.end(),
                        [&](const ArrayFiles* kind) { return kind->is_one(file); });
}

RankShare SeveralArrayFiles::read(const std::filesystem::path& file,
                                  const std::string& label_array) const {
  return of(file).read(file, label_array);
}

void SeveralArrayFiles::write(const std::filesystem::path& file, const RankShare& arrays) const {
  of(file).write(file, arrays);
}

void SeveralArrayFiles::write_stored(const std::filesystem::path& file, const DividedMesh& mesh,
                                     const CarriedRows* rows) const {
  of(file).write_stored(file, mesh, rows);
}

formats::FileSet SeveralArrayFiles::files_read(const std::filesystem::path& file) const {
  return of(file).files_read(file);
}

formats::FileSet SeveralArrayFiles::files_written(const std::filesystem::path& file) const {
  return of(file).files_written(file);
}

void SeveralArrayFiles::check_output(const std::filesystem::path& file) const {
  of(file).check_output(file);
}

bool SeveralArrayFiles::is_in_parts(const std::filesystem::path& file) const {
  return is_one(file) && of(file).is_in_parts(file);
}

bool SeveralArrayFiles::has_required_vertices(const std::filesystem::path& file) const {
  return of(file).has_required_vertices(file);
}

bool SeveralArrayFiles::takes(const std::filesystem::path& file, RowKind kind,
                              const DataArray& array) const {
  return of(file).takes(file, kind, array);
}

RankShare all_of(const MeshData& data) {
  RankShare arrays;
  const auto take = [](const auto& from, auto& to) {
    for (const auto& each : from) {
      auto& made = to.emplace_back();
      std::copy(each.vertices.begin(), each.vertices.end(), made.vertices.begin());
      made.label = each.label;
    }
  };
  arrays.points = data.points;
  arrays.point_labels = data.point_labels;
  take(data.tets, arrays.tets);
  take(data.triangles, arrays.triangles);
  take(data.edges, arrays.edges);
  arrays.required_vertices.assign(data.required_vertices.begin(), data.required_vertices.end());
  arrays.arrays[RowKind::point] = data.point_data;
  arrays.arrays[RowKind::tet] = data.tet_data;
  arrays.arrays[RowKind::triangle] = data.triangle_data;
  arrays.arrays[RowKind::edge] = data.edge_data;
  return arrays;
}

bool has_arrays(const KindArrays& arrays) {
  return std::any_of(kRowKinds.begin(), kRowKinds.end(),
                     [&](RowKind kind) { return !arrays[kind].empty(); });
}

void share_outlines(KindArrays& arrays, Ranks& ranks) {
  std::string bytes;
  for (const RowKind kind : kRowKinds) {
    put(std::uint64_t{arrays[kind].size()}, bytes);
    for (const DataArray& array : arrays[kind]) append_outline(array, bytes);
  }
  const std::string all = ranks.gather(ranks.is_first() ? bytes : std::string()).front();
  if (ranks.is_first()) return;
  std::string_view rest = all;
  for (const RowKind kind : kRowKinds) {
    std::uint64_t count = 0;
    take(rest, count);
    arrays[kind].clear();
    for (std::uint64_t i = 0; i < count; ++i) arrays[kind].push_back(take_outline(rest));
  }
}

KindArrays gather_arrays(const KindArrays& arrays, Ranks& ranks) {
  KindArrays all;
  for (const RowKind kind : kRowKinds) {
    for (const DataArray& mine : arrays[kind]) {
      std::vector<std::string> to(ranks.count());
      to[0] = bytes_of_values(mine);
      DataArray& made = all[kind].emplace_back(nothing_of(mine));
      for (const std::string& from : ranks.exchange(std::move(to))) append_values(from, made);
    }
  }
  return all;
}

ArrayCounts count_all(const RankShare& arrays, Ranks& ranks) {
  std::array<std::int64_t, 5> counts = {static_cast<std::int64_t>(arrays.points.size()),
                                        static_cast<std::int64_t>(arrays.tets.size()),
                                        static_cast<std::int64_t>(arrays.triangles.size()),
                                        static_cast<std::int64_t>(arrays.edges.size()),
                                        static_cast<std::int64_t>(arrays.required_vertices.size())};
  ranks.add(counts);
  std::array<std::uint64_t, 5> all{};
  std::copy(counts.begin(), counts.end(), all.begin());
  return {all[0], all[1], all[2], all[3], all[4]};
}

void add_arrays(const RankShare& arrays, DividedMesh& to) {
  ShareSlices(arrays, to.ranks()).add_to(to);
}

RankShare take_arrays(const DividedMesh& mesh, const CarriedRows* rows) {
  RankShare arrays = share_for(rows);
  Ranks& ranks = mesh.ranks();
  const Numbering numbering(mesh);
  const std::uint64_t total = numbering.size();
  const std::uint64_t count = ranks.count();
  const auto begin_of = [&](std::uint64_t rank) { return total * rank / count; };
  std::vector<std::string> to(count);
  for (const std::size_t part : mesh.own()) {
    const Piece piece = mesh.stored(part);
    std::vector<std::uint64_t> numbers(piece.ids.size());
    const PointColumns columns(rows, part, piece.ids.size());
    for (std::size_t v = 0; v < numbers.size(); ++v) {
      numbers[v] = numbering.number(piece.ids[v]);
      if ((piece.marks[v] & kOwn) == 0) continue;
      std::uint64_t rank = numbers[v] * count / total;
      while (begin_of(rank + 1) <= numbers[v]) ++rank;
      const Point& p = piece.points[v];
      put(SentVertex{numbers[v],
                     {p.x(), p.y(), p.z()},
                     piece.label(v),
                     (piece.marks[v] & kRequired) != 0 ? 1U : 0U},
          to[rank]);
      columns.append_row(v, to[rank]);
    }
    append_piece(piece, numbers, rows, part, arrays);
  }
  place_vertices(ranks.exchange(std::move(to)), begin_of(ranks.number()),
                 begin_of(ranks.number() + 1), RowLayout(nothing_of(arrays.arrays[RowKind::point])),
                 arrays);
  const bool has_labels =
      ranks.any(std::any_of(arrays.point_labels.begin(), arrays.point_labels.end(),
                            [](Label label) { return label != 0; }));
  if (!has_labels) arrays.point_labels.clear();
  return arrays;
}

}  // namespace tetmend::pieces
