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
      /1 pair of solids touches in faces that are triangulated differently/,
    ],
  ])("%s are regions with their names, by default and by check", async (_, right, note) => {
    save("two.stl", stlOf({ left, right }));
    const { code, stderr } = await run("mesh", "two.stl", "-o", "m.vtu");
    expect([code, stderr]).toEqual([0, expect.stringMatching(note)]);
    expect(await regionsOf("two.stl")).toEqual([
      { name: "left", volume: 1 },
      { name: "right", volume: 1 },
    ]);
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
  expect([code, stderr]).toEqual([0, expect.stringContaining("triangulated differently")]);
  const checked = await run("check", "left.off", "right.off", "--join");
  expect([checked.code, checked.stdout]).toEqual([0, expect.stringContaining("2 regions")]);
});
