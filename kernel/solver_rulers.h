// SPDX-License-Identifier: MIT
// What solvers with linear (P1) elements make of a mesh: how large steps in time may be, how much
// an iteration costs.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <tetmend/api.h>

#include "kernel/geometry.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

/// The share of one tet in the lumped mass and in the diagonal of the stiffness matrix of the
/// Laplacian: V / 4 for each vertex, and V |grad phi_i|^2 for vertex i.
struct TETMEND_API P1Diagonal {
  double mass = 0;
  std::array<double, 4> stiffness{};
};

/// Infinite stiffness, or none, where the volume is not positive: see stable_step().
/// Source: grad phi_i = normal of face i, twice its area long, / (6 V).
inline P1Diagonal p1_diagonal(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Point u = b - a, v = c - a, w = d - a, r = c - b, s = d - b;
  const double v6 = u.dot(v.cross(w));
  return {v6 / 24,
          {r.cross(s).squaredNorm() / (6 * v6), v.cross(w).squaredNorm() / (6 * v6),
           w.cross(u).squaredNorm() / (6 * v6), u.cross(v).squaredNorm() / (6 * v6)}};
}

/// Lumped mass and diagonal of the stiffness matrix of a mesh, by VertexHandle::index(). Vertices
/// of no tet have 0.
struct TETMEND_API P1Diagonals {
  std::vector<double> mass;
  std::vector<double> stiffness;
  bool are_positive = false;  ///< the volumes of all tets; false without tets

  bool is_in_use(VertexHandle v) const { return mass[v.index()] != 0 || stiffness[v.index()] != 0; }
  /// sqrt(m / k); 0 where that is no positive number.
  double step(VertexHandle v) const {
    const double square = mass[v.index()] / stiffness[v.index()];
    return square > 0 ? std::sqrt(square) : 0;
  }
};

/// The sums run in the order of the tets, whatever the number of threads.
/// Cost: linear, on all threads, about 0.02 s for a million tets on one; 16 bytes a vertex, and 0.7 MB
/// a thread.
TETMEND_API P1Diagonals p1_diagonals(const TetMesh& mesh);

/// The smallest sqrt(m_i / k_ii) over the vertices, m the lumped mass and k the stiffness matrix of
/// the Laplacian: a length, as mesh.point() has it. Explicit time integration of a wave of speed 1
/// is stable up to dt = 2 / sqrt(largest eigenvalue of M^-1 K), and step <= dt <= 2 step. 0 for a
/// mesh with a tet of no positive volume, and without tets. Mid-side nodes are not looked at.
/// Cost: as p1_diagonals().
TETMEND_API double stable_step(const TetMesh& mesh);
TETMEND_API double stable_step(const P1Diagonals& diagonals);

/// The same squared for one vertex, from its star; nothing for a star of more than kMaxStar tets. Any
/// thread may ask whose territory holds the vertex. Cost: linear in the star.
TETMEND_API std::optional<double> squared_step_at(const TetMesh& mesh, VertexHandle v);

/// How many steps conjugate gradients with Jacobi's preconditioner take to 1e-8, for the Laplacian
/// with linear elements and the surface fixed: an estimate from sums over the mesh, not an integer.
/// 0 for a mesh with a tet of no positive volume, or without an inner vertex. docs/glossary.md says
/// how good it is. Cost: linear, on all threads, about 0.06 s for a million tets on one; 28 bytes a
/// vertex and some 10 a tet more than p1_diagonals().
TETMEND_API double estimate_cg_steps(const TetMesh& mesh, const P1Diagonals& diagonals);

}  // namespace tetmend
