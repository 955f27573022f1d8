// SPDX-License-Identifier: MIT
#include "viewer/commands/script.h"

#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "kernel/error.h"
#include "schedule/lua_state.h"
#include "schedule/script_value.h"

namespace tetmend::viewer {

using nlohmann::json;

namespace {

json to_json(const ScriptValue& value) {
  switch (value.kind) {
    case ScriptValue::Kind::nothing:
      return nullptr;
    case ScriptValue::Kind::flag:
      return value.number != 0;
    case ScriptValue::Kind::number:
      return value.number;
    case ScriptValue::Kind::text:
      return value.text;
    case ScriptValue::Kind::table:
      break;
  }
  if (!value.list.empty()) {
    json list = json::array();
    for (const ScriptValue& item : value.list) list.push_back(to_json(item));
    return list;
  }
  json fields = json::object();
  for (const auto& field : value.fields) fields[field.name] = to_json(field.value);
  return fields;
}

void push(lua_State* lua, const json& value) {
  luaL_checkstack(lua, 4, "tables are nested too deep");
  if (value.is_boolean()) {
    lua_pushboolean(lua, value.get<bool>() ? 1 : 0);
  } else if (value.is_number_integer()) {
    lua_pushinteger(lua, value.get<lua_Integer>());
  } else if (value.is_number()) {
    lua_pushnumber(lua, value.get<double>());
  } else if (value.is_string()) {
    lua_pushstring(lua, value.get_ref<const std::string&>().c_str());
  } else if (value.is_structured()) {
    lua_newtable(lua);
    lua_Integer next = 1;
    for (const auto& item : value.items()) {
      push(lua, item.value());
      if (value.is_array()) {
        lua_rawseti(lua, -2, next++);
      } else {
        lua_setfield(lua, -2, item.key().c_str());
      }
    }
  } else {
    lua_pushnil(lua);
  }
}

int call(const Command& command, Session& session, lua_State* lua) {
  json arguments = json::array();
  const int count = lua_gettop(lua);
  for (int i = 1; i <= count; ++i) arguments.push_back(to_json(read_value(lua, i)));
  session.host.arrange(session.document);  // places below are those of the next picture
  const json result = command.run(session, arguments);
  if (session.document.quit) throw ScriptStop();
  push(lua, result);
  return 1;
}

}  // namespace

void run_script(Session& session, const std::string& text, const std::string& name) {
  LuaState lua;
  for (const Command& command : commands()) {
    lua.add_word(std::string(command.name),
                 [&command, &session](lua_State* state) { return call(command, session, state); });
  }
  try {
    lua.run(text, name);
  } catch (const ScriptStop&) {
  }
}

void run_script_file(Session& session, const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  if (!in || !(text << in.rdbuf())) {
    throw Error(fmt::format("{}: cannot read the script", file.string()));
  }
  run_script(session, text.str(), file.string());
}

}  // namespace tetmend::viewer
