// SPDX-License-Identifier: MIT
// Folders of killed processes go, those of others stay.
#include <fstream>

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "pieces/shelf.h"
#include "tests/pieces/meshes.h"

using namespace tetmend;
using pieces::ScratchFolder;

namespace {

/// What a process leaves in a folder that ends without tidying up.
std::filesystem::path left_by_killed_process(const std::filesystem::path& parent) {
  const pid_t child = ::fork();
  if (child == 0) {
    const ScratchFolder scratch(parent);
    std::ofstream(scratch.path() / "stored-0") << "a piece";
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return parent / (".tetmend-pieces-" + std::to_string(child) + "-0");
}

}  // namespace

TEST_CASE("what a killed process has left goes when the next one makes its folder beside it") {
  const test::Folder folder;
  const ScratchFolder working(folder.path());  // its process is alive
  const std::filesystem::path left = left_by_killed_process(folder.path());
  REQUIRE(std::filesystem::exists(left / "stored-0"));
  const ScratchFolder next(folder.path());
  CHECK(!std::filesystem::exists(left));
  CHECK(std::filesystem::exists(working.path()));
  CHECK(std::filesystem::exists(next.path()));
}

TEST_CASE("a folder of another host, one without a lock, and what has another name stay") {
  const test::Folder folder;
  const std::filesystem::path other_host = left_by_killed_process(folder.path());
  std::ofstream(other_host / "lock") << "some.other.host";
  const std::filesystem::path no_lock = folder.path() / ".tetmend-pieces-1-0";
  const std::filesystem::path other_name = folder.path() / "tetmend-pieces-1-0";
  for (const std::filesystem::path& made : {no_lock, other_name}) {
    std::filesystem::create_directory(made);
    std::ofstream(made / "stored-0") << "a piece";
  }
  std::filesystem::copy(other_host / "stored-0", other_name / "lock");
  { const ScratchFolder next(folder.path()); }
  CHECK(std::filesystem::exists(other_host / "stored-0"));
  CHECK(std::filesystem::exists(no_lock / "stored-0"));
  CHECK(std::filesystem::exists(other_name / "stored-0"));
}
