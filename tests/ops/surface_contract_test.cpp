// SPDX-License-Identifier: MIT
// Operators that change the surface: it stays within what was asked, and a guard that grants more is
// found out.
#include <memory>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "contract/contract.h"
#include "contract/moving_surface.h"
#include "kernel/workspace.h"

using namespace tetmend;
using namespace tetmend::contract;

namespace {

const std::vector<std::string> kOperators = {"surface_edge_removal", "surface_smoothing",
                                             "surface_contraction", "surface_split",
                                             "surface_insertion"};

bool is_live(const TetMesh& mesh, Target target) {
  if (target.kind == TargetKind::vertex) return !mesh.is_deleted(target.vertex());
  return !mesh.is_deleted(target.kind == TargetKind::edge ? target.edge().tet() : target.tet());
}

/// Attempts everywhere; returns how many were accepted.
std::size_t try_all(TetMesh& mesh) {
  const Registry registry = Registry::builtin();
  Workspace workspace(mesh);
  OperatorStates states;
  OperatorContext context{mesh, workspace, states};
  std::size_t accepted = 0;
  for (const std::string& name : kOperators) {
    const auto op = registry.make(name);
    for (const Target target : targets(mesh, op->info().target)) {
      if (is_live(mesh, target)) accepted += op->attempt(context, target) == Verdict::accepted;
    }
  }
  return accepted;
}

}  // namespace

TEST_CASE("operators that change the surface keep it within its tolerance, both ways") {
  const Registry registry = Registry::builtin();
  for (const EnvelopeOptions& options :
       {EnvelopeOptions{.length = 0.004}, EnvelopeOptions{.share = 0.01}}) {
    CAPTURE(options.share);
    for (const std::string& name : kOperators) {
      CAPTURE(name);
      Outcome total;
      for (const std::uint64_t seed : {17, 18, 19}) {
        total += try_in_sweeps(*registry.make(name), bowl_with_free_surface(options, seed), 2, 300);
      }
      CHECK(total.complaint == "");
      CHECK(total.accepted > 0);
    }
  }
}

TEST_CASE("a guard that grants three times what was asked is found out") {
  std::size_t found = 0;
  for (const std::uint64_t seed : {17, 18, 19}) {
    TetMesh mesh = bowl_with_free_surface({.length = 0.012}, seed);
    SurfaceShape before = surface_shape(mesh);
    REQUIRE(before.length == 0.012);
    CHECK(try_all(mesh) > 0);
    const SurfaceShape now = surface_shape(mesh);
    CHECK(complaint_about_shape(before, now) == "");
    before.length = 0.004;
    found += complaint_about_shape(before, now).empty() ? 0 : 1;
  }
  CHECK(found == 3);
}

TEST_CASE("the judge of surfaces sees what is missing of either one") {
  TetMesh mesh = bowl_with_free_surface({.share = 0.01}, 17);
  const SurfaceShape whole = surface_shape(mesh);
  CHECK(complaint_about_shape(whole, whole) == "");
  SurfaceShape part = whole;
  part.faces.begin()->second.pop_back();
  CHECK(complaint_about_shape(whole, part).find("a point of the old surface") == 0);
  CHECK(complaint_about_shape(part, whole).find("a point of the new surface") == 0);
  SurfaceShape moved = whole;  // by half and by twice what this triangle and those around it may
  auto& triangle = moved.faces.begin()->second.front();
  const Point normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
  const double tolerance = whole.tolerance(triangle);
  CHECK(tolerance > 0);
  const auto lift = [&](double length) {
    for (std::size_t k = 0; k < 3; ++k) {
      triangle[k] = whole.faces.begin()->second.front()[k] + length * normal;
    }
    return complaint_about_shape(whole, moved);
  };
  CHECK(lift(0.5 * tolerance) == "");
  CHECK(lift(5 * tolerance) != "");
  part.faces.erase(part.faces.begin());
  CHECK(complaint_about_shape(whole, part) == "a part of the surface vanished");
  CHECK(complaint_about_shape(part, whole) == "labels meet that did not meet before");
}

TEST_CASE(
    "a vertex that surface_insertion puts into a mesh lies on the surface, in the same patch") {
  TetMesh mesh = bowl_with_free_surface({.share = 0.01}, 17);
  const Registry registry = Registry::builtin();
  const auto op = registry.make("surface_insertion", {{"relax", 0}});
  Workspace workspace(mesh);
  OperatorStates states;
  OperatorContext context{mesh, workspace, states};
  std::size_t accepted = 0;
  for (const Target target : targets(mesh, TargetKind::tet)) {
    if (mesh.is_deleted(target.tet())) continue;
    const auto slots = static_cast<std::uint32_t>(mesh.vertex_slots());
    const std::size_t vertices = mesh.vertex_count();
    if (op->attempt(context, target) != Verdict::accepted) continue;
    ++accepted;
    if (mesh.vertex_slots() == slots) continue;  // it has the slot of one that went
    CHECK(mesh.vertex_count() <= vertices + 1);
    const VertexHandle v(slots);
    CHECK(mesh.is_fixed(v));
    CHECK(mesh.surface_guard()->place(v) == SurfacePlace::smooth);
    const Point& p = mesh.point(v);
    CHECK((mesh.surface_guard()->nearest(v, p) - p).norm() < 0.1);
  }
  CHECK(accepted > 0);
}

TEST_CASE("operators that change the surface leave one alone that has no guard") {
  TetMesh mesh = bowl_with_free_surface({.share = 0.01}, 17);
  mesh.set_surface_guard(nullptr);
  CHECK(try_all(mesh) == 0);
}
