// SPDX-License-Identifier: MIT
// The part of Lua's library that a script gets: repeatable, and never long without a watch. All are
// functions of Lua (schedule/lua_box.h).
#pragma once

#include <string_view>

#include <lua.hpp>

namespace tetmend {

/// Pushes a table of the functions and libraries by name. Each function charges its work to the
/// box (lua_state.h). None tells an address, asks a clock, or depends on the order in which Lua's
/// hashing happens to keep keys.
void push_library(lua_State* lua);

/// The text at an index; a number there becomes its text. Empty for anything else.
std::string_view text_at(lua_State* lua, int index);

/// Pushes what tostring() says: of tables and functions only what they are.
void push_text(lua_State* lua, int index);

/// Front of a word (LuaState::add_word) that takes its arguments as texts.
int call_with_texts(lua_State* lua);

/// Charges the work of reading the arguments of the function that runs.
void charge_arguments(lua_State* lua);

}  // namespace tetmend
