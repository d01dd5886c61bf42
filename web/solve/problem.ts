/**
 * Problems that the app solves on a mesh, as an example of a solver that uses the package: linear elements, one material,
 * conditions per patch. Lengths are those of the mesh; all other units are the caller's.
 */

/** The part of a mesh that a problem needs. Triangles that no condition names may be missing. */
export interface SolvedMesh {
  /** x y z per node. */
  readonly points: Float64Array;
  /** Four node indices per element, with positive volume. */
  readonly tetrahedra: Uint32Array;
  /** Three node indices per triangle. */
  readonly triangles: Uint32Array;
  /** Per triangle: index of its patch. */
  readonly trianglePatch: Uint32Array;
}

export type Vector = readonly [x: number, y: number, z: number];

/** A given value, or a given inward flux per unit of area. Of several values at a node, that of the patch with the largest index counts. */
export interface ScalarCondition {
  readonly kind: "value" | "flux";
  readonly value: number;
}

/** No displacement, or a given force per unit of area. */
export type ElasticCondition =
  | { readonly kind: "fixed" }
  | { readonly kind: "traction"; readonly traction: Vector };

/** −∇·(conductivity ∇T) = source. */
export interface HeatProblem {
  readonly kind: "heat";
  readonly conductivity: number;
  readonly source: number;
  /** By index of the patch. Patches without one have no flux. */
  readonly conditions: ReadonlyMap<number, ScalarCondition>;
}

/** velocity·∇c − ∇·(diffusivity ∇c) = source, with a constant velocity. */
export interface AdvectionProblem {
  readonly kind: "advection";
  readonly diffusivity: number;
  readonly velocity: Vector;
  readonly source: number;
  /** By index of the patch. Patches without one have no diffusive flux. */
  readonly conditions: ReadonlyMap<number, ScalarCondition>;
}

/** Small displacements of an isotropic elastic body. */
export interface ElasticityProblem {
  readonly kind: "elasticity";
  readonly youngsModulus: number;
  /** Above −1 and below 0.5. */
  readonly poissonRatio: number;
  /** Force per unit of volume. */
  readonly bodyForce: Vector;
  /** By index of the patch. Patches without one are free. */
  readonly conditions: ReadonlyMap<number, ElasticCondition>;
}

export type Problem = HeatProblem | AdvectionProblem | ElasticityProblem;
export type ProblemKind = Problem["kind"];

/** Values at the nodes: all components of the first node, then those of the next. */
export interface NodeField {
  readonly name: string;
  readonly components: number;
  readonly values: Float64Array<ArrayBuffer>;
}

/** The solution of a problem: first the unknown, then what follows from it. */
export interface ProblemSolution {
  readonly fields: readonly NodeField[];
  /** Steps of the iterative solver. */
  readonly iterations: number;
}

/**
 * Why a problem has no solution, or none that was found. The app has a sentence for each. `not-held`: a connected piece of the mesh
 * has no given value, so that every constant can be added to a solution, or the piece can move.
 */
const failures = ["no-elements", "not-held", "bad-material", "not-converged"] as const;
export type SolveFailure = (typeof failures)[number];

export const isSolveFailure = (text: string): text is SolveFailure =>
  failures.some((failure) => failure === text);

export class SolveError extends Error {
  readonly failure: SolveFailure;

  constructor(failure: SolveFailure) {
    super(failure);
    this.name = "SolveError";
    this.failure = failure;
  }
}

/** Names of the fields of a solution: those of files, not of the app. */
export const fieldNames = {
  heat: ["temperature", "heat flux"],
  advection: ["concentration"],
  elasticity: ["displacement", "von Mises stress"],
} as const satisfies Readonly<Record<ProblemKind, readonly string[]>>;
