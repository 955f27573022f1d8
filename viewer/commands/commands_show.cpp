// SPDX-License-Identifier: MIT
// Commands that decide what is drawn.
#include <algorithm>
#include <array>

#include "viewer/commands/command_group.h"
#include "viewer/mesh/tet_values.h"

namespace tetmend::viewer {

using nlohmann::json;

namespace {

/// A number from the script; without one, on and off.
json set_or_toggle(Session& s, const json& a, const char* name, double& value, double usual) {
  if (!a.empty()) {
    apply_json(s.document.view, {{name, a[0]}});
  } else {
    value = value > 0 ? 0 : usual;
  }
  return nullptr;
}

json ghosts(Session& s, const json& a) {
  constexpr double kFaint = 0.15;
  return set_or_toggle(s, a, "ghosts", s.document.view.scene.ghosts, kFaint);
}

/// "region", then the values of tets.
json colour(Session& s, const json& a) {
  std::string& now = s.document.view.scene.colour;
  if (!a.empty()) {
    apply_json(s.document.view, {{"colour", a[0]}});
    if (now != "region" && now != kDistance) s.document.view.scene.measure = now;
    return nullptr;
  }
  std::vector<std::string> names = {"region"};
  if (s.document.reference() != nullptr) names.emplace_back(kDistance);
  for (const TetValue& value : tet_values()) names.emplace_back(value.name);
  const auto found = std::find(names.begin(), names.end(), now);
  const auto next = found + 1 == names.end() ? names.begin() : found + 1;
  return colour(s, json::array({*next}));
}

/// Changes what is given; returns what is in force then.
json goal(Session& s, const json& a) {
  const Arguments arguments("goal", a);
  Goal goal = s.document.mesh().standard().goal();
  if (arguments.has(0)) goal = Goal::symmetric(arguments.number(0));
  if (arguments.has(1)) goal.max_angle = arguments.number(1);
  if (!a.empty()) s.document.set_goal(goal);
  return {{"min", goal.min_angle}, {"max", goal.max_angle}};
}

/// The menu turns it on and off, or asks for a file.
json reference(Session& s, const json& a) {
  Document& document = s.document;
  const Arguments arguments("reference", a);
  if (arguments.has(0)) {
    Allowance allowance;
    if (arguments.has(1)) allowance = Allowance::parse(arguments.text(1));
    document.set_reference(arguments.text(0), allowance);
    document.view.show_reference(true);
    return nullptr;
  }
  if (document.reference() == nullptr) {
    document.question = FileQuestion::reference;
  } else {
    document.view.show_reference(document.view.scene.colour != kDistance);
  }
  return nullptr;
}

json filter(Session& s, const json& a) {
  if (!a.empty()) {
    const Arguments arguments("filter", a);
    apply_json(s.document.view,
               {{"filtered", true}, {"range", {arguments.number(0), arguments.number(1)}}});
  } else {
    s.document.view.scene.filtered = false;
  }
  return nullptr;
}

json brush(Session& s, const json& a) {
  need_mesh(s.document);
  const Arguments arguments("brush", a);
  s.document.view.scene.range =
      s.document.histogram().brushed(arguments.number(0), arguments.number(1));
  s.document.view.scene.filtered = true;
  return nullptr;
}

json peel(Session& s, const json& a) {
  apply_json(s.document.view, {{"peel", Arguments("peel", a).number(0)}});
  return nullptr;
}

template <int Change>
json peel_by(Session& s, const json&) {
  int& value = s.document.view.scene.peel;
  value = std::max(0, value + Change);
  return nullptr;
}

json shrink(Session& s, const json& a) {
  constexpr double kUsual = 0.2;
  return set_or_toggle(s, a, "shrink", s.document.view.scene.shrink, kUsual);
}

json cut(Session& s, const json& a) {
  const Arguments arguments("cut", a);
  const std::uint32_t i = arguments.index(0, 4);
  if (i == 0) throw Error("cut: planes are numbered 1 to 3");
  const std::string name = fmt::format("cut_{}", i);
  json patch = a.size() > 1 ? a[1] : json::object();
  if (!patch.contains("on")) patch["on"] = true;
  apply_json(s.document.view, {{name, patch}});
  return nullptr;
}

template <std::size_t Plane>
json toggle_cut(Session& s, const json&) {
  bool& on = s.document.view.scene.cuts[Plane].on;
  on = !on;
  return nullptr;
}

json exact(Session& s, const json&) {
  auto& cuts = s.document.view.scene.cuts;
  const bool now = !cuts[0].exact;
  for (CutPlane& plane : cuts) plane.exact = now;
  return nullptr;
}

template <int Direction>
json move_cuts(Session& s, const json&) {
  constexpr double kStep = 0.02;
  for (CutPlane& plane : s.document.view.scene.cuts) {
    if (plane.on) plane.position = std::clamp(plane.position + Direction * kStep, -1.0, 1.0);
  }
  return nullptr;
}

json show_all(Session& s, const json&) {
  SceneSettings& scene = s.document.view.scene;
  scene.filtered = false;
  scene.peel = 0;
  scene.shrink = 0;
  scene.hidden_regions.clear();
  for (CutPlane& plane : scene.cuts) plane.on = false;
  if (s.document.debugger() == nullptr) scene.isolate = false;
  s.document.forget_camera_before_alone();
  return nullptr;
}

constexpr std::string_view kShow = "Show";

constexpr std::array kShowCommands = {
    Command{"edges", "E", kShow, "edges()", "Edges on or off", &toggle<&ViewSettings::edges>},
    Command{"bad", "B", kShow, "bad()", "Bad tets in red, seen through the rest",
            &toggle<&SceneSettings::bad>},
    Command{"bad_beyond_cuts", "Shift+B", kShow, "bad_beyond_cuts()",
            "Bad tets also where cuts and peeling hide them",
            &toggle<&SceneSettings::bad_beyond_cuts>},
    Command{"constraints", "C", kShow, "constraints()", "Constraint faces inside the volume",
            &toggle<&SceneSettings::constraints>},
    Command{"ghosts", "G", kShow, "ghosts(0.15)", "Ghosts of hidden tets; opacity", &ghosts},
    Command{"outline", "", kShow, "outline()",
            "The mesh as a faint outline around what a filter or isolation leaves of it",
            &toggle<&SceneSettings::outline>},
    Command{
        "reference", "Ctrl+R", kShow, "reference(\"FILE\", \"1%\")",
        "Colour the surface by its distance from that of another mesh, seen as a ghost; then on "
        "and off. A tolerance is a length or a share of edges; a trace has what it began with",
        &reference},
    Command{"colour", "M", kShow, "colour(\"quality\")",
            "Colour by region or by a measure; the key takes the next", &colour},
    Command{
        "goal", "", "", "goal(MIN, MAX, \"MEASURE\")",
        "The angles of a good tet, in degrees, and \"sine_and_length\" or \"sine\": for what is "
        "shown and for live runs; the result is what holds",
        &goal},
    Command{"filter", "R", kShow, "filter(LOW, HIGH)",
            "Show only tets with values in a range; without one the filter is off", &filter},
    Command{"brush", "", "", "brush(FROM, TO)",
            "Filter as by dragging over the histogram, 0 its left and 1 its right end", &brush},
    Command{"peel", "", "", "peel(LAYERS)", "Take layers of tets off the boundary", &peel},
    Command{"peel_more", "+", kShow, "peel_more()", "Peel one more layer", &peel_by<1>},
    Command{"peel_less", "-", kShow, "peel_less()", "Peel one layer less", &peel_by<-1>},
    Command{"shrink", "S", kShow, "shrink(0.2)", "Shrink tets towards their centres", &shrink},
    Command{"cut_x", "X", kShow, "cut_x()", "Cut plane 1 on or off", &toggle_cut<0>},
    Command{"cut_y", "Y", kShow, "cut_y()", "Cut plane 2 on or off", &toggle_cut<1>},
    Command{"cut_z", "Z", kShow, "cut_z()", "Cut plane 3 on or off", &toggle_cut<2>},
    Command{"cut", "", "", "cut(1, {normal = {1, 0, 0}, position = 0, exact = true})",
            "Set a cut plane; position in radii of the mesh from its centre", &cut},
    Command{"exact", "K", kShow, "exact()", "Cut through tets, or show whole tets", &exact},
    Command{"cut_forward", "]", kShow, "cut_forward()", "Move the cut planes forwards",
            &move_cuts<1>},
    Command{"cut_back", "[", kShow, "cut_back()", "Move the cut planes back", &move_cuts<-1>},
    Command{"show_all", "A", kShow, "show_all()", "No filter, cut, peeling, shrinking or isolation",
            &show_all},
};

}  // namespace

std::span<const Command> show_commands() {
  return kShowCommands;
}

}  // namespace tetmend::viewer
