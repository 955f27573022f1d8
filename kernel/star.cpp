// SPDX-License-Identifier: MIT
// Breadth-first walks over the star of a vertex.
#include "kernel/star.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "kernel/shell.h"
#include "kernel/workspace.h"

namespace tetmend {

namespace {

/// The walk comes to the neighbours soon: memory is asked for their cells at once.
void prefetch_neighbours(const TetMesh& mesh, TetHandle t) {
  for (const HalfFace twin : mesh.neighbours(t)) {
    if (!twin.is_outside()) mesh.prefetch(twin.tet());
  }
}

constexpr std::size_t kAnySize = std::numeric_limits<std::size_t>::max();

/// Calls visit(opposite, entered) for each tet of the star until it returns true, or `most` tets are
/// not all: the half-face opposite v, and the one through which the walk came, invalid for the first.
template <class Visit>
StarKind walk_star(const TetMesh& mesh, VertexHandle v, Workspace& workspace, std::size_t most,
                   std::vector<HalfFace>& queue, Visit&& visit) {
  queue.clear();
  const TetHandle first = mesh.tet_of(v);
  if (!first.is_valid()) return StarKind::whole;
  if (!workspace.holds(mesh.vertices(first))) return StarKind::border;
  IndexSet& seen = workspace.star_set;
  seen.clear();
  seen.insert(first.index());
  queue.push_back(HalfFace(first, mesh.local_index(first, v)));
  if (visit(queue.back(), HalfFace())) return StarKind::whole;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const HalfFace opposite = queue[i];
    const auto& neighbours = mesh.neighbours(opposite.tet());
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace twin = neighbours[f];
      if (f == opposite.face() || twin.is_outside() || !seen.insert(twin.tet().index())) continue;
      if (!workspace.holds(mesh.vertices(twin.tet())[twin.face()])) return StarKind::border;
      if (queue.size() == most) return StarKind::too_large;
      queue.push_back(HalfFace(twin.tet(), mesh.local_index(twin.tet(), v)));
      prefetch_neighbours(mesh, twin.tet());
      if (visit(queue.back(), twin)) return StarKind::whole;
    }
  }
  return StarKind::whole;
}

/// A set of numbers that lies on the stack while it is small, as those of a star are.
class Seen {
 public:
  Seen() { small_.fill(kNone); }

  /// True if it was not there.
  bool insert(std::uint32_t number) {
    if (2 * (size_ + 1) > table_.size()) grow();
    std::size_t i = home(number);
    for (; table_[i] != kNone; i = (i + 1) & (table_.size() - 1)) {
      if (table_[i] == number) return false;
    }
    table_[i] = number;
    ++size_;
    return true;
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::size_t home(std::uint32_t number) const { return (number * 0x9E3779B1u) >> shift_; }
  void grow() {
    const std::vector<std::uint32_t> old(table_.begin(), table_.end());
    large_.assign(2 * old.size(), kNone);
    table_ = large_;
    --shift_;
    size_ = 0;
    for (const std::uint32_t number : old) {
      if (number != kNone) insert(number);
    }
  }

  std::array<std::uint32_t, 128> small_{};
  std::vector<std::uint32_t> large_;
  std::span<std::uint32_t> table_ = small_;
  unsigned shift_ = 25;  // 32 less the digits of the table's size
  std::size_t size_ = 0;
};

bool visit_nothing(HalfFace, HalfFace) {
  return false;
}

}  // namespace

StarKind find_star(const TetMesh& mesh, VertexHandle v, Workspace& workspace,
                   std::vector<HalfFace>& out) {
  return walk_star(mesh, v, workspace, kMaxStar, out, visit_nothing);
}

bool collect_link(const TetMesh& mesh, VertexHandle v, Workspace& workspace,
                  std::vector<HalfFace>& out) {
  return walk_star(mesh, v, workspace, kAnySize, out, visit_nothing) == StarKind::whole;
}

Link link(const TetMesh& mesh, VertexHandle v) {
  Link found;
  const TetHandle first = mesh.tet_of(v);
  if (!first.is_valid()) return found;
  Seen seen;
  seen.insert(first.index());
  found.push_back(HalfFace(first, mesh.local_index(first, v)));
  for (std::size_t i = 0; i < found.size(); ++i) {
    const HalfFace opposite = found[i];
    const std::array<HalfFace, 4>& neighbours = mesh.neighbours(opposite.tet());
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace twin = neighbours[f];
      if (f == opposite.face() || twin.is_outside() || !seen.insert(twin.tet().index())) continue;
      found.push_back(HalfFace(twin.tet(), mesh.local_index(twin.tet(), v)));
      prefetch_neighbours(mesh, twin.tet());
    }
  }
  return found;
}

Star star(const TetMesh& mesh, VertexHandle v) {
  Star tets;
  for (const HalfFace f : link(mesh, v)) tets.push_back(f.tet());
  return tets;
}

OneRing one_ring(const TetMesh& mesh, VertexHandle v) {
  OneRing ring;
  Seen seen;
  for (const HalfFace f : link(mesh, v)) {
    for (const VertexHandle w : mesh.vertices(f)) {
      if (seen.insert(w.index())) ring.push_back(w);
    }
  }
  return ring;
}

std::optional<TetEdge> find_in_star(const TetMesh& mesh, VertexHandle a, VertexHandle b,
                                    Workspace& workspace) {
  std::optional<TetEdge> found;
  const auto search = [&](VertexHandle v, std::size_t most) {
    return walk_star(mesh, v, workspace, most, workspace.search_buffer,
                     [&](HalfFace opposite, HalfFace) {
                       found = edge_in(mesh, opposite.tet(), a, b);
                       return found.has_value();
                     });
  };
  if (search(a, kMaxStar) != StarKind::too_large) return found;
  if (mesh.is_deleted(b) || !mesh.tet_of(b).is_valid()) return std::nullopt;
  if (search(b, kMaxStar) == StarKind::too_large) search(a, kAnySize);
  return found;
}

}  // namespace tetmend
