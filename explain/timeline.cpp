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
  explicit Gauge(const auto& mesh) : quality_(mesh.tet_slots(), kNone), is_bad_(quality_.size()) {
    std::vector<Entry> low;
    for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
      const TetHandle t(i);
      if (mesh.is_deleted(t)) continue;
      quality_[i] = mesh.quality(t);
      is_bad_[i] = misses_goal(mesh, t);
      bad_ += is_bad_[i] ? 1 : 0;
      if (quality_[i] < kBadThreshold) low.emplace_back(quality_[i], i);
    }
    worst_ = Entries({}, std::move(low));
  }

  void set(const SlotMesh& mesh, TetHandle t) {
    set(t.index(), mesh.quality(t), misses_goal(mesh, t));
  }
  void remove(TetHandle t) { set(t.index(), kNone, false); }

  std::size_t bad() const { return bad_; }
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
  using Entry = std::pair<Quality, std::uint32_t>;
  using Entries = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;

  void drop_old() {
    while (!worst_.empty() && quality_[worst_.top().second] != worst_.top().first) worst_.pop();
  }
  void set(std::uint32_t slot, Quality quality, bool is_bad) {
    if (slot >= quality_.size()) {
      quality_.resize(slot + 1, kNone);
      is_bad_.resize(slot + 1, false);
    }
    bad_ += is_bad ? 1 : 0;
    bad_ -= is_bad_[slot] ? 1 : 0;
    is_bad_[slot] = is_bad;
    quality_[slot] = quality;
    if (quality != kNone) worst_.emplace(quality, slot);
  }

  std::vector<Quality> quality_;  // by slot
  std::vector<bool> is_bad_;      // likewise
  Entries worst_;                 // those of low quality at least, with some of old times
  bool has_all_ = false;          // and all others, too
  std::size_t bad_ = 0;
};

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
  Gauge gauge = start != nullptr ? Gauge(*start) : Gauge(replay.mesh());
  timeline.samples.push_back({0, gauge.bad(), gauge.worst()});
  EventCursor cursor(file);
  const std::uint64_t end = file.event_count();
  const std::uint64_t distance = std::max<std::uint64_t>(1, end / samples);
  const auto add = [&](std::uint64_t position) {
    const Timeline::Sample now{position, gauge.bad(), gauge.worst()};
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
  replay.seek(0);
  return timeline;
}

}  // namespace tetmend::explain
