/**
 * Reads TetGen's files, which hold numbers and `#` comments. `.smesh` and `.poly` contain their points or leave
 * them to the `.node` file next to them; `.face` and `.ele` always need it. Facets are polygons with a boundary
 * marker as patch; a facet of a `.poly` may have several polygons and holes. Tetrahedra have a region attribute.
 * Points mark holes and regions of the model; those of regions have an attribute and a largest volume.
 */
import { plural } from "../base/plural.js";
import type { Mesh, RegionPoint, RegionPoints } from "../mesh/mesh.js";
import { ByteReader } from "./byte-reader.js";
import type { ByteSource } from "./byte-source.js";
import type { OpenOther, ReadContext } from "./file-format.js";
import { MeshBuilder } from "./mesh-builder.js";
import { NameLines } from "./name-lines.js";
import { type Position3, UNCUT } from "./polygons.js";
import { failureIn, ReadFailure } from "./read-result.js";

const REMEDY = "Put TetGen's .node file next to the file, or save the surface again as .smesh.";
const MAX_COUNT = 0x7fffffff;

/** Points in a builder, and the number of the first point in the file. */
interface Points {
  readonly builder: MeshBuilder;
  first: number;
  /** Names from comments. */
  readonly names: NameLines;
  readonly signal: AbortSignal | undefined;
}

export async function readTetgen(
  source: ByteSource,
  { fileName, openOther, signal }: ReadContext,
): Promise<Mesh> {
  const [, stem = "", extension = ""] = /^(.*)\.([^.]*)$/.exec(fileName) ?? [];
  const points: Points = { builder: new MeshBuilder(), first: 0, names: new NameLines(), signal };
  let regionPoints: RegionPoints | undefined;
  switch (extension.toLowerCase()) {
    case "face":
      await readNodeFile(stem, openOther, points);
      await overFile(source, points, (reader) => readFaces(reader, points));
      break;
    case "ele":
      await readNodeFile(stem, openOther, points);
      await overFile(source, points, (reader) => readElements(reader, points));
      await readIfThere(stem, "face", openOther, points, (reader) => readFaces(reader, points));
      break;
    case "node":
      await overFile(source, points, (reader) => readNodes(reader, points));
      await readIfThere(stem, "ele", openOther, points, (reader) => readElements(reader, points));
      await readIfThere(stem, "face", openOther, points, (reader) => readFaces(reader, points));
      break;
    default:
      await overFile(source, points, async (reader) => {
        const count = await readNodes(reader, points);
        if (count === 0) await readNodeFile(stem, openOther, points);
        await readFacets(reader, points, extension.toLowerCase() === "poly");
        regionPoints = await readRegionPoints(reader, points.names);
      });
  }
  const mesh = points.names.applyTo(points.builder.mesh());
  return regionPoints === undefined ? mesh : { ...mesh, regionPoints };
}

function overFile<T>(
  source: ByteSource,
  { names, builder, signal }: Points,
  read: (reader: ByteReader) => Promise<T>,
): Promise<T> {
  return ByteReader.over(
    source,
    { remedy: REMEDY, comment: "#", onComment: names.readComment, signal },
    (reader) => {
      builder.onLongWork = reader.requestYield;
      return read(reader);
    },
  );
}

async function readNodeFile(stem: string, openOther: OpenOther, points: Points): Promise<void> {
  const isThere = await readIfThere(stem, "node", openOther, points, (reader) => readNodes(reader, points));
  if (isThere) return;
  const message = `the points are in another file, ${stem}.node, which is missing`;
  throw new ReadFailure({ code: "missing-file", message, remedy: REMEDY });
}

async function readIfThere(
  stem: string,
  extension: string,
  openOther: OpenOther,
  points: Points,
  read: (reader: ByteReader) => Promise<unknown>,
): Promise<boolean> {
  const fileName = `${stem}.${extension}`;
  const other = await openOther(fileName);
  if (other === undefined) return false;
  try {
    await overFile(other, points, read);
  } catch (failure) {
    throw failureIn(fileName, failure);
  }
  return true;
}

/** Reads number, x y z, attributes and marker of each point. Returns the announced number of points. */
async function readNodes(reader: ByteReader, points: Points): Promise<number> {
  const count = reader.index("the number of points", MAX_COUNT);
  if (count > 0 && reader.index("the dimension", 4) !== 3)
    reader.fail("the points are not three-dimensional");
  reader.skipLine();
  for (let i = 0; i < count; i++) {
    if (reader.isLow) await reader.fill();
    const number = reader.index("the number of a point", MAX_COUNT);
    if (i === 0) points.first = number;
    if (number !== points.first + i) reader.fail(`expected point ${points.first + i}, found ${number}`);
    const [x, y, z] = [0, 1, 2].map(() => reader.number("a coordinate"));
    points.builder.addPoint(x ?? 0, y ?? 0, z ?? 0);
    // Skip attributes and a marker.
    reader.skipLine();
  }
  return count;
}

function cornerIn(reader: ByteReader, { builder, first }: Points): number {
  const number = reader.index("a corner", first + builder.pointCount);
  return number >= first ? number - first : reader.fail(`point ${number} does not exist`);
}

/** Reads the next whole number of this line; 0 at its end. */
function markerIn(reader: ByteReader): number {
  return reader.hasWordInLine() ? reader.number("a marker") : 0;
}

async function readFaces(reader: ByteReader, points: Points): Promise<void> {
  const count = reader.index("the number of faces", MAX_COUNT);
  reader.skipLine();
  for (let f = 0; f < count; f++) {
    if (reader.isLow) await reader.fill();
    reader.index("the number of a face", MAX_COUNT);
    const [a, b, c] = [cornerIn(reader, points), cornerIn(reader, points), cornerIn(reader, points)];
    const marker = markerIn(reader);
    points.builder.addTriangle(a, b, c, points.builder.patches.tagged(marker));
    reader.skipLine();
  }
}

async function readElements(reader: ByteReader, points: Points): Promise<void> {
  const count = reader.index("the number of tetrahedra", MAX_COUNT);
  if (markerIn(reader) > 4)
    reader.fail("the tetrahedra have more than four nodes; only linear tetrahedra are supported");
  reader.skipLine();
  for (let t = 0; t < count; t++) {
    if (reader.isLow) await reader.fill();
    reader.index("the number of a tetrahedron", MAX_COUNT);
    const [a, b, c, d] = [0, 1, 2, 3].map(() => cornerIn(reader, points));
    const region = reader.hasWordInLine() ? reader.number("a region") : 1;
    points.builder.addTetrahedron(a ?? 0, b ?? 0, c ?? 0, d ?? 0, points.builder.regions.tagged(region));
    reader.skipLine();
  }
}

/** Reads facets. In a `.smesh`, a facet is one polygon; in a `.poly` it has several, and points that mark holes. */
async function readFacets(reader: ByteReader, points: Points, isPoly: boolean): Promise<void> {
  const count = reader.index("the number of facets", MAX_COUNT);
  const hasMarkers = markerIn(reader) > 0;
  reader.skipLine();
  for (let f = 0; f < count; f++) {
    if (reader.isLow) await reader.fill();
    await (isPoly ? readFacet(reader, points, f, hasMarkers) : readPolygon(reader, points, f));
  }
}

async function readFacet(reader: ByteReader, points: Points, f: number, hasMarkers: boolean): Promise<void> {
  const polygons = reader.index("the number of polygons", MAX_COUNT);
  const holes = reader.count(markerIn(reader), "holes");
  const marker = hasMarkers ? markerIn(reader) : 0;
  reader.skipLine();
  const rings: number[][] = [];
  for (let p = 0; p < polygons; p++) {
    if (reader.isLow) await reader.fill();
    const corners = cornersIn(reader, points);
    // Segments and single points inside a facet have no area.
    if (corners.length > 2) rings.push(corners);
    reader.skipLine();
  }
  const marks: Position3[] = [];
  for (let h = 0; h < holes; h++) {
    if (reader.isLow) await reader.fill();
    marks.push(pointIn(reader).position);
    reader.skipLine();
  }
  if (rings.length === 0) return;
  if (points.builder.addFacet(rings, marks, points.builder.patches.tagged(marker))) return;
  reader.fail(
    rings.length === 1 && holes === 0
      ? `facet ${f} (counted from 0) ${UNCUT}`
      : `facet ${f} (counted from 0) cannot be cut into triangles: its polygons intersect or have no area`,
    reader.location,
    "Save it as polygons that do not intersect, or as triangles.",
  );
}

function readPolygon(reader: ByteReader, points: Points, f: number): void {
  const corners = cornersIn(reader, points);
  if (corners.length < 3) reader.fail(`facet ${f} (counted from 0) has ${plural(corners.length, "corner")}`);
  const patch = points.builder.patches.tagged(markerIn(reader));
  if (!points.builder.addPolygon(corners, patch)) reader.fail(`facet ${f} (counted from 0) ${UNCUT}`);
  reader.skipLine();
}

function cornersIn(reader: ByteReader, points: Points): number[] {
  const size = reader.index("the number of corners", MAX_COUNT);
  const corners: number[] = [];
  for (let i = 0; i < size; i++) corners.push(cornerIn(reader, points));
  return corners;
}

/** Reads the number and the position of a point that marks a hole or a region. */
function pointIn(reader: ByteReader): Pick<RegionPoint, "number" | "position"> {
  const number = reader.number("the number of a point");
  const position: Position3 = [
    reader.number("a coordinate"),
    reader.number("a coordinate"),
    reader.number("a coordinate"),
  ];
  return { number, position };
}

/** Reads the sections of hole points and of region points; either may be missing at the end of the file. */
async function readRegionPoints(reader: ByteReader, { regions: names }: NameLines): Promise<RegionPoints> {
  const holes = await pointsIn(reader, "hole", (point) => point);
  const regions = await pointsIn(reader, "region", (point): RegionPoint => {
    const tag = markerIn(reader);
    const volume = markerIn(reader);
    return { ...point, tag, name: names.get(tag), maxVolume: volume > 0 ? volume : undefined };
  });
  return { holes, regions };
}

/** `rest` reads what follows the position. */
async function pointsIn<Point>(
  reader: ByteReader,
  word: string,
  rest: (point: Pick<RegionPoint, "number" | "position">) => Point,
): Promise<Point[]> {
  await reader.fill();
  if (!reader.startsNumber()) return [];
  const count = reader.count(reader.number(`the number of ${word} points`), `${word} points`);
  reader.skipLine();
  const found: Point[] = [];
  for (let i = 0; i < count; i++) {
    if (reader.isLow) await reader.fill();
    found.push(rest(pointIn(reader)));
    reader.skipLine();
  }
  return found;
}
