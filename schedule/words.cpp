// SPDX-License-Identifier: MIT
#include "schedule/words.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "kernel/quality.h"

namespace tetmend {

namespace {

constexpr WordField kOn = {"on", "selection", "'bad'", "the tets to work on"};

constexpr std::array<WordField, 1> kOnlyOn = {kOn};
constexpr std::array<WordField, 3> kReconnectionFields = {{
    kOn,
    {"edges", "operator or false", "'recursive_shell_transformation'",
     "what is tried on the edges of a tet, those at the smallest sine first; order and most_edges "
     "as for apply"},
    {"faces", "operator or false", "'multi_face_removal'", "what is tried then on its faces"},
}};
constexpr std::array<ParameterSpec, 1> kReconnectionNumbers = {{
    {"sweeps", ParameterSpec::Kind::integer, 1, 1000, 2,
     "new bad tets are tried in the next sweep"},
}};
constexpr std::array<ParameterSpec, 1> kSmoothNumbers = {{
    {"cycles", ParameterSpec::Kind::integer, 1, 1000, 4,
     "at most; ends earlier when a cycle brings no progress"},
}};
constexpr std::array<ParameterSpec, 7> kPolishNumbers = {{
    {"below", ParameterSpec::Kind::real, 0, 1, 0.7,
     "flips are tried where the mean ratio of a tet is less"},
    {"insert", ParameterSpec::Kind::real, 0, 1, 0.75,
     "a vertex is inserted where the mean ratio of a tet is less; 0: nowhere"},
    {"contract", ParameterSpec::Kind::real, 0, 10, 2,
     "free vertices are removed that have an edge shorter than this share of the length of the "
     "edges around; 0: none"},
    {"lambda", ParameterSpec::Kind::real, 0, 100, 100,
     "percent: where the bad angles come to this share of all, no tet is flipped and no vertex "
     "removed, for fewer tets raise the share"},
    {"grow", ParameterSpec::Kind::real, 0, 10, 1,
     "the mesh grows by at most that share of its tets"},
    {"smooth", ParameterSpec::Kind::real, 0, 1, 1,
     "vertices of tets with a mean ratio below are smoothed"},
    {"cycles", ParameterSpec::Kind::integer, 1, 100, 3,
     "at most; ends earlier when nothing is accepted"},
}};
constexpr std::array<ParameterSpec, 4> kAdaptNumbers = {{
    {"floor", ParameterSpec::Kind::real, 0, 2, 0.35,
     "no new tet is below that quality, or below the worst that it replaces"},
    {"sweeps", ParameterSpec::Kind::integer, 1, 1000, 1,
     "of splits and of contractions, at most; ends earlier when nothing is accepted"},
    {"split", ParameterSpec::Kind::flag, 0, 1, 1, "split what is too long"},
    {"contract", ParameterSpec::Kind::flag, 0, 1, 1, "contract what is too short"},
}};
constexpr std::array<ParameterSpec, 4> kUntangleNumbers = {{
    {"share", ParameterSpec::Kind::real, 0, 1, 0.05,
     "the least share of inverted tets among those around their vertices"},
    {"at_least", ParameterSpec::Kind::integer, 1, 1000000000, 100,
     "the least number of inverted tets that are neighbours"},
    {"rings", ParameterSpec::Kind::integer, 0, 100, 3,
     "how many vertices away from theirs others may move, too"},
    {"looks", ParameterSpec::Kind::integer, 1, 100000, 400, "at all tets of a tangle, at most"},
}};
constexpr std::array<WordField, 3> kVaryFields = {{
    kOn,
    {"schedule", "name", "'shell'", "a built-in one, that works on each copy"},
    {"settings", "table", "{}", "values of its parameters"},
}};
constexpr std::array<ParameterSpec, 4> kVaryNumbers = {{
    {"rings", ParameterSpec::Kind::integer, 1, 100, 4,
     "of vertices around a selected tet that its neighbourhood has"},
    {"variants", ParameterSpec::Kind::integer, 1, 100000, 16, "of each neighbourhood"},
    {"first", ParameterSpec::Kind::integer, 0, 1000000000, 0,
     "number of the first variant; those of other numbers are others"},
    {"floor", ParameterSpec::Kind::real, 0.01, 1, 1,
     "where at most half as many tets are bad, the worst may be worse: down to this share of its "
     "quality"},
}};
constexpr std::array<ParameterSpec, 2> kApplyNumbers = {{
    {"sweeps", ParameterSpec::Kind::integer, 1, 1000, 1,
     "at most; ends earlier when nothing is accepted"},
    {"again", ParameterSpec::Kind::flag, 0, 1, 0, "try also what has not changed since last time"},
}};

constexpr std::array<WordField, 1> kJudgeFields = {{
    {"measure", "name", "'sine_and_length'",
     "'sine', or 'sine_and_length', which sees needles as well; or a measure of a program or "
     "plugin, which stays "
     "where a run began with one"},
}};
constexpr std::array<ParameterSpec, 1> kJudgeNumbers = {{
    {"price", ParameterSpec::Kind::real, 0, 2, Standard::kUsualPrice,
     "what the worst tet must gain for each more bad tet"},
}};
constexpr std::array<ParameterSpec, 2> kGoalNumbers = {{
    {"min", ParameterSpec::Kind::real, 0, 70, 0,
     "degrees, the smallest angle of a good tet; 0: as it is"},
    {"max", ParameterSpec::Kind::real, 0, 179, 0,
     "degrees, the largest angle; 0: 180 less the smallest"},
}};

constexpr std::array<WordInfo, 28> kWords = {{
    {"description", "description \"text\"", "says what the schedule does, in one line"},
    {"parameter", "parameter{\"name\", default = 30, low = 0, high = 100, help = \"...\"}",
     "declares a parameter and returns its value, the default or what --set says; `default` is a "
     "whole number, a fraction, true or false; or `choices = {\"a\", \"b\"}` instead, the first is "
     "the default. Before the first pass"},
    {"begin_round", "begin_round()",
     "begins the next round and returns its number; for the report"},
    {"run_schedule", "run_schedule(\"shell\", {max_rounds = 10})",
     "does what a built-in schedule does, with these values for its parameters"},
    {"local_reconnection", "local_reconnection{...}",
     "Algorithm 5: removes selected tets, the worst first, by operators on their edges and faces",
     kReconnectionFields, kReconnectionNumbers,
     "recursive_shell_transformation multi_face_removal"},
    {"smooth", "smooth{...}", "smooths the movable vertices of selected tets, cycle by cycle",
     kOnlyOn, kSmoothNumbers, "smoothing"},
    {"suppress_points",
     "suppress_points{...}",
     "tries to remove each movable vertex of a selected tet",
     kOnlyOn,
     {},
     "edge_contraction"},
    {"insert_points",
     "insert_points{...}",
     "tries to split the edges of selected tets, the worst tets and longest edges first",
     kOnlyOn,
     {},
     "edge_split"},
    {"polish",
     "polish{...}",
     "raises the mean of the mean ratios: smooths movable vertices, flips, contracts and inserts, "
     "where no tet falls below the goal or gets worse below it. For the end, and, so that edges "
     "are "
     "about as long as those around, for the beginning",
     {},
     kPolishNumbers},
    {"adapt",
     "adapt{...}",
     "splits the edges that are longer than 1.41 of the wanted length, the longest first, and "
     "contracts those shorter than 0.71, the shortest first; each change brings the edges closer "
     "to "
     "that range. Needs --size",
     {},
     kAdaptNumbers},
    {"untangle",
     "untangle{...}",
     "moves all vertices of a tangle at once, so that its inverted and flat tets become positive. "
     "A tangle is where they are many, and neighbours; elsewhere operators do as well, and "
     "nothing is changed. For the beginning",
     {},
     kUntangleNumbers},
    {"vary", "vary{...}",
     "cuts the neighbourhoods of selected tets out, no tet in two, and runs a schedule on copies: "
     "numbered anew and shaken, some with a higher goal, all side by side. The best copy replaces "
     "its neighbourhood where no more tets are bad and the worst are better. For the end",
     kVaryFields, kVaryNumbers},
    {"apply", "apply(what, {...})",
     "tries any operators on selected tets, the worst first: `what` is a name, {name, parameter = "
     "value, order = \"sine\", \"angle\" (largest first), \"longest\" or \"shortest\", most_edges "
     "= 6 (of a tet, the first in that order)}, first_of{...}, all_of{...} or sequence{...}. An "
     "operator on edges, faces or vertices is tried on those of the tet",
     kOnlyOn, kApplyNumbers},
    {"attempt", "attempt(what, {vertex, ...}, {vertex, vertex, vertex, vertex})",
     "tries one operator or one sequence once; `what` is as for apply, without order. The target "
     "is the vertex, or the edge, face or tet of these vertices, by their numbers (from 0) in the "
     "mesh as it would be written now. An edge or face is seen from the tet of the last four "
     "vertices, if they are given: that may decide what is tried first"},
    {"first_of", "first_of{what, what, ...}",
     "for apply: tries the parts on one tet in turn until an attempt is accepted"},
    {"all_of", "all_of{what, what, ...}",
     "for apply: tries the parts on one tet in turn until the tet is gone"},
    {"sequence", "sequence{operator, what, ..., desperate = 0.4, theta_max = 180}",
     "for apply: one attempt of several parts. The operator may make things worse; the others then "
     "work on the bad tets among all that has changed. The result stays only if it is better as a "
     "whole and the bad tets lack less in sum. If the worst tet was below `desperate`, a gain of "
     "0.002 pays for one more bad tet instead. With a theta_max below 180 degrees it is for tets "
     "with a larger angle, and what follows works on such tets as well. The result then stays if "
     "the worst tet gets no worse and the sine of the largest angle gains 0.002, and as much for "
     "each more bad tet"},
    {"goal",
     "goal{min = 35, max = 140}",
     "from now on another goal: a tet is bad that misses it, and a quality of 1 means that it is "
     "just met. Nothing counts as tried then",
     {},
     kGoalNumbers},
    {"judge_by", "judge_by{measure = \"sine\", price = 0.1}",
     "from now on other judges: what they take for the quality of a tet, and what new bad tets "
     "cost. Nothing counts as tried then",
     kJudgeFields, kJudgeNumbers},
    {"hold_mean", "hold_mean(0.7)",
     "from now on what makes the mesh grow adds tets that are round enough: the mean ratios of all "
     "that changes, each less this number, have no smaller sum than before. 0: as from the start"},
    {"hold_worst", "hold_worst()",
     "from now on no change makes a tet with a smaller angle than the smallest of the mesh now. "
     "None makes a larger one than its largest and that of the goal. From the start it is so with "
     "those of the input"},
    {"quality_of_angle", "quality_of_angle(degrees)",
     "the quality of a tet whose worst angle is this, for the present goal"},
    {"quality", "quality()",
     "the mesh now: q_worst (1: the goal is just met), n_bad (tets that miss it), n_needles "
     "(others of a quality below 1), q_aver (mean quality of both), q_few (of the 32 worst that "
     "may change); goal_min, goal_max, theta_min, theta_max, lambda, mean_ratio "
     "and radius_ratio (the means of all tets), tets, vertices; seconds (since the start), passes "
     "(so far), date (of the sweep that comes next, for selections). q_few, theta_min, theta_max, "
     "lambda, mean_ratio and radius_ratio are measured when they are read, which must be before "
     "the "
     "next pass"},
    {"limit", "limit()",
     "what the walls of the mesh (surface, constraints, protected tets) allow at best: n_forced, "
     "the least number of bad tets; q_worst (as quality() has it), theta_min, theta_max, nil where "
     "no "
     "bound is known. "
     "Where the surface may move, only constraints inside count, and with --surface flat sharp "
     "feature lines. "
     "Also the numbers of bad tets by what holds them: frozen, surface, constraint, "
     "no_free_vertex, search. Takes as long as a short pass"},
    {"is_progress", "is_progress(before, now)",
     "true if the quality `now` is noticeably better: the worst by 0.01, the number of bad tets "
     "by 5 %, or their mean by 0.01 with no more of them"},
    {"operators", "operators()", "the names of all operators, those of plugins as well"},
    {"log", "log(...)", "notes values in the report and shows them"},
    {"print", "print(...)", "the same as log"},
}};

}  // namespace

std::span<const WordInfo> schedule_words() {
  return kWords;
}

const WordInfo& find_word(std::string_view name) {
  const auto word = std::find_if(kWords.begin(), kWords.end(),
                                 [&](const WordInfo& info) { return info.name == name; });
  assert(word != kWords.end());
  return *word;
}

}  // namespace tetmend
