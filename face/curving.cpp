// SPDX-License-Identifier: MIT
//   tets that are turned over -> their edges that may be curved -> the best bend of each, again and
//   again, with those of neighbours that came close to turning over
#include "face/curving.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "kernel/curved.h"
#include "kernel/grouping.h"
#include "kernel/second_order.h"
#include "search/bend_search.h"

namespace tetmend::face {

namespace {

/// Below this share of its straight determinant a tet is worked on: it may turn over next.
constexpr double kEnough = 0.3;
/// What is wished for while edges give way to each other.
constexpr double kWanted = 0.3;

/// At the points of a fine grid: a determinant may fall below 0 between the nodes.
bool falls_below_zero(const std::array<double, 20>& coefficients) {
  if (std::all_of(coefficients.begin(), coefficients.end(), [](double c) { return c > 0; }))
    return false;
  constexpr int kSteps = 8;
  std::array<double, 4> at{};
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      for (int k = 0; i + j + k <= kSteps; ++k) {
        at = {static_cast<double>(kSteps - i - j - k) / kSteps, static_cast<double>(i) / kSteps,
              static_cast<double>(j) / kSteps, static_cast<double>(k) / kSteps};
        double value = 0;
        std::size_t next = 0;
        for (std::size_t a = 0; a < 4; ++a) {
          for (std::size_t b = a; b < 4; ++b) {
            for (std::size_t c = b; c < 4; ++c) {
              const int ways = a == c ? 1 : a == b || b == c ? 3 : 6;
              value += ways * coefficients[next++] * at[a] * at[b] * at[c];
            }
          }
        }
        if (value <= 0) return true;
      }
    }
  }
  return false;
}

class Curver {
 public:
  /// How an edge gets its bend.
  enum class Way : bool { ease, raise };

  Curver(MeshData& data, const std::vector<bool>& is_frozen)
      : data_(data), mid_nodes_(data.mid_nodes), hold_of_(data.points.size(), Hold::stays) {
    mark(is_frozen);
    index_tets();
  }

  struct Over {
    std::vector<std::uint32_t> tets;  ///< turned over anywhere
    std::size_t at_nodes = 0;         ///< of them: at a node, which counts
  };
  Over turned_over() const {
    Over over;
    for (std::uint32_t t = 0; t < data_.tets.size(); ++t) {
      const CurvedTet tet(data_, mid_nodes_, data_.tets[t]);
      if (!tet.is_curved) continue;
      const JacobianRatio ratio = jacobian_ratio(tet.vertices, tet.bends);
      if (ratio.bound > 0) continue;
      over.at_nodes += ratio.at_nodes <= 0 ? 1 : 0;
      if (ratio.at_nodes <= 0 || falls_below_zero(jacobian_coefficients(tet.vertices, tet.bends)))
        over.tets.push_back(t);
    }
    return over;
  }

  /// All of them a little, so that no edge is in the way of another.
  void ease(const std::vector<std::uint32_t>& over) {
    constexpr int kRounds = 100;
    std::set<std::uint32_t> active(over.begin(), over.end());
    for (int round = 0; round < kRounds && !active.empty(); ++round) {
      std::set<std::uint32_t> next;
      for (const std::uint32_t t : active) improve_tet(t, Way::ease, next);
      active = std::move(next);
    }
  }

  /// Until no bend helps any more.
  void curve(const std::vector<std::uint32_t>& over) {
    constexpr int kMostRounds = 60;
    std::set<std::uint32_t> active(over.begin(), over.end());
    for (int round = 0; round < kMostRounds && !active.empty(); ++round) {
      std::set<std::uint32_t> next;
      for (const std::uint32_t t : active) improve_tet(t, Way::raise, next);
      active = std::move(next);
    }
  }

  /// The most bent edge of each that is held. @returns how many edges
  std::size_t straighten(const std::vector<std::uint32_t>& over) {
    std::size_t count = 0;
    for (const std::uint32_t t : over) {
      const CurvedTet tet(data_, mid_nodes_, data_.tets[t]);
      std::size_t most = 6;
      for (std::size_t e = 0; e < 6; ++e) {
        if (hold_of(tet.nodes[e]) != Hold::surface || tet.bends[e] == Point::Zero()) continue;
        if (most == 6 || share(tet, e) > share(tet, most)) most = e;
      }
      if (most == 6) continue;
      data_.points[tet.nodes[most]] = middle(tet, most);
      ++count;
    }
    return count;
  }

  /// Nodes that hold some tets, each once.
  struct Holding {
    std::size_t all = 0;
    std::size_t kept = 0;  ///< that straightening does not move either
  };
  Holding count_holding(const std::vector<std::uint32_t>& over) const {
    std::set<std::uint32_t> nodes;
    for (const std::uint32_t t : over) {
      const CurvedTet tet(data_, mid_nodes_, data_.tets[t]);
      for (std::size_t e = 0; e < 6; ++e) {
        const bool is_held = hold_of(tet.nodes[e]) != Hold::free;
        if (is_held && tet.bends[e] != Point::Zero()) nodes.insert(tet.nodes[e]);
      }
    }
    const auto kept = std::count_if(nodes.begin(), nodes.end(), [this](std::uint32_t node) {
      return hold_of(node) == Hold::stays;
    });
    return {nodes.size(), static_cast<std::size_t>(kept)};
  }

  /// Edges whose nodes are elsewhere than they were.
  std::size_t count_moved(const std::vector<Point>& points, bool free) const {
    std::size_t count = 0;
    for (const auto& mid : data_.mid_nodes) {
      const bool is_free = hold_of_[mid[2]] == Hold::free;
      count += is_free == free && points[mid[2]] != data_.points[mid[2]] ? 1 : 0;
    }
    return count;
  }

 private:
  /// What keeps a mid-side node where it is.
  enum class Hold : std::uint8_t { free, surface, stays };

  Hold hold_of(std::uint32_t node) const {
    return node == kNoMidNode ? Hold::stays : hold_of_[node];
  }

  void mark(const std::vector<bool>& is_frozen) {
    const std::vector<bool> is_fixed = find_fixed_mid_nodes(data_, true).is_fixed;
    for (std::size_t i = 0; i < data_.mid_nodes.size(); ++i) {
      hold_of_[data_.mid_nodes[i][2]] = is_fixed[i] ? Hold::surface : Hold::free;
    }
    for (const std::uint32_t v : data_.required_vertices) hold_of_[v] = Hold::stays;
    for (const OtherElements& others : data_.other_elements) {
      for (const std::uint32_t v : others.vertices) hold_of_[v] = Hold::stays;
    }
    for (std::size_t t = 0; t < is_frozen.size(); ++t) {
      if (!is_frozen[t]) continue;
      for (const std::uint32_t v : mid_nodes_.of(data_.tets[t].vertices)) hold_of_[v] = Hold::stays;
    }
  }

  void index_tets() {
    std::vector<std::uint32_t> nodes;  // 6 of each tet
    const auto none = static_cast<std::uint32_t>(data_.points.size());
    for (const MeshData::Tet& tet : data_.tets) {
      for (const auto& [a, b] : kMidNodeEdges) {
        const std::uint32_t node = mid_nodes_.of(tet.vertices[a], tet.vertices[b]);
        nodes.push_back(node == kNoMidNode ? none : node);
      }
    }
    edges_at_ = group_by_key(nodes, none + 1);
  }

  static Point middle(const CurvedTet& tet, std::size_t e) {
    return (tet.vertices[kMidNodeEdges[e][0]] + tet.vertices[kMidNodeEdges[e][1]]) / 2;
  }
  /// The bend of an edge by its length.
  static double share(const CurvedTet& tet, std::size_t e) {
    return tet.bends[e].norm() /
           (tet.vertices[kMidNodeEdges[e][1]] - tet.vertices[kMidNodeEdges[e][0]]).norm();
  }

  /// Bends each of its free edges anew. @param next gets the tets that are to be looked at again
  void improve_tet(std::uint32_t t, Way way, std::set<std::uint32_t>& next) {
    for (const auto& [a, b] : kMidNodeEdges) {
      const auto& v = data_.tets[t].vertices;
      const std::uint32_t node = mid_nodes_.of(v[a], v[b]);
      if (hold_of(node) == Hold::free) bend(node, v[a], v[b], way, next);
    }
  }

  void bend(std::uint32_t node, std::uint32_t a, std::uint32_t b, Way way,
            std::set<std::uint32_t>& next) {
    BendSearch search;
    for (const std::uint32_t place : edges_at_.group(node)) {
      const CurvedTet tet(data_, mid_nodes_, data_.tets[place / 6]);
      if (is_inverted(tet)) return;
      search.add(tet.vertices, tet.bends, place % 6);
    }
    const Point middle = (data_.points[a] + data_.points[b]) / 2;
    const Point before = data_.points[node] - middle;
    const double then = search.value(before);
    if (then >= kEnough) return;
    Point made;
    if (way == Way::ease) {
      made = search.eased(before, kWanted);
      constexpr double kWorthwhile = 1e-4;
      if ((made - before).norm() < kWorthwhile * (data_.points[b] - data_.points[a]).norm()) return;
    } else {
      made = search.best(before);
      constexpr double kWorthwhile = 1e-4;
      if (search.value(made) < then + kWorthwhile) return;
    }
    data_.points[node] = middle + made;
    for (const std::uint32_t place : edges_at_.group(node)) next.insert(place / 6);
  }
  static bool is_inverted(const CurvedTet& tet) {
    std::array<Point, 6> none;
    none.fill(Point::Zero());
    return !(jacobian_coefficients(tet.vertices, none)[0] > 0);
  }

  MeshData& data_;
  const MidNodes mid_nodes_;
  std::vector<Hold> hold_of_;  // by point
  Grouping edges_at_;          // by node: 6 * tet + edge
};

/// As long as that helps; what leaves more of them is undone. `over` becomes what is left.
void curve_all(MeshData& data, Curver& curver, Curver::Over& over) {
  for (bool helps = true; helps && !over.tets.empty();) {
    helps = false;
    for (const bool eases : {true, false}) {
      std::vector<Point> before = data.points;
      if (eases) curver.ease(over.tets);
      curver.curve(over.tets);
      Curver::Over left = curver.turned_over();
      if (left.tets.size() > over.tets.size() || left.at_nodes > over.at_nodes) {
        data.points = std::move(before);
        continue;
      }
      helps = left.tets.size() < over.tets.size();
      over = std::move(left);
      break;
    }
  }
}

void tell(const Curving& done, std::size_t before, const Curver::Holding& holding, bool straightens,
          std::vector<std::string>& notes) {
  if (done.left > 0) {
    std::string note =
        fmt::format("curved tets that stay turned over: {}; nodes on edges that stay hold them: {}",
                    done.left, holding.all);
    if (holding.kept > 0) {
      note += fmt::format(", {} of them of tets or points that are kept, such as boundary layers",
                          holding.kept);
    }
    if (!straightens && holding.kept < holding.all) {
      note += "; --straighten makes edges of the surface straight";
    }
    notes.push_back(std::move(note));
  }
  if (done.curved > 0) {
    notes.push_back(fmt::format(
        "edges within the volume that are curved at the end: {}; tets turned over: {} -> {}",
        done.curved, before, done.left));
  }
  if (done.straightened > 0) {
    notes.push_back(fmt::format("edges of the surface and of walls that are made straight: {}",
                                done.straightened));
  }
}

}  // namespace

Curving curve_inside(MeshData& data, const std::vector<bool>& is_frozen, bool straightens) {
  Curving done;
  const CurvedStatistics then = curved_statistics(data);
  if (then.turned_over == 0) return done;
  const std::vector<Point> before = data.points;
  Curver curver(data, is_frozen);
  Curver::Over over = curver.turned_over();
  curve_all(data, curver, over);
  while (straightens && !over.tets.empty() && curver.straighten(over.tets) > 0) {
    over = curver.turned_over();
    curve_all(data, curver, over);
  }
  done.curved = curver.count_moved(before, true);
  done.straightened = curver.count_moved(before, false);
  done.left = over.at_nodes;
  const JacobianRatio now = curved_statistics(data).worst;
  if (now.at_nodes < then.worst.at_nodes || now.bound < then.worst.bound) {
    data.points = before;  // what is promised of the worst goes first
    done = {0, 0, then.turned_over, {}};
    over = curver.turned_over();
  }
  tell(done, then.turned_over, curver.count_holding(over.tets), straightens, done.notes);
  return done;
}

}  // namespace tetmend::face
