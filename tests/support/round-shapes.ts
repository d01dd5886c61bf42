/** Triangulated shapes of revolution, each face by itself as a CAD kernel does: own nodes, own phase, own number of edges. */
import type { Shape } from "../../wasm/src/formats/joined-shapes.js";

type Triple = readonly [number, number, number];

/** Radius and height. */
type ProfilePoint = readonly [radius: number, height: number];

interface RoundShape {
  readonly name: string;
  /** Faces from the bottom around the outside to the top, and back inside if the shape has a hole; material is on the left. */
  readonly profile: readonly (readonly ProfilePoint[])[];
  /** Number of edges of a circle. */
  readonly edges: number;
  /** Angle of the first node, in radians. */
  readonly phase: number;
  /** Whether each face consists of two halves, with straight edges between. */
  readonly isHalved?: boolean;
}

/** Where a shape is put. */
export interface Motion {
  readonly axis: Triple;
  readonly angle: number;
  readonly offset: Triple;
}

export const NO_MOTION: Motion = { axis: [0, 0, 1], angle: 0, offset: [0, 0, 0] };

/** Rotates about an axis of length 1 through the origin, then moves. */
export function moved([x, y, z]: Triple, { axis: [a, b, c], angle, offset }: Motion): Triple {
  const [cosine, sine] = [Math.cos(angle), Math.sin(angle)];
  const along = (a * x + b * y + c * z) * (1 - cosine);
  return [
    x * cosine + (b * z - c * y) * sine + a * along + offset[0],
    y * cosine + (c * x - a * z) * sine + b * along + offset[1],
    z * cosine + (a * y - b * x) * sine + c * along + offset[2],
  ];
}

export function roundShape(
  { name, profile, edges, phase, isHalved = false }: RoundShape,
  motion: Motion,
): Shape {
  const points: number[] = [];
  const triangles: number[] = [];
  const faces: { readonly triangles: number; readonly color: undefined }[] = [];
  const add = ([radius, height]: ProfilePoint, i: number): number => {
    const angle = phase + (2 * Math.PI * (i % edges)) / edges;
    points.push(...moved([radius * Math.cos(angle), radius * Math.sin(angle), height], motion));
    return points.length / 3 - 1;
  };
  for (const face of profile) {
    for (const [from, to] of isHalved
      ? [[0, edges >> 1] as const, [edges >> 1, edges] as const]
      : [[0, edges] as const]) {
      const first = triangles.length;
      for (const [k, upper] of face.slice(1).entries()) {
        const lower = face[k] ?? upper;
        for (let i = from; i < to; i++) {
          const [a, b, c, d] = [add(lower, i), add(lower, i + 1), add(upper, i + 1), add(upper, i)];
          if (lower[0] > 0) triangles.push(a, b, c);
          if (upper[0] > 0) triangles.push(a, c, d);
        }
      }
      faces.push({ triangles: (triangles.length - first) / 3, color: undefined });
    }
  }
  return { name, points: Float64Array.from(points), triangles: Uint32Array.from(triangles), faces };
}

/** Returns a profile with one face per straight piece. */
export function straightFaces(...points: readonly ProfilePoint[]): (readonly ProfilePoint[])[] {
  return points.slice(1).map((to, i) => [points[i] ?? to, to]);
}

/** Returns points of a circle about the axis's point at a height, from one angle above the equator to another, in degrees. */
export function arcOf(
  radius: number,
  height: number,
  from: number,
  to: number,
  pieces: number,
): ProfilePoint[] {
  return Array.from({ length: pieces + 1 }, (_, i): ProfilePoint => {
    const angle = ((from + ((to - from) * i) / pieces) * Math.PI) / 180;
    const isPole = Math.abs(Math.cos(angle)) < 1e-9;
    return [isPole ? 0 : radius * Math.cos(angle), height + radius * Math.sin(angle)];
  });
}
