// SPDX-License-Identifier: MIT
// Walls that make tets bad.
//
//   walls of bad tets and walls next to them: where no tet is bad, none is forced -> arguments: one
//   of the tets on these walls is bad in every mesh -> as many of them as cannot be about the same
//   tet: the least number of bad tets
#include "schedule/limit/surface_limit.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <tuple>
#include <unordered_set>
#include <utility>
#include <vector>

#include "kernel/chunks.h"
#include "kernel/kept_faces.h"
#include "schedule/limit/moving_walls.h"
#include "schedule/limit/wall_probe.h"

namespace tetmend {

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr std::size_t kWallsPerChunk = 64;
constexpr WallProbe::Scope kAll = 0b1111;

/// Whether somebody waits for the end.
struct Stop {
  const std::atomic<bool>* cancel = nullptr;
  bool operator()() const { return cancel != nullptr && cancel->load(std::memory_order_relaxed); }
};

/// The angles of a tet whose quality is at least the sine of `least`.
AngleRange symmetric(double least) {
  return {least, std::numbers::pi - least};
}

AngleRange good_angles(const TetMesh& mesh) {
  const Goal goal = mesh.standard().goal();
  return {goal.min_angle * kDegree, goal.max_angle * kDegree};
}

/// Names a wall whatever its tet is: its vertices, the first one first, in the sense of its side.
using WallName = std::array<VertexHandle, 3>;

WallName name_of(const TetMesh& mesh, HalfFace wall) {
  WallName v = mesh.vertices(wall);
  std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
  return v;
}

/// In every mesh a tet on one of these walls is bad.
struct Argument {
  WallName name;  ///< of the wall that it was found at
  std::vector<HalfFace> walls;
  std::vector<HalfFace> partners;  ///< walls that may share a bad tet with one of them
  bool by_constraint = false;      ///< some wall that it depends on lies inside
};

std::vector<TetHandle> find_bad_tets(const TetMesh& mesh) {
  const auto parts =
      map_chunks<std::vector<TetHandle>>(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
        std::vector<TetHandle> part;
        mesh.visit_below(kBadThreshold, begin, end, [&](TetHandle t) {
          if (misses_goal(mesh, t)) part.push_back(t);
        });
        return part;
      });
  std::vector<TetHandle> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

void sort_unique(std::vector<HalfFace>& walls) {
  std::sort(walls.begin(), walls.end());
  walls.erase(std::unique(walls.begin(), walls.end()), walls.end());
}

/// The walls of the tets, and those within two steps around edges: as far as an argument reaches.
std::vector<HalfFace> walls_around(const TetMesh& mesh, const std::vector<TetHandle>& tets) {
  std::vector<HalfFace> walls;
  for (const TetHandle t : tets) {
    if (mesh.is_frozen(t)) continue;
    for (unsigned f = 0; f < 4; ++f) {
      if (is_wall(mesh, HalfFace(t, f))) walls.emplace_back(t, f);
    }
  }
  for (int step = 0; step < 2; ++step) {
    const std::size_t count = walls.size();
    for (std::size_t n = 0; n < count; ++n) {
      for (unsigned i = 0; i < 3; ++i) walls.push_back(find_sector(mesh, walls[n], i).other);
    }
    sort_unique(walls);
  }
  return walls;
}

bool is_bad(const TetMesh& mesh, HalfFace wall) {
  return misses_goal(mesh, wall.tet());
}

/// All that the probe looks at stays as it is.
bool is_lasting(const TetMesh& mesh, const WallProbe& probe) {
  if (mesh.surface_guard() == nullptr) return true;
  const std::vector<HalfFace> walls = probe.walls(kAll);
  return std::none_of(walls.begin(), walls.end(), [&](HalfFace w) { return may_change(mesh, w); });
}

/// The argument about the fewest tets; without walls if there is none.
Argument find_argument(const TetMesh& mesh, const WallProbe& probe) {
  const AngleRange good = good_angles(mesh);
  Argument argument;
  argument.name = name_of(mesh, probe.wall());
  if (!is_lasting(mesh, probe)) return argument;
  for (const WallProbe::Scope scope : {0b0000, 0b0001, 0b0010, 0b0100, 0b0111, 0b1111}) {
    std::vector<HalfFace> walls = probe.walls(scope);
    // This mesh shows that all of them can be good.
    if (std::none_of(walls.begin(), walls.end(), [&](HalfFace w) { return is_bad(mesh, w); })) {
      continue;
    }
    if (probe.allows(good, scope)) continue;
    argument.walls = std::move(walls);
    break;
  }
  for (const HalfFace wall : argument.walls) {
    const WallProbe at(mesh, wall);
    if (!is_lasting(mesh, at)) return {};
    bool inside = !mesh.is_boundary(wall);
    for (unsigned i = 0; i < 3; ++i) {
      inside = inside || !mesh.is_boundary(at.sector(i).other);
      if (at.may_share_bad_tet(i, good)) argument.partners.push_back(at.sector(i).other);
    }
    argument.by_constraint = argument.by_constraint || inside;
  }
  return argument;
}

/// A bound on angles in steps, tightened wall by wall. `range_of(n)` are the angles of a mesh that
/// is better than step n; ranges shrink as n grows.
class Bound {
 public:
  static constexpr int kSteps = 90000;
  static constexpr double kStep = 90.0 / kSteps;  // degrees

  template <class RangeOf>
  void tighten(const WallProbe& probe, const RangeOf& range_of) {
    if (best_ == 0 || probe.allows(range_of(best_), kAll)) return;
    int allowed = 0;
    while (best_ - allowed > 1) {
      const int middle = (allowed + best_) / 2;
      (probe.allows(range_of(middle), kAll) ? allowed : best_) = middle;
    }
  }
  void tighten(const Bound& other) { best_ = std::min(best_, other.best_); }
  /// @param angle radians
  void tighten(double angle) {
    best_ = std::min(best_, 1 + static_cast<int>(angle / (kStep * kDegree)));
  }
  /// In degrees, if there is one.
  std::optional<double> value() const {
    return best_ < kSteps ? std::optional(best_ * kStep) : std::nullopt;
  }

 private:
  int best_ = kSteps;  // not allowed by some wall, or the largest
};

struct AngleBounds {
  Bound quality;
  Bound smallest;
  Bound largest;

  void tighten(const WallProbe& probe) {
    constexpr double kStep = Bound::kStep * kDegree;
    quality.tighten(probe, [](int n) { return symmetric(n * kStep); });
    smallest.tighten(probe, [](int n) { return AngleRange{n * kStep, std::numbers::pi}; });
    largest.tighten(probe, [](int n) { return AngleRange{0, std::numbers::pi - n * kStep}; });
  }
  void tighten(const AngleBounds& other) {
    quality.tighten(other.quality);
    smallest.tighten(other.smallest);
    largest.tighten(other.largest);
  }
};

/// A wall with a sharp sector: others allow so much that they do not matter.
struct SharpWall {
  double angle = 0;  ///< of the smallest sector
  WallName name;
  HalfFace wall;
  friend bool operator<(const SharpWall& a, const SharpWall& b) {
    return std::tie(a.angle, a.name, a.wall) < std::tie(b.angle, b.name, b.wall);
  }
};

bool has_frozen_tets(const TetMesh& mesh) {
  return count_in_chunks(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
           std::size_t count = 0;
           for (std::size_t i = begin; i < end; ++i) {
             count += mesh.is_frozen(TetHandle(static_cast<std::uint32_t>(i))) ? 1 : 0;
           }
           return count;
         }) > 0;
}

/// The sharpest first, which bound most.
std::vector<SharpWall> find_sharp_walls(const TetMesh& mesh) {
  constexpr double kSharp = 120 * kDegree;
  const bool looks_at_all = has_frozen_tets(mesh);  // walls of others beside them
  const auto parts =
      map_chunks<std::vector<SharpWall>>(mesh.tet_slots(), [&](std::size_t begin, std::size_t end) {
        std::vector<SharpWall> part;
        for (std::size_t i = begin; i < end; ++i) {
          const TetHandle t(static_cast<std::uint32_t>(i));
          if (!looks_at_all && !may_have_kept_face(mesh, t)) continue;
          if (mesh.is_deleted(t) || mesh.is_frozen(t)) continue;
          for (unsigned f = 0; f < 4; ++f) {
            const HalfFace face(t, f);
            if (!is_wall(mesh, face)) continue;
            double angle = kSharp;
            for (unsigned k = 0; k < 3; ++k) {
              angle = std::min(angle, find_sector(mesh, face, k).angle);
            }
            if (angle < kSharp) part.push_back({angle, name_of(mesh, face), face});
          }
        }
        return part;
      });
  std::vector<SharpWall> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  std::sort(all.begin(), all.end());
  return all;
}

AngleBounds find_bounds(const TetMesh& mesh, const Stop& stop) {
  const std::vector<SharpWall> walls = find_sharp_walls(mesh);
  const auto tighten = [&](AngleBounds& bounds, std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end && !stop(); ++n) {
      const WallProbe probe(mesh, walls[n].wall);
      if (is_lasting(mesh, probe)) bounds.tighten(probe);
    }
  };
  AngleBounds all;
  const std::size_t first = std::min(walls.size(), kWallsPerChunk);
  tighten(all, 0, first);  // so that the others have little to do
  const auto parts = map_chunks<AngleBounds>(
      walls.size() - first,
      [&](std::size_t begin, std::size_t end) {
        AngleBounds part = all;
        tighten(part, first + begin, first + end);
        return part;
      },
      kWallsPerChunk);
  for (const AngleBounds& part : parts) all.tighten(part);
  return all;
}

std::vector<Argument> find_arguments(const TetMesh& mesh, const std::vector<HalfFace>& walls,
                                     const Stop& stop) {
  const auto parts = map_chunks<std::vector<Argument>>(
      walls.size(),
      [&](std::size_t begin, std::size_t end) {
        std::vector<Argument> part;
        for (std::size_t n = begin; n < end && !stop(); ++n) {
          Argument argument = find_argument(mesh, WallProbe(mesh, walls[n]));
          if (!argument.walls.empty()) part.push_back(std::move(argument));
        }
        return part;
      },
      kWallsPerChunk);
  std::vector<Argument> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  std::sort(all.begin(), all.end(), [](const Argument& a, const Argument& b) {
    return std::pair(a.walls.size(), a.name) < std::pair(b.walls.size(), b.name);
  });
  return all;
}

using WallSet = std::unordered_set<std::uint32_t>;  // codes

bool meets(const std::vector<HalfFace>& walls, const WallSet& set) {
  return std::any_of(walls.begin(), walls.end(),
                     [&](HalfFace wall) { return set.contains(wall.code()); });
}

/// How many arguments, taken greedily, are about different tets: no two have a common wall, and
/// none has a wall whose tet may also stand on a wall of another.
std::size_t count_independent(const std::vector<Argument>& arguments) {
  WallSet walls;
  WallSet partners;
  std::size_t count = 0;
  for (const Argument& argument : arguments) {
    if (meets(argument.walls, walls) || meets(argument.walls, partners) ||
        meets(argument.partners, walls)) {
      continue;
    }
    ++count;
    for (const HalfFace wall : argument.walls) walls.insert(wall.code());
    for (const HalfFace wall : argument.partners) partners.insert(wall.code());
  }
  return count;
}

/// One bad tet for each argument, the worst, but none where another argument's tet will do.
class ForcedTets {
 public:
  /// @param lines those with bad tets alone
  ForcedTets(const TetMesh& mesh, const std::vector<Argument>& arguments,
             const std::vector<SharpLine>& lines) {
    for (const SharpLine& line : lines) {
      for (const TetHandle t : line.worst) by_surface_.insert(t.index());
    }
    for (const Argument& argument : arguments) {
      const auto is_chosen = [&](HalfFace wall) {
        return by_surface_.contains(wall.tet().index()) ||
               by_constraint_.contains(wall.tet().index());
      };
      if (std::any_of(argument.walls.begin(), argument.walls.end(), is_chosen)) continue;
      const HalfFace worst = *std::min_element(
          argument.walls.begin(), argument.walls.end(),
          [&](HalfFace a, HalfFace b) { return mesh.quality(a.tet()) < mesh.quality(b.tet()); });
      (argument.by_constraint ? by_constraint_ : by_surface_).insert(worst.tet().index());
    }
  }
  bool by_surface(TetHandle t) const { return by_surface_.contains(t.index()); }
  bool by_constraint(TetHandle t) const { return by_constraint_.contains(t.index()); }

 private:
  std::unordered_set<std::uint32_t> by_surface_;
  std::unordered_set<std::uint32_t> by_constraint_;
};

Hindrance hindrance_of(const TetMesh& mesh, TetHandle t, const ForcedTets& forced) {
  if (mesh.is_frozen(t)) return Hindrance::frozen;
  if (forced.by_surface(t)) return Hindrance::surface;
  if (forced.by_constraint(t)) return Hindrance::constraint;
  const TetVertices& v = mesh.vertices(t);
  if (has_lasting_constraint(mesh, t) || std::any_of(v.begin(), v.end(), [&](VertexHandle w) {
        return is_held(mesh, w) && !mesh.is_boundary(w);
      })) {
    return Hindrance::constraint;
  }
  const bool all_held =
      std::all_of(v.begin(), v.end(), [&](VertexHandle w) { return is_held(mesh, w); });
  return all_held ? Hindrance::no_free_vertex : Hindrance::search;
}

SurfaceLimit compute_limit(const TetMesh& mesh, std::vector<std::pair<TetHandle, Hindrance>>* bad,
                           const Stop& stop) {
  const std::vector<TetHandle> bad_tets = find_bad_tets(mesh);
  const std::vector<Argument> arguments = find_arguments(mesh, walls_around(mesh, bad_tets), stop);
  std::vector<SharpLine> lines = find_sharp_lines(mesh, std::numbers::pi / 2);
  AngleBounds bounds = find_bounds(mesh, stop);
  for (const SharpLine& line : lines) {
    bounds.quality.tighten(line.angle);
    bounds.smallest.tighten(line.angle);
  }
  const double low = good_angles(mesh).low - kAngleSlack;
  std::erase_if(lines, [&](const SharpLine& line) { return line.angle >= low; });
  const ForcedTets forced(mesh, arguments, lines);
  SurfaceLimit limit;
  for (const TetHandle t : bad_tets) {
    const Hindrance hindrance = hindrance_of(mesh, t, forced);
    ++limit.bad[static_cast<std::size_t>(hindrance)];
    if (bad != nullptr) bad->emplace_back(t, hindrance);
    if (hindrance != Hindrance::frozen) ++limit.n_bad;
  }
  constexpr std::size_t kEdgesOfTet = 6;
  limit.n_forced =
      std::max(count_independent(arguments), (lines.size() + kEdgesOfTet - 1) / kEdgesOfTet);
  if (const auto angle = bounds.quality.value()) limit.q_worst = std::sin(*angle * kDegree);
  // Where a mesh could be of regular tets alone, it is not bounded.
  constexpr double kRegular = 70.52877936550931;  // degrees: acos(1/3)
  const auto smallest = bounds.smallest.value();
  if (smallest && *smallest < kRegular) limit.theta_min = smallest;
  const auto largest = bounds.largest.value();
  if (largest && 180 - *largest > kRegular) limit.theta_max = 180 - *largest;
  return limit;
}

}  // namespace

std::string_view to_string(Hindrance hindrance) {
  static constexpr std::array<std::string_view, kHindranceCount> kNames = {
      "frozen", "surface", "constraint", "no_free_vertex", "search"};
  return kNames[static_cast<std::size_t>(hindrance)];
}

std::optional<SurfaceLimit> find_surface_limit(const TetMesh& mesh, const std::atomic<bool>* cancel,
                                               std::vector<std::pair<TetHandle, Hindrance>>* bad) {
  const Stop stop{cancel};
  SurfaceLimit limit = compute_limit(mesh, bad, stop);
  return stop() ? std::nullopt : std::optional(limit);
}

SurfaceLimit compute_surface_limit(const TetMesh& mesh,
                                   std::vector<std::pair<TetHandle, Hindrance>>* bad) {
  return compute_limit(mesh, bad, {});
}

}  // namespace tetmend
