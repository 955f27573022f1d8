// SPDX-License-Identifier: MIT
#include "apps/folder_options.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/commands.h"
#include "kernel/nearest_word.h"

namespace tetmend::apps {
namespace {

/// A folder may come from a stranger: what it says must not write files, nor run code.
constexpr std::array<std::string_view, 11> kNotThere = {
    "output",    "report",  "trace", "checkpoint", "scratch", "plugin",
    "no-config", "dry-run", "help",  "format",     "quiet"};

std::string trimmed(const std::string& text) {
  constexpr const char* kBlanks = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

/// Without the quotes that TOML wants around text.
std::string unquoted(const std::string& text) {
  const bool is_quoted = text.size() > 1 && (text.front() == '"' || text.front() == '\'') &&
                         text.back() == text.front();
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

std::vector<std::string> names_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      const bool may_be = std::find(kNotThere.begin(), kNotThere.end(), name) == kNotThere.end();
      if (may_be) names.push_back(name);
    }
  }
  return names;
}

/// "--goal=35", "--keep-size", or nothing for a switch that is off.
std::string argument_of(const CLI::Option& option, const std::string& name,
                        const std::string& value) {
  if (option.get_expected_max() > 0) return fmt::format("--{}={}", name, value);
  if (value == "true") return "--" + name;
  if (value == "false") return {};
  throw UsageError(fmt::format("{}: '{}' is neither true nor false", name, value));
}

/// @throws UsageError without the place
std::string read_line(const std::string& line, const CLI::App& command) {
  const std::size_t equals = line.find('=');
  if (equals == std::string::npos) {
    throw UsageError(fmt::format("'{}' is not of the form NAME = VALUE", line));
  }
  const std::string name = trimmed(line.substr(0, equals));
  if (std::find(kNotThere.begin(), kNotThere.end(), name) != kNotThere.end()) {
    throw UsageError(fmt::format("'{}' stands on the command line alone", name));
  }
  const CLI::Option* const option = command.get_option_no_throw("--" + name);
  if (option == nullptr) {
    throw UsageError(fmt::format("{} has no option '{}'{}", command.get_name(), name,
                                 guess(name, names_of(command))));
  }
  if (option->count() > 0) return {};
  return argument_of(*option, name, unquoted(trimmed(line.substr(equals + 1))));
}

}  // namespace

std::vector<std::string> folder_options(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  if (chosen.empty()) return {};
  const CLI::App& command = *chosen.front();
  const CLI::Option* const no_config = command.get_option_no_throw("--no-config");
  if (no_config == nullptr || no_config->count() > 0) return {};
  std::ifstream file{std::filesystem::path(kFolderFile)};
  std::vector<std::string> arguments;
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const std::string said = trimmed(line.substr(0, line.find('#')));
    if (said.empty()) continue;
    try {
      const std::string argument = read_line(said, command);
      if (!argument.empty()) arguments.push_back(argument);
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("{}:{}: {}", kFolderFile, number, error.what()));
    }
  }
  return arguments;
}

}  // namespace tetmend::apps
