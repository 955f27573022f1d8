// SPDX-License-Identifier: MIT
#include "schedule/word_call.h"

#include <utility>

#include <fmt/format.h>

#include "schedule/lua_box.h"

namespace tetmend {

// ---- Work of C++: reading arguments -------------------------------------------------------------

namespace {

constexpr int kDeepest = 16;

/// Memory of a value and of what is made from it: a composition, a place in a vector that grows.
constexpr std::size_t kBytesOfValue = 256;

/// Only a text: Lua would turn a number into one, for which it might lack memory.
std::string_view string_at(lua_State* lua, int index) {
  if (lua_type(lua, index) != LUA_TSTRING) return {};
  std::size_t length = 0;
  const char* text = lua_tolstring(lua, index, &length);
  return {text, length};
}

/// Reads values from the stack of a call.
class Reader {
 public:
  Reader(const WordCall& call, lua_State* lua) : call_(call), lua_(lua) {}

  ScriptValue read(int index, int depth) const {
    call_.hold_in_call(kBytesOfValue);
    call_.charge_steps(1);
    ScriptValue value;
    switch (lua_type(lua_, index)) {
      case LUA_TNIL:
      case LUA_TNONE:
        return value;
      case LUA_TBOOLEAN:
        value.kind = ScriptValue::Kind::flag;
        value.number = lua_toboolean(lua_, index);
        return value;
      case LUA_TNUMBER:
        value.kind = ScriptValue::Kind::number;
        value.number = lua_tonumber(lua_, index);
        value.is_integer = lua_isinteger(lua_, index) != 0;
        return value;
      case LUA_TSTRING:
        value.kind = ScriptValue::Kind::text;
        value.text = take_text(index);
        return value;
      case LUA_TTABLE:
        return read_table(index, depth);
      default:
        throw Error(
            fmt::format("a {} is of no use here", lua_typename(lua_, lua_type(lua_, index))));
    }
  }

 private:
  /// A copy: what is shared in Lua may be large when it is copied often.
  std::string take_text(int index) const {
    const std::string_view text = string_at(lua_, index);
    call_.hold_in_call(2 * text.size());
    call_.charge_steps(text.size() / 64);
    return std::string(text);
  }

  ScriptValue read_table(int index, int depth) const {
    if (depth > kDeepest || lua_checkstack(lua_, 4) == 0) {
      throw Error("tables are nested too deep");
    }
    ScriptValue value;
    value.kind = ScriptValue::Kind::table;
    const auto length = static_cast<lua_Integer>(lua_rawlen(lua_, index));
    for (lua_Integer i = 1; i <= length; ++i) {
      lua_rawgeti(lua_, index, i);
      value.list.push_back(read(lua_gettop(lua_), depth + 1));
      lua_pop(lua_, 1);
    }
    lua_pushnil(lua_);
    while (lua_next(lua_, index) != 0) {
      if (lua_type(lua_, -2) == LUA_TSTRING) {
        std::string name = take_text(-2);
        value.fields.push_back({std::move(name), read(lua_gettop(lua_), depth + 1)});
      } else if (lua_isinteger(lua_, -2) == 0 || lua_tointeger(lua_, -2) < 1 ||
                 lua_tointeger(lua_, -2) > length) {
        throw Error("a table has keys that are neither names nor 1, 2, ... n");
      }
      lua_pop(lua_, 1);
    }
    std::sort(value.fields.begin(), value.fields.end(),
              [](const auto& x, const auto& y) { return x.name < y.name; });
    return value;
  }

  const WordCall& call_;
  lua_State* lua_;
};

}  // namespace

WordCall::WordCall(lua_State* lua) : lua_(lua), box_(box_of(lua)) {}

int WordCall::argument_count() const {
  return lua_gettop(lua_);
}

ScriptValue WordCall::argument(int i) const {
  return Reader(*this, lua_).read(i, 0);
}

std::string_view WordCall::text(int i) const {
  return string_at(lua_, i);
}

void WordCall::give(ScriptValue value) {
  box_.results.push_back(std::move(value));
}

void WordCall::charge_steps(std::size_t steps) const {
  box_.charge(steps);
}

void WordCall::hold_in_call(std::size_t bytes) const {
  box_.in_call += bytes;
  box_.check_outside();
}

void WordCall::hold_for_good(std::size_t bytes) const {
  box_.kept += bytes;
  box_.check_outside();
}

// ---- Functions of Lua: pushing results ----------------------------------------------------------

namespace {

void push(lua_State* lua, const ScriptValue& value) {
  luaL_checkstack(lua, 4, "tables are nested too deep");
  switch (value.kind) {
    case ScriptValue::Kind::nothing:
      return lua_pushnil(lua);
    case ScriptValue::Kind::flag:
      return lua_pushboolean(lua, value.number != 0 ? 1 : 0);
    case ScriptValue::Kind::number:
      if (value.is_integer) return lua_pushinteger(lua, static_cast<lua_Integer>(value.number));
      return lua_pushnumber(lua, value.number);
    case ScriptValue::Kind::text:
      lua_pushlstring(lua, value.text.data(), value.text.size());
      return;
    case ScriptValue::Kind::table:
      break;
  }
  lua_newtable(lua);
  lua_Integer i = 0;
  for (const ScriptValue& item : value.list) {
    push(lua, item);
    lua_rawseti(lua, -2, ++i);
  }
  for (const ScriptValue::Field& field : value.fields) {
    lua_pushlstring(lua, field.name.data(), field.name.size());
    push(lua, field.value);
    lua_rawset(lua, -3);
  }
}

}  // namespace

int push_results(lua_State* lua, const std::vector<ScriptValue>& results) {
  for (const ScriptValue& value : results) push(lua, value);
  return static_cast<int>(results.size());
}

}  // namespace tetmend
