// SPDX-License-Identifier: MIT
// The charts of a report for a page of somebody else, such as a notebook.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace tetmend::report {

/// A <div> with a style of its own: the verdict, the histograms that the report has, quality over
/// time, and the passes. No script; texts of the report are never markup.
std::string write_fragment(const nlohmann::json& report);

}  // namespace tetmend::report
