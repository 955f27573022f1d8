// SPDX-License-Identifier: MIT
// Who works on the pieces cannot show: ranks, tasks over files, and runs that go on where others were
// killed give the same bytes.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>

#include <doctest/doctest.h>
#include <tetmend/io.h>

#include "face/mesh_access.h"
#include "pieces/folder_run.h"
#include "pieces/improve.h"
#include "pieces/out_of_core.h"
#include "pieces/rank_share.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/pieces/meshes.h"
#include "tests/pieces/played_ranks.h"

using namespace tetmend;
using namespace tetmend::test;
using pieces::Division;
using pieces::FolderRun;
using pieces::OutOfCore;
using pieces::Ranks;

namespace {

constexpr std::size_t kRankPieces = 5;

/// A mesh on disk, and what `tetmend improve --pieces 5` makes of it.
struct RankFiles {
  explicit RankFiles(std::string ending = ".meshb", const Options& options = {})
      : in(folder.path() / ("in" + ending)),
        out(folder.path() / ("out" + ending)),
        checkpoint(folder.path() / "checkpoint") {
    save(in, MeshAccess::make(lattice(9)));
    Mesh mesh = load(in);
    Division division;
    division.pieces = kRankPieces;
    pieces::improve(mesh, options, division);
    const auto expected_file = folder.path() / ("expected" + ending);
    save(expected_file, mesh);
    expected = read_text(expected_file);
  }
  OutOfCore all() const {
    OutOfCore files;
    files.input = in;
    files.output = out;
    return files;
  }

  Folder folder;
  std::filesystem::path in, out, checkpoint;
  std::string expected;
};

Result improve(const OutOfCore& files, Ranks& ranks, const Options& options = {}) {
  Division division;
  division.pieces = kRankPieces;
  return pieces::improve_files(files, options, division, ranks);
}

/// Ends a run as a crash of one rank would, while it works on a piece of a late step.
OutOfCore with_crash(OutOfCore files, std::atomic<int>& calls, int last) {
  files.fault = [&calls, last](std::size_t, pieces::Piece&) {
    if (++calls > last) throw Error("crash");
  };
  return files;
}

void improve_all(const std::filesystem::path& folder) {
  for (;;) {
    FolderRun run(folder);
    if (run.is_finished()) return;
    for (const std::size_t piece : run.round().pieces) FolderRun(folder).improve({piece}, {});
    FolderRun(folder).join({});
  }
}

/// What a rank has of a mesh that lies on all of them, in unequal shares.
pieces::RankShare unequal_share(const MeshData& data, const Ranks& ranks) {
  pieces::RankShare mine;
  const auto begin_of = [&](std::size_t count, std::size_t rank) {
    return count * rank * rank / (ranks.count() * ranks.count());
  };
  const auto take = [&](const auto& all, auto& to) {
    for (std::size_t i = begin_of(all.size(), ranks.number());
         i < begin_of(all.size(), ranks.number() + 1); ++i) {
      auto& made = to.emplace_back();
      std::copy(all[i].vertices.begin(), all[i].vertices.end(), made.vertices.begin());
      made.label = all[i].label;
    }
  };
  take(data.tets, mine.tets);
  take(data.triangles, mine.triangles);
  take(data.edges, mine.edges);
  for (std::size_t v = begin_of(data.points.size(), ranks.number());
       v < begin_of(data.points.size(), ranks.number() + 1); ++v) {
    mine.points.push_back(data.points[v]);
  }
  if (ranks.number() + 1 == ranks.count()) {
    mine.required_vertices.assign(data.required_vertices.begin(), data.required_vertices.end());
  }
  return mine;
}

/// The arrays of all ranks, one after another.
MeshData joined_shares(const std::vector<pieces::RankShare>& all) {
  MeshData data;
  const auto append = [](const auto& from, auto& to) {
    for (const auto& each : from) {
      auto& made = to.emplace_back();
      std::copy(each.vertices.begin(), each.vertices.end(), made.vertices.begin());
      made.label = each.label;
    }
  };
  for (const pieces::RankShare& part : all) {
    data.points.insert(data.points.end(), part.points.begin(), part.points.end());
    append(part.tets, data.tets);
    append(part.triangles, data.triangles);
    append(part.edges, data.edges);
    data.required_vertices.insert(data.required_vertices.end(), part.required_vertices.begin(),
                                  part.required_vertices.end());
  }
  return data;
}

}  // namespace

TEST_CASE("the number of ranks does not show in the result, nor that of their threads") {
  for (const char* ending : {".meshb", ".mesh", ".vtu"}) {
    CAPTURE(ending);
    const RankFiles files(ending);
    for (const std::size_t count : {1, 2, 3, 8}) {
      CAPTURE(count);
      const int threads = count == 3 ? 2 : 1;
      std::filesystem::remove(files.out);
      on_ranks(count, [&](Ranks& ranks) {
        const Result result = improve(files.all(), ranks, {.threads = threads});
        CHECK(result.after.n_bad < result.before.n_bad / 10);
        CHECK(result.worse().empty());
        CHECK(result.surface_fingerprint_before == result.surface_fingerprint);
      });
      CHECK(read_text(files.out) == files.expected);
    }
  }
}

TEST_CASE("the format of the output is free, and all ranks help to write it") {
  const RankFiles files;
  Mesh mesh = load(files.in);
  Division division;
  division.pieces = kRankPieces;
  pieces::improve(mesh, {}, division);
  for (const char* ending : {".msh", ".vtu", ".mesh"}) {
    CAPTURE(ending);
    const auto expected = files.folder.path() / (std::string("whole") + ending);
    save(expected, mesh);
    OutOfCore all = files.all();
    all.output = files.folder.path() / (std::string("parts") + ending);
    for (const std::size_t count : {1, 3}) {
      CAPTURE(count);
      std::filesystem::remove(all.output);
      on_ranks(count, [&](Ranks& ranks) { improve(all, ranks); });
      CHECK(read_text(all.output) == read_text(expected));
    }
  }
}

TEST_CASE("by which number the first vertex goes does not show in the result") {
  for (const char* ending : {".meshb", ".mesh"}) {
    const RankFiles files(ending);
    OutOfCore shifted = files.all();
    shifted.first_id = pieces::VertexId{1} << 33;
    for (const std::size_t count : {1, 3}) {
      CAPTURE(count);
      std::filesystem::remove(files.out);
      on_ranks(count, [&](Ranks& ranks) { improve(shifted, ranks); });
      CHECK(read_text(files.out) == files.expected);
    }
  }
}

TEST_CASE("what a run took is known to all ranks: bytes, seconds, pieces") {
  const RankFiles files;
  std::vector<pieces::PartTime> alone;
  for (const std::size_t count : {1, 4}) {
    std::vector<pieces::RunCosts> costs(count);
    on_ranks(count, [&](Ranks& ranks) {
      OutOfCore told = files.all();
      told.costs = &costs[ranks.number()];
      improve(told, ranks);
    });
    for (const pieces::RunCosts& of_rank : costs) {
      CHECK(of_rank.ranks == count);
      CHECK(of_rank.bytes_a_tet() == costs[0].bytes_a_tet());
      CHECK((of_rank.bytes_a_tet() > 0) == (count > 1));
      CHECK(of_rank.bytes_a_tet() < 60);  // pieces are tiny
      for (const pieces::Traffic& division : of_rank.divisions) CHECK(division.tets > 3000);
      if (alone.empty()) alone = of_rank.parts;
      std::vector<pieces::PartTime> parts = of_rank.parts;
      std::sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
        return std::pair(a.step, a.part) < std::pair(b.step, b.part);
      });
      REQUIRE(parts.size() == alone.size());
      CHECK(parts.size() >= 3 * kRankPieces);
      for (std::size_t i = 0; i < parts.size(); ++i) {
        CHECK(parts[i].part == alone[i].part);
        CHECK(parts[i].tets == alone[i].tets);
        CHECK(parts[i].seconds > 0);
      }
    }
  }
}

TEST_CASE("with one piece the first of several ranks does what improve() does") {
  const RankFiles files;
  Mesh mesh = load(files.in);
  improve(mesh);
  const auto alone = files.folder.path() / "alone.meshb";
  save(alone, mesh);
  on_ranks(3, [&](Ranks& ranks) {
    Division division;
    division.pieces = 0;  // a piece for each 4 million tets
    pieces::improve_files(files.all(), {}, division, ranks);
    CHECK(division.pieces == 1);
  });
  CHECK(read_text(files.out) == read_text(alone));
}

TEST_CASE("each rank has its share of the pieces, and together they have all") {
  pieces::Parting parting;
  parting.cuts = std::vector<std::uint64_t>(10, 0);
  parting.zones = pieces::ZoneMap(std::vector<pieces::Ball>{{Point(0, 0, 0), 1, 0},
                                                            {Point(9, 0, 0), 1, 1},
                                                            {Point(9, 9, 0), 1, 1},
                                                            {Point(0, 9, 0), 1, 2}});
  const std::vector<std::uint32_t> expected = {0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 0, 1};
  const std::vector<std::uint32_t> owners = pieces::owners_of(parting, 2);
  CHECK(std::vector(owners.begin(), owners.begin() + 10) ==
        std::vector(expected.begin(), expected.begin() + 10));
  CHECK(owners[11] != owners[10]);  // the zone of two balls has a rank for itself
  CHECK(owners[12] == owners[10]);
  for (const std::uint32_t owner : pieces::owners_of(parting, 40)) CHECK(owner < 40);
}

TEST_CASE("no zone is larger than a piece, and who has which cannot show") {
  const RankFiles files;
  std::map<std::uint64_t, std::string> made;  // by the size that zones may have
  for (const std::uint64_t least : {std::uint64_t{1}, Division::kLeastZone}) {
    for (const std::size_t count : {1, 3}) {
      CAPTURE(count);
      std::size_t pieces = 0;
      std::size_t zones = 0;
      std::size_t number = 0;
      on_ranks(count, [&](Ranks& ranks) {
        Division division;
        division.pieces = kRankPieces;
        division.least_zone = least;
        pieces::RunCosts costs;
        OutOfCore all = files.all();
        all.costs = &costs;
        pieces::improve_files(all, {}, division, ranks);
        if (!ranks.is_first()) return;
        for (const pieces::PartTime& part : costs.parts) {
          std::size_t& largest = part.step < division.divisions ? pieces : zones;
          largest = std::max<std::size_t>(largest, part.tets);
          number += part.step == division.divisions ? 1 : 0;
        }
      });
      const std::string bytes = read_text(files.out);
      CHECK(made.try_emplace(least, bytes).first->second == bytes);
      CHECK((number > 1) == (least == 1));
      CHECK((zones <= pieces * 3 / 2) == (least == 1));
    }
  }
}

TEST_CASE("a run that was killed goes on from its checkpoint with any number of ranks") {
  const RankFiles files;
  std::atomic<int> total = 0;
  const OutOfCore whole = with_crash(files.all(), total, 1'000'000);
  on_ranks(2, [&](Ranks& ranks) { improve(whole, ranks); });
  std::filesystem::remove(files.out);
  for (const int last : {3, 7, 12}) {
    CAPTURE(last);
    OutOfCore saved = files.all();
    saved.checkpoint = files.checkpoint;
    std::atomic<int> calls = 0;
    const OutOfCore crashing = with_crash(saved, calls, last);
    CHECK_THROWS_WITH_AS(on_ranks(2, [&](Ranks& ranks) { improve(crashing, ranks); }), "crash",
                         Error);
    CHECK(!std::filesystem::exists(files.out));
    const int finished = last < 5 ? 0 : last < 10 ? 5 : 10;  // of whole divisions
    CHECK(std::filesystem::exists(files.checkpoint / "run") == (finished > 0));
    std::atomic<int> rest = 0;
    const OutOfCore counting = with_crash(saved, rest, 1'000'000);
    on_ranks(3, [&](Ranks& ranks) { improve(counting, ranks); });
    CHECK(read_text(files.out) == files.expected);
    CHECK(!std::filesystem::exists(files.checkpoint));
    CHECK(rest == total - finished);  // what was finished is not done again
    std::filesystem::remove(files.out);
  }
}

TEST_CASE("a checkpoint of another run is an error, and stays") {
  const RankFiles files;
  OutOfCore saved = files.all();
  saved.checkpoint = files.checkpoint;
  std::atomic<int> calls = 0;
  pieces::OneRank ranks;
  CHECK_THROWS_AS(improve(with_crash(saved, calls, 7), ranks), Error);
  const std::string message =
      files.checkpoint.string() + ": has a run of another mesh, or with other options";
  CHECK_THROWS_WITH_AS(improve(saved, ranks, {.schedule = "conservative"}), message.c_str(), Error);
  Division division;
  division.pieces = kRankPieces + 1;
  CHECK_THROWS_WITH_AS(pieces::improve_files(saved, {}, division, ranks), message.c_str(), Error);
  std::ofstream(files.checkpoint / "run", std::ios::trunc) << "other bytes";
  CHECK_THROWS_AS(improve(saved, ranks), Error);
  CHECK(std::filesystem::exists(files.checkpoint / "run"));
}

TEST_CASE("damage of any file of a checkpoint is an error that names the file, before any work") {
  const RankFiles files;
  OutOfCore saved = files.all();
  saved.checkpoint = files.checkpoint;
  std::atomic<int> calls = 0;
  pieces::OneRank alone;
  CHECK_THROWS_AS(improve(with_crash(saved, calls, 2 * kRankPieces + 2), alone), Error);
  const std::filesystem::path good = files.folder.path() / "good";
  std::filesystem::copy(files.checkpoint, good, std::filesystem::copy_options::recursive);
  std::size_t damaged = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(good)) {
    const std::filesystem::path file = entry.path().lexically_relative(good);
    if (!entry.is_regular_file() || file == "lock") continue;
    CAPTURE(file.string());
    const std::string content = read_text(entry.path());
    const auto complaint_after = [&](const std::string& bytes) -> std::string {
      std::filesystem::remove_all(files.checkpoint);
      std::filesystem::copy(good, files.checkpoint, std::filesystem::copy_options::recursive);
      const std::filesystem::path changed = files.checkpoint / file;
      if (bytes.empty()) std::filesystem::remove(changed);
      if (!bytes.empty()) std::ofstream(changed, std::ios::binary) << bytes;
      try {
        std::atomic<int> none = 0;
        improve(with_crash(saved, none, 0), alone);  // any work is another error
      } catch (const Error& error) {
        return error.what();
      }
      return "no error";
    };
    for (const std::size_t place : {std::size_t{40}, content.size() / 2, content.size() - 1}) {
      std::string bytes = content;
      char& byte = bytes[place % bytes.size()];
      byte = static_cast<char>(byte ^ 16);
      CHECK(complaint_after(bytes) == (files.checkpoint / file).string() + " is damaged: delete " +
                                          (files.checkpoint / "run").string());
    }
    const std::string lost = complaint_after("");
    const bool is_run = file == "run";  // without it there is no run: it begins anew
    CHECK((lost.find(" is missing: delete ") != std::string::npos) == !is_run);
    ++damaged;
  }
  CHECK(damaged == 1 + 2 * kRankPieces);  // the state, stored pieces and what was kept
  CHECK(!std::filesystem::exists(files.out));
}

TEST_CASE("a checkpoint of a mesh that has other bytes by now is one of another mesh") {
  const RankFiles files;
  OutOfCore saved = files.all();
  saved.checkpoint = files.checkpoint;
  std::atomic<int> calls = 0;
  pieces::OneRank alone;
  CHECK_THROWS_AS(improve(with_crash(saved, calls, 7), alone), Error);
  MeshData moved = lattice(9);
  moved.points[500].x() += 1e-6;
  save(files.in, MeshAccess::make(std::move(moved)));  // as many bytes
  CHECK_THROWS_WITH_AS(improve(saved, alone), doctest::Contains("has a run of another mesh"),
                       Error);
}

TEST_CASE(
    "while a program works on the run of a folder, others are refused; tasks work side by side") {
  const RankFiles files;
  OutOfCore saved = files.all();
  saved.checkpoint = files.checkpoint;
  pieces::OneRank alone;
  const std::string message =
      files.checkpoint.string() + ": another program works on the run of this folder";
  {
    const pieces::FolderLock other(files.checkpoint, platform::Sharing::none);
    CHECK(other.made_folder());
    CHECK_THROWS_WITH_AS(improve(saved, alone), message.c_str(), Error);
    CHECK_THROWS_WITH_AS(on_ranks(3, [&](Ranks& ranks) { improve(saved, ranks); }), message.c_str(),
                         Error);
  }
  CHECK(!std::filesystem::exists(files.checkpoint));
  Division division;
  division.pieces = kRankPieces;
  FolderRun::split(files.all(), files.checkpoint, {}, division);
  FolderRun run(files.checkpoint);
  {
    const pieces::FolderLock other(files.checkpoint, platform::Sharing::others);
    CHECK(run.improve({0, 1, 2, 3, 4}, {}) == 5);
    CHECK_THROWS_WITH_AS(run.join({}), message.c_str(), Error);
  }
  FolderRun late(files.checkpoint);
  run.join({});
  CHECK_THROWS_WITH_AS(late.join({}), doctest::Contains("another program has ended this round"),
                       Error);
  CHECK_THROWS_WITH_AS(late.improve({1}, {}), doctest::Contains("has ended this round"), Error);
}

TEST_CASE("a folder that was there before a run stays, and so does a link") {
  const RankFiles files;
  const std::filesystem::path behind = files.folder.path() / "behind";
  OutOfCore saved = files.all();
  saved.checkpoint = files.checkpoint;
  pieces::OneRank alone;
  const auto run_to_its_end = [&] {
    std::atomic<int> calls = 0;
    CHECK_THROWS_AS(improve(with_crash(saved, calls, 7), alone), Error);
    CHECK(std::filesystem::exists(files.checkpoint / "run"));
    improve(saved, alone);
    CHECK(read_text(files.out) == files.expected);
  };
  std::filesystem::create_directory(files.checkpoint);
  run_to_its_end();
  CHECK(std::filesystem::is_directory(files.checkpoint));
  CHECK(std::filesystem::is_empty(files.checkpoint));
  std::filesystem::remove(files.checkpoint);
  std::filesystem::create_directory(behind);
  std::filesystem::create_directory_symlink(behind, files.checkpoint);
  run_to_its_end();
  CHECK(std::filesystem::is_symlink(files.checkpoint));
  CHECK(std::filesystem::is_empty(behind));
  // A run that fails before its first checkpoint leaves nothing, and takes nothing away.
  OutOfCore missing = saved;
  missing.input = files.folder.path() / "none.meshb";
  CHECK_THROWS_AS(improve(missing, alone), Error);
  CHECK(std::filesystem::is_empty(behind));
  std::filesystem::remove(files.checkpoint);
  CHECK_THROWS_AS(improve(missing, alone), Error);
  CHECK(!std::filesystem::exists(files.checkpoint));
}

TEST_CASE("a run that was told to stop leaves the last whole division to go on from") {
  const RankFiles files;
  OutOfCore saved = files.all();
  saved.checkpoint = files.checkpoint;
  std::atomic<bool> stop = false;
  std::atomic<int> calls = 0;
  saved.fault = [&](std::size_t, pieces::Piece&) {
    if (++calls == 7) stop = true;
  };
  on_ranks(2, [&](Ranks& ranks) {
    CHECK(improve(saved, ranks, {.cancel = &stop}).ending == Ending::cancelled);
  });
  CHECK(read_text(files.out) != files.expected);
  CHECK(std::filesystem::exists(files.checkpoint / "run"));
  saved.fault = {};
  on_ranks(1, [&](Ranks& ranks) { improve(saved, ranks); });
  CHECK(read_text(files.out) == files.expected);
}

TEST_CASE("tasks over the files of a folder give the same bytes, killed or not") {
  const Options options = {.set = {{"max_rounds", "3"}}, .goal = {28, 152}};
  const RankFiles files(".meshb", options);
  const std::filesystem::path work = files.folder.path() / "work";
  Division division;
  division.pieces = kRankPieces;
  FolderRun::split(files.all(), work, options, division);
  CHECK_THROWS_AS(FolderRun::split(files.all(), work, options, division), Error);
  FolderRun run(work);
  CHECK(run.round().name == "division 1");
  CHECK(run.round().open == std::vector<std::size_t>{0, 1, 2, 3, 4});
  CHECK(run.improve({4, 1}, {.threads = 2}) == 2);
  CHECK(run.improve({1}, {}) == 0);
  CHECK_THROWS_WITH_AS(run.improve({5}, {}), "there is no piece 5 in this round: it has 5", Error);
  CHECK_THROWS_WITH_AS(run.join({}), "division 1: 3 of 5 pieces are not finished yet: 0, 2, 3",
                       Error);
  // A task that was killed has left an outcome that is not there, or a piece that is not whole.
  std::filesystem::remove(work / "step-1" / "outcome-1");
  std::ofstream(work / "step-1" / "stored-1", std::ios::trunc) << "half";
  CHECK(run.round().open == std::vector<std::size_t>{0, 1, 2, 3});
  run.improve({3, 2, 1, 0}, {});
  // A join that was killed has left pieces of the next round, and the file of this one.
  const std::string state = read_text(work / "run");
  std::filesystem::copy(work / "step-1", files.folder.path() / "kept");
  run.join({});
  CHECK(FolderRun(work).round().name == "division 2");
  CHECK(!std::filesystem::exists(work / "step-1"));
  std::ofstream(work / "run", std::ios::binary | std::ios::trunc) << state;
  std::filesystem::rename(files.folder.path() / "kept", work / "step-1");
  FolderRun(work).join({});
  CHECK(!std::filesystem::exists(files.out));
  improve_all(work);
  CHECK(read_text(files.out) == files.expected);
  CHECK(!std::filesystem::exists(work / "step-4"));
}

TEST_CASE("tasks over files go on from a checkpoint, and ranks from the files of tasks") {
  const RankFiles files;
  OutOfCore saved = files.all();
  saved.checkpoint = files.checkpoint;
  std::atomic<int> calls = 0;
  const OutOfCore crashing = with_crash(saved, calls, 7);
  CHECK_THROWS_AS(on_ranks(2, [&](Ranks& ranks) { improve(crashing, ranks); }), Error);
  FolderRun(files.checkpoint).join({});
  CHECK(FolderRun(files.checkpoint).round().name == "division 2");
  FolderRun(files.checkpoint).improve({0, 3}, {});
  on_ranks(3, [&](Ranks& ranks) { improve(saved, ranks); });
  CHECK(read_text(files.out) == files.expected);
}

TEST_CASE(
    "a mesh whose arrays lie on the ranks is divided as the mesh of a file, and comes back so") {
  const MeshData data = lattice(9);
  const RankFiles files;
  for (const std::size_t count : {1, 2, 3, 8}) {
    CAPTURE(count);
    std::vector<pieces::RankShare> made(count);
    on_ranks(count, [&](Ranks& ranks) {
      const pieces::RankShare mine = unequal_share(data, ranks);
      pieces::MemoryShelf shelf;
      pieces::DividedMesh mesh(shelf, ranks, data.points.size());
      pieces::add_arrays(mine, mesh);
      made[ranks.number()] = pieces::take_arrays(mesh);
      CHECK(pieces::count_all(made[ranks.number()], ranks).tets == data.tets.size());
      CHECK(made[ranks.number()].points.size() <= data.points.size() / count + 1);
      mesh.divide(kRankPieces, 0);
      pieces::MemoryShelf other;
      pieces::DividedMesh of_file(other, ranks, data.points.size());
      pieces::InputMesh(files.in, ranks).add_to(of_file, kRankPieces);
      of_file.divide(kRankPieces, 0);
      for (const std::size_t part : mesh.own()) {
        CHECK(mesh.gathered(part).ids == of_file.gathered(part).ids);
        CHECK(mesh.gathered(part).tets == of_file.gathered(part).tets);
        CHECK(mesh.gathered(part).marks == of_file.gathered(part).marks);
      }
    });
    const MeshData again = joined_shares(made);
    CHECK(again.points == data.points);
    CHECK(again.tets == data.tets);
    CHECK(again.triangles == data.triangles);
    CHECK(again.edges == data.edges);
    CHECK(again.required_vertices == data.required_vertices);
  }
}

TEST_CASE("arrays that name what is not there are errors") {
  const MeshData data = lattice(3);
  const auto message_of = [&](const auto& change) -> std::string {
    try {
      on_ranks(2, [&](Ranks& ranks) {
        pieces::RankShare mine = unequal_share(data, ranks);
        change(mine);
        pieces::MemoryShelf shelf;
        pieces::DividedMesh mesh(shelf, ranks, data.points.size());
        pieces::add_arrays(mine, mesh);
      });
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  CHECK(message_of([](pieces::RankShare&) {}) == "");
  CHECK(message_of([](pieces::RankShare& mine) { mine.tets[3].vertices[1] = 64; }) ==
        "there is no vertex 64: the mesh has 64");
  CHECK(message_of([](pieces::RankShare& mine) {
          mine.tets[3].vertices[1] = mine.tets[3].vertices[2];
        }).find("twice") != std::string::npos);
  CHECK(message_of([](pieces::RankShare& mine) {
          mine.points[0].x() = NAN;
        }).find("not a finite number") != std::string::npos);
}

TEST_CASE("a folder without a run, and a mesh that tasks cannot have, are errors") {
  const RankFiles files;
  const std::filesystem::path none = files.folder.path() / "none";
  CHECK_THROWS_AS(FolderRun{none}, Error);
  Division division;
  division.pieces = kRankPieces;
  CHECK_THROWS_AS(FolderRun::split(files.all(), none, {.keep_size = true}, division), OptionError);
  OutOfCore missing = files.all();
  missing.input = none;
  CHECK_THROWS_AS(FolderRun::split(missing, none, {}, division), Error);
  CHECK(!std::filesystem::exists(none));
  division.pieces = 1;
  CHECK_THROWS_AS(FolderRun::split(files.all(), none, {}, division), OptionError);
}
