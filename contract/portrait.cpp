// SPDX-License-Identifier: MIT
#include "contract/portrait.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contract/zoo.h"
#include "kernel/integrity.h"
#include "ops/where.h"

namespace tetmend::contract {

namespace {

using Face = Portrait::Face;
using Edge = std::array<VertexHandle, 2>;

long double volume_of(const TetMesh& mesh, const TetVertices& v) {
  std::array<std::array<long double, 3>, 3> d{};
  for (unsigned i = 0; i < 3; ++i) {
    for (unsigned k = 0; k < 3; ++k) {
      d[i][k] = static_cast<long double>(mesh.point(v[i + 1])[k]) -
                static_cast<long double>(mesh.point(v[0])[k]);
    }
  }
  return (d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) +
          d[0][1] * (d[1][2] * d[2][0] - d[1][0] * d[2][2]) +
          d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0])) /
         6;
}

/// Strictly better in lexicographic order, the shorter vector continued with +infinity.
bool strictly_better(std::vector<Quality> now, std::vector<Quality> before) {
  const std::size_t size = std::max(now.size(), before.size());
  now.resize(size, std::numeric_limits<Quality>::infinity());
  before.resize(size, std::numeric_limits<Quality>::infinity());
  return before < now;
}

}  // namespace

Portrait portrait(const TetMesh& mesh) {
  Portrait p;
  const bool may_move = mesh.surface_guard() != nullptr;
  for (const TetHandle t : live_tets(mesh)) {
    TetVertices v = mesh.vertices(t);
    const long double volume = volume_of(mesh, v);
    p.volumes[mesh.label(t)] += volume;
    p.absolute_volume += std::abs(volume);
    p.qualities.push_back(static_cast<Quality>(mesh.standard().quality(
        mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]))));
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      Face corners = mesh.vertices(face);
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      const HalfFace twin = mesh.twin(face);
      if (may_move && (twin.is_outside() || mesh.label(twin.tet()) != mesh.label(t))) continue;
      if (twin.is_outside()) {
        p.boundary.emplace_back(corners, twin.surface_triangle(), mesh.label(t));
      } else if (mesh.is_constrained(face)) {
        p.constrained_faces.emplace_back(corners, mesh.label(t));
      }
    }
    for (unsigned e = 0; e < 6; ++e) {
      if (!mesh.is_constrained(TetEdge(t, e))) continue;
      Edge edge = mesh.vertices(TetEdge(t, e));
      std::sort(edge.begin(), edge.end());
      if (may_move && mesh.surface_guard()->is_feature(edge[0], edge[1])) continue;
      p.constrained_edges.insert(edge);
    }
    if (mesh.is_frozen(t)) p.frozen.emplace_back(t, v);
    const bool certain = mesh.is_certified_positive(v);
    std::sort(v.begin(), v.end());
    if (!certain) p.doubtful.insert(v);
  }
  for (const VertexHandle v : live_vertices(mesh)) {
    const Point& at = mesh.point(v);
    if (mesh.is_fixed(v) && !may_change(mesh, v)) p.fixed.emplace_back(v, at.x(), at.y(), at.z());
  }
  std::sort(p.boundary.begin(), p.boundary.end());
  std::sort(p.constrained_faces.begin(), p.constrained_faces.end());
  std::sort(p.qualities.begin(), p.qualities.end());
  p.not_positive = count_not_positive(mesh);
  if (may_move) p.shape = std::make_shared<SurfaceShape>(surface_shape(mesh));
  return p;
}

Portrait portrait_after(const Portrait& before, const TetMesh& mesh) {
  Portrait p = portrait(mesh);
  if (before.shape) p.shape = before.shape;
  return p;
}

namespace {

/// Of the regions, and the shape of a surface that may change. `exact`: no volume may change.
std::string complaint_about_regions(const Portrait& before, const Portrait& now, bool exact) {
  if (now.volumes.size() != before.volumes.size()) return "a region vanished";
  for (const auto& [label, volume] : before.volumes) {
    const auto found = now.volumes.find(label);
    if (found == now.volumes.end()) return "a region vanished";
    if (exact && std::abs(found->second - volume) > 1e-12L * before.absolute_volume) {
      return "the volume of a region changed";
    }
  }
  return "";
}

}  // namespace

std::string complaint_about_loss(const Portrait& before, const TetMesh& changed) {
  TetMesh renewed;
  if (changed.surface_guard() != nullptr) {
    renewed = changed;
    renewed.renew_surface();
  }
  const TetMesh& mesh = changed.surface_guard() != nullptr ? renewed : changed;
  if (const auto findings = check_integrity(mesh); !findings.empty()) {
    return "the mesh is not sound: " + to_string(findings);
  }
  const Portrait now = portrait(mesh);
  if (now.boundary != before.boundary) return "the boundary changed";
  if (now.constrained_faces != before.constrained_faces) return "constrained faces changed";
  if (now.constrained_edges != before.constrained_edges) return "constrained edges changed";
  if (now.fixed != before.fixed) return "a fixed vertex moved or vanished";
  if (now.frozen != before.frozen) return "a frozen tet changed";
  const bool exact = !before.shape || before.shape->is_flat();
  if (auto about = complaint_about_regions(before, now, exact); !about.empty()) {
    return about;
  }
  if (before.shape) {
    auto about = complaint_about_shape(*before.shape, *now.shape);
    if (!about.empty()) return about;
  }
  for (const TetVertices& tet : now.doubtful) {
    if (!before.doubtful.contains(tet)) return "a tet is not certified positive";
  }
  if (now.not_positive > before.not_positive) return "more tets are inverted or flat";
  for (const TetHandle t : live_tets(mesh)) {
    const TetVertices& v = mesh.vertices(t);
    const double q = mesh.standard().quality(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]),
                                             mesh.point(v[3]));
    if (mesh.quality(t) != static_cast<Quality>(q)) return "a cached quality is stale";
  }
  try {
    const TetMesh rebuilt(mesh.to_data());
    if (rebuilt.tet_count() != mesh.tet_count()) return "tets were lost on the way to a file";
  } catch (const Error& error) {
    return std::string("the mesh cannot be built again: ") + error.what();
  }
  return "";
}

std::string complaint_about(const Portrait& before, const TetMesh& mesh) {
  if (const auto loss = complaint_about_loss(before, mesh); !loss.empty()) return loss;
  const bool better = strictly_better(portrait(mesh).qualities, before.qualities);
  return better ? "" : "the quality vector is not better";
}

}  // namespace tetmend::contract
