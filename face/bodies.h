// SPDX-License-Identifier: MIT
// Tets that hang together, so that nothing is taken from what merely lies at the same place: parts may
// overlap, and so may solids of one label, or of none.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend::face {

/// A *body* is a set of tets of one label and one part that hang together by vertices: of all tets, or of
/// those that have changed. What comes in place of changed tets hangs together as they do.
class Bodies {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// Of all tets of `data`, which must outlive this. Cost: about linear; some 10 bytes a point.
  explicit Bodies(const MeshData& data);
  /// Of these tets alone.
  Bodies(const MeshData& data, std::span<const std::uint32_t> tets);

  std::size_t count() const { return labels_.size(); }
  /// Precondition: it is one of the tets.
  std::uint32_t of_tet(std::uint32_t tet) const;
  /// The body with this label that the point belongs to; kNone if there are several, or none.
  std::uint32_t of_point(std::uint32_t point, Label label) const;
  /// Replaces `found` by the bodies of this label that all of these points belong to, but for points
  /// that belong to none of it; where no body is left, by all of the label. Ascending.
  void common(std::span<const std::uint32_t> points, Label label,
              std::vector<std::uint32_t>& found) const;
  /// Some body, of whatever label, has all of these points. Cost: a few steps.
  bool have_one_in_common(std::span<const std::uint32_t> points) const;

 private:
  /// A place of its own for a point in tets of another kind than its first.
  struct Further {
    std::uint32_t point;
    std::uint32_t kind;
    friend auto operator<=>(const Further&, const Further&) = default;
  };

  void number_kinds(std::span<const std::uint32_t> tets);
  void find_slots(std::span<const std::uint32_t> tets);
  void join(const std::array<std::uint32_t, 4>& slots);
  void number_bodies();
  std::uint32_t kind_of(std::uint32_t tet) const { return kinds_.empty() ? 0 : kinds_[tet]; }
  std::uint32_t slot_of(std::uint32_t point, std::uint32_t kind) const;
  std::uint32_t root_of(std::uint32_t slot);
  bool has_further(std::uint32_t point) const {
    return !has_further_.empty() && has_further_[point] != 0;
  }
  std::uint32_t only_one_of(std::span<const std::uint32_t> points, Label label) const;
  template <class Act>
  void for_bodies_at(std::uint32_t point, const Act& act) const;

  const MeshData& data_;
  std::vector<std::uint32_t> kinds_;  // by tet: its label and part; empty: they are all the same
  std::vector<Label> kind_labels_;
  std::vector<std::uint32_t> first_kind_;  // by point; kNone: of no tet
  std::vector<Further> further_;           // ascending
  std::vector<char> has_further_;          // by point; empty: none has
  std::vector<std::uint32_t> body_of_;     // by slot: that of each point, then of each further one
  std::vector<Label> labels_;              // by body
};

/// Where something new comes from, as far as that shows in what it hangs together with.
struct Origin {
  std::uint32_t tet = Bodies::kNone;  ///< what became of this old one, if of any
  std::vector<std::uint32_t> points;  ///< old ones, not far away
  std::vector<std::uint32_t> bodies;  ///< that it may be of, ascending; none: of any

  void clear() {
    tet = Bodies::kNone;
    points.clear();
    bodies.clear();
  }
};

/// Where what is new in an improved mesh comes from: values of the old mesh are looked up there, whatever
/// else lies at the same place. The new mesh must outlive this.
class Origins {
 public:
  /// @param old_point by new number; kGone for new ones
  /// @param changed tets of the new mesh that are not as they were
  /// @param bodies of the old mesh: of what changed, or of all
  Origins(const MeshData& now, std::span<const std::uint32_t> old_point,
          std::span<const std::uint32_t> changed, Bodies bodies);

  const Bodies& bodies() const { return bodies_; }
  /// Of a tet that has changed.
  void of_tet(std::uint32_t tet, Origin& origin) const;
  /// Of a point of such tets.
  void of_point(std::uint32_t point, Origin& origin) const;
  /// Whether a new element with these vertices may be what has become of an old one with those.
  bool may_be_one(std::span<const std::uint32_t> made, std::span<const std::uint32_t> old) const;

 private:
  const MeshData& now_;
  const Bodies bodies_;
  // By new point.
  std::vector<std::uint32_t> anchors_;  // old points
  std::vector<std::uint32_t> tet_at_;   // the first that has changed
};

/// Gives new points an old one that they hang together with, through tets of one label. New points between
/// labels get none.
/// @param tets,which of the new mesh those that have changed
/// @param may_lead whether an old point may stand for others in tets of a label
/// @param anchors by new point: of an old one its old number, else Bodies::kNone
/// Cost: linear in the number of tets, times edges from an old point.
void spread_anchors(const std::vector<MeshData::Tet>& tets, std::span<const std::uint32_t> which,
                    const std::function<bool(std::uint32_t, Label)>& may_lead,
                    std::vector<std::uint32_t>& anchors);

}  // namespace tetmend::face
