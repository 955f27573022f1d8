// SPDX-License-Identifier: MIT
#include "schedule/lua_state.h"

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <exception>
#include <iterator>
#include <new>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "kernel/error.h"
#include "schedule/lua_library.h"
#include "schedule/printable.h"

namespace tetmend {

namespace {

constexpr std::size_t kStepsBetweenWatches = 1000;
constexpr std::size_t kBytesBetweenWatches = std::size_t{4} << 20;
constexpr std::size_t kUsualBlock = std::size_t{64} << 10;
constexpr std::size_t kLongestMessage = 4000;
constexpr std::size_t kLongestName = 100;
constexpr std::size_t kMostNames = 200;
constexpr const char* kWords = "tetmend words";

}  // namespace

/// All that the callbacks of the interpreter need. The state has its address in its extra space.
struct LuaBox {
  LuaState::Limits limits;
  LuaState::Watch watch;
  std::deque<LuaState::Function> words;  // addresses must stay
  std::exception_ptr pending;            // to come out of run()
  std::string start_of_messages;         // of Lua, when it knows the line
  lua_State* running = nullptr;          // null: nothing to be watched

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
};

namespace {

LuaBox& box_of(lua_State* lua) {
  return **static_cast<LuaBox**>(lua_getextraspace(lua));
}

/// An error of the line that runs at `level`. Does not return.
int fail(lua_State* lua, std::string_view message, int level = 1) {
  luaL_where(lua, level);
  lua_pushlstring(lua, message.data(), message.size());
  lua_concat(lua, 2);
  return lua_error(lua);
}

// ---- Names -------------------------------------------------------------------------------------

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
      charge_steps(lua, 1);
      if (lua_type(lua, -1) != LUA_TSTRING || lua_rawlen(lua, -1) > kLongestName) continue;
      valid.insert(lua_tostring(lua, -1));
      if (valid.size() > kMostNames) valid.erase(std::prev(valid.end()));
    }
  }
  return fail(lua, fmt::format("unknown name '{}'; valid: {}", printable(name, kLongestName),
                               fmt::join(valid, ", ")));
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

}  // namespace

// ---- Callbacks ----------------------------------------------------------------------------------

namespace {

/// Runs what may throw in a frame that Lua called.
template <class Work>
int guarded(lua_State* lua, int level, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    return fail(lua, error.what(), level);
  } catch (const ScriptStop&) {
    box_of(lua).pending = std::current_exception();
  } catch (const std::exception&) {
    box_of(lua).pending = std::current_exception();
  }
  return fail(lua, "", level);
}

/// Asks whether the script may go on.
void look(lua_State* lua, int level) {
  LuaBox& box = box_of(lua);
  box.new_bytes = 0;
  guarded(lua, level, [&] {
    // Before the limit itself is met, which no line could be blamed for.
    if (box.used > box.enough_memory()) {
      throw Error(fmt::format("the script holds more than {} MB", box.enough_memory() >> 20));
    }
    // Comparing or reading it would be one step for Lua, however long.
    if (box.has_long_text) {
      throw Error(fmt::format("a text is longer than {} MB", box.limits.text >> 20));
    }
    if (box.watch) box.watch();
    return 0;
  });
}

void on_count(lua_State* lua, lua_Debug*) {
  LuaBox& box = box_of(lua);
  if (box.hook_is_near) {  // costs a walk through all calls
    box.hook_is_near = false;
    lua_sethook(lua, on_count, LUA_MASKCOUNT, box.instructions_between_watches());
  }
  look(lua, 0);
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
  const auto& function =
      *static_cast<const LuaState::Function*>(lua_touserdata(lua, lua_upvalueindex(1)));
  charge_arguments(lua);
  box_of(lua).in_call = 0;
  return guarded(lua, 1, [&] { return function(lua); });
}

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

std::string_view text_at(lua_State* lua, int index) {
  std::size_t length = 0;
  const char* text = lua_tolstring(lua, index, &length);
  return {text, length};
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

void charge_steps(lua_State* lua, std::size_t steps) {
  LuaBox& box = box_of(lua);
  box.steps += steps;
  while (box.running != nullptr && box.steps >= kStepsBetweenWatches) {
    box.steps -= kStepsBetweenWatches;
    look(lua, 1);
  }
}

namespace {

void check_outside(const LuaBox& box) {
  if (box.kept + box.in_call <= box.limits.outside) return;
  throw Error(fmt::format("arguments, notes and descriptions take more than {} MB",
                          box.limits.outside >> 20));
}

}  // namespace

void hold_in_call(lua_State* lua, std::size_t bytes) {
  LuaBox& box = box_of(lua);
  box.in_call += bytes;
  check_outside(box);
}

void hold_for_good(lua_State* lua, std::size_t bytes) {
  LuaBox& box = box_of(lua);
  box.kept += bytes;
  check_outside(box);
}

LuaState::LuaState(Limits limits, Watch watch) : box_(std::make_unique<LuaBox>()) {
  box_->limits = limits;
  box_->watch = std::move(watch);
  lua_.reset(lua_newstate(allocate, box_.get()));
  if (lua_ == nullptr) throw std::bad_alloc();
  // Outside of run() only memory can be missing. Lua would end the process.
  lua_atpanic(get(), [](lua_State*) -> int { throw std::bad_alloc(); });
  *static_cast<LuaBox**>(lua_getextraspace(get())) = box_.get();
  push_library(get());
  lua_setfield(get(), LUA_REGISTRYINDEX, kWords);
  make_globals(get());
}

LuaState::~LuaState() = default;

void LuaState::Close::operator()(lua_State* lua) const {
  lua_close(lua);
}

void LuaState::push_function(Function function) {
  lua_pushlightuserdata(get(), &box_->words.emplace_back(std::move(function)));
  lua_pushcclosure(get(), call_word, 1);
}

void LuaState::add_word(const std::string& name, Function function) {
  lua_getfield(get(), LUA_REGISTRYINDEX, kWords);
  push_function(std::move(function));
  lua_setfield(get(), -2, name.c_str());
  lua_pop(get(), 1);
}

void LuaState::run(std::string_view text, const std::string& name) {
  lua_State* lua = get();
  box_->pending = nullptr;
  box_->start_of_messages = name_in_messages(name) + ":";
  lua_pushcfunction(lua, add_place);
  const std::string chunk = "@" + name;
  int status = luaL_loadbufferx(lua, text.data(), text.size(), chunk.c_str(), "t");
  if (status == LUA_OK) {
    const Watching watching(lua, *box_);
    status = lua_pcall(lua, 0, 0, -2);
  }
  if (box_->pending) {
    lua_settop(lua, 0);
    std::rethrow_exception(std::exchange(box_->pending, nullptr));
  }
  if (status == LUA_OK) return lua_settop(lua, 0);
  if (status < LUA_OK) {  // an exception that is none of Lua's, from where nobody caught it
    lua_settop(lua, 0);
    throw std::bad_alloc();
  }
  const std::string message =
      status == LUA_ERRMEM
          ? fmt::format("{}: the script needs more than {} MB", name, box_->limits.memory >> 20)
          : message_of(lua, name);
  lua_settop(lua, 0);
  throw Error(message);
}

}  // namespace tetmend
