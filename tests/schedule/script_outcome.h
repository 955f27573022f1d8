// SPDX-License-Identifier: MIT
// What becomes of a small mesh under a script.
#pragma once

#include <string>
#include <vector>

#include "kernel/error.h"
#include "schedule/run.h"
#include "schedule/schedule.h"
#include "tests/support/registry.h"
#include "tests/support/zoo.h"

namespace tetmend::test {

struct ScriptOutcome {
  TetMesh mesh;
  std::vector<PassRecord> records;
  std::vector<std::string> notes;
  std::string error;
  unsigned round = 0;
};

inline ScriptOutcome run_script(const std::string& script, const ScheduleSettings& settings = {}) {
  ScriptOutcome outcome{TetMesh(delaunay_ball(150, 7)), {}, {}, {}, 0};
  Run run(outcome.mesh, kRegistry);
  try {
    improve(run, Schedule("test.lua", script), settings);
  } catch (const Error& error) {
    outcome.error = error.what();
  }
  outcome.records = run.records;
  outcome.notes = run.notes;
  outcome.round = run.round;
  return outcome;
}

}  // namespace tetmend::test
