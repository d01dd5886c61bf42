/** Bytes of written files, as other programs interpret them. */
import { readMesh, writeMesh, type Mesh } from "tetrafront";
import { describe, expect, test } from "vitest";

import { blockMesh } from "../../support/block-mesh.js";
import { boxSurface } from "../../support/surfaces.js";

const block = blockMesh();
const elementCount = (block.triangles.length + (3 * block.tetrahedra.length) / 4) / 3;

async function written(mesh: Mesh, fileName: string): Promise<Uint8Array> {
  const [file] = await writeMesh(mesh, fileName);
  return file?.bytes ?? new Uint8Array();
}

/** Returns the bytes after a line of a file. */
function after(bytes: Uint8Array, line: string): DataView {
  const begin = Buffer.from(bytes).indexOf(`${line}\n`) + line.length + 1;
  return new DataView(bytes.buffer, bytes.byteOffset + begin);
}

describe("the elements of a written Gmsh file have the tags 1 to n", () => {
  const tags = Array.from({ length: elementCount }, (_, i) => i + 1);

  test("in version 4.1", async () => {
    const view = after(await written(block, "a.msh"), "$Elements");
    const size = (at: number) => Number(view.getBigUint64(at, true));
    const found: number[] = [];
    let at = 32;
    for (let blocks = size(0); blocks > 0; blocks--) {
      const [width, count] = [view.getInt32(at + 8, true) === 2 ? 4 : 5, size(at + 12)];
      at += 20;
      for (let e = 0; e < count; e++, at += 8 * width) found.push(size(at));
    }
    expect([size(8), size(16), size(24)]).toEqual([elementCount, 1, elementCount]);
    expect(found).toEqual(tags);
  });

  test("in version 2.2", async () => {
    const view = after(await written(block, "a.msh2"), `$Elements\n${elementCount}`);
    const found: number[] = [];
    for (let at = 0; found.length < elementCount;) {
      const [nodes, count] = [view.getInt32(at, true) === 2 ? 3 : 4, view.getInt32(at + 4, true)];
      at += 12;
      for (let e = 0; e < count; e++, at += 4 * (3 + nodes)) found.push(view.getInt32(at, true));
    }
    expect(found).toEqual(tags);
  });
});

test.each(["a.msh", "a.msh2"])("%s: patches and regions have different tags", async (fileName) => {
  const numbered = (word: string, count: number) =>
    Array.from({ length: count }, (_, i) => ({ name: `${word} ${i + 1}`, tag: i + 1 }));
  const mesh = { ...block, patches: numbered("patch", 6), regions: numbered("region", 2) };
  const [file] = await writeMesh(mesh, fileName);
  const read = await readMesh(file?.bytes ?? new Uint8Array(), { fileName });
  if (!read.success) throw new Error(read.errors[0].message);
  expect(read.value.patches.map(({ tag }) => tag).sort()).toEqual([1, 2, 3, 4, 5, 6]);
  expect(read.value.regions).toEqual([
    { name: "region 1", tag: 7 },
    { name: "region 2", tag: 8 },
  ]);
  // Numbers that count from 1 are not the user's: nothing is lost that a note should mention.
  expect(file?.notes).toEqual([]);
});

test("a VTU file holds the names of patches and regions as field data", async () => {
  const text = Buffer.from(await written(block, "a.vtu")).toString("latin1");
  const found = [
    ...text.matchAll(/<DataArray type="Int32" Name="([^"]*)" NumberOfTuples="2" format="ascii">([^<]*)</g),
  ];
  expect(found.map(([, name, values]) => [name, values])).toEqual([
    ["in let", "7 2"],
    ["outlet", "3 2"],
    ["5th wall", "11 2"],
    ["outlet (patch 4)", "4 2"],
    ["floor, cold", "21 2"],
    ["steel", "5 3"],
    ["water (20 C)", "9 3"],
  ]);
});

test("the normals of a written STL file have length 1 and face outward", async () => {
  const box = boxSurface(2);
  const count = box.triangles.length / 3;
  const mesh: Mesh = {
    ...box,
    trianglePatch: new Uint32Array(count),
    patches: [{ name: "surface", tag: 1 }],
    tetrahedra: new Uint32Array(),
    tetrahedronRegion: new Uint32Array(),
    regions: [],
    nodeData: new Map(),
  };
  const bytes = await written(mesh, "a.stl");
  const view = new DataView(bytes.buffer, bytes.byteOffset + 84);
  const vector = (t: number, row: number) =>
    [0, 4, 8].map((axis) => view.getFloat32(50 * t + 12 * row + axis, true));
  for (let t = 0; t < count; t++) {
    const normal = vector(t, 0);
    const corners = [1, 2, 3].map((row) => vector(t, row));
    const axis = [0, 1, 2].find((a) => corners.every((corner) => corner[a] === corners[0]?.[a])) ?? 0;
    const outward = [0, 0, 0];
    outward[axis] = corners[0]?.[axis] === 0 ? -1 : 1;
    expect(normal.map((value) => value + 0)).toEqual(outward);
  }
});
