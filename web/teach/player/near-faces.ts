/** The faces of the front near what a step is about, for the graphics card. */
import type { Trace } from "tetrafront/trace";
import type { Position } from "../../document/position";

/** What is drawn around a step. */
export interface Neighbourhood {
  readonly centre: Position;
  /** Radius of what the step is about: nothing may hide it. */
  readonly radius: number;
  /** Faces whose centroid is farther away are not drawn. */
  readonly reach: number;
}

/** Reach as a multiple of the radius. */
const reachInRadii = 3.6;

/** Returns the neighbourhood of positions that a step is about; null without any. */
export function neighbourhoodOf(positions: readonly Position[]): Neighbourhood | null {
  const bounds = [0, 1, 2].map((axis) => {
    const along = positions.map((position) => position[axis] ?? 0);
    return [Math.min(...along), Math.max(...along)] as const;
  });
  const [x, y, z] = bounds;
  if (positions.length === 0 || !x || !y || !z) return null;
  const centre: Position = [(x[0] + x[1]) / 2, (y[0] + y[1]) / 2, (z[0] + z[1]) / 2];
  const radius = Math.hypot(x[1] - x[0], y[1] - y[0], z[1] - z[0]) / 2;
  return { centre, radius, reach: reachInRadii * radius };
}

export interface NearFaces {
  /** x y z per corner, relative to the origin. */
  readonly positions: Float32Array;
  /** Distance of each corner from the centre, in reaches. */
  readonly distances: Float32Array;
}

/** Returns the faces of the front of a state in a neighbourhood, without some of them. O(faces of the front). */
export function nearFaces(
  trace: Trace,
  state: number,
  { centre, reach }: Neighbourhood,
  origin: Position,
  leftOut: readonly number[] = [],
): NearFaces {
  const { faces, nodes } = trace;
  const at = (corner: number, axis: number): number =>
    nodes.positions[3 * (faces.nodes[corner] ?? 0) + axis] ?? 0;
  const near = trace.frontAt(state).filter((face) => {
    let square = 0;
    for (let axis = 0; axis < 3; axis++) {
      const sum = at(3 * face, axis) + at(3 * face + 1, axis) + at(3 * face + 2, axis);
      square += (sum / 3 - (centre[axis] ?? 0)) ** 2;
    }
    return square < reach * reach && !leftOut.includes(face);
  });
  const positions = new Float32Array(9 * near.length);
  const distances = new Float32Array(3 * near.length);
  near.forEach((face, slot) => {
    for (let corner = 0; corner < 3; corner++) {
      let square = 0;
      for (let axis = 0; axis < 3; axis++) {
        const along = at(3 * face + corner, axis);
        positions[9 * slot + 3 * corner + axis] = along - (origin[axis] ?? 0);
        square += (along - (centre[axis] ?? 0)) ** 2;
      }
      distances[3 * slot + corner] = Math.sqrt(square) / reach;
    }
  });
  return { positions, distances };
}
