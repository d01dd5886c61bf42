/** Meshes whose elements stay in the engine and are handed out in blocks. */
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import {
  createMesher,
  type ElementBlocks,
  type MeshResult,
  type Mesher,
  streamMesh,
  writeMesh,
} from "tetrafront";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { boxSurface, dividedSurface } from "../../support/surfaces";
import { temporaryFolder } from "../../support/temporary-folder";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

const OPTIONS = { interior: "lattice", optimization: "fast" } as const;

function blocksOf({ blocks }: MeshResult): ElementBlocks {
  if (blocks === undefined) throw new Error("the elements are not in blocks");
  return blocks;
}

/** Returns the arrays of all blocks of so many nodes or tetrahedra. */
async function read(blocks: ElementBlocks, size: number) {
  const points: number[] = [];
  const tetrahedra: number[] = [];
  for (let first = 0; first < blocks.nodes; first += size)
    for (const value of await blocks.readPoints(first, size)) points.push(value);
  for (let first = 0; first < blocks.tetrahedra; first += size)
    for (const node of await blocks.readTetrahedra(first, size)) tetrahedra.push(node);
  const regions = blocks.regionRuns.flatMap(({ region, count }) => Array<number>(count).fill(region));
  return {
    points: Float64Array.from(points),
    tetrahedra: Uint32Array.from(tetrahedra),
    regions: Uint32Array.from(regions),
  };
}

describe.each([
  ["one region", boxSurface(12)],
  ["two regions", dividedSurface(20)],
])("blocks of a mesh of %s", (_, surface) => {
  let [whole, inBlocks]: MeshResult[] = [];
  beforeAll(async () => {
    whole = await mesher.fillSurface(surface, OPTIONS);
    inBlocks = await mesher.fillSurface(surface, OPTIONS, { inBlocks: true });
  });

  it("are the arrays of the mesh, whatever their size", async () => {
    if (whole === undefined || inBlocks === undefined) throw new Error("no mesh");
    expect(whole.report.interior.lattice).toBeGreaterThan(1000);
    expect(inBlocks.report.fingerprint).toBe(whole.report.fingerprint);
    expect(inBlocks.report.regions).toEqual(whole.report.regions);
    expect(inBlocks.mesh.tetrahedra).toHaveLength(0);
    expect(inBlocks.mesh.points).toEqual(whole.mesh.points.slice(0, 3 * whole.surfaceNodes));
    for (const size of [977, 100_000]) {
      const found = await read(blocksOf(inBlocks), size);
      expect(found.points).toEqual(whole.mesh.points);
      expect(found.tetrahedra).toEqual(whole.mesh.tetrahedra);
      expect(found.regions).toEqual(whole.mesh.tetrahedronRegion);
    }
  });

  it.each(["part.vtu", "part.msh"])("make the same file, %s", async (name) => {
    if (whole === undefined || inBlocks === undefined) throw new Error("no mesh");
    const digest = createHash("sha256");
    const { files, notes } = await streamMesh(inBlocks.mesh, name, { blocks: blocksOf(inBlocks) });
    for (const { pieces } of files) for await (const piece of pieces) digest.update(piece);
    const [file] = await writeMesh(whole.mesh, name);
    expect(notes).toEqual([]);
    expect(digest.digest("hex")).toBe(
      createHash("sha256")
        .update(file?.bytes ?? "")
        .digest("hex"),
    );
  });
});

it("are refused by formats that need all elements at once", async () => {
  const result = await mesher.fillSurface(boxSurface(6), OPTIONS, { inBlocks: true });
  await expect(streamMesh(result.mesh, "part.inp", { blocks: blocksOf(result) })).rejects.toThrow(
    /"part.inp" cannot be written from blocks/,
  );
  await expect(
    streamMesh(result.mesh, "part.vtu", { blocks: blocksOf(result), elementOrder: 2 }),
  ).rejects.toThrow(/blocks/);
});

it("stop being written when the signal is aborted; the progress never falls", async () => {
  const result = await mesher.fillSurface(boxSurface(12), OPTIONS, { inBlocks: true });
  const abort = new AbortController();
  const fractions: number[] = [];
  const whole = await streamMesh(result.mesh, "part.vtu", {
    blocks: blocksOf(result),
    onProgress: ({ fraction }) => fractions.push(fraction),
  });
  for (const { pieces } of whole.files) for await (const _ of pieces) void _;
  expect(fractions).toEqual([...fractions].sort((a, b) => a - b));
  expect(fractions.length).toBeGreaterThan(1);
  expect(fractions.at(-1)).toBe(1);
  const { files } = await streamMesh(result.mesh, "part.vtu", {
    blocks: blocksOf(result),
    signal: abort.signal,
  });
  abort.abort();
  await expect(files[0]?.pieces[Symbol.asyncIterator]().next()).rejects.toThrow(/aborted/);
});

it("cannot be read after their release", async () => {
  const blocks = blocksOf(await mesher.fillSurface(boxSurface(6), OPTIONS, { inBlocks: true }));
  await expect(blocks.readPoints(0, 1)).resolves.toHaveLength(3);
  blocks.release();
  await expect(blocks.readPoints(0, 1)).rejects.toThrow(/released/);
});

it("live beside later runs", async () => {
  const first = await mesher.fillSurface(boxSurface(6), OPTIONS, { inBlocks: true });
  const before = await blocksOf(first).readTetrahedra(0, 50);
  await mesher.fillSurface(boxSurface(4), OPTIONS, { inBlocks: true });
  expect(await blocksOf(first).readTetrahedra(0, 50)).toEqual(before);
});

it("are not used for a mesh with a number of elements, nor of the second order", async () => {
  const counted = await mesher.fillSurface(boxSurface(6), { elements: 1500 }, { inBlocks: true });
  expect(counted.blocks).toBeUndefined();
  expect(counted.mesh.tetrahedra.length).toBeGreaterThan(0);
  const curved = await mesher.meshSurface(boxSurface(4), { elementOrder: 2 }, { inBlocks: true });
  expect(curved.blocks).toBeUndefined();
  expect(curved.mesh.tetrahedra.length).toBeGreaterThan(0);
});

describe("the command line", () => {
  const folder = temporaryFolder();

  it.each(["part.vtu", "part.msh"])("writes %s from blocks: the bytes of writeMesh", async (name) => {
    const surface = boxSurface(12);
    const ends = (values: ArrayLike<number>, at: number) =>
      Array.from(values)
        .slice(3 * at, 3 * at + 3)
        .join(" ");
    const lines = (values: ArrayLike<number>, first = "") =>
      Array.from({ length: values.length / 3 }, (_, i) => `${first}${ends(values, i)}`);
    const { points, triangles } = surface;
    const text = [
      "OFF",
      `${points.length / 3} ${triangles.length / 3} 0`,
      ...lines(points),
      ...lines(triangles, "3 "),
    ];
    folder.save("part.off", `${text.join("\n")}\n`);
    const options = ["--size", "0.08", "--interior", "lattice", "--surface", "keep", "--quiet"];
    const run = await folder.run("mesh", "part.off", "-o", name, ...options);
    expect(run.stderr).toBe("");
    expect(run.code).toBe(0);
    const made = await mesher.fillSurface(surface, { size: 0.08, interior: "lattice" });
    const [file] = await writeMesh(made.mesh, name);
    expect(Buffer.compare(readFileSync(folder.inFolder(name)), file?.bytes ?? Buffer.of())).toBe(0);
  });
});
