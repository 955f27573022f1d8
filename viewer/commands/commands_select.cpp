// SPDX-License-Identifier: MIT
// Commands that pick and select.
#include <algorithm>
#include <array>
#include <sstream>

#include "kernel/shell.h"
#include "kernel/workspace.h"
#include "viewer/commands/command_group.h"

namespace tetmend::viewer {

using nlohmann::json;

namespace {

VertexHandle read_vertex(const Document& document, const Arguments& arguments, std::size_t i) {
  const VertexHandle v(arguments.index(i, document.mesh().vertex_slots()));
  if (document.mesh().is_deleted(v)) throw Error(fmt::format("there is no vertex {}", v.index()));
  return v;
}

json pick(Session& s, const json& a) {
  const Arguments arguments("pick", a);
  s.document.pick(arguments.number(0), arguments.number(1));
  return state_of(s.document)["selection"];
}

json pick_kind(Session& s, const json& a) {
  constexpr std::array<std::string_view, 5> kNames = {"nearest", "tet", "edge", "face", "vertex"};
  auto next = (static_cast<std::size_t>(s.document.pick_kind) + 1) % kNames.size();
  if (!a.empty()) {
    const std::string name = Arguments("pick_kind", a).text(0);
    next = static_cast<std::size_t>(std::find(kNames.begin(), kNames.end(), name) - kNames.begin());
    if (next == kNames.size()) {
      throw Error(fmt::format("pick_kind: '{}' is none of nearest, tet, edge, face, vertex", name));
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

json select_face(Session& s, const json& a) {
  const Arguments arguments("select_face", a);
  std::array<VertexHandle, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = read_vertex(s.document, arguments, i);
  const Selection face = s.document.selection_of(corners);
  if (!std::holds_alternative<HalfFace>(face)) {
    throw Error(fmt::format("there is no face {} {} {}", corners[0].index(), corners[1].index(),
                            corners[2].index()));
  }
  s.document.select(face);
  return nullptr;
}

/// What "tet 17", "edge 3 17", "vertex 5" or "17" name in the mesh. @throws Error otherwise.
json go_to(Session& s, const json& a) {
  need_mesh(s.document);
  if (a.empty()) {
    s.document.ask_place = true;
    return nullptr;
  }
  const std::string text = Arguments("go_to", a).text(0);
  std::string words = text;
  std::replace(words.begin(), words.end(), '-', ' ');  // "edge 3-17"
  std::istringstream in(words);
  std::string kind = "tet";
  if (words.find_first_not_of("0123456789 ") != std::string::npos) in >> kind;
  json numbers = json::array();
  for (std::uint32_t number = 0; in >> number;) numbers.push_back(number);
  const bool is_whole = in.eof();
  if (is_whole && kind == "tet" && numbers.size() == 1) {
    select_tet(s, numbers);
  } else if (is_whole && kind == "edge" && numbers.size() == 2) {
    select_edge(s, numbers);
  } else if (is_whole && kind == "face" && numbers.size() == 3) {
    select_face(s, numbers);
  } else if (is_whole && kind == "vertex" && numbers.size() == 1) {
    select_vertex(s, numbers);
  } else {
    throw Error(fmt::format(
        "go_to: '{}' is not understood: tet NUMBER, edge FROM TO, face A B C or vertex NUMBER",
        text));
  }
  s.document.fly_to(Selection(s.document.selection()));
  return state_of(s.document)["selection"];
}

json deselect(Session& s, const json&) {
  s.document.show_keys = false;
  s.document.end_alone();
  s.document.select({});
  return nullptr;
}

/// Of each place its bad tets, all its tets and the worst.
json bad_places(Session& s, const json& a) {
  need_mesh(s.document);
  const auto& places = s.document.bad_places();
  if (!a.empty()) {
    const std::uint32_t n = Arguments("bad_places", a).index(0, places.size() + 1);
    if (n == 0) throw Error("bad_places: the first place is number 1");
    s.document.fly_to_place(n - 1);
  }
  json list = json::array();
  for (const BadPlace& place : places) {
    const auto& c = place.ball.centre;
    list.push_back({{"bad", place.bad},
                    {"tets", place.tets},
                    {"worst", place.worst.index()},
                    {"q_worst", place.q_worst},
                    {"centre", {c.x, c.y, c.z}}});
  }
  return list;
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

constexpr std::string_view kSelect = "Select";

constexpr std::array kSelectCommands = {
    Command{"pick", "", "", "pick(X, Y)", "Select what lies under a pixel; the result tells what",
            &pick},
    Command{"pick_kind", "Q", kSelect, "pick_kind(\"edge\")",
            "A click picks what is nearest, tets, edges, faces, or vertices", &pick_kind},
    Command{"select_tet", "", "", "select_tet(NUMBER)", "Select a tet; numbers count from 0",
            &select_tet},
    Command{"select_edge", "", "", "select_edge(FROM, TO)", "Select the edge of two vertices",
            &select_edge},
    Command{"select_face", "", "", "select_face(A, B, C)", "Select the face of three vertices",
            &select_face},
    Command{"select_vertex", "", "", "select_vertex(NUMBER)", "Select a vertex", &select_vertex},
    Command{"go_to", "Ctrl+G", kSelect, "go_to(\"edge 3 17\")",
            "Select a tet NUMBER, an edge FROM TO, a face A B C or a vertex NUMBER, and go there",
            &go_to},
    Command{"deselect", "Escape", kSelect, "deselect()", "Select nothing", &deselect},
    Command{"worst", "W", kSelect, "worst(N)",
            "Show the N-th worst tet alone, from where it is seen best; the result is its number",
            &worst},
    Command{"bad_places", "", "", "bad_places(N)",
            "Where bad tets are many: a table of counts by place; goes to the N-th", &bad_places},
    Command{"next_worst", "N", kSelect, "next_worst()", "Go to the next worst tet", &step_worst<1>},
    Command{"previous_worst", "Shift+N", kSelect, "previous_worst()", "Go to the one before",
            &step_worst<-1>},
};

}  // namespace

std::span<const Command> select_commands() {
  return kSelectCommands;
}

}  // namespace tetmend::viewer
