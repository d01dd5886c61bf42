/**
 * Gives balls the triangles of the faces in which they are seated: sockets, caps, cups and rings of other solids on the same sphere.
 * A ball is a solid whose faces all lie on one sphere, wherever its poles and its seam are. It gets the triangles of its seats; the
 * rest of the sphere is triangulated in a stereographic projection from a point in a seat, so that circles stay circles.
 */
import { PAUSE, type Steps } from "../base/steps.js";
import { centroidOf, cornersOf, cross, dot, lengthOf, minus, pointOf, type Vector } from "../base/vectors.js";
import { constrainedTriangles, CrossingConstraints } from "./constrained-triangulation.js";
import { facesOutward } from "./face-groups.js";
import { fittedSphere, type Sphere, stereographic } from "./fitted-surface.js";
import { GrowingNodes } from "./growing-nodes.js";
import type { JoinedShapes } from "./joined-shapes.js";
import { directedKey, type FacesAndRims, type ShapeRange } from "./rims.js";
import { type Segment, trianglesWithin } from "./unrolled-group.js";

/** Smallest number of nodes of a ball: OpenCascade makes hundreds. */
const MIN_NODES = 20;
/** Largest part of a sphere's volume that the triangles of a ball lack. */
const MISSING = 0.05;
/** Distance of nodes / mean length of edges, below which one of two is left out. */
const SPACING = 0.5;

interface Ball extends Sphere {
  /** Range of its triangles. */
  readonly begin: number;
  readonly end: number;
}

/** New triangles of a ball, with the face of each. */
interface NewBall {
  readonly ball: Ball;
  readonly triangles: Uint32Array;
  readonly faces: Uint32Array;
}

/**
 * Returns the shapes with balls that have the triangles of their seats; the given ones if there are none. `found`: the faces of the
 * other shapes. `tolerance`: of the spheres.
 */
export function* withSeatedBalls(
  joined: JoinedShapes,
  { faces }: Pick<FacesAndRims, "faces">,
  tolerance: number,
): Steps<JoinedShapes> {
  const sockets = faces.filter(({ surface }) => surface?.kind === "sphere");
  if (sockets.length === 0) return joined;
  const made: NewBall[] = [];
  for (const ball of ballsIn(joined, tolerance)) {
    const seats = sockets.filter((face) => isSeatOf(ball, face, joined, tolerance));
    const seated = seats.length === 0 ? undefined : seatedBall(joined, ball, seats, tolerance);
    if (seated !== undefined) made.push(seated);
    yield PAUSE;
  }
  return made.length === 0 ? joined : withBalls(joined, made);
}

/** Returns whether a solid is a whole sphere. O(n), and far less than to find the faces and rims of all shapes. */
export function hasBalls(joined: JoinedShapes, tolerance: number): boolean {
  return ballsIn(joined, tolerance).next().done !== true;
}

/** Returns the solids that are whole spheres. */
function* ballsIn(joined: JoinedShapes, tolerance: number): Generator<Ball> {
  const { shapeOf } = joined;
  let end = 0;
  for (let begin = 0; begin < shapeOf.length; begin = end) {
    while (end < shapeOf.length && shapeOf[end] === shapeOf[begin]) end++;
    const positions = nodesIn(joined, begin, end).map((node) => pointOf(joined.points, node));
    if (positions.length < MIN_NODES) continue;
    const sphere = fittedSphere(sampled(positions));
    if (sphere === undefined || !positions.every((p) => isOn(sphere, p, tolerance))) continue;
    const ball = { ...sphere, begin, end };
    const volume = volumeOf(joined, ball) / ((4 / 3) * Math.PI * sphere.radius ** 3);
    if (volume > 1 - MISSING && volume < 1 + MISSING) yield ball;
  }
}

/** Largest number of nodes that determine a sphere; all are compared with it. */
const SAMPLE = 1000;

function sampled(positions: readonly Vector[]): readonly Vector[] {
  const step = Math.ceil(positions.length / SAMPLE) | 1;
  return positions.filter((_, i) => i % step === 0);
}

const isOn = ({ centre, radius }: Sphere, p: Vector, tolerance: number) =>
  Math.abs(lengthOf(minus(p, centre)) - radius) <= tolerance;

function nodesIn({ triangles, isDropped }: JoinedShapes, begin: number, end: number): number[] {
  const nodes = new Set<number>();
  for (let t = begin; t < end; t++) {
    if (isDropped[t] === 1) continue;
    for (const node of triangles.subarray(3 * t, 3 * t + 3)) nodes.add(node);
  }
  return [...nodes];
}

function volumeOf(joined: JoinedShapes, { begin, end, centre }: Ball): number {
  let volume = 0;
  for (let t = begin; t < end; t++) {
    if (joined.isDropped[t] === 1) continue;
    const [a, b, c] = cornersOf(joined, t);
    volume += dot(minus(a, centre), cross(minus(b, centre), minus(c, centre))) / 6;
  }
  return volume;
}

/** Returns whether a face is on the sphere of a ball, as seen from inside. */
function isSeatOf(ball: Ball, face: ShapeRange, joined: JoinedShapes, tolerance: number): boolean {
  if (face.begin >= ball.begin && face.begin < ball.end) return false;
  return (
    nodesIn(joined, face.begin, face.end).every((node) =>
      isOn(ball, pointOf(joined.points, node), 2 * tolerance),
    ) && !facesOutward(joined, face)
  );
}

/** Returns the triangles of a ball in its seats; undefined if they cannot be made. */
function seatedBall(
  joined: JoinedShapes,
  ball: Ball,
  seats: readonly ShapeRange[],
  tolerance: number,
): NewBall | undefined {
  const inSeats: number[] = [];
  for (const { begin, end } of seats) {
    for (let t = begin; t < end; t++) {
      const [a = 0, b = 0, c = 0] = joined.triangles.subarray(3 * t, 3 * t + 3);
      if (joined.isDropped[t] === 0) inSeats.push(a, c, b);
    }
  }
  const edges = new Map<number, Segment>();
  for (let corner = 0; corner < inSeats.length; corner++) {
    const [a = 0, b = 0] = [inSeats[corner], inSeats[corner % 3 === 2 ? corner - 2 : corner + 1]];
    // An edge that two triangles have in the same direction: the seats overlap.
    if (edges.has(directedKey(a, b))) return undefined;
    if (!edges.delete(directedKey(b, a))) edges.set(directedKey(a, b), [a, b]);
  }
  const border = [...edges.values()].map(([a, b]): Segment => [b, a]);
  try {
    const rest = border.length === 0 ? [] : restOf(joined, ball, { inSeats, border }, tolerance);
    const triangles = Uint32Array.from([...inSeats, ...rest]);
    return { ball, triangles, faces: facesOf(joined, ball, triangles) };
  } catch (failure) {
    if (failure instanceof CrossingConstraints) return undefined;
    throw failure;
  }
}

interface Seat {
  /** Triangles of the ball in its seats, three nodes each. */
  readonly inSeats: readonly number[];
  /** Edges of the rest of the sphere, with the rest on the left. */
  readonly border: readonly Segment[];
}

/** Returns the triangles of the sphere outside of all seats, three nodes each. Throws CrossingConstraints if there are none. */
function restOf(joined: JoinedShapes, ball: Ball, { inSeats, border }: Seat, tolerance: number): number[] {
  const { points } = joined;
  const rim = [...new Set(border.flat())];
  const { pole, distance } = poleIn(points, inSeats, rim);
  const plane = stereographic(ball.centre, ball.radius, minus(ball.centre, pole));
  const old = nodesIn(joined, ball.begin, ball.end);
  const kept = new GrowingNodes(new Float64Array(), Math.max(SPACING * meanEdge(joined, ball), tolerance));
  for (const node of rim) kept.add(pointOf(points, node));
  const inner = old.filter((node) => {
    const p = pointOf(points, node);
    if (lengthOf(minus(p, pole)) < distance) return false;
    const count = kept.count;
    kept.add(p);
    return kept.count > count;
  });
  const nodes = [...rim, ...inner];
  const spotOf = new Map(rim.map((node, spot) => [node, spot]));
  const uvs = Float64Array.from(nodes.flatMap((node) => [...plane.uv(pointOf(points, node))]));
  const constraints = border.map(([a, b]): Segment => [spotOf.get(a) ?? 0, spotOf.get(b) ?? 0]);
  const all = constrainedTriangles(uvs, constraints);
  return trianglesWithin(all, constraints).flatMap((t) =>
    [...all.subarray(3 * t, 3 * t + 3)].map((spot) => nodes[spot] ?? 0),
  );
}

/** Returns the centroid of the triangle that is farthest from the border, and its distance. */
function poleIn(
  points: Float64Array,
  triangles: readonly number[],
  border: readonly number[],
): { readonly pole: Vector; readonly distance: number } {
  const positions = border.map((node) => pointOf(points, node));
  let best = { pole: [0, 0, 0] as Vector, distance: 0 };
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = triangles.slice(t, t + 3).map((node) => pointOf(points, node));
    if (a === undefined || b === undefined || c === undefined) continue;
    const pole = centroidOf([a, b, c]);
    const distance = positions.reduce((least, p) => Math.min(least, lengthOf(minus(p, pole))), Infinity);
    if (distance > best.distance) best = { pole, distance };
  }
  return best;
}

function meanEdge(joined: JoinedShapes, { begin, end }: Ball): number {
  let [sum, count] = [0, 0];
  for (let t = begin; t < end; t++) {
    if (joined.isDropped[t] === 1) continue;
    const [a, b] = cornersOf(joined, t);
    sum += lengthOf(minus(b, a));
    count++;
  }
  return sum / Math.max(count, 1);
}

/** Returns the face of each triangle: that of the nearest old triangle of the ball. */
function facesOf(joined: JoinedShapes, { begin, end }: Ball, triangles: Uint32Array): Uint32Array {
  const { faceOf, isDropped, points } = joined;
  const first = faceOf[begin] ?? 0;
  const made = new Uint32Array(triangles.length / 3).fill(first);
  if (faceOf[end - 1] === first) return made;
  const old: { readonly at: Vector; readonly face: number }[] = [];
  for (let t = begin; t < end; t++)
    if (isDropped[t] === 0) old.push({ at: centroidOf(cornersOf(joined, t)), face: faceOf[t] ?? first });
  return made.map((_, t) => {
    const [a, b, c] = [0, 1, 2].map((k) => pointOf(points, triangles[3 * t + k] ?? 0)) as [
      Vector,
      Vector,
      Vector,
    ];
    const centre = centroidOf([a, b, c]);
    let [face, least] = [first, Infinity];
    for (const { at, face: own } of old) {
      const d = minus(at, centre);
      const squared = dot(d, d);
      if (squared < least) [face, least] = [own, squared];
    }
    return face;
  });
}

/** Returns all shapes with the new triangles of the balls, each face's together. */
function withBalls(joined: JoinedShapes, made: readonly NewBall[]): JoinedShapes {
  const madeAt = new Map(made.map((one) => [one.ball.begin, one]));
  const corners: number[] = [];
  const shapes: number[] = [];
  const owners: number[] = [];
  const dropped: number[] = [];
  for (let t = 0; t < joined.shapeOf.length;) {
    const own = madeAt.get(t);
    const shape = joined.shapeOf[t] ?? 0;
    if (own === undefined) {
      for (const node of joined.triangles.subarray(3 * t, 3 * t + 3)) corners.push(node);
      shapes.push(shape);
      owners.push(joined.faceOf[t] ?? 0);
      dropped.push(joined.isDropped[t] ?? 0);
      t++;
      continue;
    }
    const order = [...own.faces.keys()].sort((a, b) => (own.faces[a] ?? 0) - (own.faces[b] ?? 0) || a - b);
    for (const i of order) {
      for (const node of own.triangles.subarray(3 * i, 3 * i + 3)) corners.push(node);
      shapes.push(shape);
      owners.push(own.faces[i] ?? 0);
      dropped.push(0);
    }
    t = own.ball.end;
  }
  return {
    ...joined,
    triangles: Uint32Array.from(corners),
    shapeOf: Uint32Array.from(shapes),
    faceOf: Uint32Array.from(owners),
    twin: Uint32Array.from(shapes.keys()),
    isDropped: Uint8Array.from(dropped),
  };
}
