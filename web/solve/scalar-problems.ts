/**
 * Heat conduction, and advection with diffusion, by linear finite elements. Advection is stabilized by streamline upwinding
 * (SUPG, Brooks & Hughes 1982): τ = h / 2|v| (coth Pe − 1/Pe) with Pe = |v| h / 2k, where h is the length of the element along
 * the velocity.
 */
import { averagedAtNodes, forEachElement, forEachTriangle, type LinearElement } from "./elements";
import type { LinearSystem } from "./linear-solvers";
import type { AdvectionProblem, HeatProblem, SolvedMesh, Vector } from "./problem";
import { SparseMatrix } from "./sparse-matrix";

/** A linear system, and the start of its unknowns, which has the given values. */
export interface AssembledProblem {
  readonly system: LinearSystem;
  readonly unknowns: Float64Array<ArrayBuffer>;
}

interface Transport {
  readonly diffusivity: number;
  readonly velocity: Vector;
  readonly source: number;
}

/** Assembles a problem of one unknown per node. `start` has values for the unknowns, for example of a similar mesh. */
export function assembleScalar(
  mesh: SolvedMesh,
  problem: HeatProblem | AdvectionProblem,
  start: Float64Array | null,
): AssembledProblem {
  const nodeCount = mesh.points.length / 3;
  const matrix = new SparseMatrix(nodeCount, mesh.tetrahedra, 1);
  const rightSide = new Float64Array(nodeCount);
  const transport = transportOf(problem);
  forEachElement(mesh, (element) => addElement(matrix, rightSide, element, transport));
  const unknowns = start ? start.slice() : new Float64Array(nodeCount);
  const isGiven = new Uint8Array(nodeCount);
  /** Per node: index of the patch that gives its value; −1 for none. */
  const givenBy = new Int32Array(nodeCount).fill(-1);
  forEachTriangle(mesh, problem.conditions, (nodes, { kind, value }, area, patch) => {
    for (const node of nodes) {
      if (kind === "flux") rightSide[node] = (rightSide[node] ?? 0) + (value * area) / 3;
      else if (patch > (givenBy[node] ?? 0)) {
        givenBy[node] = patch;
        isGiven[node] = 1;
        unknowns[node] = value;
      }
    }
  });
  return { system: { matrix, rightSide, isGiven }, unknowns };
}

function transportOf(problem: HeatProblem | AdvectionProblem): Transport {
  if (problem.kind === "advection") return problem;
  return { diffusivity: problem.conductivity, velocity: [0, 0, 0], source: problem.source };
}

function addElement(
  matrix: SparseMatrix,
  rightSide: Float64Array,
  { nodes, volume, gradients }: LinearElement,
  { diffusivity, velocity, source }: Transport,
): void {
  const along = [0, 1, 2, 3].map((corner) => dotAt(gradients, 3 * corner, velocity));
  const tau = upwinding(along, velocity, diffusivity);
  nodes.forEach((row, i) => {
    const weight = along[i] ?? 0;
    rightSide[row] = (rightSide[row] ?? 0) + source * volume * (1 / 4 + tau * weight);
    nodes.forEach((column, j) => {
      let product = 0;
      for (let k = 0; k < 3; ++k) product += (gradients[3 * i + k] ?? 0) * (gradients[3 * j + k] ?? 0);
      const carried = (along[j] ?? 0) * (1 / 4 + tau * weight);
      matrix.add(matrix.blockAt(row, column), volume * (diffusivity * product + carried));
    });
  });
}

/** Returns τ; 0 without a velocity. `along`: products of the velocity and the gradients. */
function upwinding(along: readonly number[], velocity: Vector, diffusivity: number): number {
  const speed = Math.hypot(...velocity);
  const sum = along.reduce((total, value) => total + Math.abs(value), 0);
  if (speed === 0 || sum === 0) return 0;
  const length = (2 * speed) / sum;
  const peclet = (speed * length) / (2 * diffusivity);
  // Below, the difference of the two terms would be all rounding.
  const share = peclet < 1e-3 ? peclet / 3 : 1 / Math.tanh(peclet) - 1 / peclet;
  return (length / (2 * speed)) * share;
}

function dotAt(values: Float64Array, at: number, [x, y, z]: Vector): number {
  return (values[at] ?? 0) * x + (values[at + 1] ?? 0) * y + (values[at + 2] ?? 0) * z;
}

/** Returns −conductivity ∇T at the nodes. */
export function heatFlux(mesh: SolvedMesh, conductivity: number, temperature: Float64Array) {
  return averagedAtNodes(mesh, 3, ({ nodes, gradients }, flux) => {
    flux.fill(0);
    nodes.forEach((node, corner) => {
      for (let k = 0; k < 3; ++k)
        flux[k] = (flux[k] ?? 0) - conductivity * (temperature[node] ?? 0) * (gradients[3 * corner + k] ?? 0);
    });
  });
}
