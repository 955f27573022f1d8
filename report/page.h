// SPDX-License-Identifier: MIT
// The report of a run as one HTML file that needs nothing else.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "face/portrait.h"
#include "report/shape.h"

namespace tetmend::report {

/// @param report as `tetmend improve --report FILE.json` writes it. Texts in it are never markup.
/// @param portrait of the same run
/// All figures of the page are those of the report. Below 1 MB; what is left out for that is said.
std::string write_page(const nlohmann::json& report, const face::Portrait& portrait,
                       const ShapeLimits& limits = {});

}  // namespace tetmend::report
