// SPDX-License-Identifier: MIT
#include "report/figures.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "explain/json_text.h"
#include "explain/page_text.h"
#include "kernel/grouped.h"

namespace tetmend::report {

namespace {

using explain::escaped;
using nlohmann::json;

std::string as_data(std::string_view path, const json& value, std::string_view shown) {
  return fmt::format(R"(<data data-of="{}" value="{}">{}</data>)", escaped(path),
                     escaped(explain::json_text(value)), shown);
}

}  // namespace

const json& Figures::at(std::string_view path) const {
  static const json kNothing;
  std::string pointer = fmt::format("/{}", path);
  std::replace(pointer.begin(), pointer.end(), '.', '/');
  const json::json_pointer place(pointer);
  return report_.contains(place) ? report_.at(place) : kNothing;
}

double Figures::number(std::string_view path) const {
  const json& value = at(path);
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::size_t Figures::count(std::string_view path) const {
  const json& value = at(path);
  return value.is_number_unsigned() || value.is_number_integer() ? value.get<std::size_t>() : 0;
}

bool Figures::is_true(std::string_view path) const {
  const json& value = at(path);
  return value.is_boolean() && value.get<bool>();
}

std::string Figures::text(std::string_view path) const {
  const json& value = at(path);
  return value.is_string() ? value.get<std::string>() : std::string();
}

std::string Figures::shown_count(std::string_view path) const {
  return as_data(path, at(path), has(path) ? grouped(count(path)) : "unknown");
}

std::string Figures::shown(std::string_view path, int decimals) const {
  return as_data(path, at(path), has(path) ? decimal(number(path), decimals) : "not finite");
}

std::string Figures::shown_digits(std::string_view path, int digits) const {
  return as_data(path, at(path),
                 has(path) ? fmt::format("{:.{}g}", number(path), digits) : "not finite");
}

std::string Figures::shown_text(std::string_view path) const {
  return as_data(path, at(path), escaped(text(path)));
}

std::string short_number(double value) {
  return fmt::format("{:.4g}", value);
}

}  // namespace tetmend::report
