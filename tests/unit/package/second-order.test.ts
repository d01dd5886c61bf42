/** Second-order elements: written, read by their corners, and refused where the format has none. */
import { FILE_FORMATS, type Mesh, MesherError, readMesh, writeMesh } from "tetrafront";
import { describe, expect, test } from "vitest";

import { blockMesh, taggedElements } from "../../support/block-mesh.js";

const mesh = blockMesh();
const names = FILE_FORMATS.filter(({ writable }) => writable.length > 0).map(
  ({ extensions, hasSecondOrder, readable }) => ({ extension: extensions[0], hasSecondOrder, readable }),
);

async function written(given: Mesh, fileName: string): Promise<Uint8Array> {
  const [file] = await writeMesh(given, fileName, { elementOrder: 2 });
  return file?.bytes ?? new Uint8Array();
}

describe("a format without second-order elements says so and names others:", () => {
  test.each(names.filter(({ hasSecondOrder }) => hasSecondOrder !== true))(
    "$extension",
    async ({ extension }) => {
      const failure: unknown = await writeMesh(mesh, `a${extension}`, { elementOrder: 2 }).catch(
        (reason: unknown) => reason,
      );
      expect(failure).toBeInstanceOf(MesherError);
      expect(String(failure)).toMatch(/second-order elements.*\.vtu.*\.msh.*\.inp.*\.bdf/s);
    },
  );
});

describe("second-order elements are read by their corners, with a note:", () => {
  const readable = names.filter(
    ({ hasSecondOrder, readable: read }) => hasSecondOrder === true && read.includes("volume"),
  );
  test.each(readable)("$extension", async ({ extension }) => {
    const fileName = `a${extension}`;
    const values = mesh.points.filter((_, i) => i % 3 === 0);
    const given = { ...mesh, nodeData: new Map([["x", { components: 1, values }]]) };
    const read = await readMesh(await written(given, fileName), { fileName });
    if (!read.success) throw new Error(read.errors[0].message);
    const found = read.value;
    expect(found.points).toEqual(mesh.points);
    expect(found.nodeData.get("x")?.values).toEqual(values);
    expect(taggedElements(found.tetrahedra, 4, found.tetrahedronRegion, found.regions)).toEqual(
      taggedElements(mesh.tetrahedra, 4, mesh.tetrahedronRegion, mesh.regions),
    );
    expect(taggedElements(found.triangles, 3, found.trianglePatch, found.patches)).toEqual(
      taggedElements(mesh.triangles, 3, mesh.trianglePatch, mesh.patches),
    );
    const count = mesh.tetrahedra.length / 4 + mesh.triangles.length / 3;
    expect(found.notes).toEqual([`${count} second-order elements read by the corners, as linear elements`]);
  });
});

test("the values at the middle of an edge are the means of its ends, and NaN where an end has none", async () => {
  const values = Float64Array.from({ length: mesh.points.length / 3 }, (_, node) =>
    node === 0 ? NaN : node,
  );
  const nodeData = new Map([["size", { components: 1, values }]]);
  const text = new TextDecoder().decode(await written({ ...mesh, nodeData }, "a.vtk"));
  const [, list = ""] = /size 1 \d+ double\n([^A-Z]*)/.exec(text) ?? [];
  const numbers = list.trim().split(/\s+/).map(Number);
  const [, cells = ""] = /CELLS \d+ \d+\n([^A-Z]*)/.exec(text) ?? [];
  const tets = cells
    .trim()
    .split("\n")
    .map((line) => line.split(" ").map(Number))
    .filter(([count]) => count === 10);
  expect(tets).toHaveLength(mesh.tetrahedra.length / 4);
  for (const [, a = 0, b = 0, , , middle = 0] of tets) {
    expect(numbers[middle]).toEqual(((numbers[a] ?? 0) + (numbers[b] ?? 0)) / 2);
  }
});

test("curved edges are noted", async () => {
  const text = new TextDecoder().decode(await written(mesh, "a.vtk"));
  const lines = text.split("\n");
  const last = lines.findIndex((line) => line.startsWith("CELLS")) - 1;
  lines[last] = (lines[last] ?? "")
    .split(" ")
    .map((x) => String(Number(x) + 0.01))
    .join(" ");
  const read = await readMesh(new TextEncoder().encode(lines.join("\n")), { fileName: "a.vtk" });
  if (!read.success) throw new Error(read.errors[0].message);
  expect(read.value.notes?.[0]).toMatch(/; \d+ of them had curved edges, which are straight now$/);
});
