// SPDX-License-Identifier: MIT
// Settings of operators: an Error of one line, or an operator that keeps its promises on a small
// mesh. The input is the number of a mesh and of an operator, then parameters by number and value.
#include "contract/trials.h"
#include "contract/zoo.h"
#include "fuzz/target.h"
#include "kernel/error.h"
#include "ops/registry.h"

using namespace tetmend;
using namespace tetmend::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Registry registry = Registry::builtin();
  static const auto meshes = contract::zoo();
  Bytes bytes(data, size);
  const auto& mesh = meshes[bytes.below(static_cast<unsigned>(meshes.size()))].data;
  const auto operators = registry.operators();
  const OperatorInfo& info = *operators[bytes.below(static_cast<unsigned>(operators.size()))];
  ParameterSettings settings;
  while (!bytes.empty()) {
    const unsigned which = bytes.below(static_cast<unsigned>(info.parameters.size()) + 1);
    const std::string name(which < info.parameters.size() ? info.parameters[which].name
                                                          : "nothing");
    settings.emplace_back(name, bytes.take<double>());
  }
  try {
    const auto made = registry.make(info.name, settings);
    const contract::Outcome outcome = contract::try_in_sweeps(*made, TetMesh(mesh), 1, 6);
    require(outcome.complaint.empty(), outcome.complaint);
  } catch (const Error& error) {
    require_one_line(error.what());
  }
  return 0;
}
