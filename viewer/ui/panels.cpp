// SPDX-License-Identifier: MIT
#include "viewer/ui/panels.h"

#include <array>

namespace tetmend::viewer::ui {

std::span<const Panel> panels() {
  using enum Side;
  using enum Subject;
  // Outside of all calls the whole of the run is what there is to see.
  constexpr auto kIsOutside = [](const Document& d) { return d.debugger()->call() == kNoCall; };
  constexpr auto kIsInside = [](const Document& d) { return d.debugger()->call() != kNoCall; };
  constexpr auto kHasTrial = [](const Document& d) { return d.trial() != nullptr; };
  constexpr auto kHasFound = [](const Document& d) { return d.debugger()->found().has_value(); };
  static constexpr std::array<Panel, 17> kPanels = {
      {{"Ledger", left, trace, &draw_ledger_panel, nullptr, kIsOutside},
       {"Calls", left, trace, &draw_calls_panel},
       {"Run to, breakpoints, bookmarks", left, trace, &draw_breakpoints_panel},
       {"Calls found", left, trace, &draw_found_panel, nullptr, kHasFound},
       {"Shell", left, trace, &draw_shell_panel, nullptr, kIsInside},
       {"Ledger of the run", left, trace, &draw_ledger_panel, [](const Document&) { return false; },
        kIsInside},
       {"Histogram", left, mesh, &draw_histogram_panel},
       {"Display", left, mesh, &draw_display_panel},
       {"Cuts", left, mesh, &draw_cuts_panel},
       {"Tried here", right, trace, &draw_trial_panel, nullptr, kHasTrial},
       {"Lesson", right, lesson, &draw_lesson_panel},
       {"Step", right, trace, &draw_step_panel},
       {"History", right, trace, &draw_history_panel,
        [](const Document& d) { return d.debugger()->history().has_value(); }},
       {"Statistics", right, mesh, &draw_statistics_panel},
       {"Run", right, mesh, &draw_live_panel,
        [](const Document& d) { return d.live.state() != LiveState::idle; }},
       {"Worst tets", right, mesh, &draw_worst_panel},
       {"Selection", right, mesh, &draw_selection_panel}}};
  return kPanels;
}

}  // namespace tetmend::viewer::ui
