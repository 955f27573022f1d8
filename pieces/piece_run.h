// SPDX-License-Identifier: MIT
// All pieces of a mesh, one after another: three divisions with shifted curves, then zones around
// the worst tets of all.
#pragma once

#include <functional>
#include <vector>

#include "pieces/divided_mesh.h"
#include "pieces/piece_task.h"

namespace tetmend::pieces {

/// How a mesh is divided. The result depends on these, on nothing else of a run.
struct Division {
  static constexpr unsigned kDivisions = 3;
  static constexpr unsigned kZoneRounds = 3;
  static constexpr unsigned kRings = 6;

  std::size_t pieces = 1;
  unsigned divisions = kDivisions;
  unsigned zone_rounds = kZoneRounds;
  /// How far from the borders of the last division the second and third work, in edges; 0: all over.
  unsigned rings = kRings;
};

/// One division or one round of zones.
struct StepRecord {
  bool is_zones = false;
  unsigned number = 0;     ///< from 1
  std::size_t pieces = 0;  ///< that were worked on
  std::size_t stayed = 0;  ///< of them, those that would have become worse
  double seconds = 0;
  Standing after;
  std::array<std::size_t, kVerdictCount> verdicts{};
  std::size_t items = 0;
  std::size_t deferred = 0;
};

class PieceRun {
 public:
  /// All of these must outlive it.
  PieceRun(DividedMesh& mesh, const Division& division, const TaskOptions& options)
      : mesh_(mesh), division_(division), options_(options) {}

  /// What the mesh is before the run, and what it may come to.
  struct Limits {
    std::size_t tets = 0;   ///< that there are
    std::size_t n_bad = 0;  ///< of them
    std::size_t most_tets = std::numeric_limits<std::size_t>::max();
    double seconds = 0;  ///< from now on; 0: none
  };
  void set_limits(const Limits& limits);
  /// Asked before each piece; true ends the run, with what is reached.
  void set_stop(std::function<bool()> stop) { stop_ = std::move(stop); }
  /// Told after each step.
  void set_listener(std::function<void(const StepRecord&)> listener) {
    listener_ = std::move(listener);
  }

  /// Figures of the mesh as it is, before the run; the first division is made for that.
  Figures measure_before();
  /// Works. Precondition: slices were added.
  void run();
  /// Divides once more and checks that all pieces fit: see measure_own(). Everything is stored again.
  /// @throws Error when they do not.
  Figures measure_after();

  const std::vector<StepRecord>& records() const { return records_; }
  /// The time was up, or somebody asked it to stop.
  bool stopped() const { return stopped_; }
  bool out_of_time() const { return out_of_time_; }

 private:
  bool begin_step(StepRecord& record);
  void work(StepRecord& record);
  std::uint64_t work_on_part(std::size_t part, StepRecord& record);
  bool is_active(std::size_t part, const StepRecord& record) const;
  TaskLimits limits_of_a_piece(const StepRecord& record) const;
  double seconds_left() const;
  bool is_to_stop();

  DividedMesh& mesh_;
  const Division& division_;
  const TaskOptions& options_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Limits limits_;
  std::function<bool()> stop_;
  std::function<void(const StepRecord&)> listener_;
  bool is_divided_ = false;
  bool stopped_ = false;
  bool out_of_time_ = false;
  std::vector<StepRecord> records_;
};

/// Fewer bad tets, or a better worst one.
bool is_better(const Standing& now, const Standing& before);

}  // namespace tetmend::pieces
