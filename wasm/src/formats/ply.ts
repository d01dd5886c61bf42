/**
 * PLY (Stanford polygon format), text and binary of either byte order: x y z of `vertex` and the corners
 * of `face` count; all other properties and elements are read over. Convex polygons are cut into triangles.
 */
import { ReadFailure, readSafely, type ReadResult } from "../read-result.js";
import type { SurfaceInput } from "../types.js";
import { ByteCursor } from "./byte-cursor.js";
import { addPolygon } from "./polygons.js";
import { weldPoints } from "./weld.js";

const REMEDY = "Export the surface again as a PLY file of triangles.";

/** Bytes of the types, by both of their names; "f" for floating point, "u" for unsigned. */
const TYPES: ReadonlyMap<string, { readonly bytes: 1 | 2 | 4 | 8; readonly kind: "i" | "u" | "f" }> = new Map(
  (
    [
      ["char int8", 1, "i"],
      ["uchar uint8", 1, "u"],
      ["short int16", 2, "i"],
      ["ushort uint16", 2, "u"],
      ["int int32", 4, "i"],
      ["uint uint32", 4, "u"],
      ["float float32", 4, "f"],
      ["double float64", 8, "f"],
    ] as const
  ).flatMap(([names, bytes, kind]) => names.split(" ").map((name) => [name, { bytes, kind }] as const)),
);

/** Reads the next number of a type. */
type ReadNumber = (type: string) => number;

interface Property {
  readonly name: string;
  readonly type: string;
  /** Of the number of items; undefined where the property is a single number. */
  readonly countType: string | undefined;
}

interface Element {
  readonly name: string;
  readonly count: number;
  readonly properties: Property[];
}

/** Reads a PLY file. Points of one place become one node; -0 is 0. */
export function readPly(bytes: Uint8Array): ReadResult<SurfaceInput> {
  return readSafely(() => {
    if (bytes.length === 0)
      throw new ReadFailure({ message: "the file is empty", remedy: REMEDY, offset: 0 });
    const cursor = new ByteCursor(bytes, REMEDY);
    if (cursor.line().trim() !== "ply") {
      throw new ReadFailure({ message: 'the file does not begin with "ply"', remedy: REMEDY });
    }
    const { elements, read } = readHeader(cursor);
    const given: number[] = [];
    const faces: number[][] = [];
    for (const element of elements) readElement(cursor, element, read, given, faces);
    const corners: number[] = [];
    faces.forEach((face, f) => addFace(cursor, face, f, given, corners));
    if (corners.length === 0) cursor.fail("the file has no face");
    const { points, positions } = weldPoints(Float64Array.from(given));
    return { points, triangles: Uint32Array.from(corners, (corner) => positions[corner] ?? 0) };
  });
}

function readHeader(cursor: ByteCursor): { elements: Element[]; read: ReadNumber } {
  const elements: Element[] = [];
  let read: ReadNumber | undefined;
  for (;;) {
    if (cursor.left === 0) cursor.fail('the file ends before "end_header"');
    const [word, ...rest] = cursor.line().trim().split(/\s+/);
    if (word === "end_header") break;
    if (word === "format") read = readerFor(cursor, rest[0] ?? "");
    else if (word === "element") {
      elements.push({ name: rest[0] ?? "", count: Number(rest[1]), properties: [] });
    } else if (word === "property") {
      const owner = elements.at(-1) ?? cursor.fail("a property belongs to no element");
      owner.properties.push(propertyIn(cursor, rest));
    }
  }
  return { elements, read: read ?? cursor.fail("the file does not say its format") };
}

function propertyIn(cursor: ByteCursor, words: readonly string[]): Property {
  const isList = words[0] === "list";
  const [countType, type = "", name = ""] = isList ? words.slice(1) : [undefined, ...words];
  for (const used of isList ? [countType ?? "", type] : [type]) {
    if (!TYPES.has(used)) cursor.fail(`numbers of type "${used.slice(0, 24)}" cannot be read`);
  }
  return { name, type, countType };
}

function readerFor(cursor: ByteCursor, format: string): ReadNumber {
  switch (format) {
    case "ascii":
      return () => cursor.number();
    case "binary_little_endian":
    case "binary_big_endian":
      cursor.isLittleEndian = format === "binary_little_endian";
      return (type) => {
        const { bytes, kind } = TYPES.get(type) ?? { bytes: 1, kind: "u" };
        return kind === "f" ? cursor.float(bytes === 4 ? 4 : 8) : cursor.integer(bytes, kind === "i");
      };
    default:
      return cursor.fail(`the format "${format.slice(0, 24)}" cannot be read`);
  }
}

function readElement(
  cursor: ByteCursor,
  { name, count, properties }: Element,
  read: ReadNumber,
  points: number[],
  faces: number[][],
): void {
  // Without properties an element takes no room, and any number of them says nothing.
  if (properties.length === 0) return;
  cursor.count(count, 1, `elements "${name.slice(0, 24)}"`);
  const axes = ["x", "y", "z"].map((axis) => properties.findIndex((property) => property.name === axis));
  if (name === "vertex" && axes.includes(-1)) cursor.fail("the points have no x, y and z");
  for (let e = 0; e < count; e++) {
    const values = properties.map((property) => {
      if (property.countType === undefined) return read(property.type);
      const items = cursor.count(read(property.countType), 1, "items of a list");
      const list = Array.from({ length: items }, () => read(property.type));
      if (name === "face" && /^vertex_(index|indices)$/.test(property.name)) faces.push(list);
      return NaN;
    });
    if (name !== "vertex") continue;
    for (const axis of axes) {
      const value = values[axis] ?? NaN;
      points.push(Number.isFinite(value) ? value : cursor.fail(`point ${e} has no finite place`));
    }
  }
}

function addFace(
  cursor: ByteCursor,
  face: readonly number[],
  f: number,
  points: readonly number[],
  triangles: number[],
): void {
  const count = points.length / 3;
  if (face.length < 3) cursor.fail(`face ${f} has ${face.length} corners`);
  const wild = face.find((corner) => !(Number.isInteger(corner) && corner >= 0 && corner < count));
  if (wild !== undefined) cursor.fail(`face ${f} has the corner ${wild}, there are ${count} points`);
  if (!addPolygon(face, points, triangles)) {
    cursor.fail(`face ${f} is a polygon that is not convex and cannot be cut into triangles safely`);
  }
}
