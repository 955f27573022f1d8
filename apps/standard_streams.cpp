// SPDX-License-Identifier: MIT
#include "apps/standard_streams.h"

#include <algorithm>

#include "apps/commands.h"

namespace tetmend::apps {

void say(std::FILE* stream, std::string_view text) noexcept {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stream));
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
