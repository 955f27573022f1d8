// SPDX-License-Identifier: MIT
// tetmend operators: what there is to work with.
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/commands.h"
#include "ops/registry.h"

namespace tetmend::apps {
namespace {

std::string format_range(const ParameterSpec& spec) {
  switch (spec.kind) {
    case ParameterSpec::Kind::flag:
      return "0 or 1";
    case ParameterSpec::Kind::integer:
      return fmt::format("{:.0f} to {:.0f}", spec.low, spec.high);
    case ParameterSpec::Kind::real:
      return fmt::format("{:g} to {:g}", spec.low, spec.high);
  }
  return {};
}

std::string_view kind_name(ParameterSpec::Kind kind) {
  switch (kind) {
    case ParameterSpec::Kind::flag:
      return "flag";
    case ParameterSpec::Kind::integer:
      return "integer";
    case ParameterSpec::Kind::real:
      return "real";
  }
  return {};
}

void print_operator(const OperatorInfo& info) {
  fmt::print("{}\n  target: {}\n  {}\n", info.name, to_string(info.target), info.help);
  for (const ParameterSpec& spec : info.parameters) {
    fmt::print("    {:<20} {}, {}, default {:g}\n      {}\n", spec.name, kind_name(spec.kind),
               format_range(spec), spec.initial, spec.help);
  }
}

int run_operators(const std::string& name) {
  Registry registry;
  register_builtin_operators(registry);
  if (!name.empty()) {
    try {
      print_operator(registry.find(name));
    } catch (const Error& error) {
      throw UsageError(error.what());
    }
    return 0;
  }
  bool first = true;
  for (const OperatorInfo* info : registry.operators()) {
    if (!first) fmt::print("\n");
    first = false;
    print_operator(*info);
  }
  return 0;
}

}  // namespace

void add_operators(CLI::App& app, Invocation& invocation) {
  const auto name = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("operators", "List the operators and their parameters");
  command->add_option("NAME", *name, "Only this operator")->type_name("");
  command->footer(
      R"(An operator tries to improve the mesh at one place: a tet, an edge, a face or a
vertex.

Examples:
  tetmend operators
  tetmend operators smoothing

Exit status: 0 success, 2 wrong usage)");
  command->callback(
      [name, &invocation] { invocation.action = [name] { return run_operators(*name); }; });
}

}  // namespace tetmend::apps
