// SPDX-License-Identifier: MIT
// A mesh improved in pieces: the same bytes whatever works on them, the promises of improve(), and a
// check that notices when pieces do not fit.
#include "pieces/improve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

#include <doctest/doctest.h>
#include <tetmend/io.h>

#include "face/mesh_access.h"
#include "pieces/folder_run.h"
#include "pieces/out_of_core.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/pieces/meshes.h"

using namespace tetmend;
using namespace tetmend::test;
using pieces::Division;

namespace {

bool equal_meshes(const MeshData& a, const MeshData& b) {
  return a.points == b.points && a.tets == b.tets && a.triangles == b.triangles &&
         a.edges == b.edges && a.required_vertices == b.required_vertices &&
         a.point_labels == b.point_labels;
}

MeshData improved(const MeshData& data, Options options, std::size_t count,
                  Result* result = nullptr) {
  Mesh mesh = MeshAccess::make(data);
  Division division;
  division.pieces = count;
  Result made = pieces::improve(mesh, options, division);
  if (result != nullptr) *result = std::move(made);
  return MeshAccess::take(mesh);
}

/// From file to file; returns the message of what went wrong.
std::string improve_files(const pieces::OutOfCore& files, std::size_t count, Options options = {}) {
  Division division;
  division.pieces = count;
  try {
    pieces::OneRank ranks;
    pieces::improve_files(files, options, division, ranks);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("one piece is the run of improve()") {
  const MeshData data = lattice(6);
  Mesh mesh = MeshAccess::make(data);
  improve(mesh);
  CHECK(equal_meshes(MeshAccess::data(mesh), improved(data, {}, 1)));
}

TEST_CASE("in pieces all promises hold, and maps tell where everything is") {
  const MeshData data = lattice(12);
  for (const std::size_t count : {2, 7}) {
    CAPTURE(count);
    Result result;
    const MeshData now = improved(data, {.limit = true}, count, &result);
    CHECK(result.before.n_bad > 100);
    CHECK(result.after.n_bad < result.before.n_bad / 10);
    CHECK(result.worse().empty());
    CHECK(result.after.inverted + result.after.flat == 0);
    CHECK(result.passes.size() >= 3);
    CHECK(result.passes[0].name == "division");
    CHECK(now.triangles == data.triangles);
    REQUIRE(now.edges.size() == 1);
    for (const std::uint32_t v : data.edges[0].vertices) {
      const auto& ends = now.edges[0].vertices;
      CHECK(std::find(ends.begin(), ends.end(), result.vertex_map[v]) != ends.end());
    }
    CHECK(now.required_vertices.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
      CHECK(now.points[now.required_vertices[i]] == data.points[data.required_vertices[i]]);
    }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < data.tets.size(); ++t) {
      if (result.tet_map[t] == kGone) continue;
      ++kept;
      CHECK(now.tets[result.tet_map[t]].label == data.tets[t].label);
      for (std::size_t i = 0; i < 4; ++i) {
        const std::uint32_t v = result.vertex_map[data.tets[t].vertices[i]];
        const auto& there = now.tets[result.tet_map[t]].vertices;
        CHECK(std::find(there.begin(), there.end(), v) != there.end());
      }
    }
    CHECK(kept > data.tets.size() / 10);
    CHECK(kept < data.tets.size());
  }
}

TEST_CASE("a number of tets in a schedule is one of the mesh, and pieces have shares of it") {
  const MeshData data = lattice(16);
  Options options;
  options.script = "apply('multi_face_removal', {on = {below = 100, worst = 400}})";
  Result whole;
  improved(data, options, 1, &whole);
  REQUIRE(whole.passes.size() == 1);
  CHECK(whole.passes[0].items == 400);
  for (const std::size_t count : {2, 5}) {
    CAPTURE(count);
    Result result;
    improved(data, options, count, &result);
    REQUIRE(result.passes.size() >= 3);
    // Tets between pieces have no share; numbers are rounded up.
    CHECK(result.passes[0].items <= 400 + count);
    CHECK(result.passes[0].items > 200);
    CHECK(result.passes[1].items <= 400 + count);
  }
}

TEST_CASE("later divisions try what lies near former borders, not all that may change") {
  const MeshData data = lattice(20);
  Options options;
  options.script = "apply('edge_contraction', {on = {below = 100}})";
  std::array<std::size_t, 2> items{};
  for (const bool is_all_fresh : {false, true}) {
    Mesh mesh = MeshAccess::make(data);
    Division division;
    division.pieces = 2;
    if (is_all_fresh) division.fresh_rings = division.rings;
    const Result result = pieces::improve(mesh, options, division);
    CHECK(result.passes[0].items > 5'000);  // vertices
    items[is_all_fresh ? 1 : 0] = result.passes[1].items;
  }
  CHECK(items[0] > 500);
  CHECK(items[0] < 0.8 * static_cast<double>(items[1]));
}

TEST_CASE("a mesh in pieces is adapted to lengths, as far as one that is whole") {
  MeshData data = lattice(8);
  DataArray h{"h", 1, std::vector<double>()};
  for (const Point& p : data.points) {
    std::get<std::vector<double>>(h.values).push_back(p.x() < 3 ? 0.5 : 1.5);
  }
  data.point_data.push_back(h);
  const std::vector<Options> all = {
      {.schedule = "adapt", .size = {"0.6"}},
      {.schedule = "adapt", .surface = "flat", .size = {"array:h"}},
      {.schedule = "adapt", .surface = "flat", .size = {"2"}},
      {.schedule = "adapt", .surface = "flat", .size_at = [](double x, double, double) {
         return 0.5 + 0.1 * x;
       }}};
  for (Options options : all) {
    Mesh whole = MeshAccess::make(data);
    const Result as_one = improve(whole, options);
    Result result;
    const MeshData made = improved(data, options, 4, &result);
    REQUIRE(result.sizes_before);
    REQUIRE(result.sizes_after);
    CHECK(result.sizes_before->in_range == as_one.sizes_before->in_range);
    CHECK(result.sizes_after->in_range > as_one.sizes_after->in_range - 0.05);
    CHECK(result.not_positive_after == 0);
    CHECK(std::abs(result.volume_change()) < 1e-9);
    const double ratio =
        static_cast<double>(made.tets.size()) / static_cast<double>(as_one.after.tets);
    CHECK(std::abs(ratio - 1) < 0.15);
    if (options.surface.empty())
      CHECK(result.surface_fingerprint == result.surface_fingerprint_before);
    options.threads = 2;
    CHECK(equal_meshes(improved(data, options, 4), made));
  }
}

TEST_CASE("a mesh of tiny lengths is adapted in pieces, where the lengths are of places") {
  MeshData data = lattice(6);
  for (Point& p : data.points) p *= 1e-12;
  Result result;
  improved(data, {.schedule = "adapt", .size = {"0.6e-12"}}, 2, &result);
  REQUIRE(result.sizes_after);
  CHECK(result.sizes_after->in_range > result.sizes_before->in_range + 0.1);
  Mesh mesh = MeshAccess::make(data);
  Division division;
  division.pieces = 2;
  CHECK_THROWS_AS(pieces::improve(mesh, {.schedule = "adapt", .size = {"0.5x"}}, division),
                  OptionError);
}

TEST_CASE("threads, folders and files do not show in the result") {
  const MeshData data = lattice(10);
  const MeshData expected = improved(data, {}, 5);
  CHECK(equal_meshes(improved(data, {.threads = 2}, 5), expected));

  const Folder folder;
  Mesh mesh = MeshAccess::make(data);
  Division division;
  division.pieces = 5;
  pieces::improve(mesh, {}, division, folder.path());
  CHECK(equal_meshes(MeshAccess::data(mesh), expected));

  for (const char* ending : {"meshb", "mesh"}) {
    CAPTURE(ending);
    const auto in = folder.path() / (std::string("in.") + ending);
    const auto out = folder.path() / (std::string("out.") + ending);
    const auto in_core = folder.path() / (std::string("in_core.") + ending);
    save(in, MeshAccess::make(data));
    const Folder scratch;
    CHECK(improve_files({.input = in, .output = out, .scratch = scratch.path()}, 5) == "");
    save(in_core, mesh);
    CHECK(read_text(out) == read_text(in_core));
  }
  CHECK(!equal_meshes(improved(data, {}, 4), expected));
}

TEST_CASE("a mesh of few tets has fewer pieces than were asked for, and a note") {
  CHECK(pieces::limited_pieces(7, 1'000'000) == 7);
  CHECK(pieces::limited_pieces(7, 1'500) == 5);
  CHECK(pieces::limited_pieces(7, 2) == 2);
  CHECK(pieces::limited_pieces(1, 2) == 1);
  const MeshData data = lattice(7);  // 2,058 tets
  Result result;
  const MeshData made = improved(data, {}, 24, &result);
  REQUIRE(!result.notes.empty());
  CHECK(result.notes[0] ==
        "6 pieces, not 24: more would have less than 300 of the 2,058 tets each");
  CHECK(equal_meshes(made, improved(data, {}, 6, &result)));
  for (const std::string& note : result.notes) CHECK(note.find("not 24") == std::string::npos);
}

TEST_CASE("a mesh of a few tets can be divided, whatever it is") {
  for (const contract::NamedMesh& named : contract::zoo()) {
    Mesh whole = MeshAccess::make(named.data);
    Result alone;
    try {
      alone = tetmend::improve(whole);
    } catch (const Error&) {
      continue;  // no mesh for anybody
    }
    if (alone.not_positive_before > 0 || named.data.tets.size() > 60) continue;
    CAPTURE(named.name);
    for (const char* surface : {"", "5%"}) {
      Result result;
      Options options;
      options.surface = surface;
      CHECK_NOTHROW(improved(named.data, options, 7, &result));
      CHECK(result.before.boundary_triangles == alone.before.boundary_triangles);
      CHECK(result.worse().empty());
    }
  }
}

TEST_CASE("pieces may be empty: nearly all of a mesh may lie in one place of its box") {
  MeshData data = lattice(8);
  for (Point& p : data.points) p *= 1e-5;
  const auto first = static_cast<std::uint32_t>(data.points.size());
  for (const Point& p : {Point(9, 9, 9), Point(9.1, 9, 9), Point(9, 9.1, 9), Point(9, 9, 9.1)}) {
    data.points.push_back(p);
  }
  data.tets.push_back({{first, first + 1, first + 2, first + 3}, 3});
  for (const std::size_t count : {2, 5, 9}) {
    CAPTURE(count);
    Result result;
    const MeshData made = improved(data, {}, count, &result);
    CHECK(result.after.tets == made.tets.size());
    CHECK(result.after.n_bad < result.before.n_bad);
    CHECK(result.worse().empty());
    const Folder folder;
    const auto in = folder.path() / "in.meshb";
    const auto out = folder.path() / "out.meshb";
    const auto in_core = folder.path() / "in_core.meshb";
    save(in, MeshAccess::make(data));
    CHECK(improve_files({.input = in, .output = out, .scratch = {}}, count) == "");
    save(in_core, MeshAccess::make(made));
    CHECK(read_text(out) == read_text(in_core));
  }
}

TEST_CASE("a part that owns faces and vertices but no tet counts") {
  pieces::Figures all;
  pieces::Figures faces;
  faces.statistics.vertices = 3;
  faces.statistics.boundary_triangles = 4;
  pieces::Figures tets;
  tets.statistics.tets = 10;
  tets.statistics.vertices = 5;
  tets.statistics.boundary_triangles = 20;
  tets.statistics.volume = 2;
  for (const pieces::Figures* part : {&faces, &tets, &faces, &tets}) all.add(*part);
  CHECK(all.statistics.tets == 20);
  CHECK(all.statistics.vertices == 16);
  CHECK(all.statistics.boundary_triangles == 48);
  CHECK(all.statistics.volume == 4);
}

TEST_CASE("memory decides on the number of pieces, and enough of it is one piece") {
  CHECK(pieces::pieces_for(1'000'000, 1'000'000'000) == 1);
  CHECK(pieces::pieces_for(10'000'000, 200'000'000) == 9);
  CHECK(pieces::pieces_for(1'000'000, 1) == 100);
  CHECK(pieces::pieces_at_a_time(1'000'000, 10, 0) == 1);
  CHECK(pieces::pieces_at_a_time(1'000'000, 10, 40'000'000 + 3 * 13'000'000) == 3);
  CHECK(pieces::pieces_at_a_time(1'000'000, 10, 1'000'000'000) == 10);
  CHECK(pieces::pieces_at_a_time(3, 10, 1'000'000'000) == 10);
  const Folder folder;
  const auto in = folder.path() / "in.meshb";
  const auto out = folder.path() / "out.meshb";
  const MeshData data = lattice(5);
  save(in, MeshAccess::make(data));
  const Folder scratch;
  CHECK(improve_files(
            {.input = in, .output = out, .scratch = scratch.path(), .memory = 1'000'000'000}, 0) ==
        "");
  CHECK(equal_meshes(MeshAccess::data(load(out)), improved(data, {}, 1)));
}

TEST_CASE("less memory than the program takes is refused before the mesh is read") {
  const Folder folder;
  const auto in = folder.path() / "none.meshb";
  const auto refusal = [&](std::uint64_t memory) {
    return improve_files({.input = in, .output = in, .scratch = folder.path(), .memory = memory},
                         0);
  };
  CHECK(refusal(1).find("memory: 1 bytes is less than the 40M") != std::string::npos);
  CHECK(refusal(39'999'999).find("less than the 40M") != std::string::npos);
  CHECK(refusal(40'000'000).find("none.meshb: cannot be read") != std::string::npos);
}

TEST_CASE("in pieces, too, forgotten percent signs are told, not obeyed") {
  const MeshData data = lattice(6);
  CHECK_THROWS_WITH_AS(improved(data, {.surface = "1"}, 3), doctest::Contains("did you mean 1%?"),
                       OptionError);
  CHECK_THROWS_WITH_AS(improved(data, {.tets = "10"}, 3), doctest::Contains("did you mean 10%?"),
                       OptionError);
  const Folder folder;
  const auto in = folder.path() / "in.meshb";
  const auto out = folder.path() / "out.meshb";
  save(in, MeshAccess::make(data));
  for (const Options& options : {Options{.surface = "1"}, Options{.tets = "10"}}) {
    CHECK(improve_files({.input = in, .output = out, .scratch = folder.path()}, 3, options)
              .find("did you mean") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(out));
    CHECK_THROWS_WITH_AS(pieces::FolderRun::split({.input = in, .output = out, .scratch = {}},
                                                  folder.path() / "run", options, {.pieces = 3}),
                         doctest::Contains("did you mean"), OptionError);
  }
}

TEST_CASE("protected tets stay in all divisions") {
  const MeshData data = lattice(10);
  Result result;
  improved(data, {.protect = {"box:0,0,0,5,5,5"}}, 4, &result);
  CHECK(result.protected_tets > 300);
  std::size_t inside = 0;
  for (std::size_t t = 0; t < data.tets.size(); ++t) {
    bool is_inside = true;
    for (const std::uint32_t v : data.tets[t].vertices) {
      is_inside = is_inside && data.points[v].maxCoeff() <= 5;
    }
    if (!is_inside) continue;
    ++inside;
    CHECK(result.tet_map[t] != kGone);
    for (const std::uint32_t v : data.tets[t].vertices) CHECK(result.vertex_map[v] != kGone);
  }
  CHECK(inside == result.protected_tets);
}

TEST_CASE("named arrays come over, and a bound on the number of tets is kept") {
  MeshData data = lattice(8);
  std::vector<double> values;
  for (const Point& p : data.points) values.push_back(p.x() + 2 * p.y());
  data.point_data = {{"field", 1, values}};
  Result result;
  const MeshData now = improved(data, {.tets = "0%"}, 3, &result);
  CHECK(result.after.tets <= result.before.tets);
  REQUIRE(now.point_data.size() == 1);
  const auto& carried = std::get<std::vector<double>>(now.point_data[0].values);
  for (std::size_t v = 0; v < now.points.size(); ++v) {
    CHECK(carried[v] == doctest::Approx(now.points[v].x() + 2 * now.points[v].y()));
  }
}

TEST_CASE("a mirrored mesh is set right before it is divided") {
  MeshData data = lattice(8);
  const MeshData expected = improved(data, {}, 3);
  for (Point& p : data.points) p.x() = -p.x();
  Result result;
  improved(data, {}, 3, &result);
  CHECK(result.build.mirrored);
  CHECK(result.after.inverted == 0);
  CHECK(result.after.n_bad < result.before.n_bad / 10);
}

TEST_CASE("a run in pieces is drawn as one that is not") {
  const MeshData data = lattice(8);
  Mesh mesh = MeshAccess::make(data);
  Division division;
  division.pieces = 3;
  face::Portrait portrait;
  const Result result =
      pieces::improve(mesh, {.schedule = "conservative", .limit = true}, division, {}, &portrait);
  CHECK(portrait.triangles.size() == result.before.boundary_triangles);
  CHECK(portrait.bad_before.size() >= result.before.n_bad);
  REQUIRE(portrait.bad_after.size() >= result.after.n_bad);
  REQUIRE(result.after.n_bad > 0);
  CHECK(portrait.are_reasons_known);
  CHECK(portrait.rulers_after.has_value());
  for (const face::DrawnTet& tet : portrait.bad_after) {
    std::multiset<double> drawn, there;
    for (const Point& corner : tet.corners) drawn.insert(corner.x());
    for (const std::uint32_t v : mesh.tets()[tet.facts.tet]) there.insert(mesh.points()[v][0]);
    CHECK(drawn == there);
  }
}

TEST_CASE("a run in pieces stops when it is told to, with what it has reached") {
  std::atomic<bool> stop = true;
  Result result;
  const MeshData data = lattice(8);
  const MeshData now = improved(data, {.cancel = &stop}, 3, &result);
  CHECK(result.ending == Ending::cancelled);
  CHECK(now.points == data.points);
  std::size_t told = 0;
  improved(
      data,
      {.progress = [&](const Progress& p) { return p.stage != Stage::improving || ++told < 20; }},
      3, &result);
  CHECK(result.ending == Ending::cancelled);
  CHECK(result.worse().empty());
}

TEST_CASE("a fault in one piece is noticed, and nothing is written") {
  const Folder folder;
  const auto in = folder.path() / "in.meshb";
  const auto out = folder.path() / "out.meshb";
  save(in, MeshAccess::make(lattice(8)));
  int calls = 0;
  const auto with_fault = [&](const std::function<void(pieces::Piece&)>& fault) {
    calls = 0;
    const Folder scratch;
    pieces::OutOfCore files{.input = in, .output = out, .scratch = scratch.path()};
    files.fault = [&](std::size_t, pieces::Piece& piece) {
      // In the last division, and where neighbours have copies.
      if (++calls == 9) fault(piece);
    };
    return improve_files(files, 4, {.schedule = "conservative"});
  };
  const auto of_neighbour = [](const pieces::Piece& piece) {
    std::size_t v = 0;
    while ((piece.marks[v] & pieces::kOwn) != 0) ++v;
    return v;
  };
  CHECK(with_fault([](pieces::Piece&) {}) == "");
  std::filesystem::remove(out);
  // Each of these breaks what is frozen.
  const std::string moved =
      with_fault([&](pieces::Piece& piece) { piece.points[of_neighbour(piece)].x() += 1e-12; });
  CHECK(moved.find("lies at two places") != moved.npos);
  const std::string lost = with_fault([&](pieces::Piece& piece) { piece.tets.pop_back(); });
  CHECK(lost.find("do not fit") != lost.npos);
  const std::string twice =
      with_fault([&](pieces::Piece& piece) { piece.tets.push_back(piece.tets.back()); });
  CHECK(twice != "");
  CHECK(!std::filesystem::exists(out));
}

TEST_CASE("what pieces cannot have is an error, and the mesh stays") {
  const MeshData data = lattice(4);
  Mesh mesh = MeshAccess::make(data);
  Division division;
  division.pieces = 2;
  CHECK_THROWS_AS(pieces::improve(mesh, {.script = "smooth{} error('no')"}, division), Error);
  CHECK(equal_meshes(MeshAccess::data(mesh), data));
  const Folder folder;
  const auto in = folder.path() / "in.meshb";
  save(in, MeshAccess::make(data));
  const pieces::OutOfCore files{
      .input = in, .output = folder.path() / "out.meshb", .scratch = folder.path()};
  CHECK(improve_files(files, 2, {.ignore_interior = true}) ==
        "ignore-interior: needs the whole mesh in memory");
  CHECK(improve_files(files, 2, {.keep_size = true}) ==
        "keep-size: needs the whole mesh in memory");
}
