// SPDX-License-Identifier: MIT
#include "schedule/lua_state.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <deque>
#include <exception>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/error.h"

namespace tetmend {

/// All that the callbacks of the interpreter need.
struct LuaState::Box {
  struct Word {
    Function function;
    Box* box;
  };

  std::size_t limit = 0;
  std::size_t used = 0;
  Watch watch;
  std::deque<Word> words;      // addresses must stay
  std::exception_ptr pending;  // to come out of run()
};

namespace {

constexpr int kInstructionsBetweenWatches = 1000;
constexpr const char* kBox = "tetmend box";
constexpr const char* kWords = "tetmend words";

/// An error of the line that runs at `level`. Does not return.
int fail(lua_State* lua, const std::string& message, int level = 1) {
  luaL_where(lua, level);
  lua_pushlstring(lua, message.data(), message.size());
  lua_concat(lua, 2);
  return lua_error(lua);
}

// ---- The library: what is safe and the same on every run ----------------------------------------

/// A key by which a script may walk a table.
struct Key {
  int type = LUA_TNIL;
  double number = 0;
  std::string text;
  int place = 0;  // in the list of keys

  friend bool operator<(const Key& x, const Key& y) {
    if (x.type != y.type) return x.type < y.type;
    return x.type == LUA_TSTRING ? x.text < y.text : x.number < y.number;
  }
};

int next_pair(lua_State* lua) {
  // upvalues: keys in order, how many of them are done, table
  const lua_Integer i = lua_tointeger(lua, lua_upvalueindex(2)) + 1;
  lua_pushinteger(lua, i);
  lua_replace(lua, lua_upvalueindex(2));
  if (lua_rawgeti(lua, lua_upvalueindex(1), i) == LUA_TNIL) return 1;
  lua_pushvalue(lua, -1);
  lua_rawget(lua, lua_upvalueindex(3));
  return 2;
}

/// pairs(): the built-in order changes from run to run.
int pairs_in_order(lua_State* lua) {
  luaL_checktype(lua, 1, LUA_TTABLE);
  lua_settop(lua, 1);
  lua_newtable(lua);  // keys as they come
  std::vector<Key> keys;
  lua_pushnil(lua);
  while (lua_next(lua, 1) != 0) {
    lua_pop(lua, 1);
    Key key;
    key.type = lua_type(lua, -1);
    if (key.type == LUA_TSTRING) {
      key.text = lua_tostring(lua, -1);
    } else if (key.type == LUA_TBOOLEAN) {
      key.number = lua_toboolean(lua, -1);
    } else if (key.type == LUA_TNUMBER) {
      key.number = lua_tonumber(lua, -1);
    } else {
      return fail(lua, "pairs: keys must be numbers, strings or booleans");
    }
    key.place = static_cast<int>(keys.size()) + 1;
    lua_pushvalue(lua, -1);
    lua_rawseti(lua, 2, key.place);
    keys.push_back(std::move(key));
  }
  std::sort(keys.begin(), keys.end());
  lua_createtable(lua, static_cast<int>(keys.size()), 0);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    lua_rawgeti(lua, 2, keys[i].place);
    lua_rawseti(lua, 3, static_cast<lua_Integer>(i) + 1);
  }
  lua_pushinteger(lua, 0);
  lua_pushvalue(lua, 1);
  lua_pushcclosure(lua, next_pair, 3);
  return 1;
}

/// tostring() without addresses, which change from run to run.
int to_text(lua_State* lua) {
  luaL_checkany(lua, 1);
  const int type = lua_type(lua, 1);
  if (type == LUA_TTABLE || type == LUA_TFUNCTION || type == LUA_TUSERDATA) {
    lua_pushstring(lua, lua_typename(lua, type));
  } else {
    luaL_tolstring(lua, 1, nullptr);
  }
  return 1;
}

int unknown_global(lua_State* lua) {
  lua_getfield(lua, LUA_REGISTRYINDEX, kWords);
  lua_pushvalue(lua, 2);
  if (lua_rawget(lua, -2) != LUA_TNIL) return 1;
  const std::string name = lua_type(lua, 2) == LUA_TSTRING ? lua_tostring(lua, 2) : "?";
  std::set<std::string> valid;
  for (const int table : {3, 1}) {  // words, and what the script made itself
    lua_pushnil(lua);
    while (lua_next(lua, table) != 0) {
      lua_pop(lua, 1);
      if (lua_type(lua, -1) == LUA_TSTRING) valid.insert(lua_tostring(lua, -1));
    }
  }
  return fail(lua, fmt::format("unknown name '{}'; valid: {}", name, fmt::join(valid, ", ")));
}

int new_global(lua_State* lua) {
  lua_getfield(lua, LUA_REGISTRYINDEX, kWords);
  lua_pushvalue(lua, 2);
  if (lua_rawget(lua, -2) != LUA_TNIL) {
    const char* name = lua_tostring(lua, 2);
    return fail(lua, fmt::format("'{}' is a word of the language and cannot be set",
                                 name != nullptr ? name : "?"));
  }
  lua_settop(lua, 3);
  lua_rawset(lua, 1);
  return 0;
}

/// Leaves in the table on top only the named fields. What is left out runs for a time that nobody
/// can interrupt, differs from run to run, or reaches outside.
void keep_fields(lua_State* lua, const std::vector<std::string>& names) {
  lua_newtable(lua);
  for (const std::string& name : names) {
    lua_getfield(lua, -2, name.c_str());
    lua_setfield(lua, -2, name.c_str());
  }
}

void drop_fields(lua_State* lua, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    lua_pushnil(lua);
    lua_setfield(lua, -2, name.c_str());
  }
}

void open_library(lua_State* lua) {
  lua_newtable(lua);  // words
  const auto take_over = [&](const char* name) { lua_setfield(lua, -2, name); };
  luaL_requiref(lua, "_G", luaopen_base, 0);
  for (const char* name : {"assert", "error", "ipairs", "select", "tonumber", "type"}) {
    lua_getfield(lua, -1, name);
    lua_setfield(lua, -3, name);
  }
  lua_pop(lua, 1);
  lua_pushcfunction(lua, pairs_in_order);
  take_over("pairs");
  lua_pushcfunction(lua, to_text);
  take_over("tostring");

  luaL_requiref(lua, "table", luaopen_table, 0);
  keep_fields(lua, {"concat", "insert", "pack", "remove", "sort", "unpack"});
  lua_remove(lua, -2);
  take_over("table");
  luaL_requiref(lua, "math", luaopen_math, 0);
  drop_fields(lua, {"random", "randomseed"});
  take_over("math");
  // Strings find their methods in this very table.
  luaL_requiref(lua, "string", luaopen_string, 0);
  drop_fields(lua, {"dump", "find", "gmatch", "gsub", "match", "pack", "packsize", "rep", "unpack",
                    "reverse"});
  take_over("string");
  lua_setfield(lua, LUA_REGISTRYINDEX, kWords);

  // A fresh table of globals: it holds what the script makes.
  lua_newtable(lua);
  lua_newtable(lua);
  lua_pushcfunction(lua, unknown_global);
  lua_setfield(lua, -2, "__index");
  lua_pushcfunction(lua, new_global);
  lua_setfield(lua, -2, "__newindex");
  lua_setmetatable(lua, -2);
  lua_rawseti(lua, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
}

}  // namespace

// ---- Callbacks ----------------------------------------------------------------------------------

namespace {

template <class BoxType>
void* allocate(void* data, void* block, std::size_t old_size, std::size_t size) {
  BoxType& box = *static_cast<BoxType*>(data);
  const std::size_t held = block != nullptr ? old_size : 0;
  if (size == 0) {
    std::free(block);
    box.used -= held;
    return nullptr;
  }
  if (size > held && size - held > box.limit - std::min(box.limit, box.used)) return nullptr;
  void* moved = std::realloc(block, size);
  if (moved != nullptr) box.used = box.used - held + size;
  return moved;
}

/// Runs what may throw in a frame that Lua called.
template <class BoxType, class Work>
int guarded(lua_State* lua, BoxType& box, int level, const Work& work) {
  std::string message;
  try {
    return work();
  } catch (const Error& error) {
    message = error.what();
  } catch (const ScriptStop&) {
    box.pending = std::current_exception();
  } catch (const std::exception&) {
    box.pending = std::current_exception();
  }
  return fail(lua, message, level);
}

template <class BoxType>
void on_count(lua_State* lua, lua_Debug*) {
  lua_getfield(lua, LUA_REGISTRYINDEX, kBox);
  BoxType& box = *static_cast<BoxType*>(lua_touserdata(lua, -1));
  lua_pop(lua, 1);
  guarded(lua, box, 0, [&] {
    // Before the limit itself is met, which no line could be blamed for.
    if (box.used > box.limit - box.limit / 4) {
      throw Error(
          fmt::format("the script holds more than {} MB", (box.limit - box.limit / 4) >> 20));
    }
    if (box.watch) box.watch();
    return 0;
  });
}

template <class WordType>
int call_word(lua_State* lua) {
  auto& word = *static_cast<WordType*>(lua_touserdata(lua, lua_upvalueindex(1)));
  return guarded(lua, *word.box, 1, [&] { return word.function(lua); });
}

}  // namespace

LuaState::LuaState(Limits limits, Watch watch) : box_(std::make_unique<Box>()) {
  box_->limit = limits.memory;
  box_->watch = std::move(watch);
  lua_ = lua_newstate(allocate<Box>, box_.get());
  if (lua_ == nullptr) throw std::bad_alloc();
  open_library(lua_);
  lua_pushlightuserdata(lua_, box_.get());
  lua_setfield(lua_, LUA_REGISTRYINDEX, kBox);
}

LuaState::~LuaState() {
  lua_close(lua_);
}

void LuaState::push_function(Function function) {
  Box::Word& word = box_->words.emplace_back(Box::Word{std::move(function), box_.get()});
  lua_pushlightuserdata(lua_, &word);
  lua_pushcclosure(lua_, call_word<Box::Word>, 1);
}

void LuaState::add_word(const std::string& name, Function function) {
  lua_getfield(lua_, LUA_REGISTRYINDEX, kWords);
  push_function(std::move(function));
  lua_setfield(lua_, -2, name.c_str());
  lua_pop(lua_, 1);
}

void LuaState::run(std::string_view text, const std::string& name) {
  box_->pending = nullptr;
  const std::string chunk = "@" + name;
  int status = luaL_loadbufferx(lua_, text.data(), text.size(), chunk.c_str(), "t");
  if (status == LUA_OK) {
    lua_sethook(lua_, on_count<Box>, LUA_MASKCOUNT, kInstructionsBetweenWatches);
    status = lua_pcall(lua_, 0, 0, 0);
    lua_sethook(lua_, nullptr, 0, 0);
  }
  if (box_->pending) {
    lua_settop(lua_, 0);
    std::rethrow_exception(std::exchange(box_->pending, nullptr));
  }
  if (status == LUA_OK) return;
  std::string message;
  if (status == LUA_ERRMEM) {
    message = fmt::format("{}: the script needs more than {} MB", name, box_->limit >> 20);
  } else if (lua_type(lua_, -1) == LUA_TSTRING) {
    message = lua_tostring(lua_, -1);
  } else {
    message = fmt::format("{}: error({}) was called", name, luaL_typename(lua_, -1));
  }
  lua_settop(lua_, 0);
  throw Error(message);
}

}  // namespace tetmend
