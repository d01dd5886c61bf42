/**
 * Solvers for sparse linear systems in which some unknowns are given: conjugate gradients (Hestenes & Stiefel 1952) for symmetric
 * positive matrices, and BiCGStab (van der Vorst 1992) for others, both preconditioned by the diagonal. Given unknowns keep the
 * value that they have at the start: their rows and columns take no part, so the matrix stays as it is assembled.
 */
import type { SparseMatrix } from "./sparse-matrix";
import { SolveError } from "./problem";

export interface LinearSystem {
  readonly matrix: SparseMatrix;
  readonly rightSide: Float64Array;
  /** Per unknown: 1 if it is given. */
  readonly isGiven: Uint8Array;
}

/** Largest residual, relative to the residual of the start with zeros in place of the unknowns. */
const tolerance = 1e-9;
const maxIterations = 20_000;
/** Cosine of the angle between residual and shadow below which BiCGStab stagnates, and is restarted. */
const breakdown = 1e-8;

/** Solves a symmetric positive system. Replaces `x`, the start, by the solution; returns the number of steps. */
export function conjugateGradients(system: LinearSystem, x: Float64Array): number {
  const { matrix } = system;
  const scale = inverseDiagonal(system);
  const limit = tolerance * referenceNorm(system, x);
  if (limit === 0) return clearFree(system, x);
  const r = residual(system, x);
  const z = scaled(r, scale);
  const p = z.slice();
  const q = new Float64Array(x.length);
  let rz = dot(r, z);
  for (let step = 0; step < maxIterations; ++step) {
    if (norm(r) <= limit) return step;
    matrix.multiply(p, q);
    const alpha = rz / dotFree(p, q, system.isGiven);
    if (!Number.isFinite(alpha)) break;
    addTo(x, alpha, p);
    subtractFree(r, alpha, q, system.isGiven);
    writeScaled(r, scale, z);
    const next = dot(r, z);
    const beta = next / rz;
    rz = next;
    for (let i = 0; i < p.length; ++i) p[i] = (z[i] ?? 0) + beta * (p[i] ?? 0);
  }
  throw new SolveError("not-converged");
}

/** Solves a system that need not be symmetric, as `conjugateGradients` does. */
export function stabilizedBiconjugateGradients(system: LinearSystem, x: Float64Array): number {
  const { matrix, isGiven } = system;
  const scale = inverseDiagonal(system);
  const limit = tolerance * referenceNorm(system, x);
  if (limit === 0) return clearFree(system, x);
  let r = residual(system, x);
  const shadow = r.slice();
  const p = r.slice();
  const [v, t, q, s] = [0, 1, 2, 3].map(() => new Float64Array(x.length)) as [
    Float64Array,
    Float64Array,
    Float64Array,
    Float64Array,
  ];
  let rho = dot(shadow, r);
  for (let step = 0; step < maxIterations; ++step) {
    if (norm(r) <= limit) return step;
    writeScaled(p, scale, q);
    matrix.multiply(q, v);
    const alpha = rho / dotFree(shadow, v, isGiven);
    if (!Number.isFinite(alpha)) break;
    addTo(x, alpha, q);
    subtractFree(r, alpha, v, isGiven);
    if (norm(r) <= limit) return step + 1;
    writeScaled(r, scale, s);
    matrix.multiply(s, t);
    const omega = dotFree(t, r, isGiven) / dotFree(t, t, isGiven);
    addTo(x, omega, s);
    subtractFree(r, omega, t, isGiven);
    const next = dot(shadow, r);
    if (Math.abs(next) <= breakdown * norm(shadow) * norm(r)) {
      r = residual(system, x);
      shadow.set(r);
      p.set(r);
      rho = dot(r, r);
      continue;
    }
    const beta = (next / rho) * (alpha / omega);
    rho = next;
    if (!Number.isFinite(beta)) break;
    for (let i = 0; i < p.length; ++i)
      p[i] = isGiven[i] === 1 ? 0 : (r[i] ?? 0) + beta * ((p[i] ?? 0) - omega * (v[i] ?? 0));
  }
  throw new SolveError("not-converged");
}

/** Returns 1 / diagonal, and 0 for given unknowns and for those without an element. */
function inverseDiagonal({ matrix, isGiven }: LinearSystem): Float64Array {
  return matrix.diagonal().map((entry, i) => (isGiven[i] === 1 || entry === 0 ? 0 : 1 / entry));
}

/** Returns b − A x, with 0 for given unknowns. */
function residual({ matrix, rightSide, isGiven }: LinearSystem, x: Float64Array): Float64Array {
  const r = new Float64Array(x.length);
  matrix.multiply(x, r);
  for (let i = 0; i < r.length; ++i) r[i] = isGiven[i] === 1 ? 0 : (rightSide[i] ?? 0) - (r[i] ?? 0);
  return r;
}

/** Returns the norm of the residual of the given unknowns alone, which does not depend on the start. */
function referenceNorm(system: LinearSystem, x: Float64Array): number {
  return norm(
    residual(
      system,
      x.map((value, i) => (system.isGiven[i] === 1 ? value : 0)),
    ),
  );
}

/** Sets the unknowns that are not given to 0: the solution if the residual without them is 0. Takes no steps. */
function clearFree({ isGiven }: LinearSystem, x: Float64Array): 0 {
  for (let i = 0; i < x.length; ++i) if (isGiven[i] !== 1) x[i] = 0;
  return 0;
}

function dot(a: Float64Array, b: Float64Array): number {
  let sum = 0;
  for (let i = 0; i < a.length; ++i) sum += (a[i] ?? 0) * (b[i] ?? 0);
  return sum;
}

/** Returns the product over the unknowns that are not given. */
function dotFree(a: Float64Array, b: Float64Array, isGiven: Uint8Array): number {
  let sum = 0;
  for (let i = 0; i < a.length; ++i) if (isGiven[i] !== 1) sum += (a[i] ?? 0) * (b[i] ?? 0);
  return sum;
}

const norm = (a: Float64Array): number => Math.sqrt(dot(a, a));

function scaled(a: Float64Array, scale: Float64Array): Float64Array {
  const out = new Float64Array(a.length);
  writeScaled(a, scale, out);
  return out;
}

function writeScaled(a: Float64Array, scale: Float64Array, out: Float64Array): void {
  for (let i = 0; i < a.length; ++i) out[i] = (a[i] ?? 0) * (scale[i] ?? 0);
}

/** Adds `factor` times a vector that is zero where unknowns are given. */
function addTo(a: Float64Array, factor: number, b: Float64Array): void {
  for (let i = 0; i < a.length; ++i) a[i] = (a[i] ?? 0) + factor * (b[i] ?? 0);
}

function subtractFree(a: Float64Array, factor: number, b: Float64Array, isGiven: Uint8Array): void {
  for (let i = 0; i < a.length; ++i) if (isGiven[i] !== 1) a[i] = (a[i] ?? 0) - factor * (b[i] ?? 0);
}
