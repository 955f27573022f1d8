// SPDX-License-Identifier: MIT
// Makes the lessons of assets/lessons: small meshes, runs on them that are recorded, and texts that
// lead through the traces. All numbers in the texts are read from the traces.
//
//   make_lessons OUTDIR
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contract/zoo.h"
#include "explain/call_facts.h"
#include "explain/call_study.h"
#include "explain/paper_lines.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/formats/output_file.h"
#include "kernel/shell.h"
#include "kernel/spaced.h"
#include "kernel/workspace.h"
#include "ops/registry.h"
#include "schedule/run.h"
#include "schedule/schedule.h"
#include "trace/lesson.h"
#include "trace/recorder.h"
#include "trace/replay.h"
#include "trace/trace_file.h"

namespace tetmend {
namespace {

using Tets = std::vector<std::array<std::uint32_t, 4>>;

// --- meshes --------------------------------------------------------------------------------------

/// Adds points, moved by (x, 0, 0), and tets that name them from 0.
void add_piece(MeshData& mesh, double x, const std::vector<Point>& points, const Tets& tets) {
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  for (const Point& p : points) mesh.points.emplace_back(p.x() + x, p.y(), p.z());
  for (auto tet : tets) {
    for (std::uint32_t& v : tet) v += first;
    mesh.tets.push_back({tet, 0});
  }
}

//          a = 0, b = 1: six tets around the edge a b, the skirt polygon is 2 3 4 5 6 7. No
//          covering without a b is better than the worst of the six; one that leaves four of the
//          vertices without triangles is.
MeshData shell_with_core() {
  MeshData mesh;
  add_piece(mesh, 0,
            {{0.1, 0.2, -1.15},
             {0.25, 0.3, 1.15},
             {0.85, -0.25, 0.1},
             {0.95, 1.25, 0.1},
             {-0.4, 0.45, 0.05},
             {-1.35, 0.1, -0.05},
             {-0.35, -1.45, 0.05},
             {0.35, -0.4, -0.05}},
            {{0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 4, 5}, {0, 1, 5, 6}, {0, 1, 6, 7}, {0, 1, 7, 2}});
  return mesh;
}

/// [chen, Fig. 5]: a b with five tets around it, and the edge 1 5 with a tet of its own.
MeshData two_shells() {
  MeshData mesh;
  add_piece(mesh, 0,
            {{-0.05, 0.05, -0.9},
             {-0.15, 0.1, 0.9},
             {1.45, 0.05, 0.75},
             {0.2, 0.45, 0.15},
             {-0.6, 0.15, 0.55},
             {-0.75, -0.6, -0.35},
             {0.25, -0.55, 0.7}},
            {{0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 4, 5}, {0, 1, 5, 6}, {0, 1, 6, 2}, {1, 4, 5, 6}});
  return mesh;
}

/// Side by side: a good shell of five (vertices 0 to 6), three tets whose edge passes beside the
/// triangle of their ring (7 to 11), and two shells that only the recursion can improve (12 to 18).
MeshData pieces() {
  MeshData mesh;
  add_piece(mesh, 0,
            {{0, 0, -1},
             {0, 0, 1},
             {1, 0, 0},
             {0.31, 0.95, 0},
             {-0.81, 0.59, 0},
             {-0.81, -0.59, 0},
             {0.31, -0.95, 0}},
            {{0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 4, 5}, {0, 1, 5, 6}, {0, 1, 6, 2}});
  add_piece(mesh, 3, {{0, 0, -1}, {0, 0, 1}, {0.8, 0, 1.4}, {-0.4, 0.8, 1.4}, {-0.4, -0.8, 1.4}},
            {{0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 4, 2}});
  add_piece(mesh, 6,
            {{-0.52, -0.44, 0.73},
             {0.52, 0.44, -0.73},
             {-0.41, 1.14, 1.12},
             {0.95, 0.51, 0.87},
             {0.08, 1.55, -0.12},
             {-1.02, -0.02, -0.21},
             {-0.15, -0.65, -0.19}},
            {{0, 2, 3, 1}, {0, 4, 2, 1}, {5, 4, 0, 1}, {5, 0, 4, 2}, {5, 0, 6, 1}, {0, 3, 6, 1}});
  return mesh;
}

/// A ring of six around an edge that passes close to one of its sides: all pockets have
/// triangulations, and the best one of the whole ring is no fan.
MeshData shell_beside_axis() {
  MeshData mesh;
  add_piece(mesh, 0,
            {{-0.28, -0.47, -1.13},
             {-0.04, -0.58, 1.17},
             {1.26, -0.13, 0.16},
             {0.43, 0.85, -0.06},
             {-0.49, 0.59, 0.04},
             {-1.1, 0.12, -0.13},
             {-0.52, -0.51, 0.06},
             {0.25, -0.6, 0.14}},
            {{0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 4, 5}, {0, 1, 5, 6}, {0, 1, 6, 7}, {0, 1, 7, 2}});
  return mesh;
}

/// Side by side: the two shells of the second lesson (0 to 6), two flat tets on one face (7 to 11),
/// and a flat tet by itself (12 to 15), which nothing can help.
MeshData three_cures() {
  MeshData mesh = two_shells();
  add_piece(mesh, 3.2, {{1, 0, 0}, {-0.5, 0.87, 0}, {-0.5, -0.87, 0}, {0, 0, 0.25}, {0, 0, -0.25}},
            {{0, 1, 2, 3}, {1, 0, 2, 4}});
  add_piece(mesh, 5.4, {{1, 0, 0}, {-0.5, 0.87, 0}, {-0.5, -0.87, 0}, {0, 0, 0.2}}, {{0, 1, 2, 3}});
  return mesh;
}

/// A ball around vertex 6, which is off its middle.
MeshData lopsided_ball() {
  MeshData mesh;
  add_piece(mesh, 0,
            {{1, 0, 0},
             {-1, 0, 0},
             {0, 1.1, 0},
             {0, -1, 0.1},
             {0, 0, 1.2},
             {0.1, 0, -1},
             {0.42, 0.3, 0.28}},
            {{6, 0, 2, 4},
             {6, 2, 1, 4},
             {6, 1, 3, 4},
             {6, 3, 0, 4},
             {6, 2, 0, 5},
             {6, 1, 2, 5},
             {6, 3, 1, 5},
             {6, 0, 3, 5}});
  return mesh;
}

/// Eleven random points: places with three digits, as the file has them.
MeshData eleven_points() {
  constexpr std::uint64_t kSeed = 1;
  constexpr double kDigits = 1000;
  MeshData mesh = contract::delaunay_ball(11, kSeed);
  for (Point& p : mesh.points) p = (p * kDigits).array().round() / kDigits;
  return mesh;
}

// --- the texts -----------------------------------------------------------------------------------

/// Collects the steps of a lesson while the trace is played.
class LessonWriter {
 public:
  explicit LessonWriter(const TraceFile& file) : file_(file), replay_(file) {}

  const std::vector<LessonStep>& steps() const { return steps_; }
  const TraceFile& file() const { return file_; }
  const Call& call(std::uint32_t number) const { return file_.calls()[number]; }

  void say(std::uint64_t at, std::string text, std::vector<Focus> focus) {
    steps_.push_back({at, std::move(text), std::move(focus)});
  }
  /// At the last step.
  void ask(Ask::Kind kind, std::string text) { steps_.back().ask = Ask{kind, std::move(text)}; }
  void ask_for(std::string of, std::string text) {
    steps_.back().ask = Ask{Ask::Kind::number, std::move(text), std::move(of)};
  }

  bool has_algorithm(const Call& c) const { return explain::code_of(file_, c) != nullptr; }
  std::string name(const Call& c) const { return std::string(file_.name(c.operator_name)); }
  std::string reason(const Call& c) const { return std::string(file_.reason(c)); }

  /// The first call from `from` on for which the condition holds.
  /// @throws Error when there is none: the lesson does not fit what tetmend does.
  template <class Condition>
  std::uint32_t find(std::uint32_t from, const Condition& holds) const {
    for (std::uint32_t c = from; c < file_.calls().size(); ++c) {
      if (holds(call(c))) return c;
    }
    throw Error("a call that a lesson tells of is not in its trace");
  }
  /// Just after the first event of a kind in a call.
  std::uint64_t after(const Call& c, EventKind kind) const {
    EventCursor cursor(file_);
    cursor.move_to(c.events.begin);
    while (cursor.position() < c.events.end) {
      if (cursor.next().kind == kind) return cursor.position();
    }
    throw Error("an event that a lesson tells of is not in its trace");
  }
  /// Vertices across the supporting edge ab after so many events, in the order of their numbers:
  /// those of the skirt polygon, or of its core. Empty when the edge is gone.
  std::vector<std::uint32_t> around(std::uint64_t at, std::uint32_t a, std::uint32_t b) {
    replay_.seek(at);
    const SlotMesh& mesh = replay_.mesh();
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
      if (mesh.is_deleted(TetHandle(i))) continue;
      const TetVertices& tet = mesh.vertices(TetHandle(i));
      if (std::ranges::count(tet, VertexHandle(a)) + std::ranges::count(tet, VertexHandle(b)) != 2)
        continue;
      for (const VertexHandle v : tet) {
        if (v.index() != a && v.index() != b) vertices.push_back(v.index());
      }
    }
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }
  Cavity cavity(std::uint64_t at) {
    replay_.seek(at);
    return replay_.cavity();
  }
  Quality worst(std::uint64_t at) {
    replay_.seek(at);
    Quality worst = std::numeric_limits<Quality>::infinity();
    for (std::uint32_t i = 0; i < replay_.mesh().tet_slots(); ++i) {
      if (replay_.mesh().is_deleted(TetHandle(i))) continue;
      worst = std::min(worst, replay_.mesh().quality(TetHandle(i)));
    }
    return worst;
  }
  /// Bad tets of the first mesh whose vertices all have smaller numbers than that.
  std::size_t bad_below(std::size_t end) {
    replay_.seek(0);
    const SlotMesh& mesh = replay_.mesh();
    const auto is_below = [end](VertexHandle v) { return v.index() < end; };
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
      const TetHandle t(i);
      if (mesh.is_deleted(t) || mesh.quality(t) >= 1) continue;
      if (std::ranges::all_of(mesh.vertices(t), is_below)) ++count;
    }
    return count;
  }

 private:
  const TraceFile& file_;
  Replay replay_;
  std::vector<LessonStep> steps_;
};

std::string join(const std::vector<std::uint32_t>& numbers) {
  return fmt::format("{}", fmt::join(numbers, " "));
}

/// What is in one list and not in the other; both ascending.
std::vector<std::uint32_t> without(const std::vector<std::uint32_t>& all,
                                   const std::vector<std::uint32_t>& some) {
  std::vector<std::uint32_t> rest;
  std::ranges::set_difference(all, some, std::back_inserter(rest));
  return rest;
}

std::string qualities(const Call& c) {
  return fmt::format("the worst quality among the tets that changed was {:.4f} and is {:.4f}",
                     c.worst_before, c.worst_after);
}

std::string numbers(const Call& c) {
  std::vector<std::uint32_t> vertices;
  for (const VertexHandle v : c.target()) vertices.push_back(v.index());
  return join(vertices);
}

/// As the beginning of a sentence.
std::string capital(std::string text) {
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

void write_core(LessonWriter& lesson) {
  const Call& removal = lesson.call(0);
  const Call& transformation = lesson.call(1);
  const auto ring = lesson.around(0, 0, 1);
  const std::uint64_t found = lesson.after(transformation, EventKind::candidate_found);
  const std::uint64_t replaced = lesson.after(transformation, EventKind::replace_cavity);
  const auto core = lesson.around(replaced, 0, 1);
  const Cavity cavity = lesson.cavity(replaced);
  lesson.say(0,
             fmt::format("{} tets share the edge 0 1: they are its shell, and it is their "
                         "supporting edge. The vertices around it, {}, are the skirt polygon. "
                         "Each of them makes a supporting face with the edge. The worst tet has "
                         "quality {:.4f}.",
                         ring.size(), join(ring), lesson.worst(0)),
             {Focus::picture});
  lesson.say(removal.events.begin + 1,
             "Edge removal is tried first. It fills the shell with tets that do not have the edge: "
             "the whole skirt polygon is triangulated, and each triangle makes one tet with vertex "
             "0 and one with vertex 1.",
             {Focus::picture, Focus::ring});
  lesson.ask(Ask::Kind::accepted, "Will edge removal be accepted?");
  lesson.say(removal.events.end,
             fmt::format("The answer is \"{}\": {}. Every triangulation of the whole skirt polygon "
                         "has a tet that is no better than the worst of the shell.",
                         removal.verdict_text(), lesson.reason(removal)),
             {Focus::ring});
  lesson.say(transformation.events.begin + 1,
             "Shell transformation has more to choose from: a part of the skirt polygon, the core, "
             "may stay without triangles, and there the supporting edge stays.",
             {Focus::ring});
  lesson.ask(Ask::Kind::chord,
             "Which chord cuts corners off? Pick one of the covering that is best.");
  lesson.say(found,
             fmt::format("The best covering is found. Triangles cut off the skirt vertices "
                         "{}; the core polygon is {}.",
                         join(without(ring, core)), join(core)),
             {Focus::picture, Focus::ring});
  lesson.ask_for("tets made",
                 "Two new tets for each triangle, and one for the new side of the core: how many "
                 "tets will be made?");
  lesson.say(replaced,
             fmt::format("{} tets give way to {}. The supporting faces at {} are gone. "
                         "The edge is still there, with {} supporting faces instead of "
                         "{}: the shell is partially reduced.",
                         cavity.removed.size(), cavity.created.size(), join(without(ring, core)),
                         core.size(), ring.size()),
             {Focus::picture, Focus::ring});
  lesson.say(transformation.events.end,
             fmt::format("The quality vector is better, so the change is kept: {}. The recursion "
                         "goes on from here: see the next lesson.",
                         qualities(transformation)),
             {Focus::picture, Focus::ring});
}

/// Of the lesson on two shells, until the recursion calls itself.
void tell_first_shell(LessonWriter& lesson, const Call& inner) {
  const Call& root = lesson.call(0);
  const Call& first = lesson.call(1);
  const std::uint32_t a = inner.target()[0].index();
  const std::uint32_t b = inner.target()[1].index();
  const auto ring = lesson.around(0, 0, 1);
  const auto reduced = lesson.around(first.events.end, 0, 1);
  lesson.say(0,
             fmt::format("Two shells that overlap, as in Figure 5 of the paper: that of the "
                         "edge 0 1 with {} tets, and that of the edge {} {}. The edge 0 1 is to "
                         "be removed: the worst tet has quality {:.4f}.",
                         ring.size(), a, b, lesson.worst(0)),
             {Focus::picture});
  lesson.say(root.events.begin + 1,
             "The recursive shell transformation of the edge 0 1 begins, on level 0.",
             {Focus::algorithm});
  lesson.ask(Ask::Kind::line, "Which line of Algorithm 4 comes next?");
  lesson.say(first.events.begin + 1, "First it transforms the shell of 0 1 by itself.",
             {Focus::ring});
  lesson.ask(Ask::Kind::chord, "One chord will cut a corner off. Which?");
  lesson.say(first.events.end,
             fmt::format("That reduces the shell from {} tets to {}: the supporting face at {} is "
                         "gone, the core {} stays, and so does the edge.",
                         ring.size(), reduced.size(), join(without(ring, reduced)), join(reduced)),
             {Focus::picture, Focus::ring});
}

void write_two_shells(LessonWriter& lesson) {
  const auto is = [](Algorithm algorithm, unsigned level) {
    return [algorithm, level](const Call& c) {
      return c.algorithm == algorithm && c.level == level && c.accepted();
    };
  };
  constexpr Algorithm kRecursive = Algorithm::recursion;
  constexpr Algorithm kPlain = Algorithm::shell_transformation;
  const Call& root = lesson.call(0);
  const std::uint32_t inner_number = lesson.find(2, is(kRecursive, 1));
  const Call& inner = lesson.call(inner_number);
  const Call& second = lesson.call(lesson.find(inner_number, is(kPlain, 1)));
  const Call& third = lesson.call(lesson.find(inner.subtree_end, is(kPlain, 0)));
  const std::uint32_t a = inner.target()[0].index();
  const std::uint32_t b = inner.target()[1].index();
  const auto last = lesson.around(inner.events.end, 0, 1);

  tell_first_shell(lesson, inner);
  lesson.say(inner.events.begin + 1,
             fmt::format("A supporting face goes when one of its link edges does. The face of 0 1 "
                         "and {0} has the link edge {1} {0}, at which the shell is not convex. The "
                         "procedure calls itself for that edge, on level 1.",
                         b, a),
             {Focus::picture, Focus::algorithm});
  lesson.say(second.events.begin + 1,
             fmt::format("The shell of {} {} has {} tets. It is transformed in the same way.", a, b,
                         lesson.around(second.events.begin, a, b).size()),
             {Focus::picture, Focus::ring});
  lesson.ask(Ask::Kind::accepted, "Will this transformation be accepted?");
  lesson.say(inner.events.end,
             fmt::format("It is fully reduced: {0} {1} is gone, and with it the supporting face at "
                         "{1}. The shell of 0 1 has {2} tets now: {3}.",
                         a, b, last.size(), qualities(second)),
             {Focus::picture, Focus::tree});
  lesson.say(third.events.begin + 1,
             "Back on level 0, the shell of 0 1 is smaller than before and transformed again.",
             {Focus::picture, Focus::ring});
  lesson.ask_for(
      "tets made",
      fmt::format("How many tets will take the place of the {} around the edge?", last.size()));
  lesson.say(
      third.events.end,
      fmt::format("With {} tets around it the edge 0 1 gives way to {}: a 3-2 flip.", last.size(),
                  lesson.cavity(lesson.after(third, EventKind::replace_cavity)).created.size()),
      {Focus::picture, Focus::ring});
  lesson.say(root.events.end,
             fmt::format("The quality vector of all that changed is compared once more for the "
                         "whole recursion, and it is better: {}.",
                         qualities(root)),
             {Focus::picture, Focus::tree});
}

/// What there is to say about each reason to refuse.
struct Refusal {
  Verdict verdict;
  std::string_view before;  ///< at the target
  std::string_view after;   ///< once it was refused
  std::vector<Focus> focus = {Focus::picture, Focus::ring};
};

const std::array<Refusal, 7> kRefusals = {{
    {Verdict::not_applicable, "Five tets share the edge.",
     "A 3-2 flip is for edges of three tets only."},
    {Verdict::constrained,
     "The edge lies on the boundary.",
     "The surface must stay as it is. Constrained faces and edges inside the mesh are kept in the "
     "same way.",
     {Focus::picture}},
    {Verdict::no_improvement, "The shell of the edge is good already.",
     "All coverings of the shell were searched."},
    {Verdict::inverted, "Three tets share the edge, but it passes beside the triangle of its ring.",
     "One of the two new tets would be turned inside out."},
    {Verdict::depth_spent,
     "The operator may not call itself here: its parameter max_level is 0.",
     "Its own shell alone cannot be improved, and the shells beside it are not tried.",
     {Focus::algorithm}},
    {Verdict::budget_spent,
     "The same edge. The operator may call itself, but has one shell transformation to spend: its "
     "parameter budget is 1.",
     "It was spent on its own shell, without result. For the link edges nothing was left.",
     {Focus::picture, Focus::tree}},
    {Verdict::deferred,
     "Threads share a mesh by its vertices, and here one vertex of the shell belongs to another.",
     "This is no answer yet: the attempt is made again when the mesh is divided in another way."},
}};

/// An operator at the beginning of a sentence.
std::string prose_name(const std::string& operator_name) {
  if (operator_name.starts_with("flip_")) return "A " + explain::short_name(operator_name);
  std::string name = spaced(operator_name);
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return name;
}

void write_refusals(LessonWriter& lesson) {
  lesson.say(0,
             "Three small pieces, and one attempt for each reason to refuse. A refusal leaves no "
             "trace in the mesh.",
             {Focus::picture});
  for (const Refusal& refusal : kRefusals) {
    const Call& call = lesson.call(lesson.find(
        0, [&](const Call& c) { return c.depth == 0 && c.verdict == refusal.verdict; }));
    lesson.say(call.events.begin + 1,
               fmt::format("{} at the edge {} {}. {}", prose_name(lesson.name(call)),
                           call.target()[0].index(), call.target()[1].index(), refusal.before),
               refusal.focus);
    if (refusal.verdict == Verdict::no_improvement) {
      lesson.ask_for("triangulations", "How many triangulations has a ring of five corners?");
    } else if (refusal.verdict == Verdict::depth_spent) {
      lesson.ask(Ask::Kind::line, "Which line of Algorithm 4 comes next?");
    }
    lesson.say(call.events.end,
               fmt::format("The answer is \"{}\": {}. {}", call.verdict_text(), lesson.reason(call),
                           refusal.after),
               lesson.has_algorithm(call) ? std::vector{Focus::picture, Focus::algorithm}
                                          : std::vector{Focus::picture});
  }
}

/// Entries of the tables of a call, by vertices.
struct Tables {
  Tables(const TraceFile& file, std::uint32_t call) {
    Replay replay(file);
    picture = *explain::study_call(file, replay, call).picture;
  }
  std::size_t place(std::uint32_t v) const {
    return static_cast<std::size_t>(std::ranges::find(picture.ring, VertexHandle(v)) -
                                    picture.ring.begin());
  }
  Quality q(std::uint32_t i, std::uint32_t j) const { return picture.tables.q(place(i), place(j)); }
  std::uint32_t k(std::uint32_t i, std::uint32_t j) const {
    return picture.ring[picture.tables.k(place(i), place(j))].index();
  }
  explain::ShellPicture picture;
};

void write_tables(LessonWriter& lesson) {
  const Call& call = lesson.call(0);
  const Tables tables(lesson.file(), 0);
  const auto& ring = tables.picture.ring;
  const std::uint32_t first = ring.front().index();
  const std::uint32_t second = ring[1].index();
  const std::uint32_t third = ring[2].index();
  const std::uint32_t last = ring.back().index();
  const std::uint64_t found = lesson.after(call, EventKind::candidate_found);
  const std::uint64_t replaced = lesson.after(call, EventKind::replace_cavity);
  const std::uint32_t apex = tables.k(first, last);
  lesson.say(0,
             fmt::format("{} tets share the edge a b, and its skirt polygon has {} corners. The "
                         "edge passes close to a side of it: the worst tet has quality {:.4f}. "
                         "How many ways are there to fill the shell without this edge? The "
                         "tables of Algorithms 1 and 2 find the best without trying all.",
                         ring.size(), ring.size(), tables.picture.floor),
             {Focus::picture, Focus::ring});
  lesson.ask_for(
      "triangulations",
      fmt::format("How many triangulations has a polygon with {} corners?", ring.size()));
  lesson.say(
      call.events.begin + 1,
      fmt::format("A pocket goes along the polygon from p_i on to p_j, and the chord p_i p_j "
                  "closes it. M_q(i, j) is the worst quality of its best triangulation, "
                  "M_k(i, j) the third corner of the triangle at the chord. A side is an "
                  "empty pocket: nothing is worse, so infinity. The smallest true pockets "
                  "have one triangle: from {} to {} the third corner can only be {}.",
                  first, third, second),
      {Focus::ring, Focus::tables});
  lesson.say(found,
             fmt::format("The tables are filled, diagonal by diagonal: each larger pocket is a "
                         "triangle and two smaller ones that are known. Algorithm 1 fills the half "
                         "above the diagonal, which has the pocket from {} to {}: the whole "
                         "polygon. Algorithm 2 fills both halves, as a pocket may pass from the "
                         "last corner on to the first. M_q of the whole polygon is {:.4f}.",
                         first, last, tables.q(first, last)),
             {Focus::tables});
  lesson.ask_for(
      fmt::format("M_k {} {}", first, last),
      fmt::format("Read it off M_k: what is the third corner of the triangle at {} and {}?", first,
                  last));
  lesson.say(replaced,
             fmt::format("M_k leads back to the triangles. The whole polygon, from {0} to {1}, has "
                         "the third corner {2}: a triangle {0} {2} {1}. What it leaves are the "
                         "pockets from {0} to {2} and from {2} to {1}, and so on. Each triangle "
                         "gives a tet with a and one with b: {3} tets instead of {4}.",
                         first, last, apex, lesson.cavity(replaced).created.size(), ring.size()),
             {Focus::picture, Focus::ring});
  lesson.say(call.events.end,
             fmt::format("No core was better than that, so the edge is gone: full reduction. {} "
                         "Algorithm 3 has come to its end, line 8.",
                         capital(qualities(call)) + "."),
             {Focus::ring, Focus::algorithm});
}

void write_reconnection(LessonWriter& lesson) {
  const TraceFile& file = lesson.file();
  const MeshData shells = two_shells();
  lesson.say(0,
             fmt::format("Three pieces: the two shells of the second lesson, of whose {} tets {} "
                         "are bad, two flat tets that share a face, and a flat tet by itself. "
                         "Algorithm 5 wants all bad tets gone.",
                         shells.tets.size(), lesson.bad_below(shells.points.size())),
             {Focus::picture});
  lesson.ask_for("bad tets", "Flat tets are bad, too. How many red tets are there in all?");
  const auto begins = file.passes().front().events.begin + 1;
  lesson.say(begins, "The bad tets are queued, those of lowest quality first.", {Focus::algorithm});
  lesson.ask(Ask::Kind::line, "Which line of Algorithm 5 comes next?");
  for (std::size_t i = 0; i < file.visits().size(); ++i) {
    const Visit& visit = file.visits()[i];
    std::vector<std::uint32_t> corners;
    for (const VertexHandle v : visit.tet) corners.push_back(v.index());
    std::string then;
    if (visit.first_call == visit.last_call) {
      then = "All of its edges and faces lie on the boundary, and none may be removed.";
    } else {
      const Call& call = lesson.call(visit.first_call);
      then = fmt::format("{} at {} {} comes first.",
                         call.algorithm == Algorithm::recursion ? "Algorithm 4" : "Face removal",
                         call.target_size == 2 ? "edge" : "face", numbers(call));
    }
    lesson.say(visit.events.begin + 1,
               fmt::format("The first tet of the queue has the vertices {} and quality {:.4f}. {}",
                           join(corners), visit.quality, then),
               {Focus::picture, Focus::algorithm});
    for (std::uint32_t c = visit.first_call; c < visit.last_call; c = lesson.call(c).subtree_end) {
      const Call& call = lesson.call(c);
      if (call.accepted()) {
        lesson.say(call.events.end,
                   fmt::format("It works: {}. The tet is gone, so nothing else is tried at it.",
                               qualities(call)),
                   {Focus::picture, Focus::tree});
      }
    }
  }
  const auto& end = file.passes().front().now;
  lesson.say(file.event_count(),
             fmt::format("The queue is empty. {} bad tet{} left, of quality {:.4f}: its edges and "
                         "faces are those of the boundary, and local reconnection keeps the "
                         "boundary. Other operators have to help there, or none can.",
                         end.n_bad, end.n_bad == 1 ? " is" : "s are", end.q_worst),
             {Focus::picture, Focus::tree});
}

void write_smoothing(LessonWriter& lesson) {
  const Call& call = lesson.call(0);
  const std::uint64_t moved = lesson.after(call, EventKind::move_vertex);
  lesson.say(0,
             fmt::format("{} tets share vertex 6: its ball. The vertex is not where it should be, "
                         "and the worst tet has quality {:.4f}. Nothing needs to be connected in "
                         "another way: it is enough to move the vertex.",
                         lesson.file().initial_mesh().tet_count(), lesson.worst(0)),
             {Focus::picture});
  lesson.say(
      call.events.begin + 1,
      "Smoothing first tries the mean of the neighbours, which costs next to nothing. If the "
      "worst tet of the ball is better there, the vertex begins from there. If a tet is bad "
      "still, it climbs: in each step it moves in the direction in which the worst tets "
      "become better together, until there is none.",
      {Focus::picture, Focus::algorithm});
  lesson.ask(Ask::Kind::accepted, "Will the vertex find a better place?");
  lesson.say(lesson.after(call, EventKind::candidate_found),
             "A better place is found. All other vertices stay where they are.", {Focus::picture});
  lesson.say(moved,
             fmt::format("The vertex has moved, and all {} tets of its ball with it. One "
                         "step back and on again shows the difference.",
                         lesson.cavity(moved).created.size()),
             {Focus::picture});
  lesson.say(
      call.events.end,
      fmt::format("The ball is better as a whole, so the change stays: {}.", qualities(call)),
      {Focus::picture, Focus::tree});
}

void write_cavity(LessonWriter& lesson) {
  const Call& call = lesson.call(0);
  const std::uint64_t replaced = lesson.after(call, EventKind::replace_cavity);
  const Cavity cavity = lesson.cavity(replaced);
  lesson.say(0,
             fmt::format("{} tets between {} points. Some places have too few vertices for good "
                         "tets, however they are connected. A new vertex may help: where, and "
                         "which tets must give way to it?",
                         lesson.file().initial_mesh().tet_count(),
                         lesson.file().initial_mesh().vertex_count()),
             {Focus::picture});
  lesson.say(
      call.events.begin + 1,
      fmt::format("Insertion by cavity works on the tet {}. The centroids of the tet, of its "
                  "faces and of its edges are tried as places for a vertex. At each, the "
                  "cavity grows: the tet itself, then those neighbours whose removal makes "
                  "the worst of the new tets better.",
                  numbers(call)),
      {Focus::picture, Focus::algorithm});
  lesson.ask(Ask::Kind::accepted, "Will the new vertex be accepted?");
  lesson.say(lesson.after(call, EventKind::candidate_found),
             "A place is found that promises enough. The vertex has been moved to where the worst "
             "new tet is best, and the cavity was chosen once more for that place.",
             {Focus::picture});
  lesson.ask_for("tets made",
                 fmt::format("{} tets will be taken out, and each outer face of the hole makes a "
                             "tet with the new vertex. How many will there be?",
                             cavity.removed.size()));
  lesson.say(
      replaced,
      fmt::format("{} tets are taken out. The outer faces of the cavity stay, and each of them "
                  "makes a tet with the new vertex: {} tets.",
                  cavity.removed.size(), cavity.created.size()),
      {Focus::picture});
  lesson.say(
      call.events.end,
      fmt::format("There are more tets than before, but they are better: {}.", qualities(call)),
      {Focus::picture, Focus::tree});
}

void write_polyhedron(LessonWriter& lesson) {
  const Call& call = lesson.call(0);
  const std::uint64_t replaced = lesson.after(call, EventKind::replace_cavity);
  const Cavity cavity = lesson.cavity(replaced);
  std::set<VertexHandle> corners;
  for (const CavityTet& tet : cavity.removed)
    corners.insert(tet.vertices.begin(), tet.vertices.end());
  lesson.say(0,
             "The mesh of the lesson before, without a new vertex. A shell is the neighbourhood of "
             "an edge, and a search over it finds the best covering. What if no edge has a "
             "neighbourhood that helps?",
             {Focus::picture});
  lesson.say(call.events.begin + 1,
             fmt::format("Small polyhedron reconnection begins with the tet {}. It adds a vertex, "
                         "with all tets between its vertices, and looks for the best of all "
                         "tetrahedralisations of the polyhedron so far. If none is better, it adds "
                         "the next vertex.",
                         numbers(call)),
             {Focus::picture, Focus::algorithm});
  lesson.ask(Ask::Kind::accepted, "Will it find a better way to fill one?");
  lesson.say(
      replaced,
      fmt::format("With {} vertices there is another filling: {} tets instead of {}, with the same "
                  "outer faces and vertices. The worst quality was {:.4f}. A tet that is bad still "
                  "would be red.",
                  corners.size(), cavity.created.size(), cavity.removed.size(), call.worst_before),
      {Focus::picture});
  lesson.ask(Ask::Kind::accepted, "Will the change stay?");
  lesson.say(call.events.end,
             fmt::format("The change stays: {}. The price is time: the search grows fast with the "
                         "number of vertices, so it is for the worst tets, after everything else.",
                         qualities(call)),
             {Focus::picture, Focus::tree});
}

// --- runs ----------------------------------------------------------------------------------------

struct Recipe {
  std::string_view name;
  std::string_view title;
  MeshData mesh;
  std::string_view schedule;
  std::function<void(Run&)> after_schedule;
  void (*write)(LessonWriter&);
};

/// An attempt by a worker that does not have the vertex `foreign`.
void attempt_without(Run& run, std::uint32_t foreign) {
  PassScope scope(run, "divided mesh");
  std::vector<BlockId> blocks(run.mesh().vertex_slots(), 0);
  blocks[foreign] = 1;
  const auto flip = run.registry().make("flip_3_2", {});
  Worker& worker = run.worker();
  const auto edge = find_edge(run.mesh(), VertexHandle(7), VertexHandle(8), worker.workspace());
  Workspace::FreeSlots slots;
  worker.workspace().enter(Territory(blocks, 0), slots);
  scope.expect(1);
  worker.attempt(*flip, Target::of(*edge));
  worker.workspace().leave(slots);
  worker.workspace().settle(run.mesh());
  scope.take_verdicts(worker);
  scope.finish();
}

std::vector<Recipe> recipes() {
  return {
      {"1-core",
       "A shell transformation with a core",
       shell_with_core(),
       "attempt('edge_removal', {0, 1})\n"
       "attempt('shell_transformation', {0, 1})\n",
       {},
       write_core},
      {"2-two-shells",
       "The recursion over two shells",
       two_shells(),
       "attempt({'recursive_shell_transformation', max_level = 1}, {0, 1})\n",
       {},
       write_two_shells},
      {"3-refusals", "Refusals, one for each reason", pieces(),
       "attempt('flip_3_2', {0, 1})\n"
       "attempt('shell_transformation', {2, 3})\n"
       "attempt('shell_transformation', {0, 1})\n"
       "attempt('flip_3_2', {7, 8})\n"
       "attempt({'recursive_shell_transformation', max_level = 0}, {12, 13})\n"
       "attempt({'recursive_shell_transformation', budget = 1}, {12, 13})\n",
       [](Run& run) { attempt_without(run, 9); }, write_refusals},
      {"4-tables",
       "Algorithms 1 to 3: the tables M_q and M_k",
       shell_beside_axis(),
       "attempt('shell_transformation', {0, 1})\n",
       {},
       write_tables},
      {"5-reconnection",
       "Algorithm 5: local reconnection",
       three_cures(),
       "local_reconnection{edges = {'recursive_shell_transformation', max_level = 1}, sweeps = "
       "1}\n",
       {},
       write_reconnection},
      {"6-smoothing",
       "Smoothing: the best place for a vertex",
       lopsided_ball(),
       "attempt('smoothing', {6})\n",
       {},
       write_smoothing},
      {"7-cavity",
       "Insertion by cavity: room for a vertex",
       eleven_points(),
       "attempt({'cavity_insertion', relax = false}, {5, 4, 7, 10})\n",
       {},
       write_cavity},
      {"8-polyhedron",
       "Small polyhedra: all ways to fill them",
       eleven_points(),
       "attempt({'polyhedron_reconnection', relax = false}, {5, 4, 7, 10})\n",
       {},
       write_polyhedron},
  };
}

void write_text(const std::filesystem::path& file, std::string_view text) {
  OutputFile out(file);
  out.put(text);
  out.commit();
}

void record(const Recipe& recipe, const std::filesystem::path& mesh_file,
            const std::filesystem::path& trace_file) {
  Registry registry = Registry::builtin();
  TetMesh mesh(recipe.mesh);
  mesh.set_standard(Standard(Goal{}, Standard::Terms::sine));  // as in the paper
  const Schedule schedule(fmt::format("{}.lua", recipe.name), std::string(recipe.schedule));
  TraceRecorder recorder(trace_file, mesh,
                         {.program = "make_lessons",
                          .input = mesh_file.filename().string(),
                          .schedule = schedule.name(),
                          .schedule_text = schedule.text(),
                          .settings = {},
                          .filter = {}},
                         {}, TraceClock::steps);
  Run run(mesh, registry);
  run.set_trace(&recorder);
  improve(run, schedule);
  if (recipe.after_schedule) recipe.after_schedule(run);
  recorder.finish();
}

void make_lesson(const Recipe& recipe, const std::filesystem::path& folder) {
  const auto file = [&](std::string_view extension) {
    return folder / fmt::format("{}.{}", recipe.name, extension);
  };
  write_mesh(file("mesh"), recipe.mesh);
  record(recipe, file("mesh"), file("trace"));
  const TraceFile trace(file("trace"));
  LessonWriter lesson(trace);
  recipe.write(lesson);
  write_text(file("json"), lesson_text({.title = std::string(recipe.title),
                                        .mesh = file("mesh"),
                                        .trace = file("trace"),
                                        .steps = lesson.steps()},
                                       folder));
}

}  // namespace
}  // namespace tetmend

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: make_lessons OUTDIR\n");
    return 2;
  }
  try {
    for (const tetmend::Recipe& recipe : tetmend::recipes()) tetmend::make_lesson(recipe, argv[1]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "make_lessons: {}\n", error.what());
    return 1;
  }
  return 0;
}
