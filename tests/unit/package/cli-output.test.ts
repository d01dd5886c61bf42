/** Output that does not fit on the disk, and meshes of insufficient quality. */
import { execFile } from "node:child_process";
import { writeFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

import type { Diagnostic } from "tetrafront";
import { describe, expect, test } from "vitest";

import { tetrafront } from "../../support/command-line.js";
import { offFile } from "../../support/surface-files.js";
import { boxSurface, needleGearSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const folder = temporaryFolder();
const program = fileURLToPath(new URL("../../../wasm/bin/tetrafront.mjs", import.meta.url));
const save = (name: string, content: Uint8Array) => writeFileSync(path.join(folder.path, name), content);
const run = (...args: string[]) => tetrafront(folder.path, args);

/** Runs a command whose standard output is a file limited to one block, as on a nearly full disk. */
function onFullDisk(...args: string[]): Promise<{ readonly code: number | null; readonly stderr: string }> {
  const script = 'ulimit -f 1; exec "$@" > out';
  return new Promise((resolve) => {
    const child = execFile(
      "sh",
      ["-c", script, "sh", process.execPath, program, ...args],
      { cwd: folder.path },
      (_, __, stderr) => resolve({ code: child.exitCode, stderr }),
    );
  });
}

describe("the command exits with code 1 and a message if standard output is a file on a full disk:", () => {
  test.each([
    ["a mesh", ["convert", "box.off", "-o", "-", "--to", "stl"]],
    ["statistics", ["stats", "box.mesh", "--json"]],
    ["a check", ["check", "box.mesh", "--json"]],
  ])("%s", async (_, args) => {
    save("box.off", offFile(boxSurface(4)));
    expect((await run("mesh", "box.off", "-o", "box.mesh")).code).toBe(0);
    const { code, stderr } = await onFullDisk(...args);
    expect(stderr).toMatch(/error: standard output: Writing failed \(EFBIG\)\. Free space/);
    expect(code).toBe(1);
  });
});

describe("a surface of needles", () => {
  const warningsIn = (stdout: string) =>
    (JSON.parse(stdout) as { diagnostics: Diagnostic[] }).diagnostics.map(({ code, severity }) => [
      code,
      severity,
    ]);

  test("gets a warning from check and its mesh another one", async () => {
    save("gear.off", offFile(needleGearSurface(60)));
    const check = await run("check", "gear.off", "--json");
    expect(check.code).toBe(0);
    expect(warningsIn(check.stdout)).toContainEqual(["needle-surface", "warning"]);
    const mesh = await run("mesh", "gear.off", "-o", "gear.vtu", "--report", "-");
    expect(mesh.code).toBe(0);
    expect(warningsIn(mesh.stdout)).toContainEqual(["poor-elements", "warning"]);
    expect(mesh.stderr).toMatch(
      /warning: gear\.off: \d+ of \d+ tetrahedra \(\d+ %\) are poor: .* below 10°\. Replace/,
    );
    // The message states the number of all poor elements.
    expect(mesh.stderr).not.toContain('more "poor-elements"');
  });

  test("fails with --require-angle, while a box passes", async () => {
    save("gear.off", offFile(needleGearSurface(60)));
    save("box.off", offFile(boxSurface(4)));
    const gear = await run("mesh", "gear.off", "-o", "gear.vtu", "--require-angle", "10");
    expect(gear.stderr).toMatch(
      /error: gear\.off: the smallest dihedral angle is .*°, but --require-angle is 10°/,
    );
    expect(gear.stderr).toContain("Use --optimize thorough");
    expect(gear.code).toBe(1);
    const thorough = ["--optimize", "thorough", "--require-angle", "10"];
    const most = await run("mesh", "gear.off", "-o", "gear.vtu", ...thorough);
    expect(most.stderr).not.toContain("Use --optimize thorough");
    expect(most.code).toBe(1);
    const box = await run("mesh", "box.off", "-o", "box.vtu", "--require-angle", "10");
    expect(box.stderr).not.toMatch(/poor|needle|error/);
    expect(box.code).toBe(0);
  });

  test.each(["90", "-1", "steep"])("--require-angle rejects %s", async (angle) => {
    save("box.off", offFile(boxSurface(4)));
    const { code, stderr } = await run("mesh", "box.off", "-o", "box.vtu", "--require-angle", angle);
    expect(stderr).toMatch(/The required angle is ".*"\. Use an angle from 0 to 70 degrees/);
    expect(code).toBe(2);
  });
});
