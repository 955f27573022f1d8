// SPDX-License-Identifier: MIT
// Meshes of extreme size, from the command line.
#include <cmath>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "contract/zoo.h"
#include "tests/apps/program.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// A jittered cube as a file, its points multiplied.
std::string write_cube(const std::filesystem::path& file, double factor) {
  MeshData data = contract::kuhn_cube(3, 0.38, 3);
  for (Point& p : data.points) p *= factor;
  write_mesh(file, MeshView(data));
  return file.string();
}

}  // namespace

TEST_CASE("quality, check and improve tell the same figures at 1e-150 and at 1e150") {
  const TempFolder folder;
  const std::string plain = write_cube(folder / "plain.mesh", 1);
  const auto figures = [&](const std::string& file) {
    const Outcome outcome = run_program({"quality", file, "--json"});
    REQUIRE(outcome.status == 0);
    return nlohmann::json::parse(outcome.out);
  };
  const nlohmann::json expected = figures(plain);
  for (const char* power : {"-150", "150"}) {
    CAPTURE(power);
    const double factor = std::stod(fmt::format("1e{}", power));
    const std::string file = write_cube(folder / "scaled.mesh", factor);
    const nlohmann::json found = figures(file);
    CHECK(found.at("n_bad") == expected.at("n_bad"));
    CHECK(found.at("flat") == 0);
    CHECK(found.at("theta_min").get<double>() ==
          doctest::Approx(expected.at("theta_min").get<double>()));
    CHECK(found.at("q_mean").get<double>() == doctest::Approx(expected.at("q_mean").get<double>()));
    CHECK(found.at("volume").is_null());
    // The cube of one factor is rounded: 0.999... or 1.000... of the power.
    const std::string volume = found.at("volume_text");
    const bool is_above = factor > 1;
    CHECK((volume.ends_with(is_above ? "e+450" : "e-450") ||
           volume.ends_with(is_above ? "e+449" : "e-451")));

    const std::string better = (folder / "better.mesh").string();
    const Outcome outcome = run_program({"improve", file, "-o", better});
    CHECK(outcome.status == 0);
    CHECK(outcome.out.find("nan") == std::string::npos);
    CHECK(outcome.out.find("inf") == std::string::npos);
    const Outcome checked = run_program({"check", file, better});
    CHECK(checked.status == 0);
    CHECK(checked.out.find("nan") == std::string::npos);
    const std::string both = is_above ? "1e+450, was 1e+450" : "1e-450, was 1e-450";
    CHECK(checked.out.find("volume of label 0: " + both) != std::string::npos);
  }
}

TEST_CASE("what cannot be worked with is an error that names the file; convert takes it as it is") {
  const TempFolder folder;
  for (const double factor : {1e300, 1e-300, 1e-310}) {
    CAPTURE(factor);
    const std::string file = write_cube(folder / "extreme.mesh", factor);
    const std::string text = read_text(file);
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"improve", file, "-o", (folder / "out.mesh").string()},
          std::vector<std::string>{"quality", file}}) {
      const Outcome outcome = run_program(arguments);
      CHECK(outcome.status == 1);
      CHECK(outcome.err.starts_with("tetmend: " + file + ": the mesh is "));
    }
    const std::string copy = (folder / "copy.mesh").string();
    CHECK(run_program({"convert", file, copy}).status == 0);
    CHECK(read_text(copy) == text);
  }
}

#ifdef TETMEND_HAS_OPENMESH
TEST_CASE("a surface that single precision cannot hold is not written") {
  const TempFolder folder;
  const std::string file = write_cube(folder / "large.mesh", 1e100);
  const Outcome outcome = run_program({"surface", file, (folder / "large.stl").string()});
  CHECK(outcome.status == 1);
  CHECK(outcome.err.find("beyond the single precision") != std::string::npos);
  CHECK(
      run_program({"surface", write_cube(folder / "mid.mesh", 1e20), (folder / "mid.stl").string()})
          .status == 0);
}
#endif
