// SPDX-License-Identifier: MIT
// When memory runs out: a spread of the allocations of each run. main.cpp can try them all.
#include <new>
#include <string_view>

#include <doctest/doctest.h>

#include "schedule/lua_state.h"
#include "tests/faults/failing_memory.h"
#include "tests/faults/fault_trial.h"

using namespace tetmend;
using namespace tetmend::test;

namespace {

/// The n-th allocation fails, for `count` numbers: the first ones, and then ever further apart.
void try_spread(const std::string& schedule, const std::string& mesh, Form form, int count) {
  CAPTURE(schedule);
  CAPTURE(mesh);
  CAPTURE(kFormNames[static_cast<std::size_t>(form)]);
  FaultTrial trial(fault_mesh(mesh), schedule, form);
  REQUIRE(trial.kept() > 50);
  int failures = 0;
  int on_two_threads = 0;
  double n = 1;
  for (int i = 0; i < count; ++i, n = 1 + n * 1.06) {
    CAPTURE(n);
    const FaultOutcome outcome = trial.run(static_cast<long>(n));
    for (const std::string& finding : outcome.findings) FAIL_CHECK(finding);
    on_two_threads += outcome.on_two_threads ? 1 : 0;
    if (!outcome.failed) break;
    ++failures;
  }
  if (form == Form::threads) MESSAGE(on_two_threads, " of ", failures, " runs had two threads");
  CHECK(failures > 50);
}

}  // namespace

TEST_CASE("when memory runs out, the mesh is what the last attempt that was kept left") {
  for (const std::string schedule : {"shell", "thorough"}) {
    for (const std::string mesh : {"tangled", "lattice"}) {
      try_spread(schedule, mesh, Form::plain, 150);
      try_spread(schedule, mesh, Form::divided, 60);
    }
  }
}

TEST_CASE("when memory of a thread runs out, the mesh is sound whatever the others did") {
  try_spread("shell", "large_tangled", Form::threads, 100);
  try_spread("thorough", "large_lattice", Form::threads, 100);
}

TEST_CASE("when memory runs out in a run with a trace, the trace ends or shows the way there") {
  try_spread("shell", "tangled", Form::recorded, 100);
  try_spread("thorough", "lattice", Form::recorded, 100);
}

TEST_CASE("when memory runs out, improve() gives back the mesh as it was or improved so far") {
  try_spread("shell", "tangled", Form::face, 150);
  try_spread("thorough", "lattice", Form::face, 150);
}

TEST_CASE("when memory runs out in the library of scripts, nothing else comes out of run()") {
  LuaState lua;
  int failures = 0;
  for (bool failed = true; failed && failures < 1000; failures += failed ? 1 : 0) {
    const FailingMemory memory(failures + 1);
    try {
      lua.run("local text = no_such_name_in_any_script_of_tetmend", "test.lua");
    } catch (const std::bad_alloc&) {
      CHECK(memory.has_failed());
    } catch (const Error& error) {
      CHECK(std::string_view(error.what()).find("unknown name") != std::string_view::npos);
    }
    failed = memory.has_failed();
  }
  CHECK(failures > 10);
}
