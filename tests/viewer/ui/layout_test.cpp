// SPDX-License-Identifier: MIT
#include "viewer/ui/layout.h"

#include <doctest/doctest.h>

#include "tests/support/example_traces.h"
#include "tests/viewer/session.h"

using namespace tetmend;
using namespace tetmend::viewer;
using test::TestSession;

namespace {

/// What the picture has of the window.
double share_of(Document& document, int width, int height, float scale = 1) {
  document.window = {width, height};
  const ui::Area canvas = ui::lay_out(document, scale).canvas;
  return double{canvas.width} * canvas.height / (double{1} * width * height);
}

}  // namespace

TEST_CASE("the picture has at least half of a window of 1280 x 800, also of a trace") {
  TestSession s(test::kuhn_cube(2, 0, 1));
  CHECK(share_of(s.document, 1280, 800) >= 0.5);
  CHECK(share_of(s.document, 2560, 1600, 2) >= 0.5);
  const test::HandmadeTrace trace;
  s.document.open(trace.path());
  CHECK(share_of(s.document, 1280, 800) >= 0.5);
  CHECK(share_of(s.document, 2560, 1600, 2) >= 0.5);
  CHECK(ui::lay_out(s.document, 2).is_one_column);
  s.document.window = {1920, 1080};
  CHECK_FALSE(ui::lay_out(s.document, 1).is_one_column);
}
