// SPDX-License-Identifier: MIT
#include "contract/contract.h"

#include <algorithm>

#include <fmt/format.h>

#include "contract/zoo.h"
#include "envelope/envelope.h"
#include "kernel/workspace.h"
#include "ops/builtin_operators.h"

namespace tetmend::contract {

namespace {

/// The mesh after point suppression: with free slots of tets and vertices between the live ones.
TetMesh with_free_slots(const MeshData& data) {
  TetMesh mesh(data);
  const ParameterValues defaults("", edge_contraction_info().parameters, {});
  const auto contraction = edge_contraction_info().make(defaults);
  Workspace workspace(mesh);
  OperatorStates states;
  OperatorContext context{mesh, workspace, states};
  for (const VertexHandle v : live_vertices(mesh)) contraction->attempt(context, Target::of(v));
  return mesh;
}

/// The mesh with the tets of its lower half frozen.
TetMesh half_frozen(const MeshData& data) {
  TetMesh mesh(data);
  mesh.freeze([&](TetHandle t) {
    double z = 0;
    for (const VertexHandle v : mesh.vertices(t)) z += mesh.point(v).z();
    return z < 0;
  });
  return mesh;
}

/// Each coordinate of each point moved, but for those on the planes given: sides and walls stay
/// plane.
MeshData slid(MeshData data, const std::vector<double>& planes, double step, std::uint64_t seed) {
  Random random(seed);
  for (Point& p : data.points) {
    for (double& x : p) {
      const double slide = random.real(-step, step);
      if (std::find(planes.begin(), planes.end(), x) == planes.end()) x += slide;
    }
  }
  return data;
}

/// The mesh with a surface that may move by so much; nothing asked for: where that changes no shape.
TetMesh with_free_surface(const MeshData& data, const EnvelopeOptions& options) {
  TetMesh mesh(data);
  mesh.set_surface_guard(Envelope::of(mesh, options));
  return mesh;
}

/// Fewer targets on a large mesh, where each accepted attempt costs a look at all of it.
std::size_t share(std::size_t count, const TetMesh& mesh) {
  constexpr std::size_t kAffordable = 1'000'000;
  constexpr std::size_t kFewest = 20;
  const std::size_t most = kAffordable / std::max<std::size_t>(mesh.tet_count(), 1);
  return std::clamp(count, std::min(count, kFewest), std::max(most, kFewest));
}

struct Cast {
  Candidate normal;
  std::vector<Candidate> extreme;
  std::vector<Candidate> ensemble;  // the operator and those of tetmend itself
};

Outcome try_everything(const Cast& cast, const TetMesh& mesh) {
  Outcome all = try_in_sweeps(*cast.normal.op, mesh, 3, share(1500, mesh));
  if (all.complaint.empty()) all += try_on_fresh_copies(*cast.normal.op, mesh, share(200, mesh));
  if (all.complaint.empty()) all += try_under_judges(*cast.normal.op, mesh, share(20, mesh));
  for (const Candidate& candidate : cast.extreme) {
    if (!all.complaint.empty()) return all;
    Outcome outcome = try_in_sweeps(*candidate.op, mesh, 1, share(120, mesh));
    if (!outcome.complaint.empty())
      outcome.complaint = fmt::format("{}, {}", candidate.name, outcome.complaint);
    all += outcome;
  }
  if (all.complaint.empty()) {
    // The others are tried as well, but do not count.
    const Outcome outcome = try_in_turns(cast.ensemble, mesh, 2, share(60, mesh));
    all.complaint = outcome.complaint;
  }
  return all;
}

}  // namespace

TetMesh cube_with_free_sides(unsigned cells, std::uint64_t seed) {
  return with_free_surface(slid(kuhn_cube(cells, 0, seed), {0, 1}, 0.2 / cells, seed), {});
}

std::vector<Ground> grounds() {
  std::vector<Ground> all;
  for (const NamedMesh& named : zoo()) all.push_back({named.name, TetMesh(named.data)});
  all.push_back({"constrained_ball", TetMesh(constrained_ball(11))});
  all.push_back({"half_frozen_ball", half_frozen(delaunay_ball(150, 13))});
  all.push_back({"ball_with_free_slots", with_free_slots(delaunay_ball(100, 12))});
  all.push_back({"cube_with_free_sides", cube_with_free_sides(3, 14)});
  all.push_back({"regions_with_free_wall",
                 with_free_surface(slid(two_regions(), {0, 0.5, 1}, 0.12, 15), {})});
  all.push_back(
      {"ball_with_free_surface", with_free_surface(delaunay_ball(120, 16), {.length = 0.05})});
  all.push_back({"bowl_with_free_surface", bowl_with_free_surface({.length = 0.004}, 17)});
  all.push_back({"bowl_with_a_share", bowl_with_free_surface({.share = 0.01}, 18)});
  for (const std::uint64_t seed : {1, 2}) {
    all.push_back({fmt::format("rough_cube_{}", seed), TetMesh(kuhn_cube(5, 0.38, seed))});
  }
  return all;
}

TetMesh bowl_with_free_surface(const EnvelopeOptions& options, std::uint64_t seed) {
  constexpr unsigned kCells = 3;
  MeshData data = slid(kuhn_cube(kCells, 0, seed), {0, 1}, 0.2 / kCells, seed);
  for (std::size_t i = 0; i < data.tets.size(); ++i) {
    data.tets[i].label = i / 6 < kCells * kCells ? 1 : 2;  // the lowest layer of cells
  }
  for (Point& p : data.points) {
    const double x = p.x() - 0.5;
    const double y = p.y() - 0.5;
    p.z() += 0.6 * (x * x + y * y);
  }
  return with_free_surface(data, options);
}

Candidate with_defaults(const Registry& registry, std::string_view name) {
  return {std::string(name), registry.make(name)};
}

std::vector<Candidate> at_its_limits(const Registry& registry, std::string_view name) {
  std::vector<Candidate> all;
  for (const ParameterSpec& spec : registry.find(name).parameters) {
    for (const double value : {spec.low, spec.high}) {
      if (value == spec.initial) continue;
      all.push_back({fmt::format("{} with {} = {:g}", name, spec.name, value),
                     registry.make(name, {{std::string(spec.name), value}})});
    }
  }
  return all;
}

namespace {

/// On each mesh in three territories; what belongs to nobody lies elsewhere in each.
Outcome try_in_territories(const Operator& op, const std::vector<Ground>& meshes) {
  Outcome all;
  for (const Ground& ground : meshes) {
    for (const double part : {0.4, 0.6, 0.8}) {
      Outcome outcome =
          try_in_territory(op, ground.mesh, bound_below(ground.mesh, part), share(60, ground.mesh));
      if (!outcome.complaint.empty()) {
        outcome.complaint = fmt::format("{}, {}", ground.name, outcome.complaint);
      }
      all += outcome;
      if (!all.complaint.empty()) return all;
    }
  }
  return all;
}

}  // namespace

Outcome check_contract(const Registry& registry, std::string_view name,
                       const std::vector<Ground>& meshes, const Listener& listener) {
  Cast cast{with_defaults(registry, name), at_its_limits(registry, name), {}};
  for (const OperatorInfo* info : registry.operators()) {
    if (info->name == name || registry.origin(info->name).empty()) {
      cast.ensemble.push_back(with_defaults(registry, info->name));
    }
  }
  Outcome total;
  for (const Ground& ground : meshes) {
    const Outcome outcome = try_everything(cast, ground.mesh);
    listener(ground.name, outcome);
    total += outcome;
  }
  Outcome inside = try_in_territories(*cast.normal.op, meshes);
  if (inside.complaint.empty() && inside.accepted == 0) {
    inside.note = "nothing was accepted in a territory: so what it does in threads was not tried";
  }
  listener("territory", inside);
  total += inside;
  if (total.complaint.empty() && total.accepted == 0) {
    total.complaint = fmt::format("none of {} attempts was accepted", total.attempts);
  }
  return total;
}

}  // namespace tetmend::contract
