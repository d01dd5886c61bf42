/** Puts the edges of a wire in the order in which they are passed: a file may contain them in any. */
import type { Coedge, PlaneCurve, PlaneVector } from "./trimmed-model.js";

interface End {
  readonly vertex: number;
  readonly at: PlaneVector;
}

export interface EndedCoedge {
  readonly coedge: Coedge;
  readonly inPlane: PlaneCurve;
  readonly range: PlaneVector;
  readonly from: End;
  readonly to: End;
}

/**
 * Returns the loops of a wire. Each edge is followed by the one that begins at its end vertex, nearest in the plane: the
 * two uses of a seam begin at the same vertex. O(n²) for n edges out of order.
 */
export function chainedLoops(wire: readonly EndedCoedge[]): Coedge[][] {
  const left = [...wire];
  const loops: Coedge[][] = [];
  for (let first = left.shift(); first !== undefined; first = left.shift()) {
    const loop = [first.coedge];
    for (let end = first.to; ;) {
      const next = nearest(end, left);
      // A loop ends where it began, unless the wire goes on there as near.
      const closes = end.vertex === first.from.vertex ? squaredDistance(end.at, first.from.at) : Infinity;
      if (next === undefined || closes <= next.distance) break;
      left.splice(next.index, 1);
      loop.push(next.coedge.coedge);
      end = next.coedge.to;
    }
    loops.push(loop);
  }
  return loops;
}

function nearest(end: End, left: readonly EndedCoedge[]) {
  let best: { readonly index: number; readonly coedge: EndedCoedge; readonly distance: number } | undefined;
  for (const [index, coedge] of left.entries()) {
    if (coedge.from.vertex !== end.vertex) continue;
    const distance = squaredDistance(end.at, coedge.from.at);
    if (best === undefined || distance < best.distance) best = { index, coedge, distance };
  }
  return best;
}

const squaredDistance = (a: PlaneVector, b: PlaneVector) => (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2;
