// SPDX-License-Identifier: MIT
#include "ops/parameters.h"

#include <cassert>
#include <cmath>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/nearest_word.h"

namespace tetmend {

ParameterValues::ParameterValues(std::string_view owner, std::span<const ParameterSpec> specs,
                                 const ParameterSettings& settings)
    : specs_(specs) {
  for (const ParameterSpec& spec : specs) values_.push_back(spec.initial);
  for (const auto& [name, value] : settings) {
    std::size_t i = 0;
    std::string valid;
    while (i < specs.size() && specs[i].name != name) {
      valid += valid.empty() ? "" : ", ";
      valid += specs[i++].name;
    }
    if (i == specs.size()) {
      throw Error(fmt::format("{} has no parameter '{}'; valid: {}{}", owner, name,
                              valid.empty() ? "none" : valid, guess_of(name, valid)));
    }
    const ParameterSpec& spec = specs[i];
    if (!(value >= spec.low && value <= spec.high)) {
      throw Error(
          fmt::format("{}: {} = {} is outside {} to {}", owner, name, value, spec.low, spec.high));
    }
    if (spec.kind != ParameterSpec::Kind::real && value != std::floor(value)) {
      throw Error(fmt::format("{}: {} = {} is not a whole number", owner, name, value));
    }
    values_[i] = value;
  }
}

double ParameterValues::real(std::string_view name) const {
  for (std::size_t i = 0; i < specs_.size(); ++i) {
    if (specs_[i].name == name) return values_[i];
  }
  assert(false && "undeclared parameter");
  return 0;
}

std::string ParameterValues::describe() const {
  std::string text;
  for (std::size_t i = 0; i < specs_.size(); ++i) {
    text += fmt::format("{}{} = ", i > 0 ? ", " : "", specs_[i].name);
    if (specs_[i].kind == ParameterSpec::Kind::flag) {
      text += values_[i] != 0 ? "true" : "false";
    } else {
      text += fmt::format("{}", values_[i]);
    }
  }
  return text;
}

}  // namespace tetmend
