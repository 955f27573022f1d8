// SPDX-License-Identifier: MIT
// The best tetrahedralisation of a small polyhedron by branch and bound ([liu_spr]). A pure unit:
// points and triangles in, tets out.
//
//   The search keeps a front, the faces with a tet on one side only. It fills the one with the
//   fewest apexes left, in the order of the quality of the tet, until no face is open or one has no
//   apex. At each step it is known for each open face which tets are still possible. Such a tet is
//   better than the best filling so far. It overlaps no tet that has been placed, and does not
//   cross the surface.
//
//   The result tiles the polyhedron, whatever the tests of overlap may have missed by rounding. All
//   tets are positive and every face has both its sides, so each point inside the surface lies in
//   one tet, and no other point does.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "kernel/quality.h"
#include "search/side_table.h"

namespace tetmend {

struct PolyhedronProblem {
  using Triangle = std::array<std::uint8_t, 3>;

  /// Counterclockwise seen from outside; closed. It may have several parts, and touch itself.
  std::span<const Triangle> surface;
  PointMask kept = 0;    ///< points inside that must be corners of tets; others need not
  PointMask banned = 0;  ///< corners of a tet that must not be used; none if 0
  Quality floor = 0;     ///< every new tet must be better than this; not negative
  /// The new tets must not lack more than this in sum, see deficit().
  double deficit_limit = std::numeric_limits<double>::infinity();
  /// A tetrahedralisation whose worst tet is this good ends the search.
  Quality enough = std::numeric_limits<Quality>::infinity();
  unsigned max_nodes = 1000;  ///< most tets that are placed on the way
};

/// Holds the points and what is known of them, re-used from run to run and when points are added.
class PolyhedronSearch {
 public:
  using Tet = std::array<std::uint8_t, 4>;  ///< in positive order

  /// Forgets all points.
  void clear();
  /// Gives the point the next number. Cost: see SideTable::add.
  void add(const Point& point);
  unsigned size() const { return table_.size(); }
  const SideTable& table() const { return table_; }

  /// Finds the tetrahedralisation whose worst tet is best, without points other than those added.
  /// False if there is none above the floor, or the nodes were spent before one was found.
  /// Precondition: the surface bounds a set of tets that do not overlap. Cost: exponential, bounded
  /// by the nodes; a node costs about the number of open faces.
  bool run(const PolyhedronProblem& problem);

  /// Of the last run, if it was successful.
  std::span<const Tet> tets() const { return best_; }
  Quality worst() const { return floor_; }
  /// Tets placed in the last run.
  unsigned nodes() const { return nodes_; }
  /// The last run ended for want of nodes: there may be something better.
  bool was_cut_short() const { return cut_short_; }

 private:
  /// A face of the front: its corners, and apexes of tets that may fill its empty side.
  struct OpenFace {
    unsigned triangle;
    PointMask corners;
    PointMask apexes;
  };
  struct PlacedTet {
    PointMask corners = 0;
    std::array<unsigned, 4> triangles{};  // of its faces
    std::array<std::uint8_t, 4> sides{};  // of these, on which the tet lies
    std::array<PointMask, 4> beyond{};    // points on that side
  };
  /// Of the tets placed so far.
  struct Path {
    Quality worst;
    double deficit;
  };
  /// A front that was filled in all ways, none of them better than the best so far, by tets that
  /// came after others with that deficit.
  struct DeadEnd {
    std::uint64_t front = 0;
    double deficit = 0;
  };
  enum class Admission : std::uint8_t { unknown, admitted, refused };

  // Sides of a triangle, as bits: those that have their tet, or are outside.
  static constexpr std::uint8_t kAbove = 1;
  static constexpr std::uint8_t kBelow = 2;
  static constexpr std::uint8_t kBoth = kAbove | kBelow;

  void begin(const PolyhedronProblem& problem);
  bool open_surface();
  void descend(std::size_t front, Path path);
  void finish(Path path);
  bool place(std::size_t front, const OpenFace& face, unsigned apex, Quality floor);
  void take_back(std::size_t front_end);
  void flip_sides(const PlacedTet& placed);
  DeadEnd& dead_end() { return dead_ends_[front_key_ % dead_ends_.size()]; }
  bool advance_front(std::size_t front, const PlacedTet& placed, Quality floor);
  bool open_face(unsigned triangle, PointMask corners);
  PointMask blocked_apexes(const OpenFace& face, const PlacedTet& placed) const;
  PointMask better_apexes(const OpenFace& face);
  PointMask empty_side(unsigned triangle) const;
  bool is_better(PointMask tet);
  bool is_admitted(PointMask tet);
  bool crosses_surface(const PlacedTet& tet) const;
  bool overlaps_placed(PointMask tet) const;
  Quality quality(PointMask tet);
  PlacedTet describe(PointMask tet) const;
  Tet in_positive_order(const PlacedTet& tet) const;

  SideTable table_;
  std::vector<Quality> quality_;  // of each tet, by rank; kUnknown until it is needed

  // Of one run.
  PolyhedronProblem problem_;
  std::vector<Admission> admission_;  // of each tet
  std::vector<std::uint8_t> taken_;   // sides of each triangle
  std::vector<PointMask> surface_corners_;
  std::vector<unsigned> surface_triangles_;
  std::vector<OpenFace> fronts_;  // one after the other, as deep as the search is
  std::vector<PlacedTet> placed_;
  std::uint64_t front_key_ = 0;     // of the last front
  std::vector<DeadEnd> dead_ends_;  // in the slot of their key; the last one stays
  bool forgets_ = false;            // a way was not judged by its front alone
  std::vector<Tet> best_;
  Quality floor_ = 0;
  unsigned nodes_ = 0;
  bool cut_short_ = false;
  bool done_ = false;
};

}  // namespace tetmend
