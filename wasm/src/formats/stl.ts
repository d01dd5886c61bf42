/**
 * Reads STL, binary and ASCII: triangle soup, whose equal corners are welded exactly while they arrive. A file is
 * text if it begins with "solid" and its first kilobyte contains no zero byte. Some binary files begin with that
 * word too, but all of them have zeros in the triangle count. Patches are the solids of a text file and the
 * attributes of a binary one, which are colours if the header or a bit of the attribute marks them as such.
 * Normals are ignored.
 */
import { plural } from "../base/plural.js";
import { inSteps } from "../calls/yielder.js";
import type { Mesh } from "../mesh/mesh.js";
import { ByteReader, FIRST_LINE } from "./byte-reader.js";
import type { ByteSource } from "./byte-source.js";
import { hexOf } from "./colors.js";
import { type GroupList, MeshBuilder } from "./mesh-builder.js";
import { NAME_BREAK, STL_NAMES } from "./name-lines.js";
import { openEdges } from "./open-edges.js";
import { failureAt, type ReadFailure, truncatedAt } from "./read-result.js";
import { indexOf, textOf } from "./text-bytes.js";

const HEADER_BYTES = 80;
const COUNT_BYTES = 4;
/** Normal and three corners as float32, and two bytes of attributes. */
const TRIANGLE_BYTES = 50;
const NORMAL_BYTES = 12;
/** Number of bytes inspected to distinguish text from binary. */
const SNIFFED_BYTES = 1024;
/** From this count on, a file would have more than 100 GB: programs that do not know the count write -1. */
const UNKNOWN_COUNT = 2 ** 31;
/** Number of triangles between two checks of the window. */
const BATCH = 1024;

const REMEDY = "Export the surface again; the file is damaged or not STL.";

export function readStl(source: ByteSource): Promise<Mesh> {
  return ByteReader.over(source, { remedy: REMEDY }, (reader) => {
    const head = reader.peek(SNIFFED_BYTES);
    const startsLikeText = /^\s*solid/i.test(new TextDecoder().decode(head.subarray(0, HEADER_BYTES)));
    if (startsLikeText && !head.includes(0)) return readText(reader);
    if (head.length < HEADER_BYTES + COUNT_BYTES) {
      throw failureAt({ offset: head.length }, "the file is too short for STL", REMEDY);
    }
    if (!head.includes(0)) {
      reader.fail('a text STL file must begin with "solid"', FIRST_LINE);
    }
    return readBinary(reader);
  });
}

async function readBinary(reader: ByteReader): Promise<Mesh> {
  const head = await reader.bytes(HEADER_BYTES);
  const count = reader.integer(COUNT_BYTES, false);
  const builder = new MeshBuilder(true);
  const attributes = new Attributes(builder.patches, objectColor(head));
  const isCounted = count < UNKNOWN_COUNT;
  for (let t = 0; isCounted && t < count; t++) {
    if (t % BATCH === 0) await reader.fill();
    if (reader.ahead < TRIANGLE_BYTES) throw tooShort(reader.offset + reader.ahead, count);
    readTriangle(reader, builder, attributes);
  }
  const more = await readUncounted(reader, isCounted ? count : 0, () =>
    readTriangle(reader, builder, attributes),
  );
  const mesh = attributes.named(builder.mesh(), head);
  if (more === "remark") return { ...mesh, notes: [remarkNote(count)] };
  return more === 0 ? mesh : { ...mesh, notes: [countNote(count, more + (isCounted ? count : 0))] };
}

/**
 * Reads the triangles after the announced ones, because some programs write a count of 0 or another wrong one; returns
 * their number, or that what follows the announced ones is something else. Records of zeros are padding. Content that is not a
 * whole number of triangles is a failure.
 */
async function readUncounted(
  reader: ByteReader,
  count: number,
  readOne: () => void,
): Promise<number | "remark"> {
  const end = reader.location;
  let more = 0;
  for (let record = 0; ; record++) {
    if (record % BATCH === 0) await reader.fill();
    const next = reader.peek(TRIANGLE_BYTES);
    if (next.every((byte) => byte === 0)) {
      if (next.length < TRIANGLE_BYTES) return more;
      reader.skip(TRIANGLE_BYTES);
      continue;
    }
    if (more === 0 && count > 0 && isRemark(reader.peek(LONGEST_REMARK + 1))) return "remark";
    more++;
    if (next.length < TRIANGLE_BYTES) {
      reader.fail(
        `the file continues after the ${plural(count, "triangle")} that its header announces, but not with whole triangles`,
        end,
      );
    }
    readOne();
  }
}

/** Largest number of bytes of a remark of a program. */
const LONGEST_REMARK = 4096;

/** Returns whether the rest of a file is text, or too short for a triangle. */
function isRemark(rest: Uint8Array): boolean {
  const isText = rest.every(
    (byte) => (byte >= 0x20 && byte < 0x7f) || (byte >= 0x09 && byte <= 0x0d) || byte === 0,
  );
  return rest.length < TRIANGLE_BYTES || (rest.length <= LONGEST_REMARK && isText);
}

function remarkNote(announced: number): string {
  return `what follows the ${plural(announced, "triangle")} that the header announces is not read`;
}

function countNote(announced: number, read: number): string {
  const count = announced < UNKNOWN_COUNT ? plural(announced, "triangle") : "an unknown number of triangles";
  return `the header announces ${count}, but the file has ${read}, which are read`;
}

function tooShort(length: number, count: number): ReadFailure {
  const needed = HEADER_BYTES + COUNT_BYTES + TRIANGLE_BYTES * count;
  const where = `there, but the ${plural(count, "triangle")} that its header announces need ${needed} bytes`;
  return truncatedAt({ offset: length }, where);
}

function readTriangle(reader: ByteReader, builder: MeshBuilder, attributes: Attributes): void {
  reader.skip(NORMAL_BYTES);
  const a = readCorner(reader, builder);
  const b = readCorner(reader, builder);
  const c = readCorner(reader, builder);
  builder.addTriangle(a, b, c, attributes.patchOf(reader.integer(2, false)));
}

function readCorner(reader: ByteReader, builder: MeshBuilder): number {
  const x = reader.float(4);
  const y = reader.float(4);
  const z = reader.float(4);
  if (!(Number.isFinite(x) && Number.isFinite(y) && Number.isFinite(z))) {
    reader.fail("a corner has a coordinate that is not finite");
  }
  return builder.addCorner(x, y, z);
}

type Color = readonly [number, number, number];

/** Magics writes this to the header, before the colour of all triangles without their own. */
const OBJECT_COLOR = "COLOR=";

/** Reads the three bytes after the keyword; undefined in files of other programs. */
function objectColor(head: Uint8Array): Color | undefined {
  const at = indexOf(head, new TextEncoder().encode(OBJECT_COLOR), 0);
  if (at < 0) return undefined;
  const [red, green, blue] = [0, 1, 2].map((i) => (head[at + OBJECT_COLOR.length + i] ?? 0) / 255);
  return [red ?? 0, green ?? 0, blue ?? 0];
}

const COLOR_BIT = 0x8000;

/** Interprets the two attribute bytes of triangles. */
class Attributes {
  readonly #patches: GroupList;
  readonly #objectColor: Color | undefined;
  readonly #known = new Map<number, number>();

  constructor(patches: GroupList, color: Color | undefined) {
    this.#patches = patches;
    this.#objectColor = color;
  }

  patchOf(attribute: number): number {
    const known = this.#known.get(attribute);
    if (known !== undefined) return known;
    const color = this.#colorOf(attribute);
    const patch =
      color !== undefined
        ? this.#patches.named(hexOf(color), color)
        : attribute === 0
          ? this.#patches.of("surface", () => ({ name: "surface", tag: 1 }))
          : this.#patches.tagged(attribute, `attribute ${attribute}`);
    this.#known.set(attribute, patch);
    return patch;
  }

  /**
   * VisCAM: if bit 15 is set, the lowest five bits are blue, then green and red. Magics: if bit 15 is set, the
   * colour is the object's; otherwise, unless all bits are 0, the lowest five bits are red, then green and blue.
   */
  #colorOf(attribute: number): Color | undefined {
    const isSet = attribute >= COLOR_BIT;
    const [low, middle, high] = [0, 5, 10].map((shift) => ((attribute >> shift) & 31) / 31) as [
      number,
      number,
      number,
    ];
    if (this.#objectColor === undefined) return isSet ? [high, middle, low] : undefined;
    if (isSet) return this.#objectColor;
    return attribute === 0 ? undefined : [low, middle, high];
  }

  /** Adds the names that this package writes to the header, in the order of the attributes. */
  named(mesh: Mesh, head: Uint8Array): Mesh {
    const title = textOf(head).replace(/\0+$/, "");
    if (!title.startsWith(STL_NAMES)) return mesh;
    const names = title.slice(STL_NAMES.length).split(NAME_BREAK);
    const order = [...this.#known].sort(([a], [b]) => a - b).map(([, patch]) => patch);
    if (order.length !== names.length) return mesh;
    return {
      ...mesh,
      patches: mesh.patches.map((patch, p) => ({ ...patch, name: names[order.indexOf(p)] ?? patch.name })),
    };
  }
}

async function readText(reader: ByteReader): Promise<Mesh> {
  const builder = new MeshBuilder(true);
  let patch = 0;
  let isOpen = false;
  for (;;) {
    if (reader.isLow) await reader.fill();
    if (reader.accepts("facet")) readFacet(reader, builder, patch);
    else if (reader.accepts("solid")) {
      // The rest of the line is a name, which may contain any words.
      isOpen = true;
      patch = builder.patches.named(reader.line() || `solid ${builder.patches.length + 1}`);
    } else if (acceptsEnd(reader, "solid")) {
      isOpen = false;
      reader.skipLine();
    } else {
      if (reader.isAtEnd) return isOpen ? withoutEnd(reader, builder.mesh()) : builder.mesh();
      reader.failAtWord('"facet" or "endsolid"', ["facet", "endsolid"]);
    }
  }
}

/** Accepts a file without its last line, which some programs omit, unless open edges show that triangles are missing too. */
async function withoutEnd(reader: ByteReader, mesh: Mesh): Promise<Mesh> {
  const open = await inSteps(openEdges(mesh.triangles, mesh.points.length / 3));
  if (open.length > 0 || mesh.triangles.length === 0) {
    reader.failAtEnd('"facet" or "endsolid"');
  }
  return {
    ...mesh,
    notes: [...(mesh.notes ?? []), 'the file ends without "endsolid", but its surface is closed'],
  };
}

/** Consumes "endsolid" and the like, which some programs write as two words. */
function acceptsEnd(reader: ByteReader, word: string): boolean {
  if (reader.accepts(`end${word}`)) return true;
  if (!reader.accepts("end")) return false;
  reader.expect(word);
  return true;
}

function expectEnd(reader: ByteReader, word: string): void {
  if (!acceptsEnd(reader, word)) reader.expect(`end${word}`);
}

/** Longest normal, in words: some programs leave it out, others write NaN in several words. */
const MAX_NORMAL_WORDS = 6;

function readFacet(reader: ByteReader, builder: MeshBuilder, patch: number): void {
  // Skip the normal: it follows from the corners.
  for (let words = 0; !reader.accepts("outer"); words++) {
    if (words > MAX_NORMAL_WORDS) reader.expect("outer");
    reader.word();
  }
  reader.expect("loop");
  const [a, b, c] = [readVertex(reader, builder), readVertex(reader, builder), readVertex(reader, builder)];
  expectEnd(reader, "loop");
  expectEnd(reader, "facet");
  builder.addTriangle(a, b, c, patch);
}

function readVertex(reader: ByteReader, builder: MeshBuilder): number {
  reader.expect("vertex");
  const x = reader.number("a coordinate");
  const y = reader.number("a coordinate");
  return builder.addCorner(x, y, reader.number("a coordinate"));
}
