// SPDX-License-Identifier: MIT
// What follows a trace step by step against what is built anew at each place.
#include "viewer/debugger/trace_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>

#include <doctest/doctest.h>

#include "kernel/integrity.h"
#include "kernel/statistics_cache.h"
#include "tests/support/example_traces.h"
#include "viewer/debugger/debugger.h"
#include "viewer/mesh/scene.h"
#include "viewer/mesh/tet_lists.h"

using namespace tetmend;
using namespace tetmend::viewer;

namespace {

/// Everything that the viewer keeps of the mesh of a trace.
struct Kept {
  Kept(Debugger& debugger, SceneSettings chosen, std::size_t most)
      : mesh(debugger.mesh()), settings(std::move(chosen)), most_bad(most) {
    if (settings.peel > 0) layers = distances_from_boundary(mesh);
    const auto input = scene_input();
    scene.build(input);
    copy();
  }

  void follow(Debugger& debugger) {
    const MeshStep step = debugger.follow(mesh);
    ++steps;
    anew += step.anew ? 1 : 0;
    if (step.anew) {
      lists.forget();
      statistics.forget();
    } else {
      lists.update(mesh, step.tets);
      for (const TetHandle t : step.tets) statistics.touch(t);
    }
    std::vector<TetHandle> changed = step.tets;
    if (settings.peel > 0) {
      const auto before = std::exchange(layers, distances_from_boundary(mesh));
      for (std::uint32_t i = 0; i < layers.size(); ++i) {
        if (i >= before.size() || before[i] != layers[i]) changed.emplace_back(i);
      }
    }
    if (step.anew) {
      scene.build(scene_input());
    } else {
      scene.update(scene_input(), changed);
    }
    copy();
  }

  SceneInput scene_input() {
    SceneInput input{mesh, settings, {lists.values(mesh, settings.measure), layers}, {}, {},
                     {},   ball};
    if (settings.colour != "region") {
      input.colour_values = lists.values(mesh, settings.colour);
      input.colour_range = find_tet_value(settings.colour).range;
    }
    input.most_bad = most_bad;
    return input;
  }

  /// As a renderer does.
  void copy() {
    const Scene& s = scene.scene();
    const std::array<const std::vector<SurfaceVertex>*, 3> lists_now = {&s.surface, &s.through,
                                                                        &s.ghosts};
    for (std::size_t i = 0; i < 3; ++i) {
      if (s.number != number) {
        copies[i] = *lists_now[i];
        seen[i] = s.rewritten[i].size();
        continue;
      }
      copies[i].resize(lists_now[i]->size());
      for (; seen[i] < s.rewritten[i].size(); ++seen[i]) {
        const std::size_t first = 3 * std::size_t{s.rewritten[i][seen[i]]};
        for (std::size_t k = first; k < std::min(first + 3, copies[i].size()); ++k) {
          copies[i][k] = (*lists_now[i])[k];
        }
      }
    }
    number = s.number;
  }

  TetMesh mesh;
  SceneSettings settings;
  std::size_t most_bad;
  Ball ball{{0, 0, 0}, 1};
  TetLists lists;
  StatisticsCache statistics;
  std::vector<std::uint32_t> layers;
  SceneKeeper scene;
  std::array<std::vector<SurfaceVertex>, 3> copies;
  std::array<std::size_t, 3> seen{};
  std::uint64_t number = 0;
  int steps = 0, anew = 0;
};

using Triangle = std::array<unsigned char, 3 * sizeof(SurfaceVertex) + 4>;

std::vector<Triangle> sorted(const std::vector<SurfaceVertex>& vertices,
                             const std::vector<TetHandle>& tets) {
  std::vector<Triangle> triangles(tets.size());
  for (std::size_t i = 0; i < tets.size(); ++i) {
    const std::uint32_t slot = tets[i].index();
    std::array<SurfaceVertex, 3> corners = {vertices[3 * i], vertices[3 * i + 1],
                                            vertices[3 * i + 2]};
    // A constraint begins at any corner: that of the tet that the mesh was built from.
    if (!tets[i].is_valid()) {
      std::sort(corners.begin(), corners.end(), [](const SurfaceVertex& a, const SurfaceVertex& b) {
        return std::memcmp(&a, &b, sizeof(a)) < 0;
      });
    }
    std::memcpy(triangles[i].data(), &slot, 4);
    std::memcpy(triangles[i].data() + 4, corners.data(), sizeof(corners));
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

bool same_bytes(const std::vector<SurfaceVertex>& a, const std::vector<SurfaceVertex>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(SurfaceVertex)) == 0);
}

void check_mesh(const TetMesh& mesh, const TetMesh& fresh) {
  REQUIRE(mesh.tet_count() == fresh.tet_count());
  REQUIRE(mesh.vertex_count() == fresh.vertex_count());
  REQUIRE(mesh.tet_slots() >= fresh.tet_slots());
  bool same = true;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const TetHandle t(i);
    const bool is_there = i < fresh.tet_slots() && !fresh.is_deleted(t);
    same = same && mesh.is_deleted(t) != is_there;
    if (!is_there) continue;
    same = same && mesh.vertices(t) == fresh.vertices(t) && mesh.label(t) == fresh.label(t) &&
           mesh.quality(t) == fresh.quality(t);
    for (unsigned f = 0; f < 4; ++f) {
      const HalfFace face(t, f);
      const bool is_outside = fresh.twin(face).is_outside();
      same = same && mesh.is_constrained(face) == fresh.is_constrained(face) &&
             (is_outside ? mesh.twin(face).is_outside() : mesh.twin(face) == fresh.twin(face));
    }
    for (unsigned e = 0; e < 6; ++e) {
      same = same && mesh.is_constrained(TetEdge(t, e)) == fresh.is_constrained(TetEdge(t, e));
    }
  }
  for (std::uint32_t i = 0; i < mesh.vertex_slots(); ++i) {
    const VertexHandle v(i);
    const bool is_there = i < fresh.vertex_slots() && !fresh.is_deleted(v);
    same = same && mesh.is_deleted(v) != is_there;
    if (!is_there) continue;
    same = same && mesh.point(v) == fresh.point(v) && mesh.is_boundary(v) == fresh.is_boundary(v) &&
           mesh.is_fixed(v) == fresh.is_fixed(v) &&
           mesh.tet_of(v).is_valid() == fresh.tet_of(v).is_valid();
  }
  CHECK(same);
  CHECK(to_string(check_integrity(mesh)) == "");
}

void check_lists(Kept& kept, const TetMesh& fresh) {
  const std::string& measure = kept.settings.measure;
  const auto values = evaluate_tets(fresh, find_tet_value(measure));
  const auto now = kept.lists.values(kept.mesh, measure);
  bool same = now.size() >= values.size();
  for (std::size_t i = 0; i < now.size(); ++i) {
    const float fresh_value = i < values.size() ? values[i] : std::nanf("");
    same = same && (std::isnan(fresh_value) ? std::isnan(now[i]) : now[i] == fresh_value);
  }
  CHECK(same);
  const Histogram histogram(values, find_tet_value(measure).range);
  const auto counts = kept.lists.histogram(kept.mesh, measure).counts();
  CHECK(std::equal(counts.begin(), counts.end(), histogram.counts().begin()));
  CHECK(kept.lists.worst(kept.mesh, measure) == worst_tets(values, TetLists::kWorstListed));
  const MeshStatistics truth = compute_statistics(fresh, fresh.standard().goal());
  const MeshStatistics& s = kept.statistics.statistics(kept.mesh, kept.mesh.standard().goal());
  CHECK(s.tets == truth.tets);
  CHECK(s.n_bad == truth.n_bad);
  CHECK(s.theta_min == truth.theta_min);
  CHECK(s.theta_max == truth.theta_max);
  CHECK(s.boundary_triangles == truth.boundary_triangles);
  CHECK(s.q_aver == truth.q_aver);
  CHECK(s.scaled_volume == truth.scaled_volume);
  CHECK(s.histogram == truth.histogram);
}

void check_scene(Kept& kept, const TetMesh& fresh) {
  TetLists lists;
  const auto layers =
      kept.settings.peel > 0 ? distances_from_boundary(fresh) : std::vector<std::uint32_t>();
  SceneInput input = kept.scene_input();
  SceneInput anew{
      fresh,    kept.settings,      {lists.values(fresh, kept.settings.measure), layers},
      {},       input.colour_range, {},
      kept.ball};
  if (kept.settings.colour != "region") {
    anew.colour_values = lists.values(fresh, kept.settings.colour);
  }
  anew.most_bad = kept.most_bad;
  const Scene truth = build_scene(anew);
  const Scene& scene = kept.scene.scene();
  CHECK(scene.tets_shown == truth.tets_shown);
  CHECK(scene.bad_shown == truth.bad_shown);
  CHECK(scene.note == truth.note);
  CHECK(sorted(scene.surface, scene.surface_tets) == sorted(truth.surface, truth.surface_tets));
  CHECK(sorted(scene.through, scene.through_tets) == sorted(truth.through, truth.through_tets));
  CHECK(sorted(scene.ghosts, scene.ghost_tets) == sorted(truth.ghosts, truth.ghost_tets));
  CHECK(same_bytes(kept.copies[0], scene.surface));
  CHECK(same_bytes(kept.copies[1], scene.through));
  CHECK(same_bytes(kept.copies[2], scene.ghosts));
}

/// Steps of all kinds, both ways, and a jump now and then.
void walk(Debugger& debugger, Kept& kept, unsigned seed, int steps) {
  std::mt19937 random(seed);
  debugger.seek(debugger.end() / 3);
  kept.follow(debugger);
  const auto direction = [&] { return random() % 2 == 0 ? Direction::forward : Direction::back; };
  for (int i = 0; i < steps; ++i) {
    const auto kind = random() % 20;
    if (kind == 0) {
      debugger.seek(random() % (debugger.end() + 1));
    } else {
      debugger.step(kind < 12 ? Step::into : kind < 18 ? Step::over : Step::out, direction());
    }
    CAPTURE(debugger.position());
    kept.follow(debugger);
    const TetMesh fresh = to_tet_mesh(SlotMesh(kept.mesh));
    Replay truth(debugger.file());
    truth.seek(debugger.position());
    REQUIRE(truth.mesh().fingerprint() == SlotMesh(kept.mesh).fingerprint());
    check_mesh(kept.mesh, to_tet_mesh(truth.mesh()));
    check_lists(kept, fresh);
    check_scene(kept, fresh);
  }
}

std::vector<SceneSettings> looks() {
  std::vector<SceneSettings> all(7);
  all[1].filtered = true;
  all[1].range = {0, 1.2};
  all[1].ghosts = 0.2;
  all[2].cuts[0].on = true;
  all[2].colour = all[2].measure = "min_sine";
  all[3].cuts[1].on = all[3].cuts[1].exact = true;
  all[3].ghosts = 0.3;
  all[4].peel = 1;
  all[5].shrink = 0.3;
  all[6].bad_below = 2;
  all[6].constraints = true;
  return all;
}

/// A cube of two regions, with a wall between them and a named edge.
void record_regions(const std::filesystem::path& file) {
  MeshData data = test::kuhn_cube(4, 0.25, 5);
  for (MeshData::Tet& tet : data.tets) {
    double x = 0;
    for (const std::uint32_t v : tet.vertices) x += data.points[v].x() / 4;
    tet.label = x < 0.5 ? 1 : 2;
  }
  const auto& tet = data.tets[data.tets.size() / 2].vertices;
  data.edges.push_back({{tet[0], tet[1]}, 7});
  TetMesh mesh(data);
  test::record(mesh, file);
}

}  // namespace

TEST_CASE("what follows a trace is what is built anew, after every step either way") {
  const test::TracedBall trace;
  Debugger debugger(trace.path());
  unsigned seed = 0;
  for (const SceneSettings& look : looks()) {
    CAPTURE(seed);
    Kept kept(debugger, look, kMostBadTets);
    walk(debugger, kept, ++seed, 250);
    CHECK(kept.anew < kept.steps / 2);
  }
}

TEST_CASE("of many bad tets the worst are followed") {
  const test::TracedBall trace;
  Debugger debugger(trace.path());
  SceneSettings look;
  look.bad_below = 1.5;
  Kept kept(debugger, look, 25);
  walk(debugger, kept, 11, 300);
  CHECK(kept.scene.scene().note.find("bad tets") != std::string::npos);
}

TEST_CASE("borders of regions and named edges are followed") {
  const test::TempFolder folder;
  record_regions(folder / "regions.trace");
  Debugger debugger(folder / "regions.trace");
  SceneSettings look;
  look.hidden_regions = {2};
  look.constraints = true;
  Kept kept(debugger, look, kMostBadTets);
  walk(debugger, kept, 3, 300);
}

TEST_CASE("the colours of a trace are by the measure that the run judged tets by") {
  const test::TempFolder folder;
  TetMesh mesh(test::delaunay_ball(120, 3));
  mesh.set_standard(Standard::of({"shape", 0.5, volume_length}));
  test::record(mesh, folder / "ball.trace");
  Debugger debugger(folder / "ball.trace");
  const Standard standard = Standard::of({"shape", 0.5, volume_length});
  const std::uint64_t end = debugger.file().event_count();
  for (const std::uint64_t position : {std::uint64_t{0}, end / 3, end / 2, end}) {
    debugger.seek(position);
    const TetMesh then = debugger.mesh();
    CHECK(then.standard().measure_name() == "shape");
    std::size_t others = 0;
    for (std::uint32_t i = 0; i < then.tet_slots(); ++i) {
      const TetHandle t(i);
      if (then.is_deleted(t)) continue;
      const TetVertices& v = then.vertices(t);
      const double quality =
          standard.quality(then.point(v[0]), then.point(v[1]), then.point(v[2]), then.point(v[3]));
      const float shown = evaluate_tet(then, find_tet_value("quality"), t);
      others += shown == static_cast<float>(quality) ? 0 : 1;
    }
    CHECK(others == 0);
  }
}
