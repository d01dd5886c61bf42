/** Small dense systems and symmetric matrices. Only sums, products, quotients and roots: the same on all machines. */
import type { Vector } from "./vectors.js";

/** Solves a system of equations by elimination with pivots; undefined if it is singular. */
export function solved(
  matrix: readonly (readonly number[])[],
  right: readonly number[],
): number[] | undefined {
  const rows = matrix.map((row, i) => [...row, right[i] ?? 0]);
  const count = rows.length;
  for (let k = 0; k < count; k++) {
    let pivot = k;
    for (let i = k + 1; i < count; i++)
      if (Math.abs(rows[i]?.[k] ?? 0) > Math.abs(rows[pivot]?.[k] ?? 0)) pivot = i;
    const [chosen = [], other = []] = [rows[pivot], rows[k]];
    [rows[k], rows[pivot]] = [chosen, other];
    const head = chosen[k] ?? 0;
    if (!(Math.abs(head) > 0)) return undefined;
    for (let i = k + 1; i < count; i++) {
      const row = rows[i] ?? [];
      const factor = (row[k] ?? 0) / head;
      for (let j = k; j <= count; j++) row[j] = (row[j] ?? 0) - factor * (chosen[j] ?? 0);
    }
  }
  const result = new Array<number>(count).fill(0);
  for (let k = count - 1; k >= 0; k--) {
    const row = rows[k] ?? [];
    let sum = row[count] ?? 0;
    for (let j = k + 1; j < count; j++) sum -= (row[j] ?? 0) * (result[j] ?? 0);
    result[k] = sum / (row[k] ?? 1);
  }
  return result.every(Number.isFinite) ? result : undefined;
}

/** Adds up the normal equations of a least-squares problem, row by row. */
export class LeastSquares {
  readonly #matrix: number[][];
  readonly #right: number[];

  constructor(unknowns: number) {
    this.#matrix = Array.from({ length: unknowns }, () => new Array<number>(unknowns).fill(0));
    this.#right = new Array<number>(unknowns).fill(0);
  }

  /** Adds the equation "sum of factors times unknowns = value". */
  add(factors: readonly number[], value: number): void {
    factors.forEach((factor, i) => {
      const row = this.#matrix[i];
      if (row === undefined) return;
      factors.forEach((other, j) => (row[j] = (row[j] ?? 0) + factor * other));
      this.#right[i] = (this.#right[i] ?? 0) + factor * value;
    });
  }

  solution(): number[] | undefined {
    return solved(this.#matrix, this.#right);
  }
}

/** Sweeps of Jacobi's method: it converges quadratically. */
const SWEEPS = 12;

/** Returns the unit eigenvector of the smallest eigenvalue of a symmetric matrix, by Jacobi's method. */
export function smallestEigenvector(symmetric: readonly (readonly number[])[]): Vector {
  const a = symmetric.map((row) => [...row]);
  const vectors = [0, 1, 2].map((i) => [0, 1, 2].map((j) => Number(i === j)));
  const at = (m: readonly number[][], i: number, j: number) => m[i]?.[j] ?? 0;
  const put = (m: readonly number[][], i: number, j: number, value: number) => {
    const row = m[i];
    if (row !== undefined) row[j] = value;
  };
  for (let sweep = 0; sweep < SWEEPS; sweep++) {
    for (const [p, q] of [
      [0, 1],
      [0, 2],
      [1, 2],
    ] as const) {
      if (at(a, p, q) === 0) continue;
      const half = (at(a, q, q) - at(a, p, p)) / (2 * at(a, p, q));
      const tangent = (half >= 0 ? 1 : -1) / (Math.abs(half) + Math.sqrt(half * half + 1));
      const cosine = 1 / Math.sqrt(tangent * tangent + 1);
      const sine = tangent * cosine;
      const rotate = (m: readonly number[][], isColumn: boolean) => {
        for (let k = 0; k < 3; k++) {
          const [x, y] = isColumn ? [at(m, k, p), at(m, k, q)] : [at(m, p, k), at(m, q, k)];
          const [u, v] = [cosine * x - sine * y, sine * x + cosine * y];
          put(m, isColumn ? k : p, isColumn ? p : k, u);
          put(m, isColumn ? k : q, isColumn ? q : k, v);
        }
      };
      rotate(a, true);
      rotate(a, false);
      rotate(vectors, true);
    }
  }
  const least = [0, 1, 2].reduce((best, i) => (at(a, i, i) < at(a, best, best) ? i : best), 0);
  return [at(vectors, 0, least), at(vectors, 1, least), at(vectors, 2, least)];
}
