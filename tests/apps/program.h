// SPDX-License-Identifier: MIT
// Runs the real command line program and catches what it says.
#pragma once

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/kernel/formats/fixtures.h"

namespace tetmend::test {

struct Outcome {
  int status = -1;  ///< exit status; 128 + number for a signal, as in a shell
  std::string out;
  std::string err;
};

/// TETMEND_TEST_PROGRAM may name another: a wrapper that runs it on another system.
inline const char* program() {
  const char* other = std::getenv("TETMEND_TEST_PROGRAM");
  return other == nullptr ? TETMEND_PROGRAM : other;
}

/// The program as a child process; stdout goes to a file, stderr to an open file descriptor.
class Program {
 public:
  /// @param in what the child reads from standard input; empty: what the test has
  Program(const std::vector<std::string>& arguments, const std::filesystem::path& out, int err,
          const std::filesystem::path& in = {}) {
    std::vector<char*> words = {const_cast<char*>(program())};
    for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ < 0) throw std::runtime_error("fork failed");
    if (pid_ > 0) return;
    ::signal(SIGINT, SIG_DFL);  // a test that runs in the background would hand down "ignored"
    if (!in.empty() && ::dup2(::open(in.c_str(), O_RDONLY), STDIN_FILENO) < 0) ::_exit(127);
    const int file = ::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (file >= 0 && ::dup2(file, STDOUT_FILENO) >= 0 && ::dup2(err, STDERR_FILENO) >= 0) {
      ::execv(program(), words.data());
    }
    ::_exit(127);
  }

  void send(int signal) const { ::kill(pid_, signal); }

  int wait() const {
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0) {
      if (errno != EINTR) throw std::runtime_error("waitpid failed");
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  pid_t pid_ = -1;
};

inline Outcome run_program(const std::vector<std::string>& arguments,
                           const std::filesystem::path& in = {}) {
  const TempFolder folder;
  const int err = ::open((folder / "err").c_str(), O_WRONLY | O_CREAT, 0666);
  const int status = Program(arguments, folder / "out", err, in).wait();
  ::close(err);
  return {status, read_text(folder / "out"), read_text(folder / "err")};
}

/// A terminal, seen from the side of the user.
class Terminal {
 public:
  Terminal() : master_(::posix_openpt(O_RDWR | O_NOCTTY)) {
    if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0) {
      throw std::runtime_error("no pseudo terminal");
    }
    slave_ = ::open(::ptsname(master_), O_RDWR | O_NOCTTY);
  }
  ~Terminal() {
    ::close(slave_);
    ::close(master_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  int slave() const { return slave_; }

  /// Reads until `word` has appeared; all that was read so far.
  const std::string& wait_for(const std::string& word) {
    char buffer[4096];
    while (text_.find(word) == std::string::npos) {
      pollfd ready{master_, POLLIN, 0};
      const ssize_t got =
          ::poll(&ready, 1, kPatience) == 1 ? ::read(master_, buffer, sizeof buffer) : 0;
      if (got <= 0) throw std::runtime_error("no '" + word + "' on the terminal: " + text_);
      text_.append(buffer, static_cast<std::size_t>(got));
    }
    return text_;
  }

 private:
  static constexpr int kPatience = 60000;  // milliseconds

  int master_;
  int slave_ = -1;
  std::string text_;
};

}  // namespace tetmend::test
