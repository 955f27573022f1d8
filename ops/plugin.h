// SPDX-License-Identifier: MIT
// Operators from elsewhere. A plugin is a shared library that registers operators. It needs one
// header, made of this one and all that it includes, and no library: the program that loads the
// plugin has the code.
//
//   #include <tetmend/plugin.h>
//   TETMEND_PLUGIN(registry) {
//     registry.add(my_operator_info());
//   }
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <vector>

#include <tetmend/api.h>

#include "kernel/shell.h"
#include "kernel/workspace.h"
#include "ops/describe.h"
#include "ops/registry.h"

namespace tetmend {

/// What a plugin was built against. Read before any code of the plugin is called, so its form never
/// changes.
struct TETMEND_API PluginAbi {
  std::uint32_t version;
  std::uint32_t layout;
  friend bool operator==(const PluginAbi&, const PluginAbi&) = default;
};

/// To be raised when plugins must be built again although no size has changed: when virtual
/// functions of Operator or TraceSink are added, removed or moved, or when members change places or
/// meaning.
inline constexpr std::uint32_t kPluginAbiVersion = 9;

/// Checksum of the sizes of all that host and plugin share: it differs between versions of tetmend
/// whose classes differ, and between standard libraries, also by their debugging modes.
constexpr std::uint32_t plugin_layout() {
  std::uint32_t sum = 2166136261u;
  for (const std::size_t size : {sizeof(void*),
                                 sizeof(std::size_t),
                                 sizeof(std::string),
                                 sizeof(std::vector<int>),
                                 sizeof(std::filesystem::path),
                                 sizeof(Point),
                                 sizeof(Standard),
                                 alignof(Point),
                                 sizeof(TetMesh),
                                 sizeof(SurfaceTriangle),
                                 sizeof(MeshData),
                                 sizeof(Workspace),
                                 sizeof(Transaction),
                                 sizeof(IndexSet),
                                 sizeof(Shell),
                                 sizeof(VertexMove),
                                 sizeof(Judge),
                                 sizeof(Comparison),
                                 sizeof(OperatorStates),
                                 sizeof(Replacement),
                                 sizeof(AttemptEvent),
                                 sizeof(OperatorContext),
                                 sizeof(OperatorInfo),
                                 sizeof(ParameterSpec),
                                 sizeof(ParameterValues),
                                 sizeof(Operator),
                                 sizeof(Registry)}) {
    sum = (sum ^ static_cast<std::uint32_t>(size)) * 16777619u;
  }
  return sum;
}

inline constexpr PluginAbi kPluginAbi = {kPluginAbiVersion, plugin_layout()};

/// A plugin that was loaded.
struct TETMEND_API Plugin {
  std::filesystem::path file;
  std::vector<const OperatorInfo*> operators;  ///< what it added, in its order
};

/// Loads a plugin and adds its operators, with `file` as their origin, to the registry: all of
/// them, or none if anything goes wrong. A library that was loaded stays until the program ends, so
/// that no operator and no exception can outlive its code. The program must have been linked with
/// tetmend_plugin_host (CMake).
/// @throws Error when the file is no shared library or no plugin, was built for another ABI, or
/// needs what this program does not have. Also when it throws, adds nothing, or adds a name that is
/// taken.
TETMEND_API Plugin load_plugin(const std::filesystem::path& file, Registry& registry);

}  // namespace tetmend

// The two symbols that load_plugin() looks for.
#define TETMEND_PLUGIN(registry)                                                                 \
  extern "C" __attribute__((visibility("default"))) const tetmend::PluginAbi tetmend_plugin_abi; \
  extern "C" const tetmend::PluginAbi tetmend_plugin_abi = tetmend::kPluginAbi;                  \
  extern "C" __attribute__((visibility("default"))) void tetmend_plugin_register(                \
      tetmend::Registry& registry)
