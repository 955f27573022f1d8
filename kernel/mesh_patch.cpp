// SPDX-License-Identifier: MIT
//   what must stay:  the faces around the old tets, with the tet or surface triangle behind them,
//                    and the constrained faces and edges of the old tets
//   write the slots
//   match the faces of the new tets with each other and with those around
#include "kernel/mesh_patch.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <unordered_map>

#include "kernel/in_order.h"
#include "kernel/mesh_builder.h"

namespace tetmend {

namespace {

struct FaceHash {
  std::size_t operator()(const FaceKey& key) const {
    std::uint64_t hash = key[0].index();
    for (std::size_t i = 1; i < 3; ++i) hash = (hash * 0x9E3779B97F4A7C15u) ^ key[i].index();
    return static_cast<std::size_t>(hash * 0xBF58476D1CE4E5B9u >> 16);
  }
};

}  // namespace

class MeshBuilder::Patch {
 public:
  Patch(TetMesh& mesh, const SlotContents& contents) : mesh_(mesh), contents_(contents) {}

  bool make() {
    make_room();
    for (const SlotContents::Tet& tet : contents_.tets) slots_.push_back(tet.tet);
    std::sort(slots_.begin(), slots_.end());
    for (const TetHandle t : slots_) {
      if (!mesh_.is_deleted(t)) look_around(t);
    }
    for (const SlotContents::Vertex& vertex : contents_.vertices) write(vertex);
    for (const SlotContents::Tet& tet : contents_.tets) write(tet);
    for (const SlotContents::Tet& tet : contents_.tets) {
      if (tet.vertices[0].is_valid()) match(tet.tet);
    }
    link_vertices();
    return around_.empty();
  }

  static void number_by_slots(TetMesh& mesh) {
    std::iota(mesh.vertex_origin_.begin(), mesh.vertex_origin_.end(), 0u);
  }

 private:
  /// What lies behind a face.
  struct Side {
    HalfFace behind;
    bool is_constrained = false;
  };

  void make_room() {
    std::size_t tets = mesh_.tet_slots();
    std::size_t vertices = mesh_.vertex_slots();
    for (const auto& tet : contents_.tets) tets = std::max<std::size_t>(tets, tet.tet.index() + 1);
    for (const auto& v : contents_.vertices) {
      vertices = std::max<std::size_t>(vertices, v.vertex.index() + 1);
    }
    if (tets > mesh_.tet_slots()) mesh_.grow_tets(tets - mesh_.tet_slots());
    if (vertices > mesh_.vertex_slots()) mesh_.grow_vertices(vertices - mesh_.vertex_slots());
  }

  bool is_listed(TetHandle t) const { return std::binary_search(slots_.begin(), slots_.end(), t); }

  void look_around(TetHandle t) {
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      const HalfFace twin = mesh_.twin(face);
      const bool is_constrained = mesh_.is_constrained(face);
      const bool is_inside = !twin.is_outside() && is_listed(twin.tet());
      if (is_inside && !is_constrained) continue;
      const FaceKey key = in_order(mesh_.vertices(face));
      if (is_inside) {
        constrained_.insert(key);
      } else {
        around_[key] = {twin, is_constrained};
      }
    }
    for (unsigned e = 0; e < 6; ++e) {
      const TetEdge edge(t, e);
      if (mesh_.is_constrained(edge)) edges_.insert(in_order(mesh_.vertices(edge)));
    }
    for (const VertexHandle v : mesh_.vertices(t)) loose_.push_back(v);
  }

  void write(const SlotContents::Vertex& vertex) {
    const std::size_t i = vertex.vertex.index();
    const bool was_there = !mesh_.is_deleted(vertex.vertex);
    mesh_.vertex_count_ += vertex.is_there ? 1 : 0;
    mesh_.vertex_count_ -= was_there ? 1 : 0;
    mesh_.points_[i] = vertex.is_there ? vertex.point : Point::Zero();
    mesh_.vertex_origin_[i] = static_cast<std::uint32_t>(i);
    if (was_there == vertex.is_there) return;
    mesh_.vertex_flags_[i] = vertex.is_there ? 0 : TetMesh::kVertexDeleted;
    mesh_.vertex_tet_[i] = TetHandle();
  }

  void write(const SlotContents::Tet& tet) {
    const std::size_t i = tet.tet.index();
    const bool is_there = tet.vertices[0].is_valid();
    mesh_.tet_count_ += is_there ? 1 : 0;
    mesh_.tet_count_ -= mesh_.is_deleted(tet.tet) ? 0 : 1;
    mesh_.cells_[i] = TetMesh::Cell{is_there ? tet.vertices : TetVertices(), {}};
    mesh_.label_[i] = is_there ? tet.label : 0;
    mesh_.tet_flags_[i] = 0;
    mesh_.quality_[i] = is_there ? mesh_.evaluate(tet.vertices) : TetMesh::kDeletedQuality;
  }

  void join(HalfFace face, const Side& side) {
    mesh_.cells_[face.tet().index()].neighbours[face.face()] = side.behind;
    if (!side.behind.is_outside()) {
      mesh_.cells_[side.behind.tet().index()].neighbours[side.behind.face()] = face;
    }
    if (!side.is_constrained) return;
    constrain(face);
    if (!side.behind.is_outside()) constrain(side.behind);
  }
  void constrain(HalfFace face) {
    mesh_.tet_flags_[face.tet().index()] |= static_cast<TetMesh::TetFlags>(1u << face.face());
  }

  void match(TetHandle t) {
    for (const VertexHandle v : mesh_.vertices(t)) mesh_.vertex_tet_[v.index()] = t;
    for (unsigned e = 0; !edges_.empty() && e < 6; ++e) {
      if (!edges_.contains(in_order(mesh_.vertices(TetEdge(t, e))))) continue;
      mesh_.tet_flags_[t.index()] |= static_cast<TetMesh::TetFlags>(16u << e);
    }
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      const FaceKey key = in_order(mesh_.vertices(face));
      const auto found = around_.find(key);
      if (found != around_.end()) {
        join(face, found->second);
        around_.erase(found);
        continue;
      }
      // The other tet at this face comes later.
      around_[key] = {face, constrained_.contains(key)};
    }
  }

  /// Vertices of old tets that no new one has.
  void link_vertices() {
    std::sort(loose_.begin(), loose_.end());
    loose_.erase(std::unique(loose_.begin(), loose_.end()), loose_.end());
    std::erase_if(loose_, [&](VertexHandle v) {
      const TetHandle t = mesh_.vertex_tet_[v.index()];
      return !t.is_valid() || (!mesh_.is_deleted(t) && mesh_.local_index(t, v) < 4);
    });
    if (loose_.empty()) return;
    for (const VertexHandle v : loose_) mesh_.vertex_tet_[v.index()] = TetHandle();
    for (std::uint32_t i = 0; i < mesh_.tet_slots(); ++i) {
      for (const VertexHandle v : mesh_.cells_[i].vertices) {
        if (std::binary_search(loose_.begin(), loose_.end(), v)) {
          mesh_.vertex_tet_[v.index()] = TetHandle(i);
        }
      }
    }
  }

  TetMesh& mesh_;
  const SlotContents& contents_;
  std::vector<TetHandle> slots_;  // that are listed, ascending
  std::unordered_map<FaceKey, Side, FaceHash> around_;
  std::set<FaceKey> constrained_;    // between two old tets
  std::set<EdgeKey> edges_;          // constrained ones
  std::vector<VertexHandle> loose_;  // of old tets
};

bool patch(TetMesh& mesh, const SlotContents& contents) {
  return MeshBuilder::Patch(mesh, contents).make();
}

void number_by_slots(TetMesh& mesh) {
  MeshBuilder::Patch::number_by_slots(mesh);
}

}  // namespace tetmend
