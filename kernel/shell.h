// SPDX-License-Identifier: MIT
// The shell of an edge: the tets around it, found from one of them or from an end of the edge.
//
//              b               The supporting edge ab, which runs behind p_i p_{i+1} here, and one
//            / : \             of the tets around it, (a, b, p_i, p_{i+1}) of positive volume.
//          /   :   \           Their other vertices p_0 .. p_{m-1} are the ring (skirt polygon).
//        /     :     \         Seen from b it runs counterclockwise ([chen, Fig. 3]).
//     p_i ------------ p_{i+1}
//        \     :     /           supporting face   (a, b, p_i)
//          \   :   /             link edges        (a, p_i), (b, p_i)
//            \ : /               link faces        (a, p_i, p_{i+1}), (b, p_i, p_{i+1})
//              a                 degree            m
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include <tetmend/api.h>

#include "kernel/few.h"
#include "kernel/territory.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

class Workspace;

/// Largest ring that the operators look at. Larger shells are left alone.
inline constexpr unsigned kMaxDegree = 32;

enum class ShellKind : std::uint8_t {
  closed,       ///< the tets go all the way round, and neither they nor their faces are constrained
  boundary,     ///< the edge lies on the boundary
  constrained,  ///< the edge is constrained, or lies on a constrained face or in a frozen tet
  too_large,    ///< degree above kMaxDegree
  border        ///< leaves the territory
};

/// The ring of a closed shell. Ring arithmetic is modulo degree.
struct TETMEND_API Shell {
  VertexHandle a;
  VertexHandle b;
  unsigned degree = 0;
  std::array<VertexHandle, kMaxDegree> ring;
  std::array<TetHandle, kMaxDegree> tets;  ///< tets[i] = (a, b, ring[i], ring[i+1])

  VertexHandle next(unsigned i) const { return ring[i + 1 == degree ? 0 : i + 1]; }
  VertexHandle previous(unsigned i) const { return ring[i == 0 ? degree - 1 : i - 1]; }
};

/// Walks around an edge. The ring begins at the tet that names the edge: tets[0] is that tet. Fills
/// `shell` completely only for ShellKind::closed. Precondition: the tet of the edge lies in the
/// territory, which is that of the workspace, or Territory() for the whole mesh where nobody else works.
/// Cost: one step for each tet, no memory.
TETMEND_API ShellKind find_shell(const TetMesh& mesh, TetEdge edge, Shell& shell,
                                 const Territory& territory);

/// A tet that contains the edge between two vertices, searched in the star of the first. Nothing
/// when there is none, or when the search leaves the territory of the workspace, which notes it.
/// Looks at `hint` first. At a vertex whose star is not connected through faces (touching fans),
/// only the fan of its stored tet is searched. Cost: about 26 tets without a useful hint
/// ([chen, 5.2]).
TETMEND_API std::optional<TetEdge> find_edge(const TetMesh& mesh, VertexHandle a, VertexHandle b,
                                             Workspace& workspace, TetHandle hint = {});

/// The edge between two vertices if `t` contains both.
inline std::optional<TetEdge> edge_in(const TetMesh& mesh, TetHandle t, VertexHandle a,
                                      VertexHandle b) {
  const unsigned i = mesh.local_index(t, a);
  const unsigned j = mesh.local_index(t, b);
  if (i == 4 || j == 4 || i == j) return std::nullopt;
  return TetEdge(t, kEdgeOf[i][j]);
}

/// The tets around an edge (a, b) in turn: tets[i] is (a, b, vertices[i], vertices[i + 1]), and
/// positive. A closed ring has as many vertices as tets. An open one goes from one face of the
/// boundary to the other, and has one vertex more.
struct TETMEND_API Ring {
  VertexHandle a;
  VertexHandle b;
  bool closed = false;
  Few<TetHandle, 16> tets;
  Few<VertexHandle, 16> vertices;
};

/// All tets around an edge, whatever is constrained there. Empty for an edge of a deleted tet. Cost: linear
/// in them.
TETMEND_API Ring ring(const TetMesh& mesh, TetEdge edge);

}  // namespace tetmend
