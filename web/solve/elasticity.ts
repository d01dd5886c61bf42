/** Linear elasticity of an isotropic material by linear finite elements: three displacements per node. */
import { averagedAtNodes, forEachElement, forEachTriangle, type LinearElement } from "./elements";
import type { ElasticityProblem, SolvedMesh } from "./problem";
import type { AssembledProblem } from "./scalar-problems";
import { SparseMatrix } from "./sparse-matrix";

/** The two constants of Lamé. */
interface Lame {
  readonly lambda: number;
  readonly mu: number;
}

export function lameOf({ youngsModulus, poissonRatio }: ElasticityProblem): Lame {
  return {
    lambda: (youngsModulus * poissonRatio) / ((1 + poissonRatio) * (1 - 2 * poissonRatio)),
    mu: youngsModulus / (2 * (1 + poissonRatio)),
  };
}

/** Assembles the problem. `start` has displacements, for example of a similar mesh. */
export function assembleElasticity(
  mesh: SolvedMesh,
  problem: ElasticityProblem,
  start: Float64Array | null,
): AssembledProblem {
  const nodeCount = mesh.points.length / 3;
  const matrix = new SparseMatrix(nodeCount, mesh.tetrahedra, 3);
  const rightSide = new Float64Array(3 * nodeCount);
  const lame = lameOf(problem);
  const addForce = (node: number, share: number, force: readonly number[]): void => {
    for (let k = 0; k < 3; ++k)
      rightSide[3 * node + k] = (rightSide[3 * node + k] ?? 0) + share * (force[k] ?? 0);
  };
  forEachElement(mesh, (element) => {
    addStiffness(matrix, element, lame);
    for (const node of element.nodes) addForce(node, element.volume / 4, problem.bodyForce);
  });
  const unknowns = start ? start.slice() : new Float64Array(3 * nodeCount);
  const isGiven = new Uint8Array(3 * nodeCount);
  forEachTriangle(mesh, problem.conditions, (nodes, condition, area) => {
    for (const node of nodes) {
      if (condition.kind === "traction") addForce(node, area / 3, condition.traction);
      else {
        isGiven.fill(1, 3 * node, 3 * node + 3);
        unknowns.fill(0, 3 * node, 3 * node + 3);
      }
    }
  });
  return { system: { matrix, rightSide, isGiven }, unknowns };
}

/** Adds V (λ gᵢ ⊗ gⱼ + μ gⱼ ⊗ gᵢ + μ (gᵢ·gⱼ) I) for each two corners with the gradients g. */
function addStiffness(matrix: SparseMatrix, element: LinearElement, { lambda, mu }: Lame): void {
  const { nodes, volume, gradients: g } = element;
  nodes.forEach((row, i) => {
    nodes.forEach((column, j) => {
      const block = matrix.blockAt(row, column);
      let product = 0;
      for (let k = 0; k < 3; ++k) product += (g[3 * i + k] ?? 0) * (g[3 * j + k] ?? 0);
      for (let k = 0; k < 3; ++k) {
        for (let l = 0; l < 3; ++l) {
          const mixed =
            lambda * (g[3 * i + k] ?? 0) * (g[3 * j + l] ?? 0) +
            mu * (g[3 * i + l] ?? 0) * (g[3 * j + k] ?? 0);
          matrix.add(block + 3 * k + l, volume * (mixed + (k === l ? mu * product : 0)));
        }
      }
    });
  });
}

/** Returns the von Mises stress at the nodes: that of the elements around them, averaged. */
export function vonMisesStress(mesh: SolvedMesh, problem: ElasticityProblem, displacement: Float64Array) {
  const lame = lameOf(problem);
  const gradient = new Float64Array(9);
  return averagedAtNodes(mesh, 1, (element, out) => {
    writeDisplacementGradient(element, displacement, gradient);
    out[0] = equivalentStress(gradient, lame);
  });
}

/** Writes ∂uₖ/∂xₗ to entry 3k + l. */
function writeDisplacementGradient(
  { nodes, gradients }: LinearElement,
  displacement: Float64Array,
  out: Float64Array,
): void {
  out.fill(0);
  nodes.forEach((node, corner) => {
    for (let k = 0; k < 3; ++k) {
      const u = displacement[3 * node + k] ?? 0;
      for (let l = 0; l < 3; ++l)
        out[3 * k + l] = (out[3 * k + l] ?? 0) + u * (gradients[3 * corner + l] ?? 0);
    }
  });
}

/** Returns √(3/2 s:s), where s is the deviator of the stress: 2 μ times that of the strain. */
function equivalentStress(gradient: Float64Array, { mu }: Lame): number {
  const [xx = 0, xy = 0, xz = 0, yx = 0, yy = 0, yz = 0, zx = 0, zy = 0, zz = 0] = gradient;
  const mean = (xx + yy + zz) / 3;
  const normal = (xx - mean) ** 2 + (yy - mean) ** 2 + (zz - mean) ** 2;
  const shear = ((xy + yx) ** 2 + (xz + zx) ** 2 + (yz + zy) ** 2) / 2;
  return 2 * mu * Math.sqrt(1.5 * (normal + shear));
}
