/**
 * Reads OFF (Geomview's object file format), text or binary; `#` begins a comment. Normals and texture coordinates
 * of the variants are skipped. Faces of one colour become a patch. Polygons are cut into triangles.
 */
import { plural } from "../base/plural.js";
import type { Mesh } from "../mesh/mesh.js";
import { ByteReader } from "./byte-reader.js";
import type { ByteSource } from "./byte-source.js";
import { colorPatch, numbersInLine } from "./colors.js";
import type { ReadContext } from "./file-format.js";
import { MeshBuilder } from "./mesh-builder.js";
import { FaceLines } from "./name-lines.js";
import { UNCUT } from "./polygons.js";

const REMEDY = "Export the surface again as an OFF file in text form.";
/** Follows the first word of a binary file, whose numbers have four bytes, high byte first. */
const BINARY = /^[ \t]+BINARY[ \t\r\n]/;
/** Enough bytes for the three counts and the blanks around them. */
const COUNTS_BYTES = 64;
/** Larger counts indicate a damaged file. */
const MAX_COUNT = 0x7fffffff;

export function readOff(source: ByteSource, { signal }: Pick<ReadContext, "signal"> = {}): Promise<Mesh> {
  const lines = new FaceLines();
  const options = { remedy: REMEDY, comment: "#", onComment: lines.readComment, signal };
  return ByteReader.over(source, options, async (reader) => {
    const { extras, isBinary } = readHeader(reader);
    const builder = new MeshBuilder();
    builder.onLongWork = reader.requestYield;
    if (isBinary) {
      await readBinary(reader, builder, extras);
      return builder.mesh();
    }
    const pointCount = reader.index("the number of points", MAX_COUNT);
    const faceCount = reader.index("the number of faces", MAX_COUNT);
    reader.index("the number of edges", MAX_COUNT);
    for (let i = 0; i < pointCount; i++) {
      if (reader.isLow) await reader.fill();
      const [x, y, z] = [0, 1, 2].map(() => reader.number(`a coordinate of point ${i}`));
      builder.addPoint(x ?? 0, y ?? 0, z ?? 0);
      if (extras > 0) reader.skipLine();
    }
    for (let f = 0; f < faceCount; f++) {
      if (reader.isLow) await reader.fill();
      readFace(reader, builder, f);
    }
    for (let before = -1; before < reader.offset;) {
      before = reader.offset;
      await reader.fill();
      reader.skipComments();
    }
    if (/OFF$/.test(reader.word())) reader.fail("a second surface follows the first one");
    return lines.applyTo(builder.mesh());
  });
}

interface OffHeader {
  /** Number of values per point besides x y z. */
  readonly extras: number;
  readonly isBinary: boolean;
}

/** Reads the header. Files may omit the word OFF and begin with the counts. */
function readHeader(reader: ByteReader): OffHeader {
  reader.skipComments();
  if (/^\d+\s+\d+\s+\d+\s/.test(String.fromCharCode(...reader.peek(COUNTS_BYTES)))) {
    return { extras: 0, isBinary: false };
  }
  const word = reader.word();
  const variant = /^(ST)?(C)?(N)?(4)?(n)?OFF$/.exec(word);
  if (variant === null) return reader.fail('the file does not begin with "OFF"');
  if (variant[4] !== undefined || variant[5] !== undefined) {
    return reader.fail(`"${word}" files have points that are not three-dimensional`);
  }
  const [, texture, color, normal] = variant;
  const extras =
    (texture === undefined ? 0 : 2) + (color === undefined ? 0 : 4) + (normal === undefined ? 0 : 3);
  const isBinary = BINARY.test(String.fromCharCode(...reader.peek(COUNTS_BYTES)));
  if (isBinary) {
    reader.wordInLine();
    reader.endLine();
    reader.isLittleEndian = false;
  }
  return { extras, isBinary };
}

async function readBinary(reader: ByteReader, builder: MeshBuilder, extras: number): Promise<void> {
  const integer = (what: string) => reader.count(reader.integer(4, true), what);
  const [pointCount, faceCount] = [integer("points"), integer("faces")];
  integer("edges");
  for (let i = 0; i < pointCount; i++) {
    if (reader.isLow) await reader.fill();
    const [x = NaN, y = NaN, z = NaN] = Array.from({ length: 3 + extras }, () => reader.float(4));
    if (!Number.isFinite(x + y + z)) reader.fail(`point ${i} has a coordinate that is not finite`);
    builder.addPoint(x, y, z);
  }
  for (let f = 0; f < faceCount; f++) {
    if (reader.isLow) await reader.fill();
    const size = integer("corners");
    if (size < 3) reader.fail(`face ${f} has ${plural(size, "corner")}`);
    const corners: number[] = [];
    for (let i = 0; i < size; i++) {
      const corner = reader.integer(4, true);
      if (!(corner >= 0 && corner < pointCount)) {
        reader.fail(
          `face ${f} (counted from 0) has corner ${corner}, but the file has ${plural(pointCount, "point")}`,
        );
      }
      corners.push(corner);
    }
    const colors = integer("numbers of a colour");
    if (colors > 4) reader.fail(`the colour of face ${f} has ${colors} components; the limit is 4`);
    const patch = colorPatch(
      builder.patches,
      Array.from({ length: colors }, () => reader.float(4)),
    );
    if (!builder.addPolygon(corners, patch)) reader.fail(`face ${f} ${UNCUT}`);
  }
}

function readFace(reader: ByteReader, builder: MeshBuilder, f: number): void {
  const size = reader.index(`the number of corners of face ${f}`, MAX_COUNT);
  if (size < 3) reader.fail(`face ${f} has ${plural(size, "corner")}`);
  const corners: number[] = [];
  for (let i = 0; i < size; i++) corners.push(reader.index(`a corner of face ${f}`, builder.pointCount));
  // A colour may follow: an index of a colour table, or three or four components from 0 to 1 or from 0 to 255.
  const patch = colorPatch(builder.patches, numbersInLine(reader));
  if (!builder.addPolygon(corners, patch)) {
    reader.fail(`face ${f} ${UNCUT}`);
  }
  reader.skipLine();
}
