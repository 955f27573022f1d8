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

json run(Session& s, const json& a) {
  need_mesh(s.document);
  const std::string from = a.empty() ? "file" : Arguments("live_run", a).text(0);
  if (from != "file" && from != "shown") {
    throw Error(fmt::format("live_run: '{}' is not known; valid: file, shown", from));
  }
  s.document.run_live(from == "file" ? LiveRun::From::file : LiveRun::From::shown);
  return nullptr;
}

/// Recorded runs only: to record all would cost each of them time and a file.
json debug(Session& s, const json&) {
  const LiveRun& live = s.document.live;
  if (live.is_active()) throw Error("live_debug: the run is still at work");
  const std::string trace = live.progress().trace;
  if (trace.empty()) {
    throw Error("live_debug: no recorded run is over; choose 'record' and run again");
  }
  s.document.open(trace);
  return nullptr;
}

template <Demand What>
json ask(Session& s, const json&) {
  s.document.live.ask(What);
  return nullptr;
}

json state(Session& s, const json&) {
  s.document.follow_live();
  return to_json(s.document.live.progress());
}

json wait(Session& s, const json& a) {
  constexpr double kForever = 1e6;
  s.document.live.wait(a.empty() ? kForever : Arguments("live_wait", a).number(0));
  return state(s, {});
}

constexpr std::string_view kRun = "Run";

constexpr std::array kCommands = {
    Command{"live_schedule", "", "", "live_schedule(\"NAME\")",
            "Choose a schedule by its name or file; the result has its parameters", &schedule},
    Command{"live_set", "", "", "live_set(\"PARAMETER\", VALUE)",
            "Set a parameter of the schedule, for the next run", &set},
    Command{"live_record", "", "", "live_record(\"FILE.trace\")",
            "Record the next runs into a file; without one they are not", &record},
    Command{"live_run", "F6", kRun, "live_run(\"file\")",
            "Run the schedule over the mesh as it was opened, or as it is \"shown\"", &run},
    Command{"live_pause", "F7", kRun, "live_pause()", "Pause the run after the call at hand",
            &ask<Demand::pause>},
    Command{"live_continue", "F8", kRun, "live_continue()", "Let a paused run go on",
            &ask<Demand::go_on>},
    Command{"live_step", "F9", kRun, "live_step()",
            "Let the run go on to the next call that changes the mesh",
            &ask<Demand::to_next_accepted>},
    Command{"live_step_pass", "F10", kRun, "live_step_pass()",
            "Let the run go on to the end of the pass", &ask<Demand::to_next_pass>},
    Command{"live_debug", "F11", kRun, "live_debug()",
            "Open the trace of the last run, if it was recorded, in the debugger", &debug},
    Command{"live_stop", "F12", kRun, "live_stop()", "End the run; the mesh stays as it is then",
            &ask<Demand::stop>},
    Command{"live_wait", "", "", "live_wait(SECONDS)",
            "Wait until the run has paused or ended; the result is live_state()", &wait},
    Command{"live_state", "", "", "live_state()",
            "How far the run has come, as a table: state, error, passes, ...", &state},
};

}  // namespace

std::span<const Command> live_commands() {
  return kCommands;
}

}  // namespace tetmend::viewer
