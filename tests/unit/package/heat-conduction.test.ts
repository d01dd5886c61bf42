/**
 * Finite elements on our meshes, if Python has scikit-fem and meshio: the example of heat conduction in a
 * ball.
 */
import { execFile, spawnSync } from "node:child_process";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";

import { describe, expect, test } from "vitest";

const python = process.env["TETRAFRONT_PYTHON"] ?? "python3";
const example = fileURLToPath(new URL("../../../examples/heat/heat.py", import.meta.url));
const program = fileURLToPath(new URL("../../../wasm/bin/tetrafront.mjs", import.meta.url));
const isAvailable = spawnSync(python, ["-c", "import skfem, meshio"]).status === 0;

describe("the example of linear finite elements", () => {
  test("compiles", () => {
    const { status, stderr } = spawnSync(python, ["-m", "py_compile", example], {
      encoding: "utf8",
      env: { ...process.env, PYTHONDONTWRITEBYTECODE: "1", PYTHONPYCACHEPREFIX: "/tmp/tetrafront-pycache" },
    });
    expect(status, stderr).toBe(0);
  });

  if (isAvailable) {
    test("converges at the theoretical orders", async () => {
      const { stdout } = await promisify(execFile)(python, [example, process.execPath, program]);
      const last = stdout.trim().split("\n").at(-1) ?? "";
      const { order, gradientOrder } = JSON.parse(last) as { order: number; gradientOrder: number };
      expect(order).toBeGreaterThan(1.8);
      expect(gradientOrder).toBeGreaterThan(0.9);
    });
  }
});
