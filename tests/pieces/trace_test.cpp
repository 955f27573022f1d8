// SPDX-License-Identifier: MIT
// The trace of a run in pieces: which piece it is of, the same bytes whoever works, and what becomes
// of a trace that cannot be.
#include <algorithm>
#include <atomic>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include <doctest/doctest.h>
#include <tetmend/io.h>

#include "face/mesh_access.h"
#include "pieces/folder_run.h"
#include "pieces/improve.h"
#include "pieces/out_of_core.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/pieces/meshes.h"
#include "tests/pieces/played_ranks.h"
#include "trace/trace_file.h"

using namespace tetmend;
using namespace tetmend::test;
using pieces::Division;
using pieces::FolderRun;
using pieces::OutOfCore;
using pieces::Ranks;

namespace {

constexpr std::size_t kTracedPieces = 5;

struct Bench {
  Bench() { save(in, MeshAccess::make(lattice(9))); }
  /// In memory; the trace is there then, and the file goes.
  std::string in_core(Options options, std::string* trouble = nullptr) const {
    options.trace = trace;
    Mesh mesh = load(in);
    const Result result = pieces::improve(mesh, options, in_pieces(kTracedPieces));
    if (trouble != nullptr) *trouble = result.trace_trouble;
    return taken();
  }
  OutOfCore files() const {
    OutOfCore files;
    files.input = in;
    files.output = out;
    return files;
  }
  Result by_ranks(const OutOfCore& files, std::size_t count, Options options) const {
    options.trace = trace;
    std::vector<Result> results(count);
    on_ranks(count, [&](Ranks& ranks) {
      Division division = in_pieces(kTracedPieces);
      results[ranks.number()] = pieces::improve_files(files, options, division, ranks);
    });
    for (const Result& each : results) CHECK(each.trace_trouble == results[0].trace_trouble);
    return results[0];
  }
  std::string taken() const {
    std::string bytes = read_text(trace);
    std::filesystem::remove(trace);
    return bytes;
  }

  Folder folder;
  std::filesystem::path in = folder.path() / "in.meshb";
  std::filesystem::path out = folder.path() / "out.meshb";
  std::filesystem::path trace = folder.path() / "run.trace";
};

std::string setting(const TraceFile& file, std::string_view name) {
  for (const auto& [key, value] : file.header().settings) {
    if (key == name) return value;
  }
  return {};
}

/// What the call says is wrong with an option.
template <class Call>
std::string option_complaint(const Call& call) {
  try {
    call();
  } catch (const OptionError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("the trace of a piece has the same bytes for ranks, threads, files and tasks") {
  const Bench bench;
  for (const std::string piece : {"1:3", "2:0", "4:5"}) {
    CAPTURE(piece);
    const std::string expected = bench.in_core({.trace_piece = piece});
    REQUIRE(!expected.empty());
    CHECK(bench.in_core({.threads = 2, .trace_piece = piece}) == expected);
    for (const std::size_t count : {1, 2, 3, 8}) {
      CAPTURE(count);
      const int threads = count == 2 ? 2 : 1;
      const Result result =
          bench.by_ranks(bench.files(), count, {.threads = threads, .trace_piece = piece});
      CHECK(result.trace_trouble == "");
      CHECK(bench.taken() == expected);
    }
    const std::filesystem::path work = bench.folder.path() / ("work" + piece.substr(0, 1));
    FolderRun::split(bench.files(), work, {}, in_pieces(kTracedPieces));
    const std::size_t round = std::stoul(piece.substr(0, 1));
    const std::size_t part = std::stoul(piece.substr(2));
    for (;;) {
      FolderRun run(work);
      for (const std::size_t each : run.round().pieces) {
        const bool is_it = run.round().number == round && each == part;
        std::string trouble;
        run.improve({each}, {.trace = is_it ? bench.trace : std::filesystem::path()}, &trouble);
        CHECK(trouble == "");
      }
      if (run.round().number == round) break;
      run.join({});
    }
    CHECK(bench.taken() == expected);
  }
}

TEST_CASE("a trace does not show in the mesh, and says which piece of which run it is of") {
  const Bench bench;
  bench.by_ranks(bench.files(), 1, {});
  const std::string mesh = read_text(bench.out);
  bench.taken();
  bench.by_ranks(bench.files(), 2, {.trace_piece = "2:4", .trace_depth = 1});
  CHECK(read_text(bench.out) == mesh);
  const TraceFile file(bench.trace);
  CHECK(file.header().input == bench.in.string());
  CHECK(setting(file, "--pieces") == "5");
  CHECK(setting(file, "--trace-piece") == "2:4");
  CHECK(file.header().filter == "depth at most 1");
  CHECK(!file.calls().empty());
  CHECK(file.damage().empty());
}

TEST_CASE("without a number it is the piece with the worst tet that may change") {
  const Bench bench;
  std::map<std::string, Quality> worst;
  for (const std::string piece : {"1:0", "1:1", "1:2", "1:3", "1:4"}) {
    bench.by_ranks(bench.files(), 1, {.trace_piece = piece});
    const TraceFile file(bench.trace);
    Quality& least = worst.try_emplace(piece, Quality{1}).first->second;
    for (const Visit& visit : file.visits()) least = std::min(least, visit.quality);
    bench.taken();
  }
  const auto expected = std::min_element(
      worst.begin(), worst.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  for (const std::size_t count : {1, 3}) {
    const Result result = bench.by_ranks(bench.files(), count, {});
    const TraceFile file(bench.trace);
    CHECK(setting(file, "--trace-piece") == expected->first);
    const std::string note = "the trace is of round 1, piece " + expected->first.substr(2);
    CHECK(std::count(result.notes.begin(), result.notes.end(), note) == 1);
  }
  bench.taken();
  const std::string of_zones = bench.in_core({.trace_piece = "4"});
  CHECK(!of_zones.empty());
}

TEST_CASE("a place or a tet of the file leads to its piece, in memory and from file to file") {
  const Bench bench;
  std::set<std::string> chosen;
  for (const std::string around : {"1,1,1,2", "8,8,8,2", "17", "4000,1.5"}) {
    CAPTURE(around);
    std::string trouble;
    const std::string expected = bench.in_core({.trace_around = around}, &trouble);
    CHECK(trouble == "");
    for (const std::size_t count : {1, 3}) {
      bench.by_ranks(bench.files(), count, {.trace_around = around});
      chosen.insert(setting(TraceFile(bench.trace), "--trace-piece"));
      CHECK(bench.taken() == expected);
    }
  }
  CHECK(chosen.size() > 1);
}

TEST_CASE("a piece that no run can have is a wrong option, before anything is worked on") {
  const Bench bench;
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"0", "there is no round 0: rounds count from 1 to 7"},
      {"8:0", "there is no round 8: rounds count from 1 to 7"},
      {"3:5", "there is no piece 5 in round 3: it has pieces 0 to 4"},
      {"4:4", "piece 4 is not worked on in round 4: its zones count from 5"},
      {"1:", "'1:' is not of the form ROUND or ROUND:PIECE"},
      {"worst", "'worst' is not of the form ROUND or ROUND:PIECE"}};
  for (const auto& each : wrong) {
    const auto& piece = each.first;
    const auto& reason = each.second;
    CAPTURE(piece);
    const Options options = {.trace = bench.trace, .trace_piece = piece};
    const auto in_core = [&] {
      Mesh mesh = load(bench.in);
      pieces::improve(mesh, options, in_pieces(kTracedPieces));
    };
    CHECK(option_complaint(in_core) == "trace_piece: " + reason);
    CHECK(option_complaint([&] { bench.by_ranks(bench.files(), 2, options); }) ==
          "trace_piece: " + reason);
  }
  Mesh mesh = load(bench.in);
  CHECK(option_complaint([&] { improve(mesh, {.trace = bench.trace, .trace_piece = "1"}); }) ==
        "trace_piece: the run is not in pieces");
  CHECK(option_complaint([&] {
          pieces::improve(mesh, {.trace_piece = "1:2"}, in_pieces(kTracedPieces));
        }) == "trace_piece: it needs the option trace");
  CHECK(option_complaint([&] { bench.by_ranks(bench.files(), 2, {.trace_around = "99999"}); }) ==
        "trace_around: there is no tet 99999 in the mesh, or not any more; they count from 0");
  CHECK(!std::filesystem::exists(bench.trace));
  CHECK(!std::filesystem::exists(bench.out));
}

TEST_CASE("a piece that turns out not to be there leaves the mesh, and the reason") {
  const Bench bench;
  std::string trouble;
  CHECK(bench.in_core({.trace_piece = "4:900"}, &trouble).empty());
  const std::string begin = bench.trace.string() + ": there is no piece 900 in round 4: ";
  CHECK(trouble.substr(0, begin.size()) == begin);
  CHECK(bench.by_ranks(bench.files(), 2, {.trace_piece = "4:900"}).trace_trouble == trouble);
  CHECK(std::filesystem::exists(bench.out));
  CHECK(bench.by_ranks(bench.files(), 2, {.goal = {5, 175}, .trace_piece = "4"}).trace_trouble ==
        bench.trace.string() + ": the run ended before round 4");
  std::atomic<bool> stop = true;
  CHECK(bench.by_ranks(bench.files(), 2, {.cancel = &stop}).trace_trouble ==
        bench.trace.string() + ": the run ended before round 1");
  CHECK(!std::filesystem::exists(bench.trace));
}

TEST_CASE("a run that goes on records what is left to do, and keeps the trace of what was done") {
  const Bench bench;
  const std::string late = bench.in_core({.trace_piece = "3:2"});
  const std::string early = bench.in_core({.trace_piece = "1:2"});
  OutOfCore saved = bench.files();
  saved.checkpoint = bench.folder.path() / "saved";
  for (const std::string piece : {"3:2", "1:2"}) {
    CAPTURE(piece);
    OutOfCore crashing = saved;
    std::atomic<int> calls = 0;
    crashing.fault = [&](std::size_t, pieces::Piece&) {
      if (++calls > 7) throw Error("crash");
    };
    CHECK_THROWS_WITH_AS(bench.by_ranks(crashing, 2, {.trace_piece = piece}), "crash", Error);
    CHECK(std::filesystem::exists(bench.trace) == (piece == "1:2"));
    const Result result = bench.by_ranks(saved, 3, {.trace_piece = piece});
    CHECK(result.trace_trouble == "");
    CHECK(bench.taken() == (piece == "1:2" ? early : late));
  }
  OutOfCore crashing = saved;
  std::atomic<int> calls = 0;
  crashing.fault = [&](std::size_t, pieces::Piece&) {
    if (++calls > 7) throw Error("crash");
  };
  CHECK_THROWS_AS(bench.by_ranks(crashing, 2, {.trace_piece = "2"}), Error);
  CHECK(option_complaint([&] { bench.by_ranks(saved, 2, {.trace_piece = "1:3"}); }) ==
        "trace_piece: round 1 is over, and was not recorded");
  CHECK(std::filesystem::exists(saved.checkpoint / "run"));
}

TEST_CASE("a task records the one piece that it is given, as long as that is open") {
  const Bench bench;
  const std::filesystem::path work = bench.folder.path() / "work";
  FolderRun::split(bench.files(), work, {}, in_pieces(kTracedPieces));
  FolderRun run(work);
  const Options options = {.trace = bench.trace};
  CHECK_THROWS_WITH_AS(run.improve({0, 1}, options),
                       "trace: it is of one piece, which must be named", Error);
  CHECK(run.round().open.size() == kTracedPieces);
  CHECK(run.improve({1}, options) == 1);
  CHECK(!bench.taken().empty());
  CHECK_THROWS_WITH_AS(run.improve({1}, options), "trace: piece 1 is finished already", Error);
}
