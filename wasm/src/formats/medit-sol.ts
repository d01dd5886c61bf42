/**
 * Reads and writes the values at the nodes in the `.sol` or `.solb` file beside a Medit file: sizes, or a metric, as mmg reads
 * and writes them, or fields of a solver. A symmetric matrix has the lower triangle by rows: xx, xy, yy, xz, yz, zz.
 */
import { plural } from "../base/plural.js";
import { inPieces } from "../base/steps.js";
import type { NodeData } from "../mesh/mesh.js";
import { ByteReader } from "./byte-reader.js";
import { allBytes, type ByteSource } from "./byte-source.js";
import type { Part } from "./bytes.js";
import type { OpenOther } from "./file-format.js";
import { GmfReader, gmfFile, GMF_SOLUTION } from "./gmf.js";
import { failureIn } from "./read-result.js";

/** Numbers per node of the types 1, 2 and 3. */
const COMPONENTS = [1, 3, 6] as const;
const NAMES = ["size", "vector", "metric"] as const;
/** Where xx, xy, xz, yy, yz and zz are in a symmetric matrix of the file; the order of the file among them is the same. */
const UPPER = [0, 1, 3, 2, 4, 5] as const;
/** Values of a background grid that follow from its metric. */
const SIZE_NAMES = ["size", "stretching", "direction", "secondStretching", "secondDirection"];
/** Comment with the name of a field: one word, so that programs which read words skip it. */
const NAME_COMMENT = /^\s*field-(\d+):(\S+)\s*$/;

const REMEDY = "Save the values again as a Medit .sol text file of the same nodes, or remove the file.";

/** Values of a `.sol` file, and sentences about what was not used. */
interface SolValues {
  readonly nodeData: ReadonlyMap<string, NodeData>;
  readonly notes: readonly string[];
}

const NOTHING: SolValues = { nodeData: new Map(), notes: [] };

/**
 * Reads `stem.sol`, else `stem.solb`, if one exists. Fields have the names that a comment gives them; without, a single scalar is
 * named "size", a single matrix "metric", a single vector "vector"; several fields are "solution 1", "solution 2", …. Values for
 * another number of nodes are not used, with a note.
 */
export async function readSolBeside(stem: string, nodes: number, openOther: OpenOther): Promise<SolValues> {
  for (const fileName of [`${stem}.sol`, `${stem}.solb`]) {
    const source = await openOther(fileName);
    if (source !== undefined) return readSol(source, { fileName, nodes });
  }
  return NOTHING;
}

/** Reads a `.sol` or `.solb` file of a mesh with this number of nodes. Throws a ReadFailure that names the file. */
export async function readSol(
  source: ByteSource,
  { fileName, nodes }: { readonly fileName: string; readonly nodes: number },
): Promise<SolValues> {
  try {
    if (fileName.toLowerCase().endsWith("b")) return readBinary(await allBytes(source), fileName, nodes);
    const names = new Map<number, string>();
    const onComment = (line: string): void => {
      const [, field, name] = NAME_COMMENT.exec(line) ?? [];
      if (name !== undefined) names.set(Number(field), decoded(name));
    };
    const found = await ByteReader.over(source, { remedy: REMEDY, comment: "#", onComment }, (reader) =>
      readSections(reader, fileName, nodes),
    );
    return { nodeData: named(found.fields, names), notes: found.notes };
  } catch (failure) {
    throw failureIn(fileName, failure);
  }
}

function decoded(name: string): string {
  try {
    return decodeURIComponent(name);
  } catch {
    return name;
  }
}

/** Fields in the order of the file. */
interface SolFields {
  readonly fields: readonly NodeData[];
  readonly notes: readonly string[];
}

const NO_FIELDS: SolFields = { fields: [], notes: [] };

function named(
  fields: readonly NodeData[],
  names: ReadonlyMap<number, string> = new Map(),
): ReadonlyMap<string, NodeData> {
  const otherwise = ({ components }: NodeData, field: number) =>
    fields.length === 1
      ? (NAMES[COMPONENTS.findIndex((count) => count === components)] ?? "")
      : `solution ${field + 1}`;
  return new Map(fields.map((each, field) => [names.get(field + 1) ?? otherwise(each, field), each]));
}

function otherCount(fileName: string, count: number, nodes: number): string {
  return `${fileName} has values for ${plural(count, "node")}, but the mesh has ${nodes}; they were not used`;
}

function readBinary(bytes: Uint8Array, fileName: string, nodes: number): SolValues {
  const reader = new GmfReader(bytes, REMEDY);
  for (const { keyword } of reader.sections()) {
    if (keyword !== GMF_SOLUTION) continue;
    const count = reader.count();
    if (count !== nodes) return { ...NOTHING, notes: [otherCount(fileName, count, nodes)] };
    const types = Array.from({ length: reader.int() }, () => reader.int());
    const components = types.map(
      (type) => COMPONENTS[type - 1] ?? reader.fail(`the type of a field is ${type}; it must be 1, 2 or 3`),
    );
    reader.require(count * components.reduce((sum, each) => sum + each, 0) * reader.realBytes);
    return { nodeData: named(fieldsFrom(components, count, () => reader.real())), notes: [] };
  }
  return NOTHING;
}

/** Reads all values, node by node, in the order of the file. */
function fieldsFrom(components: readonly number[], count: number, next: () => number): NodeData[] {
  const data = components.map((each) => ({ components: each, values: new Float64Array(each * count) }));
  for (let node = 0; node < count; node++) for (const field of data) readRow(field, node, next);
  return data;
}

const ROW = new Float64Array(6);

function readRow({ components, values }: NodeData, node: number, next: () => number): void {
  for (let c = 0; c < components; c++) ROW[c] = next();
  for (let c = 0; c < components; c++) {
    values[components * node + c] = ROW[components === 6 ? (UPPER[c] ?? 0) : c] ?? 0;
  }
}

/** Number of values per node of the fields that a `.sol` file can hold: scalars, vectors and symmetric matrices. */
export const isSolField = (components: number): boolean => COMPONENTS.some((count) => count === components);

/** Fields to be written: those of a background grid are its metric alone, as other programs read it. */
function writtenFields(nodeData: ReadonlyMap<string, NodeData>): readonly (readonly [string, NodeData])[] {
  const all = [...nodeData];
  return nodeData.has("metric") ? all.filter(([name]) => !SIZE_NAMES.includes(name)) : all;
}

const typeOf = ({ components }: NodeData): number =>
  COMPONENTS.findIndex((count) => count === components) + 1;

/** Returns the bytes of a `.sol` file with values at this number of nodes. */
export function writeSol(nodeData: ReadonlyMap<string, NodeData>, nodes: number): Part[] {
  const fields = writtenFields(nodeData);
  const types = fields.map(([, data]) => typeOf(data));
  const names = fields.map(([name], f) => `# field-${f + 1}:${encodeURIComponent(name)}\n`);
  const row = (node: number) => fields.map(([, data]) => rowOf(data, node).join(" ")).join(" ");
  return [
    "MeshVersionFormatted 2\n\nDimension 3\n\n",
    ...names,
    `SolAtVertices\n${nodes}\n${types.length} ${types.join(" ")}\n`,
    inPieces(nodes, (begin, end) => {
      let piece = "";
      for (let node = begin; node < end; node++) piece += `${row(node)}\n`;
      return piece;
    }),
    "\nEnd\n",
  ];
}

/** Returns the values of a node in the order of the file. */
function rowOf({ components, values }: NodeData, node: number): number[] {
  const row = [...values.subarray(components * node, components * (node + 1))];
  return components === 6 ? UPPER.map((entry) => row[entry] ?? 0) : row;
}

/** Returns the bytes of a `.solb` file. */
export function writeSolBinary(nodeData: ReadonlyMap<string, NodeData>, nodes: number): Part[] {
  const fields = writtenFields(nodeData).map(([, data]) => data);
  const width = fields.reduce((sum, { components }) => sum + components, 0);
  const head = Int32Array.of(fields.length, ...fields.map(typeOf));
  const rows = inPieces(nodes, (begin, end) => {
    const piece = new Float64Array(width * (end - begin));
    let at = 0;
    for (let node = begin; node < end; node++) {
      for (const field of fields) {
        const row = rowOf(field, node);
        piece.set(row, at);
        at += row.length;
      }
    }
    return piece;
  });
  const bytes = head.byteLength + 8 * width * nodes;
  return gmfFile([{ keyword: GMF_SOLUTION, count: nodes, bytes, parts: [head, rows] }]);
}

async function readSections(reader: ByteReader, fileName: string, nodes: number): Promise<SolFields> {
  reader.expect("meshversionformatted");
  reader.number("the version");
  for (;;) {
    await reader.fill();
    const word = reader.word().toLowerCase();
    if (word === "" || word === "end") return NO_FIELDS;
    if (word === "dimension") {
      if (reader.number("the dimension") !== 3) reader.fail("the values are not three-dimensional");
    } else if (word === "solatvertices") {
      return readValues(reader, fileName, nodes);
    } else {
      reader.failUnknown("section", word);
    }
  }
}

async function readValues(reader: ByteReader, fileName: string, nodes: number): Promise<SolFields> {
  const count = reader.count(reader.number("a number of nodes"), "nodes");
  if (count !== nodes) return { ...NO_FIELDS, notes: [otherCount(fileName, count, nodes)] };
  const fields = reader.count(reader.number("a number of fields"), "fields");
  const types = Array.from({ length: fields }, () => reader.index("the type of a field", 4));
  const data = types.map((type) => {
    const components = COMPONENTS[type - 1] ?? reader.fail("the type of a field is 0; it must be 1, 2 or 3");
    return { components, values: new Float64Array(components * count) };
  });
  for (let node = 0; node < count; node++) {
    if (reader.isLow) await reader.fill();
    for (const field of data) readRow(field, node, () => reader.number("a value", true));
  }
  return { fields: data, notes: [] };
}
