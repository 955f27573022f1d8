// SPDX-License-Identifier: MIT
// Two recorded runs side by side: what each asked, how both fared over time, and which tets are bad
// after the one and good after the other.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "trace/history.h"
#include "trace/ledger.h"

namespace tetmend {

/// A place where one run left a bad tet and the other a good one.
struct TetPair {
  HistorySubject bad;   ///< in the one run, by its own numbers; see as_question()
  HistorySubject good;  ///< the tet of the other that has the centroid of the bad one
  Quality bad_quality = 0, good_quality = 0;
};

/// From this moment of a run on, see EventRange::begin_seconds.
struct BadAtTime {
  double seconds = 0;
  std::size_t n_bad = 0;
};

struct RunComparison {
  Ledger a, b;                             ///< with names that are those of the traces
  std::vector<BadAtTime> over_a, over_b;   ///< at the beginning, and after each pass
  bool same_beginning = false;             ///< the mesh, with its numbers
  bool same_goal = false;                  ///< of the mesh at the end; qualities are by this
  std::size_t bad_in_a = 0, bad_in_b = 0;  ///< tets, at the end
  std::vector<TetPair> worse_in_a,
      worse_in_b;  ///< bad there and good in the other; the worst first
};

/// Places are those of the files. Cost: replay of both, and a pass over the tets of each end.
RunComparison compare_runs(const TraceFile& a, const TraceFile& b);

/// Two ledgers with their differences, bad tets over one axis of time, and the histories in both
/// runs of the `most` worst tets that only `a` left bad. Cost: see history_of().
std::string format_comparison(const TraceFile& a, const TraceFile& b,
                              const RunComparison& comparison, std::size_t most = 3);
/// The same for other programs, without the histories.
std::string comparison_json(const TraceFile& a, const TraceFile& b,
                            const RunComparison& comparison);

}  // namespace tetmend
