// SPDX-License-Identifier: MIT
// How the program ends when nothing can be caught.
#include "apps/interruption.h"

#include <cstdio>
#include <iostream>
#include <new>
#include <stdexcept>

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "kernel/formats/pending_file.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// The exit status of a child that throws where it may not, with an unfinished file; -1 for a signal.
template <class Exception>
int status_of_terminated(const TempFolder& folder, const Exception& exception) {
  std::cout.flush();
  std::fflush(stdout);
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(::open((folder / "err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), STDERR_FILENO);
    apps::end_without_remains();
    const formats::PendingFile file(folder / "mesh");
    const auto fail = [&] { throw exception; };
    [&]() noexcept { fail(); }();
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_CASE("what cannot be caught ends the program with a line and status 1, without remains") {
  const TempFolder folder;
  CHECK(status_of_terminated(folder, std::bad_alloc()) == 1);
  CHECK(read_text(folder / "err") == "tetmend: out of memory\n");
  CHECK(status_of_terminated(folder, std::runtime_error("no\nthread")) == 1);
  CHECK(read_text(folder / "err") == "tetmend: no thread\n");
  CHECK(folder.entries() == 1);
}
