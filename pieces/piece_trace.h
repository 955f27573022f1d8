// SPDX-License-Identifier: MIT
// The trace of a run in pieces: what one piece sees in one round.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <tetmend/improve.h>

#include "face/plan.h"
#include "pieces/divided_mesh.h"
#include "trace/recorder.h"

namespace tetmend::pieces {

/// A round of a run, whose pieces are there.
struct TracedRound {
  unsigned number = 1;       ///< from 1
  bool is_zones = false;     ///< zones alone are worked on
  unsigned rings = 0;        ///< TaskLimits::rings
  const Standard& standard;  ///< which tets are the worst
};

/// Which piece is recorded, and what becomes of the recording. All ranks choose the same one; the
/// rank that works on it writes the file. Nothing that goes wrong here ends a run.
class PieceTrace {
 public:
  /// @param input  file of the mesh, for the trace
  /// All of these must outlive it. @throws OptionError as TracePlan::check_files()
  PieceTrace(const Options& options, face::Plan& plan, std::filesystem::path input);

  /// Somebody wants a trace, and there is nothing against it.
  bool is_wanted() const { return is_wanted_; }
  unsigned round() const { return choice_.round; }
  /// This one, whatever the options say.
  void choose(unsigned round, std::uint32_t part);
  /// All ranks: finds the tet that `trace_around` names, in all pieces or in one.
  /// @throws OptionError where it is not, or not any more.
  void locate(const DividedMesh& mesh, std::optional<std::size_t> part = std::nullopt);
  /// The round is over in a run that goes on: the trace of then stays.
  /// @throws OptionError if there is none.
  void skip(Ranks& ranks);
  /// All ranks, before a round is worked on.
  void begin_round(const DividedMesh& mesh, const TracedRound& round);
  bool is_of(unsigned round, std::size_t part) const {
    return is_wanted_ && round == choice_.round && part == choice_.piece;
  }
  /// The rank that has the piece: starts to record. Null: that failed.
  TraceSink* start(const TetMesh& mesh, const ScheduleSettings& settings, std::size_t pieces);
  /// No event may follow. This rank gives the file its name, if it has one.
  void finish();
  /// All ranks: finishes. What went wrong, as "FILE: reason"; empty: nothing.
  std::string finish_all(Ranks& ranks);
  /// Of one rank alone: the recorder, to be finished later, and what has gone wrong until then.
  std::unique_ptr<TraceRecorder> take_recorder(std::string& trouble);
  /// Which piece it is, for people; empty: none was chosen.
  const std::string& note() const { return note_; }

 private:
  std::optional<std::uint32_t> with_worst(const DividedMesh& mesh, const TracedRound& round) const;
  std::string trouble() const;

  const Options& options_;
  face::Plan& plan_;
  std::filesystem::path input_;
  face::TracedPiece choice_;
  bool is_wanted_ = false;
  bool is_explicit_ = false;  // choice_ has the piece
  bool has_begun_ = false;
  bool was_made_ = false;  // by this rank
  std::unique_ptr<TraceRecorder> recorder_;
  std::string trouble_;
  std::string note_;
};

/// @throws OptionError for a piece that a run of so many cannot have.
void check_trace_piece(const Options& options, std::size_t pieces, unsigned divisions,
                       unsigned zone_rounds);

}  // namespace tetmend::pieces
