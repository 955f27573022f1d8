// SPDX-License-Identifier: MIT
#include "kernel/curved.h"

#include <algorithm>
#include <utility>

#include "kernel/second_order.h"
#include "kernel/tet_faces.h"
#include "kernel/tet_mesh.h"

namespace tetmend {

namespace {

/// A bend below this share of the length of its edge is rounding of the file.
constexpr double kStraight = 1e-6;
/// Within the volume nothing fixes an edge but its bend: a slight one is let go.
constexpr double kSlightBend = 1e-3;

bool is_bent(const MeshData& data, const std::array<std::uint32_t, 3>& mid, double share) {
  const Point& a = data.points[mid[0]];
  const Point& b = data.points[mid[1]];
  const Point bend = data.points[mid[2]] - (a + b) / 2;
  return bend.squaredNorm() > share * share * (b - a).squaredNorm();
}

/// The Bezier coefficients of the Jacobian determinant. Coefficient (i, j, k) with i <= j <= k is
/// that of lambda_i lambda_j lambda_k, by its place in lexicographic order.
class Bezier {
 public:
  Bezier(const std::array<Point, 4>& vertices, const std::array<Point, 6>& bends) {
    const auto columns = derivatives(vertices, bends);
    std::array<int, 20> terms{};
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < 4; ++b) {
        const Point normal = columns[a][0].cross(columns[b][1]);
        for (std::size_t c = 0; c < 4; ++c) {
          const std::size_t place = place_of(a, b, c);
          values_[place] += normal.dot(columns[c][2]);
          ++terms[place];
        }
      }
    }
    for (std::size_t i = 0; i < 20; ++i) values_[i] /= terms[i];
  }

  const std::array<double, 20>& coefficients() const { return values_; }
  double at_vertex(std::size_t i) const { return values_[place_of(i, i, i)]; }
  double at_middle(std::size_t i, std::size_t j) const {
    return (at_vertex(i) + at_vertex(j) +
            3 * (values_[place_of(i, i, j)] + values_[place_of(i, j, j)])) /
           8;
  }

 private:
  /// Columns of the Jacobian at each vertex; between them it is linear.
  static std::array<std::array<Point, 3>, 4> derivatives(const std::array<Point, 4>& vertices,
                                                         const std::array<Point, 6>& bends) {
    std::array<std::array<Point, 4>, 4> control;  // of the edges, of Bezier's form
    for (std::size_t i = 0; i < 4; ++i) control[i][i] = vertices[i];
    for (std::size_t e = 0; e < 6; ++e) {
      const auto& [i, j] = kMidNodeEdges[e];
      control[i][j] = control[j][i] = (vertices[i] + vertices[j]) / 2 + 2 * bends[e];
    }
    std::array<std::array<Point, 3>, 4> columns;
    for (std::size_t v = 0; v < 4; ++v) {
      for (std::size_t k = 0; k < 3; ++k) columns[v][k] = 2 * (control[v][k + 1] - control[v][0]);
    }
    return columns;
  }

  static std::size_t place_of(std::size_t a, std::size_t b, std::size_t c) {
    std::array<std::size_t, 3> sorted = {a, b, c};
    std::sort(sorted.begin(), sorted.end());
    static constexpr auto kPlaces = [] {
      std::array<std::array<std::array<std::uint8_t, 4>, 4>, 4> places{};
      std::uint8_t next = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = i; j < 4; ++j) {
          for (std::size_t k = j; k < 4; ++k) places[i][j][k] = next++;
        }
      }
      return places;
    }();
    return kPlaces[sorted[0]][sorted[1]][sorted[2]];
  }

  std::array<double, 20> values_{};
};

double ratio(double least, double greatest) {
  if (!(greatest > 0)) return -1;
  return std::max(least / greatest, -1.0);
}

/// Edges that no run changes: of faces between two regions or outside, and, with the interior, those
/// that are named. Ascending.
std::vector<std::uint64_t> edges_that_stay(const MeshData& data, bool with_interior) {
  std::vector<std::uint64_t> edges;
  const auto add = [&](std::uint32_t a, std::uint32_t b) { edges.push_back(edge_key(a, b)); };
  const auto add_triangle = [&](const std::array<std::uint32_t, 3>& v) {
    add(v[0], v[1]);
    add(v[1], v[2]);
    add(v[0], v[2]);
  };
  const auto part_of = [&](std::uint32_t t) {
    return std::pair(data.tets[t].label, data.tet_parts.empty() ? 0 : data.tet_parts[t]);
  };
  for_face_pairs(sorted_tet_faces(data), [&](const TetFace& face, const TetFace* other) {
    if (other == nullptr || part_of(face.tet) != part_of(other->tet)) add_triangle(face.vertices);
  });
  if (with_interior) {
    for (const MeshData::Triangle& triangle : data.triangles) add_triangle(triangle.vertices);
    for (const MeshData::Edge& edge : data.edges) add(edge.vertices[0], edge.vertices[1]);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

void count(CurvedStatistics& statistics, const JacobianRatio& one) {
  ++statistics.curved;
  statistics.turned_over += one.at_nodes <= 0;
  JacobianRatio& worst = statistics.worst;
  worst.at_nodes = std::min(worst.at_nodes, one.at_nodes);
  worst.bound = std::min(worst.bound, one.bound);
}

}  // namespace

CurvedTet::CurvedTet(const MeshData& data, const MidNodes& mid_nodes, const MeshData::Tet& tet) {
  for (std::size_t i = 0; i < 4; ++i) vertices[i] = data.points[tet.vertices[i]];
  for (std::size_t e = 0; e < 6; ++e) {
    const std::uint32_t a = tet.vertices[kMidNodeEdges[e][0]];
    const std::uint32_t b = tet.vertices[kMidNodeEdges[e][1]];
    nodes[e] = mid_nodes.of(a, b);
    bends[e] = Point::Zero();
    if (nodes[e] == kNoMidNode || !is_bent(data, {a, b, nodes[e]}, kStraight)) continue;
    bends[e] = data.points[nodes[e]] - (data.points[a] + data.points[b]) / 2;
    is_curved = true;
  }
}

JacobianRatio jacobian_ratio(const std::array<Point, 4>& vertices,
                             const std::array<Point, 6>& bends) {
  const Bezier bezier(vertices, bends);
  std::array<double, 10> nodes{};
  for (std::size_t i = 0; i < 4; ++i) nodes[i] = bezier.at_vertex(i);
  for (std::size_t e = 0; e < 6; ++e) {
    nodes[4 + e] = bezier.at_middle(kMidNodeEdges[e][0], kMidNodeEdges[e][1]);
  }
  const auto& all = bezier.coefficients();
  const auto [least, greatest] = std::minmax_element(all.begin(), all.end());
  const auto [least_node, greatest_node] = std::minmax_element(nodes.begin(), nodes.end());
  // The greatest value is between these two: a bound takes the one that makes it lower.
  const double divisor = *least < 0 ? *greatest_node : *greatest;
  return {ratio(*least_node, *greatest_node), ratio(*least, divisor)};
}

std::array<double, 20> jacobian_coefficients(const std::array<Point, 4>& vertices,
                                             const std::array<Point, 6>& bends) {
  return Bezier(vertices, bends).coefficients();
}

CurvedStatistics curved_statistics(const MeshData& data) {
  CurvedStatistics statistics;
  statistics.mid_nodes = data.mid_nodes.size();
  const MidNodes mid_nodes(data.mid_nodes);
  for (const MeshData::Tet& tet : data.tets) {
    const CurvedTet curved(data, mid_nodes, tet);
    if (curved.is_curved) count(statistics, jacobian_ratio(curved.vertices, curved.bends));
  }
  return statistics;
}

CurvedStatistics curved_statistics(const MeshData& data, const TetMesh& mesh) {
  return CurvedEdges(data, mesh, std::vector<bool>(data.mid_nodes.size(), true)).statistics(mesh);
}

FixedMidNodes find_fixed_mid_nodes(const MeshData& data, bool with_interior) {
  FixedMidNodes fixed;
  if (data.mid_nodes.empty()) return fixed;
  const std::vector<std::uint64_t> stay = edges_that_stay(data, with_interior);
  std::vector<bool> is_required(data.points.size(), false);
  for (const std::uint32_t v : data.required_vertices) is_required[v] = true;
  for (const auto& mid : data.mid_nodes) {
    const bool stays = std::binary_search(stay.begin(), stay.end(), edge_key(mid[0], mid[1]));
    const bool is_held = with_interior && (is_required[mid[2]] || is_bent(data, mid, kSlightBend));
    fixed.is_fixed.push_back(stays || is_held);
    if (is_held && !stays) fixed.inside.push_back({{mid[0], mid[1]}, 0});
  }
  return fixed;
}

CurvedEdges::CurvedEdges(const MeshData& data, const TetMesh& mesh, bool with_interior)
    : CurvedEdges(data, mesh, find_fixed_mid_nodes(data, with_interior).is_fixed) {
  least_ = curved_statistics(data, mesh).worst;
}

CurvedEdges::CurvedEdges(const MeshData& data, const TetMesh& mesh, const std::vector<bool>& which)
    : mid_nodes_(data.mid_nodes.size()) {
  std::vector<std::uint32_t> slot_of(data.points.size(), kNoMidNode);
  for (std::uint32_t slot = 0; slot < mesh.vertex_slots(); ++slot) {
    const VertexHandle v(slot);
    const std::uint32_t number = mesh.is_deleted(v) ? TetMesh::kNotFromFile : mesh.origin(v);
    if (number != TetMesh::kNotFromFile) slot_of[number] = slot;
  }
  has_curved_.assign(mesh.vertex_slots(), false);
  for (std::size_t i = 0; i < data.mid_nodes.size(); ++i) {
    const auto& [a, b, node] = data.mid_nodes[i];
    if (!which[i] || !is_bent(data, data.mid_nodes[i], kStraight)) continue;
    const Point bend = data.points[node] - (data.points[a] + data.points[b]) / 2;
    edges_.push_back({edge_key(slot_of[a], slot_of[b]), bend});
    has_curved_[slot_of[a]] = has_curved_[slot_of[b]] = true;
  }
  std::sort(edges_.begin(), edges_.end(),
            [](const Edge& a, const Edge& b) { return a.ends < b.ends; });
}

const Point* CurvedEdges::bend_of(VertexHandle a, VertexHandle b) const {
  const std::uint64_t ends = edge_key(a.index(), b.index());
  const auto found =
      std::lower_bound(edges_.begin(), edges_.end(), ends,
                       [](const Edge& edge, std::uint64_t key) { return edge.ends < key; });
  return found != edges_.end() && found->ends == ends ? &found->bend : nullptr;
}

std::optional<JacobianRatio> CurvedEdges::ratio_of(const TetMesh& mesh,
                                                   const TetVertices& vertices) const {
  std::size_t count = 0;
  for (const VertexHandle v : vertices) {
    count += v.index() < has_curved_.size() && has_curved_[v.index()];
  }
  if (count < 2) return std::nullopt;
  std::array<Point, 6> bends;
  bool is_curved = false;
  for (std::size_t e = 0; e < 6; ++e) {
    const Point* bend = bend_of(vertices[kMidNodeEdges[e][0]], vertices[kMidNodeEdges[e][1]]);
    is_curved |= bend != nullptr;
    bends[e] = bend == nullptr ? Point(Point::Zero()) : *bend;
  }
  if (!is_curved) return std::nullopt;
  std::array<Point, 4> points;
  for (std::size_t i = 0; i < 4; ++i) points[i] = mesh.point(vertices[i]);
  return jacobian_ratio(points, bends);
}

bool CurvedEdges::admit(const TetMesh& mesh, const TetVertices& vertices) const {
  const auto now = ratio_of(mesh, vertices);
  return !now ||
         (now->at_nodes > 0 && now->at_nodes >= least_.at_nodes && now->bound >= least_.bound);
}

CurvedStatistics CurvedEdges::statistics(const TetMesh& mesh) const {
  CurvedStatistics statistics;
  statistics.mid_nodes = mid_nodes_;
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    const TetHandle t(slot);
    if (mesh.is_deleted(t)) continue;
    if (const auto one = ratio_of(mesh, mesh.vertices(t))) count(statistics, *one);
  }
  return statistics;
}

}  // namespace tetmend
