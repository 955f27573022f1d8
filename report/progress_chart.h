// SPDX-License-Identifier: MIT
// Quality over time, pass by pass, and what each kind of pass tried, achieved and cost.
#pragma once

#include <string>

#include "report/figures.h"

namespace tetmend::report {

/// Bad tets and the worst quality over the seconds of improving, as an inline SVG. Each pass has a
/// <title>. Empty if there was no pass.
std::string progress_chart(const Figures& figures);

/// A table with a row for each name of a pass, in the order in which they appear first.
std::string pass_table(const Figures& figures);

}  // namespace tetmend::report
