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
  // Below what lists them: the ledger, or the box for conditions.
  constexpr auto kHasFoundOutside = [](const Document& d) {
    return d.debugger()->call() == kNoCall && d.debugger()->found().has_value();
  };
  constexpr auto kHasFoundInside = [](const Document& d) {
    return d.debugger()->call() != kNoCall && d.debugger()->found().has_value();
  };
  // A list of the worst does not tell where the others are.
  constexpr auto kHasMany = [](const Document& d) {
    constexpr std::size_t kMany = 1000;
    return d.statistics().n_bad > kMany;
  };
  constexpr auto kIsPause = [](const Document& d) {
    return d.debugs_live() && d.live.state() == LiveState::paused;
  };
  constexpr auto kWorksOn = [](const Document& d) {
    return neighbourhood_of(d.debugger()->file().calls()[d.debugger()->call()]);
  };
  constexpr auto kHasPair = [](const Document& d) {
    return d.debugger()->other() != nullptr && d.debugger()->other()->pair() != nullptr;
  };
  static constexpr std::array<Panel, 21> kPanels = {
      {{"Ledger", left, trace, &draw_ledger_panel, nullptr, kIsOutside},
       {"Calls found", left, trace, &draw_found_panel, nullptr, kHasFoundOutside},
       {"Calls", left, trace, &draw_calls_panel},
       {"Run to, breakpoints, bookmarks", left, trace, &draw_breakpoints_panel},
       {"Calls found", left, trace, &draw_found_panel, nullptr, kHasFoundInside},
       {"Shell", left, trace, &draw_shell_panel, nullptr, kIsInside, kWorksOn},
       {"Ledger of the run", left, trace, &draw_ledger_panel, [](const Document&) { return false; },
        kIsInside},
       {"Histogram", left, mesh, &draw_histogram_panel},
       {"Display", left, mesh, &draw_display_panel},
       {"Cuts", left, mesh, &draw_cuts_panel},
       {"Tried here", right, trace, &draw_trial_panel, nullptr, kHasTrial},
       {"Lesson", right, lesson, &draw_lesson_panel},
       {"Parameters, from the next pass on", right, trace, &draw_parameters_panel, nullptr,
        kIsPause},
       {"Step", right, trace, &draw_step_panel},
       {"In both runs", right, trace, &draw_both_panel, nullptr, kHasPair},
       {"History", right, trace, &draw_history_panel,
        [](const Document& d) { return d.debugger()->history().has_value(); }},
       {"Statistics", right, mesh, &draw_statistics_panel},
       {"Run", right, mesh, &draw_live_panel,
        [](const Document& d) { return d.live.state() != LiveState::idle; }},
       {"Worst tets", right, mesh, &draw_worst_panel},
       {"Selection", right, mesh, &draw_selection_panel},
       {"Where bad tets are many", right, mesh, &draw_places_panel, nullptr, kHasMany}}};
  return kPanels;
}

}  // namespace tetmend::viewer::ui
