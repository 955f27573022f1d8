// SPDX-License-Identifier: MIT
// Rulers: the measures by which users of other programs judge a mesh, as these define them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <tetmend/language.h>

namespace tetmend {

/// A measure of a whole mesh as another program defines it; kRulers has formulas.
enum class Ruler : std::uint8_t {
  mean_ratio,
  radius_ratio,
  sicn,
  sige,
  condition,
  aspect_ratio,
  edge_ratio,
  least_altitude,
  non_orthogonality,
  skewness,
  step
};

/// Of one ruler.
struct RulerInfo {
  std::string_view name;   ///< as in JSON: "mean_ratio"
  std::string_view title;  ///< as in tables: with unit and program
  std::string_view help;   ///< formula and value of the regular tet
  bool large_is_good;      ///< the worst is the least
  bool of_faces;           ///< a value for each face, not for each tet
  bool of_vertices;        ///< a value for each vertex of a tet
};

/// The number of values of Ruler.
inline constexpr std::size_t kRulerCount = 11;

/// All rulers, by Ruler. V is the volume, r and R the radii of the inner and the outer sphere. The
/// first four have the sign of the volume, as has the altitude. The condition number and the aspect
/// ratio of a tet without positive volume are infinite. m and k are the lumped mass and the
/// stiffness matrix of the Laplacian with linear (P1) elements; with such a tet the step is 0.
inline constexpr std::array<RulerInfo, kRulerCount> kRulers = {{
    {"mean_ratio", "mean ratio", "12 (3 V)^(2/3) / sum of the squared edges; at best 1", true,
     false, false},
    {"radius_ratio", "radius ratio, gamma (Gmsh)",
     "3 r / R; at best 1. VTK's radius ratio is its inverse", true, false, false},
    {"sicn", "SICN (Gmsh)", "signed inverse of the condition number; at best 1", true, false,
     false},
    {"sige", "SIGE (Gmsh)", "signed inverse error of a gradient; at best 1", true, false, false},
    {"condition", "condition number (VTK)",
     "of the map from the regular tet, by Frobenius' norm, / 3;\nat best 1", false, false, false},
    {"aspect_ratio", "aspect ratio (VTK)", "longest edge / (2 sqrt(6) r); at best 1", false, false,
     false},
    {"edge_ratio", "edge ratio", "longest edge / shortest edge of a tet; at best 1", false, false,
     false},
    {"least_altitude", "least altitude",
     "3 V / largest face, a length; bounds the step of explicit\ntime integration", true, false,
     false},
    {"non_orthogonality", "non-orthogonality, degrees",
     "of OpenFOAM: angle between the normal of an inner face and\n"
     "the line that joins the centroids of its tets; at best 0.\n"
     "The mean is the angle of the mean cosine",
     false, true, false},
    {"skewness", "skewness (OpenFOAM)",
     "distance of a face's centroid from that line, / size of\nthe face; at best 0", false, true,
     false},
    {"step", "step (explicit, P1)",
     "smallest sqrt(m_i / k_ii) of a vertex, a length; a wave of\nspeed 1 can be followed in steps "
     "of that, not of twice that",
     true, false, true},
}};

/// What one ruler says about a mesh.
struct RulerFigures {
  double worst = 0;        ///< of any tet, face or vertex
  double one_percent = 0;  ///< 1 % of the tets, faces or vertices are as bad as that or worse
  double mean = 0;         ///< of all of them
};

/// What all of them say. All 0 for a mesh without tets, or for a ruler without a face.
struct MeshRulers {
  std::array<RulerFigures, kRulerCount> figures{};  ///< by Ruler
  double shortest_edge = 0;                         ///< a length
  std::size_t inner_faces = 0;                      ///< faces of two tets
  std::size_t faces_above_70 = 0;  ///< inner faces of more than 70 degrees non-orthogonality
  double cg_steps = 0;  ///< estimate: of conjugate gradients with Jacobi, see docs/glossary.md
  double work = 0;      ///< tets times cg_steps

  /// The figures of one ruler.
  const RulerFigures& operator[](Ruler ruler) const {
    return figures[static_cast<std::size_t>(ruler)];
  }
};

/// A ruler that is one number of a mesh.
struct SolverRulerInfo {
  std::string_view name;      ///< as in JSON: "work"
  std::string_view title;     ///< as in tables
  std::string_view help;      ///< formula
  double MeshRulers::*value;  ///< where it stands
};

/// What solving a system of equations on the mesh costs; less is better.
inline constexpr std::array<SolverRulerInfo, 2> kSolverRulers = {{
    {"cg_steps", "CG steps, estimated",
     "of conjugate gradients with Jacobi's preconditioner, for the\nLaplacian with linear elements "
     "and the surface fixed",
     &MeshRulers::cg_steps},
    {"work", "work, tets x CG steps", "what such a solver costs, in products of a tet",
     &MeshRulers::work},
}};

}  // namespace tetmend
