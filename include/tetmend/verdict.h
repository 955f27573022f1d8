// SPDX-License-Identifier: MIT
// The answer of an operator.
#pragma once

#include <cstdint>
#include <string_view>

#include <tetmend/language.h>

namespace tetmend {

/// How an attempt of an operator ended.
enum class Verdict : std::uint8_t {
  accepted,  ///< the mesh is better now; from a stage of an attempt: nothing speaks against going
             ///< on
  not_applicable,  ///< the target is gone or is not of the kind that the operator works on
  constrained,     ///< boundary or constraint in the way
  no_improvement,  ///< nothing better was found
  inverted,        ///< the best that was found is not certified positive
  depth_spent,     ///< the recursion reached its level limit
  budget_spent,    ///< the call reached its limit of transformations
  deferred         ///< another worker's part of the mesh is in the way: to be tried again later
};

/// The number of values of Verdict.
inline constexpr std::size_t kVerdictCount = 8;

/// With blanks: "not applicable".
constexpr std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::accepted:
      return "accepted";
    case Verdict::not_applicable:
      return "not applicable";
    case Verdict::constrained:
      return "constrained";
    case Verdict::no_improvement:
      return "no improvement";
    case Verdict::inverted:
      return "inverted";
    case Verdict::depth_spent:
      return "depth spent";
    case Verdict::budget_spent:
      return "budget spent";
    case Verdict::deferred:
      return "deferred";
  }
  return "";
}

}  // namespace tetmend
