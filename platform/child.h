// SPDX-License-Identifier: MIT
// Other programs, started without a shell.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "platform/platform.h"

namespace tetmend::platform {

/// Another program, found as a shell finds it, but started without one. It reads what write() gives;
/// what it prints is dropped, what it complains of is kept.
class Child {
 public:
  /// @param arguments the first is the name of the program
  explicit Child(const std::vector<std::string>& arguments);
  ~Child() { wait(); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Why it could not be started: the error number, or 0.
  int error() const { return error_; }
  /// All of it. The error number, EPIPE when it reads no more, or 0.
  int write(std::string_view bytes) noexcept;
  /// Ends its input and waits for its end. Its exit status, which is not 0 either when a signal ended
  /// it or when it could not be started.
  int wait() noexcept;
  /// The first of its complaints, 64 kB at most.
  std::string complaint() const;

 private:
  int error_ = 0;
  std::intptr_t process_ = 0;  // 0: none, or it has ended
  int status_ = 1;
  Descriptor input_, complaints_;
};

}  // namespace tetmend::platform
