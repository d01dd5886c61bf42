/**
 * OFF (Geomview's object file format), as text: corners by number, `#` begins a comment. Normals and texture
 * coordinates of the variants are read over; faces of one colour are a patch; polygons are cut into triangles.
 */
import { ByteReader } from "./byte-reader.js";
import type { ByteSource } from "./byte-source.js";
import { colorPatch, numbersInLine } from "./colors.js";
import type { FileMesh } from "./file-mesh.js";
import { MeshBuilder } from "./mesh-builder.js";
import { FaceLines } from "./name-lines.js";
import { UNCUT } from "./polygons.js";

const REMEDY = "Export the surface again as an OFF file in text form.";
/** Three numbers and the blanks around them are no longer. */
const COUNTS_BYTES = 64;
/** More than these would be written as a triangle soup of a different format, or are garbage. */
const MAX_COUNT = 0x7fffffff;

export function readOff(source: ByteSource): Promise<FileMesh> {
  const lines = new FaceLines();
  const options = { remedy: REMEDY, comment: "#", heard: lines.hear };
  return ByteReader.over(source, options, async (reader) => {
    const hasExtras = readHeader(reader);
    const pointCount = reader.index("the number of points", MAX_COUNT);
    const faceCount = reader.index("the number of faces", MAX_COUNT);
    reader.index("the number of edges", MAX_COUNT);
    const builder = new MeshBuilder();
    for (let i = 0; i < pointCount; i++) {
      if (reader.isLow) await reader.fill();
      const [x, y, z] = [0, 1, 2].map(() => reader.number(`a coordinate of point ${i}`));
      builder.addPoint(x ?? 0, y ?? 0, z ?? 0);
      if (hasExtras) reader.skipLine();
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
    return lines.given(builder.mesh());
  });
}

/** Whether more than x y z may stand in a point's line. Files may leave the word out and begin with their numbers. */
function readHeader(reader: ByteReader): boolean {
  reader.skipComments();
  if (/^\d+\s+\d+\s+\d+\s/.test(String.fromCharCode(...reader.peek(COUNTS_BYTES)))) return false;
  const word = reader.word();
  const variant = /^(ST)?(C)?(N)?(4)?(n)?OFF$/.exec(word);
  if (variant === null) return reader.fail('the file does not begin with "OFF"');
  if (variant[4] !== undefined || variant[5] !== undefined) {
    return reader.fail(`"${word}" has points of other than three dimensions`);
  }
  return word !== "OFF";
}

function readFace(reader: ByteReader, builder: MeshBuilder, f: number): void {
  const size = reader.index(`the number of corners of face ${f}`, MAX_COUNT);
  if (size < 3) reader.fail(`face ${f} has ${size} corners`);
  const corners: number[] = [];
  for (let i = 0; i < size; i++) corners.push(reader.index(`a corner of face ${f}`, builder.pointCount));
  // A colour may follow: one number of a table, or three or four, from 0 to 1 or from 0 to 255.
  const patch = colorPatch(builder.patches, numbersInLine(reader));
  if (!builder.addPolygon(corners, patch)) {
    reader.fail(`face ${f} ${UNCUT}`);
  }
  reader.skipLine();
}
