// SPDX-License-Identifier: MIT
// What judges ask of every change that is to stay, whatever their promise is.
#pragma once

#include "kernel/judge.h"

namespace tetmend {

/// The new tets keep the bounds of the mesh, its most tets, lengths, curved edges, stable step and mean.
/// For who judges by the whole of an edit after Judge::opening(), which does not ask for that.
/// @param qualities those of the transaction
TETMEND_API bool keeps_limits(const Transaction& transaction, Comparison& qualities);

}  // namespace tetmend
