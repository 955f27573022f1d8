#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Solve, size, adapt, and again: Poisson's equation with a peak, by DOLFINx.

    poisson_peak.py [STEPS]

The solution is a narrow bump in the unit cube. Each step solves on linear elements, takes the second derivatives of
what it found for an estimate of the error, and wants edges as long as makes that error equal everywhere, for so many
tets. Beside it stands the regular mesh with about as many unknowns. Needs DOLFINx 0.5 and tetmend.
"""

import inspect
import sys

import numpy as np
import tetmend
import ufl
from dolfinx import fem
from dolfinx.mesh import create_mesh, create_unit_cube
from mpi4py import MPI
from petsc4py import PETSc

PLACE, WIDTH = (0.6, 0.55, 0.45), 0.08
CELLS, STEPS, GROWTH = 8, 4, 2.0  # of the first mesh; tets grow by so much a step
REGULAR_GROWTH = 1.36  # of the cells along an edge of the regular mesh, for about as many unknowns


def bump(x):
    return ufl.exp(-sum((x[i] - PLACE[i]) ** 2 for i in range(3)) / WIDTH ** 2)


def bump_at(points):
    """The same for arrays of shape (3, n)."""
    return np.exp(-sum((points[i] - PLACE[i]) ** 2 for i in range(3)) / WIDTH ** 2)


def mesh_of(points, tets):
    domain = ufl.Mesh(ufl.VectorElement("Lagrange", ufl.tetrahedron, 1))
    word = "domain" if "domain" in inspect.signature(create_mesh).parameters else "e"  # by version
    return create_mesh(MPI.COMM_SELF, cells=tets.astype(np.int64), x=points, **{word: domain})


def solve(mesh):
    """The solution, and its errors in the mean square: of itself and of its gradient."""
    space = fem.FunctionSpace(mesh, ("Lagrange", 1))
    u, v, x = ufl.TrialFunction(space), ufl.TestFunction(space), ufl.SpatialCoordinate(mesh)
    dx = ufl.dx(metadata={"quadrature_degree": 6})
    form, load = fem.form(ufl.inner(ufl.grad(u), ufl.grad(v)) * dx), fem.form(-ufl.div(ufl.grad(bump(x))) * v * dx)
    edge = fem.Function(space)
    edge.interpolate(bump_at)
    mesh.topology.create_connectivity(2, 3)
    from dolfinx.mesh import locate_entities_boundary
    facets = locate_entities_boundary(mesh, 2, lambda p: np.isclose(np.abs(p - 0.5).max(axis=0), 0.5))
    condition = fem.dirichletbc(edge, fem.locate_dofs_topological(space, 2, facets))
    matrix = fem.petsc.assemble_matrix(form, bcs=[condition])
    matrix.assemble()
    right = fem.petsc.assemble_vector(load)
    fem.petsc.apply_lifting(right, [form], bcs=[[condition]])
    right.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
    fem.petsc.set_bc(right, [condition])
    solver = PETSc.KSP().create(mesh.comm)
    solver.setOperators(matrix)
    solver.setType("cg")
    solver.getPC().setType("jacobi")
    solver.setTolerances(rtol=1e-10)
    solution = fem.Function(space)
    solver.solve(right, solution.vector)
    errors = []
    for square in ((bump(x) - solution) ** 2, ufl.inner(ufl.grad(bump(x) - solution), ufl.grad(bump(x) - solution))):
        errors.append(np.sqrt(fem.assemble_scalar(fem.form(square * dx))))
    return solution, errors


def arrays_of(solution):
    """Points, tets, and the solution at the points."""
    mesh = solution.function_space.mesh
    tets = np.asarray(getattr(mesh.geometry.dofmap, "array", mesh.geometry.dofmap)).reshape(-1, 4)
    dofs = np.asarray(solution.function_space.dofmap.list.array).reshape(-1, 4)
    values = np.empty(len(mesh.geometry.x))
    values[tets] = solution.x.array[dofs]
    return mesh.geometry.x, tets, values


def gradient(points, tets, values):
    """At the points: the mean of the gradients of the tets around, by volume. And the volumes of the tets."""
    corners = points[tets]
    sides = corners[:, 1:] - corners[:, :1]
    volumes = np.abs(np.linalg.det(sides)) / 6
    slopes = np.linalg.solve(sides, values[tets][:, 1:] - values[tets][:, :1])
    sums, weights = np.zeros((len(points), *slopes.shape[1:])), np.zeros(len(points))
    for corner in tets.T:
        np.add.at(sums, corner, slopes * volumes[:, None, None])
        np.add.at(weights, corner, volumes)
    return sums / weights[:, None, None], volumes


def lengths_for(points, tets, values, count):
    """Edges for about so many tets, with as much error of the gradient in each.

    That error is the length times the second derivative D. Its square, summed over a given number of tets, is
    least for lengths in proportion to D^(-2/5)."""
    slopes, volumes = gradient(points, tets, values[:, None])
    second = gradient(points, tets, slopes[:, :, 0])[0]
    bend = np.linalg.norm((second + second.transpose(0, 2, 1)) / 2, ord=2, axis=(1, 2))
    lengths = np.maximum(bend, 1e-3 * bend.max()) ** -0.4
    tets_of_length_1 = 12 / np.sqrt(2) * volumes @ np.mean(lengths[tets] ** -3.0, axis=1)
    return lengths * (tets_of_length_1 / count) ** (1 / 3)


def main():
    steps = int(sys.argv[1]) if len(sys.argv) > 1 else STEPS
    mesh = create_unit_cube(MPI.COMM_SELF, CELLS, CELLS, CELLS)
    print("            adapted                                  regular")
    print("step  unknowns  in range     error  of gradient  unknowns     error  of gradient")
    in_range = ""
    for step in range(steps + 1):
        solution, (error, slope) = solve(mesh)
        points, tets, values = arrays_of(solution)
        cells = round(CELLS * REGULAR_GROWTH ** step)
        regular, (usual, usual_slope) = solve(create_unit_cube(MPI.COMM_SELF, cells, cells, cells))
        print(f"{step:4}  {len(points):8,}  {in_range:>8}  {error:8.5f}  {slope:11.4f}  {(cells + 1) ** 3:8,}  {usual:8.5f}"
              f"  {usual_slope:11.4f}", flush=True)
        if step == steps:
            return
        lengths = lengths_for(points, tets, values, GROWTH * len(tets))
        result = tetmend.adapt(points, tets, size="array:wanted", surface="flat", point_data={"wanted": lengths})
        in_range = f"{100 * result.figures['sizes_after']['in_range']:.1f} %"
        mesh = mesh_of(result.points, result.tets)


if __name__ == "__main__":
    main()
