import type { SurfaceInput } from "tetrafront";

type Point = readonly [x: number, y: number];

/** A square plate with a hole in its middle, which is a regular polygon. */
export interface Plate {
  /** Half the width. */
  readonly half: number;
  readonly thickness: number;
  readonly radius: number;
  /** Number of corners of the hole; a multiple of 4. */
  readonly corners: number;
}

/** Volume of the plate: the square minus the area of the polygon, times the thickness. */
export function plateVolume({ half, thickness, radius, corners }: Plate): number {
  const polygon = 0.5 * corners * radius ** 2 * Math.sin((2 * Math.PI) / corners);
  return thickness * (4 * half ** 2 - polygon);
}

/** Triangles as CAD programs write them: no node on the flat faces, so that those around the hole are needles. */
export function plateSurface({ half, thickness, radius, corners }: Plate): SurfaceInput {
  const outer: Point[] = [1, 3, 5, 7].map((eighth) => {
    const angle = (eighth * Math.PI) / 4;
    return [Math.sign(Math.cos(angle)) * half, Math.sign(Math.sin(angle)) * half];
  });
  const inner: Point[] = Array.from({ length: corners }, (_, i) => {
    const angle = (2 * Math.PI * i) / corners;
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  });
  const ring = [...outer, ...inner];
  const points = [0, thickness].flatMap((z) => ring.flatMap(([x, y]) => [x, y, z]));
  const [holes, top] = [4, ring.length];
  const hole = (i: number): number => holes + (i % corners);
  const triangles: number[] = [];
  /** Adds a triangle of the top, and its mirror image on the bottom. */
  const addFace = (a: number, b: number, c: number): void =>
    void triangles.push(top + a, top + b, top + c, a, c, b);
  /** Adds the wall below the edge of the top from a to b, which has the plate on its left. */
  const addWall = (a: number, b: number): void => void triangles.push(a, b, top + b, a, top + b, top + a);
  for (let quarter = 0; quarter < 4; ++quarter) {
    const [from, to] = [(quarter * corners) / 4, ((quarter + 1) * corners) / 4];
    for (let i = from; i < to; ++i) {
      addFace(quarter, hole(i + 1), hole(i));
      addWall(hole(i + 1), hole(i));
    }
    const next = (quarter + 1) % 4;
    addFace(quarter, next, hole(to));
    addWall(quarter, next);
  }
  return { points: Float64Array.from(points), triangles: Uint32Array.from(triangles) };
}
