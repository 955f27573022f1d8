// SPDX-License-Identifier: MIT
#include "pieces/share_slices.h"

#include <algorithm>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "kernel/error.h"
#include "pieces/bytes.h"
#include "pieces/sent_vertex.h"
#include "pieces/slices.h"

namespace tetmend::pieces {

namespace {

/// Names vertices by their places among `ids`.
template <std::size_t N, class Element>
void place_elements(const std::vector<RankShare::Element<N>>& from,
                    std::pair<std::size_t, std::size_t> range, const std::vector<VertexId>& ids,
                    std::vector<Element>& to) {
  for (std::size_t i = range.first; i < range.second; ++i) {
    Element& element = to.emplace_back();
    element.label = from[i].label;
    for (std::size_t k = 0; k < N; ++k) {
      const auto found = std::lower_bound(ids.begin(), ids.end(), from[i].vertices[k]);
      element.vertices[k] = static_cast<std::uint32_t>(found - ids.begin());
    }
  }
}

}  // namespace

RankRanges::RankRanges(std::uint64_t mine, Ranks& ranks) : begins_{0} {
  std::string bytes;
  put(mine, bytes);
  for (const std::string& from : ranks.gather(bytes)) {
    std::string_view rest = from;
    std::uint64_t count = 0;
    take(rest, count);
    begins_.push_back(begins_.back() + count);
  }
}

std::uint64_t RankRanges::most() const {
  std::uint64_t most = 0;
  for (std::size_t r = 0; r + 1 < begins_.size(); ++r) {
    most = std::max(most, begins_[r + 1] - begins_[r]);
  }
  return most;
}

std::size_t RankRanges::rank_of(std::uint64_t number) const {
  const auto after = std::upper_bound(begins_.begin(), begins_.end(), number);
  return static_cast<std::size_t>(after - begins_.begin()) - 1;
}

ShareSlices::ShareSlices(const RankShare& share, Ranks& ranks)
    : share_(share),
      ranks_(ranks),
      points_(share.points.size(), ranks),
      tets_(share.tets.size(), ranks) {
  note_required();
}

void ShareSlices::note_required() {
  is_required_.assign(share_.points.size(), 0);
  std::vector<std::string> to(ranks_.count());
  for (const std::uint64_t v : share_.required_vertices) {
    put(checked(v), to[points_.rank_of(v)]);
  }
  for (const std::string& from : ranks_.exchange(std::move(to))) {
    for (std::string_view rest = from; !rest.empty();) {
      std::uint64_t v = 0;
      take(rest, v);
      is_required_[v - points_.begin(ranks_.number())] = 1;
    }
  }
}

std::uint64_t ShareSlices::checked(std::uint64_t v) const {
  if (v < points_.total()) return v;
  throw Error(fmt::format("there is no vertex {}: the mesh has {}", v, points_.total()));
}

template <std::size_t N>
void ShareSlices::note(const std::vector<RankShare::Element<N>>& elements, Range range,
                       std::vector<VertexId>& ids) const {
  for (std::size_t each = range.first; each < range.second; ++each) {
    const auto& v = elements[each].vertices;
    for (std::size_t i = 0; i < N; ++i) {
      ids.push_back(checked(v[i]));
      for (std::size_t k = 0; k < i; ++k) {
        if (v[k] == v[i]) throw Error(fmt::format("an element has vertex {} twice", v[i]));
      }
    }
  }
}

Piece ShareSlices::read(const Slicing& slicing, const RowLayout& of_points,
                        std::string& rows) const {
  Piece slice;
  note(share_.tets, slicing.of(share_.tets), slice.ids);
  note(share_.triangles, slicing.of(share_.triangles), slice.ids);
  note(share_.edges, slicing.of(share_.edges), slice.ids);
  const Range own = slicing.of(share_.points);
  const std::uint64_t first = points_.begin(ranks_.number());
  for (std::size_t v = own.first; v < own.second; ++v) slice.ids.push_back(first + v);
  std::sort(slice.ids.begin(), slice.ids.end());
  slice.ids.erase(std::unique(slice.ids.begin(), slice.ids.end()), slice.ids.end());
  place_elements(share_.tets, slicing.of(share_.tets), slice.ids, slice.tets);
  place_elements(share_.triangles, slicing.of(share_.triangles), slice.ids, slice.triangles);
  place_elements(share_.edges, slicing.of(share_.edges), slice.ids, slice.edges);
  number_tets(slicing, slice);
  fetch(of_points, slice, rows);
  for (std::size_t k = 0; k < slice.ids.size(); ++k) {
    if (slice.ids[k] < first + own.first || slice.ids[k] >= first + own.second) continue;
    slice.marks[k] = static_cast<std::uint8_t>(slice.marks[k] | kOwn);
  }
  return slice;
}

void ShareSlices::number_tets(const Slicing& slicing, Piece& slice) const {
  std::uint64_t number = tets_.begin(ranks_.number()) + slicing.of(share_.tets).first;
  for (PieceTet& tet : slice.tets) {
    tet.origin = static_cast<std::uint32_t>(std::min<std::uint64_t>(number++, PieceTet::kNone));
  }
}

/// Asks the ranks that have them for the vertices of a slice.
void ShareSlices::fetch(const RowLayout& of_points, Piece& slice, std::string& rows) const {
  std::vector<std::string> asked(ranks_.count());
  for (const VertexId id : slice.ids) put(id, asked[points_.rank_of(id)]);
  std::vector<std::string> answers;
  for (const std::string& questions : ranks_.exchange(std::move(asked))) {
    answers.push_back(answer(questions, of_points));
  }
  // Ids ascend and so do the ranks that have them: so the answers come in their order.
  std::vector<Label> labels;
  for (const std::string& from : ranks_.exchange(std::move(answers))) {
    for (std::string_view rest = from; !rest.empty();) {
      SentVertex vertex{};
      take(rest, vertex);
      rows += take_front(rest, of_points.size());
      slice.points.emplace_back(vertex.point[0], vertex.point[1], vertex.point[2]);
      if (!slice.points.back().allFinite()) {
        throw Error(fmt::format("a coordinate of vertex {} is not a finite number", vertex.number));
      }
      slice.marks.push_back(vertex.is_required != 0 ? kRequired : 0);
      labels.push_back(vertex.label);
    }
  }
  const bool has = std::any_of(labels.begin(), labels.end(), [](Label l) { return l != 0; });
  if (has) slice.labels = std::move(labels);
}

/// The vertices of these numbers, which this rank has, each with its row.
std::string ShareSlices::answer(const std::string& questions, const RowLayout& of_points) const {
  std::string bytes;
  for (std::string_view rest = questions; !rest.empty();) {
    std::uint64_t id = 0;
    take(rest, id);
    const std::uint64_t at = id - points_.begin(ranks_.number());
    const Point& p = share_.points[at];
    put(SentVertex{id,
                   {p.x(), p.y(), p.z()},
                   share_.point_labels.empty() ? 0 : share_.point_labels[at],
                   is_required_[at] != 0 ? 1U : 0U},
        bytes);
    if (of_points.size() > 0) {
      of_points.append_rows(share_.arrays[RowKind::point], at, at + 1, bytes);
    }
  }
  return bytes;
}

void ShareSlices::add_to(DividedMesh& mesh) const {
  const std::uint64_t slices = slices_of_rank(kTetsOfSlice);
  std::string no_rows;
  for (std::uint64_t i = 0; i < slices; ++i) {
    mesh.add_slice(ranks_.number() * slices + i, read({i, slices}, {}, no_rows));
  }
  mesh.end_slices();
}

ByKind<RowLayout> ShareSlices::row_layouts() const {
  ByKind<RowLayout> layouts;
  for (const RowKind kind : kRowKinds) layouts[kind] = RowLayout(nothing_of(share_.arrays[kind]));
  return layouts;
}

std::uint64_t ShareSlices::slice_count(std::size_t tets_of_slice, const Ranks& ranks) const {
  return slices_of_rank(tets_of_slice) * ranks.count();
}

void ShareSlices::for_row_slices(
    std::size_t tets_of_slice, const Ranks& ranks,
    const std::function<void(std::uint64_t number, RowSlice slice)>& use) const {
  const ByKind<RowLayout> layouts = row_layouts();
  const std::uint64_t slices = slices_of_rank(tets_of_slice);
  for (std::uint64_t i = 0; i < slices; ++i) {
    const Slicing slicing = {i, slices};
    RowSlice slice;
    slice.piece = read(slicing, layouts[RowKind::point], slice.rows[RowKind::point]);
    const auto add = [&](RowKind kind, Range range) {
      layouts[kind].append_rows(share_.arrays[kind], range.first, range.second, slice.rows[kind]);
    };
    add(RowKind::tet, slicing.of(share_.tets));
    add(RowKind::triangle, slicing.of(share_.triangles));
    add(RowKind::edge, slicing.of(share_.edges));
    use(ranks.number() * slices + i, std::move(slice));
  }
}

}  // namespace tetmend::pieces
