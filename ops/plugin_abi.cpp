// SPDX-License-Identifier: MIT
#include "ops/plugin_abi.h"

#include <span>

#include "platform/platform.h"

namespace tetmend {

std::optional<PluginAbi> read_plugin_abi(const std::filesystem::path& file) {
  PluginAbi abi{};
  if (!platform::read_constant(file, "tetmend_plugin_abi",
                               std::as_writable_bytes(std::span(&abi, 1))))
    return {};
  return abi;
}

}  // namespace tetmend
