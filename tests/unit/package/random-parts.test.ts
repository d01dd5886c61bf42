/** Parts with random dimensions: each is meshed on its own faces, with good angles. `tests/bench/random-solids.mjs` tries more. */
import { createMesher, type Mesher } from "tetrafront";
import { meshFile } from "tetrafront/node";
import { afterAll, beforeAll, expect, test } from "vitest";

import { withShape } from "../../../wasm/dist/cad/features/evaluate.js";
import type { FeatureKernel } from "../../../wasm/dist/cad/features/session.js";
import { kernelVolume, type Kernel, stepOf, testKernel } from "../../support/kernel-shapes.js";
import { randomPart } from "../../support/random-features.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const folder = temporaryFolder();
let kernel: Kernel & FeatureKernel;
let mesher: Mesher;
beforeAll(async () => {
  [kernel, mesher] = await Promise.all([testKernel(), createMesher()]);
});
afterAll(() => mesher.dispose());

test.each(Array.from({ length: 4 }, (_, seed) => seed + 1))(
  "part %i",
  async (seed) => {
    const { failures, result: volume = 0 } = withShape(kernel, randomPart(seed), (shape) => {
      folder.save(`${seed}.step`, stepOf(kernel, shape));
      return kernelVolume(kernel, shape);
    });
    expect(failures).toEqual([]);
    const made = await meshFile(folder.inFolder(`${seed}.step`), { mesher });
    if (!made.success) throw new Error(made.message);
    expect(made.report.remesh?.onFaces).toBe(true);
    expect(made.report.remesh?.placement?.unplaced).toBe(0);
    expect(made.report.dihedral.min).toBeGreaterThan(20);
    // Chords of circles leave out two hundredths of a rod, and of a hole.
    expect(Math.abs(made.report.volume / volume - 1)).toBeLessThan(0.02);
  },
  180_000,
);
