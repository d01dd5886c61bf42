import type { ProjectPreview, ProjectSource } from "tetrafront";
import { nextTurn, sliceMs } from "./slices";

/**
 * How many tetrahedra a size field asks for, before anything is meshed: the integral of
 * 1 / (elementVolume · size³) over the inside of the model, along upright lines in a regular pattern.
 */

/** Mean volume of a tetrahedron over the cube of the wanted size; 0.143 to 0.146 in five of our meshes. */
const elementVolume = 0.145;
/** Lines along each side of the model's box. */
const linesPerSide = 48;
/** Places of the lines within their cells: off the corners and sides that models have there. */
const offsets = [0.4871, 0.5213] as const;
/** One step along a line, in sizes. */
const stepInSizes = 0.7;
/** Sizes below this share of the model are not followed step by step: the count is absurd anyway. */
const leastStep = 1e-3;
/** Growth of a source that does not say. */
const defaultGrowth = 0.3;

type Place = readonly [number, number, number];

function distanceToSegment(p: Place, a: Place, b: Place): number {
  const along = b.map((x, k) => x - (a[k] ?? 0));
  const from = p.map((x, k) => x - (a[k] ?? 0));
  const length2 = along.reduce((sum, x) => sum + x * x, 0);
  const t = length2 === 0 ? 0 : along.reduce((sum, x, k) => sum + x * (from[k] ?? 0), 0) / length2;
  const held = Math.min(1, Math.max(0, t));
  return Math.hypot(...from.map((x, k) => x - held * (along[k] ?? 0)));
}

const minus = (a: Place, b: Place): Place => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a: Place, b: Place): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Place, b: Place): Place => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** Distance to a triangle's plane where the place lies above its inside; else infinite. */
function distanceAbove(p: Place, [a, b, c]: readonly Place[]): number {
  if (!a || !b || !c) return Infinity;
  const normal = cross(minus(b, a), minus(c, a));
  const isInside = [[a, b] as const, [b, c] as const, [c, a] as const].every(
    ([from, to]) => dot(cross(normal, minus(to, from)), minus(p, from)) >= 0,
  );
  const length = Math.sqrt(dot(normal, normal));
  return isInside && length > 0 ? Math.abs(dot(normal, minus(p, a))) / length : Infinity;
}

/** Distance from a source. */
function distanceToSource(p: Place, places: readonly Place[]): number {
  let nearest = distanceAbove(p, places);
  places.forEach((place, i) => {
    const next = places[(i + 1) % places.length] ?? place;
    nearest = Math.min(nearest, distanceToSegment(p, place, next));
  });
  return nearest;
}

/** The size at a place: the uniform one, or what a source makes of it. */
export function sizeAt(place: Place, uniform: number, sources: readonly ProjectSource[]): number {
  let size = uniform;
  for (const { positions: places, size: least, distance = 0, growth = defaultGrowth } of sources) {
    if (least >= size) continue;
    const beyond = Math.max(0, distanceToSource(place, places) - distance);
    size = Math.min(size, least + growth * beyond);
  }
  return size;
}

interface Range {
  readonly low: number;
  readonly step: number;
}

/** The lines' crossings with the surface, in no order: one list per line. */
function findCrossings({ patchPoints, patchTriangles }: ProjectPreview, x: Range, y: Range): number[][] {
  const crossings = Array.from({ length: linesPerSide * linesPerSide }, (): number[] => []);
  const lineRange = (low: number, high: number, { low: start, step }: Range, offset: number) =>
    [
      Math.max(0, Math.ceil((low - start) / step - offset)),
      Math.min(linesPerSide - 1, Math.floor((high - start) / step - offset)),
    ] as const;
  for (let t = 0; t + 2 < patchTriangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => {
      const at = 3 * (patchTriangles[t + k] ?? 0);
      return [patchPoints[at] ?? 0, patchPoints[at + 1] ?? 0, patchPoints[at + 2] ?? 0] as const;
    }) as [Place, Place, Place];
    const area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if (area === 0) continue;
    const [i0, i1] = lineRange(Math.min(a[0], b[0], c[0]), Math.max(a[0], b[0], c[0]), x, offsets[0]);
    const [j0, j1] = lineRange(Math.min(a[1], b[1], c[1]), Math.max(a[1], b[1], c[1]), y, offsets[1]);
    for (let j = j0; j <= j1; ++j) {
      for (let i = i0; i <= i1; ++i) {
        const px = x.low + (i + offsets[0]) * x.step;
        const py = y.low + (j + offsets[1]) * y.step;
        const u = ((px - a[0]) * (c[1] - a[1]) - (py - a[1]) * (c[0] - a[0])) / area;
        const v = ((b[0] - a[0]) * (py - a[1]) - (b[1] - a[1]) * (px - a[0])) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        crossings[j * linesPerSide + i]?.push(a[2] + u * (b[2] - a[2]) + v * (c[2] - a[2]));
      }
    }
  }
  return crossings;
}

function rangeOf(points: Float64Array, axis: number): Range & { readonly length: number } {
  let low = Infinity;
  let high = -Infinity;
  for (let i = axis; i < points.length; i += 3) {
    low = Math.min(low, points[i] ?? 0);
    high = Math.max(high, points[i] ?? 0);
  }
  return { low, step: (high - low) / linesPerSide, length: high - low };
}

/**
 * The expected number of tetrahedra for a uniform size refined by sources. Null where the preview
 * encloses nothing, or `stop` says that nobody waits any more. Gives way to the page in between.
 */
export async function estimateTetrahedra(
  preview: ProjectPreview,
  uniform: number,
  sources: readonly ProjectSource[],
  stop: () => boolean = () => false,
): Promise<number | null> {
  const [x, y, z] = [0, 1, 2].map((axis) => rangeOf(preview.patchPoints, axis)) as [
    ReturnType<typeof rangeOf>,
    ReturnType<typeof rangeOf>,
    ReturnType<typeof rangeOf>,
  ];
  if (!(x.length > 0 && y.length > 0 && z.length > 0) || !(uniform > 0)) return null;
  const shortest = leastStep * Math.max(x.length, y.length, z.length);
  const crossings = findCrossings(preview, x, y);
  let sum = 0;
  let resumed = performance.now();
  for (const [line, heights] of crossings.entries()) {
    if (performance.now() - resumed > sliceMs) {
      await nextTurn();
      if (stop()) return null;
      resumed = performance.now();
    }
    heights.sort((a, b) => a - b);
    const px = x.low + ((line % linesPerSide) + offsets[0]) * x.step;
    const py = y.low + (Math.floor(line / linesPerSide) + offsets[1]) * y.step;
    for (let k = 0; k + 1 < heights.length; k += 2) {
      const end = heights[k + 1] ?? 0;
      for (let at = heights[k] ?? 0; at < end;) {
        const size = sizeAt([px, py, at], uniform, sources);
        const step = Math.min(Math.max(stepInSizes * size, shortest), end - at);
        const middle = sizeAt([px, py, at + step / 2], uniform, sources);
        sum += step / middle ** 3;
        at += step;
        if (step === 0) break;
      }
    }
  }
  const count = (sum * x.step * y.step) / elementVolume;
  return count > 0 ? count : null;
}
