// SPDX-License-Identifier: MIT
// For what a run goes back.
#pragma once

#include <string>
#include <vector>

#include <tetmend/improve.h>

namespace tetmend::face {

/// What of Result::worse() is not the price of inverted tets that were mended, in the same words:
/// for that, an older state of the mesh is better.
std::vector<std::string> worse_for_nothing(const Result& result);

}  // namespace tetmend::face
