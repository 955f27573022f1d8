// SPDX-License-Identifier: MIT
// Which files of a run are the same.
#include "kernel/formats/run_files.h"

#include <filesystem>

#include <doctest/doctest.h>

#include "kernel/formats/mesh_io.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::test;
using formats::FileUse;
using formats::NumberedFiles;
using formats::RunFiles;

namespace {

bool clash(const FileUse& input, const FileUse& output) {
  RunFiles files;
  files.read(input);
  files.write(output);
  return files.clash().has_value();
}

FileUse use(const std::filesystem::path& file) {
  return {"x", {{file}, {}}};
}

FileUse mesh(const std::filesystem::path& file) {
  return {"x", {mesh_files(file), {}}, format_name(file), {mesh_files(file), {}}};
}

}  // namespace

TEST_CASE("files are the same by inode, and where they are not there yet by their place") {
  const TempFolder folder;
  write_text(folder / "a", "");
  std::filesystem::create_hard_link(folder / "a", folder / "hard");
  std::filesystem::create_symlink("a", folder / "soft");
  std::filesystem::create_directory(folder / "d");
  std::filesystem::create_directory_symlink("d", folder / "e");
  CHECK(clash(use(folder / "a"), use(folder / "a")));
  CHECK(clash(use(folder / "a"), use(folder / "hard")));
  CHECK(clash(use(folder / "a"), use(folder / "soft")));
  CHECK(clash(use(folder / "soft"), use(folder / "d/../a")));
  CHECK(clash(use(folder / "d/new"), use(folder / "e/new")));
  std::filesystem::create_symlink("d/new", folder / "link_to_nothing");
  CHECK(clash(use(folder / "link_to_nothing"), use(folder / "d/new")));
  CHECK_FALSE(clash(use(folder / "a"), use(folder / "d/a")));
  CHECK_FALSE(clash(use("-.msh"), use("-.msh")));  // standard input and output
}

TEST_CASE("numbered files are those that are there, behind links, and all that may come") {
  const TempFolder folder;
  write_text(folder / "in", "");
  std::filesystem::create_symlink("in", folder / "p_7.msh");
  const FileUse parts = {"parts", {{}, {{folder / "", "p_", ".msh"}}}};
  CHECK(clash(use(folder / "in"), parts));
  CHECK(clash(use(folder / "p_12.msh"), parts));
  CHECK(clash(use(folder / "p_3.msh/inner"), parts));
  for (const char* other :
       {"p_.msh", "p_1x.msh", "q_1.msh", "p_1.vtu", "d/p_1.msh", "p_1.msh.gz"}) {
    CAPTURE(other);
    CHECK_FALSE(clash(use(folder / other), parts));
  }
}

TEST_CASE("a mesh may replace itself as a whole and in its format, and nothing else") {
  const TempFolder folder;
  for (const char* name : {"a.mesh", "s.node", "s.ele"}) write_text(folder / name, "");
  std::filesystem::create_symlink("a.mesh", folder / "l.mesh");
  std::filesystem::create_symlink("a.mesh", folder / "l.vtk");
  std::filesystem::create_symlink("s.ele", folder / "t.ele");
  CHECK_FALSE(clash(mesh(folder / "a.mesh"), mesh(folder / "a.mesh")));
  CHECK_FALSE(clash(mesh(folder / "a.mesh"), mesh(folder / "l.mesh")));
  CHECK_FALSE(clash(mesh(folder / "s.ele"), mesh(folder / "s.node")));
  CHECK(clash(mesh(folder / "a.mesh"), mesh(folder / "l.vtk")));
  CHECK(clash(mesh(folder / "s.ele"), mesh(folder / "t.ele")));  // s.node would stay as it is
  CHECK(clash(mesh(folder / "a.mesh"), use(folder / "a.mesh")));
}

TEST_CASE("of two outputs the one that was named first is named first") {
  const TempFolder folder;
  RunFiles files;
  files.write({"--report", {{folder / "x"}, {}}});
  files.write({"--trace", {{folder / "./x"}, {}}});
  const auto found = files.clash();
  REQUIRE(found);
  CHECK(found->option == "--report");
  CHECK(found->output == "--trace");
  CHECK(found->file == folder / "./x");
}

TEST_CASE("what reading a deck opens is the deck and all that it includes") {
  const TempFolder folder;
  write_text(folder / "deck.inp",
             "*HEADING\n*INCLUDE, INPUT=nodes.inc\n*ELSET, ELSET=a, INPUT=set.inc\n1\n");
  write_text(folder / "nodes.inc", "*NODE\n*include,\n input=inner.inc\n");
  write_text(folder / "inner.inc", "1, 0., 0., 0.\n");
  write_text(folder / "set.inc", "1\n");
  const auto files = source_files(folder / "deck.inp");
  CHECK(files.size() == 4);
  CHECK(clash({"IN", {files, {}}}, use(folder / "inner.inc")));
  CHECK(clash({"IN", {files, {}}}, use(folder / "set.inc")));
  CHECK(source_files(folder / "none.inp").size() == 1);
  CHECK(source_files(folder / "a.ele") == mesh_files(folder / "a.ele"));
}
