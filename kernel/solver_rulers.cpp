// SPDX-License-Identifier: MIT
// The diagonals of P1 matrices: the shares of tets are computed four at a time by all threads, and
// added to the vertices in the order of the tets by one.
#include "kernel/solver_rulers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "kernel/chunks.h"
#include "kernel/index_set.h"
#include "kernel/star.h"
#include "kernel/tet_rows.h"

namespace tetmend {

namespace {

/// Six volumes, and the square of twice the area of each face.
using Shares = WideRows<5>;

TETMEND_WIDE void compute_shares(const PointRows<4>& rows,
                                 std::array<Shares, PointRows<4>::kMost / kWideLanes>& shares) {
  for (std::size_t g = 0; g < rows.groups(); ++g) {
    const WidePoint p0 = wide_point(rows.group(g), 0), p1 = wide_point(rows.group(g), 1);
    const WidePoint p2 = wide_point(rows.group(g), 2), p3 = wide_point(rows.group(g), 3);
    const WidePoint u = p1 - p0, v = p2 - p0, w = p3 - p0;
    const WidePoint a = cross(p2 - p1, p3 - p1), b = cross(v, w), c = cross(w, u), d = cross(u, v);
    WideVector* const to = shares[g].vectors();
    to[0] = dot(u, b);
    to[1] = dot(a, a);
    to[2] = dot(b, b);
    to[3] = dot(c, c);
    to[4] = dot(d, d);
  }
}

/// By slot, from the first of a range; nothing for deleted ones.
using DiagonalBuffer = std::vector<P1Diagonal>;

void fill_diagonals(const TetMesh& mesh, std::size_t begin, std::size_t end, std::size_t first,
                    DiagonalBuffer& buffer) {
  std::array<Shares, PointRows<4>::kMost / kWideLanes> shares;
  visit_rows(mesh, begin, end, 1, [&](const TetRows& rows) {
    compute_shares(rows.points, shares);
    for (std::size_t i = 0; i < rows.points.size(); ++i) {
      const auto& of = shares[i / kWideLanes].of;
      const std::size_t lane = i % kWideLanes;
      const double v6 = of[0][lane];
      P1Diagonal& diagonal = buffer[rows.tets[i].index() - first];
      diagonal.mass = v6 / 24;
      const double scale = 1 / (6 * v6);
      for (std::size_t k = 0; k < 4; ++k) diagonal.stiffness[k] = of[k + 1][lane] * scale;
    }
  });
}

}  // namespace

P1Diagonals p1_diagonals(const TetMesh& mesh, double* step) {
  constexpr std::size_t kAtOnce = 64 * kChunkSize;
  P1Diagonals sums;
  sums.mass.resize(mesh.vertex_slots());
  sums.stiffness.resize(mesh.vertex_slots());
  DiagonalBuffer buffer(std::min(kAtOnce, mesh.tet_slots()));
  bool positive = mesh.tet_count() > 0;
  for (std::size_t first = 0; first < mesh.tet_slots(); first += kAtOnce) {
    const std::size_t size = std::min(kAtOnce, mesh.tet_slots() - first);
    for_chunks(size, [&](std::size_t begin, std::size_t end) {
      fill_diagonals(mesh, first + begin, first + end, first, buffer);
    });
    for (std::size_t i = 0; i < size; ++i) {
      const TetHandle t(static_cast<std::uint32_t>(first + i));
      if (mesh.is_deleted(t)) continue;
      const P1Diagonal& diagonal = buffer[i];
      positive = positive && diagonal.mass > 0;
      const TetVertices& v = mesh.vertices(t);
      for (std::size_t k = 0; k < 4; ++k) {
        sums.mass[v[k].index()] += diagonal.mass;
        sums.stiffness[v[k].index()] += diagonal.stiffness[k];
      }
    }
  }
  if (step == nullptr) return sums;
  *step = 0;
  if (!positive) return sums;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sums.mass.size(); ++i) {
    if (sums.mass[i] > 0) least = std::min(least, sums.mass[i] / sums.stiffness[i]);
  }
  *step = std::sqrt(least);
  return sums;
}

double stable_step(const TetMesh& mesh) {
  double step = 0;
  p1_diagonals(mesh, &step);
  return step;
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
