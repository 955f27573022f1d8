// SPDX-License-Identifier: MIT
// The place in a trace as JSON, for scripts and tests.
#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "explain/paper_lines.h"
#include "explain/removal.h"
#include "viewer/commands/commands.h"

namespace tetmend::viewer {

using nlohmann::json;

namespace {

/// Of each tet its vertices, ascending.
json vertices_of(const TetMesh& mesh, const std::vector<TetHandle>& tets) {
  json list = json::array();
  for (const TetHandle t : tets) {
    std::array<std::uint32_t, 4> numbers{};
    for (unsigned i = 0; i < 4; ++i) numbers[i] = mesh.vertices(t)[i].index();
    std::sort(numbers.begin(), numbers.end());
    list.push_back(numbers);
  }
  return list;
}

json covering_state(const FlatCovering& covering) {
  json triangles = json::array();
  for (const auto& t : covering.triangles) {
    triangles.push_back({{"corners", t.corners}, {"quality", t.quality}});
  }
  json core = json::array();
  for (const auto& side : covering.core) {
    core.push_back({{"from", side.from}, {"to", side.to}, {"quality", side.quality}});
  }
  return {{"triangles", triangles}, {"core", core}, {"worst", covering.worst}};
}

/// Of the shell as it is drawn.
json shell_state(const PolygonView& view) {
  const ShellPicture& s = *view.shell;
  json ring = json::array();
  for (const VertexHandle v : s.ring) ring.push_back(v.index());
  json result = {{"a", s.a.index()}, {"b", s.b.index()}, {"ring", ring}, {"floor", s.floor}};
  json locked = json::array();
  for (std::size_t i = 0; i < s.ring.size(); ++i) {
    if (((s.locks.vertices >> i) & 1u) != 0) locked.push_back(s.ring[i].index());
  }
  result["locked"] = locked;
  json chords = json::array();
  for (const Chord& chord : chords_of(s)) {
    chords.push_back({{"from", s.ring[chord.from].index()},
                      {"to", s.ring[chord.to].index()},
                      {"on", chord.on[0]},
                      {"back", chord.back[0]}});
  }
  result["chords"] = chords;
  json tables = json::object();
  for (std::size_t i = 0; i < s.tables.size; ++i) {
    for (std::size_t j = 0; j < s.tables.size; ++j) {
      const auto k = s.tables.k(i, j);
      if (k >= s.tables.size) continue;
      tables[fmt::format("{} {}", s.ring[i].index(), s.ring[j].index())] = {
          {"q", s.tables.q(i, j)}, {"k", s.ring[k].index()}};
    }
  }
  result["tables"] = tables;
  if (view.covering != nullptr) result["covering"] = covering_state(*view.covering);
  return result;
}

json call_state(Document& document, std::uint32_t number) {
  Debugger& debugger = *document.debugger();
  const TraceFile& file = debugger.file();
  const Call& call = file.calls()[number];
  const CallFacts& facts = debugger.facts(number);
  json target = json::array();
  for (const VertexHandle v : call.target()) target.push_back(v.index());
  const auto& stack = debugger.stack();
  const auto place =
      static_cast<std::size_t>(std::find(stack.begin(), stack.end(), number) - stack.begin());
  const CodePlace code = code_place(file, stack, place, debugger.position());
  return {{"number", number},
          {"operator", file.name(call.operator_name)},
          {"target", target},
          {"level", call.level},
          {"verdict", outcome_text(call, debugger.position())},
          {"undone_with", call.undone_with == kNoCall ? json() : json(call.undone_with)},
          {"degree_before", facts.degree_before},
          {"degree_after", facts.degree_after},
          {"line", code.line},
          {"goes_on", code.goes_on}};
}

}  // namespace

json trace_state_of(Document& document) {
  Debugger& debugger = *document.debugger();
  const Timeline::Sample& sample = debugger.timeline().at(debugger.position());
  json stack = json::array();
  for (const std::uint32_t call : debugger.stack()) stack.push_back(call_state(document, call));
  json breakpoints = json::array();
  for (const Breakpoint& b : debugger.breakpoints) breakpoints.push_back(to_text(b.condition));
  json bookmarks = json::array();
  for (const auto& mark : debugger.bookmarks) bookmarks.push_back(mark.first);
  json result = {
      {"position", debugger.position()},
      {"events", debugger.end()},
      {"calls", debugger.file().calls().size()},
      {"event", debugger.last_event()},
      {"stack", stack},
      {"call", stack.empty() ? json() : stack.back()},
      {"pass_line", pass_place(debugger.file(), debugger.stack(), debugger.position()).line},
      {"breakpoints", breakpoints},
      {"bookmarks", bookmarks},
      {"bad", sample.n_bad},
      {"q_worst", sample.q_worst}};
  if (debugger.found()) {
    result["found"] = {{"condition", to_text(debugger.found()->condition)},
                       {"calls", debugger.found()->calls.size()}};
  }
  if (debugger.other()) {
    const RunComparison& made = debugger.other()->comparison();
    result["against"] = {{"file", debugger.other()->name().string()},
                         {"bad_here", made.bad_in_a},
                         {"bad_there", made.bad_in_b},
                         {"bad_here_good_there", made.worse_in_a.size()}};
  }
  if (const auto visit = debugger.visit()) {
    const Visit& made = debugger.file().visits()[*visit];
    json tet = json::array();
    for (const VertexHandle v : made.tet) tet.push_back(v.index());
    result["visit"] = {{"number", *visit}, {"tet", tet}, {"quality", made.quality}};
  }
  const CallStudy* study = debugger.study();
  if (study == nullptr) return result;
  result["tets_before"] = study->before.size();
  result["tets_after"] = study->after.size();
  result["undone"] = study->undone;
  const auto removal = removal_of(debugger.file(), study->call);
  if (removal) result["removal"] = to_text(*removal);
  result["shell_of_caller"] = vertices_of(document.mesh(), document.shell_of_caller());
  const bool has_ended = debugger.position() >= debugger.file().calls()[study->call].events.end;
  result["reason"] = has_ended ? explain_end(debugger.file(), *study) : std::string();
  if (!study->picture) return result;
  const PolygonView polygon = debugger.polygon();
  if (polygon.shell->ring.size() >= 3) result["caption"] = polygon.caption;
  result["shell"] = shell_state(polygon);
  const TableFilling filling = debugger.tables();
  result["filling"] = {{"filled", filling.filled},
                       {"cells", filling.cells.size()},
                       {"is_under_way", filling.is_under_way},
                       {"text", to_text(*polygon.shell, filling)}};
  return result;
}

}  // namespace tetmend::viewer
