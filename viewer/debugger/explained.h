// SPDX-License-Identifier: MIT
// What explain/ says of a trace, the viewer shows: it speaks of it by the same names.
#pragma once

namespace tetmend::explain {}

namespace tetmend::viewer {

using namespace explain;  // NOLINT: one vocabulary in two layers

}  // namespace tetmend::viewer
