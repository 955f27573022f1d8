// SPDX-License-Identifier: MIT
// Runs in pieces whose surface may move: within the tolerance, as samples say; the same bytes whoever
// works; and what breaks a promise is noticed.
#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <tetmend/io.h>

#include "contract/zoo.h"
#include "face/mesh_access.h"
#include "kernel/shared_parts.h"
#include "pieces/folder_run.h"
#include "pieces/improve.h"
#include "pieces/out_of_core.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/pieces/meshes.h"
#include "tests/pieces/played_ranks.h"
#include "tests/support/mixed_mesh.h"
#include "tests/support/random_solids.h"
#include "tests/support/surface_promise.h"

using namespace tetmend;
using namespace tetmend::test;
using pieces::Division;
using pieces::FolderRun;
using pieces::OutOfCore;

namespace {

constexpr std::size_t kMovingPieces = 3;

/// Many slivers at its surface, labels of points and triangles, and a group that keeps a point.
MeshData ball() {
  MeshData data = contract::delaunay_ball(200, 5);
  for (const Point& p : data.points) data.point_labels.push_back(p.z() > 0 ? 7 : 0);
  for_face_pairs(sorted_tet_faces(data), [&](const TetFace& face, const TetFace* other) {
    if (other != nullptr) return;
    const auto& v = face.vertices;
    const bool is_high = data.points[v[0]].z() + data.points[v[1]].z() + data.points[v[2]].z() > 0;
    data.triangles.push_back({v, is_high ? 3 : 4});
  });
  return data;
}

Options options_of(const std::string& surface) {
  return {.surface = surface, .feature_angle = 60};
}

/// A mesh on disk, and what a run in memory makes of it.
struct MovingFiles {
  explicit MovingFiles(const MeshData& data, const std::string& ending = ".meshb")
      : in(folder.path() / ("in" + ending)), out(folder.path() / ("out" + ending)) {
    save(in, MeshAccess::make(data));
    Mesh mesh = load(in);
    result = pieces::improve(mesh, options_of("5%"), in_pieces(kMovingPieces));
    const auto file = folder.path() / ("expected" + ending);
    save(file, mesh);
    expected = read_text(file);
  }
  OutOfCore all() const {
    OutOfCore files;
    files.input = in;
    files.output = out;
    return files;
  }

  Folder folder;
  std::filesystem::path in, out;
  std::string expected;
  Result result;
};

}  // namespace

TEST_CASE("random solids in pieces: the surface keeps within the tolerance, both ways") {
  const std::vector<std::string> choices = {"flat", "1%", "3%", "10%", "0.01"};
  RandomSolids source(17, 0.33);
  std::size_t touched = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    const Solid solid = source.next();
    const std::string& surface = choices[i % choices.size()];
    CAPTURE(i);
    CAPTURE(solid.name);
    CAPTURE(surface);
    Mesh mesh = MeshAccess::make(solid.data);
    const Result result = pieces::improve(mesh, {.surface = surface}, in_pieces(2 + i % 3));
    CHECK(complaint(surfaces_of(solid.data), surfaces_of(MeshAccess::data(mesh)), surface) == "");
    CHECK(result.worse().empty());
    REQUIRE(result.surface_change);
    const SurfaceChange& change = *result.surface_change;
    CHECK(change.sampled <= std::max(change.proven, 1e-11));
    CHECK(change.proven <= std::max(change.tolerance, 1e-11));
    touched += change.touched;
  }
  CHECK(touched > 60);
}

TEST_CASE("one piece with a surface that may move is the run of improve()") {
  const MeshData data = ball();
  Mesh whole = MeshAccess::make(data);
  improve(whole, options_of("5%"));
  Mesh one = MeshAccess::make(data);
  pieces::improve(one, options_of("5%"), in_pieces(1));
  CHECK(MeshAccess::data(one).points == MeshAccess::data(whole).points);
  CHECK(MeshAccess::data(one).tets == MeshAccess::data(whole).tets);
}

TEST_CASE("a surface that moves in pieces has the same bytes for threads, ranks, files and tasks") {
  const MeshData data = ball();
  const MovingFiles files(data);
  REQUIRE(files.result.surface_change);
  CHECK(files.result.surface_change->touched > 20);
  CHECK(files.result.after.n_bad < files.result.before.n_bad);
  // Nothing is refined around what is stuck at a border: that made four times as many.
  CHECK(files.result.after.tets < 3 * files.result.before.tets);
  Mesh mesh = load(files.in);
  Options threads = options_of("5%");
  threads.threads = 2;
  pieces::improve(mesh, threads, in_pieces(kMovingPieces));
  const auto by_threads = files.folder.path() / "threads.meshb";
  save(by_threads, mesh);
  CHECK(read_text(by_threads) == files.expected);
  for (const std::size_t ranks : {1, 2, 4}) {
    CAPTURE(ranks);
    on_ranks(ranks, [&](Ranks& rank) {
      Division division = in_pieces(kMovingPieces);
      pieces::improve_files(files.all(), options_of("5%"), division, rank);
    });
    CHECK(read_text(files.out) == files.expected);
    std::filesystem::remove(files.out);
  }
  const auto work = files.folder.path() / "work";
  FolderRun::split(files.all(), work, options_of("5%"), in_pieces(kMovingPieces));
  std::optional<Result> last;
  for (FolderRun run(work); !run.is_finished(); run = FolderRun(work)) {
    for (const std::size_t piece : run.round().pieces) FolderRun(work).improve({piece}, {});
    last = FolderRun(work).join({});
  }
  CHECK(read_text(files.out) == files.expected);
  REQUIRE((last && last->surface_change));
  CHECK(last->surface_change->proven == files.result.surface_change->proven);
}

TEST_CASE("a moving surface takes marks and arrays of a file along, whoever has them") {
  for (const char* ending : {".meshb", ".vtu"}) {
    CAPTURE(ending);
    MeshData data = ball();
    std::vector<double> heights;
    for (const Point& p : data.points) heights.push_back(p.z());
    if (ending == std::string(".vtu")) {
      data.point_data.push_back({"height", 1, heights});
    } else {
      data.groups.push_back({0, 0, "Corners", {}, {0, 1, 2}});
    }
    const MovingFiles files(data, ending);
    for (const std::size_t ranks : {1, 3}) {
      CAPTURE(ranks);
      on_ranks(ranks, [&](Ranks& rank) {
        Division division = in_pieces(kMovingPieces);
        pieces::improve_files(files.all(), options_of("5%"), division, rank);
      });
      CHECK(read_text(files.out) == files.expected);
      std::filesystem::remove(files.out);
    }
  }
}

TEST_CASE("a run with a moving surface that was killed goes on from its checkpoint") {
  const MovingFiles files(ball());
  OutOfCore saved = files.all();
  saved.checkpoint = files.folder.path() / "checkpoint";
  int calls = 0;
  saved.fault = [&](std::size_t, pieces::Piece&) {
    if (++calls > 4) throw Error("crash");
  };
  pieces::OneRank alone;
  Division division = in_pieces(kMovingPieces);
  CHECK_THROWS_AS(pieces::improve_files(saved, options_of("5%"), division, alone), Error);
  CHECK(std::filesystem::exists(saved.checkpoint / "run"));
  saved.fault = {};
  division = in_pieces(kMovingPieces);
  pieces::improve_files(saved, options_of("5%"), division, alone);
  CHECK(read_text(files.out) == files.expected);
  CHECK(!std::filesystem::exists(saved.checkpoint));
}

TEST_CASE("a surface that is farther away than was proven is noticed, and nothing is written") {
  const MovingFiles files(ball());
  const auto with_fault = [&](const std::function<void(pieces::Piece&)>& fault) -> std::string {
    int calls = 0;
    OutOfCore broken = files.all();
    broken.fault = [&](std::size_t, pieces::Piece& piece) {
      if (++calls == 9) fault(piece);  // the last of the last division
    };
    Options options = options_of("5%");
    options.script = "begin_round()";
    pieces::OneRank alone;
    Division division = in_pieces(kMovingPieces);
    division.zone_rounds = 0;
    try {
      pieces::improve_files(broken, options, division, alone);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  CHECK(with_fault([](pieces::Piece&) {}) == "");
  std::filesystem::remove(files.out);
  // A vertex that no other piece has, by a few tolerances towards the middle of the ball.
  const std::string moved = with_fault([](pieces::Piece& piece) {
    for (const auto& face : piece.surface) {
      for (const std::uint32_t v : face.vertices) {
        constexpr unsigned kShared = pieces::kBorder | pieces::kCorner;
        if ((piece.marks[v] & pieces::kOwn) == 0 || (piece.marks[v] & kShared) != 0) continue;
        piece.points[v] *= 0.97;
        return;
      }
    }
  });
  CHECK(moved.find("not near that of the input") != moved.npos);
  const std::string unlisted = with_fault([](pieces::Piece& piece) { piece.surface.pop_back(); });
  CHECK(unlisted != "");
  const std::string renamed = with_fault([](pieces::Piece& piece) {
    for (auto& face : piece.surface) face.label = face.label == 0 ? 1 : 0;
  });
  CHECK(renamed != "");
  CHECK(!std::filesystem::exists(files.out));
}

TEST_CASE("in pieces with a moving surface tets stay joined to other elements") {
  for (const Bed bed : {Bed::wedges, Bed::pyramids}) {
    CAPTURE(static_cast<int>(bed));
    const MeshData before = tets_on(bed, 4, 3);
    Options options = options_of("10%");
    options.goal = {.min_angle = 34, .max_angle = 142};
    Mesh mesh = MeshAccess::make(before);
    const Result result = pieces::improve(mesh, options, in_pieces(kMovingPieces));
    CHECK(result.surface_change->touched > 0);
    CHECK(count_lost_parts(before, result.vertex_map, MeshAccess::data(mesh)) == 0);
    CHECK(faces_on_bed(MeshAccess::data(mesh)).size() == faces_on_bed(before).size());

    const Folder folder;
    OutOfCore files;
    files.input = folder.path() / "in.vtu";
    files.output = folder.path() / "out.vtu";
    save(files.input, MeshAccess::make(before));
    pieces::OneRank alone;
    Division division = in_pieces(kMovingPieces);
    pieces::improve_files(files, options, division, alone);
    Mesh again = load(files.input);
    pieces::improve(again, options, in_pieces(kMovingPieces));
    save(folder.path() / "expected.vtu", again);
    CHECK(read_text(files.output) == read_text(folder.path() / "expected.vtu"));
  }
}
