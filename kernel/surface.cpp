// SPDX-License-Identifier: MIT
// Surfaces out of a tetrahedral mesh.
//
//   collect triangles -> glue those that belong together at an edge -> corners that are connected
//   through glued edges become one vertex -> OpenMesh
// clang-format off
#include <OpenMesh/Core/IO/MeshIO.hh>  // before the mesh type, as OpenMesh asks
#include "kernel/surface.h"
// clang-format on

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/formats/output_file.h"
#include "kernel/in_order.h"

namespace tetmend {

namespace {

using Triangle = std::array<VertexHandle, 3>;

/// OpenMesh prints what it dislikes; this library does not print.
class SilentOpenMesh {
 public:
  SilentOpenMesh() : errors_(omerr().is_enabled()), log_(omlog().is_enabled()) {
    omerr().disable();
    omlog().disable();
  }
  ~SilentOpenMesh() {
    if (errors_) omerr().enable();
    if (log_) omlog().enable();
  }
  SilentOpenMesh(const SilentOpenMesh&) = delete;
  SilentOpenMesh& operator=(const SilentOpenMesh&) = delete;

 private:
  bool errors_;
  bool log_;
};

/// Triangles and which of their corners coincide.
class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(const TetMesh& mesh) : mesh_(mesh) {}

  std::size_t size() const { return triangles_.size(); }
  void add(const Triangle& triangle, Label label) {
    triangles_.push_back(triangle);
    labels_.push_back(label);
    for (unsigned i = 0; i < 3; ++i) parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
  }
  /// The vertex is the same in both triangles. Precondition: both contain it.
  void join(std::size_t k, std::size_t l, VertexHandle v) {
    parent_[root(corner(k, v))] = root(corner(l, v));
  }

  SurfaceMesh build() {
    const SilentOpenMesh silent;
    SurfaceMesh surface;
    std::vector<OpenMesh::VertexHandle> vertex_of(parent_.size());
    for (std::size_t k = 0; k < triangles_.size(); ++k) {
      std::array<OpenMesh::VertexHandle, 3> v;
      for (unsigned i = 0; i < 3; ++i) {
        OpenMesh::VertexHandle& shared = vertex_of[root(static_cast<std::uint32_t>(3 * k + i))];
        if (!shared.is_valid()) shared = new_vertex(surface, triangles_[k][i]);
        v[i] = shared;
      }
      if (!surface.mesh.add_face(v[0], v[1], v[2]).is_valid()) {
        // A sheet that meets itself along an edge. A vertex without faces can be used as it is.
        for (unsigned i = 0; i < 3; ++i) {
          if (!surface.mesh.is_isolated(v[i])) v[i] = new_vertex(surface, triangles_[k][i]);
        }
        surface.mesh.add_face(v[0], v[1], v[2]);
      }
    }
    surface.labels = std::move(labels_);
    return surface;
  }

 private:
  OpenMesh::VertexHandle new_vertex(SurfaceMesh& surface, VertexHandle v) const {
    const Point p = mesh_.point_in_file(v);
    surface.vertices.push_back(v);
    return surface.mesh.add_vertex({p.x(), p.y(), p.z()});
  }
  std::uint32_t corner(std::size_t k, VertexHandle v) const {
    const unsigned i = triangles_[k][0] == v ? 0 : triangles_[k][1] == v ? 1 : 2;
    return static_cast<std::uint32_t>(3 * k + i);
  }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  const TetMesh& mesh_;
  std::vector<Triangle> triangles_;
  std::vector<Label> labels_;
  std::vector<std::uint32_t> parent_;  // of corner 3 k + i, in the forest of corners that coincide
};

template <class Visit>
void for_each_face(const TetMesh& mesh, Visit&& visit) {
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    if (mesh.is_deleted(TetHandle(i))) continue;
    for (unsigned f = 0; f < 4; ++f) visit(HalfFace(TetHandle(i), f));
  }
}

/// The boundary triangle that meets boundary face f at the edge opposite its vertex c, on the same
/// side: found by turning around the edge through the tets.
std::uint32_t across(const TetMesh& mesh, HalfFace f, VertexHandle c) {
  TetHandle t = f.tet();
  VertexHandle behind = c;                          // the face just crossed is edge and behind
  VertexHandle ahead = mesh.vertices(t)[f.face()];  // the next one is edge and ahead
  for (;;) {
    const HalfFace twin = mesh.twin(HalfFace(t, mesh.local_index(t, behind)));
    if (twin.is_outside()) return twin.surface_triangle();
    t = twin.tet();
    behind = ahead;
    ahead = mesh.vertices(t)[twin.face()];
  }
}

// --- formats -------------------------------------------------------------------------------------

constexpr std::array<std::string_view, 4> kSurfaceExtensions = {".off", ".obj", ".ply", ".stl"};

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

}  // namespace

SurfaceMesh extract_boundary(const TetMesh& mesh) {
  SurfaceBuilder builder(mesh);
  std::vector<HalfFace> faces;
  std::vector<std::uint32_t> position(mesh.surface_triangles().size());  // by surface triangle
  for_each_face(mesh, [&](HalfFace f) {
    if (!mesh.is_boundary(f)) return;
    const std::uint32_t number = mesh.twin(f).surface_triangle();
    position[number] = static_cast<std::uint32_t>(faces.size());
    faces.push_back(f);
    builder.add(mesh.vertices(f), mesh.surface_triangles()[number].label);
  });
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const Triangle v = mesh.vertices(faces[k]);
    for (unsigned i = 0; i < 3; ++i) {
      const std::size_t l = position[across(mesh, faces[k], v[i])];
      builder.join(k, l, v[(i + 1) % 3]);
      builder.join(k, l, v[(i + 2) % 3]);
    }
  }
  return builder.build();
}

SurfaceMesh extract_constraints(const TetMesh& mesh) {
  // Sense of the faces between two labels.
  std::vector<std::pair<Triangle, HalfFace>> borders;
  for_each_face(mesh, [&](HalfFace f) {
    if (!mesh.is_constrained(f) || mesh.is_boundary(f)) return;
    if (mesh.label(f.tet()) < mesh.label(mesh.twin(f).tet())) {
      borders.emplace_back(in_order(mesh.vertices(f)), f);
    }
  });
  std::sort(borders.begin(), borders.end());

  struct Side {
    VertexHandle low, high;
    std::size_t triangle;
    bool up;  // the triangle runs from low to high
  };
  std::vector<Side> sides;
  SurfaceBuilder builder(mesh);
  for (const SurfaceTriangle& triangle : mesh.surface_triangles()) {
    if (!triangle.interior || triangle.loose) continue;
    Triangle v = triangle.vertices;
    const auto border =
        std::lower_bound(borders.begin(), borders.end(), in_order(v),
                         [](const auto& entry, const Triangle& key) { return entry.first < key; });
    if (border != borders.end() && border->first == in_order(v)) v = mesh.vertices(border->second);
    for (unsigned i = 0; i < 3; ++i) {
      const VertexHandle a = v[i];
      const VertexHandle b = v[(i + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), builder.size(), a < b});
    }
    builder.add(v, triangle.label);
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  const auto same = [](const Side& a, const Side& b) { return a.low == b.low && a.high == b.high; };
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t j = i + 1;
    while (j < sides.size() && same(sides[i], sides[j])) ++j;
    if (j - i == 2 && sides[i].up != sides[i + 1].up) {
      builder.join(sides[i].triangle, sides[i + 1].triangle, sides[i].low);
      builder.join(sides[i].triangle, sides[i + 1].triangle, sides[i].high);
    }
    i = j;
  }
  return builder.build();
}

SurfaceMesh extract_bad_faces(const TetMesh& mesh, Quality threshold) {
  SurfaceBuilder builder(mesh);
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    if (mesh.is_deleted(t) || !(mesh.quality(t) < threshold)) continue;
    const std::size_t first = builder.size();
    for (unsigned f = 0; f < 4; ++f) builder.add(mesh.vertices(HalfFace(t, f)), mesh.label(t));
    for (unsigned k = 1; k < 4; ++k) {  // vertex k lies on all faces but k; face 0 has 1 2 3
      for (unsigned f = 1; f < 4; ++f) {
        if (f != k) builder.join(first, first + f, mesh.vertices(t)[k]);
      }
    }
    for (unsigned f = 2; f < 4; ++f) builder.join(first + 1, first + f, mesh.vertices(t)[0]);
  }
  return builder.build();
}

void check_surface_extension(const std::filesystem::path& file) {
  std::string valid;
  for (const std::string_view extension : kSurfaceExtensions) {
    if (lower_extension(file) == extension) return;
    valid += valid.empty() ? "" : ", ";
    valid += extension;
  }
  throw Error(file.string() + ": unknown surface format '" + file.extension().string() +
              "'; valid: " + valid);
}

namespace {

/// OpenMesh writes single precision.
void check_size(const std::filesystem::path& file, const SurfaceMesh& surface) {
  constexpr double kMost = std::numeric_limits<float>::max();
  constexpr double kLeast =
      std::numeric_limits<float>::min() / std::numeric_limits<float>::epsilon();
  double size = 0;
  for (const auto v : surface.mesh.vertices()) {
    for (const double x : surface.mesh.point(v)) size = std::max(size, std::abs(x));
  }
  if (size == 0 || (size >= kLeast && size <= kMost)) return;
  throw Error(fmt::format("{}: coordinates of {:.3g} are beyond the single precision of such files",
                          file.string(), size));
}

}  // namespace

void write_surface(const std::filesystem::path& file, const SurfaceMesh& surface) {
  check_surface_extension(file);
  check_size(file, surface);
  const std::string extension = lower_extension(file);
  const SilentOpenMesh silent;
  const auto options = extension == ".stl" ? OpenMesh::IO::Options(OpenMesh::IO::Options::Binary)
                                           : OpenMesh::IO::Options();
  constexpr std::streamsize kDigits = 9;  // all that a float holds
  std::ostringstream bytes;
  if (!OpenMesh::IO::write_mesh(surface.mesh, bytes, extension, options, kDigits)) {
    throw Error(file.string() + ": OpenMesh cannot write this surface");
  }
  OutputFile out(file);
  out.put(bytes.str());
  out.commit();
}

}  // namespace tetmend
