// SPDX-License-Identifier: MIT
// tetmend adapt from outside.
#include <filesystem>
#include <fstream>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/apps/program.h"
#include "tests/support/assets.h"

using namespace tetmend::test;

namespace {

std::string temporary(const std::string& name) {
  return (std::filesystem::temp_directory_path() / ("tetmend_adapt_" + name)).string();
}

}  // namespace

TEST_CASE("tetmend adapt writes a mesh and says how well its edges keep to the sizes") {
  const std::string out = temporary("out.mesh");
  const std::string json = temporary("out.json");
  const auto done = run_program(
      {"adapt", asset("two_materials.mesh"), "--size", "0.5x", "-v", "-o", out, "--report", json});
  CHECK(done.status == 0);
  CHECK(done.out.find("length over wanted") != std::string::npos);
  std::ifstream file(json);
  const auto report = nlohmann::json::parse(file);
  CHECK(report["surface"]["unchanged"] == true);
  CHECK(report["after"]["tets"] > report["before"]["tets"]);
  CHECK(report["sizes"]["after"]["in_range"] > report["sizes"]["before"]["in_range"]);
}

TEST_CASE("a dry run of tetmend adapt says what the sizes ask for, and writes nothing") {
  const auto done =
      run_program({"adapt", asset("two_materials.mesh"), "--size", "0.5x", "--dry-run"});
  CHECK(done.status == 0);
  CHECK(done.out.find("tets would fill the mesh") != std::string::npos);
}

TEST_CASE("sizes larger than the whole mesh are noted") {
  const auto done =
      run_program({"adapt", asset("two_materials.mesh"), "--size", "1e6", "--dry-run"});
  CHECK(done.status == 0);
  CHECK(done.out.find("is larger than the whole mesh") != std::string::npos);
  const auto fitting =
      run_program({"adapt", asset("two_materials.mesh"), "--size", "1x", "--dry-run"});
  CHECK(fitting.out.find("is larger than the whole mesh") == std::string::npos);
}

TEST_CASE("tetmend adapt without a size, or with one that is none, is wrong usage") {
  const std::string out = temporary("none.mesh");
  CHECK(run_program({"adapt", asset("two_materials.mesh"), "-o", out}).status == 2);
  const auto done =
      run_program({"adapt", asset("two_materials.mesh"), "--size", "small", "-o", out});
  CHECK(done.status == 2);
  CHECK(done.err.find("--size") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(out));
}
