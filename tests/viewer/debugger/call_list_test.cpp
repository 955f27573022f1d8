// SPDX-License-Identifier: MIT
#include "viewer/debugger/call_list.h"

#include <doctest/doctest.h>

#include "explain/stepper.h"
#include "tests/support/example_traces.h"

using namespace tetmend;
using namespace tetmend::viewer;

TEST_CASE("the tree is unfolded along the stack, and where the user unfolds it") {
  const test::HandmadeTrace trace;
  const TraceFile file(trace.path());
  CallList list;
  const auto rows_at = [&](std::uint64_t position) {
    return list.rows(file, whole_trace(file), explain::call_stack(file, position)).size();
  };
  CHECK(rows_at(0) == 1);
  list.toggle(0);
  CHECK(rows_at(0) == 3);
  list.toggle(0);
  CHECK(rows_at(0) == 1);
  CHECK(rows_at(4) == 3);
  list.toggle(0);  // folded by hand, although a call in it is at hand
  CHECK(rows_at(4) == 1);
  CHECK(rows_at(7) == 3);  // until the next step
  const auto& rows = list.rows(file, whole_trace(file), explain::call_stack(file, 7));
  CHECK(rows[0].is_open);
  CHECK(rows[1].indent == 1);
  CHECK_FALSE(rows[1].has_children);
}
