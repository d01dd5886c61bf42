/**
 * Estimates the interpolation error of fields on the elements of a mesh. On an element with edges e, linear interpolation of a
 * quadratic function with second derivatives H has the error Σ λi λj eᵀ H e / 2 over the edges, in barycentric coordinates. Its
 * norm is that of a regular element, with the mean of eᵀ |H| e over the six edges in place of the squared length.
 */
import { type Steps, stepwise } from "../base/steps.js";
import { minus, pointOf } from "../base/vectors.js";
import { inSteps } from "../calls/yielder.js";
import type { RunControl } from "../engine/control.js";
import { sixfoldVolume } from "../formats/sixfold-volume.js";
import { type ErrorNorm, MAX_LENGTH } from "../generated/constants.js";
import type { VolumeInput } from "../mesh/mesh.js";
import type { FieldValues } from "../mesh/solution.js";
import type { Mesher } from "./mesher-interface.js";
import { MAX_ASPECT } from "./solution-options.js";

/** Power of each norm, and its error of |x|² / 2 on a regular tetrahedron with edges 1 and volume 1. */
const NORMS: Readonly<Record<ErrorNorm, { readonly power: number; readonly unitError: number }>> = {
  l1: { power: 1, unitError: 3 / 20 },
  l2: { power: 2, unitError: Math.sqrt(13 / 560) },
  l4: { power: 4, unitError: Math.sqrt(Math.sqrt(109 / 184800)) },
  max: { power: Infinity, unitError: 3 / 16 },
};

/** Largest error for which the metric of `sizeFromSolution` is |H| itself. */
const UNIT_ERROR = 3 / 16;

/** What is estimated. */
interface Estimated {
  readonly fields: readonly FieldValues[];
  readonly norm: ErrorNorm;
  /** Name of the field that is the error itself. */
  readonly indicator?: string | undefined;
}

/** Returns the estimated error of each field; 0 for a linear field. Of the indicator, the largest value. */
export async function estimatedErrors(
  mesher: Pick<Mesher, "sizeFromSolution">,
  mesh: VolumeInput,
  { fields, norm, indicator }: Estimated,
  controlOf: () => RunControl,
): Promise<number[]> {
  const errors: number[] = [];
  const unlimited = {
    error: UNIT_ERROR,
    norm: "max",
    growth: Infinity,
    maxSize: MAX_LENGTH,
    maxAspect: MAX_ASPECT,
  } as const;
  for (const field of fields) {
    const control = controlOf();
    if (field.name === indicator) {
      errors.push(field.values.reduce((largest, value) => Math.max(largest, value), 0));
      continue;
    }
    const { metrics, diagnostics } = await mesher.sizeFromSolution(mesh, [field], unlimited, control);
    const isLinear = diagnostics.some(({ code }) => code === "constant-field");
    errors.push(isLinear ? 0 : await inSteps(errorNorm(mesh, metrics, norm), control.signal));
  }
  return errors;
}

/** Returns the norm of the error over all elements; `hessians`: xx xy xz yy yz zz of |H| per node. */
function* errorNorm(mesh: VolumeInput, hessians: Float64Array, norm: ErrorNorm): Steps<number> {
  const { points, tetrahedra } = mesh;
  const { power, unitError } = NORMS[norm];
  let sum = 0;
  yield* stepwise(tetrahedra.length / 4, (t) => {
    const corners = tetrahedra.subarray(4 * t, 4 * t + 4);
    const error = unitError * meanSquare(points, hessians, corners);
    if (power === Infinity) {
      sum = Math.max(sum, error);
      return;
    }
    const [a = 0, b = 0, c = 0, d = 0] = corners;
    sum += (Math.abs(sixfoldVolume(points, a, b, c, d).volume) / 6) * error ** power;
  });
  return power === Infinity ? sum : sum ** (1 / power);
}

/** Returns the mean of eᵀ H e over the edges of an element, where H is the mean over its corners. */
function meanSquare(points: Float64Array, hessians: Float64Array, corners: Uint32Array): number {
  const mean = (entry: number) => {
    let sum = 0;
    for (const node of corners) sum += hessians[6 * node + entry] ?? 0;
    return sum / 4;
  };
  const [xx, xy, xz, yy, yz, zz] = [mean(0), mean(1), mean(2), mean(3), mean(4), mean(5)] as const;
  let sum = 0;
  for (let i = 0; i < 4; i++) {
    for (let j = i + 1; j < 4; j++) {
      const [x, y, z] = minus(pointOf(points, corners[j] ?? 0), pointOf(points, corners[i] ?? 0));
      sum += xx * x * x + yy * y * y + zz * z * z + 2 * (xy * x * y + xz * x * z + yz * y * z);
    }
  }
  return sum / 6;
}
