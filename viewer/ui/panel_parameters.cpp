// SPDX-License-Identifier: MIT
// What may be changed while a run is paused: parameters of its operators, from the next pass on.
#include <algorithm>
#include <string>
#include <string_view>

#include <fast_float/fast_float.h>
#include <fmt/format.h>
#include <imgui.h>

#include "kernel/spaced.h"
#include "viewer/ui/call_row.h"
#include "viewer/ui/panels.h"
#include "viewer/ui/parameter_field.h"

namespace tetmend::viewer::ui {

namespace {

/// Of the outermost call at hand, else of the last one.
const Call* call_at_hand(const Debugger& debugger) {
  const auto calls = debugger.file().calls();
  if (!debugger.stack().empty()) return &calls[debugger.stack().front()];
  const auto outermost = std::find_if(calls.rbegin(), calls.rend(),
                                      [](const Call& call) { return call.parent == kNoCall; });
  return outermost == calls.rend() ? nullptr : &*outermost;
}

/// What follows "NAME = " in a text such as "max_level = 2, relax = true"; else `otherwise`.
double value_in_settings(std::string_view text, std::string_view name, double otherwise) {
  const std::string key = fmt::format("{} = ", name);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(", ", at), text.size());
    const std::string_view setting = text.substr(at, end - at);
    at = end + 2;
    if (!setting.starts_with(key)) continue;
    const std::string_view value = setting.substr(key.size());
    if (value == "true" || value == "false") return value == "true" ? 1 : 0;
    double number = otherwise;
    fast_float::from_chars(value.data(), value.data() + value.size(), number);
    return number;
  }
  return otherwise;
}

}  // namespace

void draw_parameters_panel(Session& session) {
  Document& document = session.document;
  const Debugger& debugger = *document.debugger();
  const Call* call = call_at_hand(debugger);
  if (call == nullptr) return;
  const std::string name(debugger.file().name(call->operator_name));
  const auto operators = document.live.registry().operators();
  const auto found = std::find_if(operators.begin(), operators.end(),
                                  [&](const OperatorInfo* info) { return info->name == name; });
  if (found == operators.end()) {  // a sequence
    ImGui::TextDisabled("%s has none of its own", spaced(name).c_str());
    return;
  }
  ImGui::TextDisabled("%s", spaced(name).c_str());
  const std::string_view settings = debugger.file().name(call->settings);
  const auto held = document.live.progress().held_parameters;
  for (const ParameterSpec& spec : (*found)->parameters) {
    double value = value_in_settings(settings, spec.name, spec.initial);
    for (const std::string& text : held) {
      const std::string of_operator = name + ": ";
      if (text.starts_with(of_operator)) {
        value =
            value_in_settings(std::string_view(text).substr(of_operator.size()), spec.name, value);
      }
    }
    if (const auto chosen = edit_value(spec, value)) {
      run_from_window(find_command("live_hold"), session, {name, std::string(spec.name), *chosen});
    }
  }
}

}  // namespace tetmend::viewer::ui
