// SPDX-License-Identifier: MIT
// Who stands around the attempts of a run and looks at them.
#pragma once

#include "ops/operator.h"

namespace tetmend {

class AttemptInspector {
 public:
  virtual ~AttemptInspector() = default;
  /// Makes the attempt. @throws Error as Operator::attempt(), and for what the inspector finds.
  virtual Verdict attempt(const Operator& op, OperatorContext& context, Target target) = 0;
};

}  // namespace tetmend
