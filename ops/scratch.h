// SPDX-License-Identifier: MIT
// Buffers of the operators of one worker, so that an attempt takes no memory from the heap.
#pragma once

#include <vector>

#include "kernel/shell.h"
#include "kernel/transaction.h"
#include "ops/cavity.h"
#include "ops/polyhedron.h"
#include "search/ball_optimiser.h"
#include "search/covering_search.h"
#include "search/patch_optimiser.h"
#include "search/polyhedron_search.h"

namespace tetmend {

struct Scratch {
  CoveringSearch search;
  BallOptimiser ball;
  Polyhedron polyhedron;
  PolyhedronSearch polyhedron_search;
  VertexCavity cavity;
  std::vector<VertexCavity::Place> places;
  PatchOptimiser patch;
  Shell shell;
  // What evaluate() proposes to apply(): tets to replace, and by what.
  std::vector<TetHandle> old_tets;
  std::vector<TetVertices> new_tets;
  Point point = Point::Zero();  // of a new or moved vertex
  VertexHandle kept_vertex;     // of a contraction
  std::vector<VertexMove> moves;
  std::vector<HalfFace> link;
  std::vector<HalfFace> links;  // of several vertices, one after the other
  std::vector<VertexHandle> neighbours;
  std::vector<Quality> qualities;
  std::vector<Quality> best_qualities;
  IndexSet set;
  // Quality vectors of the last comparison.
  std::vector<Quality> before;
  std::vector<Quality> now;
};

}  // namespace tetmend
