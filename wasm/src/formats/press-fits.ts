/**
 * Moves faces that overlap the face of another shape by next to nothing onto that face: pins in holes of nearly the same
 * radius, plates that overlap by a rounded number. The volume in common would be a layer too thin to be meshed.
 */
import { PAUSE, type Steps } from "../base/steps.js";
import { dot, lengthOf, minus, pointOf, type Vector } from "../base/vectors.js";
import { areBoxesNear, faceEachOther, facesOutward } from "./face-groups.js";
import type { FittedSurface } from "./fitted-surface.js";
import { type JoinedShapes, namesOf } from "./joined-shapes.js";
import { diagonalOf } from "./near-points.js";
import type { FacesAndRims, ShapeRange } from "./rims.js";

/** Largest depth of an overlap / diagonal of all: as far as triangles may be from the curved faces of a CAD file. */
const DEPTH = 1 / 5000;

/** Largest depth / diagonal of the face that is moved. */
const DEPTH_OF_FACE = 1 / 1000;

/** Number of significant digits of a depth. */
const DIGITS = 2;

/** Returns the shapes with the faces moved, and a note about them; undefined if no face overlaps another one so little. */
export function* withoutPressFits(
  joined: JoinedShapes,
  { faces, rims }: FacesAndRims,
  tolerance: number,
): Steps<JoinedShapes | undefined> {
  const limit = DEPTH * diagonalOf(joined.points);
  const nodes = faces.map(({ rims: own }) => [...new Set(own.flatMap((r) => rims[r]?.nodes ?? []))]);
  const order = [...faces.keys()].filter((f) => canMove(faces[f]) && (nodes[f]?.length ?? 0) > 0);
  const lowest = (f: number) => faces[f]?.low[0] ?? 0;
  order.sort((a, b) => lowest(a) - lowest(b) || a - b);
  const moved = new Map<number, Vector>();
  const notes: string[] = [];
  for (const [i, f] of order.entries()) {
    const one = faces[f];
    for (let j = i + 1; one !== undefined && j < order.length; j++) {
      const g = order[j] ?? 0;
      const other = faces[g];
      if (other === undefined || lowest(g) > one.high[0] + limit) break;
      if (one.shape === other.shape || !areBoxesNear(one, other, limit)) continue;
      // The face with the larger number moves, whichever comes first along x.
      const [kept, pushed] = f < g ? [f, g] : [g, f];
      const depth = depthOf(joined, { faces, nodes }, kept, pushed);
      if (depth === undefined || depth <= 2 * tolerance || depth > limit) continue;
      const onto = faces[kept]?.surface;
      const own = nodesOf(joined, faces[pushed]);
      if (onto === undefined || own.some((node) => moved.has(node))) continue;
      for (const node of own) moved.set(node, footOf(onto, pointOf(joined.points, node)));
      notes.push(noteOf(joined, faces[pushed], faces[kept], depth));
    }
    yield PAUSE;
  }
  if (moved.size === 0) return undefined;
  const points = joined.points.slice();
  for (const [node, position] of moved) points.set(position, 3 * node);
  return { ...joined, points, notes: [...joined.notes, ...new Set(notes)] };
}

const canMove = (face: ShapeRange | undefined): boolean =>
  face?.surface?.kind === "plane" || face?.surface?.kind === "cylinder";

function noteOf(
  joined: JoinedShapes,
  pushed: ShapeRange | undefined,
  kept: ShapeRange | undefined,
  depth: number,
): string {
  const [one, other] = [pushed, kept].map((face) => namesOf(joined, [face?.shape ?? 0]));
  return `moved a face of ${one} by ${Number(depth.toPrecision(DIGITS))} onto one of ${other}, which it overlapped`;
}

function nodesOf({ triangles }: JoinedShapes, face: ShapeRange | undefined): number[] {
  return [...new Set(triangles.subarray(3 * (face?.begin ?? 0), 3 * (face?.end ?? 0)))];
}

interface Faces {
  readonly faces: readonly ShapeRange[];
  /** Nodes of the rims of each face. */
  readonly nodes: readonly (readonly number[])[];
}

/** Returns by how much two faces overlap, if this is about the same everywhere; undefined if they do not. */
function depthOf(joined: JoinedShapes, { faces, nodes }: Faces, f: number, g: number): number | undefined {
  const [one, other] = [faces[f], faces[g]];
  const [a, b] = [one?.surface, other?.surface];
  if (one === undefined || other === undefined || a === undefined || b === undefined || a.kind !== b.kind)
    return undefined;
  if (!faceEachOther(joined, one, other)) return undefined;
  const size = Math.min(sizeOf(one), sizeOf(other));
  const beyond = depthsBelow(joined, one, a, nodes[g] ?? []);
  const [least, most] = [smallest(beyond), -smallest(beyond.map((x) => -x))];
  const isEven = most - least <= EVEN * most;
  // The other way round, only the distance counts: nodes of a large face may be far from a small one.
  const isSame = (nodes[f] ?? []).every(
    (node) => b.distance(pointOf(joined.points, node)) <= (1 + EVEN) * most,
  );
  return least > 0 && isEven && isSame && most <= DEPTH_OF_FACE * size ? most : undefined;
}

/** Largest difference of depths / depth: the faces are parallel, or have one axis. */
const EVEN = 0.1;

const smallest = (values: readonly number[]): number =>
  values.reduce((least, x) => Math.min(least, x), Infinity);

const sizeOf = ({ low, high }: ShapeRange): number => lengthOf(minus(high, low));

/** Returns how far nodes are behind a face, inside its shape. */
function depthsBelow(
  joined: JoinedShapes,
  face: ShapeRange,
  surface: FittedSurface,
  nodes: readonly number[],
): number[] {
  const isOutward = facesOutward(joined, face);
  return nodes.map((node) => {
    const p = pointOf(joined.points, node);
    const foot = footOf(surface, p);
    const above = dot(minus(p, foot), surface.outward(foot)) > 0;
    return (above === isOutward ? -1 : 1) * surface.distance(p);
  });
}

function footOf(surface: FittedSurface, p: Vector): Vector {
  return surface.at(surface.uv(p));
}
