// SPDX-License-Identifier: MIT
#include "pieces/piece.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "kernel/error.h"
#include "pieces/bytes.h"

namespace tetmend::pieces {

namespace {

constexpr std::uint32_t kGoneVertex = std::numeric_limits<std::uint32_t>::max();

template <class Element>
bool names_vertices_of(const std::vector<Element>& elements, std::size_t count) {
  return std::all_of(elements.begin(), elements.end(), [&](const Element& element) {
    return std::all_of(element.vertices.begin(), element.vertices.end(),
                       [&](std::uint32_t v) { return v < count; });
  });
}

template <class Element>
void append_renumbered(const std::vector<Element>& from, std::span<const std::uint32_t> numbers,
                       std::vector<Element>& to) {
  to.reserve(to.size() + from.size());
  for (Element element : from) {
    for (std::uint32_t& v : element.vertices) v = numbers[v];
    to.push_back(element);
  }
}

template <class Element>
void append_chosen(const std::vector<Element>& from, std::span<const std::uint32_t> chosen,
                   std::span<const std::uint32_t> numbers, std::vector<Element>& to) {
  to.reserve(chosen.size());
  for (const std::uint32_t i : chosen) {
    Element element = from[i];
    for (std::uint32_t& v : element.vertices) v = numbers[v];
    to.push_back(element);
  }
}

/// Bit for bit: 0 and -0 differ, and all copies of a vertex come from one.
bool same_place(const Point& a, const Point& b) {
  return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0;
}

/// Where each vertex of a part is among all ids.
std::vector<std::uint32_t> places_of(const Piece& part, const std::vector<VertexId>& ids) {
  std::vector<std::uint32_t> places(part.ids.size());
  std::size_t at = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    while (ids[at] != part.ids[i]) ++at;
    places[i] = static_cast<std::uint32_t>(at);
  }
  return places;
}

void take_vertices(const Piece& part, std::span<const std::uint32_t> places, Piece& whole,
                   std::vector<char>& known) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::uint32_t at = places[i];
    if (known[at] != 0 && !same_place(whole.points[at], part.points[i])) {
      throw Error(fmt::format("pieces do not fit: vertex {} lies at two places", part.ids[i]));
    }
    known[at] = 1;
    whole.points[at] = part.points[i];
    whole.marks[at] =
        static_cast<std::uint8_t>(whole.marks[at] | (part.marks[i] & (kLasting | kBorder | kSent)));
    if (!whole.labels.empty()) whole.labels[at] = part.label(i);
  }
}

}  // namespace

MeshData to_data(const Piece& piece) {
  MeshData data;
  data.points = piece.points;
  data.point_labels = piece.labels;
  data.tets.reserve(piece.tets.size());
  for (const PieceTet& tet : piece.tets) data.tets.push_back({tet.vertices, tet.label});
  data.triangles = piece.triangles;
  data.edges = piece.edges;
  for (std::uint32_t v = 0; v < piece.marks.size(); ++v) {
    if ((piece.marks[v] & kRequired) != 0) data.required_vertices.push_back(v);
  }
  return data;
}

std::size_t byte_count(const Piece& piece) {
  const auto bytes = [](const auto& array) {
    return sizeof(std::uint64_t) + array.size() * sizeof(array[0]);
  };
  return bytes(piece.ids) + bytes(piece.points) + bytes(piece.labels) + bytes(piece.marks) +
         bytes(piece.tets) + bytes(piece.triangles) + bytes(piece.edges) + bytes(piece.surface) +
         bytes(piece.lines);
}

void append(const Piece& piece, std::string& bytes) {
  if (bytes.empty()) bytes.reserve(byte_count(piece));
  put(piece.ids, bytes);
  put(piece.points, bytes);
  put(piece.labels, bytes);
  put(piece.marks, bytes);
  put(piece.tets, bytes);
  put(piece.triangles, bytes);
  put(piece.edges, bytes);
  put(piece.surface, bytes);
  put(piece.lines, bytes);
}

Piece take_piece(std::string_view& bytes) {
  Piece piece;
  take(bytes, piece.ids);
  take(bytes, piece.points);
  take(bytes, piece.labels);
  take(bytes, piece.marks);
  take(bytes, piece.tets);
  take(bytes, piece.triangles);
  take(bytes, piece.edges);
  take(bytes, piece.surface);
  take(bytes, piece.lines);
  const std::size_t count = piece.ids.size();
  const bool fits = piece.points.size() == count && piece.marks.size() == count &&
                    (piece.labels.empty() || piece.labels.size() == count);
  if (!fits || !std::is_sorted(piece.ids.begin(), piece.ids.end()) ||
      !names_vertices_of(piece.tets, count) || !names_vertices_of(piece.triangles, count) ||
      !names_vertices_of(piece.edges, count) || !names_vertices_of(piece.surface, count) ||
      !names_vertices_of(piece.lines, count)) {
    throw Error("a piece contradicts itself");
  }
  return piece;
}

namespace {

/// An array of an appended piece: where its values are, and how many.
template <class Value>
class PlacedArray {
 public:
  PlacedArray(const ReadBytes& read, std::uint64_t place) : read_(read), place_(place) {
    const std::string bytes = read(place, sizeof(count_));
    std::string_view rest = bytes;
    pieces::take(rest, count_);
  }
  std::uint64_t count() const { return count_; }
  std::uint64_t end() const { return place_ + sizeof(count_) + count_ * sizeof(Value); }
  std::vector<Value> values(std::uint64_t begin, std::uint64_t end) const {
    begin = std::min(begin, count_);
    end = std::min(end, count_);
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max() / sizeof(Value);
    if (end > kMost) throw Error("a piece ends too early");
    const std::string bytes =
        read_(place_ + sizeof(count_) + begin * sizeof(Value), (end - begin) * sizeof(Value));
    if (bytes.size() != (end - begin) * sizeof(Value)) throw Error("a piece ends too early");
    std::vector<Value> taken(end - begin);
    if (!taken.empty()) std::memcpy(static_cast<void*>(taken.data()), bytes.data(), bytes.size());
    return taken;
  }

 private:
  const ReadBytes& read_;
  std::uint64_t place_;
  std::uint64_t count_ = 0;
};

}  // namespace

std::vector<VertexId> read_ids(const ReadBytes& read) {
  const PlacedArray<VertexId> ids(read, 0);
  return ids.values(0, ids.count());
}

Piece read_vertices(const ReadBytes& read, std::uint64_t begin, std::uint64_t end) {
  const PlacedArray<VertexId> ids(read, 0);
  const PlacedArray<Point> points(read, ids.end());
  const PlacedArray<Label> labels(read, points.end());
  const PlacedArray<std::uint8_t> marks(read, labels.end());
  const bool fits = points.count() == ids.count() && marks.count() == ids.count() &&
                    (labels.count() == 0 || labels.count() == ids.count());
  if (!fits) throw Error("a piece contradicts itself");
  Piece piece;
  piece.ids = ids.values(begin, end);
  piece.points = points.values(begin, end);
  if (labels.count() > 0) piece.labels = labels.values(begin, end);
  piece.marks = marks.values(begin, end);
  return piece;
}

std::vector<char> near_marked(const Piece& piece, std::uint8_t marks, unsigned rings) {
  std::vector<char> near(piece.ids.size(), 0);
  for (std::size_t v = 0; v < near.size(); ++v) near[v] = (piece.marks[v] & marks) != 0 ? 1 : 0;
  for (unsigned ring = 0; ring < rings; ++ring) {
    const std::vector<char> inside = near;
    for (const PieceTet& tet : piece.tets) {
      const auto& t = tet.vertices;
      const bool any =
          std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return inside[v] != 0; });
      if (!any) continue;
      for (const std::uint32_t v : t) near[v] = 1;
    }
  }
  return near;
}

Piece extract(const Piece& from, const Extract& what) {
  Piece piece;
  std::vector<std::uint32_t> numbers(from.ids.size(), kGoneVertex);
  for (std::size_t v = 0; v < from.ids.size(); ++v) {
    if (what.wanted[v] == 0) continue;
    numbers[v] = static_cast<std::uint32_t>(piece.ids.size());
    piece.ids.push_back(from.ids[v]);
    piece.points.push_back(from.points[v]);
    if (!from.labels.empty()) piece.labels.push_back(from.labels[v]);
    piece.marks.push_back(from.marks[v]);
  }
  append_chosen(from.tets, what.tets, numbers, piece.tets);
  append_chosen(from.triangles, what.triangles, numbers, piece.triangles);
  append_chosen(from.edges, what.edges, numbers, piece.edges);
  append_chosen(from.surface, what.surface, numbers, piece.surface);
  append_chosen(from.lines, what.lines, numbers, piece.lines);
  return piece;
}

Piece merge(std::vector<Piece> parts) {
  Piece whole;
  bool has_labels = false;
  std::size_t tets = 0;
  for (const Piece& part : parts) {
    whole.ids.insert(whole.ids.end(), part.ids.begin(), part.ids.end());
    has_labels = has_labels || !part.labels.empty();
    tets += part.tets.size();
  }
  std::sort(whole.ids.begin(), whole.ids.end());
  whole.ids.erase(std::unique(whole.ids.begin(), whole.ids.end()), whole.ids.end());
  whole.ids.shrink_to_fit();
  const std::size_t count = whole.ids.size();
  whole.points.resize(count);
  whole.marks.resize(count, 0);
  if (has_labels) whole.labels.resize(count, 0);
  whole.tets.reserve(tets);
  std::vector<char> known(count, 0);
  for (Piece& part : parts) {
    const std::vector<std::uint32_t> places = places_of(part, whole.ids);
    take_vertices(part, places, whole, known);
    append_renumbered(part.tets, places, whole.tets);
    append_renumbered(part.triangles, places, whole.triangles);
    append_renumbered(part.edges, places, whole.edges);
    append_renumbered(part.surface, places, whole.surface);
    append_renumbered(part.lines, places, whole.lines);
    part = {};
  }
  return whole;
}

}  // namespace tetmend::pieces
