// SPDX-License-Identifier: MIT
// The command line as a user has it: every subcommand on real meshes, exit statuses, messages.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <tetmend/rulers.h>

#include "kernel/integrity.h"
#include "kernel/statistics.h"
#include "kernel/surface_fingerprint.h"
#include "ops/registry.h"
#include "schedule/limit/surface_limit.h"
#include "tests/apps/program.h"
#include "tests/support/assets.h"
#include "tests/support/text.h"
#include "tests/support/turned_ring.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

const std::array<std::string, 3> kAssets = {"bracket.meshb", "two_materials.mesh", "sheet.mesh"};

/// One line, from tetmend, and nothing on stdout.
void check_complaint(const Outcome& outcome, int status) {
  CAPTURE(outcome.err);
  CHECK(outcome.status == status);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.starts_with("tetmend: "));
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  CHECK(outcome.err.ends_with("\n"));
}

#ifdef TETMEND_HAS_OPENMESH
constexpr bool kHasSurface = true;
#else
constexpr bool kHasSurface = false;
#endif

/// Triangles by the text of their coordinates, each from its smallest corner on.
std::multiset<std::array<std::string, 3>> read_off(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string word;
  std::size_t vertices = 0, faces = 0, edges = 0;
  in >> word >> vertices >> faces >> edges;
  REQUIRE(word == "OFF");
  std::vector<std::string> points(vertices);
  for (std::string& point : points) {
    std::string x, y, z;
    in >> x >> y >> z;
    point = x + ' ' + y + ' ' + z;
  }
  std::multiset<std::array<std::string, 3>> triangles;
  for (std::size_t i = 0; i < faces; ++i) {
    std::size_t corners = 0, a = 0, b = 0, c = 0;
    in >> corners >> a >> b >> c;
    REQUIRE(corners == 3);
    std::array<std::string, 3> triangle = {points.at(a), points.at(b), points.at(c)};
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                triangle.end());
    triangles.insert(triangle);
  }
  REQUIRE(in);
  return triangles;
}

/// n^3 cubes of six tets each, the points inside moved a little.
MeshData jittered_cube(std::uint32_t n) {
  MeshData mesh;
  std::uint64_t random = 1;
  const auto jitter = [&random] {
    random = random * 6364136223846793005u + 1442695040888963407u;
    return 0.5 * (static_cast<double>(random >> 40) / 16777216.0 - 0.5);
  };
  const auto inside = [n](std::uint32_t i) { return i > 0 && i < n; };
  for (std::uint32_t k = 0; k <= n; ++k) {
    for (std::uint32_t j = 0; j <= n; ++j) {
      for (std::uint32_t i = 0; i <= n; ++i) {
        Point point(i, j, k);
        if (inside(i) && inside(j) && inside(k)) point += Point(jitter(), jitter(), jitter());
        mesh.points.push_back(point);
      }
    }
  }
  const std::array<std::uint32_t, 3> step = {1, n + 1, (n + 1) * (n + 1)};
  for (std::uint32_t cube = 0; cube < n * n * n; ++cube) {
    const std::uint32_t corner = cube % n + cube / n % n * step[1] + cube / n / n * step[2];
    std::array<std::size_t, 3> axes = {0, 1, 2};
    do {
      const std::uint32_t a = corner + step[axes[0]];
      const std::uint32_t b = a + step[axes[1]];
      mesh.tets.push_back({{corner, a, b, b + step[axes[2]]}, 0});
      const bool odd = (axes[1] + 3 - axes[0]) % 3 != 1;
      if (odd) std::swap(mesh.tets.back().vertices[2], mesh.tets.back().vertices[3]);
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
  return mesh;
}

}  // namespace

TEST_CASE("help and version go to stdout with status 0") {
  const Outcome help = run_program({"--help"});
  CHECK(help.status == 0);
  CHECK(help.err.empty());
  for (const std::string name :
       {"improve", "quality", "convert", "surface", "operators", "schedules", "check-plugin"}) {
    CHECK(contains(help.out, "\n  " + name + " "));
    const Outcome outcome = run_program({name, "--help"});
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty());
    CHECK(contains(outcome.out, "Usage: tetmend " + name));
  }
  const Outcome improve = run_program({"improve", "--help"});
  CHECK(contains(improve.out, "Usage: tetmend improve IN -o OUT [OPTIONS]"));
  for (const MeshFormat& format : mesh_formats()) CHECK(contains(improve.out, format.extension));
  const Outcome version = run_program({"--version"});
  CHECK(version.status == 0);
  CHECK(version.out.starts_with("tetmend "));
}

TEST_CASE("wrong usage gives one line on stderr and status 2") {
  const std::string mesh = asset("sheet.mesh");
  const TempFolder folder;
  const std::string out = (folder / "out.mesh").string();
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"polish"},
      {"--polish"},
      {"improve"},
      {"improve", mesh},
      {"improve", "-o", out},
      {"improve", mesh, "-o"},
      {"improve", mesh, "-o", out, "more"},
      {"improve", mesh, "-o", out, "--polish"},
      {"improve", mesh, "-o", out, "--threads", "0"},
      {"improve", mesh, "-o", out, "--threads", "1025"},
      {"improve", mesh, "-o", out, "--threads", "two"},
      {"improve", mesh, "-o", out, "--schedule", "varnish"},
      {"improve", mesh, "-o", out, "--report", out},
      {"improve", mesh, "-o", (folder / "out.stl").string()},
      {"quality"},
      {"quality", mesh, mesh, "--list", "2"},
      {"convert", mesh, (folder / "a.vtk").string(), "-o", (folder / "b.vtk").string()},
      {"quality", mesh, mesh, "--measure", "radius_ratio"},
      {"quality", mesh, "--measure", "beauty"},
      {"convert", mesh},
      {"convert", mesh, (folder / "out").string()},
      {"surface", mesh},
      {"surface", mesh, out},
      {"surface", mesh, (folder / "out.off").string(), "--bad", "--constraints"},
      {"operators", "polish"},
      {"schedules", "varnish"}};
  for (const auto& arguments : wrong) {
    std::string line;
    for (const std::string& word : arguments) line += word + ' ';
    CAPTURE(line);
    check_complaint(run_program(arguments), 2);
  }
  CHECK(folder.entries() == 0);
  CHECK(contains(run_program({"polish"}).err, "improve, adapt, quality, check, convert"));
  CHECK(contains(run_program({"improve", mesh, "-o", out, "--polish"}).err, "--polish"));
  CHECK(contains(run_program(wrong[12]).err, "shell"));
}

TEST_CASE("a mistyped option or subcommand is told with what was meant") {
  const std::string mesh = asset("sheet.mesh");
  CHECK(contains(run_program({"imrpove", mesh}).err, "did you mean 'improve'?"));
  CHECK(contains(run_program({"improve", mesh, "-o", "o.mesh", "--shedule", "shell"}).err,
                 "unknown option '--shedule': did you mean '--schedule'?"));
  CHECK(contains(run_program({"improve", mesh, "-o", "o.mesh", "--shedule=shell"}).err,
                 "did you mean '--schedule'?"));
  const auto unlike = run_program({"quality", mesh, "--smooth"});
  CHECK(contains(unlike.err, "unknown option '--smooth' (see tetmend quality --help)"));
}

TEST_CASE("help and its short forms") {
  CHECK(run_program({"help"}).out == run_program({"--help"}).out);
  CHECK(run_program({"help", "quality"}).out == run_program({"quality", "--help"}).out);
  CHECK(run_program({"-V"}).out == run_program({"--version"}).out);
  check_complaint(run_program({"help", "qualty"}), 2);
}

TEST_CASE("several meshes are measured a line each, and one that cannot be read stops no other") {
  const TempFolder folder;
  const std::string sheet = asset("sheet.mesh");
  const std::string two = asset("two_materials.mesh");
  const auto all = run_program({"quality", sheet, two, "-j", "2"});
  CHECK(all.status == 0);
  CHECK(std::count(all.out.begin(), all.out.end(), '\n') == 4);
  CHECK(contains(all.out, "mean ratio  mesh"));
  CHECK(contains(all.out, sheet));
  const auto alone = nlohmann::json::parse(run_program({"quality", two, "--json"}).out);
  const auto lines = run_program({"quality", sheet, two, "--json"}).out;
  CHECK(nlohmann::json::parse(lines.substr(lines.find('\n') + 1)) == alone);
  const auto some = run_program({"quality", sheet, (folder / "none.mesh").string(), two});
  CHECK(some.status == 1);
  CHECK(some.out == all.out);
  CHECK(contains(some.err, "none.mesh"));
}

#ifndef TETMEND_HAS_OPENMESH
TEST_CASE("a build without OpenMesh says that it has no command 'surface', and writes nothing") {
  const TempFolder folder;
  const Outcome outcome =
      run_program({"surface", asset(kAssets[0]), (folder / "out.off").string()});
  check_complaint(outcome, 2);
  CHECK(contains(outcome.err, "built without OpenMesh"));
  CHECK(folder.entries() == 0);
  CHECK(contains(run_program({"--help"}).out, "(not in this build)"));
}
#endif

TEST_CASE("improving each asset keeps its surface and reports what happened") {
  for (const std::string& name : kAssets) {
    CAPTURE(name);
    const TempFolder folder;
    const std::string out = (folder / name).string();
    const std::string report_file = (folder / "report.json").string();
    const Outcome outcome =
        run_program({"improve", asset(name), "-o", out, "-v", "--report", report_file});
    CAPTURE(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(outcome.err.empty());
    for (const auto part : {"theta_min", "lambda_5", "bad tets", "dihedral angles", "surface",
                            "untouched", "peak memory", "tets touched", "local_reconnection"}) {
      CAPTURE(part);
      CHECK(contains(outcome.out, part));
    }

    const TetMesh before(read_mesh(asset(name)));
    const TetMesh after(read_mesh(out));
    CHECK(to_string(check_integrity(after)).empty());
    CHECK(surface_fingerprint(after) == surface_fingerprint(before));
    CHECK(count_not_positive(after) == 0);
    const MeshStatistics now = compute_statistics(after);
    CHECK(now.n_bad < compute_statistics(before).n_bad);

    const auto report = nlohmann::json::parse(read_text(report_file));
    CHECK(report["arguments"][0] == "improve");
    CHECK(report["input"] == asset(name));
    CHECK(report["output"] == out);
    CHECK(report["schedule"] == "shell");
    CHECK(report["interrupted"] == false);
    CHECK(report["surface"]["unchanged"] == true);
    CHECK(report["not_positive_tets"]["after"] == 0);
    CHECK(report["before"]["tets"] == before.tet_count());
    CHECK(report["after"]["tets"] == after.tet_count());
    CHECK(report["after"]["n_bad"] == now.n_bad);
    CHECK(report["before"]["rulers"]["inner_faces"].get<std::size_t>() > before.tet_count());
    CHECK(report["after"]["rulers"]["mean_ratio"]["mean"] >
          report["before"]["rulers"]["mean_ratio"]["mean"]);
    CHECK(report["after"]["theta_min"].get<double>() == doctest::Approx(now.theta_min));
    CHECK(report["limit"]["n_bad"] == now.n_bad);
    std::size_t by_hindrance = 0;
    for (const auto& count : report["limit"]["bad"]) by_hindrance += count.get<std::size_t>();
    CHECK(by_hindrance == now.n_bad);
    CHECK(contains(outcome.out, "bad tets left") == (now.n_bad > 0));
    CHECK(report["volume_change"].get<double>() < 1e-12);
    CHECK(report["touched_share"].get<double>() > 0);
    CHECK(report["touched_share"].get<double>() <= 1);
    CHECK(report["peak_memory_bytes"].get<double>() > 1e6);
    CHECK(report["seconds"]["total"].get<double>() >= report["seconds"]["improving"].get<double>());
    REQUIRE(!report["passes"].empty());
    for (const auto& pass : report["passes"]) {
      std::size_t sum = 0;
      for (const auto& count : pass["verdicts"]) sum += count.get<std::size_t>();
      CHECK(pass["attempts"] == sum);
      CHECK(pass["verdicts"]["accepted"] == pass["accepted"]);
    }
    CHECK(report["passes"].back()["n_bad"] == now.n_bad);

    if (!kHasSurface) continue;
    const auto off_of = [&](const std::string& mesh, const std::string& file) {
      REQUIRE(run_program({"surface", mesh, (folder / file).string()}).status == 0);
      return read_off(folder / file);
    };
    CHECK(off_of(asset(name), "before.off") == off_of(out, "after.off"));
  }
}

TEST_CASE("the same input gives the same bytes, also for another number of threads, silently") {
  for (const std::string& name : kAssets) {
    CAPTURE(name);
    const TempFolder folder;
    for (const std::string threads : {"1", "2"}) {
      const std::string out = (folder / (threads + name)).string();
      const Outcome outcome =
          run_program({"improve", asset(name), "-o", out, "--threads", threads, "--quiet"});
      CHECK(outcome.status == 0);
      CHECK(outcome.out.empty());
      CHECK(outcome.err.empty());
    }
    const std::string bytes = read_text(folder / ("1" + name));
    CHECK(!bytes.empty());
    CHECK(bytes == read_text(folder / ("2" + name)));
    CHECK(folder.entries() == 2);
  }
}

TEST_CASE("a goal that was asked for and missed is status 3, with the mesh written") {
  const TempFolder folder;
  const std::string out = (folder / "out.mesh").string();
  const auto improve = [&](const std::string& goal) {
    return run_program(
        {"improve", asset("folded_sheet.mesh"), "-o", out, "--quiet", "--goal", goal});
  };
  const Outcome missed = improve("30");
  CHECK(missed.status == 3);
  CHECK(missed.err.starts_with("tetmend: the goal 30 is missed by "));
  CHECK(missed.err.ends_with(" tets: wrote the mesh\n"));
  CHECK(read_mesh(out).tets.size() > 100);
  const Outcome reached = improve("10");
  CHECK(reached.status == 0);
  CHECK(reached.err.empty());
}

TEST_CASE("what a format cannot hold is named, in the report too, or refused") {
  const TempFolder folder;
  const std::string in = (folder / "in.vtk").string();
  const std::string out = (folder / "out.mesh").string();
  MeshData mesh = read_mesh(asset("folded_sheet.mesh"));
  mesh.point_data = {{"heat", 1, std::vector<double>(mesh.points.size(), 1.5)}};
  write_mesh(in, mesh);
  const std::string report = (folder / "r.json").string();
  const Outcome improved = run_program({"improve", in, "-o", out, "--quiet", "--report", report});
  CHECK(improved.status == 0);
  const std::string note = "the array 'heat' of points is not kept: .mesh holds none";
  CHECK(improved.err == "note: " + in + ": " + note + "\n");
  const auto json = nlohmann::json::parse(read_text(report));
  CHECK(json["notes"][0] == note);
  CHECK(json["data"][0]["name"] == "heat");
  std::filesystem::remove(out);
  for (const std::string command : {"improve", "convert"}) {
    std::vector<std::string> words = {command, in};
    if (command == "improve") words.emplace_back("-o");
    words.insert(words.end(), {out, "--strict"});
    const Outcome refused = run_program(words);
    CHECK(refused.status == 1);
    CHECK(contains(refused.err, "something would be lost: nothing is written"));
    CHECK(!std::filesystem::exists(out));
  }
  const std::string kept = (folder / "kept.vtu.gz").string();
  CHECK(run_program({"improve", in, "-o", kept, "--quiet", "--strict"}).status == 0);
  const MeshData now = read_mesh(kept);
  REQUIRE(now.point_data.size() == 1);
  CHECK(now.point_data[0].values == DataArray::Values(std::vector<double>(now.points.size(), 1.5)));
}

TEST_CASE(
    "--strict converts what loses nothing but where tets are replaced, and does not improve it") {
  const TempFolder folder;
  const std::string in = (folder / "in.bdf").string();
  const std::string out = (folder / "out.bdf").string();
  write_text(in,
             "BEGIN BULK\nGRID,1\nGRID,2,,1.\nGRID,3,,,1.\nGRID,4,,,,1.\nCTETRA,7,1,1,2,3,4\n"
             "PLOAD4,1,7,1.\nENDDATA\n");
  const Outcome converted = run_program({"convert", in, out, "--strict"});
  CHECK(converted.status == 0);
  CHECK(contains(converted.err, "the card PLOAD4 names elements"));
  std::filesystem::remove(out);
  CHECK(run_program({"improve", in, "-o", out, "--strict"}).status == 1);
  CHECK(!std::filesystem::exists(out));
}

TEST_CASE("check holds a mesh to thresholds, presets and its input") {
  const TempFolder folder;
  const std::string in = asset("two_materials.mesh");
  const std::string out = (folder / "out.vtu").string();
  REQUIRE(run_program({"improve", in, "-o", out, "--quiet"}).status == 0);
  const Outcome kept = run_program({"check", in, out, "--min-dihedral", "29"});
  CHECK(kept.status == 0);
  CHECK(!contains(kept.out, "FAIL"));
  CHECK(contains(kept.out, "ok    triangles of the surface: the same 1,470, bit for bit"));

  const auto broken = [&](const auto& change) {
    MeshData mesh = read_mesh(out);
    change(mesh);
    const std::string file = (folder / "broken.mesh").string();
    write_mesh(file, mesh);
    const Outcome outcome = run_program({"check", in, file});
    CHECK(outcome.status == 3);
    return outcome.out;
  };
  // A vertex of the surface moves by one bit.
  const std::string moved = broken([](MeshData& mesh) {
    Point& p = mesh.points[mesh.triangles[0].vertices[0]];
    p.x() = std::nextafter(p.x(), 1e9);
  });
  CHECK(contains(moved, "FAIL  triangles of the surface"));
  const std::string relabelled = broken([](MeshData& mesh) { mesh.tets[0].label = 99; });
  CHECK(contains(relabelled, "FAIL  faces between two labels"));
  CHECK(contains(relabelled, "FAIL  label 99 is new"));
  const std::string renamed = broken([](MeshData& mesh) { mesh.triangles[0].label += 1; });
  CHECK(contains(renamed, "FAIL  named triangles with labels"));
  const std::string turned =
      broken([](MeshData& mesh) { std::swap(mesh.tets[3].vertices[0], mesh.tets[3].vertices[1]); });
  CHECK(contains(turned, "FAIL  1 inverted or flat tet, the first is tet 4 (from 1)"));

  const Outcome bad = run_program({"check", in, "--for", "calculix", "--min-dihedral", "15"});
  CHECK(bad.status == 3);
  CHECK(contains(bad.out, "ok    no inverted or flat tet"));
  CHECK(contains(bad.out, "FAIL  smallest dihedral angle"));
  const auto json =
      nlohmann::json::parse(run_program({"check", out, "--for", "openfoam", "--json"}).out);
  CHECK(json["schema"] == 1);
  CHECK(json["holds"] == true);
  CHECK(json["facts"].size() == 4);
  CHECK(json["facts"][1]["name"] == "non_orthogonality");
  CHECK(json["facts"][1]["wanted"] == 70);
  CHECK(run_program({"check", in}).status == 2);
  CHECK(run_program({"check", in, out, "--surface", "far"}).status == 2);
  CHECK(run_program({"check", in, "--surface", "1%"}).status == 2);
  const Outcome unit = run_program({"check", in, out, "--surface", "5"});
  CHECK(unit.status == 2);
  CHECK(contains(unit.err, "did you mean 5%?"));
  CHECK(run_program({"check", in, "--for", "excel"}).status == 2);
  CHECK(run_program({"check", in, "--measure", "mean_ratio"}).status == 2);
  CHECK(run_program({"check", "no.mesh", "--no-inverted"}).status == 1);
}

TEST_CASE("a mesh may be improved in place") {
  const TempFolder folder;
  const auto file = folder / "sheet.mesh";
  std::filesystem::copy_file(asset("sheet.mesh"), file);
  CHECK(run_program({"improve", file.string(), "-o", file.string(), "-q"}).status == 0);
  CHECK(read_text(file) != read_text(asset("sheet.mesh")));
  CHECK(to_string(check_integrity(TetMesh(read_mesh(file)))).empty());
  CHECK(folder.entries() == 1);
}

TEST_CASE("peculiarities of the input are told") {
  const TempFolder folder;
  MeshData mesh = read_mesh(asset("two_materials.mesh"));
  for (MeshData::Tet& tet : mesh.tets) std::swap(tet.vertices[0], tet.vertices[1]);
  write_mesh(folder / "mirrored.mesh", mesh);
  const Outcome outcome = run_program({"quality", (folder / "mirrored.mesh").string()});
  CHECK(outcome.status == 0);
  CHECK(contains(outcome.out, "note: the mesh was mirrored"));
  CHECK(contains(outcome.out, "faces inside the volume constrained"));
}

TEST_CASE("a bad file gives one line with its place, status 1, and leaves an older output alone") {
  const TempFolder folder;
  const std::string head = "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n";
  const std::string points = "0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n";
  struct Case {
    std::string content;
    std::string place;
  };
  const std::vector<Case> cases = {{"", ":1: "},
                                   {"hello\n", ":1: "},
                                   {head + "0 0 0 0\n1 0 zero 0\n0 1 0 0\n0 0 1 0\n", ":6: "},
                                   {head + points + "Tetrahedra\n1\n1 2 3 5 0\nEnd\n", ":11: "},
                                   {head + points + "Tetrahedra\n1000000000\n1 2", ":10: "},
                                   {head + points + "Tetrahedra\n1\n1 2 3 4 17", ":11: "},
                                   {head + points + "Tetrahedra\n0\nEnd\n", ": the mesh has no"}};
  write_text(folder / "old.mesh", "dear to me");
  const std::string in = (folder / "in.mesh").string();
  for (const Case& bad : cases) {
    CAPTURE(bad.content);
    write_text(in, bad.content);
    const Outcome outcome = run_program({"improve", in, "-o", (folder / "old.mesh").string()});
    check_complaint(outcome, 1);
    CHECK(contains(outcome.err, in + bad.place));
    check_complaint(run_program({"quality", in}), 1);
  }
  CHECK(read_text(folder / "old.mesh") == "dear to me");
  CHECK(folder.entries() == 2);
  check_complaint(run_program({"quality", (folder / "missing.mesh").string()}), 1);
}

TEST_CASE("what is given as a mesh and is not there, or is a trace, is told so by its name") {
  TempFolder folder;
  const std::string missing = (folder / "nope.trace").string();
  const std::string trace = (folder / "run.trace").string();
  const std::string out = (folder / "out.mesh").string();
  const std::string improved = (folder / "improved.mesh").string();
  REQUIRE(run_program({"improve", asset("sheet.mesh"), "-o", improved, "--schedule", "quick",
                       "--trace", trace})
              .status == 0);
  const std::string good = asset("sheet.mesh");
  const auto check_both = [&](const std::vector<std::string>& before,
                              const std::vector<std::string>& after) {
    const auto complain = [&](const std::string& file, const std::string& reason) {
      std::vector<std::string> words = before;
      words.push_back(file);
      words.insert(words.end(), after.begin(), after.end());
      CAPTURE(words);
      const Outcome outcome = run_program(words);
      check_complaint(outcome, 1);
      CHECK(contains(outcome.err, file + ": " + reason));
    };
    complain(missing, "cannot be read: No such file");
    complain(trace, "this is the trace of a run, not a mesh");
  };
  check_both({"quality"}, {});
  check_both({"quality", good}, {});
  check_both({"check"}, {"--no-inverted"});
  check_both({"check", good}, {});
  check_both({"improve"}, {"-o", out});
  check_both({"convert"}, {out});
  if (kHasSurface) check_both({"surface"}, {(folder / "out.off").string()});
  CHECK_FALSE(std::filesystem::exists(out));
  // A file with another wrong name is told what names there are.
  write_text(folder / "notes.txt", "hello");
  const Outcome outcome = run_program({"quality", (folder / "notes.txt").string()});
  check_complaint(outcome, 2);
  CHECK(contains(outcome.err, "the extension '.txt' is not known here"));
}

TEST_CASE(
    "tets that no order of vertices puts on two sides of a face are located in every format") {
  const TempFolder folder;
  const auto check_place = [&folder](const std::string& name, const std::string& place) {
    CAPTURE(name);
    const Outcome outcome = run_program({"quality", (folder / name).string()});
    check_complaint(outcome, 1);
    CHECK(contains(outcome.err, place));
    CHECK(contains(outcome.err, "same side"));
  };
  write_mesh(folder / "a.mesh", turned_ring());
  check_place("a.mesh", "a.mesh:20: ");
  for (const std::string name : {"a.meshb", "a.vtk", "a.ele"}) {
    CAPTURE(name);  // a mesh of broken topology converts
    CHECK(run_program({"convert", (folder / "a.mesh").string(), (folder / name).string()}).status ==
          0);
  }
  check_place("a.meshb", "a.meshb: byte 368: ");
  check_place("a.ele", "a.ele:7: ");
  check_place("a.node", "a.ele:7: ");
  const std::string vtk = read_text(folder / "a.vtk");
  constexpr std::size_t kFirstCells = 26 * 4;  // five times 4 0 1 2 3, then the 4 of the sixth tet
  check_place("a.vtk", "a.vtk: byte " +
                           std::to_string(vtk.find('\n', vtk.find("CELLS ")) + 1 + kFirstCells));
  write_text(folder / "b.vtk",
             "# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n"
             "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n2 0 1\n0 2 1\n1 1 3\nCELLS 9 44\n3 0 1 2\n"
             "4 0 1 2 3\n4 1 2 3 4\n4 2 3 4 5\n4 3 4 5 6\n4 4 5 6 7\n4 5 6 7 1\n4 6 7 1 0\n"
             "4 7 1 0 2\nCELL_TYPES 9\n5\n10\n10\n10\n10\n10\n10\n10\n10\n");
  check_place("b.vtk", "b.vtk:21: ");
}

TEST_CASE("an output that cannot be written is found out before the work begins") {
  const TempFolder folder;
  const std::string missing_input = (folder / "missing.mesh").string();
  const auto check_first = [](const std::vector<std::string>& arguments, const std::string& name) {
    const Outcome outcome = run_program(arguments);
    check_complaint(outcome, 1);
    CHECK(contains(outcome.err, name));
  };
  const std::string nowhere = (folder / "no/out.mesh").string();
  const std::string out = (folder / "out.mesh").string();
  check_first({"improve", missing_input, "-o", nowhere}, nowhere);
  const std::string report = (folder / "no/report.json").string();
  check_first({"improve", missing_input, "-o", out, "--report", report}, report);
  check_first({"convert", missing_input, nowhere}, nowhere);
  const std::string surface = (folder / "no/surface.off").string();
  if (kHasSurface) check_first({"surface", missing_input, surface}, surface);
  CHECK(folder.entries() == 0);
}

TEST_CASE("statistics as JSON are those of the library, with every measure asked for") {
  for (const std::string& name : kAssets) {
    CAPTURE(name);
    const Outcome outcome = run_program({"quality", asset(name), "--json", "--measure", "all"});
    REQUIRE(outcome.status == 0);
    const auto json = nlohmann::json::parse(outcome.out);
    const MeshStatistics expected = compute_statistics(TetMesh(read_mesh(asset(name))));
    CHECK(json["tets"] == expected.tets);
    CHECK(json["lambda"].get<double>() == doctest::Approx(expected.lambda));
    CHECK(json["histogram"].size() == expected.histogram.size());
    CHECK(json["measures"].size() == quality_measures().size());
    CHECK(json["rulers"].size() == kRulerCount + 3 + kSolverRulers.size());
    CHECK(json["rulers"]["radius_ratio"]["worst"].get<double>() ==
          doctest::Approx(json["measures"]["radius_ratio"]["worst"].get<double>()));
    CHECK(json["measures"]["min_sine"]["worst"].get<double>() == doctest::Approx(expected.q_worst));
  }
  const Outcome text = run_program({"quality", asset("sheet.mesh"), "--measure", "radius_ratio"});
  CHECK(contains(text.out, "radius_ratio, worst"));
  CHECK(!contains(text.out, "mean_ratio"));
  CHECK(contains(text.out, "dihedral angles by 10 degrees"));
  CHECK(contains(text.out, "measures of other programs"));
}

TEST_CASE("the limit of the surface is added when asked for") {
  const SurfaceLimit limit = compute_surface_limit(TetMesh(read_mesh(asset("folded_sheet.mesh"))));
  const Outcome json = run_program({"quality", asset("folded_sheet.mesh"), "--limit", "--json"});
  REQUIRE(json.status == 0);
  const auto found = nlohmann::json::parse(json.out).at("limit");
  CHECK(found.at("n_bad") == limit.n_bad);
  CHECK(found.at("n_forced") == limit.n_forced);
  CHECK(contains(run_program({"quality", asset("folded_sheet.mesh"), "--limit"}).out,
                 "bad tets             293 held by a constraint"));
  const Outcome plain = run_program({"quality", asset("folded_sheet.mesh"), "--json"});
  CHECK(!nlohmann::json::parse(plain.out).contains("limit"));
}

TEST_CASE("converting there and back keeps points, elements and labels") {
  for (const std::string& name : kAssets) {
    const MeshData original = read_mesh(asset(name));
    for (const MeshFormat& format : mesh_formats()) {
      CAPTURE(name);
      CAPTURE(format.extension);
      const TempFolder folder;
      const std::string there = (folder / ("there" + std::string(format.extension))).string();
      const std::string back = (folder / "back.meshb").string();
      CHECK(run_program({"convert", asset(name), there}).status == 0);
      // What is lost is the subject of the tests of formats. Decks sort triangles by tets, SU2 has
      // no label for a mesh of one region, FEBio, Exodus and CGNS sort by labels.
      const bool is_other = format.extension == ".inp" || format.extension == ".su2" ||
                            format.extension == ".feb" || format.name == "Exodus II" ||
                            format.name == "CGNS";
      if (is_other || !not_written(there, original).empty()) continue;
      const Outcome outcome = run_program({"convert", there, back});
      CHECK(outcome.status == 0);
      CHECK(outcome.err.empty() == not_written(back, read_mesh(there)).empty());
      const MeshData mesh = read_mesh(back);
      CHECK(mesh.points == original.points);
      CHECK(mesh.tets == original.tets);
      CHECK(mesh.triangles == original.triangles);
      CHECK(mesh.edges == original.edges);
    }
  }
}

TEST_CASE("surfaces are written in each format, of the boundary, bad tets and constraints") {
  const TempFolder folder;
  const std::string mesh = asset("two_materials.mesh");
  BuildReport build;
  const TetMesh tets(read_mesh(mesh), &build);
  const MeshStatistics statistics = compute_statistics(tets);
  for (const std::string name : {"a.off", "a.obj", "a.ply", "a.stl"}) {
    CAPTURE(name);
    const Outcome outcome = run_program({"surface", mesh, (folder / name).string()});
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty());
    CHECK(!read_text(folder / name).empty());
  }
  CHECK(read_off(folder / "a.off").size() == statistics.boundary_triangles);
  const std::string other = (folder / "b.off").string();
  CHECK(run_program({"surface", mesh, other, "--bad"}).status == 0);
  CHECK(read_off(other).size() == 4 * statistics.n_bad);
  CHECK(run_program({"surface", mesh, other, "--constraints"}).status == 0);
  CHECK(read_off(other).size() == build.constrained_faces);
}

TEST_CASE("operators are listed with their parameters, schedules with a line") {
  Registry registry = Registry::builtin();
  const Outcome all = run_program({"operators"});
  CHECK(all.status == 0);
  for (const OperatorInfo* info : registry.operators()) {
    CHECK(contains(all.out, info->name));
    const Outcome one = run_program({"operators", std::string(info->name)});
    CHECK(one.status == 0);
    CHECK(one.out.starts_with(info->name));
    for (const ParameterSpec& parameter : info->parameters) {
      CHECK(contains(one.out, parameter.name));
      CHECK(contains(one.out, parameter.help));
    }
  }
  CHECK(contains(run_program({"schedules"}).out, "shell (default)"));
}

TEST_CASE("the tables of docs/operators.md are those that the program prints") {
  const std::string page = read_text(std::string(TETMEND_SOURCE_DIR) + "/docs/operators.md");
  const std::string begin = "<!-- tables -->\n";
  const std::size_t first = page.find(begin);
  const std::size_t last = page.find("<!-- /tables -->");
  REQUIRE(first < last);
  REQUIRE(last < page.size());
  const std::string tables = page.substr(first + begin.size(), last - first - begin.size());
  const Outcome outcome = run_program({"operators", "--markdown"});
  CHECK(outcome.status == 0);
  CHECK_MESSAGE(tables == outcome.out, "script/operator-tables writes them");
}

TEST_CASE("a full disk behind standard output is an error") {
  const TempFolder folder;
  const int err = ::open((folder / "err").c_str(), O_WRONLY | O_CREAT, 0666);
  const int status = Program({"operators"}, "/dev/full", err).wait();
  ::close(err);
  CHECK(status == 1);
  CHECK(contains(read_text(folder / "err"), "standard output"));
}

TEST_CASE("a terminal shows progress in one line and Ctrl-C still gives a better mesh") {
  const TempFolder folder;
  const auto in = folder / "cube.meshb";
  const auto out = folder / "out.meshb";
  const auto report = folder / "report.json";
  const MeshData cube = jittered_cube(30);
  write_mesh(in, cube);
  Terminal terminal;
  const Program program({"improve", in.string(), "-o", out.string(), "--report", report.string()},
                        folder / "stdout", terminal.slave());
  terminal.wait_for("round  1");
  program.send(SIGINT);
  CHECK(program.wait() == 4);
  const std::string text = terminal.wait_for("interrupted: wrote the mesh as improved so far");
  const std::size_t message = text.rfind("\033[31mtetmend: \033[0minterrupted");
  REQUIRE(message != std::string::npos);
  // A note may come before the message, in a line of its own; the progress never ends a line.
  for (std::size_t end = text.find("\r\n"); end < message; end = text.find("\r\n", end + 2)) {
    const std::size_t begin = text.rfind('\r', end - 1) + 1;
    CHECK_MESSAGE(!contains(text.substr(begin, end - begin), "round "), text);
  }
  CHECK(text[message - 1] == '\r');
  CHECK(contains(text, "worst"));

  const TetMesh before(cube);
  const TetMesh after(read_mesh(out));
  CHECK(to_string(check_integrity(after)).empty());
  CHECK(surface_fingerprint(after) == surface_fingerprint(before));
  const auto json = nlohmann::json::parse(read_text(report));
  CHECK(json["interrupted"] == true);
  CHECK(json["after"]["tets"] == after.tet_count());
  CHECK(contains(read_text(folder / "stdout"), "untouched"));
}

TEST_CASE("Ctrl-C twice ends the program at once and leaves an older output alone") {
  const TempFolder folder;
  const auto in = folder / "cube.meshb";
  const auto out = folder / "out.meshb";
  write_mesh(in, jittered_cube(30));
  write_text(out, "dear to me");
  Terminal terminal;
  const Program program({"improve", in.string(), "-o", out.string()}, folder / "stdout",
                        terminal.slave());
  terminal.wait_for("round  1");
  program.send(SIGINT);
  program.send(SIGTERM);
  const int status = program.wait();
  // The two may arrive so far apart that the work is done between them.
  if (status == 1) {
    CHECK(to_string(check_integrity(TetMesh(read_mesh(out)))).empty());
  } else {
    CHECK((status == 128 + SIGTERM || status == 128 + SIGINT));
    CHECK(read_text(out) == "dear to me");
  }
}

TEST_CASE("the tire of ../shared/meshes is improved (skipped where that folder is absent)") {
  const auto tire = std::filesystem::path(TETMEND_SOURCE_DIR) / "../shared/meshes/tire.mesh";
  if (!std::filesystem::exists(tire)) {
    MESSAGE("skipped: ../shared/meshes/tire.mesh is not there");
    return;
  }
  const TempFolder folder;
  const auto report_file = folder / "tire.json";
  REQUIRE(run_program({"improve", tire.string(), "-o", (folder / "tire.mesh").string(), "--report",
                       report_file.string(), "--quiet"})
              .status == 0);
  const auto report = nlohmann::json::parse(read_text(report_file));
  CHECK(report["surface"]["unchanged"] == true);
  CHECK(report["volume_change"].get<double>() < 1e-12);
  CHECK(report["after"]["theta_min"].get<double>() >= 19);
  CHECK(report["after"]["theta_max"].get<double>() <= 157.5);
  CHECK(report["after"]["lambda"].get<double>() <= 0.26);
}
