// SPDX-License-Identifier: MIT
// What a transaction has changed so far, for those who judge it: read from its journal.
#include <algorithm>

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

void Transaction::list_changed_edges(std::vector<std::array<Point, 2>>& before,
                                     std::vector<std::array<Point, 2>>& now) const {
  using Ends = std::array<VertexHandle, 2>;
  const TransactionPast& past = this->past();
  std::vector<Ends> old_edges;
  std::vector<Ends> new_edges;
  const auto add = [](const TetVertices& tet, std::vector<Ends>& edges) {
    for (const auto& [j, k] : kEdgeVertices) {
      edges.push_back(tet[j] < tet[k] ? Ends{tet[j], tet[k]} : Ends{tet[k], tet[j]});
    }
  };
  for (const TetVertices& tet : past.removed) add(tet, old_edges);
  for (const TetHandle t : past.changed) {
    add(mesh_.vertices(t), new_edges);
    if (!past.was_made(t)) add(mesh_.vertices(t), old_edges);
  }
  for (std::vector<Ends>* edges : {&old_edges, &new_edges}) {
    std::sort(edges->begin(), edges->end());
    edges->erase(std::unique(edges->begin(), edges->end()), edges->end());
  }
  const auto stays = [&](const Ends& ends, const std::vector<Ends>& others) {
    return !past.is_displaced(ends[0]) && !past.is_displaced(ends[1]) &&
           std::binary_search(others.begin(), others.end(), ends);
  };
  const auto old_place = [&](VertexHandle v) {
    const auto place = past.find(v);
    return place == past.displaced.end() ? mesh_.point(v) : place->point;
  };
  before.clear();
  now.clear();
  for (const Ends& ends : old_edges) {
    if (!stays(ends, new_edges)) before.push_back({old_place(ends[0]), old_place(ends[1])});
  }
  for (const Ends& ends : new_edges) {
    if (!stays(ends, old_edges)) now.push_back({mesh_.point(ends[0]), mesh_.point(ends[1])});
  }
}

}  // namespace tetmend
