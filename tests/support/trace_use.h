// SPDX-License-Identifier: MIT
// All that a user does with a trace, and that its mesh is one after every event.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "kernel/integrity.h"
#include "kernel/tet_mesh.h"
#include "trace/call_extract.h"
#include "trace/call_tree.h"
#include "trace/ledger.h"
#include "trace/replay.h"
#include "trace/trace_file.h"
#include "trace/trace_summary.h"

namespace tetmend::test {

/// The ledger, for which events are read alone; nothing where that gives an error.
inline std::string ledger_of_events(const std::filesystem::path& path) {
  try {
    const TraceFile file(path, TraceCheck::events);
    return format_ledger(make_ledger(file));
  } catch (const Error&) {
    return "";
  }
}

/// Opens, plays, sums up, prints and extracts. @throws Error as these do.
inline void use_trace(const std::filesystem::path& path) {
  const TraceFile file(path);
  Replay replay(file);
  replay.seek(file.event_count());
  format_summary(file, summarize(file));
  write_slices(file, [](std::string_view) {});
  for (std::uint32_t c = 0; c < file.calls().size(); ++c) {
    call_tree_text(file, c);
    extract_call(file, replay, c);
  }
}

/// What is wrong with the mesh of a trace; empty if nothing. One too large or too small to be worked
/// with may still be looked at.
inline std::string findings_in(const SlotMesh& slots) {
  try {
    const TetMesh mesh(slots.to_data());
    if (mesh.tet_count() != slots.tet_count()) return "another number of tets";
    return to_string(check_integrity(mesh));
  } catch (const BuildError& error) {
    const std::string reason = error.what();
    return reason.find("too short to be worked with") == std::string::npos ? reason : "";
  } catch (const Error&) {
    return "";
  }
}

/// Plays a trace event by event: what is wrong with the mesh after one of them; empty if nothing.
/// @throws Error when it cannot be opened.
inline std::string findings_in_trace(const std::filesystem::path& path) {
  const TraceFile file(path);
  Replay replay(file);
  for (std::uint64_t k = 0; k <= file.event_count(); ++k) {
    replay.seek(k);
    const Cavity cavity = replay.cavity();
    if (k > 0 && cavity.created.empty() && cavity.vertices.empty()) continue;
    if (std::string findings = findings_in(replay.mesh()); !findings.empty()) return findings;
  }
  replay.seek(0);
  return "";
}

}  // namespace tetmend::test
