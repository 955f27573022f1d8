// SPDX-License-Identifier: MIT
// Runs in which one allocation fails, compared with the same run in which none does.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "kernel/mesh_data.h"
#include "kernel/tet_mesh.h"
#include "ops/registry.h"
#include "schedule/run.h"
#include "schedule/schedule.h"
#include "tests/kernel/formats/fixtures.h"
#include "trace/recorder.h"

namespace tetmend::test {

/// How a run is made.
enum class Form : std::uint8_t {
  plain,     ///< one thread, the mesh undivided
  divided,   ///< one thread, the mesh in blocks
  threads,   ///< two threads, the mesh in blocks
  recorded,  ///< one thread, with a trace
  face       ///< improve() of the library
};
inline constexpr std::array<std::string_view, 5> kFormNames = {"plain", "divided", "threads",
                                                               "recorded", "face"};

/// "tangled" or "lattice", small cubes, or "large_tangled" or "large_lattice", on which two threads
/// find work; else the name of a file.
MeshData fault_mesh(const std::string& name);

/// What came of a run.
struct FaultOutcome {
  bool failed = false;                ///< there were as many allocations
  bool on_two_threads = false;        ///< a second one came in time
  std::vector<std::string> findings;  ///< what is wrong
};

/// One mesh, one schedule, one form. Making it makes the run in which nothing fails, and notes the
/// mesh after each attempt that is kept.
class FaultTrial {
 public:
  FaultTrial(MeshData data, const std::string& schedule, Form form);

  /// A run whose n-th allocation, counted from 1, fails. Afterwards the mesh must be sound, with its
  /// surface, and no worse. Unless two threads worked on it, it must be what it was when the last
  /// attempt was kept. The passes recorded must be those that were finished.
  FaultOutcome run(long n);
  /// Of the run in which nothing fails: attempts that were kept.
  std::size_t kept() const { return states_.size() - 1; }

 private:
  class Witness;

  void note_states();
  void note_states_of_face();
  void note_state(std::uint64_t state);
  void set_up(Run& run) const;
  FaultOutcome run_schedule(long n);
  FaultOutcome run_face(long n);
  void check_mesh(const TetMesh& mesh, FaultOutcome& outcome) const;
  void check_state(std::uint64_t state, bool complete, FaultOutcome& outcome) const;
  void check_passes(const Run& run, FaultOutcome& outcome) const;
  void check_trace(const TetMesh& mesh, TraceRecorder& recorder, FaultOutcome& outcome) const;

  MeshData data_;
  Schedule schedule_;
  Form form_;
  Registry registry_ = Registry::builtin();
  TetMesh start_;
  std::uint64_t surface_;
  std::size_t not_positive_;
  std::vector<std::uint64_t> states_;
  std::unordered_set<std::uint64_t> known_states_;
  std::vector<PassRecord> passes_;
  TempFolder folder_;
};

}  // namespace tetmend::test
