// SPDX-License-Identifier: MIT
// The sandbox: what was tried, how it ended and how near it was; other parameters run it again.
#include <algorithm>

#include <imgui.h>

#include "kernel/spaced.h"
#include "viewer/ui/call_row.h"
#include "viewer/ui/panels.h"
#include "viewer/ui/parameter_field.h"
#include "viewer/ui/wrapped_text.h"

namespace tetmend::viewer::ui {

namespace {

double value_of(const TrialRequest& request, const ParameterSpec& spec) {
  for (const auto& [name, value] : request.settings) {
    if (name == spec.name) return value;
  }
  return spec.initial;
}

void try_again(Session& session, TrialRequest request, std::string_view name, double value) {
  std::erase_if(request.settings, [&](const auto& setting) { return setting.first == name; });
  request.settings.emplace_back(name, value);
  do_soon(session, [&document = session.document, request] { document.try_operator(request); });
}

void edit_settings(Session& session, const OperatorInfo& info) {
  const TrialRequest& request = session.document.trial()->request();
  for (const ParameterSpec& spec : info.parameters) {
    const auto value = edit_value(spec, value_of(request, spec));
    if (value) try_again(session, request, spec.name, *value);
  }
}

/// Another operator at the same place.
void choose_operator(Session& session) {
  Document& document = session.document;
  const TrialRequest& request = document.trial()->request();
  std::string chosen;
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo("##operator", spaced(request.operator_name).c_str())) return;
  for (const OperatorInfo* info : document.live.registry().operators()) {
    if (vertices_of(info->target) != request.target.size()) continue;
    const std::string name(info->name);
    if (ImGui::Selectable(spaced(name).c_str(), name == request.operator_name)) chosen = name;
  }
  ImGui::EndCombo();
  if (chosen.empty()) return;
  const TrialRequest next{chosen, request.target, {}};
  do_soon(session, [&document, next] { document.try_operator(next); });
}

}  // namespace

void draw_trial_panel(Session& session) {
  Document& document = session.document;
  choose_operator(session);
  wrapped_text(document.trial()->outcome());
  const unsigned calls = document.trial()->call().subtree_end;
  ImGui::TextDisabled("%.2f ms, %u %s", 1000 * document.trial()->seconds(), calls,
                      calls == 1 ? "call" : "calls");
  // Above the parameters, so that they are in sight however many there are.
  const Command& keep = find_command("keep");
  const Command& undo = find_command("undo");
  if (document.trial()->is_accepted()) {
    if (ImGui::Button("Keep")) run_from_window(keep, session);
    ImGui::SameLine();
  }
  if (ImGui::Button("Undo")) run_from_window(undo, session);
  const OperatorInfo& info =
      document.live.registry().find(document.trial()->request().operator_name);
  edit_settings(session, info);
}

}  // namespace tetmend::viewer::ui
