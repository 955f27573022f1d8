// SPDX-License-Identifier: MIT
// Commands that run a schedule over the mesh.
#include <array>

#include "viewer/commands/command_group.h"

namespace tetmend::viewer {

using nlohmann::json;

namespace {

/// All parameters with their values, as the schedule will get them.
json parameters(const LiveRun& live) {
  json values = json::object();
  for (const ScheduleParameter& parameter : live.info().parameters) {
    values[parameter.name] = live.value_of(parameter);
  }
  return values;
}

json schedule(Session& s, const json& a) {
  if (!a.empty()) s.document.live.choose_schedule(Arguments("live_schedule", a).text(0));
  return parameters(s.document.live);
}

json set(Session& s, const json& a) {
  const Arguments arguments("live_set", a);
  const std::string name = arguments.text(0);
  std::string value;
  if (arguments.has(1) && a[1].is_boolean()) {
    value = a[1].get<bool>() ? "true" : "false";
  } else if (arguments.has(1) && a[1].is_number()) {
    value = fmt::format("{}", a[1].get<double>());
  } else {
    value = arguments.text(1);
  }
  s.document.live.set(name, value);
  return nullptr;
}

json record(Session& s, const json& a) {
  s.document.live.trace = a.empty() ? "" : Arguments("live_record", a).text(0);
  return nullptr;
}

void begin_run(Session& s, std::string_view word, const json& a, bool paused) {
  need_mesh(s.document);
  const std::string from = a.empty() ? "file" : Arguments(word, a).text(0);
  if (from != "file" && from != "shown") {
    throw Error(fmt::format("{}: '{}' is not known; valid: file, shown", word, from));
  }
  s.document.live.paused = paused;
  s.document.run_live(from == "file" ? LiveRun::From::file : LiveRun::From::shown);
}

json live_run(Session& s, const json& a) {
  begin_run(s, "live_run", a, false);
  return nullptr;
}

json start(Session& s, const json& a) {
  begin_run(s, "live_start", a, true);
  return nullptr;
}

json speed(Session& s, const json& a) {
  if (!a.empty()) s.document.live.set_speed(Arguments("live_speed", a).number(0));
  return s.document.live.speed();
}

json live_follow(Session& s, const json&) {
  bool& follows = s.document.follow_changes_live;
  follows = !follows;
  s.document.message = {
      follows ? "the camera goes to each change of a run" : "the camera stays where it is", false};
  return nullptr;
}

/// What is behind the words of live_schedule() beside those that tetmend brings along.
json plugin_operators(Session& s, const json&) {
  return s.document.live.plugin_operators();
}

/// Of a recorded run that is over the whole trace, else the last calls.
json debug(Session& s, const json&) {
  const std::string trace = s.document.live.progress().trace;
  if (trace.empty()) {
    s.document.debug_live();
  } else {
    s.document.open(trace);
  }
  return nullptr;
}

json hold_parameter(Session& s, const json& a) {
  const Arguments arguments("live_hold", a);
  const double value =
      arguments.has(2) && a[2].is_boolean() ? (a[2].get<bool>() ? 1 : 0) : arguments.number(2);
  const ParameterHold change{arguments.text(0), arguments.text(1), value};
  s.document.live.hold_parameter(change);
  s.document.message = {change.text() + ", from the next pass on", false};
  return nullptr;
}

template <Demand What>
json live_ask(Session& s, const json&) {
  s.document.live.ask(What);
  return nullptr;
}

json live_state(Session& s, const json&) {
  s.document.follow_live();
  return to_json(s.document.live.progress());
}

json wait(Session& s, const json& a) {
  constexpr double kForever = 1e6;
  s.document.live.wait(a.empty() ? kForever : Arguments("live_wait", a).number(0));
  return live_state(s, {});
}

constexpr std::string_view kRun = "Run";

constexpr std::array kLiveCommands = {
    Command{"live_schedule", "", "", "live_schedule(\"NAME\")",
            "Choose a schedule by its name or file, or \"operator NAME\"; the result has its "
            "parameters",
            &schedule},
    Command{"live_set", "", "", "live_set(\"PARAMETER\", VALUE)",
            "Set a parameter of the schedule, for the next run", &set},
    Command{"live_record", "", "", "live_record(\"FILE.trace\")",
            "Record the next runs into a file; without one they are not", &record},
    Command{"live_run", "F6", kRun, "live_run(\"file\")",
            "Run the schedule over the mesh as it was opened, or as it is \"shown\"", &live_run},
    Command{"live_start", "Shift+F6", kRun, "live_start(\"file\")",
            "Begin a run that is paused before its first call; from the mesh as live_run", &start},
    Command{"live_speed", "", "", "live_speed(CHANGES)",
            "Changes a second at most, each shown; 0: as fast as it can; the result is what holds",
            &speed},
    Command{"live_follow", "", kRun, "live_follow()",
            "The camera goes to each change of a run, or stays", &live_follow},
    Command{"live_plugins", "", "", "live_plugins()",
            "Names of the operators of plugins, for live_schedule(\"operator NAME\")",
            &plugin_operators},
    Command{"live_pause", "F7", kRun, "live_pause()", "Pause the run after the call at hand",
            &live_ask<Demand::pause>},
    Command{"live_continue", "F8", kRun, "live_continue()", "Let a paused run go on",
            &live_ask<Demand::go_on>},
    Command{"live_step", "F9", kRun, "live_step()",
            "Let the run go on to the next call that changes the mesh",
            &live_ask<Demand::to_next_accepted>},
    Command{"live_step_call", "Shift+F9", kRun, "live_step_call()",
            "Let the run go on to the next call, accepted or not", &live_ask<Demand::to_next_call>},
    Command{"live_step_pass", "F10", kRun, "live_step_pass()",
            "Let the run go on to the end of the pass", &live_ask<Demand::to_next_pass>},
    Command{
        "live_hold", "", "", "live_hold(\"OPERATOR\", \"PARAMETER\", VALUE)",
        "In a paused run: from the next pass on an operator has that value; an event of its trace",
        &hold_parameter},
    Command{
        "live_debug", "F11", kRun, "live_debug()",
        "Show the last calls of a run that is paused or over in the debugger, or its trace, if it "
        "was recorded",
        &debug},
    Command{"live_stop", "F12", kRun, "live_stop()", "End the run; the mesh stays as it is then",
            &live_ask<Demand::stop>},
    Command{"live_wait", "", "", "live_wait(SECONDS)",
            "Wait until the run has paused or ended; the result is live_state()", &wait},
    Command{"live_state", "", "", "live_state()",
            "How far the run has come, as a table: state, error, passes, ...", &live_state},
};

}  // namespace

std::span<const Command> live_commands() {
  return kLiveCommands;
}

}  // namespace tetmend::viewer
