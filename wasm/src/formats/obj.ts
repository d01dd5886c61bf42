/**
 * OBJ (Wavefront), as text: `v` and `f` count, a corner being the first number of its group. The material in
 * use is the patch of a face; where groups (or objects) divide what is of one material, they are the patches, and a group
 * of several materials is one patch for each. Normals, texture coordinates, lines and points are
 * read over; a backslash at the end of a line continues it; polygons are cut into triangles; curves and surfaces that need more than corners are refused.
 */
import { plural } from "../base/plural.js";
import { ByteReader } from "./byte-reader.js";
import type { ByteSource } from "./byte-source.js";
import type { ReadContext } from "./file-format.js";
import type { FileMesh } from "./file-mesh.js";
import { GroupList, MeshBuilder } from "./mesh-builder.js";
import { UNCUT } from "./polygons.js";

const REMEDY = "Export the surface again as an OBJ file of triangles.";
/** Words that begin free-form geometry, which a mesh would be missing. */
const FREE_FORM = new Set(["curv", "curv2", "surf", "cstype", "deg", "bmat"]);

export function readObj(source: ByteSource, { signal }: Pick<ReadContext, "signal"> = {}): Promise<FileMesh> {
  const options = { remedy: REMEDY, comment: "#", continuation: "\\", signal };
  return ByteReader.over(source, options, async (reader) => {
    const builder = new MeshBuilder();
    builder.onLongWork = reader.rest;
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
      else if (FREE_FORM.has(word)) reader.fail(`"${word}" begins a curve or surface that is no polygon`);
      // A weight or colour after a point, and everything that is neither.
      reader.skipLine();
    }
    if (builder.triangleCount === 0) reader.fail("the file has no face");
    const mesh = builder.mesh();
    return { ...mesh, ...kinds.named(mesh) };
  });
}

/** What is told of a face. */
interface Kind {
  readonly material: string;
  readonly name: string;
}

/** The pairs of group and material that the faces have. */
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

  /** Kinds that end with the same name, as a group and a material may, are one patch. */
  named({ trianglePatch }: FileMesh): Pick<FileMesh, "trianglePatch" | "patches"> {
    const [materials, names] = [new Map<string, number>(), new Map<string, number>()];
    for (const { material, name } of this.#kinds) {
      materials.set(material, (materials.get(material) ?? 0) + 1);
      names.set(name, (names.get(name) ?? 0) + 1);
    }
    // A group divides a material that stands beside several.
    const isByGroup = [...materials].some(([material, count]) => material !== "" && count > 1);
    const patches = new GroupList("patch");
    const taken = new Set<string>();
    const positions = this.#kinds.map(({ material, name }) => {
      const isPair = isByGroup && material !== "" && name !== "" && (names.get(name) ?? 0) > 1;
      const single = (isByGroup && name) || material || name || "surface";
      // Words of a group and of a material beside each other may read the same for two pairs.
      const key = isPair ? `${name}\n${material}` : single;
      return patches.of(key, () => {
        const own = unused(isPair ? `${name} ${material}` : single, taken);
        return { name: own, tag: patches.length + 1 };
      });
    });
    return {
      trianglePatch: trianglePatch.map((kind) => positions[kind] ?? 0),
      patches: patches.groups(),
    };
  }
}

/** The name, or with a number behind it where another has it. */
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
    // From 1; below 0 they count backwards from the last point so far.
    const corner = given < 0 ? count + given : given - 1;
    if (word.startsWith("/") || !Number.isInteger(corner) || corner < 0 || corner >= count) {
      reader.fail(`"${word.slice(0, 24)}" is no corner among the ${plural(count, "point")} so far`);
    }
    corners.push(corner);
  }
  if (corners.length < 3) reader.fail(`a face has ${plural(corners.length, "corner")}`);
  if (!builder.addPolygon(corners, patch)) {
    reader.fail(`a face ${UNCUT}`);
  }
}
