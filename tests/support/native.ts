/** The native programs, whose meshes must be those of the package. */
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";

import type { SurfaceInput } from "tetrafront";

import { offFile } from "./surface-files.js";

export const nativeProgram = (name: string): string =>
  fileURLToPath(new URL(`../../build/release/${name}`, import.meta.url));
export const fill = nativeProgram("fill");

/** Returns the fingerprint of the mesh that the native program makes from a surface. */
export function nativeFingerprint(surface: SurfaceInput, ...options: string[]): string | undefined {
  const folder = mkdtempSync(path.join(tmpdir(), "tetrafront-"));
  try {
    const file = path.join(folder, "surface.off");
    writeFileSync(file, offFile(surface));
    return /fingerprint ([0-9a-f]{16})/i.exec(
      execFileSync(fill, [file, ...options], { encoding: "utf8" }),
    )?.[1];
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
