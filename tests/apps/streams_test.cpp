// SPDX-License-Identifier: MIT
// Standard input and output in place of files; bad tets one by one.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "contract/zoo.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/quality.h"
#include "tests/apps/program.h"
#include "tests/support/assets.h"
#include "tests/support/second_order.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::test;

TEST_CASE("a mesh goes from standard input to standard output") {
  const TempFolder folder;
  const std::string mesh = asset("two_materials.mesh");
  const Outcome outcome = run_program({"improve", "-", "-o", "-", "--format", "mesh,meshb"}, mesh);
  CHECK(outcome.status == 0);
  CHECK(contains(outcome.err, "theta_min"));  // the table makes way for the mesh
  REQUIRE(run_program({"improve", mesh, "-o", (folder / "a.meshb").string(), "-q"}).status == 0);
  CHECK(outcome.out == read_text(folder / "a.meshb"));
  const Outcome converted =
      run_program({"convert", "-", "-", "--format", "meshb,vtu"}, folder / "a.meshb");
  CHECK(converted.status == 0);
  write_text(folder / "b.vtu", converted.out);
  CHECK(read_mesh(folder / "b.vtu").tets == read_mesh(folder / "a.meshb").tets);
  // It is read more than once.
  CHECK(run_program({"check", "-", "--format", "vtu", "--no-inverted"}, folder / "b.vtu").status ==
        0);
  const Outcome figures = run_program({"quality", "-", "--format", "vtu"}, folder / "b.vtu");
  CHECK(figures.status == 0);
  CHECK(figures.out.starts_with("standard input"));
}

TEST_CASE("what is wrong with a stream is said") {
  const TempFolder folder;
  write_text(folder / "bad", "MeshVersionFormatted 2\nDimension 3\nVertices\nmany\n");
  const Outcome bad = run_program({"quality", "-", "--format", "mesh"}, folder / "bad");
  CHECK(bad.status == 1);
  CHECK(contains(bad.err, "standard input:4: 'many'"));
  const Outcome untold = run_program({"quality", "-"}, folder / "bad");
  CHECK(untold.status == 2);
  CHECK(contains(untold.err, "'-' needs --format"));
  const Outcome unknown = run_program({"quality", "-", "--format", "stl"}, folder / "bad");
  CHECK(unknown.status == 2);
  const Outcome set = run_program({"quality", "-", "--format", "node"}, folder / "bad");
  CHECK(set.status == 1);
  CHECK(contains(set.err, "several files"));
  const int err = ::open((folder / "err").c_str(), O_WRONLY | O_CREAT, 0666);
  CHECK(Program({"convert", asset("two_materials.mesh"), "-", "--format", "mesh"}, "/dev/full", err)
            .wait() == 1);
  ::close(err);
  CHECK(contains(read_text(folder / "err"), "standard output: cannot be written"));
}

TEST_CASE("a stream without an end is told before it has taken all memory") {
  const TempFolder folder;
  const std::string command =
      fmt::format("ulimit -v 800000; yes '1 2 3' | '{}' quality - --format mesh 2>'{}'",
                  TETMEND_PROGRAM, (folder / "err").string());
  CHECK(std::system(command.c_str()) == 1 << 8);
  const std::string said = read_text(folder / "err");
  CHECK_MESSAGE(contains(said, "standard input: 1024"), said);  // MB, and some
  CHECK_MESSAGE(contains(said, "an eighth of the memory that there is, and no end"), said);
}

TEST_CASE("bad tets are listed, and written as a mesh of their own") {
  const TempFolder folder;
  const std::string file = asset("bracket.meshb");
  const Outcome outcome = run_program(
      {"quality", file, "--json", "--list", "7", "--cells", (folder / "bad.vtu").string()});
  REQUIRE(outcome.status == 0);
  const auto json = nlohmann::json::parse(outcome.out);
  const MeshData mesh = read_mesh(file);
  const MeshData cells = read_mesh(folder / "bad.vtu");
  const std::size_t n_bad = json["n_bad"];
  CHECK(cells.tets.size() == n_bad);
  REQUIRE(json["bad_tets"].size() == 7);
  std::vector<std::pair<double, std::size_t>> order;  // the same, found here
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& v = mesh.tets[t].vertices;
    const auto angles =
        dihedral_angles(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]);
    double sine = 1;
    for (const double angle : angles) sine = std::min(sine, std::sin(angle * M_PI / 180));
    order.emplace_back(sine, t);
  }
  std::sort(order.begin(), order.end());
  const auto* numbers = std::get_if<std::vector<std::int64_t>>(&cells.tet_data[0].values);
  REQUIRE(numbers != nullptr);
  CHECK(cells.tet_data[0].name == "number");
  for (std::size_t i = 0; i < 7; ++i) {
    const auto& row = json["bad_tets"][i];
    const std::size_t t = order[i].second;
    CHECK(row["tet"] == t + 1);
    CHECK((*numbers)[i] == static_cast<std::int64_t>(t + 1));
    CHECK(row["region"] == mesh.tets[t].label);
    CHECK(row["quality"].get<double>() == doctest::Approx(order[i].first));
    Point centre = Point::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      centre += mesh.points[mesh.tets[t].vertices[k]] / 4;
      CHECK(cells.points[cells.tets[i].vertices[k]] == mesh.points[mesh.tets[t].vertices[k]]);
    }
    CHECK(row["centre"][1].get<double>() == doctest::Approx(centre.y()));
    CHECK_FALSE(row["reason"].get<std::string>().empty());
  }
  const Outcome text = run_program({"quality", file, "--list", "3"});
  CHECK(contains(text.out, "the worst 3"));
  CHECK(run_program({"quality", file, "--list", "0"}).status == 2);
}

TEST_CASE("check finds what has left a group, and a moved mid-side node") {
  const TempFolder folder;
  MeshData mesh = second_order(contract::kuhn_cube(2, 0.1, 1), 0.1);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.tet_parts.push_back(t % 2 == 0 ? 1 : 2);
  const auto& v = mesh.tets[0].vertices;
  mesh.triangles = {{{v[0], v[1], v[2]}, 4}, {{v[1], v[2], v[3]}, 4}};
  mesh.triangle_parts = {7, 8};
  mesh.groups = {{3, 1, "steel", {1}, {}}, {2, 2, "inlet", {7}, {}}};
  const std::string file = (folder / "a.msh").string();
  const std::string other = (folder / "b.msh").string();
  const auto verdict = [&](const MeshData& changed) {
    write_mesh(other, changed);
    const Outcome outcome = run_program({"check", file, other, "--json"});
    std::string failing;
    const auto json = nlohmann::json::parse(outcome.out);
    for (const auto& fact : json["facts"]) {
      if (!fact["holds"]) failing += fact["name"].get<std::string>() + " ";
    }
    CHECK(outcome.status == (failing.empty() ? 0 : 3));
    return failing;
  };
  write_mesh(file, mesh);
  CHECK(verdict(mesh) == "");
  MeshData changed = mesh;
  changed.tet_parts[0] = 2;
  CHECK(contains(verdict(changed), "group_contents "));
  changed = mesh;
  changed.triangle_parts[1] = 7;
  CHECK(contains(verdict(changed), "group_contents "));
  changed = mesh;
  changed.points[mesh.mid_nodes.front()[2]] += Point(0, 0, 1e-9);
  CHECK(contains(verdict(changed), "mid_nodes"));
}

TEST_CASE("check for SU2 wants a marker on the whole boundary") {
  const TempFolder folder;
  const std::string file = (folder / "a.su2").string();
  MeshData mesh = read_mesh(asset("bracket.meshb"));
  write_mesh(file, mesh);
  CHECK(run_program({"check", file, "--for", "su2"}).status == 0);
  mesh.triangles.pop_back();
  write_mesh(file, mesh);
  const Outcome outcome = run_program({"check", file, "--for", "su2"});
  CHECK(outcome.status == 3);
  CHECK(contains(outcome.out, "FAIL  1 triangles of the boundary"));
  CHECK(run_program({"check", file, "--for", "fenicsx"}).status == 0);
}

TEST_CASE("the integral of an array of the tets stays when it is asked for") {
  const TempFolder folder;
  MeshData mesh = read_mesh(asset("bracket.meshb"));
  std::vector<double> mass;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    mass.push_back(1.0 + static_cast<double>(t % 7));
  mesh.tet_data = {{"mass", 1, mass},
                   {"other", 1, mass},
                   {"kind", 1, std::vector<std::int32_t>(mass.size(), 3)}};
  mesh.label_array = "mat_id";
  const std::string file = (folder / "a.vtu").string();
  write_mesh(file, mesh);
  const std::string report = (folder / "a.json").string();
  const std::string out = (folder / "b.vtu").string();
  REQUIRE(run_program({"improve", file, "-o", out, "--conserve", "mass", "--report", report, "-q"})
              .status == 0);
  const auto json = nlohmann::json::parse(read_text(report));
  for (const auto& array : json["data"]) {
    const double error = array["integral_error"];
    if (array["name"] == "mass") CHECK(error < 1e-12);
    if (array["name"] == "other") CHECK(error > 1e-9);
  }
  CHECK(contains(run_program({"improve", file, "-o", out, "--conserve", "none"}).err,
                 "named 'none'"));
  CHECK(contains(run_program({"improve", file, "-o", out, "--conserve", "kind"}).err, "integers"));
}
