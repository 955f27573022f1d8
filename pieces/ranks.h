// SPDX-License-Identifier: MIT
// Who works on a mesh together: processes that each hold some of its pieces.
#pragma once

#include <tetmend/distributed.h>

namespace tetmend::pieces {

using tetmend::OneRank;
using tetmend::Ranks;

}  // namespace tetmend::pieces
