// SPDX-License-Identifier: MIT
// Walks from tet to tet that return values.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "face/kernel/tet_mesh.h"
#include "kernel/ring_walk.h"
#include "kernel/shell.h"
#include "kernel/star.h"
#include "kernel/workspace.h"

namespace tetmend::kernel {

namespace {

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
  return tetmend::link(mesh_, v);
}

Star TetMesh::star(VertexHandle v) const {
  is_known(v, "star");
  return tetmend::star(mesh_, v);
}

OneRing TetMesh::one_ring(VertexHandle v) const {
  is_known(v, "one_ring");
  return tetmend::one_ring(mesh_, v);
}

Ring TetMesh::ring(TetEdge e) const {
  is_known(e.tet(), "ring");
  return tetmend::ring(mesh_, e);
}

Rows<VertexHandle> TetMesh::one_rings() const {
  return rows_of<VertexHandle>(mesh_, [this](VertexHandle v, std::vector<VertexHandle>& values) {
    const OneRing ring = tetmend::one_ring(mesh_, v);
    values.insert(values.end(), ring.begin(), ring.end());
  });
}

Rows<TetHandle> TetMesh::stars() const {
  return rows_of<TetHandle>(mesh_, [this](VertexHandle v, std::vector<TetHandle>& values) {
    for (const HalfFace f : tetmend::link(mesh_, v)) values.push_back(f.tet());
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
      ring_walk::visit_around(mesh_, e, [&, a = a, b = b](TetHandle around) {
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
  for (const HalfFace f : tetmend::link(mesh_, a)) {
    const unsigned i = mesh_.local_index(f.tet(), b);
    if (i != 4 && i != f.face()) return TetEdge(f.tet(), kEdgeOf[f.face()][i]);
  }
  return std::nullopt;
}

std::optional<HalfFace> TetMesh::find_face(VertexHandle a, VertexHandle b, VertexHandle c) const {
  for (const VertexHandle v : {a, b, c}) is_known(v, "find_face");
  for (const HalfFace f : tetmend::link(mesh_, a)) {
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
  for (const HalfFace f : tetmend::link(mesh_, a)) {
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
