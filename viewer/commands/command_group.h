// SPDX-License-Identifier: MIT
// The arguments of a command, read by position; and the groups that the list of commands consists
// of.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "explain/json_text.h"
#include "kernel/error.h"
#include "viewer/commands/commands.h"

namespace tetmend::viewer {

/// Each function throws an Error that names the command, the argument and how it is used.
class Arguments {
 public:
  Arguments(std::string_view command, const nlohmann::json& values)
      : command_(command), values_(values) {}

  bool has(std::size_t i) const { return i < values_.size() && !values_[i].is_null(); }
  double number(std::size_t i) const {
    if (!has(i) || !values_[i].is_number()) fail(i, "a number");
    return values_[i].get<double>();
  }
  std::uint32_t index(std::size_t i, std::size_t bound) const {
    const double n = number(i);
    if (n != std::floor(n) || n < 0 || n >= static_cast<double>(bound)) {
      fail(i, fmt::format("a whole number from 0 to {}", bound == 0 ? 0 : bound - 1));
    }
    return static_cast<std::uint32_t>(n);
  }
  std::string text(std::size_t i) const {
    if (!has(i) || !values_[i].is_string()) fail(i, "a text");
    return values_[i].get<std::string>();
  }
  const nlohmann::json& value(std::size_t i) const { return values_[i]; }
  /// For what argument i, a table, has under that name, and what is wrong with it.
  [[noreturn]] void fail_field(std::string_view name, std::string_view expected,
                               const nlohmann::json& got) const {
    throw Error(fmt::format("{}: {} must be {}, not {}; it is used as {}", command_, name, expected,
                            explain::json_text(got), find_command(command_).usage));
  }

 private:
  [[noreturn]] void fail(std::size_t i, std::string_view expected) const {
    throw Error(fmt::format("{}: argument {} must be {}, not {}; it is used as {}", command_, i + 1,
                            expected, has(i) ? explain::json_text(values_[i]) : "missing",
                            find_command(command_).usage));
  }

  std::string_view command_;
  const nlohmann::json& values_;
};

/// @throws Error when nothing is open.
inline void need_mesh(const Document& document) {
  if (!document.has_mesh()) throw Error("there is no mesh yet: open one first");
}

/// @throws Error when no trace is open.
inline Debugger& need_trace(Document& document) {
  if (document.debugger() == nullptr) throw Error("there is no trace: open one first");
  return *document.debugger();
}

inline bool& setting(Document& document, bool Document::*which) {
  return document.*which;
}
inline bool& setting(Document& document, bool ViewSettings::*which) {
  return document.view.*which;
}
inline bool& setting(Document& document, bool SceneSettings::*which) {
  return document.view.scene.*which;
}
inline bool& setting(Document& document, bool Camera::*which) {
  return document.view.camera.*which;
}
/// A command that turns a setting on or off.
template <auto Setting>
nlohmann::json toggle(Session& s, const nlohmann::json&) {
  bool& value = setting(s.document, Setting);
  value = !value;
  return nullptr;
}

// Menus with commands of several groups.
inline constexpr std::string_view kFileMenu = "File";
inline constexpr std::string_view kViewMenu = "View";

std::span<const Command> file_commands();
std::span<const Command> figure_commands();
std::span<const Command> view_commands();
std::span<const Command> show_commands();
std::span<const Command> select_commands();
std::span<const Command> trace_commands();
std::span<const Command> history_commands();
std::span<const Command> ledger_commands();
std::span<const Command> live_commands();
std::span<const Command> trial_commands();
std::span<const Command> help_commands();
std::span<const Command> script_commands();

}  // namespace tetmend::viewer
