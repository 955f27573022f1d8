// SPDX-License-Identifier: MIT
// A mesh in another format, by all ranks together.
#pragma once

#include <filesystem>

#include "apps/files.h"
#include "pieces/rank_share.h"
#include "pieces/ranks.h"

namespace tetmend::apps {

/// All ranks. No rank has more than its share, where both formats allow that.
/// @param known formats that all ranks read and write together; null: none
/// @throws Error
void convert_pieces(const std::filesystem::path& input, const std::filesystem::path& output,
                    const CarryOptions& carry, const pieces::ArrayFiles* known, Ranks& ranks);

}  // namespace tetmend::apps
