// SPDX-License-Identifier: MIT
// The colours of the ways in which calls end.
#pragma once

#include "explain/call_facts.h"
#include "viewer/debugger/explained.h"
#include "viewer/mesh/colour_map.h"

namespace tetmend::viewer {

Colour outcome_colour(Outcome outcome);

}  // namespace tetmend::viewer
