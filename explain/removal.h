// SPDX-License-Identifier: MIT
// What a call of the recursion is to remove, and for whom: (e, f, l) of [chen, Alg. 4].
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "trace/trace_file.h"

namespace tetmend::explain {

struct Removal {
  std::array<VertexHandle, 2> edge;  ///< e
  std::optional<std::array<VertexHandle, 3>>
      face;  ///< f, of the shell of the caller; none at first
  unsigned level = 0;
};

/// The recursion that a call is a step of, which may be the call itself; kNoCall if it is of none.
std::uint32_t recursion_of(const TraceFile& file, std::uint32_t call);

/// The recursion that called that one for another edge; kNoCall if there is none.
std::uint32_t caller_of(const TraceFile& file, std::uint32_t call);

/// Nothing for a call that is no step of a recursion. Precondition: there is such a call.
std::optional<Removal> removal_of(const TraceFile& file, std::uint32_t call);

/// "to remove: face f = 0 1 5 at its link edge e = 1 5, level 1"
std::string to_text(const Removal& removal);

}  // namespace tetmend::explain
