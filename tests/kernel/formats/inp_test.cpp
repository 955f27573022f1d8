// SPDX-License-Identifier: MIT
// Decks of Abaqus and CalculiX: what is kept, what comes back word for word, how bad ones are refused.
#include <algorithm>
#include <chrono>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <tetmend/improve.h>
#include <tetmend/io.h>

#include "kernel/formats/deck_remarks.h"
#include "kernel/formats/inp_types.h"
#include "tests/kernel/formats/damage.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/text.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

// Two tets and a hexahedron, a spring, a shell; sets within sets, ranges, a surface, loads on faces.
constexpr std::string_view kDeck =
    "** made by hand\n"
    "*Heading\n"
    " Two tets, 1, 2, 3\n"
    "\n"
    "*Node, NSET=Nall\n"
    "10, 0., 0., 0.\n20, 1., 0, .0\n30, 0, 1.D0, 0\n40, 0, 0, 1.\n50, 1, 1, 1e0\n"
    "60, 0, 0, -1\n70, 1, 0, -1\n80, 1, 1, -1\n90, 0, 1, -1\n100, 1, 1, 0\n"
    "** nodes end here\n"
    "*Element, Type=C3D4H, elset=\"Left part\"\n"
    "7, 10, 20, 30,\n 40\n"
    "*ELEMENT, TYPE=C3D4, ELSET=right\n"
    "3, 50, 30, 20, 40\n"
    "*ELEMENT, TYPE=C3D8R, ELSET=BRICK\n"
    "20, 60, 70, 80, 90, 10, 20, 100, 30\n"
    "*Element, type=SPRINGA, elset=springs\n"
    "99, 10, 60\n"
    "*Element, type=S3R, elset=skin\n"
    "15, 10, 40, 20\n"
    "*ELSET, ELSET=tets, GENERATE\n1, 7, 2\n"
    "** of sets\n"
    "*ELSET, elset=ALL\nTETS, brick, 99\n"
    "*NSET, NSET=some\n20, 10,\n100\n"
    "*NSET, NSET=more\nsome\n40,\n"
    "*ELSET, ELSET=_top, INTERNAL\n7\n"
    "*SURFACE, NAME=top, TYPE=ELEMENT\n_top, S2\n20, S1\n"
    "*Solid Section, elset=RIGHT,\n material=steel\n"
    "*Solid Section, elset=\"Left part\", material=steel\n"
    "*MATERIAL, NAME=steel\n*ELASTIC\n210000, 0.3\n"
    "*STEP\n*STATIC\n"
    "*BOUNDARY\nsome, 1, 3\n30, 2\n"
    "*DLOAD\n7, P1, 2.5\nALL, GRAV, 9.81, 0, 0, -1\n3, P4, 2.5\n"
    "** the end\n"
    "*END STEP\n";

const Group& group(const MeshData& mesh, int dimension, std::string_view name) {
  for (const Group& each : mesh.groups) {
    if (each.dimension == dimension && each.name == name) return each;
  }
  FAIL("no group " << name);
  return mesh.groups[0];
}

bool has_group(const MeshData& mesh, std::string_view name) {
  return std::any_of(mesh.groups.begin(), mesh.groups.end(),
                     [&](const Group& each) { return each.name == name; });
}

/// Numbers of the tets of a group.
std::vector<std::int64_t> numbers_of_tets(const MeshData& mesh, std::string_view name) {
  std::vector<std::int64_t> numbers;
  const std::vector<Label>& parts = group(mesh, 3, name).parts;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (std::find(parts.begin(), parts.end(), mesh.tet_parts[t]) != parts.end()) {
      numbers.push_back(mesh.tet_numbers[t]);
    }
  }
  return numbers;
}

std::vector<std::array<std::uint32_t, 3>> triangles_of_group(const MeshData& mesh,
                                                             const Group& of) {
  std::vector<std::array<std::uint32_t, 3>> found;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (std::find(of.parts.begin(), of.parts.end(), mesh.triangle_parts[i]) == of.parts.end()) {
      continue;
    }
    auto v = mesh.triangles[i].vertices;
    std::sort(v.begin(), v.end());
    found.push_back(v);
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Reads, writes and reads again.
MeshData round_trip(const TempFolder& folder, std::string_view text) {
  write_mesh(folder / "b.inp", read_as(folder, "a.inp", text));
  return read_mesh(folder / "b.inp");
}

/// Without the remarks, which have lines of the file.
std::vector<std::string> inp_deck_of(const MeshData& mesh) {
  std::vector<std::string> deck = mesh.deck;
  if (!deck.empty() && deck.back().starts_with('R')) deck.pop_back();
  return deck;
}

bool same_content(const MeshData& a, const MeshData& b) {
  return same_mesh(a, b) && a.tet_parts == b.tet_parts && a.triangle_parts == b.triangle_parts &&
         a.groups == b.groups && a.other_elements == b.other_elements &&
         a.point_numbers == b.point_numbers && a.tet_numbers == b.tet_numbers &&
         a.triangle_numbers == b.triangle_numbers && inp_deck_of(a) == inp_deck_of(b);
}

constexpr std::string_view kSmall =
    "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n"
    "*ELEMENT, TYPE=C3D4, ELSET=E\n1, 1, 2, 3, 4\n";

}  // namespace

TEST_CASE("a deck is read with sets, surfaces, loads and the numbers of nodes and elements") {
  const TempFolder folder;
  const MeshData mesh = read_as(folder, "a.inp", kDeck);
  CHECK(is_sound(mesh));
  CHECK(mesh.notes.empty());
  CHECK(mesh.points.size() == 10);
  CHECK(mesh.point_numbers[4] == 50);
  CHECK(mesh.tet_numbers == std::vector<std::int64_t>{7, 3});
  CHECK(mesh.tets[0] == MeshData::Tet{{0, 1, 2, 3}, 2});  // by the order of the sections
  CHECK(mesh.tets[1] == MeshData::Tet{{4, 2, 1, 3}, 1});
  REQUIRE(mesh.other_elements.size() == 1);
  CHECK(mesh.other_elements[0].vtk_type == 12);
  CHECK(mesh.other_elements[0].numbers == std::vector<std::int64_t>{20});
  CHECK(numbers_of_tets(mesh, "Left part") == std::vector<std::int64_t>{7});
  CHECK(numbers_of_tets(mesh, "tets") == std::vector<std::int64_t>{7, 3});
  CHECK(numbers_of_tets(mesh, "ALL") == std::vector<std::int64_t>{7, 3});
  CHECK(group(mesh, 0, "some").members == std::vector<std::uint32_t>{0, 1, 9});
  CHECK(group(mesh, 0, "more").members == std::vector<std::uint32_t>{0, 1, 3, 9});
  // The shell lies on face 2 of the tet 7, as seen from the other side.
  CHECK(triangles_of_group(mesh, group(mesh, 2, "top")) ==
        std::vector<std::array<std::uint32_t, 3>>{{0, 1, 3}});
  CHECK(triangles_of_group(mesh, group(mesh, 2, "DLOAD_2")) ==
        std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {1, 3, 4}});
  CHECK_FALSE(has_group(mesh, "_top"));
}

TEST_CASE("a deck that is written has its other lines word for word, and is read back the same") {
  const TempFolder folder;
  const MeshData mesh = read_as(folder, "a.inp", kDeck);
  CHECK(not_written(folder / "b.inp", mesh).empty());
  const MeshData again = round_trip(folder, kDeck);
  const std::string text = read_text(folder / "b.inp");
  for (const std::string_view part :
       {"** made by hand\n*Heading\n Two tets, 1, 2, 3\n\n*Node, NSET=Nall\n10, 0, 0, 0\n",
        "100, 1, 1, 0\n** nodes end here\n*Element, Type=C3D4H, elset=\"Left part\"\n7, 10, 20, "
        "30, 40\n"
        "*ELEMENT, TYPE=C3D4, ELSET=right\n3, 50, 30, 20, 40\n"
        "*ELEMENT, TYPE=C3D8R, ELSET=BRICK\n20, 60, 70, 80, 90, 10, 20, 100, 30\n"
        "*Element, type=SPRINGA, elset=springs\n99, 10, 60\n"
        "*Element, type=S3R, elset=skin\n15, 10, 40, 20\n*ELSET, ELSET=tets\n3, 7\n** of sets\n"
        "*ELSET, elset=ALL\n3, 7, 20\n99,\n*NSET, NSET=some\n10, 20, 100\n",
        "*SURFACE, NAME=top, TYPE=ELEMENT\n7, S2\n20, S1\n*Solid Section, elset=RIGHT,\n "
        "material=steel\n",
        "*STEP\n*STATIC\n*BOUNDARY\nsome, 1, 3\n30, 2\n*DLOAD\nALL, GRAV, 9.81, 0, 0, -1\n"
        "3, P4, 2.5\n7, P1, 2.5\n** the end\n*END STEP\n"}) {
    CHECK_MESSAGE(text.find(part) != std::string::npos, part << "\nin\n" << text);
  }
  CHECK(again.tets == mesh.tets);
  CHECK(again.tet_numbers == mesh.tet_numbers);
  CHECK(again.groups.size() == mesh.groups.size());
  write_mesh(folder / "c.inp", again);
  CHECK(read_text(folder / "c.inp") == text);
  CHECK(same_content(read_mesh(folder / "c.inp"), again));
}

TEST_CASE(
    "points that the deck names by number inside the mesh are required, those outside are not") {
  const TempFolder folder;
  write_mesh(folder / "cube.inp", kuhn_cube(4, 0, 1));
  const std::string cube = read_text(folder / "cube.inp");
  const MeshData plain = read_mesh(folder / "cube.inp");
  REQUIRE(plain.required_vertices.empty());
  const auto is_inside = [&](const Point& p) {
    return p.minCoeff() > plain.points[0].minCoeff() &&
           p.maxCoeff() < plain.points.back().maxCoeff();
  };
  std::size_t inner = 0;
  while (!is_inside(plain.points[inner])) ++inner;
  const auto number = plain.point_numbers[inner];
  const std::vector<std::uint32_t> expected = {static_cast<std::uint32_t>(inner)};
  const auto required = [&](std::string_view more) {
    return read_as(folder, "a.inp", cube + std::string(more)).required_vertices;
  };
  CHECK(required(fmt::format("*STEP\n*CLOAD\n{}, 3, 1.\n", number)) == expected);
  CHECK(required(fmt::format("*EQUATION\n2\n1, 1, 1., {}, 1, -1.\n", number)) == expected);
  CHECK(required(fmt::format("*RIGID BODY, NSET=A, REF NODE={}\n", number)) == expected);
  CHECK(required(fmt::format("*NSET, NSET=A\n1, {}\n", number)) == expected);
  CHECK(required(fmt::format("*ELASTIC\n{}, 0.3\n", number)).empty());
  CHECK(required(fmt::format("*CLOAD\n1, {}, 1.\n", number)).empty());
  CHECK(required("*CLOAD\n1, 3, 1.\n").empty());
  CHECK(required(fmt::format("*NSET, NSET=A, GENERATE\n1, {}, 1\n", plain.points.size())).empty());
  for (const std::string lines :
       {"*SURFACE, NAME=S, TYPE=NODE\n{0}, 1.\n",
        "*INITIAL CONDITIONS, TYPE=TEMPERATURE\n{0}, 20.\n",
        "*ORIENTATION, NAME=O, DEFINITION=NODES\n1, 2, {0}\n", "*MPC\nBEAM, 1, {0}\n",
        "*ELEMENT, TYPE=SPRINGA, ELSET=E\n90001, 1, {0}\n", "*NOT HEARD OF\n1., {0}\n",
        "*USER ELEMENT, TYPE=U1, NODES=4\n1, 2\n*ELEMENT, TYPE=U1\n90001, 1, 2,\n{0}, 3\n",
        "*USER ELEMENT, TYPE=U1, NODES=5\n1, 2\n*ELEMENT, TYPE=U1\n90001, 1, 2,\n 3, 4 ,\n{0}\n",
        "*EQUATION\n5\n1, 1, 1., 2, 1, 1., 3, 1, 1., 4, 1, 1.\n{0}, 1, 1.\n"}) {
    CAPTURE(lines);
    CHECK(required(fmt::format(fmt::runtime(lines), number)) == expected);
  }
  for (const std::string lines :
       {"*SURFACE, NAME=S\n{0}, S1\n", "*DLOAD\n{0}, P1, 1.\n", "*DSLOAD\nS, P, {0}\n",
        "*INITIAL CONDITIONS, TYPE=STRESS\n{0}, 1., 1., 1., 0., 0., 0.\n",
        "*TIME POINTS, NAME=T\n{0}, 2\n",
        "*USER ELEMENT, TYPE=U1, NODES=2\n1, 2\n*ELEMENT, TYPE=U1\n90001, 1, 2\n{0}, 3, 4\n",
        "*AMPLITUDE, NAME=A\n{0}, 1, 2, {0}\n", "*ORIENTATION, NAME=O\n1, 0, 0, 0, 1, 0\n3, {0}\n",
        "*SPRING, ELSET=E\n{0}\n1.\n", "*EQUATION\n2\n1, {0}, 1., 2, {0}, -1\n",
        "*COUPLING, CONSTRAINT NAME=C\n*KINEMATIC\n{0}, 3\n",
        "*STEP\n*STATIC\n1, {0}\n*NODE PRINT, NSET=N\nU\n*END STEP\n"}) {
    CAPTURE(lines);
    CHECK(required(fmt::format(fmt::runtime(lines), number)).empty());
  }
}

TEST_CASE(
    "a deck says which of its lines keep how many points, and of unknown ones that they are") {
  const TempFolder folder;
  write_mesh(folder / "cube.inp", kuhn_cube(4, 0, 1));
  const std::string cube = read_text(folder / "cube.inp");
  const auto line = 1 + std::count(cube.begin(), cube.end(), '\n');
  CHECK(deck_remarks(read_mesh(folder / "cube.inp")).empty());
  const MeshData mesh = read_as(folder, "a.inp",
                                cube +
                                    "*CLOAD\n32, 1, 1.\n33, 1, 1.\n*CLOAD\n1, 1, 1.\n*UNHEARD\n32\n"
                                    "*NSET, NSET=\"pair\"\n34, 37\n");
  const std::string file = (folder / "a.inp").string();
  CHECK(deck_remarks(mesh) ==
        std::vector<std::string>{
            fmt::format("{}:{}: *CLOAD keeps 2 points where they are", file, line),
            fmt::format("{}:{}: *UNHEARD, whose fields are not known, keeps 1 point where it is",
                        file, line + 5),
            fmt::format("{}:{}: the set of nodes 'pair' keeps 2 points where they are", file,
                        line + 7)});
}

TEST_CASE("a deck of tetmend's own, with surfaces and walls, comes back with no point required") {
  const TempFolder folder;
  MeshData mesh = kuhn_cube(4, 0, 1);
  for (MeshData::Tet& tet : mesh.tets) {
    const Point& p = mesh.points[tet.vertices[0]] + mesh.points[tet.vertices[1]] +
                     mesh.points[tet.vertices[2]] + mesh.points[tet.vertices[3]];
    tet.label = p.x() > 2 ? 2 : 1;
  }
  mesh.triangles.push_back(
      {{mesh.tets[9].vertices[0], mesh.tets[9].vertices[1], mesh.tets[9].vertices[2]}, 5});
  write_mesh(folder / "a.inp", mesh);
  CHECK(read_mesh(folder / "a.inp").required_vertices.empty());
}

TEST_CASE("an improved deck keeps numbers, sets, surfaces and lines of what has survived") {
  const TempFolder folder;
  MeshData cube = kuhn_cube(6, 0.35, 5);
  for (auto& tet : cube.tets) {
    Point centre(0, 0, 0);
    for (const auto v : tet.vertices) centre += cube.points[v] / 4;
    tet.label = centre.x() < cube.points.back().x() / 2 ? 1 : 2;
  }
  write_mesh(folder / "cube.inp", cube);
  std::string text = read_text(folder / "cube.inp");
  const MeshData first = read_mesh(folder / "cube.inp");
  text = replaced(text, "*ELEMENT, TYPE=C3D4, ELSET=Label_1", "*ELEMENT, TYPE=C3D4T, ELSET=Soft");
  text = replaced(text, "*ELEMENT, TYPE=C3D4, ELSET=Label_2", "*ELEMENT, TYPE=C3D4, ELSET=Hard");
  const double low = first.points[0].x();
  std::string surface = "*SURFACE, NAME=side\n";
  std::size_t faces = 0;
  for (std::size_t t = 0; t < first.tets.size(); ++t) {
    for (std::size_t f = 0; f < 4; ++f) {
      const auto& corners = formats::kInpTetFaces[f];
      if (std::all_of(corners.begin(), corners.end(), [&](std::size_t k) {
            return first.points[first.tets[t].vertices[k]].x() == low;
          })) {
        surface += fmt::format("{}, S{}\n", first.tet_numbers[t], f + 1);
        ++faces;
      }
    }
  }
  REQUIRE(faces > 10);
  constexpr std::string_view kEnd =
      "*SOLID SECTION, ELSET=hard, MATERIAL=M\n*STEP\n*BOUNDARY\n1, 1, 3\n** done\n*END STEP\n";
  write_text(folder / "a.inp", text + surface + std::string(kEnd));

  const MeshData before = read_mesh(folder / "a.inp");
  Mesh mesh = load(folder / "a.inp");
  const Result result = improve(mesh, {});
  CHECK(result.after.n_bad < result.before.n_bad);
  save(folder / "b.inp", mesh);
  const MeshData after = read_mesh(folder / "b.inp");
  const std::string written = read_text(folder / "b.inp");
  CHECK(written.ends_with(kEnd));
  CHECK(written.find("*ELEMENT, TYPE=C3D4T, ELSET=Soft\n") != std::string::npos);
  CHECK(triangles_of_group(after, group(after, 2, "side")).size() == faces);
  CHECK(after.triangles.size() == before.triangles.size());
  // A number means the same tet, or is new.
  const std::int64_t most = *std::max_element(before.tet_numbers.begin(), before.tet_numbers.end());
  std::size_t survivors = 0;
  for (std::size_t t = 0; t < after.tets.size(); ++t) {
    if (after.tet_numbers[t] > most) continue;
    const auto at =
        std::find(before.tet_numbers.begin(), before.tet_numbers.end(), after.tet_numbers[t]);
    REQUIRE(at != before.tet_numbers.end());
    survivors += after.tets[t].label ==
                 before.tets[static_cast<std::size_t>(at - before.tet_numbers.begin())].label;
  }
  CHECK(survivors > 0);
  CHECK(survivors < after.tets.size());
  const auto volume = [](const MeshData& of, Label label) {
    double sum = 0;
    for (const auto& tet : of.tets) {
      const auto p = [&](std::size_t k) { return of.points[tet.vertices[k]]; };
      if (tet.label == label) sum += (p(1) - p(0)).cross(p(2) - p(0)).dot(p(3) - p(0));
    }
    return sum;
  };
  for (const Label label : {0, 1}) {
    CHECK(volume(after, label) == doctest::Approx(volume(before, label)).epsilon(1e-9));
  }
  // Every face of the surface is the face of its tet that lies on the side.
  for (const auto& triangle : triangles_of_group(after, group(after, 2, "side"))) {
    for (const auto v : triangle) CHECK(after.points[v].x() == low);
  }
}

TEST_CASE("elements of second order come back with their type, in two lines or in one") {
  const TempFolder folder;
  std::string text = "*NODE\n";
  for (int i = 1; i <= 10; ++i) text += fmt::format("{}, {}, {}, {}\n", i, i * i, i % 3, i % 4);
  text += "*ELEMENT, TYPE=C3D10M, ELSET=A\n5, 1, 2, 3, 4, 5, 6, 7,\n8, 9, 10\n";
  text += "*ELEMENT, TYPE=T3D3, ELSET=B\n6, 1, 5, 2\n*SURFACE, NAME=S\nA, S3\n";
  const MeshData mesh = read_as(folder, "a.inp", text);
  CHECK(mesh.tets.size() == 1);
  CHECK(mesh.mid_nodes.size() == 6);
  REQUIRE(mesh.edges.size() == 1);
  CHECK(mesh.edges[0].vertices == std::array<std::uint32_t, 2>{0, 1});
  CHECK(mesh.triangles.size() == 1);
  round_trip(folder, text);
  const std::string written = read_text(folder / "b.inp");
  CHECK(written.find("*ELEMENT, TYPE=C3D10M, ELSET=A\n5, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10\n"
                     "*ELEMENT, TYPE=T3D3, ELSET=B\n6, 1, 5, 2\n*SURFACE, NAME=S\n5, S3\n") !=
        std::string::npos);
}

TEST_CASE("a set whose name begins like that of a label is none") {
  const TempFolder folder;
  for (const char* name : {"Label_3_inlet", "Label_3\xff", "Label_03", "Label_"}) {
    CAPTURE(name);
    write_text(folder / "a.inp", replaced(kSmall, "ELSET=E", "ELSET=" + std::string(name)));
    const MeshData data = read_mesh(folder / "a.inp");
    CHECK(data.tets.at(0).label != 3);
  }
}

TEST_CASE("a comment under a set of nothing stays there, however often the deck is written") {
  const TempFolder folder;
  write_mesh(folder / "b.inp", read_as(folder, "a.inp",
                                       "*NODE\n1, 0, 0, 0\n*NSET, NSET=none\n"
                                       "*NSET, NSET=nor\n** here\n*NSET, NSET=one\n"
                                       "** above\n1\n"));
  const std::string once = read_text(folder / "b.inp");
  CHECK(once.find("NSET=nor\n** here\n** above\n*NSET, NSET=one\n") != once.npos);
  write_mesh(folder / "c.inp", read_mesh(folder / "b.inp"));
  CHECK(read_text(folder / "c.inp") == once);
}

TEST_CASE("data never become parameters of a keyword whose line ended with a comma") {
  const TempFolder folder;
  const MeshData mesh =
      read_as(folder, "a.inp",
              "*NODE, \"a,\n*X\n*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, 1, 1, 1\n"
              "*ELEMENT, TYPE=C3D4,\n*X\n*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n2, 2, 3, 4, 5\n");
  REQUIRE(mesh.tets.size() == 2);
  write_mesh(folder / "b.inp", mesh);
  const MeshData again = read_mesh(folder / "b.inp");
  CHECK(same_points(again, mesh));
  CHECK(again.tets.size() == 2);
}

TEST_CASE("types of elements have the nodes that their names say") {
  const auto type = [](std::string_view name) { return formats::inp_type(name); };
  CHECK(type("c3d4").vtk_type == 10);
  CHECK(type("C3D10MH").vtk_type == 24);
  CHECK(type("C3D20RI").vtk_type == 25);
  CHECK(type("STRI65").vtk_type == 22);
  CHECK(type("STRI3").vtk_type == 5);
  CHECK(type("S8R5").vtk_type == 23);
  CHECK(type("B31OS").vtk_type == 3);
  CHECK(type("B32R").vtk_type == 21);
  CHECK(type("SPRINGA").kind == formats::InpType::Kind::other);
  CHECK(type("MASS").kind == formats::InpType::Kind::other);
  CHECK(type("C3D27").kind == formats::InpType::Kind::refused);
  CHECK(type("C3D15V").kind == formats::InpType::Kind::refused);
  for (const int vtk_type : {3, 5, 9, 10, 12, 13, 14, 21, 22, 23, 24, 25, 26}) {
    CHECK(type(formats::inp_type_name(vtk_type)).vtk_type == vtk_type);
  }
}

TEST_CASE("a mesh of another format becomes a deck with sets, surfaces and sets of their nodes") {
  const TempFolder folder;
  MeshData mesh = kuhn_cube(1, 0, 1);
  mesh.tets[0].label = 4;
  for (std::size_t t = 1; t < mesh.tets.size(); ++t) mesh.tets[t].label = 9;
  mesh.groups = {{3, 4, "left steel", {}, {}}, {2, 7, "inlet", {}, {}}, {0, 1, "corner", {}, {0}}};
  const auto& v = mesh.tets[0].vertices;
  mesh.triangles = {{{v[0], v[1], v[2]}, 7}, {{v[1], v[2], v[3]}, 0}};
  mesh.edges = {{{0, 1}, 0}};
  mesh.required_vertices = {1};
  mesh.point_labels.assign(mesh.points.size(), 0);
  mesh.point_labels[2] = -3;
  const auto notes = not_written(folder / "a.inp", mesh);
  REQUIRE(notes.size() == 2);
  CHECK(notes[0].find("the first is 'left steel'") != std::string::npos);
  CHECK(notes[1] == "1 edges, and groups of them, are kept as sets of their points only");
  write_mesh(folder / "a.inp", mesh);
  const std::string text = read_text(folder / "a.inp");
  for (const std::string_view part :
       {"*ELEMENT, TYPE=C3D4, ELSET=left_steel\n1, ", "*ELEMENT, TYPE=C3D4, ELSET=Label_9\n2, ",
        "*SURFACE, TYPE=ELEMENT, NAME=inlet\n1, S", "*NSET, NSET=inlet\n",
        "*NSET, NSET=corner\n1,\n", "*SURFACE, TYPE=ELEMENT, NAME=Label_0\n", "*NSET, NSET=Edges_0",
        "*NSET, NSET=Label_m3\n3,\n", "*NSET, NSET=RequiredVertices\n2,\n"}) {
    CHECK_MESSAGE(text.find(part) != std::string::npos, part << "\nin\n" << text);
  }
  const MeshData again = read_mesh(folder / "a.inp");
  CHECK(same_points(again, mesh));
  CHECK(again.point_labels == mesh.point_labels);
  CHECK(again.triangles.size() == 2);
  CHECK(again.required_vertices == mesh.required_vertices);
  CHECK(std::count_if(again.tets.begin(), again.tets.end(), [](const auto& tet) {
          return tet.label == 9;
        }) == static_cast<std::ptrdiff_t>(mesh.tets.size() - 1));
  write_mesh(folder / "b.inp", again);
  CHECK(test::read_text(folder / "b.inp") == text);
}

TEST_CASE("coordinates have room in 20 characters, where solvers stop reading") {
  const TempFolder folder;
  MeshData mesh;
  mesh.points = {{6.123233995736766e-17, 0.1, -1.2345678901234567e-05},
                 {1.7976931348623157e308, -2.2250738585072014e-308, 1},
                 {0, 1, 0},
                 {-0.0, 1.0 / 3, 5e-324}};
  mesh.tets = {{{0, 1, 2, 3}, 0}};
  write_mesh(folder / "a.inp", mesh);
  const std::string text = read_text(folder / "a.inp");
  std::size_t longest = 0;
  std::size_t begin = text.find("*NODE\n") + 6;
  for (std::size_t i = begin; i < text.find("*ELEMENT"); ++i) {
    if (text[i] == ',' || text[i] == '\n') {
      longest = std::max(longest, i - begin);
      begin = i + 2;
    }
  }
  CHECK(longest <= 20);
  const MeshData again = read_mesh(folder / "a.inp");
  for (std::size_t i = 0; i < 4; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double was = mesh.points[i][axis];
      CHECK(std::abs(again.points[i][axis] - was) <= 1e-13 * std::abs(was));
    }
  }
  CHECK(again.points[0].x() == mesh.points[0].x());
  CHECK(again.points[3] == mesh.points[3]);
  const auto notes = not_written(folder / "a.inp", mesh);
  REQUIRE(notes.size() == 1);
  CHECK(
      notes[0].ends_with("coordinates are rounded to 20 characters, which is what Abaqus and "
                         "CalculiX read"));
}

TEST_CASE("included files with a mesh are written into the deck, the others stay") {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "sub");
  write_text(folder / "sub/mesh.inc", replaced(kSmall, "*ELEMENT", "** from the file\n*ELEMENT"));
  write_text(folder / "steel.inc", "*MATERIAL, NAME=steel\n*ELASTIC\n1., 0.\n");
  const std::string text =
      "*HEADING\nx\n*INCLUDE, INPUT=sub/mesh.inc\n*INCLUDE, input=steel.inc\n*STEP\n";
  const MeshData mesh = read_as(folder, "a.inp", text);
  CHECK(mesh.tets.size() == 1);
  CHECK(not_written(folder / "b.inp", mesh).empty());
  const auto notes = not_written(folder / "sub/b.inp", mesh);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].find("*INCLUDE stay in") != std::string::npos);
  round_trip(folder, text);
  CHECK(read_text(folder / "b.inp") ==
        "*HEADING\nx\n*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n** from the file\n"
        "*ELEMENT, TYPE=C3D4, ELSET=E\n1, 1, 2, 3, 4\n*INCLUDE, input=steel.inc\n*STEP\n");
  write_text(folder / "steel.inc", "*INCLUDE, INPUT=a.inp\n");
  CHECK(error_of_reading(folder / "a.inp") ==
        "steel.inc:1: 'a.inp' includes itself: expected another file");
  std::filesystem::remove(folder / "steel.inc");
  CHECK(error_of_reading(folder / "a.inp").starts_with("a.inp:4: "));
}

TEST_CASE("a deck of one part and instance keeps what is in its assembly") {
  const TempFolder folder;
  const std::string text =
      "*Part, name=P\n" + std::string(kSmall) +
      "*End Part\n*Assembly, name=A\n*Instance, name=P-1, part=P\n1, 2, 3\n*End Instance\n"
      "*Node\n1, 5, 5, 5\n*Nset, nset=ref\n1,\n*Nset, nset=E, instance=P-1\n1, 2\n"
      "*Elset, elset=_s_S1, internal, instance=P-1\n1,\n*Surface, type=ELEMENT, name=s\n_s_S1, S1\n"
      "*End Assembly\n*Boundary\nP-1.3, 1\n";
  const MeshData mesh = read_as(folder, "a.inp", text);
  CHECK(mesh.points.size() == 4);
  CHECK(group(mesh, 0, "E").members == std::vector<std::uint32_t>{0, 1});
  round_trip(folder, text);
  std::string expected = replaced(text, "*Elset, elset=_s_S1, internal, instance=P-1\n1,\n", "");
  expected = replaced(expected, "_s_S1, S1\n", "P-1.1, S1\n");
  CHECK(test::read_text(folder / "b.inp") == expected);
}

TEST_CASE("an *ELEMENT without rows stays in the deck, where its part counts as the mesh") {
  const TempFolder folder;
  for (const std::string& deck :
       {"*PART, NAME=A\n*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=C3D4, ELSET=E, 1, 2, 3, 4\n** cut\n*END "
        "PART\n*PART, NAME=B\n" +
            std::string(kSmall) + "*END PART\n",
        std::string(kSmall) + "*ELEMENT, TYPE=C3D4, ELSET=F\n"}) {
    CAPTURE(deck);
    const MeshData mesh = read_as(folder, "a.inp", deck);
    CHECK(mesh.tets.size() == 1);
    write_mesh(folder / "b.inp", mesh);
    const std::string text = test::read_text(folder / "b.inp");
    CHECK(text.find(deck.find("ELSET=F") == std::string::npos
                        ? "*ELEMENT, TYPE=C3D4, ELSET=E, 1, 2, 3, 4\n** cut\n"
                        : "*ELEMENT, TYPE=C3D4, ELSET=F\n") != std::string::npos);
    write_mesh(folder / "c.inp", read_mesh(folder / "b.inp"));
    CHECK(test::read_text(folder / "c.inp") == text);
  }
}

TEST_CASE("what a deck says of tets by number and is not a face is noted") {
  const TempFolder folder;
  const MeshData mesh =
      read_as(folder, "a.inp", std::string(kSmall) + "*DLOAD\n1, GRAV, 9.81, 0, 0, 1\n");
  REQUIRE(mesh.notes.size() == 1);
  CHECK(mesh.notes[0].ends_with(
      "a.inp:9 of *DLOAD names the tet 1: an improved mesh may not have it"));
  const MeshData dropped = read_as(
      folder, "a.inp", std::string(kSmall) + "*ELSET, ELSET=T\n1\n*SURFACE, NAME=S\nT, S1\n");
  REQUIRE(dropped.notes.size() == 1);
  CHECK(dropped.notes[0].starts_with("the set of elements 'T' is not kept"));
  CHECK(not_written(folder / "a.vtk", dropped).back() ==
        "4 pieces of a deck, all that is no mesh, are not kept: .vtk has no place for them");
}

TEST_CASE("where a deck has the greatest number there is, new ones are those that are free") {
  const TempFolder folder;
  for (const std::string greatest : {"9007199254740992", "2147483647", "999999999"}) {
    CAPTURE(greatest);
    std::string deck = replaced(kSmall, "4, 0, 0, 1", greatest + ", 0, 0, 1");
    deck = replaced(deck, "1, 1, 2, 3, 4", greatest + ", 1, 2, 3, " + greatest);
    MeshData mesh = read_as(folder, "a.inp", deck + "*ELEMENT, TYPE=SPRINGA\n1, 1, 2\n");
    mesh.points.emplace_back(1, 2, 3);
    mesh.point_numbers.push_back(0);
    mesh.tets.push_back({{0, 1, 2, 4}, mesh.tets[0].label});
    mesh.tet_parts.push_back(mesh.tet_parts[0]);
    mesh.tet_numbers.push_back(0);
    write_mesh(folder / "b.inp", mesh);
    const MeshData again = read_mesh(folder / "b.inp");
    CHECK(again.point_numbers.back() == 4);
    CHECK(again.tet_numbers.back() == 3);  // 1 and 2 stand in the line of the spring
    CHECK(again.tets == mesh.tets);
  }
}

TEST_CASE("a deck whose sets hold hundreds of times its size is refused, wherever they are named") {
  const TempFolder folder;
  constexpr int kMany = 3000;
  std::string nodes = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n";
  std::string tets = "*ELEMENT, TYPE=C3D4, ELSET=ALL\n";
  for (int i = 1; i <= kMany; ++i) {
    nodes += fmt::format("{}, 0, 0, {}\n", i + 4, i + 1);
    tets += fmt::format("{}, 1, 2, 3, {}\n", i, i + 3);
  }
  const auto many = [&](std::string_view line, int times) {
    std::string lines = nodes + tets;
    for (int i = 0; i < times; ++i) lines += fmt::format(fmt::runtime(line), i);
    return lines;
  };
  write_text(folder / "a.inp", many("*NSET, NSET=N{}, GENERATE\n1, 3004, 1\n", 100));
  CHECK(error_of_reading(folder / "a.inp") == "no error");
  for (const std::string_view line :
       {"*NSET, NSET=N{}, GENERATE\n1, 3004, 1\n", "*ELSET, ELSET=E{}, GENERATE\n1, 3000, 1\n",
        "*ELSET, ELSET=E{}\nALL\n", "*NSET, NSET=N{}, ELSET=ALL\n", "*SURFACE, NAME=S{}\nALL, S1\n",
        "*NSET, NSET=N, GENERATE\n1, 3004, 1\n", "*ELSET, ELSET=E\nALL, ALL, ALL, ALL, ALL\n",
        "*NSET, NSET=N, GENERATE\n2, 3004, 2\n"}) {
    CAPTURE(line);
    write_text(folder / "a.inp", many(line, 8000));
    CHECK(error_of_reading(folder / "a.inp").find("hundreds of times the size of the deck") !=
          std::string::npos);
  }
}

TEST_CASE("a file that a deck includes again and again counts once") {
  const TempFolder folder;
  write_text(folder / "big.inc", "** " + std::string(std::size_t{1} << 16, 'x') + "\n");
  std::string deck(kSmall);
  for (int i = 0; i < 100; ++i) deck += "*INCLUDE, INPUT=big.inc\n";
  write_text(folder / "a.inp", deck);
  CHECK(read_mesh(folder / "a.inp").tets.size() == 1);
  for (int i = 0; i < 400; ++i) deck += "*INCLUDE, INPUT=big.inc\n";
  write_text(folder / "a.inp", deck);
  CHECK(error_of_reading(folder / "a.inp").find("again and again") != std::string::npos);
}

TEST_CASE("bad decks are refused with line, word and what was expected") {
  const TempFolder folder;
  const auto with = [](std::string_view more) { return std::string(kSmall) + std::string(more); };
  const std::vector<BadFile> bad = {
      {"empty", "", ":1", "the file is empty"},
      {"no nodes", "*HEADING\nx\n", ":1", "*NODE is missing"},
      {"text in a number", replaced(kSmall, "2, 1, 0, 0", "2, 1x, 0, 0"), ":3",
       "'1x' is not a number"},
      {"not finite", replaced(kSmall, "2, 1, 0, 0", "2, 1, nan, 0"), ":3", "'nan'"},
      {"node twice", replaced(kSmall, "2, 1, 0, 0", "3, 1, 0, 0"), ":4", "the node '3' appears"},
      {"element twice", with("1, 1, 2, 3, 4\n"), ":8", "the element '1' appears"},
      {"node 0", replaced(kSmall, "2, 1, 0, 0", "0, 1, 0, 0"), ":3", "'0' is out of range"},
      {"element 0", with("0, 1, 2, 3, 4\n"), ":8",
       "'0' is out of range: expected the number of an"},
      {"vertex missing", replaced(kSmall, "1, 1, 2, 3, 4", "1, 1, 2, 3, 5"), ":7",
       "'5' is not the number of a node"},
      {"too few", replaced(kSmall, "1, 1, 2, 3, 4\n", "1, 1, 2, 3\n"), "", "the data lines end"},
      {"too many", replaced(kSmall, "1, 1, 2, 3, 4\n", "1, 1, 2, 3, 4, 5\n"), ":7",
       "'5' is too much"},
      {"cut", std::string(kSmall.substr(0, kSmall.size() - 1)), ":7", "the file seems truncated"},
      {"no type", replaced(kSmall, "TYPE=C3D4, ", ""), ":6", "names no type"},
      {"volume lost", replaced(kSmall, "C3D4", "C3D27"), ":6", "'C3D27' cannot be kept"},
      {"generator", with("*NGEN\n1, 2, 1\n"), ":8", "'*NGEN' cannot be read"},
      {"other system", replaced(kSmall, "*NODE", "*NODE, SYSTEM=C"), ":1", "SYSTEM=R"},
      {"instance twice",
       with("*ASSEMBLY\n*INSTANCE, NAME=A, PART=B\n*END INSTANCE\n*INSTANCE, NAME=a, PART=C\n"),
       ":11", "there is an instance 'a' already"},
      {"part twice", with("*PART, NAME=A\n*END PART\n*PART, NAME=A\n"), "",
       "there is a part 'A' already"},
      {"unknown set", with("*NSET, NSET=A\nB\n"), ":9", "'B' is neither a number nor the name"},
      {"unknown node", with("*NSET, NSET=A\n1, 77\n"), ":9", "'77' is not the number of a node"},
      {"set without name", with("*ELSET\n1\n"), ":8", "*ELSET has no name"},
      {"range backwards", with("*NSET, NSET=A, GENERATE\n4, 1, 1\n"), ":9", "'1' is not the last"},
      {"range without step", with("*NSET, NSET=A, GENERATE\n1, 4, 0\n"), ":9", "'0' is no step"},
      {"surface twice", with("*SURFACE, NAME=A\n1, S1\n*SURFACE, NAME=a\n1, S2\n"), ":10",
       "there is a surface 'a' already"},
      {"include without file", with("*INCLUDE\n"), ":8", "*INCLUDE names no file"},
      {"include missing", with("*INCLUDE, INPUT=no.inc\n"), ":8", "No such file"},
  };
  for (const BadFile& file : bad) {
    CAPTURE(file.what);
    write_text(folder / "a.inp", file.content);
    const std::string error = error_of_reading(folder / "a.inp");
    CHECK_MESSAGE(error.starts_with("a.inp" + file.place), error);
    CHECK_MESSAGE(error.find(file.reason) != std::string::npos, error);
  }
}

namespace {

constexpr std::string_view kNodes = "*Node\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n";
constexpr std::string_view kElements = "*Element, type=C3D4\n1, 1, 2, 3, 4\n";
constexpr std::string_view kSection = "*Solid Section, elset=Set-1, material=m\n,\n";

std::string part(std::string_view name, std::string_view content) {
  return fmt::format("*Part, name={}\n{}*End Part\n", name, content);
}
std::string instance(std::string_view name, std::string_view of, std::string_view content = {}) {
  return fmt::format("*Instance, name={}, part={}\n{}*End Instance\n", name, of, content);
}

}  // namespace

TEST_CASE("a mesh that stands in the instance is read, and written where it stood") {
  const TempFolder folder;
  const std::string deck =
      "*Heading\n" + part("P", "") + "*Assembly, name=A\n" +
      instance("P-1", "P",
               "3., 0., 0.\n3., 0., 0., 3., 0., 1., 90.\n" + std::string(kNodes) +
                   std::string(kElements) + "*Elset, elset=Set-1\n1,\n" + std::string(kSection)) +
      "*Nset, nset=Fix, instance=P-1\n1, 2\n*End Assembly\n*Boundary\nFix, 1, 3\nP-1.4, 1\n";
  const MeshData mesh = read_as(folder, "a.inp", deck);
  CHECK(mesh.points.size() == 4);
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 1}});
  CHECK(group(mesh, 0, "Fix").members == std::vector<std::uint32_t>{0, 1});
  write_mesh(folder / "b.inp", mesh);
  CHECK(test::read_text(folder / "b.inp") == deck);
}

TEST_CASE("parts without tets come back word for word beside the mesh") {
  const TempFolder folder;
  const std::string rest =
      part("Rigid",
           "*Node\n  1,  1.,  2.,  3.\n  2, 5., 5., 5.\n*Nset, nset=RefPt_\n1,\n"
           "*Surface, type=CYLINDER, name=s\nSTART, 1., 0.\nLINE, 1., 5.\n") +
      part("Shell",
           "*Node\n1, 0., 0., 9.\n2, 1., 0., 9.\n3, 0., 1., 9., 0., 0., 1.\n"
           "*Element, type=S3\n1, 1, 2, 3\n*Elset, elset=Set-1\n 1,\n"
           "*Shell Section, elset=Set-1, material=m\n0.1, 5\n*Elset, elset=e, generate\n"
           " 1, 1, 1\n*Surface, type=ELEMENT, name=outside\nSet-1, SPOS\n");
  const std::string assembly =
      "*Assembly, name=A\n" + instance("P-1", "P") + instance("R-1", "Rigid", "0., 0., 1.\n") +
      instance("S-1", "Shell") + instance("Point-1", "Point", "*Node\n1, 1., 1., 3.\n") +
      "*Nset, nset=both, instance=P-1\n1,\n*Nset, nset=both, instance=S-1\n 2,\n"
      "*Elset, elset=there, instance=S-1\n 1,\n*Surface, type=ELEMENT, name=other\nthere, SPOS\n"
      "*Rigid Body, ref node=Point-1.1, elset=R-1.x\n*End Assembly\n*Boundary\nS-1.3, 1\n";
  const std::string mesh_part = part("P", std::string(kNodes) + std::string(kElements) +
                                              "*Elset, elset=Set-1\n1,\n" + std::string(kSection));
  for (const std::string& deck : {rest + mesh_part + part("Point", "") + assembly,
                                  mesh_part + part("Point", "") + rest + assembly}) {
    const MeshData mesh = read_as(folder, "a.inp", deck);
    CHECK(mesh.points.size() == 4);
    CHECK(mesh.tets.size() == 1);
    CHECK(mesh.required_vertices.empty());
    CHECK(mesh.notes == std::vector<std::string>{
                            "'SHELL' has no tetrahedra: it stays in the deck, and is in no mesh"});
    write_mesh(folder / "b.inp", mesh);
    CHECK(test::read_text(folder / "b.inp") == deck);
  }
}

TEST_CASE("several parts have numbers and sets of their own, and so have their new tets") {
  const TempFolder folder;
  const std::string content = std::string(kNodes) + std::string(kElements) +
                              "*Elset, elset=Set-1\n1,\n*Nset, nset=n\n2, 3\n" +
                              std::string(kSection);
  const std::string deck =
      part("P", content) +
      part("Q", replaced(content, "\n4, 0, 0, 1\n", "\n9, 0, 0, 1\n5, 1, 1, 1\n")) +
      "*Assembly, name=A\n" + instance("P-1", "P") + instance("Q-1", "Q", "3., 0., 0.\n") +
      "*Nset, nset=hold, instance=P-1\n1, 4\n*Nset, nset=hold, instance=Q-1\n2, 5\n*End Assembly\n";
  const std::string fixed = [&] {
    std::string text = deck;
    const std::size_t second = text.find("*Element", text.find("name=Q"));
    return text.replace(text.find("1, 1, 2, 3, 4", second), 13, "1, 1, 2, 3, 9");
  }();
  MeshData mesh = read_as(folder, "a.inp", fixed);
  CHECK(mesh.points.size() == 9);
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 1}, {{4, 5, 6, 7}, 2}});
  write_mesh(folder / "b.inp", mesh);
  CHECK(test::read_text(folder / "b.inp") == fixed);
  // A point and a tet more in the second part, and a tet in the first.
  mesh.points.emplace_back(2, 2, 2);
  mesh.point_numbers.push_back(0);
  mesh.tets.push_back({{5, 6, 7, 9}, 2});
  mesh.tet_parts.push_back(mesh.tet_parts[1]);
  mesh.tet_numbers.push_back(0);
  mesh.tets.push_back({{1, 2, 3, 0}, 1});
  mesh.tet_parts.push_back(mesh.tet_parts[0]);
  mesh.tet_numbers.push_back(0);
  write_mesh(folder / "c.inp", mesh);
  const std::string written = read_text(folder / "c.inp");
  CHECK(written.find("1, 1, 2, 3, 4\n2, 2, 3, 4, 1\n*Elset") != std::string::npos);
  CHECK(written.find("10, 2, 2, 2\n*Element") != std::string::npos);
  CHECK(written.find("1, 1, 2, 3, 9\n2, 2, 3, 9, 10\n*Elset") != std::string::npos);
}

TEST_CASE("numbers of one part mean nothing in another, however they follow each other") {
  const TempFolder folder;
  const std::string other =
      std::string(kNodes) + std::string(kElements) + "*Elset, elset=Set-1, generate\n1, 1, 1\n";
  const auto deck = [&](std::string_view first, std::string_view second) {
    return part("P", first) + part("Q", second) + "*Assembly, name=A\n" + instance("P-1", "P") +
           instance("Q-1", "Q") + "*End Assembly\n";
  };
  const auto error = [&](std::string_view first, std::string_view second) {
    write_text(folder / "a.inp", deck(first, second));
    return error_of_reading(folder / "a.inp");
  };
  CHECK(error(other, replaced(other, "1, 1, 2, 3, 4", "1, 0, 2, 3, 4"))
            .find("'0' is not the number of a node: expected one of *NODE of 'Q'") !=
        std::string::npos);
  CHECK(error(replaced(other, "1, 1, 2, 3, 4", "1, 1, 2, 3, 5"), other).find("'5' is not") !=
        std::string::npos);
  // A part whose nodes are missing.
  CHECK(error(kElements, other).find("'1' is not the number of a node") != std::string::npos);
  // A range ends where the numbers of its part do.
  const MeshData mesh = read_as(
      folder, "a.inp", deck(other, replaced(other, "generate\n1, 1, 1", "generate\n0, 2, 1")));
  REQUIRE(mesh.notes.size() == 1);
  CHECK(mesh.notes[0].ends_with("ends with 2, but the greatest number of an element is 1"));
  write_mesh(folder / "b.inp", mesh);
  const std::string written = test::read_text(folder / "b.inp");
  const std::size_t first = written.find("elset=Set-1\n1,\n");
  REQUIRE(first != std::string::npos);
  CHECK(written.find("elset=Set-1\n1,\n", first + 1) != std::string::npos);
}

TEST_CASE(
    "a part that is used twice is in the mesh once, and surfaces say which instance they are of") {
  const TempFolder folder;
  const std::string assembly = "*Assembly, name=A\n" + instance("P-1", "P") +
                               instance("P-2", "P", "0., 0., -1.\n") +
                               "*Elset, elset=_top_S1, internal, instance=P-2\n1,\n"
                               "*Elset, elset=_bottom_S1, internal, instance=P-1\n1,\n"
                               "*Elset, elset=_both_S2, internal, instance=P-1\n1,\n"
                               "*Elset, elset=_both_S2, internal, instance=P-2\n1,\n"
                               "*Elset, elset=keep, instance=P-2\n1,\n"
                               "*Surface, type=ELEMENT, name=top\n_top_S1, S1\n"
                               "*Surface, type=ELEMENT, name=bottom\n_bottom_S1, S1\n"
                               "*Surface, type=ELEMENT, name=both\n_both_S2, S2\n"
                               "*Tie, name=t\ntop, bottom\n*End Assembly\n";
  const std::string deck =
      part("P", std::string(kNodes) + std::string(kElements) + "*Elset, elset=Set-1\n1,\n" +
                    std::string(kSection)) +
      assembly + "*Output, field\n*Element Output, elset=keep\nS,\n*Dsload\nP-2.none, P, 1.\n";
  const MeshData mesh = read_as(folder, "a.inp", deck);
  CHECK(mesh.tets.size() == 1);
  CHECK(mesh.triangles.size() == 2);
  write_mesh(folder / "b.inp", mesh);
  std::string expected = deck;
  for (const char* line : {"*Elset, elset=_top_S1, internal, instance=P-2\n1,\n",
                           "*Elset, elset=_bottom_S1, internal, instance=P-1\n1,\n",
                           "*Elset, elset=_both_S2, internal, instance=P-1\n1,\n",
                           "*Elset, elset=_both_S2, internal, instance=P-2\n1,\n"}) {
    expected = replaced(expected, line, "");
  }
  expected = replaced(expected, "_top_S1, S1\n", "P-2.1, S1\n");
  expected = replaced(expected, "_bottom_S1, S1\n", "P-1.1, S1\n");
  expected = replaced(expected, "_both_S2, S2\n", "P-1.1, S2\nP-2.1, S2\n");
  CHECK(test::read_text(folder / "b.inp") == expected);
  // Read again, it is the same.
  write_mesh(folder / "c.inp", read_mesh(folder / "b.inp"));
  CHECK(read_text(folder / "c.inp") == expected);
}

TEST_CASE("a surface keeps the faces of instances that are not in the mesh") {
  const TempFolder folder;
  const std::string deck =
      part("S",
           "*Node\n1, 0., 0., 9.\n2, 1., 0., 9.\n3, 0., 1., 9.\n*Element, type=S3\n1, 1, 2, 3\n") +
      part("P", std::string(kNodes) + std::string(kElements)) + "*Assembly, name=A\n" +
      instance("S-1", "S") + instance("P-1", "P") +
      "*Elset, elset=both, instance=S-1\n1, inner\n*Elset, elset=both, instance=P-1\n1,\n"
      "*Elset, elset=both, instance=S-1, generate\n4, 6, 2\n"
      "*Surface, type=ELEMENT, name=x\nboth, S1\n*End Assembly\n";
  write_mesh(folder / "b.inp", read_as(folder, "a.inp", deck));
  CHECK(read_text(folder / "b.inp")
            .find("name=x\nP-1.1, S1\nS-1.1, S1\nS-1.inner, S1\nS-1.4, S1\n"
                  "S-1.6, S1\n*End Assembly\n") != std::string::npos);
}

TEST_CASE("a byte order mark before a deck, normals of nodes and paths of Windows are understood") {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "sub");
  const std::string nodes = replaced(kNodes, "3, 0, 1, 0\n", "3, 0, 1, 0, 0.6, 0., 0.8\n");
  write_text(folder / "sub" / "mesh.inp", "\xEF\xBB\xBF" + nodes);
  write_text(folder / "a.inp",
             "\xEF\xBB\xBF*Include, input=sub\\mesh.inp\n" + std::string(kElements));
  MeshData mesh = read_mesh(folder / "a.inp");
  CHECK(mesh.tets.size() == 1);
  mesh.points.emplace_back(5, 5, 5);
  mesh.point_numbers.push_back(0);
  write_mesh(folder / "b.inp", mesh);
  CHECK(read_text(folder / "b.inp") ==
        replaced(nodes, "4, 0, 0, 1\n", "4, 0, 0, 1\n5, 5, 5, 5\n") + std::string(kElements));
}

TEST_CASE("a deck of Windows keeps its line breaks, and gets no others") {
  const TempFolder folder;
  const std::string deck = "*Heading\n one\n" + std::string(kNodes) + std::string(kElements) +
                           "*Elset, elset=Set-1\n1,\n*Nset, nset=n\n1, 3\n" +
                           std::string(kSection) + "*Surface, name=s\n1, S2\n*Dload\n1, P1, 2.\n";
  std::string windows;
  for (const char c : deck) windows += c == '\n' ? "\r\n" : std::string(1, c);
  const std::string comment = "** as it stands\n";  // of another system
  MeshData mesh = read_as(folder, "a.inp", windows + comment);
  write_mesh(folder / "b.inp", mesh);
  CHECK(test::read_text(folder / "b.inp") == windows + comment);
  mesh.points.emplace_back(5, 5, 5);
  mesh.point_numbers.push_back(0);
  write_mesh(folder / "b.inp", mesh);
  CHECK(test::read_text(folder / "b.inp") ==
        replaced(windows, "4, 0, 0, 1\r\n", "4, 0, 0, 1\r\n5, 5, 5, 5\r\n") + comment);
  write_text(folder / "plain.inp", deck);
  write_mesh(folder / "b.inp", read_mesh(folder / "plain.inp"));
  CHECK(test::read_text(folder / "b.inp") == deck);
}

TEST_CASE("a set of nodes whose order matters comes back line by line, as often as it is listed") {
  const TempFolder folder;
  const std::string deck =
      std::string(kNodes) + std::string(kElements) +
      "*Nset, nset=o, unsorted\n** first\n 4, 1\n*Nset, nset=p\n2,\n"
      "*Nset, nset=o, unsorted\n3, p\n*Nset, nset=g, unsorted, generate\n2, 4, 2\n";
  const MeshData mesh = read_as(folder, "a.inp", deck);
  CHECK(group(mesh, 0, "o").members == std::vector<std::uint32_t>{0, 1, 2, 3});
  CHECK(group(mesh, 0, "g").members == std::vector<std::uint32_t>{1, 3});
  write_mesh(folder / "b.inp", mesh);
  CHECK(test::read_text(folder / "b.inp") == deck);
}

TEST_CASE("a keyword goes on behind a comma and comments, but no line of numbers is part of it") {
  const TempFolder folder;
  const std::string deck =
      "*Node,\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n"
      "*Element,\n** the, type\n\n type=C3D4,\n** the set\n  elset=E,\n1, 1, 2, 3, 4\n";
  const MeshData mesh = read_as(folder, "a.inp", deck);
  CHECK(mesh.points.size() == 4);
  CHECK(mesh.tets.size() == 1);
  CHECK(group(mesh, 3, "E").name == "E");
}

TEST_CASE("a range of a set may end behind the greatest number, with a note") {
  const TempFolder folder;
  const MeshData mesh =
      read_as(folder, "a.inp",
              std::string(kNodes) + std::string(kElements) +
                  "*Nset, nset=all, generate\n1, 1000\n*Elset, elset=none, generate\n7, 9\n"
                  "*Nset, nset=exact, generate\n1, 4\n");
  CHECK(group(mesh, 0, "all").members.size() == 4);
  CHECK(group(mesh, 0, "exact").members.size() == 4);
  REQUIRE(mesh.notes.size() == 2);
  CHECK(mesh.notes[0].ends_with("a.inp:9 ends with 1000, but the greatest number of a node is 4"));
  CHECK(
      mesh.notes[1].ends_with("a.inp:11 ends with 9, but the greatest number of an element is 1"));
}

TEST_CASE("a file of AVS is told from a deck") {
  const TempFolder folder;
  write_text(folder / "a.inp", "4 1 0 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n1 1 tet 1 2 3 4\n");
  CHECK(error_of_reading(folder / "a.inp") ==
        "a.inp:1: this is a file of AVS (UCD), not of Abaqus: ParaView saves it as .vtu or .vtk");
}

TEST_CASE("a tet of a deck is located by its line") {
  const TempFolder folder;
  write_text(folder / "a.inp", kDeck);
  CHECK(locate_tet(folder / "a.inp", 0).ends_with("a.inp:18"));
  CHECK(locate_tet(folder / "a.inp", 1).ends_with("a.inp:21"));
}

TEST_CASE("a deck with any byte changed, or cut at any byte, is an error or gives a sound mesh") {
  const TempFolder folder;
  write_text(folder / "a.inp", kDeck);
  change_each_byte(folder / "a.inp", folder / "a.inp");
  CHECK(is_sound(read_mesh(folder / "a.inp")));
  cut_at_each_byte(folder / "a.inp");
}

TEST_CASE("all volumes of a new deck have a set for a section, and come back without a label") {
  const TempFolder folder;
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.tets = {{{0, 1, 2, 3}, 0}, {{0, 2, 1, 4}, 3}};
  write_mesh(folder / "a.inp", mesh);
  const std::string text = read_text(folder / "a.inp");
  CHECK(text.find("*ELEMENT, TYPE=C3D4, ELSET=Label_0\n1, 1, 2, 3, 4\n") != std::string::npos);
  const MeshData again = read_mesh(folder / "a.inp");
  CHECK(again.tets == mesh.tets);
  write_mesh(folder / "b.inp", again);
  CHECK(read_text(folder / "b.inp") == text);
  const std::string sections =
      "*SOLID SECTION, ELSET=Label_3, MATERIAL=M\n"
      "*SOLID SECTION, ELSET=Label_0, MATERIAL=M\n";
  write_text(folder / "c.inp", text + sections);
  CHECK(read_mesh(folder / "c.inp").tets == mesh.tets);
}
