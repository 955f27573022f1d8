// SPDX-License-Identifier: MIT
// What of a child is the same on all systems.
#include "platform/child.h"

#include <algorithm>
#include <array>
#include <cerrno>

namespace tetmend::platform {

int Child::write(std::string_view bytes) noexcept {
  return input_.is_open() ? write_fully(input_.number(), bytes) : EPIPE;
}

std::string Child::complaint() const {
  constexpr std::size_t kMost = 1 << 16;
  std::string text;
  std::array<char, 4096> buffer{};
  while (complaints_.is_open() && text.size() < kMost) {
    const auto got = read_at(complaints_.number(), text.size(), buffer);
    if (!got || got.value == 0) break;
    text.append(buffer.data(), got.value);
  }
  return text;
}

}  // namespace tetmend::platform
