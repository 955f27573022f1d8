// SPDX-License-Identifier: MIT
// How well the edges of a mesh keep to wanted lengths.
#pragma once

#include <array>
#include <cstddef>

namespace tetmend {

/// Of the edges of a mesh, each counted once. The relative length of one is its length over the wanted
/// one, which changes linearly along it.
struct SizeStatistics {
  /// Between the bins of the histogram; the first bin is below the first, the last above the last.
  static constexpr std::array<double, 9> kBounds = {
      0.25, 0.35355339059327376, 0.5, 0.70710678118654752, 1, 1.41421356237309505,
      2,    2.82842712474619010, 4};

  std::size_t edges = 0;  ///< of tets
  /// Edges by relative length. A length of exactly a bound counts for the bin above.
  std::array<std::size_t, kBounds.size() + 1> histogram{};
  double in_range = 0;            ///< share of the edges from 0.71 to 1.41, 0 to 1
  double within_two = 0;          ///< share of those from 0.5 to 2
  double shortest = 0;            ///< least relative length
  double longest = 0;             ///< largest
  std::size_t on_surface = 0;     ///< edges out of the range that lie on the surface
  std::size_t between_walls = 0;  ///< others out of the range whose ends are fixed
  /// How many regular tets as large as wanted fill the mesh.
  double tets_wanted = 0;
};

}  // namespace tetmend
