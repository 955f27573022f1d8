// SPDX-License-Identifier: MIT
// What makes TetMeshes: of plain arrays as a whole, or anew in some slots. Only for the sources of
// both.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/face_buckets.h"
#include "kernel/grouping.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

class MeshBuilder {
 public:
  MeshBuilder(MeshData&& data, TetMesh& mesh, BuildReport& report, InteriorConstraints interior,
              std::uint32_t first_number)
      : data_(std::move(data)),
        mesh_(mesh),
        report_(report),
        drops_interior_(interior == InteriorConstraints::dropped),
        first_number_(first_number) {}

  void build(bool sorted) {
    check_indices();
    mesh_.scale_ = Scale::of(data_.points);
    mesh_.scale_.to_work(data_.points);
    place_vertices(sorted);
    const FaceBuckets buckets(mesh_, place_tets(sorted));
    check_lengths();
    match_faces(buckets, orient());
    if (drops_interior_) find_border();
    build_surface(buckets);
    link_vertices();
    mark_edges();
    mark_vertices();
  }
  /// See mesh_patch.h.
  class Patch;
  /// See mesh_renewal.h.
  class Renewal;

  /// For what is known of a new mesh from before: what TetMesh::changed() says until something
  /// changes there.
  static void set_changed(TetMesh& mesh, VertexHandle v, Date date) {
    mesh.vertex_dates_[v.index()].changed = date;
  }

  /// After an Error: the data as it was.
  MeshData give_back();
  /// The file's number of each tet, by slot.
  std::vector<std::uint32_t> take_tet_numbers();

 private:
  struct Signs {
    std::size_t positive = 0;  // by the computed volume
    std::size_t negative = 0;
    std::size_t inverted = 0;  // certainly
    std::size_t flat = 0;      // or too close to tell
  };
  using Entry = FaceBuckets::Entry;

  void check_indices() const;
  void place_vertices(bool sorted);
  Grouping place_tets(bool sorted);
  void check_lengths() const;
  Signs evaluate();
  Signs evaluate(std::size_t begin, std::size_t end);
  void add_sign(std::size_t t, bool certified, Signs& signs) const;
  bool orient();
  double volume6_of_all() const;
  void match_faces(const FaceBuckets& buckets, bool has_negative);
  std::vector<std::uint32_t> match(const FaceBuckets& buckets);
  void reorder_tets();
  void check_buckets(const FaceBuckets& buckets, const std::vector<std::uint32_t>& vertices,
                     bool senses) const;
  std::pair<HalfFace, HalfFace> repeated(const std::vector<Entry>& entries, std::size_t begin,
                                         std::size_t end) const;
  void find_border();
  /// What lies between elements that are no tets stays, wherever it is.
  template <std::size_t N>
  bool are_of_others(const std::array<VertexHandle, N>& vertices) const {
    return std::all_of(vertices.begin(), vertices.end(),
                       [this](VertexHandle v) { return on_border_[v.index()] == kOfOthers; });
  }
  bool is_dropped(HalfFace f, const std::array<VertexHandle, 3>& vertices) const;
  void build_surface(const FaceBuckets& buckets);
  void add_surface_face(HalfFace f, SurfaceTriangle triangle);
  std::vector<HalfFace> unnamed_faces() const;
  void link_vertices();
  void count_unused_points();
  bool lies_on_face(TetEdge e) const;
  void mark_edges();
  void mark_vertices();

  // The file's numbers of what has a slot.
  std::uint32_t file_tet(std::size_t t) const {
    return file_tet_.empty() ? static_cast<std::uint32_t>(t) : file_tet_[t];
  }
  std::uint32_t file_code(HalfFace f) const { return 4 * file_tet(f.tet().index()) + f.face(); }
  /// The slot of the file's vertex.
  VertexHandle vertex(std::uint32_t number) const {
    return VertexHandle(slot_of_.empty() ? number : slot_of_[number]);
  }
  void swap_orientation(std::size_t t) {
    std::swap(mesh_.cells_[t].vertices[2], mesh_.cells_[t].vertices[3]);
  }
  std::string missing_point(std::uint64_t number) const {
    return fmt::format("no point {}, there are {}", number + first_number_, data_.points.size());
  }
  double tet_volume6(std::size_t t) const {
    const TetVertices& v = mesh_.cells_[t].vertices;
    return volume6(mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2]), mesh_.point(v[3]));
  }
  /// As the file lists them, counted from 0.
  std::array<std::uint32_t, 4> file_vertices(std::size_t t) const {
    TetVertices v = mesh_.cells_[t].vertices;
    if (report_.mirrored != (!swapped_.empty() && swapped_[t] != 0)) std::swap(v[2], v[3]);
    const auto number = [&](unsigned i) { return mesh_.vertex_origin_[v[i].index()]; };
    return {number(0), number(1), number(2), number(3)};
  }
  std::string describe(std::size_t t) const { return describe(file_tet(t), file_vertices(t)); }
  std::string describe(std::size_t number, const std::array<std::uint32_t, 4>& vertices) const {
    const auto counted = [this](std::uint64_t i) { return i + first_number_; };
    return fmt::format("tet {} (vertices {} {} {} {})", counted(number), counted(vertices[0]),
                       counted(vertices[1]), counted(vertices[2]), counted(vertices[3]));
  }

  MeshData data_;
  TetMesh& mesh_;
  BuildReport& report_;
  const bool drops_interior_;
  const std::uint32_t first_number_;  // from which messages count
  // By vertex slot, see find_border(); empty unless interior constraints are dropped.
  std::vector<char> on_border_;
  static constexpr char kOfOthers = 2;   // in it: of an element that is no tet
  std::vector<std::uint32_t> slot_of_;   // by the file's vertex number; empty: the same
  std::vector<std::uint32_t> file_tet_;  // by slot; empty: the same
  std::vector<char> swapped_;            // single tets that were corrected; empty: none
};

}  // namespace tetmend
