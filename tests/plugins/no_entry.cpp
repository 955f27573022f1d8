// SPDX-License-Identifier: MIT
// The right ABI, but no function to register operators.
#include <tetmend/plugin.h>

extern "C" const tetmend::PluginAbi tetmend_plugin_abi;
extern "C" const tetmend::PluginAbi tetmend_plugin_abi = tetmend::kPluginAbi;
