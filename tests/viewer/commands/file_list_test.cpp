// SPDX-License-Identifier: MIT
#include "viewer/commands/file_list.h"

#include <doctest/doctest.h>

#include "kernel/error.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::viewer;

TEST_CASE("a folder is listed with folders first, and only files that are wanted") {
  const test::TempFolder folder;
  for (const char* name : {"b.mesh", "a.MESH", "c.txt", ".hidden.mesh"}) {
    test::write_text(folder / name, "12345");
  }
  std::filesystem::create_directory(folder / "z");
  std::filesystem::create_directory(folder / ".git");
  std::filesystem::create_symlink("nowhere", folder / "lost.mesh");
  constexpr std::array<std::string_view, 1> kWanted = {".mesh"};
  std::string names;
  for (const FileEntry& entry : list_folder(folder / ".", kWanted)) {
    names += entry.name + (entry.is_folder ? "/ " : " ");
    if (entry.name == "b.mesh") CHECK(entry.bytes == 5);
  }
  CHECK(names == "z/ a.MESH b.mesh lost.mesh ");
  CHECK_THROWS_WITH_AS(list_folder(folder / "missing", kWanted), doctest::Contains("missing"),
                       Error);
}

TEST_CASE("sizes of files are told with a unit") {
  CHECK(format_bytes(0) == "0 B");
  CHECK(format_bytes(999) == "999 B");
  CHECK(format_bytes(1200) == "1.2 kB");
  CHECK(format_bytes(37'500'000) == "37.5 MB");
}
