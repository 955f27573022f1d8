// SPDX-License-Identifier: MIT
// Boundary and constraint surfaces as OpenMesh triangle meshes.
#pragma once

#include <filesystem>
#include <vector>

#include <OpenMesh/Core/Mesh/Traits.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "kernel/surface_fingerprint.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

/// Coordinates in double precision.
struct SurfaceTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};

/// A triangle surface with the way back to the tetrahedral mesh.
///
/// OpenMesh holds manifolds only. Where a surface touches itself at a vertex or along an edge, that
/// vertex is doubled, once for each sheet, so that no triangle is lost.
struct SurfaceMesh {
  OpenMesh::TriMesh_ArrayKernelT<SurfaceTraits> mesh;
  std::vector<VertexHandle> vertices;  ///< of each surface vertex, repeated where it is doubled
  std::vector<Label> labels;           ///< of each triangle
};

/// The boundary, triangles counterclockwise as seen from outside. Sheets that touch are cut apart
/// on the side of the tets, so that the result is closed. Cost: linear.
SurfaceMesh extract_boundary(const TetMesh& mesh);

/// The constrained interior faces. A face between two labels is counterclockwise as seen from the
/// larger one, any other as the file lists it. Sheets are joined along edges of two triangles of
/// the same sense. Cost: linear, apart from sorting.
SurfaceMesh extract_constraints(const TetMesh& mesh);

/// The four faces of each tet of quality below the threshold, outward; each tet has vertices of its
/// own. The label is the tet's.
SurfaceMesh extract_bad_faces(const TetMesh& mesh, Quality threshold = kBadThreshold);

/// Writes .off, .obj, .ply (text) or .stl (binary) through OpenMesh's own writers, which hold
/// coordinates in single precision. The file appears under its name only when it is complete.
/// @throws Error for another extension, or when writing fails.
void write_surface(const std::filesystem::path& file, const SurfaceMesh& surface);

/// @throws Error, with the valid extensions, if write_surface would refuse the name.
void check_surface_extension(const std::filesystem::path& file);

}  // namespace tetmend
