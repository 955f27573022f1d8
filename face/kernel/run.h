// SPDX-License-Identifier: MIT
// Passes over a program's mesh, and whole schedules.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tetmend/api.h>
#include <tetmend/goal.h>
#include <tetmend/statistics.h>

#include "face/kernel/own_operators.h"
#include "face/kernel/tet_mesh.h"
#include "schedule/pass_options.h"
#include "trace/trace_sink.h"

namespace tetmend::kernel {

using tetmend::ApplyOptions;
using tetmend::AttemptEvent;
using tetmend::Composition;
using tetmend::Goal;
using tetmend::InsertPointsOptions;
using tetmend::LocalReconnectionOptions;
using tetmend::PolishOptions;
using tetmend::QualityIndicators;
using tetmend::Selection;
using tetmend::SmoothOptions;
using tetmend::SuppressPointsOptions;
using tetmend::TraceSink;
using tetmend::UntangleOptions;
using tetmend::ValueRange;

/// What a pass did.
struct TETMEND_API PassDone {
  std::string name;
  std::size_t attempts = 0;
  std::size_t accepted = 0;
  double seconds = 0;
  QualityIndicators after;
  std::array<std::size_t, kVerdictCount> verdicts{};  ///< attempts by Verdict

  /// How many attempts ended so.
  std::size_t ended(Verdict verdict) const { return verdicts[static_cast<std::size_t>(verdict)]; }
};

/// How a Run works.
struct TETMEND_API RunOptions {
  int threads = 1;  ///< the result is the same for every number
  /// Those of the program, besides those of tetmend. Passes make one part of the mesh then, and one
  /// thread works, for a function may look anywhere. Must outlive the run.
  const Operators* operators = nullptr;
  /// Told of passes, attempts and edits, in one thread. Must outlive the run.
  TraceSink* observer = nullptr;
  std::size_t most_tets = std::numeric_limits<std::size_t>::max();  ///< none is added above that
  std::size_t most_attempts = std::numeric_limits<std::size_t>::max();  ///< of all passes together
  const std::atomic<bool>* cancel = nullptr;  ///< passes end soon after it became true
  /// A file for all that passes do, see docs/trace.md; empty: none. One thread works then. Only
  /// passes may change the mesh until finish_trace(): another one throws Error.
  std::filesystem::path trace = {};
};

/// One operator for ApplyOptions::what and for the parts of the following.
inline Composition one(std::string name, ParameterSettings settings = {}) {
  return {.operator_name = std::move(name), .settings = std::move(settings)};
}
/// Each in turn, until an attempt is accepted.
inline Composition first_of(std::vector<Composition> parts) {
  return {.kind = Composition::Kind::first_of, .parts = std::move(parts)};
}
/// Each in turn, until the tet is gone.
inline Composition all_of(std::vector<Composition> parts) {
  return {.kind = Composition::Kind::all_of, .parts = std::move(parts)};
}
/// The first may make things worse; the others follow on what is bad of it, and all stays if it is
/// better as a whole.
inline Composition sequence(std::vector<Composition> parts) {
  return {.kind = Composition::Kind::sequence, .parts = std::move(parts)};
}

/// Passes over a mesh, as a schedule makes them: what shell.lua says, in C++. A pass leaves out
/// what has not changed since it last looked there with the same options, until the program itself
/// changes the mesh. Locked vertices stay; properties follow, and one thread works then. Selections,
/// also those of scripts, know properties of tets that are numbers by their names.
///
/// The mesh must outlive the run. Passes throw Error while a transaction is open, for unknown
/// operators and parameters, and what a function of an operator throws, with its name; the mesh is
/// sound then.
class TETMEND_API Run {
 public:
  /// @throws OptionError for a number of threads without sense
  explicit Run(TetMesh& mesh, RunOptions options = {});
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// Of the mesh as it is. Cost: linear, unless a pass has just ended.
  QualityIndicators indicators();
  /// What is bad from now on, also for TetMesh::quality().
  void set_goal(const Goal& goal);

  // Where no options are given, passes work on the bad tets.
  PassDone local_reconnection(const LocalReconnectionOptions& options = {});
  PassDone smooth(const SmoothOptions& options = {});
  PassDone suppress_points(const SuppressPointsOptions& options = {});
  PassDone insert_points(const InsertPointsOptions& options = {});
  PassDone polish(const PolishOptions& options = {});
  PassDone untangle(const UntangleOptions& options = {});
  PassDone apply(const ApplyOptions& options);
  /// One operator, where the selection says.
  PassDone apply(std::string name, const Selection& on = {}) {
    return apply({.what = one(std::move(name)), .on = on});
  }
  /// The passes of a script, see docs/schedules.md, or of a schedule of tetmend by its name.
  /// @throws Error "NAME:LINE: reason" for a mistake in it
  std::vector<PassDone> schedule(
      std::string_view name_or_script,
      const std::vector<std::pair<std::string, std::string>>& settings = {});

  /// Attempts ran out, or `cancel` was set.
  bool is_over() const;
  /// The trace gets its name, and later passes are not in it. The destructor does the same, but
  /// cannot tell of trouble.
  /// @throws Error when the file could not be written
  void finish_trace();

 private:
  struct Inside;
  template <class Pass>
  std::vector<PassDone> make(const Pass& pass);
  std::unique_ptr<Inside> inside_;
};

/// True if `now` is sufficient progress over `before`: for loops over rounds.
TETMEND_API bool is_progress_over(const QualityIndicators& now, const QualityIndicators& before);

}  // namespace tetmend::kernel
