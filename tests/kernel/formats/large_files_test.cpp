// SPDX-License-Identifier: MIT
// Files of several chunks: the same by every number of threads, and errors with the right place.
#include <algorithm>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "kernel/formats/text_rows.h"
#include "kernel/mesh_view.h"
#include "kernel/tet_mesh.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/threads.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// What a format of a solver has no place for, or lists in another order.
void leave_out(MeshData& mesh, std::string_view extension) {
  const auto is_one_of = [&](std::initializer_list<std::string_view> list) {
    return std::find(list.begin(), list.end(), extension) != list.end();
  };
  if (is_one_of({".su2", ".vol", ".bdf", ".nas", ".header", ".unv", ".mfem", ".k", ".key", ".feb",
                 ".xdmf"}))
    mesh.point_labels.clear();
  if (is_one_of({".su2", ".bdf", ".nas", ".mfem", ".k", ".key", ".feb"})) mesh.edges.clear();
  if (extension == ".vol") mesh.edges.resize(1);  // no edge twice
  if (extension == ".su2") {
    for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
      mesh.tets[i].label = 0;
      mesh.triangles[i].label = Label(i / 1000);  // marker by marker
    }
  }
  if (is_one_of({".bdf", ".nas", ".mfem", ".k", ".key"})) {
    for (auto& tet : mesh.tets) ++tet.label;
    for (auto& triangle : mesh.triangles) ++triangle.label;
  }
}

/// 24576 tets, and some of all that files hold.
MeshData large_mesh(std::string_view extension) {
  MeshData mesh = kuhn_cube(16, 0.3, 9);
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    mesh.tets[i].label = Label(i % 1000);
    const auto& v = mesh.tets[i].vertices;
    mesh.triangles.push_back({{v[0], v[1], v[3]}, Label(i % 77)});
    if (i % 2 == 0) mesh.edges.push_back({{v[2], v[0]}, Label(i % 5)});
  }
  mesh.point_labels.assign(mesh.points.size(), 3);
  if (extension.starts_with(".mesh")) mesh.required_vertices = {0, 5, 4000};
  leave_out(mesh, extension);
  return mesh;
}

/// Offset of the beginning of a line, counted from 1.
std::size_t offset_of_line(const std::string& text, std::size_t line) {
  std::size_t at = 0;
  while (--line > 0) at = text.find('\n', at) + 1;
  return at;
}

std::size_t line_of(const std::string& text, std::size_t offset) {
  return 1 + static_cast<std::size_t>(std::count(
                 text.begin(), text.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
}

}  // namespace

TEST_CASE("a large mesh is written and read alike by every number of threads, in every format") {
  for (const MeshFormat& format : mesh_formats()) {
    const MeshData mesh = large_mesh(format.extension);
    const TempFolder folder;
    const std::string extension(format.extension);
    CAPTURE(extension);
    const auto file = [&](std::string name) { return folder / name.append(extension); };
    on_threads(1, [&] { write_mesh(file("1"), mesh); });
    on_threads(4, [&] { write_mesh(file("4"), mesh); });
    const bool names_other = extension == ".xdmf";  // a file beside it
    const auto text = [&](const std::filesystem::path& of) {
      return read_text(names_other ? std::filesystem::path(of).replace_extension(".h5") : of);
    };
    CHECK(text(file("1")) == text(file("4")));
    if (format.name == "TetGen") {
      for (const char* part : {".node", ".ele", ".face", ".edge"}) {
        CHECK(read_text(file("1").replace_extension(part)) ==
              read_text(file("4").replace_extension(part)));
      }
    }
    // A deck lists faces, not triangles: inp_test.cpp and others. Others sort elements by labels.
    if (extension == ".inp" || extension == ".feb" || format.name == "LS-DYNA") continue;
    if (format.name == "Exodus II" || format.name == "CGNS") continue;
    for (const int threads : {1, 2, 5}) {
      CHECK(on_threads(threads, [&] { return same_mesh(read_mesh(file("1")), mesh); }));
    }
  }
}

TEST_CASE("a view of a tet mesh is written as its data are") {
  const TempFolder folder;
  const TetMesh mesh = TetMesh::sorted(large_mesh(".mesh"));
  for (const MeshFormat& format : mesh_formats()) {
    const auto file = [&](std::string name) { return folder / name.append(format.extension); };
    write_mesh(file("view"), MeshView(mesh));
    write_mesh(file("data"), mesh.to_data());
    const auto text = [&](const std::filesystem::path& of) {
      const bool names_other = format.extension == ".xdmf";  // a file beside it
      return read_text(names_other ? std::filesystem::path(of).replace_extension(".h5") : of);
    };
    CHECK(text(file("view")) == text(file("data")));
  }
  CHECK(same_points(mesh.to_data(), large_mesh(".mesh")));
}

TEST_CASE("of several errors in a large text file the first is told with its line") {
  const TempFolder folder;
  write_mesh(folder / "a.mesh", large_mesh(".mesh"));
  const std::string good = read_text(folder / "a.mesh");
  REQUIRE(good.size() > 8 * formats::kTextChunkSize);
  const std::size_t last_line = line_of(good, good.size()) - 1;  // "End"
  const std::size_t first_tet = line_of(good, good.find("Tetrahedra")) + 2;
  std::vector<std::size_t> lines = {last_line - 1, last_line - 2, first_tet, first_tet + 12345, 10,
                                    4000};
  // Around the places where the text of the tets is cut.
  const std::size_t begin = offset_of_line(good, first_tet);
  for (std::size_t k = 1; begin + k * formats::kTextChunkSize < good.size(); ++k) {
    const std::size_t line = line_of(good, begin + k * formats::kTextChunkSize);
    for (const std::size_t l : {line - 1, line, line + 1}) lines.push_back(l);
  }
  for (const std::size_t line : lines) {
    std::string bad = good;
    bad[offset_of_line(bad, last_line - 1)] = 'x';  // a later error
    bad[offset_of_line(bad, line)] = '?';
    write_text(folder / "b.mesh", bad);
    for (const int threads : {1, 4}) {
      const std::string error =
          on_threads(threads, [&] { return error_of_reading(folder / "b.mesh"); });
      CHECK_MESSAGE(error.starts_with(fmt::format("b.mesh:{}: '?", line)), error);
    }
  }
}

TEST_CASE("a large text file may have comments, empty lines, and rows that share or change lines") {
  const TempFolder folder;
  const MeshData mesh = large_mesh(".mesh");
  write_mesh(folder / "a.mesh", mesh);
  const std::string good = read_text(folder / "a.mesh");
  const std::size_t first_tet = line_of(good, good.find("Tetrahedra")) + 2;
  const auto changed_at = [&](std::size_t line, std::string_view before, bool join) {
    std::string text = good;
    const std::size_t at = offset_of_line(text, line);
    if (join) text[text.find('\n', at)] = ' ';
    return text.insert(at, before);
  };
  std::vector<std::string> texts;
  for (const std::size_t line :
       {std::size_t{6}, std::size_t{3000}, first_tet, first_tet + 1, first_tet + 20000}) {
    texts.push_back(changed_at(line, "# comment 1 2 3\n", false));
    texts.push_back(changed_at(line, "\n \t\n", false));
    texts.push_back(changed_at(line, "", true));
    texts.push_back(changed_at(line, "\n", true));  // as many lines as rows
    texts.push_back(changed_at(line, "# comment\n", true));
  }
  std::string windows;
  for (const char c : good) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  texts.push_back(windows);
  std::string one_line = good;
  std::replace(one_line.begin() + static_cast<std::ptrdiff_t>(good.find("Tetrahedra")),
               one_line.end() - 1, '\n', ' ');
  texts.push_back(one_line);
  texts.push_back(good.substr(0, good.rfind("End")));  // which may be missing
  for (const std::string& text : texts) {
    write_text(folder / "b.mesh", text);
    for (const int threads : {1, 4}) {
      CHECK(on_threads(threads, [&] { return same_mesh(read_mesh(folder / "b.mesh"), mesh); }));
    }
  }
}

TEST_CASE("a tet of a late chunk is located by its line") {
  const TempFolder folder;
  write_mesh(folder / "a.mesh", large_mesh(".mesh"));
  const std::string text = read_text(folder / "a.mesh");
  const std::size_t first_tet = line_of(text, text.find("Tetrahedra")) + 2;
  for (const std::size_t tet : {0, 1, 24000, 24575}) {
    const std::string place = on_threads(4, [&] { return locate_tet(folder / "a.mesh", tet); });
    CHECK(place.ends_with(fmt::format(":{}", first_tet + tet)));
  }
}
