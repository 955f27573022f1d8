// SPDX-License-Identifier: MIT
// Boundary and constraint surfaces as OpenMesh triangle meshes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/Traits.hh>

#include "kernel/tet_mesh.h"

namespace tetmend {

struct SurfaceTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};

/// A triangle surface with the way back to the tetrahedral mesh.
struct SurfaceMesh {
  OpenMesh::TriMesh_ArrayKernelT<SurfaceTraits> mesh;
  std::vector<VertexHandle> vertices;  ///< of each surface vertex; the same one twice where the surface is not manifold
  std::vector<Label> labels;           ///< of each triangle
};

/// The boundary, triangles counterclockwise as seen from outside. Where it is not manifold, vertices are doubled, so that no triangle is
/// lost.
SurfaceMesh extract_boundary(const TetMesh& mesh);

/// The constrained interior faces.
SurfaceMesh extract_constraints(const TetMesh& mesh);

/// The faces of all tets of quality below the threshold, each tet with vertices of its own.
SurfaceMesh extract_bad_faces(const TetMesh& mesh, Quality threshold = kBadThreshold);

/// Writes through OpenMesh: .off, .obj, .ply or .stl. The file appears under its name only when complete.
/// @throws Error for another extension, or when writing fails.
void write_surface(const std::filesystem::path& file, const SurfaceMesh& surface);

/// @throws Error, with the valid extensions, if write_surface would refuse the name.
void check_surface_extension(const std::filesystem::path& file);

/// A number that changes when a boundary triangle or a constrained face comes, goes, or moves in the last bit of a coordinate. It does not
/// depend on numbering.
std::uint64_t surface_fingerprint(const TetMesh& mesh);

}  // namespace tetmend
