"""Solves heat conduction in a ball with a heat source, by linear finite elements on Tetrafront's meshes.

-div grad u = 6 in the unit ball, u = 0 on its surface; the solution is u = 1 - r^2. For suitable meshes,
the root mean square error is of second order in the element size, and that of the gradient of first order.
Prints one line per size, and the observed orders as JSON.

    pip install scikit-fem meshio
    npm install tetrafront
    python heat.py
"""

import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import meshio
import numpy as np
from skfem import Basis, ElementTetP1, MeshTet, condense, solve
from skfem.assembly import BilinearForm, Functional, LinearForm
from skfem.helpers import dot, grad


@BilinearForm
def laplace(u, v, _):
    return dot(grad(u), grad(v))


@LinearForm
def source(v, _):
    return 6.0 * v


@Functional
def squared_error(w):
    return (w["u"] - (1.0 - dot(w.x, w.x))) ** 2


@Functional
def squared_gradient_error(w):
    return dot(grad(w["u"]) + 2.0 * w.x, grad(w["u"]) + 2.0 * w.x)


def sphere(n):
    """Returns a unit sphere as OFF text: the faces of an octahedron divided n x n."""
    nodes, places, faces = {}, [], []

    def node(p):
        key = tuple(p)
        if key not in nodes:
            nodes[key] = len(places)
            places.append(np.array(p) / np.linalg.norm(p))
        return nodes[key]

    for sx, sy, sz in [(a, b, c) for a in (1, -1) for b in (1, -1) for c in (1, -1)]:
        at = lambda i, j: node((sx * (n - i - j), sy * i, sz * j))  # noqa: E731
        for i in range(n):
            for j in range(n - i):
                corners = [(at(i, j), at(i + 1, j), at(i, j + 1))]
                if i + j < n - 1:
                    corners.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
                # Each reflection reverses the orientation; make all faces point outward.
                faces += [face if sx * sy * sz > 0 else face[::-1] for face in corners]
    lines = ["OFF", f"{len(places)} {len(faces)} 0"]
    lines += [" ".join(repr(float(x)) for x in p) for p in places]
    lines += ["3 " + " ".join(map(str, f)) for f in faces]
    return "\n".join(lines) + "\n"


def meshed(n, folder, command):
    surface, volume = folder / "ball.off", folder / "ball.vtu"
    surface.write_text(sphere(n))
    size = 2.0 / n
    subprocess.run([*command, "mesh", str(surface), "-o", str(volume), "-q", "--size", str(size)], check=True)
    mesh = meshio.read(volume)
    return MeshTet(mesh.points.T.copy(), mesh.cells_dict["tetra"].T.astype(np.int64).copy())


def errors(mesh):
    basis = Basis(mesh, ElementTetP1(), intorder=4)
    boundary = basis.get_dofs()
    # The surface of the mesh lies inside the ball, so the solution is not exactly zero there.
    given = 1.0 - np.sum(mesh.p**2, axis=0)
    u = solve(*condense(laplace.assemble(basis), source.assemble(basis), x=given, D=boundary))
    field = basis.interpolate(u)
    return (
        math.sqrt(squared_error.assemble(basis, u=field)),
        math.sqrt(squared_gradient_error.assemble(basis, u=field)),
    )


def main(command):
    with tempfile.TemporaryDirectory() as folder:
        rows = []
        for n in (4, 8, 16):
            mesh = meshed(n, Path(folder), command)
            # Estimate the mean element size from the number of elements.
            size = mesh.t.shape[1] ** (-1.0 / 3.0)
            rows.append((size, *errors(mesh)))
            print(f"{mesh.t.shape[1]:8d} tetrahedra, error {rows[-1][1]:.3e}, of the gradient {rows[-1][2]:.3e}")
    (h0, e0, g0), (h1, e1, g1) = rows[0], rows[-1]
    order = lambda a, b: math.log(a / b) / math.log(h0 / h1)  # noqa: E731
    print(json.dumps({"order": order(e0, e1), "gradientOrder": order(g0, g1)}))


if __name__ == "__main__":
    main(sys.argv[1:] or ["npx", "tetrafront"])
