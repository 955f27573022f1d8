// SPDX-License-Identifier: MIT
// Commands of the sandbox: try an operator at a place, keep what it did, or undo it.
#include <algorithm>
#include <array>
#include <cmath>

#include "viewer/commands/command_group.h"

namespace tetmend::viewer {

using nlohmann::json;

namespace {

double number_in(const Arguments& arguments, const std::string& name, const json& value) {
  if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
  if (value.is_number()) return value.get<double>();
  arguments.fail_field(name, "a number, true or false", value);
}

VertexHandle vertex_in(const Document& document, const Arguments& arguments,
                       const std::string& name, const json& value) {
  const bool is_whole = value.is_number() && value.get<double>() >= 0 &&
                        value.get<double>() == std::floor(value.get<double>());
  if (!is_whole) arguments.fail_field(name, "vertices by their numbers", value);
  if (value.get<double>() >= static_cast<double>(document.mesh().vertex_slots())) {
    throw Error(fmt::format("try_operator: there is no vertex {}", value.get<double>()));
  }
  return VertexHandle(static_cast<std::uint32_t>(value.get<double>()));
}

/// What `field` names: a tet by its own number, the others by their vertices.
std::vector<VertexHandle> target_in(const Document& document, const Arguments& arguments,
                                    const std::string& kind, const json& field) {
  const TetMesh& mesh = document.mesh();
  if (kind == "tet" && field.is_number()) {
    const auto slot = field.get<double>();
    const bool is_there = slot >= 0 && slot < static_cast<double>(mesh.tet_slots()) &&
                          !mesh.is_deleted(TetHandle(static_cast<std::uint32_t>(slot)));
    if (!is_there) throw Error(fmt::format("try_operator: there is no tet {}", slot));
    const TetVertices& v = mesh.vertices(TetHandle(static_cast<std::uint32_t>(slot)));
    return {v.begin(), v.end()};
  }
  std::vector<VertexHandle> target;
  for (const json& item : field.is_array() ? field : json::array({field})) {
    target.push_back(vertex_in(document, arguments, kind, item));
  }
  return target;
}

TrialRequest request_in(Session& s, const json& a) {
  const Arguments arguments("try_operator", a);
  if (!arguments.has(0) || !a[0].is_object()) {
    throw Error(fmt::format("try_operator: a table is wanted; it is used as {}",
                            find_command("try_operator").usage));
  }
  const json& table = a[0];
  TrialRequest request;
  for (const auto& [name, value] : table.items()) {
    if (name == "operator") {
      if (!value.is_string()) arguments.fail_field(name, "the name of an operator", value);
      request.operator_name = value.get<std::string>();
    } else if (name == "set") {
      if (!value.is_object()) arguments.fail_field(name, "a table of parameters", value);
      for (const auto& [parameter, set_to] : value.items()) {
        request.settings.emplace_back(parameter, number_in(arguments, parameter, set_to));
      }
    } else if (name == "tet" || name == "edge" || name == "face" || name == "vertex") {
      request.target = target_in(s.document, arguments, name, value);
    } else {
      throw Error(
          fmt::format("try_operator: '{}' is not known; valid: operator, tet, edge, face, "
                      "vertex, set",
                      name));
    }
  }
  const Registry& registry = s.document.live.registry();
  const OperatorInfo& info = registry.find(request.operator_name);
  if (request.target.empty()) {
    const Trial* before = s.document.trial();
    request.target = before != nullptr
                         ? before->request().target
                         : s.document.pointed_selection(s.document.selection()).vertices;
  }
  if (request.target.size() != vertices_of(info.target)) {
    throw Error(fmt::format("try_operator: {} is for {} {}, which is neither selected nor given",
                            info.name, info.target == TargetKind::edge ? "an" : "a",
                            to_string(info.target)));
  }
  return request;
}

json try_operator(Session& s, const json& a) {
  need_mesh(s.document);
  if (a.empty()) {  // from the menu
    s.document.offer_choices = true;
    return nullptr;
  }
  s.document.try_operator(request_in(s, a));
  return trial_state_of(s.document);
}

json keep(Session& s, const json&) {
  s.document.keep_trial();
  return nullptr;
}

json undo(Session& s, const json&) {
  s.document.undo_trial();
  return nullptr;
}

constexpr std::array kTrialCommands = {
    Command{
        "try_operator", "", "Select",
        "try_operator{operator = \"edge_removal\", edge = {3, 17}, set = {max_degree = 8}}",
        "Try an operator at the selection, or at a tet, edge, face or vertex; the result is how "
        "it ended",
        &try_operator},
    Command{"keep", "", "Select", "keep()", "Keep what the operator that was tried has done",
            &keep},
    Command{"undo", "", "Select", "undo()",
            "Undo the operator that was tried: the mesh is as it was, bit for bit", &undo},
};

}  // namespace

json trial_state_of(const Document& document) {
  const Trial* trial = document.trial();
  if (trial == nullptr) return nullptr;
  json target = json::array();
  for (const VertexHandle v : trial->request().target) target.push_back(v.index());
  json state = {{"operator", trial->request().operator_name},
                {"target", target},
                {"accepted", trial->is_accepted()},
                {"verdict", trial->call().verdict_text()},
                {"outcome", trial->outcome()},
                {"worst_before", trial->call().worst_before},
                {"worst_after", trial->call().worst_after},
                {"calls", trial->call().subtree_end},
                {"seconds", trial->seconds()}};
  const double missing = trial->call().missing();
  if (!trial->is_accepted() && std::isfinite(missing)) state["missing"] = missing;
  return state;
}

std::span<const Command> trial_commands() {
  return kTrialCommands;
}

}  // namespace tetmend::viewer
