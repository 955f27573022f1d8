// SPDX-License-Identifier: MIT
// Gmsh's files of both versions and codings: what is kept, and how bad ones are refused.
#include <algorithm>
#include <initializer_list>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "kernel/mesh_view.h"
#include "tests/kernel/formats/damage.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/text.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

constexpr std::array<std::string_view, 4> kVariants = {"2.2 ASCII", "2.2 binary", "4.1 ASCII",
                                                       "4.1 binary"};

// Two tets with a common face, in volumes 1 and 2. Volume 1 is in two groups, surface 3 in none.
// Numbers of nodes and elements have gaps and no order.
constexpr std::string_view kPhysicalNames =
    "$PhysicalNames\n5\n0 7 \"corner\"\n2 30 \"inlet\"\n3 10 \"left steel\"\n3 20 \"right\"\n"
    "3 25 \"all\"\n$EndPhysicalNames\n";

std::string text_4() {
  return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + std::string(kPhysicalNames) +
         "$Entities\n1 1 2 2\n"
         "1 0 0 0 1 7 \n"
         "4 0 0 0 1 0 0 0 2 1 -1 \n"
         "5 0 0 0 1 1 0 1 -30 2 4 -4 \n3 0 0 0 1 1 1 0 0 \n"
         "1 0 0 0 1 1 1 2 10 25 1 5 \n2 0 0 -1 1 1 0 1 20 1 -3 \n"
         "$EndEntities\n"
         "$Nodes\n4 5 2 900\n"
         "0 1 0 1\n2\n0 0 0\n"
         "1 4 1 1\n70\n1 0 0 0.5\n"
         "2 5 0 1\n30\n0 1 0\n"
         "3 1 0 2\n900\n40\n0.1 0.2 -1\n0.25 0.125 1\n"
         "$EndNodes\n"
         "$Elements\n7 8 1 99\n"
         "0 1 15 1\n1 2\n"
         "1 4 1 1\n11 2 70\n"
         "2 5 2 1\n12 2 30 70\n"
         "2 3 2 1\n9 30 70 40\n"
         "3 2 4 1\n99 2 70 30 900\n"
         "3 1 4 1\n13 2 30 70 40\n"
         "3 1 6 2\n20 2 30 70 40 900 2\n21 2 30 70 40 900 30\n"
         "$EndElements\n"
         "$Periodic\n1\n2 5 3\n16 1 0 0 2 0 1 0 0 0 0 1 0 0 0 0 1\n2\n2 40\n30 70\n$EndPeriodic\n"
         "$Parametrizations\n1 2\n3 4\n$EndParametrizations\n"
         "$NodeData\n1\n\"heat\"\n1\n0.5\n3\n0\n1\n5\n2 1.5\n30 2.5\n40 nan\n70 4\n900 5\n"
         "$EndNodeData\n"
         "$NodeData\n1\n\"heat\"\n1\n1.5\n3\n1\n1\n1\n2 1.5\n$EndNodeData\n"
         "$ElementData\n1\n\"flow\"\n1\n0\n3\n0\n3\n3\n99 1 2 3\n13 4 5 6\n9 7 8 9\n"
         "$EndElementData\n";
}

/// The mesh of text_4() without what is not kept.
MeshData two_volumes() {
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {0, 1, 0}, {0.25, 0.125, 1}, {1, 0, 0}, {0.1, 0.2, -1}};
  mesh.point_entities = {{0, 1}, {2, 5}, {3, 1}, {1, 4}, {3, 1}};
  mesh.tets = {{{0, 1, 3, 2}, 10}, {{0, 3, 1, 4}, 20}};
  mesh.tet_parts = {1, 2};
  mesh.triangles = {{{1, 3, 2}, 0}, {{0, 1, 3}, 30}};
  mesh.triangle_parts = {3, 5};
  mesh.edges = {{{0, 3}, 0}};
  mesh.edge_parts = {4};
  mesh.groups = {{0, 7, "corner", {}, {0}},
                 {2, 30, "inlet", {5}, {}},
                 {3, 10, "left steel", {1}, {}},
                 {3, 20, "right", {2}, {}},
                 {3, 25, "all", {1}, {}}};
  mesh.entities = {
      {0, 1, {0, 0, 0, 0, 0, 0}, {7}, {}},        {1, 4, {0, 0, 0, 1, 0, 0}, {}, {1, -1}},
      {2, 5, {0, 0, 0, 1, 1, 0}, {-30}, {4, -4}}, {2, 3, {0, 0, 0, 1, 1, 1}, {}, {}},
      {3, 1, {0, 0, 0, 1, 1, 1}, {10, 25}, {5}},  {3, 2, {0, 0, -1, 1, 1, 0}, {20}, {-3}}};
  mesh.periodic = {{2, 5, 3, {1, 0, 0, 2, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, {{0, 2}, {1, 3}}}};
  mesh.other_elements = {{13, 6, {0, 1, 3, 2, 4, 0, 0, 1, 3, 2, 4, 1}, {10, 10}, {1, 1}, {}, {}}};
  mesh.tet_data = {{"flow", 3, std::vector<double>{4, 5, 6, 1, 2, 3}}};
  return mesh;
}

std::string text_2() {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + std::string(kPhysicalNames) +
         "$Nodes\n5\n2 0 0 0\n70 1 0 0\n30 0 1 0\n900 0.1 0.2 -1\n40 0.25 0.125 1\n$EndNodes\n"
         "$Elements\n10\n"
         "1 15 2 7 1 2\n"
         "2 1 2 0 4 2 70\n"
         "3 2 2 30 5 2 30 70\n"
         "4 2 4 0 3 1 0 30 70 40\n"
         "5 4 2 10 1 2 30 70 40\n"
         "6 4 2 25 1 2 30 70 40\n"
         "7 4 2 25 1 2 70 30 900\n"
         "8 4 2 20 1 2 70 30 900\n"
         "9 11 2 20 2 2 70 30 900 2 70 30 900 40 2\n"
         "10 15 2 0 6 30\n"
         "$EndElements\n"
         "$Periodic\n1\n2 5 3\nAffine 1 0 0 2 0 1 0 0 0 0 1 0 0 0 0 1\n1\n2 40\n$EndPeriodic\n";
}

std::string without(std::string text, std::string_view section) {
  const std::size_t begin = text.find(fmt::format("${}\n", section));
  const std::string end = fmt::format("$End{}\n", section);
  return text.erase(begin, text.find(end) + end.size() - begin);
}

bool same_gmsh_extras(const MeshData& a, const MeshData& b) {
  return a.tet_parts == b.tet_parts && a.triangle_parts == b.triangle_parts &&
         a.edge_parts == b.edge_parts && a.point_entities == b.point_entities &&
         a.groups == b.groups && a.entities == b.entities && a.periodic == b.periodic &&
         a.other_elements == b.other_elements && a.tet_data == b.tet_data;
}

const Group* find_group(const MeshData& mesh, int dimension, Label number) {
  for (const Group& group : mesh.groups) {
    if (group.dimension == dimension && group.number == number) return &group;
  }
  return nullptr;
}

}  // namespace

TEST_CASE("names of groups and views survive in .msh whatever their signs; of line breaks a note") {
  const TempFolder folder;
  MeshData mesh = awkward_mesh();
  const std::vector<std::string> names = {"5\" pipe\"", "\x1b]0;x\x07", std::string("a\0b", 3),
                                          "'"};
  mesh.groups.clear();
  for (std::size_t i = 0; i < names.size(); ++i) {
    mesh.groups.push_back({3, static_cast<Label>(i + 1), names[i], {}, {}});
    mesh.tets[i % mesh.tets.size()].label = static_cast<Label>(i + 1);
  }
  write_mesh(folder / "a.msh", mesh);
  const MeshData again = read_mesh(folder / "a.msh");
  for (const std::string& name : names) {
    CHECK(std::any_of(again.groups.begin(), again.groups.end(),
                      [&](const Group& group) { return group.name == name; }));
  }
  mesh.groups[0].name = "a\nb";
  const auto notes = not_written(folder / "a.msh", mesh);
  CHECK(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.find(".msh has other rules for 1 of them") != std::string::npos;
  }));
}

TEST_CASE("an MSH file of version 4.1 is read with its groups, entities, links and views") {
  const TempFolder folder;
  const MeshData mesh = read_as(folder, "a.msh", text_4());
  const MeshData expected = two_volumes();
  CHECK(mesh.variant == "4.1 ASCII");
  CHECK(same_mesh(mesh, expected));
  CHECK(same_gmsh_extras(mesh, expected));
  REQUIRE(mesh.point_data.size() == 1);
  CHECK(mesh.point_data[0].name == "heat");
  const auto& heat = std::get<std::vector<double>>(mesh.point_data[0].values);
  CHECK(heat[1] == 2.5);
  CHECK(std::isnan(heat[2]));
  const std::vector<std::string> notes = {
      "section '$Parametrizations' is not kept", "of view 'heat' only the first step is kept",
      "view 'flow' is not kept for triangles, for it has no values for some",
      "the parameters of nodes are not kept"};
  CHECK(mesh.notes == notes);
}

TEST_CASE("what an MSH file holds survives writing in every variant of version 4.1") {
  const TempFolder folder;
  for (const std::string variant : {"4.1 ASCII", "4.1 binary"}) {
    CAPTURE(variant);
    MeshData mesh = read_as(folder, "a.msh", text_4());
    mesh.variant = variant;
    write_mesh(folder / "b.msh", mesh);
    const MeshData again = read_mesh(folder / "b.msh");
    CHECK(again.variant == variant);
    CHECK(again.notes.empty());
    CHECK(same_mesh(again, mesh));
    CHECK(same_gmsh_extras(again, mesh));
    CHECK(again.point_data.size() == 1);
  }
}

TEST_CASE("an MSH file that was written once is written again with the same bytes") {
  const TempFolder folder;
  for (const std::string& text : {text_2(), text_4()}) {
    for (const std::string_view from : kVariants) {
      for (const std::string_view to : kVariants) {
        CAPTURE(from);
        CAPTURE(to);
        MeshData mesh = read_as(folder, "a.msh", text);
        mesh.variant = from;
        write_mesh(folder / "b.msh", mesh);
        mesh = read_mesh(folder / "b.msh");
        CHECK(mesh.variant == from);
        mesh.variant = to;
        write_mesh(folder / "c.msh", mesh);
        write_mesh(folder / "d.msh", read_mesh(folder / "c.msh"));
        CHECK(test::read_text(folder / "c.msh") == test::read_text(folder / "d.msh"));
        if (from == to) {
          CHECK(test::read_text(folder / "b.msh") == test::read_text(folder / "c.msh"));
        }
      }
    }
  }
}

TEST_CASE("an element that version 2.2 lists for each of its groups is one element") {
  const TempFolder folder;
  for (const std::string_view variant : kVariants) {
    CAPTURE(variant);
    MeshData mesh = read_as(folder, "a.msh", text_2());
    mesh.variant = variant;
    write_mesh(folder / "b.msh", mesh);
    mesh = read_mesh(folder / "b.msh");
    REQUIRE(mesh.tets.size() == 2);
    CHECK(mesh.tets[0] == MeshData::Tet{{0, 1, 3, 2}, 10});
    CHECK(mesh.tets[1] == MeshData::Tet{{0, 3, 1, 4}, 25});
    // Both are of volume 1; as one part they could not be in different groups.
    CHECK(mesh.tet_parts[0] == 1);
    CHECK(mesh.tet_parts[1] > 2);
    const Group* all = find_group(mesh, 3, 25);
    REQUIRE(all != nullptr);
    CHECK(all->parts == mesh.tet_parts);
    CHECK(all->name == "all");
    CHECK(find_group(mesh, 3, 10)->parts == std::vector<Label>{1});
    CHECK(find_group(mesh, 0, 7)->members == std::vector<std::uint32_t>{0});
    REQUIRE(mesh.other_elements.size() == 2);
    const auto& second_order = mesh.other_elements[0];
    CHECK(second_order.vtk_type == 24);
    CHECK(second_order.vertices == std::vector<std::uint32_t>{0, 3, 1, 4, 0, 3, 1, 4, 0, 2});
    CHECK(mesh.other_elements[1].vtk_type == 1);
    CHECK(mesh.periodic.size() == 1);
  }
  CHECK(notes_but_of_orders(read_as(folder, "a.msh", text_2())) ==
        std::vector<std::string>{"the partitions of elements are not kept"});
}

TEST_CASE("elements of a group that are listed behind all of another are put together") {
  const TempFolder folder;
  std::string text = text_2();
  text = replaced(text, "6 4 2 25 1 2 30 70 40\n7 4 2 25 1 2 70 30 900\n",
                  "7 4 2 25 1 2 70 30 900\n6 4 2 25 1 70 2 30 40\n");
  const MeshData mesh = read_as(folder, "a.msh", text);
  CHECK(mesh.tets.size() == 2);
  CHECK(find_group(mesh, 3, 25)->parts == mesh.tet_parts);
}

TEST_CASE("version 2.2 lists an element once for each of its groups again") {
  const TempFolder folder;
  write_mesh(folder / "b.msh", read_as(folder, "a.msh", text_2()));
  const std::string text = test::read_text(folder / "b.msh");
  CHECK(text.find("$Elements\n10\n") != std::string::npos);
  CHECK(text.find("10 1 1 2 4 3\n") != std::string::npos);
  CHECK(text.find("25 1 1 2 4 3\n") != std::string::npos);
}

TEST_CASE("data of other formats get an entity for each label, and none of them is a group for 0") {
  const TempFolder folder;
  for (const std::string_view variant : kVariants) {
    CAPTURE(variant);
    MeshData mesh = awkward_mesh();
    mesh.required_vertices.clear();
    mesh.variant = variant;
    write_mesh(folder / "a.msh", mesh);
    const MeshData again = read_mesh(folder / "a.msh");
    CHECK(same_mesh(again, mesh));
    CHECK(again.tet_parts[0] == mesh.tets[0].label);
    CHECK(find_group(again, 2, 12) != nullptr);
    CHECK(find_group(again, 2, 0) == nullptr);
    CHECK(again.triangle_parts[2] > 0);
  }
}

TEST_CASE("data without a variant are written as binary 4.1") {
  const TempFolder folder;
  write_mesh(folder / "a.msh", awkward_mesh());
  CHECK(read_mesh(folder / "a.msh").variant == "4.1 binary");
}

TEST_CASE("groups by members become entities of their own") {
  const TempFolder folder;
  MeshData mesh = awkward_mesh();
  mesh.groups = {{3, 5, "first", {}, {0}}, {3, 6, "both", {}, {0, 1}}, {0, 2, "tip", {}, {3}}};
  write_mesh(folder / "a.msh", mesh);
  const MeshData again = read_mesh(folder / "a.msh");
  REQUIRE(find_group(again, 3, 6) != nullptr);
  CHECK(find_group(again, 3, 6)->parts.size() == 2);
  CHECK(find_group(again, 3, 5)->parts == std::vector<Label>{again.tet_parts[0]});
  CHECK(find_group(again, 0, 2)->members == std::vector<std::uint32_t>{3});
}

TEST_CASE("entities of partitions are parts of their parents; what lies between partitions goes") {
  const TempFolder folder;
  std::string text = replaced(text_4(), "$Nodes\n4 5",
                              "$PartitionedEntities\n2\n1\n12 2\n0 0 1 2\n"
                              "9 3 1 2 1 2 0 0 0 1 1 1 1 10 0 \n"
                              "7 3 1 1 1 0 0 0 1 1 1 2 10 25 2 5 9 \n"
                              "8 3 2 1 2 0 0 -1 1 1 0 1 20 1 -3 \n"
                              "$EndPartitionedEntities\n$Nodes\n4 5");
  text = replaced(text, "3 1 0 2\n900", "3 7 0 2\n900");
  text = replaced(text, "3 2 4 1\n", "3 8 4 1\n");
  text = replaced(text, "3 1 4 1\n", "2 9 2 1\n55 2 30 40\n3 7 4 1\n");
  text = replaced(text, "3 1 6 2\n", "3 7 6 2\n");
  text = replaced(text, "7 8 1 99", "8 9 1 99");
  const MeshData mesh = read_as(folder, "a.msh", text);
  const MeshData expected = two_volumes();
  CHECK(same_mesh(mesh, expected));
  CHECK(same_gmsh_extras(mesh, expected));
  CHECK(std::find(mesh.notes.begin(), mesh.notes.end(),
                  "the partitions of elements are not kept") != mesh.notes.end());
}

TEST_CASE("points that came later are of the entity of an element that holds them") {
  const TempFolder folder;
  MeshData mesh = two_volumes();
  mesh.other_elements.clear();
  mesh.point_entities[4] = {-1, 0};
  mesh.point_entities[3] = {-1, 0};
  mesh.variant = "4.1 ASCII";
  write_mesh(folder / "a.msh", mesh);
  const MeshData again = read_mesh(folder / "a.msh");
  CHECK(again.point_entities[4] == std::array<Label, 2>{3, 2});
  CHECK(again.point_entities[3] == std::array<Label, 2>{1, 4});
}

TEST_CASE("an MSH file in the other byte order is read") {
  const TempFolder folder;
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    Bytes file(order);
    file.text("$MeshFormat\n2.2 1 8\n").add(std::int32_t{1}).text("\n$EndMeshFormat\n$Nodes\n4\n");
    for (std::int32_t i = 0; i < 4; ++i) {
      file.add(i + 1).add(i == 1 ? 1.0 : 0.0).add(i == 2 ? 1.0 : 0.0).add(i == 3 ? 1.0 : 0.0);
    }
    file.text("\n$EndNodes\n$Elements\n1\n")
        .add_all<std::int32_t>({4, 1, 2, 1, 9, 3, 1, 2, 3, 4})
        .text("\n$EndElements\n");
    write_text(folder / "a.msh", file.str());
    const MeshData mesh = read_mesh(folder / "a.msh");
    CHECK(mesh.points[3] == Point(0, 0, 1));
    CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 9}});
    CHECK(mesh.tet_parts == std::vector<Label>{3});
    CHECK(mesh.variant == "2.2 binary");
  }
}

TEST_CASE("an MSH file with a byte changed or cut away never crashes") {
  const TempFolder folder;
  for (const std::string& text : {text_2(), text_4()}) {
    for (const std::string_view variant : kVariants) {
      CAPTURE(variant);
      MeshData mesh = read_as(folder, "a.msh", text);
      mesh.variant = variant;
      write_mesh(folder / "b.msh", mesh);
      change_each_byte(folder / "b.msh", folder / "b.msh");
      cut_at_each_byte(folder / "b.msh");
    }
    write_text(folder / "a.msh", text);
    change_each_byte(folder / "a.msh", folder / "a.msh");
    cut_at_each_byte(folder / "a.msh");
  }
}

TEST_CASE("a tet of an MSH file is located by its line or byte, though numbers change the order") {
  const TempFolder folder;
  write_text(folder / "a.msh", text_4());
  const auto line = [](std::string_view row) {
    const std::string text = text_4();
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(text.find(row));
    return fmt::format("a.msh:{}", 1 + std::count(text.begin(), end, '\n'));
  };
  CHECK(locate_tet(folder / "a.msh", 0).ends_with(line("13 2 30 70 40")));
  CHECK(locate_tet(folder / "a.msh", 1).ends_with(line("99 2 70 30 900")));
  for (const std::string_view variant : kVariants) {
    MeshData mesh = awkward_mesh();
    mesh.variant = variant;
    write_mesh(folder / "b.msh", mesh);
    const bool binary = variant.ends_with("binary");
    CHECK((locate_tet(folder / "b.msh", 1).find(": byte ") != std::string::npos) == binary);
  }
}

TEST_CASE("names of groups of an MSH file may lack their quotes, and get them") {
  const TempFolder folder;
  for (const std::string name : {"inlet", "two  words"}) {
    for (const std::string end : {"\n", " \r\n"}) {
      const MeshData mesh = read_as(folder, "a.msh", replaced(text_2(), "\"inlet\"\n", name + end));
      const auto found = std::find_if(mesh.groups.begin(), mesh.groups.end(),
                                      [&](const Group& group) { return group.name == name; });
      CHECK(found != mesh.groups.end());
      write_mesh(folder / "b.msh", mesh);
      CHECK(test::read_text(folder / "b.msh").find('"' + name + '"') != std::string::npos);
    }
  }
}

TEST_CASE("nodes of an MSH file of version 2.2 may have parameters") {
  const TempFolder folder;
  const MeshData plain = read_as(folder, "a.msh", text_2());
  const std::string nodes =
      "$ParametricNodes\n5\n2 0 0 0 0 1\n70 1 0 0 1 4 0.5\n30 0 1 0 2 5 0.25 0.75\n"
      "900 0.1 0.2 -1 3 1\n40 0.25 0.125 1 3 1\n$EndParametricNodes\n";
  const std::string text = text_2();
  const std::size_t begin = text.find("$Nodes");
  const std::size_t end = text.find("$Elements");
  const MeshData mesh = read_as(folder, "a.msh", text.substr(0, begin) + nodes + text.substr(end));
  CHECK(mesh.points == plain.points);
  CHECK(mesh.tets == plain.tets);
  const auto cut = text.substr(0, begin) + replaced(nodes, "4 0.5", "4") + text.substr(end);
  write_text(folder / "a.msh", cut);
  CHECK(error_of_reading(folder / "a.msh") != "no error");
}

TEST_CASE("an MSH file of version 4.1 may have sizes of 4 bytes") {
  const TempFolder folder;
  CHECK(read_as(folder, "a.msh", replaced(text_4(), "4.1 0 8", "4.1 0 4")).tets ==
        read_as(folder, "a.msh", text_4()).tets);
  std::string bytes = "$MeshFormat\n4.1 1 4\n";
  const auto put = [&](auto value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  const auto put_sizes = [&](std::initializer_list<std::uint32_t> values) {
    for (const std::uint32_t value : values) put(value);
  };
  const auto put_tags = [&](std::initializer_list<std::int32_t> values) {
    for (const std::int32_t value : values) put(value);
  };
  put_tags({1});
  bytes += "\n$EndMeshFormat\n$Nodes\n";
  put_sizes({1, 4, 1, 9});
  put_tags({3, 1, 0});
  put_sizes({4, 1, 2, 3, 9});
  for (const double x : {0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1.}) put(x);
  bytes += "\n$EndNodes\n$Elements\n";
  put_sizes({1, 1, 7, 7});
  put_tags({3, 1, 4});
  put_sizes({1, 7, 1, 2, 3, 9});
  bytes += "\n$EndElements\n";
  const MeshData mesh = read_as(folder, "a.msh", bytes);
  CHECK(mesh.tets.size() == 1);
  CHECK(mesh.tets[0].vertices == std::array<std::uint32_t, 4>{0, 1, 2, 3});
  CHECK(mesh.points[3] == Point(0, 0, 1));
}

TEST_CASE("a bad MSH file is refused with line and reason") {
  const std::string two = text_2();
  const std::string four = text_4();
  const std::vector<BadFile> files = {
      {"other", "solid x\n", "1: ", "'solid' is not the beginning of an MSH file"},
      {"4.0", replaced(four, "4.1 0 8", "4 0 8"),
       "2: ", "version '4' of the format cannot be read: expected 4.1 or 2.2"},
      {"4.0", replaced(four, "4.1 0 8", "4.0 0 8"), "2: ", "version '4.0' of the format"},
      {"short", replaced(four, "4.1 0 8", "4.1 0 2"), "2: ", "'2' is not a size of numbers"},
      {"version 1", "$NOD\n4\n", "1: ", "this is an MSH file of version 1: expected 4.1 or 2.2"},
      {"no end", replaced(four, "$EndMeshFormat", "$EndMesh"), "3: ", "expected $EndMeshFormat"},
      {"one quote", replaced(four, "\"inlet\"", "\"inlet"), "7: ", "the name of a group in quotes"},
      {"no name", replaced(four, "\"inlet\"", " "), "7: ", "the name of a group in quotes"},
      {"named twice", replaced(four, "3 25", "3 10"),
       "10: ", "the group '3 10' is named for the second time"},
      {"entity twice", replaced(four, "\n3 0 0 0", "\n5 0 0 0"),
       "17: ", "the entity '2 5' appears for the second time"},
      {"node twice", replaced(four, "\n900\n40\n", "\n900\n70\n"),
       "34: ", "the number '70' of a node appears for the second time"},
      {"node twice", replaced(two, "\n40 0.25", "\n70 0.25"),
       "18: ", "the number '70' of a node appears for the second time"},
      {"no node", replaced(four, "13 2 30 70 40", "13 2 30 71 40"),
       "51: ", "'71' is not the number of a node: expected one of $Nodes"},
      {"few nodes", replaced(four, "4 5 2 900", "4 6 2 900"),
       "36: ", "the blocks hold 5 nodes: expected 6"},
      {"many in a block", replaced(four, "3 1 0 2\n", "3 1 0 3\n"),
       "32: ", "'3' is out of range: expected the nodes of a block, 0 to 2"},
      {"few elements", replaced(four, "7 8 1 99", "7 9 1 99"),
       "54: ", "the blocks hold 8 elements: expected 9"},
      {"count", replaced(four, "4 5 2 900", "4 1000000000 2 900"),
       "22: ", "1000000000 nodes cannot fit"},
      {"count", replaced(four, "7 8 1 99", "7 1000000000 1 99"),
       "39: ", "1000000000 elements cannot fit"},
      {"type", replaced(four, "3 1 6 2", "3 1 21 2"), "52: ", "elements of type 21 cannot be read"},
      {"type", replaced(two, "4 2 4 0 3 1 0", "4 26 4 0 3 1 0"),
       "25: ", "elements of type 26 cannot be read"},
      {"dimension", replaced(four, "3 1 6 2", "2 1 6 2"),
       "52: ", "'2' is not the dimension of type 6: expected 3"},
      {"no nodes", without(four, "Nodes"), "21: ", "expected $Nodes before"},
      {"no elements", without(two, "Elements"), "", "the section $Elements is missing"},
      {"twice", four + "$Nodes\n", "", "'$Nodes' appears for the second time"},
      {"partitions", replaced(four, "$Parametrizations", "$PartitionedEntities"),
       "67: ", "'$EndParametrizations'"},
      {"unknown without end", four + "$Ghost\n1 2\n", "",
       "'$Ghost' has no end: expected $EndGhost"},
      {"words", four + "hello\n", "",
       "'hello' is not expected here: expected the name of a section"},
      {"map", replaced(four, "16 1 0 0 2 0", "15 1 0 0 2"),
       "59: ", "'15' is not the number of numbers of a map: expected 0 or 16"},
      {"view", replaced(four, "\n5\n2 1.5", "\n6\n2 1.5"),
       "82: ", "'$EndNodeData' is not an integer"},
      {"view of other nodes", replaced(four, "70 4\n", "71 4\n"), "",
       "'71' is not the number of a node"},
  };
  const TempFolder folder;
  for (const BadFile& bad : files) {
    CAPTURE(bad.what);
    write_text(folder / "a.msh", bad.content);
    const std::string error = error_of_reading(folder / "a.msh");
    CHECK_MESSAGE(error.starts_with("a.msh:" + bad.place), error);
    CHECK_MESSAGE(error.find(bad.reason) != std::string::npos, error);
  }
}

TEST_CASE("a mesh without tets is refused") {
  const TempFolder folder;
  std::string text = text_2();
  for (const char* row : {"5 4 2 10 1 2 30 70 40\n", "6 4 2 25 1 2 30 70 40\n",
                          "7 4 2 25 1 2 70 30 900\n", "8 4 2 20 1 2 70 30 900\n"}) {
    text = replaced(text, row, "");
  }
  text = replaced(text, "$Elements\n10", "$Elements\n6");
  write_text(folder / "a.msh",
             replaced(replaced(text, "9 11 2 20 2 2 70 30 900 2 70 30 900 40 2\n", ""),
                      "$Elements\n6", "$Elements\n5"));
  CHECK(error_of_reading(folder / "a.msh").find("the mesh has no tetrahedra") != std::string::npos);
}

TEST_CASE("a bad binary MSH file is refused with byte and reason") {
  const TempFolder folder;
  const auto error_with = [&](std::string_view version, const Bytes& rest) {
    Bytes file;
    file.text(fmt::format("$MeshFormat\n{} 1 8\n", version)).add(std::int32_t{1});
    file.text("\n$EndMeshFormat\n").text(rest.str());
    write_text(folder / "a.msh", file.str());
    return error_of_reading(folder / "a.msh");
  };
  write_text(folder / "a.msh", "$MeshFormat\n4.1 1 8\nabcd\n$EndMeshFormat\n");
  CHECK(error_of_reading(folder / "a.msh") ==
        "a.msh: byte 20: '1684234849' does not tell the byte order: expected the integer 1");
  // The header takes 40 bytes.
  const std::int64_t huge = 1000000000;
  CHECK(error_with("4.1", Bytes().text("$Nodes\n").add(std::int64_t{0}).add(huge)) ==
        "a.msh: byte 55: 1000000000 nodes cannot fit into the 0 bytes that are left: the count is "
        "wrong or the file is truncated");
  CHECK(error_with("4.1", Bytes().text("$Entities\n").add(huge))
            .find("byte 50: 1000000000 entities cannot fit") != std::string::npos);
  CHECK(error_with("2.2", Bytes().text("$Nodes\n1000000000\n"))
            .find("byte 47: 1000000000 nodes cannot fit") != std::string::npos);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(error_with("2.2",
                   Bytes().text("$Nodes\n1\n").add(std::int32_t{1}).add_all<double>({0, nan, 0})) ==
        "a.msh: byte 61: nan is not a finite number: expected a coordinate of a node");
}

TEST_CASE("the name of a group may have a line break within its quotes, which .msh has not again") {
  const TempFolder folder;
  const std::string mesh =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"upper\nhalf\"\n3 2 \"b\"\n"
      "$EndPhysicalNames\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 0 0 -1\n$EndNodes\n"
      "$Elements\n2\n1 4 2 1 1 1 2 3 4\n2 4 2 2 2 1 3 2 5\n$EndElements\n";
  write_text(folder / "a.msh", mesh);
  const MeshData data = read_mesh(folder / "a.msh");
  REQUIRE(data.groups.size() == 2);
  CHECK(data.groups[0].name == "upper\nhalf");
  CHECK(data.groups[1].name == "b");
  REQUIRE(not_written(folder / "b.msh", data).size() == 1);
  CHECK(not_written(folder / "b.msh", data)[0].ends_with("the first is 'upper\\nhalf'"));
  write_mesh(folder / "b.msh", data);
  CHECK(read_mesh(folder / "b.msh").groups[1].name == "b");
  write_text(folder / "c.msh", mesh.substr(0, mesh.find("half")) + mesh.substr(mesh.find("\n3 2")));
  CHECK(error_of_reading(folder / "c.msh").starts_with("c.msh:6: ' \"upper' is not expected here"));
}

TEST_CASE("elements of points come back in the same order, whatever entity their node names") {
  // A node on a surface in a group of points; one of an entity without groups, on one with them.
  const std::string crossed =
      replaced(replaced(text_4(), "1 0 0 0 1 7 \n", "1 0 0 0 1 7 \n2 0 1 0 1 7 \n3 1 0 0 0 \n"),
               "1 1 2 2\n", "3 1 2 2\n");
  const std::string blocks = replaced(
      replaced(crossed, "0 1 15 1\n1 2\n", "0 3 15 1\n3 2\n0 1 15 1\n2 70\n0 2 15 1\n1 30\n"),
      "7 8 1 99", "9 10 1 99");
  const TempFolder folder;
  write_text(folder / "a.msh", blocks);
  write_mesh(folder / "b.msh", read_mesh(folder / "a.msh"));
  const std::string written = read_text(folder / "b.msh");
  write_mesh(folder / "c.msh", read_mesh(folder / "b.msh"));
  CHECK(read_text(folder / "c.msh") == written);
}
