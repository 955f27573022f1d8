// SPDX-License-Identifier: MIT
#include "apps/folder_options.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <span>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/commands.h"
#include "kernel/nearest_word.h"

namespace tetmend::apps {
namespace {

/// A folder may come from a stranger: what it says must not write files, nor run code, nor change what
/// stays unless the command line asks for it.
constexpr std::array<std::string_view, 15> kNotThere = {
    "output", "report", "trace", "checkpoint", "scratch", "plugin",          "no-config", "dry-run",
    "help",   "format", "quiet", "verbose",    "surface", "ignore-interior", "straighten"};

/// Two names of one option.
constexpr std::array<std::string_view, 2> kPurposes = {"for", "purpose"};

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

bool contains(std::span<const std::string_view> words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::vector<std::string> names_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      if (!contains(kNotThere, name)) names.push_back(name);
    }
  }
  return names;
}

bool is_said(const CLI::App& command, std::string_view name) {
  const auto has = [&](std::string_view each) {
    const CLI::Option* const option = command.get_option_no_throw("--" + std::string(each));
    return option != nullptr && option->count() > 0;
  };
  if (contains(kPurposes, name)) return std::any_of(kPurposes.begin(), kPurposes.end(), has);
  return has(name);
}

/// "--goal=35", "--keep-size", or nothing for a switch that is off.
std::string argument_of(const CLI::Option& option, const std::string& name,
                        const std::string& value) {
  if (value.empty()) throw UsageError(fmt::format("{}: the value is missing", name));
  if (option.get_expected_max() > 0) return fmt::format("--{}={}", name, value);
  if (value == "true") return "--" + name;
  if (value == "false") return {};
  throw UsageError(fmt::format("{}: '{}' is neither true nor false", name, value));
}

/// What stands before a comment: a # at the beginning or behind a blank, outside of quotes.
std::string without_comment(const std::string& line) {
  char quote = '\0';
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#' && (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t')) {
      return line.substr(0, i);
    }
  }
  return line;
}

/// The file for one command.
class FolderFile {
 public:
  FolderFile(const CLI::App& app, const CLI::App& command) : app_(app), command_(command) {}

  /// @throws UsageError without the place
  void take(std::size_t number, const std::string& line) {
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) {
      throw UsageError(fmt::format("'{}' is not of the form NAME = VALUE", line));
    }
    const std::string name = trimmed(line.substr(0, equals));
    if (contains(kNotThere, name)) {
      throw UsageError(fmt::format("'{}' stands on the command line alone", name));
    }
    const CLI::Option* const option = command_.get_option_no_throw("--" + name);
    if (option == nullptr) {
      if (is_of_another(name)) return;
      throw UsageError(fmt::format("{} has no option '{}'{}", command_.get_name(), name,
                                   guess(name, names_of(command_))));
    }
    std::string argument = argument_of(*option, name, unquoted(trimmed(line.substr(equals + 1))));
    if (argument.empty() || is_said(command_, name)) return;
    taken_.push_back({option, {number, std::move(argument)}});
  }

  std::vector<FolderOption> options() const {
    std::vector<FolderOption> options;
    for (const Taken& each : taken_) {
      if (can_be(*each.option)) options.push_back(each.folder);
    }
    return options;
  }

 private:
  struct Taken {
    const CLI::Option* option;
    FolderOption folder;
  };

  /// A file serves improve and adapt.
  bool is_of_another(const std::string& name) const {
    const auto others = app_.get_subcommands([](const CLI::App* each) {
      return each->get_name() == "improve" || each->get_name() == "adapt";
    });
    return std::any_of(others.begin(), others.end(), [&](const CLI::App* other) {
      return other->get_option_no_throw("--" + name) != nullptr;
    });
  }

  bool can_be(const CLI::Option& option) const {
    const auto is_there = [&](const CLI::Option* needed) {
      return needed->count() > 0 ||
             std::any_of(taken_.begin(), taken_.end(),
                         [&](const Taken& each) { return each.option == needed; });
    };
    const auto needs = option.get_needs();
    const auto excludes = option.get_excludes();
    return std::all_of(needs.begin(), needs.end(), is_there) &&
           std::none_of(excludes.begin(), excludes.end(),
                        [](const CLI::Option* other) { return other->count() > 0; });
  }

  const CLI::App& app_;
  const CLI::App& command_;
  std::vector<Taken> taken_;
};

/// The file is read as it is, wherever it is.
std::ifstream open_folder_file(const std::filesystem::path& path) {
  std::error_code error;
  std::ifstream file(path);
  if (std::filesystem::is_directory(path, error) || !file) {
    throw Error(fmt::format("{}: it cannot be read; --no-config does without it", kFolderFile));
  }
  return file;
}

}  // namespace

std::filesystem::path folder_file(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  if (chosen.empty()) return {};
  const CLI::Option* const no_config = chosen.front()->get_option_no_throw("--no-config");
  if (no_config == nullptr || no_config->count() > 0) return {};
  std::error_code error;
  const std::filesystem::path path(kFolderFile);
  return std::filesystem::exists(path, error) ? path : std::filesystem::path();
}

std::vector<FolderOption> folder_options(const CLI::App& app) {
  const std::filesystem::path path = folder_file(app);
  if (path.empty()) return {};
  std::ifstream file = open_folder_file(path);
  FolderFile folder(app, *app.get_subcommands().front());
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (number == 1 && line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
    const std::string said = trimmed(without_comment(line));
    if (said.empty()) continue;
    try {
      folder.take(number, said);
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("{}:{}: {}", kFolderFile, number, error.what()));
    }
  }
  return folder.options();
}

}  // namespace tetmend::apps
