// SPDX-License-Identifier: MIT
// All figures of both meshes side by side, and histograms of all measures.
#pragma once

#include <string>

#include "report/figures.h"

namespace tetmend::report {

std::string measure_tables(const Figures& figures);

/// Of the dihedral angles and of each ruler.
std::string histograms(const Figures& figures);

}  // namespace tetmend::report
