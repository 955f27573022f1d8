// SPDX-License-Identifier: MIT
// Meshes that one file is, and those that several are or that all ranks read together.
#pragma once

#include <filesystem>

#include "apps/files.h"
#include "pieces/rank_share.h"

namespace tetmend::apps {

/// What commands do with the names of IN and OUT before they read.
/// @param known formats that all ranks read and write together; null: none
/// @throws UsageError for an extension of no format, and a variant that OUT does not have; Error when
/// it is known already that OUT cannot be written
void check_formats(const std::filesystem::path& input, const std::filesystem::path& output,
                   const CarryOptions& carry, const pieces::ArrayFiles* known);

}  // namespace tetmend::apps
