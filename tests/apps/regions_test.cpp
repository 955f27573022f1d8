// SPDX-License-Identifier: MIT
// A part of a mesh is improved and the rest stays as it is, bit for bit; interior constraints are
// dropped on demand.
#include <algorithm>
#include <array>
#include <functional>
#include <set>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "kernel/integrity.h"
#include "kernel/surface_fingerprint.h"
#include "tests/apps/program.h"
#include "tests/support/assets.h"
#include "tests/support/layered_mesh.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Label and corners, coordinate by coordinate, the corners in an order of their own.
struct Tet {
  Label label = 0;
  std::array<Point, 4> corners;

  std::array<double, 13> key() const {
    std::array<std::array<double, 3>, 4> sorted{};
    for (std::size_t i = 0; i < 4; ++i)
      sorted[i] = {corners[i].x(), corners[i].y(), corners[i].z()};
    std::sort(sorted.begin(), sorted.end());
    std::array<double, 13> key{};
    for (std::size_t i = 0; i < 12; ++i) key[i] = sorted[i / 3][i % 3];
    key[12] = label;
    return key;
  }
  Quality quality() const {
    return static_cast<Quality>(minimum_sine(corners[0], corners[1], corners[2], corners[3]));
  }
};

struct Box {
  Point low, high;
  bool holds(const Tet& tet) const {
    return std::all_of(tet.corners.begin(), tet.corners.end(), [&](const Point& p) {
      return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
    });
  }
};

std::vector<Tet> tets_of(const std::filesystem::path& file) {
  const MeshData data = read_mesh(file);
  std::vector<Tet> all;
  for (const MeshData::Tet& tet : data.tets) {
    Tet t{tet.label, {}};
    for (std::size_t i = 0; i < 4; ++i) t.corners[i] = data.points[tet.vertices[i]];
    all.push_back(t);
  }
  return all;
}

struct Part {
  std::multiset<std::array<double, 13>> tets;
  std::size_t bad = 0;
};

Part part_of(const std::vector<Tet>& tets, const std::function<bool(const Tet&)>& is_in) {
  Part part;
  for (const Tet& tet : tets) {
    if (!is_in(tet)) continue;
    part.tets.insert(tet.key());
    part.bad += tet.quality() < 0.5f;
  }
  return part;
}

/// Triangles by label and corners.
std::vector<std::array<double, 10>> triangles_of(const MeshData& data) {
  std::vector<std::array<double, 10>> all;
  for (const MeshData::Triangle& triangle : data.triangles) {
    std::array<double, 10> row{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Point& p = data.points[triangle.vertices[i]];
      for (std::size_t k = 0; k < 3; ++k) row[3 * i + k] = p[static_cast<Eigen::Index>(k)];
    }
    row[9] = triangle.label;
    all.push_back(row);
  }
  return all;
}

struct Case {
  std::string mesh;
  std::vector<std::string> options;
  std::function<bool(const Tet&)> is_protected;
};

const Box kLower = {{0, 0, 0}, {13, 11, 5.5}};
const Box kCorner = {{-1, -1, -1}, {7, 7, 7}};

const std::vector<Case> kCases = {
    {"two_materials.mesh", {"--protect", "label:2"}, [](const Tet& t) { return t.label == 2; }},
    {"two_materials.mesh", {"--only", "label:2"}, [](const Tet& t) { return t.label != 2; }},
    {"two_materials.mesh",
     {"--protect", "label:2", "--protect", "box:-1,-1,-1,7,7,7"},
     [](const Tet& t) { return t.label == 2 || kCorner.holds(t); }},
    {"two_materials.mesh",
     {"--only", "box:0,0,0,13,11,5.5", "--protect", "label:1"},
     [](const Tet& t) { return t.label == 1 || !kLower.holds(t); }},
    {"sheet.mesh",
     {"--only", "box:-inf,-1,-1,7,7,7", "--only", "box:0,0,0,13,11,5.5"},
     [](const Tet& t) { return !kCorner.holds(t) && !kLower.holds(t); }},
};

}  // namespace

TEST_CASE("protected tets come out bit for bit, the others improved") {
  for (const Case& one : kCases) {
    const TempFolder folder;
    const auto out = folder / "out.mesh";
    const auto report_file = folder / "report.json";
    std::vector<std::string> arguments = {"improve"};
    arguments.insert(arguments.end(), one.options.begin(), one.options.end());
    arguments.insert(arguments.end(), {asset(one.mesh), "-o", out.string(), "--report",
                                       report_file.string(), "--threads", "2"});
    std::string line;
    for (const std::string& word : arguments) line += word + ' ';
    CAPTURE(line);
    const Outcome outcome = run_program(arguments);
    CAPTURE(outcome.err);
    REQUIRE(outcome.status == 0);

    const auto is_free = [&](const Tet& t) { return !one.is_protected(t); };
    const std::vector<Tet> before = tets_of(asset(one.mesh));
    const std::vector<Tet> after = tets_of(out);
    const Part kept = part_of(before, one.is_protected);
    const Part worked_on = part_of(before, is_free);
    REQUIRE(!kept.tets.empty());
    REQUIRE(worked_on.bad > 5);
    Part now;
    for (const Tet& tet : after) now.tets.insert(tet.key());
    CHECK(std::includes(now.tets.begin(), now.tets.end(), kept.tets.begin(), kept.tets.end()));
    for (const Tet& tet : after) now.bad += tet.quality() < 0.5f;
    CHECK(now.bad < kept.bad + worked_on.bad);
    CHECK(now.bad >= kept.bad);

    const TetMesh mesh(read_mesh(out));
    CHECK(to_string(check_integrity(mesh)) == "");
    CHECK(surface_fingerprint(mesh) == surface_fingerprint(TetMesh(read_mesh(asset(one.mesh)))));
    const auto report = nlohmann::json::parse(read_text(report_file));
    CHECK(report["protected"]["tets"] == kept.tets.size());
    CHECK(report["protected"]["bad_tets"] == kept.bad);
    CHECK(contains(outcome.out, "tets protected"));
  }
}

TEST_CASE("a run without protected tets says nothing of them") {
  const TempFolder folder;
  const Outcome outcome =
      run_program({"improve", asset("sheet.mesh"), "-o", (folder / "out.mesh").string()});
  CHECK(outcome.status == 0);
  CHECK(!contains(outcome.out, "protected"));
  CHECK(!contains(outcome.out, "dropped"));
}

TEST_CASE("boundary layers come out bit for bit, are counted, and can be given up") {
  const TempFolder folder;
  const auto input = folder / "in.mesh";
  const auto out = folder / "out.mesh";
  const auto report_file = folder / "report.json";
  const LayeredMesh layered =
      make_layered(plane_wall(8), {.heights = growing_heights(4, 0.05, 1.4), .core = {0.6, 0.9}});
  write_mesh(input, TetMesh(layered.data).to_data());  // each tet the right way round
  const std::vector<Tet> before = tets_of(input);
  const auto end = before.begin() + static_cast<std::ptrdiff_t>(layered.layer_tets);
  const Part layers = part_of({before.begin(), end}, [](const Tet&) { return true; });
  const auto kept_layers = [&](const std::string& choice) {
    const Outcome outcome = run_program({"improve", input.string(), "-o", out.string(), "--layers",
                                         choice, "--report", report_file.string()});
    REQUIRE(outcome.status == 0);
    const bool keeps = choice == "keep";
    const std::string note = "1,536 tets of boundary layers kept; --layers improve works on them";
    const auto report = nlohmann::json::parse(read_text(report_file));
    CHECK(contains(outcome.out, note) == keeps);
    CHECK(contains(report["notes"].dump(), note) == keeps);
    CHECK(report["layers"]["tets"] == (keeps ? layers.tets.size() : 0));
    CHECK(report["layers"]["bad_tets"] == (keeps ? layers.bad : 0));
    const Part now = part_of(tets_of(out), [](const Tet&) { return true; });
    return std::includes(now.tets.begin(), now.tets.end(), layers.tets.begin(), layers.tets.end());
  };
  CHECK(kept_layers("keep"));
  CHECK(!kept_layers("improve"));

  const Outcome wrong =
      run_program({"improve", input.string(), "-o", out.string(), "--layers", "drop"});
  CHECK(wrong.status == 2);
  CHECK(contains(wrong.err, "--layers"));
  CHECK(contains(wrong.err, "keep"));
}

TEST_CASE("what the mesh is protected by may be all of it") {
  const TempFolder folder;
  const auto out = folder / "out.mesh";
  REQUIRE(run_program({"improve", asset("sheet.mesh"), "-o", out.string(), "--protect", "label:1"})
              .status == 0);
  const auto all = [](const Tet&) { return true; };
  CHECK(part_of(tets_of(out), all).tets == part_of(tets_of(asset("sheet.mesh")), all).tets);
}

TEST_CASE("interior constraints are dropped on demand, borders between labels are not") {
  const TempFolder folder;
  const auto input = folder / "in.mesh";
  const auto out = folder / "out.mesh";
  const auto report_file = folder / "report.json";
  for (const std::string name : {"sheet.mesh", "two_materials.mesh"}) {
    CAPTURE(name);
    MeshData data = read_mesh(asset(name));
    const TetMesh plain(data);
    // An edge and a vertex inside, and ones on the boundary.
    for (const bool inside : {true, false}) {
      for (std::uint32_t i = 0;; ++i) {
        const TetVertices& v = plain.vertices(TetHandle(i));
        if (plain.is_fixed(v[0]) == inside || plain.is_fixed(v[1]) == inside) continue;
        if (!inside && !(plain.is_boundary(v[0]) && plain.is_boundary(v[1]))) continue;
        if (!inside) {
          const auto& corners = data.triangles[0].vertices;
          data.edges.push_back({{corners[0], corners[1]}, 8});
        } else {
          data.edges.push_back({{v[0].index(), v[1].index()}, 7});
        }
        data.required_vertices.push_back(v[1].index());
        break;
      }
    }
    write_mesh(input, data);
    const Outcome outcome = run_program({"improve", input.string(), "-o", out.string(),
                                         "--ignore-interior", "--report", report_file.string()});
    CAPTURE(outcome.err);
    REQUIRE(outcome.status == 0);

    const bool is_sheet = name == "sheet.mesh";
    const MeshData now = read_mesh(out);
    auto expected = triangles_of(data);
    if (is_sheet) std::erase_if(expected, [](const auto& row) { return row[9] == 10; });
    CHECK(triangles_of(now) == expected);
    REQUIRE(now.edges.size() == 1);
    CHECK(now.edges[0].label == 8);
    REQUIRE(now.required_vertices.size() == 1);
    CHECK(now.points[now.required_vertices[0]] == data.points[data.required_vertices[1]]);

    const auto build = nlohmann::json::parse(read_text(report_file))["build"];
    CHECK(build["dropped_triangles"] == (is_sheet ? 94 : 0));
    CHECK(build["dropped_edges"] == 1);
    CHECK(build["dropped_vertices"] == 1);
    CHECK(build["constrained_faces"] == (is_sheet ? 0 : 311));
    CHECK(contains(outcome.out, "note: 94 triangles inside a region dropped") == is_sheet);
    CHECK(contains(outcome.out, "note: 1 edge inside a region dropped"));
    CHECK(contains(outcome.out, "note: 1 vertex inside a region no longer required"));
  }
}

TEST_CASE("a region that makes no sense is wrong usage, one that is empty a failure") {
  const TempFolder folder;
  const std::string out = (folder / "out.mesh").string();
  const auto complaint = [&](const std::string& option, const std::string& spec, int status) {
    CAPTURE(spec);
    const Outcome outcome =
        run_program({"improve", asset("two_materials.mesh"), "-o", out, option, spec});
    CHECK(outcome.status == status);
    CHECK(outcome.out.empty());
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(contains(outcome.err, option + " " + spec));
    return outcome.err;
  };
  for (const std::string option : {"--protect", "--only"}) {
    for (const char* spec :
         {"2", "lable:2", "label:", "label:1,", "label:1.5", "label:one", "label:99999999999",
          "box:", "box:0,0,0,1,1", "box:0,0,0,1,1,1,1", "box:0,0,0,1,1,x", "box:0,0,0,1,1,nan",
          "box:0,0,2,1,1,1", "box:0,0,0,1,1,1 "}) {
      const std::string text = complaint(option, spec, 2);
      CHECK(contains(text, "label:L"));
      CHECK(contains(text, "box:x0,y0,z0,x1,y1,z1"));
    }
    CHECK(contains(complaint(option, "label:2,7", 1), "no tet has label 7: the mesh has 1, 2"));
    CHECK(contains(complaint(option, "box:100,0,0,101,1,1", 1), "the mesh fills 0,0,0,13,11,11"));
  }
  CHECK(folder.entries() == 0);
}
