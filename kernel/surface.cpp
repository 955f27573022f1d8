// SPDX-License-Identifier: MIT
#include <OpenMesh/Core/IO/MeshIO.hh>  // before the mesh type, as OpenMesh asks

#include "kernel/surface.h"

#include <algorithm>
#include <array>
#include <bit>
#include <system_error>
#include <unordered_map>

#include "kernel/error.h"

namespace tetmend {

namespace {

constexpr std::array<std::string_view, 4> kExtensions = {".off", ".obj", ".ply", ".stl"};

/// Adds triangles; doubles vertices where OpenMesh, which holds manifolds only, would refuse one.
class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(const TetMesh& mesh) : mesh_(mesh) { omerr().disable(); }
  ~SurfaceBuilder() { omerr().enable(); }
  SurfaceBuilder(const SurfaceBuilder&) = delete;
  SurfaceBuilder& operator=(const SurfaceBuilder&) = delete;

  void add(const std::array<VertexHandle, 3>& triangle, Label label) {
    // OpenMesh refuses a face that is not manifold with those before it, and changes nothing.
    const auto face = surface_.mesh.add_face(shared(triangle[0]), shared(triangle[1]), shared(triangle[2]));
    if (!face.is_valid()) surface_.mesh.add_face(own(triangle[0]), own(triangle[1]), own(triangle[2]));
    surface_.labels.push_back(label);
  }
  /// The next triangles share no vertices with those before.
  void separate() { numbers_.clear(); }
  SurfaceMesh take() { return std::move(surface_); }

 private:
  OpenMesh::VertexHandle own(VertexHandle v) {
    const Point& p = mesh_.point(v);
    surface_.vertices.push_back(v);
    return surface_.mesh.add_vertex({p.x(), p.y(), p.z()});
  }
  OpenMesh::VertexHandle shared(VertexHandle v) {
    const auto found = numbers_.find(v.index());
    if (found != numbers_.end()) return found->second;
    return numbers_[v.index()] = own(v);
  }
  const TetMesh& mesh_;
  SurfaceMesh surface_;
  std::unordered_map<std::uint32_t, OpenMesh::VertexHandle> numbers_;
};

template <class Visit>
void for_each_face(const TetMesh& mesh, Visit&& visit) {
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    if (mesh.is_deleted(TetHandle(i))) continue;
    for (unsigned f = 0; f < 4; ++f) visit(HalfFace(TetHandle(i), f));
  }
}

std::uint64_t mix(std::uint64_t h) {
  h = (h ^ (h >> 33)) * 0xFF51AFD7ED558CCDull;
  h = (h ^ (h >> 33)) * 0xC4CEB9FE1A85EC53ull;
  return h ^ (h >> 33);
}

}  // namespace

SurfaceMesh extract_boundary(const TetMesh& mesh) {
  SurfaceBuilder builder(mesh);
  for_each_face(mesh, [&](HalfFace f) {
    const HalfFace twin = mesh.twin(f);
    if (twin.is_outside()) builder.add(mesh.vertices(f), mesh.surface_triangles()[twin.surface_triangle()].label);
  });
  return builder.take();
}

SurfaceMesh extract_constraints(const TetMesh& mesh) {
  SurfaceBuilder builder(mesh);
  for (const SurfaceTriangle& triangle : mesh.surface_triangles()) {
    if (triangle.interior) builder.add(triangle.vertices, triangle.label);
  }
  return builder.take();
}

SurfaceMesh extract_bad_faces(const TetMesh& mesh, Quality threshold) {
  SurfaceBuilder builder(mesh);
  for_each_face(mesh, [&](HalfFace f) {
    if (mesh.quality(f.tet()) >= threshold) return;
    if (f.face() == 0) builder.separate();
    builder.add(mesh.vertices(f), mesh.label(f.tet()));
  });
  return builder.take();
}

void check_surface_extension(const std::filesystem::path& file) {
  std::string valid;
  for (const std::string_view extension : kExtensions) {
    if (file.extension() == extension) return;
    valid += valid.empty() ? "" : ", ";
    valid += extension;
  }
  throw Error(file.string() + ": unknown surface format '" + file.extension().string() + "'; valid: " + valid);
}

void write_surface(const std::filesystem::path& file, const SurfaceMesh& surface) {
  check_surface_extension(file);
  std::filesystem::path partial = file;
  partial.replace_extension(".partial" + file.extension().string());
  constexpr std::streamsize kRoundTripDigits = 17;
  omerr().disable();
  const bool written = OpenMesh::IO::write_mesh(surface.mesh, partial.string(), OpenMesh::IO::Options::Default, kRoundTripDigits);
  omerr().enable();
  std::error_code error;
  if (written) std::filesystem::rename(partial, file, error);
  if (!written || error) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    throw Error(file.string() + ": cannot write" + (error ? ": " + error.message() : std::string()));
  }
}

std::uint64_t surface_fingerprint(const TetMesh& mesh) {
  const auto hash = [&](VertexHandle v) {
    std::uint64_t h = 1;
    for (const double x : mesh.point(v)) h = mix(h * 31 + std::bit_cast<std::uint64_t>(x));
    return h;
  };
  std::uint64_t sum = 0;
  // From the tets, not from the table of surface triangles: a lost face must show.
  for_each_face(mesh, [&](HalfFace f) {
    const bool outside = mesh.twin(f).is_outside();
    if (!outside && !mesh.is_constrained(f)) return;
    const auto [a, b, c] = mesh.vertices(f);
    std::array<std::uint64_t, 3> corners = {hash(a), hash(b), hash(c)};
    std::sort(corners.begin(), corners.end());
    sum += mix(mix(mix(corners[0]) ^ corners[1]) ^ corners[2] ^ (outside ? 0 : 1));
  });
  return sum;
}

}  // namespace tetmend
