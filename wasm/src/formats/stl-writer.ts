/**
 * Writes binary STL: the triangles with their normals, as float32, and the tag of their patch as attribute; 0 if
 * there is a single patch with a generic name. The header lists the names in the order of the tags, if all fit into
 * its 80 bytes.
 */
import { stepwise } from "../base/steps.js";
import type { Mesh } from "../mesh/mesh.js";
import { boundaryOf } from "./boundary.js";
import type { Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import { hasGenericName, listed, noteNames, usedGroups } from "./groups.js";
import { noteMerged } from "./merged-points.js";
import { NAME_BREAK, STL_NAMES, STL_TITLE } from "./name-lines.js";

const HEADER_TEXT = 80;
const HEADER_BYTES = 84;
const TRIANGLE_BYTES = 50;
/** Largest attribute: readers interpret a set highest bit as a colour. */
const MAX_ATTRIBUTE = 0x7fff;

/**
 * Returns the bytes of an STL file. Patches beyond 32767 share the attribute 0, and coordinates are rounded to
 * float32.
 */
export function* writeStl(given: Mesh, note: Note): Generator<Part, void> {
  const mesh = yield* boundaryOf(given);
  const { points, triangles, trianglePatch } = mesh;
  yield* noteMerged(points, note);
  const attributes = attributesOf(mesh, note);
  const count = triangles.length / 3;
  const bytes = new Uint8Array(HEADER_BYTES + TRIANGLE_BYTES * count);
  bytes.set(header(mesh, attributes, note));
  const view = new DataView(bytes.buffer);
  view.setUint32(HEADER_BYTES - 4, count, true);
  yield* stepwise(count, (t) => {
    const corners = [0, 1, 2].map((i) => {
      const node = triangles[3 * t + i] ?? 0;
      return points.subarray(3 * node, 3 * node + 3);
    });
    let at = HEADER_BYTES + TRIANGLE_BYTES * t;
    for (const row of [normalOf(corners), ...corners]) {
      for (let axis = 0; axis < 3; axis++, at += 4) view.setFloat32(at, row[axis] ?? 0, true);
    }
    view.setUint16(at, attributes[trianglePatch[t] ?? 0] ?? 0, true);
  });
  yield bytes;
}

/**
 * Returns the attribute per patch: the tags if all are unique and permitted, else numbers from 1 in order, and 0
 * beyond the largest.
 */
function attributesOf({ patches, trianglePatch }: Mesh, note: Note): Uint16Array {
  const attributes = new Uint16Array(patches.length);
  const [first] = patches;
  if (patches.length === 1 && first?.tag === 1 && hasGenericName(first)) return attributes;
  const used = [...usedGroups(trianglePatch, patches)];
  const tags = used.map((patch) => patches[patch]?.tag ?? NaN);
  const isHeld = tags.every((tag) => Number.isInteger(tag) && tag >= 1 && tag <= MAX_ATTRIBUTE);
  const isKept = isHeld && new Set(tags).size === tags.length;
  const changed = used.flatMap((patch, u) => {
    const tag = tags[u] ?? 0;
    const attribute = isKept ? tag : u < MAX_ATTRIBUTE ? u + 1 : 0;
    attributes[patch] = attribute;
    return attribute === tag ? [] : [`${tag} as ${attribute}`];
  });
  if (changed.length > 0) {
    note(
      `numbers of patches changed, because the format requires a different whole number from 1 to ${MAX_ATTRIBUTE} ` +
        `for each: ${listed(changed)}`,
    );
  }
  return attributes;
}

/**
 * The header must not begin with "solid", which begins text files, nor contain zero bytes or "COLOR=", which have a
 * meaning.
 */
function header({ patches, trianglePatch }: Mesh, attributes: Uint16Array, note: Note): Uint8Array {
  const used = [...usedGroups(trianglePatch, patches)].sort(
    (a, b) => (attributes[a] ?? 0) - (attributes[b] ?? 0),
  );
  const names = used.map((patch) => patches[patch]?.name ?? "");
  const text = `${STL_NAMES}${names.join(NAME_BREAK)}`;
  const bytes = new TextEncoder().encode(text);
  const isTold = names.every((name) => name !== "" && !/;|\s$|[\r\n]/.test(name)) && !text.includes("COLOR=");
  if (isTold && bytes.length <= HEADER_TEXT && !patches.every(hasGenericName)) return bytes;
  noteNames(patches, note, [...attributes]);
  return new TextEncoder().encode(STL_TITLE);
}

/** Returns the unit normal; zero if the triangle has no area. */
function normalOf(corners: readonly ArrayLike<number>[]): number[] {
  const side = (to: number, axis: number) => (corners[to]?.[axis] ?? 0) - (corners[0]?.[axis] ?? 0);
  const cross = [0, 1, 2].map((axis) => {
    const [j, k] = [(axis + 1) % 3, (axis + 2) % 3];
    return side(1, j) * side(2, k) - side(1, k) * side(2, j);
  });
  const length = Math.sqrt(cross.reduce((sum, value) => sum + value * value, 0));
  return cross.map((value) => (length > 0 ? value / length : 0));
}
