/** `cover`, `propose`, `check` and `mesh --background` from end to end, and what is said on the way. */
import { mkdirSync, readdirSync, readFileSync } from "node:fs";
import path from "node:path";

import { readProject, writeProject, type Diagnostic, type MeshReport, type Project } from "tetrafront";
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

/** The number of tetrahedra of a mesh that is done. */
async function meshed(...args: string[]): Promise<number> {
  const { code, stdout, stderr } = await run("mesh", ...args, "--quiet", "--report", "-");
  expect([code, stderr]).toEqual([0, ""]);
  return (JSON.parse(stdout) as MeshReport).tetrahedra;
}

describe("cover", () => {
  test("puts a grid around a project that can then be meshed without a size", async () => {
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

  test.each(["cover", "propose"])(
    "%s takes over the project's one size, so that the grid counts",
    async (command) => {
      save("sized.json", writeProject({ ...bare, meshing: { size: 0.3, order: "smallest-first" } }));
      const { code, stderr } = await run(command, "sized.json", "-o", "out.json");
      expect([code, stderr]).toEqual([0, expect.stringContaining("of size 0.3, ")]);
      expect(projectIn("out.json").meshing).toEqual({ order: "smallest-first" });
      await run(command, "sized.json", "-o", "own.json", command === "cover" ? "--size" : "--uniform", "0.5");
      expect(projectIn("own.json").background.nodes.map(({ size }) => size)).toEqual(Array(8).fill(0.5));
      expect(projectIn("own.json").meshing).toEqual({ order: "smallest-first" });
    },
  );

  test("may take a single tetrahedron, and the place of its input", async () => {
    save("bare.json", writeProject(bare));
    const { code } = await run("cover", "bare.json", "-o", "bare.json", "--shape", "tetrahedron", "-q");
    expect([code, projectIn("bare.json").background.tetrahedra.length]).toEqual([0, 1]);
  });

  test.each<[string, string[], RegExp]>([
    ["a size that is none", ["bare.json", "-o", "out.json", "--size", "no"], /size is "no"\. Use /],
    ["a shape unheard of", ["bare.json", "-o", "out.json", "--shape", "ball"], /cover --help/],
    ["an output that is no project", ["bare.json", "-o", "out.vtu"], /ends in \.json/],
    ["an output in no folder", ["bare.json", "-o", "none/out.json"], /folder none does not exist/],
    [
      "a surface",
      ["cube.off", "-o", "out.json"],
      /"\.off" files cannot be read here\. Use a file whose name ends in \.json/,
    ],
    ["an empty project", ["empty.json", "-o", "out.json"], /nothing to cover/],
  ])("refuses %s", async (_, args, message) => {
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

test("propose adds sources where a model is narrow, behind those it has", async () => {
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
  const { code, stderr } = await run("propose", "thin.json", "-o", "out.json", "--uniform", "0.2");
  expect(code).toBe(0);
  expect(stderr).toMatch(/of size 0\.2, \d+ sources -> out\.json\n$/);
  const { background } = projectIn("out.json");
  const [mine, ...proposed] = background.sources ?? [];
  expect(mine?.name).toBe("mine");
  expect(proposed.length).toBeGreaterThan(0);
  expect(proposed.map(({ id }) => id)).toEqual(proposed.map((_, s) => 8 + s));
  // Three elements across a gap of a twentieth.
  for (const { size } of proposed) expect(size).toBeCloseTo(1 / 60, 6);
  expect(background.tetrahedra).toHaveLength(5);
});

describe("check", () => {
  test("finds nothing wrong with a good project", async () => {
    save("cube.json", writeProject(cubeProject()));
    expect(await run("check", "cube.json")).toEqual({
      code: 0,
      stdout: "",
      stderr: "tetrafront: cube.json: no problems\n",
    });
  });

  test("lists everything wrong, in words and as JSON", async () => {
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
    const told = await run("check", "wrong.json");
    expect([told.code, told.stdout]).toEqual([2, ""]);
    expect(told.stderr).toMatch(/error: wrong\.json: A loop of patch "front" is not closed/);
    expect(told.stderr).toMatch(/error: wrong\.json: Source 4 has the size -1/);
    expect(told.stderr).toMatch(/wrong\.json: \d+ errors/);
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

  test("leaves the grid alone where a size is given", async () => {
    save("bare.json", writeProject(bare));
    expect((await run("check", "bare.json")).stderr).toMatch(/no background grid/);
    expect(await run("check", "bare.json", "--size", "0.2")).toMatchObject({ code: 0 });
  });

  test.each([
    ["none.json", /no such file/, "unreadable-input"],
    ["text.json", /line 1: this is not JSON/i, "malformed-file"],
  ])("of %s says why it cannot be read, as JSON too", async (name, message, wanted) => {
    save("text.json", "{");
    expect((await run("check", name)).stderr).toMatch(message);
    const { code, stdout } = await run("check", name, "--json");
    expect(code).toBe(2);
    const { diagnostics } = JSON.parse(stdout) as { diagnostics: Diagnostic[] };
    expect(diagnostics).toMatchObject([{ code: wanted }]);
  });
});

describe("mesh --background", () => {
  test.each(["--quiet", "--refine-surface"])("names the grid's own file (%s)", async (option) => {
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
    expect(stderr).toMatch(/error: wrong\.json: Background node 0 \(counted from 0\) has the element size 0/);
    expect(stderr).not.toMatch(/error: box\.off/);
  });

  test.each(["vtu", "msh"])("takes a mesh in .%s with sizes from its own edges", async (extension) => {
    save("cube.json", writeProject(cubeProject(0.2)));
    save("bare.json", writeProject(bare));
    const first = await meshed("cube.json", "-o", `first.${extension}`);
    const again = await meshed("bare.json", "-o", "again.vtu", "--background", `first.${extension}`);
    expect(again / first).toBeGreaterThan(0.7);
    expect(again / first).toBeLessThan(1.4);
  });

  test("takes the grid and the sources of another project, also for a surface", async () => {
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
    ["that is not there", ["--background", "none.vtu"], /none\.vtu: There is no such file/],
    [
      "of another kind",
      ["--background", "cube.off"],
      /"\.off" files cannot be read here.*\.json, \.vtu, \.msh/,
    ],
    ["that is broken", ["--background", "broken.msh"], /broken\.msh: Line 1: the file does not begin with/],
    ["that does not cover", ["--background", "far.json"], /outside the background grid/],
    ["that tells no sizes", ["--background", "bare.json"], /bare\.json: The project has no sizes/],
  ])("%s is refused", async (_, args, message) => {
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

describe("what is said", () => {
  test("is five of a kind, then how many more", async () => {
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

  test("includes that a shell was turned round, unless it is to be quiet", async () => {
    save("turned.off", offFile(turned(sphereSurface(4))));
    const told = await run("mesh", "turned.off", "-o", "out.vtu");
    expect(told.stderr).toMatch(
      /note: turned\.off: The component of the surface with triangle 0 .*was inside out.* its \d+ triangles/,
    );
    expect((await run("mesh", "turned.off", "-o", "out.vtu", "--quiet")).stderr).toBe("");
  });

  test("of a size is the same for numbers and words, and 0x10 is no number", async () => {
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

  test("of text that is no STL is that it is none", async () => {
    save("part.stl", `OFF\n${"0 0 0\n".repeat(40)}`);
    expect((await run("mesh", "part.stl", "-o", "out.vtu")).stderr).toMatch(
      /part\.stl: Line 1: a text STL file must begin with "solid"/,
    );
  });

  test("of a place that cannot be written to comes before the mesh", async () => {
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
