// SPDX-License-Identifier: MIT
//   forward: events one after the other, see Playback
//   back:    the log in reverse; where it does not reach, the nearest keyframe, then forward
#include "trace/replay.h"

#include <algorithm>

#include "kernel/star.h"

namespace tetmend {

namespace {

/// Of a log of this many steps the older half is dropped.
constexpr std::uint64_t kLongLog = 1 << 17;
/// A copy of so many bytes takes as long as to play an event.
constexpr std::uint64_t kBytesOfAnEvent = 2048;
/// A list by vertex costs as much as so many looks at all tets.
constexpr unsigned kFewLooks = 8;

bool holds_all_of(const TetVertices& tet, std::span<const VertexHandle> vertices) {
  return std::all_of(vertices.begin(), vertices.end(), [&](VertexHandle v) {
    return std::find(tet.begin(), tet.end(), v) != tet.end();
  });
}

}  // namespace

Replay::Replay(const TraceFile& file, std::size_t memory, std::uint64_t distance)
    : file_(file), distance_(distance), cursor_(file), playback_(file.initial_mesh()) {
  take_keyframes(memory);
}

void Replay::take_keyframes(std::size_t memory) {
  keyframes_.push_back({0, {}});
  const std::uint64_t affordable = std::max<std::size_t>(1, memory / (mesh().bytes() + 1));
  distance_ = std::max(distance_, file_.event_count() / affordable);
  for (const std::uint64_t begin : file_.chunk_begins()) {
    if (begin < keyframes_.back().position + distance_) continue;
    forward_to(begin);
    playback_.forget_log(position_);
    keyframes_.push_back({position_, mesh()});
    // The mesh may have grown. Twice the memory is the most, with one that doubles at once.
    if (keyframes_.size() * mesh().bytes() > 2 * memory) thin_keyframes();
  }
  if (position_ != 0) restore(keyframes_.front());
}

/// Keeps the first and every second one after it.
void Replay::thin_keyframes() {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < keyframes_.size(); k += 2) {
    if (k != kept) keyframes_[kept] = std::move(keyframes_[k]);
    ++kept;
  }
  keyframes_.resize(kept);
  distance_ *= 2;
}

void Replay::restore(const Keyframe& keyframe) {
  const bool is_first = keyframe.position == 0;
  playback_.reset(is_first ? file_.initial_mesh() : keyframe.mesh, keyframe.position);
  position_ = keyframe.position;
}

/// The event before `position` is played or stays in the log, so that cavity() can tell of it.
void Replay::seek(std::uint64_t position) {
  const bool is_logged =
      position > playback_.log_begin() || (position == 0 && playback_.log_begin() == 0);
  if (position < position_ && is_logged) {
    playback_.back_to(position);
    position_ = position;
    return;
  }
  const auto not_before =
      std::lower_bound(keyframes_.begin(), keyframes_.end(), position,
                       [](const Keyframe& k, std::uint64_t p) { return k.position < p; });
  const Keyframe& keyframe = not_before == keyframes_.begin() ? *not_before : *(not_before - 1);
  const std::uint64_t near = mesh().bytes() / kBytesOfAnEvent;
  const bool is_ahead = keyframe.position > position_ && position - position_ > near;
  if (position < position_ || is_ahead) restore(keyframe);
  forward_to(position);
}

const SlotMesh& Replay::mesh_at(std::uint64_t position) {
  const bool is_end = position == file_.event_count();
  if (is_end && position_ != position && file_.last_mesh() != nullptr) return *file_.last_mesh();
  seek(position);
  return mesh();
}

void Replay::forward_to(std::uint64_t position) {
  if (position == position_) return;
  cursor_.move_to(position_);
  const std::span<const std::uint64_t> begins = file_.chunk_begins();
  while (position_ < position) {
    if (playback_.log_size() > std::min(kLongLog, 4 * distance_) &&
        std::binary_search(begins.begin(), begins.end(), position_)) {
      shorten_log();
    }
    if (playback_.prepare(cursor_.next(), position_)) playback_.make();
    ++position_;
  }
}

/// A step back must not lead to a keyframe. Nothing is undone across the border of a chunk.
void Replay::shorten_log() {
  const std::span<const std::uint64_t> begins = file_.chunk_begins();
  const std::uint64_t middle = playback_.log_begin() + (position_ - playback_.log_begin()) / 2;
  playback_.shorten_log(*std::upper_bound(begins.begin(), begins.end(), middle));
}

void Replay::lend(const TetMesh& start) {
  if (start_ == nullptr) lent_ = changes().mark();
  start_ = &start;
}

/// Those around it at the beginning, and all that were written since; false where that is not known.
bool Replay::add_tets_of(VertexHandle v, std::vector<TetHandle>& tets) {
  const ChangeLog::Changes changed = changes().since(lent_);
  if (start_ == nullptr || changed.everything) return false;
  tets.assign(changed.tets.begin(), changed.tets.end());
  const bool was_there =
      v.index() < start_->vertex_slots() && !start_->is_deleted(v) && start_->tet_of(v).is_valid();
  if (was_there) {
    for (const TetHandle t : star(*start_, v)) tets.push_back(t);
  }
  std::sort(tets.begin(), tets.end());
  tets.erase(std::unique(tets.begin(), tets.end()), tets.end());
  return true;
}

std::vector<TetHandle> Replay::tets_around(std::span<const VertexHandle> vertices) {
  if (vertices.empty()) return {};
  std::vector<TetHandle> tets;
  const auto is_no_such = [&](TetHandle t) {
    return mesh().is_deleted(t) || !holds_all_of(mesh().vertices(t), vertices);
  };
  if (add_tets_of(vertices.front(), tets)) {
    std::erase_if(tets, is_no_such);
    // Parts that touch in the vertex alone are not all seen from one of its tets.
    if (!tets.empty()) return tets;
  }
  if (looks_ < kFewLooks) {
    ++looks_;
    for (std::uint32_t slot = 0; slot < mesh().tet_slots(); ++slot) {
      const TetHandle t(slot);
      if (holds_all_of(mesh().vertices(t), vertices) && !mesh().is_deleted(t)) tets.push_back(t);
    }
    return tets;
  }
  vertex_tets_.follow(mesh(), changes());
  tets = vertex_tets_.tets_of(vertices.front());
  std::erase_if(tets, [&](TetHandle t) { return !holds_all_of(mesh().vertices(t), vertices); });
  return tets;
}

Cavity Replay::cavity() const {
  Cavity cavity;
  for (const TetChange& change : playback_.tet_changes(position_)) {
    if (change.before[0].is_valid()) cavity.removed.push_back({change.tet, change.before});
    if (change.after[0].is_valid()) cavity.created.push_back({change.tet, change.after});
  }
  const auto vertices = playback_.vertex_changes(position_);
  cavity.vertices.assign(vertices.begin(), vertices.end());
  return cavity;
}

}  // namespace tetmend
