// SPDX-License-Identifier: MIT
#include "schedule/single_attempt.h"

#include <doctest/doctest.h>

#include "ops/registry.h"
#include "schedule/schedule.h"
#include "tests/support/zoo.h"
#include "trace/text_trace.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// The trace of a script on a shell of three tets around the edge 0 1, the ring 2 3 4.
std::string script_trace(const std::string& script) {
  TetMesh mesh(shell_mesh({.degree = 3, .height = 1.4142135623730951}));
  Registry registry = Registry::builtin();
  Run run(mesh, registry);
  TextTrace trace;
  run.set_trace(&trace);
  improve(run, Schedule("test.lua", script));
  CHECK(run.records.size() == 1);
  return trace.text();
}

}  // namespace

TEST_CASE("a single attempt aims at the target of the vertices and at nothing else") {
  CHECK(script_trace("attempt('edge_removal', {0, 1})") ==
        "edge_removal(0 1) level 0\n-> accepted, 3 tets 1.1547 -> 2 tets 1.8856\n");
  CHECK(script_trace("attempt('edge_removal', {2, 3})") ==
        "edge_removal(2 3) level 0\n-> constrained\n");
  CHECK(script_trace("attempt('smoothing', {4})") == "smoothing(4) level 0\n-> constrained\n");
  CHECK(script_trace("attempt({'recursive_shell_transformation', max_level = 0}, {0, 1})")
            .find("-> accepted") != std::string::npos);
}

TEST_CASE("a single attempt sees its target from the tet that is named") {
  // The two tets of a face list its vertices in opposite sense.
  CHECK(script_trace("attempt('flip_2_3', {0, 1, 3}, {0, 1, 2, 3})").find("flip_2_3(0 1 3)") == 0);
  CHECK(script_trace("attempt('flip_2_3', {0, 1, 3}, {0, 1, 3, 4})").find("flip_2_3(0 3 1)") == 0);
  CHECK_THROWS_WITH_AS(script_trace("attempt('edge_removal', {2, 3}, {0, 1, 3, 4})"),
                       doctest::Contains("no edge has the vertices 2, 3 in a tet of 0, 1, 3, 4"),
                       Error);
  CHECK_THROWS_WITH_AS(script_trace("attempt('edge_removal', {0, 1}, {0, 1, 9, 4})"),
                       doctest::Contains("there is no vertex 9"), Error);
}

TEST_CASE("a single attempt at what is not there is a mistake of the script") {
  CHECK_THROWS_WITH_AS(script_trace("attempt('edge_removal', {0, 9})"),
                       doctest::Contains("there is no vertex 9; the mesh has 5"), Error);
  CHECK_THROWS_WITH_AS(script_trace("attempt('edge_removal', {0, 1, 2})"),
                       doctest::Contains("edge_removal: no edge has the vertices 0, 1, 2"), Error);
  CHECK_THROWS_WITH_AS(script_trace("attempt('edge_removal', {0, 0.5})"),
                       doctest::Contains("0.5 is no number of a vertex"), Error);
  CHECK_THROWS_WITH_AS(script_trace("attempt(all_of{'smoothing'}, {0})"),
                       doctest::Contains("must be one operator"), Error);
}

TEST_CASE("an attempt at handles does what the one at numbers does, wherever the target lies") {
  const TetMesh mesh(delaunay_ball(60, 2));
  const Registry registry = Registry::builtin();
  std::size_t accepted = 0;
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    const TetVertices& v = mesh.vertices(TetHandle(slot));
    const std::array<VertexHandle, 2> edge = {v[1], v[3]};
    const auto made = [&](const auto& attempt) {
      TetMesh tried = mesh;
      Run run(tried, registry);
      TextTrace text;
      run.set_trace(&text);
      attempt(run);
      accepted += run.records[0].accepted();
      return text.text();
    };
    const Composition what{.operator_name = "edge_removal"};
    const std::string by_handles = made([&](Run& run) { attempt_at(run, what, edge); });
    const std::string by_numbers = made([&](Run& run) {
      attempt_once(run, {.what = what, .vertices = {edge[0].index(), edge[1].index()}});
    });
    CHECK(by_handles == by_numbers);
  }
  CHECK(accepted > 0);
  TetMesh tried = mesh;
  Run run(tried, registry);
  const std::array<VertexHandle, 2> none = {VertexHandle(0), VertexHandle(0)};
  CHECK_THROWS_WITH_AS(attempt_at(run, {.operator_name = "edge_removal"}, none),
                       doctest::Contains("no edge has the vertices 0, 0"), Error);
}
