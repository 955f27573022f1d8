// SPDX-License-Identifier: MIT
#include "pieces/ranks.h"

namespace tetmend {

Ranks::~Ranks() = default;

void Ranks::meet() {
  gather({});
}

bool Ranks::any(bool here) {
  std::int64_t count = here ? 1 : 0;
  add({&count, 1});
  return count > 0;
}

std::vector<std::string> OneRank::gather(std::string_view mine) {
  return {std::string(mine)};
}

void OneRank::add(std::span<std::int64_t>) {}

std::vector<std::string> OneRank::exchange(std::vector<std::string> to) {
  return to;
}

}  // namespace tetmend
