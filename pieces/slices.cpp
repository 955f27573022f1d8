// SPDX-License-Identifier: MIT
#include "pieces/slices.h"

#include <algorithm>
#include <utility>

#include <tetmend/improve.h>

#include "envelope/kept_points.h"

namespace tetmend::pieces {

namespace {

/// A range of `count` things for slice `i` of `slices`.
struct Range {
  Range(std::size_t count, std::size_t i, std::size_t slices)
      : begin(count * i / slices), end(count * (i + 1) / slices) {}
  std::size_t begin, end;
};

template <class Element>
void take_range(const std::vector<Element>& from, const Range& range, std::vector<Element>& to) {
  to.assign(from.begin() + static_cast<std::ptrdiff_t>(range.begin),
            from.begin() + static_cast<std::ptrdiff_t>(range.end));
}

template <class Element>
void note_vertices(const std::vector<Element>& elements, std::vector<char>& used) {
  for (const Element& element : elements) {
    for (const std::uint32_t v : element.vertices) used[v] = 1;
  }
}

template <class Element>
void renumber(std::vector<Element>& elements, const std::vector<std::uint32_t>& numbers) {
  for (Element& element : elements) {
    for (std::uint32_t& v : element.vertices) v = numbers[v];
  }
}

void take_tets(const MeshData& data, std::span<const char> is_protected, const Range& range,
               Piece& slice) {
  slice.tets.reserve(range.end - range.begin);
  for (std::size_t i = range.begin; i < range.end; ++i) {
    PieceTet tet{data.tets[i].vertices, data.tets[i].label, static_cast<std::uint32_t>(i)};
    if (!is_protected.empty() && is_protected[i] != 0) tet.origin |= PieceTet::kProtected;
    slice.tets.push_back(tet);
  }
}

}  // namespace

void add_slices(const MeshData& data, std::span<const char> is_protected, DividedMesh& to,
                std::span<const char> is_kept) {
  const std::size_t slices = 1 + data.tets.size() / kTetsOfSlice;
  std::vector<char> required(data.points.size(), 0);
  for (const std::uint32_t v : data.required_vertices) required[v] = 1;
  std::vector<std::uint32_t> numbers(data.points.size());
  for (std::size_t i = 0; i < slices; ++i) {
    Piece slice;
    take_tets(data, is_protected, Range(data.tets.size(), i, slices), slice);
    take_range(data.triangles, Range(data.triangles.size(), i, slices), slice.triangles);
    take_range(data.edges, Range(data.edges.size(), i, slices), slice.edges);
    const Range own(data.points.size(), i, slices);
    std::vector<char> used(data.points.size(), 0);
    std::fill(used.begin() + static_cast<std::ptrdiff_t>(own.begin),
              used.begin() + static_cast<std::ptrdiff_t>(own.end), 1);
    note_vertices(slice.tets, used);
    note_vertices(slice.triangles, used);
    note_vertices(slice.edges, used);
    for (std::size_t v = 0; v < used.size(); ++v) {
      if (used[v] == 0) continue;
      numbers[v] = static_cast<std::uint32_t>(slice.ids.size());
      slice.ids.push_back(v);
      slice.points.push_back(data.points[v]);
      if (!data.point_labels.empty()) slice.labels.push_back(data.point_labels[v]);
      const unsigned is_own = v >= own.begin && v < own.end ? kOwn : 0U;
      const char kept = is_kept.empty() ? char{0} : is_kept[v];
      const unsigned stays = kept == 0            ? 0U
                             : kept == kHeldPoint ? unsigned{kCorner | kHeld}
                                                  : unsigned{kCorner};
      slice.marks.push_back(
          static_cast<std::uint8_t>(is_own | stays | (required[v] != 0 ? kRequired : 0U)));
    }
    renumber(slice.tets, numbers);
    renumber(slice.triangles, numbers);
    renumber(slice.edges, numbers);
    to.add_slice(i, slice);
  }
}

namespace {

/// The vertices of all pieces by id.
class Vertices {
 public:
  void add(const Piece& piece) {
    for (std::size_t v = 0; v < piece.ids.size(); ++v) {
      if ((piece.marks[v] & kOwn) == 0) continue;
      all_.push_back({piece.ids[v], piece.points[v], piece.label(v), piece.marks[v]});
    }
  }
  void sort() {
    std::sort(all_.begin(), all_.end(),
              [](const Vertex& a, const Vertex& b) { return a.id < b.id; });
  }
  std::uint32_t number(VertexId id) const {
    const auto found =
        std::lower_bound(all_.begin(), all_.end(), id,
                         [](const Vertex& vertex, VertexId other) { return vertex.id < other; });
    if (found == all_.end() || found->id != id) {
      throw Error("pieces do not fit: a vertex belongs to none");
    }
    return static_cast<std::uint32_t>(found - all_.begin());
  }
  void write(VertexId first, std::size_t in_file, Joined& joined) {
    MeshData& data = joined.data;
    const bool has_labels =
        std::any_of(all_.begin(), all_.end(), [](const Vertex& v) { return v.label != 0; });
    for (const Vertex& vertex : all_) {
      if ((vertex.marks & kRequired) != 0) {
        data.required_vertices.push_back(static_cast<std::uint32_t>(data.points.size()));
      }
      data.points.push_back(vertex.point);
      if (has_labels) data.point_labels.push_back(vertex.label);
      const VertexId number = vertex.id - first;
      joined.vertex_origins.push_back(number < in_file ? static_cast<std::uint32_t>(number)
                                                       : kGone);
    }
    all_ = {};
  }

 private:
  struct Vertex {
    VertexId id;
    Point point;
    Label label;
    std::uint8_t marks;
  };
  std::vector<Vertex> all_;
};

}  // namespace

Joined join(const DividedMesh& mesh, std::size_t vertices) {
  Joined joined;
  Vertices all;
  const std::size_t pieces = mesh.state().stored;
  for (std::size_t i = 0; i < pieces; ++i) all.add(mesh.stored_vertices(i));
  all.sort();
  for (std::size_t i = 0; i < pieces; ++i) {
    Piece piece = mesh.stored(i);
    std::vector<std::uint32_t> numbers(piece.ids.size());
    for (std::size_t v = 0; v < numbers.size(); ++v) numbers[v] = all.number(piece.ids[v]);
    renumber(piece.tets, numbers);
    renumber(piece.triangles, numbers);
    renumber(piece.edges, numbers);
    for (const PieceTet& tet : piece.tets) {
      joined.data.tets.push_back({tet.vertices, tet.label});
      joined.tet_origins.push_back(tet.origin & ~PieceTet::kProtected);
      joined.is_protected.push_back(tet.is_protected() ? 1 : 0);
    }
    MeshData& data = joined.data;
    data.triangles.insert(data.triangles.end(), piece.triangles.begin(), piece.triangles.end());
    data.edges.insert(data.edges.end(), piece.edges.begin(), piece.edges.end());
  }
  all.write(mesh.state().first_id, vertices, joined);
  return joined;
}

Maps maps_of(const Joined& joined, std::size_t vertices, std::size_t tets) {
  Maps maps{std::vector<std::uint32_t>(vertices, kGone), std::vector<std::uint32_t>(tets, kGone)};
  for (std::uint32_t v = 0; v < joined.vertex_origins.size(); ++v) {
    if (joined.vertex_origins[v] != kGone) maps.vertices[joined.vertex_origins[v]] = v;
  }
  for (std::uint32_t t = 0; t < joined.tet_origins.size(); ++t) {
    if (joined.tet_origins[t] != PieceTet::kNone) maps.tets[joined.tet_origins[t]] = t;
  }
  return maps;
}

}  // namespace tetmend::pieces
