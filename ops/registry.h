// SPDX-License-Identifier: MIT
// The operators that exist, by name. Passed down; there is no global registry.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "ops/operator.h"

namespace tetmend {

class Registry {
 public:
  /// @throws Error if an operator of that name is there. `info` must outlive the registry.
  void add(const OperatorInfo& info);

  /// In the order of registration.
  std::span<const OperatorInfo* const> operators() const { return infos_; }

  /// @throws Error for an unknown name, with the valid ones.
  const OperatorInfo& find(std::string_view name) const;

  /// @throws Error for an unknown operator or parameter, or a value out of range.
  std::unique_ptr<Operator> make(std::string_view name,
                                 const ParameterSettings& settings = {}) const;

 private:
  std::vector<const OperatorInfo*> infos_;
};

/// Adds the operators of tetmend itself.
void register_builtin_operators(Registry& registry);

}  // namespace tetmend
