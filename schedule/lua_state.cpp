// SPDX-License-Identifier: MIT
#include "schedule/lua_state.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iterator>
#include <new>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/error.h"
#include "kernel/nearest_word.h"
#include "kernel/printable.h"
#include "schedule/lua_box.h"
#include "schedule/lua_library.h"

namespace tetmend {

namespace {

constexpr std::size_t kBytesBetweenWatches = std::size_t{4} << 20;
constexpr std::size_t kLongestMessage = 4000;
constexpr std::size_t kLongestName = 100;
constexpr std::size_t kMostNames = 200;
constexpr const char* kWordsKey = "tetmend words";

}  // namespace

// ---- Work of C++ ---------------------------------------------------------------------------------

void LuaBox::look() {
  new_bytes = 0;
  // Before the limit itself is met, which no line could be blamed for.
  if (used > enough_memory()) {
    throw Error(fmt::format("the script holds more than {} MB", enough_memory() >> 20));
  }
  // Comparing or reading it would be one step for Lua, however long.
  if (has_long_text) throw Error(fmt::format("a text is longer than {} MB", limits.text >> 20));
  if (watch) watch();
}

void LuaBox::charge(std::size_t new_steps) {
  steps += new_steps;
  while (running != nullptr && steps >= kStepsBetweenWatches) {
    steps -= kStepsBetweenWatches;
    look();
  }
}

void LuaBox::check_outside() const {
  if (kept + in_call <= limits.outside) return;
  throw Error(
      fmt::format("arguments, notes, descriptions and records of passes take more than {} MB",
                  limits.outside >> 20));
}

namespace {

/// The words in the table at 3 and what the script made itself in that at 1, for the name at 2.
[[noreturn]] void refuse_global(lua_State* lua) {
  std::set<std::string_view> valid;  // of Lua: they stay for as long as the tables
  for (const int table : {3, 1}) {
    lua_pushnil(lua);
    while (lua_next(lua, table) != 0) {
      lua_pop(lua, 1);
      box_of(lua).charge(1);
      if (lua_type(lua, -1) != LUA_TSTRING || lua_rawlen(lua, -1) > kLongestName) continue;
      valid.insert(lua_tostring(lua, -1));
      if (valid.size() > kMostNames) valid.erase(std::prev(valid.end()));
    }
  }
  const char* name = lua_type(lua, 2) == LUA_TSTRING ? lua_tostring(lua, 2) : "?";
  const std::string names = fmt::format("{}", fmt::join(valid, ", "));
  throw Error(fmt::format("unknown name '{}'; valid: {}{}", printable(name, kLongestName), names,
                          guess_of(name, names)));
}

}  // namespace

// ---- Functions of Lua ----------------------------------------------------------------------------

int raise(lua_State* lua, int level) {
  luaL_where(lua, level);
  lua_pushstring(lua, box_of(lua).message);
  lua_concat(lua, 2);
  return lua_error(lua);
}

void charge_steps(lua_State* lua, std::size_t steps) {
  LuaBox& box = box_of(lua);
  if (!is_done(box, [&box, steps] { box.charge(steps); })) raise(lua, 1);
}

namespace {

int unknown_global(lua_State* lua) {
  lua_getfield(lua, LUA_REGISTRYINDEX, kWordsKey);
  lua_pushvalue(lua, 2);
  if (lua_rawget(lua, -2) != LUA_TNIL) return 1;
  is_done(box_of(lua), [lua] { refuse_global(lua); });
  return raise(lua, 1);
}

int new_global(lua_State* lua) {
  lua_getfield(lua, LUA_REGISTRYINDEX, kWordsKey);
  lua_pushvalue(lua, 2);
  if (lua_rawget(lua, -2) != LUA_TNIL) {
    return luaL_error(lua, "'%s' is a word of the language and cannot be set",
                      lua_type(lua, 2) == LUA_TSTRING ? lua_tostring(lua, 2) : "?");
  }
  lua_settop(lua, 3);
  lua_rawset(lua, 1);
  return 0;
}

/// A fresh table of globals: it holds what the script makes.
void make_globals(lua_State* lua) {
  lua_newtable(lua);
  lua_newtable(lua);
  lua_pushcfunction(lua, unknown_global);
  lua_setfield(lua, -2, "__index");
  lua_pushcfunction(lua, new_global);
  lua_setfield(lua, -2, "__newindex");
  lua_setmetatable(lua, -2);
  lua_rawseti(lua, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
}

void on_count(lua_State* lua, lua_Debug*) {
  LuaBox& box = box_of(lua);
  if (box.hook_is_near) {  // costs a walk through all calls
    box.hook_is_near = false;
    lua_sethook(lua, on_count, LUA_MASKCOUNT, box.instructions_between_watches());
  }
  if (!is_done(box, [&box] { box.look(); })) raise(lua, 0);
}

/// Brings the next watch forward when an instruction takes much memory, and so time. Lua allows
/// lua_sethook() at any moment.
void note_block(LuaBox& box, std::size_t size) {
  box.new_bytes += size;
  const bool is_largest = size > box.largest_block;
  if (is_largest) box.largest_block = size;
  const bool must_look = is_largest || box.has_long_text || box.new_bytes > kBytesBetweenWatches ||
                         box.used > box.enough_memory();
  if (!must_look || box.running == nullptr || box.hook_is_near) return;
  box.hook_is_near = true;
  lua_sethook(box.running, on_count, LUA_MASKCOUNT, 1);
}

void* allocate(void* data, void* block, std::size_t old_size, std::size_t size) {
  LuaBox& box = *static_cast<LuaBox*>(data);
  const std::size_t held = block != nullptr ? old_size : 0;
  if (size == 0) {
    std::free(block);
    box.used -= held;
    return nullptr;
  }
  const std::size_t limit = box.limits.memory;
  if (size > held && size - held > limit - std::min(limit, box.used)) return nullptr;
  void* moved = std::realloc(block, size);
  if (moved == nullptr) return nullptr;
  box.used = box.used - held + size;
  // Without a block, the old size says what it is for.
  if (block == nullptr && old_size == LUA_TSTRING && size > box.limits.text) {
    box.has_long_text = true;
  }
  if (size > held) note_block(box, size);
  return moved;
}

int call_word(lua_State* lua) {
  const auto* word = static_cast<const LuaState::Word*>(lua_touserdata(lua, lua_upvalueindex(1)));
  charge_arguments(lua);
  LuaBox& box = box_of(lua);
  box.in_call = 0;
  box.results.clear();
  const auto work = [lua, word] {
    WordCall call(lua);
    (*word)(call);
  };
  if (!is_done(box, work)) return raise(lua, 1);
  return push_results(lua, box.results);
}

/// Adds file and line to messages from within functions of C++, for which Lua has none.
int add_place(lua_State* lua) {
  const bool has_place =
      lua_type(lua, 1) != LUA_TSTRING || text_at(lua, 1).starts_with(box_of(lua).start_of_messages);
  if (has_place) return 1;
  lua_Debug caller;
  for (int level = 1; lua_getstack(lua, level, &caller) != 0; ++level) {
    lua_getinfo(lua, "l", &caller);
    if (caller.currentline <= 0) continue;
    luaL_where(lua, level);
    lua_insert(lua, 1);
    lua_concat(lua, 2);
    return 1;
  }
  return 1;
}

/// Words, and a table of globals without any: it will hold what the script makes.
int make_names(lua_State* lua) {
  push_library(lua);
  lua_setfield(lua, LUA_REGISTRYINDEX, kWordsKey);
  make_globals(lua);
  return 0;
}

}  // namespace

// ---- The box ------------------------------------------------------------------------------------

namespace {

/// Watches the script for as long as it runs.
class Watching {
 public:
  Watching(lua_State* lua, LuaBox& box) : lua_(lua), box_(box) {
    box_.running = lua_;
    box_.hook_is_near = false;
    lua_sethook(lua_, on_count, LUA_MASKCOUNT, box_.instructions_between_watches());
  }
  ~Watching() {
    box_.running = nullptr;
    lua_sethook(lua_, nullptr, 0, 0);
  }
  Watching(const Watching&) = delete;
  Watching& operator=(const Watching&) = delete;

 private:
  lua_State* lua_;
  LuaBox& box_;
};

/// How messages of Lua begin: it shortens long names of files.
std::string name_in_messages(const std::string& name) {
  constexpr std::size_t kLongest = LUA_IDSIZE - 1;
  constexpr std::size_t kKept = LUA_IDSIZE - 4;
  return name.size() <= kLongest ? name : "..." + name.substr(name.size() - kKept);
}

/// What went wrong, from the value on top of the stack.
std::string message_of(lua_State* lua, const std::string& name) {
  if (lua_type(lua, -1) != LUA_TSTRING) {
    return fmt::format("{}: error({}) was called", name, luaL_typename(lua, -1));
  }
  const std::string message = printable(text_at(lua, -1), kLongestMessage);
  const bool has_file = text_at(lua, -1).starts_with(box_of(lua).start_of_messages);
  return has_file ? message : fmt::format("{}: {}", name, message);
}

}  // namespace

LuaState::LuaState(Limits limits, Watch watch) : box_(std::make_unique<LuaBox>()) {
  box_->limits = limits;
  box_->watch = std::move(watch);
  lua_.reset(lua_newstate(allocate, box_.get()));
  if (lua_ == nullptr) throw std::bad_alloc();
  *static_cast<LuaBox**>(lua_getextraspace(lua_.get())) = box_.get();
  set_up(make_names, nullptr);
}

LuaState::~LuaState() = default;

void LuaState::Close::operator()(lua_State* lua) const {
  lua_close(lua);
}

void LuaState::set_up(lua_CFunction function, void* what) {
  lua_pushcfunction(lua_.get(), function);
  lua_pushlightuserdata(lua_.get(), what);
  const int status = lua_pcall(lua_.get(), 1, 0, 0);
  lua_settop(lua_.get(), 0);
  if (status != LUA_OK) throw std::bad_alloc();
}

struct LuaState::Addition {
  const char* table;  // in the registry
  const char* name;
  Word* word;  // null: none
  lua_CFunction front;
};

int LuaState::add_to_table(lua_State* lua) {
  const Addition& addition = *static_cast<const Addition*>(lua_touserdata(lua, 1));
  luaL_newmetatable(lua, addition.table);  // or the table that is there
  if (addition.word != nullptr) {
    lua_pushlightuserdata(lua, addition.word);
    lua_pushcclosure(lua, call_word, 1);
  }
  if (addition.front != nullptr) {
    lua_pushcclosure(lua, addition.front, addition.word != nullptr ? 1 : 0);
  }
  lua_setfield(lua, -2, addition.name);
  return 0;
}

void LuaState::add(Addition addition) {
  set_up(add_to_table, &addition);
}

void LuaState::add_word(const std::string& name, Word word, lua_CFunction front) {
  add({kWordsKey, name.c_str(), &box_->words.emplace_back(std::move(word)), front});
}

void LuaState::add_function(const std::string& name, lua_CFunction function) {
  add({kWordsKey, name.c_str(), nullptr, function});
}

void LuaState::add_metamethod(const char* table, const char* event, Word word,
                              lua_CFunction front) {
  add({table, event, &box_->words.emplace_back(std::move(word)), front});
}

struct LuaState::NumberCall {
  const char* function;
  std::span<const double> arguments;
  double result = 0;
};

int LuaState::call_with_numbers(lua_State* lua) {
  auto& call = *static_cast<NumberCall*>(lua_touserdata(lua, 1));
  const auto count = static_cast<int>(call.arguments.size());
  luaL_checkstack(lua, count + 3, nullptr);
  lua_rawgeti(lua, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
  lua_pushstring(lua, call.function);
  lua_rawget(lua, -2);
  if (!lua_isfunction(lua, -1)) {
    return luaL_error(lua, "the script has no function %s", call.function);
  }
  for (const double argument : call.arguments) lua_pushnumber(lua, argument);
  lua_call(lua, count, 1);
  if (lua_type(lua, -1) != LUA_TNUMBER) {
    return luaL_error(lua, "%s returns a %s, but a number is wanted", call.function,
                      luaL_typename(lua, -1));
  }
  call.result = lua_tonumber(lua, -1);
  return 0;
}

double LuaState::call(const std::string& function, std::span<const double> arguments) {
  lua_State* lua = lua_.get();
  NumberCall call{function.c_str(), arguments};
  lua_pushcfunction(lua, add_place);
  lua_pushcfunction(lua, call_with_numbers);
  lua_pushlightuserdata(lua, &call);
  run_watched(1);
  return call.result;
}

void LuaState::run(std::string_view text, const std::string& name) {
  lua_State* lua = lua_.get();
  name_ = name;
  box_->start_of_messages = name_in_messages(name) + ":";
  lua_pushcfunction(lua, add_place);
  const std::string chunk = "@" + name;
  const int status = luaL_loadbufferx(lua, text.data(), text.size(), chunk.c_str(), "t");
  if (status != LUA_OK) throw_failure(status);
  run_watched(0);
}

void LuaState::run_watched(int arguments) {
  lua_State* lua = lua_.get();
  box_->pending = nullptr;
  int status = LUA_OK;
  {
    const Watching watching(lua, *box_);
    status = lua_pcall(lua, arguments, 0, -2 - arguments);
  }
  box_->thrown = nullptr;
  if (box_->pending) {
    lua_settop(lua, 0);
    std::rethrow_exception(std::exchange(box_->pending, nullptr));
  }
  if (status != LUA_OK) throw_failure(status);
  lua_settop(lua, 0);
}

/// The reason is on top of the stack.
void LuaState::throw_failure(int status) {
  lua_State* lua = lua_.get();
  const std::string message =
      status == LUA_ERRMEM
          ? fmt::format("{}: the script needs more than {} MB", name_, box_->limits.memory >> 20)
          : message_of(lua, name_);
  lua_settop(lua, 0);
  throw Error(message);
}

}  // namespace tetmend
