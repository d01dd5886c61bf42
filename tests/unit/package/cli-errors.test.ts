/**
 * Options without effect are rejected, failures of the engine are reported in one line, and batches can be
 * cancelled.
 */
import { existsSync, readFileSync } from "node:fs";

import { writeMesh, type Mesh } from "tetrafront";
import { writeProject } from "tetrafront/project";
import { beforeEach, describe, expect, test } from "vitest";

import { blockMesh } from "../../support/block-mesh.js";
import { signalAtProgress, tetrafront } from "../../support/command-line.js";
import { cubeProject } from "../../support/projects.js";
import { stlBinary } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const folder = temporaryFolder();
const { inFolder, save, run } = folder;

async function saveMesh(name: string, mesh: Mesh): Promise<void> {
  for (const { fileName, bytes } of await writeMesh(mesh, name)) save(fileName, bytes);
}

describe("options without effect", () => {
  beforeEach(async () => {
    await saveMesh("block.vtu", blockMesh());
    save("box.stl", stlBinary(boxSurface(1)));
    save("cube.json", writeProject(cubeProject()));
  });

  test.each([
    [["convert", "block.vtu", "-o", "again.msh", "--repair"], /repairs are for surfaces/i],
    [["check", "box.stl", "--size", "0.1"], /--size is for projects/],
    [["check", "block.vtu", "--inner-shells", "regions"], /--inner-shells is for/],
    [["check", "block.vtu", "--max-diagnostics", "9"], /--max-diagnostics is for surfaces/],
    [["check", "cube.json", "--max-diagnostics", "all"], /--max-diagnostics is for surfaces/],
    [
      ["check", "box.stl", "--max-diagnostics", "0"],
      /number of diagnostics to list is 0\. Use a whole number from 1 to 1000000/,
    ],
    [["check", "box.stl", "--max-diagnostics", "some"], /number of diagnostics to list is "some"/],
    [["mesh", "cube.json", "-o", "cube.vtu", "--growth", "0.1"], /--growth is for surfaces/],
    [["check", "-", "box.stl"], /standard input cannot be combined/i],
  ])("are rejected: %j", async (args, words) => {
    const { code, stderr } = await run(...args);
    expect(stderr).toMatch(words);
    expect(code).toBe(2);
  });

  test("do not include --repair if convert writes the boundary of a mesh", async () => {
    const { code, stderr } = await run("convert", "block.vtu", "-o", "skin.stl", "--repair");
    expect(stderr).toMatch(/^tetrafront: repair: block.vtu: /m);
    expect(code).toBe(0);
  });
});

test("an out-of-memory error of the engine is reported in one line and as a diagnostic, without a stack trace", async () => {
  const count = 600_000;
  await saveMesh("many.vtu", {
    ...blockMesh(),
    ...{ triangles: new Uint32Array(), trianglePatch: new Uint32Array(), patches: [] },
    tetrahedra: Uint32Array.from({ length: 4 * count }, (_, i) => i % 4),
    tetrahedronRegion: new Uint32Array(count),
  });
  const limit = new URL("../../support/little-memory.mjs", import.meta.url).href;
  const env = { TETRAFRONT_TEST_MEMORY: String(66 * 2 ** 20), NODE_OPTIONS: `--import "${limit}"` };
  for (const args of [
    ["stats", "many.vtu"],
    ["check", "many.vtu", "--json"],
  ]) {
    const { code, stderr, stdout } = await tetrafront(folder.path, args, { env });
    expect(stderr).not.toMatch(/^ +at /m);
    expect(code).toBe(1);
    // On a slow machine, lines before it say how long the work has taken so far.
    if (args[0] === "stats")
      expect(stderr).toMatch(
        /^(.* s so far\n)*tetrafront: error: many.vtu: The engine ran out of memory \(\d+ MB\)\. Use .*\n$/,
      );
    else expect(JSON.parse(stdout)).toMatchObject({ kind: "none", diagnostics: [{ code: "out-of-memory" }] });
  }
});

test("a cancelled batch ends its processes and still writes its report", async () => {
  for (const name of ["a.stl", "b.stl", "c.stl"]) save(name, stlBinary(boxSurface(1)));
  const args = ["mesh", "a.stl", "b.stl", "c.stl", "-o", "{name}.vtu", "-j", "2", "--report", "all.json"];
  const { code, stderr } = await tetrafront(folder.path, [...args, "--size", "0.03", "--surface", "refine"], {
    env: signalAtProgress("SIGTERM", "parent"),
  });
  // As one file: 128 and the number of SIGTERM.
  expect(code).toBe(143);
  expect(stderr).toMatch(/3 files: 0 done, 3 not completed, 0 invalid/);
  const reports = JSON.parse(readFileSync(inFolder("all.json"), "utf8")) as { status: string }[];
  // The files whose runs had started; the third run never started.
  expect(reports.length).toBeLessThan(3);
  for (const { status } of reports) expect(status).toBe("cancelled");
});

test("output names contain input names verbatim", async () => {
  save("a$$b.stl", stlBinary(boxSurface(1)));
  await run("convert", "a$$b.stl", "-o", "{name}.off", "-q");
  expect(existsSync(inFolder("a$$b.off"))).toBe(true);
});

test("propose does not add the same sources twice", async () => {
  save("duct.json", readFileSync(new URL("../../../public/models/pipe-and-flow.json", import.meta.url)));
  const propose = () => run("propose", "duct.json", "-o", "duct.json", "--max-size", "0.5");
  await propose();
  const first = readFileSync(inFolder("duct.json"), "utf8");
  const { background } = JSON.parse(first) as { background: { sources: readonly unknown[] } };
  expect(background.sources.length).toBeGreaterThan(0);
  await propose();
  expect(readFileSync(inFolder("duct.json"), "utf8")).toBe(first);
});

test("a project can be read from a stream, and an unknown extension gives a hint at --from", async () => {
  const covered = await tetrafront(folder.path, ["cover", "-", "-o", "-"], {
    input: writeProject(cubeProject()),
  });
  expect(covered.code).toBe(0);
  expect(JSON.parse(covered.stdout)).toMatchObject({ format: "tetrafront-project" });
  save("part.dat", "solid");
  expect((await run("check", "part.dat")).stderr).toMatch(/--from/);
});
