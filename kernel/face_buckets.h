// SPDX-License-Identifier: MIT
// The faces of all tets, found by their smallest vertex: how neighbours are matched.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "kernel/grouping.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

/// Of the four faces of a tet, three have its smallest vertex as their smallest, and the fourth its
/// second smallest. So two lists of tets, by these two vertices, stand for all faces: 4 to 8 bytes
/// a tet.
class FaceBuckets {
 public:
  /// One side of a face in the bucket of its smallest vertex.
  struct Entry {
    std::uint32_t low;  ///< of the other two vertices
    std::uint32_t high;
    HalfFace face;
    bool even;  ///< the tet lists (smallest, low, high) counterclockwise as seen from outside

    bool same_face(const Entry& other) const { return low == other.low && high == other.high; }
  };

  /// @param by_smallest tets by their smallest vertex; an empty order stands for 0, 1, 2, ...
  FaceBuckets(const TetMesh& mesh, Grouping by_smallest);

  /// Calls visit(Entry) for each face of which v is the smallest vertex.
  template <class Visit>
  void visit(std::uint32_t v, const Visit& visit) const {
    for (std::uint32_t i = by_smallest_.begin[v]; i < by_smallest_.begin[v + 1]; ++i) {
      const TetHandle t = tet_at(i);
      const unsigned at = mesh_.local_index(t, VertexHandle(v));
      for (unsigned f = 0; f < 4; ++f) {
        if (f != at) visit(entry(t, f, at));
      }
    }
    for (const std::uint32_t i : by_second_.group(v)) {
      const TetHandle t(i);
      visit(entry(t, smallest_of(t), mesh_.local_index(t, VertexHandle(v))));
    }
  }
  /// At least as many faces as visit() will show.
  std::size_t bound(std::uint32_t v) const {
    return 3 * std::size_t{by_smallest_.begin[v + 1] - by_smallest_.begin[v]} +
           by_second_.group(v).size();
  }
  /// A side of the face of these vertices; invalid if no tet has it.
  HalfFace find(std::array<std::uint32_t, 3> vertices) const;

 private:
  TetHandle tet_at(std::uint32_t i) const {
    return TetHandle(by_smallest_.order.empty() ? i : by_smallest_.order[i]);
  }
  unsigned smallest_of(TetHandle t) const {
    const TetVertices& v = mesh_.vertices(t);
    const unsigned a = v[1] < v[0] ? 1 : 0;
    const unsigned b = v[3] < v[2] ? 3 : 2;
    return v[b] < v[a] ? b : a;
  }
  /// Face f, of which local vertex `at` is the smallest.
  Entry entry(TetHandle t, unsigned f, unsigned at) const {
    const auto& [second, third] = kOthers[f][at];
    const TetVertices& v = mesh_.vertices(t);
    const std::uint32_t a = v[second].index();
    const std::uint32_t b = v[third].index();
    return {std::min(a, b), std::max(a, b), HalfFace(t, f), a < b};
  }

  /// kOthers[f][i]: the vertices that follow vertex i around face f.
  static constexpr auto kOthers = [] {
    std::array<std::array<std::array<std::uint8_t, 2>, 4>, 4> others{};
    for (unsigned f = 0; f < 4; ++f) {
      for (unsigned i = 0; i < 3; ++i) {
        others[f][kFaceVertices[f][i]] = {kFaceVertices[f][(i + 1) % 3],
                                          kFaceVertices[f][(i + 2) % 3]};
      }
    }
    return others;
  }();

  const TetMesh& mesh_;
  Grouping by_smallest_;
  Grouping by_second_;
};

/// Finds pairs of sides that coincide, and faces with more sides than that.
class FacePairs {
 public:
  /// Empties the table and makes room for `faces`.
  void begin(std::size_t faces) {
    std::size_t size = 64;
    while (size < 2 * faces) size *= 2;
    if (size > keys_.size()) {
      keys_.resize(size);
      sides_.resize(size);
    }
    mask_ = size - 1;
    std::fill_n(keys_.begin(), size, kNone);
  }
  enum class Found { first, second, third };
  struct Side {
    HalfFace face;
    bool even = false;
  };
  /// Adds a side; `other` becomes its counterpart if it is the second of its face.
  Found add(const FaceBuckets::Entry& entry, Side& other) {
    const std::uint64_t key = std::uint64_t{entry.high} << 32 | entry.low;
    std::size_t i = (key * 0x9E3779B97F4A7C15ull >> 40) & mask_;
    while (keys_[i] != kNone && keys_[i] != key) i = (i + 1) & mask_;
    if (keys_[i] == kNone) {
      keys_[i] = key;
      sides_[i] = {entry.face, entry.even};
      return Found::first;
    }
    if (sides_[i].face == HalfFace()) return Found::third;
    other = sides_[i];
    sides_[i] = {};  // paired
    return Found::second;
  }

 private:
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};  // no face: it is no vertex's number

  std::vector<std::uint64_t> keys_;  // of the two vertices that are not the smallest
  std::vector<Side> sides_;
  std::size_t mask_ = 0;
};

}  // namespace tetmend
