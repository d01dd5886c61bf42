/** What `tetrafront mesh` does with the triangles of a surface if no treatment is given. */
import { readFileSync } from "node:fs";

import type { MeshReport } from "tetrafront";
import { expect, test } from "vitest";

import { offFile } from "../../support/surface-files.js";
import { boxSurface, needleGearSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const { save, run, inFolder } = temporaryFolder();

/** Runs `mesh` and returns its report. */
async function meshed(...more: readonly string[]) {
  const args = ["mesh", "part.off", "-o", "part.vtu", "--report", "part.json", ...more];
  const { code, stderr } = await run(...args);
  expect(code).toBe(0);
  return {
    stderr,
    report: JSON.parse(readFileSync(inFolder("part.json"), "utf8")) as MeshReport & {
      refinement?: object;
      remesh?: object;
    },
  };
}
const codes = (report: MeshReport) => report.diagnostics.map(({ code }) => code);

test("a size far below the triangles splits them, and a note says so", async () => {
  save("part.off", offFile(boxSurface(1)));
  const { stderr, report } = await meshed("--size", "0.1");
  expect(report.tetrahedra).toBeGreaterThan(5000);
  expect(report.refinement).toMatchObject({ given: 12 });
  expect(codes(report)).toEqual(["divided-surface"]);
  expect(stderr).toMatch(
    /note: part\.off: Triangles had edges up to 14 times the target length, so they were split, as by --surface refine\. Use --surface keep/,
  );
  const kept = await meshed("--size", "0.1", "--surface", "keep");
  expect(kept.report.tetrahedra).toBeLessThan(20);
  expect(codes(kept.report)).toEqual(["coarse-surface"]);
});

test("a source far below the triangles splits them too", async () => {
  save("part.off", offFile(boxSurface(1)));
  const { report } = await meshed("--source", "0,0,0,0.02,0.1");
  expect(codes(report)).toContain("divided-surface");
});

test("a size far below the triangles replaces them if many are needles", async () => {
  save("part.off", offFile(needleGearSurface(9, 0.3)));
  const { stderr, report } = await meshed("--size", "0.1");
  expect(report.remesh).toBeDefined();
  expect(stderr).toContain("so they were replaced, as by --surface remesh");
  expect(report.dihedral.min).toBeGreaterThan(10);
});

test.each([[["--size", "0.8"]], [[]]])("other triangles are kept: %j", async (more) => {
  save("part.off", offFile(boxSurface(1)));
  const { report } = await meshed(...more);
  expect(report.triangles).toBe(12);
  expect(codes(report)).toEqual([]);
});
