// SPDX-License-Identifier: MIT
// Registers nothing.
#include <tetmend/plugin.h>

TETMEND_PLUGIN(registry) {
  static_cast<void>(registry);
}
