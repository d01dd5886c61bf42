/** Finds faces of several shapes that lie on one surface, and face each other. */
import { PAUSE, type Steps } from "../base/steps.js";
import { centroidOf, cornersOf, dot, normalOf, pointOf } from "../base/vectors.js";
import { disjointSets } from "./components.js";
import type { FittedSurface } from "./fitted-surface.js";
import type { JoinedShapes } from "./joined-shapes.js";
import type { FacesAndRims, ShapeRange } from "./rims.js";

/** Faces on one surface, in increasing order of their numbers. */
export type FaceGroup = readonly number[];

/** Returns the groups of faces of several shapes that may have an area in common. Each face is in at most one. */
export function* faceGroups(
  joined: JoinedShapes,
  { faces, rims }: FacesAndRims,
  tolerance: number,
): Steps<FaceGroup[]> {
  const sets = disjointSets(faces.length);
  const nodes = faces.map(({ rims: own }) => [...new Set(own.flatMap((r) => rims[r]?.nodes ?? []))]);
  const isOn = (f: number, surface: FittedSurface) =>
    (nodes[f] ?? []).every((node) => surface.distance(pointOf(joined.points, node)) <= 2 * tolerance);
  const order = [...faces.keys()].filter(
    (f) => faces[f]?.surface !== undefined && (nodes[f]?.length ?? 0) > 0,
  );
  const lowest = (f: number) => faces[f]?.low[0] ?? 0;
  order.sort((a, b) => lowest(a) - lowest(b) || a - b);
  for (const [i, f] of order.entries()) {
    const one = faces[f];
    if (one?.surface === undefined) continue;
    for (let j = i + 1; j < order.length && lowest(order[j] ?? 0) <= one.high[0] + tolerance; j++) {
      const g = order[j] ?? 0;
      const other = faces[g];
      if (other?.surface === undefined || one.shape === other.shape) continue;
      if (one.surface.kind !== other.surface.kind || !areBoxesNear(one, other, tolerance)) continue;
      if (!isOn(g, one.surface) || !isOn(f, other.surface) || !faceEachOther(joined, one, other)) continue;
      sets.join(f, g);
    }
    yield PAUSE;
  }
  const groups = new Map<number, number[]>();
  for (const f of faces.keys()) {
    const root = sets.rootOf(f);
    groups.set(root, [...(groups.get(root) ?? []), f]);
  }
  return [...groups.values()].filter(({ length }) => length > 1);
}

export function areBoxesNear(one: ShapeRange, other: ShapeRange, tolerance: number): boolean {
  return one.low.every(
    (low, k) =>
      low - tolerance <= (other.high[k] ?? 0) && (other.low[k] ?? 0) - tolerance <= (one.high[k] ?? 0),
  );
}

/** Returns whether the outsides of two faces of about one surface are on different sides of it. */
export function faceEachOther(joined: JoinedShapes, one: ShapeRange, other: ShapeRange): boolean {
  return facesOutward(joined, one) !== facesOutward(joined, { ...other, surface: one.surface });
}

/** Returns whether a face faces away from the axis or centre of its surface; of a plane, as its normal. */
export function facesOutward(
  joined: JoinedShapes,
  { begin, surface }: Pick<ShapeRange, "begin" | "surface">,
): boolean {
  const corners = cornersOf(joined, begin);
  return surface !== undefined && dot(normalOf(corners), surface.outward(centroidOf(corners))) > 0;
}
