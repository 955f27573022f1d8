// SPDX-License-Identifier: MIT
// Damage of files that outlast a process is noticed before they are used, and named.
#include "pieces/sealed_shelf.h"

#include <fstream>
#include <functional>
#include <iterator>

#include <doctest/doctest.h>
#include <sys/stat.h>

#include "kernel/error.h"
#include "tests/pieces/meshes.h"

using namespace tetmend;
using pieces::SealedShelf;

namespace {

constexpr std::uint32_t kRun = 7;

/// A folder of a run with one step.
struct SealedRun {
  SealedRun() { std::filesystem::create_directories(step()); }
  std::filesystem::path step() const { return root() / "step-2"; }
  std::filesystem::path root() const { return folder.path() / "ck"; }
  SealedShelf shelf(std::uint32_t run = kRun) const { return {root(), "step-2", run}; }
  std::string content(const std::string& name) const {
    std::ifstream in(step() / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& name, std::string_view bytes) const {
    std::ofstream(step() / name, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  std::string complaint(const std::string& name, const std::string& what) const {
    return (step() / name).string() + " " + what + ": delete " + (root() / "run").string();
  }

  test::Folder folder;
};

std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

std::string error_of_reading(const SealedShelf& shelf, const std::string& name) {
  return error_of([&] { shelf.read(name); });
}

}  // namespace

TEST_CASE("what was put or appended is read again, as a whole or in parts, by others too") {
  const SealedRun run;
  SealedShelf shelf = run.shelf();
  shelf.put("a-1", "content");
  shelf.append("b-1", "abc");
  shelf.append("b-1", "def");
  shelf.end("b-1");
  shelf.end("c-1");  // nothing was appended
  const SealedShelf other = run.shelf();
  for (const SealedShelf* each : std::initializer_list<const SealedShelf*>{&shelf, &other}) {
    CHECK(each->read("a-1") == "content");
    CHECK(each->read("b-1") == "abcdef");
    CHECK(each->read("b-1", 2, 3) == "cde");
    CHECK(each->read("b-1", 4, 100) == "ef");
    CHECK(each->read("b-1", 100, 100).empty());
    CHECK(each->read("c-1").empty());
    CHECK(each->has("c-1"));
    CHECK(!each->has("d-1"));
  }
  shelf.put("a-1", "");
  CHECK(shelf.read("a-1").empty());
  shelf.append("b-1", "again");  // a new one
  shelf.end("b-1");
  CHECK(shelf.read("b-1") == "again");
  shelf.remove("b-1");
  CHECK(!shelf.has("b-1"));
}

TEST_CASE("a bit that flips anywhere in a file is damage, and the message names file and folder") {
  const SealedRun run;
  run.shelf().put("stored-2", "some content");
  const std::string sound = run.content("stored-2");
  CHECK(sound.size() == 12 + SealedShelf::kSealSize);
  for (std::size_t i = 0; i < sound.size(); ++i) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      std::string damaged = sound;
      damaged[i] = static_cast<char>(damaged[i] ^ (1 << bit));
      run.write("stored-2", damaged);
      CHECK(error_of_reading(run.shelf(), "stored-2") == run.complaint("stored-2", "is damaged"));
    }
  }
  run.write("stored-2", sound);
  CHECK(run.shelf().read("stored-2") == "some content");
}

TEST_CASE("a file that was cut, grew, or has zeros where a page was lost is damaged") {
  const SealedRun run;
  const std::string content(10'000, 'x');
  run.shelf().put("a", content);
  const std::string sound = run.content("a");
  const auto check = [&](std::string_view bytes) {
    run.write("a", bytes);
    CHECK(error_of_reading(run.shelf(), "a") == run.complaint("a", "is damaged"));
    CHECK(error_of([&] { run.shelf().read("a", 0, 1); }) == run.complaint("a", "is damaged"));
  };
  for (const std::size_t size : {0, 1, 11, 12, 13, 4096, 9'999, 10'011})
    check(sound.substr(0, size));
  check(sound + "x");
  check(sound + sound);
  check(std::string(sound.size(), '\0'));
  check(sound.substr(0, 4096) + std::string(4096, '\0') + sound.substr(8192));
  check("");
}

TEST_CASE("a sound file of another name, step or run is damage; one renamed behind a dot is not") {
  const SealedRun run;
  SealedShelf shelf = run.shelf();
  shelf.put("stored-1", "one");
  shelf.put("stored-2", "two");
  const std::string sound = run.content("stored-1");
  run.write("stored-2", sound);
  CHECK(error_of_reading(run.shelf(), "stored-2") == run.complaint("stored-2", "is damaged"));
  CHECK(error_of_reading(run.shelf(kRun + 1), "stored-1") ==
        run.complaint("stored-1", "is damaged"));
  std::filesystem::create_directories(run.root() / "step-3");
  std::filesystem::copy(run.step() / "stored-1", run.root() / "step-3" / "stored-1");
  const SealedShelf next(run.root(), "step-3", kRun);
  CHECK(error_of_reading(next, "stored-1") != "no error");
  shelf.put("kept-1.next", "rest");
  shelf.rename("kept-1.next", "kept-1");
  shelf.rename("kept-1.next", "kept-1");  // it is not there any more
  CHECK(shelf.read("kept-1") == "rest");
  CHECK(run.shelf().read("kept-1") == "rest");
  CHECK(!shelf.has("kept-1.next"));
}

TEST_CASE(
    "what is missing, incomplete or no regular file is an error at once, and no link is followed") {
  const SealedRun run;
  SealedShelf shelf = run.shelf();
  CHECK(error_of_reading(shelf, "none") == run.complaint("none", "is missing"));
  shelf.append("half", "appended");
  CHECK(error_of_reading(run.shelf(), "half") == run.complaint("half", "is damaged"));
  std::filesystem::create_symlink("/dev/zero", run.step() / "link");
  std::filesystem::create_symlink(run.step() / "half", run.step() / "other");
  std::filesystem::create_directory(run.step() / "folder");
  REQUIRE(::mkfifo((run.step() / "pipe").c_str(), 0600) == 0);
  for (const std::string name : {"link", "other", "folder", "pipe"}) {
    CHECK(error_of_reading(shelf, name) == run.complaint(name, "is no regular file"));
  }
  // What is put takes the place of a link, not of what it leads to.
  const std::filesystem::path outside = run.folder.path() / "outside";
  std::ofstream(outside) << "mine";
  std::filesystem::create_symlink(outside, run.step() / "run");
  shelf.put("run", "state");
  CHECK(shelf.read("run") == "state");
  CHECK(std::filesystem::file_size(outside) == 4);
  std::filesystem::create_directory_symlink(run.step(), run.root() / "step-9");
  CHECK(error_of([&] { SealedShelf(run.root(), "step-9", kRun); }).find("is no folder") !=
        std::string::npos);
}

TEST_CASE("what cannot be read while a file is parsed is told as it is, and is no damage of that") {
  const SealedRun run;
  SealedShelf shelf = run.shelf();
  shelf.put("a", "one");
  CHECK(error_of([&] { shelf.parse("a", [&] { shelf.read("none"); }); }) ==
        run.complaint("none", "is missing"));
  CHECK(error_of([&] { shelf.visit("a", [](auto) { throw Error("no list"); }); }) ==
        run.complaint("a", "is damaged (no list)"));
}
