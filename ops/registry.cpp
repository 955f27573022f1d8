// SPDX-License-Identifier: MIT
#include "ops/registry.h"

#include <string>

#include "kernel/error.h"

namespace tetmend {

void Registry::add(const OperatorInfo& info) {
  for (const OperatorInfo* other : infos_) {
    if (other->name == info.name)
      throw Error("operator '" + std::string(info.name) + "' is registered twice");
  }
  infos_.push_back(&info);
}

const OperatorInfo& Registry::find(std::string_view name) const {
  std::string valid;
  for (const OperatorInfo* info : infos_) {
    if (info->name == name) return *info;
    valid += valid.empty() ? "" : ", ";
    valid += info->name;
  }
  throw Error("unknown operator '" + std::string(name) + "'; valid: " + valid);
}

std::unique_ptr<Operator> Registry::make(std::string_view name,
                                         const ParameterSettings& settings) const {
  const OperatorInfo& info = find(name);
  return info.make(ParameterValues(info.name, info.parameters, settings));
}

}  // namespace tetmend
