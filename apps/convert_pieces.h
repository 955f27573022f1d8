// SPDX-License-Identifier: MIT
// A mesh in another format, where one of the two is a mesh in parts, or by all ranks together.
#pragma once

#include <cstddef>
#include <filesystem>

#include "apps/files.h"
#include "pieces/rank_share.h"
#include "pieces/ranks.h"

namespace tetmend::apps {

/// All ranks. No rank has more than its share, where both formats allow that.
/// @param known formats that all ranks read and write together; null: none
/// @param parts of OUT, if it is a mesh in parts; 0: one for each piece that a run would make
/// @throws Error
void convert_pieces(const std::filesystem::path& input, const std::filesystem::path& output,
                    const CarryOptions& carry, const pieces::ArrayFiles* known, std::size_t parts,
                    Ranks& ranks);

}  // namespace tetmend::apps
