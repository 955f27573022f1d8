// SPDX-License-Identifier: MIT
// Loading plugins: what they add, and that a broken one costs no more than a clear error.
#include "ops/plugin.h"

#include <fstream>
#include <map>
#include <string>

#include <doctest/doctest.h>
#include <sys/stat.h>

#include "contract/contract.h"
#include "contract/zoo.h"
#include "kernel/error.h"
#include "kernel/integrity.h"
#include "schedule/passes.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/lone_worker.h"
#include "tests/support/plugin_file.h"
#include "tests/support/text.h"
#include "tests/support/threads.h"

using namespace tetmend;
using namespace tetmend::test;
using tetmend::contract::delaunay_ball;
using tetmend::contract::kuhn_cube;
using tetmend::contract::live_vertices;

namespace {

/// The complaint about a file that must not be loaded; checks that it names the file and that the
/// registry is as before.
std::string complaint_about(const std::string& file) {
  Registry registry = Registry::builtin();
  const std::size_t count = registry.operators().size();
  std::string complaint;
  try {
    load_plugin(file, registry);
  } catch (const Error& error) {
    complaint = error.what();
  }
  CAPTURE(complaint);
  CHECK(complaint.starts_with(file + ": "));
  CHECK(!contains(complaint, "\n"));
  CHECK(registry.operators().size() == count);
  CHECK(registry.make("smoothing")->info().name == "smoothing");
  return complaint;
}

/// What the attempts at all vertices of a ball end in. After an error or refusal the mesh must be
/// as before.
std::map<std::string, int> endings(const Operator& op) {
  std::map<std::string, int> count;
  LoneWorker worker(delaunay_ball(60, 2));
  for (const VertexHandle v : live_vertices(worker.mesh)) {
    const TetMesh before = worker.mesh;
    try {
      const Verdict verdict = worker.attempt(op, Target::of(v));
      ++count[std::string(to_string(verdict))];
      if (verdict == Verdict::accepted) continue;
    } catch (const Error& error) {
      std::string message = error.what();
      const std::string where = "vertex " + std::to_string(v.index()) + ":";
      if (const auto at = message.find(where); at != std::string::npos) {
        message.replace(at, where.size(), "vertex N:");
      }
      ++count[message];
    }
    CHECK(worker.mesh == before);
  }
  CHECK(to_string(check_integrity(worker.mesh)) == "");
  return count;
}

}  // namespace

TEST_CASE("a plugin's operator works like a built-in one and knows where it comes from") {
  Registry registry = Registry::builtin();
  const std::string file = plugin_file("sound");
  const Plugin plugin = load_plugin(file, registry);
  CHECK(plugin.file == file);
  REQUIRE(plugin.operators.size() == 1);
  CHECK(plugin.operators[0]->name == "sound");
  CHECK(registry.operators().back() == plugin.operators[0]);
  CHECK(registry.origin("sound") == file);
  const auto op = registry.make("sound");
  CHECK(op->origin() == file);
  CHECK(endings(*op)["accepted"] > 0);
}

TEST_CASE("an operator of a plugin may outlive the registry") {
  std::unique_ptr<Operator> op;
  {
    Registry registry;
    load_plugin(plugin_file("sound"), registry);
    op = registry.make("sound");
  }
  CHECK(endings(*op)["accepted"] > 0);
  op.reset();
}

TEST_CASE("a relative name is a file of the current folder, not of the linker's") {
  Registry registry;
  CHECK_THROWS_WITH_AS(load_plugin("libc.so.6", registry), doctest::Contains("No such file"),
                       Error);
  const auto relative = std::filesystem::proximate(plugin_file("sound"));
  REQUIRE(relative.is_relative());
  CHECK(load_plugin(relative, registry).operators.size() == 1);
}

TEST_CASE("a library that was cut is refused, wherever it was") {
  const TempFolder folder;
  const std::string whole = read_text(plugin_file("sound"));
  constexpr std::size_t kCuts = 40;
  for (std::size_t i = 0; i <= kCuts; ++i) {
    CAPTURE(i);
    const std::string file =
        (folder / (std::to_string(i) + ".so")).string();  // what is loaded stays
    const std::size_t size = i == kCuts ? whole.size() - 1 : whole.size() * i / kCuts;
    write_text(file, std::string_view(whole).substr(0, size));
    CHECK(contains(complaint_about(file), file + ": cannot be loaded as a plugin: "));
  }
  const std::string half = (folder / "half.so").string();
  write_text(half, std::string_view(whole).substr(0, whole.size() / 2));
  CHECK(contains(complaint_about(half), "the end of the file is missing"));
}

TEST_CASE("a pipe, a device or a folder is refused as a plugin at once") {
  const TempFolder folder;
  const std::string pipe = (folder / "pipe.so").string();
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(contains(complaint_about(pipe), "not a regular file"));
  CHECK(contains(complaint_about("/dev/zero"), "not a regular file"));
  CHECK(contains(complaint_about("/tmp"), "not a regular file"));
}

TEST_CASE("what is no plugin is refused with the reason") {
  CHECK(contains(complaint_about(plugin_file("missing")), "No such file"));
  const TempFolder folder;
  const std::string text = (folder / "text.so").string();
  std::ofstream(text) << "this is not a library\n";
  CHECK(contains(complaint_about(text), "cannot be loaded as a plugin: "));
  CHECK(contains(complaint_about(plugin_file("no_plugin")), "no symbol tetmend_plugin_abi"));
  CHECK(contains(complaint_about(plugin_file("no_entry")), "no symbol tetmend_plugin_register"));
  CHECK(contains(complaint_about(plugin_file("unbound")),
                 "undefined symbol: tetmend_function_that_is_nowhere"));
  CHECK(contains(complaint_about(plugin_file("empty")), "registers no operator"));
  CHECK(contains(complaint_about(plugin_file("throwing_entry")), "no licence found"));
}

TEST_CASE("a plugin for another ABI is refused before its code runs, with both numbers") {
  const std::string version = complaint_about(plugin_file("other_version"));
  CHECK(contains(version, "built for plugin ABI " + std::to_string(kPluginAbi.version + 1)));
  CHECK(contains(version, "this is ABI " + std::to_string(kPluginAbi.version)));
  const std::string layout = complaint_about(plugin_file("other_layout"));
  CHECK(contains(layout, "built for plugin ABI " + std::to_string(kPluginAbi.version) + ","));
}

TEST_CASE("a plugin with a name that is taken adds nothing at all") {
  const std::string complaint = complaint_about(plugin_file("clash"));
  CHECK(contains(complaint, "'smoothing'"));
  CHECK(contains(complaint, "tetmend itself"));
  Registry registry;
  load_plugin(plugin_file("sound"), registry);
  try {
    load_plugin(plugin_file("sound"), registry);
    FAIL("the second must clash with the first");
  } catch (const Error& error) {
    CHECK(contains(error.what(), "'sound' is registered twice"));
  }
  CHECK(registry.operators().size() == 1);
}

TEST_CASE(
    "an operator that throws leaves the mesh as it was, and the error names it and its plugin") {
  Registry registry;
  const std::string file = plugin_file("throwing");
  load_plugin(file, registry);
  const auto message = [&](const std::string& name, const std::string& reason) {
    return "operator '" + name + "' of " + file + " failed at vertex N: " + reason;
  };
  CHECK(endings(*registry.make("throws_in_precondition"))
            .contains(message("throws_in_precondition", "precondition is not written yet")));
  CHECK(endings(*registry.make("throws_in_evaluate"))
            .contains(message("throws_in_evaluate", "an exception of an unknown type")));
  CHECK(endings(*registry.make("throws_in_apply"))
            .contains(message("throws_in_apply", "index 17 out of range")));
  CHECK_THROWS_WITH_AS(
      registry.make("throws_when_made"),
      ("operator 'throws_when_made' of " + file + " cannot be made: no table found").c_str(),
      Error);
}

TEST_CASE("an operator that throws in a pass ends it, on any number of threads, mesh in order") {
  Registry registry = Registry::builtin();
  load_plugin(plugin_file("throwing"), registry);
  for (const int threads : {1, 3}) {
    CAPTURE(threads);
    TetMesh mesh = TetMesh::sorted(kuhn_cube(12, 0.33, 3));
    mesh.set_standard(Standard(Goal{}, Standard::Terms::sine));
    const double volume = compute_statistics(mesh).volume;
    on_threads(threads, [&] {
      Run run(mesh, registry);
      run.set_block_count(8);
      local_reconnection(run, {});
      LocalReconnectionOptions broken;
      broken.edge_operator = "throws_at_edges";
      CHECK_THROWS_AS(local_reconnection(run, broken), Error);
      CHECK(to_string(check_integrity(mesh)) == "");
      smooth(run, {});
    });
    CHECK(to_string(check_integrity(mesh)) == "");
    CHECK(mesh.tet_count() == contract::live_tets(mesh).size());
    CHECK(compute_statistics(mesh).volume == doctest::Approx(volume));
  }
}

TEST_CASE("an operator that lies cannot harm the mesh") {
  Registry registry;
  const std::string file = plugin_file("lying");
  load_plugin(file, registry);
  CHECK(endings(*registry.make("edits_in_evaluate"))
            .contains("operator 'edits_in_evaluate' of " + file +
                      " failed at vertex N: it edits the mesh before apply()"));
  const auto nothing = endings(*registry.make("does_nothing"));
  CHECK(nothing.contains("no improvement"));
  CHECK(!nothing.contains("accepted"));
  const auto worse = endings(*registry.make("makes_it_worse"));
  CHECK((worse.contains("no improvement") || worse.contains("inverted")));
  CHECK(!worse.contains("accepted"));
  CHECK_THROWS_WITH_AS(registry.make("makes_nothing"),
                       ("operator 'makes_nothing' of " + file +
                        " cannot be made: its function "
                        "made nothing")
                           .c_str(),
                       Error);
  CHECK_THROWS_WITH_AS(registry.make("makes_another"),
                       doctest::Contains("its constructor must be given the description that is "
                                         "registered (a function of its own named info() hides"),
                       Error);
}

TEST_CASE("the contract tells what is wrong with each operator, and finds nothing in a sound one") {
  Registry registry = Registry::builtin();
  for (const std::string name : {"sound", "odt_smoothing", "throwing", "lying", "careless"}) {
    load_plugin(plugin_file(name), registry);
  }
  std::vector<contract::Ground> grounds = contract::grounds();
  std::erase_if(grounds, [](const contract::Ground& ground) {
    return ground.name != "two_tets" && ground.name != "cube_3" && ground.name != "ball_60";
  });
  REQUIRE(grounds.size() == 3);
  const auto verdict = [&](const std::string& name) {
    std::size_t lines = 0;
    const auto total = contract::check_contract(
        registry, name, grounds, [&](std::string_view, const contract::Outcome&) { ++lines; });
    CHECK(lines == grounds.size() + 1);
    return total.complaint;
  };
  CHECK(verdict("sound") == "");
  CHECK(verdict("odt_smoothing") == "");
  CHECK(contains(verdict("throws_in_apply"), "index 17 out of range"));
  CHECK(contains(verdict("edits_in_evaluate"), "edits the mesh before apply()"));
  CHECK(contains(verdict("changes_its_mind"), "the second attempt answers differently"));
  CHECK(contains(verdict("does_nothing"), "attempts was accepted"));
  CHECK(contains(verdict("looks_around"), "depend on what lies outside"));
  CHECK(contains(verdict("trespasses"), "an edit that reaches out of the territory"));
  CHECK(contains(verdict("careless"), "an edit that reaches out of the territory"));
}

TEST_CASE("where nothing is accepted in a territory, the contract says so and is not broken") {
  Registry registry = Registry::builtin();
  load_plugin(plugin_file("sound"), registry);
  std::vector<contract::Ground> grounds;  // too small for a territory
  grounds.push_back({"two_tets", TetMesh(contract::two_tets())});
  grounds.push_back({"shell", TetMesh(contract::shell_mesh({.degree = 5, .height = 1}))});
  const auto total = contract::check_contract(registry, "flip_2_3", grounds, [](auto&&...) {});
  CHECK(total.complaint == "");
  CHECK(contains(total.note, "nothing was accepted in a territory"));
}
