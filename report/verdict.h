// SPDX-License-Identifier: MIT
// How a run went, in a sentence, and what it promised.
#pragma once

#include <string>
#include <vector>

#include "report/figures.h"

namespace tetmend::report {

enum class Outcome {
  reached,     ///< no tet misses the goal
  missed,      ///< some do
  interrupted  ///< the schedule did not come to its end
};

struct Verdict {
  Outcome outcome = Outcome::reached;
  std::string sentence;  ///< HTML
};
Verdict verdict_of(const Figures& figures);

/// What every run promises, and whether it was kept.
struct Promise {
  std::string text;
  std::string before, after;  ///< HTML; empty: there is no figure
  bool is_kept = false;
  /// `before` is how far something may go, `after` how far it went at most.
  bool is_bound = false;
  bool is_price = false;  ///< not kept, because inverted tets were mended, which goes first
};
std::vector<Promise> promises_of(const Figures& figures);

/// A table of these, and a list of all that is worse than before.
std::string promise_table(const Figures& figures);

}  // namespace tetmend::report
