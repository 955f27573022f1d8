// SPDX-License-Identifier: MIT
// A mesh with one worker, for tests that make single attempts and look at the tets afterwards.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/integrity.h"
#include "kernel/shell.h"
#include "kernel/workspace.h"
#include "ops/registry.h"
#include "tests/support/tets.h"
#include "tests/support/zoo.h"

namespace tetmend::test {

class LoneWorker {
 public:
  explicit LoneWorker(const MeshData& data) : mesh(data), workspace(mesh) {}

  /// Checks that the mesh is sound afterwards and, after a refusal, what it was before.
  Verdict attempt(std::string_view name, Target target, const ParameterSettings& settings = {}) {
    const TetMesh before = mesh;
    const Verdict verdict = attempt(*Registry::builtin().make(name, settings), target);
    CHECK(check_integrity(mesh).empty());
    CHECK(count_not_positive(mesh) <= count_not_positive(before));
    if (verdict != Verdict::accepted) CHECK(mesh == before);
    return verdict;
  }

  /// Checks nothing.
  Verdict attempt(const Operator& op, Target target, TraceSink* trace = nullptr,
                  unsigned level = 0) {
    OperatorContext context{mesh, workspace, states, trace, level};
    return op.attempt(context, target);
  }

  bool has_edge(std::uint32_t a, std::uint32_t b) {
    return find_edge(mesh, VertexHandle(a), VertexHandle(b), workspace).has_value();
  }
  /// Number of tets around an edge that is inside; 0 if it is gone.
  unsigned degree(std::uint32_t a, std::uint32_t b) {
    if (!has_edge(a, b)) return 0;
    Shell shell;
    REQUIRE(find_shell(mesh, edge(a, b).edge(), shell, Territory()) == ShellKind::closed);
    return shell.degree;
  }
  Target edge(std::uint32_t a, std::uint32_t b) {
    const auto found = find_edge(mesh, VertexHandle(a), VertexHandle(b), workspace);
    REQUIRE(found.has_value());
    return Target::of(*found);
  }
  Target tet(const Corners& corners) const {
    for (const TetHandle t : live_tets(mesh)) {
      if (corners_of(t) == corners) return Target::of(t);
    }
    FAIL("no such tet");
    return {};
  }
  Target face(std::vector<std::uint32_t> corners) const {
    std::sort(corners.begin(), corners.end());
    for (const TetHandle t : live_tets(mesh)) {
      for (unsigned f = 0; f < 4; ++f) {
        std::vector<std::uint32_t> found;
        for (const VertexHandle v : mesh.vertices(HalfFace(t, f))) found.push_back(v.index());
        std::sort(found.begin(), found.end());
        if (found == corners) return Target::of(HalfFace(t, f));
      }
    }
    FAIL("no such face");
    return {};
  }
  std::set<Corners> tets() const {
    std::set<Corners> all;
    for (const TetHandle t : live_tets(mesh)) all.insert(corners_of(t));
    return all;
  }
  /// Of the live tets, ascending.
  std::vector<Quality> qualities() const {
    std::vector<Quality> all;
    for (const TetHandle t : live_tets(mesh)) all.push_back(mesh.quality(t));
    std::sort(all.begin(), all.end());
    return all;
  }
  Quality worst() const { return qualities().front(); }

  /// The vertices listed belong to others from now on. Free slots are those provided before.
  void give_away(const std::vector<std::uint32_t>& vertices) {
    blocks_.assign(mesh.vertex_slots(), 0);
    for (const std::uint32_t v : vertices) blocks_[v] = 1;
    slots_ = std::exchange(workspace.free_slots(), {});
    workspace.enter(Territory(blocks_, 0), slots_);
  }

  TetMesh mesh;
  Workspace workspace;
  OperatorStates states;

 private:
  Corners corners_of(TetHandle t) const {
    Corners corners{};
    for (unsigned i = 0; i < 4; ++i) corners[i] = mesh.vertices(t)[i].index();
    std::sort(corners.begin(), corners.end());
    return corners;
  }

  std::vector<BlockId> blocks_;
  Workspace::FreeSlots slots_;
};

}  // namespace tetmend::test
