// SPDX-License-Identifier: MIT
// Lists the edits that script/bench --kernel makes: 3-2 flips and contractions that the mesh allows and that do
// not touch each other.
#include <cstdio>
#include <vector>

#include "bench/kernel/task.h"
#include "face/kernel/transaction.h"

namespace {

using namespace tetmend;
using kernel::Transaction;

/// Marks tets, unless one of them is marked.
bool take(std::vector<bool>& used, const auto& tets) {
  for (const TetHandle t : tets) {
    if (used[t.index()]) return false;
  }
  for (const TetHandle t : tets) used[t.index()] = true;
  return true;
}

/// The stars of both ends, and what lies around them.
std::vector<TetHandle> around(const kernel::TetMesh& mesh, VertexHandle v, VertexHandle w) {
  std::vector<TetHandle> tets;
  for (const VertexHandle end : {v, w}) {
    for (const TetHandle t : mesh.star(end)) tets.push_back(t);
  }
  return tets;
}

void list(kernel::TetMesh& mesh) {
  std::vector<bool> used(mesh.tet_slots());
  for (const TetEdge e : mesh.edges()) {
    const auto [a, b] = mesh.vertices(e);
    const kernel::Ring ring = mesh.ring(e);
    if (!ring.closed || ring.tets.size() != 3) continue;
    Transaction edit(mesh);
    if (edit.flip_3_2(e) != EditResult::made) continue;
    edit.undo();
    if (take(used, around(mesh, a, b))) std::printf("flip %u %u\n", a.index(), b.index());
  }
  used.assign(used.size(), false);
  for (const TetEdge e : mesh.edges()) {
    const auto [a, b] = mesh.vertices(e);
    if (mesh.is_boundary(a) || mesh.is_boundary(b)) continue;
    Transaction edit(mesh);
    if (edit.contract(a, b) != EditResult::made) continue;
    edit.undo();
    if (take(used, around(mesh, a, b))) std::printf("contract %u %u\n", a.index(), b.index());
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    kernel::TetMesh mesh(load(argv[1]));
    list(mesh);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
