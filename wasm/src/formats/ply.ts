/**
 * PLY (Stanford polygon format), text and binary of either byte order: x y z of `vertex` and the corners of
 * `face` count. Faces are put into patches by their number `patch`, whose names comments may tell, else by their
 * colour; all other properties and elements are read over. Polygons and strips are cut into triangles.
 */
import { plural } from "../base/plural.js";
import { ByteReader, FIRST_LINE } from "./byte-reader.js";
import type { ByteSource } from "./byte-source.js";
import { colorPatch } from "./colors.js";
import { Column } from "./column.js";
import type { ReadContext } from "./file-format.js";
import type { FileMesh } from "./file-mesh.js";
import { MeshBuilder } from "./mesh-builder.js";
import { NameLines } from "./name-lines.js";
import { UNCUT } from "./polygons.js";

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

/** Faces that came before the points which they are cut by. */
class EarlyFaces {
  readonly #sizes = new Column(Uint32Array);
  readonly #corners = new Column(Uint32Array);
  readonly #patches = new Column(Uint32Array);

  push(corners: readonly number[], patch: number): void {
    this.#sizes.push(corners.length);
    for (const corner of corners) this.#corners.push(corner);
    this.#patches.push(patch);
  }

  addTo(builder: MeshBuilder, reader: ByteReader): void {
    for (let f = 0, begin = 0; f < this.#sizes.length; begin += this.#sizes.at(f++)) {
      const face = Array.from({ length: this.#sizes.at(f) }, (_, i) => this.#corners.at(begin + i));
      addFace(reader, builder, f, face, this.#patches.at(f));
    }
  }
}

interface PlyReading {
  readonly reader: ByteReader;
  readonly read: ReadNumber;
  readonly builder: MeshBuilder;
  /** So many points the header announces. */
  readonly points: number;
  /** Undefined once the points are there. */
  early: EarlyFaces | undefined;
  faces: number;
}

export function readPly(source: ByteSource, { signal }: Pick<ReadContext, "signal"> = {}): Promise<FileMesh> {
  return ByteReader.over(source, { remedy: REMEDY, signal }, async (reader) => {
    if (reader.line() !== "ply") reader.fail('the file does not begin with "ply"', FIRST_LINE);
    const names = new NameLines();
    const { elements, read } = readHeader(reader, names);
    const builder = new MeshBuilder();
    builder.onLongWork = reader.rest;
    const early = new EarlyFaces();
    const isOfPoints = ({ name }: Element) => name === "vertex";
    const points = elements.filter(isOfPoints).reduce((sum, { count }) => sum + count, 0);
    const reading: PlyReading = { reader, read, builder, points, early, faces: 0 };
    for (const [e, element] of elements.entries()) {
      await readElement(reading, element);
      if (e === elements.findLastIndex(isOfPoints)) reading.early = undefined;
    }
    early.addTo(builder, reader);
    if (reading.faces === 0) reader.fail("the file has no face");
    await reader.fill();
    if (/^\s*ply\r?\n/.test(String.fromCharCode(...reader.peek(8)))) {
      reader.fail("another surface begins behind this one");
    }
    return names.given(builder.mesh());
  });
}

function readHeader(reader: ByteReader, names: NameLines): { elements: Element[]; read: ReadNumber } {
  const elements: Element[] = [];
  let read: ReadNumber | undefined;
  for (;;) {
    if (reader.isAtEnd) reader.fail('the file ends before "end_header"');
    const line = reader.line();
    const [word, ...rest] = line.split(/\s+/);
    if (word === "end_header") break;
    if (word === "comment") names.hear(line.slice("comment".length));
    else if (word === "format") read = readerFor(reader, rest[0] ?? "");
    else if (word === "element") {
      const count = reader.count(Number(rest[1]), "elements");
      elements.push({ name: rest[0] ?? "", count, properties: [] });
    } else if (word === "property") {
      const owner = elements.at(-1) ?? reader.fail("a property belongs to no element");
      owner.properties.push(propertyIn(reader, rest));
    }
  }
  // Without properties an element takes no room, and any number of them says nothing.
  const held = elements.filter(({ properties }) => properties.length > 0);
  return { elements: held, read: read ?? reader.fail("the file does not say its format") };
}

function propertyIn(reader: ByteReader, words: readonly string[]): Property {
  const isList = words[0] === "list";
  const [countType, type = "", name = ""] = isList ? words.slice(1) : [undefined, ...words];
  for (const used of isList ? [countType ?? "", type] : [type]) {
    if (!TYPES.has(used)) reader.fail(`numbers of type "${used.slice(0, 24)}" cannot be read`);
  }
  return { name, type, countType };
}

function readerFor(reader: ByteReader, format: string): ReadNumber {
  switch (format) {
    case "ascii":
      return () => reader.number("a property");
    case "binary_little_endian":
    case "binary_big_endian":
      reader.isLittleEndian = format === "binary_little_endian";
      return (type) => {
        const { bytes, kind } = TYPES.get(type) ?? { bytes: 1, kind: "u" };
        return kind === "f" ? reader.float(bytes === 4 ? 4 : 8) : reader.integer(bytes, kind === "i");
      };
    default:
      return reader.fail(`the format "${format.slice(0, 24)}" cannot be read`);
  }
}

async function readElement(reading: PlyReading, { name, count, properties }: Element): Promise<void> {
  const { reader, read, builder } = reading;
  const position = (wanted: string) => properties.findIndex((property) => property.name === wanted);
  const axes = ["x", "y", "z"].map(position);
  if (name === "vertex" && axes.includes(-1)) reader.fail("the points have no x, y and z");
  const corners = properties.findIndex((property) => /^vertex_(index|indices)$/.test(property.name));
  const patch = position("patch");
  const colors = ["red", "green", "blue"].map(position);
  const values = new Float64Array(properties.length);
  const patchOf = (): number => {
    if (patch >= 0) return builder.patches.tagged(values[patch] ?? 0);
    return colorPatch(builder.patches, colors.includes(-1) ? [] : colors.map((at) => values[at] ?? 0));
  };
  let face: number[] = [];
  for (let e = 0; e < count; e++) {
    if (reader.isLow) await reader.fill();
    for (const [p, property] of properties.entries()) {
      if (property.countType === undefined) values[p] = read(property.type);
      else if (name === "face" && p === corners) face = readCorners(reading, property);
      else if (name === "tristrips" && p === corners) await readStrips(reading, property);
      else await skipList(reader, property, read);
    }
    if (name === "face" && corners >= 0) {
      if (reading.early !== undefined) reading.early.push(face, patchOf());
      else addFace(reader, builder, reading.faces, face, patchOf());
      reading.faces++;
    }
    if (name !== "vertex") continue;
    const [x, y, z] = axes.map((axis) => values[axis] ?? NaN);
    if (!(Number.isFinite(x) && Number.isFinite(y) && Number.isFinite(z))) {
      reader.fail(`point ${e} has no finite place`);
    }
    builder.addPoint(x ?? 0, y ?? 0, z ?? 0);
  }
}

async function skipList(reader: ByteReader, { type, countType }: Property, read: ReadNumber): Promise<void> {
  const items = reader.count(read(countType ?? ""), "items of a list");
  for (let i = 0; i < items; i++) {
    if (reader.isLow) await reader.fill();
    read(type);
  }
}

/**
 * Strips in one list, each ended by -1: every corner makes a triangle with the two before it, which turn the other way
 * in every second one. Where two are the same there is none.
 */
async function readStrips(reading: PlyReading, { type, countType }: Property): Promise<void> {
  const { reader, read, builder, early } = reading;
  const items = reader.count(read(countType ?? ""), "corners");
  const patch = colorPatch(builder.patches, []);
  let [a, b, length] = [0, 0, 0];
  for (let i = 0; i < items; i++) {
    if (reader.isLow) await reader.fill();
    const corner = read(type);
    length = corner === -1 ? 0 : length + 1;
    if (length === 0) continue;
    checkCorner(reading, corner);
    if (length > 2 && a !== b && b !== corner && corner !== a) {
      const triangle = length % 2 === 1 ? [a, b, corner] : [b, a, corner];
      if (early === undefined) addFace(reader, builder, reading.faces, triangle, patch);
      else early.push(triangle, patch);
      reading.faces++;
    }
    [a, b] = [b, corner];
  }
}

function checkCorner({ reader, faces, points }: PlyReading, corner: number): void {
  if (Number.isInteger(corner) && corner >= 0 && corner < points) return;
  reader.fail(`face ${faces} has the corner ${corner} of ${plural(points, "point")}, counted from 0`);
}

function readCorners(reading: PlyReading, { type, countType }: Property): number[] {
  const { reader, read, faces } = reading;
  const items = reader.count(read(countType ?? ""), "corners");
  if (items < 3) reader.fail(`face ${faces} has ${plural(items, "corner")}`);
  const corners: number[] = [];
  for (let i = 0; i < items; i++) {
    const corner = read(type);
    checkCorner(reading, corner);
    corners.push(corner);
  }
  return corners;
}

function addFace(
  reader: ByteReader,
  builder: MeshBuilder,
  f: number,
  corners: readonly number[],
  patch: number,
): void {
  if (!builder.addPolygon(corners, patch)) reader.fail(`face ${f} ${UNCUT}`);
}
