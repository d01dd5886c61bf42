/** Values at the nodes: written if the format can store them, otherwise reported as left out. */
import { FILE_FORMATS, readMesh, writeMesh, type Mesh, type NodeData } from "tetrafront";
import { expect, test } from "vitest";

import type { Part } from "../../../wasm/src/formats/bytes.js";
import { NodeTags } from "../../../wasm/src/formats/node-tags.js";
import { writeVtk } from "../../../wasm/src/formats/vtk.js";
import { blockMesh } from "../../support/block-mesh.js";

const block = blockMesh();
const count = block.points.length / 3;
const mesh: Mesh = {
  ...block,
  nodeData: new Map([
    ["size", { components: 1, values: Float64Array.from({ length: count }, (_, i) => 1 / (i + 3)) }],
    ['a <b> & "c"\'s %', { components: 3, values: Float64Array.from({ length: 3 * count }, (_, i) => -i) }],
    ["Größe", { components: 1, values: Float64Array.from({ length: count }, (_, i) => (i === 4 ? NaN : i)) }],
  ]),
};

test.each([".vtu", ".vtk", ".msh", ".msh2"])("values at the nodes are kept by %s", async (extension) => {
  const [file] = await writeMesh(mesh, `a${extension}`);
  expect(file?.notes.map(({ message }) => message).join()).not.toMatch(/left out/);
  const read = await readMesh(file?.bytes ?? new Uint8Array(), { fileName: `a${extension}` });
  if (!read.success) throw new Error(read.errors[0].message);
  const plain = (name: string) => name.replaceAll('"', "'");
  const data = (given: Mesh) =>
    [...given.nodeData].map(([name, { components, values }]) => [plain(name), components, [...values]]);
  const negative = (value: unknown) =>
    JSON.stringify(value, (_, held: unknown) => (Object.is(held, -0) ? 0 : held));
  expect(negative(data(read.value))).toEqual(negative(data(mesh)));
  expect(read.value.patches.length).toBe(block.patches.length);
});

const elements = block.tetrahedra.length / 4;
const withElements: Mesh = {
  ...block,
  elementData: new Map([
    ["a b", { components: 1, values: Float64Array.from({ length: elements }, (_, t) => 1 / (t + 3)) }],
    ["flux", { components: 3, values: Float64Array.from({ length: 3 * elements }, (_, i) => i - 7) }],
  ]),
};

/** Values by name and the nodes of their element: formats sort elements by region. */
const byElement = ({ points, tetrahedra, elementData = new Map() }: Mesh) =>
  [...elementData].map(([name, { components, values }]) => [
    name,
    Array.from({ length: tetrahedra.length / 4 }, (_, t) => {
      const corners = Array.from(tetrahedra.subarray(4 * t, 4 * t + 4), (node) =>
        points.subarray(3 * node, 3 * node + 3).join(),
      );
      return `${corners.join(" ")}: ${values.subarray(components * t, components * (t + 1)).join()}`;
    }).sort(),
  ]);

test.each([".vtu", ".vtk", ".msh", ".msh2"])("values of elements are kept by %s", async (extension) => {
  const [file] = await writeMesh(withElements, `a${extension}`);
  const read = await readMesh(file?.bytes ?? new Uint8Array(), { fileName: `a${extension}` });
  if (!read.success) throw new Error(read.errors[0].message);
  expect(byElement(read.value)).toEqual(byElement(withElements));
});

test("values of elements are reported as left out where a format has none, and counted", async () => {
  for (const fileName of ["a.inp", "a.mesh"]) {
    const [file] = await writeMesh(withElements, fileName);
    expect(file?.notes.map(({ message }) => message)).toContain(
      'Values of the elements are left out: "a b", "flux"',
    );
  }
  const short = new Map([["p", { components: 1, values: new Float64Array(elements - 1) }]]);
  await expect(writeMesh({ ...block, elementData: short }, "a.msh")).rejects.toThrow(/elementData "p"/);
});

test("VTK: all values of a node can be missing", async () => {
  const values = new Float64Array(3 * count).fill(NaN);
  const [file] = await writeMesh(
    { ...block, nodeData: new Map([["v", { components: 3, values }]]) },
    "a.vtk",
  );
  const written = new TextDecoder().decode(file?.bytes);
  expect(written).toContain(`v 3 ${count} double\n${"nan nan nan\n".repeat(count)}`);
});

test("VTK: rows of values are generated lazily", () => {
  const parts = [...writeVtk(mesh, () => undefined)].flatMap((part): readonly Part[] =>
    Array.isArray(part) ? (part as readonly Part[]) : [part],
  );
  const texts = parts.filter((part) => typeof part === "string");
  expect(texts.filter((text) => text.split("\n").length > 6)).toEqual([]);
  expect(texts.filter((text) => /^\d+\n/.test(text))).toEqual([]);
});

const others = FILE_FORMATS.filter(
  ({ id, writable }) => writable.length > 0 && !/^(vtu|vtk|gmsh2?|medit(-binary)?)$/.test(id),
);
test.each(others.map(({ extensions }) => extensions[0]))(
  "%s: reports that values at the nodes are left out",
  async (extension) => {
    const [file] = await writeMesh(mesh, `a${extension}`);
    const notes = file?.notes.map(({ message }) => message).join("\n");
    expect(notes).toMatch(/Values at the nodes are left out: "size", /);
  },
);

test("Gmsh: reports values with other than one, three or nine components as left out", async () => {
  const values = new Float64Array(2 * count);
  const odd = { ...block, nodeData: new Map([["pair", { components: 2, values }]]) };
  const [file] = await writeMesh(odd, "a.msh");
  expect(file?.notes.map(({ message }) => message)).toContain('Values at the nodes are left out: "pair"');
});

test("writeMesh rejects a wrong number of values and nodes without a finite position", async () => {
  const short = { ...block, nodeData: new Map([["size", { components: 1, values: new Float64Array(1) }]]) };
  await expect(writeMesh(short, "a.vtu")).rejects.toThrow(/nodeData "size"/);
  const points = block.points.slice();
  points[3 * 5 + 1] = NaN;
  await expect(writeMesh({ ...block, points }, "a.vtu")).rejects.toThrow(
    /node 5 has a coordinate that is not finite/,
  );
});

test("regions of a surface without tetrahedra are reported as left out", async () => {
  const surface: Mesh = {
    ...block,
    tetrahedra: new Uint32Array(),
    tetrahedronRegion: new Uint32Array(),
    regions: [],
    surfaceRegions: {
      regions: [{ name: "steel", tag: 1 }],
      triangleRegions: new Uint32Array((2 * block.triangles.length) / 3),
    },
  };
  const [file] = await writeMesh(surface, "a.stl");
  expect(file?.notes.map(({ message }) => message).join()).toMatch(/left out.*: "steel"/);
});

test("Nastran: counts the nodes that become equal within 16 characters", async () => {
  const moved = (shift: number) => ({
    ...block,
    points: block.points.map((value, i) => value + (i % 3 ? 0 : shift)),
  });
  const notesFor = async (shift: number) => {
    const [file] = await writeMesh(moved(shift), "a.bdf");
    return file?.notes.map(({ message }) => message).join() ?? "";
  };
  expect(await notesFor(0)).not.toMatch(/became equal to others/);
  expect(await notesFor(1e15)).toMatch(/^\d+ points? became equal to others: the format has 16 characters/);
});

test.each([".vtu", ".vtk"])("fields named as arrays that define groups are kept by %s", async (extension) => {
  const field = (scale: number, components = 1) => ({
    components,
    values: Float64Array.from({ length: components * elements }, (_, i) => scale * i),
  });
  const given: Mesh = {
    ...block,
    elementData: new Map([
      ["region", field(0.5)],
      ["region field", field(2)],
      ["patch", field(3, 3)],
      ["medit:ref", field(4)],
    ]),
  };
  const [file] = await writeMesh(given, `a${extension}`);
  const notes = file?.notes.map(({ message }) => message).join();
  expect(notes).toMatch(/"region" is written as "region field field".*"patch" is written as "patch field"/);
  const read = await readMesh(file?.bytes ?? new Uint8Array(), { fileName: `a${extension}` });
  if (!read.success) throw new Error(read.errors[0].message);
  const renamed = { ...given, elementData: new Map<string, NodeData>() };
  const names = ["region field field", "region field", "patch field", "medit:ref"];
  [...(given.elementData ?? []).values()].forEach((data, f) => renamed.elementData.set(names[f] ?? "", data));
  expect(byElement(read.value)).toEqual(byElement(renamed));
  const tags = ({ regions, patches }: Mesh) => [...regions, ...patches].map(({ tag }) => tag);
  expect(tags(read.value)).toEqual(tags(block));
});

test("tags with gaps are found in as many maps as they need; the last of several counts", () => {
  const tags = new NodeTags(3);
  const added = [5, 6, 9, 10, 2, 1e9, 6, 30, 31, 32];
  added.forEach((tag) => tags.add(tag));
  for (const tag of added) expect(tags.indexOf(tag)).toBe(added.lastIndexOf(tag));
  for (const tag of [0, 1, 7, 33]) expect(tags.indexOf(tag)).toBeUndefined();
});
