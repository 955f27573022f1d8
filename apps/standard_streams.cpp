// SPDX-License-Identifier: MIT
#include "apps/standard_streams.h"

#include <algorithm>
#include <array>
#include <csignal>

#include <fcntl.h>
#include <unistd.h>

#include "apps/commands.h"

namespace tetmend::apps {

void reserve_standard_streams() noexcept {
  // The other way round: what is meant for reading can only be written, and vice versa.
  constexpr std::array<int, 3> kModes = {O_WRONLY, O_RDONLY, O_RDONLY};
  for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; ++fd) {
    if (::fcntl(fd, F_GETFD) != -1) continue;
    // The lowest free number is this one, for those below are taken.
    static_cast<void>(::open("/dev/null", kModes[static_cast<std::size_t>(fd)]));
  }
}

void say(std::FILE* stream, std::string_view text) noexcept {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stream));
}

void ignore_broken_pipes() noexcept {
  ::signal(SIGPIPE, SIG_IGN);
}

// Also where memory is out: nothing here may need some.
int complain(Status status, std::string_view message) noexcept {
  std::fflush(stdout);
  say(stderr, "tetmend: ");
  while (!message.empty()) {
    const std::string_view line = message.substr(0, message.find('\n'));
    say(stderr, line);
    if (line.size() < message.size()) say(stderr, " ");
    message.remove_prefix(std::min(line.size() + 1, message.size()));
  }
  say(stderr, "\n");
  return status;
}

}  // namespace tetmend::apps
