// SPDX-License-Identifier: MIT
// The text trace of tiny runs, line by line: what a recursion tried, in which order, and how it
// ended.
#include <memory>
#include <string>

#include <doctest/doctest.h>

#include "kernel/workspace.h"
#include "ops/registry.h"
#include "tests/support/two_shells.h"
#include "tests/support/zoo.h"
#include "trace/text_trace.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

std::string attempt_trace(const MeshData& data, std::string_view name, Target target,
                          const ParameterSettings& settings = {}) {
  Registry registry = Registry::builtin();
  TetMesh mesh(data);
  mesh.set_standard(Standard(Goal{}, Standard::Terms::sine));
  Workspace workspace(mesh);
  OperatorStates states;
  TextTrace trace;
  OperatorContext context{mesh, workspace, states, &trace};
  registry.make(name, settings)->attempt(context, target);
  return trace.text();
}

}  // namespace

TEST_CASE("the trace of an edge removal names the edge and both quality vectors") {
  const MeshData data = shell_mesh({.degree = 3, .height = 1.4142135623730951});
  CHECK(attempt_trace(data, "edge_removal", Target::of(TetEdge(TetHandle(0), 0))) ==
        "edge_removal(0 1) level 0\n"
        "-> accepted, 3 tets 1.1547 -> 2 tets 1.8856\n");
}

TEST_CASE("the trace of a refusal has no quality vectors") {
  const MeshData data = shell_mesh({.degree = 3, .height = 0.4});
  CHECK(attempt_trace(data, "shell_transformation", Target::of(TetEdge(TetHandle(0), 0))) ==
        "shell_transformation(0 1) level 0\n"
        "-> no improvement\n");
  CHECK(attempt_trace(data, "flip_2_3", Target::of(HalfFace(TetHandle(0), 0))) ==
        "flip_2_3(1 2 3) level 0\n"
        "-> constrained\n");
  CHECK(attempt_trace(data, "smoothing", Target::of(VertexHandle(0))) ==
        "smoothing(0) level 0\n"
        "-> constrained\n");
}

TEST_CASE("the trace of a recursion shows the calls on the way") {
  const Target target = Target::of(TetEdge(TetHandle(0), 2));
  CHECK(attempt_trace(two_shells(), "recursive_shell_transformation", target) ==
        "recursive_shell_transformation(0 1) level 0\n"
        "  shell_transformation(0 1) level 0\n"
        "  -> no improvement\n"
        "  recursive_shell_transformation(1 2) level 1\n"
        "  -> constrained\n"
        "  recursive_shell_transformation(0 4) level 1\n"
        "    shell_transformation(0 4) level 1\n"
        "    -> accepted, 3 tets 0.3930 -> 2 tets 1.1166\n"
        "  -> accepted\n"
        "  shell_transformation(0 1) level 0\n"
        "  -> accepted, 4 tets 0.7058 -> 4 tets 1.0930\n"
        "-> accepted, 6 tets 0.3930 -> 5 tets 1.0930\n");
  CHECK(attempt_trace(two_shells(), "recursive_shell_transformation", target, {{"max_level", 0}}) ==
        "recursive_shell_transformation(0 1) level 0\n"
        "  shell_transformation(0 1) level 0\n"
        "  -> no improvement\n"
        "-> depth spent\n");
}
