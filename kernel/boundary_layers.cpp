// SPDX-License-Identifier: MIT
// Climbs from walls along rows of three tets, and keeps what neighbours agree on.
//
//   bad tets on walls: where a column may start -> climb prism by prism -> drop prisms whose lines
//   few of the columns around them confirm -> patches of columns with common lines; those that are
//   large, high and thinner than what lies above are layers -> the tets along their lines
#include "kernel/boundary_layers.h"

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <utility>

#include "kernel/chunks.h"

namespace tetmend {

namespace {

// Heights in mean edges of the triangle below.
constexpr double kFlatPrism = 0.25;  // at most, of the first prism
constexpr double kIsotropic = 1.0;   // at most, of all others
// Of a line, from prism to prism. Generators thin layers out in narrow places.
constexpr double kLeastGrowth = 0.7;
constexpr double kMostGrowth = 2.5;
constexpr double kMostUneven = 2.0;  // ratio of the heights at the corners of a prism
// Cosines of a line to the normal, to its neighbours and to its step before. In corners lines lean.
constexpr double kLeastNormal = 0.35;
constexpr double kLeastParallel = 0.5;
constexpr double kLeastStraight = 0.7;
// Of the columns at a vertex, those that take the same step: one in so many. On the edge of a wall
// stand columns of other walls.
constexpr std::size_t kWallShare = 3;
constexpr std::size_t kLineShare = 2;
// What lies above, in heights of the first prism.
constexpr double kLeastContrast = 2.0;
// Of a layer. Where slivers lie side by side on a wall, single prisms come about by chance.
constexpr std::size_t kLeastColumns = 8;
constexpr std::size_t kLeastPrisms = 32;

/// From a vertex up to the next one of its line.
struct LineStep {
  VertexHandle from;
  VertexHandle to;
  friend auto operator<=>(const LineStep&, const LineStep&) = default;
};

struct Prism {
  std::array<LineStep, 3> steps;
  double height = 0;  // mean
};

/// The prisms over a wall triangle, lowest first.
struct Column {
  std::array<VertexHandle, 3> base;
  std::vector<Prism> prisms;
  double above = 0;  // height of the tet above; 0: there is none
};

/// The triangle that a climb has reached, and the tet ahead of it.
class Front {
 public:
  Front(const TetMesh& mesh, HalfFace wall) : mesh_(&mesh), ahead_(wall), v_(mesh.vertices(wall)) {}

  const std::array<VertexHandle, 3>& vertices() const { return v_; }
  const Point& point(unsigned i) const { return mesh_->point(v_[i]); }
  bool is_outside() const { return ahead_.is_outside(); }
  /// Precondition for the next three: not outside.
  TetHandle tet() const { return ahead_.tet(); }
  VertexHandle apex() const { return mesh_->vertices(tet())[ahead_.face()]; }
  /// To the other side of the tet ahead: corner i gives way to its apex.
  void advance(unsigned i) {
    const VertexHandle next = apex();
    ahead_ = mesh_->twin(HalfFace(tet(), mesh_->local_index(tet(), v_[i])));
    v_[i] = next;
  }
  /// Unit vector, upwards.
  Point normal() const { return (point(2) - point(0)).cross(point(1) - point(0)).normalized(); }
  double mean_edge() const {
    return ((point(1) - point(0)).norm() + (point(2) - point(1)).norm() +
            (point(0) - point(2)).norm()) /
           3;
  }

 private:
  const TetMesh* mesh_;
  HalfFace ahead_;                 // a face of the tet ahead, or the outside
  std::array<VertexHandle, 3> v_;  // counterclockwise as seen from below
};

/// Climbs a column.
class Climber {
 public:
  Climber(const TetMesh& mesh, HalfFace wall) : mesh_(mesh), front_(mesh, wall) {
    column_.base = front_.vertices();
  }

  Column climb() {
    for (double most = kFlatPrism; climb_prism(most); most = kIsotropic) {
    }
    if (!column_.prisms.empty() && !front_.is_outside()) {
      column_.above = (mesh_.point(front_.apex()) - front_.point(0)).dot(front_.normal());
    }
    return std::move(column_);
  }

 private:
  struct Lift {
    Point direction = Point::Zero();  // unit vector
    double height = 0;                // along the normal
  };
  using Lifts = std::array<Lift, 3>;

  /// Leaves all as it is where no further prism stands.
  bool climb_prism(double most_edges) {
    const Front base = front_;
    const double most = most_edges * base.mean_edge();
    const Point normal = base.normal();
    Front front = base;
    Prism prism;
    Lifts lifts;
    for (unsigned lifted = 0; lifted != 0b111;) {
      if (front.is_outside()) return false;
      const unsigned i = corner_below(mesh_.point(front.apex()), base, lifted);
      const Point up = mesh_.point(front.apex()) - base.point(i);
      lifts[i] = {up.normalized(), up.dot(normal)};
      if (!(lifts[i].height < kMostUneven * most)) return false;
      prism.steps[i] = {base.vertices()[i], front.apex()};
      front.advance(i);
      lifted |= 1u << i;
    }
    prism.height = (lifts[0].height + lifts[1].height + lifts[2].height) / 3;
    if (!(prism.height <= most) || !is_even(lifts, normal) || !goes_on(lifts)) return false;
    column_.prisms.push_back(prism);
    lifts_ = lifts;
    front_ = front;
    return true;
  }

  /// The nearest corner that is not lifted: all lie about equally far below the apex.
  static unsigned corner_below(const Point& apex, const Front& base, unsigned lifted) {
    unsigned nearest = 3;
    double least = 0;
    for (unsigned i = 0; i < 3; ++i) {
      if (((lifted >> i) & 1u) != 0) continue;
      const double distance = (apex - base.point(i)).squaredNorm();
      if (nearest < 3 && distance >= least) continue;
      nearest = i;
      least = distance;
    }
    return nearest;
  }

  static bool is_even(const Lifts& lifts, const Point& normal) {
    for (unsigned i = 0; i < 3; ++i) {
      const Lift& a = lifts[i];
      const Lift& b = lifts[(i + 1) % 3];
      if (!(a.direction.dot(normal) > kLeastNormal)) return false;
      if (!(a.direction.dot(b.direction) > kLeastParallel)) return false;
      if (a.height > kMostUneven * b.height || b.height > kMostUneven * a.height) return false;
    }
    return true;
  }

  /// They go on from those of the prism below.
  bool goes_on(const Lifts& lifts) const {
    if (column_.prisms.empty()) return true;
    for (unsigned i = 0; i < 3; ++i) {
      const double growth = lifts[i].height / lifts_[i].height;
      if (growth < kLeastGrowth || growth > kMostGrowth) return false;
      if (!(lifts[i].direction.dot(lifts_[i].direction) > kLeastStraight)) return false;
    }
    return true;
  }

  const TetMesh& mesh_;
  Front front_;
  Column column_;
  Lifts lifts_;  // of the last prism
};

/// Bad tets on walls, seen from the walls.
std::vector<HalfFace> find_starts(const TetMesh& mesh) {
  const auto parts =
      map_chunks<std::vector<HalfFace>>(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
        std::vector<TetHandle> bad;
        mesh.visit_below(kBadThreshold, begin, end, [&](TetHandle t) {
          mesh.prefetch(t);
          bad.push_back(t);
        });
        std::vector<HalfFace> part;
        for (const TetHandle t : bad) {
          for (unsigned f = 0; f < 4; ++f) {
            const HalfFace face(t, f);
            if (mesh.is_boundary(face) || mesh.is_constrained(face)) part.push_back(face);
          }
        }
        return part;
      });
  std::vector<HalfFace> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::vector<Column> climb_columns(const TetMesh& mesh, const std::vector<HalfFace>& starts) {
  constexpr std::size_t kColumnsPerChunk = 256;
  auto parts = map_chunks<std::vector<Column>>(
      starts.size(),
      [&](std::size_t begin, std::size_t end) {
        std::vector<Column> part;
        for (std::size_t n = begin; n < end; ++n) {
          Column column = Climber(mesh, starts[n]).climb();
          if (!column.prisms.empty()) part.push_back(std::move(column));
        }
        return part;
      },
      kColumnsPerChunk);
  std::vector<Column> all;
  for (auto& part : parts) std::move(part.begin(), part.end(), std::back_inserter(all));
  return all;
}

/// The steps of columns, counted.
class Lines {
 public:
  Lines(const TetMesh& mesh, const std::vector<Column>& columns) : at_(mesh.vertex_slots()) {
    for (const Column& column : columns) {
      for (const VertexHandle v : column.base) ++at_[v.index()].standing;
      for (const Prism& prism : column.prisms) {
        for (const LineStep& step : prism.steps) add(step);
      }
    }
    std::sort(others_.begin(), others_.end());
  }
  /// How many columns take the step.
  std::size_t count(const LineStep& step) const {
    const Vertex& at = at_[step.from.index()];
    if (at.next == step.to) return at.taken;
    if (others_.empty()) return 0;
    const auto [first, last] = std::equal_range(others_.begin(), others_.end(), step);
    return static_cast<std::size_t>(last - first);
  }
  /// How many columns stand on the vertex.
  std::size_t standing(VertexHandle v) const { return at_[v.index()].standing; }

 private:
  void add(const LineStep& step) {
    Vertex& at = at_[step.from.index()];
    if (!at.next.is_valid()) at.next = step.to;
    if (at.next == step.to) {
      ++at.taken;
    } else {
      others_.push_back(step);
    }
  }

  struct Vertex {
    VertexHandle next;  // as the first column went on
    std::uint32_t taken = 0;
    std::uint32_t standing = 0;
  };
  std::vector<Vertex> at_;
  std::vector<LineStep> others_;  // to other vertices, sorted, each as often as it is taken
};

/// The prisms of a column from the wall on whose steps enough columns take: of those on the same
/// vertex of the wall, or that came there by the same step.
std::size_t count_confirmed(const Column& column, const Lines& lines) {
  for (std::size_t n = 0; n < column.prisms.size(); ++n) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t count = lines.count(column.prisms[n].steps[i]);
      const bool confirmed = n == 0
                                 ? kWallShare * count >= lines.standing(column.base[i])
                                 : kLineShare * count >= lines.count(column.prisms[n - 1].steps[i]);
      if (!confirmed) return n;
    }
  }
  return column.prisms.size();
}

/// Cuts columns where too few others go the same way.
void cut_unconfirmed(const TetMesh& mesh, std::vector<Column>& columns) {
  const Lines lines(mesh, columns);
  for (Column& column : columns) {
    const std::size_t confirmed = count_confirmed(column, lines);
    if (confirmed == column.prisms.size()) continue;
    column.above = column.prisms[confirmed].height;
    column.prisms.resize(confirmed);
  }
  std::erase_if(columns, [](const Column& column) { return column.prisms.empty(); });
}

/// Sets of columns. Two belong together if they have an edge of the wall in common, and the same
/// steps at its ends.
class Patches {
 public:
  explicit Patches(const std::vector<Column>& columns) : parent_(columns.size()) {
    std::iota(parent_.begin(), parent_.end(), 0u);
    struct Side {
      LineStep low;
      LineStep high;
      std::uint32_t column = 0;
      auto operator<=>(const Side&) const = default;
    };
    std::vector<Side> sides;
    for (std::uint32_t n = 0; n < columns.size(); ++n) {
      const auto& steps = columns[n].prisms.front().steps;
      for (unsigned i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(steps[i], steps[(i + 1) % 3]);
        sides.push_back({low, high, n});
      }
    }
    std::sort(sides.begin(), sides.end());
    for (std::size_t i = 1; i < sides.size(); ++i) {
      const Side& a = sides[i - 1];
      const Side& b = sides[i];
      if (a.low == b.low && a.high == b.high) parent_[find(a.column)] = find(b.column);
    }
  }
  /// The column that stands for the patch of column n.
  std::uint32_t find(std::uint32_t n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Drops the columns of patches that are no layers.
void keep_layers(std::vector<Column>& columns) {
  struct Tally {
    std::size_t columns = 0;
    std::size_t prisms = 0;
    std::size_t contrasting = 0;
  };
  Patches patches(columns);
  std::vector<Tally> tallies(columns.size());
  for (std::uint32_t n = 0; n < columns.size(); ++n) {
    const std::vector<Prism>& prisms = columns[n].prisms;
    const double thickest = std::max(columns[n].above, prisms.back().height);
    Tally& tally = tallies[patches.find(n)];
    ++tally.columns;
    tally.prisms += prisms.size();
    tally.contrasting += thickest >= kLeastContrast * prisms.front().height ? 1 : 0;
  }
  std::uint32_t n = 0;
  std::erase_if(columns, [&](const Column&) {
    const Tally& tally = tallies[patches.find(n++)];
    return tally.columns < kLeastColumns || tally.prisms < kLeastPrisms ||
           2 * tally.contrasting < tally.columns;
  });
}

/// The tets over a wall that follow the lines.
void collect_tets(const TetMesh& mesh, HalfFace wall, const Lines& lines, std::size_t most,
                  std::vector<TetHandle>& tets) {
  Front front(mesh, wall);
  for (std::size_t count = 0; count < most && !front.is_outside(); ++count) {
    const VertexHandle apex = front.apex();
    unsigned best = 3;
    std::size_t most_taken = 0;  // lines may meet: whichever vertex comes first must not matter
    for (unsigned i = 0; i < 3; ++i) {
      const std::size_t taken = lines.count({front.vertices()[i], apex});
      if (taken <= most_taken) continue;
      most_taken = taken;
      best = i;
    }
    if (best == 3) return;
    tets.push_back(front.tet());
    front.advance(best);
  }
}

}  // namespace

BoundaryLayers find_boundary_layers(const TetMesh& mesh) {
  BoundaryLayers layers;
  const std::vector<HalfFace> starts = find_starts(mesh);
  std::vector<Column> columns = climb_columns(mesh, starts);
  if (columns.empty()) return layers;
  cut_unconfirmed(mesh, columns);
  keep_layers(columns);
  if (columns.empty()) return layers;

  std::vector<char> is_base(mesh.vertex_slots(), 0);
  for (const Column& column : columns) {
    for (const VertexHandle v : column.base) is_base[v.index()] = 1;
    layers.most_prisms = std::max(layers.most_prisms, column.prisms.size());
  }
  const Lines lines(mesh, columns);
  const std::size_t most_tets = 3 * layers.most_prisms;
  for (const HalfFace wall : starts) {
    const auto corners = mesh.vertices(wall);
    const bool stands = std::all_of(corners.begin(), corners.end(),
                                    [&](VertexHandle v) { return is_base[v.index()] != 0; });
    if (!stands) continue;
    const std::size_t before = layers.tets.size();
    collect_tets(mesh, wall, lines, most_tets, layers.tets);
    layers.columns += layers.tets.size() > before ? 1 : 0;
  }
  std::sort(layers.tets.begin(), layers.tets.end());
  layers.tets.erase(std::unique(layers.tets.begin(), layers.tets.end()), layers.tets.end());
  return layers;
}

}  // namespace tetmend
