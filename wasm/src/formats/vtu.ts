/**
 * Writes VTU (VTK XML unstructured grid), which ParaView, VTK and meshio read: float64 points, then the tetrahedra and
 * the boundary's triangles as cells. Cell data hold the tags `region` and `patch`, 0 for a cell without one. Names are
 * in comments, for Tetrafront, and in field data, for other programs. The arrays are appended raw and compressed with
 * zlib, as ParaView writes them; coordinates survive a round trip bit for bit. The head of the file states where each array
 * begins, so the compressed arrays are kept in a spool until all are made.
 */
import { zlibSync } from "fflate";
import { PAUSE, type Steps } from "../base/steps.js";
import type { MeshGroup, Mesh, NodeData } from "../mesh/mesh.js";
import { IS_LITTLE_ENDIAN, type Part, widened } from "./bytes.js";
import type { Note } from "./file-format.js";
import { hasDefaultName, usedGroups } from "./groups.js";
import type { WrittenMesh } from "./second-order.js";
import { allNameLines } from "./name-lines.js";
import { memorySpool, type Spool } from "./spool.js";
import { type CellValues, vtkCellData, vtkCellNodes, vtkElementData } from "./vtk.js";

/** Blocks are compressed one by one; readers keep one of them in memory at a time. */
const BLOCK_BYTES = 1 << 16;
/** Higher levels hardly compress mesh data better. */
const LEVEL = 4;

/** Attributes of the arrays that every file has, in the order of its head. */
export const VTU_ARRAYS = {
  points: 'type="Float64" Name="Points" NumberOfComponents="3"',
  connectivity: 'type="Int32" Name="connectivity"',
  offsets: 'type="Int32" Name="offsets"',
  types: 'type="UInt8" Name="types"',
  region: 'type="Int32" Name="region"',
  patch: 'type="Int32" Name="patch"',
} as const;

interface DataArray {
  readonly attributes: string;
  readonly count: number;
  /** Bytes per value. */
  readonly width: number;
  /** Returns the values from `begin` to `end` - 1. */
  readonly values: (begin: number, end: number) => ArrayBufferView;
}

/** Returns the bytes of a VTU file. */
export function* writeVtu(mesh: WrittenMesh, note: Note, createSpool = memorySpool): Generator<Part, void> {
  const spool = createSpool();
  try {
    yield* fileIn(mesh, note, spool);
  } finally {
    spool.close();
  }
}

function* fileIn(mesh: WrittenMesh, note: Note, spool: Spool): Generator<Part, void> {
  const { points } = mesh;
  const { count, types, regions, patches } = vtkCellData(mesh);
  const { connectivity, offsets } = yield* cellNodes(mesh);
  const cellData = yield* vtkElementData(mesh, note);
  const perCell = { count, width: 4 };
  const arrays: readonly DataArray[] = [
    { attributes: VTU_ARRAYS.points, ...doubles(points) },
    { attributes: VTU_ARRAYS.connectivity, ...connectivity },
    { attributes: VTU_ARRAYS.offsets, ...perCell, values: offsets },
    {
      attributes: VTU_ARRAYS.types,
      count,
      width: 1,
      values: (b, e) => Uint8Array.from(types(b, e)),
    },
    { attributes: VTU_ARRAYS.region, ...perCell, values: regions },
    { attributes: VTU_ARRAYS.patch, ...perCell, values: patches },
    ...namedArrays(cellData),
    ...namedArrays(mesh.nodeData),
  ];
  const packed = new Map<DataArray, PackedArray>();
  for (const array of arrays.toReversed()) packed.set(array, yield* compressed(array, spool));
  yield* vtuFile({ mesh, nodes: points.length / 3, cells: count, note }, packed, spool, cellData.size);
}

/** What the head of a file states. `mesh`: patches, regions and the values at its nodes. */
interface FileContent {
  readonly mesh: Mesh;
  readonly nodes: number;
  readonly cells: number;
  readonly note: Note;
}

/** Returns the file of arrays that are in the spool: points, cells, their groups, and values of `cellFields` fields of cells and of nodes. */
export function* vtuFile(
  { mesh, nodes, cells, note }: FileContent,
  packed: ReadonlyMap<Pick<DataArray, "attributes">, PackedArray>,
  spool: Spool,
  cellFields: number,
): Generator<Part, void> {
  const [pointTag, connectivityTag, offsetTag, typeTag, regionTag, patchTag, ...dataTags] = arrayTags(packed);
  const order = IS_LITTLE_ENDIAN ? "LittleEndian" : "BigEndian";
  const head = [
    '<?xml version="1.0"?>',
    `<VTKFile type="UnstructuredGrid" version="1.0" byte_order="${order}" header_type="UInt64" compressor="vtkZLibDataCompressor">`,
    ...allNameLines(mesh, note).map((line) => `<!-- ${escaped(line)} -->`),
    "<UnstructuredGrid>",
    ...fieldData(mesh),
    `<Piece NumberOfPoints="${nodes}" NumberOfCells="${cells}">`,
    `<Points>${pointTag}</Points>`,
    `<Cells>${connectivityTag}${offsetTag}${typeTag}</Cells>`,
    `<CellData Scalars="region">${regionTag}${patchTag}${dataTags.slice(0, cellFields).join("")}</CellData>`,
    ...(mesh.nodeData.size > 0 ? [`<PointData>${dataTags.slice(cellFields).join("")}</PointData>`] : []),
    "</Piece>",
    "</UnstructuredGrid>",
    '<AppendedData encoding="raw">',
    "_",
  ].join("\n");
  yield head;
  for (const { header, bytes } of packed.values()) yield [header, spool.take(bytes)];
  yield "\n</AppendedData>\n</VTKFile>\n";
}

function namedArrays(data: ReadonlyMap<string, NodeData>): DataArray[] {
  return [...data].map(([name, { components, values }]) => ({
    attributes: `type="Float64" Name="${inQuotes(name)}"${components === 1 ? "" : ` NumberOfComponents="${components}"`}`,
    ...doubles(values),
  }));
}

function doubles(values: Float64Array) {
  return {
    count: values.length,
    width: 8,
    values: (begin: number, end: number) => values.subarray(begin, end),
  };
}

/**
 * Returns an array with the tag and the dimension of each named group. ParaView displays it, and meshio keeps the
 * physical names of Gmsh files in the same form.
 */
function fieldData(mesh: Mesh): string[] {
  const taken = new Set<string>();
  const arrays = (
    word: "patch" | "region",
    dimension: number,
    groups: readonly MeshGroup[],
    owners: Uint32Array,
  ) => {
    const used = usedGroups(owners, groups);
    return groups.flatMap((group, g) => {
      if (hasDefaultName(word, group) || !used.has(g)) return [];
      const name = taken.has(group.name) ? `${group.name} (${word} ${group.tag})` : group.name;
      taken.add(name);
      const attributes = `type="Int32" Name="${inQuotes(name)}" NumberOfTuples="2" format="ascii"`;
      return [`<DataArray ${attributes}>${group.tag} ${dimension}</DataArray>`];
    });
  };
  const named = [
    ...arrays("patch", 2, mesh.patches, mesh.trianglePatch),
    ...arrays("region", 3, mesh.regions, mesh.tetrahedronRegion),
  ];
  return named.length > 0 ? ["<FieldData>", ...named, "</FieldData>"] : [];
}

/** Returns the nodes of all cells, and the end of each cell among them. */
function* cellNodes(mesh: WrittenMesh): Steps<{
  readonly connectivity: Omit<DataArray, "attributes">;
  readonly offsets: CellValues;
}> {
  const { tetrahedra, triangles, perTetrahedron, perTriangle } = yield* vtkCellNodes(mesh);
  const ofTetrahedra = tetrahedra.length;
  const nodes = (begin: number, end: number) => {
    if (end <= ofTetrahedra) return tetrahedra.subarray(begin, end);
    const faces = triangles.subarray(Math.max(begin - ofTetrahedra, 0), end - ofTetrahedra);
    if (begin >= ofTetrahedra) return faces;
    const both = new Uint32Array(end - begin);
    both.set(tetrahedra.subarray(begin));
    both.set(faces, ofTetrahedra - begin);
    return both;
  };
  const tets = ofTetrahedra / perTetrahedron;
  return {
    connectivity: { count: ofTetrahedra + triangles.length, width: 4, values: nodes },
    offsets: (begin, end) =>
      Int32Array.from({ length: end - begin }, (_, c) => {
        const cells = begin + c + 1;
        return perTetrahedron * Math.min(cells, tets) + perTriangle * Math.max(cells - tets, 0);
      }),
  };
}

function inQuotes(name: string): string {
  const codes = (found: string) => `&#${found.codePointAt(0)};`;
  return name.replace(/[&<>"\t\r\n]/g, codes);
}

/** Escapes the text of a comment, which must not contain two consecutive hyphens. */
function escaped(line: string): string {
  const entities: Readonly<Record<string, string>> = { "&": "&amp;", "<": "&lt;", ">": "&gt;", "-": "&#45;" };
  return line.replace(/[&<>]|-(?=-|$)/g, (found) => entities[found] ?? found);
}

/** An array in the spool. */
export interface PackedArray {
  /** Number of blocks, bytes of a block, bytes of a shorter last block, and the compressed size of each block. */
  readonly header: Uint32Array;
  /** Bytes of all compressed blocks. */
  readonly bytes: number;
}

function* compressed({ count, width, values }: DataArray, spool: Spool): Generator<Part, PackedArray> {
  const perBlock = BLOCK_BYTES / width;
  const packer = new ArrayPacker(spool);
  for (let begin = 0; begin < count; begin += perBlock) {
    packer.add(values(begin, Math.min(begin + perBlock, count)));
    yield PAUSE;
  }
  return packer.end();
}

/** Compresses an array into the spool. */
export class ArrayPacker {
  readonly #spool: Spool;
  readonly #sizes: number[] = [];
  readonly #block = new Uint8Array(BLOCK_BYTES);
  #filled = 0;

  constructor(spool: Spool) {
    this.#spool = spool;
  }

  /** Adds the next values. */
  add({ buffer, byteOffset, byteLength }: ArrayBufferView): void {
    const bytes = new Uint8Array(buffer, byteOffset, byteLength);
    for (let begin = 0; begin < bytes.length;) {
      const taken = bytes.subarray(begin, begin + BLOCK_BYTES - this.#filled);
      this.#block.set(taken, this.#filled);
      this.#filled += taken.length;
      begin += taken.length;
      if (this.#filled === BLOCK_BYTES) this.#compress();
    }
  }

  end(): PackedArray {
    const rest = this.#filled;
    if (rest > 0) this.#compress();
    const sizes = this.#sizes;
    return {
      header: widened([sizes.length, BLOCK_BYTES, rest, ...sizes]),
      bytes: sizes.reduce((sum, size) => sum + size, 0),
    };
  }

  #compress(): void {
    const block = zlibSync(this.#block.subarray(0, this.#filled), { level: LEVEL });
    this.#filled = 0;
    this.#spool.add(block);
    this.#sizes.push(block.length);
  }
}

/**
 * Returns one element per array, in reverse order, with the offset of its values after the underscore; the values of the last
 * array come first. meshio (5.3) finds arrays by offset while it assigns new offsets from the first values on, and if two
 * arrays have the same offset, it takes the first. In this order no new offset equals the old offset of an array
 * that it has yet to find, so it never takes the wrong one.
 */
function arrayTags(packed: ReadonlyMap<Pick<DataArray, "attributes">, PackedArray>): readonly string[] {
  let offset = 0;
  const tags = Array.from(packed, ([{ attributes }, { header, bytes }]) => {
    const tag = `<DataArray ${attributes} format="appended" offset="${offset}"/>`;
    offset += header.byteLength + bytes;
    return tag;
  });
  return tags.reverse();
}
