// SPDX-License-Identifier: MIT
#include "ops/registry.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/nearest_word.h"

namespace tetmend {

namespace {

/// Why a parameter makes no sense; empty if it does.
std::string_view complaint_about(const ParameterSpec& spec) {
  using Kind = ParameterSpec::Kind;
  if (!is_name(spec.name)) return "the name is not made of a-z, 0-9 and _";
  if (spec.help.empty()) return "there is no help";
  if (!std::isfinite(spec.low) || !std::isfinite(spec.high) || !(spec.low < spec.high)) {
    return "the range is empty or not finite";
  }
  if (!(spec.initial >= spec.low && spec.initial <= spec.high)) {
    return "the default lies outside the range";
  }
  if (spec.kind != Kind::real && spec.initial != std::floor(spec.initial)) {
    return "the default is not a whole number";
  }
  if (spec.kind == Kind::flag && (spec.low != 0 || spec.high != 1)) {
    return "the range of a flag is 0 to 1";
  }
  return {};
}

/// @throws Error for what no operator can be made of.
void check(const OperatorInfo& info) {
  const auto complain = [&](std::string_view about) {
    throw Error(fmt::format("operator '{}': {}", info.name, about));
  };
  if (!is_name(info.name)) complain("the name is not made of a-z, 0-9 and _");
  if (info.target > TargetKind::vertex) complain("there is no such kind of target");
  if (info.help.empty()) complain("there is no help");
  for (std::size_t i = 0; i < info.parameters.size(); ++i) {
    const ParameterSpec& spec = info.parameters[i];
    if (const auto about = complaint_about(spec); !about.empty()) {
      complain(fmt::format("parameter '{}': {}", spec.name, about));
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (info.parameters[k].name == spec.name) {
        complain(fmt::format("there are two parameters '{}'", spec.name));
      }
    }
  }
}

/// `settings`, but for what is held.
ParameterSettings with(const ParameterSettings& held, ParameterSettings settings) {
  for (const auto& [name, value] : held) {
    std::erase_if(settings,
                  [&, &name = name](const auto& setting) { return setting.first == name; });
    settings.emplace_back(name, value);
  }
  return settings;
}

}  // namespace

void Registry::add(const OperatorInfo& info, std::string_view origin) {
  if (info.make == nullptr) {
    throw Error(fmt::format("operator '{}': there is no function that makes it", info.name));
  }
  add(info, origin, info.make);
}

void Registry::add(const OperatorInfo& info, Maker make) {
  add(info, {}, std::move(make));
  needs_whole_mesh_ = true;
}

void Registry::add_measure(const Standard& own) {
  const std::string_view name = own.measure_name();
  for (const Standard& known : measures_) {
    if (known.measure_name() == name) {
      throw Error(fmt::format("measure '{}' is registered twice", name));
    }
  }
  measures_.push_back(own);
}

Standard Registry::standard(std::string_view measure, const Goal& goal, double price) const {
  std::string valid = "sine, sine_and_length";
  for (const Standard& own : measures_) {
    if (own.measure_name() == measure) return own.with_goal(goal).with_price(price);
    valid += fmt::format(", {}", own.measure_name());
  }
  return Standard(goal, to_terms(measure, valid), price);
}

void Registry::add(const OperatorInfo& info, std::string_view origin, Maker make) {
  check(info);
  for (std::size_t i = 0; i < infos_.size(); ++i) {
    if (infos_[i]->name != info.name) continue;
    const auto who = [](std::string_view file) { return file.empty() ? "tetmend itself" : file; };
    throw Error(origin.empty() && origins_[i].empty()
                    ? fmt::format("operator '{}' is registered twice", info.name)
                    : fmt::format("operator '{}' is registered twice: by {} and by {}", info.name,
                                  who(origins_[i]), who(origin)));
  }
  infos_.push_back(&info);
  origins_.emplace_back(origin);
  makers_.push_back(std::move(make));
  held_.emplace_back();
}

std::size_t Registry::index_of(std::string_view name) const {
  std::string valid;
  for (std::size_t i = 0; i < infos_.size(); ++i) {
    if (infos_[i]->name == name) return i;
    valid += valid.empty() ? "" : ", ";
    valid += infos_[i]->name;
  }
  throw Error(
      fmt::format("unknown operator '{}'; valid: {}{}", name, valid, guess_of(name, valid)));
}

const OperatorInfo& Registry::find(std::string_view name) const {
  return *infos_[index_of(name)];
}

const std::string& Registry::origin(std::string_view name) const {
  return origins_[index_of(name)];
}

void Registry::hold(std::string_view name, std::string_view parameter, double value) {
  const std::size_t i = index_of(name);
  const ParameterSettings held = with({{std::string(parameter), value}}, held_[i]);
  static_cast<void>(ParameterValues(name, infos_[i]->parameters, held));  // may refuse them
  held_[i] = held;
}

std::unique_ptr<Operator> Registry::make(std::string_view name,
                                         const ParameterSettings& settings) const {
  const std::size_t i = index_of(name);
  const OperatorInfo& info = *infos_[i];
  const ParameterValues values(info.name, info.parameters, with(held_[i], settings));
  if (origins_[i].empty()) {
    std::unique_ptr<Operator> made = makers_[i](values);
    made->settings_ = values.describe();
    return made;
  }
  const auto complain = [&](std::string_view about) -> Error {
    return Error(fmt::format("operator '{}' of {} cannot be made: {}", name, origins_[i], about));
  };
  std::unique_ptr<Operator> made;
  try {
    made = makers_[i](values);
  } catch (const std::exception& error) {
    throw complain(error.what());
  } catch (...) {
    throw complain("an exception of an unknown type");
  }
  if (!made) throw complain("its function made nothing");
  if (&made->info() != &info) {
    throw complain(
        "its function made another operator: its constructor must be given the description that is "
        "registered (a function of its own named info() hides Operator::info())");
  }
  made->origin_ = origins_[i];
  made->settings_ = values.describe();
  return made;
}

}  // namespace tetmend
