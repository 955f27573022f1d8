// SPDX-License-Identifier: MIT
// Arrays that lie on ranks: the mesh of `tetmend improve --pieces`, wherever they lay.
#include <atomic>

#include <doctest/doctest.h>
#include <tetmend/distributed.h>

#include "face/mesh_access.h"
#include "pieces/improve.h"
#include "tests/pieces/meshes.h"
#include "tests/pieces/played_ranks.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

constexpr std::size_t kDistributedPieces = 4;

/// From one number for the whole to that where a rank begins: unequal shares, the first has least.
std::size_t begin_of(std::size_t count, std::size_t rank, std::size_t ranks) {
  return count * rank * rank / (ranks * ranks);
}

RankArrays arrays_of_rank(const MeshData& data, const Ranks& ranks) {
  RankArrays mine;
  const auto for_share = [&](std::size_t count, const auto& take) {
    const std::size_t end = begin_of(count, ranks.number() + 1, ranks.count());
    for (std::size_t i = begin_of(count, ranks.number(), ranks.count()); i < end; ++i) take(i);
  };
  for_share(data.points.size(), [&](std::size_t v) {
    const Point& p = data.points[v];
    mine.points.push_back({p.x(), p.y(), p.z()});
  });
  const auto take = [&](const auto& from, auto& to, auto& labels) {
    for_share(from.size(), [&](std::size_t i) {
      auto& vertices = to.emplace_back();
      std::copy(from[i].vertices.begin(), from[i].vertices.end(), vertices.begin());
      labels.push_back(from[i].label);
    });
  };
  take(data.tets, mine.tets, mine.tet_labels);
  take(data.triangles, mine.triangles, mine.triangle_labels);
  take(data.edges, mine.edges, mine.edge_labels);
  if (ranks.is_first()) {
    mine.required_vertices.assign(data.required_vertices.begin(), data.required_vertices.end());
  }
  return mine;
}

/// Of all ranks, one after another.
MeshArrays joined_arrays(const std::vector<RankArrays>& all) {
  MeshArrays mesh;
  const auto append = [](const auto& from, auto& to) {
    for (const auto& each : from) {
      std::copy(each.begin(), each.end(), to.emplace_back().begin());
    }
  };
  const auto extend = [](const auto& from, auto& to) {
    for (const auto& each : from) to.push_back(static_cast<std::uint32_t>(each));
  };
  for (const RankArrays& part : all) {
    append(part.points, mesh.points);
    append(part.tets, mesh.tets);
    append(part.triangles, mesh.triangles);
    append(part.edges, mesh.edges);
    extend(part.required_vertices, mesh.required_vertices);
    extend(part.tet_labels, mesh.tet_labels);
  }
  return mesh;
}

}  // namespace

TEST_CASE("arrays on ranks become those of a run in pieces, wherever they lay") {
  const MeshData data = lattice(8);
  Mesh expected = MeshAccess::make(data);
  pieces::Division division;
  division.pieces = kDistributedPieces;
  pieces::improve(expected, {}, division);
  for (const std::size_t count : {1, 2, 5}) {
    CAPTURE(count);
    std::vector<RankArrays> made(count);
    on_ranks(count, [&](Ranks& ranks) {
      RankArrays mine = arrays_of_rank(data, ranks);
      const Result result = improve(mine, ranks, {}, {.count = kDistributedPieces});
      CHECK(result.after.n_bad < result.before.n_bad / 10);
      CHECK(result.worse().empty());
      made[ranks.number()] = std::move(mine);
    });
    const MeshArrays now = joined_arrays(made);
    CHECK(std::equal(now.points.begin(), now.points.end(), expected.points().begin(),
                     expected.points().end()));
    CHECK(std::equal(now.tets.begin(), now.tets.end(), expected.tets().begin(),
                     expected.tets().end()));
    CHECK(std::equal(now.tet_labels.begin(), now.tet_labels.end(), expected.tet_labels().begin(),
                     expected.tet_labels().end()));
    CHECK(std::equal(now.triangles.begin(), now.triangles.end(), expected.triangles().begin(),
                     expected.triangles().end()));
    CHECK(std::equal(now.edges.begin(), now.edges.end(), expected.edges().begin(),
                     expected.edges().end()));
    CHECK(now.required_vertices.size() == 2);
  }
}

TEST_CASE("ranks without tets, without points, and more ranks than pieces do not show") {
  const MeshData data = lattice(8);
  Mesh expected = MeshAccess::make(data);
  pieces::Division division;
  division.pieces = kDistributedPieces;
  pieces::improve(expected, {}, division);
  OneRank alone;
  const RankArrays all = arrays_of_rank(data, alone);
  for (const std::size_t owner : {0, 2, 7}) {  // of tets; the points are elsewhere
    CAPTURE(owner);
    std::vector<RankArrays> made(8);
    on_ranks(8, [&](Ranks& ranks) {
      RankArrays mine;
      if (ranks.number() == owner) {
        mine = all;
        mine.points.clear();
      }
      if (ranks.number() == 5) mine.points = all.points;
      improve(mine, ranks, {}, {.count = kDistributedPieces});
      made[ranks.number()] = std::move(mine);
    });
    const MeshArrays now = joined_arrays(made);
    CHECK(std::equal(now.points.begin(), now.points.end(), expected.points().begin(),
                     expected.points().end()));
    CHECK(std::equal(now.tets.begin(), now.tets.end(), expected.tets().begin(),
                     expected.tets().end()));
  }
}

TEST_CASE("progress on one rank stops all, with sound arrays") {
  const MeshData data = lattice(8);
  std::vector<RankArrays> made(3);
  on_ranks(3, [&](Ranks& ranks) {
    RankArrays mine = arrays_of_rank(data, ranks);
    std::size_t told = 0;
    Options options;
    if (ranks.number() == 2) {
      options.progress = [&](const Progress& p) {
        return p.stage != Stage::improving || ++told < 5;
      };
    }
    CHECK(improve(mine, ranks, options, {.count = kDistributedPieces}).ending == Ending::cancelled);
    made[ranks.number()] = std::move(mine);
  });
  const Mesh mesh(joined_arrays(made));  // throws for arrays that contradict themselves
  CHECK(mesh.tet_count() > data.tets.size() / 2);
}

TEST_CASE("arrays that contradict themselves, and options that pieces cannot have, are errors") {
  const MeshData data = lattice(4);
  OneRank alone;
  RankArrays mine = arrays_of_rank(data, alone);
  const RankArrays before = mine;
  CHECK_THROWS_AS(improve(mine, alone, {.keep_size = true}, {.count = 2}), OptionError);
  CHECK_THROWS_AS(improve(mine, alone, {}, {.count = 1}), OptionError);
  CHECK(mine.tets == before.tets);
  mine.tet_labels.pop_back();
  CHECK_THROWS_WITH_AS(improve(mine, alone, {}, {.count = 2}),
                       "tet_labels: there are 383 for 384 entities", Error);
  mine = before;
  std::swap(mine.tets[7][0], mine.tets[7][1]);
  CHECK_THROWS_AS(improve(mine, alone, {}, {.count = 2}), Error);
  mine = before;
  improve(mine, alone);  // two pieces at least
  CHECK(mine.tets != before.tets);
}
