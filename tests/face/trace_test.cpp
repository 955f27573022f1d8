// SPDX-License-Identifier: MIT
#include <filesystem>
#include <string>

#include <doctest/doctest.h>
#include <tetmend/improve.h>
#include <tetmend/trace.h>

#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;

TEST_CASE("a trace tells of the run that it was recorded from") {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / "tetmend_face_trace_test.trace";
  Mesh mesh = load(std::filesystem::path(TETMEND_SOURCE_DIR) / "assets/meshes/sheet.mesh");
  const std::size_t tets = mesh.tet_count();
  const Result result = improve(mesh, {.set = {{"max_rounds", "1"}}, .trace = file});
  {
    const Trace trace(file);
    CHECK(trace.damage().empty());
    CHECK(trace.schedule() == "shell");
    CHECK(trace.pass_count() == result.passes.size());
    std::size_t accepted = 0;
    for (std::uint32_t c = 0; c < trace.call_count(); c = trace.call(c).subtree_end) {
      CHECK(trace.call(c).depth == 0);
      CHECK_FALSE(trace.call(c).parent);
      accepted += trace.call(c).accepted;
    }
    CHECK(accepted > 0);
    std::size_t begun = 0;
    for (const Trace::Event& event : trace.events(0, trace.event_count())) {
      begun += event.kind == "attempt begins";
      CHECK((event.kind != "cavity replaced" || event.removed + event.created > 0));
    }
    CHECK(begun == trace.call_count());
    CHECK(trace.mesh_at(0).tet_count() == tets);
    CHECK(trace.mesh_at(trace.event_count()).tet_count() == mesh.tet_count());
    CHECK_THROWS_WITH_AS(trace.call(trace.call_count()), doctest::Contains("there is no call"),
                         Error);
    CHECK_THROWS_AS(trace.events(1, trace.event_count() + 1), Error);
    CHECK_THROWS_AS(trace.mesh_at(trace.event_count() + 1), Error);
  }
  std::filesystem::remove(file);
}

TEST_CASE(
    "a trace that would replace the file of the mesh, what it includes or the schedule is "
    "refused") {
  const test::TempFolder folder;
  const std::filesystem::path source = std::filesystem::path(TETMEND_SOURCE_DIR) / "assets/meshes";
  std::filesystem::copy(source / "two_materials.mesh", folder / "a.mesh");
  std::filesystem::create_symlink("a.mesh", folder / "l.trace");
  save(folder / "nodes.inp", load(folder / "a.mesh"));
  test::write_text(folder / "deck.inp", "*INCLUDE, INPUT=nodes.inp\n");
  test::write_text(folder / "my.lua", "smooth{}\n");
  const auto refusal = [&](const char* input, Options options) -> std::string {
    Mesh mesh = load(folder / input);
    try {
      improve(mesh, options);
    } catch (const OptionError& error) {
      CHECK(error.option() == "trace");
      return error.what();
    }
    return "";
  };
  CHECK(refusal("a.mesh", {.trace = folder / "a.mesh"}).find("the same file") != std::string::npos);
  CHECK(refusal("a.mesh", {.trace = folder / "l.trace"}).find("the mesh") != std::string::npos);
  CHECK(refusal("deck.inp", {.trace = folder / "nodes.inp"}).find("the mesh") != std::string::npos);
  const std::string schedule = (folder / "my.lua").string();
  CHECK(refusal("a.mesh", {.schedule = schedule, .trace = schedule}).find("the schedule") !=
        std::string::npos);
  CHECK(refusal("a.mesh", {.schedule = schedule, .trace = folder / "run.trace"}).empty());
}
