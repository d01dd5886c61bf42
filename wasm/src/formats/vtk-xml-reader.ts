/**
 * Reads VTU and VTP files (VTK XML unstructured grids and polygons) as this package, meshio and ParaView
 * write them: pieces one after the other; arrays as text, in base64 or appended; compressed with zlib or not.
 * The numbers `patch` and `region` of cells tell their groups; vertices and lines are passed over.
 */
import { ReadFailure } from "../read-result.js";
import { allBytes, type ByteSource } from "./byte-source.js";
import type { FileMesh } from "./file-mesh.js";
import { MeshBuilder } from "./mesh-builder.js";
import { decodeArray, UnpackingBudget, type ArrayCoding } from "./vtk-arrays.js";
import { addCell, cellsOf } from "./vtk-cells.js";

const REMEDY = "Save the mesh again as .vtu or .vtp with triangles or linear tetrahedra.";
const VTK_POLYGON = 7;
const VTK_STRIP = 6;
/** Sections in which arrays are looked for. Those of cells in polygon files are named by their kind. */
const SECTIONS = new Set(["Points", "Cells", "Verts", "Lines", "Strips", "Polys", "PointData", "CellData"]);

type Attributes = ReadonlyMap<string, string>;

/** An array before its numbers are read. */
interface FoundArray {
  readonly section: string;
  readonly attributes: Attributes;
  /** What stands between its tags. */
  readonly content: string;
}

interface Piece {
  readonly attributes: Attributes;
  readonly arrays: FoundArray[];
}

interface Head {
  readonly file: Attributes;
  readonly pieces: readonly Piece[];
  /** What follows the underscore of the appended data, and whether it is base64. */
  readonly appended: { readonly begin: number; readonly isBase64: boolean } | undefined;
}

type Numbers = (found: FoundArray) => Float64Array;

export async function readVtkXml(source: ByteSource): Promise<FileMesh> {
  const bytes = await allBytes(source);
  const text = new TextDecoder("latin1").decode(bytes);
  const head = readHead(text);
  const coding = codingOf(head, bytes, text);
  const numbers: Numbers = ({ attributes, content }) =>
    decodeArray(coding, {
      type: attributes.get("type") ?? "",
      format: attributes.get("format") ?? "ascii",
      offset: Number(attributes.get("offset") ?? NaN),
      content,
    });
  const builder = new MeshBuilder();
  for (const piece of head.pieces) {
    const firstNode = builder.pointCount;
    addPoints(piece, numbers, builder);
    // A piece may be empty where others are not.
    if (builder.pointCount === firstNode) continue;
    const reading = { piece, numbers, builder, firstNode };
    if (head.file.get("type") === "PolyData") addPolygons(reading);
    else addCells(reading);
  }
  addPointData(head.pieces, numbers, builder);
  return builder.mesh();
}

/** A piece whose points are there. */
interface PieceReading {
  readonly piece: Piece;
  readonly numbers: Numbers;
  readonly builder: MeshBuilder;
  /** Of the piece; its cells count from there. */
  readonly firstNode: number;
}

/** The array of this name in a section; the first one for the name "". */
function arrayOf(piece: Piece, section: string, name: string): FoundArray {
  return (
    piece.arrays.find(
      (array) => array.section === section && (name === "" || array.attributes.get("Name") === name),
    ) ?? fail(`the file has no array "${name === "" ? section : name}"`)
  );
}

function addPoints(piece: Piece, numbers: Numbers, builder: MeshBuilder): void {
  const count = Number(piece.attributes.get("NumberOfPoints") ?? NaN);
  const points = count === 0 ? new Float64Array() : numbers(arrayOf(piece, "Points", ""));
  if (points.length !== 3 * count) fail(`there are ${points.length / 3} points, ${count} are announced`);
  if (!points.every(Number.isFinite)) fail("a point has a coordinate that is not finite");
  for (let i = 0; i < points.length; i += 3) {
    builder.addPoint(points[i] ?? 0, points[i + 1] ?? 0, points[i + 2] ?? 0);
  }
}

/** What all pieces that tell anything of their nodes have under one name, piece after piece. */
function addPointData(pieces: readonly Piece[], numbers: Numbers, builder: MeshBuilder): void {
  const told = pieces.map(pointArrays);
  for (const [name, found] of told.find(({ size }) => size > 0) ?? []) {
    const parts = told.map((arrays) => arrays.get(name));
    const values = joinedNumbers(parts.map((part) => (part === undefined ? NO_NUMBERS : numbers(part))));
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
function cellData(piece: Piece, numbers: Numbers): Map<string, Float64Array> {
  const data = new Map<string, Float64Array>();
  for (const found of piece.arrays) {
    if (found.section !== "CellData" || found.attributes.get("type") === "String") continue;
    if (Number(found.attributes.get("NumberOfComponents") ?? 1) > 1) continue;
    data.set(found.attributes.get("Name") ?? "", numbers(found));
  }
  return data;
}

function addCells(reading: PieceReading): void {
  const { piece, numbers, builder } = reading;
  const offsets = numbers(arrayOf(piece, "Cells", "offsets"));
  const types = numbers(arrayOf(piece, "Cells", "types"));
  if (offsets.length !== types.length) fail("the cells have more or fewer types than offsets");
  const cells = cellsOf(builder, cellData(piece, numbers), fail);
  eachCell(reading, "Cells", offsets, (nodes, cell) => addCell(cells, types[cell] ?? 0, nodes, cell));
}

/** The cells of a polygon file are numbered through vertices, lines, strips, polygons in VTK's order. */
function addPolygons(reading: PieceReading): void {
  const { piece, numbers, builder } = reading;
  const cells = cellsOf(builder, cellData(piece, numbers), fail);
  let first = 0;
  for (const section of ["Verts", "Lines", "Polys", "Strips"]) {
    if (!piece.arrays.some((array) => array.section === section)) continue;
    const offsets = numbers(arrayOf(piece, section, "offsets"));
    if (section === "Polys" || section === "Strips") {
      const type = section === "Polys" ? VTK_POLYGON : VTK_STRIP;
      eachCell(reading, section, offsets, (nodes, cell) => addCell(cells, type, nodes, first + cell));
    }
    first += offsets.length;
  }
}

/** The cells of a section by their nodes in the whole mesh; cells count from 0 in the section. */
function eachCell(
  { piece, numbers, builder, firstNode }: PieceReading,
  section: string,
  offsets: Float64Array,
  use: (nodes: readonly number[], cell: number) => void,
): void {
  const connectivity = numbers(arrayOf(piece, section, "connectivity"));
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
  for (const match of text.matchAll(/<(\/?)([A-Za-z]+)([^<>]*)>/g)) {
    const [tag, slash, name = "", rest = ""] = match;
    const end = match.index + tag.length;
    const attributes = attributesIn(rest);
    if (slash === "/") {
      if (name === section) section = "";
    } else if (name === "VTKFile") file = attributes;
    else if (name === "Piece") pieces.push({ attributes, arrays: [] });
    else if (SECTIONS.has(name)) section = rest.endsWith("/") ? section : name;
    else if (name === "DataArray" && section !== "") {
      const close = rest.endsWith("/") ? end : text.indexOf("<", end);
      pieces.at(-1)?.arrays.push({ section, attributes, content: text.slice(end, close < 0 ? end : close) });
    } else if (name === "AppendedData") {
      const begin = text.indexOf("_", end) + 1;
      const isBase64 = attributes.get("encoding") === "base64";
      return checkedHead(file, pieces, { begin: begin === 0 ? text.length : begin, isBase64 });
    }
  }
  return checkedHead(file, pieces, undefined);
}

function checkedHead(
  file: Attributes | undefined,
  pieces: readonly Piece[],
  appended: Head["appended"],
): Head {
  const type = file?.get("type");
  if (file === undefined || (type !== "UnstructuredGrid" && type !== "PolyData"))
    return fail("this is neither a VTU nor a VTP file: it has no unstructured grid and no polygons");
  if (pieces.length === 0) return fail("the file has no piece");
  return { file, pieces, appended };
}

/** name="value" pairs; between quotes there are names, within them values. */
function attributesIn(text: string): Attributes {
  const parts = text.split('"');
  const attributes = new Map<string, string>();
  for (let i = 0; i + 1 < parts.length; i += 2) {
    const name = (parts[i] ?? "").replace("=", "").trim();
    attributes.set(name, parts[i + 1] ?? "");
  }
  return attributes;
}

function codingOf({ file, pieces, appended }: Head, bytes: Uint8Array, text: string): ArrayCoding {
  const compressor = file.get("compressor");
  if (compressor !== undefined && compressor !== "vtkZLibDataCompressor") {
    fail(`the compressor ${compressor} is not known, only vtkZLibDataCompressor`);
  }
  return {
    isLittleEndian: file.get("byte_order") !== "BigEndian",
    headerBytes: file.get("header_type") === "UInt64" ? 8 : 4,
    isCompressed: compressor !== undefined,
    appended:
      appended === undefined
        ? undefined
        : appended.isBase64
          ? text.slice(appended.begin)
          : bytes.subarray(appended.begin),
    nextOffsets: nextOffsets(pieces.flatMap(({ arrays }) => arrays)),
    budget: new UnpackingBudget(bytes.length, fail),
    fail,
  };
}

function nextOffsets(arrays: readonly FoundArray[]): Map<number, number> {
  const offsets = arrays.map(({ attributes }) => Number(attributes.get("offset") ?? NaN));
  const sorted = [...new Set(offsets)].filter(Number.isFinite).sort((a, b) => a - b);
  return new Map(sorted.slice(1).map((next, i) => [sorted[i] ?? 0, next]));
}

function fail(message: string): never {
  throw new ReadFailure({ message, remedy: REMEDY });
}
