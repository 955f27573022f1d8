// SPDX-License-Identifier: MIT
// --surface from outside: what is printed and written, traces, threads, mistakes.
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "kernel/formats/mesh_io.h"
#include "kernel/integrity.h"
#include "kernel/statistics.h"
#include "kernel/surface_fingerprint.h"
#include "tests/apps/program.h"
#include "tests/support/assets.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::test;

TEST_CASE("--surface moves the surface and reports by how much, for any number of threads") {
  for (const std::string surface : {"flat", "3%"}) {
    CAPTURE(surface);
    const TempFolder folder;
    const std::string out = (folder / "out.mesh").string();
    const std::string report_file = (folder / "report.json").string();
    const Outcome outcome = run_program({"improve", asset("two_materials.mesh"), "-o", out,
                                         "--surface", surface, "--report", report_file});
    CAPTURE(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(contains(outcome.out, surface == "flat" ? "the same shape" : "which is proven"));
    const TetMesh after(read_mesh(out));
    CHECK(to_string(check_integrity(after)).empty());
    CHECK(count_not_positive(after) == 0);
    const auto report = nlohmann::json::parse(read_text(report_file));
    const auto& told = report["surface"];
    CHECK(told["proven_distance"] <= told["tolerance"]);
    CHECK(told["regions"].size() == 2);
    CHECK(told["triangles_touched"] <= told["triangles_after"]);
    const std::string again = (folder / "again.mesh").string();
    REQUIRE(run_program({"improve", asset("two_materials.mesh"), "-o", again, "--surface", surface,
                         "--threads", "3"})
                .status == 0);
    CHECK(read_text(again) == read_text(out));
  }
}

TEST_CASE("a trace of a run that moves the surface can be read and checked") {
  const TempFolder folder;
  const std::string trace = (folder / "run.trace").string();
  const Outcome run =
      run_program({"improve", asset("folded_sheet.mesh"), "-o", (folder / "out.mesh").string(),
                   "--surface", "5%", "--trace", trace});
  REQUIRE(run.status == 0);
  const Outcome told = run_program({"trace", trace});
  CAPTURE(told.err);
  CHECK(told.status == 0);
  CHECK(contains(told.out, "surface_"));
  CHECK(contains(told.out, "--surface = 5%"));
}

TEST_CASE("a tolerance that is none is a mistake, and nothing is written") {
  const TempFolder folder;
  for (const std::string wrong : {"round", "0", "-1%", "2x"}) {
    const Outcome outcome = run_program({"improve", asset("folded_sheet.mesh"), "-o",
                                         (folder / "out.mesh").string(), "--surface=" + wrong});
    CAPTURE(outcome.err);
    CHECK(outcome.status == 2);
    CHECK(contains(outcome.err, "--surface: '" + wrong + "' is none of"));
  }
  CHECK(folder.entries() == 0);
}
