/** The files of an assembly, which `tetrafront mesh --join` meshes as one model. */
import { readFileSync } from "node:fs";
import { readMesh, type SurfaceInput } from "tetrafront";
import { describe, expect, test } from "vitest";

import { sixfoldVolume } from "../../support/block-mesh.js";
import { boxSolid, stepFile } from "../../support/step-files.js";
import { offFile, smeshFile } from "../../support/surface-files.js";
import { boxSurface, joined, turned } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const { save, run, inFolder } = temporaryFolder();

/** Returns the volumes of the tetrahedra of a file, by the name of their region. */
async function tetrahedronVolumesIn(fileName: string): Promise<ReadonlyMap<string, readonly number[]>> {
  const read = await readMesh(readFileSync(inFolder(fileName)), { fileName });
  if (!read.success) throw new Error(read.errors[0].message);
  const { points, tetrahedra, tetrahedronRegion, regions } = read.value;
  const volumes = regions.map((): number[] => []);
  tetrahedronRegion.forEach((region, t) => {
    const corners = [...tetrahedra.subarray(4 * t, 4 * t + 4)];
    volumes[region]?.push(Math.abs(sixfoldVolume(points, corners)) / 6);
  });
  return new Map(regions.map(({ name }, region) => [name, volumes[region] ?? []]));
}

describe("files of an assembly", () => {
  const parts = {
    base: boxSolid("base", [0, 0, 0], [6, 4, 1]),
    left: boxSolid("left", [0, 0, 1], [1, 4, 4]),
    right: boxSolid("right", [5, 0, 1], [6, 4, 4]),
    lid: boxSolid("lid", [0, 0, 4], [6, 4, 5]),
    // Names in files need not differ.
    post: boxSolid("base", [2, 1, 1], [4, 3, 4]),
  };

  test("are one mesh with named regions and interfaces by --join", async () => {
    for (const [name, solid] of Object.entries(parts)) save(`${name}.step`, stepFile([solid]));
    const files = Object.keys(parts).map((name) => `${name}.step`);
    const { code, stderr } = await run(
      "mesh",
      ...files,
      "--join",
      "-o",
      "assembly.msh",
      "--report",
      "r.json",
    );
    expect([code, stderr]).toEqual([0, expect.not.stringContaining("error")]);
    const read = await readMesh(readFileSync(inFolder("assembly.msh")), { fileName: "assembly.msh" });
    if (!read.success) throw new Error(read.errors[0].message);
    expect(read.value.regions.map(({ name }) => name)).toEqual(["base", "left", "right", "lid", "base 2"]);
    const interfaces = read.value.patches.map(({ name }) => name).filter((name) => name.includes(" / "));
    for (const pair of ["base / left", "base / right", "base / base 2", "left / lid", "right / lid"]) {
      expect(interfaces).toContain(pair);
    }
    const report = JSON.parse(readFileSync(inFolder("r.json"), "utf8")) as { volume: number; status: string };
    expect([report.status, report.volume]).toEqual(["done", expect.closeTo(24 + 24 + 24 + 12, 6)]);
    const tets = read.value.tetrahedra;
    const faces = new Map<string, number>();
    for (let t = 0; t < tets.length; t += 4) {
      for (let k = 0; k < 4; k++) {
        const key = [0, 1, 2, 3]
          .flatMap((i) => (i === k ? [] : (tets[t + i] ?? 0)))
          .sort((a, b) => a - b)
          .join();
        faces.set(key, (faces.get(key) ?? 0) + 1);
      }
    }
    expect(Math.max(...faces.values())).toBe(2);
  });

  test("need one unit, and are no projects", async () => {
    save("a.step", stepFile([parts.base]));
    save("b.off", offFile(boxSurface(1)));
    const mixed = await run("mesh", "a.step", "b.off", "--join", "-o", "x.vtu");
    expect([mixed.code, mixed.stderr]).toEqual([
      2,
      expect.stringContaining("The unit of the file is unknown, but that of the first file is mm"),
    ]);
    const named = await run("mesh", "a.step", "b.off", "--join", "-o", "{name}.vtu");
    expect([named.code, named.stderr]).toEqual([2, expect.stringContaining("Joined inputs have one output")]);
    const over = await run("mesh", "a.step", "b.off", "--join", "-o", "b.off");
    expect(over.code).toBe(2);
    const report = await run("mesh", "a.step", "b.off", "--join", "-o", "x.vtu", "--report", "b.off");
    expect([report.code, report.stderr]).toEqual([
      2,
      expect.stringContaining("The report would replace the input b.off"),
    ]);
    expect(readFileSync(inFolder("b.off"), "utf8")).toMatch(/^OFF/);
  });

  test("keep the holes and regions that points of their files mark", async () => {
    // A box with a void, which a hole point marks; and a box in the void, whose region has a largest volume.
    const outer = boxSurface(2);
    const inner = boxSurface(1, [0.25, 0.25, 0.25], [0.5, 0.5, 0.5]);
    save("shell.smesh", smeshFile(joined(outer, inner), "1\n1 0.3 0.3 0.3\n0\n"));
    save("core.smesh", smeshFile(inner, "0\n1\n1 0.3 0.3 0.3 7 0.0005\n"));
    const args = ["mesh", "shell.smesh", "core.smesh", "--join", "-o", "joined.msh", "--report", "r.json"];
    const { code, stderr } = await run(...args);
    expect([code, stderr]).toEqual([0, expect.not.stringContaining("error")]);
    const volumes = await tetrahedronVolumesIn("joined.msh");
    expect([...volumes.keys()]).toEqual(["shell", "core"]);
    const sum = (all: readonly number[]) => all.reduce((total, volume) => total + volume, 0);
    expect([...volumes.values()].map(sum)).toEqual([
      expect.closeTo(1 - 1 / 64, 9),
      expect.closeTo(1 / 64, 9),
    ]);
    expect(Math.max(...(volumes.get("core") ?? []))).toBeLessThanOrEqual(0.0005);
  });
});

describe("solids of joined files", () => {
  const left = offFile(boxSurface(2));
  const volumeIn = (name: string) =>
    (JSON.parse(readFileSync(inFolder(name), "utf8")) as { volume: number }).volume;
  const regionVolumesIn = (name: string) => {
    const report = JSON.parse(readFileSync(inFolder(name), "utf8")) as {
      quality: { regions: { volume: number }[] };
    };
    return report.quality.regions.map(({ volume }) => volume);
  };

  test("that share faces are named, and all files with them", async () => {
    save("left.off", left);
    save("right.off", offFile(boxSurface(2, [1, 0, 0], [2, 1, 1])));
    const { code, stderr } = await run("mesh", "left.off", "right.off", "--join", "-o", "a.vtu");
    expect([code, stderr]).toEqual([
      0,
      expect.stringContaining('note: left.off + right.off: 2 solids; shared faces: "left" and "right"'),
    ]);
    expect(stderr).toContain("left.off + right.off: done, ");
    save("right.off", offFile(boxSurface(2, [2, 0, 0], [3, 1, 1])));
    const apart = await run("check", "left.off", "right.off", "--join");
    expect([apart.code, apart.stdout]).toEqual([0, expect.stringContaining("none of them share faces")]);
    expect(apart.stdout).not.toContain("almost touch");
  });

  test("that almost touch are told, and joined by the weld of the remedy", async () => {
    save("left.off", left);
    save("right.off", offFile(boxSurface(2, [1.0001, 0, 0], [2, 1, 1])));
    const inputs = ["left.off", "right.off", "--join"];
    const checked = await run("check", ...inputs);
    expect(checked.stdout).toMatch(/warning: .*"left" and "right" almost touch: a gap of 0\.0001 /);
    const weld = /Use (--weld) (\S+)/.exec(checked.stdout)?.slice(1) ?? [];
    const { code, stderr } = await run("mesh", ...inputs, "-o", "a.vtu", "--report", "r.json", ...weld);
    expect([code, stderr]).toEqual([0, expect.stringContaining('shared faces: "left" and "right"')]);
    expect(stderr).not.toContain("almost touch");
  });

  test("that overlap are an error if triangles are kept; else both regions stay", async () => {
    save("left.off", left);
    save("right.off", offFile(boxSurface(2, [0.99, 0, 0], [1.99, 1, 1])));
    const args = ["mesh", "left.off", "right.off", "--join", "-o", "a.vtu", "--report", "r.json"];
    const refused = await run(...args, "--surface", "keep");
    expect([refused.code, refused.stderr.split("\n")]).toEqual([
      2,
      [
        expect.stringMatching(
          /left\.off \+ right\.off: The solids "left" and "right" overlap, .*--surface remesh/,
        ),
        "",
      ],
    ]);
    const { code, stderr } = await run(...args);
    expect([code, stderr]).toEqual([
      0,
      expect.stringMatching(
        /overlap by a volume of 0\.01, 1 % of the smaller one, about 0\.0098 deep\. It became a part of "left"; both/,
      ),
    ]);
    expect(stderr).not.toContain("not meshed");
    expect(volumeIn("r.json")).toBeCloseTo(1.99, 4);
    expect(regionVolumesIn("r.json")).toEqual([expect.closeTo(1, 4), expect.closeTo(0.99, 4)]);
  });

  describe.each([
    ["outward", (surface: SurfaceInput) => surface],
    ["inward", turned],
  ])("one of which has a hole and faces %s", (_, facing) => {
    const { points, triangles } = boxSurface(4);
    const open = facing({ points, triangles: triangles.subarray(9) });
    const args = ["--join", "-o", "a.msh", "--report", "r.json", "--surface", "remesh"];

    test.each([
      ["lie apart", [1.5, 0, 0], 0],
      ["touch in a whole face", [1, 0, 0], 0],
      ["touch in a part of a face", [1, 0.125, 0.125], 0],
      ["overlap", [0.8, 0.125, 0.125], 0.2 * 0.75 ** 2],
    ] as const)("keep both regions if they %s", async (_, [x, low, lowToo], shared) => {
      const other = boxSurface(4, [x, low, lowToo], [x + 1, 1 - low, 1 - lowToo]);
      save("open.off", offFile(open));
      save("other.off", offFile(other));
      const { code, stderr } = await run("mesh", "open.off", "other.off", ...args);
      expect([code, stderr]).toEqual([0, expect.stringContaining('not closed: "open"')]);
      expect(stderr).not.toContain("not meshed");
      expect(regionVolumesIn("r.json")).toEqual([
        expect.closeTo(1, 3),
        expect.closeTo((1 - 2 * low) ** 2 - shared, 3),
      ]);
    });

    test("keep the largest volumes of regions", async () => {
      const core = boxSurface(1, [1.5, 0, 0], [2, 0.5, 0.5]);
      save("open.off", offFile(open));
      save("core.smesh", smeshFile(core, "0\n1\n1 1.6 0.1 0.1 7 0.0005\n"));
      const { code, stderr } = await run("mesh", "open.off", "core.smesh", ...args);
      expect([code, stderr]).toEqual([0, expect.not.stringContaining("largest volumes")]);
      const volumes = await tetrahedronVolumesIn("a.msh");
      expect(Math.max(...(volumes.get("core") ?? []))).toBeLessThanOrEqual(0.0005);
    });
  });

  test("leave a closed gap between them empty, and do not make a region of it", async () => {
    // The middle node of the face is moved away from the other solid, or into it.
    const withMiddleAt = (n: number, x: number) => {
      const surface = boxSurface(n, [1, 0, 0], [2, 1, 1]);
      const { points } = surface;
      for (let i = 0; i < points.length; i += 3) {
        const isInside = [points[i + 1] ?? 0, points[i + 2] ?? 0].every((y) => y > 0 && y < 1);
        if (points[i] === 1 && isInside) points[i] = x;
      }
      return offFile(surface);
    };
    save("left.off", left);
    save("right.off", withMiddleAt(2, 1.05));
    const args = ["left.off", "right.off", "--join", "-o", "a.msh"];
    const report = ["--report", "r.json"];
    const gap = await run("mesh", ...args, ...report);
    expect([gap.code, gap.stderr]).toEqual([
      0,
      expect.stringMatching(/Between the solids "left", "right" is a closed gap with a volume of 0\.0/),
    ]);
    const regionsIn = async () => {
      const read = await readMesh(readFileSync(inFolder("a.msh")), { fileName: "a.msh" });
      return read.success ? read.value.regions.map(({ name }) => name) : [];
    };
    expect(await regionsIn()).toEqual(["left", "right"]);
    // Triangulated differently, the solids are cut along each other first.
    save("right.off", withMiddleAt(3, 1.05));
    const cut = await run("mesh", ...args, ...report, "--surface", "remesh");
    expect([cut.code, cut.stderr]).toEqual([0, expect.stringContaining("is a closed gap")]);
    expect(await regionsIn()).toEqual(["left", "right"]);
    save("right.off", withMiddleAt(2, 0.95));
    const shared = await run("mesh", ...args, ...report);
    expect([shared.code, shared.stderr]).toEqual([
      0,
      expect.stringContaining("It counts once, as a part of one of them"),
    ]);
    expect(volumeIn("r.json")).toBeCloseTo(2, 9);
  });
});
