// SPDX-License-Identifier: MIT
// A function of numbers that a script makes.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include <tbb/enumerable_thread_specific.h>

#include "schedule/lua_state.h"

namespace tetmend {

/// Each thread calls it in an interpreter of its own, so several may at once. What the script keeps
/// between calls is of one thread, and must not be seen in a result.
class LuaFunction {
 public:
  /// @throws Error when the file cannot be read, or "FILE:LINE: reason" for a mistake in it
  LuaFunction(const std::filesystem::path& file, std::string function);

  /// Cost: see LuaState::call().
  /// @throws Error as that, and for a call that does not come to an end
  double operator()(std::span<const double> arguments) const;

 private:
  struct Interpreter;

  Interpreter& mine() const;

  std::string file_;
  std::string text_;
  std::string function_;
  mutable tbb::enumerable_thread_specific<std::shared_ptr<Interpreter>> interpreters_;
};

}  // namespace tetmend
