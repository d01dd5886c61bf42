import type { Trace } from "tetrafront";

/** What the colours of the front's faces mean. */
export type FrontColoring = "age" | "size" | "layer";

/** Number of steps in which the colour of a face changes from that of the youngest to that of the oldest. */
export const agingSteps = 200;

/** What the colours show: a value per face, and the values at both ends of the scale. */
export interface FrontValues {
  readonly valueOf: (face: number) => number;
  /** Values at the beginning and at the end of the colour scale, in the state after a step. */
  readonly rangeAt: (step: number) => readonly [from: number, to: number];
}

export function frontValues(trace: Trace, coloring: FrontColoring): FrontValues {
  switch (coloring) {
    case "age": {
      // The triangles of the boundary are as old as can be.
      const bornOf = (face: number): number => trace.faces.born[face] || -agingSteps;
      return { valueOf: bornOf, rangeAt: (step) => [step - agingSteps, step] };
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
  return { valueOf, rangeAt: () => range };
}
