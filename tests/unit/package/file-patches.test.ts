/** Patches carried from a file through a mesh to another file: none is lost silently. */
import { createMesher, readSurface } from "tetrafront";
import { expect, test } from "vitest";

import { boxSurface } from "../../support/surfaces.js";

const CORNERS = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

async function patchesOf(obj: string): Promise<(string | undefined)[]> {
  const read = await readSurface(new TextEncoder().encode(obj), { fileName: "a.obj" });
  if (!read.success) throw new Error(read.errors[0].message);
  const { trianglePatch, patches } = read.value;
  return Array.from(trianglePatch, (patch) => patches[patch]?.name);
}

const faces = (...heads: readonly string[]) =>
  CORNERS + heads.map((head, f) => `${head}\nf ${["1 3 2", "1 2 4", "2 3 4", "1 4 3"][f]}\n`).join("");

test.each([
  [
    "one material in all groups",
    ["g inlet\nusemtl grey", "", "g outlet\nusemtl grey", ""],
    "inlet inlet outlet outlet",
  ],
  ["materials only", ["usemtl red", "", "usemtl blue", ""], "red red blue blue"],
  ["materials in one group", ["g all\nusemtl red", "", "usemtl blue", ""], "red red blue blue"],
  ["one material per group", ["g a\nusemtl red", "", "g b\nusemtl blue", ""], "a a b b"],
  ["one group and one material", ["g a\nusemtl red", "", "", ""], "a a a a"],
  ["materials, and groups of some faces", ["usemtl red", "", "g b", ""], "red red b b"],
  ["groups only", ["g a", "g b", "g a", ""], "a b a a"],
])("OBJ: reads the patches of a file with %s", async (_, heads, names) => {
  expect(await patchesOf(faces(...heads))).toEqual(names.split(" "));
});

test("OBJ: splits a group by material", async () => {
  const names = await patchesOf(faces("g a\nusemtl red", "usemtl blue", "g b\nusemtl red", ""));
  expect(names).toEqual(["a red", "a blue", "b", "b"]);
});

test("OBJ: keeps pairs of group and material apart if their names join to the same text", async () => {
  const names = await patchesOf(faces("g a b\nusemtl c", "usemtl d", "g a\nusemtl b c", "usemtl c"));
  expect(new Set(names).size).toBe(4);
  expect(names.slice(0, 3)).toEqual(["a b c", "a b d", "a b c (2)"]);
});

test("OBJ: merges a group and a material of the same name into one patch", async () => {
  const obj = faces("usemtl m", "g m\nusemtl k", "g a", "g m");
  expect(await patchesOf(obj)).toEqual(["m", "m", "a", "m"]);
  const read = await readSurface(new TextEncoder().encode(obj), { fileName: "a.obj" });
  expect(read.success && read.value.patches.map(({ name, tag }) => [name, tag])).toEqual([
    ["m", 1],
    ["a", 2],
  ]);
});

test("a refined surface and its mesh keep the patches of the file", async () => {
  const mesher = await createMesher();
  const box = boxSurface(1);
  const given = {
    ...box,
    trianglePatch: Uint32Array.from({ length: box.triangles.length / 3 }, (_, t) => t % 2),
    patches: [
      { name: "inlet", tag: 1 },
      { name: "wall", tag: 2 },
    ],
  };
  try {
    const refinement = await mesher.refineSurface(given, { size: 0.4 });
    expect(refinement.mesh.patches).toEqual(given.patches);
    const { mesh } = await mesher.fillSurface(refinement.mesh, { size: 0.4 });
    expect(mesh.patches.map(({ name }) => name)).toEqual(["inlet", "wall"]);
  } finally {
    mesher.dispose();
  }
});
