// SPDX-License-Identifier: MIT
//   compare the ABI in the file -> open -> compare it again -> make it stay -> let it register into a registry of its own -> add
//   that to the host's
#include "ops/plugin.h"

#include <new>
#include <string>

#include <fmt/format.h>

#include "kernel/error.h"
#include "ops/plugin_abi.h"
#include "platform/platform.h"

namespace tetmend {

namespace {

using platform::SharedLibrary;

/// What the dynamic linker has to say, without the name of the file in front.
std::string linker_message(const std::string& file) {
  std::string message = platform::loading_error();
  if (message.starts_with(file + ": ")) message.erase(0, file.size() + 2);
  return message;
}

void* find(const SharedLibrary& library, const std::string& file, const char* symbol) {
  void* found = library.find(symbol);
  if (found == nullptr) throw_no_symbol(file, symbol);
  return found;
}

void check_abi(const PluginAbi& abi, const std::string& file) {
  if (abi == kPluginAbi) return;
  throw Error(
      fmt::format("{}: built for plugin ABI {}, layout {:08x}; this is ABI {}, layout "
                  "{:08x}: build the plugin with the headers of this tetmend",
                  file, abi.version, abi.layout, kPluginAbi.version, kPluginAbi.layout));
}

/// Its initialisers run when it is opened, so what the file says of its ABI is looked at before.
SharedLibrary open(const std::string& file) {
  if (const auto abi = read_plugin_abi(file)) check_abi(*abi, file);
  SharedLibrary library(file);
  if (!library.is_open()) {
    throw Error(fmt::format("{}: cannot be loaded as a plugin: {}", file, linker_message(file)));
  }
  check_abi(*static_cast<const PluginAbi*>(find(library, file, kPluginAbiSymbol)), file);
  return library;
}

}  // namespace

Plugin load_plugin(const std::filesystem::path& path, Registry& registry) {
  // Absolute, for a bare name would be searched for in the folders of the system.
  const std::string file = std::filesystem::absolute(path).string();
  const SharedLibrary library = open(file);
  const auto enter =
      reinterpret_cast<void (*)(Registry&)>(find(library, file, "tetmend_plugin_register"));
  library.pin();

  try {
    Registry own;
    enter(own);
    Plugin plugin{path, {own.operators().begin(), own.operators().end()}};
    if (plugin.operators.empty() && own.measures().empty()) {
      throw Error("it registers no operator");
    }
    Registry extended = registry;
    for (const Standard& measure : own.measures()) extended.add_measure(measure);
    for (const OperatorInfo* info : plugin.operators) extended.add(*info, path.string());
    registry = std::move(extended);
    return plugin;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(fmt::format("{}: {}", file, error.what()));
  } catch (...) {
    throw Error(fmt::format("{}: registering failed by an exception of an unknown type", file));
  }
}

}  // namespace tetmend
