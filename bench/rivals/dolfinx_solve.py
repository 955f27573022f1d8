# SPDX-License-Identifier: MIT
"""Prints as JSON what DOLFINx finds when it solves equations on a mesh with linear elements.

    dolfinx_solve.py INPUT.mesh

Poisson's equation with a smooth solution that is known, given on the surface: relative error of the
gradient, and steps of conjugate gradients to 1e-8 with Jacobi's preconditioner and with algebraic
multigrid (GAMG of PETSc). Then the wave equation with lumped mass: the largest stable step of
explicit time integration for a speed of 1, and sqrt(m / k) of each vertex from mass and diagonal of
the stiffness matrix.
"""

import json
import sys
from pathlib import Path

import dolfinx
import numpy
import ufl
from dolfinx import fem, mesh
from dolfinx.fem.petsc import assemble_matrix, assemble_vector
from mpi4py import MPI
from petsc4py import PETSc

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import medit  # noqa: E402

TOLERANCE = 1e-8
LANCZOS_STEPS = 100  # the largest eigenvalue is there long before


def load(file: Path) -> mesh.Mesh:
    """Without points of no tet, which would have empty rows."""
    read = medit.read(file, leave_out_unknown=True)
    tets = numpy.array(read.tets, dtype=numpy.int64)
    used, numbers = numpy.unique(tets, return_inverse=True)
    points = numpy.array(read.points)[used]
    element = ufl.VectorElement("Lagrange", ufl.tetrahedron, 1)
    return mesh.create_mesh(MPI.COMM_SELF, numbers.reshape(tets.shape), points, ufl.Mesh(element))


def smooth_solution(domain: mesh.Mesh):
    """Half a wave to one and a half along the longest side of the box. Constants of DOLFINx: forms are
    compiled once for all meshes."""
    points = domain.geometry.x
    low = fem.Constant(domain, points.min(axis=0))
    scale = fem.Constant(domain, float(numpy.pi / numpy.ptp(points, axis=0).max()))
    x = ufl.SpatialCoordinate(domain)
    s = [scale * (x[i] - low[i]) for i in range(3)]
    return ufl.sin(s[0] + 0.3) * ufl.sin(1.5 * s[1] + 0.7) * ufl.sin(1.5 * s[2] + 1.1)


def conjugate_gradients(matrix: PETSc.Mat, right: PETSc.Vec, preconditioner: str):
    """The solution and the number of steps."""
    solver = PETSc.KSP().create(MPI.COMM_SELF)
    solver.setOperators(matrix)
    solver.setType("cg")
    solver.getPC().setType(preconditioner)
    solver.setNormType(PETSc.KSP.NormType.UNPRECONDITIONED)
    solver.setTolerances(rtol=TOLERANCE, max_it=100000)
    solution = right.duplicate()
    solver.solve(right, solution)
    return solution, solver.getIterationNumber()


def poisson(domain: mesh.Mesh) -> dict:
    space = fem.FunctionSpace(domain, ("Lagrange", 1))
    exact = smooth_solution(domain)
    u, v, x = ufl.TrialFunction(space), ufl.TestFunction(space), ufl.SpatialCoordinate(domain)
    found = fem.Function(space)
    found.interpolate(fem.Expression(exact, space.element.interpolation_points()))
    domain.topology.create_connectivity(2, 3)
    surface = mesh.exterior_facet_indices(domain.topology)
    fixed = fem.locate_dofs_topological(space, 2, surface)
    free = numpy.setdiff1d(numpy.arange(space.dofmap.index_map.size_local), fixed)
    matrix = assemble_matrix(fem.form(ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx))
    matrix.assemble()
    right = assemble_vector(fem.form(-ufl.div(ufl.grad(exact)) * v * ufl.dx))
    told = {"unknowns": len(free)}
    if len(free) > 0:
        given = found.vector.copy()
        given.array[free] = 0
        right.axpy(-1, matrix * given)
        chosen = PETSc.IS().createGeneral(free.astype(numpy.int32), MPI.COMM_SELF)
        inner, load_there = matrix.createSubMatrix(chosen, chosen), right.getSubVector(chosen)
        _, told["amg"] = conjugate_gradients(inner, load_there, "gamg")
        solution, told["jacobi"] = conjugate_gradients(inner, load_there, "jacobi")
        found.x.array[free] = solution.array
    difference = ufl.grad(found - exact)
    square = ufl.inner(difference, difference) * ufl.dx(metadata={"quadrature_degree": 4})
    whole = ufl.inner(ufl.grad(exact), ufl.grad(exact)) * ufl.dx(metadata={"quadrature_degree": 4})
    told["error"] = float(numpy.sqrt(fem.assemble_scalar(fem.form(square)) /
                                     fem.assemble_scalar(fem.form(whole))))
    return told


def largest_eigenvalue(matrix: PETSc.Mat) -> float:
    """Of a symmetric matrix, by the method of Lanczos from a start that is always the same."""
    size = matrix.getSize()[0]
    before, now, product = matrix.createVecRight(), matrix.createVecRight(), matrix.createVecRight()
    now.array[:] = numpy.random.default_rng(1).standard_normal(size)
    now.normalize()
    diagonal, beside = [], []
    for _ in range(min(size, LANCZOS_STEPS)):
        matrix.mult(now, product)
        diagonal.append(product.dot(now))
        product.axpy(-diagonal[-1], now)
        product.axpy(-(beside[-1] if beside else 0), before)
        length = product.norm()
        if length < 1e-12:
            break
        beside.append(length)
        before, now, product = now, product / length, before
    small = numpy.diag(diagonal) + numpy.diag(beside[:len(diagonal) - 1], 1)
    return float(numpy.linalg.eigvalsh(small, UPLO="U").max())


def wave(domain: mesh.Mesh) -> dict:
    space = fem.FunctionSpace(domain, ("Lagrange", 1))
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    mass = assemble_vector(fem.form(v * ufl.dx)).array.copy()
    matrix = assemble_matrix(fem.form(ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx))
    matrix.assemble()
    steps = numpy.sqrt(mass / matrix.getDiagonal().array)
    scale = matrix.createVecRight()
    scale.array[:] = 1 / numpy.sqrt(mass)
    matrix.diagonalScale(scale, scale)
    return {"dt": float(2 / numpy.sqrt(largest_eigenvalue(matrix))), "step": float(steps.min()),
            "version": dolfinx.__version__, "tolerance": 1e-9, "values": {"step": steps.tolist()}}


def main() -> None:
    only_values = sys.argv[1] == "--values"
    domain = load(Path(sys.argv[-1]))
    print(json.dumps(wave(domain) | ({} if only_values else poisson(domain))))


main()
