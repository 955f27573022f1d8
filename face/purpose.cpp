// SPDX-License-Identifier: MIT
#include "face/purpose.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "kernel/nearest_word.h"

namespace tetmend::face {

namespace {

constexpr std::array<Purpose, 5> kPurposes = {{
    {"", "the solver that follows, whichever", "15%", true, 3, 2},
    {"explicit", "explicit time integration: tets over step", "0%", true, 3, 6},
    {"implicit", "iterative solvers: tets times steps", "5%", true, 3, 6},
    {"volumes", "finite volumes: faces at right angles to what they part", "15%", true, 3, 6},
    {"angles", "angles alone, whatever the number of tets and the step", "", false, 3, 3},
}};

/// A built-in schedule that ends by itself where more tets remove fewer bad ones.
bool is_bounded(const Options& options) {
  return options.script.empty() && (options.schedule == "shell" || options.schedule == "polish");
}

}  // namespace

std::span<const Purpose> purposes() {
  return kPurposes;
}

const Purpose& find_purpose(const Options& options) {
  const auto found = std::find_if(kPurposes.begin(), kPurposes.end(), [&](const Purpose& purpose) {
    return purpose.name == options.purpose;
  });
  if (found != kPurposes.end()) return *found;
  constexpr std::string_view kValid = "explicit, implicit, volumes, angles";
  throw OptionError("purpose", fmt::format("purpose: '{}' is none; valid: {}{}", options.purpose,
                                           kValid, guess_of(options.purpose, kValid)));
}

std::string tets_of(const Options& options) {
  if (!options.tets.empty()) return options.tets;
  if (options.purpose.empty() && !is_bounded(options)) return {};
  return std::string(find_purpose(options).tets);
}

std::size_t least_growth_of(const Options& options) {
  constexpr std::size_t kHandful = 100;
  return options.tets.empty() && options.purpose.empty() ? kHandful : 0;
}

std::vector<std::pair<std::string, std::string>> settings_of(const Options& options) {
  std::vector<std::pair<std::string, std::string>> settings;
  const Purpose& purpose = find_purpose(options);
  if (!purpose.name.empty() && options.script.empty() && options.schedule == "shell") {
    settings = {{"polish_first", std::to_string(purpose.first_cycles)},
                {"polish_last", std::to_string(purpose.last_cycles)}};
  }
  settings.insert(settings.end(), options.set.begin(), options.set.end());
  return settings;
}

}  // namespace tetmend::face
