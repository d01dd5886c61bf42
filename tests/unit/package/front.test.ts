/** Snapshots of the front while a run advances. */
import { createMesher, type Mesher, type MeshResult, type RunControl } from "tetrafront";
import { afterAll, beforeAll, expect, test } from "vitest";

import { boxSurface } from "../../support/surfaces.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

/** Some 100 000 elements: the front alone takes longer than the first snapshot waits. */
const fill = (control: RunControl = {}): Promise<MeshResult> =>
  mesher.fillSurface(boxSurface(28), { optimization: "none" }, control);

test("the front is shown while it advances, and the mesh is the same", async () => {
  const fronts: Float64Array[] = [];
  const shown = await fill({ onFront: (corners) => void fronts.push(corners) });
  const hidden = await fill();
  expect(shown.report.status).toBe("done");
  expect(shown.report.fingerprint).toBe(hidden.report.fingerprint);
  expect(fronts.length).toBeGreaterThan(0);
  for (const corners of fronts) {
    expect(corners.length % 9).toBe(0);
    expect(corners.length).toBeGreaterThan(0);
    expect(corners.every((x) => x >= 0 && x <= 1)).toBe(true);
  }
  // At most four a second, the first after a quarter of one.
  expect(fronts.length).toBeLessThanOrEqual(4 * shown.report.seconds.total);
});

test("what onFront throws ends the run, which is rejected with just that", async () => {
  const failure = new Error("mine");
  const onFront = (): void => {
    throw failure;
  };
  await expect(fill({ onFront })).rejects.toBe(failure);
});

test("onFront must be a function", async () => {
  const { report } = await fill({ onFront: 5 as unknown as () => void });
  expect(report.status).toBe("invalid-input");
  expect(report.diagnostics[0]?.remedy).toContain("onFront");
});
