// SPDX-License-Identifier: MIT
// Data arrays of a mesh whose arrays lie on ranks: a run in pieces has the values of one with all
// of it in memory, wherever they lay.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <mutex>

#include <doctest/doctest.h>
#include <tetmend/io.h>

#include "face/mesh_access.h"
#include "pieces/bytes.h"
#include "pieces/improve.h"
#include "pieces/mesh_files.h"
#include "pieces/out_of_core.h"
#include "pieces/rank_share.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/pieces/meshes.h"
#include "tests/pieces/played_ranks.h"

using namespace tetmend;
using namespace tetmend::test;
using pieces::KindArrays;
using pieces::Ranks;
using pieces::RankShare;
using pieces::RowKind;

namespace {

constexpr std::size_t kArrayPieces = 3;

/// Of all four types, in rows of one, two and three numbers; triangles and edges have others than
/// tets.
MeshData lattice_with_arrays(std::uint32_t n) {
  MeshData data = lattice(n);
  data.required_vertices.clear();  // VTK has none
  data.label_array = "CellEntityIds";
  std::vector<double> heights;
  std::vector<float> winds;
  std::vector<std::int64_t> names;
  for (const Point& p : data.points) {
    heights.push_back(p.z() * p.z() + p.x());
    for (const double x : p) winds.push_back(static_cast<float>(std::sin(x)));
    names.push_back(static_cast<std::int64_t>(names.size() / 2) << 33);  // twice: no identifiers
  }
  data.point_data = {{"height", 1, heights}, {"wind", 3, winds}, {"name/of point", 1, names}};
  std::vector<double> density;
  std::vector<std::int32_t> colours;
  for (std::size_t i = 0; i < data.tets.size(); ++i) {
    density.push_back(1.0 / static_cast<double>(i + 1));
    for (const std::size_t k : {0, 1}) colours.push_back(static_cast<std::int32_t>(1000 - i * k));
  }
  data.tet_data = {{"density", 1, density}, {"colours", 2, colours}};
  data.triangle_data = {{"density", 1, std::vector<double>(data.triangles.size(), 0.25)},
                        {"flux", 1, std::vector<float>(data.triangles.size(), 4.5F)}};
  return data;
}

/// A range of a mesh for each rank. The first of several has nothing.
RankShare range_of_rank(const MeshData& data, const Ranks& ranks) {
  const RankShare all = pieces::all_of(data);
  const std::size_t count = std::max<std::size_t>(1, ranks.count() - 1);
  const bool has_nothing = ranks.count() > 1 && ranks.is_first();
  const std::size_t number = ranks.count() > 1 ? ranks.number() - 1 : 0;
  RankShare mine;
  const auto range = [&](std::size_t size) {
    return has_nothing ? std::pair<std::size_t, std::size_t>(0, 0)
                       : std::pair(size * number / count, size * (number + 1) / count);
  };
  const auto take = [&](RowKind kind, const auto& from, auto& to) {
    const auto [begin, end] = range(from.size());
    to.assign(from.begin() + static_cast<std::ptrdiff_t>(begin),
              from.begin() + static_cast<std::ptrdiff_t>(end));
    mine.arrays[kind] = pieces::nothing_of(all.arrays[kind]);
    const pieces::RowLayout layout(mine.arrays[kind]);
    std::string rows;
    layout.append_rows(all.arrays[kind], begin, end, rows);
    layout.take_rows(rows, mine.arrays[kind]);
  };
  take(RowKind::point, all.points, mine.points);
  take(RowKind::tet, all.tets, mine.tets);
  take(RowKind::triangle, all.triangles, mine.triangles);
  take(RowKind::edge, all.edges, mine.edges);
  return mine;
}

/// A file of all ranks that is a mesh in memory: "x.held".
class HeldMesh final : public pieces::ArrayFiles {
 public:
  HeldMesh(const MeshData& data, Ranks& ranks) : data_(data), ranks_(ranks) {}

  bool is_one(const std::filesystem::path& file) const override {
    return file.extension() == ".held";
  }
  RankShare read(const std::filesystem::path&, const std::string&) const override {
    return range_of_rank(data_, ranks_);
  }
  void write(const std::filesystem::path&, const RankShare& share) const override {
    written = pieces::gather_arrays(share.arrays, ranks_);
  }
  bool takes(const std::filesystem::path&, RowKind, const DataArray&) const override {
    return true;
  }

  mutable KindArrays written;  // on the first rank

 private:
  const MeshData& data_;
  Ranks& ranks_;
};

/// Improves from one file to the other by so many ranks.
KindArrays improve_by(std::size_t count, const MeshData& data, const std::filesystem::path& in,
                      const std::filesystem::path& out, const Options& options,
                      std::size_t pieces = kArrayPieces) {
  KindArrays written;
  on_ranks(count, [&](Ranks& ranks) {
    const HeldMesh held(data, ranks);
    pieces::OutOfCore files;
    files.input = in;
    files.output = out;
    files.array_files = &held;
    files.tell_lost = [](const std::vector<std::string>& lost) { CHECK(lost.empty()); };
    pieces::Division division;
    division.pieces = pieces;
    const Result result = pieces::improve_files(files, options, division, ranks);
    if (!ranks.is_first()) return;
    CHECK(result.carried.size() == 5);
    written = held.written;
  });
  return written;
}

bool is_same(const std::vector<DataArray>& a, const std::vector<DataArray>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (pieces::outline_key(a[i]) != pieces::outline_key(b[i]) ||
        pieces::bytes_of_values(a[i]) != pieces::bytes_of_values(b[i])) {
      return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("data on ranks is carried as by one process, whoever has it, and where one has nothing") {
  const MeshData data = lattice_with_arrays(7);
  for (const bool is_conserved : {false, true}) {
    CAPTURE(is_conserved);
    Options options;
    if (is_conserved) options.conserve = {"density"};
    const Folder folder;
    const auto expected = folder.path() / "expected.vtu";
    Mesh mesh = MeshAccess::make(data);
    pieces::Division division;
    division.pieces = kArrayPieces;
    pieces::improve(mesh, options, division);
    const MeshData improved = MeshAccess::data(mesh);
    save(expected, mesh);
    for (const std::size_t count : {1, 2, 5}) {
      CAPTURE(count);
      const auto out = folder.path() / "out.vtu";
      improve_by(count, data, "in.held", out, options);
      CHECK(read_text(out) == read_text(expected));
      const KindArrays written = improve_by(count, data, "in.held", "out.held", options);
      CHECK(is_same(written[RowKind::point], improved.point_data));
      CHECK(is_same(written[RowKind::tet], improved.tet_data));
      CHECK(is_same(written[RowKind::triangle], improved.triangle_data));
    }
  }
}

TEST_CASE("data of a .vtu file, and of one that is read as a whole, goes to ranks") {
  MeshData data = lattice_with_arrays(6);
  const Folder folder;
  for (const char* name : {"in.vtu", "in.vtk"}) {
    CAPTURE(name);
    const auto in = folder.path() / name;
    save(in, MeshAccess::make(data));
    Mesh mesh = load(in);
    pieces::Division division;
    division.pieces = kArrayPieces;
    pieces::improve(mesh, {}, division);
    const MeshData improved = MeshAccess::data(mesh);
    for (const std::size_t count : {1, 3}) {
      CAPTURE(count);
      std::atomic<std::size_t> carried = 0;
      KindArrays written;
      on_ranks(count, [&](Ranks& ranks) {
        const HeldMesh held(data, ranks);
        pieces::OutOfCore files;
        files.input = in;
        files.output = "out.held";
        files.array_files = &held;
        pieces::Division pieces_of;
        pieces_of.pieces = kArrayPieces;
        carried += pieces::improve_files(files, {}, pieces_of, ranks).carried.size();
        if (ranks.is_first()) written = held.written;
      });
      CHECK(carried == improved.point_data.size() + improved.tet_data.size());
      CHECK(is_same(written[RowKind::point], improved.point_data));
      CHECK(is_same(written[RowKind::tet], improved.tet_data));
      CHECK(is_same(written[RowKind::triangle], improved.triangle_data));
    }
  }
}

TEST_CASE("walls between parts of one label, which a file does not name, have no data on ranks") {
  MeshData data = lattice_with_arrays(5);
  data.label_array.clear();
  for (const MeshData::Tet& tet : data.tets) {
    const double x = data.points[tet.vertices[0]].x();
    data.tet_parts.push_back(x < 2 ? 1 : x < 3 ? 2 : 3);
  }
  data.groups.push_back({.dimension = 3, .number = 1, .name = "left", .parts = {1, 2}});
  data.groups.push_back({.dimension = 3, .number = 2, .name = "right", .parts = {3}});
  const Folder folder;
  const auto in = folder.path() / "in.msh";
  save(in, MeshAccess::make(data));
  Mesh mesh = load(in);
  pieces::Division division;
  division.pieces = kArrayPieces;
  pieces::improve(mesh, {}, division);
  const MeshData improved = MeshAccess::data(mesh);
  REQUIRE(improved.triangle_data.size() == 2);
  on_ranks(3, [&](Ranks& ranks) {
    const HeldMesh held(data, ranks);
    pieces::OutOfCore files;
    files.input = in;
    files.output = "out.held";
    files.array_files = &held;
    files.tell_lost = [](const std::vector<std::string>& lost) {
      CHECK(lost == std::vector<std::string>{"groups and whatever there is besides arrays, labels "
                                             "and constraints are not written"});
    };
    pieces::Division pieces_of;
    pieces_of.pieces = kArrayPieces;
    pieces::improve_files(files, {}, pieces_of, ranks);
    if (!ranks.is_first()) return;
    CHECK(is_same(held.written[RowKind::point], improved.point_data));
    CHECK(is_same(held.written[RowKind::tet], improved.tet_data));
    for (const DataArray& array : held.written[RowKind::triangle]) {
      CHECK(array.size() > improved.triangles.size() * array.components);
    }
  });
}

TEST_CASE("a mesh of one piece keeps the data that lies on ranks, also in a file of one process") {
  const MeshData data = lattice_with_arrays(6);
  const Folder folder;
  Mesh mesh = MeshAccess::make(data);
  improve(mesh, {});
  const MeshData improved = MeshAccess::data(mesh);
  save(folder.path() / "expected.vtu", mesh);
  for (const std::size_t count : {1, 3}) {
    CAPTURE(count);
    const KindArrays written = improve_by(count, data, "in.held", "out.held", {}, 1);
    CHECK(is_same(written[RowKind::point], improved.point_data));
    CHECK(is_same(written[RowKind::tet], improved.tet_data));
    CHECK(is_same(written[RowKind::triangle], improved.triangle_data));
    improve_by(count, data, "in.held", folder.path() / "out.vtu", {}, 1);
    CHECK(read_text(folder.path() / "out.vtu") == read_text(folder.path() / "expected.vtu"));
  }
}

TEST_CASE("data on ranks goes to a file that the first process writes whole") {
  const MeshData data = lattice_with_arrays(6);
  const Folder folder;
  Mesh mesh = MeshAccess::make(data);
  pieces::Division division;
  division.pieces = kArrayPieces;
  pieces::improve(mesh, {}, division);
  save(folder.path() / "expected.vtk", mesh);
  improve_by(3, data, "in.held", folder.path() / "out.vtk", {});
  CHECK(read_text(folder.path() / "out.vtk") == read_text(folder.path() / "expected.vtk"));
}

TEST_CASE(
    "what of data on ranks is lost is told: where the surface moves, and in files without arrays") {
  const MeshData data = lattice_with_arrays(5);
  on_ranks(2, [&](Ranks& ranks) {
    const HeldMesh held(data, ranks);
    pieces::InputMesh mesh("in.held", ranks, &held);
    CHECK(mesh.lost_in("out.held").empty());
    CHECK(mesh.lost_in("out.vtu").empty());
    CHECK(mesh.holds_more("out.held"));
    CHECK(mesh.holds_more("out.vtu"));
    CHECK(!mesh.holds_more("out.meshb"));
    CHECK(!mesh.lost_in("out.meshb").empty());
    CHECK_THROWS_AS(mesh.check_conserve({"colours"}), OptionError);
    mesh.check_conserve({"density"});
    mesh.set_surface_moves();
    for (const char* out : {"out.held", "out.vtu"}) {
      const std::vector<std::string> lost = mesh.lost_in(out);
      CHECK(lost.size() == 7);
      CHECK(lost.front() == "the array 'height' of points is not written");
      CHECK(!mesh.holds_more(out));
    }
  });
}
