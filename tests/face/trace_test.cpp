// SPDX-License-Identifier: MIT
#include <filesystem>
#include <string>

#include <doctest/doctest.h>
#include <tetmend/improve.h>
#include <tetmend/trace.h>

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
