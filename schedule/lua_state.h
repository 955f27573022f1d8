// SPDX-License-Identifier: MIT
// A Lua interpreter in a box: no files, no processes, no clock, no chance; limited memory; can be
// stopped at any time.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include <lua.hpp>

#include "schedule/word_call.h"

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
/// Lua may be compiled as C++ or as C: see schedule/lua_box.h for what that asks of the code here.
class LuaState {
 public:
  struct Limits {
    std::size_t memory = std::size_t{128} << 20;  ///< bytes of the interpreter
    std::size_t text = std::size_t{4} << 20;      ///< bytes of the longest text
    std::size_t outside = std::size_t{64} << 20;  ///< bytes that words hold for the script
  };
  /// Asked every thousand instructions, or earlier where they copy large blocks. Throws to stop
  /// the script; the exception comes out of run().
  using Watch = std::function<void()>;
  /// Work of C++ that a script calls. May throw tetmend::Error, which becomes an error of the line
  /// that called it; anything else comes out of run() unchanged, ScriptStop above all.
  using Word = std::function<void(WordCall&)>;

  explicit LuaState(Limits limits, Watch watch = {});
  LuaState() : LuaState(Limits{}) {}
  ~LuaState();
  LuaState(const LuaState&) = delete;
  LuaState& operator=(const LuaState&) = delete;

  /// Makes a word available by name. If there is a `front`, the script calls that: a function of
  /// Lua, which has the word as its upvalue 1, for what only the interpreter can do.
  void add_word(const std::string& name, Word word, lua_CFunction front = nullptr);
  /// Makes a function of Lua available by name.
  void add_function(const std::string& name, lua_CFunction function);
  /// Makes a word the metamethod `event` of the tables that luaL_setmetatable(lua, table) marks.
  void add_metamethod(const char* table, const char* event, Word word, lua_CFunction front);

  /// Runs the text of a script. `name` is what errors call it.
  /// @throws Error "NAME:LINE: reason" for a mistake in the script or its run, without control
  /// characters; whatever the watch or a word throws to stop; std::bad_alloc.
  void run(std::string_view text, const std::string& name);
  /// Calls a function that the script which ran last has made, with numbers, for a number. Cost: about
  /// 0.2 microseconds and what the function does.
  /// @throws Error as run(), and where there is no such function or what it returns is no number
  double call(const std::string& function, std::span<const double> arguments);

 private:
  struct Close {
    void operator()(lua_State* lua) const;
  };

  /// What a function of Lua needs to add another one to a table.
  struct Addition;
  void add(Addition addition);
  static int add_to_table(lua_State* lua);
  /// Calls a function of Lua, outside of a script, with `what` as light userdata.
  /// @throws std::bad_alloc: only memory can be missing.
  void set_up(lua_CFunction function, void* what);
  /// What a function of Lua needs to call one of the script.
  struct NumberCall;
  static int call_with_numbers(lua_State* lua);
  /// What is on top of the stack, with so many arguments. @throws as run()
  void run_watched(int arguments);
  [[noreturn]] void throw_failure(int status);

  std::unique_ptr<LuaBox> box_;
  std::unique_ptr<lua_State, Close> lua_;
  std::string name_;  // of the script that ran last
};

/// Charges work, in units of an instruction. May ask the watch, and raise an error. For functions
/// of Lua; words have WordCall::charge_steps().
void charge_steps(lua_State* lua, std::size_t steps);

/// Thrown by a word or a watch to end a script that did nothing wrong.
struct ScriptStop {};

}  // namespace tetmend
