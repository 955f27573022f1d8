// SPDX-License-Identifier: MIT
#include "kernel/formats/unique_names.h"

#include <algorithm>

namespace tetmend::formats {
namespace {

bool is_control(char c) {
  return static_cast<unsigned char>(c) < ' ';
}

}  // namespace

std::string_view whole_characters(std::string_view text, std::size_t most) {
  if (text.size() <= most) return text;
  constexpr std::size_t kMostOfCharacter = 4;
  const auto continues = [&](std::size_t i) {
    return (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U;
  };
  std::size_t end = most;
  while (end > 0 && most - end < kMostOfCharacter && continues(end)) --end;
  return text.substr(0, continues(end) ? most : end);  // the bytes may be no UTF-8
}

bool fits(std::string_view name, const NameRules& rules) {
  if (name.empty() || name.size() > rules.most || name.back() == ' ') return false;
  if (std::any_of(name.begin(), name.end(), is_control)) return false;
  return !rules.is_of_path() || (name.front() != ' ' && name != "." && name != ".." &&
                                 name.find('/') == std::string_view::npos);
}

std::string fit_name(std::string name, const NameRules& rules) {
  if (fits(name, rules)) return name;
  for (char& c : name) {
    if (is_control(c)) c = '_';
    if (c == '/') c = rules.slash;
  }
  const std::size_t first = rules.is_of_path() ? name.find_first_not_of(' ') : 0;
  name.erase(0, first);
  name.resize(whole_characters(name, rules.most).size());
  name.resize(name.find_last_not_of(' ') + 1);
  return fits(name, rules) ? name : "unnamed";
}

}  // namespace tetmend::formats
