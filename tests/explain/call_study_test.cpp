// SPDX-License-Identifier: MIT
#include "explain/call_study.h"

#include <algorithm>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "explain/call_facts.h"
#include "explain/paper_lines.h"
#include "explain/stepper.h"
#include "kernel/geometry.h"
#include "tests/support/example_traces.h"

using namespace tetmend;
using namespace tetmend::explain;

namespace {

double volume(const std::vector<LocalTet>& tets) {
  double sum = 0;
  for (const LocalTet& tet : tets) {
    const auto& c = tet.corners;
    sum += (c[1] - c[0]).cross(c[2] - c[0]).dot(c[3] - c[0]);
  }
  return sum;
}

Quality worst(const std::vector<LocalTet>& tets) {
  Quality least = 1;
  for (const LocalTet& tet : tets) least = std::min(least, tet.quality);
  return least;
}

struct Studied {
  test::TracedBall trace;
  TraceFile file{trace.path()};
  Replay replay{file};
};

}  // namespace

TEST_CASE(
    "the tets before and after a call fill the same place, and the replay stays where it is") {
  Studied s;
  s.replay.seek(17);
  unsigned accepted = 0;
  unsigned undone = 0;
  for (std::uint32_t k = 0; k < s.file.calls().size(); k += 17) {
    const CallStudy study = study_call(s.file, s.replay, k);
    REQUIRE(s.replay.position() == 17);
    const Call& call = s.file.calls()[k];
    CAPTURE(k);
    if (!study.after.empty()) {
      CHECK(volume(study.after) == doctest::Approx(volume(study.before)));
    }
    if (call.accepted() && call.worst_before != 0) {
      ++accepted;
      CHECK_FALSE(study.undone);
      CHECK(worst(study.before) <= call.worst_before);
    }
    if (study.undone) {
      ++undone;
      CHECK_FALSE(call.accepted());
    }
  }
  CHECK(accepted > 4);
  CHECK(undone > 0);
}

TEST_CASE("the covering of a shell transformation is what the mesh has afterwards") {
  Studied s;
  FactTable facts;
  unsigned full = 0;
  unsigned partial = 0;
  for (std::uint32_t k = 0; k < s.file.calls().size(); ++k) {
    const Call& call = s.file.calls()[k];
    if (!call.accepted() || call.algorithm != Algorithm::shell_transformation) continue;
    const CallStudy study = study_call(s.file, s.replay, k);
    REQUIRE(study.picture);
    REQUIRE(study.covering);
    const auto m = study.picture->ring.size();
    const FlatCovering& covering = *study.covering;
    const CallFacts& found = facts.facts(s.file, s.replay, k);
    CHECK(found.degree_before == m);
    CHECK(found.degree_after == covering.core.size());
    // A polygon of m sides, with a core of n: m - n triangles, or m - 2 without.
    CHECK(covering.triangles.size() == (covering.core.empty() ? m - 2 : m - covering.core.size()));
    CHECK(covering.worst >= study.picture->floor);
    covering.core.empty() ? ++full : ++partial;
  }
  CHECK(full > 0);
  CHECK(partial > 0);
}

TEST_CASE("the ring of a recursion follows its shell through all steps") {
  const TraceFile file(TETMEND_SOURCE_DIR "/assets/lessons/2-two-shells.trace");
  Replay replay(file);
  const Call& inner = file.calls()[2];  // of edge 1 5, with nothing but its shell transformation
  REQUIRE(inner.algorithm == Algorithm::recursion);
  const CallStudy made = study_call(file, replay, 2);
  REQUIRE(made.covering);
  CHECK(made.first_edit == study_call(file, replay, 3).first_edit);
  CHECK(polygon_at(made, made.first_edit - 1, false).stage == PolygonStage::before);
  const PolygonView view = polygon_at(made, inner.events.end, false);
  REQUIRE(view.stage == PolygonStage::made);
  CHECK(view.caption.substr(0, view.caption.find(',')) == "made: degree 3 -> 0");
  CHECK_FALSE(view.covering->triangles.empty());

  const CallStudy outer = study_call(file, replay, 0);  // takes that one in its midst
  REQUIRE(outer.covering);
  CHECK(outer.outdated == made.first_edit);
  const PolygonView first = polygon_at(outer, outer.outdated - 1, false);
  CHECK(first.stage == PolygonStage::made);
  CHECK(first.caption.rfind("made at first: degree 5 -> 4", 0) == 0);
  const PolygonView then = polygon_at(outer, outer.outdated, false);
  REQUIRE(then.stage == PolygonStage::now);
  CHECK(then.caption.rfind("now: degree 3, worst ", 0) == 0);
  CHECK(then.caption.find("; before the call: degree 5, worst ") != std::string::npos);
  const PolygonView last = polygon_at(outer, file.calls()[0].events.end, false);
  REQUIRE(last.stage == PolygonStage::made);
  CHECK(last.caption.rfind("made later: degree 3 -> 0", 0) == 0);
  CHECK(last.shell->ring.size() == 3);
}

TEST_CASE("the ring after a step of a recursion is the shell that the mesh has there") {
  Studied s;
  std::size_t present = 0, closed = 0;
  constexpr std::size_t kEnough = 400;
  for (std::uint32_t k = 0; k < s.file.calls().size() && present < kEnough; ++k) {
    if (s.file.calls()[k].algorithm != Algorithm::recursion) continue;
    const CallStudy study = study_call(s.file, s.replay, k);
    for (const LaterShell& later : study.later) {
      s.replay.seek(later.from);
      const VertexHandle a = study.picture->a, b = study.picture->b;
      const std::vector<TetHandle> around = s.replay.tets_around(std::array{a, b});
      const SlotShell shell = shell_of(s.replay.mesh(), around, a, b);
      const PolygonView view = polygon_at(study, later.from, false);
      CHECK(view.stage == later.stage);
      if (later.stage == PolygonStage::now) {
        ++present;
        CHECK(view.shell->ring.size() == shell.tets.size());
        CHECK(std::is_permutation(shell.ring.begin(), shell.ring.end(), view.shell->ring.begin(),
                                  view.shell->ring.end()));
      } else if (later.stage == PolygonStage::made) {
        ++closed;
        CHECK(shell.tets.size() == view.covering->core.size());
        CHECK(view.covering->worst >= view.shell->floor);
      } else if (later.stage == PolygonStage::before) {
        CHECK(shell.tets.size() == study.picture->ring.size());
      } else {
        CHECK_FALSE(shell.closed);
      }
    }
  }
  CHECK(present > 0);
  CHECK(closed > 0);
}

TEST_CASE("what a step of a recursion made respects the locks and uses pockets of its picture") {
  Studied s;
  std::size_t locked = 0;
  std::size_t chords = 0;
  for (std::uint32_t k = 0; k < s.file.calls().size(); k += 5) {
    const Call& call = s.file.calls()[k];
    if (call.algorithm != Algorithm::shell_transformation || call.level == 0) continue;
    const CallStudy study = study_call(s.file, s.replay, k);
    if (!study.picture) continue;
    const ShellPicture& picture = *study.picture;
    if (picture.locks.any()) ++locked;
    if (!study.covering || !call.accepted()) continue;
    const auto m = static_cast<unsigned>(picture.ring.size());
    for (const auto& triangle : study.covering->triangles) {
      for (unsigned n = 0; n < 3; ++n) {
        const unsigned i = triangle.corners[n];
        const unsigned j = triangle.corners[(n + 1) % 3];
        if ((i + 1) % m == j || (j + 1) % m == i) continue;
        ++chords;
        CHECK(((picture.locks.vertices >> i) & 1u) == 0);
        CHECK(std::max(picture.pocket(i, j), picture.pocket(j, i))[0] > picture.floor);
      }
    }
  }
  CHECK(locked > 0);
  CHECK(chords > 0);
}

TEST_CASE("a refusal is explained with the numbers of its shell") {
  Studied s;
  bool told = false;
  bool undone = false;
  for (std::uint32_t k = 0; k < s.file.calls().size() && !(told && undone); ++k) {
    const Call& call = s.file.calls()[k];
    if (call.accepted() || call.verdict != Verdict::no_improvement) continue;
    s.replay.seek(call.events.begin);
    const CallStudy study = study_call(s.file, s.replay, k);
    const std::string text = explain_end(s.file, study);
    CHECK(text.find('.') != std::string::npos);
    if (text.find("best complete triangulation has worst quality") != std::string::npos) {
      told = true;
      CHECK_FALSE(call.candidate_found);
    }
    if (text.find("Undone.") != std::string::npos) {
      undone = true;
      CHECK(study.undone);
      // A better worst tet may not have been worth the more bad ones.
      const double price = s.replay.mesh().standard().price();
      CHECK((price > 0 || call.worst_after <= call.worst_before + kQualityTolerance));
      CHECK(text.find(fmt::format("Tried: worst quality {:.4f}, as against {:.4f}.",
                                  call.worst_after, call.worst_before)) != std::string::npos);
    }
  }
  CHECK(told);
  CHECK(undone);
}

TEST_CASE("an edge with too many tets for its removal is told as that, and nothing was searched") {
  const test::TempFolder folder;
  TetMesh mesh(test::delaunay_ball(120, 3));
  test::record(mesh, folder / "a.trace", {}, {},
               Schedule("few", "apply({'edge_removal', max_degree = 4}, {on = {below = 100}})"));
  const TraceFile file(folder / "a.trace");
  Replay replay(file);
  std::size_t told = 0;
  for (std::uint32_t k = 0; k < file.calls().size(); ++k) {
    const Call& call = file.calls()[k];
    if (call.verdict != Verdict::not_applicable) continue;
    const CallStudy study = study_call(file, replay, k);
    if (!study.picture) continue;
    CHECK(explain_end(file, study) ==
          fmt::format("{} tets lie around the edge, more than max_degree = 4.",
                      study.picture->ring.size()));
    CHECK_FALSE(call.has_searched());
    CHECK(polygon_at(study, call.events.end, false).stage == PolygonStage::before);
    const auto stack = call_stack(file, call.events.end);
    CHECK(code_place(file, stack, stack.size() - 1, call.events.end).line == 1);
    ++told;
  }
  CHECK(told > 10);
}
