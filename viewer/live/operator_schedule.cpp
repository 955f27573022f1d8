// SPDX-License-Identifier: MIT
#include "viewer/live/operator_schedule.h"

#include <fmt/format.h>

namespace tetmend::viewer {

namespace {

/// As Lua writes a text.
std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result + '"';
}

std::string number(const ParameterSpec& spec, double value) {
  if (spec.kind == ParameterSpec::Kind::integer) {
    return fmt::format("{}", static_cast<long long>(value));
  }
  const std::string text = fmt::format("{}", value);
  return text.find_first_of(".en") == text.npos ? text + ".0" : text;
}

std::string declaration(const ParameterSpec& spec) {
  const std::string help = quoted(spec.help);
  if (spec.kind == ParameterSpec::Kind::flag) {
    return fmt::format("parameter{{\"{}\", default = {}, help = {}}}", spec.name, spec.initial != 0,
                       help);
  }
  return fmt::format("parameter{{\"{}\", default = {}, low = {}, high = {}, help = {}}}", spec.name,
                     number(spec, spec.initial), number(spec, spec.low), number(spec, spec.high),
                     help);
}

}  // namespace

Schedule operator_schedule(const OperatorInfo& info) {
  std::string text = fmt::format("description {}\n", quoted(info.help));
  text +=
      "local rounds_at_most = parameter{\"rounds_at_most\", default = 1, low = 1, high = 100, "
      "help = \"passes over the bad tets; they end when nothing is accepted\"}\n";
  text += "local what = {" + quoted(info.name) + "}\n";
  for (const ParameterSpec& spec : info.parameters) {
    text += fmt::format("what[\"{}\"] = {}\n", spec.name, declaration(spec));
  }
  text +=
      "for round = 1, rounds_at_most do\n"
      "  begin_round()\n"
      "  if apply(what) == 0 then break end\n"
      "end\n";
  return {std::string(kOperatorPrefix) + std::string(info.name), std::move(text)};
}

Schedule find_schedule(const Registry& registry, const std::string& name) {
  if (!name.starts_with(kOperatorPrefix)) return Schedule::find(name);
  return operator_schedule(registry.find(std::string_view(name).substr(kOperatorPrefix.size())));
}

}  // namespace tetmend::viewer
