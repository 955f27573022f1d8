// SPDX-License-Identifier: MIT
#include "ops/plugin_abi.h"

#include <span>

#include <fmt/format.h>

#include "kernel/error.h"
#include "platform/platform.h"

namespace tetmend {

void throw_no_symbol(const std::filesystem::path& file, std::string_view symbol) {
  throw Error(
      fmt::format("{}: not a plugin of tetmend: it has no symbol {} (see "
                  "TETMEND_PLUGIN in ops/plugin.h)",
                  file.string(), symbol));
}

std::optional<PluginAbi> read_plugin_abi(const std::filesystem::path& file) {
  using platform::ConstantSearch;
  const auto facts = platform::look_at(file);
  if (!facts) return {};
  if (facts.value.kind != platform::FileKind::regular) {
    throw Error(fmt::format("{}: cannot be loaded as a plugin: not a regular file", file.string()));
  }
  PluginAbi abi{};
  switch (
      platform::read_constant(file, kPluginAbiSymbol, std::as_writable_bytes(std::span(&abi, 1)))) {
    case ConstantSearch::found:
      return abi;
    case ConstantSearch::absent:
      throw_no_symbol(file, kPluginAbiSymbol);
    case ConstantSearch::cut_off:
      throw Error(fmt::format("{}: cannot be loaded as a plugin: the end of the file is missing",
                              file.string()));
    case ConstantSearch::no_answer:
      break;
  }
  return {};
}

}  // namespace tetmend
