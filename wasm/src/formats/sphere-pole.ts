/** Chooses where the sphere of several faces is opened to become a plane: in the middle of its largest part without a face. */
import { cross, dot, lengthOf, minus, plus, scaled, type Vector } from "../base/vectors.js";
import { type FittedSurface, frameOf, stereographic } from "./fitted-surface.js";

/** Directions that are tried: squares per edge of a cube. */
const SQUARES = 10;
/** Steps by which the best direction is moved, in radii: from half the distance of the directions. */
const FIRST_STEP = 0.1;
const LAST_STEP = 0.003;

/**
 * Returns a sphere in the projection from the position that is farthest from all nodes of the faces on it; other surfaces
 * as they are. O(nodes).
 */
export function openedSurface(surface: FittedSurface, nodes: readonly Vector[]): FittedSurface {
  const { sphere } = surface;
  if (sphere === undefined) return surface;
  const { centre, radius } = sphere;
  const units = nodes.map((p) => unit(minus(p, centre)));
  const nearest = (direction: Vector) =>
    units.reduce((most, other) => Math.max(most, dot(other, direction)), -1);
  let best = { direction: [0, 0, 1] as Vector, cosine: Infinity };
  const offer = (direction: Vector): boolean => {
    const cosine = nearest(direction);
    const isBetter = cosine < best.cosine;
    if (isBetter) best = { direction, cosine };
    return isBetter;
  };
  for (const direction of directions()) offer(direction);
  for (let step = FIRST_STEP; step > LAST_STEP;) {
    const { x, y } = frameOf(best.direction);
    const from = best.direction;
    const isBetter = [x, y, scaled(x, -1), scaled(y, -1)]
      .map((way) => offer(unit(plus(from, scaled(way, step)))))
      .some(Boolean);
    if (!isBetter) step /= 2;
  }
  return stereographic(centre, radius, scaled(best.direction, -1));
}

const unit = (v: Vector): Vector => scaled(v, 1 / lengthOf(v));

/** Yields directions through the middles of the squares of a cube. */
function* directions(): Generator<Vector> {
  const axes: readonly Vector[] = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  for (const [k, axis] of axes.entries()) {
    const across = axes[(k + 1) % 3] ?? axis;
    const up = cross(axis, across);
    for (let i = 0; i < SQUARES * SQUARES; i++) {
      const [a, b] = [i % SQUARES, Math.floor(i / SQUARES)].map((n) => (2 * n + 1) / SQUARES - 1);
      const direction = unit(plus(axis, plus(scaled(across, a ?? 0), scaled(up, b ?? 0))));
      yield direction;
      yield scaled(direction, -1);
    }
  }
}
