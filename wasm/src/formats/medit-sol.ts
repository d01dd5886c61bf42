/**
 * Reads the values at the nodes from the `.sol` file beside a Medit file: sizes, or a metric, as mmg reads and writes
 * them, or fields of a solver. A symmetric matrix has the lower triangle by rows: xx, xy, yy, xz, yz, zz.
 */
import { plural } from "../base/plural.js";
import type { NodeData } from "../mesh/mesh.js";
import { ByteReader } from "./byte-reader.js";
import type { OpenOther } from "./file-format.js";
import { failureIn } from "./read-result.js";

/** Numbers per node of the types 1, 2 and 3. */
const COMPONENTS = [1, 3, 6] as const;
const NAMES = ["size", "vector", "metric"] as const;
/** Where xx, xy, xz, yy, yz and zz are in a symmetric matrix of the file. */
const UPPER = [0, 1, 3, 2, 4, 5] as const;

const REMEDY = "Save the values again as a Medit .sol text file of the same nodes, or remove the file.";

/** Values of a `.sol` file, and sentences about what was not used. */
interface SolValues {
  readonly nodeData: ReadonlyMap<string, NodeData>;
  readonly notes: readonly string[];
}

const NOTHING: SolValues = { nodeData: new Map(), notes: [] };

/**
 * Reads `stem.sol` if it exists. A single scalar is named "size", a single matrix "metric", a single vector "vector"; several
 * fields are "solution 1", "solution 2", …. Values for another number of nodes are not used, with a note.
 */
export async function readSolBeside(stem: string, nodes: number, openOther: OpenOther): Promise<SolValues> {
  const fileName = `${stem}.sol`;
  const source = await openOther(fileName);
  if (source === undefined) return NOTHING;
  try {
    return await ByteReader.over(source, { remedy: REMEDY, comment: "#" }, (reader) =>
      readSol(reader, fileName, nodes),
    );
  } catch (failure) {
    throw failureIn(fileName, failure);
  }
}

async function readSol(reader: ByteReader, fileName: string, nodes: number): Promise<SolValues> {
  reader.expect("meshversionformatted");
  reader.number("the version");
  for (;;) {
    await reader.fill();
    const word = reader.word().toLowerCase();
    if (word === "" || word === "end") return NOTHING;
    if (word === "dimension") {
      if (reader.number("the dimension") !== 3) reader.fail("the values are not three-dimensional");
    } else if (word === "solatvertices") {
      return readValues(reader, fileName, nodes);
    } else {
      reader.failUnknown("section", word);
    }
  }
}

async function readValues(reader: ByteReader, fileName: string, nodes: number): Promise<SolValues> {
  const count = reader.count(reader.number("a number of nodes"), "nodes");
  if (count !== nodes) {
    const note = `${fileName} has values for ${plural(count, "node")}, but the mesh has ${nodes}; they were not used`;
    return { ...NOTHING, notes: [note] };
  }
  const fields = reader.count(reader.number("a number of fields"), "fields");
  const types = Array.from({ length: fields }, () => reader.index("the type of a field", 4));
  const data = types.map((type) => {
    const components = COMPONENTS[type - 1] ?? reader.fail("the type of a field is 0; it must be 1, 2 or 3");
    return { components, values: new Float64Array(components * count) };
  });
  const row = new Float64Array(6);
  for (let node = 0; node < count; node++) {
    if (reader.isLow) await reader.fill();
    for (const { components, values } of data) {
      for (let c = 0; c < components; c++) row[c] = reader.number("a value", true);
      for (let c = 0; c < components; c++) {
        values[components * node + c] = row[components === 6 ? (UPPER[c] ?? 0) : c] ?? 0;
      }
    }
  }
  const nameOf = (field: number) =>
    fields === 1 ? (NAMES[(types[field] ?? 1) - 1] ?? "") : `solution ${field + 1}`;
  return { nodeData: new Map(data.map((each, field) => [nameOf(field), each])), notes: [] };
}
