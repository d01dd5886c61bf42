/**
 * Writes VTU (VTK XML unstructured grid), which ParaView, VTK and meshio read: float64 points, then the tetrahedra and
 * the boundary's triangles as cells. Cell data hold the tags `region` and `patch`, 0 for a cell without one. Names are
 * in comments, for Tetrafront, and in field data, for other programs. The arrays are appended raw and compressed with
 * zlib, as ParaView writes them; coordinates survive a round trip bit for bit.
 */
import { zlibSync } from "fflate";
import { PAUSE, type Steps, stepwise } from "../base/steps.js";
import type { MeshGroup, Mesh } from "../mesh/mesh.js";
import { IS_LITTLE_ENDIAN, joinBytes, type Part, widened } from "./bytes.js";
import type { Note } from "./file-format.js";
import { hasDefaultName, usedGroups } from "./groups.js";
import type { WrittenMesh } from "./second-order.js";
import { allNameLines } from "./name-lines.js";
import { vtkCellData, vtkCellNodes } from "./vtk.js";

/** Blocks are compressed one by one; readers keep one of them in memory at a time. */
const BLOCK_BYTES = 1 << 16;
/** Higher levels hardly compress mesh data better. */
const LEVEL = 4;

interface DataArray {
  readonly attributes: string;
  readonly values: Float64Array | Int32Array | Uint8Array;
}

/** Returns the bytes of a VTU file. */
export function* writeVtu(mesh: WrittenMesh, note: Note): Generator<Part, void> {
  const { points } = mesh;
  const { connectivity, offsets } = yield* cellNodes(mesh);
  const { types, regions, patches } = yield* vtkCellData(mesh);
  const arrays: readonly DataArray[] = [
    { attributes: 'type="Float64" Name="Points" NumberOfComponents="3"', values: points },
    { attributes: 'type="Int32" Name="connectivity"', values: connectivity },
    { attributes: 'type="Int32" Name="offsets"', values: offsets },
    { attributes: 'type="UInt8" Name="types"', values: types },
    { attributes: 'type="Int32" Name="region"', values: regions },
    { attributes: 'type="Int32" Name="patch"', values: patches },
    ...[...mesh.nodeData].map(([name, { components, values }]) => ({
      attributes: `type="Float64" Name="${inQuotes(name)}"${components === 1 ? "" : ` NumberOfComponents="${components}"`}`,
      values,
    })),
  ];
  const packed: Uint8Array[] = [];
  for (const { values } of arrays) packed.push(yield* compressed(values));
  const [pointTag, connectivityTag, offsetTag, typeTag, regionTag, patchTag, ...dataTags] = arrayTags(
    arrays,
    packed,
  );
  const order = IS_LITTLE_ENDIAN ? "LittleEndian" : "BigEndian";
  const head = [
    '<?xml version="1.0"?>',
    `<VTKFile type="UnstructuredGrid" version="1.0" byte_order="${order}" header_type="UInt64" compressor="vtkZLibDataCompressor">`,
    ...allNameLines(mesh, note).map((line) => `<!-- ${escaped(line)} -->`),
    "<UnstructuredGrid>",
    ...fieldData(mesh),
    `<Piece NumberOfPoints="${points.length / 3}" NumberOfCells="${types.length}">`,
    `<Points>${pointTag}</Points>`,
    `<Cells>${connectivityTag}${offsetTag}${typeTag}</Cells>`,
    `<CellData Scalars="region">${regionTag}${patchTag}</CellData>`,
    ...(dataTags.length > 0 ? [`<PointData>${dataTags.join("")}</PointData>`] : []),
    "</Piece>",
    "</UnstructuredGrid>",
    '<AppendedData encoding="raw">',
    "_",
  ].join("\n");
  yield* [head, ...packed.reverse(), "\n</AppendedData>\n</VTKFile>\n"];
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
function* cellNodes(
  mesh: WrittenMesh,
): Steps<{ readonly connectivity: Int32Array; readonly offsets: Int32Array }> {
  const { tetrahedra, triangles, perTetrahedron, perTriangle } = yield* vtkCellNodes(mesh);
  const connectivity = new Int32Array(tetrahedra.length + triangles.length);
  connectivity.set(tetrahedra);
  connectivity.set(triangles, tetrahedra.length);
  const [tets, faces] = [tetrahedra.length / perTetrahedron, triangles.length / perTriangle];
  const offsets = new Int32Array(tets + faces);
  yield* stepwise(offsets.length, (c) => {
    offsets[c] = c < tets ? perTetrahedron * (c + 1) : tetrahedra.length + perTriangle * (c + 1 - tets);
  });
  return { connectivity, offsets };
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

/**
 * Returns the number of blocks, the bytes of a block, the bytes of a shorter last block, the compressed size of
 * each block, and the blocks.
 */
function* compressed(values: ArrayBufferView): Generator<Part, Uint8Array> {
  const bytes = new Uint8Array(values.buffer, values.byteOffset, values.byteLength);
  const blocks: Uint8Array[] = [];
  for (let at = 0; at < bytes.length; at += BLOCK_BYTES) {
    blocks.push(zlibSync(bytes.subarray(at, at + BLOCK_BYTES), { level: LEVEL }));
    yield PAUSE;
  }
  const header = [
    blocks.length,
    BLOCK_BYTES,
    bytes.length % BLOCK_BYTES,
    ...blocks.map((block) => block.length),
  ];
  return joinBytes([widened(header), ...blocks]);
}

/**
 * Returns one element per array with the offset of its values after the underscore; the values of the last array
 * come first. meshio (5.3) finds arrays by offset while it assigns new offsets from the first values on, and if two
 * arrays have the same offset, it takes the first. In this order no new offset equals the old offset of an array
 * that it has yet to find, so it never takes the wrong one.
 */
function arrayTags(arrays: readonly DataArray[], packed: readonly Uint8Array[]): readonly string[] {
  let offset = packed.reduce((sum, { length }) => sum + length, 0);
  return arrays.map(({ attributes }, a) => {
    offset -= packed[a]?.length ?? 0;
    return `<DataArray ${attributes} format="appended" offset="${offset}"/>`;
  });
}
