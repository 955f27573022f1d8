// SPDX-License-Identifier: MIT
#include "viewer/commands/menu.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tetmend::viewer {

namespace {

using Text = std::pair<std::string_view, std::string_view>;  // command, words of the menu

constexpr auto kTexts = std::to_array<Text>({{"open", "Open ..."},
                                             {"save", "Save as ..."},
                                             {"reload", "Read again"},
                                             {"screenshot", "Save picture"},
                                             {"copy_view", "Copy view"},
                                             {"paste_view", "Paste view"},
                                             {"quit", "Quit"},
                                             {"home", "Whole mesh"},
                                             {"fit", "Fit"},
                                             {"from_right", "From the right (+x)"},
                                             {"from_left", "From the left (-x)"},
                                             {"from_back", "From the back (+y)"},
                                             {"from_front", "From the front (-y)"},
                                             {"from_top", "From above (+z)"},
                                             {"from_bottom", "From below (-z)"},
                                             {"undo_view", "Undo view"},
                                             {"redo_view", "Redo view"},
                                             {"orthographic", "Orthographic"},
                                             {"theme", "Light or dark"},
                                             {"panels", "Panels"},
                                             {"keys", "Keys"},
                                             {"numbers", "Vertex numbers"},
                                             {"all_numbers", "Numbers of all vertices seen"},
                                             {"legend", "Legend"},
                                             {"edges", "Edges"},
                                             {"bad", "Bad tets in red"},
                                             {"bad_beyond_cuts", "Bad tets beyond cuts"},
                                             {"constraints", "Constraint faces"},
                                             {"ghosts", "Ghosts of hidden tets"},
                                             {"outline", "Outline of the mesh"},
                                             {"reference", "Reference surface ..."},
                                             {"colour", "Next colour"},
                                             {"filter", "Filter off"},
                                             {"peel_more", "Peel one more layer"},
                                             {"peel_less", "Peel one layer less"},
                                             {"shrink", "Shrink tets"},
                                             {"cut_x", "Cut plane 1"},
                                             {"cut_y", "Cut plane 2"},
                                             {"cut_z", "Cut plane 3"},
                                             {"exact", "Exact cuts"},
                                             {"cut_forward", "Move cuts forwards"},
                                             {"cut_back", "Move cuts back"},
                                             {"show_all", "Show all"},
                                             {"pick_kind", "Next kind to pick"},
                                             {"go_to", "Go to ..."},
                                             {"deselect", "Select nothing"},
                                             {"try_operator", "Try ..."},
                                             {"keep", "Keep what was tried"},
                                             {"undo", "Undo what was tried"},
                                             {"worst", "Worst tet"},
                                             {"next_worst", "Next worst tet"},
                                             {"previous_worst", "Worst tet before"},
                                             {"step_into", "Step into"},
                                             {"back_into", "Step back into"},
                                             {"step_over", "Step over"},
                                             {"back_over", "Step back over"},
                                             {"step_out", "Step out"},
                                             {"back_out", "Step back out"},
                                             {"to_begin", "Beginning"},
                                             {"to_end", "End"},
                                             {"play", "Play or stop"},
                                             {"faster", "Play faster"},
                                             {"slower", "Play slower"},
                                             {"run", "Run to next breakpoint"},
                                             {"run_back", "Run back to breakpoint"},
                                             {"next_accepted", "Next accepted call"},
                                             {"last_accepted", "Accepted call before"},
                                             {"next_refused", "Next refused call"},
                                             {"last_refused", "Refused call before"},
                                             {"deepest", "Deepest call"},
                                             {"bookmark", "Set or remove bookmark"},
                                             {"next_bookmark", "Next bookmark"},
                                             {"last_bookmark", "Bookmark before"},
                                             {"next_lesson_step", "Next step of the lesson"},
                                             {"last_lesson_step", "Step of the lesson before"},
                                             {"isolate", "Isolate"},
                                             {"follow", "Camera follows"},
                                             {"teaching", "Layout for teaching"},
                                             {"tables", "Tables of Algorithm 2"},
                                             {"blend", "Blend before and after"},
                                             {"figure", "Save figures of the call"},
                                             {"colour_bar", "Colour bar"},
                                             {"scale_bar", "Scale bar"},
                                             {"background", "Next background"},
                                             {"history", "History of the selection"},
                                             {"against", "Compare with another run ..."},
                                             {"live_run", "Run"},
                                             {"live_start", "Run, paused at first"},
                                             {"live_follow", "Camera follows the run"},
                                             {"live_step_call", "To the next call"},
                                             {"live_pause", "Pause"},
                                             {"live_continue", "Continue"},
                                             {"live_step", "To the next change"},
                                             {"live_step_pass", "To the end of the pass"},
                                             {"live_debug", "Debug this run"},
                                             {"live_stop", "Stop"},
                                             {"manual", "Manual"},
                                             {"lectures", "Lectures"},
                                             {"about", "About tetmend"}});

bool is_trace_possible(std::string_view name, Document& document) {
  const Debugger* debugger = document.debugger();
  if (name == "isolate") return document.has_mesh();
  if (debugger == nullptr) return false;
  if (name.ends_with("lesson_step")) return debugger->lesson().has_value();
  if (name == "next_bookmark" || name == "last_bookmark") return !debugger->bookmarks.empty();
  return true;
}

bool is_run_possible(std::string_view name, Document& document) {
  if (name == "live_follow") return true;
  if (name == "live_run" || name == "live_start")
    return document.has_mesh() && !document.live.is_active();
  if (name == "live_debug") {
    const LiveState state = document.live.state();
    return state != LiveState::idle && state != LiveState::running && state != LiveState::stopping;
  }
  if (name.starts_with("live_step")) return document.has_mesh();
  return document.live.is_active();
}

}  // namespace

std::string menu_text(const Command& command) {
  const auto found = std::find_if(kTexts.begin(), kTexts.end(),
                                  [&](const Text& text) { return text.first == command.name; });
  if (found != kTexts.end()) return std::string(found->second);
  return std::string(command.help.substr(0, command.help.find(';')));
}

bool begins_group(const Command& command) {
  constexpr std::array<std::string_view, 22> kFirst = {
      "screenshot", "from_right", "undo_view",  "orthographic",  "numbers",  "reference",
      "filter",     "cut_x",      "show_all",   "worst",         "history",  "try_operator",
      "to_begin",   "play",       "run",        "next_accepted", "bookmark", "next_lesson_step",
      "isolate",    "live_pause", "live_debug", "about"};
  return std::find(kFirst.begin(), kFirst.end(), command.name) != kFirst.end();
}

std::optional<bool> is_on(const Command& command, const Document& document) {
  const ViewSettings& view = document.view;
  const SceneSettings& scene = view.scene;
  const std::array<std::pair<std::string_view, bool>, 25> states = {
      {{"edges", view.edges},
       {"bad", scene.bad},
       {"bad_beyond_cuts", scene.bad_beyond_cuts},
       {"constraints", scene.constraints},
       {"ghosts", scene.ghosts > 0},
       {"outline", scene.outline},
       {"reference", scene.colour == kDistance},
       {"shrink", scene.shrink > 0},
       {"cut_x", scene.cuts[0].on},
       {"cut_y", scene.cuts[1].on},
       {"cut_z", scene.cuts[2].on},
       {"exact", scene.cuts[0].exact},
       {"orthographic", view.camera.orthographic},
       {"panels", document.show_panels},
       {"keys", document.show_keys},
       {"numbers", view.numbers},
       {"all_numbers", view.all_numbers},
       {"legend", view.legend},
       {"colour_bar", view.colour_bar},
       {"scale_bar", view.scale_bar},
       {"isolate", scene.isolate},
       {"follow", document.follow_trace},
       {"teaching", document.teaching},
       {"tables", document.debugger() != nullptr && document.debugger()->shows_tables},
       {"live_follow", document.follow_changes_live}}};
  for (const auto& [name, state] : states) {
    if (name == command.name) return state;
  }
  return std::nullopt;
}

bool is_possible(const Command& command, Document& document) {
  if (command.menu == "Trace") return is_trace_possible(command.name, document);
  if (command.menu == "Run") return is_run_possible(command.name, document);
  constexpr std::array<std::string_view, 12> kWithoutMesh = {
      "open",   "quit", "screenshot", "copy_view", "paste_view", "theme",
      "panels", "keys", "legend",     "manual",    "lectures",   "about"};
  const bool is_free =
      std::find(kWithoutMesh.begin(), kWithoutMesh.end(), command.name) != kWithoutMesh.end();
  if (!is_free && !document.has_mesh()) return false;
  if (command.name == "figure") return document.debugger() != nullptr;
  if (command.name == "keep") {
    return document.trial() != nullptr && document.trial()->is_accepted();
  }
  if (command.name == "undo") return document.trial() != nullptr;
  if (command.name == "deselect" || command.name == "try_operator") {
    return !std::holds_alternative<std::monostate>(document.selection());
  }
  return true;
}

}  // namespace tetmend::viewer
