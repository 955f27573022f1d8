// SPDX-License-Identifier: MIT
// Input files of FEBio: blocks, surfaces and sets, what stays word for word and what it pins.
#include "kernel/formats/febio.h"

#include <doctest/doctest.h>

#include "kernel/formats/deck_remarks.h"
#include "tests/kernel/formats/damage.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

std::string model_text() {
  return "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n"
         "<febio_spec version=\"4.0\">\n"
         "\t<Module type=\"solid\"/> <!-- a comment -->\n"
         "\t<Mesh>\n"
         "\t\t<Nodes name=\"Object1\">\n"
         "\t\t\t<node id=\"1\">0,0,0</node>\n"
         "\t\t\t<node id=\"2\">1,0,0</node>\n"
         "\t\t\t<node id=\"3\">0, 1.0e+00, 0</node>\n"
         "\t\t\t<node id=\"7\">0,0,1.5e-1</node>\n"
         "\t\t</Nodes>\n"
         "\t\t<Nodes>\n"
         "\t\t\t<node id=\"9\">1,1,1</node>\n"
         "\t\t</Nodes>\n"
         "\t\t<Elements type=\"tet4\" name=\"Part1\">\n"
         "\t\t\t<elem id=\"1\">1,2,3,7</elem>\n"
         "\t\t</Elements>\n"
         "\t\t<Elements type=\"tet4\" name=\"Part &gt;2\">\n"
         "\t\t\t<elem id=\"5\">2,3,7,9</elem>\n"
         "\t\t</Elements>\n"
         "\t\t<Surface name=\"Wall\">\n"
         "\t\t\t<tri3 id=\"1\">1,2,3</tri3>\n"
         "\t\t</Surface>\n"
         "\t\t<Surface name=\"Same wall\">\n"
         "\t\t\t<tri3 id=\"1\">3,2,1</tri3>\n"
         "\t\t</Surface>\n"
         "\t\t<NodeSet name=\"Held\">\n"
         "\t\t\t<n id=\"9\"/>\n"
         "\t\t</NodeSet>\n"
         "\t\t<ElementSet name=\"All\">\n"
         "\t\t\t1, 5\n"
         "\t\t</ElementSet>\n"
         "\t</Mesh>\n"
         "\t<MeshDomains><SolidDomain name=\"Part1\" mat=\"1\"/></MeshDomains>\n"
         "</febio_spec>\n";
}

MeshData read_model(const TempFolder& folder, std::string_view content) {
  write_text(folder / "a.feb", content);
  return read_mesh(folder / "a.feb");
}

std::string altered(std::string text, std::string_view what, std::string_view by) {
  const auto at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

}  // namespace

TEST_CASE("a model of FEBio gives nodes, blocks, surfaces and sets") {
  const TempFolder folder;
  const MeshData mesh = read_model(folder, model_text());
  CHECK(mesh.points[3] == Point(0, 0, 0.15));
  CHECK(mesh.point_numbers == std::vector<std::int64_t>{1, 2, 3, 7, 9});
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 1}, {{1, 2, 3, 4}, 2}});
  CHECK(mesh.tet_numbers == std::vector<std::int64_t>{1, 5});
  CHECK(mesh.triangles.size() == 1);  // which both surfaces have
  CHECK(mesh.triangles[0].vertices == std::array<std::uint32_t, 3>{0, 1, 2});
  std::vector<std::string> names;
  for (const Group& group : mesh.groups) names.push_back(group.name);
  CHECK(names ==
        std::vector<std::string>{"", "Part1", "Part >2", "Wall", "Same wall", "Held", "All"});
  CHECK(mesh.required_vertices == std::vector<std::uint32_t>{0, 1, 2, 4});
  REQUIRE(deck_remarks(mesh).size() == 2);
  CHECK(deck_remarks(mesh)[0].ends_with("a.feb:24: <Surface> keeps 3 points where they are"));
  CHECK(mesh.notes.empty());
}

TEST_CASE("surfaces of FEBio pin no node unless they say more than triangles") {
  const TempFolder folder;
  const std::string turned = "<tri3 id=\"1\">3,2,1</tri3>";
  const auto required = [&](std::string_view what, std::string_view by) {
    const std::string text = altered(model_text(), turned, "<tri3 id=\"1\">2,3,1</tri3>");
    return read_model(folder, altered(text, what, by)).required_vertices;
  };
  using Points = std::vector<std::uint32_t>;
  CHECK(read_model(folder, model_text()).required_vertices == Points{0, 1, 2, 4});
  CHECK(required("Same wall", "Label_7") == Points{0, 1, 2, 4});  // its face has another label
  CHECK(required("Same wall", "Other") == Points{4});
  CHECK(required("\"Wall\"", "\"Label_7\"") == Points{4});
  CHECK(required("<tri3 id=\"1\">1", "<tri3 id=\"1\" side=\"2\">1") == Points{0, 1, 2, 4});
  CHECK(required("</tri3>", "</tri3><tri3 id=\"2\">1,2,3</tri3>") == Points{0, 1, 2, 4});
  CHECK(required("</Mesh>", "</Mesh><MeshData><SurfaceData surface=\"Wall\"/></MeshData>") ==
        Points{0, 1, 2, 4});
}

TEST_CASE("a set of tets of FEBio labels none, and tets of no block are not lost in silence") {
  const TempFolder folder;
  MeshData mesh = read_model(folder, altered(model_text(), "Part1", "Label_0"));
  CHECK(mesh.tets == std::vector<MeshData::Tet>{{{0, 1, 2, 3}, 0}, {{1, 2, 3, 4}, 1}});
  write_mesh(folder / "b.feb", mesh);
  CHECK(read_mesh(folder / "b.feb").tets == mesh.tets);
  mesh.tets[0].label = 7;
  CHECK_THROWS_WITH_AS(write_mesh(folder / "c.feb", mesh),
                       doctest::Contains("a tet has the label 7"), Error);
}

TEST_CASE("a model of FEBio comes back, all but its mesh word for word") {
  const TempFolder folder;
  const MeshData mesh = read_model(folder, model_text());
  CHECK(not_written(folder / "b.feb", mesh).empty());
  write_mesh(folder / "b.feb", mesh);
  const std::string written = test::read_text(folder / "b.feb");
  std::string wanted = altered(model_text(), "0, 1.0e+00, 0", "0,1,0");
  wanted = altered(wanted, "1.5e-1", "0.15");
  CHECK(written == wanted);
  const MeshData again = read_mesh(folder / "b.feb");
  CHECK(same_mesh(again, mesh));
  CHECK(again.groups == mesh.groups);
}

TEST_CASE("older models of FEBio with sets of tags and pins outside of the mesh are read") {
  const TempFolder folder;
  std::string text = altered(model_text(), "<Mesh>", "<Geometry>");
  text = altered(text, "</Mesh>",
                 "</Geometry><Boundary><fix bc=\"x\"><node id=\"7\"/></fix></Boundary>");
  text = altered(text, "\t\t\t1, 5\n", "\t\t\t<e id=\"1\"/>\n\t\t\t<e id=\"5\"/>\n");
  const MeshData mesh = read_model(folder, text);
  CHECK(mesh.required_vertices == std::vector<std::uint32_t>{0, 1, 2, 3, 4});
  write_mesh(folder / "b.feb", mesh);
  CHECK(test::read_text(folder / "b.feb").find("<e id=\"1\"/>\n\t\t\t<e id=\"5\"/>\n") !=
        std::string::npos);
  CHECK(read_mesh(folder / "b.feb").groups == mesh.groups);
}

TEST_CASE("elements of FEBio that say type and material by themselves come back so") {
  const TempFolder folder;
  std::string text = altered(model_text(), "<Elements type=\"tet4\" name=\"Part1\">", "<Elements>");
  text = altered(text, "<elem id=\"1\">1,2,3,7</elem>",
                 "<tet4 id=\"1\" mat=\"4\">1,2,3,7</tet4>\n"
                 "\t\t\t<tet4 id=\"3\" mat=\"2\">1,2,7,9</tet4>");
  const MeshData mesh = read_model(folder, text);
  REQUIRE(mesh.tets.size() == 3);
  CHECK(mesh.tets[0].label == 4);
  CHECK(mesh.tets[1].label == 2);
  CHECK(mesh.tets[2].label == 1);  // the block's own, which no material has
  write_mesh(folder / "b.feb", mesh);
  CHECK(read_mesh(folder / "b.feb").tets == mesh.tets);
  CHECK(test::read_text(folder / "b.feb").find("<tet4 id=\"3\" mat=\"2\">1,2,7,9</tet4>") !=
        std::string::npos);
  write_text(folder / "a.feb", altered(text, " mat=\"2\"", ""));
  CHECK(error_of_reading(folder / "a.feb").find("expected the id of a material") !=
        std::string::npos);
}

TEST_CASE(
    "members of a set of nodes of FEBio that are no nodes are told where it is written anew") {
  const TempFolder folder;
  const std::string text =
      altered(model_text(), "<n id=\"9\"/>",
              "<n id=\"1\"/><n id=\"2\"/><n id=\"3\"/><n id=\"7\"/><n id=\"99\"/>");
  CHECK(read_model(folder, text).notes ==
        std::vector<std::string>{"1 members of the set 'Held' are not kept: they are no nodes"});
}

TEST_CASE("second order of FEBio is kept") {
  const TempFolder folder;
  std::string text = "<febio_spec version=\"4.0\"><Mesh><Nodes>";
  for (int i = 1; i <= 10; ++i) {
    text += "<node id=\"" + std::to_string(i) + "\">0," + std::to_string(i) + ",1</node>";
  }
  text +=
      "</Nodes><Elements type=\"tet10\" name=\"a\"><elem id=\"1\">1,2,3,4,5,6,7,8,9,10</elem>"
      "</Elements></Mesh></febio_spec>";
  const MeshData mesh = read_model(folder, text);
  CHECK(mesh.mid_nodes.size() == 6);
  write_mesh(folder / "b.feb", mesh);
  CHECK(read_mesh(folder / "b.feb").mid_nodes == mesh.mid_nodes);
}

TEST_CASE("two blocks of FEBio with one label, and the end of one in a comment, are written once") {
  const TempFolder folder;
  std::string text = altered(model_text(), "\"Part1\"", "\"Label_4\"");
  text = altered(text, "\"Part &gt;2\"", "\"Label_4\"");
  text = altered(text, "\t\t\t<elem id=\"1\"", "<!-- not </Elements> yet -->\t\t\t<elem id=\"1\"");
  const MeshData mesh = read_model(folder, text);
  write_mesh(folder / "b.feb", mesh);
  const MeshData again = read_mesh(folder / "b.feb");
  CHECK(same_mesh(again, mesh));
  CHECK(again.tet_numbers == mesh.tet_numbers);
}

TEST_CASE("a tet of a model of FEBio is located by its line") {
  const TempFolder folder;
  write_text(folder / "a.feb", model_text());
  CHECK(locate_tet(folder / "a.feb", 1).ends_with("a.feb:18"));
}

TEST_CASE("a model of FEBio with a byte changed or cut away never crashes") {
  const TempFolder folder;
  write_text(folder / "a.feb", model_text());
  change_each_byte(folder / "a.feb", folder / "a.feb");
  cut_at_each_byte(folder / "a.feb");
}

TEST_CASE("a bad model of FEBio is refused with line and reason") {
  const std::string good = model_text();
  const std::vector<BadFile> files = {
      {"empty", "", "1: ", "the file is empty"},
      {"text", "solid x\n", "", "this is no XML"},
      {"other", "<VTKFile/>\n", "1: ", "the file is no model of FEBio: expected <febio_spec>"},
      {"no mesh", "<febio_spec/>\n", "1: ", "the model has no mesh"},
      {"elsewhere", "<febio_spec><Mesh from=\"b.feb\"/></febio_spec>\n", "1: ", "in another file"},
      {"cut", good.substr(0, good.size() - 10), "", "this is no XML"},
      {"coordinate", altered(good, ">1,0,0<", ">1,0<"), "7: ", "'1,0' is no point"},
      {"infinite", altered(good, "1.5e-1", "1e999"), "9: ", "expected three finite coordinates"},
      {"twice", altered(good, "id=\"7\"", "id=\"1\""), "9: ", "the id '1' of a node appears"},
      {"node", altered(good, "2,3,7,9", "2,3,7,8"), "18: ", "'8' is not the id of a node"},
      {"few", altered(good, "2,3,7,9", "2,3,7"), "18: ", "the element has 3 nodes: expected 4"},
      {"order", altered(good, "\"tet4\"", "\"tet15\""), "15: ", "expected none of higher order"},
      {"nested", altered(good, "2,3,7,9", "2,3,7,9<elem id=\"6\">1,2,3,9</elem>"),
       "18: ", "<elem> holds another element of XML: expected numbers alone"},
      {"element twice", altered(good, "elem id=\"5\"", "elem id=\"1\""),
       "18: ", "the id '1' of an element appears for the second time"},
  };
  const TempFolder folder;
  for (const BadFile& bad : files) {
    CAPTURE(bad.what);
    write_text(folder / "a.feb", bad.content);
    const std::string error = error_of_reading(folder / "a.feb");
    CHECK_MESSAGE(error.starts_with("a.feb:" + bad.place), error);
    CHECK_MESSAGE(error.find(bad.reason) != std::string::npos, error);
  }
}
