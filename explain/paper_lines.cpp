// SPDX-License-Identifier: MIT
#include "explain/paper_lines.h"

namespace tetmend::explain {

namespace {

constexpr std::array<std::string_view, 8> kShell = {
    "best triangulation of each pocket p_i .. p_j",
    "the same for pockets beyond p_m",
    "graph: an arc i -> j for each pocket that has one",
    "core: the best cycle of arcs; none: full reduction",
    "triangles: those of the pockets outside the core",
    "covering: 2 tets a triangle, 1 tet a side of the core",
    "if it is better than the old tets",
    "    replace them by it"};
constexpr Pseudocode kShellCode = {"Algorithm 3: shell transformation of edge ab", kShell};

constexpr std::array<std::string_view, 15> kRecursion = {
    "if edge e, or face f, is gone already",
    "    success",
    "transform the shell of e (Algorithm 3)",
    "if edge e, or face f, is gone now",
    "    success",
    "if the level is the deepest allowed",
    "    fail",
    "m = degree of the shell",
    "for each supporting face f_i of e",
    "    e' = its reflex link edge, if any",
    "    if there is one",
    "        recursion: remove f_i at e', level + 1",
    "        if the degree is below m now",
    "            once more from line 1",
    "fail"};
constexpr Pseudocode kRecursionCode = {"Algorithm 4: remove edge e, or face f at e", kRecursion};

constexpr std::array<std::string_view, 14> kTables = {
    "for d = 2 to m - 1",
    "    for i = 1 to m",
    "        j' = i + d",
    "        for k' = i + 1 to j' - 1",
    "            j = j' beyond m ? j' - m : j'",
    "            k = k' beyond m ? k' - m : k'",
    "            q = worse of the two tets at p_i p_k p_j",
    "            if k' < j' - 1",
    "                q = min(q, M_q(k, j))",
    "            if k' > i + 1",
    "                q = min(q, M_q(i, k))",
    "            if k' = i + 1 or q > M_q(i, j)",
    "                M_q(i, j) = q",
    "                M_k(i, j) = k"};
constexpr Pseudocode kTableCode = {"Algorithm 2: filling in M_q and M_k", kTables};

constexpr std::array<std::string_view, 16> kReconnection = {
    "queue all bad tets, the worst first",
    "while there are any",
    "    t = the first of them",
    "    if t is gone already",
    "        go to line 16",
    "    E = edges of t that may be removed",
    "    for each edge e_j of E",
    "        recursion: remove e_j (Algorithm 4)",
    "        if t is gone",
    "            go to line 16",
    "    F = faces of t that may be removed",
    "    for each face f_j of F",
    "        multi-face removal of f_j",
    "        if t is gone",
    "            no more faces",
    "    take t out of the queue"};
constexpr Pseudocode kReconnectionCode = {"Algorithm 5: local reconnection", kReconnection};

constexpr std::array<std::string_view, 7> kFaces = {"a, b = the two vertices that see face f",
                                                    "faces connected with f that both of them see",
                                                    "polygon: the outline of these faces",
                                                    "leave out faces at vertices inside of it",
                                                    "its best covering, as in Algorithm 3",
                                                    "if that is better than the old tets",
                                                    "    replace them by it"};
constexpr Pseudocode kFacesCode = {"Multi-face removal of face f (5.4)", kFaces};

constexpr std::array<std::string_view, 7> kSmoothing = {
    "ball: the tets around vertex v",
    "try the mean of its neighbours",
    "if the worst tet is better there, begin there",
    "if a tet is bad still",
    "    climb to where the worst tet is best",
    "if the ball is better as a whole",
    "    move v there"};
constexpr Pseudocode kSmoothingCode = {"Smoothing of vertex v (6.2)", kSmoothing};

constexpr std::array<std::string_view, 5> kSplit = {
    "shell: the tets around edge ab", "put a vertex v on ab: each tet becomes two",
    "climb with v to where the worst tet is best", "if the new tets are better than the old ones",
    "    keep them"};
constexpr Pseudocode kSplitCode = {"Edge split, ab (6.3)", kSplit};

constexpr std::array<std::string_view, 6> kContraction = {
    "for each neighbour w of vertex v",
    "    v merged into w: the tets of edge vw vanish",
    "take the w whose tets are best",
    "smooth w",
    "if the tets around w are better than the old ones",
    "    keep them"};
constexpr Pseudocode kContractionCode = {"Edge contraction at vertex v (6.3)", kContraction};

constexpr std::array<std::string_view, 8> kCavity = {
    "for the centroids of tet t, its faces and its edges",
    "    cavity: t, and tets around it whose removal",
    "    makes the worst of the new tets best",
    "for the most promising of these places",
    "    replace the cavity by tets at a new vertex",
    "    smooth and reconnect around the vertex",
    "    if all that changed is better now",
    "        keep it"};
constexpr Pseudocode kCavityCode = {"Insertion by cavity, into tet t", kCavity};

constexpr std::array<std::string_view, 7> kPolyhedron = {
    "polyhedron: tet t",
    "while it is smaller than allowed",
    "    add a vertex, with all tets between its vertices",
    "    search all its tetrahedralisations for the best",
    "    if that is better than the old tets",
    "        replace them by it",
    "fail"};
constexpr Pseudocode kPolyhedronCode = {"Small polyhedron reconnection, at tet t", kPolyhedron};

constexpr std::array<std::string_view, 6> kJoint = {
    "the free vertices of tet t, and all tets around them",
    "climb with all of them to where the bad tets lack least",
    "    first in sum, then more and more the worst of them",
    "if that helps tet t",
    "if the tets are better as a whole",
    "    move the vertices there"};
constexpr Pseudocode kJointCode = {"Joint smoothing of tet t", kJoint};

constexpr std::array<std::string_view, 5> kMean = {
    "go to where the tets around vertex v are round on average", "if their mean gains enough",
    "    for all, a half and a quarter of the way there",
    "        move v; if the tets are better as a whole", "            keep it"};
constexpr Pseudocode kMeanCode = {"Mean smoothing of vertex v", kMean};

constexpr std::array<std::string_view, 7> kSequence = {
    "opening: the first operator, which may make tets worse",
    "if it has changed nothing: fail",
    "for the bad tets among all that has changed so far",
    "    try the next operators, as if they were alone",
    "if all that has changed is better than at first",
    "    keep it",
    "else undo it all"};
constexpr Pseudocode kSequenceCode = {"Sequence of operators at one target", kSequence};

/// The line of an attempt that calls nothing described here, by what has happened last.
struct Lines {
  Algorithm algorithm;
  const Pseudocode* code;
  unsigned begins, candidate, edit, undone, inner;
  unsigned accepted, refused_candidate, nothing_found, not_for_it;
};

constexpr std::array<Lines, 6> kLines = {{
    {Algorithm::multi_face_removal, &kFacesCode, 1, 5, 7, 6, 5, 7, 6, 5, 1},
    {Algorithm::smoothing, &kSmoothingCode, 1, 6, 7, 6, 1, 7, 6, 5, 1},
    {Algorithm::edge_split, &kSplitCode, 1, 2, 2, 4, 3, 5, 4, 3, 1},
    {Algorithm::edge_contraction, &kContractionCode, 1, 3, 3, 5, 4, 6, 5, 2, 1},
    {Algorithm::cavity_insertion, &kCavityCode, 1, 4, 5, 7, 6, 8, 7, 3, 1},
    {Algorithm::polyhedron_reconnection, &kPolyhedronCode, 1, 2, 6, 5, 4, 6, 7, 7, 1},
}};

// Those that a trace knows by their names alone.
constexpr Lines kJointLines = {Algorithm::other, &kJointCode, 1, 4, 6, 5, 2, 6, 5, 4, 1};
constexpr Lines kMeanLines = {Algorithm::other, &kMeanCode, 1, 2, 4, 4, 1, 5, 4, 2, 1};
constexpr Lines kSequenceLines = {Algorithm::other, &kSequenceCode, 1, 5, 1, 7, 4, 6, 7, 2, 1};

const Lines* lines_of(const TraceFile& file, const Call& call) {
  for (const Lines& lines : kLines) {
    if (lines.algorithm == call.algorithm) return &lines;
  }
  if (call.algorithm != Algorithm::other) return nullptr;
  const std::string_view name = file.name(call.operator_name);
  if (name == "joint_smoothing") return &kJointLines;
  if (name == "mean_smoothing") return &kMeanLines;
  return name.substr(0, name.find('(')) == "sequence" ? &kSequenceLines : nullptr;
}

bool is_shell(const Call& call) {
  return call.algorithm == Algorithm::shell_transformation ||
         call.algorithm == Algorithm::edge_removal;
}

EventKind last_kind(const TraceFile& file, std::uint64_t position) {
  EventCursor cursor(file);
  cursor.move_to(position - 1);
  return cursor.next().kind;
}

unsigned line_of_end(const Call& call) {
  if (call.accepted()) return 8;
  if (!call.has_searched()) return 1;
  return call.verdict == Verdict::no_improvement && !call.candidate_found ? 4 : 7;
}

unsigned line_of_shell(const TraceFile& file, const Call& call, std::uint64_t position) {
  switch (last_kind(file, position)) {
    case EventKind::attempt_begins:
      return 1;
    case EventKind::candidate_found:
      return 6;
    case EventKind::attempt_ends:
      return line_of_end(call);
    case EventKind::undo:
      return 7;
    default:
      return 8;
  }
}

/// The call is the innermost: it has just begun or ended.
unsigned line_of_recursion(const TraceFile& file, std::uint32_t number, std::uint64_t position) {
  const Call& call = file.calls()[number];
  if (position < call.events.end) return 1;
  if (call.accepted()) return 5;
  const bool recursed = call.subtree_end > number + 2;  // more in it than its own transformation
  return call.verdict == Verdict::depth_spent && !recursed ? 7 : 15;
}

unsigned line_of_end(const Lines& lines, const Call& call) {
  if (call.accepted()) return lines.accepted;
  if (call.candidate_found) return lines.refused_candidate;
  const bool has_searched =
      call.verdict == Verdict::no_improvement || call.verdict == Verdict::budget_spent;
  return has_searched ? lines.nothing_found : lines.not_for_it;
}

unsigned line_of(const TraceFile& file, const Lines& lines, const Call& call,
                 std::uint64_t position) {
  switch (last_kind(file, position)) {
    case EventKind::attempt_begins:
      return lines.begins;
    case EventKind::candidate_found:
      return lines.candidate;
    case EventKind::attempt_ends:
      return line_of_end(lines, call);
    case EventKind::undo:
      return lines.undone;
    default:
      return lines.edit;
  }
}

/// The pass that is open, or nothing.
const TracedPass* pass_at(const TraceFile& file, std::uint64_t position) {
  for (const TracedPass& pass : file.passes()) {
    if (pass.events.begin < position && position <= pass.events.end) return &pass;
  }
  return nullptr;
}

}  // namespace

const Pseudocode& shell_transformation_code() {
  return kShellCode;
}

const Pseudocode& recursion_code() {
  return kRecursionCode;
}

const Pseudocode& reconnection_code() {
  return kReconnectionCode;
}

const Pseudocode& table_code() {
  return kTableCode;
}

const Pseudocode* code_of(const TraceFile& file, const Call& call) {
  if (const Lines* lines = lines_of(file, call)) return lines->code;
  if (call.algorithm == Algorithm::recursion) return &kRecursionCode;
  return searches_covering(call.algorithm) ? &kShellCode : nullptr;
}

CodePlace code_place(const TraceFile& file, std::span<const std::uint32_t> stack, std::size_t i,
                     std::uint64_t position) {
  const Call& call = file.calls()[stack[i]];
  const Pseudocode* code = code_of(file, call);
  if (code == nullptr) return {};
  const bool is_innermost = i + 1 == stack.size();
  const bool is_back = !is_innermost && file.calls()[stack[i + 1]].events.end <= position;
  if (const Lines* lines = lines_of(file, call)) {
    const bool is_opening =
        lines == &kSequenceLines && !is_innermost && stack[i + 1] == stack[i] + 1;
    if (is_opening) return {code, 1, is_back ? 2U : 0U};
    return {code, is_innermost ? line_of(file, *lines, call, position) : lines->inner, 0};
  }
  if (is_shell(call)) return {code, is_innermost ? line_of_shell(file, call, position) : 1, 0};
  if (is_innermost) return {code, line_of_recursion(file, stack[i], position), 0};
  const Call& inner = file.calls()[stack[i + 1]];
  const unsigned line = is_shell(inner) ? 3 : 12;
  return {code, line, is_back ? line + 1 : 0};
}

CodePlace pass_place(const TraceFile& file, std::span<const std::uint32_t> stack,
                     std::uint64_t position) {
  constexpr std::string_view kName = "local_reconnection";
  const TracedPass* pass = position == 0 ? nullptr : pass_at(file, position);
  if (pass == nullptr || file.name(pass->name) != kName) return {};
  constexpr unsigned kFaceOfTriangle = 3;
  if (!stack.empty()) {
    const Call& call = file.calls()[stack.front()];
    const bool is_face = call.target_size == kFaceOfTriangle;
    const bool is_done = call.events.end <= position;
    const unsigned line = is_face ? 13 : 8;
    return {&kReconnectionCode, line, is_done ? line + 1 : 0};
  }
  switch (last_kind(file, position)) {
    case EventKind::pass_begins:
      return {&kReconnectionCode, 1, 0};
    case EventKind::visit_begins:
      return {&kReconnectionCode, 3, 0};
    case EventKind::visit_ends:
      return {&kReconnectionCode, 16, 0};
    default:
      return {&kReconnectionCode, 2, 0};
  }
}

}  // namespace tetmend::explain
