// SPDX-License-Identifier: MIT
// Commands that move through a trace.
#include <algorithm>
#include <array>
#include <sstream>

#include "kernel/grouped.h"
#include "viewer/commands/command_group.h"

namespace tetmend::viewer {

using nlohmann::json;

namespace {

/// Where a move has led, for the status line; the result of the command.
json arrive(Session& s, const std::string& text = {}) {
  s.document.show_trace();
  Debugger& debugger = *s.document.debugger();
  std::string here = text;
  if (here.empty()) {
    here = fmt::format("event {} of {}: {}", grouped(debugger.position()), grouped(debugger.end()),
                       debugger.last_event());
    const TableFilling filling = debugger.tables();
    if (filling.is_under_way) {
      here += fmt::format(", cell {} of {}", filling.filled, filling.cells.size());
    }
  }
  s.document.message = {here, false};
  return debugger.position();
}

json seek(Session& s, const json& a) {
  Debugger& debugger = need_trace(s.document);
  const Arguments arguments("seek", a);
  const double position = arguments.number(0);
  if (position < 0 || position > static_cast<double>(debugger.end())) {
    throw Error(
        fmt::format("seek: the trace has {} events, there is no {}", debugger.end(), position));
  }
  debugger.seek(static_cast<std::uint64_t>(position));
  return arrive(s);
}

json to_begin(Session& s, const json&) {
  need_trace(s.document).seek(0);
  return arrive(s);
}

json to_end(Session& s, const json&) {
  need_trace(s.document).seek(s.document.debugger()->end());
  return arrive(s);
}

template <Step How, Direction Where>
json move(Session& s, const json&) {
  Debugger& debugger = need_trace(s.document);
  debugger.playing = false;
  debugger.step(How, Where);
  return arrive(s);
}

Direction read_direction(const Arguments& arguments, std::size_t i) {
  if (!arguments.has(i)) return Direction::forward;
  const std::string word = arguments.text(i);
  if (word == "forward") return Direction::forward;
  if (word == "back") return Direction::back;
  throw Error(fmt::format("'{}' is no direction: expected forward or back", word));
}

json step(Session& s, const json& a) {
  constexpr std::array<std::string_view, 3> kWords = {"into", "over", "out"};
  Debugger& debugger = need_trace(s.document);
  const Arguments arguments("step", a);
  const std::string word = arguments.has(0) ? arguments.text(0) : "into";
  const auto found = std::find(kWords.begin(), kWords.end(), word);
  if (found == kWords.end()) {
    throw Error(fmt::format("step: '{}' is none of into, over, out", word));
  }
  debugger.step(static_cast<Step>(found - kWords.begin()), read_direction(arguments, 1));
  return arrive(s);
}

/// False, and a message, when there is no such place.
json run_to_condition(Session& s, const Condition& condition, Direction direction) {
  Debugger& debugger = need_trace(s.document);
  debugger.playing = false;
  if (debugger.run_to(condition, direction)) {
    arrive(s);
    return true;
  }
  s.document.message = {fmt::format("no '{}' {} here", to_text(condition),
                                    direction == Direction::forward ? "after" : "before"),
                        false, true};
  return false;
}

json run_to(Session& s, const json& a) {
  const Arguments arguments("run_to", a);
  return run_to_condition(s, parse_condition(arguments.text(0)), read_direction(arguments, 1));
}

template <Condition::Kind What, Direction Where>
json run_to_next(Session& s, const json&) {
  return run_to_condition(s, {{{What, {}, {}, {}}}, false}, Where);
}

/// "all": also those that a caller undid.
template <Direction Where>
json run_to_accepted(Session& s, const json& a) {
  const Arguments arguments("next_accepted", a);
  if (arguments.has(0) && arguments.text(0) != "all") {
    throw Error(fmt::format("'{}' is no kind of accepted calls: expected all, or nothing",
                            arguments.text(0)));
  }
  return run_to_condition(s, {{{Condition::Kind::accepted, {}, {}, {}}}, !arguments.has(0)}, Where);
}

template <Direction Where>
json run(Session& s, const json&) {
  Debugger& debugger = need_trace(s.document);
  // Who has listed the calls of a condition wants the next of them, and not the end.
  if (debugger.breakpoints.empty() && debugger.found()) {
    return run_to_condition(s, debugger.found()->condition, Where);
  }
  const auto stop = debugger.run(Where);
  return arrive(s, stop ? fmt::format("breakpoint: {}", to_text(*stop)) : std::string());
}

json enter(Session& s, const json& a) {
  Debugger& debugger = need_trace(s.document);
  debugger.enter(Arguments("enter", a).index(0, debugger.file().calls().size()));
  return arrive(s);
}

json deepest(Session& s, const json&) {
  Debugger& debugger = need_trace(s.document);
  const std::uint32_t call = debugger.deepest_call();
  if (call == kNoCall) throw Error("the trace has no calls");
  debugger.enter(call);
  arrive(s);
  return call;
}

/// Of the trace, or of live runs where there is none, or only their last calls.
std::vector<Breakpoint>& breakpoints_of(Document& document) {
  if (document.debugger() != nullptr && !document.debugs_live())
    return document.debugger()->breakpoints;
  return document.live.breakpoints;
}

json breakpoint(Session& s, const json& a) {
  const Condition condition = parse_condition(Arguments("breakpoint", a).text(0));
  const auto& terms = condition.terms;
  if (&breakpoints_of(s.document) == &s.document.live.breakpoints &&
      std::any_of(terms.begin(), terms.end(), is_about_record)) {
    throw Error(fmt::format("'{}' asks what became of a call: only recorded runs know",
                            to_text(condition)));
  }
  std::vector<Breakpoint>& all = breakpoints_of(s.document);
  const auto same = [&](const Breakpoint& b) { return b.condition == condition; };
  if (std::erase_if(all, same) == 0) all.push_back({condition});
  s.document.live.tell_breakpoints();
  return all.size();
}

json clear_breakpoints(Session& s, const json&) {
  breakpoints_of(s.document).clear();
  s.document.live.tell_breakpoints();
  return nullptr;
}

json bookmark(Session& s, const json& a) {
  Debugger& debugger = need_trace(s.document);
  const std::uint64_t here = debugger.position();
  if (a.empty() && debugger.bookmarks.erase(here) > 0) return nullptr;
  debugger.bookmarks[here] = a.empty() ? debugger.last_event() : Arguments("bookmark", a).text(0);
  return nullptr;
}

template <Direction Where>
json to_bookmark(Session& s, const json&) {
  Debugger& debugger = need_trace(s.document);
  const auto& marks = debugger.bookmarks;
  auto mark = Where == Direction::forward ? marks.upper_bound(debugger.position())
                                          : marks.lower_bound(debugger.position());
  if (Where == Direction::back) mark = mark == marks.begin() ? marks.end() : std::prev(mark);
  if (mark == marks.end()) throw Error("no further bookmark");
  const std::string name = mark->second;
  debugger.seek(mark->first);
  return arrive(s, name);
}

template <Direction Where>
json to_lesson_step(Session& s, const json&) {
  Debugger& debugger = need_trace(s.document);
  if (!debugger.lesson()) throw Error("no lesson lies beside this trace");
  const auto& steps = debugger.lesson()->steps;
  const auto now = step_at(*debugger.lesson(), debugger.position());
  std::size_t next = now ? *now + 1 : 0;
  if (Where == Direction::back) {
    // Several steps may be at one position: the window shows them together.
    const auto before = std::find_if(steps.rbegin(), steps.rend(), [&](const LessonStep& step) {
      return step.at < debugger.position();
    });
    if (before == steps.rend()) throw Error("this is the beginning of the lesson");
    next = static_cast<std::size_t>(steps.rend() - before) - 1;
  }
  if (next >= steps.size()) throw Error("this is the end of the lesson");
  debugger.seek(steps[next].at);
  json here = arrive(s);
  // What it speaks of may leave the picture less room, or more.
  const Canvas before = s.document.canvas;
  s.host.arrange(s.document);
  const Canvas& now_there = s.document.canvas;
  const bool is_other = now_there.width != before.width || now_there.height != before.height;
  if (is_other && s.document.follow_trace) s.document.fit();
  return here;
}

/// "accepted", 3, "2 7"
json answer(Session& s, const json& a) {
  const Arguments arguments("answer", a);
  const bool is_number = arguments.has(0) && a[0].is_number();
  const LessonQuestion& asked =
      need_trace(s.document).answer(is_number ? a[0].dump() : arguments.text(0));
  s.document.message = {*asked.is_right ? "right" : "not so", false};
  return {{"right", *asked.is_right}, {"why", asked.question.why}};
}

json play(Session& s, const json&) {
  Debugger& debugger = need_trace(s.document);
  debugger.playing = !debugger.playing && debugger.position() < debugger.end();
  return nullptr;
}

template <int Direction>
json change_speed(Session& s, const json&) {
  constexpr double kSlowest = 0.25;
  constexpr double kFastest = 1 << 16;
  double& speed = need_trace(s.document).speed;
  speed = std::clamp(Direction > 0 ? speed * 2 : speed / 2, kSlowest, kFastest);
  s.document.message = {fmt::format("{} events a second", speed), false};
  return nullptr;
}

/// Of a mesh without a trace: the selection.
json isolate(Session& s, const json&) {
  need_mesh(s.document);
  s.document.toggle_isolation();
  return nullptr;
}

json follow(Session& s, const json&) {
  need_trace(s.document);
  s.document.follow_trace = !s.document.follow_trace;
  s.document.message = {
      s.document.follow_trace ? "the camera follows the calls" : "the camera stays where it is",
      false};
  return nullptr;
}

json teaching(Session& s, const json&) {
  need_trace(s.document);
  s.document.teaching = !s.document.teaching;
  return nullptr;
}

/// "vertex 5", "edge 3 17", "face 1 2 3", "tet 1 2 3 4" by its vertices, or "call 12"; nothing to end
/// it.
json point_at(Session& s, const json& a) {
  need_mesh(s.document);
  if (a.empty()) {
    s.document.point_at({});
    return nullptr;
  }
  constexpr std::array<std::string_view, 4> kKinds = {"vertex", "edge", "face", "tet"};
  const std::string text = Arguments("point_at", a).text(0);
  std::istringstream in(text);
  std::string kind;
  in >> kind;
  std::vector<VertexHandle> vertices;
  for (std::uint32_t number = 0; in >> number;) vertices.emplace_back(number);
  if (kind == "call" && vertices.size() == 1) {
    const std::size_t calls = need_trace(s.document).file().calls().size();
    const std::uint32_t call = vertices[0].index();
    if (call >= calls) throw Error(fmt::format("point_at: the trace has {} calls", calls));
    s.document.point_at(s.document.pointed_call(call));
    return nullptr;
  }
  const auto found = std::find(kKinds.begin(), kKinds.end(), kind);
  const auto size = static_cast<std::size_t>(found - kKinds.begin()) + 1;
  if (found == kKinds.end() || vertices.size() != size || !in.eof()) {
    throw Error(fmt::format(
        "point_at: '{}' is not understood: vertex, edge, face or tet with its vertices, or call "
        "NUMBER",
        text));
  }
  for (const VertexHandle v : vertices) {
    const TetMesh& mesh = s.document.mesh();
    if (v.index() >= mesh.vertex_slots() || mesh.is_deleted(v)) {
      throw Error(fmt::format("point_at: there is no vertex {}", v.index()));
    }
  }
  s.document.point_at({std::move(vertices)});
  return nullptr;
}

json tables(Session& s, const json&) {
  Debugger& debugger = need_trace(s.document);
  debugger.shows_tables = !debugger.shows_tables;
  s.document.show_trace();
  return nullptr;
}

json blend(Session& s, const json& a) {
  need_trace(s.document);
  ViewSettings& view = s.document.view;
  view.blended = a.empty() ? !view.blended : true;
  if (!a.empty()) apply_json(view, {{"blend", a[0]}});
  return nullptr;
}

constexpr std::string_view kTrace = "Trace";
constexpr auto kForward = Direction::forward;
constexpr auto kBack = Direction::back;

constexpr std::array kTraceCommands = {
    Command{"seek", "", "", "seek(EVENTS)", "Go to the place where so many events have happened",
            &seek},
    Command{"step", "", "", "step(\"over\", \"back\")",
            "Step \"into\", \"over\" or \"out\", forward or back; the result is the place", &step},
    Command{"step_into", "Right", kTrace, "step_into()",
            "One event on, or one cell of the tables that are looked at",
            &move<Step::into, kForward>},
    Command{"back_into", "Left", kTrace, "back_into()", "One event back", &move<Step::into, kBack>},
    Command{"step_over", "Down", kTrace, "step_over()", "One event on, over a whole call",
            &move<Step::over, kForward>},
    Command{"back_over", "Up", kTrace, "back_over()", "One event back, over a whole call",
            &move<Step::over, kBack>},
    Command{"step_out", "PageDown", kTrace, "step_out()", "To the end of the call",
            &move<Step::out, kForward>},
    Command{"back_out", "PageUp", kTrace, "back_out()", "To before the call",
            &move<Step::out, kBack>},
    Command{"to_begin", "Home", kTrace, "to_begin()", "To the beginning of the trace", &to_begin},
    Command{"to_end", "End", kTrace, "to_end()", "To the end of the trace", &to_end},
    Command{"play", "Space", kTrace, "play()", "Play, or stop playing", &play},
    Command{"faster", ">", kTrace, "faster()", "Play twice as fast", &change_speed<1>},
    Command{"slower", "<", kTrace, "slower()", "Play half as fast", &change_speed<-1>},
    Command{"run", "Enter", kTrace, "run()", "To the next breakpoint, or to the end",
            &run<kForward>},
    Command{"run_back", "Backspace", kTrace, "run_back()",
            "Back to the last breakpoint, or to the beginning", &run<kBack>},
    Command{"run_to", "", "", "run_to(\"edge 3 17\", \"back\")",
            "To the next place of a condition, see Conditions; false if there is none", &run_to},
    Command{"next_accepted", "J", kTrace, "next_accepted()",
            "To the next call that was accepted for good; \"all\": or undone with a caller",
            &run_to_accepted<kForward>},
    Command{"last_accepted", "Shift+J", kTrace, "last_accepted()",
            "To the call before that was accepted for good; \"all\": or undone with a caller",
            &run_to_accepted<kBack>},
    Command{"next_refused", "U", kTrace, "next_refused()", "To the next refused call",
            &run_to_next<Condition::Kind::refused, kForward>},
    Command{"last_refused", "Shift+U", kTrace, "last_refused()", "To the refused call before",
            &run_to_next<Condition::Kind::refused, kBack>},
    Command{"enter", "", "", "enter(CALL)", "To the beginning of a call", &enter},
    Command{"deepest", "D", kTrace, "deepest()",
            "To the deepest call of all; the result is its number", &deepest},
    Command{"breakpoint", "", "", "breakpoint(\"deeper 2\")",
            "Set a breakpoint, or take it away; of live runs while no trace is open", &breakpoint},
    Command{"clear_breakpoints", "", "", "clear_breakpoints()", "Take all breakpoints away",
            &clear_breakpoints},
    Command{"bookmark", "L", kTrace, "bookmark(\"NAME\")",
            "Set a bookmark here; without a name, or by the key, take one away that is here",
            &bookmark},
    Command{"next_bookmark", ".", kTrace, "next_bookmark()", "To the next bookmark",
            &to_bookmark<kForward>},
    Command{"last_bookmark", ",", kTrace, "last_bookmark()", "To the bookmark before",
            &to_bookmark<kBack>},
    Command{"next_lesson_step", "Shift+L", kTrace, "next_lesson_step()",
            "To the next step of the lesson", &to_lesson_step<kForward>},
    Command{"last_lesson_step", "Shift+K", kTrace, "last_lesson_step()",
            "To the step of the lesson before", &to_lesson_step<kBack>},
    Command{"answer", "", "", "answer(\"accepted\")",
            "Answer the question of the lesson here: \"accepted\" or \"refused\", a line, a "
            "number, or a "
            "chord as \"2 7\"; the result has right and why",
            &answer},
    Command{"isolate", "I", kTrace, "isolate()",
            "Show only the tets of the call at hand, or of the selection", &isolate},
    Command{"follow", "Shift+F", kTrace, "follow()",
            "The camera goes to each call that it does not see, or stays", &follow},
    Command{"teaching", "Shift+T", kTrace, "teaching()",
            "Layout for teaching: large text, the picture, the shell, the algorithm", &teaching},
    Command{"point_at", "", "", "point_at(\"edge 3 17\")",
            "Light up a vertex, edge, face or tet by its vertices, or a call, in all views",
            &point_at},
    Command{"tables", "", kTrace, "tables()",
            "The tables of Algorithm 2 are looked at, and filled by steps", &tables},
    Command{"blend", "V", kTrace, "blend(0.5)",
            "The shell before and after side by side, or blended", &blend},
};

}  // namespace

std::span<const Command> trace_commands() {
  return kTraceCommands;
}

}  // namespace tetmend::viewer
