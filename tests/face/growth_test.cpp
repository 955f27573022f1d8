// SPDX-License-Identifier: MIT
// How far a run lets a mesh grow, and what lengths its new edges have.
#include "face/growth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include <doctest/doctest.h>
#include <tetmend/improve.h>
#include <tetmend/rulers.h>

#include "kernel/formats/tet_mesh_io.h"
#include "ops/registry.h"
#include "schedule/run.h"
#include "schedule/schedule.h"
#include "tests/face/meshes.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

using Edge = std::array<std::array<double, 3>, 2>;

std::set<Edge> edges_of(const MeshArrays& mesh) {
  std::set<Edge> edges;
  for (const auto& tet : mesh.tets) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        Edge edge = {mesh.points[tet[i]], mesh.points[tet[k]]};
        if (edge[1] < edge[0]) std::swap(edge[0], edge[1]);
        edges.insert(edge);
      }
    }
  }
  return edges;
}

double length(const Edge& edge) {
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) square += std::pow(edge[0][i] - edge[1][i], 2);
  return std::sqrt(square);
}

/// Mean length of the edges of the vertex nearest to the midpoint, each once for each of its tets.
double usual_length(const MeshArrays& mesh, const Edge& edge) {
  std::size_t nearest = 0;
  double least = 1e300;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      square += std::pow((edge[0][i] + edge[1][i]) / 2 - mesh.points[v][i], 2);
    }
    if (square >= least) continue;
    least = square;
    nearest = v;
  }
  double sum = 0;
  int count = 0;
  for (const auto& tet : mesh.tets) {
    if (std::find(tet.begin(), tet.end(), nearest) == tet.end()) continue;
    for (const auto v : tet) {
      if (v == nearest) continue;
      sum += length({mesh.points[v], mesh.points[nearest]});
      ++count;
    }
  }
  return sum / count;
}

}  // namespace

TEST_CASE("fewer tets than there are is a forgotten percent sign, unless it is marked as meant") {
  const Mesh input = load(asset("folded_sheet.mesh"));
  const std::size_t before = input.arrays().tets.size();
  const auto complaint = [&](const std::string& tets) -> std::string {
    Mesh mesh = input;
    try {
      improve(mesh, {.schedule = "conservative", .tets = tets});
    } catch (const OptionError& error) {
      CHECK(error.option() == "tets");
      CHECK(mesh.arrays().points == input.arrays().points);
      return error.what();
    }
    return "";
  };
  CHECK(complaint("10").find("did you mean 10%?") != std::string::npos);
  CHECK(complaint("0").find("did you mean 0%?") != std::string::npos);
  const std::string one_less = complaint(std::to_string(before - 1));
  CHECK(one_less.find("is less than the") != std::string::npos);
  CHECK(one_less.find("0% keeps the mesh from growing") != std::string::npos);
  for (const std::string& tets : {std::string("10!"), std::string("10%"), std::to_string(before),
                                  std::to_string(before) + "!"}) {
    CAPTURE(tets);
    CHECK(complaint(tets).empty());
  }
  for (const std::string wrong : {"!", "10%!", "10!!", "!10", "10 !"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS(check({.tets = wrong}), OptionError);
  }
}

TEST_CASE("a run makes no more tets than it may, for any number of threads") {
  const Mesh input = load(asset("folded_sheet.mesh"));
  const std::size_t before = input.arrays().tets.size();
  Mesh free = input;
  improve(free);
  for (const std::string schedule : {"shell", "thorough"}) {
    for (const auto& growth : {std::pair<std::string, std::size_t>{"0%", before},
                               {"0.5%", before + before / 200},
                               {std::to_string(before - 40) + "!", before}}) {
      const std::string tets = growth.first;
      const std::size_t most = growth.second;
      CAPTURE(schedule);
      CAPTURE(tets);
      std::vector<Mesh> results;
      for (const int threads : {1, 3}) {
        Mesh mesh = input;
        const Result result =
            improve(mesh, {.schedule = schedule, .threads = threads, .tets = tets});
        CHECK(result.after.tets <= most);
        CHECK(result.after.n_bad < result.before.n_bad / 2);
        results.push_back(mesh);
      }
      CHECK(results[0].arrays().points == results[1].arrays().points);
      CHECK(results[0].arrays().tets == results[1].arrays().tets);
    }
  }
  const Result bounded = [&] {
    Mesh mesh = input;
    return improve(mesh, {.tets = "1000%"});
  }();
  CHECK(bounded.after.tets == free.arrays().tets.size());
}

TEST_CASE("by itself a mesh grows by 15 % at most, or by what its purpose allows") {
  // Thin parts between two materials, whose bad tets go by insertion alone.
  const Mesh input = load(asset("sheet.mesh"));
  const double before = static_cast<double>(input.arrays().tets.size());
  const auto growth = [&](const Options& options) {
    Mesh mesh = input;
    const Result result = improve(mesh, options);
    CHECK(result.after.n_bad < result.before.n_bad);
    return static_cast<double>(result.after.tets) / before;
  };
  CHECK(growth({.goal = {40, 140}}) <= 1.15);
  CHECK(growth({.purpose = "explicit", .goal = {40, 140}}) <= 1);
  CHECK(growth({.purpose = "implicit", .goal = {40, 140}}) <= 1.05);
  CHECK(growth({.purpose = "volumes", .goal = {40, 140}}) <= 1.15);
  CHECK(growth({.purpose = "angles", .goal = {40, 140}}) > 1.15);
  CHECK(growth({.purpose = "explicit", .goal = {40, 140}, .tets = "1000%"}) > 1.15);
  CHECK_THROWS_AS(check({.purpose = "explicitly"}), OptionError);
}

TEST_CASE("all purposes but angles hold the stable step") {
  const Mesh input = load(asset("two_materials.mesh"));
  for (const std::string purpose : {"", "explicit", "implicit", "volumes", "angles"}) {
    CAPTURE(purpose);
    Mesh mesh = input;
    const Result result = improve(mesh, {.purpose = purpose});
    CHECK(result.holds_solver == (purpose != "angles"));
    REQUIRE(result.rulers_after.has_value());
    const double then = (*result.rulers_before)[Ruler::step].worst;
    const double now = (*result.rulers_after)[Ruler::step].worst;
    if (result.holds_solver) CHECK(now >= then * (1 - 1e-9));
    CHECK(result.worse().empty());
  }
}

TEST_CASE("where the lengths of edges are kept, no new edge is much shorter or longer") {
  for (const std::string schedule : {"shell", "conservative"}) {
    CAPTURE(schedule);
    Mesh mesh = load(asset("folded_sheet.mesh"));
    const MeshArrays before = mesh.arrays();
    const Result result = improve(mesh, {.schedule = schedule, .keep_size = true});
    CHECK(result.after.n_bad < result.before.n_bad);
    const std::set<Edge> old = edges_of(before);
    std::size_t made = 0;
    std::size_t wrong = 0;
    for (const Edge& edge : edges_of(mesh.arrays())) {
      if (old.contains(edge)) continue;
      ++made;
      const double usual = usual_length(before, edge);
      wrong += length(edge) < 0.5 * usual || length(edge) > 2 * usual ? 1 : 0;
    }
    CHECK(made > 500);
    CHECK(wrong == 0);
  }
}

TEST_CASE("lengths around vertices where nothing changed are taken over, and no others") {
  TetMesh mesh = read_tet_mesh(asset("folded_sheet.mesh"));
  const std::size_t vertices = mesh.vertex_count();
  const face::LocalLengths before(mesh, vertices);
  const Registry registry = Registry::builtin();
  Run run(mesh, registry);
  improve(run, Schedule::builtin("shell"), {});
  std::size_t unchanged = 0;
  for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) {
    const VertexHandle vertex(v);
    unchanged += !mesh.is_deleted(vertex) && mesh.changed(vertex) == 0 ? 1 : 0;
  }
  REQUIRE(unchanged > 0);
  REQUIRE(unchanged < vertices);
  const face::LocalLengths anew(mesh, vertices);
  CHECK(before.renewed(mesh) == anew);
  CHECK_FALSE(before == anew);
}

TEST_CASE("the report says how the lengths of edges have changed") {
  Mesh mesh = load(asset("folded_sheet.mesh"));
  const Mesh input = mesh;
  const Result result = improve(mesh);
  REQUIRE(result.size_drift);
  CHECK(result.size_drift->one_percent < result.size_drift->median);
  CHECK(result.size_drift->median < result.size_drift->ninety_nine_percent);
  CHECK(result.size_drift->median == doctest::Approx(1).epsilon(0.1));
  const auto shortest = [](const Mesh& of) {
    double least = 1e300;
    for (const Edge& edge : edges_of(of.arrays())) least = std::min(least, length(edge));
    return least;
  };
  CHECK(result.rulers_before->shortest_edge == doctest::Approx(shortest(input)));
  CHECK(result.rulers_after->shortest_edge == doctest::Approx(shortest(mesh)));
}

TEST_CASE("a growth that is none is refused") {
  Mesh mesh = load(asset("sheet.mesh"));
  for (const char* tets : {"x", "-5%", "%", "10 %", "1e3", "nan%", "inf%"}) {
    CAPTURE(tets);
    CHECK_THROWS_AS(improve(mesh, {.tets = tets}), OptionError);
  }
}
