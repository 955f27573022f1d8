// SPDX-License-Identifier: MIT
// What a mesh is for, and what a run may do to it then.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <tetmend/improve.h>

namespace tetmend::face {

/// A row of the table of Options::purpose.
struct Purpose {
  std::string_view name;
  std::string_view help;
  std::string_view tets;  ///< Options::tets unless that is given; empty: as far as it pays
  bool keeps_step;        ///< of explicit time integration, and the largest angle below the goal's
  int first_cycles;       ///< of the polish before the rounds
  int last_cycles;        ///< and at the end
};

/// All of them; the first is the default, without a name.
std::span<const Purpose> purposes();
/// @throws OptionError for a name that is none
const Purpose& find_purpose(const Options& options);
/// Options::tets, or what the purpose says instead. Scripts, and schedules that go on as long as that
/// helps, are bounded only where Options::tets or a purpose says so.
std::string tets_of(const Options& options);
/// So many tets more are allowed in any case: a share of a handful of tets would be none.
std::size_t least_growth_of(const Options& options);
/// Options::set, and before it what the purpose says.
std::vector<std::pair<std::string, std::string>> settings_of(const Options& options);

}  // namespace tetmend::face
