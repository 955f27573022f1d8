// SPDX-License-Identifier: MIT
// The neighbourhood of a vertex: star (ball), link and one-ring.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <tetmend/api.h>

#include "kernel/few.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

class Workspace;

/// Largest star, in tets, that the operators look at; a vertex of a larger one stays where it is. An
/// attempt may look at each tet once for each neighbour of the vertex, which takes milliseconds
/// here. Stars of real parts have less than a hundred tets.
inline constexpr std::size_t kMaxStar = 300;

enum class StarKind : std::uint8_t {
  whole,
  too_large,  ///< more than kMaxStar tets
  border      ///< leaves the territory
};

/// As collect_link(), but gives up at a star that is too large. Fills `out` completely only for
/// StarKind::whole. Cost: linear in the star, at most kMaxStar steps.
TETMEND_API StarKind find_star(const TetMesh& mesh, VertexHandle v, Workspace& workspace,
                               std::vector<HalfFace>& out);

using Star = Few<TetHandle, 48>;        ///< the tets around a vertex
using Link = Few<HalfFace, 48>;         ///< for each of them its face opposite the vertex
using OneRing = Few<VertexHandle, 32>;  ///< the other ends of the edges of a vertex

/// Of a vertex, as values; empty for one of no tet. They spread through faces from the stored tet; the
/// order follows from the connectivity alone. Cost: linear in the star. Precondition for a worker: the
/// star lies in its territory; operators that do not know ask collect_link().
TETMEND_API Link link(const TetMesh& mesh, VertexHandle v);
TETMEND_API Star star(const TetMesh& mesh, VertexHandle v);
TETMEND_API OneRing one_ring(const TetMesh& mesh, VertexHandle v);

/// Link of a vertex as half-faces: for each tet of the star, the half-face opposite v. Spreads
/// through faces from the stored tet; the order follows from the connectivity alone. `out` is
/// cleared first. False, with a part of the link, if the star leaves the territory of the
/// workspace. Cost: linear in the star.
TETMEND_API bool collect_link(const TetMesh& mesh, VertexHandle v, Workspace& workspace,
                              std::vector<HalfFace>& out);

/// Edge (a, b) in the star of a, or in that of b if a's is larger than kMaxStar; nothing if there is
/// none in the territory of the workspace. Precondition: a is a live vertex with a tet. Cost: linear
/// in the star of a, or in the smaller one and kMaxStar.
TETMEND_API std::optional<TetEdge> find_in_star(const TetMesh& mesh, VertexHandle a, VertexHandle b,
                                                Workspace& workspace);

}  // namespace tetmend
