/** Exact arithmetic on doubles: every finite double is an integer times a power of two. */

const view = new DataView(new ArrayBuffer(8));

/** value = mantissa × 2^exponent. */
function split(value: number): { mantissa: bigint; exponent: number } {
  view.setFloat64(0, value);
  const bits = view.getBigUint64(0);
  const biased = Number((bits >> 52n) & 0x7ffn);
  const fraction = bits & 0xfffffffffffffn;
  const magnitude = biased === 0 ? fraction : fraction | 0x10000000000000n;
  return { mantissa: bits >> 63n === 1n ? -magnitude : magnitude, exponent: Math.max(biased, 1) - 1075 };
}

/** Scales all values by the same power of two, so that they become integers. */
function scaledIntegers(values: readonly number[]): bigint[] {
  const parts = values.map(split);
  const least = Math.min(
    ...parts.filter(({ mantissa }) => mantissa !== 0n).map(({ exponent }) => exponent),
    0,
  );
  return parts.map(({ mantissa, exponent }) => (mantissa === 0n ? 0n : mantissa << BigInt(exponent - least)));
}

/** Upper bound of the rounding error of the determinant below, relative to its permanent. */
const FILTER = 1e-14;

/** Returns the exact sign of (b-a) × (c-a) · (d-a) for the nodes a, b, c, d: 1, 0 or -1. */
export function orientation(points: Float64Array, nodes: readonly [number, number, number, number]): number {
  const p = nodes.flatMap((node) => [0, 1, 2].map((axis) => points[3 * node + axis] ?? NaN));
  const edge = (k: number, axis: number) => (p[3 * k + axis] ?? NaN) - (p[axis] ?? NaN);
  let det = 0;
  let permanent = 0;
  for (const [i, j, k, sign] of PERMUTATIONS) {
    const product = edge(1, i) * edge(2, j) * edge(3, k);
    det += sign * product;
    permanent += Math.abs(product);
  }
  return Math.abs(det) > FILTER * permanent ? Math.sign(det) : exactOrientation(p);
}

const PERMUTATIONS: readonly (readonly [number, number, number, 1 | -1])[] = [
  [0, 1, 2, 1],
  [1, 2, 0, 1],
  [2, 0, 1, 1],
  [0, 2, 1, -1],
  [2, 1, 0, -1],
  [1, 0, 2, -1],
];

function exactOrientation(coordinates: readonly number[]): number {
  const integers = scaledIntegers(coordinates);
  const edge = (k: number, axis: number) => (integers[3 * k + axis] ?? 0n) - (integers[axis] ?? 0n);
  const det = PERMUTATIONS.reduce(
    (sum, [i, j, k, sign]) => sum + BigInt(sign) * edge(1, i) * edge(2, j) * edge(3, k),
    0n,
  );
  return det > 0n ? 1 : det < 0n ? -1 : 0;
}
