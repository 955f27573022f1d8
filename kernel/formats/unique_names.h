// SPDX-License-Identifier: MIT
// Names of which none is like another.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>

namespace tetmend::formats {

class UniqueNames {
 public:
  /// Names are alike that have the same key; null: that are the same.
  using Key = std::string (*)(std::string_view name);
  explicit UniqueNames(Key key = nullptr) : key_(key) {}

  void take(std::string_view name) { last_.try_emplace(key_of(name), 1); }
  /// Takes `name`, or the first of name_2, name_3... that nothing has yet.
  std::string make(const std::string& name) {
    const auto [at, is_new] = last_.try_emplace(key_of(name), 1);
    if (is_new) return name;
    for (int& last = at->second;;) {
      std::string next = fmt::format("{}_{}", name, ++last);
      if (last_.try_emplace(key_of(next), 1).second) return next;
    }
  }

 private:
  std::string key_of(std::string_view name) const {
    return key_ == nullptr ? std::string(name) : key_(name);
  }

  Key key_;
  std::unordered_map<std::string, int> last_;  // the number behind the last that was like it
};

}  // namespace tetmend::formats
