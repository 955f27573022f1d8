// SPDX-License-Identifier: MIT
// The whole of a program that works on a mesh of the kernel.
#include <cstdio>

#include <tetmend/kernel.h>

using namespace tetmend::kernel;

int main() {
  TetMesh mesh(load("part.mesh"));
  std::size_t moved = 0;
  for (VertexHandle v : mesh.vertices()) {
    Point mean = Point::Zero();
    const OneRing ring = mesh.one_ring(v);
    for (VertexHandle w : ring) mean += mesh.point(w) / static_cast<double>(ring.size());
    Transaction edit(mesh);
    if (edit.move(v, mean) != EditResult::made) continue;  // a tet would turn over, or v must stay
    edit.keep();
    ++moved;
  }
  std::printf("%zu vertices moved\n", moved);
  save("smoothed.mesh", mesh.to_mesh());
}
