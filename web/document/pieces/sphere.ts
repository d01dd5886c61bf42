import type { Quantity } from "../../expressions/quantity";
import { strings } from "../../strings";
import type { Position } from "../position";
import { scaleQuantities, type QuantityPosition } from "../quantity-positions";
import { ShapeBuilder, type Shape } from "../shape";
import { add, cross, scale, unit, zero } from "../vectors";

const names = strings.pieces.patches;

/** Patches along each edge of the cube whose faces cover the sphere. */
const divisions = 3;

/** The outward normals of the faces of a cube. */
const normals: readonly Position[] = [
  [1, 0, 0],
  [-1, 0, 0],
  [0, 1, 0],
  [0, -1, 0],
  [0, 0, 1],
  [0, 0, -1],
];

/**
 * Returns a sphere around the origin. The faces of a cube are projected onto it and divided into nine Coons patches each,
 * within arcs of great circles. Eight octants would be simpler, but their middles would lie 14 % of the radius inside the
 * sphere; the 54 patches lie inside by at most 0.34 % of it.
 */
export function sphere(radius: number): Shape;
export function sphere(radius: Quantity): Shape<QuantityPosition>;
export function sphere(radius: Quantity): Shape<QuantityPosition> {
  const builder = new ShapeBuilder<QuantityPosition>();
  const nodes = new Map<string, number>();
  const arcs = new Map<string, number>();
  /** Returns the point of the sphere in a direction, which is made once. */
  const pointTowards = (direction: Position): number => {
    const along = unit(direction) ?? zero;
    const key = along.map((x) => Math.round(x * 1e6) + 0).join(" ");
    const known = nodes.get(key);
    if (known !== undefined) return known;
    const made = builder.point(scaleQuantities(along, radius));
    nodes.set(key, made);
    return made;
  };
  /** Returns the number of the arc between two directions. */
  const arcBetween = (from: Position, to: Position): number => {
    const [a, b] = [pointTowards(from), pointTowards(to)];
    const key = `${Math.min(a, b)} ${Math.max(a, b)}`;
    const known = arcs.get(key);
    if (known !== undefined) return a < b ? known : -known;
    const [start, end] = a < b ? [a, b] : [b, a];
    const middle = pointTowards(add(unit(from) ?? zero, unit(to) ?? zero));
    const made = builder.line("arc", [start, middle, end]);
    arcs.set(key, made);
    return a < b ? made : -made;
  };
  for (const normal of normals) {
    const [nx, ny, nz] = normal;
    const u: Position = [Math.abs(ny), Math.abs(nz), Math.abs(nx)];
    const v = cross(normal, u);
    const at = (i: number, j: number): Position =>
      add(normal, add(scale(u, gridLine(i)), scale(v, gridLine(j))));
    for (let i = 0; i < divisions; ++i) {
      for (let j = 0; j < divisions; ++j) {
        const corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        const loop = corners.map((from, k) => arcBetween(from, corners[(k + 1) % 4] ?? from));
        builder.patch("coons", [loop], names.numbered("", builder.patches.length + 1).trim());
      }
    }
  }
  return builder.shape;
}

/** Position of a line of the grid on a face of the cube [-1, 1]³: at equal angles from the centre of the sphere. */
const gridLine = (i: number): number => Math.tan((Math.PI / 4) * ((2 * i) / divisions - 1));
