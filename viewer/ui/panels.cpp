// SPDX-License-Identifier: MIT
#include "viewer/ui/panels.h"

#include <array>

namespace tetmend::viewer::ui {

std::span<const Panel> panels() {
  static constexpr std::array<Panel, 7> kPanels = {
      {{"Histogram", Side::left, &draw_histogram_panel},
       {"Display", Side::left, &draw_display_panel},
       {"Cuts", Side::left, &draw_cuts_panel},
       {"Statistics", Side::right, &draw_statistics_panel},
       {"Run", Side::right, &draw_live_panel,
        [](const Document& d) { return d.live.state() != LiveState::idle; }},
       {"Selection", Side::right, &draw_selection_panel},
       {"Worst tets", Side::right, &draw_worst_panel}}};
  return kPanels;
}

}  // namespace tetmend::viewer::ui
