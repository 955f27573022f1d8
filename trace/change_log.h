// SPDX-License-Identifier: MIT
// Which slots of a mesh were written, for those who keep something beside it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernel/handles.h"

namespace tetmend {

/// Any number of followers may ask; each keeps a mark of its own.
class ChangeLog {
 public:
  struct Mark {
    std::uint64_t generation = 0;  ///< 0: nothing was seen yet
    std::size_t tets = 0, vertices = 0;
  };
  /// Some slots may be listed that are what they were, and some several times.
  struct Changes {
    bool everything = false;  ///< anything may have changed; the lists are empty
    std::span<const TetHandle> tets;
    std::span<const VertexHandle> vertices;
  };

  void note(TetHandle t) { tets_.push_back(t); }
  void note(VertexHandle v) { vertices_.push_back(v); }
  /// Another mesh, or a list that would cost more to go through than the mesh.
  void note_everything() {
    ++generation_;
    tets_.clear();
    vertices_.clear();
  }
  /// To be called now and then.
  void keep_short() {
    if (tets_.size() + vertices_.size() > kMost) note_everything();
  }

  Mark mark() const { return {generation_, tets_.size(), vertices_.size()}; }
  /// Valid until the next note.
  Changes since(const Mark& mark) const {
    if (mark.generation != generation_) return {true, {}, {}};
    return {false, std::span(tets_).subspan(mark.tets),
            std::span(vertices_).subspan(mark.vertices)};
  }

 private:
  static constexpr std::size_t kMost = std::size_t{1} << 17;

  std::uint64_t generation_ = 1;
  std::vector<TetHandle> tets_;
  std::vector<VertexHandle> vertices_;
};

}  // namespace tetmend
