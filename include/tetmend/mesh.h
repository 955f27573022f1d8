// SPDX-License-Identifier: MIT
// A user's mesh: points, tets, labels and what else the file formats carry.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <tetmend/data.h>
#include <tetmend/error.h>

namespace tetmend {

/// A mesh as plain arrays. Vertices are numbered from 0, in the order of `points`. An array of
/// labels has one for each entity, or none: then all labels are 0.
struct MeshArrays {
  std::vector<std::array<double, 3>> points = {};       ///< coordinates
  std::vector<std::int32_t> point_labels = {};          ///< carried along
  std::vector<std::array<std::uint32_t, 4>> tets = {};  ///< either way round
  std::vector<std::int32_t> tet_labels = {};            ///< regions; faces between two stay
  /// Triangles and edges with a name: of the boundary, between two regions, or inside one. They are
  /// constraints: all of them are there afterwards.
  std::vector<std::array<std::uint32_t, 3>> triangles = {};
  std::vector<std::int32_t> triangle_labels = {};        ///< carried along
  std::vector<std::array<std::uint32_t, 2>> edges = {};  ///< constraints like `triangles`
  std::vector<std::int32_t> edge_labels = {};            ///< carried along
  std::vector<std::uint32_t> required_vertices = {};     ///< must neither move nor vanish

  /// Comes over to the improved mesh: linearly in the old mesh, integers from the nearest vertex.
  std::vector<DataArray> point_data = {};
  /// Comes over from the old tet at the centroid, or see Options::conserve.
  std::vector<DataArray> tet_data = {};
  std::vector<DataArray> triangle_data = {};  ///< carried along
  std::vector<DataArray> edge_data = {};      ///< carried along
  /// Like labels, but only to tell apart what groups tell apart: one for each tet, or none. A face
  /// between two parts stays.
  std::vector<std::int32_t> tet_parts = {};
  std::vector<std::int32_t> triangle_parts = {};  ///< likewise
  std::vector<std::int32_t> edge_parts = {};      ///< likewise
  std::vector<Group> groups = {};                 ///< named sets of points and elements
  /// Of a mesh of second order: {end, end, node} of each edge of its tets, in any order. The node is
  /// a point that no tet has for a vertex, in the middle of the edge or beside it. Triangles and edges
  /// all of whose edges are named here are of second order, too.
  std::vector<std::array<std::uint32_t, 3>> mid_nodes = {};
};

/// A mesh, as it was loaded, made of arrays, or improved. Its coordinates are finite and its
/// vertex numbers in range; whether its topology is sound shows when it is improved or measured.
///
/// Reading from several threads at once is safe. What was moved from is an empty mesh.
class TETMEND_API Mesh {
 public:
  /// An empty mesh.
  Mesh();
  /// Move the arrays in where they are not needed any more.
  /// @throws Error when a coordinate is NaN or infinite, when a vertex number is out of range or
  /// twice in an element, when an array of labels, parts or data has another length than its
  /// entities, when a group contradicts itself, or when mid-side nodes do: each edge of a tet has one
  /// or none has. The message begins with the place: "tets[7]: ",
  /// counted from 0.
  explicit Mesh(MeshArrays arrays);
  ~Mesh();
  /// A copy takes as much memory as the mesh.
  Mesh(const Mesh& other);
  /// The other mesh is empty then.
  Mesh(Mesh&& other) noexcept;
  /// As the copy.
  Mesh& operator=(const Mesh& other);
  /// As the move.
  Mesh& operator=(Mesh&& other) noexcept;

  std::size_t point_count() const;     ///< also of points of no tet
  std::size_t tet_count() const;       ///< without making arrays
  std::size_t triangle_count() const;  ///< those with a name
  std::size_t edge_count() const;      ///< those with a name

  // The arrays, contiguous, valid until the mesh changes. The first call of any of these copies
  // them out of the form in which the library works, once: 24 bytes a point and 20 a tet.

  /// Coordinates of each vertex.
  std::span<const std::array<double, 3>> points() const;
  /// Four vertices of each tet.
  std::span<const std::array<std::uint32_t, 4>> tets() const;
  /// Triangles with a name.
  std::span<const std::array<std::uint32_t, 3>> triangles() const;
  /// Edges with a name.
  std::span<const std::array<std::uint32_t, 2>> edges() const;
  /// Vertices that must neither move nor vanish.
  std::span<const std::uint32_t> required_vertices() const;
  /// A label for each vertex; empty where all are 0.
  std::span<const std::int32_t> point_labels() const;
  /// The region of each tet.
  std::span<const std::int32_t> tet_labels() const;
  /// A label for each triangle.
  std::span<const std::int32_t> triangle_labels() const;
  /// A label for each edge.
  std::span<const std::int32_t> edge_labels() const;

  // Without a copy; valid until the mesh changes.

  /// Named numbers of each point.
  const std::vector<DataArray>& point_data() const;
  /// Named numbers of each tet.
  const std::vector<DataArray>& tet_data() const;
  /// Named numbers of each triangle.
  const std::vector<DataArray>& triangle_data() const;
  /// Named numbers of each edge.
  const std::vector<DataArray>& edge_data() const;
  /// Named sets of points and elements.
  const std::vector<Group>& groups() const;
  /// {end, end, node} of each edge of an element of second order, once.
  std::span<const std::array<std::uint32_t, 3>> mid_nodes() const;

  /// Points or elements of one of its groups, whether it names them itself, by parts or by a label.
  std::vector<std::uint32_t> members(const Group& group) const;

  /// All of it; the first call also copies data, parts and groups.
  const MeshArrays& arrays() const;
  /// Moves the arrays out: `std::move(mesh).take_arrays()`. The mesh is empty then.
  MeshArrays take_arrays() &&;

  /// What of the file it was loaded from is not here, one sentence each.
  const std::vector<std::string>& notes() const;
  /// The file it was loaded from, for messages; empty for a mesh of arrays and an improved one.
  const std::filesystem::path& file() const;

 private:
  friend struct MeshAccess;
  struct Content;
  const Content& content() const;
  const MeshArrays& elements() const;  // with their labels, all else may be missing

  std::unique_ptr<Content> content_;  // null: empty
};

}  // namespace tetmend
