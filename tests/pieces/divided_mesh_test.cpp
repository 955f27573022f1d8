// SPDX-License-Identifier: MIT
#include "pieces/divided_mesh.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include <doctest/doctest.h>

#include "pieces/slices.h"
#include "tests/pieces/meshes.h"

using namespace tetmend;
using namespace tetmend::pieces;

namespace {

void divide_idly(DividedMesh& mesh, std::size_t pieces, unsigned shift) {
  mesh.divide(pieces, shift);
  test::store_idly(mesh);
}

/// Each gathered piece has all tets around its vertices. Each tet and each vertex is the own of one of
/// them, or of what has stayed. @returns how many tets were sent
std::size_t check_division(const MeshData& data, const DividedMesh& mesh) {
  std::vector<std::size_t> tets_around(data.points.size(), 0);
  for (const MeshData::Tet& tet : data.tets) {
    for (const std::uint32_t v : tet.vertices) ++tets_around[v];
  }
  std::vector<unsigned> times(data.tets.size(), 0);
  std::vector<unsigned> times_own(data.points.size(), 0);
  std::size_t sent = 0;
  for (std::uint32_t part = 0; part < mesh.parts(); ++part) {
    const Piece gathered = mesh.gathered(part);
    std::vector<std::size_t> around_here(gathered.ids.size(), 0);
    for (const PieceTet& tet : gathered.tets) {
      for (const std::uint32_t v : tet.vertices) ++around_here[v];
    }
    const std::vector<std::uint32_t> parts = mesh.state().parting.parts_of(gathered);
    for (std::size_t v = 0; v < parts.size(); ++v) {
      if (parts[v] == part) CHECK(around_here[v] == tets_around[gathered.ids[v]]);
    }
    const auto count = [&](const Piece& piece) {
      for (const PieceTet& tet : piece.tets) ++times[tet.origin];
      for (std::size_t v = 0; v < piece.ids.size(); ++v) {
        if (is_own(piece.marks[v])) ++times_own[piece.ids[v]];
      }
    };
    const Piece own = own_part(gathered, mesh.state().parting, part);
    sent += own.tets.size();
    count(own);
    for (const Piece& rest : mesh.rest(part)) count(rest);
  }
  CHECK(times == std::vector<unsigned>(times.size(), 1));
  CHECK(times_own == std::vector<unsigned>(times_own.size(), 1));
  return sent;
}

std::multiset<std::array<std::uint32_t, 4>> tets_of(const MeshData& data) {
  std::multiset<std::array<std::uint32_t, 4>> all;
  for (const MeshData::Tet& tet : data.tets) all.insert(tet.vertices);
  return all;
}

}  // namespace

TEST_CASE("a mesh that was divided and joined is the same, with all that it names") {
  const MeshData data = test::lattice(8);
  MemoryShelf shelf;
  OneRank ranks;
  DividedMesh mesh(shelf, ranks, data.points.size());
  add_slices(data, {}, mesh);
  mesh.end_slices();
  for (const unsigned shift : {0u, 1u, 2u}) divide_idly(mesh, 5, shift);
  const Joined joined = join(mesh, data.points.size());
  CHECK(joined.data.points == data.points);
  CHECK(tets_of(joined.data) == tets_of(data));
  CHECK(joined.data.triangles == data.triangles);
  CHECK(joined.data.edges == data.edges);
  CHECK(joined.data.required_vertices == data.required_vertices);
  for (std::size_t t = 0; t < joined.tet_origins.size(); ++t) {
    CHECK(joined.data.tets[t] == data.tets[joined.tet_origins[t]]);
  }
}

TEST_CASE("a gathered piece has all tets around its vertices, and each tet is the own of one") {
  const MeshData data = test::lattice(8);
  MemoryShelf shelf;
  OneRank ranks;
  DividedMesh mesh(shelf, ranks, data.points.size());
  add_slices(data, {}, mesh);
  mesh.end_slices();
  mesh.divide(6, 1);
  const Parting& parting = mesh.state().parting;
  const std::vector<std::uint32_t> parts = parting.parts_of(data.points);
  std::map<std::uint32_t, std::size_t> times_own;
  for (std::uint32_t part = 0; part < 6; ++part) {
    const Piece gathered = mesh.gathered(part);
    std::set<std::uint32_t> here;
    for (const PieceTet& tet : gathered.tets) here.insert(tet.origin);
    for (std::uint32_t t = 0; t < data.tets.size(); ++t) {
      const auto& v = data.tets[t].vertices;
      const bool touches =
          std::any_of(v.begin(), v.end(), [&](std::uint32_t w) { return parts[w] == part; });
      CHECK(touches == here.contains(t));
    }
    for (const PieceTet& tet : own_part(gathered, parting, part).tets) ++times_own[tet.origin];
  }
  CHECK(times_own.size() == data.tets.size());
  for (const auto& [tet, times] : times_own) CHECK(times == 1);
}

TEST_CASE("what is near no border and in no zone stays, and nothing is lost or doubled") {
  const MeshData data = test::lattice(12);
  MemoryShelf shelf;
  OneRank ranks;
  DividedMesh mesh(shelf, ranks, data.points.size());
  add_slices(data, {}, mesh);
  mesh.end_slices();
  divide_idly(mesh, 4, 0);
  std::vector<std::size_t> sent;
  const auto check = [&] {
    sent.push_back(check_division(data, mesh));
    test::store_idly(mesh);
  };
  for (const unsigned shift : {1u, 2u}) {
    mesh.divide_near_borders(shift, 1);
    check();
  }
  for (const double side : {0.3, 0.7, 0.3}) {
    const WorstTet tet{0, Point(6, side * 12, 6), 0.5};
    mesh.divide_zones(ZoneMap({&tet, 1}));
    check();
  }
  for (const std::size_t tets : sent) {
    CHECK(tets > 0);
    CHECK(tets < data.tets.size());
  }
  divide_idly(mesh, 4, 3);
  const Joined joined = join(mesh, data.points.size());
  CHECK(joined.data.points == data.points);
  CHECK(tets_of(joined.data) == tets_of(data));
  CHECK(joined.data.triangles == data.triangles);
  CHECK(joined.data.edges == data.edges);
}

TEST_CASE("into how many slices a file was cut does not show") {
  const MeshData data = test::lattice(7);
  OneRank ranks;
  MemoryShelf one;
  DividedMesh whole(one, ranks, data.points.size());
  add_slices(data, {}, whole);
  whole.end_slices();
  divide_idly(whole, 4, 0);
  MemoryShelf other;
  DividedMesh sliced(other, ranks, data.points.size());
  for (std::size_t i = 0; i < whole.state().stored; ++i) sliced.add_slice(i, whole.stored(i));
  sliced.end_slices();
  divide_idly(sliced, 4, 0);
  divide_idly(whole, 4, 0);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(sliced.stored(i).ids == whole.stored(i).ids);
    CHECK(sliced.stored(i).tets == whole.stored(i).tets);
  }
}

TEST_CASE("a piece that cannot be read is an error that names its file") {
  const test::Folder folder;
  FolderShelf shelf(folder.path());
  shelf.append("stored-0", "abc");
  CHECK(shelf.read("stored-0") == "abc");
  shelf.append("stored-0", "def");
  CHECK(shelf.read("stored-0") == "abcdef");
  CHECK(shelf.read("stored-1").empty());
  shelf.remove("stored-0");
  CHECK(shelf.read("stored-0").empty());
  FolderShelf nowhere(folder.path() / "none");
  CHECK_THROWS_AS(nowhere.append("stored-0", "abc"), Error);
}
