// SPDX-License-Identifier: MIT
// The passes over a mesh: each selects tets and tries operators on them. What schedules are made
// of.
#pragma once

#include <string>

#include "schedule/composition.h"
#include "schedule/run.h"
#include "schedule/selection.h"

namespace tetmend {

// Options hold the operators to use by name and the parameters of the pass. A pass leaves out what
// has not changed since it last looked there with the same options.
struct LocalReconnection {
  Selection on = {};
  std::string edge_operator = "recursive_shell_transformation";  ///< empty: none
  ParameterSettings edge_settings = {};
  EdgeOrder edge_order = EdgeOrder::sine;
  unsigned most_edges = 6;                           ///< of a tet that are tried
  std::string face_operator = "multi_face_removal";  ///< empty: none
  ParameterSettings face_settings = {};
  unsigned sweeps = 2;  ///< new bad tets are tried in the next sweep
};

struct SmoothingPass {
  Selection on = {};
  ParameterSettings settings = {};
  unsigned cycles = 4;  ///< at most; ends earlier when a cycle brings no progress
};

struct SuppressionPass {
  Selection on = {};
  ParameterSettings settings = {};
};

struct InsertionPass {
  Selection on = {};
  ParameterSettings settings = {};
};

struct ApplyPass {
  Composition what;
  Selection on = {};
  unsigned sweeps = 1;  ///< at most; ends earlier when nothing is accepted
  bool again = false;   ///< also where nothing changed
};

/// [chen, Alg. 5]: selected tets from the worst up; edges of the tet in the order of their dihedral
/// angle's sine, then faces, until the tet is gone.
void local_reconnection(Run& run, const LocalReconnection& options = {});

/// [chen, 6.2]: smooths the movable vertices of selected tets, cycle by cycle, while an indicator
/// improves. A vertex whose ball has not changed since it was last tried is passed over.
void smooth(Run& run, const SmoothingPass& options = {});

/// [chen, 6.3]: tries to remove each movable vertex of a selected tet by edge contraction, once.
void suppress_points(Run& run, const SuppressionPass& options = {});

/// [chen, 6.3]: tries to split the edges of selected tets, worst tets and longest edges first, each
/// edge once.
void insert_points(Run& run, const InsertionPass& options = {});

/// Any operators: on selected tets from the worst up, or, for one operator on vertices, on their
/// movable vertices in the order of the mesh.
void apply(Run& run, const ApplyPass& options);

/// True if `now` is sufficient progress over `before`: q_worst or n_bad or, with n_bad no larger,
/// q_aver improved noticeably.
bool is_progress(const QualityIndicators& before, const QualityIndicators& now);

}  // namespace tetmend
