// SPDX-License-Identifier: MIT
// Universal files: numbers, groups of any dimension, beams and shells, what is kept word for word.
#include "kernel/formats/unv.h"

#include <algorithm>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/kernel/formats/damage.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Two tets of one property in two groups, a shell, a beam; a group of elements and a node.
std::string unv_text() {
  return "    -1\n   164\n         1  SI: Meter (newton)         2\n    1.0D+0    1.0D+0\n    -1\n"
         "    -1\n  2411\n"
         "        11         1         1        11\n   0.0D+00   0.0000000000000000D+00   0.D0\n"
         "        12         1         1        11\n   1.0000000000000000D+00  0.0  0.0\n"
         "        13         1         1        11\n   0.0  1.0000000000000000E+00  0.0\n"
         "        14         1         1        11\n   0.0  0.0  1.5D-01\n"
         "        20         1         1        11\n   1.0  1.0  1.0\n"
         "    -1\n"
         "    -1\n  2412\n"
         "         1       111         2         1         7         4\n"
         "        11        12        13        14\n"
         "         2       111         2         1         7         4\n"
         "        12        13        14        20\n"
         "         3        41         2         1         7         3\n"
         "        11        12        13\n"
         "         5        21         2         1         7         2\n"
         "         0         1         1\n"
         "        11        12\n"
         "    -1\n"
         "    -1\n  2414\n results of node 11\n    -1\n"
         "    -1\n  2467\n"
         "         4         0         0         0         0         0         0         1\n"
         "left body\n"
         "         8         1         0         0\n"
         "         6         0         0         0         0         0         0         3\n"
         "right\n"
         "         8         2         0         0         8         3         0         0\n"
         "         7        20         0         0\n"
         "    -1\n";
}

MeshData read_unv_text(const TempFolder& folder, std::string_view content) {
  write_text(folder / "a.unv", content);
  return read_mesh(folder / "a.unv");
}

}  // namespace

TEST_CASE("a universal file gives nodes, elements and groups with their numbers and names") {
  const TempFolder folder;
  const MeshData mesh = read_unv_text(folder, unv_text());
  CHECK(mesh.points.size() == 5);
  CHECK(mesh.points[3] == Point(0, 0, 0.15));
  CHECK(mesh.point_numbers == std::vector<std::int64_t>{11, 12, 13, 14, 20});
  // All have the property 2: so the groups are the labels.
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 4}, {{1, 2, 3, 4}, 6}});
  CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{{0, 1, 2}, 6}});
  CHECK(mesh.edges == std::vector<MeshData::Edge>{{{0, 1}, 2}});
  REQUIRE(mesh.groups.size() == 4);
  CHECK(mesh.groups[0].name == "left body");
  CHECK(mesh.groups[1] == Group{0, 6, "right", {}, {4}});
  CHECK(mesh.groups[2].dimension == 2);
  CHECK(mesh.groups[3].dimension == 3);
  CHECK(mesh.tet_parts[0] != mesh.tet_parts[1]);
  CHECK(mesh.notes == std::vector<std::string>{"the dataset '2414' is not kept"});
  REQUIRE(mesh.deck.size() == 1);
  CHECK(mesh.deck[0].find("SI: Meter") != std::string::npos);
}

TEST_CASE("labels of a universal file are the properties where these tell elements apart") {
  const TempFolder folder;
  const std::string text = replaced(unv_text(), "2       111         2", "2       111         9");
  CHECK(read_unv_text(folder, text).tets[0].label == 2);
  CHECK(read_unv_text(folder, text).tets[1].label == 9);
}

TEST_CASE("what a universal file holds survives writing, and the second time with the same bytes") {
  const TempFolder folder;
  const MeshData mesh = read_unv_text(folder, unv_text());
  CHECK(not_written(folder / "b.unv", mesh).empty());
  write_mesh(folder / "b.unv", mesh);
  const MeshData again = read_mesh(folder / "b.unv");
  CHECK(same_mesh(again, mesh));
  CHECK(again.groups == mesh.groups);
  CHECK(again.tet_data == mesh.tet_data);
  CHECK(again.triangle_data == mesh.triangle_data);
  CHECK(again.tet_numbers == mesh.tet_numbers);
  CHECK(again.triangle_numbers == mesh.triangle_numbers);
  CHECK(again.point_numbers == mesh.point_numbers);
  CHECK(again.deck == mesh.deck);
  write_mesh(folder / "c.unv", again);
  CHECK(test::read_text(folder / "b.unv") == test::read_text(folder / "c.unv"));
}

TEST_CASE("middle nodes of a universal file stand between their ends") {
  const TempFolder folder;
  std::string text = "    -1\n  2411\n";
  const std::array<std::array<double, 3>, 10> places = {{{0, 0, 0},
                                                         {.5, 0, 0},
                                                         {1, 0, 0},
                                                         {.5, .5, 0},
                                                         {0, 1, 0},
                                                         {0, .5, 0},
                                                         {0, 0, .5},
                                                         {.5, 0, .5},
                                                         {0, .5, .5},
                                                         {0, 0, 1}}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    text += std::to_string(i + 1) + " 1 1 11\n";
    for (const double x : places[i]) text += " " + std::to_string(x);
    text += "\n";
  }
  text += "    -1\n    -1\n  2412\n 1 118 1 1 7 10\n 1 2 3 4 5 6 7 8\n 9 10\n    -1\n";
  const MeshData mesh = read_unv_text(folder, text);
  REQUIRE(mesh.tets.size() == 1);
  REQUIRE(mesh.mid_nodes.size() == 6);
  for (const auto& [a, b, node] : mesh.mid_nodes) {
    CHECK(mesh.points[node] == (mesh.points[a] + mesh.points[b]) / 2);
  }
  write_mesh(folder / "b.unv", mesh);
  CHECK(read_mesh(folder / "b.unv").mid_nodes == mesh.mid_nodes);
}

TEST_CASE("older datasets of a universal file are read") {
  const TempFolder folder;
  std::string text = replaced(unv_text(), "  2411\n", "   781\n");
  for (const std::string_view name : {"2477", "2452", "2435"}) {
    CAPTURE(name);
    CHECK(
        read_unv_text(folder, replaced(text, "  2467\n", "  " + std::string(name) + "\n")).groups ==
        read_unv_text(folder, unv_text()).groups);
  }
}

TEST_CASE("groups of a universal file come back in the dataset that they came in") {
  const TempFolder folder;
  for (const char* name : {"2435", "2452", "2477", "2467"}) {
    const MeshData mesh =
        read_unv_text(folder, replaced(unv_text(), "  2467\n", fmt::format("  {}\n", name)));
    CHECK(mesh.groups.size() == read_unv_text(folder, unv_text()).groups.size());
    write_mesh(folder / "b.unv", mesh);
    CHECK(read_text(folder / "b.unv").find(fmt::format("  {}\n", name)) != std::string::npos);
    CHECK(read_mesh(folder / "b.unv").deck == mesh.deck);
    const std::vector<std::string> lost = not_written(folder / "b.msh", mesh);
    CHECK(std::count(lost.begin(), lost.end(),
                     "1 pieces of a deck, all that is no mesh, are not "
                     "kept: .msh has no place for them") == 1);
  }
}

TEST_CASE("a group without members is in no universal file, and a note says so") {
  const TempFolder folder;
  MeshData mesh = awkward_mesh();
  mesh.groups = {{3, 7777, "nobody", {}, {}}, {3, mesh.tets[0].label, "some", {}, {}}};
  const std::vector<std::string> notes = not_written(folder / "a.unv", mesh);
  CHECK(std::count(notes.begin(), notes.end(), "1 groups have no members: not kept") == 1);
  write_mesh(folder / "a.unv", mesh);
  CHECK(read_text(folder / "a.unv").find("nobody") == std::string::npos);
  const MeshData again = read_mesh(folder / "a.unv");
  CHECK(std::any_of(again.groups.begin(), again.groups.end(),
                    [](const Group& group) { return group.name == "some"; }));
}

TEST_CASE("members of groups that are not in a universal file are named") {
  const TempFolder folder;
  const MeshData mesh =
      read_unv_text(folder, replaced(unv_text(), "8         3         0", "8        77         0"));
  REQUIRE(mesh.notes.size() == 2);
  CHECK(mesh.notes[1] ==
        "1 of 3 members of the group 'right' are not kept: they are no nodes or elements of the "
        "mesh");
}

TEST_CASE("a tet of a universal file is located by its line") {
  const TempFolder folder;
  write_text(folder / "a.unv", unv_text());
  CHECK(locate_tet(folder / "a.unv", 1).ends_with("a.unv:23"));
}

TEST_CASE("a universal file with a byte changed or cut away never crashes") {
  const TempFolder folder;
  write_text(folder / "a.unv", unv_text());
  change_each_byte(folder / "a.unv", folder / "a.unv");
  cut_at_each_byte(folder / "a.unv");
}

TEST_CASE("a bad universal file is refused with line and reason") {
  const std::string good = unv_text();
  const std::vector<BadFile> files = {
      {"empty", "", "1: ", "the file is empty"},
      {"other", "solid x\n", "1: ", "'solid' is not the beginning of a dataset: expected -1"},
      {"no nodes", "    -1\n   164\n 1\n    -1\n", "", "the file has no nodes"},
      {"cut", good.substr(0, good.rfind("    -1")), "36: ", "the dataset '2467' has no end"},
      {"node", replaced(good, "        11        12        13        14", "11 12 13 15"),
       "22: ", "'15' is not the number of a node"},
      {"twice", replaced(good, "        12         1         1", "        11         1         1"),
       "10: ", "the number '11' of a node appears for the second time"},
      {"element twice", replaced(good, "         2       111", "         1       111"),
       "23: ", "the number '1' of an element appears for the second time"},
      {"width", replaced(good, "7         4\n", "7         5\n"),
       "21: ", "an element of kind 111 has 5 nodes: expected 4"},
      {"cubic", replaced(good, "111", "117"), "21: ", "expected none of third order"},
      {"infinite", replaced(good, "1.5D-01", "1.5D+999"), "15: ", "is not a finite number"},
      {"many", replaced(good, "0         1\nleft", "0 900000000\nleft"), "37: ", "cannot fit"},
  };
  const TempFolder folder;
  for (const BadFile& bad : files) {
    CAPTURE(bad.what);
    write_text(folder / "a.unv", bad.content);
    const std::string error = error_of_reading(folder / "a.unv");
    CHECK_MESSAGE(error.starts_with("a.unv:" + bad.place), error);
    CHECK_MESSAGE(error.find(bad.reason) != std::string::npos, error);
  }
}
