// SPDX-License-Identifier: MIT
// What passes are told: which operators, where, how often.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <tetmend/api.h>

#include "kernel/judge.h"
#include "ops/parameters.h"
#include "schedule/selection.h"

namespace tetmend {

/// In which order the edges of a tet are tried.
enum class EdgeOrder {
  sine,     ///< lowest sine of the dihedral angle first: the edges to get rid of
  angle,    ///< largest dihedral angle first: those of them that go most easily
  longest,  ///< longest first: the edges to split
  shortest
};

/// One operator, or several that are tried one after the other.
struct TETMEND_API Composition {
  enum class Kind {
    one,       ///< the operator
    first_of,  ///< the parts in turn, until an attempt is accepted
    all_of,    ///< the parts in turn, until the tet is gone
    /// The first part, an operator, opens: it may make things worse. The others follow, each on the
    /// bad tets among all that has changed, the worst first. What came of it stays only if it is
    /// better as a whole; with a theta_max, if the largest angles are.
    sequence
  };
  Kind kind = Kind::one;
  std::string operator_name = {};  ///< of Kind::one
  ParameterSettings settings = {};
  EdgeOrder order = EdgeOrder::sine;
  unsigned most_edges = 6;        ///< of a tet that are tried, the first in that order
  double desperate = kDesperate;  ///< of a sequence: below this worst quality, a gain of 0.002
                                  ///< pays for one more bad tet
  /// Of a sequence, degrees. Below 180 it is tried on tets with a larger dihedral angle only, what
  /// follows works on such tets as well, and it stays if the sine of the largest angle of all that
  /// has changed gains 0.002 on the tet's, and as much for each more bad tet, and the worst tet
  /// gets no worse.
  double theta_max = 180;
  std::vector<Composition> parts = {};  ///< of the other kinds

  /// As a script writes it, settings left out: first_of(edge_removal, flip_2_3).
  std::string name() const;
  /// Equal for compositions that do the same.
  std::string describe() const;
};

/// What makes a tangle.
struct TangleLimits {
  double share = 0.05;         ///< of inverted or flat tets among those around their vertices
  std::size_t at_least = 100;  ///< so many of them
  unsigned rings = 3;          ///< vertices that far from theirs may move, too
};

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
  /// Percent: where the bad angles come to this share of all, no tet is flipped and no vertex
  /// removed, for fewer tets raise the share.
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

}  // namespace tetmend
