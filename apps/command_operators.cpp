// SPDX-License-Identifier: MIT
// tetmend operators: what there is to work with.
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tetmend/catalogue.h>

#include "apps/commands.h"
#include "apps/plugins.h"
#include "apps/standard_streams.h"
#include "kernel/nearest_word.h"

namespace tetmend::apps {
namespace {

using Parameter = OperatorDescription::Parameter;

std::string format_range(const Parameter& spec) {
  switch (spec.kind) {
    case Parameter::Kind::flag:
      return "0 or 1";
    case Parameter::Kind::integer:
      return fmt::format("{:.0f} to {:.0f}", spec.low, spec.high);
    case Parameter::Kind::real:
      return fmt::format("{:g} to {:g}", spec.low, spec.high);
  }
  return {};
}

std::string_view kind_name(Parameter::Kind kind) {
  switch (kind) {
    case Parameter::Kind::flag:
      return "flag";
    case Parameter::Kind::integer:
      return "integer";
    case Parameter::Kind::real:
      return "real";
  }
  return {};
}

/// As a sentence in a table: first letter large, no bar that would end the cell.
std::string as_sentence(std::string_view text) {
  std::string result;
  for (const char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  if (!result.empty() && result[0] >= 'a' && result[0] <= 'z') {
    result[0] = static_cast<char>(result[0] - 'a' + 'A');
  }
  return result;
}

void print_operator(const OperatorDescription& info) {
  say(stdout, fmt::format("{}\n  target: {}\n  {}\n", info.name, info.target, info.help));
  if (!info.plugin.empty()) say(stdout, fmt::format("  plugin: {}\n", info.plugin.string()));
  for (const Parameter& spec : info.parameters) {
    say(stdout, fmt::format("    {:<20} {}, {}, default {:g}\n      {}\n", spec.name,
                            kind_name(spec.kind), format_range(spec), spec.initial, spec.help));
  }
}

/// One section for each operator, with a table of its parameters.
std::string markdown_table(const std::vector<OperatorDescription>& operators) {
  std::string text;
  for (const OperatorDescription& info : operators) {
    text += fmt::format("### {}\n\nTarget: {}. {}.\n\n", info.name, info.target,
                        as_sentence(info.help));
    if (info.parameters.empty()) {
      text += "No parameters.\n\n";
      continue;
    }
    text += "| Parameter | Range | Default | Meaning |\n|---|---|---|---|\n";
    for (const Parameter& spec : info.parameters) {
      text += fmt::format("| `{}` | {}, {} | {:g} | {} |\n", spec.name, kind_name(spec.kind),
                          format_range(spec), spec.initial, as_sentence(spec.help));
    }
    text += '\n';
  }
  if (!text.empty()) text.pop_back();
  return text;
}

const OperatorDescription& find_operator(const std::vector<OperatorDescription>& operators,
                                         const std::string& name) {
  std::string valid;
  for (const OperatorDescription& info : operators) {
    if (info.name == name) return info;
    valid += (valid.empty() ? "" : ", ") + info.name;
  }
  throw UsageError(
      fmt::format("unknown operator '{}'; valid: {}{}", name, valid, guess_of(name, valid)));
}

struct OperatorsOptions {
  std::string name;  // empty: all
  std::vector<std::filesystem::path> plugins;
  bool markdown = false;
};

int run_operators(const OperatorsOptions& options) {
  const std::vector<OperatorDescription> operators =
      tetmend::operators(all_plugins(options.plugins));
  if (options.markdown) {
    say(stdout, markdown_table(operators));
    return 0;
  }
  if (!options.name.empty()) {
    print_operator(find_operator(operators, options.name));
    return 0;
  }
  bool first = true;
  for (const OperatorDescription& info : operators) {
    if (!first) say(stdout, "\n");
    first = false;
    print_operator(info);
  }
  return 0;
}

}  // namespace

void add_operators(CLI::App& app, Invocation& invocation) {
  const auto options = std::make_shared<OperatorsOptions>();
  CLI::App* command = app.add_subcommand("operators", "List the operators and their parameters");
  command->add_option("NAME", options->name, "Only this operator")->type_name("");
  add_plugin_option(*command, options->plugins);
  command->add_flag("--markdown", options->markdown, "As the tables of docs/operators.md");
  command->footer(
      R"(An operator tries to improve the mesh at one place: a tet, an edge, a face or a
vertex.

Examples:
  tetmend operators
  tetmend operators smoothing
  tetmend operators --plugin ./my_operator.so

Exit status: 0 success, 1 a plugin cannot be loaded, 2 wrong usage)");
  command->callback([options, &invocation] {
    invocation.action = [options] { return run_operators(*options); };
  });
}

}  // namespace tetmend::apps
