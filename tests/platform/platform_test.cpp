// SPDX-License-Identifier: MIT
// What the system gives: files by descriptor, signals, memory. Where a test of the layers above says
// the same, it is not repeated here.
#include "platform/platform.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "platform/memory.h"
#include "tests/kernel/formats/fixtures.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// How a child ended that ran `work`: its exit status, or 128 + the number of a signal.
template <class Work>
int status_of_child(const Work& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    work();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

extern "C" void leave_with_number(int number) {
  ::_exit(number);
}
extern "C" void say_number(int number) {
  const char digit = static_cast<char>('0' + number % 10);
  static_cast<void>(platform::write_fully(platform::kStandardError, {&digit, 1}));
}

}  // namespace

TEST_CASE("a new file takes no name that is there, not even that of a link to nothing") {
  const TempFolder folder;
  const auto made = platform::create(folder / "a", platform::Access::owner_only);
  REQUIRE(made);
  CHECK(platform::look_at(made.value.number()).value.permissions == 0600);
  CHECK(platform::create(folder / "a", platform::Access::as_usual).error == EEXIST);
  std::filesystem::create_symlink(folder / "none", folder / "link");
  CHECK(platform::create(folder / "link", platform::Access::as_usual).error == EEXIST);
  CHECK(platform::create(folder / "none" / "a", platform::Access::as_usual).error == ENOENT);
}

TEST_CASE("what is opened goes to no child, and opening a pipe that nobody writes returns") {
  const TempFolder folder;
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  const auto pipe = platform::open_to_read(folder / "pipe");
  REQUIRE(pipe);
  CHECK(platform::look_at(pipe.value.number()).value.kind == platform::FileKind::other);
  const auto made = platform::create(folder / "a", platform::Access::as_usual);
  const auto nameless = platform::create_nameless();
  for (const int number : {pipe.value.number(), made.value.number(), nameless.value.number()}) {
    CHECK(::fcntl(number, F_GETFD) == FD_CLOEXEC);
  }
  CHECK(platform::open_to_read(folder / "none").error == ENOENT);
}

TEST_CASE("a descriptor closes its file once, and moves") {
  auto made = platform::create_nameless();
  const int number = made.value.number();
  platform::Descriptor other = std::move(made.value);
  CHECK_FALSE(made.value.is_open());
  CHECK(other.number() == number);
  CHECK(other.close() == 0);
  CHECK_FALSE(other.is_open());
  CHECK(::fcntl(number, F_GETFD) == -1);
  CHECK(other.close() == 0);
}

TEST_CASE("a file without a name is read again at any place") {
  const auto made = platform::create_nameless();
  REQUIRE(platform::write_fully(made.value.number(), "0123456789") == 0);
  std::array<char, 4> buffer{};
  CHECK(platform::read_at(made.value.number(), 7, buffer).value == 3);
  CHECK(std::string(buffer.data(), 3) == "789");
  CHECK(platform::read_at(made.value.number(), 10, buffer).value == 0);
}

TEST_CASE("a full disk and a closed descriptor are told by their numbers") {
  const platform::Descriptor full(::open("/dev/full", O_WRONLY | O_CLOEXEC));
  CHECK(platform::write_fully(full.number(), "x") == ENOSPC);
  std::array<char, 1> buffer{};
  CHECK(platform::read_some(-1, buffer).error == EBADF);
  CHECK(platform::synchronise(-1) == EBADF);
}

TEST_CASE("a link is looked at by its own name or through it; names are counted") {
  const TempFolder folder;
  write_text(folder / "a", "abc");
  std::filesystem::create_symlink(folder / "a", folder / "link");
  REQUIRE(platform::add_name(folder / "a", folder / "b") == 0);
  CHECK(platform::add_name(folder / "a", folder / "b") == EEXIST);
  const auto through = platform::look_at(folder / "link");
  CHECK(through.value.kind == platform::FileKind::regular);
  CHECK(through.value.size == 3);
  CHECK(through.value.names == 2);
  CHECK(platform::look_at_name(folder / "link").value.kind == platform::FileKind::other);
  CHECK(platform::look_at(folder / "").value.kind == platform::FileKind::folder);
}

TEST_CASE("the arguments of a program are its words; a variable that is not set is empty") {
  std::vector<std::string> words = {"tetmend", "", "\xc3\xa4 b"};
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  CHECK(platform::arguments(3, pointers.data()) == words);
  ::unsetenv("TETMEND_TEST_VARIABLE");
  CHECK(platform::trusted_variable("TETMEND_TEST_VARIABLE").empty());
  ::setenv("TETMEND_TEST_VARIABLE", "a:b", 1);
  CHECK(platform::trusted_variable("TETMEND_TEST_VARIABLE") == "a:b");
  ::unsetenv("TETMEND_TEST_VARIABLE");
}

TEST_CASE("the file of the program is found") {
  CHECK(platform::program_file().filename() == "unit_tests");
}

TEST_CASE("peak memory is in bytes") {
  const std::size_t before = platform::peak_memory();
  constexpr std::size_t kSize = std::size_t{1} << 28;
  {
    const std::vector<char> block(kSize, 'x');
    const volatile char* seen = block.data();  // or a compiler leaves the block out
    CHECK(seen[kSize - 1] == 'x');
  }
  const std::size_t after = platform::peak_memory();
  CHECK(after >= kSize);
  CHECK(after <= before + 2 * kSize);
}

TEST_CASE("memory for a process is that of the machine, or less by a limit") {
  const std::uint64_t all = platform::memory_for_process();
  CHECK(all > std::uint64_t{1} << 28);
  CHECK(all < std::uint64_t{1} << 60);
  rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_AS, &before) == 0);
  rlimit limit = before;
  limit.rlim_cur = all - 4096;
  REQUIRE(::setrlimit(RLIMIT_AS, &limit) == 0);
  const std::uint64_t less = platform::memory_for_process();
  REQUIRE(::setrlimit(RLIMIT_AS, &before) == 0);
  CHECK(less == all - 4096);
}

TEST_CASE("a signal that ends programs calls the handler, one that is ignored stays so") {
  using platform::EndSignals;
  for (const int number : {SIGHUP, SIGINT, SIGTERM, SIGXCPU, SIGUSR1, SIGUSR2, SIGALRM}) {
    const bool is_of_terminals = number == SIGHUP || number == SIGINT || number == SIGTERM;
    const auto end_by = [number](EndSignals which, void (*before)(int)) {
      return status_of_child([=] {
        ::signal(number, before);
        platform::on_end_signals(which, leave_with_number);
        ::raise(number);
      });
    };
    CHECK(end_by(EndSignals::batch, SIG_DFL) == number);
    CHECK(end_by(EndSignals::batch, SIG_IGN) == 0);
    CHECK(end_by(EndSignals::terminal, SIG_DFL) == (is_of_terminals ? number : 128 + number));
  }
}

TEST_CASE("a crash calls the handler once, then ends the program as it would have") {
  const TempFolder folder;
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
    const int status = status_of_child([&] {
      ::dup2(::open((folder / "err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), STDERR_FILENO);
      platform::provide_crash_stack();
      platform::on_crashes(say_number);
      ::raise(number);
    });
    CHECK(status == 128 + number);
    CHECK(read_text(folder / "err") == std::to_string(number % 10));
  }
}

TEST_CASE("libraries have a name of their own; one that cannot be opened says why") {
  CHECK(platform::is_library_name("folder/a.so"));
  CHECK_FALSE(platform::is_library_name("folder/so"));
  CHECK_FALSE(platform::is_library_name("a.so.1"));
  const platform::SharedLibrary none("/none.so");
  CHECK_FALSE(none.is_open());
  CHECK(platform::loading_error().find("/none.so") != std::string::npos);
  CHECK(platform::loading_error() == "unknown reason");
}
