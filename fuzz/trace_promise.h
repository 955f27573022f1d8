// SPDX-License-Identifier: MIT
// What is promised for any trace.
#pragma once

#include "fuzz/target.h"
#include "kernel/error.h"
#include "tests/support/trace_use.h"

namespace tetmend::fuzz {

/// An Error of one line, or a mesh after every event and no crash in what a user does with it.
inline void require_error_or_sound_trace(const std::filesystem::path& file) {
  test::ledger_of_events(file);
  try {
    const std::string findings = test::findings_in_trace(file);
    require(findings.empty(), findings);
    test::use_trace(file);
  } catch (const Error& error) {
    require_one_line(error.what());
  }
}

}  // namespace tetmend::fuzz
