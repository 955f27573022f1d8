// SPDX-License-Identifier: MIT
// Registers nothing.
#include "ops/plugin.h"

TETMEND_PLUGIN(registry) {
  static_cast<void>(registry);
}
