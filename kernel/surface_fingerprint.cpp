// SPDX-License-Identifier: MIT
// A number that tells whether a surface is still the same.
#include "kernel/surface_fingerprint.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "kernel/chunks.h"
#include "kernel/kept_faces.h"

namespace tetmend {

namespace {

std::uint64_t mix(std::uint64_t h) {
  h = (h ^ (h >> 33)) * 0xFF51AFD7ED558CCDull;
  h = (h ^ (h >> 33)) * 0xC4CEB9FE1A85EC53ull;
  return h ^ (h >> 33);
}

template <class Counts>
std::uint64_t fingerprint(const TetMesh& mesh, const Counts& counts) {
  const auto hash = [&](VertexHandle v) {
    std::uint64_t h = 1;
    for (const double x : mesh.point_in_file(v)) h = mix(h * 31 + std::bit_cast<std::uint64_t>(x));
    return h;
  };
  const auto of_face = [&](HalfFace f) -> std::uint64_t {
    const bool outside = mesh.twin(f).is_outside();
    if (!outside && !mesh.is_constrained(f)) return 0;
    const std::array<VertexHandle, 3> vertices = mesh.vertices(f);
    if (!counts(vertices)) return 0;
    const auto [a, b, c] = vertices;
    std::array<std::uint64_t, 3> corners = {hash(a), hash(b), hash(c)};
    std::sort(corners.begin(), corners.end());
    return mix(mix(mix(corners[0]) ^ corners[1]) ^ corners[2] ^ (outside ? 0 : 1));
  };
  // From the tets, not from the table of surface triangles: a lost face must show.
  const auto parts =
      map_chunks<std::uint64_t>(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
        std::uint64_t sum = 0;
        for (std::size_t slot = begin; slot < end; ++slot) {
          const TetHandle t(static_cast<std::uint32_t>(slot));
          if (!may_have_kept_face(mesh, t) || mesh.is_deleted(t)) continue;
          for (unsigned f = 0; f < 4; ++f) sum += of_face(HalfFace(t, f));
        }
        return sum;
      });
  return std::accumulate(parts.begin(), parts.end(), std::uint64_t{0});
}

}  // namespace

std::uint64_t surface_fingerprint(const TetMesh& mesh) {
  return fingerprint(mesh, [](const auto&) { return true; });
}

std::uint64_t surface_fingerprint(
    const TetMesh& mesh, const std::function<bool(const std::array<VertexHandle, 3>&)>& counts) {
  return fingerprint(mesh, counts);
}

}  // namespace tetmend
