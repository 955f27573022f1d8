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

TEST_CASE("a bar of many calls says how many of them ended in which way") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  unsigned joined = 0;
  for (const IcicleBar& bar : lay_out_icicle(file, whole_trace(file), 0.01)) {
    std::uint32_t sum = 0;
    for (const std::uint32_t count : bar.ended) sum += count;
    CHECK(sum == bar.count);
    joined += bar.count > 1 ? 1 : 0;
    if (bar.count > 1) continue;
    CHECK(bar.ended[static_cast<std::size_t>(outcome_of(file.calls()[bar.call]))] == 1);
  }
  CHECK(joined > 5);
}

TEST_CASE("a part of a window shows the calls in it, wider, and no others") {
  const test::TracedBall trace;
  const TraceFile file(trace.path());
  const CallWindow whole = whole_trace(file);
  const CallWindow part = zoomed(whole, whole, 0.3, 0.05);
  CHECK(part.end - part.begin ==
        doctest::Approx(0.05 * static_cast<double>(whole.end)).epsilon(0.01));
  const auto middle =
      static_cast<double>(part.begin) + 0.3 * static_cast<double>(part.end - part.begin);
  CHECK(middle == doctest::Approx(0.3 * static_cast<double>(whole.end)).epsilon(0.01));
  std::size_t shown = 0;
  for (const IcicleBar& bar : lay_out_icicle(file, part, 0)) {
    const Call& call = file.calls()[bar.call];
    CHECK(call.events.begin < part.end);
    CHECK(call.events.end > part.begin);
    CHECK(bar.left >= 0);
    CHECK(bar.right <= 1);
    ++shown;
  }
  std::size_t truth = 0;
  for (const Call& call : file.calls()) {
    truth += call.events.begin < part.end && call.events.end > part.begin ? 1 : 0;
  }
  CHECK(shown == truth);
  CHECK(shown > 10);
}

TEST_CASE("zooming and moving never lead out of the window, and back to the whole of it") {
  const CallWindow whole{100, 1100, 3, 40};
  CallWindow shown = whole;
  for (int i = 0; i < 60; ++i) shown = zoomed(whole, shown, 0.9, 0.8);
  CHECK(shown.end - shown.begin == 8);
  CHECK(panned(whole, shown, 5000).end == whole.end);
  CHECK(panned(whole, shown, -5000).begin == whole.begin);
  CHECK(panned(whole, shown, -3).begin == shown.begin - 3);
  for (int i = 0; i < 60; ++i) shown = zoomed(whole, shown, 0.1, 1.25);
  CHECK(shown.begin == whole.begin);
  CHECK(shown.end == whole.end);
  CHECK(shown.first_call == whole.first_call);
}

TEST_CASE("rows fill the band, be it one or many") {
  const test::HandmadeTrace trace;
  const TraceFile file(trace.path());
  CHECK(icicle_row_height(lay_out_icicle(file, call_window(file, 1), 0), 120) == 120);  // alone
  const auto bars = lay_out_icicle(file, call_window(file, 0), 0);
  CHECK(icicle_row_height(bars, 120) == 60);
}

TEST_CASE(
    "a bar has operator and target in as many lines as it has room for, or the target alone") {
  const auto width_of = [](const std::string& text) {
    return 10.0 * static_cast<double>(text.size());
  };
  const auto name = [&](double width, double height) {
    return name_in_bar("face removal", "face 1 2 3", width, height, 20, width_of);
  };
  using Lines = std::vector<std::string>;
  CHECK(name(250, 20).lines == Lines{"face removal face 1 2 3"});
  CHECK(name(250, 20).size == 20);
  CHECK(name(140, 40).lines == Lines{"face removal", "face 1 2 3"});
  CHECK(name(90, 80).lines == Lines{"face", "removal", "face 1 2", "3"});
  // Smaller before it is cut.
  CHECK(name(160, 14).lines == Lines{"face removal face 1 2 3"});
  CHECK(name(160, 14).size < 14);
  CHECK(name(110, 20).lines == Lines{"face 1 2 3"});
  CHECK(name(20, 100).lines.empty());
  CHECK(name(250, 8).lines.empty());
  for (double width = 5; width < 300; width += 7) {
    for (double height = 5; height < 120; height += 9) {
      const BarName made = name(width, height);
      const double share = made.size / 20;
      CHECK(static_cast<double>(made.lines.size()) * made.size <= height);
      for (const std::string& line : made.lines) CHECK(share * width_of(line) < width);
    }
  }
}
