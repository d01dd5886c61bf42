"""Pulls a part by linear elasticity, from its STL or STEP file to the displacements, with scikit-fem.

Meshes the part with well-shaped triangles and splits its surface into patches at sharp edges: "patch 1" is the
lowest one. The faces of a STEP file are patches with their own names. One patch is fixed, another is pulled up with a force of 1 per
unit of area. Young's modulus is 2000, Poisson's ratio 0.35. Writes result.vtu with the displacement of each node, for ParaView.

    pip install scikit-fem meshio
    npm install tetrafront
    python part.py part.stl "patch 1" "patch 6"
    python part.py part.step "face 1" "face 6" --order 2

Elements of order 2 have nodes in the middles of their edges, on the faces of a STEP file: curved surfaces are computed as they are.
Without names of patches, it lists them: number of triangles, box, area, and normal if the patch is flat.
"""

import argparse
import subprocess
import sys

import meshio
import numpy as np
from skfem import (
    Basis,
    ElementTetP1,
    ElementTetP2,
    ElementVector,
    FacetBasis,
    LinearForm,
    condense,
    solve,
)
from skfem.io.meshio import from_meshio
from skfem.models.elasticity import lame_parameters, linear_elasticity


@LinearForm
def pull(v, _):
    return v[2]


def meshed(part, order, command):
    """Returns the mesh. Gmsh's format has the names of the patches, and scikit-fem makes boundaries of them."""
    options = ["--surface", "remesh", "--split-patches", "--element-order", str(order), "-q"]
    subprocess.run([*command, "mesh", part, "-o", "part.msh", *options], check=True)
    mesh = meshio.read("part.msh")
    # scikit-fem finds boundaries by the corners of triangles.
    mesh.cells = [
        meshio.CellBlock("triangle", block.data[:, :3]) if block.type == "triangle6" else block
        for block in mesh.cells
    ]
    return from_meshio(mesh)


def check_names(mesh, patches):
    """Ends the program if the mesh has no patch of a name."""
    for name in patches:
        if name not in mesh.boundaries:
            sys.exit(f'There is no patch "{name}". The patches are: {", ".join(mesh.boundaries)}')


def displacements(mesh, order, fixed, pulled):
    """Returns the displacement of each corner of the elements."""
    element = ElementVector(ElementTetP2() if order == 2 else ElementTetP1())
    basis = Basis(mesh, element)
    stiffness = linear_elasticity(*lame_parameters(2000.0, 0.35)).assemble(basis)
    load = pull.assemble(FacetBasis(mesh, element, facets=mesh.boundaries[pulled]))
    u = solve(*condense(stiffness, load, D=basis.get_dofs(fixed)))
    return u[basis.nodal_dofs].T


def main(part, patches, order, command):
    mesh = meshed(part, order, command)
    if len(patches) != 2:
        subprocess.run([*command, "info", "part.msh"], check=True)
        return
    check_names(mesh, patches)
    u = displacements(mesh, order, *patches)
    # The corners come first among the nodes of the mesh, before the middles of edges.
    corners = mesh.t[:4].T
    meshio.write_points_cells(
        "result.vtu", mesh.p[:, : len(u)].T, [("tetra", corners)], {"displacement": u}
    )
    largest = np.linalg.norm(u, axis=1).max()
    print(f"{mesh.nelements} tetrahedra, largest displacement {largest:.6g}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Pulls a part by linear elasticity.")
    parser.add_argument("part")
    parser.add_argument("patches", nargs="*")
    parser.add_argument("--order", type=int, choices=(1, 2), default=1)
    parser.add_argument("--command", nargs="+", default=["npx", "tetrafront"])
    given = parser.parse_args()
    main(given.part, given.patches, given.order, given.command)
