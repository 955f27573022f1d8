// SPDX-License-Identifier: MIT
// What stored pieces ask parts of space, and what these answer.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "kernel/error.h"
#include "kernel/geometry.h"
#include "pieces/bytes.h"
#include "pieces/piece.h"
#include "pieces/ranks.h"
#include "pieces/rows.h"

namespace tetmend::pieces {

[[noreturn]] inline void fail_to_fit() {
  throw Error("pieces do not fit: the file has no row for one of their elements");
}

template <std::size_t N>
std::array<VertexId, N> sorted_ids(const std::vector<VertexId>& ids,
                                   const std::array<std::uint32_t, N>& vertices) {
  std::array<VertexId, N> sorted;
  for (std::size_t i = 0; i < N; ++i) sorted[i] = ids[vertices[i]];
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

inline std::array<Point, 4> corners_of(const std::vector<Point>& points,
                                       const std::array<std::uint32_t, 4>& vertices) {
  std::array<Point, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = points[vertices[i]];
  return corners;
}

inline Eigen::AlignedBox3d box_of(const std::array<Point, 4>& corners, double margin) {
  Eigen::AlignedBox3d box;
  for (const Point& corner : corners) box.extend(corner);
  const Point around = Point::Constant(margin);
  return {box.min() - around, box.max() + around};
}

/// What a piece wants to know of a part of space. Places are those in its lists.
struct Questions {
  struct OfNumber {
    std::uint64_t number;
    std::uint64_t place;
  };
  /// What something new hangs together with: with tets of a label, at points that the file has.
  struct Kin {
    std::array<VertexId, 4> points = {kNobody, kNobody, kNobody, kNobody};
    std::uint64_t tet = kNobody;  ///< of the file, if it has become of that
    Label label = 0;
    std::uint32_t is_known = 0;  ///< 0: only other pieces may know

    static constexpr VertexId kNobody = ~VertexId{0};
  };
  struct AtPoint {
    std::array<double, 3> point;
    std::uint64_t place;
    VertexId id;  ///< of a point, in all pieces
    Kin kin;
  };
  struct OfTet {
    std::array<std::array<double, 3>, 4> corners;
    std::uint64_t place;
    Kin kin;
  };
  template <std::size_t N>
  struct OfIds {
    std::array<VertexId, N> ids;
    std::uint64_t place;
  };

  std::vector<OfNumber> old_points, old_tets;  ///< that are as they were
  std::vector<AtPoint> new_points, new_tets;
  std::vector<OfIds<3>> triangles;
  std::vector<OfIds<2>> edges;
  std::vector<std::uint64_t> kept;  ///< old tets that are as they were
  std::vector<OfTet> shares;        ///< what old tets have in common with these

  bool is_empty() const {
    return old_points.empty() && old_tets.empty() && new_points.empty() && new_tets.empty() &&
           triangles.empty() && edges.empty() && kept.empty() && shares.empty();
  }
  std::string bytes() const {
    std::string all;
    put(old_points, all);
    put(old_tets, all);
    put(new_points, all);
    put(new_tets, all);
    put(triangles, all);
    put(edges, all);
    put(kept, all);
    put(shares, all);
    return all;
  }
  explicit Questions(std::string_view all = {}) {
    if (all.empty()) return;
    take(all, old_points);
    take(all, old_tets);
    take(all, new_points);
    take(all, new_tets);
    take(all, triangles);
    take(all, edges);
    take(all, kept);
    take(all, shares);
  }
};

inline Point to_point(const std::array<double, 3>& p) {
  return {p[0], p[1], p[2]};
}

inline std::array<double, 3> to_array(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

/// Rows, and where they go.
struct Answers {
  struct Share {
    std::uint64_t place;
    std::uint64_t old_tet;
    double volume;
  };
  ByKind<std::vector<std::uint64_t>> places;
  ByKind<std::string> rows;
  std::vector<Share> shares;
  std::string share_rows;

  bool is_empty() const {
    return shares.empty() && std::all_of(kAllRowKinds.begin(), kAllRowKinds.end(),
                                         [&](RowKind kind) { return places[kind].empty(); });
  }
  std::string bytes() const {
    std::string all;
    for (const RowKind kind : kAllRowKinds) {
      put(places[kind], all);
      put(rows[kind], all);
    }
    put(shares, all);
    put(share_rows, all);
    return all;
  }
  Answers() = default;
  explicit Answers(std::string_view all) {
    for (const RowKind kind : kAllRowKinds) {
      take(all, places[kind]);
      take(all, rows[kind]);
    }
    take(all, shares);
    take(all, share_rows);
  }
};

/// Sums over tets, for each component of each array: of the values, and of their absolute values.
class Integrals {
 public:
  explicit Integrals(const ByKind<RowLayout>& layouts) : layouts_(layouts) {
    for (const RowKind kind : {RowKind::point, RowKind::tet}) {
      for (const DataArray& array : layouts[kind].arrays())
        sums_.resize(sums_.size() + 2 * array.components, 0);
    }
  }

  void add(const std::array<Point, 4>& p, const std::array<const char*, 4>& of_points,
           const char* of_tet) {
    const double volume = std::abs(volume6(p[0], p[1], p[2], p[3])) / 6;
    std::size_t at = 0;
    const auto add_mean = [&](double mean) {
      sums_[at++] += volume * mean;
      sums_[at++] += volume * std::abs(mean);
    };
    for_components([&](RowKind kind, std::size_t array, std::size_t component) {
      if (kind == RowKind::tet) {
        add_mean(layouts_[kind].number(array, component, of_tet));
        return;
      }
      double mean = 0;
      for (const char* const row : of_points) {
        mean += layouts_[kind].number(array, component, row) / 4;
      }
      add_mean(mean);
    });
  }

  const std::vector<double>& sums() const { return sums_; }

  /// Adds up what the parts have, in their order.
  static std::vector<double> add_up(const std::map<std::uint64_t, std::vector<double>>& mine,
                                    std::size_t count, Ranks& ranks) {
    std::string bytes;
    for (const auto& [part, sums] : mine) {
      put(part, bytes);
      put(sums, bytes);
    }
    std::map<std::uint64_t, std::vector<double>> all;
    for (const std::string& from : ranks.gather(bytes)) {
      for (std::string_view rest = from; !rest.empty();) {
        std::uint64_t part = 0;
        take(rest, part);
        take(rest, all[part]);
      }
    }
    std::vector<double> total(count, 0);
    for (const auto& [part, sums] : all) {
      for (std::size_t i = 0; i < count; ++i) total[i] += sums[i];
    }
    return total;
  }

 private:
  template <class Use>
  void for_components(const Use& use) const {
    for (const RowKind kind : {RowKind::point, RowKind::tet}) {
      const std::vector<DataArray>& arrays = layouts_[kind].arrays();
      for (std::size_t i = 0; i < arrays.size(); ++i) {
        for (std::size_t k = 0; k < arrays[i].components; ++k) use(kind, i, k);
      }
    }
  }

  const ByKind<RowLayout>& layouts_;
  std::vector<double> sums_;
};

}  // namespace tetmend::pieces
