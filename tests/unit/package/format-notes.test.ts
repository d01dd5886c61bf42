/** Notes returned with a written file report what its format cannot store. */
import { readMesh, writeMesh, type Mesh } from "tetrafront";
import { expect, test } from "vitest";

import { boxSurface } from "../../support/surfaces.js";

const cube = boxSurface(1);

/** A cube moved along x, with its triangles assigned in turn to the last two of `patchCount` patches. */
function surfaceMesh(patchCount: number, shift = 0): Mesh {
  return {
    points: cube.points.map((value, i) => (i % 3 === 0 ? value + shift : value)),
    triangles: cube.triangles,
    trianglePatch: Uint32Array.from(
      { length: cube.triangles.length / 3 },
      (_, t) => patchCount - 1 - (t % 2),
    ),
    patches: Array.from({ length: patchCount }, (_, p) => ({ name: `patch ${p + 1}`, tag: p + 1 })),
    tetrahedra: new Uint32Array(),
    tetrahedronRegion: new Uint32Array(),
    regions: [],
    nodeData: new Map(),
  };
}

async function notesOf(mesh: Mesh, fileName: string): Promise<string> {
  const [file] = await writeMesh(mesh, fileName);
  return (file?.notes ?? []).map(({ message }) => message).join("\n");
}

test.each(["a.stl", "a.glb"])("%s: counts nodes merged by single precision", async (fileName) => {
  expect(await notesOf(surfaceMesh(2), fileName)).toBe("");
  // Of two corners that differ only in x, one remains.
  const notes = await notesOf(surfaceMesh(2, 1e9), fileName);
  const lost = Number(/^(\d+) points became equal to others/.exec(notes)?.[1]);
  expect(lost).toBe(cube.points.length / 3 - distinct(surfaceMesh(2, 1e9).points));
});

function distinct(points: Float64Array): number {
  const rounded = [...points].map(Math.fround);
  return new Set(rounded.flatMap((_, i) => (i % 3 === 0 ? [rounded.slice(i, i + 3).join(" ")] : []))).size;
}

test("STL: reports patches with numbers above 32767", async () => {
  expect(await notesOf(surfaceMesh((1 << 15) - 1), "a.stl")).toBe("");
  const mesh = surfaceMesh(1 << 15);
  expect(await notesOf(mesh, "a.stl")).toMatch(
    /^Numbers of patches .* from 1 to 32767.*: 32767 as 1, 32768 as 2$/,
  );
  const [file] = await writeMesh(mesh, "a.stl");
  const read = await readMesh(file?.bytes ?? new Uint8Array(), { fileName: "a.stl" });
  expect(read.success && read.value.patches).toHaveLength(2);
});

test.each(["a.stl", "a.obj", "a.ply", "a.off", "a.glb"])(
  "%s: reports the named regions of tetrahedra, which it cannot store",
  async (fileName) => {
    const volume = (name: string): Mesh => ({
      ...surfaceMesh(2),
      tetrahedra: Uint32Array.of(0, 1, 2, 4),
      tetrahedronRegion: Uint32Array.of(0),
      regions: [
        { name, tag: 1 },
        { name: "unused", tag: 2 },
      ],
    });
    expect(await notesOf(volume("region 1"), fileName)).toBe("");
    expect(await notesOf(volume("steel"), fileName)).toBe(
      'Names of regions are left out with the tetrahedra, because the format stores triangles only: "steel"',
    );
  },
);
