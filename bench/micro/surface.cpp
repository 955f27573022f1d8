// SPDX-License-Identifier: MIT
// What one question costs where the surface may move: may these faces become those? A flip of two
// faces, and a vertex that moves a fiftieth of an edge; the answer is undone where it was yes.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/micro/example.h"
#include "envelope/envelope.h"

namespace {

using namespace tetmend;

using Triple = std::array<VertexHandle, 3>;

struct Question {
  std::vector<SurfaceFace> before, after;
};

struct Ground {
  TetMesh mesh;
  std::unique_ptr<Envelope> guard;
  SurfaceFeatures features;
};

Ground ground(const EnvelopeOptions& options) {
  Ground result{bench::example_mesh(), nullptr, {}};
  result.guard = Envelope::of(result.mesh, options);
  result.features = find_features(result.mesh, {options.angle, options.is_flat(), {}});
  return result;
}

SurfaceFace face(const TetMesh& mesh, const Triple& v) {
  return {v, {mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2])}};
}

/// Of all edges inside patches.
std::vector<Question> flips(const Ground& ground) {
  std::map<std::pair<VertexHandle, VertexHandle>, VertexHandle> opposite;
  for (const auto& [v, patch] : ground.features.faces) {
    for (unsigned k = 0; k < 3; ++k) opposite[{v[k], v[(k + 1) % 3]}] = v[(k + 2) % 3];
  }
  std::vector<Question> all;
  for (const auto& [edge, c] : opposite) {
    const auto [a, b] = edge;
    const auto other = opposite.find({b, a});
    if (b < a || other == opposite.end() || ground.guard->is_feature(a, b)) continue;
    const VertexHandle d = other->second;
    const TetMesh& mesh = ground.mesh;
    all.push_back({{face(mesh, {a, b, c}), face(mesh, {b, a, d})},
                   {face(mesh, {c, a, d}), face(mesh, {d, b, c})}});
  }
  return all;
}

/// Of all vertices that may, towards the next vertex of a face, and back to the patch or line.
std::vector<Question> moves(const Ground& ground) {
  const TetMesh& mesh = ground.mesh;
  std::map<VertexHandle, std::vector<Triple>> stars;
  for (const auto& entry : ground.features.faces) {
    for (const VertexHandle v : entry.vertices) stars[v].push_back(entry.vertices);
  }
  std::vector<Question> all;
  for (const auto& [v, star] : stars) {
    if (ground.guard->place(v) == SurfacePlace::corner) continue;
    const auto at = std::find(star[0].begin(), star[0].end(), v);
    const VertexHandle next = at + 1 == star[0].end() ? star[0][0] : *(at + 1);
    const Point to = ground.guard->nearest(v, 0.98 * mesh.point(v) + 0.02 * mesh.point(next));
    Question question;
    for (const Triple& triple : star) {
      question.before.push_back(face(mesh, triple));
      question.after.push_back(question.before.back());
      for (unsigned k = 0; k < 3; ++k) {
        if (triple[k] == v) question.after.back().points[k] = to;
      }
    }
    all.push_back(std::move(question));
  }
  return all;
}

void ask(benchmark::State& state, const EnvelopeOptions& options,
         std::vector<Question> (*questions)(const Ground&)) {
  const Ground ground = ::ground(options);
  const std::vector<Question> all = questions(ground);
  const auto journal = ground.guard->make_journal();
  std::size_t next = 0;
  std::size_t allowed = 0;
  for (auto _ : state) {
    const Question& question = all[next];
    next = next + 1 < all.size() ? next + 1 : 0;
    if (!ground.guard->replace(question.before, question.after, *journal)) continue;
    ground.guard->undo(*journal);
    ++allowed;
  }
  state.counters["allowed"] =
      benchmark::Counter(static_cast<double>(allowed), benchmark::Counter::kAvgIterations);
}

BENCHMARK_CAPTURE(ask, flip_flat, EnvelopeOptions{}, flips)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(ask, move_flat, EnvelopeOptions{}, moves)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(ask, flip_1_percent, EnvelopeOptions{.share = 0.01}, flips)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(ask, move_1_percent, EnvelopeOptions{.share = 0.01}, moves)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
