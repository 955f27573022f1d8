// SPDX-License-Identifier: MIT
#include "apps/standard_streams.h"

#include <algorithm>
#include <exception>

#include "apps/commands.h"
#include "kernel/printable.h"

namespace tetmend::apps {

namespace {

void put(std::FILE* stream, std::string_view text) noexcept {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stream));
}

/// Where memory is out.
void put_ascii(std::FILE* stream, std::string_view text) noexcept {
  for (const char c : text) {
    const bool is_shown = (c >= ' ' && c <= '~') || c == '\n' || c == '\t';
    std::fputc(is_shown ? c : '?', stream);
  }
}

}  // namespace

void say(std::FILE* stream, std::string_view text) noexcept {
  try {
    put(stream, printable_lines(text));
  } catch (const std::exception&) {
    put_ascii(stream, text);
  }
}

// Also where memory is out.
int complain(Status status, std::string_view message) noexcept {
  std::fflush(stdout);
  put(stderr, "tetmend: ");
  while (!message.empty()) {
    const std::string_view line = message.substr(0, message.find('\n'));
    say(stderr, line);
    if (line.size() < message.size()) put(stderr, " ");
    message.remove_prefix(std::min(line.size() + 1, message.size()));
  }
  put(stderr, "\n");
  return status;
}

}  // namespace tetmend::apps
