// SPDX-License-Identifier: MIT
// The panels beside the picture. A new one is a file with a draw function and a row in panels.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "viewer/commands/commands.h"

namespace tetmend::viewer::ui {

enum class Side { left, right };
/// Which documents a panel is for. While a trace is open, those for meshes are folded at first.
enum class Subject { mesh, trace, lesson };

struct Panel {
  const char* title;
  Side side;
  Subject subject;
  void (*draw)(Session& session);
  /// Opens by itself once this is so; null: is open from the beginning.
  bool (*is_needed)(const Document& document) = nullptr;
  /// Is there only while this is so; null: always.
  bool (*is_there)(const Document& document) = nullptr;
  /// What its heading says, a literal; null: the title.
  std::string_view (*heading)(const Document& document) = nullptr;
};

/// All panels, from top to bottom. Drawn only when there is a mesh.
std::span<const Panel> panels();

void draw_histogram_panel(Session& session);
void draw_display_panel(Session& session);
void draw_cuts_panel(Session& session);
void draw_worst_panel(Session& session);
/// Where bad tets are many.
void draw_places_panel(Session& session);
void draw_statistics_panel(Session& session);
void draw_selection_panel(Session& session);
void draw_live_panel(Session& session);
/// The operator that was tried: how it ended, its parameters, keep or undo.
void draw_trial_panel(Session& session);
/// At a pause of a run: parameters of the operator at hand, from the next pass on.
void draw_parameters_panel(Session& session);
// With a trace; the lesson with one that has a lesson.
void draw_calls_panel(Session& session);
void draw_breakpoints_panel(Session& session);
void draw_step_panel(Session& session);
/// Its buttons alone, where draw_last_event() stands elsewhere. `is_short`: those for steps.
void draw_step_buttons(Session& session, bool is_short = false);
/// The algorithm that the call at hand follows, with its line in sight. Fills the current window.
/// `is_whole`: its lines are as small as they need to be seen all.
void draw_algorithm_panel(Session& session, bool is_whole = false);
/// What it would like to have, in pixels; 0: nothing is to be shown.
float algorithm_height(const Session& session);
void draw_shell_panel(Session& session);
void draw_lesson_panel(Session& session);
void draw_history_panel(Session& session);
void draw_ledger_panel(Session& session);
/// Another run beside this one: bad tets of both over time, tets that are bad in one alone.
void draw_other_run(Session& session);
/// Of such a tet, its place and its history in both.
void draw_both_panel(Session& session);
/// The calls of a condition.
void draw_found_panel(Session& session);

// What others leave room for: the ring, in widths of the panel, and rows of the table of chords.
inline constexpr float kRingShare = 0.6F;
inline constexpr float kChordRows = 5.2F;  // with the head; more can be scrolled to

// Parts of these, for the layout for teaching.
/// The text of the step at hand, or what happened last.
void draw_lesson_text(Session& session);
/// That and the line for an answer.
void draw_lesson_step(Session& session);
/// Buttons, and how far the lesson is.
void draw_lesson_bar(Session& session);
/// The calls as a breadcrumb, the innermost `most` of them, and what the innermost is to do.
void draw_stack(Session& session, std::size_t most = 1000);
/// What happened last, the verdict and its reason.
void draw_last_event(Session& session);
/// The polygon of the shell alone, as large as the window allows. `is_told`: with where it is and what it
/// shows, where there is room.
void draw_ring(Session& session, bool is_told = true);
/// The tables of Algorithm 2 alone; their text is as small as they need to be seen whole.
void draw_tables(Session& session);
/// The same, to be unfolded. Precondition: the call at hand has a polygon.
void draw_tables_fold(Session& session);
/// The tree of calls alone, as high as the window.
void draw_tree(Session& session);

}  // namespace tetmend::viewer::ui
