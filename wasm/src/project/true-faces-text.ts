/**
 * The true faces of a body as the text of a project file: base64 of its solids, one after the other. Each has six doubles (factor on
 * its lengths, number of faces, and the counts of numbers, nodes, triangles and zeros to the next multiple of 8 bytes), the numbers as
 * doubles, x y z and u v per node as floats, which are near the faces as they are, and three nodes and the face per triangle as 32-bit
 * whole numbers. All are little-endian.
 */
import { base64Of, bytesOfBase64 } from "../base/base64.js";
import type { TrueFaces } from "../mesh/mesh.js";

const HEAD = 6;
const DOUBLE = 8;

/** Returns the text of the true faces of solids. O(n). */
export function textOfTrueFaces(solids: readonly TrueFaces[]): string {
  const parts = solids.map(bytesOf);
  const bytes = new Uint8Array(parts.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return base64Of(bytes);
}

function bytesOf({
  numbers,
  points,
  parameters,
  triangles,
  faces,
  faceCount,
  placement,
}: TrueFaces): Uint8Array {
  const nodes = points.length / 3;
  const lists = [
    numbers,
    Float32Array.from(points),
    Float32Array.from(parameters),
    triangles,
    faces,
  ] as const;
  const length = lists.reduce((sum, list) => sum + list.byteLength, 0);
  const zeros = (DOUBLE - (length % DOUBLE)) % DOUBLE;
  const head = [placement?.scale ?? 1, faceCount, numbers.length, nodes, faces.length, zeros];
  const bytes = new Uint8Array(HEAD * DOUBLE + length + zeros);
  let at = 0;
  for (const list of [Float64Array.from(head), ...lists]) {
    bytes.set(new Uint8Array(list.buffer, list.byteOffset, list.byteLength), at);
    at += list.byteLength;
  }
  return bytes;
}

/** Returns the true faces of a text; undefined if it is not such a text. O(n). */
export function trueFacesOfText(text: string): TrueFaces[] | undefined {
  const bytes = bytesOfBase64(text);
  if (bytes === undefined || bytes.length % DOUBLE !== 0) return undefined;
  const solids: TrueFaces[] = [];
  for (let at = 0; at < bytes.length;) {
    if (bytes.length - at < HEAD * DOUBLE) return undefined;
    const head = new Float64Array(bytes.buffer, at, HEAD);
    const [scale = 1, faceCount = 0, count = 0, nodes = 0, triangles = 0, zeros = 0] = head;
    const lengths = [DOUBLE * count, 12 * nodes, 8 * nodes, 12 * triangles, 4 * triangles, zeros];
    const end = lengths.reduce((sum, length) => sum + length, at + HEAD * DOUBLE);
    const areWhole = head.subarray(1).every((value) => Number.isInteger(value) && value >= 0);
    if (!areWhole || !(scale > 0 && scale < Infinity) || end > bytes.length) return undefined;
    let next = at + HEAD * DOUBLE;
    const buffers = lengths.map((length) => bytes.buffer.slice(next, (next += length)));
    const [numbers, points, parameters, corners, faces] = buffers as [
      ArrayBuffer,
      ArrayBuffer,
      ArrayBuffer,
      ArrayBuffer,
      ArrayBuffer,
    ];
    const solid: TrueFaces = {
      numbers: new Float64Array(numbers),
      points: Float64Array.from(new Float32Array(points)),
      parameters: Float64Array.from(new Float32Array(parameters)),
      triangles: new Uint32Array(corners),
      faces: new Uint32Array(faces),
      faceCount,
      ...(scale !== 1 && { placement: { scale } }),
    };
    if (solid.triangles.some((node) => node >= nodes) || solid.faces.some((face) => face >= faceCount))
      return undefined;
    solids.push(solid);
    at = end;
  }
  return solids.length > 0 ? solids : undefined;
}
