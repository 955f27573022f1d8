// SPDX-License-Identifier: MIT
// Output files appear complete or not at all.
#include "kernel/formats/output_file.h"

#include <csignal>

#include <doctest/doctest.h>
#include <sys/resource.h>

#include "tests/kernel/formats/fixtures.h"
#include "tests/support/threads.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// Lets no file of this process grow beyond some bytes: what a full disk looks like to a writer.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*old_handler_)(int);
  rlimit old_{};
};

}  // namespace

TEST_CASE("an output file without commit leaves nothing and keeps the older file") {
  const TempFolder folder;
  write_text(folder / "a", "old");
  {
    OutputFile out(folder / "a");
    out.put("new");
  }
  CHECK(read_text(folder / "a") == "old");
  CHECK(folder.entries() == 1);
}

TEST_CASE("a committed output file replaces the older one and keeps its permissions") {
  const TempFolder folder;
  write_text(folder / "a", "old");
  std::filesystem::permissions(folder / "a", std::filesystem::perms{0640});
  OutputFile out(folder / "a");
  out.put("n ");
  out.put_integer(std::numeric_limits<std::int64_t>::min());
  out.put(' ');
  out.put_real(0.1);
  out.commit();
  CHECK(read_text(folder / "a") == "n -9223372036854775808 0.1");
  CHECK(std::filesystem::status(folder / "a").permissions() == std::filesystem::perms{0640});
  CHECK(folder.entries() == 1);
}

TEST_CASE("text longer than the buffer is written in order") {
  const TempFolder folder;
  std::string expected;
  OutputFile out(folder / "a");
  for (const std::size_t size : {10u, 300000u, 5u, 262144u, 262143u, 7u}) {
    const std::string piece(size, static_cast<char>('a' + size % 26));
    out.put(piece);
    out.put('|');
    expected += piece + "|";
  }
  out.commit();
  CHECK(read_text(folder / "a") == expected);
}

TEST_CASE("an output file behind a link is replaced and the link stays") {
  const TempFolder folder;
  write_text(folder / "a", "old");
  std::filesystem::create_symlink(folder / "a", folder / "link");
  OutputFile out(folder / "link");
  out.put("new");
  out.commit();
  CHECK(std::filesystem::is_symlink(folder / "link"));
  CHECK(read_text(folder / "a") == "new");
}

TEST_CASE(
    "output into a missing folder, onto a folder or onto a device is an error with the reason") {
  const TempFolder folder;
  write_text(folder / "file", "");
  std::filesystem::create_directory(folder / "folder");
  const auto reason = [](const std::filesystem::path& target) -> std::string {
    try {
      const OutputFile out(target);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  const std::string written = ": cannot be written: ";
  CHECK(reason(folder / "none/a") ==
        (folder / "none/a").string() + written + "No such file or directory");
  CHECK(reason(folder / "file/a").ends_with(written + "Not a directory"));
  CHECK(reason(folder / "folder").ends_with(written + "Is a directory"));
  CHECK(reason("/dev/null") == "/dev/null" + written + "not a regular file");
}

TEST_CASE("a mesh that does not fit on the disk is an error and keeps the older files") {
  MeshData mesh = awkward_mesh();
  for (int i = 0; i < 2000; ++i) mesh.tets.push_back({{0, 1, 2, 3}, i});
  for (const MeshFormat& format : mesh_formats()) {
    CAPTURE(format.extension);
    const TempFolder folder;
    const auto file = folder / ("mesh" + std::string(format.extension));
    write_mesh(file, awkward_mesh());
    const MeshData before = read_mesh(file);
    const std::size_t entries = folder.entries();
    {
      const FullDisk disk(2000);
      CHECK_THROWS_WITH_AS(write_mesh(file, mesh),
                           doctest::Contains("cannot be written: File too large"), Error);
    }
    CHECK(same_mesh(read_mesh(file), before));
    CHECK(folder.entries() == entries);
  }
}

TEST_CASE("blocks are written in their order, between what was put before and after") {
  const TempFolder folder;
  std::string expected = "first\n";
  for (int i = 0; i < 1000; ++i)
    expected.append(static_cast<std::size_t>(i) * 3, 'x') += std::to_string(i);
  expected += "last\n";
  for (const int threads : {1, 4}) {
    OutputFile out(folder / "a");
    out.put("first\n");
    on_threads(threads, [&] {
      out.put_blocks(1000, [](std::size_t block, OutputBuffer& buffer) {
        for (std::size_t i = 0; i < block; ++i) buffer.put("xxx");
        buffer.put_integer(static_cast<std::int64_t>(block));
      });
      out.put_blocks(0, [](std::size_t, OutputBuffer& buffer) { buffer.put("never"); });
    });
    out.put("last\n");
    out.commit();
    CHECK(read_text(folder / "a") == expected);
  }
}

TEST_CASE("a disk that gets full while blocks are written is an error, and the older file stays") {
  const TempFolder folder;
  write_text(folder / "a", "old");
  for (const int threads : {1, 4}) {
    OutputFile out(folder / "a");
    const FullDisk full(100000);
    CHECK_THROWS_AS(on_threads(threads,
                               [&] {
                                 out.put_blocks(100, [](std::size_t, OutputBuffer& buffer) {
                                   for (int i = 0; i < 5000; ++i) buffer.put('x');
                                 });
                               }),
                    Error);
  }
  CHECK(read_text(folder / "a") == "old");
  CHECK(folder.entries() == 1);
}
