// SPDX-License-Identifier: MIT
// How calls end: the verdict taken apart by its reason, and by what became of it later.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tetmend {

enum class CallEnding : std::uint8_t {
  for_good,
  undone,
  nothing_better,
  vector_not_better,
  more_bad_tets,
  judge_not_content,
  calls_not_enough,
  not_applicable,
  does_not_fit,
  target_constrained,
  candidate_constrained,
  rest_constrained,
  inverted,
  depth_spent,
  budget_spent,
  deferred,
  cut_off
};
inline constexpr std::size_t kEndingCount = static_cast<std::size_t>(CallEnding::cut_off) + 1;

/// A refusal: neither accepted, for good or not, nor cut off.
constexpr bool is_refusal(CallEnding ending) {
  return ending > CallEnding::undone && ending < CallEnding::cut_off;
}

struct EndingWords {
  std::string_view name;    ///< for headings, files and conditions
  std::string_view reason;  ///< in a sentence
};

inline constexpr std::array<EndingWords, kEndingCount> kEndingWords = {{
    {"accepted for good", "the quality vector of all that changed is better"},
    {"undone with a caller", "it was accepted, and undone by a call around it"},
    {"nothing better", "no candidate is better than what is there"},
    {"vector not better", "the quality vector with the candidate is not better"},
    {"more bad tets", "the quality vector is better, but the gain does not pay for more bad tets"},
    {"judge not content", "the quality vector is better, but not all that its judge asks for is"},
    {"calls not enough", "what the calls in it reached is not enough"},
    {"not applicable", "the target is gone or is not of the kind that the operator works on"},
    {"does not fit", "the candidate does not fit into its cavity"},
    {"target constrained", "the target lies on the boundary or on a constraint"},
    {"candidate constrained", "the candidate would remove a constrained face, edge or vertex"},
    {"rest constrained", "what is left to transform lies on the boundary or on a constraint"},
    {"inverted", "a tet of the candidate is not certified positive"},
    {"depth spent", "nothing helped up to the deepest level allowed"},
    {"budget spent", "the call used up its transformations"},
    {"deferred", "another worker's part of the mesh is in the way; to be tried again"},
    {"cut off", "the trace ends before the call does"},
}};

constexpr std::string_view name_of(CallEnding ending) {
  return kEndingWords[static_cast<std::size_t>(ending)].name;
}

}  // namespace tetmend
