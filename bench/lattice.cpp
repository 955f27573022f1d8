// SPDX-License-Identifier: MIT
// Writes a mesh of any size for the measurement of growth.
//
//   A cube of n^3 cells, six tets each. Every inner point is moved at random. Where that turns a
//   tet over, or nearly so, the moves of its points are halved until it does not.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <random>

#include <fmt/format.h>

#include "kernel/chunks.h"
#include "kernel/formats/mesh_io.h"
#include "kernel/geometry.h"

namespace tetmend {
namespace {

class Lattice {
 public:
  explicit Lattice(std::uint32_t cells) : cells_(cells), side_(cells + 1) {}

  MeshData make() {
    MeshData data;
    place_points(data);
    list_tets(data);
    while (calm_down(data)) {
    }
    return data;
  }

 private:
  std::uint32_t number(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return (z * side_ + y) * side_ + x;
  }
  Point at_rest(std::uint32_t i) const {
    return Point(i % side_, i / side_ % side_, i / side_ / side_);
  }

  void place_points(MeshData& data) const {
    constexpr double kAmplitude = 0.33;  // about as many bad tets as in a Delaunay mesh
    std::mt19937_64 random(1);
    const auto move = [&] {
      return kAmplitude * (static_cast<double>(random() >> 11) * 0x1p-52 - 1);
    };
    data.points.resize(std::size_t{side_} * side_ * side_);
    for (std::uint32_t i = 0; i < data.points.size(); ++i) {
      const Point rest = at_rest(i);
      const bool inner = rest.minCoeff() > 0 && rest.maxCoeff() < cells_;
      data.points[i] = inner ? Point(rest + Point(move(), move(), move())) : rest;
    }
  }

  /// The six tets of a cell share its diagonal; each follows one order of the axes.
  void list_tets(MeshData& data) const {
    constexpr std::array<std::array<unsigned, 3>, 6> kOrders = {
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    data.tets.reserve(std::size_t{6} * cells_ * cells_ * cells_);
    for (std::uint32_t z = 0; z < cells_; ++z) {
      for (std::uint32_t y = 0; y < cells_; ++y) {
        for (std::uint32_t x = 0; x < cells_; ++x) {
          for (unsigned n = 0; n < kOrders.size(); ++n) {
            std::array<std::uint32_t, 3> corner = {x, y, z};
            std::array<std::uint32_t, 4> tet{};
            tet[0] = number(corner[0], corner[1], corner[2]);
            for (unsigned step = 0; step < 3; ++step) {
              ++corner[kOrders[n][step]];
              tet[step + 1] = number(corner[0], corner[1], corner[2]);
            }
            if (n >= 3) std::swap(tet[2], tet[3]);  // odd orders are mirrored
            data.tets.push_back({tet, 1});
          }
        }
      }
    }
  }

  /// Halves the moves of the points of tets that are inverted or too flat. False if there are none.
  bool calm_down(MeshData& data) const {
    constexpr double kLeastVolume6 = 0.05;
    std::vector<std::uint8_t> marked(data.points.size(), 0);
    bool any = false;
    for (const auto& tet : data.tets) {
      const auto& v = tet.vertices;
      if (volume6(data.points[v[0]], data.points[v[1]], data.points[v[2]], data.points[v[3]]) >=
          kLeastVolume6)
        continue;
      any = true;
      for (const std::uint32_t i : v) marked[i] = 1;
    }
    for (std::uint32_t i = 0; i < marked.size(); ++i) {
      if (marked[i] != 0) data.points[i] = 0.5 * (data.points[i] + at_rest(i));
    }
    return any;
  }

  std::uint32_t cells_;
  std::uint32_t side_;
};

}  // namespace
}  // namespace tetmend

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: lattice TETS OUT    writes a mesh of about that many tets\n");
    return 2;
  }
  try {
    const double tets = std::stod(argv[1]);
    const auto cells = static_cast<std::uint32_t>(std::max(1.0, std::cbrt(tets / 6) + 0.5));
    tetmend::write_mesh(argv[2], tetmend::Lattice(cells).make());
  } catch (const std::exception& error) {
    fmt::print(stderr, "lattice: {}\n", error.what());
    return 1;
  }
  return 0;
}
