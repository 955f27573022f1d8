// SPDX-License-Identifier: MIT
// All pieces of a mesh, one after another: three divisions with shifted curves, then zones around
// the worst tets of all.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pieces/divided_mesh.h"
#include "pieces/figures.h"
#include "pieces/held_surface.h"
#include "pieces/piece_task.h"
#include "pieces/side_by_side.h"
#include "pieces/standing.h"

namespace tetmend::pieces {

/// How a mesh is divided. The result depends on these, on nothing else of a run.
struct Division {
  static constexpr unsigned kDivisions = 3;
  static constexpr unsigned kZoneRounds = 4;
  static constexpr unsigned kRings = 3;
  static constexpr unsigned kFreshRings = 1;
  static constexpr std::uint64_t kLeastZone = 300'000;

  std::size_t pieces = 1;
  unsigned divisions = kDivisions;
  unsigned zone_rounds = kZoneRounds;
  /// How far from the borders of the last division the second and third work, in edges; 0: all over.
  unsigned rings = kRings;
  /// Within so many edges of them everything is tried anew; farther away, what has changed.
  unsigned fresh_rings = kFreshRings;
  /// Tets that a zone may have where pieces have fewer: so many need little memory, and a cut costs
  /// quality. Larger zones are cut.
  std::uint64_t least_zone = kLeastZone;
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

/// What became of one part in a step.
struct PartOutcome {
  std::uint64_t part = 0;
  std::uint64_t added = 0;  ///< vertices
  bool stayed = false;      ///< it would have become worse
  std::array<std::uint64_t, kVerdictCount> verdicts{};
  std::uint64_t items = 0;
  std::uint64_t deferred = 0;
  Standing standing;
};
void append(const PartOutcome& outcome, std::string& bytes);
/// @throws Error when the bytes end too early.
PartOutcome take_outcome(std::string_view& bytes);

/// How long a rank worked on a part.
struct PartTime {
  std::uint32_t step = 0;  ///< from 0; divisions, then rounds of zones
  std::uint32_t part = 0;
  std::uint64_t tets = 0;  ///< in it, shared ones included
  double seconds = 0;
};

/// What the mesh is before a run, and what it may come to.
struct RunLimits {
  std::uint64_t tets = 0;   ///< that there are
  std::uint64_t n_bad = 0;  ///< of them
  std::uint64_t most_tets = std::numeric_limits<std::uint64_t>::max();
  double seconds = 0;  ///< from now on; 0: none
};

/// All that a run knows between two steps, besides the mesh and the options.
struct RunState {
  RunLimits limits;
  bool is_divided = false;          ///< the step that comes next has its pieces
  std::optional<Bounds> bounds;     ///< of the mesh as it was; nothing: they are yet to be found
  std::vector<StepRecord> records;  ///< the worst tets of the last one alone
};
void append(const RunState& state, std::string& bytes);
/// @throws Error when the bytes end too early.
RunState take_run_state(std::string_view& bytes);

/// All ranks of the mesh call the same functions, where nothing else is said.
class PieceRun {
 public:
  /// All of these must outlive it.
  PieceRun(DividedMesh& mesh, const Division& division, const TaskOptions& options)
      : mesh_(mesh), division_(division), options_(options) {}
  /// Goes on.
  PieceRun(DividedMesh& mesh, const Division& division, const TaskOptions& options, RunState state)
      : mesh_(mesh), division_(division), options_(options), state_(std::move(state)) {}

  void set_limits(const RunLimits& limits);
  /// Asked before each piece, by any thread; true ends the run, with what is reached.
  void set_stop(std::function<bool()> stop) { stop_ = std::move(stop); }
  /// How many pieces are worked on and measured at a time; one, unless that is set. Cannot show.
  void set_side_by_side(std::size_t most);
  /// Told after each step, when its pieces are stored; also after one that was stopped.
  void set_listener(std::function<void(const StepRecord&)> listener) {
    listener_ = std::move(listener);
  }

  /// From now on the surface may move. The first division is made for that; called before the first
  /// step, and before or after measure_before().
  /// @throws Error as HeldSurface
  /// @returns what another program needs for the same, see the next
  std::string hold_surface(const EnvelopeOptions& options, Shelf* next = nullptr);
  /// Likewise in a run that goes on.
  void hold_surface(const EnvelopeOptions& options, std::string_view saved);
  /// What the surface is held to; null: it is fixed.
  const HeldSurface* surface() const { return surface_.get(); }
  /// After measure_after(), where the surface may move.
  const std::optional<SurfaceChange>& surface_change() const { return surface_change_; }

  /// Figures of the mesh as it is, before the run; the first division is made for that.
  /// @param next  see DividedMesh::divide(); here and below
  Measured measure_before(const Wanted& wanted = {}, Shelf* next = nullptr);
  /// Works. Precondition: slices were added.
  void run();
  /// Divides once more and checks that all pieces fit: see measure_own(). Everything is stored again.
  /// Where the surface may move, proves anew how near it is.
  /// @param before  the same of the mesh as it was; its means make the bins of histograms
  /// @throws Error when they do not.
  Measured measure_after(const Wanted& wanted = {}, const Measured& before = {},
                         Shelf* next = nullptr);

  // run() in steps:
  /// Divides the mesh for the next step. Nothing: all is done.
  std::optional<StepRecord> begin_step(Shelf* next = nullptr);
  /// Which parts are worked on.
  bool is_active(std::size_t part, const StepRecord& record) const;
  /// This rank alone: works on the part, and stores it.
  PartOutcome work_on_part(std::size_t part, const StepRecord& record);
  /// When all parts are stored. `outcomes`: of all ranks, in any order.
  void end_step(StepRecord record, std::vector<PartOutcome> outcomes);

  const RunState& state() const { return state_; }
  const std::vector<StepRecord>& records() const { return state_.records; }
  /// Of this rank, in the order in which it worked.
  const std::vector<PartTime>& times() const { return times_; }
  /// The time was up, or somebody asked it to stop.
  bool stopped() const { return stopped_; }
  bool out_of_time() const { return out_of_time_; }

 private:
  struct WorkedPart {
    PartOutcome outcome;
    std::optional<PartTime> time;  ///< none: nothing was to be done
  };
  WorkedPart work_on(std::size_t part, const StepRecord& record);
  void each_own(const std::function<SideBySide::Use(std::size_t part)>& make) const;
  void divide_first(Shelf* next);
  std::optional<Survey> survey_for(const Wanted& wanted);
  void agree_on_bounds(const Bounds& mine);
  void find_bounds();
  void divide_for(const StepRecord& record, Shelf* next);
  Piece gathered(std::size_t part) const;
  ZoneMap make_zones(const Standing& last) const;
  std::vector<PartOutcome> share(std::vector<PartOutcome> mine);
  TaskLimits limits_of(std::size_t part, const StepRecord& record) const;
  unsigned rings_of(const StepRecord& record) const;
  Aim aim_of(const StepRecord& record) const;
  /// The one that is worked on or comes next, from 1.
  unsigned round() const { return static_cast<unsigned>(state_.records.size()) + 1; }
  double seconds_left() const;
  bool is_to_stop();
  void agree_on_stop();
  void store_unchanged();

  DividedMesh& mesh_;
  const Division& division_;
  const TaskOptions& options_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  RunState state_;
  std::function<bool()> stop_;
  std::function<void(const StepRecord&)> listener_;
  std::vector<PartTime> times_;
  std::unique_ptr<const HeldSurface> surface_;
  std::optional<SurfaceChange> surface_change_;
  SideBySide side_by_side_;
  std::atomic<bool> stopped_ = false;
  std::atomic<bool> out_of_time_ = false;
};

/// Fewer bad tets, or a better worst one.
bool is_better(const Standing& now, const Standing& before);

}  // namespace tetmend::pieces
