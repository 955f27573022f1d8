// SPDX-License-Identifier: MIT
// Numbers, dates and flags of a mesh as if it were new; other places for its points.
#include "kernel/mesh_renewal.h"

#include <cstdint>
#include <vector>

#include "kernel/chunks.h"
#include "kernel/mesh_builder.h"
#include "kernel/mesh_view.h"

namespace tetmend {

class MeshBuilder::Renewal {
 public:
  explicit Renewal(TetMesh& mesh) : mesh_(mesh) {}

  void count_as_new() {
    mesh_.collect_garbage();
    const MeshView view(mesh_);
    std::vector<Label> labels;
    for (std::size_t i = 0; view.has_point_labels() && i < view.point_count(); ++i) {
      labels.push_back(view.point_label(i));
    }
    for (std::uint32_t i = 0; i < view.point_count(); ++i) {
      mesh_.vertex_origin_[view.vertex_slots()[i]] = i;
    }
    mesh_.point_labels_ = std::move(labels);
    mesh_.vertex_dates_.assign(mesh_.vertex_dates_.size(), {});
    constexpr auto kOfRuns =
        static_cast<TetMesh::TetFlags>(TetMesh::kTetTouched | TetMesh::kTetCreated);
    for (TetMesh::TetFlags& flags : mesh_.tet_flags_) {
      flags &= static_cast<TetMesh::TetFlags>(~kOfRuns);
    }
  }

  std::size_t place(std::span<const std::array<double, 3>> points) {
    const std::vector<Point> old = mesh_.points_;
    for_chunks(old.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto& [x, y, z] = points[mesh_.vertex_origin_[i]];
        mesh_.points_[i] = mesh_.scale_.to_work(Point(x, y, z));
      }
    });
    const std::size_t turned =
        count_in_chunks(mesh_.cells_.size(), [&](std::size_t begin, std::size_t end) {
          std::size_t count = 0;
          for (std::size_t i = begin; i < end; ++i) count += turns_over(i, old) ? 1 : 0;
          return count;
        });
    if (turned > 0) {
      mesh_.points_ = old;
      return turned;
    }
    for_chunks(mesh_.cells_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        mesh_.quality_[i] = mesh_.evaluate(mesh_.cells_[i].vertices);
      }
    });
    return 0;
  }

  void hold(const std::function<bool(VertexHandle)>& stays) {
    for (std::uint32_t i = 0; i < mesh_.vertex_flags_.size(); ++i) {
      TetMesh::VertexFlags& flags = mesh_.vertex_flags_[i];
      flags &= static_cast<TetMesh::VertexFlags>(~TetMesh::kVertexFrozen);
      const VertexHandle v(i);
      if (stays && !mesh_.is_deleted(v) && stays(v)) flags |= TetMesh::kVertexFrozen;
    }
    for (std::uint32_t i = 0; i < mesh_.cells_.size(); ++i) {
      const TetHandle t(i);
      if (mesh_.is_deleted(t) || !mesh_.is_frozen(t)) continue;
      for (const VertexHandle v : mesh_.vertices(t)) {
        mesh_.vertex_flags_[v.index()] |= TetMesh::kVertexFrozen;
      }
    }
  }

 private:
  bool turns_over(std::size_t tet, const std::vector<Point>& old) const {
    const TetVertices& v = mesh_.cells_[tet].vertices;
    return !mesh_.is_certified_positive(v) &&
           certified_positive(old[v[0].index()], old[v[1].index()], old[v[2].index()],
                              old[v[3].index()]);
  }

  TetMesh& mesh_;
};

void count_as_new(TetMesh& mesh) {
  MeshBuilder::Renewal(mesh).count_as_new();
}

std::size_t place_points(TetMesh& mesh, std::span<const std::array<double, 3>> points) {
  return MeshBuilder::Renewal(mesh).place(points);
}

void hold(TetMesh& mesh, const std::function<bool(VertexHandle)>& stays) {
  MeshBuilder::Renewal(mesh).hold(stays);
}

}  // namespace tetmend
