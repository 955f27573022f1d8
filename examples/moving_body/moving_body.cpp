// SPDX-License-Identifier: MIT
// A body moves through a mesh, as a store that separates from an aircraft: [chen, 7].
//
//   make a lattice of tets in a box, with a hole: the body
//   for each step:
//     while a part of the step is left:
//       let the body move by that part, and the springs between the vertices pull the mesh along if
//       a tet turns over: try again with half the part build the mesh again from the moved points
//       improve the bad tets and what is around them; no other tet is touched
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
#include <stdexcept>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <Eigen/SparseCholesky>
#include <fmt/format.h>

#include "kernel/formats/mesh_io.h"
#include "kernel/geometry.h"
#include "kernel/statistics.h"
#include "schedule/passes.h"

using tetmend::MeshData;
using tetmend::Point;

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

struct Scene {
  MeshData mesh;
  /// Where the vertices of the body start. They are the first vertices of the mesh and stay so,
  /// because nothing removes vertices of the boundary.
  std::vector<Point> body;
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
  MeshData& mesh = scene.mesh;
  std::map<Place, std::uint32_t> number;
  const auto add_vertices = [&](bool of_body) {
    for_each_place({kBox[0] + 1, kBox[1] + 1, kBox[2] + 1}, [&](const Place& at) {
      const int distance = distance_from_middle(at);
      if (distance == 0 || (distance == 1) != of_body) return;
      number[at] = static_cast<std::uint32_t>(mesh.points.size());
      mesh.points.emplace_back(at[0], at[1], at[2]);
    });
  };
  add_vertices(true);
  scene.body = mesh.points;
  add_vertices(false);

  // Six tets for each cell: every order of the axes is a path along the edges of the cell, from its
  // lowest to its highest corner.
  for_each_place(kBox, [&](const Place& cell) {
    const Place highest = {cell[0] + 1, cell[1] + 1, cell[2] + 1};
    if (distance_from_middle(cell) <= 1 && distance_from_middle(highest) <= 1) return;  // the body
    std::array<unsigned, 3> axes = {0, 1, 2};
    do {
      MeshData::Tet tet;
      Place corner = cell;
      for (unsigned i = 0; i < 4; ++i) {
        tet.vertices[i] = number.at(corner);
        if (i < 3) ++corner[axes[i]];
      }
      const bool is_even = (axes[1] + 3 - axes[0]) % 3 == 1;
      if (!is_even) std::swap(tet.vertices[2], tet.vertices[3]);
      mesh.tets.push_back(tet);
    } while (std::next_permutation(axes.begin(), axes.end()));
  });
  return scene;
}

// ---- The springs --------------------------------------------------------------------------------

bool is_on_wall(const Point& p) {
  const Point far(kBox[0], kBox[1], kBox[2]);
  return (p.array() == 0 || p.array() == far.array()).any();
}

/// Each edge is a spring, the stiffer the shorter. Given where the body goes and that walls stay,
/// finds the displacements of all vertices at which the springs are in balance.
std::vector<Point> balance_springs(const Scene& scene, double time) {
  const auto& points = scene.mesh.points;
  std::vector<Point> displacements(points.size(), Point::Zero());
  for (std::size_t v = 0; v < scene.body.size(); ++v) {
    displacements[v] = body_at(scene.body[v], time) - points[v];
  }
  std::vector<int> unknown(points.size(), -1);
  int count = 0;
  for (std::size_t v = scene.body.size(); v < points.size(); ++v) {
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
  for (const MeshData::Tet& tet : scene.mesh.tets) {  // an edge counts once for each of its tets
    for (const auto& [i, j] : tetmend::kEdgeVertices) {
      const std::uint32_t v = tet.vertices[i];
      const std::uint32_t w = tet.vertices[j];
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

/// The scene with the body where it is at that time.
Scene move(Scene scene, double time) {
  const std::vector<Point> displacements = balance_springs(scene, time);
  for (std::size_t v = 0; v < displacements.size(); ++v) scene.mesh.points[v] += displacements[v];
  for (std::size_t v = 0; v < scene.body.size(); ++v) {
    scene.mesh.points[v] = body_at(scene.body[v], time);  // no rounding adds up
  }
  return scene;
}

bool has_turned_tets(const MeshData& mesh) {
  return std::any_of(mesh.tets.begin(), mesh.tets.end(), [&](const MeshData::Tet& tet) {
    const auto& [a, b, c, d] = tet.vertices;
    return !tetmend::certified_positive(mesh.points[a], mesh.points[b], mesh.points[c],
                                        mesh.points[d]);
  });
}

/// Improves the tets with angles below about 20 degrees; the passes try these only, and what they
/// change lies around them. New vertices are for tets that a round has not cured, so that the mesh
/// does not grow at every step. Returns how many tets are new or have moved.
std::size_t improve(MeshData& data, const tetmend::Registry& registry) {
  constexpr int kRounds = 3;
  tetmend::TetMesh mesh(std::move(data));
  mesh.set_standard(tetmend::Standard(tetmend::Goal{}, tetmend::Standard::Terms::sine));
  const tetmend::Selection needy = {
      .below = static_cast<tetmend::Quality>(mesh.standard().quality_of_angle(20.5))};
  tetmend::Run run(mesh, registry);
  const auto is_good = [&] { return tetmend::quality_indicators(mesh).q_worst >= needy.below; };
  for (int round = 0; round < kRounds && !is_good(); ++round) {
    tetmend::local_reconnection(run, {.on = needy});
    tetmend::smooth(run, {.on = needy});
    tetmend::suppress_points(run, {.on = needy});
    if (round > 0) {
      tetmend::insert_points(run, {.on = needy, .settings = {{"relax", 1}}});
    }
    tetmend::smooth(run, {.on = needy});
  }
  std::size_t touched = 0;
  for (std::uint32_t i = 0; i < mesh.tet_slots(); ++i) {
    const tetmend::TetHandle t(i);
    if (!mesh.is_deleted(t) && mesh.is_touched(t)) ++touched;
  }
  data = mesh.to_data();
  return touched;
}

struct Effort {
  std::size_t parts = 0;    ///< of the step
  std::size_t touched = 0;  ///< tets, summed over the parts
};

/// Moves the body on, in as many parts as it takes.
Effort make_step(Scene& scene, double from, double to, const tetmend::Registry& registry) {
  constexpr double kSmallestPart = 1.0 / 64;
  Effort effort;
  double done = 0;
  double part = 1;
  while (done < 1) {
    Scene moved = move(scene, from + (to - from) * (done + part));
    if (has_turned_tets(moved.mesh)) {
      part /= 2;
      if (part < kSmallestPart) throw std::runtime_error("the mesh does not give way to the body");
      continue;
    }
    done += part;
    scene = std::move(moved);
    effort.touched += improve(scene.mesh, registry);
    ++effort.parts;
  }
  return effort;
}

/// Prints a line; false if the mesh has tets without a positive volume.
bool report(int step, const MeshData& data, const Effort& effort, double seconds) {
  const tetmend::MeshStatistics now = tetmend::compute_statistics(tetmend::TetMesh(data));
  const std::size_t inverted = now.inverted + now.flat;
  fmt::print("{:>4} {:>5} {:>9.2f} {:>9.2f} {:>6} {:>8} {:>7} {:>7} {:>7.3f}\n", step, effort.parts,
             now.theta_min, now.theta_max, now.n_bad, inverted, now.tets, effort.touched, seconds);
  return inverted == 0;
}

int run(int steps, bool plain, const std::filesystem::path& output) {
  tetmend::Registry registry = tetmend::Registry::builtin();
  Scene scene = make_scene();
  bool is_valid = true;
  fmt::print("step parts theta_min theta_max  n_bad inverted    tets touched seconds\n");
  for (int step = 1; step <= steps; ++step) {
    const auto start = std::chrono::steady_clock::now();
    const double from = static_cast<double>(step - 1) / steps;
    const double to = static_cast<double>(step) / steps;
    Effort effort = {.parts = 1};
    if (plain) {
      scene = move(std::move(scene), to);
    } else {
      effort = make_step(scene, from, to, registry);
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    is_valid = report(step, scene.mesh, effort, seconds.count()) && is_valid;
  }
  if (!output.empty()) tetmend::write_mesh(output, scene.mesh);
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
