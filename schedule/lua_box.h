// SPDX-License-Identifier: MIT
// What the callbacks of the interpreter share. For the files of the box alone: lua_state.cpp,
// word_call.cpp.
//
// Lua may be compiled as C++ or as C. As C it raises an error by a jump, which passes over frames
// of C++ without destroying what they hold, and no exception may pass through its own frames. So
// there are two kinds of functions, and each keeps to its side:
//
//   work of C++          holds objects, throws; calls nothing of Lua that can raise an error: reads
//                        the stack, walks through tables, no more
//   function of Lua      may raise errors; holds no object with a destructor, throws nothing
//
// From a function of Lua one gets to work of C++ by is_done() alone: when that returns, every
// object of the work is gone, and what it threw lies in the box for raise(). Results lie there,
// too, until they are pushed.
#pragma once

#include <algorithm>
#include <deque>
#include <exception>
#include <string>
#include <vector>

#include <lua.hpp>

#include "kernel/error.h"
#include "schedule/lua_state.h"
#include "schedule/script_value.h"

namespace tetmend {

/// The state has its address in its extra space.
struct LuaBox {
  static constexpr std::size_t kStepsBetweenWatches = 1000;
  static constexpr std::size_t kUsualBlock = std::size_t{64} << 10;

  LuaState::Limits limits;
  LuaState::Watch watch;
  std::deque<LuaState::Word> words;  // addresses must stay
  std::vector<ScriptValue> results;  // of the word that ended last
  std::exception_ptr thrown;         // by work of C++; holds `message`
  const char* message = "";          // for the script, if there is one
  std::exception_ptr pending;        // to come out of run()
  std::string start_of_messages;     // of Lua, when it knows the line
  lua_State* running = nullptr;      // null: nothing to be watched

  std::size_t used = 0;       // bytes of the interpreter
  std::size_t kept = 0;       // bytes that words keep outside
  std::size_t in_call = 0;    // bytes that the present word needs outside
  std::size_t steps = 0;      // charged since the last watch
  std::size_t new_bytes = 0;  // since the last watch
  std::size_t largest_block = kUsualBlock;
  bool hook_is_near = false;
  bool has_long_text = false;

  std::size_t enough_memory() const { return limits.memory - limits.memory / 4; }
  /// An instruction may copy or compare a whole block.
  int instructions_between_watches() const {
    const std::size_t n = kStepsBetweenWatches * kUsualBlock / largest_block;
    return static_cast<int>(std::max<std::size_t>(n, 1));
  }

  // Work of C++.

  /// @throws Error, or whatever the watch throws, if the script must not go on.
  void look();
  /// Charges work, in units of an instruction. @throws as look().
  void charge(std::size_t steps);
  /// @throws Error when words hold too much.
  void check_outside() const;
};

inline LuaBox& box_of(lua_State* lua) {
  return **static_cast<LuaBox**>(lua_getextraspace(lua));
}

/// Does work of C++ in a function of Lua. False if it threw: then raise().
template <class Work>
bool is_done(LuaBox& box, const Work& work) noexcept {
  try {
    work();
    return true;
  } catch (const Error& error) {
    box.thrown = std::current_exception();
    box.message = error.what();
  } catch (...) {
    box.pending = box.thrown = std::current_exception();
    box.message = "";
  }
  return false;
}

/// Raises what was thrown, as an error of the line that runs at `level`. Does not return. A
/// function of Lua.
int raise(lua_State* lua, int level);

/// Pushes the results of a word and says how many they are. A function of Lua.
int push_results(lua_State* lua, const std::vector<ScriptValue>& results);

}  // namespace tetmend
