/**
 * Writes glTF 2.0 as a binary file (GLB): the boundary, with one primitive and material per patch, named after the
 * patch. Coordinates are float32, as the format requires; the axes are those of the mesh.
 */
import type { Mesh } from "../mesh/mesh.js";
import { boundaryOf, colorsOf } from "./boundary.js";
import type { Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import { type Group, patchGroups, usedGroups } from "./groups.js";
import { noteMerged } from "./merged-points.js";

const MAGIC = 0x46546c67;
const VERSION = 2;
const JSON_CHUNK = 0x4e4f534a;
const BINARY_CHUNK = 0x004e4942;
/** OpenGL constants: the purpose of a buffer, and the type of its numbers. */
const ARRAY_BUFFER = 34962;
const ELEMENT_ARRAY_BUFFER = 34963;
const FLOAT = 5126;
const UNSIGNED_INT = 5125;

/** Returns the bytes of a GLB file. A surface without triangles becomes a scene without a mesh. */
export function* writeGlb(mesh: Mesh, note: Note): Generator<Part, void> {
  const surface = yield* boundaryOf(mesh);
  yield* noteMerged(surface.points, note);
  const groups = yield* patchGroups(surface, { note });
  const positions = littleEndian(surface.points, (view, at, value) => view.setFloat32(at, value, true));
  const indices = groups.map(({ nodes }) =>
    littleEndian(nodes, (view, at, value) => view.setUint32(at, value, true)),
  );
  const json = padded(JSON.stringify(description(surface, groups)));
  const length = [positions, ...indices].reduce((sum, part) => sum + part.byteLength, 0);
  const hasBinary = length > 0;
  yield [
    words(MAGIC, VERSION, 12 + 8 + json.length + (hasBinary ? 8 + length : 0)),
    words(json.length, JSON_CHUNK),
    json,
    ...(hasBinary ? [words(length, BINARY_CHUNK), positions, ...indices] : []),
  ];
}

function description(surface: Mesh, groups: readonly Group[]): object {
  const asset = { version: "2.0", generator: "Tetrafront" };
  if (groups.length === 0) return { asset, scene: 0, scenes: [{}] };
  const used = usedGroups(surface.trianglePatch, surface.patches);
  const colors = colorsOf(surface).filter((_, patch) => used.has(patch));
  const positionBytes = 4 * surface.points.length;
  const counts = groups.map(({ nodes }) => nodes.length);
  let end = positionBytes;
  const begins = counts.map((count) => (end += 4 * count) - 4 * count);
  return {
    asset,
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [
      {
        primitives: groups.map((_, g) => ({ attributes: { POSITION: 0 }, indices: g + 1, material: g })),
      },
    ],
    materials: groups.map(({ name }, g) => ({
      name,
      doubleSided: true,
      pbrMetallicRoughness: {
        baseColorFactor: [...(colors[g] ?? [0.5, 0.5, 0.5]), 1],
        metallicFactor: 0,
        roughnessFactor: 0.8,
      },
    })),
    accessors: [
      {
        bufferView: 0,
        componentType: FLOAT,
        count: surface.points.length / 3,
        type: "VEC3",
        ...extent(surface.points),
      },
      ...counts.map((count, g) => ({
        bufferView: g + 1,
        componentType: UNSIGNED_INT,
        count,
        type: "SCALAR",
      })),
    ],
    bufferViews: [
      { buffer: 0, byteOffset: 0, byteLength: positionBytes, target: ARRAY_BUFFER },
      ...counts.map((count, g) => ({
        buffer: 0,
        byteOffset: begins[g],
        byteLength: 4 * count,
        target: ELEMENT_ARRAY_BUFFER,
      })),
    ],
    buffers: [{ byteLength: end }],
  };
}

/** Rounded to float32, like the coordinates in the file. */
function extent(points: Float64Array): { min: number[]; max: number[] } {
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  points.forEach((value, i) => {
    min[i % 3] = Math.min(min[i % 3] ?? 0, Math.fround(value));
    max[i % 3] = Math.max(max[i % 3] ?? 0, Math.fround(value));
  });
  return { min, max };
}

/** Packs values of four bytes each. */
function littleEndian(
  values: Float64Array | Uint32Array,
  set: (view: DataView, at: number, value: number) => void,
): DataView {
  const view = new DataView(new ArrayBuffer(4 * values.length));
  values.forEach((value, i) => set(view, 4 * i, value));
  return view;
}

function words(...values: number[]): DataView {
  return littleEndian(Uint32Array.from(values), (view, at, value) => view.setUint32(at, value, true));
}

/** Pads JSON with blanks: the size of a chunk is a multiple of four bytes. */
function padded(json: string): Uint8Array {
  const bytes = new TextEncoder().encode(json);
  const filled = new Uint8Array(4 * Math.ceil(bytes.length / 4)).fill(32);
  filled.set(bytes);
  return filled;
}
