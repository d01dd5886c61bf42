/**
 * Reads Medit `.mesh` files (text): triangles and quadrilaterals with their reference as patch, tetrahedra with
 * their reference as region. Other sections, such as edges, corners and normals, are skipped. Values at the nodes come from
 * the `.sol` or `.solb` file of the same name beside it, if there is one.
 */
import type { Mesh } from "../mesh/mesh.js";
import { ByteReader } from "./byte-reader.js";
import type { ByteSource } from "./byte-source.js";
import type { ReadContext } from "./file-format.js";
import { readSolBeside } from "./medit-sol.js";
import { MeshBuilder } from "./mesh-builder.js";
import { NameLines } from "./name-lines.js";
import { UNCUT } from "./polygons.js";

const REMEDY = "Save the mesh again as a Medit text file with triangles or linear tetrahedra.";

/** Sections to skip: numbers up to the next word. Their count per entry depends on the program that wrote the file. */
const SKIPPED = new Set([
  ...["edges", "corners", "ridges", "tangents", "normals", "boundingbox", "angleofcornerbound"],
  ...["requiredvertices", "requirededges", "requiredtriangles", "requiredquadrilaterals"],
  ...["requiredtetrahedra", "requiredprisms", "requiredhexahedra", "requiredpyramids"],
  ...["tangentatvertices", "tangentatedges", "tangentatedgevertices", "normalatvertices"],
  ...["normalattrianglevertices", "normalatquadrilateralvertices"],
  ...["vertexongeometricvertex", "vertexongeometricedge", "vertexongeometrictriangle"],
  ...["vertexongeometricquadrilateral", "edgeongeometricedge", "triangleongeometrictriangle"],
  ...["quadrilateralongeometricquadrilateral", "subdomainfrommesh", "subdomainfromgeom"],
  ...["extraverticesatedges", "extraverticesattriangles", "extraverticesatquadrilaterals"],
  ...["extraverticesattetrahedra", "extraverticesathexahedra", "coarsehexahedra", "edgesp2", "edgesp3"],
  ...["periodicvertices", "periodicedges", "periodictriangles", "periodicquadrilaterals"],
  ...["paralleltriangles", "parallelvertices", "iterations", "time", "solatvertices", "solatedges"],
  ...["solattriangles", "solattetrahedra", "solatquadrilaterals", "domain", "incidents", "version"],
]);
/** Elements other than linear triangles and tetrahedra; a file with any of them is rejected. */
const OTHERS =
  /^(hexahedra|hexaedra|prisms|pyramids|(triangles|tetrahedra|hexahedra|prisms|pyramids)[pq][2-4]|quadrilaterals[pq][2-4])$/;

export async function readMedit(source: ByteSource, { fileName, openOther }: ReadContext): Promise<Mesh> {
  const mesh = await readMeditMesh(source);
  const stem = fileName.replace(/\.[^.]*$/, "");
  const { nodeData, notes } = await readSolBeside(stem, mesh.points.length / 3, openOther);
  if (nodeData.size === 0 && notes.length === 0) return mesh;
  return { ...mesh, nodeData, notes: [...(mesh.notes ?? []), ...notes] };
}

function readMeditMesh(source: ByteSource): Promise<Mesh> {
  const names = new NameLines();
  const options = { remedy: REMEDY, comment: "#", onComment: names.readComment };
  return ByteReader.over(source, options, async (reader) => {
    reader.expect("meshversionformatted");
    reader.number("the version");
    const builder = new MeshBuilder();
    for (;;) {
      await reader.fill();
      const word = reader.word().toLowerCase();
      if (word === "" || word === "end") return names.applyTo(builder.mesh());
      await readSection(reader, word, builder);
    }
  });
}

async function readSection(reader: ByteReader, word: string, builder: MeshBuilder): Promise<void> {
  switch (word) {
    case "dimension":
      if (reader.number("the dimension") !== 3) reader.fail("the mesh is not three-dimensional");
      return;
    case "vertices":
      if (builder.pointCount > 0)
        reader.fail("the file has a second section of vertices, so it holds several meshes");
      return eachEntry(reader, () => {
        const [x, y, z] = [0, 1, 2].map(() => reader.number("a coordinate"));
        builder.addPoint(x ?? 0, y ?? 0, z ?? 0);
        reader.number("a reference");
      });
    case "triangles":
      return eachEntry(reader, () => addPolygon(reader, builder, 3));
    case "quadrilaterals":
      return eachEntry(reader, () => addPolygon(reader, builder, 4));
    case "tetrahedra":
      return eachEntry(reader, () => {
        const [a, b, c, d] = [corner(), corner(), corner(), corner()];
        builder.addTetrahedron(a, b, c, d, builder.regions.tagged(reader.number("a reference")));
      });
    case "identifier":
    case "geometry":
      return skipQuoted(reader);
    default:
      if (SKIPPED.has(word)) return skipNumbers(reader);
      if (!OTHERS.test(word)) reader.failUnknown("section", word);
      return eachEntry(reader, () =>
        reader.fail(`the file has ${word}; only linear triangles and tetrahedra are supported`),
      );
  }

  function corner(): number {
    return cornerIn(reader, builder);
  }
}

async function skipNumbers(reader: ByteReader): Promise<void> {
  while (reader.startsNumber()) {
    if (reader.isLow) await reader.fill();
    reader.number("a number");
  }
}

/** Skips words from an opening quote to the closing one. */
function skipQuoted(reader: ByteReader): void {
  let word = reader.word();
  if (!word.startsWith('"')) reader.fail(`expected a text in quotes, found "${word.slice(0, 24)}"`);
  if (word === '"') word = reader.word();
  while (word !== "" && !word.endsWith('"')) word = reader.word();
}

async function eachEntry(reader: ByteReader, readEntry: () => void): Promise<void> {
  const count = reader.count(reader.number("a number of entries"), "entries");
  for (let i = 0; i < count; i++) {
    if (reader.isLow) await reader.fill();
    readEntry();
  }
}

function cornerIn(reader: ByteReader, builder: MeshBuilder): number {
  const corner = reader.index("a corner, counted from 1", builder.pointCount + 1);
  return corner > 0 ? corner - 1 : reader.fail("a corner is 0, but corners are counted from 1");
}

function addPolygon(reader: ByteReader, builder: MeshBuilder, size: number): void {
  const corners = Array.from({ length: size }, () => cornerIn(reader, builder));
  const patch = builder.patches.tagged(reader.number("a reference"));
  if (!builder.addPolygon(corners, patch)) {
    reader.fail(`a quadrilateral ${UNCUT}`);
  }
}
