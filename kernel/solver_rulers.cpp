// SPDX-License-Identifier: MIT
// Sums over the tets around each vertex: the shares of tets are computed four at a time by all
// threads, and added to the vertices in the order of the tets by one.
//
//   estimate of CG steps: 8 (g^2 / lambda)^(3/8), whose powers and factor are fitted
//     g       largest row sum of |K| scaled by its diagonal, of inner vertices, over their tets one
//             by one: large where tets are flat; about the largest eigenvalue of the scaled matrix
//     lambda  u'Ku / u'Du, D the diagonal of K, for u = edges on the way to the surface: about the
//             smallest eigenvalue
#include "kernel/solver_rulers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "kernel/chunks.h"
#include "kernel/compensated_sum.h"
#include "kernel/index_set.h"
#include "kernel/star.h"
#include "kernel/tet_rows.h"

namespace tetmend {

namespace {

constexpr std::size_t kGroups = PointRows<4>::kMost / kWideLanes;

template <std::size_t N>
using Shares = std::array<WideRows<N>, kGroups>;

/// Calls compute(rows, shares) for blocks of tets, on all threads, then add(tet, share) with the N
/// numbers of each live tet, in their order. Buffers at most a million tets.
template <std::size_t N, class Compute, class Add>
void visit_shares(const TetMesh& mesh, const Compute& compute, const Add& add) {
  constexpr std::size_t kAtOnce = 64 * kChunkSize;
  std::vector<std::array<double, N>> buffer(std::min(kAtOnce, mesh.tet_slots()));
  for (std::size_t first = 0; first < mesh.tet_slots(); first += kAtOnce) {
    const std::size_t size = std::min(kAtOnce, mesh.tet_slots() - first);
    for_chunks(size, [&](std::size_t begin, std::size_t end) {
      Shares<N> shares;
      visit_rows(mesh, first + begin, first + end, 1, [&](const TetRows& rows) {
        compute(rows, shares);
        for (std::size_t i = 0; i < rows.points.size(); ++i) {
          std::array<double, N>& to = buffer[rows.tets[i].index() - first];
          for (std::size_t k = 0; k < N; ++k) {
            to[k] = shares[i / kWideLanes].of[k][i % kWideLanes];
          }
        }
      });
    });
    for (std::size_t i = 0; i < size; ++i) {
      const TetHandle t(static_cast<std::uint32_t>(first + i));
      if (!mesh.is_deleted(t)) add(t, buffer[i]);
    }
  }
}

/// Normals of the four faces, twice the areas long, and six volumes.
struct WideFaces {
  std::array<WidePoint, 4> normal;
  WideVector v6;
};

TETMEND_WIDE_INLINE WideFaces faces_of(const PointRows<4>& rows, std::size_t g) {
  const WidePoint p0 = wide_point(rows.group(g), 0), p1 = wide_point(rows.group(g), 1);
  const WidePoint p2 = wide_point(rows.group(g), 2), p3 = wide_point(rows.group(g), 3);
  const WidePoint u = p1 - p0, v = p2 - p0, w = p3 - p0;
  const WidePoint b = cross(v, w);
  return {{cross(p3 - p1, p2 - p1), b, cross(w, u), cross(u, v)}, dot(u, b)};
}

/// Mass of a vertex, then the diagonal of the stiffness matrix.
TETMEND_WIDE void compute_diagonals(const PointRows<4>& rows, Shares<5>& shares) {
  for (std::size_t g = 0; g < rows.groups(); ++g) {
    const WideFaces faces = faces_of(rows, g);
    WideVector* const to = shares[g].vectors();
    const WideVector scale = 1.0 / (6.0 * faces.v6);
    to[0] = faces.v6 / 24.0;
    for (std::size_t i = 0; i < 4; ++i) {
      to[i + 1] = scale * dot(faces.normal[i], faces.normal[i]);
    }
  }
}

/// Of the vertices of a block of tets: a scale, and edges on the way to the surface.
struct VertexRows {
  std::array<WideRows<4>, kGroups> scale{};
  std::array<WideRows<4>, kGroups> depth{};
};

/// The product of the stiffness matrix, without signs, and the scale; then the energy of `depth`.
TETMEND_WIDE void compute_products(const PointRows<4>& rows, const VertexRows& vertices,
                                   Shares<5>& shares) {
  for (std::size_t g = 0; g < rows.groups(); ++g) {
    const WideFaces faces = faces_of(rows, g);
    const WideVector* const scale = vertices.scale[g].vectors();
    const WideVector* const depth = vertices.depth[g].vectors();
    WideVector* const to = shares[g].vectors();
    const WideVector inverse = 1.0 / (6.0 * faces.v6);
    WidePoint gradient = {};
    for (std::size_t i = 0; i < 4; ++i) {
      const WidePoint& n = faces.normal[i];
      WideVector sum = {};
      for (std::size_t j = 0; j < 4; ++j) {
        sum += magnitude(dot(n, faces.normal[j])) * scale[j];
      }
      to[i] = inverse * sum;
      const WideVector rise = depth[i] - depth[0];
      gradient = {gradient.x + rise * n.x, gradient.y + rise * n.y, gradient.z + rise * n.z};
    }
    to[4] = inverse * dot(gradient, gradient);
  }
}

/// By vertex: the number of edges on the way to the surface. Sweeps until nothing changes, so that
/// it depends on the mesh alone.
std::vector<std::uint32_t> find_depths(const TetMesh& mesh) {
  constexpr std::uint32_t kFar = std::numeric_limits<std::uint32_t>::max() / 2;
  std::vector<std::uint32_t> depths(mesh.vertex_slots(), kFar);
  for (std::uint32_t i = 0; i < depths.size(); ++i) {
    if (mesh.is_boundary(VertexHandle(i))) depths[i] = 0;
  }
  const auto relax = [&](std::size_t slot) {
    const TetHandle t(static_cast<std::uint32_t>(slot));
    if (mesh.is_deleted(t)) return false;
    std::uint32_t next = kFar;
    for (const VertexHandle v : mesh.vertices(t)) next = std::min(next, depths[v.index()] + 1);
    bool changed = false;
    for (const VertexHandle v : mesh.vertices(t)) {
      changed = changed || next < depths[v.index()];
      depths[v.index()] = std::min(depths[v.index()], next);
    }
    return changed;
  };
  bool changed = true;
  for (bool forward = true; changed; forward = !forward) {
    changed = false;
    for (std::size_t i = 0; i < mesh.tet_slots(); ++i) {
      changed = relax(forward ? i : mesh.tet_slots() - 1 - i) || changed;
    }
  }
  return depths;
}

}  // namespace

P1Diagonals p1_diagonals(const TetMesh& mesh) {
  P1Diagonals sums;
  sums.mass.resize(mesh.vertex_slots());
  sums.stiffness.resize(mesh.vertex_slots());
  sums.are_positive = mesh.tet_count() > 0;
  visit_shares<5>(
      mesh, [](const TetRows& rows, Shares<5>& shares) { compute_diagonals(rows.points, shares); },
      [&](TetHandle t, const std::array<double, 5>& share) {
        sums.are_positive = sums.are_positive && share[0] > 0;
        const TetVertices& v = mesh.vertices(t);
        for (std::size_t k = 0; k < 4; ++k) {
          sums.mass[v[k].index()] += share[0];
          sums.stiffness[v[k].index()] += share[k + 1];
        }
      });
  return sums;
}

double stable_step(const P1Diagonals& diagonals) {
  if (!diagonals.are_positive) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < diagonals.mass.size(); ++i) {
    const VertexHandle v(static_cast<std::uint32_t>(i));
    if (diagonals.is_in_use(v)) least = std::min(least, diagonals.step(v));
  }
  return least;
}

double stable_step(const TetMesh& mesh) {
  return stable_step(p1_diagonals(mesh));
}

double estimate_cg_steps(const TetMesh& mesh, const P1Diagonals& diagonals) {
  constexpr double kFactor = 8;
  if (!diagonals.are_positive) return 0;
  const std::vector<std::uint32_t> depths = find_depths(mesh);
  std::vector<double> scale(depths.size());
  CompensatedSum squares;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (depths[i] == 0 || !diagonals.is_in_use(VertexHandle(static_cast<std::uint32_t>(i))))
      continue;
    const double depth = depths[i];
    scale[i] = 1 / std::sqrt(diagonals.stiffness[i]);
    squares.add(diagonals.stiffness[i] * depth * depth);
  }
  std::vector<double> rows(depths.size());
  CompensatedSum energy;
  visit_shares<5>(
      mesh,
      [&](const TetRows& tets, Shares<5>& shares) {
        VertexRows vertices;
        for (std::size_t i = 0; i < tets.points.size(); ++i) {
          const TetVertices& v = mesh.vertices(tets.tets[i]);
          for (std::size_t k = 0; k < 4; ++k) {
            vertices.scale[i / kWideLanes].of[k][i % kWideLanes] = scale[v[k].index()];
            vertices.depth[i / kWideLanes].of[k][i % kWideLanes] = depths[v[k].index()];
          }
        }
        compute_products(tets.points, vertices, shares);
      },
      [&](TetHandle t, const std::array<double, 5>& share) {
        const TetVertices& v = mesh.vertices(t);
        for (std::size_t k = 0; k < 4; ++k) rows[v[k].index()] += share[k];
        energy.add(share[4]);
      });
  double largest = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) largest = std::max(largest, scale[i] * rows[i]);
  if (largest == 0) return 0;  // no inner vertex
  const double condition = largest * largest * squares.value() / energy.value();
  const double fourth = std::sqrt(std::sqrt(condition));
  return kFactor * fourth * std::sqrt(fourth);  // the power 3/8, the same on every machine
}

std::optional<double> squared_step_at(const TetMesh& mesh, VertexHandle v) {
  thread_local IndexSet seen;
  thread_local std::vector<TetHandle> star;
  seen.clear();
  star.assign(1, mesh.tet_of(v));
  seen.insert(star[0].index());
  double mass = 0;
  double stiffness = 0;
  for (std::size_t i = 0; i < star.size(); ++i) {
    const TetHandle t = star[i];
    const TetVertices& corners = mesh.vertices(t);
    unsigned at = 0;
    while (corners[at] != v) ++at;
    const auto& [j, k, l] = kFaceVertices[at];
    const Point& p = mesh.point(corners[j]);
    const Point normal = (mesh.point(corners[k]) - p).cross(mesh.point(corners[l]) - p);
    const double v6 = normal.dot(mesh.point(v) - p);
    mass += std::abs(v6) / 24;
    stiffness += normal.squaredNorm() / (6 * std::abs(v6));
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      if (f == at || mesh.is_boundary(face)) continue;
      const TetHandle next = mesh.twin(face).tet();
      if (seen.insert(next.index())) star.push_back(next);
    }
    if (star.size() > kMaxStar) return std::nullopt;
  }
  return mass / stiffness;
}

}  // namespace tetmend
