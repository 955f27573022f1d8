// SPDX-License-Identifier: MIT
// The zoo: small meshes, one for each situation that an operator can meet.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "kernel/tet_mesh.h"

namespace tetmend::contract {

/// Same numbers with every standard library: the engine is fixed by the standard, the mapping is
/// ours.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// Evenly in [0, 1).
  double real() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double real(double low, double high) { return low + (high - low) * real(); }
  /// Evenly in 0..n-1, for n much smaller than 2^64.
  std::size_t index(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }
  /// Evenly in the ball of that radius around 0.
  Point in_ball(double radius);

 private:
  std::mt19937_64 engine_;
};

/// Regular tet with edge length sqrt(8) around 0.
MeshData one_tet();
/// Two tets on the two sides of a face.
MeshData two_tets();

/// Tets around one edge.
struct ShellShape {
  unsigned degree = 5;  ///< vertices of the ring, 3 or more
  double height = 1;    ///< half the length of the edge; the ring has radius 1
  double squash = 1;    ///< scale of the ring in y
  double jitter = 0;    ///< largest displacement of a ring vertex
  bool open = false;    ///< leave out the last tet: the edge lies on the boundary
  std::uint64_t seed = 1;
};
/// Vertices 0 and 1 are the edge, 2 .. degree + 1 the ring.
MeshData shell_mesh(const ShellShape& shape);

/// Two apexes over and under a fan of degree - 2 triangles: what multi-face removal turns into a
/// shell.
MeshData sandwich(unsigned degree, double height);

/// two_tets() with the common face named as a constraint.
MeshData constrained_face();
/// A shell of six with one supporting face, or its edge, named as a constraint.
MeshData shell_with_constrained_face();
MeshData shell_with_constrained_edge();
/// Kuhn cube of 2 x 2 x 2 cells: label 1 below, label 2 above.
MeshData two_regions();

/// A middle tet with two tets above and two below. Its upper and lower edge are 2 lift apart: it is
/// positive for lift > 0, flat for 0, inverted below 0. The other tets are positive for
/// |lift| < 0.5.
MeshData middle_tet(double lift);

/// Two octahedra, each with a vertex inside, that touch at one vertex or along one edge.
MeshData touching_at_vertex();
MeshData touching_at_edge();

/// Delaunay tetrahedralisation of n random points in the unit ball.
MeshData delaunay_ball(unsigned n, std::uint64_t seed);
/// delaunay_ball with an inner vertex dragged out of its star: some tets are inverted.
MeshData tangled_ball(unsigned n, std::uint64_t seed);

/// Unit cube of cells^3 cells, each split into six tets around its diagonal; inner vertices are
/// moved by at most `jitter` cell widths. From about 0.4 on, tets may be inverted.
MeshData kuhn_cube(unsigned cells, double jitter, std::uint64_t seed);

/// Ball of two regions with interior faces, edges and vertices named as constraints.
MeshData constrained_ball(std::uint64_t seed);

struct NamedMesh {
  std::string name;
  MeshData data;
};
/// Some of everything above. Names are unique and contain no spaces.
std::vector<NamedMesh> zoo();
/// The mesh of that name in the zoo. @throws Error when there is none.
MeshData zoo_data(const std::string& name);

/// All live tets and vertices, ascending.
std::vector<TetHandle> live_tets(const TetMesh& mesh);
std::vector<VertexHandle> live_vertices(const TetMesh& mesh);

}  // namespace tetmend::contract
