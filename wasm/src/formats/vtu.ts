/**
 * VTU (VTK XML unstructured grid), which ParaView, VTK and meshio read: float64 points, the tetrahedra
 * as cells, the region as cell data. The arrays are appended raw, as ParaView writes them by default:
 * coordinates come back bit for bit.
 */
import { IS_LITTLE_ENDIAN, joinBytes, widened } from "./bytes.js";
import type { FileMesh } from "./file-mesh.js";

/** VTK's number for a linear tetrahedron; its node order is ours. */
const VTK_TETRA = 10;
/** Every appended array is preceded by its length in bytes as a 64-bit number. */
const LENGTH_BYTES = 8;

interface DataArray {
  readonly attributes: string;
  readonly values: Float64Array | Int32Array | Uint8Array;
}

/** The bytes of a VTU file. */
export function writeVtu(mesh: FileMesh): Uint8Array<ArrayBuffer> {
  const { points, tetrahedra, tetrahedronRegion: regions } = mesh;
  const cellCount = tetrahedra.length / 4;
  const arrays: readonly DataArray[] = [
    { attributes: 'type="Float64" Name="Points" NumberOfComponents="3"', values: points },
    { attributes: 'type="Int32" Name="connectivity"', values: new Int32Array(tetrahedra) },
    { attributes: 'type="Int32" Name="offsets"', values: Int32Array.from(regions, (_, t) => 4 * (t + 1)) },
    { attributes: 'type="UInt8" Name="types"', values: new Uint8Array(cellCount).fill(VTK_TETRA) },
    { attributes: 'type="Int32" Name="region"', values: new Int32Array(regions) },
  ];
  const [pointTag, connectivityTag, offsetTag, typeTag, regionTag] = arrayTags(arrays);
  const head = [
    '<?xml version="1.0"?>',
    `<VTKFile type="UnstructuredGrid" version="1.0" byte_order="${IS_LITTLE_ENDIAN ? "Little" : "Big"}Endian" header_type="UInt64">`,
    "<UnstructuredGrid>",
    `<Piece NumberOfPoints="${points.length / 3}" NumberOfCells="${cellCount}">`,
    `<Points>${pointTag}</Points>`,
    `<Cells>${connectivityTag}${offsetTag}${typeTag}</Cells>`,
    `<CellData Scalars="region">${regionTag}</CellData>`,
    "</Piece>",
    "</UnstructuredGrid>",
    '<AppendedData encoding="raw">',
    "_",
  ].join("\n");
  const data = arrays.flatMap(({ values }) => [widened([values.byteLength]), values]);
  return joinBytes([head, ...data, "\n</AppendedData>\n</VTKFile>\n"]);
}

/** One element per array, with the place of its values after the underscore. */
function arrayTags(arrays: readonly DataArray[]): readonly string[] {
  let offset = 0;
  return arrays.map(({ attributes, values }) => {
    const tag = `<DataArray ${attributes} format="appended" offset="${offset}"/>`;
    offset += LENGTH_BYTES + values.byteLength;
    return tag;
  });
}
