/**
 * Reads OBJ (Wavefront, text): `v`, and the first index of each corner in `f`. The patch of a face is its group (or
 * object); a group with several materials becomes one patch per material. If there are no groups, or one for all faces,
 * the materials are the patches. Normals, texture coordinates, lines and points are skipped. A backslash at the end of a line
 * continues it. Polygons are cut into triangles. Free-form curves and surfaces are rejected.
 */
import { plural } from "../base/plural.js";
import type { Mesh } from "../mesh/mesh.js";
import { ByteReader } from "./byte-reader.js";
import type { ByteSource } from "./byte-source.js";
import type { ReadContext } from "./file-format.js";
import { GroupList, MeshBuilder } from "./mesh-builder.js";
import { UNCUT } from "./polygons.js";

const REMEDY = "Export the surface again as an OBJ file of triangles.";
const CORNER_REMEDY =
  "Correct the number in that line, or export the surface again: points must come before the faces that use them.";
/** Keywords of free-form geometry, without which the mesh would be incomplete. */
const FREE_FORM = new Set(["curv", "curv2", "surf", "cstype", "deg", "bmat"]);

export function readObj(source: ByteSource, { signal }: Pick<ReadContext, "signal"> = {}): Promise<Mesh> {
  const options = { remedy: REMEDY, comment: "#", continuation: "\\", signal };
  return ByteReader.over(source, options, async (reader) => {
    const builder = new MeshBuilder();
    builder.onLongWork = reader.requestYield;
    const kinds = new Kinds(builder.patches);
    const group = { material: "", name: "" };
    for (;;) {
      if (reader.isLow) await reader.fill();
      const word = reader.word();
      if (word === "") break;
      if (word === "v") readPoint(reader, builder);
      else if (word === "f") {
        readFace(reader, builder, kinds.patchOf(group));
      } else if (word === "usemtl") group.material = nameIn(reader);
      else if (word === "g" || word === "o") group.name = nameIn(reader);
      else if (FREE_FORM.has(word))
        reader.fail(`"${word}" begins a free-form curve or surface; only polygons are supported`);
      // Skip a weight or colour after a point, and all other statements.
      reader.skipLine();
    }
    if (builder.triangleCount === 0) reader.fail("the file has no faces");
    const mesh = builder.mesh();
    return { ...mesh, ...kinds.named(mesh) };
  });
}

/** Material and group of a face. */
interface Kind {
  readonly material: string;
  readonly name: string;
}

/** Combinations of group and material that the faces have. */
class Kinds {
  readonly #patches: GroupList;
  readonly #kinds: Kind[] = [];

  constructor(patches: GroupList) {
    this.#patches = patches;
  }

  patchOf({ material, name }: Kind): number {
    return this.#patches.of(`${material}\n${name}`, () => {
      this.#kinds.push({ material, name });
      return { name, tag: this.#kinds.length };
    });
  }

  /** Merges combinations that end up with the same name, as a group and a material may. */
  named({ trianglePatch }: Mesh): Pick<Mesh, "trianglePatch" | "patches"> {
    const names = new Map<string, number>();
    for (const { name } of this.#kinds) names.set(name, (names.get(name) ?? 0) + 1);
    const hasGroups = names.size > 1 || this.#kinds.length === 1;
    const patches = new GroupList("patch");
    const taken = new Set<string>();
    const indices = this.#kinds.map(({ material, name }) => {
      const isPair = hasGroups && material !== "" && name !== "" && (names.get(name) ?? 0) > 1;
      const single = (hasGroups && name) || material || name || "surface";
      // Joining group and material by a space could give two pairs the same key.
      const key = isPair ? `${name}\n${material}` : single;
      return patches.of(key, () => {
        const own = unused(isPair ? `${name} ${material}` : single, taken);
        return { name: own, tag: patches.length + 1 };
      });
    });
    return {
      trianglePatch: trianglePatch.map((kind) => indices[kind] ?? 0),
      patches: patches.groups(),
    };
  }
}

/** Returns the name, with a number appended if it is taken. */
function unused(name: string, taken: Set<string>): string {
  let own = name;
  for (let copy = 2; taken.has(own); copy++) own = `${name} (${copy})`;
  taken.add(own);
  return own;
}

function nameIn(reader: ByteReader): string {
  const words: string[] = [];
  for (let word = reader.wordInLine(); word !== ""; word = reader.wordInLine()) words.push(word);
  return words.join(" ");
}

function readPoint(reader: ByteReader, builder: MeshBuilder): void {
  const x = reader.number("a coordinate");
  const y = reader.number("a coordinate");
  builder.addPoint(x, y, reader.number("a coordinate"));
}

function readFace(reader: ByteReader, builder: MeshBuilder, patch: number): void {
  const count = builder.pointCount;
  const corners: number[] = [];
  for (let word = reader.wordInLine(); word !== ""; word = reader.wordInLine()) {
    const given = Number(word.split("/")[0]);
    // Corners count from 1; negative ones count backwards from the last point so far.
    const corner = given < 0 ? count + given : given - 1;
    const isNumber = !word.startsWith("/") && Number.isInteger(given);
    if (!isNumber || corner < 0 || corner >= count) {
      const shown = `"${word.slice(0, 24)}"`;
      const why = isNumber
        ? `refers to point ${given}, but the file has ${plural(count, "point")} up to this line`
        : "is not the number of a point";
      reader.fail(`a face has the corner ${shown}, which ${why}`, reader.location, CORNER_REMEDY);
    }
    corners.push(corner);
  }
  if (corners.length < 3 && reader.isAtEnd) reader.failAtEnd("another corner of a face");
  if (corners.length < 3) reader.fail(`a face has ${plural(corners.length, "corner")}`);
  if (!builder.addPolygon(corners, patch)) {
    reader.fail(`a face ${UNCUT}`);
  }
}
