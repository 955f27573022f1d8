// SPDX-License-Identifier: MIT
// Questions to a trace: what it knows of one tet, face, edge or vertex.
#include <algorithm>
#include <array>

#include <fmt/ranges.h>

#include "explain/call_facts.h"
#include "explain/json_text.h"
#include "viewer/commands/command_group.h"

namespace tetmend::viewer {

using nlohmann::json;

namespace {

/// Vertices that are selected, or a table of numbers, as find_subject() reads them.
std::string subject_of_selection(const Document& document) {
  const Pointed selected = document.pointed_selection(document.selection());
  if (!selected.vertices.empty()) return as_question(selected.vertices);
  throw Error("history: select a tet, an edge or a vertex, or name one");
}

std::uint32_t whole_number(const json& value, bool from_file) {
  const double number = value.is_number() ? value.get<double>() : -1;
  if (number < 0 || number != std::floor(number) || number > 4e9) {
    throw Error(
        fmt::format("history: {} is no number of a tet or vertex", explain::json_text(value)));
  }
  return static_cast<std::uint32_t>(number) + (from_file ? 1 : 0);
}

/// {tet = 17, file = "o.mesh"}. In the viewer all numbers count from 0, for find_subject() those of
/// files from 1.
std::string subject_of_table(const json& table) {
  constexpr std::array<std::string_view, 4> kKinds = {"tet", "face", "edge", "vertex"};
  std::string subject;
  std::string file;
  if (const auto found = table.find("file"); found != table.end()) {
    if (!found->is_string()) throw Error("history: 'file' must be the name of a mesh");
    file = found->get<std::string>();
  }
  for (const auto& item : table.items()) {
    if (item.key() == "file") continue;
    const bool is_kind = std::find(kKinds.begin(), kKinds.end(), item.key()) != kKinds.end();
    if (!is_kind || !subject.empty()) {
      throw Error(fmt::format("history: '{}' is not expected; valid: one of {}, and file",
                              item.key(), fmt::join(kKinds, ", ")));
    }
    subject = item.key() + ":";
    if (item.value() == "worst") {
      subject += "worst";
      continue;
    }
    const json numbers = item.value().is_array() ? item.value() : json::array({item.value()});
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      subject += fmt::format("{}{}", i == 0 ? "" : ",", whole_number(numbers[i], !file.empty()));
    }
  }
  if (subject.empty()) throw Error("history: name a tet, face, edge or vertex");
  return file.empty() ? subject : subject + "@" + file;
}

json numbers_of(const HistorySubject& subject) {
  json numbers = json::array();
  for (const VertexHandle v : subject) numbers.push_back(v.index());
  return numbers;
}

json history_json(const TraceFile& file, const History& history) {
  json calls = json::array();
  json trials = json::array();
  for (const HistoryCall& each : history.calls) {
    const Call& call = file.calls()[each.call];
    (each.in_trial ? trials : calls)
        .push_back({{"call", each.call},
                    {"operator", file.name(call.operator_name)},
                    {"target", numbers_of({call.target().begin(), call.target().end()})},
                    {"verdict", call.verdict_in_words()},
                    {"before", call.worst_before},
                    {"after", call.worst_after},
                    {"reason", file.reason(call)}});
  }
  json parts = json::array();
  for (const PartHistory& part : history.parts) {
    parts.push_back({{"vertices", numbers_of(part.part)},
                     {"on_surface", part.on_surface},
                     {"calls", part.calls},
                     {"accepted", part.accepted},
                     {"undone", part.undone},
                     {"in_trials", part.in_trials},
                     {"nearest", part.nearest == kNoCall ? json() : json(part.nearest)}});
  }
  json result = {{"vertices", numbers_of(history.subject)},
                 {"text", history_paragraph(file, history)},
                 {"from_beginning", history.from_beginning},
                 {"made", history.made},
                 {"moves", history.moves},
                 {"visits", history.visits.size()},
                 {"visited", history.visits},
                 {"calls", calls},
                 {"trials", trials},
                 {"parts", parts}};
  if (history.removed) result["removed"] = *history.removed;
  if (history.made_by != kNoCall) result["made_by"] = history.made_by;
  if (history.removed_by != kNoCall) result["removed_by"] = history.removed_by;
  if (history.subject.size() == 4) result["quality"] = history.quality;
  return result;
}

json history(Session& s, const json& a) {
  Debugger& debugger = need_trace(s.document);
  std::string asked;
  if (a.empty()) {
    asked = subject_of_selection(s.document);
  } else if (a[0].is_object()) {
    asked = subject_of_table(a[0]);
  } else {
    asked = Arguments("history", a).text(0);
  }
  debugger.ask_history(debugger.subject_of(asked));
  debugger.asked = asked;
  const Selection found = s.document.selection_of(debugger.history()->subject);
  if (found != Selection()) s.document.select(found);
  s.document.message = {fmt::format("the history of {} is in the panel History", asked), false};
  return history_json(debugger.file(), *debugger.history());
}

constexpr std::array kHistoryCommands = {
    Command{"history", "Shift+H", "Trace", "history{tet = 17, file = \"better.mesh\"}",
            "What the trace knows of the selection, or of a tet, face, edge or vertex: a table of "
            "text, calls, trials, parts",
            &history},
};

}  // namespace

std::span<const Command> history_commands() {
  return kHistoryCommands;
}

}  // namespace tetmend::viewer
