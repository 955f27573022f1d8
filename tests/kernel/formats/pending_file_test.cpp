// SPDX-License-Identifier: MIT
// Files that take the place of others: what is kept, what is refused, and the way back.
#include "kernel/formats/pending_file.h"

#include <array>
#include <csignal>
#include <optional>
#include <string_view>

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "kernel/formats/output_file.h"
#include "kernel/mesh_data.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::test;
using formats::PendingFile;

namespace {

std::string pending_refusal(const std::filesystem::path& file) {
  try {
    const PendingFile pending(file);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

struct stat status_of(const std::filesystem::path& file) {
  struct stat status {};
  REQUIRE(::lstat(file.c_str(), &status) == 0);
  return status;
}

bool is_root() {
  return ::geteuid() == 0;
}

/// The signal that ended a child which ran `work`, or 0.
template <class Work>
int signal_of_child(const Work& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    work();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

}  // namespace

TEST_CASE("a link to nothing and a loop of links are refused, and stay") {
  const TempFolder folder;
  std::filesystem::create_symlink(folder / "none", folder / "dangling");
  std::filesystem::create_symlink(folder / "loop", folder / "loop");
  CHECK(pending_refusal(folder / "dangling").ends_with("cannot be written: a link to nothing"));
  CHECK(pending_refusal(folder / "loop").ends_with("Too many levels of symbolic links"));
  CHECK(folder.entries() == 2);
}

TEST_CASE("links at the names of temporary files are not followed") {
  const TempFolder folder;
  write_text(folder / "dear", "dear to me");
  for (int i = 0; i < 3; ++i) {
    const auto name = ".tetmend-" + std::to_string(::getpid()) + "-" + std::to_string(i) + ".tmp";
    std::filesystem::create_symlink(folder / "dear", folder / name);
  }
  PendingFile file(folder / "a");
  file.write("new");
  file.commit();
  CHECK(read_text(folder / "dear") == "dear to me");
  CHECK(read_text(folder / "a") == "new");
  CHECK(folder.entries() == 5);
}

TEST_CASE("a file of several names is replaced under one, which is noted") {
  const TempFolder folder;
  write_text(folder / "a", "old");
  CHECK(PendingFile(folder / "a").notes().empty());
  std::filesystem::create_hard_link(folder / "a", folder / "b");
  PendingFile file(folder / "a");
  REQUIRE(file.notes().size() == 1);
  CHECK(file.notes()[0] == "has 2 names: only this one gets the new content");
  file.commit();
  CHECK(read_text(folder / "a").empty());
  CHECK(read_text(folder / "b") == "old");
}

TEST_CASE("owner, group and permissions of an older file are kept, setuid is not") {
  if (!is_root()) {
    MESSAGE("skipped: only root can give files away");
    return;
  }
  const TempFolder folder;
  for (const mode_t mode : {0640u, 0u, 04755u}) {
    write_text(folder / "a", "old");
    REQUIRE(::chown((folder / "a").c_str(), 1234, 2345) == 0);
    REQUIRE(::chmod((folder / "a").c_str(), mode) == 0);
    PendingFile file(folder / "a");
    CHECK((status_of(file.temporary()).st_mode & 07777) == (mode & 0777));
    CHECK(file.notes().empty());
    file.commit();
    const auto now = status_of(folder / "a");
    CHECK(now.st_uid == 1234);
    CHECK(now.st_gid == 2345);
    CHECK((now.st_mode & 07777) == (mode & 0777));
  }
}

TEST_CASE("an owner that cannot be kept is noted, and no other group may do more") {
  if (!is_root()) {
    MESSAGE("skipped: needs a user of its own");
    return;
  }
  const TempFolder folder;
  REQUIRE(::chmod((folder / "").c_str(), 0777) == 0);
  write_text(folder / "a", "old");
  REQUIRE(::chown((folder / "a").c_str(), 1234, 2345) == 0);
  REQUIRE(::chmod((folder / "a").c_str(), 0662) == 0);
  CHECK(signal_of_child([&] {
          if (::setgid(4321) != 0 || ::setuid(4321) != 0) ::abort();
          PendingFile file(folder / "a");
          if (file.notes().size() != 2) ::abort();
          file.commit();
        }) == 0);
  const auto now = status_of(folder / "a");
  CHECK(now.st_uid == 4321);
  CHECK((now.st_mode & 07777) == 0622);
}

TEST_CASE("files that belong together are all new, or all old after a fault at any of them") {
  for (const bool with_older : {true, false}) {
    for (int bad = 0; bad < 4; ++bad) {
      const TempFolder folder;
      const std::array<const char*, 4> names = {"0", "1", "2", "3"};
      if (with_older) {
        for (const char* name : names) write_text(folder / name, "old");
      }
      std::array<std::optional<PendingFile>, 4> files;
      std::array<PendingFile*, 4> all{};
      for (std::size_t i = 0; i < 4; ++i) {
        files[i].emplace(folder / names[i]);
        files[i]->write("new");
        all[i] = &*files[i];
      }
      // Now this one cannot be renamed.
      const auto& bad_name = names[static_cast<std::size_t>(bad)];
      std::filesystem::remove(folder / bad_name);
      std::filesystem::create_directory(folder / bad_name);
      CHECK_THROWS_WITH_AS(PendingFile::commit_all(all), doctest::Contains("Is a directory"),
                           Error);
      for (auto& file : files) file.reset();
      CHECK(folder.entries() == (with_older ? 4 : 1));
      for (const char* name : names) {
        if (with_older && name != bad_name) CHECK(read_text(folder / name) == "old");
      }
      std::filesystem::remove(folder / bad_name);
      for (std::size_t i = 0; i < 4; ++i) {
        files[i].emplace(folder / names[i]);
        files[i]->write("new");
      }
      PendingFile::commit_all(all);
      for (const char* name : names) CHECK(read_text(folder / name) == "new");
      CHECK(folder.entries() == 4);
    }
  }
}

TEST_CASE("an index is the last to be new; after a fault all is old") {
  // What cannot be replaced: nothing, the index, a file, one that shall go.
  for (const char* bad : {"", "index", "1", "3"}) {
    CAPTURE(bad);
    const bool is_bad = bad[0] != '\0';
    const TempFolder folder;
    const TempFolder drafts;
    for (const char* name : {"index", "1", "2", "3"}) write_text(folder / name, "old");
    for (const char* name : {"index", "1", "2"}) write_text(drafts / name, "new");
    {
      PendingFile index(folder / "index", drafts / "index");
      PendingFile first(folder / "1", drafts / "1");
      PendingFile second(folder / "2", drafts / "2");
      if (is_bad) {
        std::filesystem::remove(folder / bad);
        std::filesystem::create_directory(folder / bad);
      }
      const std::array files = {&first, &second};
      const std::array<std::filesystem::path, 1> gone = {folder / "3"};
      const auto commit = [&] { PendingFile::commit_behind(index, files, gone); };
      if (is_bad) {
        CHECK_THROWS_WITH_AS(commit(), doctest::Contains("Is a directory"), Error);
      } else {
        commit();
      }
    }
    for (const char* name : {"index", "1", "2"}) {
      if (std::string_view(name) != bad) {
        CHECK(read_text(folder / name) == (is_bad ? "old" : "new"));
      }
    }
    CHECK(std::filesystem::exists(folder / "3") == is_bad);
    CHECK(folder.entries() == (is_bad ? 4 : 3));
    CHECK(drafts.entries() == 0);
  }
}

TEST_CASE("a file that is complete keeps the permissions of the one that it replaces") {
  const TempFolder folder;
  write_text(folder / "a", "old");
  write_text(folder / "draft", "new");
  REQUIRE(::chmod((folder / "a").c_str(), 0640) == 0);
  PendingFile(folder / "a", folder / "draft").commit();
  CHECK(read_text(folder / "a") == "new");
  CHECK((status_of(folder / "a").st_mode & 07777) == 0640);
  CHECK(folder.entries() == 1);
  CHECK_THROWS_WITH_AS(PendingFile(folder / "a", folder / "none"),
                       doctest::Contains("No such file"), Error);
}

TEST_CASE(
    "a signal that ends the program removes what is unfinished, but waits for what is short") {
  const TempFolder folder;
  write_text(folder / "a", "old");
  CHECK(signal_of_child([&] {
          PendingFile file(folder / "a");
          formats::end_by_signal(SIGTERM);
        }) == SIGTERM);
  CHECK(folder.entries() == 1);
  CHECK(signal_of_child([&] {
          const formats::EndDelay delay;
          formats::end_by_signal(SIGTERM);
          write_text(folder / "a", "new");
        }) == SIGTERM);
  CHECK(read_text(folder / "a") == "new");
}

TEST_CASE("the files of a mesh are known from one of them") {
  const auto files = mesh_files("x/a.ele");
  CHECK(files == std::vector<std::filesystem::path>{"x/a.ele", "x/a.node", "x/a.face", "x/a.edge"});
  CHECK(mesh_files("A.NODE")[1] == "A.ELE");
  CHECK(mesh_files("mesh.header").size() == 5);
  CHECK(mesh_files("a.mesh") == std::vector<std::filesystem::path>{"a.mesh"});
  CHECK(mesh_files("run.trace").size() == 1);
}
