// SPDX-License-Identifier: MIT
// Is a file that is to be opened a trace, or no mesh, either?
#pragma once

#include "trace/no_mesh.h"

namespace tetmend::viewer {

using tetmend::is_trace;
using tetmend::refuse_what_is_no_mesh;

}  // namespace tetmend::viewer
