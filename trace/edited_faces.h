// SPDX-License-Identifier: MIT
// The faces of a mesh while tets are exchanged for others and that is undone.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "trace/tet_faces.h"

namespace tetmend {

/// The faces of a mesh under edits, the last of which may be undone. Most are, at once: they never
/// reach the large table, which is out of every cache.
class EditedFaces {
 public:
  EditedFaces() { recent_.entries_.resize(kRecent); }

  void reserve(std::size_t tets) { table_.reserve(2 * tets); }
  /// A tet that is there before the first edit; see TetFaces::add().
  bool add(const TetVertices& tet, unsigned face) { return table_.add(tet, face); }

  /// What is made until the next is one edit, which takes or gives so many tets.
  void begin_edit(std::size_t tets) {
    constexpr std::size_t kMostTets = 100;  // their faces fit into the other half
    if (recent_.used_ > kRecent / 2 || tets > kMostTets) settle();
    if (tets <= kMostTets) edits_.push_back(journal_.size());
  }

  /// Forgets what was listed: so many tets are to come.
  void list_none(std::size_t tets) { listed_.clear(3 * tets); }
  /// Lists a face of a tet that goes.
  void list_gone(const TetVertices& tet, unsigned face) { list(tet, face, 0); }
  /// Lists a face of a tet that comes. False if another that comes is on its side.
  bool list_come(const TetVertices& tet, unsigned face) { return list(tet, face, kSecond); }

  /// The tets listed that go and those that come have the same hull.
  bool keep_hull() const {
    return std::all_of(listed_.entries_.begin(), listed_.entries_.end(), fits);
  }
  /// The same, but for faces where the mesh, which has those that go, has no tet on the other side:
  /// such may come and go.
  bool keep_hull_inside() const {
    return std::all_of(listed_.entries_.begin(), listed_.entries_.end(),
                       [&](const TetFaces::Entry& entry) {
                         return fits(entry) || (bits_of(entry.key) & ~first(entry)) == 0;
                       });
  }
  /// Puts what comes in the place of what goes, which was there. False if a tet is on the side of
  /// one that comes already.
  bool make() {
    if (edits_.empty()) settle();  // what is to be written is in the table alone
    return std::all_of(listed_.entries_.begin(), listed_.entries_.end(),
                       [&](const TetFaces::Entry& entry) {
                         return !entry.is_there() || first(entry) == second(entry) ||
                                put(entry.key, first(entry), second(entry));
                       });
  }

  /// Takes back the last edit. False if it is in the table for good: then list and make it backwards.
  bool undo() {
    if (edits_.empty()) return false;
    for (; journal_.size() > edits_.back(); journal_.pop_back()) {
      recent_.probe(journal_.back().key).sides = journal_.back().sides;
    }
    edits_.pop_back();
    return true;
  }
  /// No edit so far is undone with undo().
  void settle() {
    if (recent_.used_ > 0) {
      for (const TetFaces::Entry& entry : recent_.entries_) {
        if (entry.sides == TetFaces::kFree || first(entry) == second(entry)) continue;
        table_.entry_of(entry.key).sides = first(entry);
      }
      recent_.entries_.assign(kRecent, {});
      recent_.used_ = 0;
    }
    edits_.clear();
    journal_.clear();
  }

 private:
  static constexpr std::size_t kRecent = 4096;  // entries
  // Entries here have two sets of sides. Listed: that go and that come. Recent: of now, and what the
  // table has.
  static constexpr unsigned kSecond = 3;
  static std::uint32_t first(const TetFaces::Entry& entry) { return entry.sides & 3u; }
  static std::uint32_t second(const TetFaces::Entry& entry) { return entry.sides >> kSecond; }

  /// A face with one side, before or after, is of the hull.
  static bool fits(const TetFaces::Entry& entry) {
    const auto is_open = [](std::uint32_t sides) { return sides == 1 || sides == 2; };
    const bool is_of_hull = is_open(first(entry)) || is_open(second(entry));
    return !entry.is_there() || !is_of_hull || first(entry) == second(entry);
  }
  bool list(const TetVertices& tet, unsigned face, unsigned which) {
    const auto [key, side] = TetFaces::key_of(tet, face);
    TetFaces::Entry& entry = listed_.entry_of(key);
    const bool is_new = (entry.sides >> which & side) == 0;
    entry.sides |= side << which;
    return is_new;
  }
  std::uint32_t bits_of(const TetFaces::Key& key) const {
    const TetFaces::Entry& recent = recent_.entries_[recent_.place_of(key)];
    return recent.sides == TetFaces::kFree ? table_.bits_of(key) : first(recent);
  }
  bool put(const TetFaces::Key& key, std::uint32_t gone, std::uint32_t come) {
    TetFaces::Entry& entry = edits_.empty() ? table_.entry_of(key) : recent_entry(key);
    const std::uint32_t rest = entry.sides & ~gone;  // the entry stays until the next rehash
    entry.sides = rest | come;
    return (rest & come) == 0;
  }
  TetFaces::Entry& recent_entry(const TetFaces::Key& key) {
    TetFaces::Entry& entry = recent_.probe(key);  // there is room: see begin_edit()
    if (entry.sides == TetFaces::kFree) {
      const std::uint32_t bits = table_.bits_of(key);
      entry = {key, bits | (bits << kSecond)};
      ++recent_.used_;
    }
    journal_.push_back(entry);
    return entry;
  }

  TetFaces table_;
  TetFaces listed_;
  TetFaces recent_;                       // faces that edits touched lately
  std::vector<TetFaces::Entry> journal_;  // as they were before
  std::vector<std::size_t> edits_;        // those that can be undone: where each begins in it
};

}  // namespace tetmend
