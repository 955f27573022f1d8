// SPDX-License-Identifier: MIT
// The stable step against closed forms and against eigenvalues of the whole matrix.
#include "kernel/solver_rulers.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <doctest/doctest.h>

#include "kernel/chunks.h"
#include "tests/support/threads.h"
#include "tests/support/zoo.h"

using namespace tetmend;
using tetmend::test::on_threads;

namespace {

/// Stiffness matrix of the Laplacian and lumped mass, from gradients that solve linear systems.
struct Matrices {
  Eigen::MatrixXd stiffness;
  Eigen::VectorXd mass;
};

Matrices assemble(const TetMesh& mesh) {
  const auto size = static_cast<Eigen::Index>(mesh.vertex_slots());
  Matrices all = {Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size)};
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    const TetVertices& v = mesh.vertices(TetHandle(slot));
    Eigen::Matrix4d rows;  // the coordinates and 1: its inverse has the linear functions
    for (Eigen::Index i = 0; i < 4; ++i) {
      rows.row(i) << mesh.point(v[static_cast<std::size_t>(i)]).transpose(), 1;
    }
    const double volume = std::abs(rows.determinant()) / 6;
    const Eigen::Matrix<double, 3, 4> gradients = rows.inverse().topRows<3>();
    const Eigen::Matrix4d local = volume * gradients.transpose() * gradients;
    for (std::size_t i = 0; i < 4; ++i) {
      all.mass[v[i].index()] += volume / 4;
      for (std::size_t j = 0; j < 4; ++j) {
        all.stiffness(v[i].index(), v[j].index()) +=
            local(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
    }
  }
  return all;
}

/// 2 / sqrt(largest eigenvalue of M^-1 K).
double largest_step(const Matrices& of) {
  const Eigen::VectorXd root = of.mass.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = root.asDiagonal() * of.stiffness * root.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled, Eigen::EigenvaluesOnly);
  return 2 / std::sqrt(solver.eigenvalues().maxCoeff());
}

/// By vertex: edges on the way to the surface.
std::vector<double> count_depths(const TetMesh& mesh) {
  std::vector<double> depths(mesh.vertex_slots(), 1e9);
  for (std::uint32_t v = 0; v < depths.size(); ++v) {
    if (mesh.is_boundary(VertexHandle(v))) depths[v] = 0;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
      for (const VertexHandle v : mesh.vertices(TetHandle(slot))) {
        for (const VertexHandle w : mesh.vertices(TetHandle(slot))) {
          if (depths[w.index()] + 1 >= depths[v.index()]) continue;
          depths[v.index()] = depths[w.index()] + 1;
          changed = true;
        }
      }
    }
  }
  return depths;
}

/// The estimate from its definition: 8 (g^2 / lambda)^(3/8).
double estimate_by_definition(const TetMesh& mesh) {
  const std::vector<double> depths = count_depths(mesh);
  const P1Diagonals diagonals = p1_diagonals(mesh);
  std::vector<double> scale(depths.size()), rows(depths.size());
  double squares = 0, energy = 0, largest = 0;
  for (std::size_t v = 0; v < depths.size(); ++v) {
    if (depths[v] > 0) scale[v] = 1 / std::sqrt(diagonals.stiffness[v]);
    squares += diagonals.stiffness[v] * depths[v] * depths[v];
  }
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    const TetVertices& v = mesh.vertices(TetHandle(slot));
    Eigen::Matrix4d coordinates;
    Eigen::Vector4d depth;
    for (std::size_t i = 0; i < 4; ++i) {
      coordinates.row(static_cast<Eigen::Index>(i)) << mesh.point(v[i]).transpose(), 1;
      depth[static_cast<Eigen::Index>(i)] = depths[v[i].index()];
    }
    const Eigen::Matrix<double, 3, 4> gradients = coordinates.inverse().topRows<3>();
    const Eigen::Matrix4d local =
        std::abs(coordinates.determinant()) / 6 * gradients.transpose() * gradients;
    energy += depth.dot(local * depth);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        rows[v[i].index()] +=
            std::abs(local(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))) *
            scale[v[j].index()];
      }
    }
  }
  for (std::size_t v = 0; v < rows.size(); ++v) largest = std::max(largest, scale[v] * rows[v]);
  return 8 * std::pow(largest * largest * squares / energy, 3.0 / 8);
}

/// Of conjugate gradients with Jacobi's preconditioner to 1e-8, load 1, surface fixed.
int count_cg_steps(const TetMesh& mesh) {
  const Matrices all = assemble(mesh);
  std::vector<Eigen::Index> inner;
  for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) {
    if (!mesh.is_boundary(VertexHandle(v))) inner.push_back(v);
  }
  const Eigen::MatrixXd matrix = all.stiffness(inner, inner);
  Eigen::VectorXd residual = all.mass(inner);
  const Eigen::VectorXd inverse = matrix.diagonal().cwiseInverse();
  const double end = 1e-8 * residual.norm();
  Eigen::VectorXd z = inverse.cwiseProduct(residual);
  Eigen::VectorXd direction = z;
  int steps = 0;
  while (residual.norm() > end) {
    const Eigen::VectorXd product = matrix * direction;
    const double before = residual.dot(z);
    residual -= before / direction.dot(product) * product;
    z = inverse.cwiseProduct(residual);
    direction = z + residual.dot(z) / before * direction;
    ++steps;
  }
  return steps;
}

}  // namespace

TEST_CASE("the step of a regular tet is that of its altitude") {
  MeshData data;
  data.points = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  data.tets = {{{0, 1, 2, 3}}};
  // m = V / 4 and k = V / h^2
  CHECK(stable_step(TetMesh(data)) == doctest::Approx((4 / std::sqrt(3.0)) / 2));
}

TEST_CASE("the step is the least of sqrt(m / k), and dt lies between it and twice as much") {
  for (const MeshData& data :
       {test::kuhn_cube(4, 0, 7), test::kuhn_cube(5, 0.3, 7), test::delaunay_ball(150, 3)}) {
    const TetMesh mesh(data);
    const Matrices matrices = assemble(mesh);
    const Eigen::VectorXd squares =
        matrices.mass.cwiseQuotient(Eigen::VectorXd(matrices.stiffness.diagonal()));
    const double step = stable_step(mesh);
    CHECK(step == doctest::Approx(std::sqrt(squares.minCoeff())).epsilon(1e-12));
    const P1Diagonals diagonals = p1_diagonals(mesh);
    for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) {
      CHECK(diagonals.step(VertexHandle(v)) == doctest::Approx(std::sqrt(squares[v])));
    }
    const double dt = largest_step(matrices);
    CHECK(step <= dt);
    CHECK(dt <= 2 * step);
  }
}

TEST_CASE("the diagonal of one tet is what the sums over a mesh of one tet have") {
  MeshData data;
  data.points = {{0, 0, 0}, {1, 0.1, 0}, {0.2, 1.5, 0.1}, {0.3, 0.2, 0.7}};
  data.tets = {{{0, 1, 2, 3}}};
  const TetMesh mesh(data);
  const auto& p = data.points;
  const P1Diagonal one = p1_diagonal(p[0], p[1], p[2], p[3]);
  const P1Diagonals all = p1_diagonals(mesh);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(all.mass[i] == doctest::Approx(one.mass));
    CHECK(all.stiffness[i] == doctest::Approx(one.stiffness[i]));
  }
}

TEST_CASE("a mesh with a tet of no positive volume, or without tets, has no step") {
  CHECK(stable_step(TetMesh()) == 0);
  CHECK(stable_step(TetMesh(test::tangled_ball(60, 3))) == 0);
}

TEST_CASE("the estimate of CG steps is of the size of those that are taken") {
  for (const MeshData& data : {test::kuhn_cube(6, 0.15, 7), test::kuhn_cube(9, 0.15, 7),
                               test::kuhn_cube(9, 0.3, 7), test::delaunay_ball(900, 3)}) {
    const TetMesh mesh(data);
    const double taken = count_cg_steps(mesh);
    const double estimate = estimate_cg_steps(mesh, p1_diagonals(mesh));
    CAPTURE(taken);
    CHECK(estimate > taken / 1.6);
    CHECK(estimate < taken * 1.6);
  }
}

TEST_CASE("a mesh with flatter tets is estimated to take more CG steps, and takes them") {
  const TetMesh even(test::kuhn_cube(8, 0.1, 7));
  const TetMesh uneven(test::kuhn_cube(8, 0.3, 7));
  CHECK(count_cg_steps(uneven) > 1.1 * count_cg_steps(even));
  CHECK(estimate_cg_steps(uneven, p1_diagonals(uneven)) >
        1.1 * estimate_cg_steps(even, p1_diagonals(even)));
}

TEST_CASE(
    "a mesh whose vertices are all on the surface, or with an inverted tet, has no estimate") {
  const TetMesh one(test::kuhn_cube(1, 0, 7));
  CHECK(estimate_cg_steps(one, p1_diagonals(one)) == 0);
  const TetMesh tangled(test::tangled_ball(60, 3));
  CHECK(estimate_cg_steps(tangled, p1_diagonals(tangled)) == 0);
  CHECK(estimate_cg_steps(TetMesh(), p1_diagonals(TetMesh())) == 0);
}

TEST_CASE("the estimate of CG steps is what its definition gives, however deep the mesh is") {
  for (const int cells : {2, 3, 6, 11}) {
    CAPTURE(cells);
    const TetMesh mesh(test::kuhn_cube(cells, 0.2, 7));
    CHECK(estimate_cg_steps(mesh, p1_diagonals(mesh)) ==
          doctest::Approx(estimate_by_definition(mesh)).epsilon(1e-9));
  }
}

TEST_CASE("sums at vertices are the same, bit for bit, for every number of threads") {
  const TetMesh mesh(test::kuhn_cube(26, 0.3, 7));  // more than one range of vertices
  const P1Diagonals sums = on_threads(1, [&] { return p1_diagonals(mesh); });
  const double steps = on_threads(1, [&] { return estimate_cg_steps(mesh, sums); });
  CHECK(steps > 0);
  for (const int threads : {2, 5}) {
    const P1Diagonals again = on_threads(threads, [&] { return p1_diagonals(mesh); });
    CHECK(again.mass == sums.mass);
    CHECK(again.stiffness == sums.stiffness);
    CHECK(again.are_positive);
    CHECK(on_threads(threads, [&] { return estimate_cg_steps(mesh, again); }) == steps);
  }
  // In the order of the tets, of which a vertex has the mass of each in turn.
  std::vector<double> mass(mesh.vertex_slots());
  for (std::uint32_t slot = 0; slot < mesh.tet_slots(); ++slot) {
    const TetVertices& v = mesh.vertices(TetHandle(slot));
    const double share =
        p1_diagonal(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])).mass;
    for (const VertexHandle w : v) mass[w.index()] += share;
  }
  CHECK(mass == sums.mass);
}

TEST_CASE("the step is the same, bit for bit, for every number of threads") {
  const TetMesh mesh(test::kuhn_cube(17, 0.3, 7));
  REQUIRE(mesh.tet_slots() > kChunkSize);
  const double step = on_threads(1, [&] { return stable_step(mesh); });
  CHECK(step > 0);
  CHECK(on_threads(2, [&] { return stable_step(mesh); }) == step);
  CHECK(on_threads(5, [&] { return stable_step(mesh); }) == step);
}
