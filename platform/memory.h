// SPDX-License-Identifier: MIT
// How much memory there is.
#pragma once

#include <cstdint>

namespace tetmend::platform {

/// Bytes of memory that this process may take: those of the machine, of its container, or of a limit
/// that somebody set, whichever are fewest.
std::uint64_t memory_for_process() noexcept;

}  // namespace tetmend::platform
