/** The highest stress that a mesh finds, and how far it is from the truth. */
import { solveElasticity } from "./elasticity";
import { exactStress, highestStress, type Hole } from "./exact-plate";
import type { PlateMesh } from "./plate-mesh";

export interface SolvedPlate {
  readonly mesh: PlateMesh;
  /** Stress along the pull, per triangle. */
  readonly stresses: Float64Array;
  /** The largest of them, and its triangle. */
  readonly answer: number;
  readonly peak: number;
  /** Per cent of the truth. */
  readonly error: number;
}

/** Solves a plate whose outer edges are pulled as the large plate around it pulls them. */
export function solvePlate(mesh: PlateMesh, hole: Hole): SolvedPlate {
  const isRim = (node: number): boolean => mesh.onHole.has(node);
  const solution = solveElasticity(mesh, (x, y, from, to) =>
    isRim(from) && isRim(to) ? null : exactStress(hole, [x, y]),
  );
  const stresses = solution.stresses.filter((_stress, i) => i % 3 === 0);
  const answer = Math.max(...stresses);
  const truth = highestStress(hole);
  return {
    mesh,
    stresses,
    answer,
    peak: stresses.indexOf(answer),
    error: (100 * Math.abs(answer - truth)) / truth,
  };
}
