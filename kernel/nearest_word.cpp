// SPDX-License-Identifier: MIT
#include "kernel/nearest_word.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

namespace tetmend {

namespace {

/// Letters added, left out, replaced, or swapped with the next one.
std::size_t count_slips(std::string_view a, std::string_view b) {
  std::vector<std::size_t> last(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    next[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      next[j] =
          std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool are_swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (are_swapped) next[j] = std::min(next[j], last[j - 2] + 1);
    }
    last.swap(row);
    row.swap(next);
  }
  return row[b.size()];
}

}  // namespace

bool is_name(std::string_view text) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !text.empty() && text[0] >= 'a' && std::all_of(text.begin(), text.end(), fits);
}

std::string nearest_word(std::string_view word, std::span<const std::string> candidates) {
  constexpr std::size_t kMostWord = 64;  // longer ones are no slips
  if (word.size() > kMostWord) return {};
  std::string nearest;
  std::size_t fewest = std::max<std::size_t>(word.size() / 3, 1) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t slips = count_slips(word, candidate);
    if (slips >= fewest) continue;
    fewest = slips;
    nearest = candidate;
  }
  return nearest;
}

std::string guess_of(std::string_view word, std::string_view valid) {
  constexpr std::string_view kBetween = ", ";
  std::vector<std::string> candidates;
  while (!valid.empty()) {
    const std::size_t end = std::min(valid.find(kBetween), valid.size());
    candidates.emplace_back(valid.substr(0, end));
    valid.remove_prefix(std::min(end + kBetween.size(), valid.size()));
  }
  const std::string nearest = nearest_word(word, candidates);
  return nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
}

std::string guess(std::string_view word, std::span<const std::string> candidates) {
  const std::string nearest = nearest_word(word, candidates);
  return nearest.empty() ? "" : fmt::format(": did you mean '{}'?", nearest);
}

}  // namespace tetmend
