/** Cracks of surfaces: the command line proposes the weld that closes them. */
import { createMesher, type Mesher, type SurfaceInput } from "tetrafront";
import { afterAll, beforeAll, expect, test } from "vitest";

import { crackWarning } from "../../../wasm/src/api/cracks.js";
import { boxSurface, sphereSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";
import { offFile } from "../../support/surface-files.js";

const { save, run } = temporaryFolder();
let mesher: Mesher;
beforeAll(async () => void (mesher = await createMesher()));
afterAll(() => mesher.dispose());

/** Triangles with corners of their own, each moved. */
function apart({ points, triangles }: SurfaceInput, move: (corners: number[][]) => number[][]): SurfaceInput {
  const moved: number[] = [];
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = [...triangles.subarray(t, t + 3)].map((n) => [...points.subarray(3 * n, 3 * n + 3)]);
    moved.push(...move(corners).flat());
  }
  return {
    points: Float64Array.from(moved),
    triangles: Uint32Array.from(moved.keys()).slice(0, moved.length / 3),
  };
}

/** A box whose halves are moved apart along x, each half welded by itself. */
const halves = (gap: number): SurfaceInput => {
  const { points, triangles } = boxSurface(4);
  const count = points.length / 3;
  const isRight = (t: number) => {
    const corners = [...triangles.subarray(3 * t, 3 * t + 3)].map((n) => points[3 * n] ?? 0);
    return corners.reduce((sum, one) => sum + one, 0) > 1.5;
  };
  const right = points.map((value, i) => (i % 3 === 0 ? value + gap : value));
  const all = triangles.map((node, corner) => (isRight(Math.floor(corner / 3)) ? node + count : node));
  return { points: Float64Array.of(...points, ...right), triangles: all };
};

const refused = { isFillable: false, regions: 0 };

test("a crack between two halves is closed by the proposed weld", async () => {
  const [found] = await crackWarning(mesher, halves(0.01), { isFillable: true, regions: 2 });
  expect(found).toMatchObject({ code: "cracked-surface", severity: "warning" });
  expect(found?.message).toContain("split into 2 regions");
  expect(found?.remedy).toBe("Use `weld: 0.011` to close the crack.");
  expect(await crackWarning(mesher, halves(0.01), { isFillable: true, regions: 1 })).toEqual([]);
});

test("the proposed weld is tried with the inner shells that are asked for", async () => {
  const asked: unknown[] = [];
  const watched: Pick<Mesher, "repairSurface" | "inspectSurface"> = {
    repairSurface: (surface, options) => {
      asked.push(options?.innerShells);
      return mesher.repairSurface(surface, options);
    },
    inspectSurface: (surface, options) => {
      asked.push(options?.innerShells);
      return mesher.inspectSurface(surface, options);
    },
  };
  const repaired = { isFillable: true, regions: 2 };
  expect(await crackWarning(watched, halves(0.01), repaired, "regions")).toHaveLength(1);
  expect(asked).toEqual(["regions", "regions"]);
});

test("loose triangles are joined by the proposed weld", async () => {
  const loose = apart(sphereSurface(4), (corners) => {
    const middle = [0, 1, 2].map((k) => corners.reduce((sum, corner) => sum + (corner[k] ?? 0), 0) / 3);
    return corners.map((corner) => corner.map((value, k) => value + 0.01 * ((middle[k] ?? 0) - value)));
  });
  const [found] = await crackWarning(mesher, loose, refused);
  const weld = Number(/weld: ([^`]+)/.exec(found?.remedy ?? "")?.[1]);
  expect(weld).toBeLessThan(0.05);
  const { mesh: surface } = await mesher.repairSurface(loose, { weld });
  expect((await mesher.inspectSurface(surface)).isFillable).toBe(true);
});

test("a wide gap, an open box and a closed one have no crack", async () => {
  expect(await crackWarning(mesher, halves(0.5), refused)).toEqual([]);
  const box = boxSurface(4);
  expect(await crackWarning(mesher, box, refused)).toEqual([]);
  const open = { ...box, triangles: box.triangles.slice(0, -3) };
  expect(await crackWarning(mesher, open, refused)).toEqual([]);
});

test("the command proposes it, and it works", async () => {
  save("cracked.off", offFile(halves(0.01)));
  const split = await run("remesh", "cracked.off", "-o", "split.off", "--size", "0.4");
  expect(split.stderr).toContain("warning: cracked.off: The surface has a crack up to 0.011 wide");
  const closed = await run("remesh", "cracked.off", "-o", "closed.off", "--size", "0.4", "--weld", "0.011");
  expect([split.code, closed.code]).toEqual([0, 0]);
  expect(closed.stderr).not.toContain("has a crack");
});
