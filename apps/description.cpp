// SPDX-License-Identifier: MIT
// What a parser knows of its program, as data: man pages and completions are made of it, by apps/manual.
#include "apps/description.h"

#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/help_formatter.h"

namespace tetmend::apps {
namespace {

nlohmann::json describe_option(const CLI::Option& option) {
  nlohmann::json names = nlohmann::json::array();
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  const bool is_positional = option.get_positional();
  return {{"names", names},
          {"positional", is_positional ? option.get_name(true) : ""},
          {"value", option.get_expected_max() > 0 && !is_positional ? option.get_type_name() : ""},
          {"required", option.get_required()},
          {"group", option.get_group()},
          {"place", place_in_help(option)},
          {"repeatable", option.get_items_expected_max() > 1 ||
                             option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll},
          {"text", option.get_description()}};
}

/// Options of groups, which are parsers without a name, are those of their command; each has a
/// --help of its own.
void add_options(const CLI::App& app, nlohmann::json& options) {
  const bool is_group = app.get_name().empty();
  for (const CLI::Option* option : app.get_options()) {
    if (is_group && option == app.get_help_ptr()) continue;
    nlohmann::json described = describe_option(*option);
    described["alone"] = is_group && app.get_require_option_max() == 1;
    options.push_back(described);
  }
}

nlohmann::json describe_command(const CLI::App& app) {
  nlohmann::json options = nlohmann::json::array();
  nlohmann::json commands = nlohmann::json::array();
  add_options(app, options);
  for (const CLI::App* below : app.get_subcommands({})) {
    if (!below->get_name().empty()) {
      commands.push_back(describe_command(*below));
    } else {
      add_options(*below, options);
    }
  }
  return {{"name", app.get_name()},
          {"purpose", app.get_description()},
          {"options", options},
          {"commands", commands},
          {"text", app.get_footer()}};
}

}  // namespace

nlohmann::json describe(const CLI::App& app, std::string_view version) {
  nlohmann::json description = describe_command(app);
  description["version"] = version;
  return description;
}

}  // namespace tetmend::apps
