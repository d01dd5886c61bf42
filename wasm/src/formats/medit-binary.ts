/**
 * Reads and writes binary Medit files (`.meshb`): what `.mesh` files hold, without names. Values at the nodes are in the `.solb` or
 * `.sol` file of the same name beside it.
 */
import { PAUSE, inPieces, STEP, type Steps } from "../base/steps.js";
import { inSteps } from "../calls/yielder.js";
import type { Mesh, MeshGroup } from "../mesh/mesh.js";
import { allBytes, type ByteSource } from "./byte-source.js";
import type { Note, ReadContext } from "./file-format.js";
import {
  GMF_QUADRILATERALS,
  GMF_TETRAHEDRA,
  GMF_TRIANGLES,
  GMF_VERTICES,
  gmfFile,
  GmfReader,
  type GmfSection,
} from "./gmf.js";
import type { Part } from "./bytes.js";
import { noteNames } from "./groups.js";
import { readSolBeside } from "./medit-sol.js";
import { MeshBuilder } from "./mesh-builder.js";
import { UNCUT } from "./polygons.js";

const REMEDY = "Save the mesh again as a Medit file with triangles or linear tetrahedra.";

/** Keywords of elements that are not supported; a file with any of them is rejected. */
const OTHERS: ReadonlyMap<number, string> = new Map([
  [9, "prisms"],
  [10, "hexahedra"],
  [24, "second-order triangles"],
  [30, "second-order tetrahedra"],
  [49, "pyramids"],
]);

export async function readMeditBinary(source: ByteSource, context: ReadContext): Promise<Mesh> {
  const { fileName, openOther, signal } = context;
  const mesh = await inSteps(meshIn(await allBytes(source)), signal);
  const stem = fileName.replace(/\.[^.]*$/, "");
  const { nodeData, notes } = await readSolBeside(stem, mesh.points.length / 3, openOther);
  return { ...mesh, nodeData, ...(notes.length > 0 && { notes: [...(mesh.notes ?? []), ...notes] }) };
}

function* meshIn(bytes: Uint8Array): Steps<Mesh> {
  const reader = new GmfReader(bytes, REMEDY);
  const builder = new MeshBuilder();
  for (const { keyword } of reader.sections()) {
    const other = OTHERS.get(keyword);
    if (other !== undefined && reader.count() > 0) {
      reader.fail(`the file has ${other}; only linear triangles and tetrahedra are supported`);
    }
    if (keyword === GMF_VERTICES) yield* addPoints(reader, builder);
    if (keyword === GMF_TRIANGLES) yield* addPolygons(reader, builder, 3);
    if (keyword === GMF_QUADRILATERALS) yield* addPolygons(reader, builder, 4);
    if (keyword === GMF_TETRAHEDRA) yield* addTetrahedra(reader, builder);
  }
  return builder.mesh();
}

function* eachRow(
  reader: GmfReader,
  { reals = 0, indices }: { readonly reals?: number; readonly indices: number },
  add: () => void,
): Steps<void> {
  const count = reader.count();
  reader.requireRows(count, reals, indices);
  for (let row = 0; row < count; row++) {
    add();
    if ((row + 1) % STEP === 0) yield PAUSE;
  }
}

function addPoints(reader: GmfReader, builder: MeshBuilder): Steps<void> {
  if (builder.pointCount > 0) {
    reader.fail("the file has a second section of vertices, so it holds several meshes");
  }
  return eachRow(reader, { reals: 3, indices: 1 }, () => {
    const [x, y, z] = [reader.real(), reader.real(), reader.real()];
    if (!Number.isFinite(x + y + z)) reader.fail("a coordinate is not finite");
    builder.addPoint(x, y, z);
    reader.index();
  });
}

function cornerIn(reader: GmfReader, builder: MeshBuilder): number {
  const corner = reader.index();
  if (corner >= 1 && corner <= builder.pointCount) return corner - 1;
  return reader.fail(`a corner is ${corner}, but the file has the vertices 1 to ${builder.pointCount}`);
}

function addPolygons(reader: GmfReader, builder: MeshBuilder, size: number): Steps<void> {
  return eachRow(reader, { indices: size + 1 }, () => {
    const corners = Array.from({ length: size }, () => cornerIn(reader, builder));
    if (!builder.addPolygon(corners, builder.patches.tagged(reader.index()))) {
      reader.fail(`a quadrilateral ${UNCUT}`);
    }
  });
}

function addTetrahedra(reader: GmfReader, builder: MeshBuilder): Steps<void> {
  return eachRow(reader, { indices: 5 }, () => {
    const corner = () => cornerIn(reader, builder);
    const [a, b, c, d] = [corner(), corner(), corner(), corner()];
    builder.addTetrahedron(a, b, c, d, builder.regions.tagged(reader.index()));
  });
}

/** Returns the bytes of a `.meshb` file. */
export function writeMeditBinary(mesh: Mesh, note: Note): Part[] {
  const { points, triangles, trianglePatch, patches, tetrahedra, tetrahedronRegion, regions } = mesh;
  noteNames(patches, note);
  noteNames(regions, note);
  const nodes = points.length / 3;
  const rows = inPieces(nodes, (begin, end) => {
    const view = new Uint8Array(VERTEX_BYTES * (end - begin));
    const coordinates = new Uint8Array(points.buffer, points.byteOffset, points.byteLength);
    for (let node = begin; node < end; node++) {
      view.set(coordinates.subarray(24 * node, 24 * node + 24), VERTEX_BYTES * (node - begin));
    }
    return view;
  });
  return gmfFile([
    { keyword: GMF_VERTICES, count: nodes, bytes: VERTEX_BYTES * nodes, parts: [rows] },
    elements(GMF_TRIANGLES, triangles, 3, { owners: trianglePatch, groups: patches }),
    elements(GMF_TETRAHEDRA, tetrahedra, 4, { owners: tetrahedronRegion, groups: regions }),
  ]);
}

/** Three coordinates and a reference, which is 0. */
const VERTEX_BYTES = 28;

interface Owners {
  readonly owners: Uint32Array;
  readonly groups: readonly MeshGroup[];
}

function elements(
  keyword: number,
  corners: Uint32Array,
  width: number,
  { owners, groups }: Owners,
): GmfSection {
  const count = corners.length / width;
  const rows = inPieces(count, (begin, end) => {
    const piece = new Int32Array((width + 1) * (end - begin));
    for (let e = begin; e < end; e++) {
      const at = (width + 1) * (e - begin);
      for (let c = 0; c < width; c++) piece[at + c] = (corners[width * e + c] ?? 0) + 1;
      piece[at + width] = groups[owners[e] ?? 0]?.tag ?? 0;
    }
    return piece;
  });
  return { keyword, count, bytes: 4 * (width + 1) * count, parts: [rows] };
}
