"""A solver for `tetrafront adapt --solver`: the Poisson equation with a thin layer, by linear finite elements.

-div grad u = f, with u given on the boundary, so that u = tanh(20 (x + y / 2 - 0.6)) is the solution: it jumps from
-1 to 1 within about a tenth. The mesh comes from Tetrafront, the solution goes back to it, as values at the nodes.
Prints the error of the solution in the norm L2.

    pip install scikit-fem meshio
    npx tetrafront adapt cube.stl --solver "python solve.py {mesh} {solution}" --cycles 4 --elements 4000 -o adapted.vtu
"""

import sys

import meshio
import numpy as np
from skfem import Basis, ElementTetP1, MeshTet, condense, solve
from skfem.assembly import BilinearForm, Functional, LinearForm
from skfem.helpers import dot, grad

STEEPNESS = 20.0


def level(x):
    return STEEPNESS * (x[0] + 0.5 * x[1] - 0.6)


def exact(x):
    return np.tanh(level(x))


@BilinearForm
def laplace(u, v, _):
    return dot(grad(u), grad(v))


@LinearForm
def source(v, w):
    t = np.tanh(level(w.x))
    return 2.0 * STEEPNESS**2 * 1.25 * t * (1.0 - t**2) * v


@Functional
def squared_error(w):
    return (w["u"] - exact(w.x)) ** 2


def main(mesh_file, solution_file):
    given = meshio.read(mesh_file)
    elements = np.vstack([block.data for block in given.cells if block.type == "tetra"])
    mesh = MeshTet(given.points.T.copy(), elements.T.astype(np.int64))
    basis = Basis(mesh, ElementTetP1(), intorder=4)
    boundary = basis.get_dofs()
    u = basis.zeros()
    u[boundary.flatten()] = exact(basis.doflocs[:, boundary.flatten()])
    u = solve(*condense(laplace.assemble(basis), source.assemble(basis), x=u, D=boundary))
    error = np.sqrt(squared_error.assemble(basis, u=basis.interpolate(u)))
    print(f"{len(elements)} elements, error {error:.3e}")
    # scikit-fem keeps the order of the nodes, so the values fit the points of the file.
    cells = [("tetra", elements)]
    meshio.write(solution_file, meshio.Mesh(given.points, cells, point_data={"u": u}))


if __name__ == "__main__":
    main(*sys.argv[1:3])
