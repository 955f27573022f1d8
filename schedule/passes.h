// SPDX-License-Identifier: MIT
// The passes over a mesh: each selects tets and tries operators on them. What schedules are made
// of. Scripts, records and traces call a pass as the function is called here; a pass of apply() has
// the name of its operators.
#pragma once

#include <string>

#include "schedule/composition.h"
#include "schedule/pass_options.h"
#include "schedule/run.h"

namespace tetmend {

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
