// SPDX-License-Identifier: MIT
// How to make the run again.
#pragma once

#include <string>
#include <vector>

#include "report/figures.h"

namespace tetmend::report {

/// The words as a shell reads them, quoted where they must be.
std::string shell_line(const std::vector<std::string>& words);

/// The command, and what else decides about the result.
std::string repeat_section(const Figures& figures);

}  // namespace tetmend::report
