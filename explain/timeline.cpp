// SPDX-License-Identifier: MIT
#include "explain/timeline.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace tetmend::explain {

namespace {

/// Number of bad tets and worst quality of a mesh whose tets come and go.
class Gauge {
 public:
  explicit Gauge(const SlotMesh& mesh) {
    weigh(mesh);
    is_bad_.resize(quality_.size());
    for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
      const TetHandle t(i);
      is_bad_[i] = !mesh.is_deleted(t) && misses_goal(mesh, t) ? 1 : 0;
      bad_ += is_bad_[i];
    }
  }
  /// Counts from 0 on, by how many more or fewer are bad than in `start`, which must outlive this:
  /// only tets that change are looked at.
  explicit Gauge(const TetMesh& start) : start_(&start) {
    weigh(start);
    is_bad_.resize(quality_.size(), kUnknown);
  }

  void set(const SlotMesh& mesh, TetHandle t) {
    set(t.index(), mesh.quality(t), misses_goal(mesh, t));
  }
  void remove(TetHandle t) { set(t.index(), kNone, false); }

  std::ptrdiff_t bad() const { return bad_; }
  double worst() {
    drop_old();
    if (worst_.empty() && !std::exchange(has_all_, true)) {
      for (std::uint32_t i = 0; i < quality_.size(); ++i) {
        if (quality_[i] != kNone) worst_.emplace(quality_[i], i);
      }
    }
    return worst_.empty() ? 0 : static_cast<double>(worst_.top().first);
  }

 private:
  static constexpr Quality kNone = std::numeric_limits<Quality>::infinity();
  static constexpr std::uint8_t kUnknown = 2;
  using Entry = std::pair<Quality, std::uint32_t>;
  using Entries = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;

  void weigh(const auto& mesh) {
    quality_.resize(mesh.tet_slots(), kNone);
    std::vector<Entry> low;
    for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
      if (mesh.is_deleted(TetHandle(i))) continue;
      quality_[i] = mesh.quality(TetHandle(i));
      if (quality_[i] < kBadThreshold) low.emplace_back(quality_[i], i);
    }
    worst_ = Entries({}, std::move(low));
  }
  bool was_bad(std::uint32_t slot) const {
    if (is_bad_[slot] != kUnknown) return is_bad_[slot] == 1;
    return !start_->is_deleted(TetHandle(slot)) && misses_goal(*start_, TetHandle(slot));
  }
  void drop_old() {
    while (!worst_.empty() && quality_[worst_.top().second] != worst_.top().first) worst_.pop();
  }
  void set(std::uint32_t slot, Quality quality, bool is_bad) {
    if (slot >= quality_.size()) {
      quality_.resize(slot + 1, kNone);
      is_bad_.resize(slot + 1, 0);
    }
    bad_ += is_bad ? 1 : 0;
    bad_ -= was_bad(slot) ? 1 : 0;
    is_bad_[slot] = is_bad ? 1 : 0;
    quality_[slot] = quality;
    if (quality != kNone) worst_.emplace(quality, slot);
  }

  std::vector<Quality> quality_;      // by slot
  std::vector<std::uint8_t> is_bad_;  // likewise
  const TetMesh* start_ = nullptr;    // to ask where that is unknown
  Entries worst_;                     // those of low quality at least, with some of old times
  bool has_all_ = false;              // and all others, too
  std::ptrdiff_t bad_ = 0;
};

/// How many are bad at the end is known of a trace that is one pass, whose goal stays: those of the
/// beginning need no counting.
bool knows_bad_at_end(const TraceFile& file) {
  const SlotMesh& mesh = file.initial_mesh();
  return file.passes().size() == 1 && file.passes()[0].events.end == file.event_count() &&
         file.passes()[0].standard == mesh.standard() && mesh.frozen_tets().empty();
}

void follow(Gauge& gauge, const SlotMesh& mesh, const Cavity& cavity) {
  for (const CavityTet& tet : cavity.removed) {
    if (mesh.is_deleted(tet.tet)) gauge.remove(tet.tet);
  }
  for (const CavityTet& tet : cavity.created) gauge.set(mesh, tet.tet);
}

}  // namespace

const Timeline::Sample& Timeline::at(std::uint64_t position) const {
  const auto after =
      std::upper_bound(samples.begin(), samples.end(), position,
                       [](std::uint64_t p, const Sample& sample) { return p < sample.position; });
  return *(after - 1);
}

std::size_t Timeline::changes_before(std::uint64_t position) const {
  return static_cast<std::size_t>(std::upper_bound(changes.begin(), changes.end(), position) -
                                  changes.begin());
}

Timeline make_timeline(const TraceFile& file, Replay& replay, const TetMesh* start,
                       std::size_t samples) {
  Timeline timeline;
  replay.seek(0);
  const bool is_relative = start != nullptr && knows_bad_at_end(file);
  Gauge gauge = is_relative ? Gauge(*start) : Gauge(replay.mesh());
  const auto bad = [&] { return static_cast<std::size_t>(gauge.bad()); };
  timeline.samples.push_back({0, bad(), gauge.worst()});
  EventCursor cursor(file);
  const std::uint64_t end = file.event_count();
  const std::uint64_t distance = std::max<std::uint64_t>(1, end / samples);
  const auto add = [&](std::uint64_t position) {
    const Timeline::Sample now{position, bad(), gauge.worst()};
    const Timeline::Sample& last = timeline.samples.back();
    if (position == end || now.n_bad != last.n_bad || now.q_worst != last.q_worst) {
      timeline.samples.push_back(now);
    }
  };
  for (std::uint64_t position = 1; position <= end; ++position) {
    const EventKind kind = cursor.next().kind;
    if (changes_mesh(kind) || kind == EventKind::standard_changes) {
      timeline.changes.push_back(position);
      replay.seek(position);
      if (changes_mesh(kind)) {
        follow(gauge, replay.mesh(), replay.cavity());
      } else {
        gauge = Gauge(replay.mesh());
      }
    }
    if (position % distance == 0 || position == end) {
      add(position);
    }
  }
  if (is_relative) {  // numbers below 0 have wrapped around, and come back
    const std::size_t more = file.passes()[0].now.n_bad - bad();
    for (Timeline::Sample& sample : timeline.samples) sample.n_bad += more;
  }
  replay.seek(0);
  return timeline;
}

}  // namespace tetmend::explain
