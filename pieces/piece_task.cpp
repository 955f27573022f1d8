// SPDX-License-Identifier: MIT
//   piece -> MeshData -> TetMesh, frozen where it is shared -> schedule -> what is its own
//
// A vertex of another part has all its tets in other pieces, too, and none of them may change: so it
// stays, and so does each tet that has one.
#include "pieces/piece_task.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "contract/inspector.h"
#include "kernel/mesh_builder.h"
#include "kernel/mesh_view.h"
#include "kernel/size_field.h"
#include "kernel/statistics.h"
#include "kernel/wanted_lengths.h"
#include "pieces/standing.h"

namespace tetmend::pieces {

namespace {

/// Leaves out what is not its own. `parts` is by vertex.
Piece keep_own(const Piece& all, std::span<const std::uint32_t> parts, std::uint32_t number) {
  Extract what;
  what.wanted.assign(all.ids.size(), 0);
  const auto choose = [&](const auto& elements, std::vector<std::uint32_t>& chosen) {
    for (std::uint32_t i = 0; i < elements.size(); ++i) {
      if (!is_own(elements[i].vertices, parts, number)) continue;
      chosen.push_back(i);
      for (const std::uint32_t v : elements[i].vertices) what.wanted[v] = 1;
    }
  };
  choose(all.tets, what.tets);
  choose(all.triangles, what.triangles);
  choose(all.edges, what.edges);
  choose(all.surface, what.surface);
  choose(all.lines, what.lines);
  for (std::size_t v = 0; v < parts.size(); ++v) {
    if (parts[v] == number) what.wanted[v] = 1;
  }
  return extract(all, what);
}

/// Which vertices are its own, and which are of tets that several pieces share.
void mark(Piece& piece, std::span<const std::uint32_t> parts, std::uint32_t number) {
  for (std::size_t v = 0; v < parts.size(); ++v) {
    const unsigned lasting = piece.marks[v] & unsigned{kLasting};
    const unsigned of_part = parts[v] == number ? kOwn : parts[v] == Parting::kNoPart ? kSeam : 0U;
    piece.marks[v] = static_cast<std::uint8_t>(lasting | of_part);
  }
  for (const PieceTet& tet : piece.tets) {
    std::uint32_t part = Parting::kNoPart;
    bool is_shared = false;
    for (const std::uint32_t v : tet.vertices) {
      if (parts[v] == Parting::kNoPart) continue;
      is_shared = is_shared || (part != Parting::kNoPart && parts[v] != part);
      part = parts[v];
    }
    if (!is_shared) continue;
    for (const std::uint32_t v : tet.vertices) {
      piece.marks[v] = static_cast<std::uint8_t>(piece.marks[v] | kBorder);
    }
  }
}

/// Tets that stay: protected, shared, or far from where something is left to do.
class StayingTets {
 public:
  /// @param rings  see TaskLimits. What is given must outlive it, the piece and parts by vertex.
  StayingTets(const Piece& piece, std::span<const std::uint32_t> parts, std::uint32_t number,
              unsigned rings)
      : parts_(parts),
        number_(number),
        near_(rings > 0 ? near_marked(piece, kBorder, rings)
                        : std::vector<char>(piece.ids.size(), 1)) {}

  bool operator()(const PieceTet& tet) const {
    const auto& v = tet.vertices;
    const auto is_foreign = [&](std::uint32_t w) { return parts_[w] != number_; };
    return tet.is_protected() || std::any_of(v.begin(), v.end(), is_foreign) ||
           std::none_of(v.begin(), v.end(), [&](std::uint32_t w) { return near_[w] != 0; });
  }

 private:
  std::span<const std::uint32_t> parts_;
  std::uint32_t number_;
  std::vector<char> near_;
};

constexpr double kRounding = 1e-9;

/// By their angles, the worst first.
std::vector<double> bad_qualities(const TetMesh& mesh) {
  const Standard standard = mesh.standard().of_angles();
  std::vector<double> bad;
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    const TetHandle t(slot);
    if (mesh.is_deleted(t)) continue;
    const TetVertices& v = mesh.vertices(t);
    const double quality =
        standard.quality(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
    if (quality < kBadThreshold) bad.push_back(quality);
  }
  std::sort(bad.begin(), bad.end());
  return bad;
}

/// The first that differs is better, or there are fewer.
bool is_better(std::span<const double> after, std::span<const double> before) {
  for (std::size_t i = 0; i < std::min(after.size(), before.size()); ++i) {
    if (std::abs(after[i] - before[i]) > kRounding) return after[i] > before[i];
  }
  return after.size() < before.size();
}

/// What is promised not to become worse, frozen tets included.
struct Reached {
  MeshStatistics statistics;
  std::vector<double> bad;  ///< where they may pay for each other

  Reached(const TetMesh& mesh, const Goal& goal, bool may_pay)
      : statistics(compute_statistics(mesh, goal)) {
    if (may_pay) bad = bad_qualities(mesh);
  }
};

bool is_worse(const Reached& before, const Reached& after, const Goal& goal,
              std::size_t spare_bad) {
  const MeshStatistics& then = before.statistics;
  const MeshStatistics& now = after.statistics;
  const bool is_spent = now.n_bad > then.n_bad || now.lambda > then.lambda + kRounding;
  if (is_spent && now.n_bad <= then.n_bad + spare_bad && is_better(after.bad, before.bad)) {
    return false;
  }
  return is_spent || now.theta_min < then.theta_min - kRounding ||
         now.theta_max > std::max(then.theta_max, goal.max_angle) + kRounding;
}

/// A piece while it is worked on.
class Task {
 public:
  Task(const Piece& gathered, const Parting& parting, std::uint32_t number,
       const TaskOptions& options, const HeldSurface* surface)
      : gathered_(gathered),
        parts_(parting.parts_of(gathered)),
        number_(number),
        options_(options),
        surface_(surface) {}

  TaskResult run(const TaskLimits& limits);

 private:
  bool build();
  void freeze(const TaskLimits& limits);
  void run_schedule(const TaskLimits& limits);
  void take_back();
  void take_vertices(const MeshView& view, Piece& all, std::vector<std::uint32_t>& parts);
  void take_tets(std::span<const std::uint32_t> numbers, Piece& all);
  void take_surface(std::span<const std::uint32_t> numbers, Piece& all) const;

  /// The date of what has changed since the last division.
  static constexpr Date kFresh = 1;

  const Piece& gathered_;
  const std::vector<std::uint32_t> parts_;
  const std::uint32_t number_;
  const TaskOptions& options_;
  const HeldSurface* const surface_;  // null: fixed
  TetMesh mesh_;
  std::vector<std::uint32_t> tet_numbers_;
  std::size_t free_tets_ = 0;
  TaskResult result_;
};

TaskResult Task::run(const TaskLimits& limits) {
  const bool is_sound = build();
  if (is_sound) {
    freeze(limits);
    mesh_.set_bounds(options_.wanted() != nullptr ? Bounds() : limits.bounds);
    mesh_.set_size_field(options_.wanted() == nullptr ? options_.size_field
                                                      : in_work(*options_.wanted(), mesh_.scale()));
    if (surface_ != nullptr) mesh_.set_surface_guard(surface_->guard(mesh_, gathered_));
    const Goal& goal = options_.standard.goal();
    const bool may_pay = limits.spare_bad > 0;
    const Reached before(mesh_, goal, may_pay);
    run_schedule(limits);
    const Reached after(mesh_, goal, may_pay);
    result_.went_back =
        options_.wanted() == nullptr && is_worse(before, after, goal, limits.spare_bad);
  }
  if (!is_sound || result_.went_back) build();
  take_back();
  return std::move(result_);
}

/// False where most tets are inverted: the mesh has them turned round.
bool Task::build() {
  BuildReport report;
  MeshData data = to_data(gathered_);
  mesh_ = TetMesh::build(data, {.report = &report, .tet_numbers = &tet_numbers_});
  mesh_.set_standard(options_.standard);
  return !report.mirrored && report.reordered_tets == 0;
}

/// Also tells what counts as tried already, by dates.
void Task::freeze(const TaskLimits& limits) {
  const StayingTets stays(gathered_, parts_, number_, limits.rings);
  free_tets_ = mesh_.tet_count() - mesh_.freeze([&](TetHandle t) {
    return stays(gathered_.tets[tet_numbers_[t.index()]]);
  });
  if (limits.rings == 0) return;
  const std::vector<char> is_fresh = near_marked(gathered_, kBorder, limits.fresh_rings);
  for (std::uint32_t slot = 0; slot < mesh_.vertex_slots(); ++slot) {
    const VertexHandle v(slot);
    if (is_fresh[mesh_.origin(v)] != 0) MeshBuilder::set_changed(mesh_, v, kFresh);
  }
}

void Task::run_schedule(const TaskLimits& limits) {
  Run run(mesh_, options_.registry);
  if (limits.whole > 0) {
    const std::uint64_t share = limits.share > 0 ? limits.share : free_tets_;
    run.set_share(std::min(share, limits.whole), limits.whole);
  }
  if (limits.rings > 0) run.set_first_date(kFresh);
  if (limits.most_new_tets != std::numeric_limits<std::size_t>::max()) {
    run.set_most_tets(mesh_.tet_count() + limits.most_new_tets);
  }
  if (limits.seconds > 0) run.set_time_limit(limits.seconds);
  if (limits.trace) run.set_trace(limits.trace(mesh_));
  contract::Inspector inspector;
  if (options_.check_operators) run.set_inspector(&inspector);
  const face::WatchedRun watched(options_.watcher, run);
  improve(run, options_.schedule, options_.settings.of(limits.aim));
  // Where the fixed surface holds bad tets, it moves. What is stuck at a border is for another
  // division or a zone: costly rounds would only refine around it.
  if (mesh_.surface_guard() != nullptr && !run.cancelled()) {
    run.set_standard(options_.standard);
    ScheduleSettings settings;
    if (!limits.is_zone || options_.wanted() != nullptr) settings.emplace_back("max_rounds", "0");
    if (run.indicators().n_bad > 0) improve(run, Schedule::builtin("surface"), settings);
  }
  run.set_standard(options_.standard);  // a script may aim higher for a while, and be stopped then
  result_.stopped = run.cancelled();
  for (const PassRecord& record : run.records) {
    for (std::size_t i = 0; i < kVerdictCount; ++i) result_.verdicts[i] += record.verdicts[i];
    result_.items += record.items;
    result_.deferred += record.deferred;
  }
}

void Task::take_back() {
  mesh_.renew_surface();
  const MeshView view(mesh_);
  Piece all;
  std::vector<std::uint32_t> parts;
  take_vertices(view, all, parts);
  std::vector<std::uint32_t> numbers(mesh_.vertex_slots(), 0);
  const auto slots = view.vertex_slots();
  for (std::uint32_t i = 0; i < slots.size(); ++i) numbers[slots[i]] = i;
  take_tets(numbers, all);
  all.triangles.assign(view.triangles().begin(), view.triangles().end());
  all.edges.assign(view.edges().begin(), view.edges().end());
  take_surface(numbers, all);
  mesh_ = {};
  mark(all, parts, number_);
  result_.piece = keep_own(all, parts, number_);
}

void Task::take_vertices(const MeshView& view, Piece& all, std::vector<std::uint32_t>& parts) {
  const std::size_t count = view.point_count();
  const auto slots = view.vertex_slots();
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t origin = mesh_.origin(VertexHandle(slots[i]));
    const bool is_new = origin == TetMesh::kNotFromFile;
    all.ids.push_back(is_new ? TaskResult::kNewVertex + result_.added++ : gathered_.ids[origin]);
    all.points.push_back(view.point(i));
    unsigned mark = 0;
    if (!is_new) {
      mark = gathered_.marks[origin] & unsigned{kCorner | kMoved};
      if (!(gathered_.points[origin] == view.point(i))) mark |= kMoved;
    }
    all.marks.push_back(static_cast<std::uint8_t>(mark));
    if (view.has_point_labels()) all.labels.push_back(view.point_label(i));
    parts.push_back(is_new ? number_ : parts_[origin]);
  }
  for (const std::uint32_t v : view.required_vertices()) {
    all.marks[v] = static_cast<std::uint8_t>(all.marks[v] | kRequired);
  }
}

/// Patches and lines as the guard knows them by now. Where there is none, nothing has moved.
void Task::take_surface(std::span<const std::uint32_t> numbers, Piece& all) const {
  if (surface_ == nullptr) return;
  if (const auto* const guard = dynamic_cast<const Envelope*>(mesh_.surface_guard())) {
    const SurfaceFeatures now = guard->present();
    for (const auto& face : now.faces) {
      auto& to = all.surface.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) to.vertices[k] = numbers[face.vertices[k].index()];
      to.label = static_cast<Label>(face.patch);
    }
    for (const auto& edge : now.edges) {
      auto& to = all.lines.emplace_back();
      for (std::size_t k = 0; k < 2; ++k) to.vertices[k] = numbers[edge.vertices[k].index()];
      to.label = static_cast<Label>(edge.line);
    }
    return;
  }
  std::vector<std::uint32_t> by_origin(gathered_.ids.size(), 0);
  for (std::uint32_t slot = 0; slot < mesh_.vertex_slots(); ++slot) {
    const std::uint32_t origin = mesh_.origin(VertexHandle(slot));
    if (origin != TetMesh::kNotFromFile) by_origin[origin] = numbers[slot];
  }
  const auto renumber = [&](auto elements) {
    for (auto& element : elements) {
      for (std::uint32_t& v : element.vertices) v = by_origin[v];
    }
    return elements;
  };
  all.surface = renumber(gathered_.surface);
  all.lines = renumber(gathered_.lines);
}

void Task::take_tets(std::span<const std::uint32_t> numbers, Piece& all) {
  for (std::uint32_t slot = 0; slot < mesh_.tet_slots(); ++slot) {
    const TetHandle t(slot);
    if (mesh_.is_deleted(t)) continue;
    PieceTet tet;
    for (std::size_t i = 0; i < 4; ++i) tet.vertices[i] = numbers[mesh_.vertices(t)[i].index()];
    tet.label = mesh_.label(t);
    if (!mesh_.is_created(t)) tet.origin = gathered_.tets[tet_numbers_[slot]].origin;
    all.tets.push_back(tet);
  }
}

}  // namespace

AimSettings::AimSettings(const Schedule& schedule, const ScheduleSettings& settings) {
  const ScheduleInfo info = schedule.describe();
  settings_.fill(settings);
  const auto set = [&](Aim aim, std::string_view name, std::string_view value) {
    const bool has = std::any_of(info.parameters.begin(), info.parameters.end(),
                                 [&](const ScheduleParameter& p) { return p.name == name; });
    const bool is_set = std::any_of(settings.begin(), settings.end(),
                                    [&](const auto& setting) { return setting.first == name; });
    if (has && !is_set) settings_[static_cast<std::size_t>(aim)].emplace_back(name, value);
  };
  set(Aim::but_worst, "worst_later", "true");
  set(Aim::worst, "worst_only", "true");
  // A polish is for small meshes, and these are parts of a large one.
  for (const Aim aim : {Aim::all, Aim::but_worst, Aim::worst}) {
    set(aim, "polish_first", "0");
    set(aim, "polish_last", "0");
  }
}

std::shared_ptr<const WantedLengths> in_work(const WantedLengths& of_file, const Scale& scale) {
  if (scale.is_one()) return {std::shared_ptr<const WantedLengths>(), &of_file};
  return std::make_shared<WantedLengths>([&of_file, scale](const Point& p) {
    return scale.to_work(of_file.length(scale.to_file(p)));
  });
}

TaskResult work_on(const Piece& gathered, const Parting& parting, std::uint32_t number,
                   const TaskOptions& options, const TaskLimits& limits,
                   const HeldSurface* surface) {
  return Task(gathered, parting, number, options, surface).run(limits);
}

Piece own_part(const Piece& gathered, const Parting& parting, std::uint32_t number) {
  const std::vector<std::uint32_t> parts = parting.parts_of(gathered);
  Piece all = gathered;
  mark(all, parts, number);
  return keep_own(all, parts, number);
}

std::optional<double> worst_free(const Piece& gathered, const Parting& parting,
                                 std::uint32_t number, unsigned rings, const Standard& standard) {
  const std::vector<std::uint32_t> parts = parting.parts_of(gathered);
  const StayingTets stays(gathered, parts, number, rings);
  const double scale = scale_of(parting.side);
  std::optional<double> worst;
  for (const PieceTet& tet : gathered.tets) {
    if (stays(tet)) continue;
    const std::array<Point, 4> p = corners_of(gathered, tet, scale);
    const double quality = standard.quality(p[0], p[1], p[2], p[3]);
    if (!worst || quality < *worst) worst = quality;
  }
  return worst;
}

}  // namespace tetmend::pieces
