// SPDX-License-Identifier: MIT
// The operators of tetmend, for tests that add none.
#pragma once

#include "ops/registry.h"

namespace tetmend::test {

inline const Registry kRegistry = Registry::builtin();

}  // namespace tetmend::test
