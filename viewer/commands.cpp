// SPDX-License-Identifier: MIT
#include "viewer/commands.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/workspace.h"

namespace tetmend::viewer {

using nlohmann::json;

namespace {

/// Reads the arguments of a command by position.
class Arguments {
 public:
  Arguments(std::string_view command, const json& values) : command_(command), values_(values) {}

  bool has(std::size_t i) const { return i < values_.size() && !values_[i].is_null(); }
  double number(std::size_t i) const {
    if (!has(i) || !values_[i].is_number()) fail(i, "a number");
    return values_[i].get<double>();
  }
  std::uint32_t index(std::size_t i, std::size_t bound) const {
    const double n = number(i);
    if (n != std::floor(n) || n < 0 || n >= static_cast<double>(bound)) {
      fail(i, fmt::format("a whole number from 0 to {}", bound == 0 ? 0 : bound - 1));
    }
    return static_cast<std::uint32_t>(n);
  }
  std::string text(std::size_t i) const {
    if (!has(i) || !values_[i].is_string()) fail(i, "a text");
    return values_[i].get<std::string>();
  }
  const json& value(std::size_t i) const { return values_[i]; }

 private:
  [[noreturn]] void fail(std::size_t i, std::string_view expected) const {
    throw Error(fmt::format("{}: argument {} must be {}, not {}; it is used as {}", command_, i + 1,
                            expected, has(i) ? values_[i].dump() : "missing",
                            find_command(command_).usage));
  }

  std::string_view command_;
  const json& values_;
};

void need_mesh(const Document& document) {
  if (!document.has_mesh()) throw Error("there is no mesh yet: open one first");
}

VertexHandle read_vertex(const Document& document, const Arguments& arguments, std::size_t i) {
  const VertexHandle v(arguments.index(i, document.mesh().vertex_slots()));
  if (document.mesh().is_deleted(v)) throw Error(fmt::format("there is no vertex {}", v.index()));
  return v;
}

// ---- File ---------------------------------------------------------------------------------------

json open(Session& s, const json& a) {
  if (a.empty()) {
    s.document.ask_for_file = true;
  } else {
    s.document.open(Arguments("open", a).text(0));
  }
  return nullptr;
}

json compare(Session& s, const json& a) {
  s.document.compare_with(Arguments("compare", a).text(0));
  return nullptr;
}

json reload(Session& s, const json&) {
  need_mesh(s.document);
  s.document.open(std::string(s.document.file()));
  return nullptr;
}

json screenshot(Session& s, const json& a) {
  const std::string file = a.empty() ? "tetmend-view.png" : Arguments("screenshot", a).text(0);
  write_png(file, s.host.render(s.document));
  s.document.message = {"wrote " + file, false};
  return nullptr;
}

json copy_view(Session& s, const json&) {
  s.host.set_clipboard(to_json(s.document.view).dump(2));
  s.document.message = {"the view is on the clipboard, as JSON", false};
  return nullptr;
}

json paste_view(Session& s, const json&) {
  apply_json_text(s.document.view, s.host.clipboard());
  s.document.message = {"view taken from the clipboard", false};
  return nullptr;
}

json quit(Session& s, const json&) {
  s.document.quit = true;
  return nullptr;
}

// ---- View ---------------------------------------------------------------------------------------

json home(Session& s, const json&) {
  s.document.go_home();
  return nullptr;
}

json fit(Session& s, const json&) {
  s.document.fit();
  return nullptr;
}

json look_from(Session& s, const json& a) {
  s.document.view.camera.look_from(Arguments("look_from", a).text(0));
  return nullptr;
}

template <char Sign, char Axis>
json look_along(Session& s, const json&) {
  s.document.view.camera.look_from(std::string{Sign, Axis});
  return nullptr;
}

json orthographic(Session& s, const json&) {
  s.document.view.camera.orthographic = !s.document.view.camera.orthographic;
  return nullptr;
}

json theme(Session& s, const json& a) {
  std::string& now = s.document.view.theme;
  if (a.empty()) {
    now = now == "light" ? "dark" : "light";
  } else {
    apply_json(s.document.view, {{"theme", a[0]}});
  }
  return nullptr;
}

json panels(Session& s, const json&) {
  s.document.show_panels = !s.document.show_panels;
  return nullptr;
}

json keys(Session& s, const json&) {
  s.document.show_keys = !s.document.show_keys;
  return nullptr;
}

json view(Session& s, const json& a) {
  if (!a.empty()) apply_json(s.document.view, a[0]);
  return to_json(s.document.view);
}

json size(Session& s, const json& a) {
  constexpr std::size_t kMost = 8192;
  const Arguments arguments("size", a);
  s.document.resize({static_cast<int>(std::max(1U, arguments.index(0, kMost + 1))),
                     static_cast<int>(std::max(1U, arguments.index(1, kMost + 1)))});
  return nullptr;
}

// ---- Show ---------------------------------------------------------------------------------------

template <bool SceneSettings::*Switch>
json toggle(Session& s, const json&) {
  bool& value = s.document.view.scene.*Switch;
  value = !value;
  return nullptr;
}

json edges(Session& s, const json&) {
  s.document.view.edges = !s.document.view.edges;
  return nullptr;
}

json ghosts(Session& s, const json& a) {
  constexpr double kFaint = 0.15;
  if (!a.empty()) {
    apply_json(s.document.view, {{"ghosts", a[0]}});
  } else {
    double& value = s.document.view.scene.ghosts;
    value = value > 0 ? 0 : kFaint;
  }
  return nullptr;
}

/// "region", then the measures.
json colour(Session& s, const json& a) {
  std::string& now = s.document.view.scene.colour;
  if (!a.empty()) {
    apply_json(s.document.view, {{"colour", a[0]}});
    if (now != "region") s.document.view.scene.measure = now;
    return nullptr;
  }
  std::vector<std::string> names = {"region"};
  for (const QualityMeasure& m : quality_measures()) names.emplace_back(m.name);
  const auto found = std::find(names.begin(), names.end(), now);
  const auto next = found + 1 == names.end() ? names.begin() : found + 1;
  return colour(s, json::array({*next}));
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
  if (!a.empty()) {
    apply_json(s.document.view, {{"shrink", a[0]}});
  } else {
    double& value = s.document.view.scene.shrink;
    value = value > 0 ? 0 : kUsual;
  }
  return nullptr;
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
  return nullptr;
}

// ---- Select -------------------------------------------------------------------------------------

json pick(Session& s, const json& a) {
  const Arguments arguments("pick", a);
  s.document.pick(arguments.number(0), arguments.number(1));
  return state_of(s.document)["selection"];
}

json pick_kind(Session& s, const json& a) {
  constexpr std::array<std::string_view, 4> kNames = {"nearest", "tet", "edge", "vertex"};
  auto next = (static_cast<std::size_t>(s.document.pick_kind) + 1) % kNames.size();
  if (!a.empty()) {
    const std::string name = Arguments("pick_kind", a).text(0);
    next = static_cast<std::size_t>(std::find(kNames.begin(), kNames.end(), name) - kNames.begin());
    if (next == kNames.size()) {
      throw Error(fmt::format("pick_kind: '{}' is none of nearest, tet, edge, vertex", name));
    }
  }
  s.document.pick_kind = static_cast<PickKind>(next);
  s.document.message = {fmt::format("a click picks: {}", kNames[next]), false};
  return nullptr;
}

json select_tet(Session& s, const json& a) {
  const TetHandle t(Arguments("select_tet", a).index(0, s.document.mesh().tet_slots()));
  if (s.document.mesh().is_deleted(t)) throw Error(fmt::format("there is no tet {}", t.index()));
  s.document.select(t);
  return nullptr;
}

json select_vertex(Session& s, const json& a) {
  s.document.select(read_vertex(s.document, Arguments("select_vertex", a), 0));
  return nullptr;
}

json select_edge(Session& s, const json& a) {
  const Arguments arguments("select_edge", a);
  const VertexHandle from = read_vertex(s.document, arguments, 0);
  const VertexHandle to = read_vertex(s.document, arguments, 1);
  Workspace workspace(s.document.mesh());
  std::optional<TetEdge> edge;
  if (from != to && s.document.mesh().tet_of(from).is_valid()) {
    edge = find_edge(s.document.mesh(), from, to, workspace);
  }
  if (!edge) throw Error(fmt::format("there is no edge {} - {}", from.index(), to.index()));
  s.document.select(*edge);
  return nullptr;
}

json deselect(Session& s, const json&) {
  s.document.show_keys = false;
  s.document.select({});
  return nullptr;
}

json worst(Session& s, const json& a) {
  need_mesh(s.document);
  const std::uint32_t n =
      a.empty() ? 1 : Arguments("worst", a).index(0, Document::kWorstListed + 1);
  if (n == 0) throw Error("worst: the worst tet is number 1");
  s.document.fly_to_worst(n - 1);
  return s.document.worst()[n - 1].index();
}

template <int Direction>
json step_worst(Session& s, const json&) {
  need_mesh(s.document);
  const auto place = s.document.place_among_worst();
  const auto count = static_cast<int>(s.document.worst().size());
  const int next = place ? static_cast<int>(*place) + Direction : (Direction > 0 ? 0 : count - 1);
  s.document.fly_to_worst(static_cast<std::size_t>((next + count) % count));
  return nullptr;
}

// ---- For scripts --------------------------------------------------------------------------------

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

constexpr std::string_view kFile = "File";
constexpr std::string_view kView = "View";
constexpr std::string_view kShow = "Show";
constexpr std::string_view kSelect = "Select";

constexpr std::array kCommands = {
    Command{"open", "Ctrl+O", kFile, "open(\"FILE\")", "Open a mesh", &open},
    Command{"reload", "F5", kFile, "reload()", "Read the file again", &reload},
    Command{"compare", "", "", "compare(\"FILE\")",
            "Show the statistics of another mesh beside: the state before", &compare},
    Command{"screenshot", "P", kFile, "screenshot(\"FILE.png\")",
            "Write the picture; without a name to tetmend-view.png", &screenshot},
    Command{"copy_view", "Ctrl+C", kFile, "copy_view()", "Copy the view as JSON", &copy_view},
    Command{"paste_view", "Ctrl+V", kFile, "paste_view()", "Take the view from the clipboard",
            &paste_view},
    Command{"quit", "Ctrl+Q", kFile, "quit()", "Quit", &quit},

    Command{"home", "H", kView, "home()", "Whole mesh from the home direction", &home},
    Command{"fit", "F", kView, "fit()", "Fit the selection, or the whole mesh", &fit},
    Command{"from_right", "1", kView, "from_right()", "Look from +x", &look_along<'+', 'x'>},
    Command{"from_left", "2", kView, "from_left()", "Look from -x", &look_along<'-', 'x'>},
    Command{"from_back", "3", kView, "from_back()", "Look from +y", &look_along<'+', 'y'>},
    Command{"from_front", "4", kView, "from_front()", "Look from -y", &look_along<'-', 'y'>},
    Command{"from_top", "5", kView, "from_top()", "Look from +z", &look_along<'+', 'z'>},
    Command{"from_bottom", "6", kView, "from_bottom()", "Look from -z", &look_along<'-', 'z'>},
    Command{"look_from", "", "", "look_from(\"+x\")", "Look from a side, or \"home\"", &look_from},
    Command{"orthographic", "O", kView, "orthographic()", "Orthographic or perspective",
            &orthographic},
    Command{"theme", "T", kView, "theme(\"dark\")", "Light or dark", &theme},
    Command{"panels", "Tab", kView, "panels()", "Panels on or off", &panels},
    Command{"keys", "F1", kView, "keys()", "This list of keys", &keys},
    Command{"view", "", "", "view{peel = 2}",
            "Change settings by name; the result is the whole view", &view},
    Command{"size", "", "", "size(WIDTH, HEIGHT)", "Size of the picture in pixels", &size},

    Command{"edges", "E", kShow, "edges()", "Edges on or off", &edges},
    Command{"bad", "B", kShow, "bad()", "Bad tets in red, seen through the rest",
            &toggle<&SceneSettings::bad>},
    Command{"constraints", "C", kShow, "constraints()", "Constraint faces inside the volume",
            &toggle<&SceneSettings::constraints>},
    Command{"ghosts", "G", kShow, "ghosts(0.15)", "Ghosts of hidden tets; opacity", &ghosts},
    Command{"colour", "M", kShow, "colour(\"min_sine\")",
            "Colour by region or by a measure; the key takes the next", &colour},
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
    Command{"show_all", "A", kShow, "show_all()", "No filter, cut, peeling or shrinking",
            &show_all},

    Command{"pick", "", "", "pick(X, Y)", "Select what lies under a pixel; the result tells what",
            &pick},
    Command{"pick_kind", "Q", kSelect, "pick_kind(\"edge\")",
            "A click picks what is nearest, tets, edges, or vertices", &pick_kind},
    Command{"select_tet", "", "", "select_tet(NUMBER)", "Select a tet; numbers count from 0",
            &select_tet},
    Command{"select_edge", "", "", "select_edge(FROM, TO)", "Select the edge of two vertices",
            &select_edge},
    Command{"select_vertex", "", "", "select_vertex(NUMBER)", "Select a vertex", &select_vertex},
    Command{"deselect", "Escape", kSelect, "deselect()", "Select nothing", &deselect},
    Command{"worst", "W", kSelect, "worst(N)",
            "Select the N-th worst tet and go there; the result is its number", &worst},
    Command{"next_worst", "N", kSelect, "next_worst()", "Go to the next worst tet", &step_worst<1>},
    Command{"previous_worst", "Shift+N", kSelect, "previous_worst()", "Go to the one before",
            &step_worst<-1>},

    Command{"state", "", "", "state()", "Counts, selection and view, as a table", &state},
    Command{"locate", "", "", "locate()", "Pixel of the selection: a table of x and y", &locate},
    Command{"red_pixels", "", "", "red_pixels(X, Y, RADIUS)",
            "Number of red pixels near a pixel, or in the whole picture", &red_pixels},
    Command{"pixel", "", "", "pixel(X, Y)", "Colour of a pixel: red, green, blue", &pixel},
    Command{"expect", "", "", "expect(CONDITION, \"TEXT\")", "Ends the script with an error if not",
            &expect},
};

constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kGestures = {
    {{"drag", "orbit"},
     {"right drag, or Shift + drag", "pan"},
     {"wheel", "zoom to the mouse"},
     {"click", "pick"},
     {"double click", "pick and fit"},
     {"drag over the histogram", "filter; click there: filter off"},
     {"drop a file", "open it; a .json file is a view"}}};

}  // namespace

std::span<const Command> commands() {
  return kCommands;
}

const Command& find_command(std::string_view name) {
  return *std::find_if(kCommands.begin(), kCommands.end(),
                       [&](const Command& c) { return c.name == name; });
}

const Command* command_for_keys(std::string_view keys) {
  for (const Command& command : kCommands) {
    if (!keys.empty() && command.keys == keys) return &command;
  }
  return nullptr;
}

void run_from_window(const Command& command, Session& session) {
  try {
    command.run(session, json::array());
  } catch (const Error& error) {
    session.document.message = {error.what(), true};
  }
}

std::string command_reference() {
  std::string text = "| Key | Effect |\n|---|---|\n";
  for (const auto& gesture : kGestures) {
    text += fmt::format("| {} | {} |\n", gesture.first, gesture.second);
  }
  for (const Command& c : kCommands) {
    if (!c.keys.empty()) text += fmt::format("| `{}` | {} |\n", c.keys, c.help);
  }
  text += "\n| Word | Effect |\n|---|---|\n";
  for (const Command& c : kCommands) text += fmt::format("| `{}` | {} |\n", c.usage, c.help);
  return text;
}

std::span<const std::pair<std::string_view, std::string_view>> mouse_gestures() {
  return kGestures;
}

json state_of(Document& document) {
  json selection = {{"kind", "nothing"}};
  const TetMesh& mesh = document.mesh();
  if (const auto* t = std::get_if<TetHandle>(&document.selection())) {
    selection = {{"kind", "tet"}, {"tet", t->index()}, {"quality", mesh.quality(*t)}};
  } else if (const auto* e = std::get_if<TetEdge>(&document.selection())) {
    const auto ends = mesh.vertices(*e);
    selection = {{"kind", "edge"}, {"from", ends[0].index()}, {"to", ends[1].index()}};
  } else if (const auto* v = std::get_if<VertexHandle>(&document.selection())) {
    selection = {{"kind", "vertex"}, {"vertex", v->index()}};
  }
  const Scene& scene = document.scene();
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
          {"message", document.message.text},
          {"selection", selection},
          {"view", to_json(document.view)}};
}

}  // namespace tetmend::viewer
