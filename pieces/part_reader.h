// SPDX-License-Identifier: MIT
// The files of a mesh in parts, as the share of the rank that reads them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/mesh_data.h"
#include "pieces/merged_points.h"
#include "pieces/part_arrays.h"
#include "pieces/rank_share.h"
#include "pieces/ranks.h"
#include "pieces/rows.h"

namespace tetmend::pieces {

/// The array by which parts name their points, one number of the whole mesh for each.
inline constexpr const char* kPointIds = "GlobalNodeId";

/// Whether an array says how parts fit together: then it is none of the mesh.
bool is_of_parts(RowKind kind, std::string_view name);

/// Reads the files of one rank, one after another; memory holds what they have.
class PartReader {
 public:
  /// A file of VTK.
  /// @param part its number among all parts; each rank has a range of them
  /// @param label_array which of its arrays holds labels; empty: see read_mesh()
  /// @throws Error as read_mesh(), for elements besides tets, triangles and edges of first order, and
  /// for one number at two points
  void read_vtu(const std::filesystem::path& file, std::uint64_t part,
                const std::string& label_array);
  /// A file of Gmsh, whose numbers of nodes are those of the whole mesh. @throws Error likewise
  void read_msh(const std::filesystem::path& file, std::uint64_t part);
  /// All ranks: what all have read is one mesh.
  /// Has the arrays that all parts have; where they have several values for a point, that of the
  /// first.
  /// @throws Error as merge_points(), and where parts have labels in arrays of several names
  RankShare finish(Ranks& ranks);

 private:
  void add(const std::filesystem::path& file, MeshData& data, std::uint64_t part);
  void check_label_arrays(Ranks& ranks) const;
  void take_ids(const std::filesystem::path& file, MeshData& data);
  void drop_arrays(MeshData& data);

  RankShare share_;
  ByKind<PartArrays> arrays_;
  PartPoints points_;
  std::set<std::string> label_arrays_;
  bool has_part_without_ids_ = false;
};

}  // namespace tetmend::pieces
