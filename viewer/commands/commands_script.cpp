// SPDX-License-Identifier: MIT
// Commands for scripts: what they look at.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "explain/json_text.h"
#include "kernel/printable.h"
#include "viewer/commands/command_group.h"

namespace tetmend::viewer {

using nlohmann::json;

namespace {

json state(Session& s, const json&) {
  return state_of(s.document);
}

json locate(Session& s, const json&) {
  if (std::holds_alternative<std::monostate>(s.document.selection())) {
    throw Error("locate: nothing is selected");
  }
  const Ball ball = ball_around(s.document.mesh(), s.document.selection());
  const auto pixel = s.document.view.camera.project(ball.centre, s.document.canvas);
  if (!pixel) throw Error("locate: the selection lies behind the camera");
  return {{"x", std::floor(pixel->x) + s.document.canvas_corner.x},
          {"y", std::floor(pixel->y) + s.document.canvas_corner.y}};
}

json red_pixels(Session& s, const json& a) {
  const Image image = s.host.render(s.document);
  if (a.empty()) return count_red(image);
  const Arguments arguments("red_pixels", a);
  return count_red(image, static_cast<int>(arguments.number(0)),
                   static_cast<int>(arguments.number(1)),
                   static_cast<int>(arguments.index(2, 100000)));
}

json pixel(Session& s, const json& a) {
  const Arguments arguments("pixel", a);
  const auto x = arguments.index(0, static_cast<std::size_t>(s.document.window.width));
  const auto y = arguments.index(1, static_cast<std::size_t>(s.document.window.height));
  const Image image = s.host.render(s.document);
  const Colour& c = image.at(static_cast<int>(x), static_cast<int>(y));
  return {{"red", c.red}, {"green", c.green}, {"blue", c.blue}};
}

json expect(Session&, const json& a) {
  const bool holds = !a.empty() && !a[0].is_null() && a[0] != json(false);
  if (holds) return nullptr;
  throw Error(a.size() > 1 && a[1].is_string() ? "expected: " + a[1].get<std::string>()
                                               : "an expectation does not hold");
}

/// Lua's numbers come as reals; whole ones are written without a point.
json plain(json value) {
  constexpr double kExact = 9007199254740992.0;  // 2^53
  if (value.is_number_float()) {
    const double number = value.get<double>();
    const bool is_whole = std::abs(number) <= kExact && number == std::floor(number);
    return is_whole ? json(static_cast<std::int64_t>(number)) : value;
  }
  if (value.is_structured()) {
    for (json& item : value) item = plain(std::move(item));
  }
  return value;
}

std::string text_of(const json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_null()) return "nil";
  if (value.is_number_float()) return fmt::format("{}", value.get<double>());
  return value.is_structured() ? explain::json_text(plain(value), 2) : explain::json_text(value);
}

json print(Session& s, const json& a) {
  std::string line;
  for (const json& value : a) line += fmt::format("{}{}", line.empty() ? "" : " ", text_of(value));
  s.host.print(line);
  return nullptr;
}

constexpr std::array kScriptCommands = {
    Command{"state", "", "", "state()", "Counts, selection and view, as a table", &state},
    Command{"locate", "", "", "locate()", "Pixel of the selection: a table of x and y", &locate},
    Command{"red_pixels", "", "", "red_pixels(X, Y, RADIUS)",
            "Number of red pixels near a pixel, or in the whole picture", &red_pixels},
    Command{"pixel", "", "", "pixel(X, Y)", "Colour of a pixel: red, green, blue", &pixel},
    Command{"expect", "", "", "expect(CONDITION, \"TEXT\")", "Ends the script with an error if not",
            &expect},
    Command{"print", "", "", "print(VALUE, ...)",
            "Write a line to standard output; a table as JSON", &print},
};

}  // namespace

void Host::print(const std::string& line) {
  fmt::print("{}\n", printable_lines(line));
  std::fflush(stdout);
}

std::span<const Command> script_commands() {
  return kScriptCommands;
}

namespace {

json reference_state(Document& document) {
  const ReferenceSurface& reference = *document.reference();
  const SurfaceDeparture& departure = document.departure();
  json state = {{"name", reference.name()},
                {"distance", departure.most.distance},
                {"triangles", departure.triangles},
                {"changed", departure.others},
                {"range", {document.distance_range().low, document.distance_range().high}}};
  if (reference.allowance().is_known()) state["share_of_tolerance"] = departure.most.share;
  if (departure.back) {
    state["distance_back"] = departure.back->distance;
    if (reference.allowance().is_known()) state["share_back"] = departure.back->share;
  }
  return state;
}

}  // namespace

json state_of(Document& document) {
  json selection = {{"kind", "nothing"}};
  const TetMesh& mesh = document.mesh();
  if (const auto* t = std::get_if<TetHandle>(&document.selection())) {
    selection = {{"kind", "tet"}, {"tet", t->index()}, {"quality", mesh.quality(*t)}};
  } else if (const auto* e = std::get_if<TetEdge>(&document.selection())) {
    const auto ends = mesh.vertices(*e);
    selection = {{"kind", "edge"}, {"from", ends[0].index()}, {"to", ends[1].index()}};
  } else if (const auto* f = std::get_if<HalfFace>(&document.selection())) {
    const auto corners = mesh.vertices(*f);
    selection = {{"kind", "face"},
                 {"vertices", {corners[0].index(), corners[1].index(), corners[2].index()}}};
  } else if (const auto* v = std::get_if<VertexHandle>(&document.selection())) {
    selection = {{"kind", "vertex"}, {"vertex", v->index()}};
  }
  json names = json::array();
  for (const NamedVertex& name : document.names()) {
    names.push_back({{"vertex", name.vertex.index()}, {"role", name.role}});
  }
  json legend = json::array();
  for (const LegendEntry& entry : document.legend()) legend.push_back(entry.text);
  json pointed = json::array();
  for (const VertexHandle v : document.pointed().vertices) pointed.push_back(v.index());
  const Scene& scene = document.scene();
  json reference;
  if (document.reference() != nullptr && document.view.scene.colour == kDistance) {
    reference = reference_state(document);
  }
  json trace;
  if (document.debugger() != nullptr) trace = trace_state_of(document);
  return {{"file", document.file()},
          {"tets", mesh.tet_count()},
          {"vertices", mesh.vertex_count()},
          {"bad", document.statistics().n_bad},
          {"theta_min", document.statistics().theta_min},
          {"theta_max", document.statistics().theta_max},
          {"shown", scene.tets_shown},
          {"bad_shown", scene.bad_shown},
          {"triangles", scene.surface.size() / 3},
          {"note", scene.note},
          {"run", to_string(document.live.state())},
          {"held_parameters", document.live.progress().held_parameters},
          {"title", document.title()},
          {"unsaved", document.has_unsaved()},
          {"recent", document.recent},
          {"trial", trial_state_of(document)},
          {"message", document.message.text},
          {"selection", selection},
          {"notes", document.notes()},
          {"names", names},
          {"legend", legend},
          {"pointed", pointed},
          {"teaching", document.teaching},
          {"reference", reference},
          {"trace", trace},
          {"view", to_json(document.view)}};
}

}  // namespace tetmend::viewer
