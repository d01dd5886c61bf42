/**
 * OBJ (Wavefront), as text: `v` and `f` count, a corner being the first number of its group. Normals,
 * texture coordinates, materials, groups, lines and points are read over; convex polygons are cut into
 * triangles; curves and surfaces that need more than corners are refused.
 */
import { ReadFailure, readSafely, type ReadResult } from "../read-result.js";
import type { SurfaceInput } from "../types.js";
import { addPolygon } from "./polygons.js";
import { TextScanner } from "./text-scanner.js";
import { weldPoints } from "./weld.js";

const REMEDY = "Export the surface again as an OBJ file of triangles.";
/** Words that begin free-form geometry, which a mesh would be missing. */
const FREE_FORM = new Set(["curv", "curv2", "surf", "cstype", "deg", "bmat"]);

/** Reads an OBJ file; all its objects become one surface. Points of one place become one node; -0 is 0. */
export function readObj(bytes: Uint8Array): ReadResult<SurfaceInput> {
  return readSafely(() => {
    if (bytes.length === 0)
      throw new ReadFailure({ message: "the file is empty", remedy: REMEDY, offset: 0 });
    const scanner = new TextScanner(bytes, { comment: "#", remedy: REMEDY });
    const given: number[] = [];
    const corners: number[] = [];
    for (let word = scanner.next(); word !== undefined; word = scanner.next()) {
      if (word === "v") {
        for (let axis = 0; axis < 3; axis++) given.push(scanner.number("a coordinate"));
      } else if (word === "f") readFace(scanner, given, corners);
      else if (FREE_FORM.has(word)) scanner.fail(`"${word}" begins a curve or surface that is no polygon`);
      // A weight or colour after a point, and everything that is neither.
      scanner.skipLine();
    }
    if (corners.length === 0) scanner.fail("the file has no face");
    const { points, positions } = weldPoints(Float64Array.from(given));
    return { points, triangles: Uint32Array.from(corners, (corner) => positions[corner] ?? 0) };
  });
}

function readFace(scanner: TextScanner, points: readonly number[], triangles: number[]): void {
  const count = points.length / 3;
  const corners: number[] = [];
  for (let word = nextCorner(scanner); word !== undefined; word = nextCorner(scanner)) {
    const given = Number(word.split("/")[0]);
    // From 1; below 0 they count backwards from the last point so far.
    const corner = given < 0 ? count + given : given - 1;
    if (word.startsWith("/") || !Number.isInteger(corner) || corner < 0 || corner >= count) {
      scanner.fail(`"${word.slice(0, 24)}" is no corner among the ${count} points so far`);
    }
    corners.push(corner);
  }
  if (corners.length < 3) scanner.fail(`a face has ${corners.length} corners`);
  if (!addPolygon(corners, points, triangles)) {
    scanner.fail("a face is a polygon that is not convex and cannot be cut into triangles safely");
  }
}

/** The next word of the face; a backslash at the end of a line continues it on the next. */
function nextCorner(scanner: TextScanner): string | undefined {
  const word = scanner.nextInLine();
  return word === "\\" ? scanner.next() : word;
}
