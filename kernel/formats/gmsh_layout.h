// SPDX-License-Identifier: MIT
// Where things stand in a Gmsh file of version 4.1 that is too large to be held in memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::formats {

/// Nodes or elements of one entity.
struct GmshBlock {
  std::int32_t dimension = 3;
  Label part = 0;                ///< the entity
  Label label = 0;               ///< its first group
  std::uint32_t parameters = 0;  ///< of each node, besides its place
};

/// Some rows of a block: few enough to be read at once.
struct GmshChunk {
  std::uint64_t block = 0;
  std::uint64_t first = 0;  ///< its first row, among all of the kind
  std::uint64_t rows = 0;
  std::uint64_t at = 0;  ///< of the numbers of nodes, or of the rows of elements
  std::uint64_t size = 0;
  std::uint64_t places_at = 0;  ///< of the coordinates of nodes
  std::uint64_t places_size = 0;
};

struct GmshLayout {
  enum Kind : std::size_t { nodes, edges, triangles, tets };

  bool binary = false;
  bool swap = false;
  /// The file without its nodes and elements, see read_gmsh_head().
  std::string head;
  std::vector<GmshBlock> blocks;
  std::array<std::vector<GmshChunk>, 4> chunks;  ///< by kind
  std::array<std::uint64_t, 4> counts{};         ///< likewise
  std::vector<GmshChunk> point_elements;         ///< rows of a number and a node
  std::uint64_t loose_points = 0;                ///< of them, those that are in no group
  bool parametric = false;
};

/// Reads what stands around the numbers, a part of the file at a time. Text has a row on each line.
/// @returns nothing for a file that is not so, has elements besides points, edges, triangles and
/// tets of first order, or sections besides $PhysicalNames, $Entities, $Nodes and $Elements:
/// read_gmsh() reads it, or says what is wrong
std::optional<GmshLayout> scan_gmsh(const std::filesystem::path& file);

/// Groups, entities and the like of a file without nodes and elements. @throws Error
MeshData read_gmsh_head(const std::string& bytes);

}  // namespace tetmend::formats
