/**
 * End-to-end tests of `cover`, `propose`, `check` and `mesh --background`, and of the messages they print.
 */
import { mkdirSync, readdirSync, readFileSync } from "node:fs";
import path from "node:path";

import type { Diagnostic, MeshReport } from "tetrafront";
import { readProject, writeProject, type Project } from "tetrafront/project";
import { describe, expect, test } from "vitest";

import { cubeProject } from "../../support/projects.js";
import { offFile } from "../../support/surface-files.js";
import { boxSurface, sphereSurface, turned } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const folder = temporaryFolder();
const { inFolder, save, run } = folder;

const bare: Project = { ...cubeProject(), background: { nodes: [], tetrahedra: [] } };

function projectIn(name: string): Project {
  const read = readProject(readFileSync(inFolder(name), "utf8"));
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

/** Meshes without messages and returns the number of tetrahedra. */
async function meshed(...args: string[]): Promise<number> {
  const { code, stdout, stderr } = await run("mesh", ...args, "--quiet", "--report", "-");
  expect([code, stderr]).toEqual([0, ""]);
  return (JSON.parse(stdout) as MeshReport).tetrahedra;
}

describe("cover", () => {
  test("adds a grid to a project, which can then be meshed without a size", async () => {
    save("bare.json", writeProject(bare));
    const { code, stderr } = await run("cover", "bare.json", "-o", "out.json", "--size", "0.3");
    expect([code, stderr]).toEqual([
      0,
      "tetrafront: bare.json: a grid of 5 tetrahedra of size 0.3, 0 sources -> out.json\n",
    ]);
    expect(readdirSync(folder.path).sort()).toEqual(["bare.json", "out.json"]);
    expect({ ...projectIn("out.json"), background: bare.background }).toEqual(bare);
    const bySize = await meshed("bare.json", "-o", "a.vtu", "--size", "0.3");
    const byGrid = await meshed("out.json", "-o", "b.vtu");
    expect(Math.abs(byGrid / bySize - 1)).toBeLessThan(0.1);
  });

  test.each(["cover", "propose"])("%s replaces the project's uniform size by the grid", async (command) => {
    save("sized.json", writeProject({ ...bare, meshing: { size: 0.3, order: "smallest-first" } }));
    const { code, stderr } = await run(command, "sized.json", "-o", "out.json");
    expect([code, stderr]).toEqual([0, expect.stringContaining("of size 0.3, ")]);
    expect(projectIn("out.json").meshing).toEqual({ order: "smallest-first" });
    await run(command, "sized.json", "-o", "own.json", command === "cover" ? "--size" : "--max-size", "0.5");
    expect(projectIn("own.json").background.nodes.map(({ size }) => size)).toEqual(Array(8).fill(0.5));
    expect(projectIn("own.json").meshing).toEqual({ order: "smallest-first" });
  });

  test("can use a single tetrahedron and overwrite its input", async () => {
    save("bare.json", writeProject(bare));
    const { code } = await run("cover", "bare.json", "-o", "bare.json", "--shape", "tetrahedron", "-q");
    expect([code, projectIn("bare.json").background.tetrahedra.length]).toEqual([0, 1]);
  });

  test.each<[string, string[], RegExp]>([
    ["a size that is not a number", ["bare.json", "-o", "out.json", "--size", "no"], /size is "no"\. Use /],
    ["an unknown shape", ["bare.json", "-o", "out.json", "--shape", "ball"], /cover --help/],
    ["an output that is not a project", ["bare.json", "-o", "out.vtu"], /ends in \.json/],
    ["an output in a missing folder", ["bare.json", "-o", "none/out.json"], /folder none does not exist/],
    [
      "a surface",
      ["cube.off", "-o", "out.json"],
      /"\.off" files cannot be read here\. Use a file whose name ends in \.json/,
    ],
    ["an empty project", ["empty.json", "-o", "out.json"], /nothing to cover/],
  ])("rejects %s", async (_, args, message) => {
    save("bare.json", writeProject(bare));
    save("empty.json", writeProject({ ...bare, points: [], lines: [], patches: [] }));
    save("cube.off", offFile(boxSurface(1)));
    const { code, stderr, stdout } = await run("cover", ...args);
    expect([code, stdout]).toEqual([2, ""]);
    expect(stderr).toMatch(message);
    expect(stderr.trimEnd().split("\n")).toHaveLength(1);
    expect(readdirSync(folder.path)).not.toContain("out.json");
  });
});

test("propose adds sources in narrow parts of a model after the existing ones", async () => {
  const thin: Project = {
    ...bare,
    points: bare.points.map((point) => ({
      ...point,
      position: [point.position[0], point.position[1], point.position[2] / 20],
    })),
    background: {
      ...bare.background,
      sources: [{ id: 7, name: "mine", type: "point", positions: [[0, 0, 0]], size: 0.2 }],
    },
  };
  save("thin.json", writeProject(thin));
  const { code, stderr } = await run("propose", "thin.json", "-o", "out.json", "--max-size", "0.2");
  expect(code).toBe(0);
  expect(stderr).toMatch(/of size 0\.2, \d+ sources -> out\.json\n$/);
  const { background } = projectIn("out.json");
  const [mine, ...proposed] = background.sources ?? [];
  expect(mine?.name).toBe("mine");
  expect(proposed.length).toBeGreaterThan(0);
  expect(proposed.map(({ id }) => id)).toEqual(proposed.map((_, s) => 8 + s));
  // Three elements across a gap of 1/20.
  for (const { size } of proposed) expect(size).toBeCloseTo(1 / 60, 6);
  expect(background.tetrahedra).toHaveLength(5);
});

describe("check", () => {
  test("reports no problems for a valid project", async () => {
    save("cube.json", writeProject(cubeProject()));
    expect(await run("check", "cube.json")).toEqual({
      code: 0,
      stdout: "cube.json: no problems\n",
      stderr: "",
    });
  });

  test("lists all problems as text and as JSON", async () => {
    const wrong: Project = {
      ...cubeProject(),
      patches: cubeProject().patches.map((patch) =>
        patch.id === 3 ? { ...patch, loops: [patch.loops[0]?.slice(1) ?? []] } : patch,
      ),
      background: {
        ...cubeProject().background,
        sources: [{ id: 4, type: "point", positions: [[0, 0, 0]], size: -1 }],
      },
    };
    save("wrong.json", writeProject(wrong));
    const printed = await run("check", "wrong.json");
    expect([printed.code, printed.stderr]).toEqual([2, ""]);
    expect(printed.stdout).toMatch(/error: wrong\.json: A loop of patch "front" is not closed/);
    expect(printed.stdout).toMatch(/error: wrong\.json: Source 4 has the size -1/);
    expect(printed.stdout).toMatch(/wrong\.json: \d+ errors/);
    const listed = await run("check", "wrong.json", "--json");
    expect([listed.code, listed.stderr]).toEqual([2, ""]);
    const { errors, diagnostics } = JSON.parse(listed.stdout) as {
      errors: number;
      diagnostics: Diagnostic[];
    };
    const codes = diagnostics.map(({ code }) => code);
    expect(codes).toEqual(expect.arrayContaining(["loop-not-closed", "source-out-of-range"]));
    expect(errors).toBe(diagnostics.filter(({ severity }) => severity === "error").length);
  });

  test("does not require a grid if a size is given", async () => {
    save("bare.json", writeProject(bare));
    expect((await run("check", "bare.json")).stdout).toMatch(/no background grid/);
    expect(await run("check", "bare.json", "--size", "0.2")).toMatchObject({ code: 0 });
  });

  test.each([
    ["none.json", /no such file/, "unreadable-input"],
    ["text.json", /line 1: this is not JSON/i, "malformed-file"],
  ])("reports why it cannot read %s, as text and as JSON", async (name, message, expectedCode) => {
    save("text.json", "{");
    expect((await run("check", name)).stderr).toMatch(message);
    const { code, stdout } = await run("check", name, "--json");
    expect(code).toBe(2);
    const { diagnostics } = JSON.parse(stdout) as { diagnostics: Diagnostic[] };
    expect(diagnostics).toMatchObject([{ code: expectedCode }]);
  });
});

describe("mesh --background", () => {
  test.each(["--quiet", "--surface=refine", "--surface=remesh"])(
    "names the file of the grid (%s)",
    async (option) => {
      const { background } = cubeProject();
      const nodes = background.nodes.map((node) => ({ ...node, size: 0 }));
      save("box.off", offFile(boxSurface(1)));
      save("wrong.json", writeProject({ ...bare, background: { ...background, nodes } }));
      const args = [
        "mesh",
        "box.off",
        "-o",
        "a.vtu",
        "--background",
        "wrong.json",
        "--report",
        "r.json",
        option,
      ];
      const { code, stderr } = await run(...args);
      expect(code).toBe(2);
      expect(stderr).toMatch(
        /error: wrong\.json: Background node 0 \(counted from 0\) has the element size 0/,
      );
      expect(stderr).not.toMatch(/error: box\.off/);
    },
  );

  test.each(["vtu", "msh"])("uses a .%s mesh with sizes derived from its edges", async (extension) => {
    save("cube.json", writeProject(cubeProject(0.2)));
    save("bare.json", writeProject(bare));
    const first = await meshed("cube.json", "-o", `first.${extension}`);
    const again = await meshed("bare.json", "-o", "again.vtu", "--background", `first.${extension}`);
    expect(again / first).toBeGreaterThan(0.7);
    expect(again / first).toBeLessThan(1.4);
  });

  test("uses the grid and the sources of another project, also for a surface", async () => {
    const sources = [
      { id: 1, type: "point", positions: [[0.5, 0.5, 0.5]], size: 0.08, distance: 0.2 },
    ] as const;
    save("grid.json", writeProject(cubeProject(0.5)));
    save("fine.json", writeProject({ ...bare, background: { ...cubeProject(0.5).background, sources } }));
    save("only.json", writeProject({ ...bare, background: { ...bare.background, sources } }));
    save("bare.json", writeProject(bare));
    save("cube.off", offFile(boxSurface(6)));
    for (const input of ["bare.json", "cube.off"]) {
      const coarse = await meshed(input, "-o", "a.vtu", "--background", "grid.json");
      const fine = await meshed(input, "-o", "b.vtu", "--background", "fine.json");
      expect(fine).toBeGreaterThan(1.3 * coarse);
    }
    const own = await meshed("cube.off", "-o", "a.vtu");
    expect(await meshed("cube.off", "-o", "b.vtu", "--background", "only.json")).toBeGreaterThan(1.3 * own);
  });

  test.each<[string, string[], RegExp]>([
    [
      "together with a size",
      ["--background", "grid.json", "--size", "0.2"],
      /--size and --background exclude each other/,
    ],
    ["if its file does not exist", ["--background", "none.vtu"], /none\.vtu: There is no such file/],
    [
      "if its file is a surface",
      ["--background", "cube.off"],
      /"\.off" files cannot be read here.*\.json, \.vtu, \.msh/,
    ],
    [
      "if its file is malformed",
      ["--background", "broken.msh"],
      /broken\.msh: Line 1: the file does not begin with/,
    ],
    ["if it does not cover the model", ["--background", "far.json"], /outside the background grid/],
    ["if its project has no sizes", ["--background", "bare.json"], /bare\.json: The project has no sizes/],
  ])("is rejected %s", async (_, args, message) => {
    save("bare.json", writeProject(bare));
    save("grid.json", writeProject(cubeProject()));
    save("cube.off", offFile(boxSurface(1)));
    save("broken.msh", "mesh");
    const nodes = cubeProject().background.nodes.map((node) => ({
      ...node,
      position: [node.position[0] + 9, node.position[1], node.position[2]] as const,
    }));
    save("far.json", writeProject({ ...bare, background: { ...cubeProject().background, nodes } }));
    const { code, stderr } = await run("mesh", "bare.json", "-o", "out.vtu", ...args);
    expect(code).toBe(2);
    expect(stderr).toMatch(message);
  });
});

describe("messages", () => {
  test("show five diagnostics per code, then the number of the others", async () => {
    const nodes = cubeProject().background.nodes.map((node) => ({ ...node, size: -1 }));
    save("cube.json", writeProject({ ...cubeProject(), background: { ...cubeProject().background, nodes } }));
    const { code, stderr } = await run("mesh", "cube.json", "-o", "out.vtu", "--report", "r.json");
    expect(code).toBe(2);
    const lines = stderr.trimEnd().split("\n");
    expect(lines.filter((line) => line.includes("has the element size -1"))).toHaveLength(5);
    expect(lines.at(-1)).toBe('tetrafront: error: cube.json: and 3 more "size-out-of-range".');
    const { diagnostics } = JSON.parse(readFileSync(inFolder("r.json"), "utf8")) as MeshReport;
    expect(diagnostics).toHaveLength(8);
  });

  test("include a note on a flipped shell, except with --quiet", async () => {
    save("turned.off", offFile(turned(sphereSurface(4))));
    const flipped = await run("mesh", "turned.off", "-o", "out.vtu");
    expect(flipped.stderr).toMatch(
      /note: turned\.off: The component of the surface with triangle 0 .*was inside out.* its \d+ triangles/,
    );
    expect((await run("mesh", "turned.off", "-o", "out.vtu", "--quiet")).stderr).toBe("");
  });

  test("quote an invalid --size value unless it is a number, and 0x10 is not a number", async () => {
    save("cube.off", offFile(boxSurface(1)));
    for (const [size, shown] of [
      ["-1", "-1"],
      ["abc", '"abc"'],
      ["0x10", '"0x10"'],
    ]) {
      const { code, stderr } = await run("mesh", "cube.off", "-o", "out.vtu", `--size=${size}`);
      expect([code, stderr]).toEqual([
        2,
        `tetrafront: error: command line: The element size is ${shown}. Use a size from 1e-30 to 1e30, in model units.\n`,
      ]);
    }
  });

  test("name the first line of a file that is not an STL file", async () => {
    save("part.stl", `OFF\n${"0 0 0\n".repeat(40)}`);
    expect((await run("mesh", "part.stl", "-o", "out.vtu")).stderr).toMatch(
      /part\.stl: Line 1: a text STL file must begin with "solid"/,
    );
  });

  test("about an output path that cannot be written appear before meshing", async () => {
    save("cube.off", offFile(boxSurface(1)));
    mkdirSync(inFolder("deep"));
    const name = `${"x".repeat(300)}.vtu`;
    const { code, stderr } = await run(
      "mesh",
      "cube.off",
      "-o",
      path.join("deep", name),
      "--report",
      "r.json",
    );
    expect(code).toBe(2);
    expect(stderr).toMatch(/cannot be written \(ENAMETOOLONG\)/);
    expect((JSON.parse(readFileSync(inFolder("r.json"), "utf8")) as MeshReport).seconds.total).toBe(0);
  });
});
