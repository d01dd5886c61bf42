import type { Trace } from "tetrafront/trace";

/** What the colours of the front's faces mean. */
export const frontColorings = ["age", "size", "layer"] as const;
export type FrontColoring = (typeof frontColorings)[number];

/**
 * How a front is faded behind what the lens shows. It loses most of its colour and some contrast, the more the farther it is from
 * the eye, but keeps light and edges: its shape must stay visible.
 */
export const fading = {
  /** Share of plain grey in the colour of a face. */
  plain: 0.7,
  /** Share of the background in what is nearest to the eye, and what that grows by up to the farthest. */
  background: 0.25,
  depth: 0.45,
} as const;

/** What the colours show: a value per face, and the values at both ends of the scale. */
export interface FrontValues {
  readonly valueOf: (face: number) => number;
  /** Values at the beginning and at the end of the colour scale, in the state after a step. */
  readonly rangeAt: (step: number) => readonly [from: number, to: number];
  /** Power of the distance from the end of the scale, as a share of the scale, that the colour shows: 1 is linear. */
  readonly power: number;
}

/** Returns where a value is on the colour scale in the state after a step, 0 to 1. */
export function shadeOf({ rangeAt, power }: FrontValues, value: number, step: number): number {
  const [from, to] = rangeAt(step);
  return 1 - Math.min(Math.max((to - value) / (to - from), 0), 1) ** power;
}

/**
 * Most faces of a long run are thousands of steps old, those at work a few steps. On a linear scale, one of the two
 * groups has a single colour. With the cube root, half of the scale shows the last eighth of the steps.
 */
const agePower = 1 / 3;

export function frontValues(trace: Trace, coloring: FrontColoring): FrontValues {
  switch (coloring) {
    case "age": {
      // The triangles of the boundary are as old as can be.
      const bornOf = (face: number): number => trace.faces.born[face] ?? 0;
      return { valueOf: bornOf, rangeAt: (step) => [Math.min(0, step - 1), step], power: agePower };
    }
    case "size":
      return fixedRange(trace, (face) => faceSize(trace, face));
    case "layer":
      return fixedRange(trace, (face) => faceLayer(trace, face));
  }
}

/** Returns the root mean square of the edge lengths, by which the front orders its faces. */
export function faceSize({ faces, nodes: { positions } }: Trace, face: number): number {
  let squares = 0;
  for (let corner = 0; corner < 3; corner++) {
    const a = 3 * (faces.nodes[3 * face + corner] ?? 0);
    const b = 3 * (faces.nodes[3 * face + ((corner + 1) % 3)] ?? 0);
    for (let axis = 0; axis < 3; axis++)
      squares += ((positions[a + axis] ?? 0) - (positions[b + axis] ?? 0)) ** 2;
  }
  return Math.sqrt(squares / 3);
}

/** Returns the mean layer of a face's nodes. */
export function faceLayer({ faces, nodes }: Trace, face: number): number {
  let sum = 0;
  for (let corner = 0; corner < 3; corner++) sum += nodes.layers[faces.nodes[3 * face + corner] ?? 0] ?? 0;
  return sum / 3;
}

/** The scale covers the values of all faces that were ever made. */
function fixedRange(trace: Trace, valueOf: (face: number) => number): FrontValues {
  let [low, high] = [Infinity, -Infinity];
  for (let face = 0; face < trace.faces.born.length; face++) {
    const value = valueOf(face);
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  const range = low < high ? ([low, high] as const) : ([low - 1, low + 1] as const);
  return { valueOf, rangeAt: () => range, power: 1 };
}
