// SPDX-License-Identifier: MIT
// Whether a run is recorded, and what of it.
#pragma once

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

/// What of a run is to be recorded. A tet is named by its number in the data, so it must be looked
/// up before a mesh is built of them.
class TracePlan {
 public:
  /// @throws OptionError for a mistake in the options; Error when the file cannot be written.
  TracePlan(const Options& options, const Registry& registry);
  /// Finds the tet of `trace_around`. @throws OptionError when the mesh has no such tet.
  void locate(const MeshData& data);
  /// Null when no trace is wanted. @throws Error when the file cannot be written.
  std::unique_ptr<TraceRecorder> start(const TetMesh& mesh, const std::filesystem::path& input,
                                       const Schedule& schedule,
                                       const ScheduleSettings& settings) const;

 private:
  void read_around(std::string_view text);

  std::filesystem::path file_;
  TraceFilter filter_;
  std::string surface_;  // Options::surface, unless the surface is fixed
  std::optional<std::uint64_t> tet_;
};

}  // namespace tetmend::face
