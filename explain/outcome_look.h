// SPDX-License-Identifier: MIT
// How the ways in which calls end look: a colour, and a mark that tells them apart without it.
#pragma once

#include <span>
#include <vector>

#include "explain/call_facts.h"
#include "figure/colour.h"
#include "figure/drawing.h"

namespace tetmend::explain {

figure::Colour outcome_colour(Outcome outcome);

/// Lines in a square from 0 to 1, y downwards: a check, an arrow back, a dash, a clock, a lock, a
/// cross, a slash, two bars; a ring of one that is under way or cut off.
std::span<const std::vector<figure::Place>> outcome_mark(Outcome outcome);

/// The mark in the colour of the outcome, in a square with its upper left corner there.
void add_mark(figure::Drawing& drawing, Outcome outcome, figure::Place corner, double side);

/// Slanted white lines over the bar of a call that was undone.
void add_hatching(figure::Drawing& drawing, figure::Place corner, double width, double height);

/// A bar of many calls: as much of its height in each colour as ended so. `ended` is by Outcome.
void add_shares(figure::Drawing& drawing, std::span<const std::uint32_t, kOutcomeCount> ended,
                figure::Place corner, double width, double height);

}  // namespace tetmend::explain
