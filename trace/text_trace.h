// SPDX-License-Identifier: MIT
// A trace as indented text: for tests and for a look at tiny runs.
#pragma once

#include <string>

#include "trace/trace_sink.h"

namespace tetmend {

/// Appends one line when an attempt begins and one when it ends, indented by nesting.
class TextTrace final : public TraceSink {
 public:
  const std::string& text() const { return text_; }
  void attempt_begins(const AttemptEvent& event) override;
  void attempt_ends(Verdict verdict, std::span<const Quality> before,
                    std::span<const Quality> now) override;

 private:
  std::string text_;
  unsigned depth_ = 0;
};

}  // namespace tetmend
