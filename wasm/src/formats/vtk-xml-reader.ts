/**
 * Reads VTU and VTP files (VTK XML unstructured grids and polygons) as this package, meshio and ParaView
 * write them: pieces one after the other; arrays as text, in base64 or appended; compressed with zlib or not.
 * The numbers `patch` and `region` of cells tell their groups; vertices and lines are passed over.
 */
import { failureAt } from "../read-result.js";
import { allBytes, type ByteSource } from "./byte-source.js";
import type { FileMesh } from "./file-mesh.js";
import { MeshBuilder } from "./mesh-builder.js";
import { NameLines } from "./name-lines.js";
import { decodeArray, UnpackingBudget, type ArrayCoding, type ArrayFail } from "./vtk-arrays.js";
import { addCell, cellsOf, type Fail } from "./vtk-cells.js";

const REMEDY = "Save the mesh again as .vtu or .vtp with triangles or linear tetrahedra.";
const VTK_POLYGON = 7;
const VTK_STRIP = 6;
/** Sections in which arrays are looked for. Those of cells in polygon files are named by their kind. */
const SECTIONS = new Set(["Points", "Cells", "Verts", "Lines", "Strips", "Polys", "PointData", "CellData"]);

/** A tag, in whose values there may be what ends it elsewhere. */
const TAG = /<(\/?)([A-Za-z]+)((?:"[^"<]*"|'[^'<]*'|[^<>"'])*)>/g;

type Attributes = ReadonlyMap<string, string>;

/** An array before its numbers are read. */
interface FoundArray {
  readonly section: string;
  readonly attributes: Attributes;
  /** What stands between its tags, and where that begins. */
  readonly content: string;
  readonly at: number;
}

interface Piece {
  /** Where its tag begins. */
  readonly at: number;
  readonly attributes: Attributes;
  readonly arrays: FoundArray[];
}

interface Head {
  readonly file: Attributes;
  readonly pieces: readonly Piece[];
  /** What follows the underscore of the appended data, and whether it is base64. */
  readonly appended: { readonly begin: number; readonly isBase64: boolean } | undefined;
}

/** A file whose tags are known; each byte is a character of its text. */
class XmlFile {
  readonly head: Head;
  readonly #bytes: Uint8Array;
  readonly #text: string;
  readonly #coding: Omit<ArrayCoding, "fail">;

  constructor(bytes: Uint8Array) {
    this.#bytes = bytes;
    this.#text = new TextDecoder("latin1").decode(bytes);
    this.head = readHead(this.#text);
    this.#coding = codingOf(this.head, bytes, this.#text);
  }

  /** The numbers of an array. */
  numbers(found: FoundArray): Float64Array {
    const { attributes, content } = found;
    const fail: ArrayFail = (message, within = 0) => this.fail(message, this.placeOf(found) + within);
    return decodeArray(
      { ...this.#coding, fail },
      {
        type: attributes.get("type") ?? "",
        format: attributes.get("format") ?? "ascii",
        offset: Number(attributes.get("offset") ?? NaN),
        content,
      },
    );
  }

  /** Where its values begin; of appended ones that is at their offset. */
  placeOf({ attributes, at }: FoundArray): number {
    const { appended } = this.head;
    const offset = Number(attributes.get("offset") ?? NaN);
    const begin = (appended?.begin ?? NaN) + offset;
    return attributes.get("format") === "appended" && begin < this.#text.length ? begin : at;
  }

  /** The array of this name in a section; the first one for the name "". */
  arrayOf(piece: Piece, section: string, name: string): FoundArray {
    return (
      piece.arrays.find(
        (array) => array.section === section && (name === "" || array.attributes.get("Name") === name),
      ) ?? this.fail(`the piece has no array "${name === "" ? section : name}"`, piece.at)
    );
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
    return failIn(this.#text, message, at, this.head.appended?.begin);
  }
}

function unescaped(line: string): string {
  const characters: Readonly<Record<string, string>> = { lt: "<", gt: ">", "#45": "-", amp: "&" };
  return line.replace(/&(lt|gt|#45|amp);/g, (_, name: string) => characters[name] ?? "");
}

/** `at`: a character, counted as a line up to where data that are no text begin. */
function failIn(text: string, message: string, at: number, dataBegin = Infinity): never {
  const place = at < dataBegin ? { line: text.slice(0, at).split(/\r\n?|\n/).length } : { offset: at };
  throw failureAt(place, message, REMEDY);
}

export async function readVtkXml(source: ByteSource): Promise<FileMesh> {
  const file = new XmlFile(await allBytes(source));
  const builder = new MeshBuilder();
  for (const piece of file.head.pieces) {
    const firstNode = builder.pointCount;
    addPoints(piece, file, builder);
    // A piece may be empty where others are not.
    if (builder.pointCount === firstNode) continue;
    const reading = { piece, file, builder, firstNode };
    if (file.head.file.get("type") === "PolyData") addPolygons(reading);
    else addCells(reading);
  }
  addPointData(file, builder);
  return file.names().given(builder.mesh());
}

/** A piece whose points are there. */
interface PieceReading {
  readonly piece: Piece;
  readonly file: XmlFile;
  readonly builder: MeshBuilder;
  /** Of the piece; its cells count from there. */
  readonly firstNode: number;
}

function addPoints(piece: Piece, file: XmlFile, builder: MeshBuilder): void {
  for (const [name, value] of piece.attributes)
    if (name.startsWith("NumberOf")) checkCount(piece, file, name, value);
  const announced = piece.attributes.get("NumberOfPoints");
  if (announced === undefined) return file.fail("the piece does not say its NumberOfPoints", piece.at);
  const count = Number(announced);
  if (count === 0) return;
  const array = file.arrayOf(piece, "Points", "");
  const points = file.numbers(array);
  const at = file.placeOf(array);
  if (points.length !== 3 * count)
    file.fail(`there are ${points.length / 3} points, ${count} are announced`, at);
  const wild = points.findIndex((value) => !Number.isFinite(value));
  if (wild >= 0) file.fail(`point ${Math.floor(wild / 3)} (counted from 0) has no finite place`, at);
  for (let i = 0; i < points.length; i += 3) {
    builder.addPoint(points[i] ?? 0, points[i + 1] ?? 0, points[i + 2] ?? 0);
  }
}

function checkCount(piece: Piece, file: XmlFile, name: string, value: string): void {
  const count = Number(value);
  if (Number.isSafeInteger(count) && count >= 0) return;
  file.fail(`${name} is "${value.slice(0, 24)}", which is no whole number of 0 or more`, piece.at);
}

/** What all pieces that tell anything of their nodes have under one name, piece after piece. */
function addPointData(file: XmlFile, builder: MeshBuilder): void {
  const told = file.head.pieces.map(pointArrays);
  for (const [name, found] of told.find(({ size }) => size > 0) ?? []) {
    const parts = told.map((arrays) => arrays.get(name));
    const values = joinedNumbers(parts.map((part) => (part === undefined ? NO_NUMBERS : file.numbers(part))));
    const components = Number(found.attributes.get("NumberOfComponents") ?? 1);
    if (values.length === components * builder.pointCount) builder.nodeData.set(name, { components, values });
  }
}

function pointArrays({ arrays }: Piece): Map<string, FoundArray> {
  const named = new Map<string, FoundArray>();
  for (const array of arrays) {
    if (array.section !== "PointData" || array.attributes.get("type") === "String") continue;
    named.set(array.attributes.get("Name") ?? "", array);
  }
  return named;
}

const NO_NUMBERS = new Float64Array();

function joinedNumbers(parts: readonly Float64Array[]): Float64Array {
  const joined = new Float64Array(parts.reduce((sum, { length }) => sum + length, 0));
  let end = 0;
  for (const part of parts) {
    joined.set(part, end);
    end += part.length;
  }
  return joined;
}

/** Arrays of one number per cell. */
function cellData({ piece, file }: PieceReading): Map<string, Float64Array> {
  const data = new Map<string, Float64Array>();
  for (const found of piece.arrays) {
    if (found.section !== "CellData" || found.attributes.get("type") === "String") continue;
    if (Number(found.attributes.get("NumberOfComponents") ?? 1) > 1) continue;
    data.set(found.attributes.get("Name") ?? "", file.numbers(found));
  }
  return data;
}

function addCells(reading: PieceReading): void {
  const { piece, file, builder } = reading;
  const types = file.arrayOf(piece, "Cells", "types");
  const typeOf = file.numbers(types);
  const section = sectionOf(reading, "Cells");
  if (section.offsets.length !== typeOf.length) {
    file.fail("the cells have more or fewer types than offsets", file.placeOf(types));
  }
  const cells = cellsOf(builder, cellData(reading), section.fail);
  eachCell(reading, section, (nodes, cell) => addCell(cells, typeOf[cell] ?? 0, nodes, cell));
}

/** The cells of a polygon file are numbered through vertices, lines, strips, polygons in VTK's order. */
function addPolygons(reading: PieceReading): void {
  const { piece, builder } = reading;
  const data = cellData(reading);
  let first = 0;
  for (const name of ["Verts", "Lines", "Polys", "Strips"]) {
    if (!piece.arrays.some((array) => array.section === name)) continue;
    const section = sectionOf(reading, name);
    if (name === "Polys" || name === "Strips") {
      const type = name === "Polys" ? VTK_POLYGON : VTK_STRIP;
      const cells = cellsOf(builder, data, section.fail);
      eachCell(reading, section, (nodes, cell) => addCell(cells, type, nodes, first + cell));
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

function sectionOf({ piece, file }: PieceReading, name: string): CellSection {
  const nodes = file.arrayOf(piece, name, "connectivity");
  const fail: Fail = (message) => file.fail(message, file.placeOf(nodes));
  return {
    offsets: file.numbers(file.arrayOf(piece, name, "offsets")),
    connectivity: file.numbers(nodes),
    fail,
  };
}

/** The cells of a section by their nodes in the whole mesh; cells count from 0 in the section. */
function eachCell(
  { builder, firstNode }: PieceReading,
  { offsets, connectivity, fail }: CellSection,
  use: (nodes: readonly number[], cell: number) => void,
): void {
  const count = builder.pointCount - firstNode;
  const wild = connectivity.find((node) => !(Number.isInteger(node) && node >= 0 && node < count));
  if (wild !== undefined) fail(`a cell has a corner that is no node of its piece: ${wild}`);
  let begin = 0;
  for (const [cell, end] of offsets.entries()) {
    if (!(end >= begin && end <= connectivity.length)) fail(`cell ${cell} (counted from 0) has no corners`);
    use(
      Array.from(connectivity.subarray(begin, end), (node) => firstNode + node),
      cell,
    );
    begin = end;
  }
}

function readHead(text: string): Head {
  let file: Attributes | undefined;
  const pieces: Piece[] = [];
  let section = "";
  for (const match of text.matchAll(TAG)) {
    const [tag, slash, name = "", rest = ""] = match;
    const end = match.index + tag.length;
    const attributes = attributesIn(rest);
    if (slash === "/") {
      if (name === section) section = "";
    } else if (name === "VTKFile") file = attributes;
    else if (name === "Piece") pieces.push({ at: match.index, attributes, arrays: [] });
    else if (SECTIONS.has(name)) section = rest.endsWith("/") ? section : name;
    else if (name === "DataArray" && section !== "") {
      const close = rest.endsWith("/") ? end : text.indexOf("<", end);
      const content = text.slice(end, close < 0 ? end : close);
      pieces.at(-1)?.arrays.push({ section, attributes, content, at: end });
    } else if (name === "AppendedData") {
      const begin = text.indexOf("_", end) + 1;
      const isBase64 = attributes.get("encoding") === "base64";
      return checkedHead(text, file, pieces, { begin: begin === 0 ? text.length : begin, isBase64 });
    }
  }
  return checkedHead(text, file, pieces, undefined);
}

function checkedHead(
  text: string,
  file: Attributes | undefined,
  pieces: readonly Piece[],
  appended: Head["appended"],
): Head {
  const type = file?.get("type");
  if (file === undefined || (type !== "UnstructuredGrid" && type !== "PolyData"))
    return failIn(
      text,
      "this is neither a VTU nor a VTP file: it has no unstructured grid and no polygons",
      0,
    );
  if (pieces.length === 0) return failIn(text, "the file has no piece", text.length, appended?.begin);
  const compressor = file.get("compressor");
  if (compressor !== undefined && compressor !== "vtkZLibDataCompressor") {
    const message = `the compressor ${compressor} is not known, only vtkZLibDataCompressor`;
    failIn(text, message, text.indexOf("<VTKFile"));
  }
  return { file, pieces, appended };
}

/** name="value" pairs, or name='value'. */
function attributesIn(text: string): Attributes {
  const pairs = text.matchAll(/([^\s="']{1,100})\s*=\s*(?:"([^"]*)"|'([^']*)')/g);
  return new Map([...pairs].map(([, name = "", double, single]) => [name, double ?? single ?? ""]));
}

function codingOf(
  { file, pieces, appended }: Head,
  bytes: Uint8Array,
  text: string,
): Omit<ArrayCoding, "fail"> {
  return {
    isLittleEndian: file.get("byte_order") !== "BigEndian",
    headerBytes: file.get("header_type") === "UInt64" ? 8 : 4,
    isCompressed: file.has("compressor"),
    appended:
      appended === undefined
        ? undefined
        : appended.isBase64
          ? text.slice(appended.begin)
          : bytes.subarray(appended.begin),
    nextOffsets: nextOffsets(pieces.flatMap(({ arrays }) => arrays)),
    budget: new UnpackingBudget(bytes.length),
  };
}

function nextOffsets(arrays: readonly FoundArray[]): Map<number, number> {
  const offsets = arrays.map(({ attributes }) => Number(attributes.get("offset") ?? NaN));
  const sorted = [...new Set(offsets)].filter(Number.isFinite).sort((a, b) => a - b);
  return new Map(sorted.slice(1).map((next, i) => [sorted[i] ?? 0, next]));
}
