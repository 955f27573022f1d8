// SPDX-License-Identifier: MIT
// What a word of the language sees of the interpreter: the arguments of a call, room for results.
#pragma once

#include <cstddef>
#include <string_view>

struct lua_State;

namespace tetmend {

struct LuaBox;
struct ScriptValue;

/// One call of a word by a script. A word is work of C++ (schedule/lua_box.h): it may hold what it
/// likes and throw what it likes, and has nothing else of Lua, so that it cannot raise an error
/// there. What it gives is handed to the script when the word has ended.
class WordCall {
 public:
  /// For the box; words are given one.
  explicit WordCall(lua_State* lua);

  int argument_count() const;
  /// Argument i, from 1 on; Kind::nothing where there is none.
  /// @throws Error for functions, for keys that are neither names nor 1 to n, for tables too deep,
  /// and for more than the box holds; whatever the watch throws.
  ScriptValue argument(int i) const;
  /// Argument i where the interpreter has it, valid until the word ends; empty if it is no text.
  std::string_view text(int i) const;

  /// One more result.
  void give(ScriptValue value);

  /// Charges work, in units of an instruction. @throws whatever the watch throws.
  void charge_steps(std::size_t steps) const;
  /// Announces memory outside of the interpreter, until this word returns or for good. Bounded by
  /// Limits::outside. @throws Error
  void hold_in_call(std::size_t bytes) const;
  void hold_for_good(std::size_t bytes) const;

 private:
  lua_State* lua_;
  LuaBox& box_;
};

}  // namespace tetmend
