// SPDX-License-Identifier: MIT
// A body moves through a mesh, as a store that separates from an aircraft: [chen, 7].
//
//   make a lattice of tets in a box, with a hole: the body
//   for each step:
//     while a part of the step is left:
//       let the body move by that part, and the springs between the vertices pull the mesh along
//       if a tet turns over: try again with half the part
//       improve what has got bad; no other tet is touched
//     print a line
//   with --plain: each step at once, and no improvement
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <fmt/format.h>
#include <tetmend/improve.h>
#include <tetmend/measure.h>

using Point = Eigen::Vector3d;
using Points = std::vector<std::array<double, 3>>;
using Tets = std::vector<std::array<std::uint32_t, 4>>;

namespace {

// ---- The scene: a box of 14 x 8 x 8 unit cells; the body takes the 8 cells around a place -------

using Place = std::array<int, 3>;  // of a vertex, or of the lowest corner of a cell

constexpr Place kBox = {14, 8, 8};
constexpr Place kMiddle = {3, 4, 4};

/// The body flies along x and pitches as it goes. Where a point of it is at a time between 0 and 1.
Point body_at(const Point& start, double time) {
  constexpr double kWay = 8;
  constexpr double kPitch = std::numbers::pi / 3;
  const Point middle(kMiddle[0], kMiddle[1], kMiddle[2]);
  const Eigen::AngleAxisd turn(kPitch * time, Point::UnitY());
  return middle + Point(kWay * time, 0, 0) + turn * (start - middle);
}

Point to_point(const std::array<double, 3>& p) {
  return Point(p[0], p[1], p[2]);
}

struct Scene {
  Points points;
  Tets tets;
  /// Where the vertices of the body start. They are the first vertices of the mesh and stay so,
  /// because nothing removes vertices of the boundary.
  Points body;
};

/// Calls visit() for all places of a lattice of that size.
template <class Visit>
void for_each_place(const Place& size, Visit&& visit) {
  for (int z = 0; z < size[2]; ++z) {
    for (int y = 0; y < size[1]; ++y) {
      for (int x = 0; x < size[0]; ++x) visit(Place{x, y, z});
    }
  }
}

/// 0 for the middle of the body, 1 for its surface, more for the rest.
int distance_from_middle(const Place& at) {
  int distance = 0;
  for (unsigned i = 0; i < 3; ++i) distance = std::max(distance, std::abs(at[i] - kMiddle[i]));
  return distance;
}

Scene make_scene() {
  Scene scene;
  std::map<Place, std::uint32_t> number;
  const auto add_vertices = [&](bool of_body) {
    for_each_place({kBox[0] + 1, kBox[1] + 1, kBox[2] + 1}, [&](const Place& at) {
      const int distance = distance_from_middle(at);
      if (distance == 0 || (distance == 1) != of_body) return;
      number[at] = static_cast<std::uint32_t>(scene.points.size());
      scene.points.push_back({double(at[0]), double(at[1]), double(at[2])});
    });
  };
  add_vertices(true);
  scene.body = scene.points;
  add_vertices(false);

  // Six tets for each cell: every order of the axes is a path along the edges of the cell, from its
  // lowest to its highest corner.
  for_each_place(kBox, [&](const Place& cell) {
    const Place highest = {cell[0] + 1, cell[1] + 1, cell[2] + 1};
    if (distance_from_middle(cell) <= 1 && distance_from_middle(highest) <= 1) return;  // the body
    std::array<unsigned, 3> axes = {0, 1, 2};
    do {
      std::array<std::uint32_t, 4> tet{};
      Place corner = cell;
      for (unsigned i = 0; i < 4; ++i) {
        tet[i] = number.at(corner);
        if (i < 3) ++corner[axes[i]];
      }
      scene.tets.push_back(tet);
    } while (std::next_permutation(axes.begin(), axes.end()));
  });
  return scene;
}

// ---- The springs --------------------------------------------------------------------------------

constexpr std::array<std::array<unsigned, 2>, 6> kEdges = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

bool is_on_wall(const Point& p) {
  const Point far(kBox[0], kBox[1], kBox[2]);
  return (p.array() == 0 || p.array() == far.array()).any();
}

/// Each edge is a spring, the stiffer the shorter. Given where the body goes and that walls stay,
/// finds the displacements of all vertices at which the springs are in balance.
std::vector<Point> balance_springs(std::span<const std::array<double, 3>> places,
                                   std::span<const std::array<std::uint32_t, 4>> tets,
                                   const Points& body, double time) {
  std::vector<Point> points;
  for (const auto& place : places) points.push_back(to_point(place));
  std::vector<Point> displacements(points.size(), Point::Zero());
  for (std::size_t v = 0; v < body.size(); ++v) {
    displacements[v] = body_at(to_point(body[v]), time) - points[v];
  }
  std::vector<int> unknown(points.size(), -1);
  int count = 0;
  for (std::size_t v = body.size(); v < points.size(); ++v) {
    if (!is_on_wall(points[v])) unknown[v] = count++;
  }

  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX3d loads = Eigen::MatrixX3d::Zero(count, 3);
  const auto add_spring = [&](std::size_t v, std::size_t w, double stiffness) {
    if (unknown[v] < 0) return;
    entries.emplace_back(unknown[v], unknown[v], stiffness);
    if (unknown[w] >= 0) {
      entries.emplace_back(unknown[v], unknown[w], -stiffness);
    } else {
      loads.row(unknown[v]) += stiffness * displacements[w].transpose();
    }
  };
  for (const auto& tet : tets) {  // an edge counts once for each of its tets
    for (const auto& [i, j] : kEdges) {
      const std::uint32_t v = tet[i];
      const std::uint32_t w = tet[j];
      const double stiffness = 1 / (points[v] - points[w]).norm();
      add_spring(v, w, stiffness);
      add_spring(w, v, stiffness);
    }
  }
  Eigen::SparseMatrix<double> stiffnesses(count, count);
  stiffnesses.setFromTriplets(entries.begin(), entries.end());
  const Eigen::MatrixX3d solution =
      Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(stiffnesses).solve(loads);
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (unknown[v] >= 0) displacements[v] = solution.row(unknown[v]);
  }
  return displacements;
}

// ---- The steps ----------------------------------------------------------------------------------

/// The points where they are when the body is where it is at that time.
Points move(const tetmend::Mesh& mesh, const Points& body, double time) {
  const auto displacements = balance_springs(mesh.points(), mesh.tets(), body, time);
  Points moved;
  for (std::size_t v = 0; v < displacements.size(); ++v) {
    // No rounding adds up at the body.
    const Point p = v < body.size() ? body_at(to_point(body[v]), time)
                                    : to_point(mesh.points()[v]) + displacements[v];
    moved.push_back({p.x(), p.y(), p.z()});
  }
  return moved;
}

struct Effort {
  std::size_t parts = 0;    ///< of the step
  std::size_t touched = 0;  ///< tets, summed over the parts
};

/// Moves the body on, in as many parts as it takes.
Effort make_step(tetmend::Improver& session, const Points& body, double from, double to) {
  constexpr double kSmallestPart = 1.0 / 64;
  Effort effort;
  double done = 0;
  double part = 1;
  while (done < 1) {
    if (!session.move(move(session.mesh(), body, from + (to - from) * (done + part)))) {
      part /= 2;
      if (part < kSmallestPart) throw std::runtime_error("the mesh does not give way to the body");
      continue;
    }
    done += part;
    effort.touched += session.improve().touched_tets;
    ++effort.parts;
  }
  return effort;
}

/// Prints a line; false if the mesh has tets without a positive volume.
bool report(int step, const tetmend::Mesh& mesh, const Effort& effort, double seconds) {
  const tetmend::MeshStatistics now = tetmend::measure(mesh).statistics;
  const std::size_t inverted = now.inverted + now.flat;
  fmt::print("{:>4} {:>5} {:>9.2f} {:>9.2f} {:>6} {:>8} {:>7} {:>7} {:>7.3f}\n", step, effort.parts,
             now.theta_min, now.theta_max, now.n_bad, inverted, now.tets, effort.touched, seconds);
  return inverted == 0;
}

/// Tets with angles below about 20 degrees are bad; above, a moving mesh has too many of them.
tetmend::Options options_of_steps() {
  return {.purpose = "angles", .goal = {20.5, 159.5}, .measure = "sine", .tets = "5%"};
}

int run(int steps, bool plain, const std::filesystem::path& output) {
  Scene scene = make_scene();
  tetmend::Mesh mesh({.points = scene.points, .tets = scene.tets});
  tetmend::Improver session(mesh, options_of_steps());
  bool is_valid = true;
  fmt::print("step parts theta_min theta_max  n_bad inverted    tets touched seconds\n");
  for (int step = 1; step <= steps; ++step) {
    const auto start = std::chrono::steady_clock::now();
    const double from = static_cast<double>(step - 1) / steps;
    const double to = static_cast<double>(step) / steps;
    Effort effort = {.parts = 1};
    if (plain) {
      mesh = tetmend::Mesh({.points = move(mesh, scene.body, to), .tets = scene.tets});
    } else {
      effort = make_step(session, scene.body, from, to);
      mesh = session.mesh();
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    is_valid = report(step, mesh, effort, seconds.count()) && is_valid;
  }
  if (!output.empty()) tetmend::save(output, mesh);
  return is_valid ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A body moves through a mesh, and the mesh is mended as it goes");
  int steps = 40;
  bool plain = false;
  std::filesystem::path output;
  app.add_option("--steps", steps, "How many steps the way is divided into")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_flag("--plain", plain, "Only move the mesh: no improvement");
  app.add_option("-o,--output", output, "Write the last mesh to this file");
  CLI11_PARSE(app, argc, argv);
  try {
    return run(steps, plain, output);
  } catch (const std::exception& error) {
    fmt::print(stderr, "moving_body: {}\n", error.what());
    return 1;
  }
}
