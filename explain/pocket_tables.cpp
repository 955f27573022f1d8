// SPDX-License-Identifier: MIT
#include "explain/pocket_tables.h"

#include <algorithm>
#include <array>
#include <limits>

#include "search/covering_search.h"

namespace tetmend::explain {

namespace {

constexpr Quality kBest = std::numeric_limits<Quality>::infinity();

/// The worst qualities, ascending, padded with +infinity.
using Ranking = CoveringSearch::Ranking;

void add(Ranking& ranking, Quality q) {
  for (Quality& place : ranking) {
    if (q < place) std::swap(q, place);
  }
}

class Filling {
 public:
  Filling(const SlotMesh& mesh, VertexHandle a, VertexHandle b,
          const std::vector<VertexHandle>& ring, const ShellLocks& locks)
      : mesh_(mesh), a_(a), b_(b), ring_(ring), locks_(locks), m_(ring.size()) {
    tables_.size = m_;
    tables_.quality.assign(m_ * m_, 0);
    tables_.apex.assign(m_ * m_, static_cast<unsigned>(m_));
    rankings_.assign(m_ * m_, Ranking{});
  }

  PocketTables fill() {
    evaluate_triangles();
    for (std::size_t i = 0; i < m_; ++i) {
      if (!is_locked_edge(i)) rankings_[i * m_ + (i + 1) % m_].fill(kBest);
      tables_.quality[i * m_ + (i + 1) % m_] = kBest;
    }
    for (std::size_t d = 2; d < m_; ++d) {
      for (std::size_t i = 0; i < m_; ++i) fill_pocket(i, d);
    }
    return std::move(tables_);
  }

 private:
  bool is_locked_edge(std::size_t i) const { return ((locks_.edges >> i) & 1u) != 0; }
  bool is_locked_vertex(std::size_t i) const { return ((locks_.vertices >> i) & 1u) != 0; }

  Quality quality(VertexHandle p, VertexHandle q, VertexHandle r, VertexHandle s) const {
    return static_cast<Quality>(
        standard_.quality(mesh_.point(p), mesh_.point(q), mesh_.point(r), mesh_.point(s)));
  }

  void evaluate_triangles() {
    both_.resize(m_ * m_ * m_);
    for (std::size_t i = 0; i < m_; ++i) {
      for (std::size_t k = i + 1; k < m_; ++k) {
        for (std::size_t j = k + 1; j < m_; ++j) {
          auto& [upper, lower] = both_[(i * m_ + k) * m_ + j];
          upper = quality(a_, ring_[i], ring_[k], ring_[j]);
          lower = quality(ring_[i], ring_[k], ring_[j], b_);
          tables_.triangles.push_back(std::max(std::min(upper, lower), Quality(0)));
        }
      }
    }
  }

  std::array<Quality, 2> triangle(std::size_t i, std::size_t k, std::size_t j) const {
    std::array<std::size_t, 3> corners = {i, k, j};
    std::sort(corners.begin(), corners.end());
    return both_[(corners[0] * m_ + corners[1]) * m_ + corners[2]];
  }

  void fill_pocket(std::size_t i, std::size_t d) {
    const std::size_t j = (i + d) % m_;
    const bool is_whole = d + 1 == m_;  // its last side is one of the ring
    if (is_whole ? is_locked_edge(j) : is_locked_vertex(i) || is_locked_vertex(j)) return;
    Ranking& best = rankings_[i * m_ + j];
    for (std::size_t step = 1; step < d; ++step) {
      const std::size_t k = (i + step) % m_;
      const auto [upper, lower] = triangle(i, k, j);
      const Ranking& left = rankings_[i * m_ + k];
      const Ranking& right = rankings_[k * m_ + j];
      if (std::min({upper, lower, left[0], right[0]}) <= 0) continue;
      Ranking all = left;
      for (const Quality q : right) add(all, q);
      add(all, upper);
      add(all, lower);
      if (all <= best) continue;  // the first of equals stays
      best = all;
      tables_.apex[i * m_ + j] = static_cast<unsigned>(k);
      tables_.quality[i * m_ + j] = best[0];
    }
  }

  const SlotMesh& mesh_;
  Standard standard_ = standard_of_drawings(mesh_);
  VertexHandle a_, b_;
  const std::vector<VertexHandle>& ring_;
  ShellLocks locks_;
  std::size_t m_;
  PocketTables tables_;
  std::vector<Ranking> rankings_;             // all 0: none
  std::vector<std::array<Quality, 2>> both_;  // tets of the triangles
};

}  // namespace

PocketTables fill_tables(const SlotMesh& mesh, VertexHandle a, VertexHandle b,
                         const std::vector<VertexHandle>& ring, const ShellLocks& locks) {
  if (ring.size() < 3 || ring.size() > kMaxSearchRing) return {};
  return Filling(mesh, a, b, ring, locks).fill();
}

}  // namespace tetmend::explain
