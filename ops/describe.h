// SPDX-License-Identifier: MIT
// How a class becomes an operator of the registry.
#pragma once

#include "ops/operator.h"

namespace tetmend {

/// The description of an operator of the class `Op`, which is made from the values of its
/// parameters. What the views name must outlive it, as constants do.
/// @param at_surface see OperatorInfo
template <class Op>
constexpr OperatorInfo describe(std::string_view name, TargetKind target, std::string_view help,
                                std::span<const ParameterSpec> parameters = {},
                                bool at_surface = false) {
  return {name,
          target,
          help,
          parameters,
          [](const ParameterValues& values) -> std::unique_ptr<Operator> {
            return std::make_unique<Op>(values);
          },
          at_surface};
}

}  // namespace tetmend
