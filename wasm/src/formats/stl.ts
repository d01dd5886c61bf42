/**
 * STL, binary and ASCII: triangle soup, whose equal corners are welded exactly. Some binary files begin
 * with the word "solid" as ASCII ones do, so the size decides: a binary file of n triangles has exactly
 * 84 + 50 n bytes. Normals, colours and names are not used; several solids become one surface.
 */
import { ReadFailure, readSafely, type ReadResult } from "../read-result.js";
import type { SurfaceInput } from "../types.js";
import { TextScanner } from "./text-scanner.js";
import { weldPoints } from "./weld.js";

const HEADER_BYTES = 80;
const COUNT_BYTES = 4;
/** Normal and three corners as float32, and two bytes of attributes. */
const TRIANGLE_BYTES = 50;
const NORMAL_BYTES = 12;
/** How much of a file is looked at to tell text from binary. */
const SNIFFED_BYTES = 1024;

const REMEDY = "Export the surface again; the file is damaged or is not STL.";

/** Reads an STL file. Corners of one place become one node; -0 is 0. */
export function readStl(bytes: Uint8Array): ReadResult<SurfaceInput> {
  return readSafely(() => {
    if (bytes.length === 0)
      throw new ReadFailure({ message: "the file is empty", remedy: REMEDY, offset: 0 });
    const corners = isBinary(bytes) ? readBinary(bytes) : readText(bytes);
    const { points, positions } = weldPoints(corners);
    return { points, triangles: positions };
  });
}

function isBinary(bytes: Uint8Array): boolean {
  if (bytes.length === sizeOf(announcedTriangles(bytes))) return true;
  const head = bytes.subarray(0, SNIFFED_BYTES);
  const startsLikeText = /^\s*solid/i.test(String.fromCharCode(...head.subarray(0, HEADER_BYTES)));
  return !startsLikeText || head.includes(0);
}

function sizeOf(triangles: number): number {
  return HEADER_BYTES + COUNT_BYTES + TRIANGLE_BYTES * triangles;
}

/** What a binary file says it holds; NaN where it is too short to say. */
function announcedTriangles(bytes: Uint8Array): number {
  if (bytes.length < HEADER_BYTES + COUNT_BYTES) return NaN;
  return new DataView(bytes.buffer, bytes.byteOffset).getUint32(HEADER_BYTES, true);
}

function readBinary(bytes: Uint8Array): Float64Array {
  const count = announcedTriangles(bytes);
  if (Number.isNaN(count)) {
    const message = `it has ${bytes.length} bytes, too few for an STL file`;
    throw new ReadFailure({ message, remedy: REMEDY, offset: bytes.length });
  }
  const head = bytes.subarray(0, SNIFFED_BYTES);
  if (bytes.length !== sizeOf(count) && !head.includes(0)) {
    const message = 'this is text, but not an STL file: it does not begin with "solid"';
    throw new ReadFailure({ message, remedy: REMEDY, offset: 0 });
  }
  if (bytes.length < sizeOf(count)) {
    const message =
      `the file ends at byte ${bytes.length}, but the ${count} triangles it announces ` +
      `need ${sizeOf(count)} bytes`;
    throw new ReadFailure({ message, remedy: REMEDY, offset: bytes.length });
  }
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const corners = new Float64Array(9 * count);
  for (let t = 0, out = 0; t < count; t++) {
    const begin = HEADER_BYTES + COUNT_BYTES + TRIANGLE_BYTES * t + NORMAL_BYTES;
    for (let i = 0; i < 9; i++) corners[out++] = view.getFloat32(begin + 4 * i, true);
  }
  return corners;
}

function readText(bytes: Uint8Array): Float64Array {
  const scanner = new TextScanner(bytes, { remedy: REMEDY });
  const corners: number[] = [];
  for (let word = scanner.next(); word !== undefined; word = scanner.next()) {
    switch (word.toLowerCase()) {
      case "solid":
      case "endsolid":
        // What follows is a name, which may hold any words.
        scanner.skipLine();
        break;
      case "facet":
        readFacet(scanner, corners);
        break;
      default:
        scanner.fail(`"${word.slice(0, 24)}" where "facet" or "endsolid" should be`);
    }
  }
  return Float64Array.from(corners);
}

function readFacet(scanner: TextScanner, corners: number[]): void {
  expectWord(scanner, "normal");
  // The normal follows from the corners; here it may be anything, as some programs write NaN.
  for (let i = 0; i < 3; i++) scanner.next();
  expectWord(scanner, "outer");
  expectWord(scanner, "loop");
  for (let corner = 0; corner < 3; corner++) {
    expectWord(scanner, "vertex");
    for (let i = 0; i < 3; i++) corners.push(scanner.number("a coordinate"));
  }
  expectWord(scanner, "endloop");
  expectWord(scanner, "endfacet");
}

function expectWord(scanner: TextScanner, wanted: string): void {
  const word = scanner.next() ?? scanner.fail(`the file ends where "${wanted}" should be`);
  if (word.toLowerCase() !== wanted) scanner.fail(`"${word.slice(0, 24)}" where "${wanted}" should be`);
}
