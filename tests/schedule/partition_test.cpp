// SPDX-License-Identifier: MIT
#include "schedule/partition.h"

#include <algorithm>
#include <array>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/transaction.h"
#include "kernel/workspace.h"
#include "tests/support/threads.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

TetMesh large_cube() {
  return TetMesh::sorted(kuhn_cube(14, 0.3, 1));
}

bool crosses(const TetMesh& mesh, const Partition& partition, TetHandle t) {
  const TetVertices& v = mesh.vertices(t);
  return std::any_of(v.begin(), v.end(),
                     [&](VertexHandle w) { return partition.block(w) != partition.block(v[0]); });
}

}  // namespace

TEST_CASE("each vertex has a block, and blocks have about the same number of vertices") {
  const TetMesh mesh = large_cube();
  for (const unsigned shift : {0u, 1u, 5u}) {
    for (const std::size_t blocks : {std::size_t{2}, std::size_t{7}, std::size_t{16}}) {
      CAPTURE(shift);
      CAPTURE(blocks);
      const Partition partition(mesh, blocks, shift);
      CHECK(partition.block_count() == blocks);
      std::vector<std::size_t> size(blocks, 0);
      for (const VertexHandle v : live_vertices(mesh)) {
        REQUIRE(partition.block(v) < blocks);
        ++size[partition.block(v)];
      }
      const std::size_t mean = mesh.vertex_count() / blocks;
      CHECK(*std::min_element(size.begin(), size.end()) > mean / 2);
      CHECK(*std::max_element(size.begin(), size.end()) < 2 * mean);
    }
  }
}

TEST_CASE("a tet that crosses a border of one partition rarely crosses one of all the others") {
  const TetMesh mesh = large_cube();
  constexpr unsigned kShifts = 6;
  std::vector<Partition> partitions;
  for (unsigned shift = 0; shift < kShifts; ++shift) partitions.emplace_back(mesh, 4, shift);
  std::array<std::size_t, kShifts + 1> crossing{};  // tets that cross in the first n partitions
  for (const TetHandle t : live_tets(mesh)) {
    ++crossing[0];
    for (unsigned n = 0; n < kShifts && crosses(mesh, partitions[n], t); ++n) ++crossing[n + 1];
  }
  CHECK(crossing[1] < crossing[0] / 2);
  CHECK(crossing[2] < crossing[1] * 3 / 4);
  CHECK(crossing[kShifts] < crossing[0] / 50);
}

TEST_CASE("a new vertex joins the block of its place") {
  TetMesh mesh = large_cube();
  Partition partition(mesh, 8, 1);
  Workspace workspace(mesh);
  const VertexHandle near = live_vertices(mesh)[100];
  Transaction transaction(mesh, workspace);
  const VertexHandle added = transaction.add_vertex(mesh.point(near));
  partition.include(mesh, {&added, 1});
  CHECK(partition.block(added) == partition.block(near));
}

TEST_CASE("a partition does not depend on the number of threads") {
  const TetMesh mesh = TetMesh::sorted(kuhn_cube(30, 0.3, 1));  // several chunks of vertices
  Partition one = on_threads(1, [&] { return Partition(mesh, 9, 2); });
  Partition four = on_threads(4, [&] { return Partition(mesh, 9, 2); });
  CHECK(std::ranges::equal(one.blocks(), four.blocks()));
}
