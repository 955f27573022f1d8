// SPDX-License-Identifier: MIT
#include "explain/page_text.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "explain/json_text.h"

namespace tetmend::explain {

namespace {

template <class Json>
std::string without_tags(const Json& json) {
  std::string result;
  for (const char c : json_text(json)) {
    if (c == '<') {
      result += "\\u003c";
    } else if (c == '&') {
      result += "\\u0026";
    } else {
      result += c;
    }
  }
  return result;
}

}  // namespace

std::string in_script(const nlohmann::ordered_json& json) {
  return without_tags(json);
}
std::string in_script(const nlohmann::json& json) {
  return without_tags(json);
}

std::string fill_in(std::string_view form,
                    const std::vector<std::pair<std::string_view, std::string>>& values) {
  std::string result;
  while (!form.empty()) {
    const std::size_t at = form.find('@');
    result += form.substr(0, at);
    if (at == std::string_view::npos) break;
    form.remove_prefix(at);
    const auto named = std::find_if(values.begin(), values.end(), [&](const auto& value) {
      return form.starts_with(value.first);
    });
    if (named == values.end()) {
      result += '@';
      form.remove_prefix(1);
    } else {
      result += named->second;
      form.remove_prefix(named->first.size());
    }
  }
  return result;
}

}  // namespace tetmend::explain
