// SPDX-License-Identifier: MIT
// What a file holds besides its mesh, and regions that stay, when no process has the whole mesh: the
// bytes of a run in pieces that has it.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <map>
#include <set>

#include <doctest/doctest.h>
#include <tetmend/io.h>

#include "face/mesh_access.h"
#include "kernel/formats/mesh_io.h"
#include "pieces/file_slices.h"
#include "pieces/folder_run.h"
#include "pieces/improve.h"
#include "pieces/out_of_core.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/pieces/meshes.h"
#include "tests/pieces/played_ranks.h"
#include "tests/support/errors.h"
#include "tests/support/overlapping_mesh.h"

using namespace tetmend;
using namespace tetmend::test;
using pieces::Division;
using pieces::FolderRun;
using pieces::OutOfCore;
using pieces::Ranks;

namespace {

constexpr std::size_t kCarriedPieces = 3;

/// Arrays of points and tets, groups, and parts that are finer than labels.
MeshData lattice_with_data() {
  MeshData data = lattice(7);
  std::vector<double> heights;
  for (const Point& p : data.points) heights.push_back(p.z() * p.z() + p.x());
  data.point_data.push_back({"height", 1, heights});
  std::vector<std::int32_t> colours;
  for (std::size_t i = 0; i < data.tets.size(); ++i) {
    colours.push_back(static_cast<std::int32_t>(i % 7));
    data.tet_parts.push_back(data.points[data.tets[i].vertices[0]].x() < 3 ? 1 : 2);
  }
  data.tet_data.push_back({"colour", 1, colours});
  data.groups.push_back({.dimension = 3, .number = 1, .name = "left", .parts = {1}});
  data.groups.push_back({.dimension = 3, .number = 2, .name = "right", .parts = {2}});
  return data;
}

/// A file, and what a run in pieces with all of it in memory makes of it.
struct CarriedFiles {
  CarriedFiles(const MeshData& data, const std::string& ending, const Options& options)
      : in(folder.path() / ("in" + ending)), out(folder.path() / ("out" + ending)) {
    save(in, MeshAccess::make(data));
    Mesh mesh = load(in);
    result = pieces::improve(mesh, options, in_pieces(kCarriedPieces));
    save(out, mesh);
    expected = read_text(out);
    std::filesystem::remove(out);
  }
  OutOfCore all() const {
    OutOfCore files;
    files.input = in;
    files.output = out;
    return files;
  }

  Folder folder;
  std::filesystem::path in, out;
  Result result;
  std::string expected;
};

void improve_by_tasks(const CarriedFiles& files, const Options& options) {
  const std::filesystem::path work = files.folder.path() / "work";
  FolderRun::split(files.all(), work, options, in_pieces(kCarriedPieces));
  for (FolderRun run(work); !run.is_finished(); run = FolderRun(work)) {
    run.improve(run.round().open, {});
    FolderRun(work).join({});
  }
}

/// So no rank need have all of it.
bool is_told_by_rows(const std::filesystem::path& file) {
  pieces::OneRank alone;
  const auto slices = pieces::open_slices(file, {}, alone);
  return slices && slices->has_all_in_rows();
}

/// By ranks, and by tasks over files, the bytes are the same.
/// @param see  looks at the result on each rank
void check_all_ways(const CarriedFiles& files, const Options& options,
                    std::initializer_list<std::size_t> counts,
                    const std::function<void(const Result&, Ranks&)>& see = {}) {
  for (const std::size_t count : counts) {
    CAPTURE(count);
    std::filesystem::remove(files.out);
    on_ranks(count, [&](Ranks& ranks) {
      Division division = in_pieces(kCarriedPieces);
      const Result result = pieces::improve_files(files.all(), options, division, ranks);
      if (see) see(result, ranks);
    });
    CHECK(read_text(files.out) == files.expected);
  }
  std::filesystem::remove(files.out);
  improve_by_tasks(files, options);
  CHECK(read_text(files.out) == files.expected);
}

}  // namespace

TEST_CASE("arrays, groups and parts are carried by ranks and by tasks as by one process") {
  for (const char* ending : {".vtu", ".msh"}) {
    CAPTURE(ending);
    const Options options = {.conserve = {}};
    const CarriedFiles files(lattice_with_data(), ending, options);
    CHECK(files.result.carried.size() >= 2);
    check_all_ways(files, options, {1, 3}, [&](const Result& result, Ranks& ranks) {
      CHECK(result.carried.size() == (ranks.is_first() ? files.result.carried.size() : 0));
      CHECK(files.result.touched_tets > 0);
      CHECK(result.touched_tets == files.result.touched_tets);
    });
  }
}

TEST_CASE("the number of a tet that is gone is given to no other tet, in pieces, too") {
  const auto tets_of = [](const std::filesystem::path& file) {
    const MeshData data = read_mesh(file);
    std::map<std::int64_t, std::set<std::int64_t>> tets;  // numbers of their corners
    for (std::size_t i = 0; i < data.tets.size(); ++i) {
      for (const std::uint32_t v : data.tets[i].vertices)
        tets[data.tet_numbers[i]].insert(data.point_numbers[v]);
    }
    return tets;
  };
  for (const char* ending : {".bdf", ".k"}) {
    CAPTURE(ending);
    const CarriedFiles files(lattice(5), ending, {});
    check_all_ways(files, {}, {2});
    const auto before = tets_of(files.in);
    std::size_t new_ones = 0;
    for (const auto& [number, corners] : tets_of(files.out)) {
      const auto old = before.find(number);
      if (old == before.end()) {
        ++new_ones;
      } else if (old->second != corners) {
        CHECK(number == 0);
      }
    }
    CHECK(new_ones > 0);
  }
}

TEST_CASE("arrays of a .vtu file are carried where no rank has all of it, as by one process") {
  MeshData data = lattice(7);
  data.label_array = "material";
  data.triangles.push_back(data.triangles.front());  // named twice, with other numbers
  data.triangles.push_back({{1, 2, 10}, 7});
  std::vector<double> heights;
  std::vector<float> velocities;
  std::vector<std::int64_t> names;
  for (const Point& p : data.points) {
    heights.push_back(p.z() * p.z() + p.x());
    for (const double x : p) velocities.push_back(static_cast<float>(std::sin(x)));
    names.push_back(static_cast<std::int64_t>(names.size() / 2) << 33);  // twice: no identifiers
  }
  data.point_data = {{"height", 1, heights}, {"velocity", 3, velocities}, {"name", 1, names}};
  const auto give_cell_data = [](const auto& elements, std::vector<DataArray>& arrays) {
    std::vector<double> density;
    std::vector<std::int32_t> colours;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      density.push_back(1.0 / static_cast<double>(i + 1));
      colours.push_back(static_cast<std::int32_t>(1'000'000 - i / 2));
    }
    arrays = {{"density", 1, density}, {"colour", 1, colours}};
  };
  give_cell_data(data.tets, data.tet_data);
  give_cell_data(data.triangles, data.triangle_data);
  give_cell_data(data.edges, data.edge_data);
  for (const bool is_conserved : {false, true}) {
    CAPTURE(is_conserved);
    Options options;
    if (is_conserved) options.conserve = {"density"};
    const CarriedFiles files(data, ".vtu", options);
    CHECK(is_told_by_rows(files.in));
    check_all_ways(files, options, {1, 2, 5}, [&](const Result& result, Ranks& ranks) {
      if (!ranks.is_first()) return;
      REQUIRE(result.carried.size() == 5);
      for (std::size_t i = 0; i < 5; ++i) {
        const CarriedArray& here = result.carried[i];
        const CarriedArray& there = files.result.carried[i];
        CHECK(here.name == there.name);
        CHECK(here.on == there.on);
        CHECK(here.rule == there.rule);
        CHECK(here.integral_error == doctest::Approx(there.integral_error).epsilon(1e-6));
      }
    });
  }
}

TEST_CASE("where solids overlap, values stay apart in pieces, too, by ranks and by tasks") {
  for (const ToldBy told_by : {ToldBy::labels, ToldBy::nothing}) {
    CAPTURE(static_cast<int>(told_by));
    MeshData data = two_overlapping(told_by, 6);
    data.groups.clear();
    data.label_array = "material";
    for (MeshData::Tet& tet : data.tets) tet.label = std::max(tet.label, 1);
    for (const bool conserves : {false, true}) {
      Options options = {.conserve = {}};
      if (conserves) options.conserve = {"young"};
      const CarriedFiles files(data, ".vtu", options);
      REQUIRE(is_told_by_rows(files.in));
      check_all_ways(files, options, {1, 3});
      CHECK(files.result.touched_tets > 500);
      CHECK(count_strange_values(read_mesh(files.out)) == 0);
    }
  }
}

TEST_CASE("marks and normals of a .meshb file are carried where no rank has all of it") {
  MeshData data = lattice(6);
  for (std::uint32_t v = 0; v + 1 < 40; ++v) data.edges.push_back({{v, v + 1}, Label(v % 3)});
  data.triangles.push_back({{1, 2, 9}, 7});
  data.groups.push_back({0, 0, "Corners", {}, {0, 6, 60, 61, 62, 150}});  // some are inside
  data.groups.push_back({1, 0, "Ridges", {}, {9, 3, 4, 21}});
  data.groups.push_back({1, 0, "RequiredEdges", {}, {0, 9}});
  data.groups.push_back({2, 0, "RequiredTriangles", {}, {1}});
  for (const char* name : {"Normals", "Tangents"}) {
    const bool is_normal = name[0] == 'N';
    std::vector<double> values;
    for (std::size_t i = 0; i < 3 * data.points.size(); ++i) values.push_back(std::cos(double(i)));
    data.point_data.push_back({name, 3, values});
    Group group{0, 0, is_normal ? "NormalAtVertices" : "TangentAtVertices", {}, {}};
    for (std::uint32_t v = is_normal ? 0 : 5; v < 80; v += 5) group.members.push_back(v);
    data.groups.push_back(group);
  }
  for (const bool has_normals : {true, false}) {
    CAPTURE(has_normals);
    if (!has_normals) {
      data.point_data.erase(data.point_data.begin());
      std::erase_if(data.groups, [](const Group& g) { return g.name == "NormalAtVertices"; });
    }
    const CarriedFiles files(data, ".meshb", {});
    const MeshData there = read_mesh(files.in);
    REQUIRE(there.groups.size() == (has_normals ? 6 : 5));
    CHECK(is_told_by_rows(files.in));
    check_all_ways(files, {}, {1, 2, 5});
  }
}

TEST_CASE("what a file holds that the output cannot have is told, once") {
  const CarriedFiles files(lattice_with_data(), ".msh", {});
  OutOfCore plain = files.all();
  plain.output = files.folder.path() / "out.mesh";
  std::atomic<int> told = 0;
  plain.tell_lost = [&](const std::vector<std::string>& lost) {
    ++told;
    CHECK(!lost.empty());
  };
  on_ranks(2, [&](Ranks& ranks) {
    Division division = in_pieces(kCarriedPieces);
    pieces::improve_files(plain, {}, division, ranks);
  });
  CHECK(told == 1);
  plain.tell_lost = [](const std::vector<std::string>&) { throw Error("too much"); };
  std::filesystem::remove(plain.output);
  CHECK(message_of([&] {
          pieces::OneRank alone;
          Division division = in_pieces(kCarriedPieces);
          pieces::improve_files(plain, {}, division, alone);
        }) == "too much");
  CHECK(!std::filesystem::exists(plain.output));
}

TEST_CASE("regions that are protected stay, whoever has them") {
  const std::vector<Options> all = {
      {.protect = {"label:1"}},
      {.protect = {"box:-1,-1,-1,3.5,8,8"}, .only = {"label:2", "box:0,0,0,8,8,5"}}};
  for (const Options& options : all) {
    const CarriedFiles files(lattice(8), ".meshb", options);
    CHECK(files.result.protected_tets > 0);
    CHECK(files.expected != CarriedFiles(lattice(8), ".meshb", {}).expected);
    check_all_ways(files, options, {1, 3}, [&](const Result& result, Ranks&) {
      CHECK(result.protected_tets == files.result.protected_tets);
      CHECK(result.protected_bad_tets == files.result.protected_bad_tets);
    });
  }
}

TEST_CASE("a region without a tet is an error, also where each rank has some tets of others") {
  const CarriedFiles files(lattice(6), ".meshb", {});
  const auto message = [&](const Options& options) {
    return message_of([&] {
      on_ranks(2, [&](Ranks& ranks) {
        Division division = in_pieces(kCarriedPieces);
        pieces::improve_files(files.all(), options, division, ranks);
      });
    });
  };
  CHECK(message({.protect = {"label:1,2"}}) == "");  // each rank has seen some of both, or one
  CHECK(message({.protect = {"label:3"}}) ==
        "protect label:3: no tet has label 3: the mesh has 1, 2");
  CHECK(message({.only = {"box:7,7,7,8,8,8"}}) ==
        "only box:7,7,7,8,8,8: no tet lies in the box: the mesh fills 0,0,0,6,6,6");
}

namespace {

/// Surfaces, curves and vertices of the geometry, with and without groups, and volumes that are finer than
/// labels, as Gmsh has them.
MeshData lattice_with_entities(bool is_finer) {
  constexpr std::uint32_t kCells = 6;
  MeshData data = lattice(kCells);
  data.required_vertices.clear();
  data.triangles.clear();
  data.edges.clear();
  const auto is_at = [&](std::uint32_t v, double z) { return data.points[v].z() == z; };
  for (const MeshData::Tet& tet : data.tets) {
    for (std::size_t skip = 0; skip < 4; ++skip) {
      std::array<std::uint32_t, 3> face{};
      std::size_t n = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        if (i != skip) face[n++] = tet.vertices[i];
      }
      for (const double z : {0.0, double(kCells)}) {
        if (!std::all_of(face.begin(), face.end(), [&](auto v) { return is_at(v, z); })) continue;
        data.triangles.push_back({face, z > 0 ? 7 : 0});
        data.triangle_parts.push_back(z > 0 ? 12 : data.points[face[0]].x() < 3 ? 10 : 11);
      }
    }
  }
  for (std::uint32_t v = 0; v < kCells; ++v) {
    data.edges.push_back({{v, v + 1}, 0});
    data.edge_parts.push_back(v < 3 ? 5 : 6);
  }
  for (MeshData::Tet& tet : data.tets) {
    tet.label = 3;
    const bool is_left = data.points[tet.vertices[0]].x() < 3;
    data.tet_parts.push_back(is_finer && is_left ? 21 : 20);
  }
  data.point_entities.assign(data.points.size(), {3, 20});
  for (const MeshData::Triangle& triangle : data.triangles) {
    for (const std::uint32_t v : triangle.vertices) data.point_entities[v] = {2, 12};
  }
  data.point_entities[0] = {0, 1};
  data.point_entities[kCells] = {0, 2};
  data.groups.push_back({3, 3, "body", {}, {}});
  data.groups.push_back({2, 7, "top", {}, {}});
  data.groups.push_back({0, 9, "corner", {}, {kCells}});
  const auto list = [&](int dimension, std::initializer_list<Label> tags, Label group) {
    for (const Label tag : tags) {
      GeometricEntity entity{dimension, tag, {0, 0, 0, 6, 6, 6}, {}, {}};
      if (dimension == 0) entity.box = {0, 0, 0, 0, 0, 0};
      if (group != 0) entity.groups = {group};
      data.entities.push_back(entity);
    }
  };
  list(0, {1}, 0);
  list(0, {2}, 9);
  list(1, {5, 6}, 0);
  list(2, {10, 11}, 0);
  list(2, {12}, 7);
  list(3, {20, 21, 22}, 3);
  data.other_elements.push_back({1, 1, {0}, {0}, {1}, {}, {}});
  return data;
}

}  // namespace

TEST_CASE("entities of a .msh file are carried where no rank has all of it, as by one process") {
  for (const bool is_finer : {false, true}) {
    CAPTURE(is_finer);
    const CarriedFiles files(lattice_with_entities(is_finer), ".msh", {});
    const MeshData there = read_mesh(files.in);
    REQUIRE(there.entities.size() == 10);
    REQUIRE(there.other_elements.size() == 1);
    CHECK(is_told_by_rows(files.in));
    check_all_ways(files, {}, {1, 2, 5});
  }
}
