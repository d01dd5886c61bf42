import type { Trace } from "tetrafront/trace";
import type { Position } from "../../document/position";
import type { ShownElements } from "./player";

/** Number of elements drawn as "recent". */
const recentCount = 60;
/** Elements are drawn smaller, so that each can be seen. */
const shrinking = 0.9;
/** Corners of the faces of a tetrahedron, counter-clockwise seen from outside. */
const faceCorners = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2] as const;

/** Corners of the triangles of an element. */
export const cornersPerElement = faceCorners.length;

/** Writes the triangles of an element to slot `slot` of an array: x y z per corner, relative to the origin. */
export function writeElement(
  target: Float32Array,
  slot: number,
  points: Float64Array,
  nodes: Uint32Array,
  origin: Position,
): void {
  for (let axis = 0; axis < 3; axis++) {
    const along = (corner: number): number => points[3 * (nodes[corner] ?? 0) + axis] ?? 0;
    const centre = (along(0) + along(1) + along(2) + along(3)) / 4;
    faceCorners.forEach((corner, i) => {
      target[3 * (cornersPerElement * slot + i) + axis] =
        centre + shrinking * (along(corner) - centre) - (origin[axis] ?? 0);
    });
  }
}

/** The elements made last, as triangles for the graphics card. */
export class ElementBuffers {
  /** x y z per corner, relative to the origin. */
  readonly positions = new Float32Array(3 * cornersPerElement * recentCount);
  /** Number of the element per corner. */
  readonly values = new Float32Array(cornersPerElement * recentCount);
  readonly #trace: Trace;
  #count = 0;
  #last = 0;

  constructor(trace: Trace) {
    this.#trace = trace;
  }

  /** Number of corners to draw. */
  get cornerCount(): number {
    return cornersPerElement * this.#count;
  }

  /** Values at the ends of the colour scale: the older an element, the darker. */
  get range(): readonly [number, number] {
    return [this.#last - recentCount, this.#last];
  }

  /** Writes the last elements of a state; instead of all, the recent ones. */
  show(step: number, shown: ShownElements, origin: Position): void {
    const { elements, steps } = this.#trace;
    const wanted = shown === "none" ? 0 : shown === "last" ? 1 : recentCount;
    const made = steps.elementsMade[step] ?? 0;
    this.#last = made;
    this.#count = 0;
    for (let element = made - 1; element >= 0 && element >= made - 2 * recentCount; element--) {
      if (this.#count === wanted) return;
      if ((elements.died[element] ?? 0) > step) this.#write(element, origin);
    }
  }

  #write(element: number, origin: Position): void {
    const { elements, nodes } = this.#trace;
    const corners = elements.nodes.subarray(4 * element, 4 * element + 4);
    const slot = this.#count++;
    writeElement(this.positions, slot, nodes.positions, corners, origin);
    this.values.fill(element, cornersPerElement * slot, cornersPerElement * (slot + 1));
  }
}
