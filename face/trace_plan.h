// SPDX-License-Identifier: MIT
// Whether a run is recorded, and what of it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <tetmend/improve.h>

#include "ops/registry.h"
#include "schedule/schedule.h"
#include "trace/recorder.h"

namespace tetmend::face {

/// Options::trace_piece: what of a run in pieces is recorded.
struct TracedPiece {
  unsigned round = 1;                  ///< from 1
  std::optional<std::uint32_t> piece;  ///< from 0; none: it follows from a place

  /// Nothing where it is empty. @throws OptionError for another form.
  static std::optional<TracedPiece> of(const Options& options);
};

/// What of a run is to be recorded. A tet is named by its number in the data, so it must be looked
/// up before a mesh is built of them.
class TracePlan {
 public:
  /// @throws OptionError for a mistake in the options; Error when the file cannot be written.
  TracePlan(const Options& options, const Registry& registry);
  /// @param input file of the mesh; empty: none
  /// @throws OptionError when the trace would replace that file, what it includes, the schedule or a
  /// plugin.
  static void check_files(const Options& options, const std::filesystem::path& input);
  /// Finds the tet of `trace_around`. @throws OptionError when the mesh has no such tet.
  void locate(const MeshData& data);
  /// The tet of `trace_around` that nobody has located yet.
  std::optional<std::uint64_t> tet() const { return tet_; }
  /// It has these corners.
  void locate(const std::array<Point, 4>& corners);
  /// The middle of `trace_around`; nothing where there is none, or where it is not located yet.
  std::optional<Point> place() const;
  /// Empty: no trace is wanted.
  const std::filesystem::path& file() const { return file_; }

  /// Null when no trace is wanted. @throws Error when the file cannot be written.
  std::unique_ptr<TraceRecorder> start(const TetMesh& mesh, const std::filesystem::path& input,
                                       const Schedule& schedule,
                                       const ScheduleSettings& settings) const;
  /// The same of one piece. Its times are steps, so that the bytes depend on the piece alone.
  /// @param piece  names and values that say which it is, as options of the command line
  std::unique_ptr<TraceRecorder> start_piece(const TetMesh& mesh,
                                             const std::filesystem::path& input,
                                             const Schedule& schedule,
                                             const ScheduleSettings& settings,
                                             const ScheduleSettings& piece) const;

 private:
  void read_around(std::string_view text);
  TraceHeader header(const std::filesystem::path& input, const Schedule& schedule,
                     const ScheduleSettings& settings) const;

  std::filesystem::path file_;
  TraceFilter filter_;
  std::string surface_;  // Options::surface, unless the surface is fixed
  std::optional<std::uint64_t> tet_;
};

}  // namespace tetmend::face
