// SPDX-License-Identifier: MIT
#include "explain/icicle.h"

#include <doctest/doctest.h>

#include "tests/support/example_traces.h"

using namespace tetmend;
using namespace tetmend::explain;

TEST_CASE("bars are as wide as their events and lie under the calls around them") {
  const test::HandmadeTrace trace;
  const TraceFile file(trace.path());
  const auto bars = lay_out_icicle(file, call_window(file, 0), 0);
  REQUIRE(bars.size() == 3);
  CHECK(bars[0].left == 0);
  CHECK(bars[0].right == 1);
  CHECK(bars[0].row == 0);
  CHECK(bars[1].row == 1);
  CHECK(bars[1].left == doctest::Approx(1.0 / 7));
  CHECK(bars[1].right == doctest::Approx(4.0 / 7));
  CHECK(bars[2].call == 2);
  CHECK(bar_at(bars, 0.3, 1)->call == 1);
  CHECK(bar_at(bars, 0.05, 1) == nullptr);
  CHECK(bar_at(bars, 0.3, 2) == nullptr);
}

TEST_CASE("the window of a pass has its calls, and outside of all passes it is the whole trace") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  const TracedPass& pass = file.passes()[1];
  const CallWindow window = pass_around(file, pass.events.begin + 1);
  CHECK(window.first_call == pass.first_call);
  CHECK(window.last_call == pass.last_call);
  CHECK(pass_around(file, 0).last_call == file.calls().size());
}

TEST_CASE("thin bars are joined, none is lost and none overlaps another") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  const auto bars = lay_out_icicle(file, whole_trace(file), 0.002);
  CHECK(bars.size() < 2000);
  std::size_t outermost = 0;
  double end = 0;
  for (const IcicleBar& bar : bars) {
    if (bar.row != 0) continue;
    outermost += bar.count;
    CHECK(bar.left >= end);
    end = bar.right;
  }
  std::size_t truth = 0;
  for (const Call& call : file.calls()) truth += call.depth == 0 ? 1 : 0;
  CHECK(outermost == truth);
  CHECK(bars.size() < truth);
}
