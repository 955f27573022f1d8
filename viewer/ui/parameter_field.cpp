// SPDX-License-Identifier: MIT
#include "viewer/ui/parameter_field.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "kernel/spaced.h"
#include "viewer/ui/call_row.h"

namespace tetmend::viewer::ui {

namespace {

std::optional<double> edit(const ParameterSpec& spec, double value) {
  const std::string name = name_field(spec.name);
  if (spec.kind == ParameterSpec::Kind::flag) {
    bool on = value != 0;
    if (!ImGui::Checkbox(name.c_str(), &on)) return std::nullopt;
    return on ? 1 : 0;
  }
  if (spec.kind == ParameterSpec::Kind::integer) {
    int whole = static_cast<int>(value);
    constexpr int kStep = 1;
    if (!ImGui::InputInt(name.c_str(), &whole, kStep, kStep,
                         ImGuiInputTextFlags_EnterReturnsTrue)) {
      return std::nullopt;
    }
    return whole;
  }
  if (!ImGui::InputDouble(name.c_str(), &value, 0, 0, "%g", ImGuiInputTextFlags_EnterReturnsTrue)) {
    return std::nullopt;
  }
  return value;
}

}  // namespace

std::string name_field(std::string_view name) {
  constexpr float kNames = 0.5F;  // of the width
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(spaced(name).c_str());
  ImGui::SameLine(kNames * ImGui::GetContentRegionMax().x);
  ImGui::SetNextItemWidth(-1);
  return "##" + std::string(name);
}

std::optional<double> edit_value(const ParameterSpec& spec, double value) {
  const auto chosen = edit(spec, value);
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%s", fmt::format("{}: {}\n{:g} to {:g}; default {:g}", spec.name, spec.help,
                                        spec.low, spec.high, spec.initial)
                                .c_str());
  }
  if (!chosen) return std::nullopt;
  return std::clamp(*chosen, spec.low, spec.high);
}

}  // namespace tetmend::viewer::ui
