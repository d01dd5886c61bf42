/**
 * The command line with surfaces and meshes from files: check, repair, convert, info, stats, streams and
 * batches.
 */
import { mkdirSync, readdirSync, readFileSync, renameSync, symlinkSync, writeFileSync } from "node:fs";
import path from "node:path";

import {
  readMesh,
  writeMesh,
  type Diagnostic,
  type Mesh,
  type MeshReport,
  type SurfaceInput,
} from "tetrafront";
import { writeProject } from "tetrafront/project";
import { describe, expect, test } from "vitest";

import { expandInputs, splitPattern } from "../../../wasm/src/cli/batch.js";
import { blockMesh } from "../../support/block-mesh.js";
import { tetrafront } from "../../support/command-line.js";
import { cubeProject } from "../../support/projects.js";
import { offFile, stlBinary } from "../../support/surface-files.js";
import { boxSurface, cavitySurface, crossingNeedles, joined, sphereSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const folder = temporaryFolder();
const { inFolder, save, run } = folder;

const jsonIn = (name: string): unknown => JSON.parse(readFileSync(inFolder(name), "utf8"));

async function meshIn(name: string): Promise<Mesh> {
  const read = await readMesh(readFileSync(inFolder(name)), { fileName: name });
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

const box = boxSurface(2, [0, 0, 0], [1, 2, 3]);
const without = ({ points, triangles }: SurfaceInput, count: number): SurfaceInput => ({
  points,
  triangles: triangles.slice(3 * count),
});

describe("--surface refine", () => {
  test("splits large triangles before meshing and reports it", async () => {
    const { points, triangles } = boxSurface(1, [0, 0, 0], [1, 1, 1]);
    const patched = offFile({ points, triangles });
    save("box.off", patched);
    const args = ["mesh", "box.off", "-o", "box.msh", "--size", "0.2", "--report", "box.json"];
    const coarse = await tetrafront(folder.path, [...args, "--surface", "keep"]);
    expect(coarse.code).toBe(0);
    expect(coarse.stderr).toMatch(/warning: .*--surface refine.*--surface remesh/);
    const { code, stderr } = await tetrafront(folder.path, [...args, "--surface", "refine"]);
    expect(code).toBe(0);
    expect(stderr).not.toContain("warning");
    const { refinement, triangles: count } = jsonIn("box.json") as MeshReport & {
      refinement: { given: number; triangles: number; splitEdges: number };
    };
    expect(refinement.given).toBe(12);
    expect(refinement.triangles).toBe(count);
    expect(refinement.splitEdges).toBe(count / 2 - 6);
    expect(stderr).toContain(`refined: 12 triangles before, ${count} after`);
  });

  test("rejects a size that gives too many elements before it splits any triangle", async () => {
    save("box.off", offFile(box));
    const args = [
      "mesh",
      "box.off",
      "-o",
      "b.vtu",
      "--surface",
      "refine",
      "--size",
      "0.004",
      "--report",
      "r.json",
    ];
    const { code, stderr } = await tetrafront(folder.path, args);
    expect(code).toBe(2);
    // The surface alone, three million triangles, would be below the limit; splitting it takes many seconds.
    expect(stderr).toMatch(/about 79\d{7} tetrahedra; the limit is \d{9}.*1\.\d times as large/);
    expect(stderr).not.toMatch(/refined:/);
  });

  test("without sizes, splits what is large beside small triangles, as the default does", async () => {
    save("inclusion.off", offFile(joined(boxSurface(1, [-2, -2, -2], [2, 2, 2]), sphereSurface(8))));
    const args = ["mesh", "inclusion.off", "-o", "a.vtu", "--report", "a.json"];
    const angleWith = async (...more: string[]): Promise<number> => {
      expect((await run(...args, ...more)).code).toBe(0);
      return (jsonIn("a.json") as MeshReport).quality.shapes.dihedral.min;
    };
    expect(await angleWith("--surface", "keep")).toBeLessThan(10);
    expect(await angleWith("--surface", "refine")).toBeGreaterThan(25);
    expect(await angleWith()).toBeGreaterThan(25);
  });
});

describe("a repair option", () => {
  test.each<[string, (args: { mesh: string; project: string }) => string[], RegExp]>([
    [
      "a project to mesh",
      ({ project }) => ["mesh", project, "-o", "a.vtu", "--repair"],
      /the input is a project/,
    ],
    ["a project to check", ({ project }) => ["check", project, "--weld", "1e-6"], /the input is a project/],
    ["a mesh to check", ({ mesh }) => ["check", mesh, "--fill-holes", "3"], /a mesh of tetrahedra/],
  ])("is rejected for %s", async (_, argsFor, message) => {
    save("cube.json", writeProject(cubeProject()));
    save("block.vtu", (await writeMesh(blockMesh(), "block.vtu"))[0]?.bytes ?? "");
    const args = argsFor({ mesh: "block.vtu", project: "cube.json" });
    const { code, stderr } = await tetrafront(folder.path, args);
    expect(code).toBe(2);
    expect(stderr).toMatch(/repairs are for surfaces/i);
    expect(stderr).toMatch(message);
  });
});

test("every command uses the singular for one item and the plural for several", async () => {
  const one = "MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\n";
  save("one.mesh", `${one}Triangles 1\n1 3 2 1\nTetrahedra 1\n1 2 3 4 1\nEnd\n`);
  save("cube.json", writeProject(cubeProject()));
  save("box.off", offFile(box));
  const results = [
    await run("info", "one.mesh"),
    await run("info", "cube.json"),
    await run("stats", "one.mesh"),
    await run("check", "one.mesh"),
    await run("convert", "one.mesh", "-o", "one.su2"),
    await run("convert", "one.mesh", "-o", "one.foam.zip"),
    await run("cover", "cube.json", "-o", "covered.json", "--shape", "tetrahedron"),
    await run("check", "one.mesh", "box.off"),
  ];
  const output = results.map(({ stdout, stderr }) => stdout + stderr).join("");
  expect(output).toMatch(/\b1 tetrahedron\b/);
  expect(output).toMatch(/\b1 triangle\b/);
  expect(output).toMatch(/\b6 patches\b/);
  expect(output).not.toMatch(/\b1 (tetrahedra|[a-z]+s)\b/);
});

test("the bounding box of a part far from the origin is printed with all digits", async () => {
  save("far.off", offFile({ points: box.points.map((x) => 3e7 + 0.25 * x), triangles: box.triangles }));
  const boundingBox = "box (30000000, 30000000, 30000000) to (30000000.25, 30000000.5, 30000000.75)";
  expect((await run("check", "far.off")).stdout).toContain(boundingBox);
  expect((await run("info", "far.off")).stdout).toContain(boundingBox);
});

describe("check", () => {
  test("prints its list to standard output, and to standard error that an input could not be checked", async () => {
    const open = offFile(without(box, 1));
    save("open.off", open);
    const found = await run("check", "open.off");
    expect([found.code, found.stderr]).toEqual([2, ""]);
    expect(found.stdout).toMatch(/^error: open\.off: The surface is not closed/m);
    expect(found.stdout).toMatch(/^open\.off: 3 errors\n$/m);
    const quiet = await run("check", "open.off", "--quiet");
    expect(quiet.stdout.split("\n").filter((line) => !line.startsWith("error: "))).toEqual([""]);
    save("cut.off", open.subarray(0, 20));
    const cut = await run("check", "cut.off");
    expect([cut.code, cut.stdout]).toEqual([2, ""]);
    expect(cut.stderr).toMatch(/^tetrafront: error: cut\.off: /m);
    const both = await run("check", "open.off", "cut.off");
    expect(both.stdout).toBe(found.stdout);
  });

  test("prints similar diagnostics once, with their count", async () => {
    const { points, triangles } = boxSurface(3);
    save("tiny.off", offFile({ points: points.map((x) => 1e-90 * x), triangles }));
    const { code, stdout } = await tetrafront(folder.path, ["check", "tiny.off"]);
    expect(code).toBe(2);
    // One per node with such a coordinate. Diagnostics with positions are listed separately.
    expect(stdout.match(/has the coordinate/g)).toHaveLength(1);
    const tiny = points.filter(
      (_, i) => i % 3 === 0 && points.subarray(i, i + 3).some((x) => x !== 0),
    ).length;
    expect(stdout).toMatch(`(and ${tiny - 1} similar)`);
  });

  test("counts the diagnostics that are not listed", async () => {
    const corners = Array.from({ length: 400 }, (_, i) => [i, 0, 0, i + 0.5, 0, 0, i, 1, 0]).flat();
    const apart = {
      points: Float64Array.from(corners),
      triangles: Uint32Array.from({ length: 1200 }, (_, i) => i),
    };
    save("apart.off", offFile(apart));
    const { code, stdout } = await tetrafront(folder.path, ["check", "apart.off"]);
    expect(code).toBe(2);
    expect(stdout).toMatch(/: and 1195 more "open-edge"\.\n/);
    // The remedy is the same for all.
    expect(stdout.match(/every edge needs at least two triangles/g)).toHaveLength(1);
    expect(stdout).toMatch(/: 1200 errors\n$/);
  });

  test("lists all diagnostics on request, as text and as JSON", async () => {
    const pairs = 300;
    save("soup.off", offFile(crossingNeedles(pairs)));
    const listedIn = (text: string) => text.match(/error: soup\.off: The surface intersects itself/g)?.length;
    expect(listedIn((await run("check", "soup.off")).stdout)).toBe(5);
    const some = await run("check", "soup.off", "--max-diagnostics", "70");
    expect(listedIn(some.stdout)).toBe(70);
    expect(some.stdout).toMatch(/: and 230 more "self-intersection"\.\n/);
    const all = await run("check", "soup.off", "--max-diagnostics", "all");
    expect(listedIn(all.stdout)).toBe(pairs);
    expect(all.stdout).not.toMatch(/: and \d+ more/);
    expect(all.stdout).toMatch(/: 2100 errors\n$/);
    const { code, stdout } = await run("check", "soup.off", "--max-diagnostics", "all", "--json");
    expect(code).toBe(2);
    const report = JSON.parse(stdout) as { errors: number; diagnostics: Diagnostic[] };
    expect(report.errors).toBe(7 * pairs);
    const crossings = report.diagnostics.filter((found) => found.code === "self-intersection");
    expect(crossings.map(({ entities }) => entities.map(({ index }) => index))).toEqual(
      Array.from({ length: pairs }, (_, i) => [2 * i, 2 * i + 1]),
    );
    // The same text as if it were written in one piece.
    expect(stdout).toBe(`${JSON.stringify(report, null, 2)}\n`);
  });

  test("interprets inner shells as regions or cavities", async () => {
    const inside = boxSurface(1, [0.25, 0.25, 0.25], [0.75, 0.75, 0.75]);
    writeFileSync(path.join(folder.path, "core.off"), offFile(joined(boxSurface(2), inside)));
    for (const [meaning, regions] of [
      ["regions", 2],
      ["cavities", 1],
    ] as const) {
      const args = ["check", "core.off", "--inner-shells", meaning, "--json"];
      const { code, stdout } = await tetrafront(folder.path, args);
      expect(code).toBe(0);
      expect(JSON.parse(stdout)).toMatchObject({ inspection: { regions, cavities: 2 - regions } });
    }
  });

  test("prints the properties of a valid surface and exits with 0", async () => {
    save("part.off", offFile(cavitySurface(10)));
    const { code, stdout } = await tetrafront(folder.path, ["check", "part.off"]);
    expect(code).toBe(0);
    expect(stdout).toContain("part.off: closed, manifold, without self-intersections\n");
    expect(stdout).toContain("part.off: 1 region, 1 cavity\n");
    expect(stdout).toContain("part.off: no problems\n");
  });

  test("lists all problems with indices and positions, as text and as JSON, and exits with 2", async () => {
    save("open.off", offFile(without(box, 1)));
    const text = await tetrafront(folder.path, ["check", "open.off"]);
    expect(text.code).toBe(2);
    expect(text.stdout.match(/error: open\.off: .* at \(/g)).toHaveLength(3);
    const { code, stdout } = await tetrafront(folder.path, ["check", "open.off", "--json"]);
    expect(code).toBe(2);
    expect(JSON.parse(stdout)).toMatchObject({
      input: "open.off",
      kind: "surface",
      errors: 3,
      inspection: { isClosed: false, openEdges: 3 },
    });
  });

  test("reports what a repair would change and which problems remain, and leaves the file unchanged", async () => {
    const file = offFile(without(box, 1));
    save("open.off", file);
    const { code, stdout } = await tetrafront(folder.path, ["check", "open.off", "--fill-holes", "3"]);
    expect(code).toBe(0);
    expect(stdout).toContain("repair: open.off: filled a hole with 1 triangle: from triangle ");
    expect(stdout).toContain("no problems");
    expect(new Uint8Array(readFileSync(inFolder("open.off")))).toEqual(new Uint8Array(file));
  });

  test("fills no hole with more edges than --fill-holes permits", async () => {
    save("open.off", offFile(without(box, 1)));
    for (const limit of ["0", "2"]) {
      const { code, stdout } = await tetrafront(folder.path, ["check", "open.off", "--fill-holes", limit]);
      expect([code, stdout]).toEqual([2, expect.stringContaining("The surface is not closed")]);
      expect(stdout).not.toContain("filled a hole");
    }
    const { code, stdout } = await tetrafront(folder.path, ["check", "open.off", "--repair"]);
    expect([code, stdout]).toEqual([0, expect.stringContaining("filled a hole with 1 triangle")]);
  });
});

describe("mesh", () => {
  test("repairs only on request and lists the changes in its report", async () => {
    save("open.off", offFile(without(box, 1)));
    const unrepaired = await tetrafront(folder.path, ["mesh", "open.off", "-o", "a.vtu"]);
    expect(unrepaired.code).toBe(2);
    const { code } = await tetrafront(folder.path, [
      ...["mesh", "open.off", "-o", "a.vtu", "--fill-holes", "3", "--report", "a.json", "-q"],
    ]);
    expect(code).toBe(0);
    expect(jsonIn("a.json")).toMatchObject({ status: "done", repair: [{ kind: "filled-hole" }] });
  });

  test("reads standard input and writes standard output", async () => {
    save("part.off", offFile(box));
    const named = await tetrafront(folder.path, ["mesh", "part.off", "-o", "part.vtk"]);
    const streamed = await tetrafront(
      folder.path,
      ["mesh", "-", "--from", "off", "-o", "-", "--to", "vtk", "-q"],
      { input: offFile(box) },
    );
    expect([named.code, streamed.code, streamed.stderr]).toEqual([0, 0, ""]);
    expect(streamed.stdout).toBe(readFileSync(inFolder("part.vtk"), "utf8"));
    const short = await tetrafront(folder.path, ["check", "-", "--format", "off"], { input: offFile(box) });
    expect(short.code).toBe(0);
    const nameless = await tetrafront(folder.path, ["mesh", "-", "-o", "a.vtu"]);
    expect(nameless.code).toBe(2);
    expect(nameless.stderr).toMatch(/the format of a stream must be given.*--format/i);
  });

  test("makes smaller elements near a source, whatever other sizes are given", async () => {
    save("part.off", offFile(boxSurface(4)));
    const counts = await Promise.all(
      [[], ["--source", "0.5,0.5,0.5,0.05,0.1"], ["--size", "0.4", "--source", "0.5,0.5,0.5,0.05,0.1"]].map(
        async (more, i) => {
          const { code } = await tetrafront(folder.path, [
            ...["mesh", "part.off", "-o", `${i}.vtu`, "--report", `${i}.json`, "-q", ...more],
            ...(more.length > 0 ? ["--surface", "refine"] : []),
          ]);
          expect(code).toBe(0);
          return (jsonIn(`${i}.json`) as MeshReport).tetrahedra;
        },
      ),
    );
    const [plain = 0, source = 0, both = 0] = counts;
    expect(source).toBeGreaterThan(2 * plain);
    expect(both).toBeGreaterThan(2 * plain);
    const { code, stderr } = await tetrafront(folder.path, [
      "mesh",
      "part.off",
      "-o",
      "a.vtu",
      "--source",
      "1,2",
    ]);
    expect([code, /invalid source "1,2"/i.test(stderr)]).toEqual([2, true]);
  });
});

describe("a batch", () => {
  test("processes a file that is named twice only once", async () => {
    save("twice.off", offFile(box));
    const file = inFolder("twice.off");
    expect(await expandInputs([file, `${folder.path}/./twice.off`, "-"])).toEqual([file, "-"]);
  });

  test("meshes the files that match a pattern, one process each, with one report for all", async () => {
    mkdirSync(inFolder("parts"));
    mkdirSync(inFolder("out"));
    save("parts/a.off", offFile(box));
    save("parts/b.stl", stlBinary(box));
    save("parts/c.off", offFile(without(box, 1)));
    const { code, stderr } = await tetrafront(folder.path, [
      ...["mesh", "parts/*.*", "-o", "out/{name}.vtu", "--jobs", "2", "--report", "all.json"],
    ]);
    expect(code).toBe(2);
    expect(stderr).toContain("3 files: 2 done, 0 not completed, 1 invalid");
    expect(jsonIn("all.json")).toMatchObject([
      { input: "parts/a.off", status: "done", output: "out/a.vtu" },
      { input: "parts/b.stl", status: "done", output: "out/b.vtu" },
      { input: "parts/c.off", status: "invalid-input", output: null },
    ]);
    expect((await meshIn("out/b.vtu")).tetrahedra.length).toBeGreaterThan(0);
  });

  test.each<[string, boolean, string, string]>([
    ["parts\\*.stl", true, "parts/", "*.stl"],
    ["C:\\CAD (x86)\\[old]\\*.stl", true, "C:/CAD (x86)/", "[old]/*.stl"],
    ["\\\\server\\parts/**\\*.off", true, "//server/parts/", "**/*.off"],
    ["*.off", true, "", "*.off"],
    ["parts (1)/*.stl", false, "parts (1)/", "*.stl"],
    ["/parts/a\\*b/{c,d}.stl", false, "/parts/", "a\\*b/{c,d}.stl"],
  ])("splits the pattern %s, on Windows: %s", (input, isWindows, plain, pattern) => {
    expect(splitPattern(input, isWindows)).toEqual({ folder: plain, pattern });
  });

  test("finds files in a folder whose name contains pattern characters", async () => {
    mkdirSync(inFolder("parts (1)"));
    save("parts (1)/a.off", offFile(box));
    for (const pattern of ["parts (1)/*.off", inFolder("parts (1)/?.off"), "*/a.{off,stl}"]) {
      const { code, stdout } = await tetrafront(folder.path, ["check", pattern]);
      expect([code, stdout.includes("a.off: closed, manifold")]).toEqual([0, true]);
    }
  });

  test("reports its files in order, however long each takes", async () => {
    save("slow.off", offFile(sphereSurface(10)));
    for (const name of ["b.off", "c.off"]) save(name, offFile(box));
    const { code, stderr } = await tetrafront(folder.path, [
      ...["mesh", "slow.off", "b.off", "c.off", "-o", "{name}.vtu", "-j", "3"],
    ]);
    expect(code).toBe(0);
    expect([...stderr.matchAll(/(\w+\.off): done/g)].map(([, name]) => name)).toEqual([
      "slow.off",
      "b.off",
      "c.off",
    ]);
  });

  test.each<[string, string[], RegExp]>([
    ["one output for several inputs", ["mesh", "a.off", "b.off", "-o", "c.vtu"], /Add \{name\} to its name/],
    ["a pattern without match", ["check", "*.ply"], /no file matches this pattern/i],
    ["an invalid number of jobs", ["check", "a.off", "b.off", "--jobs", "none"], /number of jobs is "none"/],
  ])("is rejected with %s", async (_, args, message) => {
    save("a.off", offFile(box));
    save("b.off", offFile(box));
    const { code, stderr } = await tetrafront(folder.path, args);
    expect(stderr).toMatch(message);
    expect(code).toBe(2);
  });
});

describe("convert, info and stats", () => {
  test("keep or count all elements of a volume mesh", async () => {
    save("part.off", offFile(box));
    await tetrafront(folder.path, ["mesh", "part.off", "-o", "part.vtu", "--report", "r.json", "-q"]);
    const { tetrahedra, dihedral } = jsonIn("r.json") as MeshReport;
    expect((await tetrafront(folder.path, ["convert", "part.vtu", "-o", "part.msh"])).code).toBe(0);
    const mesh = await meshIn("part.msh");
    expect(mesh.tetrahedra).toHaveLength(4 * tetrahedra);
    const info = await tetrafront(folder.path, ["info", "part.msh", "--json"]);
    expect(JSON.parse(info.stdout)).toMatchObject({ tetrahedra, box: { low: [0, 0, 0], high: [1, 2, 3] } });
    const stats = await tetrafront(folder.path, ["stats", "part.msh", "--json"]);
    const found = JSON.parse(stats.stdout) as MeshReport & { boundaryTriangles: number; isValid: boolean };
    expect(found).toMatchObject({ isValid: true, tetrahedra, boundaryTriangles: box.triangles.length / 3 });
    expect(found.dihedral.min).toBeCloseTo(dihedral.min, 9);
    expect(found.volume).toBeCloseTo(6, 12);
    const text = await tetrafront(folder.path, ["stats", "part.vtu"]);
    expect(text.stdout).toMatch(/ 60° to 65° +#+ \d+/);
  });

  test("report the format version of a file, whatever its name", async () => {
    save("part.off", offFile(box));
    await tetrafront(folder.path, ["mesh", "part.off", "-o", "old.msh2", "-q"]);
    await tetrafront(folder.path, ["mesh", "part.off", "-o", "new.msh", "-q"]);
    renameSync(inFolder("old.msh2"), inFolder("old.msh"));
    for (const [name, format] of [
      ["old.msh", "Gmsh 2.2"],
      ["new.msh", "Gmsh 4.1"],
    ] as const) {
      const { stdout } = await tetrafront(folder.path, ["info", name, "--json"]);
      expect(JSON.parse(stdout)).toMatchObject({ format });
    }
  });

  test("flip inverted elements and report them: some inverted elements are an error, all inverted are not", async () => {
    const head = "MeshVersionFormatted 2\nDimension 3\nVertices\n5\n";
    const vertices = "0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 -1 0\n";
    const mesh = (...tetrahedra: string[]) =>
      `${head}${vertices}Tetrahedra\n${tetrahedra.length}\n${tetrahedra.map((line) => `${line} 1\n`).join("")}End\n`;
    const note = /note: mixed\.mesh: 1 of 2 tetrahedra is inverted/;
    save("mixed.mesh", mesh("1 2 3 4", "1 2 3 5"));
    save("alike.mesh", mesh("2 1 3 4", "1 2 3 5"));
    expect((await tetrafront(folder.path, ["convert", "mixed.mesh", "-o", "a.vtu"])).stderr).toMatch(note);
    expect((await tetrafront(folder.path, ["convert", "alike.mesh", "-o", "b.vtu"])).stderr).not.toMatch(
      /note/,
    );
    const stats = await tetrafront(folder.path, ["stats", "mixed.mesh", "--json"]);
    expect(JSON.parse(stats.stdout)).toMatchObject({
      isValid: false,
      invertedTetrahedra: 1,
      reversedInFile: 1,
    });
    const check = await tetrafront(folder.path, ["check", "mixed.mesh"]);
    expect(check.stdout).toMatch(
      /error: mixed\.mesh: 1 tetrahedron with negative volume \(inverted\): 1 \(counted from 0\)/,
    );
    expect(check.code).toBe(2);
    const info = await tetrafront(folder.path, ["info", "mixed.mesh"]);
    expect(info.stdout).toMatch(/1 of 2 tetrahedra is inverted.*the first at \(/);
    const alike = await tetrafront(folder.path, ["check", "alike.mesh"]);
    expect(alike.stdout).toMatch(/note: alike\.mesh: the file uses the opposite node order/i);
    expect(alike.code).toBe(0);
    expect((await meshIn("a.vtu")).reversedTetrahedra).toBe(0);
  });

  test("report an invalid request in one line", async () => {
    save("part.off", offFile(box));
    const surface = await tetrafront(folder.path, ["stats", "part.off"]);
    expect([surface.code, surface.stderr.trim().split("\n").length]).toEqual([2, 1]);
    const same = await tetrafront(folder.path, ["convert", "part.off", "-o", "part.off"]);
    expect(same.code).toBe(2);
  });
});

describe("a command line is rejected before any work:", () => {
  test.each<[string, string[], RegExp]>([
    [
      "the report would replace the mesh",
      ["mesh", "a.off", "-o", "x.vtu", "-r", "./x.vtu"],
      /report would replace the mesh/,
    ],
    [
      "mesh and report on standard output",
      ["mesh", "a.off", "-o", "-", "--to", "vtu", "-r", "-"],
      /would replace the mesh/,
    ],
    [
      "the mesh would replace the input",
      ["mesh", "part.mesh", "-o", "link.mesh"],
      /mesh would replace the input/,
    ],
    [
      "the mesh would replace the background grid",
      ["mesh", "a.off", "-o", "grid.vtu", "-b", "grid.vtu"],
      /replace the background grid/,
    ],
    [
      "the output would replace a file of the input",
      ["convert", "part.face", "-o", "part.ele"],
      /output would replace the input/,
    ],
    [
      "an output would replace another output",
      ["convert", "a.off", "sub/a.off", "-o", "{name}.stl"],
      /the output of sub\/a\.off would replace the output of a\.off/i,
    ],
    [
      "an output would replace another output through a link",
      ["convert", "b.off", "c.off", "-o", "{name}.stl"],
      /the output of c\.off would replace the output of b\.off/i,
    ],
    [
      "an output would replace an input of the batch",
      ["convert", "a.off", "a.stl", "-o", "{name}.stl"],
      /output of a\.off would replace the input a\.stl/i,
    ],
    [
      "the report would replace an output of the batch",
      ["mesh", "a.off", "b.off", "-o", "{name}.vtu", "-r", "b.vtu"],
      /report would replace the output of b\.off/i,
    ],
    ["several files on one stream", ["mesh", "a.off", "-o", "-", "--format", "tetgen"], /several files/],
    ["an unknown placeholder", ["mesh", "a.off", "-o", "{foo}.vtu"], /\{foo\}.*Use \{name\}/],
    [
      "a placeholder in the name of the report",
      ["mesh", "a.off", "-o", "a.vtu", "-r", "{name}.json"],
      /one report for all/,
    ],
    ["an invalid number of jobs, with one input", ["check", "a.off", "-j", "0"], /number of jobs is "0"/],
  ])("%s", async (_, args, message) => {
    mkdirSync(inFolder("sub"));
    for (const name of ["a.off", "b.off", "c.off", "sub/a.off"]) save(name, offFile(box));
    for (const name of ["part.mesh", "part.face", "part.node", "grid.vtu", "b.stl", "a.stl"])
      save(name, "old");
    symlinkSync("b.stl", inFolder("c.stl"));
    symlinkSync("part.mesh", inFolder("link.mesh"));
    const before = contentsOf(folder.path);
    const { code, stderr, stdout } = await tetrafront(folder.path, args);
    expect(stderr).toMatch(message);
    expect([code, stdout]).toEqual([2, ""]);
    expect(contentsOf(folder.path)).toEqual(before);
  });

  const contentsOf = (root: string) =>
    readdirSync(root, { recursive: true, encoding: "utf8" })
      .filter((name) => /\.[a-z]+$/.test(name))
      .sort()
      .map((name) => [name, readFileSync(path.join(root, name), "utf8")]);
});

test("the command ends silently with code 141 if the reader of its output closes the pipe", async () => {
  save("part.off", offFile(box));
  for (const args of [
    ["info", "part.off"],
    ["check", "part.off", "--json"],
    ["mesh", "part.off", "-o", "-", "--to", "vtu", "-q"],
  ]) {
    const { code, stderr } = await tetrafront(folder.path, args, {
      started: (child) => child.stdout?.destroy(),
    });
    expect([code, stderr]).toEqual([141, ""]);
  }
});

test("the help of each command includes examples", async () => {
  for (const command of ["mesh", "check", "convert", "info", "stats", "cover", "propose"]) {
    const { code, stdout } = await tetrafront(folder.path, [command, "--help"]);
    expect(code).toBe(0);
    expect(stdout).toMatch(new RegExp(`Exit code\n[^]*Examples\n  tetrafront ${command} `));
  }
});
