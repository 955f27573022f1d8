// SPDX-License-Identifier: MIT
#include "apps/help_formatter.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>

#include <fmt/format.h>

namespace tetmend::apps {
namespace {

constexpr std::size_t kTextColumn = 28;
constexpr std::size_t kHelpWidth = 80;
constexpr const char* kExamples = "Examples:";

constexpr std::array kHeadings = {headings::kUsual,  headings::kChange, headings::kSearch,
                                  headings::kData,   headings::kLarge,  headings::kRecord,
                                  headings::kPlugins};

/// Options of the program itself in commands that have many.
constexpr std::array<std::pair<std::string_view, const char*>, 11> kOwn = {
    {{"format", headings::kData},
     {"variant", headings::kData},
     {"strict", headings::kData},
     {"label-array", headings::kData},
     {"no-config", headings::kData},
     {"pieces", headings::kLarge},
     {"memory", headings::kLarge},
     {"scratch", headings::kLarge},
     {"checkpoint", headings::kLarge},
     {"plugin", headings::kPlugins},
     {"attempt-limit", headings::kPlugins}}};

/// Words in lines of a width.
std::string wrapped(const std::string& text, std::size_t width) {
  std::istringstream words(text);
  std::string lines;
  std::size_t used = 0;
  for (std::string word; words >> word;) {
    const bool fits = used + 1 + word.size() <= width;
    if (used > 0) lines += fits ? ' ' : '\n';
    used = used > 0 && fits ? used + 1 + word.size() : word.size();
    lines += word;
  }
  return lines;
}

/// From a heading to the next empty line; empty where there is none.
std::string block_of(const std::string& text, const std::string& heading) {
  const std::size_t begin = text.find("\n" + heading);
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find("\n\n", begin + 1) - begin) + "\n";
}

}  // namespace

HelpFormatter::HelpFormatter(bool is_short) : is_short_(is_short) {
  column_width(kTextColumn);
  label("Positionals", "Arguments");
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name,
                                     CLI::AppFormatMode mode) const {
  if (mode == CLI::AppFormatMode::Sub) return make_expanded(app);
  std::string text = app->get_description() + "\n" + make_usage(app, name) + make_positionals(app) +
                     list_groups(*app) + list_commands(*app);
  if (!is_short_) return text + "\n" + make_footer(app);
  return text + block_of("\n" + app->get_footer(), kExamples) +
         fmt::format("\nAll there is to say: {} --help\n", name);
}

std::string HelpFormatter::list_groups(const CLI::App& app) const {
  std::string text;
  for (const char* heading : kHeadings) {
    std::vector<const CLI::Option*> options = app.get_options([&](const CLI::Option* option) {
      return option->nonpositional() && option->get_group() == heading;
    });
    std::stable_partition(options.begin(), options.end(),
                          [&](const CLI::Option* option) { return option != app.get_help_ptr(); });
    if (!options.empty()) text += make_group(heading, false, options);
    if (is_short_) break;
  }
  for (const CLI::App* one_of : app.get_subcommands({})) {  // groups are those without a name
    if (!one_of->get_name().empty()) continue;
    text += make_group("At most one of", false, one_of->get_options([&](const CLI::Option* option) {
      return option != one_of->get_help_ptr();
    }));
  }
  return text;
}

std::string HelpFormatter::list_commands(const CLI::App& app) const {
  std::string text;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name().empty()) continue;
    if (text.empty()) text = "\nSubcommands:\n";
    text += make_subcommand(command);
  }
  return text;
}

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
  usage +=
      app->get_subcommands([](const CLI::App* each) { return !each->get_name().empty(); }).empty()
          ? " [OPTIONS]"
          : " SUBCOMMAND ...";
  return usage + "\n";
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  const std::string type = option->get_type_name();
  return type.empty() ? "" : " " + type;
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  return wrapped(option->get_description(), kHelpWidth - kTextColumn);
}

bool asks_for_short_help(const std::vector<std::string>& arguments) {
  const auto has = [&](std::string_view word) {
    return std::find(arguments.begin(), arguments.end(), word) != arguments.end();
  };
  return has("-h") && !has("--help");
}

std::size_t place_in_help(const CLI::Option& option) {
  const auto found = std::find(kHeadings.begin(), kHeadings.end(), option.get_group());
  return static_cast<std::size_t>(found - kHeadings.begin());
}

void group_options(CLI::App& command) {
  for (const auto& [name, heading] : kOwn) {
    CLI::Option* const option = command.get_option_no_throw("--" + std::string(name));
    if (option != nullptr) option->group(heading);
  }
}

std::string message_of(const CLI::ParseError& error) {
  const std::string text = error.what();
  const auto without = [&](std::string_view end) {
    return text.substr(0, text.size() - end.size());
  };
  constexpr std::string_view kRequired = " is required";
  if (error.get_name() == "RequiredError" && text.ends_with(kRequired)) {
    return without(kRequired) + " is missing";
  }
  if (const std::size_t list = text.find("given from [");
      error.get_name() == "RequiredError" && list != std::string::npos) {
    return "at most one is allowed of " +
           text.substr(text.find('[', list) + 1, text.find(']', list) - text.find('[', list) - 1);
  }
  if (error.get_name() != "ArgumentMismatch") return text;
  const std::string option = text.substr(0, text.find(':'));
  constexpr std::string_view kMissing = " missing";
  if (text.ends_with(kMissing)) {  // --output: 1 required OUT missing
    const std::string rest = without(kMissing);
    return fmt::format("{}: {} is missing", option, rest.substr(rest.rfind(' ') + 1));
  }
  if (text.find("At Most 1 required") != std::string::npos) return option + " is given twice";
  return text;
}

}  // namespace tetmend::apps
