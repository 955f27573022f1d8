// SPDX-License-Identifier: MIT
// What the tests of insertion in an octahedron share.
#pragma once

#include "kernel/judge.h"
#include "tests/support/lone_worker.h"

namespace tetmend::test {

inline const Corners kTarget = {0, 1, 2, 3};
inline const ParameterSettings kUnsmoothed = {{"smooth", 0}};

// Some octahedra are flat: needles would be in the way.
inline const Standard kSine = Standard(Goal{}, Standard::Terms::sine);

}  // namespace tetmend::test
