/** Chooses where the sphere of several faces is opened to become a plane: in the middle of its largest part without a face. */
import { cross, dot, lengthOf, minus, plus, scaled, type Vector } from "../base/vectors.js";
import { type FittedSurface, frameOf, stereographic } from "./fitted-surface.js";

/** Directions that are tried: squares per edge of a cube. */
const SQUARES = 10;
/** Steps by which the best direction is moved, in radii: from half the distance of the directions. */
const FIRST_STEP = 0.1;
const LAST_STEP = 0.003;

/** A surface as a plane. */
export interface OpenedSurface {
  readonly surface: FittedSurface;
  /** Node from which the sphere is projected: a part of the faces, around which the triangles of the plane leave a hole. */
  readonly pole?: number;
}

/** Faces on a surface. */
export interface FacesOnSurface {
  readonly positionOf: (node: number) => Vector;
  /** Three nodes per triangle. */
  readonly triangles: readonly number[];
  /** Nodes of the rims. */
  readonly rimNodes: ReadonlySet<number>;
}

/**
 * Returns a sphere in the projection from the position that is farthest from all nodes of the faces on it. If the faces cover the
 * whole sphere, this is the node that is farthest from their rims. Returns other surfaces as they are. O(nodes).
 */
export function openedSurface(surface: FittedSurface, faces: FacesOnSurface): OpenedSurface {
  const { sphere } = surface;
  if (sphere === undefined) return { surface };
  const { centre, radius } = sphere;
  const nodes = [...new Set([...faces.triangles, ...faces.rimNodes])];
  const unitOf = (node: number) => unit(minus(faces.positionOf(node), centre));
  const directionOf = new Map(nodes.map((node) => [node, unitOf(node)]));
  const direction = freeDirection([...directionOf.values()]);
  const opened = (from: Vector) => stereographic(centre, radius, scaled(from, -1));
  if (!isCovered(direction, faces.triangles, directionOf)) return { surface: opened(direction) };
  const rim = [...faces.rimNodes].map(unitOf);
  let [pole, least] = [-1, Infinity];
  for (const [node, own] of directionOf) {
    const nearest = rim.reduce((most, other) => Math.max(most, dot(own, other)), -1);
    if (nearest < least) [pole, least] = [node, nearest];
  }
  return { surface: opened(directionOf.get(pole) ?? direction), pole };
}

/** Returns whether one of the triangles is in a direction from the centre. */
function isCovered(
  direction: Vector,
  triangles: readonly number[],
  directionOf: ReadonlyMap<number, Vector>,
): boolean {
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = triangles.slice(t, t + 3).map((node) => directionOf.get(node));
    if (a === undefined || b === undefined || c === undefined || !(dot(direction, a) > 0)) continue;
    const sides = [cross(a, b), cross(b, c), cross(c, a)].map((normal) => dot(normal, direction));
    if (sides.every((side) => side >= 0) || sides.every((side) => side <= 0)) return true;
  }
  return false;
}

/** Returns the direction that is farthest from others. */
function freeDirection(units: readonly Vector[]): Vector {
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
  return best.direction;
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
