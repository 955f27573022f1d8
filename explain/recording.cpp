// SPDX-License-Identifier: MIT
#include "explain/recording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "explain/call_facts.h"
#include "explain/call_study.h"
#include "explain/event_text.h"
#include "explain/outcome_look.h"
#include "explain/paper_lines.h"
#include "explain/removal.h"
#include "explain/stepper.h"
#include "trace/traced_standard.h"

namespace tetmend::explain {

namespace {

/// As many digits as tell a float from its neighbours, and no more. Infinity is null.
Json short_number(Quality value) {
  if (!std::isfinite(value)) return nullptr;
  return std::stod(fmt::format("{}", value));
}

Json numbers_of(std::span<const VertexHandle> vertices) {
  Json list = Json::array();
  for (const VertexHandle v : vertices) list.push_back(v.index());
  return list;
}

std::string_view name_of(Outcome outcome) {
  constexpr std::array<std::string_view, kOutcomeCount> kNames = {
      "unfinished",  "accepted", "undone",         "no_improvement", "limit",
      "constrained", "rejected", "not_applicable", "deferred"};
  return kNames[static_cast<std::size_t>(outcome)];
}

Json to_json(const FlatCovering& covering) {
  Json triangles = Json::array();
  for (const auto& t : covering.triangles) {
    triangles.push_back({t.corners[0], t.corners[1], t.corners[2], short_number(t.quality)});
  }
  Json core = Json::array();
  for (const auto& side : covering.core) {
    core.push_back({side.from, side.to, short_number(side.quality)});
  }
  return {{"triangles", triangles}, {"core", core}};
}

Json to_json(const PocketTables& tables) {
  if (tables.size == 0) return nullptr;
  Json quality = Json::array();
  for (const Quality q : tables.quality) quality.push_back(short_number(q));
  Json triangles = Json::array();
  for (const Quality q : tables.triangles) triangles.push_back(short_number(q));
  return {{"q", quality}, {"k", tables.apex}, {"triangles", triangles}};
}

/// Points and tets by numbers, each once.
class Interned {
 public:
  /// The tet in that slot as it is now.
  std::uint32_t tet(const SlotMesh& mesh, TetHandle t) {
    const TetVertices& v = mesh.vertices(t);
    Tet key{};
    for (unsigned i = 0; i < 4; ++i) key.points[i] = point(v[i], mesh.point(v[i]));
    return add(key, mesh.quality(t));
  }
  std::uint32_t tet(const LocalTet& local) {
    Tet key{};
    for (unsigned i = 0; i < 4; ++i) key.points[i] = point(local.vertices[i], local.corners[i]);
    return add(key, local.quality);
  }

  Json points() const {
    Point low = Point::Zero();
    Point high = Point::Zero();
    if (!points_.empty()) low = high = points_.front().place;
    for (const Version& p : points_) {
      low = low.cwiseMin(p.place);
      high = high.cwiseMax(p.place);
    }
    const Point centre = (low + high) / 2;
    const double radius = std::max((high - low).norm() / 2, 1e-300);
    Json list = Json::array();
    for (const Version& p : points_) {
      const Point q = (p.place - centre) / radius;
      list.push_back({p.vertex, rounded(q.x()), rounded(q.y()), rounded(q.z())});
    }
    return list;
  }

  Json tets() const {
    Json list = Json::array();
    for (const Tet& t : tets_) {
      list.push_back({t.points[0], t.points[1], t.points[2], t.points[3], short_number(t.quality)});
    }
    return list;
  }

 private:
  struct Version {
    std::uint32_t vertex;
    Point place;
  };
  struct Tet {
    std::array<std::uint32_t, 4> points{};
    Quality quality = 0;
    // libc++ has no <=> of arrays.
    bool operator<(const Tet& other) const {
      return std::tie(points, quality) < std::tie(other.points, other.quality);
    }
  };

  static double rounded(double x) {
    constexpr double kSteps = 1e5;  // finer than a pixel of any screen
    return std::round(x * kSteps) / kSteps + 0.0;
  }

  std::uint32_t point(VertexHandle v, const Point& p) {
    const auto [found, is_new] = point_numbers_.try_emplace(
        {v.index(), p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(points_.size()));
    if (is_new) points_.push_back({v.index(), p});
    return found->second;
  }

  std::uint32_t add(Tet tet, Quality quality) {
    tet.quality = quality;
    const auto [found, is_new] =
        tet_numbers_.try_emplace(tet, static_cast<std::uint32_t>(tets_.size()));
    if (is_new) tets_.push_back(tet);
    return found->second;
  }

  std::map<std::tuple<std::uint32_t, double, double, double>, std::uint32_t> point_numbers_;
  std::vector<Version> points_;
  std::map<Tet, std::uint32_t> tet_numbers_;
  std::vector<Tet> tets_;
};

/// All its steps are there, its first event included.
bool is_in(const Call& call, const RecordingRange& range) {
  return call.events.begin + 1 >= range.begin && call.events.end <= range.end;
}

class Recording {
 public:
  Recording(const TraceFile& file, Replay& replay, const RecordingRange& range)
      : file_(file), replay_(replay), range_(range), home_(replay.position()) {
    for (const Pseudocode* code : {&table_code(), &reconnection_code()}) code_number(code);
  }
  ~Recording() { replay_.seek(home_); }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  Json make() {
    choose_tets();
    Json start = tets_at_begin();
    Json steps = make_steps();
    Json calls = make_calls();
    return {{"begin", range_.begin},     {"goal", describe(standard_)},
            {"start", std::move(start)}, {"steps", std::move(steps)},
            {"calls", std::move(calls)}, {"shells", std::move(shells_)},
            {"codes", make_codes()},     {"points", interned_.points()},
            {"tets", interned_.tets()},  {"outcomes", outcomes()},
            {"visits", visits()}};
  }

 private:
  /// All tets of a small mesh, else those at a target and those that change.
  void choose_tets() {
    constexpr std::size_t kSmall = 1000;
    takes_all_ = file_.initial_mesh().tet_count() <= kSmall;
    replay_.seek(range_.begin);
    for (const std::uint32_t around : call_stack(file_, range_.begin)) take_target(around);
    EventCursor cursor(file_);
    cursor.move_to(range_.begin);
    std::uint32_t next = first_call();
    while (cursor.position() < range_.end) {
      const TraceEvent& event = cursor.next();
      const EventKind kind = event.kind;
      if (kind == EventKind::visit_begins && !takes_all_) {
        replay_.seek(cursor.position());
        take_visit({event.vertices[0], event.vertices[1], event.vertices[2], event.vertices[3]});
      } else if (changes_mesh(kind)) {
        replay_.seek(cursor.position());
        for (const CavityTet& t : replay_.cavity().removed) slots_.insert(t.tet.index());
        for (const CavityTet& t : replay_.cavity().created) slots_.insert(t.tet.index());
      } else if (kind == EventKind::attempt_begins) {
        const Call& call = file_.calls()[next++];
        if (takes_all_ || call.depth > range_.deepest) continue;
        replay_.seek(cursor.position());
        take_target(next - 1);
      }
    }
  }

  void take_target(std::uint32_t call) { take_around(file_.calls()[call].target()); }

  void take_around(std::span<const VertexHandle> vertices) {
    for (const TetHandle t : replay_.tets_around(vertices)) slots_.insert(t.index());
  }

  /// A tet that a pass turns to, and its neighbours.
  void take_visit(const TetVertices& tet) {
    for (unsigned f = 0; f < 4; ++f) {
      std::array<VertexHandle, 3> face;
      for (unsigned k = 0; k < 3; ++k) face[k] = tet[(f + 1 + k) % 4];
      take_around(face);
    }
  }

  std::uint32_t first_call() const {
    const auto calls = file_.calls();
    const auto first = std::lower_bound(
        calls.begin(), calls.end(), range_.begin,
        [](const Call& call, std::uint64_t position) { return call.events.begin + 1 < position; });
    return static_cast<std::uint32_t>(first - calls.begin());
  }

  Json tets_at_begin() {
    replay_.seek(range_.begin);
    standard_ = replay_.mesh().standard();
    const SlotMesh& mesh = replay_.mesh();
    Json start = Json::array();
    for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
      if (mesh.is_deleted(TetHandle(i)) || !(takes_all_ || slots_.contains(i))) continue;
      live_[i] = interned_.tet(mesh, TetHandle(i));
      start.push_back(live_[i]);
    }
    return start;
  }

  Json make_steps() {
    Json steps = Json::array();
    std::set<std::uint32_t> gone;
    std::set<std::uint32_t> come;
    for (std::uint64_t position = range_.begin; position <= range_.end; ++position) {
      if (position > range_.begin) follow(position, gone, come);
      const auto stack = call_stack(file_, position);
      const bool is_shown = stack.empty() || file_.calls()[stack.back()].depth <= range_.deepest ||
                            position == range_.begin;
      if (!is_shown) continue;
      steps.push_back(step_at(position, stack, gone, come));
      gone.clear();
      come.clear();
    }
    return steps;
  }

  void follow(std::uint64_t position, std::set<std::uint32_t>& gone,
              std::set<std::uint32_t>& come) {
    replay_.seek(position);
    const Cavity cavity = replay_.cavity();
    const auto leave = [&](std::uint32_t tet) {
      if (come.erase(tet) == 0) gone.insert(tet);
    };
    const auto arrive = [&](std::uint32_t tet) {
      if (gone.erase(tet) == 0) come.insert(tet);
    };
    for (const CavityTet& t : cavity.removed) {
      const auto found = live_.find(t.tet.index());
      if (found == live_.end()) continue;
      leave(found->second);
      live_.erase(found);
    }
    for (const CavityTet& t : cavity.created) {
      const std::uint32_t tet = interned_.tet(replay_.mesh(), t.tet);
      live_[t.tet.index()] = tet;
      arrive(tet);
    }
  }

  /// Where it leads forwards and backwards, over and out, as far as the range goes.
  Json ways(std::uint64_t position) const {
    const auto to = [&](Step step, Direction direction) {
      return std::clamp(step_from(file_, position, step, direction), range_.begin, range_.end);
    };
    return {to(Step::over, Direction::forward), to(Step::out, Direction::forward),
            to(Step::over, Direction::back), to(Step::out, Direction::back)};
  }

  Json step_at(std::uint64_t position, const std::vector<std::uint32_t>& stack,
               const std::set<std::uint32_t>& gone, const std::set<std::uint32_t>& come) {
    Json lines = Json::array();
    const CodePlace pass = pass_place(file_, stack, position);
    CodePlace caller = pass;
    for (std::size_t i = 0; i < stack.size(); ++i) {
      const CodePlace place = code_place(file_, stack, i, position);
      lines.push_back(place.line);
      if (i + 2 == stack.size()) caller = place;
    }
    Json call;
    if (!stack.empty()) call = stack.back();
    return {position,      event_text(file_, position),
            call,          lines,
            pass.line,     ways(position),
            gone,          come,
            caller.goes_on};
  }

  /// Name and mark of each way to end that the calls have, and of those under way.
  Json outcomes() const {
    Json named = Json::object();
    for (std::size_t i = 0; i < kOutcomeCount; ++i) {
      const auto outcome = static_cast<Outcome>(i);
      if (!seen_.contains(outcome)) continue;
      Json lines = Json::array();
      for (const auto& line : outcome_mark(outcome)) {
        Json places = Json::array();
        constexpr double kSteps = 100;
        for (const figure::Place& at : line) {
          places.push_back(std::round(at.x * kSteps) / kSteps);
          places.push_back(std::round(at.y * kSteps) / kSteps);
        }
        lines.push_back(std::move(places));
      }
      named[std::string(name_of(outcome))] = {{"name", outcome_name(outcome)}, {"mark", lines}};
    }
    return named;
  }

  /// First and last position of each that is seen, and its tet.
  Json visits() const {
    Json list = Json::array();
    for (const Visit& visit : file_.visits()) {
      if (visit.events.begin >= range_.end || visit.events.end <= range_.begin) continue;
      list.push_back({visit.events.begin + 1, visit.events.end, numbers_of(visit.tet)});
    }
    return list;
  }

  Json make_calls() {
    Json calls = Json::object();
    for (std::uint32_t k = first_call(); k < file_.calls().size(); ++k) {
      const Call& call = file_.calls()[k];
      if (call.events.begin >= range_.end) break;
      if (is_in(call, range_)) calls[fmt::format("{}", k)] = call_at(k);
    }
    // The calls around the range: breadcrumbs name them.
    for (std::uint32_t k : call_stack(file_, range_.begin)) {
      if (!calls.contains(fmt::format("{}", k))) calls[fmt::format("{}", k)] = call_row(k);
    }
    return calls;
  }

  /// What tree and breadcrumb say.
  Json call_row(std::uint32_t k) {
    const Call& call = file_.calls()[k];
    const CallFacts& facts = facts_.facts(file_, replay_, k);
    Json parent;
    if (call.parent != kNoCall) parent = call.parent;
    seen_.insert(outcome_of(call));
    return {{"name", short_name(file_, call)},
            {"operator", file_.name(call.operator_name)},
            {"target", numbers_of(call.target())},
            {"place", format_target(call)},
            {"level", call.level},
            {"depth", call.depth},
            {"parent", parent},
            {"last", call.subtree_end},
            {"begin", call.events.begin},
            {"end", call.events.end},
            {"verdict", call.verdict_in_words()},
            {"outcome", name_of(outcome_of(call))},
            {"degrees", degree_text(facts)},
            {"qualities", quality_text(call, facts)},
            {"code", code_number(code_of(file_, call))}};
  }

  Json call_at(std::uint32_t k) {
    Json row = call_row(k);
    const Call& call = file_.calls()[k];
    row["settings"] = file_.name(call.settings);
    if (call.depth > range_.deepest) return row;
    add_removal(row, k);
    const CallStudy study = study_call(file_, replay_, k);
    row["reason"] = explain_end(file_, study);
    row["before"] = numbers_of_tets(study.before);
    row["after"] = numbers_of_tets(study.after);
    row["undone"] = study.undone;
    if (study.picture && study.picture->ring.size() >= 3) {
      row["shell"] = shell_number(*study.picture);
      row["made"] = ring_at(call, study);
    }
    return row;
  }

  /// Of a step of the recursion: what it is to remove, and from whose shell.
  void add_removal(Json& row, std::uint32_t k) const {
    const auto removal = removal_of(file_, k);
    if (!removal) return;
    row["removal"] = to_text(*removal);
    const std::uint32_t caller = caller_of(file_, k);
    if (caller != kNoCall) row["caller"] = numbers_of(file_.calls()[caller].target());
    if (removal->face) row["face"] = numbers_of(*removal->face);
  }

  Json numbers_of_tets(const std::vector<LocalTet>& tets) {
    Json list = Json::array();
    for (const LocalTet& tet : tets) list.push_back(interned_.tet(tet));
    return list;
  }

  /// Calls of a recursion see the same shell again and again: each is listed once.
  std::size_t shell_number(const ShellPicture& s) {
    Json chords = Json::array();
    for (const Chord& chord : chords_of(s)) {
      chords.push_back(
          {chord.from, chord.to, short_number(chord.on[0]), short_number(chord.back[0])});
    }
    Json shell = {{"a", s.a.index()},
                  {"b", s.b.index()},
                  {"ring", numbers_of(s.ring)},
                  {"floor", short_number(s.floor)},
                  {"before", to_json(s.before)},
                  {"searched", !s.pockets.empty()},
                  {"chords", std::move(chords)},
                  {"locks", locks_text(s)},
                  {"tables", to_json(s.tables)}};
    if (!s.full.triangles.empty()) shell["full"] = to_json(s.full);
    const auto [found, is_new] = shell_numbers_.try_emplace(shell.dump(), shells_.size());
    if (is_new) shells_.push_back(std::move(shell));
    return found->second;
  }

  /// What became of the shell, and what its drawing shows from which position on.
  Json ring_at(const Call& call, const CallStudy& study) {
    Json ring = Json::object();
    Json stages = Json::array();
    constexpr std::array<std::string_view, 6> kStages = {"before", "found",   "made",
                                                         "full",   "earlier", "now"};
    const auto add = [&](std::uint64_t from, bool refused) {
      const PolygonView view = polygon_at(study, from, refused);
      const auto stage = static_cast<std::size_t>(view.stage);
      Json row = {from, kStages[stage], view.caption, shell_number(*view.shell)};
      if (view.covering != nullptr) row.push_back(to_json(*view.covering));
      stages.push_back(std::move(row));
    };
    add(call.events.begin + 1, false);
    if (study.found) add(*study.found, false);
    if (study.covering) add(study.first_edit, false);
    for (const LaterShell& later : study.later) {
      if (later.from < call.events.end) add(later.from, false);
    }
    add(call.events.end, !call.accepted() && call.has_searched());
    ring["stages"] = stages;
    return ring;
  }

  /// -1 for none.
  int code_number(const Pseudocode* code) {
    if (code == nullptr) return -1;
    const auto found = std::find(codes_.begin(), codes_.end(), code);
    if (found == codes_.end()) {
      codes_.push_back(code);
      return static_cast<int>(codes_.size()) - 1;
    }
    return static_cast<int>(found - codes_.begin());
  }

  Json make_codes() const {
    Json codes = Json::array();
    for (const Pseudocode* code : codes_) {
      codes.push_back(
          {{"title", code->title},
           {"lines", std::vector<std::string>(code->lines.begin(), code->lines.end())}});
    }
    return codes;
  }

  const TraceFile& file_;
  Replay& replay_;
  RecordingRange range_;
  std::uint64_t home_;
  Interned interned_;
  FactTable facts_;
  Standard standard_;
  bool takes_all_ = false;
  std::set<std::uint32_t> slots_;                // of tets that are shown
  std::map<std::uint32_t, std::uint32_t> live_;  // slot -> tet
  std::set<Outcome> seen_ = {Outcome::unfinished};
  std::map<std::string, std::size_t> shell_numbers_;
  Json shells_ = Json::array();
  std::vector<const Pseudocode*> codes_;  // first those of the tables and of Algorithm 5
};

}  // namespace

RecordingRange range_of_call(const TraceFile& file, std::uint32_t call) {
  const Call& c = file.calls()[call];
  return {c.events.begin + 1, c.events.end};
}

unsigned depth_of(const TraceFile& file, const RecordingRange& range) {
  unsigned deepest = 0;
  for (const Call& call : file.calls()) {
    if (is_in(call, range)) deepest = std::max<unsigned>(deepest, call.depth);
  }
  return deepest;
}

std::size_t count_calls(const TraceFile& file, const RecordingRange& range) {
  const auto calls = file.calls();
  return static_cast<std::size_t>(std::count_if(
      calls.begin(), calls.end(), [&](const Call& call) { return is_in(call, range); }));
}

Json record(const TraceFile& file, Replay& replay, const RecordingRange& range) {
  return Recording(file, replay, range).make();
}

}  // namespace tetmend::explain
