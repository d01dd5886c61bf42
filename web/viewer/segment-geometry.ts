import { BufferAttribute, BufferGeometry, InterleavedBuffer, InterleavedBufferAttribute } from "three";

/** Vertices of a segment: two at each end. */
export const segmentVertices = 4;
/** Entries of the index per segment: two triangles. */
export const segmentCorners = 6;
/** Numbers per vertex: x y z of both ends. */
const stride = 6;

/**
 * Segments as rectangles, for `createLineMaterial`. Every vertex has both ends of its segment (`position` and `end`). They
 * are not instances: renderers without a graphics processor draw instances one by one, about ten times as slowly.
 */
export class SegmentGeometry extends BufferGeometry {
  readonly #vertices: InterleavedBuffer;

  /** @param segments number of segments, whose ends `setEnds` writes. */
  constructor(segments: number) {
    super();
    this.#vertices = new InterleavedBuffer(new Float32Array(segmentVertices * stride * segments), stride);
    this.setAttribute("position", new InterleavedBufferAttribute(this.#vertices, 3, 0));
    this.setAttribute("end", new InterleavedBufferAttribute(this.#vertices, 3, 3));
    const corners = new Uint32Array(segmentCorners * segments);
    for (let i = 0; i < segments; ++i) {
      const first = segmentVertices * i;
      corners.set([first, first + 1, first + 2, first + 2, first + 1, first + 3], segmentCorners * i);
    }
    this.setIndex(new BufferAttribute(corners, 1));
  }

  /** Returns another geometry of the same vertices, with an index of its own. */
  sharing(index: Uint32Array<ArrayBuffer>): BufferGeometry {
    const geometry = new BufferGeometry();
    for (const name of Object.keys(this.attributes)) geometry.setAttribute(name, this.getAttribute(name));
    return geometry.setIndex(new BufferAttribute(index, 1));
  }

  /** Writes the ends of all segments: x y z of both ends per segment. */
  setEnds(ends: Float32Array): void {
    const { array } = this.#vertices;
    for (let i = 0; stride * i < ends.length; ++i) {
      const segment = ends.subarray(stride * i, stride * (i + 1));
      for (let vertex = 0; vertex < segmentVertices; ++vertex)
        array.set(segment, stride * (segmentVertices * i + vertex));
    }
    this.#vertices.needsUpdate = true;
  }
}

/**
 * Returns the index of lines one pixel wide, for `createThinLineMaterial`. Segments of a line that follow each other become
 * one, as long as the ends between them lie within `tolerance` of it.
 *
 * @param ends x y z of both ends per segment.
 * @param offsets first segment of each line, and the end.
 */
export function thinIndex(
  ends: ArrayLike<number>,
  offsets: ArrayLike<number>,
  tolerance: number,
): Uint32Array<ArrayBuffer> {
  const index: number[] = [];
  for (let line = 0; line + 1 < offsets.length; ++line) {
    const end = offsets[line + 1] ?? 0;
    for (let first = offsets[line] ?? 0; first < end;) {
      let last = first;
      while (last + 1 < end && isNearChord(ends, first, last + 1, tolerance)) ++last;
      index.push(segmentVertices * first, segmentVertices * (last + 1) - 1);
      first = last + 1;
    }
  }
  return Uint32Array.from(index);
}

/** Returns whether all ends between two segments lie near the straight line from the first end to the last. */
function isNearChord(ends: ArrayLike<number>, first: number, last: number, tolerance: number): boolean {
  const at = (index: number, k: number): number => ends[index + k] ?? 0;
  const [from, to] = [stride * first, stride * last + 3];
  const chord = [0, 1, 2].map((k) => at(to, k) - at(from, k));
  const squared = chord.reduce((sum, x) => sum + x * x, 0);
  for (let i = stride * first + 3; i < to; i += stride) {
    const offset = [0, 1, 2].map((k) => at(i, k) - at(from, k));
    const along = chord.reduce((sum, x, k) => sum + x * (offset[k] ?? 0), 0) / (squared || 1);
    const share = Math.min(1, Math.max(0, along));
    const distance = Math.hypot(...chord.map((x, k) => share * x - (offset[k] ?? 0)));
    if (distance > tolerance) return false;
  }
  return true;
}

/** Returns segments that all have one state. `ends`: x y z of both ends per segment. */
export function segmentsInState(ends: Float32Array, state: number): SegmentGeometry {
  const segments = ends.length / stride;
  const geometry = new SegmentGeometry(segments);
  geometry.setEnds(ends);
  const states = new Uint8Array(segmentVertices * segments).fill(state);
  geometry.setAttribute("state", new BufferAttribute(states, 1));
  return geometry;
}
