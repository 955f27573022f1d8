// SPDX-License-Identifier: MIT
// What all micro-benchmarks work on: the example mesh of the repository, and a stop watch.
#pragma once

#include <chrono>
#include <vector>

#include "kernel/tet_mesh.h"

namespace tetmend::bench {

/// As read from the file.
const MeshData& example_data();

/// Sorted in space as a run sorts it.
const TetMesh& example_mesh();

/// Edges with a closed shell of that many tets, each once.
std::vector<TetEdge> edges_of_degree(const TetMesh& mesh, unsigned degree);

/// Vertices that may move and have a bad tet.
std::vector<VertexHandle> bad_vertices(const TetMesh& mesh);

/// For work that changes the mesh: the copy that it starts from is made outside the watch.
template <class Work>
double seconds_of(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace tetmend::bench
