/** Solids that are patches of one file, and touch. */
import { readFileSync } from "node:fs";
import type { SurfaceInput } from "tetrafront";
import { describe, expect, test } from "vitest";
import { offFile } from "../../support/surface-files.js";
import { boxSurface, turned } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const { save, run, inFolder } = temporaryFolder();

/** The solids of an STL file as text, one after the other. */
function stlOf(solids: Readonly<Record<string, SurfaceInput>>): string {
  return Object.entries(solids)
    .map(([name, { points, triangles }]) => {
      const corner = (node: number) => `vertex ${points.subarray(3 * node, 3 * node + 3).join(" ")}`;
      const facets = Array.from({ length: triangles.length / 3 }, (_, t) => {
        const corners = [...triangles.subarray(3 * t, 3 * t + 3)].map(corner);
        return `facet normal 0 0 0\nouter loop\n${corners.join("\n")}\nendloop\nendfacet`;
      });
      return `solid ${name}\n${facets.join("\n")}\nendsolid ${name}\n`;
    })
    .join("");
}

interface Region {
  readonly name: string;
  readonly volume: number;
}

async function regionsOf(name: string, ...options: string[]): Promise<readonly Region[]> {
  const { code, stderr } = await run("mesh", name, "-o", "m.vtu", "--report", "r.json", ...options);
  expect([code, stderr]).toEqual([0, expect.any(String)]);
  const { regions } = JSON.parse(readFileSync(inFolder("r.json"), "utf8")) as {
    readonly regions: readonly Region[];
  };
  return regions.map(({ name: region, volume }) => ({ name: region, volume: Number(volume.toFixed(6)) }));
}

const left = boxSurface(2);
const matching = boxSurface(2, [1, 0, 0], [2, 1, 1]);
const other = boxSurface(3, [1, 0, 0], [2, 1, 1]);

describe("solids of one STL file", () => {
  test.each([
    ["whose faces match", matching, /2 solids; shared faces: "left" and "right"/],
    [
      "whose faces do not match",
      other,
      /triangles of 1 pair of solids that touch or overlap do not fit together/,
    ],
  ])("%s are regions with their names, by default and by check", async (_, right, note) => {
    save("two.stl", stlOf({ left, right }));
    const { code, stderr } = await run("mesh", "two.stl", "-o", "m.vtu");
    expect([code, stderr]).toEqual([0, expect.stringMatching(note)]);
    expect(await regionsOf("two.stl")).toEqual([
      { name: "left", volume: 1 },
      { name: "right", volume: 1 },
    ]);
    expect(await regionsOf("two.stl", "--inner-shells", "cavities")).toHaveLength(2);
    const checked = await run("check", "two.stl");
    expect([checked.code, checked.stdout]).toEqual([0, expect.stringContaining("2 regions")]);
  });

  test("keep their triangles if their faces match", async () => {
    save("two.stl", stlOf({ left, right: matching }));
    expect(await regionsOf("two.stl", "--surface", "keep")).toHaveLength(2);
    const { triangles } = JSON.parse(readFileSync(inFolder("r.json"), "utf8")) as {
      readonly triangles: number;
    };
    // 48 triangles each; the 8 of the common face count once.
    expect(triangles).toBe(48 + 48 - 8);
  });

  test("that touch from within are regions too", async () => {
    save(
      "in.stl",
      stlOf({ outer: boxSurface(4, [0, 0, 0], [4, 4, 4]), inner: boxSurface(1, [1, 1, 0], [2, 2, 1]) }),
    );
    expect(await regionsOf("in.stl")).toEqual([
      { name: "outer", volume: 63 },
      { name: "inner", volume: 1 },
    ]);
  });

  test("that face inward are no solids", async () => {
    save(
      "hole.stl",
      stlOf({
        outer: boxSurface(4, [0, 0, 0], [4, 4, 4]),
        hole: turned(boxSurface(1, [1, 1, 1], [2, 2, 2])),
      }),
    );
    expect((await regionsOf("hole.stl")).map(({ volume }) => volume)).toEqual([63]);
  });
});

test("files that do not match are joined without an option", async () => {
  save("left.off", offFile(left));
  save("right.off", offFile(other));
  const { code, stderr } = await run(
    "mesh",
    "left.off",
    "right.off",
    "--join",
    "-o",
    "m.vtu",
    "--report",
    "r.json",
  );
  expect([code, stderr]).toEqual([0, expect.stringContaining("do not fit together")]);
  const checked = await run("check", "left.off", "right.off", "--join");
  expect([checked.code, checked.stdout]).toEqual([0, expect.stringContaining("2 regions")]);
});

/** A box with edges of `sides` parts between two corners. */
const box = (low: readonly number[], high: readonly number[], sides = 1): SurfaceInput =>
  boxSurface(sides, low as [number, number, number], high as [number, number, number]);

describe("solids of one STL file inside others", () => {
  const outer = box([0, 0, 0], [4, 4, 4]);
  const inner = box([1, 1, 1], [2, 2, 2]);
  const plug = box([1, 1, 0], [3, 3, 2]);
  const touching = box([4, 0, 0], [6, 4, 4]);
  const overlapping = box([3.5, 1, 1], [5, 3, 3]);

  test.each<readonly [string, Readonly<Record<string, SurfaceInput>>, Readonly<Record<string, number>>]>([
    [
      "keep their names beside solids that touch",
      { outer, touching, inner },
      { outer: 63, touching: 32, inner: 1 },
    ],
    [
      "keep their names beside solids that overlap",
      { inner, overlapping, outer },
      { inner: 1, overlapping: 6, outer: 61 },
    ],
    ["and flush with a face stay regions", { outer, plug }, { outer: 56, plug: 8 }],
    ["and flush with a face stay regions in any order", { plug, outer }, { plug: 8, outer: 56 }],
    [
      "and each flush with a face of the next stay regions",
      { outer, plug, core: box([1.5, 1.5, 0], [2.5, 2.5, 1]) },
      { outer: 56, plug: 7, core: 1 },
    ],
    [
      "that touch along an edge keep their names",
      { left, right: box([1, 1, 0], [2, 2, 1], 2) },
      { left: 1, right: 1 },
    ],
  ])("%s", async (_, solids, volumes) => {
    save("nested.stl", stlOf(solids));
    const found = await regionsOf("nested.stl");
    expect(Object.fromEntries(found.map(({ name, volume }) => [name, volume]))).toEqual(volumes);
    const { stderr } = await run("mesh", "nested.stl", "-o", "m.vtu");
    expect(stderr.includes("overlap by")).toBe("overlapping" in solids);
    expect(stderr).not.toContain("not meshed");
  });

  test("leave a void of a solid empty that others overlap", async () => {
    const { points, triangles } = turned(inner);
    const corners = Uint32Array.from(triangles, (node) => node + outer.points.length / 3);
    const holed = {
      points: Float64Array.of(...outer.points, ...points),
      triangles: Uint32Array.of(...outer.triangles, ...corners),
    };
    save("void.stl", stlOf({ holed, overlapping }));
    expect(await regionsOf("void.stl")).toEqual([
      { name: "holed", volume: 63 },
      { name: "overlapping", volume: 4 },
    ]);
  });
});
