// SPDX-License-Identifier: MIT
// How --help looks: a usage line with all that is required, and option names without the parser's
// types.
#include "apps/help_formatter.h"

#include <fmt/format.h>

namespace tetmend::apps {

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const {
  // The parser puts the name of a subcommand behind that of the program itself.
  std::string usage = fmt::format("\nUsage: {}", name);
  std::string options;
  for (const CLI::Option* option : app->get_options()) {
    if (option->get_positional()) {
      const std::string positional = option->get_name(true);
      usage += option->get_required() ? " " + positional : " [" + positional + "]";
    } else if (option->get_required()) {
      const std::string& shortest = option->get_snames().empty()
                                        ? "-" + option->get_lnames().front()
                                        : option->get_snames().front();
      options += fmt::format(" -{}{}", shortest, make_option_opts(option));
    }
  }
  usage += options;
  usage += app->get_subcommands({}).empty() ? " [OPTIONS]" : " SUBCOMMAND ...";
  return usage + "\n";
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  const std::string type = option->get_type_name();
  return type.empty() ? "" : " " + type;
}

}  // namespace tetmend::apps
