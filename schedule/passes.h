// SPDX-License-Identifier: MIT
// The passes over a mesh: each selects tets and tries operators on them. What schedules are made
// of. Scripts, records and traces call a pass as the function is called here; a pass of apply() has
// the name of its operators.
#pragma once

#include <string>

#include "schedule/composition.h"
#include "schedule/run.h"
#include "schedule/selection.h"
#include "schedule/tangle.h"

namespace tetmend {

// Options hold the operators to use by name and the parameters of the pass. A pass leaves out what
// has not changed since it last looked there with the same options.
struct LocalReconnectionOptions {
  Selection on = {};
  std::string edge_operator = "recursive_shell_transformation";  ///< empty: none
  ParameterSettings edge_settings = {};
  EdgeOrder edge_order = EdgeOrder::sine;
  unsigned most_edges = 6;                           ///< of a tet that are tried
  std::string face_operator = "multi_face_removal";  ///< empty: none
  ParameterSettings face_settings = {};
  unsigned sweeps = 2;  ///< new bad tets are tried in the next sweep
};

struct SmoothOptions {
  Selection on = {};
  ParameterSettings settings = {};
  unsigned cycles = 4;  ///< at most; ends earlier when a cycle brings no progress
};

struct SuppressPointsOptions {
  Selection on = {};
  ParameterSettings settings = {};
};

struct InsertPointsOptions {
  Selection on = {};
  ParameterSettings settings = {};
};

struct PolishOptions {
  double below = 0.7;    ///< flips are tried where the mean ratio of a tet is less
  double insert = 0.75;  ///< a vertex is inserted where the mean ratio of a tet is less; 0: nowhere
  /// Free vertices are removed that have an edge shorter than this share of the length of the edges
  /// around; 0: none
  double contract = 2;
  /// Percent: where the bad angles come to this share of all, no tet is flipped and no vertex removed,
  /// for fewer tets raise the share.
  double lambda = 100;
  double grow = 1;      ///< the mesh grows by at most that share of its tets
  double smooth = 1;    ///< free vertices of tets with a mean ratio below are smoothed
  unsigned cycles = 3;  ///< at most; ends earlier when nothing is accepted
};

struct UntangleOptions {
  TangleLimits where = {};
  unsigned looks = 400;  ///< at all tets of a tangle, at most
};

struct ApplyOptions {
  Composition what;
  Selection on = {};
  unsigned sweeps = 1;  ///< at most; ends earlier when nothing is accepted
  bool again = false;   ///< also where nothing changed
};

/// [chen, Alg. 5]: selected tets from the worst up; edges of the tet in the order of their dihedral
/// angle's sine, then faces, until the tet is gone.
void local_reconnection(Run& run, const LocalReconnectionOptions& options = {});

/// [chen, 6.2]: smooths the movable vertices of selected tets, cycle by cycle, while an indicator
/// improves. A vertex whose ball has not changed since it was last tried is passed over.
void smooth(Run& run, const SmoothOptions& options = {});

/// [chen, 6.3]: tries to remove each movable vertex of a selected tet by edge contraction, once.
void suppress_points(Run& run, const SuppressPointsOptions& options = {});

/// [chen, 6.3]: tries to split the edges of selected tets, worst tets and longest edges first, each
/// edge once.
void insert_points(Run& run, const InsertPointsOptions& options = {});

/// Raises the mean of the mean ratios: smooths movable vertices, flips, contracts and inserts, where
/// that raises it and no tet falls below the goal or gets worse below it.
void polish(Run& run, const PolishOptions& options = {});

/// Moves all free vertices of a tangle at once, so that its tets become positive. The mesh is the
/// same afterwards unless fewer tets are inverted or flat, no more are bad and no bound is broken. No
/// pass is recorded where nothing is tangled. A run that is stopped meanwhile leaves the tangle as it
/// is.
void untangle(Run& run, const UntangleOptions& options = {});

/// Any operators: on selected tets from the worst up, or, for one operator on vertices, on their
/// movable vertices in the order of the mesh.
void apply(Run& run, const ApplyOptions& options);

/// True if `now` is sufficient progress over `before`: q_worst or n_bad or, with n_bad no larger,
/// q_aver improved noticeably.
bool is_progress(const QualityIndicators& before, const QualityIndicators& now);

}  // namespace tetmend
