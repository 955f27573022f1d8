// SPDX-License-Identifier: MIT
// A mesh as a file lists it, without a copy of it: what writers print.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/mesh_data.h"
#include "kernel/scale.h"

namespace tetmend {

class TetMesh;
namespace formats {
class PendingFile;
}

/// Looks at a MeshData, or at a TetMesh as to_data() would give it. Tets come in blocks, so that
/// large meshes can be written piece by piece. The mesh must outlive the view and not change
/// meanwhile. All member functions may be called from several threads.
class MeshView {
 public:
  explicit MeshView(const MeshData& data);
  /// Cost: linear in the number of vertices; takes 8 bytes a vertex, and copies of the named
  /// triangles and edges.
  explicit MeshView(const TetMesh& mesh);

  /// The data that it looks at, with all that a file may hold besides; null for a TetMesh.
  const MeshData* data() const { return data_; }

  /// How a format that can be written in several ways is to be written; empty: as it likes.
  std::string_view variant() const {
    if (!variant_.empty() || data_ == nullptr) return variant_;
    return data_->variant;
  }
  void set_variant(std::string_view variant) { variant_ = variant; }

  /// Files that are to appear together with that of the mesh. Called once, when the mesh is complete
  /// under a temporary name; what it throws leaves all older files as they were.
  using Companions = std::function<std::vector<formats::PendingFile*>()>;
  void set_companions(Companions companions) { companions_ = std::move(companions); }
  /// Empty: the mesh appears alone.
  const Companions& companions() const { return companions_; }

  std::size_t point_count() const { return point_count_; }
  Point point(std::size_t i) const {
    return scale_.to_file(points_[order_.empty() ? i : order_[i]]);
  }
  /// Of a TetMesh: the slots of its vertices in the order of this list.
  std::span<const std::uint32_t> vertex_slots() const { return order_; }
  bool has_point_labels() const { return !point_labels_.empty(); }
  Label point_label(std::size_t i) const { return has_point_labels() ? point_labels_[i] : 0; }

  std::size_t tet_count() const { return first_tet_.back(); }
  std::size_t tet_blocks() const { return first_tet_.size() - 1; }
  /// Number of the first tet of a block.
  std::size_t first_tet(std::size_t block) const { return first_tet_[block]; }
  /// The tets of a block. `buffer` may be used to hold them.
  std::span<const MeshData::Tet> tets(std::size_t block, std::vector<MeshData::Tet>& buffer) const;

  std::span<const MeshData::Triangle> triangles() const { return triangles_; }
  std::span<const MeshData::Edge> edges() const { return edges_; }
  std::span<const std::uint32_t> required_vertices() const { return required_vertices_; }

 private:
  void order_vertices();
  void number_tets();
  void collect_named();

  std::string_view variant_;
  Companions companions_;
  const MeshData* data_ = nullptr;  // one of the two
  const TetMesh* mesh_ = nullptr;
  std::size_t point_count_ = 0;
  std::span<const Point> points_;
  Scale scale_;
  std::span<const Label> point_labels_;
  std::span<const MeshData::Triangle> triangles_;
  std::span<const MeshData::Edge> edges_;
  std::span<const std::uint32_t> required_vertices_;
  std::vector<std::size_t> first_tet_;  // of each block, then the number of tets

  // Of a TetMesh only: slots of the vertices as they are listed (empty: 0, 1, 2, ...), and so on.
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> number_;  // by slot, the inverse
  std::vector<Label> own_point_labels_;
  std::vector<MeshData::Triangle> own_triangles_;
  std::vector<MeshData::Edge> own_edges_;
  std::vector<std::uint32_t> own_required_vertices_;
};

}  // namespace tetmend
