/**
 * Binary PLY: coordinates as doubles, and, where there are several patches, each triangle with the number of
 * its patch and the colour of that.
 */
import { joinBytes } from "./bytes.js";
import { boundaryOf, colorsOf } from "./boundary.js";
import type { FileMesh } from "./file-mesh.js";
import { tagsOf } from "./groups.js";

const POINT_BYTES = 24;
/** A count and three corners. */
const FACE_BYTES = 1 + 3 * 4;
/** The patch, three colours. */
const PATCH_BYTES = 4 + 3;

const PATCH_PROPERTIES = [
  "property int patch",
  "property uchar red\nproperty uchar green\nproperty uchar blue",
];

/** The bytes of a PLY file. */
export function writePly(mesh: FileMesh): Uint8Array<ArrayBuffer> {
  const { points, triangles, trianglePatch, patches } = boundaryOf(mesh);
  const count = triangles.length / 3;
  const hasPatches = patches.length > 1;
  const faceBytes = FACE_BYTES + (hasPatches ? PATCH_BYTES : 0);
  const header = [
    "ply\nformat binary_little_endian 1.0",
    ...tagsOf(patches).map(
      (tag, p) => `comment patch ${tag} ${(patches[p]?.name ?? "").replace(/[\r\n]/g, " ")}`,
    ),
    `element vertex ${points.length / 3}\nproperty double x\nproperty double y\nproperty double z`,
    `element face ${count}\nproperty list uchar int vertex_indices`,
    ...(hasPatches ? PATCH_PROPERTIES : []),
    "end_header\n",
  ].join("\n");
  const view = new DataView(new ArrayBuffer((POINT_BYTES / 3) * points.length + faceBytes * count));
  points.forEach((value, i) => view.setFloat64(8 * i, value, true));
  const tags = tagsOf(patches);
  const colors = colorsOf(mesh).map((color) => color.map((value) => Math.round(255 * value)));
  for (let t = 0; t < count; t++) {
    let at = 8 * points.length + faceBytes * t;
    const patch = trianglePatch[t] ?? 0;
    view.setUint8(at++, 3);
    for (let i = 0; i < 3; i++, at += 4) view.setInt32(at, triangles[3 * t + i] ?? 0, true);
    if (!hasPatches) continue;
    view.setInt32(at, tags[patch] ?? 0, true);
    at += 4;
    for (const part of colors[patch] ?? [0, 0, 0]) view.setUint8(at++, part);
  }
  return joinBytes([header, view]);
}
