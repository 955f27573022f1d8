// SPDX-License-Identifier: MIT
// Checks that the arrays of a mesh agree with each other: what tests run after every operation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <tetmend/statistics.h>

#include "kernel/tet_mesh.h"

namespace tetmend {

/// One broken promise of a mesh.
struct Finding {
  enum class Kind : std::uint8_t {
    adjacency,    ///< vertices of a tet, or a face that its two sides do not agree on
    orientation,  ///< two tets list their common face in the same sense: they lie on one side of it
    vertex_link,  ///< the stored tet of a vertex
    boundary,     ///< outside faces, surface triangles and boundary flags
    label,        ///< different labels across a face that is not constrained
    quality,      ///< cached quality and points
    constraint,   ///< constraint bits, fixed and frozen flags
    count         ///< numbers of live tets and vertices
  };

  Kind kind{};
  TetHandle tet;        ///< where, if it is about a tet
  VertexHandle vertex;  ///< where, if it is about a vertex
  std::string message;  ///< one line
};

/// Word for a kind of finding, as in the enumeration.
std::string_view name_of(Finding::Kind kind);

/// Finds all contradictions, at most `limit` of them; empty when the mesh is sound. Needs only
/// that the arrays have the right lengths: any number in them may be wrong. The sign of volumes is
/// not looked at, because inverted input is allowed: see count_not_positive.
/// Cost: linear, apart from sorting the surface triangles.
std::vector<Finding> check_integrity(const TetMesh& mesh, std::size_t limit = 100);

/// Findings as text, one a line; empty for none.
std::string to_string(const std::vector<Finding>& findings);

/// Live tets whose volume is not positive, in exact arithmetic. Cost: linear.
std::size_t count_not_positive(const TetMesh& mesh);

/// The same, where the statistics of the mesh are known: they tell certain signs from others.
/// Cost: none, unless some tet is too flat to tell.
std::size_t count_not_positive(const TetMesh& mesh, const MeshStatistics& statistics);

}  // namespace tetmend
