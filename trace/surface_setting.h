// SPDX-License-Identifier: MIT
// How a trace says that the surface might move.
#pragma once

namespace tetmend {

/// Name in TraceHeader::settings; its value is that of the option. Not there if the surface stayed.
inline constexpr const char* kSurfaceSetting = "--surface";

}  // namespace tetmend
