/** The example of a part, from an STL file to displacements, if Python has scikit-fem and meshio. */
import { execFile, spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";

import { describe, expect, test } from "vitest";
import { stepOf, testKernel } from "../../support/kernel-shapes.js";
import { stlBinary } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const python = process.env["TETRAFRONT_PYTHON"] ?? "python3";
const example = fileURLToPath(new URL("../../../examples/part/part.py", import.meta.url));
const readme = fileURLToPath(new URL("../../../README.md", import.meta.url));
const program = fileURLToPath(new URL("../../../wasm/bin/tetrafront.mjs", import.meta.url));
const isAvailable = spawnSync(python, ["-c", "import skfem, meshio"]).status === 0;

describe("the example of a part", () => {
  const folder = temporaryFolder();

  async function runExample(...given: string[]): Promise<string> {
    const command = [example, ...given, "--command", process.execPath, program];
    return (await promisify(execFile)(python, command, { cwd: folder.path })).stdout;
  }

  const largestIn = (printed: string) => Number(/largest displacement (\S+)/.exec(printed)?.[1]);

  test("compiles", () => {
    const { status, stderr } = spawnSync(python, ["-m", "py_compile", example], {
      encoding: "utf8",
      env: { ...process.env, PYTHONPYCACHEPREFIX: folder.path },
    });
    expect(status, stderr).toBe(0);
  });

  if (isAvailable) {
    test("pulls a bar to the length that the theory gives", async () => {
      folder.save("bar.stl", stlBinary(boxSurface(1, [0, 0, 0], [1, 1, 4])));
      const largest = largestIn(await runExample("bar.stl", "patch 1", "patch 6"));
      // Stress 1, Young's modulus 2000, length 4; the fixed end cannot become narrower.
      expect(largest).toBeGreaterThan(0.0019);
      expect(largest).toBeLessThan(0.00205);
      // The lowest patch is the first.
      const { stdout } = await folder.run("info", "part.msh");
      expect(stdout).toMatch(
        /patch 1 "patch 1": \d+, box \(0, 0, 0\) to \(1, 1, 0\), area 1, normal \(0, 0, -1\)/,
      );
      expect(stdout).toMatch(/patch 6 "patch 6": \d+, box \(0, 0, 4\) to \(1, 1, 4\)/);
    });

    test("pulls a rod of a STEP file with curved second-order elements", async () => {
      const kernel = await testKernel();
      folder.save("rod.step", stepOf(kernel, new kernel.BRepPrimAPI_MakeCylinder(0.5, 4).Shape()));
      const largest = largestIn(await runExample("rod.step", "face 3", "face 2", "--order", "2"));
      expect(largest).toBeGreaterThan(0.00195);
      expect(largest).toBeLessThan(0.00201);
      // The middles of edges are on the cylinder: scikit-fem integrates its volume.
      const volume = `
import meshio
from skfem import Basis, ElementTetP2, Functional, MeshTet2
mesh = MeshTet2.load("part.msh")
print(Functional(lambda w: 1.0 + 0.0 * w.x[0]).assemble(Basis(mesh, ElementTetP2(), intorder=6)))`;
      const { stdout } = await promisify(execFile)(python, ["-c", volume], { cwd: folder.path });
      expect(Number(stdout.trim().split("\n").at(-1)) / Math.PI).toBeCloseTo(1, 3);
    });

    test("README: the temperature between the ends of a bar is linear", async () => {
      folder.save("bar.stl", stlBinary(boxSurface(1, [0, 0, 0], [1, 1, 4])));
      await folder.run("mesh", "bar.stl", "-o", "part.msh", "--surface", "remesh", "--split-patches");
      const [, solving = ""] = /```python\n([^`]*)```/.exec(readFileSync(readme, "utf8")) ?? [];
      const check = "print(len(u) > 8 and abs(u - mesh.p[2] / 4).max() < 1e-9)";
      const options = { cwd: folder.path };
      const { stdout } = await promisify(execFile)(python, ["-c", `${solving}${check}`], options);
      expect(stdout.trim()).toMatch(/True$/);
    });

    test("lists the patches if a name is wrong", async () => {
      folder.save("bar.stl", stlBinary(boxSurface(1, [0, 0, 0], [1, 1, 4])));
      await expect(runExample("bar.stl", "patch 1", "top")).rejects.toMatchObject({
        stderr: expect.stringMatching(
          /There is no patch "top"\. The patches are: patch 1, .*patch 6/,
        ) as string,
      });
    });
  }
});
