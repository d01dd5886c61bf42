/** Solids of an STL file that are prepared together or by themselves. */
import { createMesher, meshFile, type Mesh, type Mesher, readSurface, type SurfaceInput } from "tetrafront";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { connectedGroups } from "../../../wasm/dist/base/connected-groups.js";
import { inSteps } from "../../../wasm/dist/calls/yielder.js";
import { solidsOfPatches } from "../../../wasm/dist/formats/patch-solids.js";
import { nearPairs } from "../../../wasm/dist/base/boxes.js";
import { solidUnits } from "../../../wasm/dist/formats/solid-units.js";
import { stlText } from "../../support/surface-files.js";
import { boxSurface, sphereSurface } from "../../support/surfaces.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

const stlOf = (solids: Readonly<Record<string, SurfaceInput>>): Uint8Array =>
  new TextEncoder().encode(
    Object.entries(solids)
      .map(([name, surface]) => new TextDecoder().decode(stlText(surface, name)))
      .join(""),
  );

const solids = {
  base: boxSurface(2, [0, 0, 0], [10, 10, 2]),
  free: sphereSurface(8, 3, [20, 5, 5]),
  tower: boxSurface(2, [3, 3, 2], [6, 6, 8]),
  other: sphereSurface(8, 2, [-9, 5, 5]),
};

async function unitsIn(given: Readonly<Record<string, SurfaceInput>>): Promise<number[][]> {
  const read = await readSurface(stlOf(given), { fileName: "a.stl" });
  const divided = read.success ? await inSteps(solidsOfPatches(read.value)) : undefined;
  if (divided?.surfaceRegions === undefined) throw new Error("no solids");
  return solidUnits({ ...divided, surfaceRegions: divided.surfaceRegions });
}

describe("solids", () => {
  test("that may touch are units; all others are one", async () => {
    expect(await unitsIn(solids)).toEqual([[0], [1, 3], [2]]);
    const { base, free, other } = solids;
    expect(await unitsIn({ base, free, other })).toEqual([[0, 1, 2]]);
    const inside = sphereSurface(6, 0.4, [5, 5, 1]);
    expect(await unitsIn({ base, inside })).toEqual([[0, 1]]);
  });

  test("are near if their boxes share a corner", () => {
    const box = (low: number, high: number) => ({ low: [low, low, low], high: [high, high, high] });
    expect(nearPairs([box(0, 1), box(1, 2), box(1.1, 1.2), box(5, 6)])).toEqual([
      [0, 1],
      [1, 2],
    ]);
  });

  test("are connected through others", () => {
    const pairs = [
      [0, 4],
      [2, 3],
      [4, 1],
    ] as const;
    expect(connectedGroups(6, pairs)).toEqual([[0, 1, 4], [2, 3], [5]]);
  });
});

/** The positions of the nodes of a triangle, in any order. */
const cornersOf = ({ points, triangles }: SurfaceInput, triangle: number): string[] =>
  [...triangles.subarray(3 * triangle, 3 * triangle + 3)]
    .map((node) => points.subarray(3 * node, 3 * node + 3).join())
    .sort();

test("triangles and nodes of a part are named by their numbers in the file", async () => {
  const read = await readSurface(stlOf(solids), { fileName: "a.stl" });
  if (!read.success) throw new Error("not read");
  const given = read.value;
  const { surface, changes = [], report } = await mesher.meshSurface(given, {});
  expect(report.status).toBe("done");
  const { origin = new Uint32Array(), nodeOrigin = new Uint32Array() } = surface;
  const free = given.patches.findIndex(({ name }) => name === "free");
  const kept = [...origin.keys()].filter((t) => given.trianglePatch[origin[t] ?? 0] === free);
  expect(kept).toHaveLength(solids.free.triangles.length / 3);
  for (const t of kept) expect(cornersOf(given, origin[t] ?? 0)).toEqual(cornersOf(surface, t));
  const patchOf = ({ patches, trianglePatch }: Mesh, t: number) => patches[trianglePatch[t] ?? 0]?.name;
  origin.forEach((from, t) => expect(patchOf(given, from)).toBe(patchOf(surface, t)));
  for (const t of kept)
    for (const node of surface.triangles.subarray(3 * t, 3 * t + 3)) {
      const from = nodeOrigin[node] ?? 0;
      expect(given.points.subarray(3 * from, 3 * from + 3)).toEqual(
        surface.points.subarray(3 * node, 3 * node + 3),
      );
    }
  const cut = changes.flatMap((change) => (change.kind === "resolved-intersection" ? [change.triangle] : []));
  const owners = new Set(cut.map((t) => given.patches[given.trianglePatch[t] ?? 0]?.name));
  expect([...owners].sort()).toEqual(["base", "tower"]);
});

test("a solid that touches none keeps its triangles, whatever the others do", async () => {
  const { report, mesh } = await meshFile(stlOf(solids), { fileName: "a.stl", mesher });
  expect(report.status).toBe("done");
  expect(report.regions.map(({ name }) => name)).toEqual(["base", "tower", "free", "other"]);
  const volumes = new Map(report.regions.map(({ name, volume }) => [name, volume]));
  expect(volumes.get("base")).toBeCloseTo(200, 9);
  expect(volumes.get("tower")).toBeCloseTo(54, 9);
  for (const name of ["free", "other"] as const) {
    const patch = mesh?.patches.findIndex((one) => one.name === name);
    const triangles = mesh?.trianglePatch.filter((own) => own === patch).length;
    expect(triangles).toBe(solids[name].triangles.length / 3);
  }
  expect(report.remesh?.given).toBeLessThan(solids.free.triangles.length / 3);
  const alone = await meshFile(stlOf({ free: solids.free }), { fileName: "a.stl", mesher });
  expect(volumes.get("free")).toBeCloseTo(alone.report.volume, 9);
});
