// SPDX-License-Identifier: MIT
#include "schedule/lua_library.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string_view>

#include "schedule/lua_state.h"

namespace tetmend {

namespace {

/// So many bytes are copied or compared while Lua does one instruction.
constexpr std::size_t kBytesPerStep = 64;

/// Quoting a byte may take as long as many instructions.
constexpr std::size_t kLongestToQuote = std::size_t{64} << 10;

std::size_t text_length(lua_State* lua, int index) {
  return lua_type(lua, index) == LUA_TSTRING ? static_cast<std::size_t>(lua_rawlen(lua, index)) : 0;
}

lua_Integer list_length(lua_State* lua, int index) {
  luaL_checktype(lua, index, LUA_TTABLE);
  return static_cast<lua_Integer>(lua_rawlen(lua, index));
}

// ---- Sorting ------------------------------------------------------------------------------------

/// Merges two sorted pieces of `from`, [low, mid) and [mid, high), into `to`. `less` compares the
/// two values on top of the stack.
template <class Less>
void merge(lua_State* lua, int from, int to, lua_Integer low, lua_Integer mid, lua_Integer high,
           const Less& less) {
  lua_Integer left = low;
  lua_Integer right = mid;
  for (lua_Integer k = low; k < high; ++k) {
    charge_steps(lua, 1);
    bool take_right = left == mid;
    if (left < mid && right < high) {
      lua_rawgeti(lua, from, right);
      lua_rawgeti(lua, from, left);
      take_right = less();
      lua_pop(lua, 2);
    }
    lua_rawgeti(lua, from, take_right ? right++ : left++);
    lua_rawseti(lua, to, k);
  }
}

/// Sorts entries 1 to n of a table. What is equal keeps its order. Whatever `less` answers, it is
/// asked n log n times at most and nothing outside is touched: Lua's own sort takes its pivots from
/// the clock when a list is long.
template <class Less>
void merge_sort(lua_State* lua, int table, lua_Integer n, const Less& less) {
  if (n >= std::numeric_limits<int>::max()) luaL_error(lua, "the list is too long to be sorted");
  if (n < 2) return;
  luaL_checkstack(lua, 8, "no room to sort");
  lua_createtable(lua, static_cast<int>(n), 0);
  int from = table;
  int to = lua_gettop(lua);
  for (lua_Integer width = 1; width < n; width *= 2) {
    for (lua_Integer low = 1; low <= n; low += 2 * width) {
      merge(lua, from, to, low, std::min(low + width, n + 1), std::min(low + 2 * width, n + 1),
            less);
    }
    std::swap(from, to);
  }
  for (lua_Integer i = 1; from != table && i <= n; ++i) {
    charge_steps(lua, 1);
    lua_rawgeti(lua, from, i);
    lua_rawseti(lua, table, i);
  }
  lua_pop(lua, 1);
}

int sort_list(lua_State* lua) {
  const lua_Integer n = list_length(lua, 1);
  if (!lua_isnoneornil(lua, 2)) luaL_checktype(lua, 2, LUA_TFUNCTION);
  lua_settop(lua, 2);
  if (lua_isnil(lua, 2)) {
    merge_sort(lua, 1, n, [lua] {
      charge_steps(lua, std::min(text_length(lua, -1), text_length(lua, -2)) / kBytesPerStep);
      return lua_compare(lua, -2, -1, LUA_OPLT) != 0;
    });
  } else {
    merge_sort(lua, 1, n, [lua] {
      lua_pushvalue(lua, 2);
      lua_pushvalue(lua, -3);
      lua_pushvalue(lua, -3);
      lua_call(lua, 2, 1);
      const bool is_less = lua_toboolean(lua, -1) != 0;
      lua_pop(lua, 1);
      return is_less;
    });
  }
  return 0;
}

// ---- Walking through tables ---------------------------------------------------------------------

/// Of the two keys on top: booleans, then numbers, then texts by their bytes.
bool key_is_less(lua_State* lua) {
  const int type = lua_type(lua, -2);
  if (type != lua_type(lua, -1)) return type < lua_type(lua, -1);
  if (type == LUA_TBOOLEAN) return lua_toboolean(lua, -2) < lua_toboolean(lua, -1);
  if (type == LUA_TNUMBER) return lua_compare(lua, -2, -1, LUA_OPLT) != 0;
  charge_steps(lua, std::min(text_length(lua, -1), text_length(lua, -2)) / kBytesPerStep);
  return text_at(lua, -2) < text_at(lua, -1);
}

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
  lua_newtable(lua);
  lua_Integer n = 0;
  for (lua_pushnil(lua); lua_next(lua, 1) != 0;) {
    charge_steps(lua, 1);
    lua_pop(lua, 1);
    const int type = lua_type(lua, -1);
    if (type != LUA_TSTRING && type != LUA_TBOOLEAN && type != LUA_TNUMBER) {
      return luaL_error(lua, "pairs: keys must be numbers, strings or booleans");
    }
    lua_pushvalue(lua, -1);
    lua_rawseti(lua, 2, ++n);
  }
  merge_sort(lua, 2, n, [lua] { return key_is_less(lua); });
  lua_pushinteger(lua, 0);
  lua_pushvalue(lua, 1);
  lua_pushcclosure(lua, next_pair, 3);
  return 1;
}

// ---- Lists --------------------------------------------------------------------------------------

int join_list(lua_State* lua) {
  const lua_Integer length = list_length(lua, 1);
  std::size_t comma_length = 0;
  const char* comma = luaL_optlstring(lua, 2, "", &comma_length);
  const lua_Integer first = luaL_optinteger(lua, 3, 1);
  const lua_Integer last = luaL_optinteger(lua, 4, length);
  luaL_Buffer text;
  luaL_buffinit(lua, &text);
  for (lua_Integer i = first; i <= last; ++i) {
    if (lua_rawgeti(lua, 1, i) != LUA_TSTRING && lua_isnumber(lua, -1) == 0) {
      return luaL_error(lua, "table.concat: entry %I is a %s", static_cast<LUAI_UACINT>(i),
                        luaL_typename(lua, -1));
    }
    charge_steps(lua, 1 + (text_length(lua, -1) + comma_length) / kBytesPerStep);
    luaL_addvalue(&text);
    if (i == last) break;  // the last of all integers has no next
    luaL_addlstring(&text, comma, comma_length);
  }
  luaL_pushresult(&text);
  return 1;
}

/// Moves entry `from` of the list at 1 to `to`.
void move_entry(lua_State* lua, lua_Integer from, lua_Integer to) {
  charge_steps(lua, 1);
  lua_rawgeti(lua, 1, from);
  lua_rawseti(lua, 1, to);
}

int insert_entry(lua_State* lua) {
  // A list may claim to end at the largest integer.
  const auto end = static_cast<lua_Integer>(static_cast<lua_Unsigned>(list_length(lua, 1)) + 1);
  const int count = lua_gettop(lua);
  if (count != 2 && count != 3) return luaL_error(lua, "wrong number of arguments to 'insert'");
  const lua_Integer place = count == 2 ? end : luaL_checkinteger(lua, 2);
  luaL_argcheck(lua, place >= 1 && place <= end, 2, "position out of bounds");
  for (lua_Integer i = end; i > place; --i) move_entry(lua, i - 1, i);
  lua_rawseti(lua, 1, place);
  return 0;
}

int remove_entry(lua_State* lua) {
  const lua_Integer length = list_length(lua, 1);
  const lua_Integer place = luaL_optinteger(lua, 2, length);
  luaL_argcheck(lua, place == length || (place >= 1 && place <= length + 1), 2,
                "position out of bounds");
  lua_rawgeti(lua, 1, place);
  lua_Integer i = place;
  for (; i < length; ++i) move_entry(lua, i + 1, i);
  lua_pushnil(lua);
  lua_rawseti(lua, 1, i);
  return 1;
}

/// The function of Lua that this one stands before.
int call_original(lua_State* lua) {
  return lua_tocfunction(lua, lua_upvalueindex(1))(lua);
}

int unpack_list(lua_State* lua) {
  constexpr lua_Unsigned kMostResults = LUAI_MAXSTACK;
  const lua_Integer length = list_length(lua, 1);
  const lua_Integer first = luaL_optinteger(lua, 2, 1);
  const lua_Integer last = luaL_optinteger(lua, 3, length);
  const lua_Unsigned count = static_cast<lua_Unsigned>(last) - static_cast<lua_Unsigned>(first);
  if (first <= last) charge_steps(lua, std::min(count, kMostResults));
  return call_original(lua);
}

// ---- Texts --------------------------------------------------------------------------------------

/// A function of Lua whose work grows with its arguments and no faster.
int charged(lua_State* lua) {
  charge_arguments(lua);
  return call_original(lua);
}

int to_text(lua_State* lua) {
  luaL_checkany(lua, 1);
  push_text(lua, 1);
  return 1;
}

/// Of the letters `first` to `last`, which are among a-z or A-Z: the rest would depend on the locale.
int change_case(lua_State* lua, char first, char last) {
  constexpr std::size_t kPiece = 4096;
  std::size_t length = 0;
  const char* text = luaL_checklstring(lua, 1, &length);
  luaL_Buffer changed;
  char* to = luaL_buffinitsize(lua, &changed, length);
  for (std::size_t begin = 0; begin < length; begin += kPiece) {
    charge_steps(lua, kPiece / kBytesPerStep);
    const std::size_t end = std::min(length, begin + kPiece);
    std::transform(text + begin, text + end, to + begin, [=](char c) {
      return c >= first && c <= last ? static_cast<char>(c ^ ('a' ^ 'A')) : c;
    });
  }
  luaL_pushresultsize(&changed, length);
  return 1;
}

int to_lower(lua_State* lua) {
  return change_case(lua, 'A', 'Z');
}

int to_upper(lua_State* lua) {
  return change_case(lua, 'a', 'z');
}

bool modifies_format(char c) {
  return c != 0 && std::strchr("-+ #0123456789.", c) != nullptr;
}

/// string.format without addresses: no %p, and %s as tostring() has it.
int format_text(lua_State* lua) {
  charge_arguments(lua);
  luaL_checkstring(lua, 1);
  const std::string_view format = text_at(lua, 1);
  int argument = 1;
  for (std::size_t i = 0; i < format.size(); ++i) {
    if (format[i] != '%') continue;
    if (++i < format.size() && format[i] == '%') continue;
    ++argument;
    while (i < format.size() && modifies_format(format[i])) ++i;
    if (i >= format.size() || argument > lua_gettop(lua)) break;  // Lua says what is wrong
    if (format[i] == 'p') {
      return luaL_error(lua, "string.format: %%p is an address, which changes from run to run");
    }
    if (format[i] == 'q' && text_length(lua, argument) > kLongestToQuote) {
      return luaL_error(lua, "string.format: the text is too long for %%q");
    }
    if (format[i] == 's') {
      push_text(lua, argument);
      lua_replace(lua, argument);
    }
  }
  return call_original(lua);
}

// ---- All of it ----------------------------------------------------------------------------------

/// Puts a function that calls the one of the same name in the table on top into its place.
void stand_before(lua_State* lua, const char* name, lua_CFunction function) {
  lua_getfield(lua, -1, name);
  lua_pushcclosure(lua, function, 1);
  lua_setfield(lua, -2, name);
}

void put(lua_State* lua, const char* name, lua_CFunction function) {
  lua_pushcfunction(lua, function);
  lua_setfield(lua, -2, name);
}

void drop(lua_State* lua, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    lua_pushnil(lua);
    lua_setfield(lua, -2, name);
  }
}

void push_table_library(lua_State* lua) {
  luaL_requiref(lua, "table", luaopen_table, 0);
  drop(lua, {"move"});
  put(lua, "concat", join_list);
  put(lua, "insert", insert_entry);
  put(lua, "remove", remove_entry);
  put(lua, "sort", sort_list);
  stand_before(lua, "pack", charged);
  stand_before(lua, "unpack", unpack_list);
}

/// Strings find their methods in this very table.
void push_string_library(lua_State* lua) {
  luaL_requiref(lua, "string", luaopen_string, 0);
  drop(lua,
       {"dump", "find", "gmatch", "gsub", "match", "pack", "packsize", "rep", "unpack", "reverse"});
  for (const char* name : {"byte", "char", "sub"}) stand_before(lua, name, charged);
  stand_before(lua, "format", format_text);
  put(lua, "lower", to_lower);
  put(lua, "upper", to_upper);
}

}  // namespace

std::string_view text_at(lua_State* lua, int index) {
  std::size_t length = 0;
  const char* text = lua_tolstring(lua, index, &length);
  return {text, length};
}

void charge_arguments(lua_State* lua) {
  const int count = lua_gettop(lua);
  std::size_t bytes = 0;
  for (int i = 1; i <= count; ++i) bytes += text_length(lua, i);
  charge_steps(lua, static_cast<std::size_t>(count) + bytes / kBytesPerStep);
}

void push_text(lua_State* lua, int index) {
  const int type = lua_type(lua, index);
  if (type == LUA_TNIL || type == LUA_TBOOLEAN || type == LUA_TNUMBER || type == LUA_TSTRING) {
    luaL_tolstring(lua, index, nullptr);
  } else {
    lua_pushstring(lua, lua_typename(lua, type));
  }
}

int call_with_texts(lua_State* lua) {
  const int count = lua_gettop(lua);
  luaL_checkstack(lua, count + 4, "too many arguments");
  lua_pushvalue(lua, lua_upvalueindex(1));
  for (int i = 1; i <= count; ++i) push_text(lua, i);
  lua_call(lua, count, 0);
  return 0;
}

void push_library(lua_State* lua) {
  lua_newtable(lua);
  luaL_requiref(lua, "_G", luaopen_base, 0);
  stand_before(lua, "tonumber", charged);
  for (const char* name : {"assert", "error", "ipairs", "select", "tonumber", "type"}) {
    lua_getfield(lua, -1, name);
    lua_setfield(lua, -3, name);
  }
  lua_pop(lua, 1);
  put(lua, "pairs", pairs_in_order);
  put(lua, "tostring", to_text);
  push_table_library(lua);
  lua_setfield(lua, -2, "table");
  luaL_requiref(lua, "math", luaopen_math, 0);
  drop(lua, {"random", "randomseed"});
  lua_setfield(lua, -2, "math");
  push_string_library(lua);
  lua_setfield(lua, -2, "string");
}

}  // namespace tetmend
