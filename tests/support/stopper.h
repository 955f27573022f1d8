// SPDX-License-Identifier: MIT
// A user who loses patience.
#pragma once

#include <atomic>
#include <string_view>

#include <doctest/doctest.h>

#include "schedule/run.h"

namespace tetmend::test {

/// Stops the run after so many reports.
struct Stopper final : ProgressListener {
  explicit Stopper(int reports) : left(reports) {}
  void progress(std::string_view, unsigned, double share) override {
    CHECK(share >= 0);
    CHECK(share <= 1);
    if (--left <= 0) cancel = true;
  }
  void pass_done(std::string_view, unsigned, const QualityIndicators&) override { ++passes; }
  int left;
  int passes = 0;
  std::atomic<bool> cancel = false;
};

}  // namespace tetmend::test
