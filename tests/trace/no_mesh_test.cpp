// SPDX-License-Identifier: MIT
#include "trace/no_mesh.h"

#include <doctest/doctest.h>

#include "kernel/error.h"
#include "tests/kernel/formats/fixtures.h"
#include "tests/support/example_traces.h"

using namespace tetmend;
using namespace tetmend::test;

TEST_CASE("a trace is known by its first bytes") {
  const HandmadeTrace trace;
  CHECK(is_trace(trace.path()));
  CHECK_FALSE(is_trace(TETMEND_SOURCE_DIR "/assets/meshes/sheet.mesh"));
  CHECK_FALSE(is_trace("missing.trace"));
}

TEST_CASE("a name that is no mesh's is looked behind, one that is a mesh's is left to its reader") {
  TempFolder folder;
  const HandmadeTrace trace;
  CHECK_THROWS_WITH_AS(refuse_what_is_no_mesh(folder / "missing"),
                       doctest::Contains("missing: cannot be read: No such file"), Error);
  CHECK_THROWS_WITH_AS(refuse_what_is_no_mesh(trace.path()),
                       doctest::Contains("this is the trace of a run, not a mesh"), Error);
  write_text(folder / "notes.txt", "hello");
  CHECK_NOTHROW(refuse_what_is_no_mesh(folder / "notes.txt"));
  CHECK_NOTHROW(refuse_what_is_no_mesh(folder / "missing.mesh"));
  CHECK_NOTHROW(refuse_what_is_no_mesh(folder / "missing.vtu.gz"));
}
