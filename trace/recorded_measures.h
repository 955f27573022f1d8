// SPDX-License-Identifier: MIT
// Measures of programs whose function is not here, by what a trace noted of the tets of its run.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "kernel/quality.h"

namespace tetmend {

/// Whoever opens a trace notes qualities here, then calls complete(); from then on the standards
/// that known() gave say of these tets what the run saw, bit for bit. Of a tet that the run never
/// had they say what they say where a measure is unknown.
class RecordedMeasures {
 public:
  /// The same standard; a measure of a program gets what is noted, or will be, for its function.
  Standard known(const Standard& standard);
  /// The same of one that known() has seen.
  Standard of(const Standard& standard) const;
  /// The quality by `standard`, which has a measure of a program, of a tet at these points.
  void note(const Standard& standard, const std::array<Point, 4>& tet, Quality quality);
  /// Precondition: no note() follows. Cost: n log n.
  void complete();

 private:
  struct Table;
  struct Measure {
    Standard standard;
    std::shared_ptr<Table> table;
  };
  const Measure* find(const Standard& standard) const;
  Measure& find_or_add(const Standard& standard);

  std::vector<Measure> measures_;
};

}  // namespace tetmend
