// SPDX-License-Identifier: MIT
// Memory that fails once, at a chosen allocation of any thread: replaces operator new of the whole
// program.
#pragma once

namespace tetmend::test {

/// While it lives, the n-th `operator new` of the program, counted from 1, fails. One at a time.
class FailingMemory {
 public:
  explicit FailingMemory(long n);
  ~FailingMemory();
  FailingMemory(const FailingMemory&) = delete;
  FailingMemory& operator=(const FailingMemory&) = delete;

  /// There were n allocations since it was made.
  bool has_failed() const;
};

}  // namespace tetmend::test
