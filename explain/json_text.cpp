// SPDX-License-Identifier: MIT
#include "explain/json_text.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "kernel/printable.h"

namespace tetmend::explain {

namespace {

template <class Json>
Json made_printable(Json json) {
  if (json.is_string()) return printable_lines(json.template get_ref<const std::string&>());
  if (json.is_array()) {
    for (Json& item : json) item = made_printable(std::move(item));
  }
  if (!json.is_object()) return json;
  Json object = Json::object();
  for (auto member = json.begin(); member != json.end(); ++member) {
    object[printable_lines(member.key())] = made_printable(std::move(member.value()));
  }
  return object;
}

void add_changed(const std::string& text, std::vector<std::string>& to) {
  std::string made = printable_lines(text);
  if (made != text && std::find(to.begin(), to.end(), made) == to.end()) {
    to.push_back(std::move(made));
  }
}

void add_changed(const nlohmann::json& json, std::vector<std::string>& to) {
  if (json.is_string()) return add_changed(json.get_ref<const std::string&>(), to);
  if (!json.is_structured()) return;
  for (auto item = json.begin(); item != json.end(); ++item) {
    if (json.is_object()) add_changed(item.key(), to);
    add_changed(item.value(), to);
  }
}

}  // namespace

std::vector<std::string> changed_texts(const nlohmann::json& json) {
  std::vector<std::string> texts;
  add_changed(json, texts);
  return texts;
}

nlohmann::json printable_json(nlohmann::json json) {
  return made_printable(std::move(json));
}

nlohmann::ordered_json printable_json(nlohmann::ordered_json json) {
  return made_printable(std::move(json));
}

std::string json_text(const nlohmann::json& json, int indent) {
  return printable_json(json).dump(indent);
}

std::string json_text(const nlohmann::ordered_json& json, int indent) {
  return printable_json(json).dump(indent);
}

}  // namespace tetmend::explain
