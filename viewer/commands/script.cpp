// SPDX-License-Identifier: MIT
#include "viewer/commands/script.h"

#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "kernel/error.h"
#include "schedule/lua_state.h"
#include "schedule/script_value.h"
#include "viewer/commands/menu.h"

namespace tetmend::viewer {

using nlohmann::json;

namespace {

json value_json(const ScriptValue& value) {
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
    for (const ScriptValue& item : value.list) list.push_back(value_json(item));
    return list;
  }
  json fields = json::object();
  for (const auto& field : value.fields) fields[field.name] = value_json(field.value);
  return fields;
}

ScriptValue to_value(const json& value) {
  if (value.is_boolean()) return ScriptValue::of_flag(value.get<bool>());
  if (value.is_number_integer()) return ScriptValue::of_integer(value.get<double>());
  if (value.is_number()) return ScriptValue::of_number(value.get<double>());
  if (value.is_string()) return ScriptValue::of_text(value.get_ref<const std::string&>());
  if (!value.is_structured()) return {};
  ScriptValue table = ScriptValue::empty_table();
  for (const auto& item : value.items()) {
    if (value.is_array()) {
      table.list.push_back(to_value(item.value()));
    } else {
      table.fields.push_back({item.key(), to_value(item.value())});
    }
  }
  return table;
}

/// A word without arguments takes none; one that switches takes true or false as well, and false then
/// means: it is so already. @throws Error
bool is_to_run(const Command& command, const Document& document, const json& arguments) {
  const bool takes_some = !command.usage.ends_with("()");
  if (takes_some || arguments.empty()) return true;
  const auto state = is_on(command, document);
  const bool is_switch = state && arguments.size() == 1 && arguments[0].is_boolean();
  if (!is_switch) {
    throw Error(
        fmt::format("{}: it takes no argument{}", command.name, state ? ", or true or false" : ""));
  }
  return *state != arguments[0].get<bool>();
}

void run_command(const Command& command, Session& session, WordCall& call) {
  json arguments = json::array();
  for (int i = 1; i <= call.argument_count(); ++i)
    arguments.push_back(value_json(call.argument(i)));
  session.host.arrange(session.document);  // places below are those of the next picture
  session.document.keep_view();
  if (!is_to_run(command, session.document, arguments)) return;
  const json result = command.run(session, arguments);
  if (session.document.quit) throw ScriptStop();
  call.give(to_value(result));
}

}  // namespace

void run_script(Session& session, const std::string& text, const std::string& name) {
  LuaState lua;
  for (const Command& command : commands()) {
    lua.add_word(std::string(command.name),
                 [&command, &session](WordCall& call) { run_command(command, session, call); });
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
