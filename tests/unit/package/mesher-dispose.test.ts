/** Meshers that are disposed of, and those that are not. */
import { execFile } from "node:child_process";
import { promisify } from "node:util";

import { createMesher, MesherError } from "tetrafront";
import { describe, expect, test } from "vitest";

import { cubeProject } from "../../support/projects.js";
import { boxSurface, sphereSurface } from "../../support/surfaces.js";

describe("disposing", () => {
  test("can be omitted: the process ends without it", async () => {
    const program = `
      import { createMesher } from "tetrafront";
      const mesher = await createMesher();
      const points = Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1);
      const triangles = Uint32Array.of(0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3);
      console.log((await mesher.fillSurface({ points, triangles })).report.status);`;
    const args = ["--input-type=module", "--eval", program];
    const { stdout } = await promisify(execFile)(process.execPath, args, { timeout: 20_000 });
    expect(stdout).toBe("done\n");
  });

  test("rejects active and later calls", async () => {
    const short = await createMesher();
    const runs = [short.fillSurface(sphereSurface(24)), short.previewProject(cubeProject())];
    short.dispose();
    short.dispose();
    const after = short.fillSurface(boxSurface(1));
    for (const run of [...runs, after]) await expect(run).rejects.toMatchObject({ code: "disposed" });
    await expect(after).rejects.toBeInstanceOf(MesherError);
  });
});
