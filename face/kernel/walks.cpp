// SPDX-License-Identifier: MIT
// Walks from tet to tet that return values.
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "face/kernel/tet_mesh.h"

namespace tetmend::kernel {

namespace {

/// A set of numbers that lies on the stack while it is small, as those of a star are.
class Seen {
 public:
  Seen() { small_.fill(kNone); }

  /// True if it was not there.
  bool insert(std::uint32_t number) {
    if (2 * (size_ + 1) > table_.size()) grow();
    std::size_t i = home(number);
    for (; table_[i] != kNone; i = (i + 1) & (table_.size() - 1)) {
      if (table_[i] == number) return false;
    }
    table_[i] = number;
    ++size_;
    return true;
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::size_t home(std::uint32_t number) const { return (number * 0x9E3779B1u) >> shift_; }
  void grow() {
    const std::vector<std::uint32_t> old(table_.begin(), table_.end());
    large_.assign(2 * old.size(), kNone);
    table_ = large_;
    --shift_;
    size_ = 0;
    for (const std::uint32_t number : old) {
      if (number != kNone) insert(number);
    }
  }

  std::array<std::uint32_t, 128> small_{};
  std::vector<std::uint32_t> large_;
  std::span<std::uint32_t> table_ = small_;
  unsigned shift_ = 25;  // 32 less the digits of the table's size
  std::size_t size_ = 0;
};

/// Spreads from the stored tet of a vertex through faces.
Link walk_link(const tetmend::TetMesh& mesh, VertexHandle v) {
  Link link;
  const TetHandle first = mesh.tet_of(v);
  if (!first.is_valid()) return link;
  Seen seen;
  seen.insert(first.index());
  link.push_back(HalfFace(first, mesh.local_index(first, v)));
  for (std::size_t i = 0; i < link.size(); ++i) {
    const HalfFace opposite = link[i];
    const std::array<HalfFace, 4>& neighbours = mesh.neighbours(opposite.tet());
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace twin = neighbours[f];
      if (f == opposite.face() || twin.is_outside() || !seen.insert(twin.tet().index())) continue;
      link.push_back(HalfFace(twin.tet(), mesh.local_index(twin.tet(), v)));
      for (const HalfFace next : mesh.neighbours(twin.tet())) {
        if (!next.is_outside()) mesh.prefetch(next.tet());
      }
    }
  }
  return link;
}

OneRing walk_one_ring(const tetmend::TetMesh& mesh, VertexHandle v) {
  OneRing ring;
  Seen seen;
  for (const HalfFace f : walk_link(mesh, v)) {
    for (const VertexHandle w : mesh.vertices(f)) {
      if (seen.insert(w.index())) ring.push_back(w);
    }
  }
  return ring;
}

/// The tet at hand of a walk around an edge: (a, b, from, to), positive.
struct Turn {
  TetHandle tet;
  VertexHandle from;
  VertexHandle to;
};

Turn first_turn(const tetmend::TetMesh& mesh, TetEdge e) {
  // Edge 5 - e joins the other two; an even permutation of (0, 1, 2, 3) keeps the sign.
  static constexpr std::array<bool, 6> kIsEven = {true, false, true, true, false, true};
  const TetVertices& v = mesh.vertices(e.tet());
  const auto& other = kEdgeVertices[5 - e.edge()];
  const bool is_even = kIsEven[e.edge()];
  return {e.tet(), v[other[is_even ? 0 : 1]], v[other[is_even ? 1 : 0]]};
}

/// To the tet behind the face opposite `from`; false at the boundary.
bool step(const tetmend::TetMesh& mesh, Turn& turn) {
  const HalfFace next = mesh.twin(HalfFace(turn.tet, mesh.local_index(turn.tet, turn.from)));
  if (next.is_outside()) return false;
  turn = {next.tet(), turn.to, mesh.vertices(next.tet())[next.face()]};
  return true;
}

/// The other way round.
bool step_back(const tetmend::TetMesh& mesh, Turn& turn) {
  const HalfFace next = mesh.twin(HalfFace(turn.tet, mesh.local_index(turn.tet, turn.to)));
  if (next.is_outside()) return false;
  turn = {next.tet(), mesh.vertices(next.tet())[next.face()], turn.from};
  return true;
}

/// Calls visit(tet) for the tets around an edge, in no particular order.
template <class Visit>
void visit_around(const tetmend::TetMesh& mesh, TetEdge e, const Visit& visit) {
  const Turn first = first_turn(mesh, e);
  Turn turn = first;
  do {
    visit(turn.tet);
    if (step(mesh, turn)) continue;
    turn = first;
    while (step_back(mesh, turn)) visit(turn.tet);
    return;
  } while (turn.tet != first.tet);
}

template <class T, class Walk>
Rows<T> rows_of(const tetmend::TetMesh& mesh, const Walk& walk) {
  Rows<T> rows;
  rows.begin.reserve(mesh.vertex_slots() + 1);
  rows.begin.push_back(0);
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    walk(VertexHandle(i), rows.values);
    rows.begin.push_back(rows.values.size());
  }
  return rows;
}

}  // namespace

Link TetMesh::link(VertexHandle v) const {
  is_known(v, "link");
  return walk_link(mesh_, v);
}

Star TetMesh::star(VertexHandle v) const {
  is_known(v, "star");
  Star star;
  for (const HalfFace f : walk_link(mesh_, v)) star.push_back(f.tet());
  return star;
}

OneRing TetMesh::one_ring(VertexHandle v) const {
  is_known(v, "one_ring");
  return walk_one_ring(mesh_, v);
}

Ring TetMesh::ring(TetEdge e) const {
  is_known(e.tet(), "ring");
  Ring ring;
  if (mesh_.is_deleted(e.tet())) return ring;
  const auto [a, b] = mesh_.vertices(e);
  ring.a = a;
  ring.b = b;
  Turn turn = first_turn(mesh_, e);
  // An open ring begins at the boundary.
  while (step_back(mesh_, turn) && turn.tet != e.tet()) {
  }
  const TetHandle first = turn.tet;
  do {
    ring.tets.push_back(turn.tet);
    ring.vertices.push_back(turn.from);
    if (step(mesh_, turn)) continue;
    ring.vertices.push_back(turn.to);
    return ring;
  } while (turn.tet != first);
  ring.closed = true;
  return ring;
}

Rows<VertexHandle> TetMesh::one_rings() const {
  return rows_of<VertexHandle>(mesh_, [this](VertexHandle v, std::vector<VertexHandle>& values) {
    const OneRing ring = walk_one_ring(mesh_, v);
    values.insert(values.end(), ring.begin(), ring.end());
  });
}

Rows<TetHandle> TetMesh::stars() const {
  return rows_of<TetHandle>(mesh_, [this](VertexHandle v, std::vector<TetHandle>& values) {
    for (const HalfFace f : walk_link(mesh_, v)) values.push_back(f.tet());
  });
}

Edges TetMesh::edges() const {
  std::vector<Edges::Entry> entries;
  entries.reserve(mesh_.tet_count() + mesh_.tet_count() / 2);
  std::vector<std::uint8_t> seen(mesh_.tet_slots(), 0);  // a bit for each edge of a tet
  for (const TetHandle t : tets()) {
    for (const TetEdge e : edges(t)) {
      if ((seen[t.index()] >> e.edge() & 1u) != 0) continue;
      const auto [a, b] = mesh_.vertices(e);
      entries.push_back({a, b, e});
      visit_around(mesh_, e, [&, a = a, b = b](TetHandle around) {
        const unsigned edge = kEdgeOf[mesh_.local_index(around, a)][mesh_.local_index(around, b)];
        seen[around.index()] = static_cast<std::uint8_t>(seen[around.index()] | 1u << edge);
      });
    }
  }
  return {*this, std::move(entries)};
}

std::optional<TetEdge> TetMesh::find_edge(VertexHandle a, VertexHandle b) const {
  is_known(a, "find_edge");
  is_known(b, "find_edge");
  for (const HalfFace f : walk_link(mesh_, a)) {
    const unsigned i = mesh_.local_index(f.tet(), b);
    if (i != 4 && i != f.face()) return TetEdge(f.tet(), kEdgeOf[f.face()][i]);
  }
  return std::nullopt;
}

std::optional<HalfFace> TetMesh::find_face(VertexHandle a, VertexHandle b, VertexHandle c) const {
  for (const VertexHandle v : {a, b, c}) is_known(v, "find_face");
  for (const HalfFace f : walk_link(mesh_, a)) {
    const TetHandle t = f.tet();
    if (mesh_.local_index(t, b) == 4 || mesh_.local_index(t, c) == 4) continue;
    for (const HalfFace face : faces(t)) {
      std::array<VertexHandle, 3> v = mesh_.vertices(face);
      const auto first = std::find(v.begin(), v.end(), a);
      if (first == v.end()) continue;
      std::rotate(v.begin(), first, v.end());
      if (v[1] == b && v[2] == c) return face;
    }
  }
  return std::nullopt;
}

std::optional<TetHandle> TetMesh::find_tet(VertexHandle a, VertexHandle b, VertexHandle c,
                                           VertexHandle d) const {
  for (const VertexHandle v : {a, b, c, d}) is_known(v, "find_tet");
  for (const HalfFace f : walk_link(mesh_, a)) {
    const TetHandle t = f.tet();
    const std::array<VertexHandle, 4> wanted = {a, b, c, d};
    // Four that differ are all of a tet that has them.
    const bool has_all = std::all_of(wanted.begin(), wanted.end(), [&](VertexHandle v) {
      return mesh_.local_index(t, v) != 4 && std::count(wanted.begin(), wanted.end(), v) == 1;
    });
    if (has_all) return t;
  }
  return std::nullopt;
}

}  // namespace tetmend::kernel
