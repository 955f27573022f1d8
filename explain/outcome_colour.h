// SPDX-License-Identifier: MIT
// The colours of the ways in which calls end.
#pragma once

#include "explain/call_facts.h"
#include "figure/colour.h"

namespace tetmend::explain {

figure::Colour outcome_colour(Outcome outcome);

}  // namespace tetmend::explain
