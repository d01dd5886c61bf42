/**
 * Reads VTU and VTP files (VTK XML unstructured grids and polygons) as this package, meshio and ParaView
 * write them: pieces one after the other; arrays as text, in base64 or appended; compressed with zlib or not.
 * The numbers `patch` and `region` of cells tell their groups; vertices and lines are passed over.
 */
import { allBytes, type ByteSource } from "./byte-source.js";
import type { ReadContext } from "./file-format.js";
import type { FileMesh } from "./file-mesh.js";
import { MeshBuilder } from "./mesh-builder.js";
import { NameLines } from "./name-lines.js";
import { firstOf, inSteps, STEP, stepwise, type Steps } from "./steps.js";
import { decodeArray, isReadable, UnpackingBudget, type ArrayCoding, type ArrayFail } from "./vtk-arrays.js";
import {
  addCell,
  cellsOf,
  cellwise,
  PATCH_ARRAYS,
  REGION_ARRAYS,
  type CellNumbers,
  type Fail,
} from "./vtk-cells.js";
import { failIn, readHead, unescaped, type FoundArray, type Head, type Piece } from "./vtk-xml-head.js";

const VTK_POLYGON = 7;
const VTK_STRIP = 6;

/** Of the whole work, roughly, what is done when the bytes are there. */
export const ARRIVAL = 0.25;

/** A file whose tags are known. */
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

  /** Tells that so much of the work is done, of which an array is 1, as are the cells of a piece. Not all, before the end. */
  did(work: number): void {
    this.#done += work;
    this.#onWork?.(Math.min(NEARLY_ALL, this.#done / this.#work));
  }

  /** The numbers of an array. */
  *numbers(found: FoundArray): Steps<Float64Array> {
    const { section, attributes, content } = found;
    const fail: ArrayFail = (message, within = 0) => this.fail(message, this.placeOf(found) + within);
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

  /** Where its values begin; of appended ones that is at their offset. */
  placeOf({ attributes, at }: FoundArray): number {
    const { appended } = this.head;
    const offset = Number(attributes.get("offset") ?? NaN);
    const begin = (appended?.begin ?? NaN) + offset;
    return attributes.get("format") === "appended" && begin < this.#bytes.length ? begin : at;
  }

  /** The array of this name in a section; the first one for the name "". */
  arrayOf(piece: Piece, section: string, name: string): FoundArray {
    return (
      piece.arrays.find(
        (array) => array.section === section && (name === "" || array.attributes.get("Name") === name),
      ) ?? this.fail(`the piece has no array "${name === "" ? section : name}"`, piece.at)
    );
  }

  /** So many bytes are taken beside those of arrays. */
  spend(bytes: number, found: FoundArray): void {
    this.#coding.budget.spend(bytes, (message) => this.fail(message, this.placeOf(found)));
  }

  /** Names that comments tell before the first piece. */
  names(): NameLines {
    const names = new NameLines();
    const begin = new TextDecoder().decode(this.#bytes.subarray(0, this.head.pieces[0]?.at));
    for (const [, line = ""] of begin.matchAll(/<!--([^<>]{1,4000})-->/g)) {
      names.hear(unescaped(line));
    }
    return names;
  }

  fail(message: string, at: number): never {
    return failIn(this.#bytes, message, at, this.head.appended?.begin);
  }
}

const NEARLY_ALL = 0.99;

export async function readVtkXml(source: ByteSource, { signal, onWork }: ReadContext): Promise<FileMesh> {
  const mesh = await inSteps(meshIn(await allBytes(source), onWork), signal);
  onWork?.(1);
  return mesh;
}

function* meshIn(bytes: Uint8Array, onWork: ReadContext["onWork"]): Steps<FileMesh> {
  const file = new XmlFile(bytes, onWork);
  const builder = new MeshBuilder();
  const held: PieceReading[] = [];
  for (const piece of file.head.pieces) {
    const firstNode = builder.pointCount;
    yield* addPoints(piece, file, builder);
    // A piece may be empty where others are not.
    if (builder.pointCount === firstNode) continue;
    const reading = { piece, file, builder, firstNode, pointCount: builder.pointCount - firstNode };
    held.push(reading);
    if (file.head.file.get("type") === "PolyData") yield* addPolygons(reading);
    else yield* addCells(reading);
  }
  yield* addPointData(held, file, builder);
  return file.names().given(builder.mesh());
}

/** A piece whose points are there. */
interface PieceReading {
  readonly piece: Piece;
  readonly file: XmlFile;
  readonly builder: MeshBuilder;
  /** Of the piece; its cells count from there. */
  readonly firstNode: number;
  readonly pointCount: number;
}

function* addPoints(piece: Piece, file: XmlFile, builder: MeshBuilder): Steps<void> {
  for (const [name, value] of piece.attributes)
    if (name.startsWith("NumberOf")) checkCount(piece, file, name, value);
  const announced = piece.attributes.get("NumberOfPoints");
  if (announced === undefined) return file.fail("the piece does not say its NumberOfPoints", piece.at);
  const count = Number(announced);
  if (count === 0) return;
  const array = file.arrayOf(piece, "Points", "");
  const points = yield* file.numbers(array);
  const at = file.placeOf(array);
  if (points.length !== 3 * count)
    file.fail(`there are ${points.length / 3} points, ${count} are announced`, at);
  const wild = yield* firstOf(points, (value) => !Number.isFinite(value));
  if (wild >= 0) file.fail(`point ${Math.floor(wild / 3)} (counted from 0) has no finite place`, at);
  yield* stepwise(count, (p) =>
    builder.addPoint(points[3 * p] ?? 0, points[3 * p + 1] ?? 0, points[3 * p + 2] ?? 0),
  );
}

function checkCount(piece: Piece, file: XmlFile, name: string, value: string): void {
  const count = Number(value);
  if (Number.isSafeInteger(count) && count >= 0) return;
  file.fail(`${name} is "${value.slice(0, 24)}", which is no whole number of 0 or more`, piece.at);
}

/** The numbers at nodes by name, piece after piece; NaN at those of a piece that has none where others do. */
function* addPointData(held: readonly PieceReading[], file: XmlFile, builder: MeshBuilder): Steps<void> {
  const told = held.map(({ piece }) => pointArrays(piece));
  for (const [name, first] of told.flatMap((arrays) => [...arrays])) {
    if (builder.nodeData.has(name)) continue;
    const components = componentsOf(first, file);
    const parts: Float64Array[] = [];
    for (const [p, { pointCount }] of held.entries()) {
      const found = told[p]?.get(name);
      if (found === undefined) file.spend(8 * components * pointCount, first);
      parts.push(
        found === undefined
          ? new Float64Array(components * pointCount).fill(NaN)
          : yield* pointNumbers(found, { file, components, pointCount }),
      );
    }
    builder.nodeData.set(name, { components, values: joinedNumbers(parts) });
  }
}

function componentsOf({ attributes, at }: FoundArray, file: XmlFile): number {
  const word = attributes.get("NumberOfComponents") ?? "1";
  const count = Number(word);
  if (Number.isSafeInteger(count) && count > 0) return count;
  return file.fail(`NumberOfComponents is "${word.slice(0, 24)}", which is no whole number above 0`, at);
}

interface PointNumbers {
  readonly file: XmlFile;
  readonly components: number;
  readonly pointCount: number;
}

function* pointNumbers(
  found: FoundArray,
  { file, components, pointCount }: PointNumbers,
): Steps<Float64Array> {
  const values = yield* file.numbers(found);
  if (values.length === components * pointCount) return values;
  const name = found.attributes.get("Name") ?? "";
  return file.fail(
    `"${name}" has ${values.length} numbers where ${pointCount} points have ${components} each`,
    file.placeOf(found),
  );
}

function pointArrays({ arrays }: Piece): Map<string, FoundArray> {
  const named = new Map<string, FoundArray>();
  for (const array of arrays) {
    if (array.section !== "PointData" || !isReadable(array.attributes.get("type") ?? "")) continue;
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

/** Arrays of one number per cell; only those are read that tell patches or regions. */
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

function* addCells(reading: PieceReading): Steps<void> {
  const { piece, file, builder } = reading;
  const types = file.arrayOf(piece, "Cells", "types");
  const typeOf = yield* file.numbers(types);
  const section = yield* sectionOf(reading, "Cells");
  if (section.offsets.length !== typeOf.length) {
    file.fail("the cells have more or fewer types than offsets", file.placeOf(types));
  }
  const cells = cellsOf(builder, yield* cellData(reading), section.fail);
  yield* eachCell(reading, section, (nodes, cell) => addCell(cells, typeOf[cell] ?? 0, nodes, cell));
}

/** The cells of a polygon file are numbered through vertices, lines, strips, polygons in VTK's order. */
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

/** Cells by their nodes, which are `connectivity` up to the next offset. */
interface CellSection {
  readonly offsets: Float64Array;
  readonly connectivity: Float64Array;
  /** Tells where the nodes of its cells begin. */
  readonly fail: Fail;
}

function* sectionOf({ piece, file }: PieceReading, name: string): Steps<CellSection> {
  const nodes = file.arrayOf(piece, name, "connectivity");
  const fail: Fail = (message) => file.fail(message, file.placeOf(nodes));
  return {
    offsets: yield* file.numbers(file.arrayOf(piece, name, "offsets")),
    connectivity: yield* file.numbers(nodes),
    fail,
  };
}

/** The cells of a section by their nodes in the whole mesh; cells count from 0 in the section. */
function* eachCell(
  { file, builder, firstNode }: PieceReading,
  { offsets, connectivity, fail }: CellSection,
  use: (nodes: readonly number[], cell: number) => void,
): Steps<void> {
  const count = builder.pointCount - firstNode;
  const wild = yield* firstOf(connectivity, (node) => !(Number.isInteger(node) && node >= 0 && node < count));
  if (wild >= 0) fail(`a cell has a corner that is no node of its piece: ${connectivity[wild]}`);
  let begin = 0;
  yield* cellwise(builder, offsets.length, (cell) => {
    const end = offsets[cell] ?? NaN;
    if (!(end >= begin && end <= connectivity.length)) fail(`cell ${cell} (counted from 0) has no corners`);
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
