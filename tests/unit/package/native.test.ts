import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";

import { createMesher, type SurfaceInput } from "tetrafront";
import { expect, test } from "vitest";

import { offFile } from "../../support/surface-files.js";
import { boxSurface, cavitySurface, sphereSurface, torusSurface } from "../../support/surfaces.js";

const fill = fileURLToPath(new URL("../../../build/native/fill", import.meta.url));

/** What the native program says about the mesh of the same surface. */
function nativeFingerprint(surface: SurfaceInput): string | undefined {
  const folder = mkdtempSync(path.join(tmpdir(), "tetrafront-"));
  try {
    const file = path.join(folder, "surface.off");
    writeFileSync(file, offFile(surface));
    return /fingerprint ([0-9a-f]{16})/i.exec(execFileSync(fill, [file], { encoding: "utf8" }))?.[1];
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

test.each<[string, SurfaceInput]>([
  ["a sphere", sphereSurface(12)],
  ["a cube", boxSurface(9)],
  ["a torus", torusSurface(48, 20)],
  ["a cube with a cavity", cavitySurface(10)],
])("%s has the same mesh bit for bit natively and as WebAssembly", async (_, surface) => {
  const mesher = await createMesher();
  const { report } = await mesher.fillSurface(surface);
  mesher.dispose();
  expect(report.status).toBe("done");
  expect(nativeFingerprint(surface)?.toLowerCase()).toBe(report.fingerprint);
});
