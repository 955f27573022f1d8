// SPDX-License-Identifier: MIT
// Needs a function that no program has.
#include <tetmend/plugin.h>

extern "C" void tetmend_function_that_is_nowhere();

TETMEND_PLUGIN(registry) {
  static_cast<void>(registry);
  tetmend_function_that_is_nowhere();
}
