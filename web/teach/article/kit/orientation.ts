/** The exact sign of the volume of a tetrahedron: the one question on which the topology of a mesh depends. */
import type { Position } from "../../../document/position";
import { cross, dot, subtract } from "../../../document/vectors";

/** A bound on the rounding error of the determinant, as a share of the sum of its absolute terms (J. R. Shewchuk, 1997). */
const errorShare = 8 * Number.EPSILON;

/**
 * Returns 1 if d is on the side of the plane through a, b and c from which they are counter-clockwise, −1 if it is on the other
 * side, and 0 if all four lie in one plane. The answer is exact: if rounding could change it, it is computed again with
 * integers.
 */
export function orientation(a: Position, b: Position, c: Position, d: Position): -1 | 0 | 1 {
  const [u, v, w] = [subtract(b, a), subtract(c, a), subtract(d, a)];
  const volume = dot(cross(u, v), w);
  const terms =
    (Math.abs(u[1] * v[2]) + Math.abs(u[2] * v[1])) * Math.abs(w[0]) +
    (Math.abs(u[2] * v[0]) + Math.abs(u[0] * v[2])) * Math.abs(w[1]) +
    (Math.abs(u[0] * v[1]) + Math.abs(u[1] * v[0])) * Math.abs(w[2]);
  if (Math.abs(volume) > errorShare * terms) return volume > 0 ? 1 : -1;
  return signOf(exactVolume(a, b, c, d));
}

const signOf = (value: bigint): -1 | 0 | 1 => (value > 0n ? 1 : value < 0n ? -1 : 0);

function exactVolume(a: Position, b: Position, c: Position, d: Position): bigint {
  const from = (p: Position): readonly [bigint, bigint, bigint] => [
    integerOf(p[0]) - integerOf(a[0]),
    integerOf(p[1]) - integerOf(a[1]),
    integerOf(p[2]) - integerOf(a[2]),
  ];
  const [u, v, w] = [from(b), from(c), from(d)];
  return (
    (u[1] * v[2] - u[2] * v[1]) * w[0] +
    (u[2] * v[0] - u[0] * v[2]) * w[1] +
    (u[0] * v[1] - u[1] * v[0]) * w[2]
  );
}

const view = new DataView(new ArrayBuffer(8));

/** Returns a number times 2¹⁰⁷⁴, which is an integer for every finite number. */
function integerOf(value: number): bigint {
  view.setFloat64(0, value);
  const bits = view.getBigUint64(0);
  const exponent = (bits >> 52n) & 0x7ffn;
  const fraction = bits & 0xfffffffffffffn;
  const size = exponent === 0n ? fraction : (fraction | (1n << 52n)) << (exponent - 1n);
  return value < 0 ? -size : size;
}
