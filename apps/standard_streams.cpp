// SPDX-License-Identifier: MIT
#include "apps/standard_streams.h"

#include <algorithm>
#include <cstdlib>
#include <exception>

#include "apps/commands.h"
#include "kernel/printable.h"
#include "platform/platform.h"

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

namespace {

bool shows_colours(std::FILE* stream) noexcept {
  const char* const no_colour = std::getenv("NO_COLOR");
  const char* const terminal = std::getenv("TERM");
  if (no_colour != nullptr && *no_colour != '\0') return false;
  if (terminal == nullptr || std::string_view(terminal) == "dumb") return false;
  if (stream != stdout && stream != stderr) return false;
  return platform::is_terminal(stream == stdout ? platform::kStandardOutput
                                                : platform::kStandardError);
}

}  // namespace

void say(std::FILE* stream, std::string_view text, Colour colour) noexcept {
  if (!shows_colours(stream)) return say(stream, text);
  const auto code = static_cast<unsigned>(colour);
  const char begin[] = {'\x1b', '[', static_cast<char>('0' + code / 10),
                        static_cast<char>('0' + code % 10), 'm'};
  put(stream, {begin, sizeof begin});
  say(stream, text);
  put(stream, "\x1b[0m");
}

// Also where memory is out.
int complain(Status status, std::string_view message) noexcept {
  std::fflush(stdout);
  if (status == kSuccess) {
    put(stderr, "tetmend: ");
  } else {
    say(stderr, "tetmend: ", Colour::red);
  }
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
