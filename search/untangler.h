// SPDX-License-Identifier: MIT
// Where to put many vertices at once so that no tet around them is inverted. A pure unit: points
// in, points out.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "kernel/mesh_data.h"

namespace tetmend {

/// A part of a mesh, of which some vertices may move.
struct TangledPatch {
  std::vector<Point> points;  ///< the free vertices first
  std::size_t free_count = 0;
  std::vector<std::array<std::uint32_t, 4>> tets;  ///< in positive order if not inverted
};

/// What a tet costs while a patch is untangled. It is finite for any sign of the volume, and soars
/// where the volume falls to 0; how steeply, says `softness`. With the sum S of the squared edges,
/// the edge length h that it should have and the volume D as a share of the regular tet's of that
/// length,
///
///   cost = (1 - w) S / (6 h^2 x^(2/3)) + w (D^2 + 1) / (2 x),  x = (D + sqrt(softness^2 + D^2)) / 2.
///
/// Without softness the first term is 1 / mean ratio. Source: [garanzha].
class TangledTet {
 public:
  /// @param size h, above 0
  TangledTet(const std::array<Point, 4>& corners, double size);

  double volume() const { return volume_; }  ///< D
  double cost(double softness) const;
  /// Derivatives of the cost by the corners.
  void gradient(double softness, std::array<Point, 4>& out) const;

 private:
  const std::array<Point, 4>& corners_;
  double size_;
  double squares_;  // S / (6 h^2)
  double volume_;
};

/// Moves the free vertices of a patch together until all its tets are positive: lowers the cost of
/// all tets by a quasi-Newton method of limited memory ([liu_nocedal]), then the softness, and so
/// on. If each minimum is found well enough, that leads to a patch without inverted tets where there
/// is one ([garanzha]).
class Untangler {
 public:
  struct Limits {
    unsigned looks = 400;  ///< at all tets, at most
    unsigned steps = 60;   ///< directions at one softness, at most
  };

  /// Told how often it has looked; false ends the search. Called often, by any thread.
  using Proceed = std::function<bool(std::size_t looks)>;

  explicit Untangler(TangledPatch patch);

  /// Moves the free vertices; they end where fewest tets were inverted. Ends when all are positive
  /// and hardly any softness is left, or when several values of it brought nothing. Uses the threads
  /// of the caller's oneTBB arena; their number cannot show in the result. Cost: some dozen looks at
  /// all tets, some hundred where not all can become positive.
  /// @returns the number of tets whose volume is not positive; of no use if the search was ended
  std::size_t untangle(const Limits& limits, const Proceed& proceed);

  /// The free vertices are the first of them.
  std::span<const Point> points() const { return points_; }
  /// So far; for measurements.
  std::size_t looks() const { return looks_; }

 private:
  struct Tet {
    std::array<std::uint32_t, 4> corners;
    double size = 1;
  };
  /// What a patch costs and has.
  struct State {
    double cost = 0;
    double least = 0;  // volume of a tet
    std::size_t inverted = 0;
    void include(const State& other);
  };
  /// One step of the past: way and change of the gradient, and their product.
  struct Memory {
    std::vector<Point> way;
    std::vector<Point> turn;
    double product = 0;
  };
  static constexpr std::size_t kMemory = 7;

  std::array<Point, 4> corners(const Tet& tet) const;
  void list_stars();
  void measure_sizes();
  void look(const Proceed& proceed);
  void find_gradient();
  bool descend(const Limits& limits, const Proceed& proceed);
  void find_direction();
  bool search_line(double slope, const Proceed& proceed);
  void remember();
  void keep_best();

  std::vector<Point> points_;
  std::size_t free_count_;
  std::vector<Tet> tets_;
  std::vector<std::uint32_t> star_begin_;    // of each free vertex
  std::vector<std::uint32_t> stars_;         // 4 x tet + corner
  std::vector<double> scale_;                // of each free vertex: the unit of its steps
  std::vector<std::array<Point, 4>> parts_;  // of the gradient, by tet
  double softness_ = 1;
  State state_;
  std::vector<Point> gradient_;
  std::vector<Point> last_gradient_;
  std::vector<Point> direction_;
  std::vector<Point> start_;  // of a line search
  double step_ = 0;
  std::vector<Point> best_;
  std::size_t best_inverted_ = 0;
  std::array<Memory, kMemory> memory_;
  std::size_t remembered_ = 0;
  std::size_t looks_ = 0;
  std::atomic<bool> stopped_ = false;  // the state is of no use then
};

}  // namespace tetmend
