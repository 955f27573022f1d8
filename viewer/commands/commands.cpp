// SPDX-License-Identifier: MIT
#include "viewer/commands/commands.h"

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "viewer/commands/command_group.h"

namespace tetmend::viewer {

using nlohmann::json;

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kGestures = {
    {{"drag", "orbit"},
     {"right drag, or Shift + drag", "pan"},
     {"wheel", "zoom to the mouse"},
     {"click", "pick"},
     {"double click", "pick and fit"},
     {"right click",
      "go to what the mouse is on, in the picture or a panel, or ask for its history"},
     {"drag over the histogram", "filter; click there: filter off"},
     {"drop a file", "open it; a .json file is a view or a lesson"}}};

}  // namespace

std::span<const Command> commands() {
  static const std::vector<Command> kAll = [] {
    std::vector<Command> list;
    for (const auto group :
         {file_commands(), figure_commands(), view_commands(), show_commands(), select_commands(),
          trace_commands(), history_commands(), ledger_commands(), live_commands(),
          trial_commands(), help_commands(), script_commands()}) {
      list.insert(list.end(), group.begin(), group.end());
    }
    return list;
  }();
  return kAll;
}

const Command& find_command(std::string_view name) {
  return *std::find_if(commands().begin(), commands().end(),
                       [&](const Command& c) { return c.name == name; });
}

const Command* command_for_keys(std::string_view keys) {
  for (const Command& command : commands()) {
    if (!keys.empty() && command.keys == keys) return &command;
  }
  return nullptr;
}

bool guarded(Document& document, const std::function<void()>& work) {
  try {
    work();
    return true;
  } catch (const std::bad_alloc&) {
    document.message = {"out of memory", true};
  } catch (const std::exception& error) {
    document.message = {error.what(), true};
  }
  return false;
}

void do_soon(Session& session, const std::function<void()>& work) {
  if (session.is_drawing) {
    session.asked.push_back(work);
  } else {
    guarded(session.document, work);
  }
}

void do_asked(Session& session) {
  for (const auto& work : std::exchange(session.asked, {})) guarded(session.document, work);
}

namespace {

/// Leaves the mesh that is shown for something else, or for good.
bool leaves_mesh(const Command& command, const json& arguments, const LiveRun& live) {
  return command.name == "quit" || (command.name == "live_debug" && !live.is_active()) ||
         command.name == "reload" || (command.name == "open" && !arguments.empty());
}

}  // namespace

void run_waiting(Session& session) {
  const WaitingCommand waiting = *session.document.waiting;
  session.document.waiting.reset();
  json arguments = json::array();
  if (!waiting.argument.empty()) arguments.push_back(waiting.argument);
  guarded(session.document, [&] { find_command(waiting.name).run(session, arguments); });
}

void run_from_window(const Command& command, Session& session, const json& arguments) {
  do_soon(session, [&command, &session, arguments] {
    Document& document = session.document;
    document.begin_act();
    if (leaves_mesh(command, arguments, document.live) && document.has_unsaved()) {
      const std::string file = arguments.empty() ? "" : arguments[0].get<std::string>();
      document.waiting = WaitingCommand{std::string(command.name), file};
    } else {
      command.run(session, arguments);
    }
  });
}

std::string command_reference() {
  std::string text = "| Key or mouse | Word of a script | Effect |\n|---|---|---|\n";
  for (const auto& gesture : kGestures) {
    text += fmt::format("| {} | | {} |\n", gesture.first, gesture.second);
  }
  for (const Command& c : commands()) {
    const std::string key = c.keys.empty() ? "" : fmt::format(" `{}`", c.keys);
    text += fmt::format("|{} | `{}` | {} |\n", key, c.usage, c.help);
  }
  return text;
}

std::span<const std::pair<std::string_view, std::string_view>> mouse_gestures() {
  return kGestures;
}

}  // namespace tetmend::viewer
