import { spawnSync } from "node:child_process";
import { pythonProgram } from "./python.mjs";

/** Python packages that tests need, and what they check; without a package, the tests skip these checks. */
const ORACLES = [
  {
    module: "meshio",
    pip: "meshio",
    judges: "meshio reads the files written here, its own are read, and curved elements are valid",
  },
  { module: "gmsh", pip: "gmsh", judges: "Gmsh reads the files written here" },
  {
    module: "skfem",
    pip: "scikit-fem",
    judges: "finite elements converge on the meshes (examples/heat, examples/part)",
  },
  {
    module: "ray",
    pip: "ray",
    judges: "many parts are meshed by a cluster that loses a machine (examples/cluster)",
  },
];

/** Returns one line for each check that did not run, with what to install. */
export function untestedOracles() {
  const python = pythonProgram();
  return ORACLES.filter(({ module }) => spawnSync(python, ["-c", `import ${module}`]).status !== 0).map(
    ({ pip, judges }) =>
      `NOT TESTED that ${judges}: pip install ${pip} (TETRAFRONT_PYTHON selects the Python, currently ${python})`,
  );
}
