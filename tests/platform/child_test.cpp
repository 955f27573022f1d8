// SPDX-License-Identifier: MIT
#include "platform/child.h"

#include <cerrno>
#include <string>

#include <doctest/doctest.h>

#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using platform::Child;

TEST_CASE("a child reads what is written, and its status comes back") {
  const test::TempFolder folder;
  const std::string out = (folder / "out").string();
  Child child({"dd", "status=none", "of=" + out});
  REQUIRE(child.error() == 0);
  CHECK(child.write("first ") == 0);
  CHECK(child.write("second") == 0);
  CHECK(child.wait() == 0);
  CHECK(child.wait() == 0);
  CHECK(test::read_text(out) == "first second");
  CHECK(child.complaint().empty());
}

TEST_CASE("there is no shell: words with its marks are words") {
  const test::TempFolder folder;
  const std::string out = (folder / "a b;$(true) 'c'").string();
  Child child({"dd", "status=none", "of=" + out});
  CHECK(child.write("x") == 0);
  CHECK(child.wait() == 0);
  CHECK(test::read_text(out) == "x");
}

TEST_CASE("what a child complains of is kept, and its failure is told") {
  Child child({"dd", "if=/no/such/file"});
  REQUIRE(child.error() == 0);
  CHECK(child.wait() != 0);
  CHECK(child.complaint().find("/no/such/file") != std::string::npos);
}

TEST_CASE("a program that is not there is an error number") {
  Child child({"tetmend-no-such-program"});
  CHECK(child.error() == ENOENT);
  CHECK(child.write("x") == EPIPE);
  CHECK(child.wait() != 0);
}

TEST_CASE("a child that reads no more is an error of writing, not the end of the program") {
  Child child({"true"});
  REQUIRE(child.error() == 0);
  const std::string much(1 << 20, 'x');
  CHECK(child.write(much) == EPIPE);
  CHECK(child.wait() == 0);
}
