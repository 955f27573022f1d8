// SPDX-License-Identifier: MIT
#include "trace/call_script.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "kernel/formats/input_file.h"
#include "kernel/from_chars.h"

namespace tetmend {

namespace {

/// Compositions, which a script writes as functions of a table.
constexpr std::array<std::string_view, 3> kCompositions = {"sequence", "all_of", "first_of"};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// Takes a text apart from the left; false wherever it is not what is looked for.
class SettingsReader {
 public:
  explicit SettingsReader(std::string_view text) : left_(text) {}

  bool take_all() { return take_list(0) && left_.empty(); }

 private:
  // Compositions do not nest deeper; more would be at the cost of the stack.
  static constexpr int kDeepest = 64;

  bool take_list(int depth) {
    if (depth > kDeepest) return false;
    skip_spaces();
    if (left_.empty() || left_.front() == '}') return true;
    do {
      if (!take_item(depth)) return false;
    } while (take(','));
    return true;
  }
  bool take_item(int depth) {
    skip_spaces();
    if (left_.empty() || !is_letter(left_.front())) return take_value(depth);
    const std::string_view word = take_word();
    if (take('=')) return take_value(depth);
    const auto end = kCompositions.end();
    return std::find(kCompositions.begin(), end, word) != end && take_table(depth);
  }
  bool take_value(int depth) {
    skip_spaces();
    if (left_.empty()) return false;
    const char first = left_.front();
    if (first == '{') return take_table(depth);
    if (first == '"') return take_text();
    if (!is_letter(first)) return take_number();
    const std::string_view word = take_word();
    return word == "true" || word == "false" || word == "inf";
  }
  bool take_table(int depth) { return take('{') && take_list(depth + 1) && take('}'); }
  bool take_text() {
    const std::size_t end = left_.find_first_of("\"\\\n\r", 1);
    if (end == std::string_view::npos || left_[end] != '"') return false;
    left_.remove_prefix(end + 1);
    return true;
  }
  bool take_number() {
    const std::size_t sign = left_.front() == '-' ? 1 : 0;
    if (left_.size() <= sign || !is_digit(left_[sign])) return false;
    double value = 0;
    const auto [end, failed] = from_chars(left_.data(), left_.data() + left_.size(), value);
    if (failed != std::errc()) return false;
    left_.remove_prefix(static_cast<std::size_t>(end - left_.data()));
    return true;
  }
  std::string_view take_word() {
    const auto end = std::find_if_not(left_.begin(), left_.end(),
                                      [](char c) { return is_letter(c) || is_digit(c); });
    const std::string_view word = left_.substr(0, static_cast<std::size_t>(end - left_.begin()));
    left_.remove_prefix(word.size());
    return word;
  }
  bool take(char c) {
    skip_spaces();
    if (left_.empty() || left_.front() != c) return false;
    left_.remove_prefix(1);
    return true;
  }
  void skip_spaces() { left_.remove_prefix(std::min(left_.find_first_not_of(' '), left_.size())); }

  std::string_view left_;
};

}  // namespace

bool is_plain_settings(std::string_view text) {
  return SettingsReader(text).take_all();
}

std::string script_of_call(const TraceFile& file, const Call& call) {
  const std::string_view name = file.name(call.operator_name);
  const std::string_view settings = file.name(call.settings);
  if (!is_plain_settings(settings)) {
    throw Error(fmt::format("{}: event {}: settings that are no list of values: {}",
                            file.path().string(), call.events.begin, formats::in_quotes(settings)));
  }
  if (name == kUntanglingName || name == kVariantsName) {
    throw Error(fmt::format(
        "{}: event {}: {} is no attempt of an operator; --at {} -o FILE writes the mesh, "
        "and {}{{}} of a schedule repeats it",
        file.path().string(), call.events.begin, name, call.events.begin,
        name == kUntanglingName ? "untangle" : "vary"));
  }
  if (name == kSequenceName) return fmt::format("{}{{{}}}", name, settings);
  if (name.find_first_of("\"\\") != std::string_view::npos) {
    throw Error(fmt::format("{}: event {}: an operator of a name that is none: {}",
                            file.path().string(), call.events.begin, formats::in_quotes(name)));
  }
  return fmt::format("{{\"{}\"{}{}}}", name, settings.empty() ? "" : ", ", settings);
}

}  // namespace tetmend
