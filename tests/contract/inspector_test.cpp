// SPDX-License-Identifier: MIT
// Attempts of plugins under suspicion: sly ones are found out, and honest ones change nothing.
#include "contract/inspector.h"

#include <string>

#include <doctest/doctest.h>

#include "contract/zoo.h"
#include "ops/plugin.h"
#include "schedule/passes.h"
#include "tests/support/plugin_file.h"
#include "tests/support/text.h"
#include "tests/support/threads.h"

using namespace tetmend;
using namespace tetmend::test;
using tetmend::contract::Breach;
using tetmend::contract::Inspector;
using tetmend::contract::kuhn_cube;

namespace {

Registry registry_with(const std::string& plugin) {
  Registry registry = Registry::builtin();
  load_plugin(plugin_file(plugin), registry);
  return registry;
}

/// What a pass of an operator of sly.so, after one of tetmend's own, ends in.
std::string breach_of(const std::string& name, bool is_inspected = true) {
  const Registry registry = registry_with("sly");
  TetMesh mesh(kuhn_cube(4, 0.33, 3));
  Run run(mesh, registry);
  Inspector inspector;
  if (is_inspected) run.set_inspector(&inspector);
  try {
    smooth(run, {});
    apply(run, {.what = {.operator_name = name}, .on = {.below = Selection::kAll}});
  } catch (const Breach& breach) {
    return breach.what();
  }
  return "";
}

}  // namespace

TEST_CASE("an attempt that changes the mesh past its judge is found out") {
  const std::string who = " of " + plugin_file("sly") + " breaks the contract at vertex ";
  const auto check = [&](const std::string& name, const std::string& complaint) {
    const std::string message = breach_of(name);
    CAPTURE(message);
    CHECK(message.starts_with("operator '" + name + "'" + who));
    CHECK(contains(message, complaint));
  };
  check("refuses_and_moves", ": the refusal left a trace");
  check("throws_and_moves", ": the error left a trace: ");
  check("throws_and_moves", "out of ideas");
  check("moves_another", ": something changed that the judge did not see");
  check("judges_itself", ": its own judge is that of an opening, and nobody judges the whole");
}

TEST_CASE("nothing but the inspector sees what goes on behind an attempt") {
  CHECK(breach_of("refuses_and_moves", false).empty());
  CHECK(breach_of("moves_another", false).empty());
}

TEST_CASE("an operator that swaps the judge of its attempt is judged by the one it had") {
  CHECK(breach_of("swaps_the_judge").empty());
}

TEST_CASE("inspected attempts in blocks leave the same mesh as others, and are accepted as often") {
  const Registry registry = registry_with("odt_smoothing");
  const auto improved = [&](AttemptInspector* inspector, std::size_t& accepted) {
    TetMesh mesh = TetMesh::sorted(kuhn_cube(6, 0.33, 3));
    on_threads(3, [&] {
      Run run(mesh, registry);
      run.set_block_count(6);
      run.set_inspector(inspector);
      local_reconnection(run, {});
      insert_points(run, {});
      const Composition plugin = {.operator_name = "odt_smoothing"};
      apply(run, {.what = plugin, .on = {.below = 1.2F}});
      // As what follows an opening, in a transaction that is undone or kept.
      apply(run, {.what = {.kind = Composition::Kind::sequence,
                           .parts = {{.operator_name = "edge_split"}, plugin}},
                  .on = {.below = 0.7F}});
      REQUIRE(run.records.size() == 4);
      CHECK(run.records[2].accepted() > 0);
      for (const PassRecord& record : run.records) accepted += record.accepted();
    });
    return mesh;
  };
  Inspector inspector;
  std::size_t accepted = 0;
  std::size_t accepted_inspected = 0;
  CHECK(improved(nullptr, accepted) == improved(&inspector, accepted_inspected));
  CHECK(accepted > 0);
  CHECK(accepted == accepted_inspected);
}

namespace {

/// Refuses everything, and counts.
struct Counter final : AttemptInspector {
  Verdict attempt(const Operator& op, OperatorContext& context, Target target) override {
    ++attempts;
    return op.attempt(context, target);
  }
  std::size_t attempts = 0;
};

}  // namespace

TEST_CASE("every attempt that a pass counts goes through the inspector of the run") {
  const Registry registry = registry_with("sound");
  TetMesh mesh(kuhn_cube(6, 0.33, 3));
  on_threads(2, [&] {
    Run run(mesh, registry);
    run.set_block_count(4);
    Counter counter;
    run.set_inspector(&counter);
    local_reconnection(run, {});
    apply(run, {.what = {.operator_name = "sound"}, .on = {.below = Selection::kAll}});
    std::size_t attempts = 0;
    for (const PassRecord& record : run.records) attempts += record.attempts();
    CHECK(attempts > 0);
    CHECK(counter.attempts == attempts);
  });
}
