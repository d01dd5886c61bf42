/**
 * STL, binary and ASCII: triangle soup, whose equal corners are welded exactly while they arrive. A file is
 * text if it begins with "solid" and has no zero byte near its begin: some binary files begin with that
 * word too, but all of them have zeros in the number of triangles. Solids, and the attributes of binary
 * triangles, become patches; normals are not used.
 */
import { plural } from "../plural.js";
import { failureAt, ReadFailure } from "../read-result.js";
import { ByteReader, FIRST_LINE } from "./byte-reader.js";
import type { ByteSource } from "./byte-source.js";
import type { FileGroup, FileMesh } from "./file-mesh.js";
import { MeshBuilder } from "./mesh-builder.js";
import { NAME_BREAK, NameLines, STL_NAMES } from "./name-lines.js";

const HEADER_BYTES = 80;
const COUNT_BYTES = 4;
/** Normal and three corners as float32, and two bytes of attributes. */
const TRIANGLE_BYTES = 50;
const NORMAL_BYTES = 12;
/** How much of a file is looked at to tell text from binary. */
const SNIFFED_BYTES = 1024;
/** Triangles between two looks at the window. */
const BATCH = 1024;

const REMEDY = "Export the surface again; the file is damaged or is not STL.";

export function readStl(source: ByteSource): Promise<FileMesh> {
  return ByteReader.over(source, { remedy: REMEDY }, (reader) => {
    const head = reader.peek(SNIFFED_BYTES);
    const startsLikeText = /^\s*solid/i.test(new TextDecoder().decode(head.subarray(0, HEADER_BYTES)));
    if (startsLikeText && !head.includes(0)) return readText(reader);
    if (head.length < HEADER_BYTES + COUNT_BYTES) {
      throw failureAt({ offset: head.length }, "the file ends here, with too few bytes for STL", REMEDY);
    }
    if (!head.includes(0)) {
      reader.fail('this is text, but not an STL file: it does not begin with "solid"', FIRST_LINE);
    }
    return readBinary(reader);
  });
}

async function readBinary(reader: ByteReader): Promise<FileMesh> {
  const head = await reader.bytes(HEADER_BYTES);
  const header = String.fromCharCode(...head);
  const names = new NameLines();
  const title = new TextDecoder().decode(head).replace(/\0+$/, "");
  if (title.startsWith(STL_NAMES)) {
    const told = title.slice(STL_NAMES.length).split(NAME_BREAK);
    for (const [p, name] of told.entries()) names.hear(`patch ${p + 1} ${name}`);
  }
  const count = reader.integer(COUNT_BYTES, false);
  const builder = new MeshBuilder(true);
  for (let t = 0; t < count; t++) {
    if (t % BATCH === 0) await reader.fill();
    if (reader.ahead < TRIANGLE_BYTES) throw tooShort(reader.offset + reader.ahead, count);
    readTriangle(reader, builder, header);
  }
  await reader.fill();
  // Zeros fill up blocks; anything else is what a wrong number would leave out.
  if (reader.ahead >= TRIANGLE_BYTES && reader.peek(TRIANGLE_BYTES).some((byte) => byte !== 0)) {
    reader.fail(`the file goes on behind the ${plural(count, "triangle")} it announces`);
  }
  return names.given(builder.mesh());
}

function tooShort(length: number, count: number): ReadFailure {
  const needed = HEADER_BYTES + COUNT_BYTES + TRIANGLE_BYTES * count;
  const message = `the file ends at byte ${length}, of ${needed} for the ${plural(count, "triangle")} it announces`;
  return new ReadFailure({ message, remedy: REMEDY, offset: length });
}

function readTriangle(reader: ByteReader, builder: MeshBuilder, header: string): void {
  reader.skip(NORMAL_BYTES);
  const a = readCorner(reader, builder);
  const b = readCorner(reader, builder);
  const c = readCorner(reader, builder);
  const attribute = reader.integer(2, false);
  const known = builder.patches.known(attribute);
  const patch = known ?? builder.patches.of(attribute, () => attributePatch(attribute, header));
  builder.addTriangle(a, b, c, patch);
}

function readCorner(reader: ByteReader, builder: MeshBuilder): number {
  const x = reader.float(4);
  const y = reader.float(4);
  const z = reader.float(4);
  if (!(Number.isFinite(x) && Number.isFinite(y) && Number.isFinite(z))) {
    reader.fail("a corner has no finite place");
  }
  return builder.addCorner(x, y, z);
}

/**
 * What the two bytes of a triangle say: a colour of 5 bits each where bit 15 is set, blue lowest, or, in
 * files whose header says "COLOR=", where it is clear, red lowest; else just a number.
 */
function attributePatch(attribute: number, header: string): FileGroup {
  const tag = attribute + 1;
  const hasDefault = header.includes("COLOR=");
  const isColor = attribute !== 0 && ((attribute & 0x8000) === 0) === hasDefault;
  if (!isColor) return { name: attribute === 0 ? "surface" : `attribute ${attribute}`, tag };
  const [low, middle, high] = [0, 5, 10].map((shift) => ((attribute >> shift) & 31) / 31) as [
    number,
    number,
    number,
  ];
  return { name: `color ${attribute}`, tag, color: hasDefault ? [low, middle, high] : [high, middle, low] };
}

async function readText(reader: ByteReader): Promise<FileMesh> {
  const builder = new MeshBuilder(true);
  let patch = 0;
  let isOpen = false;
  for (;;) {
    if (reader.isLow) await reader.fill();
    if (reader.accepts("facet")) readFacet(reader, builder, patch);
    else if (reader.accepts("solid")) {
      // What follows is a name, which may hold any words.
      isOpen = true;
      patch = builder.patches.named(reader.line() || `solid ${builder.patches.length + 1}`);
    } else if (reader.accepts("endsolid")) {
      isOpen = false;
      reader.skipLine();
    } else {
      const word = reader.word();
      if (word === "" && isOpen)
        reader.fail('the file ends where "facet" or "endsolid" should be: it was cut off');
      if (word === "") return builder.mesh();
      reader.fail(`"${word.slice(0, 24)}" where "facet" or "endsolid" should be`);
    }
  }
}

function readFacet(reader: ByteReader, builder: MeshBuilder, patch: number): void {
  reader.expect("normal");
  // The normal follows from the corners; here it may be anything, as some programs write NaN.
  for (let i = 0; i < 3; i++) reader.word();
  reader.expect("outer");
  reader.expect("loop");
  const [a, b, c] = [readVertex(reader, builder), readVertex(reader, builder), readVertex(reader, builder)];
  reader.expect("endloop");
  reader.expect("endfacet");
  builder.addTriangle(a, b, c, patch);
}

function readVertex(reader: ByteReader, builder: MeshBuilder): number {
  reader.expect("vertex");
  const x = reader.number("a coordinate");
  const y = reader.number("a coordinate");
  return builder.addCorner(x, y, reader.number("a coordinate"));
}
