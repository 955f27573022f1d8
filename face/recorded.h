// SPDX-License-Identifier: MIT
// A run for a program: its trace and its reports get their names together with the mesh, and it can
// be drawn, or followed.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include <tetmend/improve.h>

#include "face/portrait.h"
#include "kernel/mesh_data.h"
#include "kernel/mesh_view.h"
#include "schedule/run.h"
#include "trace/recorder.h"

namespace tetmend::face {

/// Which figures a result has: all, or those that a run is judged by. What nobody reads need not be
/// measured: then Result::size_drift is empty, and MeshRulers::cg_steps and work are no numbers.
enum class Figures : bool { judging, all };

/// As tetmend::improve(), but the trace is not finished.
/// @param trace what finish() gives its name; null if none was asked for. No event may follow.
/// @param portrait null, or empty; filled before improve() returns. For a million tets that takes
/// about 0.5 s on one thread.
Result improve(Mesh& mesh, const Options& options, std::unique_ptr<TraceRecorder>& trace,
               Portrait* portrait = nullptr, Figures figures = Figures::all);

/// As tetmend::improve(), drawn. @param portrait see above
Result improve(Mesh& mesh, const Options& options, Portrait* portrait);

/// The mesh of a run as it is, by a copy, with all that the user's mesh holds besides, as improve()
/// would leave it. For the thread of the run, or while that waits. Cost: n log n.
using DataSoFar = std::function<MeshData()>;

/// Looks into a run while it goes on.
class Follower {
 public:
  virtual ~Follower() = default;
  /// The passes of `run` begin, or begin anew where it goes back; `run` is the one before no longer.
  /// What is returned is told of passes, attempts and edits, all in one thread. It may look at the
  /// mesh meanwhile, and hold parameters where a pass begins. Null: nothing. `so_far` may be asked
  /// as long as the run is there.
  virtual TraceSink* follow(Run& run, const DataSoFar& so_far) = 0;
};

/// As tetmend::improve(), followed. Options::trace must be empty: who follows may record.
Result improve(Mesh& mesh, const Options& options, Follower& follower);

/// As tetmend::save(). Other files appear together with the mesh, or nothing does.
void save(const std::filesystem::path& file, const Mesh& mesh, int threads,
          const std::string& variant, MeshView::Companions companions);

}  // namespace tetmend::face
