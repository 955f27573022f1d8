// SPDX-License-Identifier: MIT
// What a transaction has changed so far, for those who judge it: read from its journal.
#include <algorithm>
#include <bit>

#include "kernel/transaction.h"
#include "kernel/workspace.h"

namespace tetmend {

void Transaction::compare(std::vector<Quality>& before, std::vector<Quality>& now) const {
  list_qualities(before, now);
  std::sort(before.begin(), before.end());
  std::sort(now.begin(), now.end());
}

void Transaction::list_qualities(std::vector<Quality>& before, std::vector<Quality>& now) const {
  const Journal& journal = workspace_.journal_;
  before.clear();
  now.clear();
  if (journal.edits.size() == first_edit_ + 1) {  // no tet was touched twice
    const Edit& edit = journal.edits.back();
    for (std::uint32_t k = edit.removed_begin; k < edit.removed_end; ++k) {
      before.push_back(journal.removed[k].quality);
    }
    for (std::uint32_t k = edit.created_begin; k < edit.created_end; ++k) {
      now.push_back(mesh_.quality(journal.created[k]));
    }
    for (std::uint32_t k = edit.qualities_begin; k < edit.qualities_end; ++k) {
      before.push_back(journal.qualities[k].quality);
      now.push_back(mesh_.quality(journal.qualities[k].tet));
    }
    return;
  }
  IndexSet& touched = workspace_.touched_set_;
  touched.clear();
  // The first time an edit touches a slot tells what was in it when the transaction began.
  const auto touch = [&](TetHandle t) {
    if (!touched.insert(t.index())) return false;
    if (!mesh_.is_deleted(t)) now.push_back(mesh_.quality(t));
    return true;
  };
  for (std::size_t i = first_edit_; i < journal.edits.size(); ++i) {
    const Edit& edit = journal.edits[i];
    for (std::uint32_t k = edit.removed_begin; k < edit.removed_end; ++k) {
      if (touch(journal.removed[k].tet)) before.push_back(journal.removed[k].quality);
    }
    for (std::uint32_t k = edit.created_begin; k < edit.created_end; ++k) touch(journal.created[k]);
    for (std::uint32_t k = edit.qualities_begin; k < edit.qualities_end; ++k) {
      if (touch(journal.qualities[k].tet)) before.push_back(journal.qualities[k].quality);
    }
  }
}

void Transaction::list_changed(std::vector<TetHandle>& out) const {
  const Journal& journal = workspace_.journal_;
  IndexSet& touched = workspace_.touched_set_;
  touched.clear();
  out.clear();
  const auto touch = [&](TetHandle t) {
    if (touched.insert(t.index()) && !mesh_.is_deleted(t)) out.push_back(t);
  };
  for (std::size_t i = first_edit_; i < journal.edits.size(); ++i) {
    const Edit& edit = journal.edits[i];
    for (std::uint32_t k = edit.created_begin; k < edit.created_end; ++k) touch(journal.created[k]);
    for (std::uint32_t k = edit.qualities_begin; k < edit.qualities_end; ++k) {
      touch(journal.qualities[k].tet);
    }
  }
}

bool Transaction::has_too_many_tets() const {
  const std::size_t now = workspace_.tet_count(mesh_);
  return static_cast<std::ptrdiff_t>(now - tets_before_) > 0 && workspace_.has_too_many_tets(mesh_);
}

TransactionPast& Transaction::past() const {
  const Journal& journal = workspace_.journal_;
  TransactionPast& past = workspace_.past_;
  past.displaced.clear();
  past.made.clear();
  past.removed.clear();
  for (std::size_t i = first_edit_; i < journal.edits.size(); ++i) {
    const Edit& edit = journal.edits[i];
    if (edit.kind != Edit::Kind::replace_cavity && !past.is_displaced(edit.vertex)) {
      past.displaced.push_back({edit.vertex, edit.point});
    }
    for (std::uint32_t k = edit.removed_begin; k < edit.removed_end; ++k) {
      const Journal::RemovedTet& tet = journal.removed[k];
      if (!past.was_made(tet.tet)) past.removed.push_back(tet.vertices);
    }
    for (std::uint32_t k = edit.created_begin; k < edit.created_end; ++k) {
      past.made.push_back(journal.created[k]);
    }
  }
  list_changed(past.changed);
  return past;
}

Transaction::Tets Transaction::tets() const {
  TransactionPast& past = this->past();
  past.before.clear();
  past.now.clear();
  past.vertices_before.clear();
  past.vertices_now.clear();
  const auto add_before = [&](const TetVertices& tet) {
    past.vertices_before.push_back(tet);
    auto& corners = past.before.emplace_back();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto place = past.find(tet[i]);
      corners[i] = place == past.displaced.end() ? mesh_.point(tet[i]) : place->point;
    }
  };
  for (const TetVertices& tet : past.removed) add_before(tet);
  for (const TetHandle t : past.changed) {
    const TetVertices& v = mesh_.vertices(t);
    past.now.push_back(
        {mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2]), mesh_.point(v[3])});
    past.vertices_now.push_back(v);
    if (!past.was_made(t)) add_before(v);
  }
  return {past.before, past.now, past.vertices_before, past.vertices_now};
}

void Transaction::list_new_edges(std::vector<std::array<VertexHandle, 2>>& out) const {
  const TransactionPast& past = this->past();
  const auto was_edge = [&past](VertexHandle a, VertexHandle b) {
    return std::any_of(past.removed.begin(), past.removed.end(), [&](const TetVertices& tet) {
      return std::find(tet.begin(), tet.end(), a) != tet.end() &&
             std::find(tet.begin(), tet.end(), b) != tet.end();
    });
  };
  out.clear();
  for (const TetHandle t : past.changed) {
    const bool was_there = !past.was_made(t);
    for (const auto& [j, k] : kEdgeVertices) {
      const VertexHandle a = mesh_.vertices(t)[j];
      const VertexHandle b = mesh_.vertices(t)[k];
      const bool is_new =
          past.is_displaced(a) || past.is_displaced(b) || !(was_there || was_edge(a, b));
      if (is_new) out.push_back({a, b});
    }
  }
}

namespace {

/// The edges of tets before and after a change, each once. Hashed, for a change is asked about often.
class EdgesOfChange {
 public:
  static constexpr unsigned kBefore = 1, kNow = 2, kBoth = 3;

  /// So many tets are to come.
  void clear(std::size_t tets) {
    for (const std::uint32_t slot : used_) slots_[slot].sides = 0;
    used_.clear();
    const std::size_t most = 2 * kEdgeVertices.size() * tets;  // at most half of the slots are used
    if (slots_.size() <= most) {
      slots_.assign(std::bit_ceil(most + 1), {});
      shift_ = 64 - static_cast<unsigned>(std::countr_zero(slots_.size()));
    }
  }
  void add(const TetVertices& tet, unsigned sides) {
    for (const auto& [j, k] : kEdgeVertices) {
      const std::uint64_t low = std::min(tet[j].index(), tet[k].index());
      const std::uint64_t ends = low << 32 | std::max(tet[j].index(), tet[k].index());
      Slot& slot = slots_[slot_of(ends)];
      if (slot.sides == 0) used_.push_back(static_cast<std::uint32_t>(&slot - slots_.data()));
      slot.ends = ends;
      slot.sides |= sides;
    }
  }
  /// In the order in which they came.
  template <class Act>
  void for_each(const Act& act) const {
    for (const std::uint32_t slot : used_) {
      const auto& [ends, sides] = slots_[slot];
      act(VertexHandle(static_cast<std::uint32_t>(ends >> 32)),
          VertexHandle(static_cast<std::uint32_t>(ends)), sides);
    }
  }

 private:
  struct Slot {
    std::uint64_t ends = 0;
    unsigned sides = 0;  // 0: free
  };

  std::size_t slot_of(std::uint64_t ends) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = ends * 0x9E3779B97F4A7C15u >> shift_;
    while (slots_[i].sides != 0 && slots_[i].ends != ends) i = (i + 1) & mask;
    return i;
  }

  std::vector<Slot> slots_;
  std::vector<std::uint32_t> used_;
  unsigned shift_ = 63;
};

}  // namespace

void Transaction::list_changed_edges(std::vector<std::array<Point, 2>>& before,
                                     std::vector<std::array<Point, 2>>& now) const {
  thread_local EdgesOfChange edges;
  const TransactionPast& past = this->past();
  edges.clear(past.removed.size() + past.changed.size());
  for (const TetVertices& tet : past.removed) edges.add(tet, EdgesOfChange::kBefore);
  for (const TetHandle t : past.changed) {
    edges.add(mesh_.vertices(t), past.was_made(t) ? EdgesOfChange::kNow : EdgesOfChange::kBoth);
  }
  const auto old_place = [&](VertexHandle v) {
    const auto place = past.find(v);
    return place == past.displaced.end() ? mesh_.point(v) : place->point;
  };
  before.clear();
  now.clear();
  edges.for_each([&](VertexHandle a, VertexHandle b, unsigned sides) {
    if (sides == EdgesOfChange::kBoth && !past.is_displaced(a) && !past.is_displaced(b)) return;
    if (sides & EdgesOfChange::kBefore) before.push_back({old_place(a), old_place(b)});
    if (sides & EdgesOfChange::kNow) now.push_back({mesh_.point(a), mesh_.point(b)});
  });
}

}  // namespace tetmend
