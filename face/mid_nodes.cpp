// SPDX-License-Identifier: MIT
#include "face/mid_nodes.h"

#include <algorithm>
#include <array>
#include <span>

#include <tetmend/improve.h>

#include "kernel/second_order.h"

namespace tetmend::face {

namespace {

using Edge = std::array<std::uint32_t, 2>;

template <class Elements>
void append_edges(const Elements& elements, std::vector<Edge>& edges) {
  for (const auto& element : elements) {
    const std::size_t n = element.vertices.size();
    for (std::size_t e = 0; e < n * (n - 1) / 2; ++e) {
      const std::uint32_t a = element.vertices[kMidNodeEdges[e][0]];
      const std::uint32_t b = element.vertices[kMidNodeEdges[e][1]];
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
}

/// Each once, ascending.
void make_list(std::vector<Edge>& edges) {
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

class Renewal {
 public:
  Renewal(const MeshData& before, std::vector<std::uint32_t>& vertex_map, MeshData& now)
      : before_(before), vertex_map_(vertex_map), now_(now), is_used_(now.points.size(), true) {
    for (const auto& mid : before.mid_nodes) is_used_[vertex_map[mid[2]]] = false;
    for (const OtherElements& others : before.other_elements) {
      for (const std::uint32_t v : others.vertices) is_used_[vertex_map[v]] = true;
    }
  }

  void run() {
    std::vector<Edge> of_tets;
    append_edges(now_.tets, of_tets);
    make_list(of_tets);
    std::vector<Edge> all = of_tets;
    append_edges(now_.triangles, all);
    append_edges(now_.edges, all);
    make_list(all);
    keep_old(all);
    if (!had_curved_tets()) of_tets.clear();
    for (const Edge& edge : of_tets) {
      if (!std::binary_search(kept_.begin(), kept_.end(), edge)) add(edge);
    }
    drop_unused();
  }

 private:
  /// False where only triangles or edges are of second order. Tets all are, or none is.
  bool had_curved_tets() const {
    std::vector<Edge> edges;
    append_edges(std::span(before_.tets).first(std::min<std::size_t>(1, before_.tets.size())),
                 edges);
    return std::any_of(before_.mid_nodes.begin(), before_.mid_nodes.end(), [&](const auto& mid) {
      const Edge edge = {std::min(mid[0], mid[1]), std::max(mid[0], mid[1])};
      return std::find(edges.begin(), edges.end(), edge) != edges.end();
    });
  }

  /// The old nodes of edges that are still there.
  void keep_old(const std::vector<Edge>& edges) {
    for (const auto& mid : before_.mid_nodes) {
      const std::uint32_t a = vertex_map_[mid[0]];
      const std::uint32_t b = vertex_map_[mid[1]];
      if (a == kGone || b == kGone) continue;
      const Edge edge = {std::min(a, b), std::max(a, b)};
      if (!std::binary_search(edges.begin(), edges.end(), edge)) continue;
      const std::uint32_t node = vertex_map_[mid[2]];
      is_used_[node] = true;
      kept_.push_back(edge);
      now_.mid_nodes.push_back({edge[0], edge[1], node});
      const bool is_same =
          now_.points[a] == before_.points[mid[0]] && now_.points[b] == before_.points[mid[1]];
      if (!is_same) now_.points[node] = middle(edge);
    }
    std::sort(kept_.begin(), kept_.end());
  }

  void add(const Edge& edge) {
    const auto node = static_cast<std::uint32_t>(now_.points.size());
    now_.mid_nodes.push_back({edge[0], edge[1], node});
    now_.points.push_back(middle(edge));
    if (!now_.point_labels.empty()) now_.point_labels.push_back(0);
    is_used_.push_back(true);
  }

  Point middle(const Edge& edge) const { return (now_.points[edge[0]] + now_.points[edge[1]]) / 2; }

  void drop_unused() {
    std::vector<std::uint32_t> number_of(now_.points.size(), kNoMidNode);
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < number_of.size(); ++i) {
      if (is_used_[i]) number_of[i] = count++;
    }
    renumber_points(now_, number_of, count);
    for (std::uint32_t& v : vertex_map_) v = v == kGone ? kGone : number_of[v];
  }

  const MeshData& before_;
  std::vector<std::uint32_t>& vertex_map_;
  MeshData& now_;
  std::vector<bool> is_used_;  // by number in now_
  std::vector<Edge> kept_;     // ascending, when all are there
};

}  // namespace

void renew_mid_nodes(const MeshData& before, std::vector<std::uint32_t>& vertex_map,
                     MeshData& now) {
  if (!before.mid_nodes.empty()) Renewal(before, vertex_map, now).run();
}

}  // namespace tetmend::face
