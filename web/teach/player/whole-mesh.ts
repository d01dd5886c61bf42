/** All elements of a state of a trace, or those behind a plane: the triangles of what they fill, for the graphics card. */
import type { Trace } from "tetrafront/trace";
import type { Position } from "../../document/position";

/** Corners of the faces of a tetrahedron, counter-clockwise seen from outside. */
const faces = [
  [0, 2, 1],
  [0, 1, 3],
  [1, 2, 3],
  [0, 3, 2],
] as const;

/** Elements in front of a vertical plane, towards where the camera is at first, are cut away. */
const towardsEye: Position = [1, -1, 0];

export interface WholeMesh {
  /** x y z per corner of a triangle, relative to the origin. */
  readonly positions: Float32Array;
  /** Number of the element per corner. */
  readonly values: Float32Array;
  /** Centroid of the element per corner, relative to the origin; empty unless the elements are apart. */
  readonly centroids: Float32Array;
}

/** What of the elements is drawn. */
export interface WholeChoice {
  /** Share of the model behind the plane that cuts it open, 0 to 1; null for all of it. */
  readonly cutAt: number | null;
  /** Whether the elements are pulled apart, so that all of their faces are seen. */
  readonly isApart: boolean;
}

/** What all states of a trace have in common, found once: states then only look it up. */
interface KnownElements {
  /** Number of each face, the same for elements that share it: four per element. */
  readonly faceNumbers: Uint32Array;
  readonly faceCount: number;
  /** Height of the centroid of each element over the cutting plane's direction. */
  readonly heights: Float64Array;
}

const known = new WeakMap<Trace, KnownElements>();

/** Returns the faces of the elements after a step: the outer ones, or of elements that are apart all. O(elements). */
export function wholeMesh(trace: Trace, step: number, choice: WholeChoice, origin: Position): WholeMesh {
  const { nodes, elements } = trace;
  const table = known.get(trace) ?? { ...numberedFaces(trace), heights: heightsOf(trace) };
  known.set(trace, table);
  const all = trace.elementsAt(step);
  const drawn = choice.cutAt === null ? all : behind(table, all, choice.cutAt);
  const shown = choice.isApart ? facesOf(drawn) : outerFaces(table, drawn);
  const positions = new Float32Array(9 * shown.length);
  const values = new Float32Array(3 * shown.length);
  const centroids = new Float32Array(choice.isApart ? 9 * shown.length : 0);
  const along = (node: number, axis: number): number =>
    (nodes.positions[3 * (elements.nodes[node] ?? 0) + axis] ?? 0) - (origin[axis] ?? 0);
  let at = 0;
  for (const face of shown) {
    const first = face & ~3;
    for (const corner of faces[face & 3] ?? faces[0]) {
      values[at / 3] = face >>> 2;
      for (let axis = 0; axis < 3; axis++, at++) {
        positions[at] = along(first + corner, axis);
        if (!choice.isApart) continue;
        const sum =
          along(first, axis) + along(first + 1, axis) + along(first + 2, axis) + along(first + 3, axis);
        centroids[at] = sum / 4;
      }
    }
  }
  return { positions, values, centroids };
}

/** Returns all faces of elements. */
function facesOf(elements: Uint32Array): Uint32Array {
  const all = new Uint32Array(4 * elements.length);
  elements.forEach((element, i) => {
    for (let face = 0; face < 4; face++) all[4 * i + face] = 4 * element + face;
  });
  return all;
}

/** Numbers the faces of all elements in a hash table of their sorted nodes, with linear probing. */
function numberedFaces({ elements: { nodes } }: Trace): Pick<KnownElements, "faceNumbers" | "faceCount"> {
  const faceNumbers = new Uint32Array(nodes.length);
  /** Three nodes per numbered face, sorted. */
  const corners = new Uint32Array(3 * nodes.length);
  const mask = 2 ** Math.ceil(Math.log2(2 * nodes.length + 1)) - 1;
  /** Number of a face plus 1; 0 for a free slot. */
  const slots = new Uint32Array(mask + 1);
  let faceCount = 0;
  for (let face = 0; face < nodes.length; face++) {
    const [i, j, k] = faces[face & 3] ?? faces[0];
    const first = face & ~3;
    const [a = 0, b = 0, c = 0] = [nodes[first + i], nodes[first + j], nodes[first + k]];
    const [low, high] = [Math.min(a, b, c), Math.max(a, b, c)];
    const middle = a + b + c - low - high;
    let slot = hashOf(low, middle, high) & mask;
    for (; slots[slot]; slot = (slot + 1) & mask) {
      const at = 3 * ((slots[slot] ?? 1) - 1);
      if (corners[at] === low && corners[at + 1] === middle && corners[at + 2] === high) break;
    }
    if (!slots[slot]) {
      corners[3 * faceCount] = low;
      corners[3 * faceCount + 1] = middle;
      corners[3 * faceCount + 2] = high;
      slots[slot] = ++faceCount;
    }
    faceNumbers[face] = (slots[slot] ?? 1) - 1;
  }
  return { faceNumbers, faceCount };
}

/** Multiplicative hashing: large odd factors spread the nodes over 32 bits. */
function hashOf(low: number, middle: number, high: number): number {
  const mixed = Math.imul(low, 0x9e3779b1) ^ Math.imul(middle, 0x85ebca6b) ^ Math.imul(high, 0xc2b2ae35);
  return mixed ^ (mixed >>> 15);
}

/** Returns the faces that one of the elements has alone. */
function outerFaces({ faceNumbers, faceCount }: KnownElements, shown: Uint32Array): readonly number[] {
  /** 1 for a face that an odd number of elements has. */
  const isOuter = new Uint8Array(faceCount);
  for (const element of shown)
    for (let face = 4 * element; face < 4 * element + 4; face++) {
      const number = faceNumbers[face] ?? 0;
      isOuter[number] = 1 - (isOuter[number] ?? 0);
    }
  const outer: number[] = [];
  for (const element of shown)
    for (let face = 4 * element; face < 4 * element + 4; face++)
      if (isOuter[faceNumbers[face] ?? 0]) outer.push(face);
  return outer;
}

function heightsOf({ elements, nodes }: Trace): Float64Array {
  const heights = new Float64Array(elements.nodes.length / 4);
  elements.nodes.forEach((node, i) => {
    let sum = heights[i >> 2] ?? 0;
    for (let axis = 0; axis < 3; axis++)
      sum += ((nodes.positions[3 * node + axis] ?? 0) * (towardsEye[axis] ?? 0)) / 4;
    heights[i >> 2] = sum;
  });
  return heights;
}

/** Returns the elements whose centroid lies behind a plane: at a share of the way from the hindmost to the foremost. */
function behind({ heights }: KnownElements, all: Uint32Array, cutAt: number): Uint32Array {
  let [low, high] = [Infinity, -Infinity];
  for (const element of all) {
    const height = heights[element] ?? 0;
    [low, high] = [Math.min(low, height), Math.max(high, height)];
  }
  const plane = cutAt < 1 ? low + cutAt * (high - low) : high;
  return all.filter((element) => (heights[element] ?? 0) <= plane);
}
