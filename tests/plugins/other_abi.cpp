// SPDX-License-Identifier: MIT
// A plugin built against another tetmend, as TETMEND_TEST_VERSION and TETMEND_TEST_LAYOUT say,
// whose code must not run: neither its initialisers nor what it registers.
#include <cstdlib>

#include <tetmend/plugin.h>

extern "C" const tetmend::PluginAbi tetmend_plugin_abi;
extern "C" const tetmend::PluginAbi tetmend_plugin_abi = {
    tetmend::kPluginAbi.version + TETMEND_TEST_VERSION,
    tetmend::kPluginAbi.layout + TETMEND_TEST_LAYOUT};
// Nowhere defined: binding everything before the ABI is known would give the wrong message.
extern "C" void tetmend_function_of_another_version();

namespace {
struct Initialiser {
  Initialiser() { std::abort(); }
};
const Initialiser kInitialiser;
}  // namespace

extern "C" void tetmend_plugin_register(tetmend::Registry&) {
  tetmend_function_of_another_version();
  std::abort();
}
