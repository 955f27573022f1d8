// SPDX-License-Identifier: MIT
// The worst tets that are left, each with a picture and the reason why it is there.
#pragma once

#include <array>
#include <string>

#include <Eigen/Core>

#include "report/figures.h"

namespace tetmend::report {

/// Of a tet as seen where it shows most of its shape: faces shine through, edges with an angle that
/// misses the goal are red, the smallest and the largest angle stand at their edges; a corner that
/// may move is a ring.
/// @param goal smallest and largest angle, degrees
std::string tet_picture(const std::array<Eigen::Vector3d, 4>& corners,
                        const std::array<bool, 4>& is_free, std::array<double, 2> goal);

/// A list of those that the report names; a sentence where there are none.
std::string worst_tets(const Figures& figures);

/// How many bad tets are there for which reason, and what helps. Empty where none are left.
std::string reasons(const Figures& figures);

}  // namespace tetmend::report
