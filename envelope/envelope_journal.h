// SPDX-License-Identifier: MIT
// What one worker needs for edits of the surface: undo data and working memory.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "envelope/cover.h"
#include "envelope/envelope.h"
#include "envelope/replacement.h"

namespace tetmend {

class Envelope::Journal final : public SurfaceJournal {
 public:
  void clear() noexcept override {
    saved.clear();
    saved_covers.clear();
    steps.clear();
  }

  // What was exchanged: before undo as it was, before commit as it will be.
  struct Saved {
    VertexHandle vertex;
    std::unique_ptr<SurfaceVertex> data;
    Point point;
  };
  struct Certified {
    std::uint32_t element = 0;
    std::vector<PresentKey> certifiers;
  };
  std::vector<Saved> saved;
  std::vector<Certified> saved_covers;
  std::vector<JournalStep> steps;

  // Of the edit that is being asked about.
  SurfaceExchange edit;
  std::vector<PresentKey> gone;   ///< faces and edges that vanish or move, sorted
  std::vector<Certified> proofs;  ///< new ones, by element
  /// What certifies an element no longer, or from now on.
  std::vector<SurfaceVertex::Served> dropped, added;
  std::vector<VertexHandle> others;  ///< not of the edit, but what they serve changes

  // Working memory.
  CoverTest cover;
  double widening = 1;  ///< of tolerances, within what they were narrowed by
  double widened(double tolerance) const { return widening * tolerance; }
  std::vector<std::uint32_t> elements;
  std::vector<CoverTarget> targets;
  std::vector<PresentKey> keys;

  void clear_proof() {
    gone.clear();
    proofs.clear();
    dropped.clear();
    added.clear();
    others.clear();
  }
  bool is_gone(const PresentKey& key) const {
    return std::binary_search(gone.begin(), gone.end(), key);
  }
  void exchange_served(VertexHandle v, SurfaceVertex& data) const {
    std::erase_if(data.served, [&](const auto& entry) {
      return is_gone(entry.key) ||
             std::find(dropped.begin(), dropped.end(), entry) != dropped.end();
    });
    for (const auto& entry : added) {
      if (entry.key[0] == v) data.served.push_back(entry);
    }
  }
};

}  // namespace tetmend
