"""Pulls a part by linear elasticity, from its STL or STEP file to the displacements, with scikit-fem.

Meshes the part with well-shaped triangles and splits its surface into patches at sharp edges: "patch 1" is the
lowest one. One patch is fixed, another is pulled up with a force of 1 per unit of area. Young's modulus is 2000,
Poisson's ratio 0.35. Writes result.vtu with the displacement of each node, for ParaView.

    pip install scikit-fem meshio
    npm install tetrafront
    python part.py part.stl "patch 1" "patch 6"

Without names of patches, it lists them: number of triangles, box, area, and normal if the patch is flat.
"""

import subprocess
import sys

import numpy as np
from skfem import Basis, ElementTetP1, ElementVector, FacetBasis, LinearForm, MeshTet, condense, solve
from skfem.models.elasticity import lame_parameters, linear_elasticity


@LinearForm
def pull(v, _):
    return v[2]


def meshed(part, command):
    """Returns the mesh. Gmsh's format has the names of the patches, and scikit-fem makes boundaries of them."""
    options = ["--surface", "remesh", "--split-patches", "-q"]
    subprocess.run([*command, "mesh", part, "-o", "part.msh", *options], check=True)
    return MeshTet.load("part.msh")


def check_names(mesh, patches):
    """Ends the program if the mesh has no patch of a name."""
    for name in patches:
        if name not in mesh.boundaries:
            sys.exit(f'There is no patch "{name}". The patches are: {", ".join(mesh.boundaries)}')


def displacements(mesh, fixed, pulled):
    element = ElementVector(ElementTetP1())
    basis = Basis(mesh, element)
    stiffness = linear_elasticity(*lame_parameters(2000.0, 0.35)).assemble(basis)
    load = pull.assemble(FacetBasis(mesh, element, facets=mesh.boundaries[pulled]))
    u = solve(*condense(stiffness, load, D=basis.get_dofs(fixed)))
    return u.reshape(-1, 3)


def main(part, patches, command):
    mesh = meshed(part, command)
    if len(patches) != 2:
        subprocess.run([*command, "info", "part.msh"], check=True)
        return
    check_names(mesh, patches)
    u = displacements(mesh, *patches)
    mesh.save("result.vtu", {"displacement": u})
    largest = np.linalg.norm(u, axis=1).max()
    print(f"{mesh.nelements} tetrahedra, largest displacement {largest:.6g}")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:4], sys.argv[4:] or ["npx", "tetrafront"])
