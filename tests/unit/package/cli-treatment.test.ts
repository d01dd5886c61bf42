/** What `tetrafront mesh` does with the triangles of a surface if no treatment is given. */
import { readFileSync } from "node:fs";

import { type MeshReport, readMesh } from "tetrafront";
import { expect, test } from "vitest";

import { offFile } from "../../support/surface-files.js";
import { boxSurface, needleGearSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const { save, run, inFolder } = temporaryFolder();

/** Runs `mesh` and returns its report. */
async function meshed(...more: readonly string[]) {
  return meshedFile("part.off", ...more);
}

async function meshedFile(input: string, ...more: readonly string[]) {
  const args = ["mesh", input, "-o", "part.vtu", "--report", "part.json", ...more];
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

test.each([[[]], [["--size", "0.1"]], [["--size", "10"]]])(
  "needles are replaced with the sizes %j, said in one line with how to keep them",
  async (more) => {
    save("part.off", offFile(needleGearSurface(9, 0.3)));
    const { stderr, report } = await meshed(...more);
    expect(report.remesh).toBeDefined();
    const lines = stderr.split("\n").filter((line) => line.includes("--surface"));
    expect(lines).toEqual([
      expect.stringMatching(
        /^tetrafront: note: part\.off: \d+ of 212 triangles were needles \(smallest angle [\d.]+°\), so all were replaced, as by --surface remesh\. Use --surface keep to keep them\.$/,
      ),
    ]);
    expect(codes(report)).toContain("replaced-surface");
    expect(report.dihedral.min).toBeGreaterThan(10);
    const same = await meshed(...more, "--surface", "remesh");
    expect(same.report.fingerprint).toBe(report.fingerprint);
    const kept = await meshed(...more, "--surface", "keep");
    expect(kept.report.triangles).toBe(212);
  },
);

test.each([[["--size", "0.8"]], [[]]])("other triangles are kept: %j", async (more) => {
  save("part.off", offFile(boxSurface(1)));
  const { report } = await meshed(...more);
  expect(report.triangles).toBe(12);
  expect(codes(report)).toEqual([]);
});

/** A unit cube whose region point limits the volumes, if there is one. */
const cubeFile = (points: string) => `8 3 0 0
0 0 0 0
1 1 0 0
2 0 1 0
3 1 1 0
4 0 0 1
5 1 0 1
6 0 1 1
7 1 1 1
6 0
4 0 2 3 1
4 4 5 7 6
4 0 1 5 4
4 1 3 7 5
4 3 2 6 7
4 2 0 4 6
${points}`;

test("the volume limit of a region counts as a size", async () => {
  save("part.smesh", cubeFile("0\n1\n1 .5 .5 .5 7 .001\n"));
  const { report } = await meshedFile("part.smesh");
  expect(codes(report)).toEqual(["divided-surface"]);
  expect(report.tetrahedra).toBeGreaterThan(1000);
  expect(report.dihedral.min).toBeGreaterThan(5);
  const refined = await meshedFile("part.smesh", "--surface", "refine");
  expect(refined.report.tetrahedra).toBe(report.tetrahedra);
  const remeshed = await meshedFile("part.smesh", "--surface", "remesh");
  expect(remeshed.report.tetrahedra).toBeGreaterThan(1000);
  expect(remeshed.report.dihedral.min).toBeGreaterThan(10);
});

/** Two unit cubes beside each other, with a region each; the first one has this largest volume, if any. */
const twoCubesFile = (limit: string) => {
  const corner = (x: number, y: number, z: number) => (x * 2 + y) * 2 + z;
  const xs = [0, 1, 2];
  const nodes = xs.flatMap((x) => [0, 1].flatMap((y) => [0, 1].map((z) => [corner(x, y, z), x, y, z])));
  const across = xs.map((x) => [corner(x, 0, 0), corner(x, 1, 0), corner(x, 1, 1), corner(x, 0, 1)]);
  const along = [0, 1].flatMap((x) =>
    [0, 1].flatMap((side) => [
      [corner(x, side, 0), corner(x + 1, side, 0), corner(x + 1, side, 1), corner(x, side, 1)],
      [corner(x, 0, side), corner(x + 1, 0, side), corner(x + 1, 1, side), corner(x, 1, side)],
    ]),
  );
  const facets = [...across, ...along].map((facet) => ["4", ...facet]);
  const points = ["0", "2", `1 .5 .5 .5 1 ${limit}`, "2 1.5 .5 .5 2"];
  const lines = [[nodes.length, 3, 0, 0], ...nodes, [facets.length, 0], ...facets].map((row) =>
    row.join(" "),
  );
  return [...lines, ...points, ""].join("\n");
};

test.each(["remesh", "refine"])(
  "the volume limit of a region leaves other regions alone: %s",
  async (how) => {
    const counted = async (limit: string) => {
      save("two.smesh", twoCubesFile(limit));
      const { report } = await meshedFile("two.smesh", "--surface", how, "--size", "0.2");
      const read = await readMesh(readFileSync(inFolder("part.vtu")), { fileName: "part.vtu" });
      if (!read.success) throw new Error(read.errors[0].message);
      const regions = [...read.value.tetrahedronRegion];
      const inRegion = (tag: number) =>
        regions.filter((region) => read.value.regions[region]?.tag === tag).length;
      return { limited: inRegion(1), other: inRegion(2), smallest: report.dihedral.min };
    };
    const without = await counted("");
    const limited = await counted(".0001");
    expect(limited.limited).toBeGreaterThan(10_000);
    // Elements at the interface are small, and the sizes grow from there.
    expect(limited.other).toBeLessThan(without.other + limited.limited / 8);
    expect(limited.smallest).toBeGreaterThan(15);
  },
);

test("a file that could have region points, but has none, is meshed", async () => {
  save("part.smesh", cubeFile("0\n0\n"));
  const { report } = await meshedFile("part.smesh", "--inner-shells", "cavities");
  expect(report.volume).toBeCloseTo(1, 12);
});

test("cavities and region points together are told", async () => {
  save("part.smesh", cubeFile("0\n1\n1 0.5 0.5 0.5 7 0\n"));
  const { stderr, report } = await meshedFile("part.smesh", "--inner-shells", "cavities");
  expect(stderr).toContain("--inner-shells cavities has no effect: the points of the file decide");
  expect(report.volume).toBeCloseTo(1, 12);
  expect((await meshedFile("part.smesh", "--inner-shells", "regions")).stderr).not.toContain("has no effect");
});

type Triple = readonly [number, number, number];

/** Boxes between two corners, which do not share nodes. */
const boxesBetween = (...boxes: readonly { readonly low: Triple; readonly high: Triple }[]) => {
  const { points, triangles } = boxSurface(1);
  return offFile({
    points: Float64Array.from(
      boxes.flatMap(({ low, high }) => [...points].map((x, i) => (x === 0 ? low : high)[i % 3] ?? 0)),
    ),
    triangles: Uint32Array.from(
      boxes.flatMap((_, b) => [...triangles].map((node) => node + (b * points.length) / 3)),
    ),
  });
};

/** Unit boxes that do not share nodes. */
const boxesFile = (...offsets: readonly Triple[]) =>
  boxesBetween(...offsets.map((low) => ({ low, high: [low[0] + 1, low[1] + 1, low[2] + 1] as const })));

test("bodies that become one are told, with the volume that they shared", async () => {
  save("cross.off", boxesFile([0, 0, 0], [0.5, 0.5, 0.5]));
  const { stderr } = await meshedFile("cross.off", "--repair");
  expect(stderr).toContain("2 bodies that intersect became one, without the parts inside");
  expect(stderr).toContain("0.125 in all, count once");
  // Two pairs: what each becomes counts once.
  save("pairs.off", boxesFile([0, 0, 0], [0.5, 0.5, 0.5], [3, 0, 0], [3.5, 0.5, 0.5]));
  expect((await meshedFile("pairs.off", "--repair")).stderr).toContain(
    "4 bodies that intersect became 2, without the parts inside; the volumes that they shared, 0.25 in all",
  );
  // Two plates across each axis, half as thick as they are apart: the cavity between them is another piece of the same body.
  const plates = [0, 1, 2].flatMap((axis) =>
    [0.25, 1.25].map((from) => {
      const corner = (of: (k: number) => number): Triple => [of(0), of(1), of(2)];
      return {
        low: corner((k) => (k === axis ? from : 0)),
        high: corner((k) => (k === axis ? from + 0.5 : 2)),
      };
    }),
  );
  save("plates.off", boxesBetween(...plates));
  expect((await meshedFile("plates.off", "--repair")).stderr).toContain(
    "6 bodies that intersect became one, without the parts inside; the volumes that they shared, 5 in all",
  );
  // Bodies that only touch stay two regions, and bodies apart are not repaired at all.
  save("touch.off", boxesFile([0, 0, 0], [1, 0.25, 0.25]));
  expect((await meshedFile("touch.off", "--repair")).stderr).not.toContain("became");
  save("apart.off", boxesFile([0, 0, 0], [2, 0, 0]));
  expect((await meshedFile("apart.off", "--repair")).stderr).not.toContain("became");
});

test("bodies with holes that become one are told, with the volume that they shared after they are closed", async () => {
  // Without the first two triangles of the second box: a whole side.
  const open = (...offset: readonly [number, number, number]) => {
    const { points, triangles } = boxSurface(1);
    const second = points.map((x, i) => x + (offset[i % 3] ?? 0));
    return offFile({
      points: Float64Array.from([...points, ...second]),
      triangles: Uint32Array.from([...triangles, ...triangles.subarray(6).map((n) => n + points.length / 3)]),
    });
  };
  save("cross.off", open(-0.5, 0.5, 0.5));
  const { stderr } = await meshedFile("cross.off", "--repair");
  expect(stderr).toContain("filled a hole with 2 triangles");
  expect(stderr).toContain("2 bodies that intersect became one, without the parts inside");
  expect(stderr).toContain("0.125 in all, count once");
  save("touch.off", open(-1, 0.25, 0.25));
  expect((await meshedFile("touch.off", "--repair")).stderr).not.toContain("became");
});

test("six sheets in one plane are refused with the reason: nothing is enclosed", async () => {
  const sheet = (i: number) => [0.1 * i, 0, 0, 1 + 0.1 * i, 0, 0, 1 + 0.1 * i, 1, 0, 0.1 * i, 1, 0];
  const points = Float64Array.from([0, 1, 2, 3, 4, 5].flatMap(sheet));
  const triangles = Uint32Array.from(
    [0, 1, 2, 3, 4, 5].flatMap((i) => [0, 1, 2, 0, 2, 3].map((n) => 4 * i + n)),
  );
  save("sheets.off", offFile({ points, triangles }));
  for (const args of [["--surface", "remesh"], ["--repair"]]) {
    const { code, stderr } = await run("mesh", "sheets.off", "-o", "sheets.vtu", ...args);
    expect(code).toBe(2);
    expect(stderr).toContain(
      "warning: sheets.off: The surface could not be resolved, and stays as it is: its triangles enclose no volume",
    );
    expect(stderr).toContain("Use a surface that encloses a volume");
  }
});

test("large sheets through a small box are refused with the reason: most of the area encloses nothing", async () => {
  const { points: box, triangles } = boxSurface(1);
  const sheet = (z: number) => [-30, -30, z, 31, -30, z, 31, 31, z, -30, 31, z];
  const heights = [0.3, 0.4, 0.5, 0.6];
  const first = (i: number) => box.length / 3 + 4 * i;
  const points = Float64Array.from([...box, ...heights.flatMap(sheet)]);
  const corners = heights.flatMap((_, i) => [0, 1, 2, 0, 2, 3].map((n) => first(i) + n));
  save("cut.off", offFile({ points, triangles: Uint32Array.from([...triangles, ...corners]) }));
  const { code, stderr } = await run("mesh", "cut.off", "-o", "cut.vtu", "--repair");
  expect(code).toBe(2);
  expect(stderr).toMatch(
    /stays as it is: more than half of its area encloses nothing(, for example triangle \d+.* at \(.*\))?\. Remove the triangles that enclose nothing/,
  );
});

test("sizes are proposed for a surface that is repaired first, as remesh does", async () => {
  const { points, triangles } = boxSurface(1);
  const shifted = points.map((x) => x + 0.5);
  save(
    "cross.off",
    offFile({
      points: Float64Array.from([...points, ...shifted]),
      triangles: Uint32Array.from([...triangles, ...triangles.map((n) => n + points.length / 3)]),
    }),
  );
  const { code, stdout, stderr } = await run("propose", "cross.off");
  expect(stderr).toContain("repair: cross.off: ");
  expect(code).toBe(0);
  expect(stdout).toMatch(/about \d+ triangles and \d+ tetrahedra/);
});
