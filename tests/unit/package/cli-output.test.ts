/** Output that does not fit on the disk, and meshes of insufficient quality. */
import { execFile } from "node:child_process";
import { writeFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

import type { Diagnostic, MeshInspection, MeshReport } from "tetrafront";
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

  test.each([["--help"], ["mesh", "--help"], ["convert", "--help"]])("the help: %s %s", async (...args) => {
    const { code, stderr } = await onFullDisk(...args);
    expect(stderr).toMatch(/^tetrafront: error: standard output: Writing failed \(EFBIG\)\. Free space/);
    expect(code).toBe(1);
  });

  test("the report of a mesh", async () => {
    save("box.off", offFile(boxSurface(4)));
    const { code, stderr } = await onFullDisk("mesh", "box.off", "-o", "box.vtu", "--report", "-", "-q");
    expect(stderr).toMatch(
      /box\.vtu: The file cannot be written[^]*tetrafront: error: standard output: Writing failed \(EFBIG\)\. Free space/,
    );
    expect(code).toBe(1);
  });
});

describe("a surface of needles that are kept", () => {
  const KEEP = ["--surface", "keep"];
  const warningsIn = (stdout: string) =>
    (JSON.parse(stdout) as { diagnostics: Diagnostic[] }).diagnostics.map(({ code, severity }) => [
      code,
      severity,
    ]);

  test("gets a note from check and its mesh a warning", async () => {
    save("gear.off", offFile(needleGearSurface(24)));
    const check = await run("check", "gear.off", "--json");
    expect(check.code).toBe(0);
    expect(warningsIn(check.stdout)).toContainEqual(["needle-surface", "information"]);
    expect(check.stdout).toContain("A mesh replaces all triangles, as by --surface remesh.");
    const mesh = await run("mesh", "gear.off", "-o", "gear.vtu", ...KEEP, "--report", "-");
    expect(mesh.code).toBe(0);
    expect(warningsIn(mesh.stdout)).toContainEqual(["poor-elements", "warning"]);
    expect(mesh.stderr).toMatch(
      /warning: gear\.off: \d+ of \d+ tetrahedra \(\d+ %\) are poor: .* below 10°; .*\. The smallest angle is [\d.]+°, at \(.*\).*\. The largest angle is 1\d\d°\. Remesh the surface \(--surface remesh/,
    );
    // The message states the number of all poor elements.
    expect(mesh.stderr).not.toContain('more "poor-elements"');
    expect(mesh.stderr).toMatch(/the worst are tetrahedron \d+ \(counted from 0\), tetrahedron \d+/);
  });

  test("gets the same warning from check of its mesh, which names the worst elements", async () => {
    save("gear.off", offFile(needleGearSurface(24)));
    await run("mesh", "gear.off", "-o", "gear.vtu", ...KEEP, "-q");
    const { code, stdout } = await run("check", "gear.vtu", "--json");
    expect(code).toBe(0);
    const { diagnostics } = JSON.parse(stdout) as { diagnostics: Diagnostic[] };
    const warning = diagnostics.find((found) => found.code === "poor-elements");
    const stats = await run("stats", "gear.vtu", "--json");
    const { dihedral, tetrahedra, quality } = JSON.parse(stats.stdout) as MeshInspection;
    expect(warning).toMatchObject({ severity: "warning", data: { tetrahedra } });
    const angleOf = new Map(
      [...quality.worst, ...quality.limitedByBoundary.worst].map((one) => [
        one.tetrahedron,
        one.dihedral.min,
      ]),
    );
    expect(warning?.entities.map(({ kind }) => kind)).toEqual(Array(5).fill("tetrahedron"));
    const angles = warning?.entities.map(({ index }) => angleOf.get(index) ?? 180) ?? [];
    expect(angles[0]).toBeCloseTo(dihedral.min, 9);
    expect(angles).toEqual([...angles].sort((a, b) => a - b));
    expect(angles.at(-1)).toBeLessThan(10);
    const text = await run("check", "gear.vtu");
    expect(text.stdout).toContain("gear.vtu: 1 warning");
  });

  test("fails with --require-angle, while a box passes", async () => {
    save("gear.off", offFile(needleGearSurface(10)));
    save("box.off", offFile(boxSurface(4)));
    const gear = await run("mesh", "gear.off", "-o", "gear.vtu", ...KEEP, "--require-angle", "10");
    expect(gear.stderr).toMatch(
      /error: gear\.off: The smallest dihedral angle is .*°, but --require-angle is 10°/,
    );
    expect(gear.stderr).toContain("Use --surface remesh, or --optimize thorough, or a surface");
    expect(gear.code).toBe(1);
    const thorough = ["--optimize", "thorough", "--require-angle", "10"];
    const most = await run("mesh", "gear.off", "-o", "gear.vtu", ...KEEP, ...thorough);
    expect(most.stderr).not.toContain("--optimize thorough");
    expect(most.code).toBe(1);
    const reported = await run(
      "mesh",
      "gear.off",
      "-o",
      "gear.vtu",
      ...KEEP,
      "--require-angle",
      "10",
      "-r",
      "-",
    );
    const { diagnostics, output, dihedral } = JSON.parse(reported.stdout) as MeshReport & { output: string };
    const error = diagnostics.find(({ severity }) => severity === "error");
    expect(error).toMatchObject({ code: "required-angle", data: { angle: dihedral.min, required: 10 } });
    // The mesh is written nevertheless, as the help says.
    expect(output).toBe("gear.vtu");
    expect(reported.code).toBe(1);
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
