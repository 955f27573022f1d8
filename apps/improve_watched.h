// SPDX-License-Identifier: MIT
// A run that a person watches and may interrupt, and what it reports.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <tetmend/improve.h>

#include "apps/improve_options.h"
#include "apps/improve_report.h"
#include "apps/interruption.h"
#include "apps/progress_line.h"
#include "kernel/formats/output_file.h"

namespace tetmend::apps {

/// Before the schedule signals end the program: there is nothing to be saved yet.
/// @param interruption begins then
/// @param work what is done with the options
Result improve_watched(const ImproveOptions& all, ProgressLine& line,
                       std::optional<Interruption>& interruption,
                       const std::function<Result(const Options&)>& work);

/// As JSON or as a page, by the ending of each: complete, but without their names.
std::vector<std::unique_ptr<OutputFile>> make_reports(
    const std::vector<std::filesystem::path>& files, const ImproveReport& report);
/// The same with their names.
void write_reports(const std::vector<std::filesystem::path>& files, const ImproveReport& report);

}  // namespace tetmend::apps
