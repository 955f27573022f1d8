// SPDX-License-Identifier: MIT
#include "schedule/reference.h"

#include <cctype>
#include <sstream>

#include <fmt/format.h>

#include "schedule/words.h"

namespace tetmend {

namespace {

constexpr std::size_t kColumns = 80;

std::string wrap(std::string_view text, std::size_t indent) {
  std::istringstream words{std::string(text)};
  std::string result(indent, ' ');
  std::size_t column = indent;
  for (std::string word; words >> word;) {
    if (column > indent && column + 1 + word.size() > kColumns) {
      result += '\n' + std::string(indent, ' ');
      column = indent;
    }
    if (column > indent) {
      result += ' ';
      ++column;
    }
    result += word;
    column += word.size();
  }
  return result + '\n';
}

std::string range_of(const ParameterSpec& spec) {
  return spec.kind == ParameterSpec::Kind::flag ? std::string("true or false")
                                                : fmt::format("{} to {}", spec.low, spec.high);
}

std::string initial_of(const ParameterSpec& spec) {
  if (spec.kind == ParameterSpec::Kind::flag) return spec.initial != 0 ? "true" : "false";
  return fmt::format("{}", spec.initial);
}

std::string operators_of(const WordInfo& word, std::string_view quote) {
  std::istringstream names{std::string(word.operators)};
  std::string text;
  for (std::string name; names >> name;) {
    text += fmt::format("{}{}{}{}", text.empty() ? "" : " and ", quote, name, quote);
  }
  return text;
}

/// A cell of a Markdown table.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string sentence(std::string_view text) {
  std::string result = fmt::format("{}.", text);
  result[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(result[0])));
  return result;
}

std::string word_in_markdown(const WordInfo& word) {
  std::string text = fmt::format("### `{}`\n\n{}\n", word.usage, sentence(word.help));
  if (!word.fields.empty() || !word.numbers.empty()) {
    text += "\n| argument | takes | default | |\n|---|---|---|---|\n";
    for (const WordField& field : word.fields) {
      text += fmt::format("| `{}` | {} | `{}` | {} |\n", field.name, cell(field.takes),
                          cell(field.initial), cell(field.help));
    }
    for (const ParameterSpec& spec : word.numbers) {
      text += fmt::format("| `{}` | {} | {} | {} |\n", spec.name, range_of(spec), initial_of(spec),
                          cell(spec.help));
    }
  }
  if (!word.operators.empty()) {
    text += fmt::format("\nThe parameters of {} may be given as well (docs/operators.md).\n",
                        operators_of(word, "`"));
  }
  return text;
}

std::string schedule_in_markdown(const ScheduleInfo& info) {
  std::string text = fmt::format("### {}\n\n{}\n", info.name, sentence(info.description));
  if (info.parameters.empty()) return text;
  text += "\n| parameter | takes | default | |\n|---|---|---|---|\n";
  for (const ScheduleParameter& parameter : info.parameters) {
    text += fmt::format("| `{}` | {} | {} | {} |\n", parameter.name, parameter.range(),
                        parameter.initial_text(), cell(parameter.help));
  }
  return text;
}

}  // namespace

std::string format_summary(const ScheduleInfo& info) {
  const bool is_default = info.name == builtin_schedule_names().front();
  return info.name + (is_default ? " (default)\n" : "\n") + wrap(info.description, 2);
}

std::string format_parameters(const ScheduleInfo& info) {
  std::string text = format_summary(info);
  for (const ScheduleParameter& parameter : info.parameters) {
    text += fmt::format("    {:<20} {}, default {}\n", parameter.name, parameter.range(),
                        parameter.initial_text());
    text += wrap(parameter.help, 6);
  }
  return text;
}

std::string format_words() {
  std::string text;
  for (const WordInfo& word : schedule_words()) {
    text += fmt::format("{}{}\n{}", text.empty() ? "" : "\n", word.usage, wrap(word.help, 2));
    for (const WordField& field : word.fields) {
      text += fmt::format("    {:<10} {}, default {}\n{}", field.name, field.takes, field.initial,
                          wrap(field.help, 6));
    }
    for (const ParameterSpec& spec : word.numbers) {
      text += fmt::format("    {:<10} {}, default {}\n{}", spec.name, range_of(spec),
                          initial_of(spec), wrap(spec.help, 6));
    }
    if (!word.operators.empty()) {
      text += wrap("and the parameters of " + operators_of(word, ""), 4);
    }
  }
  return text;
}

std::string format_reference() {
  std::string text = "## Words\n";
  for (const WordInfo& word : schedule_words()) text += fmt::format("\n{}", word_in_markdown(word));
  text += "\n## Schedules that come with tetmend\n";
  for (const std::string_view name : builtin_schedule_names()) {
    text += fmt::format("\n{}", schedule_in_markdown(Schedule::builtin(name).describe()));
  }
  return text;
}

}  // namespace tetmend
