// SPDX-License-Identifier: MIT
// What is done with one piece: a mesh is built of it, what it shares is frozen, a schedule runs, and
// what is its own is taken back. A function of the piece and the options alone.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>

#include "face/watcher.h"
#include "kernel/bounds.h"
#include "kernel/size_field.h"
#include "pieces/held_surface.h"
#include "pieces/parting.h"
#include "pieces/piece.h"
#include "pieces/zones.h"
#include "schedule/run.h"
#include "schedule/schedule.h"

namespace tetmend::pieces {

class PieceTrace;

/// What a schedule is to go for.
enum class Aim : std::uint8_t {
  all,
  but_worst,  ///< the worst come later, with what lies around all of them
  worst
};

/// The settings of a schedule for each aim: its parameter "worst_later" or "worst_only" is true, if it
/// has one that the user has not set.
class AimSettings {
 public:
  AimSettings(const Schedule& schedule, const ScheduleSettings& settings);
  const ScheduleSettings& of(Aim aim) const { return settings_[static_cast<std::size_t>(aim)]; }

 private:
  std::array<ScheduleSettings, 3> settings_;  // by aim
};

/// The same for all pieces.
struct TaskOptions {
  const Registry& registry;
  const Schedule& schedule;
  const AimSettings& settings;
  Standard standard;
  std::shared_ptr<const SizeField> size_field = {};  ///< null: lengths are free
  face::Watcher* watcher = nullptr;                  ///< of all pieces; null: nobody watches
  PieceTrace* trace = nullptr;                       ///< null: nobody wants one
  bool check_operators = false;                      ///< Options::check_operators
  /// Changes a piece before it is stored, as a fault would: for tests of what notices that.
  std::function<void(std::size_t number, Piece& piece)> fault = {};

  /// Where the mesh is adapted to lengths, so that what is there is no bound; else null.
  const WantedLengths* wanted() const { return size_field ? size_field->wanted() : nullptr; }
};

/// The lengths of a file in those of a mesh. `of_file` must outlive it.
std::shared_ptr<const WantedLengths> in_work(const WantedLengths& of_file, const Scale& scale);

/// What differs from piece to piece.
struct TaskLimits {
  /// Only tets near former borders may change: those within so many edges. 0: all may.
  unsigned rings = 0;
  /// Of them, what is within so many edges is tried; others where something has changed.
  unsigned fresh_rings = 0;
  /// Numbers of tets that a schedule names are of the whole mesh. A piece has a share of them: so many
  /// of its tets, or where `share` is 0, those that may change.
  std::uint64_t whole = 0;  ///< 0: it has all
  std::uint64_t share = 0;
  Bounds bounds;  ///< of the whole mesh, as the run found it
  bool is_zone = false;
  Aim aim = Aim::all;
  std::size_t most_new_tets = std::numeric_limits<std::size_t>::max();  ///< that it may grow by
  /// A zone may end with so many more bad tets, if the worst are better.
  std::size_t spare_bad = 0;
  double seconds = 0;  ///< 0: no limit
  /// Null, or gives what records the run on the mesh of the piece; null: nothing does.
  std::function<TraceSink*(const TetMesh&)> trace = {};
};

/// What became of a piece. New vertices have the ids kNewVertex, kNewVertex + 1, ...
struct TaskResult {
  static constexpr VertexId kNewVertex = VertexId{1} << 63;

  Piece piece;  ///< what is its own, and the vertices of that
  std::uint64_t added = 0;
  std::array<std::size_t, kVerdictCount> verdicts{};
  std::size_t items = 0;
  std::size_t deferred = 0;
  bool went_back = false;  ///< some figure had become worse, so it is as before
  bool stopped = false;    ///< cancelled or out of time
};

/// Works on the piece of that number. `gathered` holds all tets with a vertex in its part.
/// @param surface null: it is fixed
/// @throws Error for a mesh of broken topology, or a mistake in the script; contract::Breach as
/// contract/inspector.h
TaskResult work_on(const Piece& gathered, const Parting& parting, std::uint32_t number,
                   const TaskOptions& options, const TaskLimits& limits,
                   const HeldSurface* surface = nullptr);

/// The same without any work: what is its own.
Piece own_part(const Piece& gathered, const Parting& parting, std::uint32_t number);

/// The quality of the worst tet that work_on() may change; nothing where there is none.
std::optional<double> worst_free(const Piece& gathered, const Parting& parting,
                                 std::uint32_t number, unsigned rings, const Standard& standard);

}  // namespace tetmend::pieces
