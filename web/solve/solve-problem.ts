import { assembleElasticity, vonMisesStress } from "./elasticity";
import { conjugateGradients, stabilizedBiconjugateGradients } from "./linear-solvers";
import {
  fieldNames,
  SolveError,
  type NodeField,
  type Problem,
  type ProblemSolution,
  type SolvedMesh,
} from "./problem";
import { assembleScalar, heatFlux, type AssembledProblem } from "./scalar-problems";

/**
 * Solves a problem on a mesh. `start` has the unknowns of a similar solution at the nodes, which saves steps of the iterative
 * solver; null for none. Throws a `SolveError` if the problem has no unique solution. O(n) to assemble, about O(n^1.3) to solve.
 */
export function solveProblem(
  mesh: SolvedMesh,
  problem: Problem,
  start: Float64Array | null = null,
): ProblemSolution {
  checkMaterial(problem);
  if (mesh.tetrahedra.length === 0) throw new SolveError("no-elements");
  const { system, unknowns } = assembled(mesh, problem, start);
  checkHeld(mesh, unknowns.length / (mesh.points.length / 3), system.isGiven);
  const solver = problem.kind === "advection" ? stabilizedBiconjugateGradients : conjugateGradients;
  const iterations = solver(system, unknowns);
  return { fields: fieldsOf(mesh, problem, unknowns), iterations };
}

function assembled(mesh: SolvedMesh, problem: Problem, start: Float64Array | null): AssembledProblem {
  if (problem.kind === "elasticity") return assembleElasticity(mesh, problem, start);
  return assembleScalar(mesh, problem, start);
}

function checkMaterial(problem: Problem): void {
  if (!isUsable(problem)) throw new SolveError("bad-material");
}

function isUsable(problem: Problem): boolean {
  switch (problem.kind) {
    case "heat":
      return problem.conductivity > 0;
    case "advection":
      return problem.diffusivity > 0;
    case "elasticity":
      return problem.youngsModulus > 0 && problem.poissonRatio > -1 && problem.poissonRatio < 0.5;
  }
}

/** Throws if a connected piece of the mesh has no given unknown. */
function checkHeld({ points, tetrahedra }: SolvedMesh, perNode: number, isGiven: Uint8Array): void {
  const parent = Uint32Array.from({ length: points.length / 3 }, (_, node) => node);
  const rootOf = (node: number): number => {
    let root = node;
    while ((parent[root] ?? 0) !== root) {
      parent[root] = parent[parent[root] ?? 0] ?? 0;
      root = parent[root] ?? 0;
    }
    return root;
  };
  for (let first = 0; first < tetrahedra.length; first += 4) {
    const root = rootOf(tetrahedra[first] ?? 0);
    for (let k = 1; k < 4; ++k) parent[rootOf(tetrahedra[first + k] ?? 0)] = root;
  }
  const isHeld = new Uint8Array(parent.length);
  for (let node = 0; node < parent.length; ++node)
    if (isGiven[perNode * node] === 1) isHeld[rootOf(node)] = 1;
  for (let first = 0; first < tetrahedra.length; first += 4)
    if (isHeld[rootOf(tetrahedra[first] ?? 0)] !== 1) throw new SolveError("not-held");
}

function fieldsOf(
  mesh: SolvedMesh,
  problem: Problem,
  unknowns: Float64Array<ArrayBuffer>,
): readonly NodeField[] {
  switch (problem.kind) {
    case "heat": {
      const [temperature, flux] = fieldNames.heat;
      const values = heatFlux(mesh, problem.conductivity, unknowns);
      return [
        { name: temperature, components: 1, values: unknowns },
        { name: flux, components: 3, values },
      ];
    }
    case "advection":
      return [{ name: fieldNames.advection[0], components: 1, values: unknowns }];
    case "elasticity": {
      const [displacement, stress] = fieldNames.elasticity;
      const values = vonMisesStress(mesh, problem, unknowns);
      return [
        { name: displacement, components: 3, values: unknowns },
        { name: stress, components: 1, values },
      ];
    }
  }
}
