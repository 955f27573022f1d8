// SPDX-License-Identifier: MIT
#include "explain/call_study.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <set>

#include <fmt/format.h>

namespace tetmend::explain {

namespace {

LocalTet local_tet(const SlotMesh& mesh, TetHandle t) {
  LocalTet tet{t, mesh.vertices(t), {}, mesh.quality(t)};
  for (unsigned i = 0; i < 4; ++i) tet.corners[i] = mesh.point(tet.vertices[i]);
  return tet;
}

/// Puts the replay back where it was.
class Excursion {
 public:
  explicit Excursion(Replay& replay) : replay_(replay), home_(replay.position()) {}
  ~Excursion() { replay_.seek(home_); }
  Excursion(const Excursion&) = delete;
  Excursion& operator=(const Excursion&) = delete;

 private:
  Replay& replay_;
  std::uint64_t home_;
};

/// Where the call and those in it edit, and what it does itself.
struct Edits {
  std::vector<std::uint64_t> all;      // positions after them, undoes included
  std::vector<std::uint64_t> own;      // without undoes
  std::optional<std::uint64_t> found;  // after the call itself told of a candidate, the first time
  bool last_is_undo = false;
};

Edits edits_of(const TraceFile& file, const Call& call) {
  Edits edits;
  EventCursor cursor(file);
  cursor.move_to(call.events.begin);
  int depth = 0;
  while (cursor.position() < call.events.end) {
    const TraceEvent& event = cursor.next();
    if (event.kind == EventKind::attempt_begins) ++depth;
    if (event.kind == EventKind::attempt_ends) --depth;
    if (event.kind == EventKind::candidate_found && depth == 1 && !edits.found) {
      edits.found = cursor.position();
    }
    if (!changes_mesh(event.kind)) continue;
    edits.all.push_back(cursor.position());
    edits.last_is_undo = event.kind == EventKind::undo;
    if (depth == 1 && !edits.last_is_undo) edits.own.push_back(cursor.position());
  }
  return edits;
}

/// Position after the last edit that is not an undo, before the undoes at the end.
std::uint64_t last_try(const TraceFile& file, const Edits& edits) {
  EventCursor cursor(file);
  for (std::size_t i = edits.all.size(); i-- > 0;) {
    cursor.move_to(edits.all[i] - 1);
    if (cursor.next().kind != EventKind::undo) return edits.all[i];
  }
  return 0;
}

class Study {
 public:
  Study(const TraceFile& file, Replay& replay, std::uint32_t call)
      : file_(file), replay_(replay), call_(file.calls()[call]) {
    study_.call = call;
  }

  CallStudy make() {
    const Excursion excursion(replay_);
    const Edits edits = edits_of(file_, call_);
    replay_.seek(call_.events.begin);
    draw_shell();
    take_before(edits);
    if (!edits.all.empty()) take_after(edits);
    if (!edits.own.empty()) {
      find_covering(edits);
    } else if (study_.picture && !sandwich_a_.is_valid()) {
      follow_steps(edits.all);
    }
    return std::move(study_);
  }

 private:
  const SlotMesh& mesh() const { return replay_.mesh(); }

  void draw_shell() {
    const auto target = call_.target();
    for (const VertexHandle v : target) {
      if (mesh().is_deleted(v)) return;
    }
    around_ = replay_.tets_around(target);
    if (target.size() == 2) {
      const SlotShell shell = shell_of(mesh(), around_, target[0], target[1]);
      const bool drawable =
          shell.closed && shell.ring.size() >= 3 && shell.ring.size() <= kMostDrawn;
      if (drawable) study_.picture = picture_of_shell(mesh(), shell, ancestors());
    }
    if (target.size() == 3 && around_.size() == 2) draw_sandwich();
  }

  /// The edges that the recursive calls around this one are to remove, if it is a step of theirs.
  std::vector<std::array<VertexHandle, 2>> ancestors() const {
    std::vector<std::array<VertexHandle, 2>> edges;
    unsigned level = call_.level;
    for (std::uint32_t c = call_.parent; c != kNoCall && level > 0; c = file_.calls()[c].parent) {
      const Call& caller = file_.calls()[c];
      if (caller.algorithm != Algorithm::recursion || caller.level >= level) continue;
      edges.push_back({caller.target()[0], caller.target()[1]});
      level = caller.level;
    }
    return edges;
  }

  void draw_sandwich() {
    const auto target = call_.target();
    const auto apex = [&](TetHandle t) {
      const TetVertices& tet = mesh().vertices(t);
      return *std::find_if(tet.begin(), tet.end(), [&](VertexHandle v) {
        return std::find(target.begin(), target.end(), v) == target.end();
      });
    };
    sandwich_a_ = apex(around_[0]);
    sandwich_b_ = apex(around_[1]);
    const std::array<std::array<VertexHandle, 3>, 1> triangle = {
        others(mesh().vertices(around_[0]), sandwich_a_)};
    study_.picture = picture_of_sandwich(mesh(), sandwich_a_, sandwich_b_, triangle);
  }

  /// The slots that the call changes, for good or not.
  void take_before(const Edits& edits) {
    for (const TetHandle t : around_) touched_.insert(t);
    for (const std::uint64_t position : edits.all) {
      replay_.seek(position);
      const Cavity cavity = replay_.cavity();
      for (const CavityTet& tet : cavity.removed) touched_.insert(tet.tet);
      for (const CavityTet& tet : cavity.created) touched_.insert(tet.tet);
    }
    replay_.seek(call_.events.begin);
    study_.before = touched_tets();
  }

  void take_after(const Edits& edits) {
    replay_.seek(call_.events.end);
    study_.after = touched_tets();
    study_.undone = edits.last_is_undo && is_same(study_.before, study_.after);
    if (!study_.undone) return;
    replay_.seek(last_try(file_, edits));
    study_.after = touched_tets();
  }

  std::vector<LocalTet> touched_tets() const {
    std::vector<LocalTet> tets;
    for (const TetHandle t : touched_) {
      if (!mesh().is_deleted(t)) tets.push_back(local_tet(mesh(), t));
    }
    return tets;
  }

  static bool is_same(const std::vector<LocalTet>& x, const std::vector<LocalTet>& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                      [](const LocalTet& s, const LocalTet& t) {
                        return s.vertices == t.vertices && s.corners == t.corners;
                      });
  }

  /// What the first edit of the call makes of the polygon.
  void find_covering(const Edits& edits) {
    if (!study_.picture) return;
    const std::uint64_t position = edits.own.front();
    replay_.seek(position);
    const Cavity cavity = replay_.cavity();
    if (cavity.created.empty() || !cavity.vertices.empty()) return;
    if (sandwich_a_.is_valid()) grow_sandwich(cavity);
    study_.covering = covering_at(*study_.picture);
    if (!study_.covering) return;
    study_.first_edit = position;
    if (edits.found && *edits.found < position) study_.found = edits.found;
  }

  /// What the edit that the replay has just made makes of a polygon, as far as that can be drawn.
  std::optional<FlatCovering> covering_at(const ShellPicture& picture) {
    const Cavity cavity = replay_.cavity();
    if (cavity.created.empty() || !cavity.vertices.empty()) return std::nullopt;
    std::vector<TetVertices> tets;
    for (const CavityTet& tet : cavity.created) tets.push_back(tet.vertices);
    for (const TetHandle t : replay_.tets_around(std::array{picture.a, picture.b})) {
      const auto made = [&](const CavityTet& tet) { return tet.tet == t; };
      if (std::any_of(cavity.created.begin(), cavity.created.end(), made)) continue;
      tets.push_back(mesh().vertices(t));  // stays as it is
    }
    FlatCovering covering = covering_of(mesh(), picture, tets);
    if (covering.triangles.empty() && covering.core.empty()) return std::nullopt;
    return covering;
  }

  /// A recursion has others change its shell: looks at it after each call in it that did, and
  /// after what the recursion itself undid.
  void follow_steps(const std::vector<std::uint64_t>& edits) {
    shell_now_ = study_.picture;
    replay_.seek(call_.events.begin);
    tets_before_ = tets_now_ = vertices_of(around_);
    auto edit = edits.begin();
    for (std::uint32_t c = study_.call + 1; c < call_.subtree_end;
         c = file_.calls()[c].subtree_end) {
      const Call& step = file_.calls()[c];
      for (; edit != edits.end() && *edit <= step.events.begin; ++edit) look_after(*edit, nullptr);
      const auto behind =
          std::find_if(edit, edits.end(), [&](std::uint64_t at) { return at > step.events.end; });
      if (behind != edit) look_after(*(behind - 1), &step);
      edit = behind;
    }
    for (; edit != edits.end(); ++edit) look_after(*edit, nullptr);
  }

  void look_after(std::uint64_t position, const Call* step) {
    replay_.seek(position);
    const std::array<VertexHandle, 2> ends = {study_.picture->a, study_.picture->b};
    const std::vector<TetHandle> tets = replay_.tets_around(ends);
    std::vector<TetVertices> vertices = vertices_of(tets);
    if (vertices == tets_now_) return;
    const bool is_of_edge =
        step != nullptr && step->accepted() && step->target().size() == 2 && is_target_of(*step);
    std::optional<FlatCovering> covering;
    if (is_of_edge && shell_now_) covering = covering_at(*shell_now_);
    if (covering && study_.later.empty() && !study_.covering) {
      study_.covering = std::move(covering);
      study_.first_edit = position;
    } else {
      study_.outdated = std::min(study_.outdated, position);
      LaterShell& later = study_.later.emplace_back();
      later.from = position;
      later.stage = covering ? PolygonStage::made : PolygonStage::now;
      if (covering) later.picture = shell_now_;
      later.covering = std::move(covering);
    }
    tets_now_ = std::move(vertices);
    shell_now_ = shell_at(tets);
    const bool is_new = !study_.later.empty() && study_.later.back().from == position;
    if (is_new && study_.later.back().stage == PolygonStage::now) show_present();
  }

  bool is_target_of(const Call& step) const {
    return std::is_permutation(step.target().begin(), step.target().end(), call_.target().begin());
  }

  std::vector<TetVertices> vertices_of(const std::vector<TetHandle>& tets) const {
    std::vector<TetVertices> list;
    for (const TetHandle t : tets) list.push_back(mesh().vertices(t));
    std::sort(list.begin(), list.end());
    return list;
  }

  /// Nothing if it cannot be drawn.
  std::optional<ShellPicture> shell_at(const std::vector<TetHandle>& tets) const {
    const auto ends = call_.target();
    const SlotShell shell = shell_of(mesh(), tets, ends[0], ends[1]);
    const bool is_drawn = shell.closed && shell.ring.size() >= 3 && shell.ring.size() <= kMostDrawn;
    if (!is_drawn) return std::nullopt;
    return picture_of_shell(mesh(), shell, ancestors());
  }

  void show_present() {
    LaterShell& later = study_.later.back();
    if (!shell_now_) {
      later.stage = PolygonStage::earlier;
    } else if (tets_now_ == tets_before_) {
      later.stage = PolygonStage::before;
    } else {
      later.picture = shell_now_;
    }
  }

  /// All faces between the two vertices that the call took together.
  void grow_sandwich(const Cavity& cavity) {
    std::vector<std::array<VertexHandle, 3>> triangles;
    for (const CavityTet& tet : cavity.removed) {
      if (contains(tet.vertices, sandwich_a_)) {
        triangles.push_back(others(tet.vertices, sandwich_a_));
      }
    }
    const std::uint64_t here = replay_.position();
    replay_.seek(call_.events.begin);
    ShellPicture grown = picture_of_sandwich(mesh(), sandwich_a_, sandwich_b_, triangles);
    if (grown.ring.size() >= 3) study_.picture = std::move(grown);
    replay_.seek(here);
  }

  const TraceFile& file_;
  Replay& replay_;
  const Call& call_;
  CallStudy study_;
  std::vector<TetHandle> around_;  // the target
  std::set<TetHandle> touched_;
  VertexHandle sandwich_a_, sandwich_b_;
  // The shell of the target while follow_steps() goes on.
  std::optional<ShellPicture> shell_now_;
  std::vector<TetVertices> tets_before_, tets_now_;
};

/// What the search had to offer at best.
std::string explain_search(const ShellPicture& s) {
  if (s.pockets.empty()) return "";
  const std::string locks = locks_text(s);
  return fmt::format("{}{} {}", locks.empty() ? "" : " ", locks,
                     s.full.triangles.empty()
                         ? "No complete triangulation of the polygon gives positive tets."
                         : fmt::format("The best complete triangulation has worst quality {:.4f}, "
                                       "the old tets {:.4f}.",
                                       s.full.worst, s.floor));
}

/// What the shell was before the call, behind what it is now.
std::string as_before(const ShellPicture& old) {
  return fmt::format("before the call: degree {}, worst {:.4f}", old.ring.size(), old.floor);
}

std::string caption_of(const CallStudy& study, const PolygonView& view) {
  const ShellPicture& old = *study.picture;
  const ShellPicture& shell = *view.shell;
  switch (view.stage) {
    case PolygonStage::made: {
      const bool is_later = view.shell != &old;
      const char* verb = study.undone          ? "tried"
                         : is_later            ? "made later"
                         : study.later.empty() ? "made"
                                               : "made at first";
      std::string text =
          fmt::format("{}: degree {} -> {}, worst {:.4f} -> {:.4f}", verb, shell.ring.size(),
                      view.covering->core.size(), shell.floor, view.covering->worst);
      return is_later ? text + "; " + as_before(old) : text;
    }
    case PolygonStage::found:
      return fmt::format("found: degree {} -> {}, worst {:.4f} -> {:.4f}", shell.ring.size(),
                         view.covering->core.size(), shell.floor, view.covering->worst);
    case PolygonStage::best_triangulation:
      return fmt::format("best complete triangulation: worst {:.4f}, old {:.4f}", shell.full.worst,
                         shell.floor);
    case PolygonStage::earlier:
      return as_before(old) + "; the shell is gone now";
    case PolygonStage::now:
      return fmt::format("now: degree {}, worst {:.4f}; {}", shell.ring.size(), shell.floor,
                         as_before(old));
    case PolygonStage::before:
      break;
  }
  const auto chords = chords_of(shell);
  const bool has_dashed = std::any_of(chords.begin(), chords.end(), [&](const Chord& chord) {
    return chord.best()[0] <= shell.floor;
  });
  return fmt::format("before: degree {}, worst {:.4f}{}", shell.ring.size(), shell.floor,
                     has_dashed ? "; dashed chords are no better" : "");
}

/// How many tets may lie around an edge that was not searched; without a limit, any number.
std::size_t most_degree(const TraceFile& file, const Call& call) {
  constexpr std::string_view kName = "max_degree = ";
  const std::string_view settings = file.name(call.settings);
  const std::size_t at = settings.find(kName);
  std::size_t most = std::numeric_limits<std::size_t>::max();
  if (call.verdict != Verdict::not_applicable || at == settings.npos) return most;
  std::from_chars(settings.data() + at + kName.size(), settings.data() + settings.size(), most);
  return most;
}

}  // namespace

Quality worst_of(const std::vector<LocalTet>& tets) {
  Quality worst = std::numeric_limits<Quality>::infinity();
  for (const LocalTet& tet : tets) worst = std::min(worst, tet.quality);
  return worst;
}

PolygonView polygon_at(const CallStudy& study, std::uint64_t position, bool refused) {
  const ShellPicture& old = *study.picture;
  const bool has_full = !old.full.triangles.empty();
  PolygonView view;
  view.shell = &old;
  const LaterShell* later = nullptr;
  for (const LaterShell& each : study.later) {
    if (each.from <= position) later = &each;
  }
  if (later != nullptr) {
    view.stage = later->stage;
    if (later->picture) view.shell = &*later->picture;
    if (later->covering) view.covering = &*later->covering;
  } else if (study.covering && position >= study.first_edit) {
    view.stage = PolygonStage::made;
    view.covering = &*study.covering;
  } else if (study.found && position >= *study.found) {
    view.stage = PolygonStage::found;
    view.covering = &*study.covering;
  }
  const bool is_best = refused && view.stage == PolygonStage::before && has_full;
  if (is_best && !study.covering) view.stage = PolygonStage::best_triangulation;
  view.caption = caption_of(study, view);
  return view;
}

CallStudy study_call(const TraceFile& file, Replay& replay, std::uint32_t call) {
  return Study(file, replay, call).make();
}

std::string explain_end(const TraceFile& file, const CallStudy& study) {
  const Call& call = file.calls()[study.call];
  std::string text(file.reason(call));
  if (const auto most = most_degree(file, call);
      study.picture && study.picture->ring.size() > most) {
    text = fmt::format("{} tets lie around the edge, more than max_degree = {}",
                       study.picture->ring.size(), most);
  }
  if (text.empty()) return text;
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  text += '.';
  if (call.accepted() && call.worst_before != 0) {
    text +=
        fmt::format(" Worst quality {:.4f}, before {:.4f}.", call.worst_after, call.worst_before);
  }
  if (call.undone && call.undone_with != kNoCall) {
    text += fmt::format(" Call {} undid it, and ended: {}.", call.undone_with,
                        file.calls()[call.undone_with].verdict_in_words());
  }
  if (call.accepted()) return text;
  if (study.undone) {
    const bool has_vectors = call.worst_before != 0;
    text += fmt::format(" Tried: worst quality {:.4f}, as against {:.4f}. Undone.",
                        has_vectors ? call.worst_after : worst_of(study.after),
                        has_vectors ? call.worst_before : worst_of(study.before));
  } else if (call.verdict == Verdict::no_improvement && !call.candidate_found &&
             searches_covering(call.algorithm) && study.picture) {
    text += explain_search(*study.picture);
  }
  return text;
}

}  // namespace tetmend::explain
