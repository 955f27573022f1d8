// SPDX-License-Identifier: MIT
#include "pieces/rank_share.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "kernel/error.h"
#include "pieces/bytes.h"
#include "pieces/numbering.h"
#include "pieces/slices.h"

namespace tetmend::pieces {

namespace {

/// What a rank sends of a vertex.
struct SentVertex {
  std::uint64_t number;
  std::array<double, 3> point;
  Label label;
  std::uint32_t is_required;
};

std::vector<std::uint64_t> numbers_of_all(std::uint64_t mine, Ranks& ranks) {
  std::string bytes;
  put(mine, bytes);
  std::vector<std::uint64_t> all;
  for (const std::string& from : ranks.gather(bytes)) {
    std::string_view rest = from;
    take(rest, all.emplace_back());
  }
  return all;
}

/// Which numbers each rank has, when they are numbered through.
class Ranges {
 public:
  Ranges(std::uint64_t mine, Ranks& ranks) : begins_{0} {
    for (const std::uint64_t count : numbers_of_all(mine, ranks)) {
      begins_.push_back(begins_.back() + count);
    }
  }
  std::uint64_t begin(std::size_t rank) const { return begins_[rank]; }
  std::uint64_t total() const { return begins_.back(); }
  std::size_t rank_of(std::uint64_t number) const {
    const auto after = std::upper_bound(begins_.begin(), begins_.end(), number);
    return static_cast<std::size_t>(after - begins_.begin()) - 1;
  }

 private:
  std::vector<std::uint64_t> begins_;
};

/// The slices of one rank, one after another; all ranks make as many.
class Slicer {
 public:
  Slicer(const RankShare& arrays, DividedMesh& to)
      : arrays_(arrays),
        to_(to),
        ranks_(to.ranks()),
        points_(arrays.points.size(), ranks_),
        tets_(arrays.tets.size(), ranks_) {
    const std::vector<std::uint64_t> counts = numbers_of_all(arrays.tets.size(), ranks_);
    slices_ = 1 + *std::max_element(counts.begin(), counts.end()) / kTetsOfSlice;
    note_required();
  }

  void add_all() {
    for (std::uint64_t i = 0; i < slices_; ++i) add(i);
    to_.end_slices();
  }

 private:
  template <class Element>
  using Range = std::pair<const Element*, const Element*>;

  /// Of a list, what slice i has.
  template <class Value>
  Range<Value> range(const std::vector<Value>& all, std::uint64_t i) const {
    return {all.data() + all.size() * i / slices_, all.data() + all.size() * (i + 1) / slices_};
  }

  void note_required() {
    is_required_.assign(arrays_.points.size(), 0);
    std::vector<std::string> to(ranks_.count());
    for (const std::uint64_t v : arrays_.required_vertices) {
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

  std::uint64_t checked(std::uint64_t v) const {
    if (v < points_.total()) return v;
    throw Error(fmt::format("there is no vertex {}: the mesh has {}", v, points_.total()));
  }

  template <std::size_t N>
  void note(Range<RankShare::Element<N>> elements, std::vector<VertexId>& ids) const {
    for (const auto* element = elements.first; element != elements.second; ++element) {
      const auto& v = element->vertices;
      for (std::size_t i = 0; i < N; ++i) {
        ids.push_back(checked(v[i]));
        for (std::size_t k = 0; k < i; ++k) {
          if (v[k] == v[i]) throw Error(fmt::format("an element has vertex {} twice", v[i]));
        }
      }
    }
  }

  template <std::size_t N, class Element>
  static void renumber(Range<RankShare::Element<N>> from, const std::vector<VertexId>& ids,
                       std::vector<Element>& to) {
    for (const auto* each = from.first; each != from.second; ++each) {
      Element& element = to.emplace_back();
      element.label = each->label;
      for (std::size_t k = 0; k < N; ++k) {
        const auto found = std::lower_bound(ids.begin(), ids.end(), each->vertices[k]);
        element.vertices[k] = static_cast<std::uint32_t>(found - ids.begin());
      }
    }
  }

  void add(std::uint64_t i) {
    Piece slice;
    note(range(arrays_.tets, i), slice.ids);
    note(range(arrays_.triangles, i), slice.ids);
    note(range(arrays_.edges, i), slice.ids);
    const std::uint64_t first = points_.begin(ranks_.number());
    const auto own = range(arrays_.points, i);
    const auto own_begin = first + static_cast<std::uint64_t>(own.first - arrays_.points.data());
    const auto own_end = first + static_cast<std::uint64_t>(own.second - arrays_.points.data());
    for (std::uint64_t v = own_begin; v < own_end; ++v) slice.ids.push_back(v);
    std::sort(slice.ids.begin(), slice.ids.end());
    slice.ids.erase(std::unique(slice.ids.begin(), slice.ids.end()), slice.ids.end());
    renumber(range(arrays_.tets, i), slice.ids, slice.tets);
    renumber(range(arrays_.triangles, i), slice.ids, slice.triangles);
    renumber(range(arrays_.edges, i), slice.ids, slice.edges);
    number_tets(i, slice);
    fetch(slice);
    for (std::size_t k = 0; k < slice.ids.size(); ++k) {
      if (slice.ids[k] < own_begin || slice.ids[k] >= own_end) continue;
      slice.marks[k] = static_cast<std::uint8_t>(slice.marks[k] | kOwn);
    }
    to_.add_slice(ranks_.number() * slices_ + i, slice);
  }

  void number_tets(std::uint64_t i, Piece& slice) const {
    std::uint64_t number = tets_.begin(ranks_.number()) + arrays_.tets.size() * i / slices_;
    for (PieceTet& tet : slice.tets) {
      tet.origin = static_cast<std::uint32_t>(std::min<std::uint64_t>(number++, PieceTet::kNone));
    }
  }

  /// Asks the ranks that have them for the vertices of a slice.
  void fetch(Piece& slice) const {
    std::vector<std::string> asked(ranks_.count());
    for (const VertexId id : slice.ids) put(id, asked[points_.rank_of(id)]);
    std::vector<std::string> answers(ranks_.count());
    const std::vector<std::string> questions = ranks_.exchange(std::move(asked));
    for (std::size_t r = 0; r < questions.size(); ++r) {
      for (std::string_view rest = questions[r]; !rest.empty();) {
        std::uint64_t id = 0;
        take(rest, id);
        put(sent(id), answers[r]);
      }
    }
    // Ids ascend and so do the ranks that have them: so the answers come in their order.
    std::vector<Label> labels;
    for (const std::string& from : ranks_.exchange(std::move(answers))) {
      for (std::string_view rest = from; !rest.empty();) {
        SentVertex vertex{};
        take(rest, vertex);
        slice.points.emplace_back(vertex.point[0], vertex.point[1], vertex.point[2]);
        if (!slice.points.back().allFinite()) {
          throw Error(
              fmt::format("a coordinate of vertex {} is not a finite number", vertex.number));
        }
        slice.marks.push_back(vertex.is_required != 0 ? kRequired : 0);
        labels.push_back(vertex.label);
      }
    }
    const bool has = std::any_of(labels.begin(), labels.end(), [](Label l) { return l != 0; });
    if (has) slice.labels = std::move(labels);
  }

  SentVertex sent(std::uint64_t id) const {
    const std::uint64_t at = id - points_.begin(ranks_.number());
    const Point& p = arrays_.points[at];
    return {id,
            {p.x(), p.y(), p.z()},
            arrays_.point_labels.empty() ? 0 : arrays_.point_labels[at],
            is_required_[at] != 0 ? 1U : 0U};
  }

  const RankShare& arrays_;
  DividedMesh& to_;
  Ranks& ranks_;
  Ranges points_;
  Ranges tets_;
  std::uint64_t slices_ = 1;
  std::vector<char> is_required_;
};

template <std::size_t N, class Element>
void append_elements(const std::vector<Element>& from, const std::vector<std::uint64_t>& numbers,
                     std::vector<RankShare::Element<N>>& to) {
  for (const Element& element : from) {
    auto& made = to.emplace_back();
    for (std::size_t k = 0; k < N; ++k) made.vertices[k] = numbers[element.vertices[k]];
    made.label = element.label;
  }
}

/// Puts the vertices that came in the order of their numbers.
void place_vertices(const std::vector<std::string>& came, std::uint64_t begin, std::uint64_t end,
                    RankShare& arrays) {
  arrays.points.resize(end - begin);
  arrays.point_labels.assign(end - begin, 0);
  for (const std::string& from : came) {
    for (std::string_view rest = from; !rest.empty();) {
      SentVertex vertex{};
      take(rest, vertex);
      const std::uint64_t at = vertex.number - begin;
      arrays.points[at] = Point(vertex.point[0], vertex.point[1], vertex.point[2]);
      arrays.point_labels[at] = vertex.label;
      if (vertex.is_required != 0) arrays.required_vertices.push_back(vertex.number);
    }
  }
  std::sort(arrays.required_vertices.begin(), arrays.required_vertices.end());
}

}  // namespace

void ArrayFiles::write_stored(const std::filesystem::path& file, const DividedMesh& mesh) const {
  write(file, take_arrays(mesh));
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

void SeveralArrayFiles::write_stored(const std::filesystem::path& file,
                                     const DividedMesh& mesh) const {
  of(file).write_stored(file, mesh);
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
  return arrays;
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
  Slicer(arrays, to).add_all();
}

RankShare take_arrays(const DividedMesh& mesh) {
  RankShare arrays;
  Ranks& ranks = mesh.ranks();
  const Numbering numbering(mesh);
  const std::uint64_t total = numbering.size();
  const std::uint64_t count = ranks.count();
  const auto begin_of = [&](std::uint64_t rank) { return total * rank / count; };
  std::vector<std::string> to(count);
  for (const std::size_t part : mesh.own()) {
    const Piece piece = mesh.stored(part);
    std::vector<std::uint64_t> numbers(piece.ids.size());
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
    }
    append_elements(piece.tets, numbers, arrays.tets);
    append_elements(piece.triangles, numbers, arrays.triangles);
    append_elements(piece.edges, numbers, arrays.edges);
  }
  place_vertices(ranks.exchange(std::move(to)), begin_of(ranks.number()),
                 begin_of(ranks.number() + 1), arrays);
  const bool has_labels =
      ranks.any(std::any_of(arrays.point_labels.begin(), arrays.point_labels.end(),
                            [](Label label) { return label != 0; }));
  if (!has_labels) arrays.point_labels.clear();
  return arrays;
}

}  // namespace tetmend::pieces
