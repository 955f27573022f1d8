// SPDX-License-Identifier: MIT
// The passes over a mesh: each walks the bad tets and tries operators on them. What schedules are
// made of.
#pragma once

#include "schedule/run.h"

namespace tetmend {

/// Limits a pass to the worst tets: those below `below`, and always the worst `at_least`.
struct Worst {
  Quality below = 1;
  std::size_t at_least = 200;
};

// Options hold the operators to use by name and the parameters of the pass, so that a script can
// set them. `calendar` names the dates by which unchanged neighbourhoods are passed over: passes
// with other settings, which may succeed where this one failed, need one of their own.
struct LocalReconnection {
  std::string calendar = "local_reconnection";
  std::string edge_operator = "recursive_shell_transformation";  ///< empty: none
  ParameterSettings edge_settings = {};
  std::string face_operator = "multi_face_removal";  ///< empty: none
  ParameterSettings face_settings = {};
  Quality threshold = kBadThreshold;  ///< tets below it are tried
  unsigned sweeps = 2;                ///< new bad tets are tried in the next sweep
  Worst worst = {};
};

struct SmoothingPass {
  std::string calendar = "smoothing";
  ParameterSettings settings = {};
  Quality threshold = kBadThreshold;
  unsigned cycles = 4;  ///< at most; ends earlier when a cycle brings no progress
};

struct SuppressionPass {
  std::string calendar = "point_suppression";
  ParameterSettings settings = {};
  Quality threshold = kBadThreshold;
};

struct InsertionPass {
  std::string calendar = "point_insertion";
  ParameterSettings settings = {};
  Quality threshold = kBadThreshold;
  Worst worst = {};
};

/// [chen, Alg. 5]: bad tets from the worst up; edges of the tet in the order of their dihedral
/// angle's sine, then faces, until the tet is gone.
void local_reconnection(Run& run, const LocalReconnection& options);

/// [chen, 6.2]: smooths the movable vertices of bad tets, cycle by cycle, while an indicator
/// improves. A vertex whose ball has not changed since it was last tried is passed over.
void smooth(Run& run, const SmoothingPass& options);

/// [chen, 6.3]: tries to remove each movable vertex of a bad tet by edge contraction, once.
void suppress_points(Run& run, const SuppressionPass& options);

/// [chen, 6.3]: tries to split the edges of bad tets, worst tets and longest edges first, each edge
/// once.
void insert_points(Run& run, const InsertionPass& options);

/// True if `now` is sufficient progress over `before`: q_worst or n_bad or, with n_bad no larger,
/// q_aver improved noticeably.
bool is_progress(const QualityIndicators& before, const QualityIndicators& now);

}  // namespace tetmend
