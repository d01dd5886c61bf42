import { mkdirSync, readdirSync, readFileSync } from "node:fs";

import type { MeshReport, SurfaceInput } from "tetrafront";
import { writeProject } from "tetrafront/project";
import { beforeEach, describe, expect, test } from "vitest";

import {
  enclosedVolume,
  defectsOf,
  meshVolume,
  NO_DEFECTS,
  type Elements,
} from "../../support/check-mesh.js";
import { signalAtProgress, tetrafront, type CommandResult } from "../../support/command-line.js";
import { parseMsh, parseVtu } from "../../support/mesh-files.js";
import { cubeProject } from "../../support/projects.js";
import { offFile, stlBinary, stlText } from "../../support/surface-files.js";
import { boxSurface, joined, sphereSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const folder = temporaryFolder();
const { inFolder, save } = folder;

const bytesOf = (name: string) => new Uint8Array(readFileSync(inFolder(name)));
const reportIn = (name: string) => JSON.parse(readFileSync(inFolder(name), "utf8")) as MeshReport;

/** Expects one line that names the subject and the remedy, and exit code 2. */
function expectError({ code, stderr, stdout }: CommandResult, subject: string, message: RegExp): void {
  expect(stderr.trimEnd().split("\n")).toHaveLength(1);
  expect(stderr).toContain(`tetrafront: error: ${subject}: `);
  expect(stderr).toMatch(message);
  expect(stderr).toMatch(/\. [A-Z][^.]*.*\.\n$/);
  expect(stdout).toBe("");
  expect(code).toBe(2);
}

function volumeIn(name: string): Elements {
  const read = parseVtu(bytesOf(name));
  return {
    points: read.points,
    tetrahedra: Uint32Array.from(read.tetrahedra.flat()),
    tetrahedronRegion: Uint32Array.from(read.regions),
  };
}

describe("meshing", () => {
  const sphere = sphereSurface(6);
  const rounded: SurfaceInput = { ...sphere, points: Float64Array.from(new Float32Array(sphere.points)) };

  test.each<[string, Uint8Array, SurfaceInput]>([
    ["part.off", offFile(sphere), sphere],
    ["part.stl", stlBinary(sphere), rounded],
    ["PART.STL", stlText(sphere), sphere],
  ])("a surface in %s gives a valid mesh and a report", async (name, file, surface) => {
    save(name, file);
    const { code, stdout, stderr } = await tetrafront(folder.path, [
      "mesh",
      name,
      "-o",
      "out.vtu",
      "--report",
      "r.json",
    ]);
    expect([code, stdout]).toEqual([0, ""]);
    expect(stderr).toMatch(/^tetrafront: .* done, \d+ tetrahedra, .* -> out\.vtu\n$/);
    const volume = volumeIn("out.vtu");
    expect(defectsOf(volume, surface)).toEqual(NO_DEFECTS);
    expect(Math.abs(meshVolume(volume) / enclosedVolume(surface) - 1)).toBeLessThan(1e-10);
    expect(reportIn("r.json")).toMatchObject({
      status: "done",
      nodes: volume.points.length / 3,
      tetrahedra: volume.tetrahedra.length / 4,
      triangles: surface.triangles.length / 3,
      diagnostics: [],
      input: name,
      output: "out.vtu",
    });
    expect(readdirSync(folder.path).sort()).toEqual([name, "out.vtu", "r.json"].sort());
  });

  test("a project gives a Gmsh file with the names of its patches", async () => {
    save("cube.json", writeProject(cubeProject()));
    const { code } = await tetrafront(folder.path, ["mesh", "cube.json", "-o", "cube.msh", "--quiet"]);
    expect(code).toBe(0);
    const read = parseMsh(bytesOf("cube.msh"));
    expect(read.triangles.map(({ name }) => name)).toEqual([
      "bottom",
      "top",
      "front",
      "back",
      "left",
      "right",
    ]);
    expect(read.tetrahedra.map(({ name }) => name)).toEqual(["region 1"]);
  });

  test("a surface gives a Gmsh file with numbered shells and regions", async () => {
    save("two.off", offFile(joined(boxSurface(2), boxSurface(2, [3, 0, 0], [4, 1, 1]))));
    expect((await tetrafront(folder.path, ["mesh", "two.off", "-o", "two.msh", "-q"])).code).toBe(0);
    const read = parseMsh(bytesOf("two.msh"));
    expect(read.triangles.map(({ name }) => name)).toEqual(["shell 1", "shell 2"]);
    expect(read.tetrahedra.map(({ name }) => name)).toEqual(["region 1", "region 2"]);
  });

  test("prints only the report if it goes to standard output, with all statistics", async () => {
    save("cube.json", writeProject(cubeProject()));
    const args = ["mesh", "cube.json", "-o", "cube.vtu", "--size", "0.5", "--report", "-"];
    const { code, stdout } = await tetrafront(folder.path, args);
    expect(code).toBe(0);
    const report = JSON.parse(stdout) as MeshReport;
    expect(Object.keys(report.seconds).sort()).toEqual([
      "check",
      "optimize",
      "sides",
      "surface",
      "total",
      "volume",
    ]);
    expect(report.dihedral.min).toBeGreaterThan(0);
    expect(report.dihedral.max).toBeLessThan(180);
    expect(report.radiusRatio.min).toBeGreaterThan(0);
    expect(report.radiusRatio.mean).toBeLessThanOrEqual(1);
    expect(report.fingerprint).toMatch(/^[0-9a-f]{16}$/);
  });

  test("--size replaces the background grid", async () => {
    save("cube.json", writeProject(cubeProject(0.5)));
    await tetrafront(folder.path, ["mesh", "cube.json", "-o", "a.vtu", "--report", "a.json"]);
    await tetrafront(folder.path, ["mesh", "cube.json", "-o", "b.vtu", "--report", "b.json", "-s", "0.2"]);
    expect(reportIn("b.json").tetrahedra).toBeGreaterThan(4 * reportIn("a.json").tetrahedra);
  });

  test("replaces an existing output, but only by a complete mesh", async () => {
    save("cube.off", offFile(boxSurface(2)));
    save("out.vtu", "old");
    const open = { ...boxSurface(2), triangles: boxSurface(2).triangles.subarray(3) };
    save("open.off", offFile(open));
    expect((await tetrafront(folder.path, ["mesh", "open.off", "-o", "out.vtu"])).code).toBe(2);
    expect(readFileSync(inFolder("out.vtu"), "utf8")).toBe("old");
    expect((await tetrafront(folder.path, ["mesh", "cube.off", "-o", "out.vtu"])).code).toBe(0);
    expect(bytesOf("out.vtu").length).toBeGreaterThan(1000);
  });

  test("prints nothing with --quiet if there is no problem", async () => {
    save("cube.off", offFile(boxSurface(1)));
    expect(await tetrafront(folder.path, ["mesh", "cube.off", "-o", "out.vtu", "--quiet"])).toEqual({
      code: 0,
      stdout: "",
      stderr: "",
    });
  });
});

describe("an interrupt", () => {
  /** Interrupts a long run as soon as it has tetrahedra. */
  async function interrupted(...args: string[]): Promise<CommandResult> {
    save("large.off", offFile(sphereSurface(40)));
    // Lattices have no partial mesh.
    const front = ["--interior", "front"];
    const command = ["mesh", "large.off", "-o", "out.vtu", "--report", "r.json", ...front, ...args];
    return tetrafront(folder.path, command, { env: signalAtProgress("SIGINT", "program") });
  }

  test("exits with code 1, a report and no mesh", async () => {
    const { code, stderr } = await interrupted();
    expect(code).toBe(1);
    expect(reportIn("r.json").status).toBe("cancelled");
    expect(reportIn("r.json").seconds.total).toBeGreaterThan(0);
    // Without elements, there are no angles.
    expect(/dihedral/.test(stderr)).toBe(reportIn("r.json").tetrahedra > 0);
    expect(readdirSync(folder.path).sort()).toEqual(["large.off", "r.json"]);
  });

  test("leaves the partial mesh with --keep-partial", async () => {
    expect((await interrupted("--keep-partial")).code).toBe(1);
    expect(reportIn("r.json").tetrahedra).toBeGreaterThan(0);
    expect(volumeIn("out.vtu").tetrahedra.length / 4).toBe(reportIn("r.json").tetrahedra);
  });
});

describe("invalid input gives exit code 2 and one line:", () => {
  const args = (input: string, ...more: string[]) => ["mesh", input, "-o", "out.vtu", ...more];
  beforeEach(() => save("cube.off", offFile(boxSurface(1))));

  test.each<[string, string, RegExp]>([
    ["a missing file", "none.stl", /no such file/],
    ["a folder instead of a file", "folder.stl", /folder/],
    ["an empty STL file", "empty.stl", /empty/],
    ["an empty OFF file", "empty.off", /empty/],
    ["an empty project", "empty.json", /empty/],
    ["an unknown extension", "cube.dwg", /"\.dwg" files cannot be read here.*\.json, \.stl, \.off/],
    ["no extension", "cube", /no extension/],
    ["a truncated file", "short.stl", /Byte 300: the file is truncated/],
    ["text that is not JSON", "broken.json", /line 2/i],
    ["a project of a later version", "later.json", /version 7/],
    [
      "a project with an invalid reference",
      "wrong.json",
      /lines\[0\]\.points\[1\]: there is no point with the id 99/i,
    ],
  ])("%s", async (_, name, message) => {
    mkdirSync(inFolder("folder.stl"));
    for (const empty of ["empty.stl", "empty.off", "empty.json"]) save(empty, "");
    save("cube.dwg", "x");
    save("cube", "x");
    save("short.stl", stlBinary(boxSurface(1)).subarray(0, 300));
    save("broken.json", "{\n  'format': 1\n}");
    save("later.json", JSON.stringify({ format: "tetrafront-project", version: 7 }));
    const cube = cubeProject();
    const lines = cube.lines.map((line) => (line.id === 1 ? { ...line, points: [1, 99] } : line));
    save("wrong.json", writeProject({ ...cube, lines }));
    expectError(await tetrafront(folder.path, args(name, "--report", "r.json")), name, message);
    expect(reportIn("r.json")).toMatchObject({ status: "invalid-input", tetrahedra: 0, output: null });
    expect(reportIn("r.json").diagnostics.length).toBeGreaterThan(0);
  });

  test("an open surface, with the triangle and the position", async () => {
    const { points, triangles } = boxSurface(1);
    save("open.off", offFile({ points, triangles: triangles.subarray(0, triangles.length - 3) }));
    const result = await tetrafront(folder.path, args("open.off", "--quiet", "--report", "r.json"));
    expect(result.code).toBe(2);
    expect(result.stderr).toMatch(/^tetrafront: error: open\.off: .*triangle \d+.* at \(.*\)/);
    expect(reportIn("r.json").diagnostics[0]).toMatchObject({ code: "open-edge", severity: "error" });
  });

  test("a project without a grid, if --size is not given", async () => {
    save("bare.json", writeProject({ ...cubeProject(), background: { nodes: [], tetrahedra: [] } }));
    expectError(await tetrafront(folder.path, args("bare.json")), "bare.json", /no background grid.*--size/);
    expect((await tetrafront(folder.path, args("bare.json", "--size", "0.5"))).code).toBe(0);
  });

  test.each(["NaN", "0", "-1", "Infinity", "", "large", "1e", "0x"])("--size %j", async (size) => {
    const result = await tetrafront(folder.path, args("cube.off", `--size=${size}`, "--report", "r.json"));
    expect(result.code).toBe(2);
    expect(result.stderr).toMatch(/^tetrafront: error: [^\n]*\. Use [^\n]*\.\n$/);
    expect(reportIn("r.json").status).toBe("invalid-input");
  });

  test.each<[string, string[], RegExp]>([
    ["an unknown output format", ["cube.off", "-o", "out.stl"], /\.vtu or \.msh/],
    ["an output without extension", ["cube.off", "-o", "out"], /no extension/],
    ["an output in a missing folder", ["cube.off", "-o", "none/out.vtu"], /folder none does not exist/],
    ["an output that is a folder", ["cube.off", "-o", "taken.vtu"], /folder/],
    [
      "a report in a missing folder",
      ["cube.off", "-o", "out.vtu", "--report", "none/r.json"],
      /folder none does not exist/,
    ],
    [
      "a report that would replace the input",
      ["cube.off", "-o", "out.vtu", "--report", "./cube.off"],
      /replace the input/,
    ],
  ])("%s", async (_, more, message) => {
    mkdirSync(inFolder("taken.vtu"));
    const result = await tetrafront(folder.path, ["mesh", ...more]);
    expect(result).toMatchObject({ code: 2, stdout: "" });
    expect(result.stderr).toMatch(message);
    expect(result.stderr.split("\n")).toHaveLength(2);
    expect(readdirSync(folder.path).sort()).toEqual(["cube.off", "taken.vtu"]);
  });

  test.each<[string, string[]]>([
    ["no input", ["mesh", "-o", "out.vtu"]],
    ["no output", ["mesh", "cube.off"]],
    ["no input", ["mesh", "-o", "out.vtu"]],
    ["an unknown option", ["mesh", "cube.off", "-o", "out.vtu", "--fast"]],
    ["an unknown order", ["mesh", "cube.off", "-o", "out.vtu", "--order", "largest"]],
    ["an unknown optimization", ["mesh", "cube.off", "-o", "out.vtu", "--optimize", "much"]],
    ["an unknown command", ["refine", "cube.off"]],
  ])("%s", async (_, words) => {
    const result = await tetrafront(folder.path, words);
    expect(result).toMatchObject({ code: 2, stdout: "" });
    expect(result.stderr).toMatch(/^tetrafront: error: [^\n]*--help\n$/);
  });
});

test("--help of an unknown command is an error", async () => {
  const result = await tetrafront(folder.path, ["cut", "--help"]);
  expect(result).toMatchObject({ code: 2, stdout: "" });
  expect(result.stderr).toBe("tetrafront: error: unknown command 'cut'. See: tetrafront --help\n");
});

test.each([
  ["repair", "tetrafront convert IN -o OUT --repair"],
  ["refine", "--surface refine"],
  ["remsh", "remesh"],
])("the unknown command %s is answered with what does its work", async (name, words) => {
  const { code, stderr } = await tetrafront(folder.path, [name, "cube.off"]);
  expect([code, stderr.split("\n")]).toEqual([2, [expect.stringContaining(words), ""]]);
  expect(stderr).toMatch(/\(Did you mean .*\) See: tetrafront --help/);
});

test.each(["mesh", "check", "convert", "info", "stats", "cover", "propose"])(
  "--help of %s lists streams and only options that the command has",
  async (command) => {
    const { stdout } = await tetrafront(folder.path, [command, "--help"]);
    expect(stdout).toMatch(new RegExp(`^Usage: tetrafront ${command} `));
    const known = new Set(stdout.match(/^ {2}(?:-\w, )?--[a-z-]+/gm)?.map((line) => /--.*/.exec(line)?.[0]));
    const named = stdout.slice(0, stdout.indexOf("Exit code")).match(/(?<![\w-])--[a-z-]+/g) ?? [];
    for (const option of named) expect([...known, "--help"]).toContain(option);
    if (["mesh", "convert"].includes(command)) expect(stdout).toMatch(/^ {2}- +standard output/m);
    if (["check", "info", "stats"].includes(command)) expect(stdout).toMatch(/- is standard input/);
  },
);

test("--help lists the options, and --version prints the version", async () => {
  const help = await tetrafront(folder.path, ["mesh", "--help"]);
  expect(help).toMatchObject({ code: 0, stderr: "" });
  for (const word of [
    "--output",
    "--size",
    "--growth",
    "--order",
    "--no-filters",
    "--report",
    "--keep-partial",
    ".stl",
    ".msh",
  ]) {
    expect(help.stdout).toContain(word);
  }
  expect((await tetrafront(folder.path, ["--help"])).stdout).toContain("mesh");
  expect((await tetrafront(folder.path, ["--version"])).stdout).toMatch(/^\d+\.\d+\.\d+\n$/);
});
