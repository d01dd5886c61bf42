/**
 * OFF (Geomview's object file format), as text: corners by number, `#` begins a comment. Colours,
 * normals and texture coordinates of the variants are read over. Convex polygons are cut into
 * triangles from their first corner, which changes nothing about a plane face.
 */
import { ReadFailure, readSafely, type ReadResult } from "../read-result.js";
import type { SurfaceInput } from "../types.js";
import { addPolygon } from "./polygons.js";
import { TextScanner } from "./text-scanner.js";
import { weldPoints } from "./weld.js";

const REMEDY = "Export the surface again as an OFF file in text form.";
/** More than these would be written as a triangle soup of a different format, or are garbage. */
const MAX_COUNT = 0x7fffffff;

/** Reads an OFF file. Points of one place become one node; -0 is 0. */
export function readOff(bytes: Uint8Array): ReadResult<SurfaceInput> {
  return readSafely(() => {
    if (bytes.length === 0)
      throw new ReadFailure({ message: "the file is empty", remedy: REMEDY, offset: 0 });
    const scanner = new TextScanner(bytes, { comment: "#", remedy: REMEDY });
    const hasExtras = readHeader(scanner);
    const pointCount = scanner.index("the number of points", MAX_COUNT);
    const faceCount = scanner.index("the number of faces", MAX_COUNT);
    scanner.index("the number of edges", MAX_COUNT);
    const given = readPoints(scanner, pointCount, hasExtras);
    const { points, positions } = weldPoints(given);
    const corners = readFaces(scanner, faceCount, given);
    return { points, triangles: Uint32Array.from(corners, (corner) => positions[corner] ?? 0) };
  });
}

/** Whether more than x y z may stand in a point's line. */
function readHeader(scanner: TextScanner): boolean {
  const word = scanner.next();
  const variant = /^(ST)?(C)?(N)?(4)?(n)?OFF$/.exec(word ?? "");
  if (variant === null) return scanner.fail('the file does not begin with "OFF"');
  if (variant[4] !== undefined || variant[5] !== undefined) {
    return scanner.fail(`"${word}" has points of other than three dimensions`);
  }
  return word !== "OFF";
}

function readPoints(scanner: TextScanner, count: number, hasExtras: boolean): Float64Array {
  // Grows with the file, not with what its header claims.
  const points: number[] = [];
  for (let i = 0; i < count; i++) {
    for (let axis = 0; axis < 3; axis++) points.push(scanner.number(`a coordinate of point ${i}`));
    if (hasExtras) scanner.skipLine();
  }
  return Float64Array.from(points);
}

function readFaces(scanner: TextScanner, count: number, points: Float64Array): number[] {
  const triangles: number[] = [];
  for (let f = 0; f < count; f++) {
    const size = scanner.index(`the number of corners of face ${f}`, MAX_COUNT);
    if (size < 3) scanner.fail(`face ${f} has ${size} corners`);
    const corners: number[] = [];
    for (let i = 0; i < size; i++) corners.push(scanner.index(`a corner of face ${f}`, points.length / 3));
    if (!addPolygon(corners, points, triangles)) {
      scanner.fail(`face ${f} is a polygon that is not convex and cannot be cut into triangles safely`);
    }
    // A colour may follow, of one to four numbers.
    scanner.skipLine();
  }
  return triangles;
}
