// SPDX-License-Identifier: MIT
// A run that is recorded, with the true mesh at some of its events beside it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>

#include "kernel/formats/mesh_io.h"
#include "ops/registry.h"
#include "schedule/run.h"
#include "schedule/schedule.h"
#include "tests/support/zoo.h"
#include "trace/recorder.h"
#include "trace/slot_mesh.h"

namespace tetmend::test {

/// Hands everything to a recorder and takes fingerprints of the mesh whenever the recorder has as
/// many events as wanted.
class Witness final : public TraceSink {
 public:
  Witness(TraceRecorder& recorder, const TetMesh& mesh, std::set<std::uint64_t> wanted)
      : recorder_(recorder), mesh_(mesh), wanted_(std::move(wanted)) {
    look();
  }

  void pass_begins(std::string_view name, unsigned round) override {
    recorder_.pass_begins(name, round);
    look();
  }
  void pass_ends(const QualityIndicators& now) override {
    recorder_.pass_ends(now);
    look();
  }
  void visit_begins(const TetVertices& tet, Quality quality) override {
    recorder_.visit_begins(tet, quality);
  }
  void visit_ends() override {
    recorder_.visit_ends();
    look();
  }
  void standard_changed(const Standard& standard) override {
    recorder_.standard_changed(standard);
    look();
  }
  void attempt_begins(const AttemptEvent& event) override {
    recorder_.attempt_begins(event);
    look();
  }
  void candidate_found() override {
    recorder_.candidate_found();
    look();
  }
  void attempt_ends(Verdict verdict, std::span<const Quality> before,
                    std::span<const Quality> now) override {
    recorder_.attempt_ends(verdict, before, now);
    look();
  }
  void edit_made(const TetMesh& mesh, const Journal& journal) noexcept override {
    // Vertices that move together are all in place when the first of them is told of: the states
    // between were never there.
    const bool is_move = journal.edits.back().kind == Edit::Kind::move_vertex;
    if (is_move && last_move_ == last_) fingerprints.erase(last_);
    recorder_.edit_made(mesh, journal);
    look();
    if (is_move) last_move_ = last_;
  }
  void edit_undone() noexcept override {
    recorder_.edit_undone();
    look();
  }

  /// By number of events.
  std::map<std::uint64_t, std::uint64_t> fingerprints;

 private:
  void look() {
    // The begin of a visit is written together with its first attempt.
    const std::uint64_t now = recorder_.event_count();
    for (std::uint64_t k = std::min(last_ + 1, now); k <= now; ++k) {
      if (wanted_.contains(k)) fingerprints[k] = SlotMesh(mesh_).fingerprint();
    }
    last_ = now;
  }

  TraceRecorder& recorder_;
  const TetMesh& mesh_;
  std::set<std::uint64_t> wanted_;
  std::uint64_t last_ = 0;
  std::optional<std::uint64_t> last_move_;  // number of events right after it
};

inline std::set<std::uint64_t> random_numbers(std::size_t count, std::uint64_t below) {
  std::mt19937_64 random(7);
  std::set<std::uint64_t> numbers;
  while (numbers.size() < std::min<std::uint64_t>(count, below)) numbers.insert(random() % below);
  return numbers;
}

inline TetMesh asset_mesh(const std::string& name) {
  return TetMesh::sorted(
      read_mesh(std::filesystem::path(TETMEND_SOURCE_DIR) / "assets/meshes" / name));
}

/// Takes the last frame from a trace, the one that says it is complete.
inline void cut_end(const std::filesystem::path& file) {
  FrameReader frames(file);
  while (frames.next()) {
  }
  std::filesystem::resize_file(file, frames.offset());
}

/// Runs a schedule over the mesh and records it; returns the fingerprints that were wanted.
inline std::map<std::uint64_t, std::uint64_t> record(
    TetMesh& mesh, const std::filesystem::path& file, const TraceFilter& filter = {},
    const std::set<std::uint64_t>& wanted = {},
    const Schedule& schedule = Schedule::builtin("shell"), TraceClock clock = TraceClock::real) {
  Registry registry = Registry::builtin();
  TraceRecorder recorder(file, mesh,
                         {.program = "test",
                          .input = "mesh",
                          .schedule = schedule.name(),
                          .schedule_text = schedule.text(),
                          .settings = {},
                          .filter = {}},
                         filter, clock);
  Witness witness(recorder, mesh, wanted);
  Run run(mesh, registry);
  run.set_trace(&witness);
  improve(run, schedule);
  recorder.finish();
  return witness.fingerprints;
}

}  // namespace tetmend::test
