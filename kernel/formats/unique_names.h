// SPDX-License-Identifier: MIT
// Names that a format takes, of which none is like another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>

namespace tetmend::formats {

/// What a format asks of a name: no control characters, no blanks at the end, not empty, and this.
struct NameRules {
  std::size_t most = SIZE_MAX;  ///< bytes
  /// Of parts of a path, which do not begin with a blank, and are not "." or "..": what stands for a
  /// slash. Else a slash stays one.
  char slash = '/';

  bool is_of_path() const { return slash != '/'; }
};

/// The first bytes of UTF-8, no more than `most`, without a part of a character at the end.
std::string_view whole_characters(std::string_view text, std::size_t most);

bool fits(std::string_view name, const NameRules& rules);
/// The name itself where it fits, else one that is like it and does.
std::string fit_name(std::string name, const NameRules& rules);

class UniqueNames {
 public:
  /// Names are alike that have the same key; null: that are the same.
  using Key = std::string (*)(std::string_view name);
  explicit UniqueNames(Key key = nullptr, const NameRules& rules = {}) : key_(key), rules_(rules) {}
  explicit UniqueNames(const NameRules& rules) : UniqueNames(nullptr, rules) {}

  bool has(std::string_view name) const { return last_.contains(key_of(name)); }
  void take(std::string_view name) { last_.try_emplace(key_of(name), 1); }
  /// Takes `name`, or the first of name_2, name_3... that nothing has yet. Precondition: `name` fits.
  std::string make(const std::string& name) {
    const auto [at, is_new] = last_.try_emplace(key_of(name), 1);
    if (is_new) return name;
    for (int& last = at->second;;) {
      std::string next = numbered(name, ++last);
      if (last_.try_emplace(key_of(next), 1).second) return next;
    }
  }
  /// Makes it fit first.
  std::string make_fit(std::string name) { return make(fit_name(std::move(name), rules_)); }

  const NameRules& rules() const { return rules_; }

 private:
  /// name_2, within the length that names have.
  std::string numbered(std::string_view name, int number) const {
    const std::string ending = fmt::format("_{}", number);
    return std::string(whole_characters(name, rules_.most - ending.size())) + ending;
  }
  std::string key_of(std::string_view name) const {
    return key_ == nullptr ? std::string(name) : key_(name);
  }

  Key key_;
  NameRules rules_;
  std::unordered_map<std::string, int> last_;  // the number behind the last that was like it
};

}  // namespace tetmend::formats
