// SPDX-License-Identifier: MIT
// The lessons of assets/lessons are what make_lessons makes today, and show what they promise.
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "kernel/formats/mesh_io.h"
#include "kernel/integrity.h"
#include "tests/apps/program.h"
#include "trace/lesson.h"
#include "trace/replay.h"
#include "trace/trace_frame.h"
#include "trace/verdict.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

const std::filesystem::path kLessons = TETMEND_SOURCE_DIR "/assets/lessons";

/// The content of all frames: another release of the compressor may pack them otherwise.
std::vector<std::vector<std::byte>> frames_of(const std::filesystem::path& file) {
  FrameReader reader(file);
  std::vector<std::vector<std::byte>> frames;
  while (reader.next()) reader.unpack(reader.offset(), frames.emplace_back());
  CHECK(reader.damage().empty());
  return frames;
}

/// Number of tets at the edge 0 1.
std::size_t degree(const SlotMesh& mesh) {
  std::size_t tets = 0;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    if (mesh.is_deleted(TetHandle(i))) continue;
    const TetVertices& v = mesh.vertices(TetHandle(i));
    tets += std::ranges::count_if(v, [](VertexHandle x) { return x.index() < 2; }) == 2 ? 1 : 0;
  }
  return tets;
}

std::vector<std::size_t> degrees_during(const std::string& lesson) {
  const TraceFile file(read_lesson(kLessons / lesson).trace);
  Replay replay(file);
  std::vector<std::size_t> degrees = {degree(replay.mesh())};
  for (std::uint64_t k = 1; k <= file.event_count(); ++k) {
    replay.seek(k);
    if (degree(replay.mesh()) != degrees.back()) degrees.push_back(degree(replay.mesh()));
  }
  return degrees;
}

}  // namespace

TEST_CASE("the lessons are made again just as they are") {
  const TempFolder folder;
  REQUIRE(run_program({(folder / "").string()}).status == 0);
  const auto lessons = list_lessons(kLessons);
  REQUIRE(lessons.size() == 8);
  CHECK(folder.entries() == 3 * lessons.size());
  for (const std::filesystem::path& file : lessons) {
    CAPTURE(file.string());
    const Lesson lesson = read_lesson(file);
    CHECK(read_text(folder / file.filename().string()) == read_text(file));
    CHECK(read_text(folder / lesson.mesh.filename().string()) == read_text(lesson.mesh));
    CHECK(frames_of(folder / lesson.trace.filename().string()) == frames_of(lesson.trace));
  }
}

TEST_CASE("each lesson has a whole trace of its mesh, small, and steps inside it") {
  for (const std::filesystem::path& path : list_lessons(kLessons)) {
    CAPTURE(path.string());
    const Lesson lesson = read_lesson(path);
    const TraceFile file(lesson.trace);
    CHECK(file.damage().empty());
    CHECK(file.file_size() < 10000);
    CHECK(lesson.steps.front().at == 0);
    CHECK(lesson.steps.back().at <= file.event_count());
    const TetMesh mesh(read_mesh(lesson.mesh));
    CHECK(count_not_positive(mesh) == 0);
    CHECK(file.initial_mesh().fingerprint() == SlotMesh(mesh).fingerprint());
  }
}

TEST_CASE("a lesson asks for what is in sight, and speaks of nothing that only a page has") {
  for (const std::filesystem::path& path : list_lessons(kLessons)) {
    const Lesson lesson = read_lesson(path);
    const TraceFile file(lesson.trace);
    for (const LessonStep& step : lesson.steps) {
      CAPTURE(path.string());
      CAPTURE(step.text);
      CHECK(step.text.find("Before and After") == std::string::npos);
      if (!step.ask) continue;
      // After the change, the window counts what is shown.
      EventCursor cursor(file);
      if (step.at > 0) cursor.move_to(step.at - 1);
      const bool is_after_change = step.at > 0 && changes_mesh(cursor.next().kind);
      CHECK(!(is_after_change && step.ask->of == "tets made"));
      if (step.ask->of != "bad tets") continue;
      // In a call, and at the visit of a tet, other tets are outlines at most.
      for (const Call& call : file.calls()) {
        CHECK(!(call.events.begin < step.at && step.at <= call.events.end));
      }
      for (const Visit& visit : file.visits()) {
        CHECK(!(visit.events.begin < step.at && step.at <= visit.events.end));
      }
    }
  }
}

TEST_CASE("the first lesson leaves a core of four where edge removal fails") {
  CHECK(degrees_during("1-core.json") == std::vector<std::size_t>{6, 4});
  const TraceFile file(read_lesson(kLessons / "1-core.json").trace);
  REQUIRE(file.calls().size() == 2);
  CHECK(file.calls()[0].algorithm == Algorithm::edge_removal);
  CHECK(!file.calls()[0].accepted());
  CHECK(file.calls()[1].accepted());
}

TEST_CASE("the second lesson removes an edge as Figure 5 does: 5 tets around it, 4, 3, none") {
  CHECK(degrees_during("2-two-shells.json") == std::vector<std::size_t>{5, 4, 3, 0});
}

TEST_CASE("the third lesson has every reason to refuse, tells of each, and leaves the mesh alone") {
  const Lesson lesson = read_lesson(kLessons / "3-refusals.json");
  const TraceFile file(lesson.trace);
  std::set<std::optional<Verdict>> seen;
  for (const Call& call : file.calls()) {
    if (call.depth == 0) seen.insert(call.verdict);
  }
  for (std::size_t v = 0; v < kVerdictCount; ++v) {
    const auto verdict = static_cast<Verdict>(v);
    const std::string answer = fmt::format("The answer is \"{}\"", to_string(verdict));
    CAPTURE(answer);
    const bool is_refusal = verdict != Verdict::accepted;
    CHECK(seen.contains(verdict) == is_refusal);
    CHECK(std::ranges::count_if(lesson.steps, [&](const LessonStep& step) {
            return step.text.starts_with(answer);
          }) == (is_refusal ? 1 : 0));
  }
  Replay replay(file);
  replay.seek(file.event_count());
  CHECK(replay.mesh().fingerprint() == file.initial_mesh().fingerprint());
}
