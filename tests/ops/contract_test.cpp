// SPDX-License-Identifier: MIT
// What every registered operator promises, tried on every mesh of the zoo: a refusal leaves no
// trace, an accepted attempt leaves a sound and better mesh with the same surface, regions and
// constraints.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "kernel/integrity.h"
#include "kernel/workspace.h"
#include "ops/registry.h"
#include "tests/support/zoo.h"
#include "trace/text_trace.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

// ---- Meshes and operators -----------------------------------------------------------------------

/// A ball of two regions with interior faces, edges and vertices that the file names.
MeshData constrained_ball(std::uint64_t seed) {
  MeshData data = delaunay_ball(70, seed);
  for (std::size_t i = 0; i < data.tets.size(); ++i) {
    double x = 0;
    for (const std::uint32_t v : data.tets[i].vertices) x += data.points[v].x();
    data.tets[i].label = x < 0 ? 1 : 2;
    const auto& v = data.tets[i].vertices;
    if (i % 29 == 3) data.triangles.push_back({{v[0], v[1], v[2]}, 5});
    if (i % 17 == 5) data.edges.push_back({{v[1], v[3]}, 6});
    if (i % 41 == 7) data.required_vertices.push_back(v[2]);
  }
  return data;
}

/// The mesh after point suppression: with free slots of tets and vertices between the live ones.
TetMesh with_free_slots(const MeshData& data) {
  TetMesh mesh(data);
  Registry registry;
  register_builtin_operators(registry);
  const auto contraction = registry.make("edge_contraction");
  Workspace workspace(mesh);
  const auto scratch = std::make_unique<Scratch>();
  OperatorContext context{mesh, workspace, *scratch};
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

std::vector<std::pair<std::string, TetMesh>> meshes() {
  std::vector<std::pair<std::string, TetMesh>> all;
  for (const NamedMesh& named : zoo()) all.emplace_back(named.name, TetMesh(named.data));
  all.emplace_back("constrained_ball", TetMesh(constrained_ball(11)));
  all.emplace_back("half_frozen_ball", half_frozen(delaunay_ball(150, 13)));
  all.emplace_back("ball_with_free_slots", with_free_slots(delaunay_ball(100, 12)));
  return all;
}

struct Candidate {
  std::string name;
  std::unique_ptr<Operator> op;
};

std::vector<Candidate> operators_with_defaults(const Registry& registry) {
  std::vector<Candidate> all;
  for (const OperatorInfo* info : registry.operators()) {
    all.push_back({std::string(info->name), registry.make(info->name)});
  }
  return all;
}

/// Every operator with each of its parameters at both ends of the range.
std::vector<Candidate> operators_at_their_limits(const Registry& registry) {
  std::vector<Candidate> all;
  for (const OperatorInfo* info : registry.operators()) {
    for (const ParameterSpec& spec : info->parameters) {
      for (const double value : {spec.low, spec.high}) {
        if (value == spec.initial) continue;
        const std::string name = std::string(spec.name);
        all.push_back({std::string(info->name) + " with " + name + " = " + std::to_string(value),
                       registry.make(info->name, {{name, value}})});
      }
    }
  }
  return all;
}

std::vector<Target> targets(const TetMesh& mesh, TargetKind kind) {
  std::vector<Target> all;
  if (kind == TargetKind::vertex) {
    for (const VertexHandle v : live_vertices(mesh)) all.push_back(Target::of(v));
    return all;
  }
  for (const TetHandle t : live_tets(mesh)) {
    if (kind == TargetKind::tet) all.push_back(Target::of(t));
    for (unsigned f = 0; kind == TargetKind::face && f < 4; ++f) {
      all.push_back(Target::of(HalfFace(t, f)));
    }
    for (unsigned e = 0; kind == TargetKind::edge && e < 6; ++e) {
      all.push_back(Target::of(TetEdge(t, e)));
    }
  }
  return all;
}

/// At most `count` of the targets, evenly spread; another choice for each `turn`.
std::vector<Target> sample(const std::vector<Target>& all, std::size_t count, std::size_t turn) {
  const std::size_t stride = (all.size() + count - 1) / std::max<std::size_t>(count, 1);
  if (stride <= 1) return all;
  std::vector<Target> some;
  for (std::size_t i = turn % stride; i < all.size(); i += stride) some.push_back(all[i]);
  return some;
}

bool is_live(const TetMesh& mesh, Target target) {
  switch (target.kind) {
    case TargetKind::tet:
      return !mesh.is_deleted(target.tet());
    case TargetKind::edge:
      return !mesh.is_deleted(target.edge().tet());
    case TargetKind::face:
      return !mesh.is_deleted(target.face().tet());
    case TargetKind::vertex:
      return !mesh.is_deleted(target.vertex());
  }
  return false;
}

// ---- What must be kept --------------------------------------------------------------------------

using Face = std::array<VertexHandle, 3>;
using Edge = std::array<VertexHandle, 2>;

/// All that an operator must keep, and what it must improve. Nothing comes from cached values.
struct Portrait {
  std::vector<std::tuple<Face, std::uint32_t, Label>> boundary;  // sense, surface triangle, region
  std::vector<std::tuple<Face, Label>> constrained_faces;        // from each side
  std::set<Edge> constrained_edges;
  std::vector<std::tuple<VertexHandle, double, double, double>> fixed;
  std::vector<std::pair<TetHandle, TetVertices>> frozen;
  std::map<Label, long double> volumes;
  long double absolute_volume = 0;
  std::vector<Quality> qualities;  // ascending
  std::set<TetVertices> doubtful;  // tets not certified positive, vertices sorted
  std::size_t not_positive = 0;    // in exact arithmetic
};

long double volume_of(const TetMesh& mesh, const TetVertices& v) {
  std::array<std::array<long double, 3>, 3> d{};
  for (unsigned i = 0; i < 3; ++i) {
    for (unsigned k = 0; k < 3; ++k) {
      d[i][k] = static_cast<long double>(mesh.point(v[i + 1])[k]) -
                static_cast<long double>(mesh.point(v[0])[k]);
    }
  }
  return (d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) +
          d[0][1] * (d[1][2] * d[2][0] - d[1][0] * d[2][2]) +
          d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0])) /
         6;
}

Portrait portrait(const TetMesh& mesh) {
  Portrait p;
  for (const TetHandle t : live_tets(mesh)) {
    TetVertices v = mesh.vertices(t);
    const long double volume = volume_of(mesh, v);
    p.volumes[mesh.label(t)] += volume;
    p.absolute_volume += std::abs(volume);
    p.qualities.push_back(static_cast<Quality>(
        minimum_sine(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]))));
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      Face corners = mesh.vertices(face);
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      const HalfFace twin = mesh.twin(face);
      if (twin.is_outside()) {
        p.boundary.emplace_back(corners, twin.surface_triangle(), mesh.label(t));
      } else if (mesh.is_constrained(face)) {
        p.constrained_faces.emplace_back(corners, mesh.label(t));
      }
    }
    for (unsigned e = 0; e < 6; ++e) {
      if (!mesh.is_constrained(TetEdge(t, e))) continue;
      Edge edge = mesh.vertices(TetEdge(t, e));
      std::sort(edge.begin(), edge.end());
      p.constrained_edges.insert(edge);
    }
    if (mesh.is_frozen(t)) p.frozen.emplace_back(t, v);
    const bool certain = mesh.is_certified_positive(v);
    std::sort(v.begin(), v.end());
    if (!certain) p.doubtful.insert(v);
  }
  for (const VertexHandle v : live_vertices(mesh)) {
    const Point& at = mesh.point(v);
    if (mesh.is_fixed(v)) p.fixed.emplace_back(v, at.x(), at.y(), at.z());
  }
  std::sort(p.boundary.begin(), p.boundary.end());
  std::sort(p.constrained_faces.begin(), p.constrained_faces.end());
  std::sort(p.qualities.begin(), p.qualities.end());
  p.not_positive = count_not_positive(mesh);
  return p;
}

/// Strictly better in lexicographic order, the shorter vector continued with +infinity.
bool strictly_better(std::vector<Quality> now, std::vector<Quality> before) {
  const std::size_t size = std::max(now.size(), before.size());
  now.resize(size, std::numeric_limits<Quality>::infinity());
  before.resize(size, std::numeric_limits<Quality>::infinity());
  return before < now;
}

/// What an accepted attempt did wrong; empty when all is well.
std::string complaint_about(const Portrait& before, const TetMesh& mesh) {
  if (const auto findings = check_integrity(mesh); !findings.empty()) {
    return "the mesh is not sound: " + to_string(findings);
  }
  const Portrait now = portrait(mesh);
  if (now.boundary != before.boundary) return "the boundary changed";
  if (now.constrained_faces != before.constrained_faces) return "constrained faces changed";
  if (now.constrained_edges != before.constrained_edges) return "constrained edges changed";
  if (now.fixed != before.fixed) return "a fixed vertex moved or vanished";
  if (now.frozen != before.frozen) return "a frozen tet changed";
  if (now.volumes.size() != before.volumes.size()) return "a region vanished";
  for (const auto& [label, volume] : before.volumes) {
    const auto found = now.volumes.find(label);
    if (found == now.volumes.end()) return "a region vanished";
    if (std::abs(found->second - volume) > 1e-12L * before.absolute_volume) {
      return "the volume of a region changed";
    }
  }
  for (const TetVertices& tet : now.doubtful) {
    if (!before.doubtful.contains(tet)) return "a tet is not certified positive";
  }
  if (now.not_positive > before.not_positive) return "more tets are inverted or flat";
  if (!strictly_better(now.qualities, before.qualities)) return "the quality vector is not better";
  for (const TetHandle t : live_tets(mesh)) {
    const TetVertices& v = mesh.vertices(t);
    const double q =
        minimum_sine(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
    if (mesh.quality(t) != static_cast<Quality>(q)) return "a cached quality is stale";
  }
  try {
    const TetMesh rebuilt(mesh.to_data());
    if (rebuilt.tet_count() != mesh.tet_count()) return "tets were lost on the way to a file";
  } catch (const Error& error) {
    return std::string("the mesh cannot be built anew: ") + error.what();
  }
  return "";
}

// ---- Attempts -----------------------------------------------------------------------------------

struct Worker {
  explicit Worker(const TetMesh& start)
      : mesh(start), workspace(mesh), scratch(std::make_unique<Scratch>()) {}
  Verdict attempt(const Operator& op, Target target, TraceSink* trace = nullptr) {
    OperatorContext context{mesh, workspace, *scratch, trace};
    return op.attempt(context, target);
  }

  TetMesh mesh;
  Workspace workspace;
  std::unique_ptr<Scratch> scratch;
};

struct Outcome {
  std::string complaint;
  std::size_t attempts = 0;
  std::size_t accepted = 0;
};

/// Sweeps over one mesh. A twin with buffers of its own gets only the accepted attempts, traced and
/// inside an outer transaction: it stays equal only if nothing else leaves a mark, in mesh, free
/// lists or buffers.
Outcome sweep_over(const Operator& op, const TetMesh& start, unsigned sweeps, std::size_t count) {
  Outcome outcome;
  Worker worker(start);
  Worker twin(start);
  TextTrace trace;
  TetMesh before = start;
  Portrait known = portrait(start);
  const auto complain = [&](Target target, const std::string& about) {
    outcome.complaint = std::string(to_string(target.kind)) + " " + std::to_string(target.code) +
                        ", attempt " + std::to_string(outcome.attempts) + ": " + about;
    return outcome;
  };
  for (unsigned sweep = 0; sweep < sweeps; ++sweep) {
    const std::size_t accepted = outcome.accepted;
    for (const Target target : sample(targets(worker.mesh, op.info().target), count, 7 * sweep)) {
      if (!is_live(worker.mesh, target)) continue;
      ++outcome.attempts;
      Verdict rehearsed{};
      {
        Transaction outer(worker.mesh, worker.workspace);
        rehearsed = worker.attempt(op, target);
      }
      if (!(worker.mesh == before)) return complain(target, "undoing the attempt left a trace");
      const Verdict verdict = worker.attempt(op, target);
      if (verdict != rehearsed) return complain(target, "the second attempt answers differently");
      if (verdict != Verdict::accepted) {
        if (!(worker.mesh == before)) return complain(target, "the refusal left a trace");
        continue;
      }
      ++outcome.accepted;
      {
        Transaction outer(twin.mesh, twin.workspace);
        if (twin.attempt(op, target, &trace) != verdict)
          return complain(target, "the twin refuses");
        outer.keep();
      }
      if (!(worker.mesh == twin.mesh)) return complain(target, "the twin's mesh differs");
      if (const auto about = complaint_about(known, worker.mesh); !about.empty()) {
        return complain(target, about);
      }
      known = portrait(worker.mesh);
      before = worker.mesh;
    }
    if (outcome.accepted == accepted) break;
  }
  return outcome;
}

/// Each target on a copy of the mesh as it came.
Outcome try_on_fresh_copies(const Operator& op, const TetMesh& start, std::size_t count) {
  Outcome outcome;
  const Portrait known = portrait(start);
  Target last_accepted{};
  for (const Target target : sample(targets(start, op.info().target), count, 0)) {
    const auto complain = [&](const std::string& about) {
      outcome.complaint = std::string(to_string(target.kind)) + " " + std::to_string(target.code) +
                          " of a fresh copy: " + about;
      return outcome;
    };
    ++outcome.attempts;
    Worker worker(start);
    if (worker.attempt(op, target) == Verdict::accepted) {
      ++outcome.accepted;
      last_accepted = target;
      const std::string about = complaint_about(known, worker.mesh);
      if (!about.empty()) return complain(about);
      Worker other(start);
      other.attempt(op, target);
      if (!(worker.mesh == other.mesh)) return complain("two copies differ afterwards");
      continue;
    }
    if (!(worker.mesh == start)) return complain("the refusal left a trace");
    if (outcome.accepted == 0) continue;
    // What comes after a refusal is what would have come without it.
    Worker other(start);
    worker.attempt(op, last_accepted);
    other.attempt(op, last_accepted);
    if (!(worker.mesh == other.mesh)) return complain("the refusal shows in the next attempt");
  }
  return outcome;
}

template <class Try>
void check_all(const std::vector<Candidate>& candidates, bool must_succeed, Try&& attempt) {
  const auto all = meshes();
  for (const Candidate& candidate : candidates) {
    std::size_t attempts = 0;
    std::size_t accepted = 0;
    for (const auto& entry : all) {
      const auto& name = entry.first;
      const auto& mesh = entry.second;
      const Outcome outcome = attempt(*candidate.op, mesh);
      attempts += outcome.attempts;
      accepted += outcome.accepted;
      CHECK_MESSAGE(outcome.complaint.empty(), candidate.name, " on ", name, ", ",
                    outcome.complaint);
    }
    // An operator that never accepts would pass all the same.
    if (must_succeed)
      CHECK_MESSAGE(accepted > 0, candidate.name, ": none of ", attempts, " accepted");
    MESSAGE(candidate.name, ": ", accepted, " of ", attempts, " attempts accepted");
  }
}

Registry builtin_operators() {
  Registry registry;
  register_builtin_operators(registry);
  return registry;
}

}  // namespace

TEST_CASE("each operator keeps its contract in sweeps over every mesh of the zoo") {
  const Registry registry = builtin_operators();
  check_all(operators_with_defaults(registry), true,
            [](const Operator& op, const TetMesh& mesh) { return sweep_over(op, mesh, 3, 1500); });
}

TEST_CASE("each operator keeps its contract on fresh copies of every mesh of the zoo") {
  const Registry registry = builtin_operators();
  check_all(operators_with_defaults(registry), true, [](const Operator& op, const TetMesh& mesh) {
    return try_on_fresh_copies(op, mesh, 200);
  });
}

TEST_CASE("each operator keeps its contract with each parameter at the ends of its range") {
  const Registry registry = builtin_operators();
  check_all(operators_at_their_limits(registry), false,
            [](const Operator& op, const TetMesh& mesh) { return sweep_over(op, mesh, 1, 120); });
}

TEST_CASE("operators keep the contract when they work one after the other on the same mesh") {
  const Registry registry = builtin_operators();
  for (const auto& entry : meshes()) {
    const auto& name = entry.first;
    Worker worker(entry.second);
    Portrait known = portrait(worker.mesh);
    std::size_t turn = 0;
    for (unsigned round = 0; round < 2; ++round) {
      for (const Candidate& candidate : operators_with_defaults(registry)) {
        const Operator& op = *candidate.op;
        for (const Target target : sample(targets(worker.mesh, op.info().target), 250, ++turn)) {
          if (!is_live(worker.mesh, target)) continue;
          const TetMesh before = worker.mesh;
          const Verdict verdict = worker.attempt(op, target);
          std::string about;
          if (verdict != Verdict::accepted) {
            if (!(worker.mesh == before)) about = "the refusal left a trace";
          } else {
            about = complaint_about(known, worker.mesh);
            known = portrait(worker.mesh);
          }
          REQUIRE_MESSAGE(about.empty(), candidate.name, " on ", name, ": ", about);
        }
      }
    }
  }
}
