// SPDX-License-Identifier: MIT
#include "report/repeat.h"

#include <string_view>

#include <fmt/format.h>

#include "explain/page_text.h"

namespace tetmend::report {

namespace {

using explain::escaped;

std::string quoted(const std::string& word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

void add_row(std::string& rows, std::string_view name, const std::string& value) {
  rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", name, value);
}

}  // namespace

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words)
    line += fmt::format("{}{}", line.empty() ? "" : " ", quoted(word));
  return line;
}

std::string repeat_section(const Figures& figures) {
  std::vector<std::string> words = {"tetmend"};
  for (const nlohmann::json& word : figures.at("arguments")) {
    words.push_back(word.get<std::string>());
  }
  std::string rows;
  add_row(rows, "tetmend", figures.shown_text("tetmend"));
  add_row(rows, "schedule", figures.shown_text("schedule"));
  std::string settings;
  for (const auto& [name, value] : figures.at("settings").items()) {
    settings += fmt::format("{}{} = {}", settings.empty() ? "" : ", ", escaped(name),
                            escaped(value.get<std::string>()));
  }
  add_row(rows, "parameters", settings.empty() ? "as the schedule has them" : settings);
  add_row(rows, "goal, degrees",
          fmt::format("{} to {}", figures.shown_digits("goal.min_angle", 6),
                      figures.shown_digits("goal.max_angle", 6)));
  add_row(rows, "measure", figures.shown_text("measure"));
  add_row(rows, "threads", figures.shown_count("threads") + ": any number gives the same mesh");
  add_row(rows, "fingerprint of the surface", figures.shown_text("surface.fingerprint_before"));
  add_row(rows, "seconds", figures.shown("seconds.total", 2));
  if (figures.has("peak_memory_bytes")) {
    add_row(rows, "bytes of memory, at most", figures.shown_count("peak_memory_bytes"));
  }
  const bool is_cut = figures.is_true("interrupted") || figures.is_true("out_of_time");
  return fmt::format(
      "<pre id=\"command\">{}</pre>\n<button type=\"button\" id=\"copy\">Copy</button>\n"
      "<p>{}</p>\n<table class=\"repeat\"><tbody>\n{}</tbody></table>\n",
      escaped(shell_line(words)),
      is_cut ? "This run ended before its schedule did, so another one may end elsewhere."
             : "The same input and the same command give the same mesh, byte for byte.",
      rows);
}

}  // namespace tetmend::report
