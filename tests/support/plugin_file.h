// SPDX-License-Identifier: MIT
// Plugins of the tests.
#pragma once

#include <string>

namespace tetmend::test {

/// What tests/plugins/NAME.cpp became.
inline std::string plugin_file(const std::string& name) {
  return std::string(TETMEND_TEST_PLUGINS) + "/" + name + ".so";
}

}  // namespace tetmend::test
