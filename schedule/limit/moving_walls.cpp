// SPDX-License-Identifier: MIT
#include "schedule/limit/moving_walls.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include "envelope/envelope.h"

namespace tetmend {

namespace {

bool stays_flat(const TetMesh& mesh) {
  const auto* const envelope = dynamic_cast<const Envelope*>(mesh.surface_guard());
  return envelope != nullptr && envelope->reference().is_flat();
}

}  // namespace

bool is_held(const TetMesh& mesh, VertexHandle v) {
  if (!mesh.is_fixed(v)) return false;
  const SurfaceGuard* const guard = mesh.surface_guard();
  if (guard == nullptr) return true;
  const SurfacePlace place = guard->place(v);
  return place == SurfacePlace::inside || place == SurfacePlace::corner;
}

bool has_lasting_constraint(const TetMesh& mesh, TetHandle t) {
  const SurfaceGuard* const guard = mesh.surface_guard();
  if (guard == nullptr || mesh.is_frozen(t)) return mesh.has_constraints(t);
  for (unsigned f = 0; f < 4; ++f) {
    const HalfFace face(t, f);
    if (mesh.is_constrained(face) && !may_change(mesh, face)) return true;
  }
  const TetVertices& v = mesh.vertices(t);
  for (unsigned e = 0; e < 6; ++e) {
    if (!mesh.is_constrained(TetEdge(t, e))) continue;
    if (!guard->is_feature(v[kEdgeVertices[e][0]], v[kEdgeVertices[e][1]])) return true;
  }
  return false;
}

std::vector<SharpLine> find_sharp_lines(const TetMesh& mesh, double most) {
  std::map<std::uint32_t, SharpLine> lines;
  if (!stays_flat(mesh)) return {};
  for (std::uint32_t code = 0; code < 4 * mesh.tet_slots(); ++code) {
    const HalfFace wall = HalfFace::from_code(code);
    if (mesh.is_deleted(wall.tet()) || mesh.is_frozen(wall.tet()) || !may_change(mesh, wall))
      continue;
    const auto v = mesh.vertices(wall);
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint32_t line = mesh.surface_guard()->line(v[(i + 1) % 3], v[(i + 2) % 3]);
      if (line == SurfaceGuard::kNone) continue;
      const double angle = find_sector(mesh, wall, i).angle;
      if (angle >= most) continue;
      const auto [at, is_new] = lines.try_emplace(line);
      at->second.angle = is_new ? angle : std::min(at->second.angle, angle);
      at->second.worst.push_back(worst_in_sector(mesh, wall, i));
    }
  }
  std::vector<SharpLine> all;
  for (auto& [number, line] : lines) {
    std::vector<TetHandle>& worst = line.worst;  // each sector was seen from both its walls
    std::sort(worst.begin(), worst.end());
    worst.erase(std::unique(worst.begin(), worst.end()), worst.end());
    all.push_back(std::move(line));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const SharpLine& a, const SharpLine& b) { return a.angle < b.angle; });
  return all;
}

}  // namespace tetmend
