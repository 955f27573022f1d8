// SPDX-License-Identifier: MIT
#include "explain/stepper.h"

#include <doctest/doctest.h>

#include "tests/support/example_traces.h"

using namespace tetmend;
using namespace tetmend::explain;

namespace {

struct Steps {
  test::HandmadeTrace trace;
  TraceFile file{trace.path()};

  std::uint64_t on(std::uint64_t from, Step step) const {
    return step_from(file, from, step, Direction::forward);
  }
  std::uint64_t back(std::uint64_t from, Step step) const {
    return step_from(file, from, step, Direction::back);
  }
};

}  // namespace

TEST_CASE("a step into goes one event on or back, and stays at the ends of the trace") {
  const Steps s;
  REQUIRE(s.file.event_count() == 11);
  CHECK(s.on(0, Step::into) == 1);
  CHECK(s.on(3, Step::into) == 4);
  CHECK(s.back(4, Step::into) == 3);
  for (const Step step : {Step::into, Step::over, Step::out}) {
    CHECK(s.on(11, step) == 11);
    CHECK(s.back(0, step) == 0);
  }
}

TEST_CASE("a step over takes a call, a visit or a pass as one") {
  const Steps s;
  CHECK(s.on(0, Step::over) == 11);
  CHECK(s.on(1, Step::over) == 10);
  CHECK(s.on(2, Step::over) == 9);
  CHECK(s.on(3, Step::over) == 6);
  CHECK(s.on(4, Step::over) == 5);  // a candidate begins nothing
  CHECK(s.on(6, Step::over) == 8);
  CHECK(s.on(8, Step::over) == 9);
}

TEST_CASE("a step back over undoes a step over") {
  const Steps s;
  for (const std::uint64_t from : {0, 1, 2, 3, 4, 6}) {
    CAPTURE(from);
    CHECK(s.back(s.on(from, Step::over), Step::over) == from);
  }
}

TEST_CASE("a step out leads to the end of what is open, and back to before its beginning") {
  const Steps s;
  CHECK(s.on(4, Step::out) == 6);
  CHECK(s.on(6, Step::out) == 9);  // the inner call has ended: out of the outer one
  CHECK(s.on(9, Step::out) == 10);
  CHECK(s.on(10, Step::out) == 11);
  CHECK(s.back(5, Step::out) == 3);
  CHECK(s.back(3, Step::out) == 2);
  CHECK(s.back(2, Step::out) == 1);
  CHECK(s.back(1, Step::out) == 0);
}

TEST_CASE(
    "the stack has the call of the last event and those around it, also right after its end") {
  const Steps s;
  using Stack = std::vector<std::uint32_t>;
  CHECK(call_stack(s.file, 2) == Stack{});
  CHECK(call_stack(s.file, 3) == Stack{0});
  CHECK(call_stack(s.file, 4) == Stack{0, 1});
  CHECK(call_stack(s.file, 6) == Stack{0, 1});
  CHECK(call_stack(s.file, 8) == Stack{0, 2});
  CHECK(call_stack(s.file, 9) == Stack{0});
  CHECK(call_stack(s.file, 10) == Stack{});
}
