/**
 * VTU (VTK XML unstructured grid), which ParaView, VTK and meshio read: float64 points, the tetrahedra and
 * behind them the boundary's triangles as cells; as cell data the number of their `region` and `patch`, 0
 * where a cell has none, and comments with their names. The arrays are appended raw and compressed with zlib, as ParaView writes them:
 * coordinates come back bit for bit.
 */
import { zlibSync } from "fflate";

import { IS_LITTLE_ENDIAN, joinBytes, widened, type Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import type { FileMesh } from "./file-mesh.js";
import { allNameLines } from "./name-lines.js";
import { BREATH, stepwise, type Steps } from "./steps.js";
import { vtkCellData } from "./vtk.js";

/** Blocks are compressed one by one; readers hold one of them at a time. */
const BLOCK_BYTES = 1 << 16;
/** Mesh data gains little from more. */
const LEVEL = 4;

interface DataArray {
  readonly attributes: string;
  readonly values: Float64Array | Int32Array | Uint8Array;
}

/** The bytes of a VTU file. */
export function* writeVtu(mesh: FileMesh, note: Note): Generator<Part, void> {
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

/** The nodes of the cells one after the other, and where those of each end. */
function* cellNodes({
  tetrahedra,
  triangles,
}: FileMesh): Steps<{ readonly connectivity: Int32Array; readonly offsets: Int32Array }> {
  const connectivity = new Int32Array(tetrahedra.length + triangles.length);
  connectivity.set(tetrahedra);
  connectivity.set(triangles, tetrahedra.length);
  const [tets, faces] = [tetrahedra.length / 4, triangles.length / 3];
  const offsets = new Int32Array(tets + faces);
  yield* stepwise(offsets.length, (c) => {
    offsets[c] = c < tets ? 4 * (c + 1) : tetrahedra.length + 3 * (c + 1 - tets);
  });
  return { connectivity, offsets };
}

function inQuotes(name: string): string {
  const codes = (found: string) => `&#${found.codePointAt(0)};`;
  return name.replace(/[&<>"\t\r\n]/g, codes);
}

/** As text of a comment, in which two hyphens must not follow each other. */
function escaped(line: string): string {
  const entities: Readonly<Record<string, string>> = { "&": "&amp;", "<": "&lt;", ">": "&gt;", "-": "&#45;" };
  return line.replace(/[&<>]|-(?=-|$)/g, (found) => entities[found] ?? found);
}

/** Numbers of blocks, bytes of a block, bytes of a shorter last one, bytes of each when packed; the blocks. */
function* compressed(values: ArrayBufferView): Generator<Part, Uint8Array> {
  const bytes = new Uint8Array(values.buffer, values.byteOffset, values.byteLength);
  const blocks: Uint8Array[] = [];
  for (let at = 0; at < bytes.length; at += BLOCK_BYTES) {
    blocks.push(zlibSync(bytes.subarray(at, at + BLOCK_BYTES), { level: LEVEL }));
    yield BREATH;
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
 * One element per array, with the place of its values after the underscore: those of the last array come first. meshio
 * (5.3) takes arrays by their places while it gives them new ones, from the first values on, and of two with one place the
 * first array: as it has none of the new places in front of those it looks for, it never takes another's.
 */
function arrayTags(arrays: readonly DataArray[], packed: readonly Uint8Array[]): readonly string[] {
  let offset = packed.reduce((sum, { length }) => sum + length, 0);
  return arrays.map(({ attributes }, a) => {
    offset -= packed[a]?.length ?? 0;
    return `<DataArray ${attributes} format="appended" offset="${offset}"/>`;
  });
}
