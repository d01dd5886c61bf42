/**
 * Reads PLY (Stanford polygon format), text and binary of either byte order: x y z of `vertex`, and the corners of
 * `face`. The patch of a face is its property `patch`, whose names comments may define, else its colour. Other
 * properties and elements are skipped. Polygons and strips are cut into triangles.
 */
import { plural } from "../base/plural.js";
import type { Mesh } from "../mesh/mesh.js";
import { ByteReader, FIRST_LINE } from "./byte-reader.js";
import type { ByteSource } from "./byte-source.js";
import { colorPatch } from "./colors.js";
import { Column } from "./column.js";
import type { ReadContext } from "./file-format.js";
import { MeshBuilder } from "./mesh-builder.js";
import { NameLines } from "./name-lines.js";
import { UNCUT } from "./polygons.js";

const REMEDY = "Export the surface again as a PLY file of triangles.";

/** Bytes of the types, by both of their names; "i" signed, "u" unsigned, "f" floating point. */
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
  /** Type of the number of items; undefined if the property is a single number. */
  readonly countType: string | undefined;
}

interface Element {
  readonly name: string;
  readonly count: number;
  readonly properties: Property[];
}

/** Faces that precede the points needed to cut them. */
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
  /** Number of points announced by the header. */
  readonly points: number;
  /** Undefined once all points are known. */
  early: EarlyFaces | undefined;
  faces: number;
}

export function readPly(source: ByteSource, { signal }: Pick<ReadContext, "signal"> = {}): Promise<Mesh> {
  return ByteReader.over(source, { remedy: REMEDY, signal }, async (reader) => {
    if (reader.line() !== "ply") reader.fail('the file does not begin with "ply"', FIRST_LINE);
    const names = new NameLines();
    const { elements, read } = readHeader(reader, names);
    const builder = new MeshBuilder();
    builder.onLongWork = reader.requestYield;
    const early = new EarlyFaces();
    const isOfPoints = ({ name }: Element) => name === "vertex";
    const points = elements.filter(isOfPoints).reduce((sum, { count }) => sum + count, 0);
    const reading: PlyReading = { reader, read, builder, points, early, faces: 0 };
    for (const [e, element] of elements.entries()) {
      await readElement(reading, element);
      if (e === elements.findLastIndex(isOfPoints)) reading.early = undefined;
    }
    early.addTo(builder, reader);
    if (reading.faces === 0) reader.fail("the file has no faces");
    await reader.fill();
    if (/^\s*ply\r?\n/.test(String.fromCharCode(...reader.peek(8)))) {
      reader.fail("a second surface follows the first one");
    }
    return names.applyTo(builder.mesh());
  });
}

function readHeader(reader: ByteReader, names: NameLines): { elements: Element[]; read: ReadNumber } {
  const elements: Element[] = [];
  let read: ReadNumber | undefined;
  for (;;) {
    if (reader.isAtEnd) reader.failAtEnd('"end_header"');
    const line = reader.line();
    const [word, ...rest] = line.split(/\s+/);
    if (word === "end_header") break;
    if (word === "comment") names.readComment(line.slice("comment".length));
    else if (word === "format") read = readerFor(reader, rest[0] ?? "");
    else if (word === "element") {
      const count = reader.count(Number(rest[1]), "elements");
      elements.push({ name: rest[0] ?? "", count, properties: [] });
    } else if (word === "property") {
      const owner = elements.at(-1) ?? reader.fail("a property is not preceded by an element");
      owner.properties.push(propertyIn(reader, rest));
    }
  }
  // Drop elements without properties: they occupy no bytes.
  const held = elements.filter(({ properties }) => properties.length > 0);
  return { elements: held, read: read ?? reader.fail("the header does not state the format") };
}

function propertyIn(reader: ByteReader, words: readonly string[]): Property {
  const isList = words[0] === "list";
  const [countType, type = "", name = ""] = isList ? words.slice(1) : [undefined, ...words];
  for (const used of isList ? [countType ?? "", type] : [type]) {
    if (!TYPES.has(used)) reader.fail(`unknown number type "${used.slice(0, 24)}"`);
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
      return reader.fail(`unknown format "${format.slice(0, 24)}"`);
  }
}

async function readElement(reading: PlyReading, { name, count, properties }: Element): Promise<void> {
  const { reader, read, builder } = reading;
  const indexOf = (name: string) => properties.findIndex((property) => property.name === name);
  const axes = ["x", "y", "z"].map(indexOf);
  if (name === "vertex" && axes.includes(-1)) reader.fail("the points lack x, y or z");
  const corners = properties.findIndex((property) => /^vertex_(index|indices)$/.test(property.name));
  const patch = indexOf("patch");
  const colors = ["red", "green", "blue"].map(indexOf);
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
      reader.fail(`point ${e} has a coordinate that is not finite`);
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
 * Reads strips in one list, each ended by -1. Each corner forms a triangle with the two before it; every other
 * triangle has the opposite orientation. A triangle with two equal corners is skipped.
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
  reader.fail(
    `face ${faces} (counted from 0) has corner ${corner}, but the file has ${plural(points, "point")}`,
  );
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
