// SPDX-License-Identifier: MIT
// Meshes in several files: no rank has all, and none of them shows in the result.
#include <algorithm>
#include <array>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <tetmend/io.h>

#include "face/mesh_access.h"
#include "kernel/formats/mesh_io.h"
#include "pieces/improve.h"
#include "pieces/merged_points.h"
#include "pieces/mesh_files.h"
#include "pieces/mesh_output.h"
#include "pieces/out_of_core.h"
#include "pieces/partitioned_files.h"
#include "pieces/pvtu.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/pieces/meshes.h"
#include "tests/pieces/played_ranks.h"
#include "tests/support/errors.h"

using namespace tetmend;
using namespace tetmend::test;
using pieces::GmshParts;
using pieces::PvtuFiles;
using pieces::Ranks;

namespace {

constexpr std::size_t kPartitionPieces = 4;

/// VTK has no required vertices.
MeshData mesh_of_vtk() {
  MeshData data = lattice(7);
  data.required_vertices.clear();
  return data;
}

std::ptrdiff_t drafts_in(const std::filesystem::path& folder) {
  const std::filesystem::directory_iterator entries(folder);
  return std::count_if(begin(entries), end(entries), [](const auto& entry) {
    return entry.path().filename().string().starts_with(".tetmend");
  });
}

void improve_to(const std::filesystem::path& in, const std::filesystem::path& out, Ranks& ranks,
                std::size_t pieces = kPartitionPieces) {
  const PvtuFiles pvtu(ranks);
  const GmshParts gmsh(ranks);
  const pieces::SeveralArrayFiles parts({&pvtu, &gmsh});
  pieces::OutOfCore files;
  files.input = in;
  files.output = out;
  files.array_files = &parts;
  pieces::Division division;
  division.pieces = pieces;
  pieces::improve_files(files, {}, division, ranks);
}

void convert(const std::filesystem::path& in, const std::filesystem::path& out, Ranks& ranks) {
  const PvtuFiles pvtu(ranks);
  const GmshParts gmsh(ranks);
  const pieces::SeveralArrayFiles parts({&pvtu, &gmsh});
  pieces::InputMesh mesh(in, ranks, &parts);
  pieces::MemoryShelf shelf;
  pieces::DividedMesh slices(shelf, ranks, mesh.vertices());
  mesh.add_to(slices, kPartitionPieces);
  pieces::write_pieces(out, slices, {.vertices = mesh.vertices(), .array_files = &parts});
}

std::map<std::string, std::string> bytes_of_all(const std::filesystem::path& file) {
  std::map<std::string, std::string> all = {{"", read_text(file)}};
  for (const auto& part : pieces::read_pvtu(file)) all[part.filename().string()] = read_text(part);
  return all;
}

/// Names of the points as they were go, as in files of others.
void without_ids(const std::filesystem::path& file) {
  for (const auto& part : pieces::read_pvtu(file)) {
    MeshData data = read_mesh(part);
    std::erase_if(data.point_data, [](const DataArray& a) { return a.name == "GlobalNodeId"; });
    write_mesh(part, data);
  }
}

}  // namespace

TEST_CASE("a mesh in parts is written by all ranks, with the same bytes for any number of them") {
  const Folder folder;
  const auto in = folder.path() / "in.meshb";
  const auto whole = folder.path() / "whole.meshb";
  save(in, MeshAccess::make(mesh_of_vtk()));
  on_ranks(1, [&](Ranks& ranks) { improve_to(in, whole, ranks); });
  std::map<std::string, std::string> expected;
  for (const std::size_t count : {1, 2, 6}) {
    CAPTURE(count);
    const auto out = folder.path() / "out.pvtu";
    on_ranks(count, [&](Ranks& ranks) { improve_to(in, out, ranks); });
    const auto now = bytes_of_all(out);
    CHECK(now.size() == kPartitionPieces + 1);
    if (expected.empty()) expected = now;
    CHECK((now == expected));
    CHECK(drafts_in(folder.path()) == 0);
    // And it is read by any number of ranks as the mesh that it is.
    const auto again = folder.path() / "again.meshb";
    on_ranks(7 - count, [&](Ranks& ranks) { convert(out, again, ranks); });
    CHECK(read_text(again) == read_text(whole));
  }
}

TEST_CASE("parts of Gmsh are written and read by any number of ranks") {
  const Folder folder;
  const auto in = folder.path() / "in.meshb";
  const auto whole = folder.path() / "whole.meshb";
  save(in, MeshAccess::make(mesh_of_vtk()));
  on_ranks(1, [&](Ranks& ranks) { improve_to(in, whole, ranks); });
  const auto parts = folder.path() / "out_%d.msh";
  std::vector<std::string> expected;
  for (const std::size_t count : {1, 3}) {
    CAPTURE(count);
    on_ranks(count, [&](Ranks& ranks) { improve_to(in, parts, ranks); });
    std::vector<std::string> now;
    for (std::size_t part = 1; part <= kPartitionPieces; ++part) {
      now.push_back(read_text(folder.path() / fmt::format("out_{}.msh", part)));
      CHECK(!now.back().empty());
    }
    if (expected.empty()) expected = now;
    CHECK((now == expected));
    const auto again = folder.path() / "again.meshb";
    on_ranks(4 - count, [&](Ranks& ranks) { convert(parts, again, ranks); });
    CHECK(read_text(again) == read_text(whole));
  }
  for (const char* part : {"out_5.msh", "out_6.msh", "out_8.msh"}) {
    std::ofstream(folder.path() / part) << "of an older mesh";
  }
  on_ranks(2, [&](Ranks& ranks) { improve_to(in, parts, ranks); });
  CHECK(!std::filesystem::exists(folder.path() / "out_5.msh"));
  CHECK(!std::filesystem::exists(folder.path() / "out_6.msh"));
  CHECK(std::filesystem::exists(folder.path() / "out_8.msh"));  // without 7 no part of the mesh
  CHECK(drafts_in(folder.path()) == 0);
  CHECK(message_of([&] {
          pieces::OneRank alone;
          convert(folder.path() / "none_%d.msh", whole, alone);
        }).find("none_1.msh") != std::string::npos);
}

TEST_CASE("a mesh that is not divided is one part, whatever the number of ranks") {
  const Folder folder;
  const auto in = folder.path() / "in.meshb";
  const auto out = folder.path() / "out.pvtu";
  save(in, MeshAccess::make(mesh_of_vtk()));
  for (const std::size_t count : {1, 3}) {
    on_ranks(count, [&](Ranks& ranks) { improve_to(in, out, ranks, 1); });
    CHECK(pieces::read_pvtu(out).size() == 1);
  }
}

TEST_CASE("parts without numbers of their points are one mesh by their places") {
  const Folder folder;
  const auto in = folder.path() / "in.meshb";
  const auto parts = folder.path() / "in.pvtu";
  const MeshData data = mesh_of_vtk();
  save(in, MeshAccess::make(data));
  on_ranks(2, [&](Ranks& ranks) { improve_to(in, parts, ranks); });
  const auto whole = folder.path() / "whole.meshb";
  on_ranks(1, [&](Ranks& ranks) { convert(parts, whole, ranks); });
  const MeshData expected = read_mesh(whole);
  without_ids(parts);
  std::string first;
  for (const std::size_t count : {1, 3, 6}) {
    CAPTURE(count);
    const auto again = folder.path() / "again.meshb";
    on_ranks(count, [&](Ranks& ranks) { convert(parts, again, ranks); });
    const MeshData now = read_mesh(again);
    CHECK(now.points.size() == expected.points.size());
    CHECK(now.tets.size() == expected.tets.size());
    for (std::size_t t = 0; t < now.tets.size(); ++t) {
      CHECK(now.tets[t].label == expected.tets[t].label);
      for (std::size_t i = 0; i < 4; ++i) {
        CHECK(
            (now.points[now.tets[t].vertices[i]] == expected.points[expected.tets[t].vertices[i]]));
      }
    }
    if (first.empty()) first = read_text(again);
    CHECK(read_text(again) == first);
  }
}

namespace {

/// Arrays of points, tets, triangles and edges, as the whole mesh of parts has them.
MeshData mesh_with_arrays() {
  MeshData data = mesh_of_vtk();
  data.label_array = "CellEntityIds";
  std::vector<double> heights;
  std::vector<float> winds;
  for (const Point& p : data.points) {
    heights.push_back(p.z() * p.z() + p.x());
    for (const double x : p) winds.push_back(static_cast<float>(x * 0.3));
  }
  data.point_data = {{"height", 1, heights}, {"wind", 3, winds}};
  const auto give = [](const auto& elements, std::vector<DataArray>& arrays) {
    std::vector<double> density;
    std::vector<std::int32_t> colours;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      density.push_back(1.0 / static_cast<double>(i + 1));
      colours.push_back(static_cast<std::int32_t>(i % 3));
    }
    arrays = {{"density", 1, density}, {"colour", 1, colours}};
  };
  give(data.tets, data.tet_data);
  give(data.triangles, data.triangle_data);
  give(data.edges, data.edge_data);
  return data;
}

void convert_with_arrays(const std::filesystem::path& in, const std::filesystem::path& out,
                         Ranks& ranks, std::size_t parts = 0) {
  const PvtuFiles pvtu(ranks);
  pieces::InputMesh mesh(in, ranks, &pvtu);
  CHECK(mesh.lost_in(out).empty());
  pieces::MemoryShelf shelf;
  pieces::DividedMesh slices(shelf, ranks, mesh.vertices());
  const bool holds_more = mesh.holds_more(out);
  CHECK(holds_more);
  mesh.add_to(slices, kPartitionPieces);
  pieces::write_pieces(
      out, slices,
      {.vertices = mesh.vertices(), .array_files = &pvtu, .parts = parts, .source = in});
}

}  // namespace

TEST_CASE(
    "arrays go into parts and come out of them, with the same bytes for any number of ranks") {
  const Folder folder;
  const auto in = folder.path() / "in.vtu";
  const auto parts = folder.path() / "parts.pvtu";
  save(in, MeshAccess::make(mesh_with_arrays()));
  std::map<std::string, std::string> expected;
  std::string whole;
  for (const std::size_t count : {1, 2, 5}) {
    CAPTURE(count);
    on_ranks(count, [&](Ranks& ranks) { convert_with_arrays(in, parts, ranks, kPartitionPieces); });
    const auto now = bytes_of_all(parts);
    CHECK(now.size() == kPartitionPieces + 1);
    if (expected.empty()) expected = now;
    CHECK((now == expected));
    const auto again = folder.path() / "again.vtu";
    on_ranks(6 - count, [&](Ranks& ranks) { convert_with_arrays(parts, again, ranks); });
    if (whole.empty()) whole = read_text(again);
    CHECK(read_text(again) == whole);
  }
  const MeshData before = read_mesh(in);
  const MeshData after = read_mesh(folder.path() / "again.vtu");
  CHECK(after.point_data == before.point_data);  // points have their order
  // Tets have another one: each is known by its vertices.
  const auto by_vertices = [](const MeshData& data) {
    std::map<std::array<std::uint32_t, 4>, std::pair<double, std::int32_t>> values;
    for (std::size_t t = 0; t < data.tets.size(); ++t) {
      values[data.tets[t].vertices] = {
          std::get<std::vector<double>>(data.tet_data.at(0).values).at(t),
          std::get<std::vector<std::int32_t>>(data.tet_data.at(1).values).at(t)};
    }
    return values;
  };
  CHECK((by_vertices(after) == by_vertices(before)));
  CHECK(after.triangle_data == before.triangle_data);
  CHECK(after.edge_data == before.edge_data);
}

TEST_CASE("whole numbers of tets stay data in parts, where the mesh has no labels") {
  const Folder folder;
  MeshData data = mesh_with_arrays();
  for (MeshData::Tet& tet : data.tets) tet.label = 0;
  data.triangles.clear();
  data.triangle_data.clear();
  data.edges.clear();
  data.edge_data.clear();
  const auto in = folder.path() / "in.vtu";
  const auto parts = folder.path() / "parts.pvtu";
  const auto again = folder.path() / "again.vtu";
  save(in, MeshAccess::make(data));
  on_ranks(2, [&](Ranks& ranks) {
    convert_with_arrays(in, parts, ranks, kPartitionPieces);
    convert_with_arrays(parts, again, ranks);
  });
  const MeshData after = read_mesh(again);
  REQUIRE(after.tet_data.size() == 2);
  CHECK(after.tet_data[1].name == "colour");
  CHECK(after.tets.front().label == 0);
}

TEST_CASE("a run from parts to parts carries their arrays as a run from a file of all of it") {
  const Folder folder;
  const auto in = folder.path() / "in.vtu";
  const auto parts = folder.path() / "parts.pvtu";
  const auto same = folder.path() / "same.vtu";  // in the order of the parts
  save(in, MeshAccess::make(mesh_with_arrays()));
  on_ranks(2, [&](Ranks& ranks) {
    convert_with_arrays(in, parts, ranks, kPartitionPieces);
    convert_with_arrays(parts, same, ranks);
  });
  const auto improve = [&](const std::filesystem::path& from, const std::filesystem::path& to,
                           Ranks& ranks) {
    const PvtuFiles pvtu(ranks);
    pieces::OutOfCore files;
    files.input = from;
    files.output = to;
    files.array_files = &pvtu;
    files.tell_lost = [](const std::vector<std::string>& lost) { CHECK(lost.empty()); };
    pieces::Division division;
    division.pieces = kPartitionPieces;
    const Result result = pieces::improve_files(files, {.conserve = {"density"}}, division, ranks);
    CHECK(result.carried.size() == (ranks.is_first() ? 4 : 0));
  };
  const auto expected = folder.path() / "expected.vtu";
  const auto whole = folder.path() / "whole.vtu";
  on_ranks(1, [&](Ranks& ranks) { improve(same, expected, ranks); });
  for (const std::size_t count : {1, 2, 5}) {
    CAPTURE(count);
    const auto out = folder.path() / "out.pvtu";
    on_ranks(count, [&](Ranks& ranks) {
      improve(parts, whole, ranks);
      improve(parts, out, ranks);
    });
    CHECK(read_text(whole) == read_text(expected));
    on_ranks(2, [&](Ranks& ranks) { convert_with_arrays(out, whole, ranks); });
    CHECK(read_text(whole) == read_text(expected));
  }
}

TEST_CASE("where parts have several values for a point, that of the first part counts") {
  const Folder folder;
  const auto in = folder.path() / "in.vtu";
  const auto parts = folder.path() / "in.pvtu";
  save(in, MeshAccess::make(mesh_with_arrays()));
  on_ranks(2, [&](Ranks& ranks) { convert_with_arrays(in, parts, ranks, kPartitionPieces); });
  double number = 0;
  std::map<std::int64_t, double> expected;
  for (const auto& part : pieces::read_pvtu(parts)) {
    MeshData data = read_mesh(part);
    for (DataArray& array : data.point_data) {
      if (array.name == "height") array.values = std::vector<double>(data.points.size(), number);
      if (array.name != "GlobalNodeId") continue;
      for (const std::int64_t id : std::get<std::vector<std::int64_t>>(array.values)) {
        expected.emplace(id, number);
      }
    }
    write_mesh(part, data);
    ++number;
  }
  for (const std::size_t count : {1, 3}) {
    CAPTURE(count);
    const auto out = folder.path() / "out.vtu";
    on_ranks(count, [&](Ranks& ranks) { convert_with_arrays(parts, out, ranks); });
    const MeshData data = read_mesh(out);
    const auto& heights = std::get<std::vector<double>>(data.point_data.at(0).values);
    REQUIRE(heights.size() == expected.size());
    for (const auto& [id, height] : expected)
      CHECK(heights[static_cast<std::size_t>(id)] == height);
  }
}

TEST_CASE("ghost tets of parts go with their values, and arrays that some parts lack are named") {
  const Folder folder;
  const auto in = folder.path() / "in.meshb";
  const auto parts = folder.path() / "in.pvtu";
  save(in, MeshAccess::make(mesh_of_vtk()));
  on_ranks(2, [&](Ranks& ranks) { improve_to(in, parts, ranks); });
  std::size_t tets = 0;
  for (const auto& part : pieces::read_pvtu(parts)) {
    MeshData data = read_mesh(part);
    tets += data.tets.size();
    const std::size_t tets_here = data.tets.size();
    std::vector<std::int32_t> ghosts(tets_here, 0);
    for (std::size_t i = 0; i < 3; ++i) {
      // A tet of another part, which nothing here has: copies would be dropped before.
      MeshData::Tet ghost = data.tets[i];
      const auto& others = data.tets[tets_here - 1 - i].vertices;
      ghost.vertices[3] = *std::find_if(others.begin(), others.end(), [&](std::uint32_t v) {
        return std::find(ghost.vertices.begin(), ghost.vertices.end(), v) == ghost.vertices.end();
      });
      data.tets.push_back(ghost);
      ghosts.push_back(1);
    }
    data.tet_data.push_back({"vtkGhostType", 1, ghosts});
    if (part == pieces::read_pvtu(parts).front()) {
      data.point_data.push_back({"heat", 1, std::vector<double>(data.points.size(), 1.0)});
    }
    std::vector<double> sizes;
    for (std::size_t i = 0; i < data.tets.size(); ++i) sizes.push_back(ghosts[i] == 0 ? 2.5 : -1);
    data.tet_data.push_back({"size", 1, sizes});
    write_mesh(part, data);
  }
  on_ranks(2, [&](Ranks& ranks) {
    const PvtuFiles files(ranks);
    const pieces::InputMesh mesh(parts, ranks, &files);
    CHECK(mesh.tets() == tets);
    CHECK(
        mesh.lost_in(folder.path() / "x.pvtu") ==
        std::vector<std::string>{"the array 'heat' of points is not kept: not all parts have it"});
    const pieces::RankShare share = files.read(parts, {});
    REQUIRE(share.arrays[pieces::RowKind::tet].size() == 1);
    CHECK(share.arrays[pieces::RowKind::tet].front().values ==
          DataArray::Values(std::vector<double>(share.tets.size(), 2.5)));
  });
}

TEST_CASE("parts that do not fit are errors") {
  const Folder folder;
  const auto in = folder.path() / "in.meshb";
  const auto parts = folder.path() / "in.pvtu";
  save(in, MeshAccess::make(mesh_of_vtk()));
  on_ranks(2, [&](Ranks& ranks) { improve_to(in, parts, ranks); });
  const auto last = pieces::read_pvtu(parts).back();
  const auto message = [&] {
    return message_of([&] {
      on_ranks(2, [&](Ranks& ranks) { convert(parts, folder.path() / "out.meshb", ranks); });
    });
  };
  CHECK(message() == "");
  const MeshData sound = read_mesh(last);
  MeshData moved = sound;
  for (Point& p : moved.points) p.x() += 1e-9;
  write_mesh(last, moved);
  CHECK(message().find("lies at two places") != std::string::npos);
  MeshData twice = sound;
  auto& ids = std::get<std::vector<std::int64_t>>(twice.point_data.front().values);
  ids[1] = ids[0];
  write_mesh(last, twice);
  CHECK(message().find("two points have the number") != std::string::npos);
  std::filesystem::remove(last);
  CHECK(message().find(last.filename().string()) != std::string::npos);
  std::ofstream(parts) << "<VTKFile/>";
  CHECK(message().find("expected a VTKFile with a PUnstructuredGrid") != std::string::npos);
}

TEST_CASE("points of one part stay apart; where another part has one, too, it is an error") {
  const auto merged = [](bool is_everywhere, std::size_t count) {
    std::vector<std::uint64_t> numbers;
    on_ranks(count, [&](Ranks& ranks) {
      pieces::PartPoints mine;
      for (std::uint64_t part = 0; part < 2; ++part) {
        if (part * count / 2 != ranks.number()) continue;
        for (const double x : {double(part), 5.0, part == 0 || is_everywhere ? 5.0 : 7.0}) {
          if (part == 1 && !is_everywhere && x == 5.0) continue;
          mine.points.emplace_back(x, 0, 0);
          mine.part_of.push_back(part);
        }
      }
      const pieces::MergedPoints now = pieces::merge_points(mine, ranks);
      if (ranks.is_first()) numbers = now.numbers;
    });
    return numbers;
  };
  CHECK(merged(false, 2) == std::vector<std::uint64_t>{0, 1, 2});
  CHECK(merged(false, 1) == std::vector<std::uint64_t>{0, 1, 2, 3, 4});
  CHECK_THROWS_AS(merged(true, 2), Error);
}
