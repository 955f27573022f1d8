// SPDX-License-Identifier: MIT
// The skirt polygon of a call drawn flat, for paper and for windows.
#pragma once

#include "explain/call_study.h"
#include "explain/figures/linked_drawing.h"

namespace tetmend::explain {

/// Where it goes, and how large its words and lines are.
struct RingLook {
  figure::Place middle;    ///< of the square that polygon and names fill
  double half = 1;         ///< half of its side
  double name_size = 8;    ///< of a vertex's number, p_i is smaller; 0: no names and no numbers
  double number_size = 7;  ///< likewise, where there is room for it
  double line = 1;         ///< width of the skirt polygon's side, in thirds
  figure::Colour ink = figure::kBlack;
  figure::Colour patch{255, 255, 255, 200};  ///< behind numbers
  /// Of good tets; bad ones are red.
  const figure::ColourMap* map = &figure::colour_maps().front();
};

/// Before the edit it has the old tets, a slice each, and the chords that the search may use,
/// dashed where their pockets are no better; after it the covering that was made or tried; after a
/// refusal without a candidate the best complete triangulation, dashed, with the chords.
LinkedDrawing draw_polygon(const PolygonView& view, const RingLook& look);

/// Lines as draw_polygon() draws them, for legends.
figure::Pen skirt_pen(double line);
figure::Pen pocket_pen(double line);
figure::Pen core_pen(double line);
figure::Pen chord_pen(double line, bool is_better);

}  // namespace tetmend::explain
