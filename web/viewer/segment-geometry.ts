import { BufferAttribute, BufferGeometry, InterleavedBuffer, InterleavedBufferAttribute } from "three";

/** Vertices of a segment: two at each end. */
export const segmentVertices = 4;
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
    const corners = new Uint32Array(6 * segments);
    for (let i = 0; i < segments; ++i) {
      const first = segmentVertices * i;
      corners.set([first, first + 1, first + 2, first + 2, first + 1, first + 3], 6 * i);
    }
    this.setIndex(new BufferAttribute(corners, 1));
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

/** Returns segments that all have one state. `ends`: x y z of both ends per segment. */
export function segmentsInState(ends: Float32Array, state: number): SegmentGeometry {
  const segments = ends.length / stride;
  const geometry = new SegmentGeometry(segments);
  geometry.setEnds(ends);
  const states = new Uint8Array(segmentVertices * segments).fill(state);
  geometry.setAttribute("state", new BufferAttribute(states, 1));
  return geometry;
}
