// SPDX-License-Identifier: MIT
#include "explain/call_facts.h"

#include <doctest/doctest.h>

#include "explain/slot_shell.h"
#include "tests/support/example_traces.h"

using namespace tetmend;
using namespace tetmend::explain;

TEST_CASE("the facts of a call are those of the mesh at its beginning and its end") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  Replay replay(file);
  Replay truth(file);
  FactTable table;
  unsigned changed = 0;
  for (std::uint32_t k = 0; k < file.calls().size(); k += 5) {
    const Call& call = file.calls()[k];
    const CallFacts& facts = table.facts(file, replay, k);
    CHECK(replay.position() == 0);
    truth.seek(call.events.begin);
    CHECK(facts.degree_before == tets_around(truth.mesh(), call.target()).size());
    truth.seek(call.events.end);
    CHECK(facts.degree_after == tets_around(truth.mesh(), call.target()).size());
    if (facts.degree_before != facts.degree_after) ++changed;
  }
  CHECK(changed > 5);
}

TEST_CASE("operators and what became of a target are told in words") {
  CHECK(short_name("flip_3_2") == "3-2 flip");
  CHECK(short_name("shell_transformation") == "shell");
  Call refused;
  CHECK(quality_text(refused, {3, 0, 0.123F, 0}) == "0.123 -> removed");
  CHECK(quality_text(refused, {3, 3, 0.852F, 0.919F}) == "0.852 -> 0.919");
  CHECK(quality_text(refused, {3, 3, 0.0003F, 0}) == "0.0003 -> 0.000");
}

TEST_CASE("a call is under way until its last event") {
  const test::HandmadeTrace trace;
  const TraceFile file(trace.path());
  const Call& shell = file.calls()[1];
  CHECK(outcome_text(shell, shell.events.begin) == "to come");
  CHECK(outcome_text(shell, shell.events.begin + 1) == "under way");
  CHECK(outcome_text(shell, 5) == "under way");
  CHECK(outcome_text(shell, 6) == "no improvement");
  CHECK(outcome_of(shell) == Outcome::rejected);
  CHECK(outcome_of(file.calls()[0]) == Outcome::no_improvement);
  CHECK(outcome_of(file.calls()[2]) == Outcome::limit);
  CHECK(format_target(shell) == "edge 0 1");
  CHECK(root_of(file, 2) == 0);
}

TEST_CASE("what is to be tried again is not what does not apply") {
  const auto outcome = [](Verdict verdict) {
    Call call;
    call.verdict = verdict;
    return outcome_of(call);
  };
  CHECK(outcome(Verdict::deferred) == Outcome::deferred);
  CHECK(outcome(Verdict::not_applicable) == Outcome::not_applicable);
  CHECK(outcome_name(Outcome::deferred) == "deferred, to be tried again");
  CHECK(outcome_name(Outcome::not_applicable) == "not applicable");
}

TEST_CASE("what a call works on has the name that its target and its operator give it") {
  const auto name = [](Algorithm algorithm, std::uint8_t target_size) {
    Call call;
    call.algorithm = algorithm;
    call.target_size = target_size;
    return neighbourhood_of(call);
  };
  CHECK(name(Algorithm::shell_transformation, 2) == "Shell");
  CHECK(name(Algorithm::edge_split, 2) == "Shell");
  CHECK(name(Algorithm::smoothing, 1) == "Ball");
  CHECK(name(Algorithm::multi_face_removal, 3) == "Virtual shell");
  CHECK(name(Algorithm::cavity_insertion, 4) == "Cavity");
  CHECK(name(Algorithm::polyhedron_reconnection, 4) == "Small polyhedron");
  CHECK(name(Algorithm::other, 3) == "Tets of the call");
}
