// SPDX-License-Identifier: MIT
// The whole of a recorded run: its ledger, lists of calls, another run beside it.
#include <array>

#include "kernel/grouped.h"
#include "viewer/commands/command_group.h"

namespace tetmend::viewer {

using nlohmann::json;

namespace {

json ledger(Session& s, const json&) {
  Debugger& debugger = need_trace(s.document);
  return json::parse(ledger_json(debugger.file(), debugger.ledger()));
}

json list_calls(Session& s, const json& a) {
  Debugger& debugger = need_trace(s.document);
  debugger.list_calls(parse_condition(Arguments("list_calls", a).text(0)));
  const FoundCalls& found = *debugger.found();
  s.document.message = {
      fmt::format("{} calls: {}", grouped(found.calls.size()), to_text(found.condition)), false,
      found.calls.empty()};
  return found.calls;
}

json numbers_of_tet(const HistorySubject& tet) {
  json numbers = json::array();
  for (const VertexHandle v : tet) numbers.push_back(v.index());
  return numbers;
}

json pairs_of_tets(const std::vector<TetPair>& pairs) {
  json list = json::array();
  for (const TetPair& pair : pairs) {
    list.push_back({{"bad", numbers_of_tet(pair.bad)},
                    {"bad_quality", pair.bad_quality},
                    {"good", numbers_of_tet(pair.good)},
                    {"good_quality", pair.good_quality}});
  }
  return list;
}

json against(Session& s, const json& a) {
  Debugger& debugger = need_trace(s.document);
  if (a.empty()) {
    s.document.question = FileQuestion::other_run;
    return nullptr;
  }
  debugger.compare_with(Arguments("against", a).text(0));
  const RunComparison& made = debugger.other()->comparison();
  s.document.message = {
      fmt::format("{} tets are bad here and good there, {} the other way round",
                  grouped(made.worse_in_a.size()), grouped(made.worse_in_b.size())),
      false};
  return {{"bad_here", made.bad_in_a},
          {"bad_there", made.bad_in_b},
          {"bad_here_good_there", pairs_of_tets(made.worse_in_a)},
          {"bad_there_good_here", pairs_of_tets(made.worse_in_b)}};
}

json beside(Session& s, const json& a) {
  Debugger& debugger = need_trace(s.document);
  if (debugger.other() == nullptr) throw Error("beside: no other run is beside this one");
  const std::size_t count = debugger.other()->comparison().worse_in_a.size();
  debugger.look_at_pair(Arguments("beside", a).index(0, count));
  const OtherRun& other = *debugger.other();
  const TetPair& pair = *other.pair();
  const Selection found = s.document.selection_of(pair.bad);
  if (found != Selection()) s.document.fly_to(found);
  s.document.message = {fmt::format("{} is in the panel In both runs", in_words(pair.bad)), false};
  json result = pairs_of_tets({pair})[0];
  result["here"] = history_paragraph(debugger.file(), *debugger.history());
  result["there"] = other.place()->told;
  result["tets_here"] = other.place()->here.size();
  result["tets_there"] = other.place()->there.size();
  return result;
}

constexpr std::array kLedgerCommands = {
    Command{"ledger", "", "", "ledger()",
            "Of all calls: by operator, level and ending their number, share and time; a table",
            &ledger},
    Command{"list_calls", "", "", "list_calls(\"operator smoothing and refused\")",
            "List the calls of a condition, the nearest to being accepted first; their numbers",
            &list_calls},
    Command{"against", "Ctrl+B", "Trace", "against(\"FILE.trace\")",
            "Another run beside this one: differences of the ledgers, tets bad in one alone",
            &against},
    Command{"beside", "", "", "beside(N)",
            "Of the N-th tet that is bad here and good in the other run, counted from 0: its place "
            "and its history in both; a table",
            &beside},
};

}  // namespace

std::span<const Command> ledger_commands() {
  return kLedgerCommands;
}

}  // namespace tetmend::viewer
