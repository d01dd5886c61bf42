/** Finds the plane, cylinder, cone or sphere on which the nodes of a triangulated face lie. */
import { LeastSquares, smallestEigenvector } from "../base/linear-algebra.js";
import {
  type Corners,
  cross,
  dot,
  lengthOf,
  minus,
  normalOf,
  plus,
  scaled,
  type Vector,
} from "../base/vectors.js";

/** Coordinates on a surface, in lengths: `u` along circles of a round surface, `v` along its rulings. */
export type Uv = readonly [u: number, v: number];

export interface FittedSurface {
  readonly kind: "plane" | "cylinder" | "cone" | "sphere";
  /** Of spheres. */
  readonly sphere?: Sphere;
  /** Length after which `u` repeats; 0 if it does not. */
  readonly period: number;
  /** Returns the distance of a position. */
  distance(p: Vector): number;
  /** Returns the coordinates of the point of the surface below a position; `u` is from 0 to `period`. */
  uv(p: Vector): Uv;
  at(uv: Uv): Vector;
  /** Returns a vector across the surface at a position: away from the axis or the centre; for planes, the same everywhere. */
  outward(p: Vector): Vector;
}

/** A direction and two perpendicular to it and to each other; all of length 1, right-handed in the order x, y, axis. */
export interface Frame {
  readonly x: Vector;
  readonly y: Vector;
  readonly axis: Vector;
}

export function frameOf(direction: Vector): Frame {
  const axis = scaled(direction, 1 / lengthOf(direction));
  const least = [0, 1, 2].reduce(
    (best, k) => (Math.abs(axis[k] ?? 0) < Math.abs(axis[best] ?? 0) ? k : best),
    0,
  );
  const across = cross(axis, [Number(least === 0), Number(least === 1), Number(least === 2)]);
  const x = scaled(across, 1 / lengthOf(across));
  return { x, y: cross(axis, x), axis };
}

/** Tangent of an eighth of a right angle's double: of 22.5 degrees. */
const EIGHTH = Math.SQRT2 - 1;

/**
 * Returns the direction of (x, y) as a number from 0 to 4 that grows with its angle, and nearly as fast everywhere: the tangent
 * of half the angle from the nearest axis. Unlike the angle, it is the same on all machines.
 */
export function turnOf(x: number, y: number): number {
  const isAlongX = Math.abs(x) >= Math.abs(y);
  const quarter = isAlongX ? (x >= 0 ? 0 : 2) : y >= 0 ? 1 : 3;
  const [along, across] = [
    [x, y],
    [y, -x],
    [-x, -y],
    [-y, x],
  ][quarter] as [number, number];
  const length = Math.sqrt(along * along + across * across);
  const turn = length > 0 ? quarter + across / (length + along) / (2 * EIGHTH) : 0;
  return turn < 0 ? turn + 4 : turn;
}

/** Returns the unit vector in a direction that `turnOf` has given. */
export function directionAt(turn: number): readonly [x: number, y: number] {
  const quarter = Math.round(turn);
  const t = (turn - quarter) * 2 * EIGHTH;
  const [cosine, sine] = [(1 - t * t) / (1 + t * t), (2 * t) / (1 + t * t)];
  const turned = [
    [cosine, sine],
    [-sine, cosine],
    [-cosine, -sine],
    [sine, -cosine],
  ][((quarter % 4) + 4) % 4];
  return turned as [number, number];
}

/** Smallest number of nodes for which a fit means something: more than a surface has parameters. */
const MIN_NODES = { cylinder: 6, cone: 8, sphere: 8 } as const;

/**
 * Returns the surface within `tolerance` of all nodes of a face; undefined if there is none. `triangles`: those of the face,
 * which may be coarse.
 */
export function fittedSurface(
  nodes: readonly Vector[],
  triangles: readonly Corners[],
  tolerance: number,
): FittedSurface | undefined {
  const isOn = (surface: FittedSurface | undefined): surface is FittedSurface =>
    surface !== undefined && nodes.every((p) => surface.distance(p) <= tolerance);
  const [some, pieces] = [sampleOf(nodes), sampleOf(triangles)];
  const plane = planeOf(pieces);
  if (isOn(plane)) return plane;
  const { cylinder, cone, sphere } = MIN_NODES;
  const axis = axisOf(pieces);
  const cylinderFit = nodes.length >= cylinder ? revolved(some, axis, false) : undefined;
  if (isOn(cylinderFit)) return cylinderFit;
  // Two circles of nodes with one axis are on a sphere, too: as a face, they are much more often a cone.
  const coneFit = nodes.length >= cone ? revolved(some, axis, true) : undefined;
  if (isOn(coneFit)) return coneFit;
  const sphereFit = nodes.length >= sphere ? sphereOf(some) : undefined;
  return isOn(sphereFit) ? sphereFit : undefined;
}

/** Largest number of nodes or triangles that determine a surface; all nodes are compared with it. */
const SAMPLE = 1000;

function sampleOf<Item>(items: readonly Item[]): readonly Item[] {
  // Odd, because nodes may alternate between two curves.
  const step = Math.ceil(items.length / SAMPLE) | 1;
  return step <= 1 ? items : items.filter((_, i) => i % step === 0);
}

function planeOf(triangles: readonly Corners[]): FittedSurface | undefined {
  let normal: Vector = [0, 0, 0];
  let [moment, weight]: [Vector, number] = [[0, 0, 0], 0];
  for (const corners of triangles) {
    const own = normalOf(corners);
    const area = lengthOf(own);
    normal = plus(normal, own);
    moment = plus(moment, scaled(corners.reduce(plus), area / 3));
    weight += area;
  }
  if (!(lengthOf(normal) > 0)) return undefined;
  const origin = scaled(moment, 1 / weight);
  const { x, y, axis } = frameOf(normal);
  return {
    kind: "plane",
    period: 0,
    distance: (p) => Math.abs(dot(minus(p, origin), axis)),
    uv: (p) => [dot(minus(p, origin), x), dot(minus(p, origin), y)],
    at: ([u, v]) => plus(origin, plus(scaled(x, u), scaled(y, v))),
    outward: () => axis,
  };
}

/** Returns the direction to which all normals have the same angle, as those of a cylinder or cone. */
function axisOf(triangles: readonly Corners[]): Vector {
  const normals = triangles.map(normalOf);
  const total = normals.reduce((sum, normal) => sum + lengthOf(normal), 0);
  const mean = scaled(normals.reduce(plus, [0, 0, 0]), 1 / total);
  const spread = [0, 1, 2].map(() => [0, 0, 0]);
  for (const normal of normals) {
    const weight = lengthOf(normal);
    if (!(weight > 0)) continue;
    const d = minus(scaled(normal, 1 / weight), mean);
    spread.forEach((row, i) =>
      row.forEach((value, j) => (row[j] = value + weight * (d[i] ?? 0) * (d[j] ?? 0))),
    );
  }
  return smallestEigenvector(spread);
}

const ITERATIONS = 20;

/** Change of a position, relative to the size, below which an iteration ends. */
const CONVERGED = 1e-15;

/**
 * Fits a cylinder, or a cone, to nodes by the Gauss-Newton method: the distance from the axis is a linear function of the
 * position along it.
 */
function revolved(nodes: readonly Vector[], start: Vector, isCone: boolean): FittedSurface | undefined {
  const origin = scaled(nodes.reduce(plus, [0, 0, 0]), 1 / nodes.length);
  const size = nodes.reduce((most, p) => Math.max(most, lengthOf(minus(p, origin))), 0);
  const local = nodes.map((p) => scaled(minus(p, origin), 1 / size));
  let frame = frameOf(start);
  const first = circleIn(local.map((p) => [dot(p, frame.x), dot(p, frame.y)]));
  if (first === undefined) return undefined;
  let [centreX, centreY, radius] = first;
  let slope = 0;
  for (let round = 0; round < ITERATIONS; round++) {
    const system = new LeastSquares(isCone ? 6 : 5);
    for (const p of local) {
      const z = dot(p, frame.axis);
      const [x, y] = [dot(p, frame.x) - centreX, dot(p, frame.y) - centreY];
      const rho = Math.sqrt(x * x + y * y);
      if (!(rho > 0)) return undefined;
      const [cosine, sine] = [x / rho, y / rho];
      const lever = z + slope * rho;
      const factors = [cosine, sine, 1, lever * cosine, lever * sine];
      if (isCone) factors.push(z);
      system.add(factors, rho - radius - slope * z);
    }
    const step = system.solution();
    if (step === undefined) return undefined;
    const [dx = 0, dy = 0, dr = 0, tx = 0, ty = 0, dk = 0] = step;
    // The centre stays where the axis passes the plane through the mean of the nodes.
    const moved = plus(scaled(frame.x, centreX + dx), scaled(frame.y, centreY + dy));
    frame = frameOf(plus(frame.axis, plus(scaled(frame.x, tx), scaled(frame.y, ty))));
    [centreX, centreY] = [dot(moved, frame.x), dot(moved, frame.y)];
    radius += dr;
    slope += dk;
    if (step.every((part) => Math.abs(part) <= CONVERGED)) break;
  }
  if (!(radius > 0) || !Number.isFinite(radius + slope)) return undefined;
  const onAxis = plus(scaled(frame.x, centreX), scaled(frame.y, centreY));
  return surfaceOfRevolution(plus(origin, scaled(onAxis, size)), frame, radius * size, slope);
}

/** Returns the centre and radius of the circle nearest to positions in a plane, by the algebraic distance. */
function circleIn(
  positions: readonly (readonly [number, number])[],
): readonly [number, number, number] | undefined {
  const system = new LeastSquares(3);
  for (const [x, y] of positions) system.add([2 * x, 2 * y, 1], x * x + y * y);
  const [x = 0, y = 0, c = 0] = system.solution() ?? [];
  const squared = c + x * x + y * y;
  return squared > 0 ? [x, y, Math.sqrt(squared)] : undefined;
}

function surfaceOfRevolution(origin: Vector, frame: Frame, radius: number, slope: number): FittedSurface {
  const { x, y, axis } = frame;
  const slant = Math.sqrt(1 + slope * slope);
  // A right angle is one turn.
  const perTurn = (radius * Math.PI) / 2;
  const split = (p: Vector) => {
    const d = minus(p, origin);
    return { z: dot(d, axis), a: dot(d, x), b: dot(d, y) };
  };
  return {
    kind: slope === 0 ? "cylinder" : "cone",
    period: 4 * perTurn,
    distance: (p) => {
      const { z, a, b } = split(p);
      const expected = radius + slope * z;
      // The other half of a double cone is not part of the surface.
      return expected > 0 ? Math.abs(Math.sqrt(a * a + b * b) - expected) / slant : Infinity;
    },
    uv: (p) => {
      const { z, a, b } = split(p);
      return [turnOf(a, b) * perTurn, z * slant];
    },
    at: ([u, v]) => {
      const [cosine, sine] = directionAt(u / perTurn);
      const z = v / slant;
      const rho = radius + slope * z;
      return plus(origin, plus(scaled(axis, z), plus(scaled(x, rho * cosine), scaled(y, rho * sine))));
    },
    outward: (p) => {
      const d = minus(p, origin);
      return minus(d, scaled(axis, dot(d, axis)));
    },
  };
}

function sphereOf(nodes: readonly Vector[]): FittedSurface | undefined {
  const sphere = fittedSphere(nodes);
  if (sphere === undefined) return undefined;
  const { centre, radius } = sphere;
  const mean = scaled(nodes.reduce(plus, [0, 0, 0]), 1 / nodes.length);
  const outward = minus(mean, centre);
  return stereographic(centre, radius, lengthOf(outward) > 0 ? outward : [0, 0, 1]);
}

export interface Sphere {
  readonly centre: Vector;
  readonly radius: number;
}

/** Returns the sphere nearest to positions, by the algebraic distance; undefined if they do not determine one. */
export function fittedSphere(nodes: readonly Vector[]): Sphere | undefined {
  const mean = scaled(nodes.reduce(plus, [0, 0, 0]), 1 / nodes.length);
  const system = new LeastSquares(4);
  for (const p of nodes) {
    const d = minus(p, mean);
    system.add([2 * d[0], 2 * d[1], 2 * d[2], 1], dot(d, d));
  }
  const [x, y, z, c] = system.solution() ?? [];
  if (x === undefined || y === undefined || z === undefined || c === undefined) return undefined;
  const radius = Math.sqrt(c + x * x + y * y + z * z);
  return radius > 0 ? { centre: plus(mean, [x, y, z]), radius } : undefined;
}

/** Coordinates are those of the projection from the point of the sphere opposite to `direction`: circles stay circles. */
export function stereographic(centre: Vector, radius: number, direction: Vector): FittedSurface {
  const { x, y, axis } = frameOf(direction);
  return {
    kind: "sphere",
    sphere: { centre, radius },
    period: 0,
    distance: (p) => Math.abs(lengthOf(minus(p, centre)) - radius),
    uv: (p) => {
      const d = minus(p, centre);
      const unit = scaled(d, 1 / lengthOf(d));
      const factor = (2 * radius) / Math.max(1 + dot(unit, axis), Number.EPSILON);
      return [factor * dot(unit, x), factor * dot(unit, y)];
    },
    at: ([u, v]) => {
      const [a, b] = [u / (2 * radius), v / (2 * radius)];
      const squared = a * a + b * b;
      const rim = plus(scaled(x, 2 * a), scaled(y, 2 * b));
      return plus(centre, scaled(plus(rim, scaled(axis, 1 - squared)), radius / (1 + squared)));
    },
    outward: (p) => minus(p, centre),
  };
}
