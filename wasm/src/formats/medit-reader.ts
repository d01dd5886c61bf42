/**
 * Reads Medit `.mesh` files (text): triangles and quadrilaterals with their reference as patch, tetrahedra
 * with theirs as region. Edges, corners, normals and the like are passed over.
 */
import { ByteReader } from "./byte-reader.js";
import type { ByteSource } from "./byte-source.js";
import type { FileMesh } from "./file-mesh.js";
import { MeshBuilder } from "./mesh-builder.js";
import { NameLines } from "./name-lines.js";
import { UNCUT } from "./polygons.js";

const REMEDY = "Save the mesh again as a Medit file in text form, with triangles or linear tetrahedra.";

/** Numbers per entry of the sections that are passed over. */
const SKIPPED: ReadonlyMap<string, number> = new Map([
  ["edges", 3],
  ["corners", 1],
  ["ridges", 1],
  ["requiredvertices", 1],
  ["requirededges", 1],
  ["requiredtriangles", 1],
  ["requiredtetrahedra", 1],
  ["requiredquadrilaterals", 1],
  ["normals", 3],
  ["tangents", 3],
  ["normalatvertices", 2],
  ["tangentatvertices", 2],
  ["tangentatedges", 3],
  ["normalattrianglevertices", 3],
  ["normalatquadrilateralvertices", 3],
  ["vertexongeometricvertex", 2],
  ["vertexongeometricedge", 3],
  ["vertexongeometrictriangle", 4],
  ["edgeongeometricedge", 2],
  ["triangleongeometrictriangle", 2],
  ["subdomainfrommesh", 4],
  ["subdomainfromgeom", 4],
]);
/** Sections of so many numbers, without a number of entries. */
const HEADS: ReadonlyMap<string, number> = new Map([
  ["boundingbox", 6],
  ["angleofcornerbound", 1],
]);
const VOLUMES = new Set(["hexahedra", "hexaedra", "prisms", "pyramids"]);

export function readMedit(source: ByteSource): Promise<FileMesh> {
  const names = new NameLines();
  const options = { remedy: REMEDY, comment: "#", heard: names.hear };
  return ByteReader.over(source, options, async (reader) => {
    reader.expect("meshversionformatted");
    reader.number("the version");
    const builder = new MeshBuilder();
    for (;;) {
      await reader.fill();
      const word = reader.word().toLowerCase();
      if (word === "" || word === "end") return names.given(builder.mesh());
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
    default: {
      if (VOLUMES.has(word)) {
        return eachEntry(reader, () => reader.fail(`${word} cannot be read, only triangles and tetrahedra`));
      }
      const head = HEADS.get(word);
      if (head !== undefined) return skipNumbers(reader, head, word);
      const width = SKIPPED.get(word) ?? reader.fail(`"${word.slice(0, 24)}" is not a section`);
      return eachEntry(reader, () => skipNumbers(reader, width, word));
    }
  }

  function corner(): number {
    return cornerIn(reader, builder);
  }
}

function skipNumbers(reader: ByteReader, count: number, section: string): void {
  for (let i = 0; i < count; i++) reader.number(`a number of ${section}`);
}

/** Words from one that begins with a quote to one that ends with it. */
function skipQuoted(reader: ByteReader): void {
  let word = reader.word();
  if (!word.startsWith('"')) reader.fail("a text in quotes should be here");
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
  return corner > 0 ? corner - 1 : reader.fail("a corner is 0, they are counted from 1");
}

function addPolygon(reader: ByteReader, builder: MeshBuilder, size: number): void {
  const corners = Array.from({ length: size }, () => cornerIn(reader, builder));
  const patch = builder.patches.tagged(reader.number("a reference"));
  if (!builder.addPolygon(corners, patch)) {
    reader.fail(`a quadrilateral ${UNCUT}`);
  }
}
