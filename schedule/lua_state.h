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

struct LuaBox;

/// Owns an interpreter with the language itself and the parts of its library that are safe and
/// repeatable. These are assert, error, ipairs, pairs (in the order of the keys), select, tonumber,
/// tostring, type, unpack, table, string (no patterns) and math (no random numbers). There is no
/// io, os, require, load, debug, coroutine, metatables, pcall or garbage collection.
///
/// What a function of C++ does for a script is charged by its size (charge_steps), so that the
/// watch is asked in the middle of a long sort as well.
///
/// Reading an unknown global name is an error that names the valid ones; words that were given to
/// the script cannot be overwritten.
///
/// The interpreter is compiled as C++: an exception of Lua unwinds C++ frames. No other exception
/// may leave a function that Lua calls; see add_word().
class LuaState {
 public:
  struct Limits {
    std::size_t memory = std::size_t{128} << 20;  ///< bytes of the interpreter
    std::size_t text = std::size_t{4} << 20;      ///< bytes of the longest text
    std::size_t outside = std::size_t{16} << 20;  ///< bytes that words hold for the script
  };
  /// Asked every thousand instructions, or earlier where they copy large blocks. Throws to stop
  /// the script; the exception comes out of run().
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
  /// @throws Error "NAME:LINE: reason" for a mistake in the script or its run, without control
  /// characters; whatever the watch or a word throws to stop; std::bad_alloc.
  void run(std::string_view text, const std::string& name);

  lua_State* get() const { return lua_.get(); }

 private:
  struct Close {
    void operator()(lua_State* lua) const;
  };

  std::unique_ptr<LuaBox> box_;
  std::unique_ptr<lua_State, Close> lua_;
};

// For functions that a script calls. Each takes the state of a LuaState and may raise an error of
// Lua, which is an exception: the frames between need no more than destructors.

/// Charges work, in units of an instruction. May ask the watch.
void charge_steps(lua_State* lua, std::size_t steps);

/// Counts bytes that the present word takes outside of the interpreter until it returns.
/// @throws Error when the script has too much there.
void hold_in_call(lua_State* lua, std::size_t bytes);
/// The same for what stays: notes, descriptions.
void hold_for_good(lua_State* lua, std::size_t bytes);

/// Thrown by a word or a watch to end a script that did nothing wrong.
struct ScriptStop {};

}  // namespace tetmend
