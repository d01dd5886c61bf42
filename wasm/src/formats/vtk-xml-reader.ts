/**
 * Reads VTU and VTP files (VTK XML unstructured grids and polygons), as written by this package, meshio and
 * ParaView: several pieces; arrays as text, base64 or appended data, compressed with zlib or not. The cell arrays
 * `patch` and `region` define the groups. Vertices and lines are skipped.
 */
import { plural } from "../base/plural.js";
import { firstOf, STEP, type Steps, stepwise } from "../base/steps.js";
import { inSteps } from "../calls/yielder.js";
import type { Mesh } from "../mesh/mesh.js";
import { allBytes, type ByteSource } from "./byte-source.js";
import type { ReadContext } from "./file-format.js";
import { MeshBuilder } from "./mesh-builder.js";
import { NameLines } from "./name-lines.js";
import { textOf } from "./text-bytes.js";
import { type ArrayCoding, type ArrayFail, decodeArray, isReadable, UnpackingBudget } from "./vtk-arrays.js";
import {
  addCell,
  type CellNumbers,
  type Cells,
  cellsOf,
  cellwise,
  type Fail,
  PATCH_ARRAYS,
  REGION_ARRAYS,
  rowsOfTetrahedra,
} from "./vtk-cells.js";
import { failIn, type FoundArray, type Head, type Piece, readHead } from "./vtk-xml-head.js";
import { xmlInUtf8 } from "./xml-encoding.js";
import { unescaped } from "./xml-tags.js";

const VTK_POLYGON = 7;
const VTK_STRIP = 6;

/** Approximate fraction of the total work done when all bytes have arrived. */
export const ARRIVAL = 0.25;

/** File whose tags have been parsed. */
class XmlFile {
  readonly head: Head;
  readonly #bytes: Uint8Array;
  readonly #coding: Omit<ArrayCoding, "fail">;
  readonly #onWork: ReadContext["onWork"];
  readonly #work: number;
  #done = 0;

  constructor(bytes: Uint8Array, onWork: ReadContext["onWork"]) {
    this.#bytes = bytes;
    this.head = readHead(bytes);
    this.#coding = codingOf(this.head, bytes);
    this.#onWork = onWork;
    this.#work = this.head.pieces.reduce((sum, { arrays }) => sum + arrays.length + 1, 0);
  }

  /**
   * Reports progress. An array counts 1, and so do the cells of a piece. The reported fraction stays below 1 until
   * the end.
   */
  did(work: number): void {
    this.#done += work;
    this.#onWork?.(Math.min(MAX_ESTIMATE, this.#done / this.#work));
  }

  /** Returns the numbers of an array. */
  *numbers(found: FoundArray): Steps<Float64Array> {
    const { section, attributes, content } = found;
    const fail: ArrayFail = (message, within = 0) => this.fail(message, this.offsetOf(found) + within);
    const values = yield* decodeArray(
      { ...this.#coding, fail },
      {
        type: attributes.get("type") ?? "",
        format: attributes.get("format") ?? "ascii",
        offset: Number(attributes.get("offset") ?? NaN),
        content,
        mayBeNone: section === "PointData",
      },
    );
    this.did(1);
    return values;
  }

  /** Returns the offset at which the values begin, also for appended data. */
  offsetOf({ attributes, at }: FoundArray): number {
    const { appended } = this.head;
    const offset = Number(attributes.get("offset") ?? NaN);
    const begin = (appended?.begin ?? NaN) + offset;
    return attributes.get("format") === "appended" && begin < this.#bytes.length ? begin : at;
  }

  /** Returns the array of this name in a section; the first one for the name "". */
  arrayOf(piece: Piece, section: string, name: string): FoundArray {
    return (
      piece.arrays.find(
        (array) => array.section === section && (name === "" || array.attributes.get("Name") === name),
      ) ?? this.fail(`the piece has no array "${name === "" ? section : name}"`, piece.at)
    );
  }

  /** Charges bytes other than those of arrays to the budget. */
  spend(bytes: number, found: FoundArray): void {
    this.#coding.budget.spend(bytes, (message) => this.fail(message, this.offsetOf(found)));
  }

  /** Returns the names defined in comments before the first piece. */
  names(): NameLines {
    const names = new NameLines();
    const begin = textOf(this.#bytes.subarray(0, this.head.pieces[0]?.at));
    for (const [, line = ""] of begin.matchAll(/<!--([^<>]{1,4000})-->/g)) {
      names.readComment(unescaped(line));
    }
    return names;
  }

  fail(message: string, at: number): never {
    return failIn(this.#bytes, message, at, this.head.appended?.begin);
  }
}

const MAX_ESTIMATE = 0.99;

export async function readVtkXml(source: ByteSource, { signal, onWork }: ReadContext): Promise<Mesh> {
  const mesh = await inSteps(meshIn(xmlInUtf8(await allBytes(source)), onWork), signal);
  onWork?.(1);
  return mesh;
}

function* meshIn(bytes: Uint8Array, onWork: ReadContext["onWork"]): Steps<Mesh> {
  const file = new XmlFile(bytes, onWork);
  const builder = new MeshBuilder();
  const held: ReadPiece[] = [];
  for (const piece of file.head.pieces) {
    const firstNode = builder.pointCount;
    yield* addPoints(piece, file, builder);
    // A piece may be empty even if others are not.
    if (builder.pointCount === firstNode) continue;
    const reading = { piece, file, builder, firstNode, pointCount: builder.pointCount - firstNode };
    if (file.head.file.get("type") === "PolyData") {
      yield* addPolygons(reading);
      held.push({ ...reading, tetrahedra: new Uint32Array(), cellCount: 0, groupArrays: new Set() });
    } else {
      held.push({ ...reading, ...(yield* addCells(reading)) });
    }
  }
  yield* addPointData(held, file, builder);
  yield* addElementData(held, file, builder);
  const names = file.names();
  yield* addFieldNames(file, names);
  return names.applyTo(builder.mesh());
}

/**
 * Adds the names in arrays of two whole numbers, the tag and the dimension of a group. Programs that rewrite the file
 * keep these arrays, but not the comments.
 */
function* addFieldNames(file: XmlFile, names: NameLines): Steps<void> {
  for (const found of file.head.fields) {
    const { attributes } = found;
    const isPair = attributes.get("NumberOfTuples") === "2" && !attributes.has("NumberOfComponents");
    if (!isPair || !/^U?Int\d+$/.test(attributes.get("type") ?? "")) continue;
    const [tag = 0, dimension] = yield* file.numbers(found);
    const name = attributes.get("Name") ?? "";
    if (name !== "" && (dimension === 2 || dimension === 3)) names.addName(dimension, tag, name);
  }
}

/** Piece whose points have been added. */
interface PieceReading {
  readonly piece: Piece;
  readonly file: XmlFile;
  readonly builder: MeshBuilder;
  /** First node of the piece; node indices of its cells are relative to it. */
  readonly firstNode: number;
  readonly pointCount: number;
}

/** Cells of a piece. */
interface PieceCells extends Pick<Cells, "groupArrays"> {
  readonly cellCount: number;
  /** Cells that are tetrahedra. */
  readonly tetrahedra: Uint32Array;
}

type ReadPiece = PieceReading & PieceCells;

function* addPoints(piece: Piece, file: XmlFile, builder: MeshBuilder): Steps<void> {
  for (const [name, value] of piece.attributes)
    if (name.startsWith("NumberOf")) checkCount(piece, file, name, value);
  const announced = piece.attributes.get("NumberOfPoints");
  if (announced === undefined) return file.fail("the piece has no NumberOfPoints", piece.at);
  const count = Number(announced);
  if (count === 0) return;
  const array = file.arrayOf(piece, "Points", "");
  const points = yield* file.numbers(array);
  const at = file.offsetOf(array);
  if (points.length !== 3 * count)
    file.fail(`the piece has ${plural(points.length / 3, "point")}, but announces ${count}`, at);
  const wild = yield* firstOf(points, (value) => !Number.isFinite(value));
  if (wild >= 0)
    file.fail(`point ${Math.floor(wild / 3)} (counted from 0) has a coordinate that is not finite`, at);
  yield* stepwise(count, (p) =>
    builder.addPoint(points[3 * p] ?? 0, points[3 * p + 1] ?? 0, points[3 * p + 2] ?? 0),
  );
}

function checkCount(piece: Piece, file: XmlFile, name: string, value: string): void {
  const count = Number(value);
  if (Number.isSafeInteger(count) && count >= 0) return;
  file.fail(`${name} must be a whole number of at least 0, found "${value.slice(0, 24)}"`, piece.at);
}

/** Reads the values at nodes by name, piece by piece; NaN at nodes of a piece that lacks them. */
function* addPointData(held: readonly ReadPiece[], file: XmlFile, builder: MeshBuilder): Steps<void> {
  const arraysOfPieces = held.map(({ piece }) => namedArrays(piece, "PointData"));
  for (const [name, first] of arraysOfPieces.flatMap((arrays) => [...arrays])) {
    if (builder.nodeData.has(name)) continue;
    const components = componentsOf(first, file);
    const parts: Float64Array[] = [];
    for (const [p, { pointCount }] of held.entries()) {
      const found = arraysOfPieces[p]?.get(name);
      if (found === undefined) file.spend(8 * components * pointCount, first);
      parts.push(
        found === undefined
          ? new Float64Array(components * pointCount).fill(NaN)
          : yield* numbersOf(found, { file, components, count: pointCount, word: "points" }),
      );
    }
    builder.nodeData.set(name, { components, values: joinedNumbers(parts) });
  }
}

function componentsOf({ attributes, at }: FoundArray, file: XmlFile): number {
  const word = attributes.get("NumberOfComponents") ?? "1";
  const count = Number(word);
  if (Number.isSafeInteger(count) && count > 0) return count;
  return file.fail(
    `NumberOfComponents must be a whole number of at least 1, found "${word.slice(0, 24)}"`,
    at,
  );
}

interface Rows {
  readonly file: XmlFile;
  readonly components: number;
  readonly count: number;
  /** What has a row each, in messages. */
  readonly word: "points" | "cells";
}

function* numbersOf(found: FoundArray, { file, components, count, word }: Rows): Steps<Float64Array> {
  const values = yield* file.numbers(found);
  if (values.length === components * count) return values;
  const name = found.attributes.get("Name") ?? "";
  return file.fail(
    `"${name}" has ${values.length} values, but ${count} ${word} need ${components} each`,
    file.offsetOf(found),
  );
}

function namedArrays({ arrays }: Piece, section: "PointData" | "CellData"): Map<string, FoundArray> {
  const named = new Map<string, FoundArray>();
  for (const array of arrays) {
    if (array.section !== section || !isReadable(array.attributes.get("type") ?? "")) continue;
    named.set(array.attributes.get("Name") ?? "", array);
  }
  return named;
}

function joinedNumbers(parts: readonly Float64Array[]): Float64Array {
  if (parts.length === 1 && parts[0] !== undefined) return parts[0];
  const joined = new Float64Array(parts.reduce((sum, { length }) => sum + length, 0));
  let end = 0;
  for (const part of parts) {
    joined.set(part, end);
    end += part.length;
  }
  return joined;
}

/** Reads arrays with one number per cell, but only those that define patches or regions. */
function* cellData({ piece, file }: PieceReading): Steps<CellNumbers> {
  const isTaken = (found: FoundArray, name: string) =>
    found.section === "CellData" &&
    found.attributes.get("Name") === name &&
    componentsOf(found, file) === 1 &&
    isReadable(found.attributes.get("type") ?? "");
  const read = new Map<string, Float64Array>();
  for (const names of [PATCH_ARRAYS, REGION_ARRAYS]) {
    const [found] = names.flatMap((name) => piece.arrays.find((array) => isTaken(array, name)) ?? []);
    const name = found?.attributes.get("Name") ?? "";
    if (found !== undefined && !read.has(name)) read.set(name, yield* file.numbers(found));
  }
  return (name) => read.get(name);
}

function* addCells(reading: PieceReading): Steps<PieceCells> {
  const { piece, file, builder } = reading;
  const types = file.arrayOf(piece, "Cells", "types");
  const typeOf = yield* file.numbers(types);
  const section = yield* sectionOf(reading, "Cells");
  if (section.offsets.length !== typeOf.length) {
    const message = `the cells have ${plural(typeOf.length, "type")}, but ${plural(section.offsets.length, "offset")}`;
    file.fail(message, file.offsetOf(types));
  }
  const cells = cellsOf(builder, yield* cellData(reading), section.fail);
  yield* eachCell(reading, section, (nodes, cell) => addCell(cells, typeOf[cell] ?? 0, nodes, cell));
  return {
    cellCount: typeOf.length,
    tetrahedra: cells.tetrahedra.taken(),
    groupArrays: cells.groupArrays,
  };
}

/** Reads the values of tetrahedra by name, piece by piece; NaN in a piece that lacks them. */
function* addElementData(held: readonly ReadPiece[], file: XmlFile, builder: MeshBuilder): Steps<void> {
  if (builder.tetrahedronCount === 0) return;
  const arraysOfPieces = held.map(({ piece }) => namedArrays(piece, "CellData"));
  for (const [name, first] of arraysOfPieces.flatMap((arrays) => [...arrays])) {
    const components = componentsOf(first, file);
    const isGroupArray = components === 1 && held.some(({ groupArrays }) => groupArrays.has(name));
    if (isGroupArray || builder.elementData.has(name)) continue;
    const parts: Float64Array[] = [];
    for (const [p, { cellCount, tetrahedra }] of held.entries()) {
      const found = arraysOfPieces[p]?.get(name);
      if (found === undefined) file.spend(8 * components * tetrahedra.length, first);
      parts.push(
        found === undefined
          ? new Float64Array(components * tetrahedra.length).fill(NaN)
          : yield* rowsOfTetrahedra(
              yield* numbersOf(found, { file, components, count: cellCount, word: "cells" }),
              components,
              tetrahedra,
            ),
      );
    }
    builder.elementData.set(name, { components, values: joinedNumbers(parts) });
  }
}

/** In polygon files, cells are numbered through vertices, lines, strips and polygons in VTK's order. */
function* addPolygons(reading: PieceReading): Steps<void> {
  const { piece, builder } = reading;
  const data = yield* cellData(reading);
  let first = 0;
  for (const name of ["Verts", "Lines", "Polys", "Strips"]) {
    if (!piece.arrays.some((array) => array.section === name)) continue;
    const section = yield* sectionOf(reading, name);
    if (name === "Polys" || name === "Strips") {
      const type = name === "Polys" ? VTK_POLYGON : VTK_STRIP;
      const cells = cellsOf(builder, data, section.fail);
      yield* eachCell(reading, section, (nodes, cell) => addCell(cells, type, nodes, first + cell));
    }
    first += section.offsets.length;
  }
}

/** Cells by their nodes: `connectivity` up to the next offset. */
interface CellSection {
  readonly offsets: Float64Array;
  readonly connectivity: Float64Array;
  /** Fails at the offset at which the nodes of its cells begin. */
  readonly fail: Fail;
}

function* sectionOf({ piece, file }: PieceReading, name: string): Steps<CellSection> {
  const nodes = file.arrayOf(piece, name, "connectivity");
  const fail: Fail = (message) => file.fail(message, file.offsetOf(nodes));
  const ends = file.arrayOf(piece, name, "offsets");
  const offsets = yield* file.numbers(ends);
  const announced = piece.attributes.get(`NumberOf${name}`);
  if (announced !== undefined && Number(announced) !== offsets.length) {
    const message = `the piece has ${plural(offsets.length, "offset")} of ${name}, but announces NumberOf${name}="${announced}"`;
    file.fail(message, file.offsetOf(ends));
  }
  return {
    offsets,
    connectivity: yield* file.numbers(nodes),
    fail,
  };
}

/** Calls `use` with the nodes in the whole mesh of each cell; cells count from 0 in the section. */
function* eachCell(
  { file, builder, firstNode }: PieceReading,
  { offsets, connectivity, fail }: CellSection,
  use: (nodes: readonly number[], cell: number) => void,
): Steps<void> {
  const count = builder.pointCount - firstNode;
  const wild = yield* firstOf(connectivity, (node) => !(Number.isInteger(node) && node >= 0 && node < count));
  if (wild >= 0) fail(`a cell refers to node ${connectivity[wild]}, which its piece does not have`);
  let begin = 0;
  yield* cellwise(builder, offsets.length, (cell) => {
    const end = offsets[cell] ?? NaN;
    if (!(end >= begin && end <= connectivity.length))
      fail(`cell ${cell} (counted from 0) has an invalid list of corners`);
    use(
      Array.from(connectivity.subarray(begin, end), (node) => firstNode + node),
      cell,
    );
    begin = end;
    if ((cell + 1) % STEP === 0) file.did(STEP / offsets.length);
  });
}

function codingOf({ file, pieces, appended }: Head, bytes: Uint8Array): Omit<ArrayCoding, "fail"> {
  return {
    isLittleEndian: file.get("byte_order") !== "BigEndian",
    headerBytes: file.get("header_type") === "UInt64" ? 8 : 4,
    isCompressed: file.has("compressor"),
    appended: appended && bytes.subarray(appended.begin),
    isBase64: appended?.isBase64 ?? false,
    nextOffsets: nextOffsets(pieces.flatMap(({ arrays }) => arrays)),
    budget: new UnpackingBudget(bytes.length),
  };
}

function nextOffsets(arrays: readonly FoundArray[]): Map<number, number> {
  const offsets = arrays.map(({ attributes }) => Number(attributes.get("offset") ?? NaN));
  const sorted = [...new Set(offsets)].filter(Number.isFinite).sort((a, b) => a - b);
  return new Map(sorted.slice(1).map((next, i) => [sorted[i] ?? 0, next]));
}
