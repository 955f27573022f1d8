// SPDX-License-Identifier: MIT
// The stable step against closed forms and against eigenvalues of the whole matrix.
#include "kernel/solver_rulers.h"

#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>
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

TEST_CASE("the step is the same, bit for bit, for every number of threads") {
  const TetMesh mesh(test::kuhn_cube(17, 0.3, 7));
  REQUIRE(mesh.tet_slots() > kChunkSize);
  const double step = on_threads(1, [&] { return stable_step(mesh); });
  CHECK(step > 0);
  CHECK(on_threads(2, [&] { return stable_step(mesh); }) == step);
  CHECK(on_threads(5, [&] { return stable_step(mesh); }) == step);
}
