// SPDX-License-Identifier: MIT
// Feature edges, corners and lines.
#include <algorithm>
#include <iterator>
#include <numeric>

#include "envelope/feature_finder.h"

namespace tetmend {

void FeatureFinder::collect_edges() {
  auto named = named_.begin();
  for (std::size_t g = 0; g + 1 < group_.size(); ++g) {
    const Ends& ends = sides_[group_[g]].ends;
    for (; named != named_.end() && named->vertices < ends; ++named) {  // not on the surface
      for (const VertexHandle v : named->vertices) keep(v);
    }
    const bool is_named = named != named_.end() && named->vertices == ends;
    const Label label = is_named ? named->label : 0;
    while (named != named_.end() && named->vertices == ends) ++named;
    if (smooth_[g]) continue;
    edges_.push_back({ends, group_[g], group_[g + 1], label, is_named, are_held(ends)});
  }
  for (; named != named_.end(); ++named) {
    for (const VertexHandle v : named->vertices) keep(v);
  }
  first_edge_.assign(points_.size() + 1, 0);
  for (const FeatureEdge& edge : edges_) {
    for (const VertexHandle v : edge.ends) ++first_edge_[v.index() + 1];
  }
  std::partial_sum(first_edge_.begin(), first_edge_.end(), first_edge_.begin());
  edges_of_.resize(2 * edges_.size());
  std::vector<std::uint32_t> next(first_edge_.begin(), std::prev(first_edge_.end()));
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    for (const VertexHandle v : edges_[e].ends) edges_of_[next[v.index()]++] = e;
  }
}

/// The line turns at v by more than the feature angle. Straight lines are found later.
bool FeatureFinder::bends(std::uint32_t e, std::uint32_t f, VertexHandle v) const {
  const auto away = [&](std::uint32_t edge) {
    const Ends& ends = edges_[edge].ends;
    return (point(ends[0] == v ? ends[1] : ends[0]) - point(v)).normalized();
  };
  return !(-away(e).dot(away(f)) >= least_cosine_);
}

/// Both edges lie between the same patches, as seen along the line.
bool FeatureFinder::same_sides(const FeatureEdge& a, const FeatureEdge& b,
                               VertexHandle middle) const {
  const auto list = [&](const FeatureEdge& edge, bool into) {
    std::vector<std::pair<std::uint32_t, bool>> patches;
    const bool up = (edge.ends[1] == middle) == into;
    for (std::uint32_t s = edge.first_side; s < edge.last_side; ++s) {
      patches.emplace_back(found_.faces[sides_[s].face].patch, sides_[s].up == up);
    }
    std::sort(patches.begin(), patches.end());
    return patches;
  };
  return list(a, true) == list(b, false);
}

void FeatureFinder::find_corners() {
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    const VertexHandle v(i);
    SurfacePlace& place = found_.places[i];
    if (place == SurfacePlace::inside) continue;
    const auto edges = edges_at(v);
    if (!edges.empty()) {
      place = SurfacePlace::ridge;
      if (edges.size() != 2 || edges_[edges[0]].named != edges_[edges[1]].named ||
          edges_[edges[0]].label != edges_[edges[1]].label || bends(edges[0], edges[1], v) ||
          !same_sides(edges_[edges[0]], edges_[edges[1]], v)) {
        place = SurfacePlace::corner;
      }
    }
  }
  for (const VertexHandle v : kept_) {
    if (found_.places[v.index()] != SurfacePlace::inside) {
      found_.places[v.index()] = SurfacePlace::corner;
    }
  }
  mark_pinched();
}

/// Of each vertex: into how many parts its faces fall that smooth edges join.
std::vector<std::uint32_t> FeatureFinder::count_fans() const {
  std::vector<std::uint32_t> parent(3 * found_.faces.size());  // of corners of faces
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t c) {
    while (parent[c] != c) c = parent[c] = parent[parent[c]];
    return c;
  };
  const auto corner = [&](std::uint32_t face, VertexHandle v) {
    const auto& w = found_.faces[face].vertices;
    return 3 * face + (w[0] == v ? 0u : w[1] == v ? 1u : 2u);
  };
  for (std::size_t g = 0; g + 1 < group_.size(); ++g) {
    if (!smooth_[g]) continue;
    const Side* pair = &sides_[group_[g]];
    for (const VertexHandle v : pair->ends) {
      parent[root(corner(pair[0].face, v))] = root(corner(pair[1].face, v));
    }
  }
  std::vector<std::uint32_t> fans(points_.size(), 0);
  for (std::uint32_t c = 0; c < parent.size(); ++c) {
    fans[found_.faces[c / 3].vertices[c % 3].index()] += root(c) == c;
  }
  return fans;
}

/// Sheets that touch at a vertex give it more fans than its feature edges explain: one without
/// them, else one for each two sides of feature edges.
void FeatureFinder::mark_pinched() {
  std::vector<std::uint32_t> sides(points_.size(), 0);
  for (const FeatureEdge& edge : edges_) {
    for (const VertexHandle v : edge.ends) sides[v.index()] += edge.last_side - edge.first_side;
  }
  const std::vector<std::uint32_t> fans = count_fans();
  for (std::uint32_t v = 0; v < fans.size(); ++v) {
    const std::uint32_t expected = sides[v] == 0 ? 2 : sides[v];
    if (found_.places[v] != SurfacePlace::inside && 2 * fans[v] != expected) {
      found_.places[v] = SurfacePlace::corner;
    }
  }
}

void FeatureFinder::make_lines() {
  std::vector<char> done(edges_.size(), 0);
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    const VertexHandle v(i);
    if (found_.places[i] != SurfacePlace::corner) continue;
    for (const std::uint32_t e : edges_at(v)) {
      if (!done[e]) walk(v, e, done);
    }
  }
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {  // rings without a corner
    if (!done[e]) walk(edges_[e].ends[0], e, done);
  }
}

/// The line from a vertex on, until a corner or back to the vertex.
void FeatureFinder::walk(VertexHandle from, std::uint32_t edge, std::vector<char>& done) {
  std::vector<VertexHandle> chain = {from};
  const std::uint32_t first = edge;
  for (VertexHandle v = from;;) {
    done[edge] = 1;
    const Ends& ends = edges_[edge].ends;
    v = ends[0] == v ? ends[1] : ends[0];
    chain.push_back(v);
    if (v == from || found_.places[v.index()] == SurfacePlace::corner) break;
    const auto edges = edges_at(v);
    edge = edges[0] == edge ? edges[1] : edges[0];
  }
  if (!options_.flat) return add_line(chain, first);
  if (chain.front() == chain.back()) found_.places[from.index()] = SurfacePlace::corner;
  for (std::size_t begin = 0; begin + 1 < chain.size();) {
    const std::size_t end = straight_end(chain, begin);
    found_.places[chain[end].index()] = SurfacePlace::corner;
    const auto from_begin = chain.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto to_end = chain.begin() + static_cast<std::ptrdiff_t>(end);
    add_line({from_begin, to_end + 1}, first);
    begin = end;
  }
}

/// How far the chain goes straight on: forwards all the time, with all vertices on one line.
std::size_t FeatureFinder::straight_end(const std::vector<VertexHandle>& chain,
                                        std::size_t begin) const {
  const Point& origin = point(chain[begin]);
  std::size_t end = begin + 1;
  for (; end + 1 < chain.size(); ++end) {
    const Point along = (point(chain[end + 1]) - origin).normalized();
    double last = 0;
    for (std::size_t i = begin + 1; i <= end + 1; ++i) {
      const Point d = point(chain[i]) - origin;
      const double t = d.dot(along);
      if (!(t > last) || (d - t * along).norm() > flatness_ / 2) return end;
      last = t;
    }
  }
  return end;
}

void FeatureFinder::add_line(const std::vector<VertexHandle>& chain, std::uint32_t edge) {
  const auto line = static_cast<std::uint32_t>(found_.lines.size());
  SurfaceFeatures::Line data{edges_[edge].label, edges_[edge].named, edges_[edge].held};
  if (options_.flat) {
    data.origin = point(chain.front());
    data.direction = (point(chain.back()) - data.origin).normalized();
  }
  found_.lines.push_back(data);
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    found_.edges.push_back({{chain[i], chain[i + 1]}, line});
  }
}

}  // namespace tetmend
