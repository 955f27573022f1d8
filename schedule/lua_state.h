// SPDX-License-Identifier: MIT
// A Lua interpreter in a box: no files, no processes, no clock, no chance; limited memory; can be
// stopped at any time.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include <lua.hpp>

namespace tetmend {

/// Owns an interpreter with the language itself and the parts of its library that are safe and
/// repeatable. These are assert, error, ipairs, pairs (in the order of the keys), select, tonumber,
/// tostring, type, unpack, table, string (no patterns) and math (no random numbers). There is no
/// io, os, require, load, debug, coroutine, metatables, pcall or garbage collection.
///
/// Reading an unknown global name is an error that names the valid ones; words that were given to
/// the script cannot be overwritten.
///
/// The interpreter is compiled as C++: an exception of Lua unwinds C++ frames. No other exception
/// may leave a function that Lua calls; see add_word().
class LuaState {
 public:
  struct Limits {
    std::size_t memory = std::size_t{128} << 20;  ///< bytes
  };
  /// Asked every thousand instructions. Throws to stop the script; the exception comes out of
  /// run().
  using Watch = std::function<void()>;
  using Function = std::function<int(lua_State*)>;

  explicit LuaState(Limits limits, Watch watch = {});
  LuaState() : LuaState(Limits{}) {}
  ~LuaState();
  LuaState(const LuaState&) = delete;
  LuaState& operator=(const LuaState&) = delete;

  /// Makes a function available by name. It may throw tetmend::Error, which becomes an error of the
  /// line that called it, and ScriptStop, which comes out of run() unchanged.
  void add_word(const std::string& name, Function function);

  /// Pushes such a function on the stack. It lives as long as this state.
  void push_function(Function function);

  /// Runs the text of a script. `name` is what errors call it.
  /// @throws Error "NAME:LINE: reason" for a mistake in the script or its run; whatever the watch
  /// or a word throws to stop.
  void run(std::string_view text, const std::string& name);

  lua_State* get() const { return lua_; }

 private:
  struct Box;

  std::unique_ptr<Box> box_;
  lua_State* lua_ = nullptr;
};

/// Thrown by a word or a watch to end a script that did nothing wrong.
struct ScriptStop {};

}  // namespace tetmend
