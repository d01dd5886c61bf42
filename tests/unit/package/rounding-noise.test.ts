/** Surfaces without topology whose nodes differ by rounding. */
import { readFileSync } from "node:fs";
import { createMesher, readSurface, type Mesh, type SurfaceInput } from "tetrafront";
import { describe, expect, test } from "vitest";

import { randomSource } from "../../support/random.js";
import { offFile, stlBinary } from "../../support/surface-files.js";
import { boxSurface, joined, sphereSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

async function surfaceIn(bytes: Uint8Array, fileName: string): Promise<Mesh> {
  const read = await readSurface(bytes, { fileName });
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

/** The corners of each triangle as nodes of their own, moved by `noise`. */
function soupOf(
  { points, triangles }: SurfaceInput,
  noise: (x: number, axis: number) => number,
): SurfaceInput {
  return {
    points: Float64Array.from({ length: 3 * triangles.length }, (_, i) => {
      const axis = i % 3;
      return noise(points[3 * (triangles[(i - axis) / 3] ?? 0) + axis] ?? 0, axis);
    }),
    triangles: Uint32Array.from(triangles.keys()),
  };
}

describe("closed parts with a common face", () => {
  /** Two boxes side by side, of which the second one is moved by `gap`. */
  const boxes = (gap: number, at = 2): SurfaceInput =>
    joined(boxSurface(2, [0, 0, 0], [at, 1, 1]), boxSurface(2, [at + gap, 0, 0], [2 * at, 1, 1]));

  test.each([1e-7, -1e-7, 4e-16])(
    "are welded there if they are %d apart, and become two regions",
    async (gap) => {
      const read = await surfaceIn(stlText(soupOf(boxes(gap), (x) => x)), "boxes.stl");
      expect(read.points.length / 3).toBe(2 * 26 - 9);
      expect(read.notes).toEqual([expect.stringMatching(/^9 nodes were welded/)]);
      const mesher = await createMesher();
      const { report, mesh } = await mesher.meshSurface(read);
      expect(report.status).toBe("done");
      expect(report.regions.map(({ volume }) => volume)).toEqual([
        expect.closeTo(2, 6),
        expect.closeTo(2, 6),
      ]);
      expect(mesh.points.length / 3).toBe(report.nodes);
      mesher.dispose();
    },
  );

  test("stay apart if the space between them is more than rounding, or they have no face in common", async () => {
    for (const surface of [boxes(1e-4), joined(boxSurface(2), boxSurface(3, [1 + 1e-7, 0, 0], [2, 1, 1]))]) {
      const read = await surfaceIn(stlText(soupOf(surface, (x) => x)), "boxes.stl");
      expect(read.points).toHaveLength(surface.points.length);
    }
  });
});

/** The number of single precision that is `steps` after x. */
function stepped(x: number, steps: number): number {
  const float = Float32Array.of(x);
  const bits = new Int32Array(float.buffer);
  if (Math.abs(x) > 1e-30) bits[0] = (bits[0] ?? 0) + steps;
  return float[0] ?? 0;
}

const encoded = (text: string) => new TextEncoder().encode(text);

function stlText({ points, triangles }: SurfaceInput, format: (x: number) => string = String): Uint8Array {
  const corner = (node: number) =>
    [...points.subarray(3 * node, 3 * node + 3)].map((x) => format(x)).join(" ");
  const facets = Array.from({ length: triangles.length / 3 }, (_, t) => {
    const corners = [...triangles.subarray(3 * t, 3 * t + 3)].map((node) => `vertex ${corner(node)}`);
    return `facet normal 0 0 0 outer loop ${corners.join(" ")} endloop endfacet\n`;
  });
  return encoded(`solid part\n${facets.join("")}endsolid part\n`);
}

/** Number of edges with one triangle, counted by text. */
function openEdgesOf({ triangles }: SurfaceInput): number {
  const uses = new Map<string, number>();
  for (let t = 0; t < triangles.length; t += 3) {
    for (const [a, b] of [
      [0, 1],
      [1, 2],
      [2, 0],
    ] as const) {
      const key = [triangles[t + a], triangles[t + b]].sort().join();
      uses.set(key, (uses.get(key) ?? 0) + 1);
    }
  }
  return [...uses.values()].filter((count) => count === 1).length;
}

const ROUNDING = /^\d+ nodes? w(as|ere) welded to .* only by rounding, by at most [\d.e-]+$/;

const volumeOf = async (surface: SurfaceInput) => {
  const mesher = await createMesher();
  try {
    return (await mesher.inspectSurface(surface)).volume;
  } finally {
    mesher.dispose();
  }
};

describe("noise of rounding", () => {
  test.each([
    ["two triangles at -2.7e-16", (x: number, t: number) => (x === 0 && t < 2 ? -2.7e-16 : x)],
    [
      "every third triangle at 1e-17 to 1e-15",
      (x: number, t: number) => (x === 0 && t % 3 === 0 ? 10 ** -(15 + (t % 4)) : x),
    ],
  ])("around zero is welded to zero: %s", async (_, noisy) => {
    const box = boxSurface(1);
    let corner = 0;
    const soup = soupOf(box, (x) => noisy(x, Math.floor(corner++ / 9)));
    for (const [name, bytes] of [
      ["a.stl", stlBinary(soup)],
      ["b.stl", stlText(soup)],
      ["c.off", offFile(soup)],
    ] as const) {
      const read = await surfaceIn(bytes, name);
      expect([read.points.length / 3, openEdgesOf(read)], name).toEqual([8, 0]);
      expect(new Set(read.points), name).toEqual(new Set([0, 1]));
      expect(read.notes, name).toEqual([expect.stringMatching(ROUNDING)]);
      expect(await volumeOf(read), name).toBe(1);
    }
  });

  test.each([
    ["near the origin", [0.5, 0.7, 0.6], String],
    ["in one direction far away", [1e5, 0.5, -3], String],
    ["far away", [123456, -98765, 45678], String],
    ["far away, with six decimals", [123456, -98765, 45678], (x: number) => x.toFixed(6)],
    ["with nine digits", [12, -7, 40], (x: number) => x.toPrecision(9)],
  ] as const)("of two units in the last place is welded %s", async (_, center, format) => {
    const sphere = sphereSurface(6, 100, [...center]);
    const random = randomSource(5);
    const soup = soupOf(sphere, (x) => stepped(x, (random() % 5) - 2));
    for (const bytes of [stlText(soup, format), ...(format === String ? [stlBinary(soup)] : [])]) {
      const read = await surfaceIn(bytes, "sphere.stl");
      expect([read.points.length, openEdgesOf(read)]).toEqual([sphere.points.length, 0]);
      expect(read.notes).toEqual([expect.stringMatching(ROUNDING)]);
    }
  });

  test("is welded in the same way in any order of the triangles", async () => {
    const random = randomSource(8);
    const soup = soupOf(sphereSurface(5, 1, [3, 4, 5]), (x) => stepped(x, (random() % 5) - 2));
    const order = Array.from({ length: soup.triangles.length / 3 }, (_, t) => t);
    const positionsIn = ({ points }: SurfaceInput) =>
      Array.from({ length: points.length / 3 }, (_, p) => points.slice(3 * p, 3 * p + 3).join()).sort();
    const first = positionsIn(await surfaceIn(stlBinary(soup), "a.stl"));
    for (let round = 0; round < 5; round++) {
      const shuffled = order
        .map((t) => ({ t, key: random() }))
        .sort((a, b) => a.key - b.key)
        .map(({ t }) => t);
      const triangles = Uint32Array.from(shuffled.flatMap((t) => [3 * t + 1, 3 * t + 2, 3 * t]));
      expect(positionsIn(await surfaceIn(stlBinary({ ...soup, triangles }), "a.stl"))).toEqual(first);
    }
  });

  test("is welded in soups of quadrilaterals", async () => {
    const faces = [
      [0, 0, 0, 0, 1, 0, 1, 1, 0, 1, 0, 0],
      [0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1],
      [0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1],
      [1, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1],
      [1, 1, 0, 0, 1, 0, 0, 1, 1, 1, 1, 1],
      [0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 1, 1],
    ];
    const rows = faces.flatMap((face, f) =>
      [0, 3, 6, 9].map(
        (at) =>
          `v ${face
            .slice(at, at + 3)
            .map((x) => x + f * 1e-17 + (x === 1 ? f * 2e-16 : 0))
            .join(" ")}`,
      ),
    );
    const quads = faces.map((_, f) => `f ${[1, 2, 3, 4].map((corner) => 4 * f + corner).join(" ")}`);
    const read = await surfaceIn(encoded([...rows, ...quads, ""].join("\n")), "cube.obj");
    expect([read.points.length / 3, openEdgesOf(read)]).toEqual([8, 0]);
  });
});

describe("nodes that are not noise", () => {
  test("stay apart in a closed surface, however near they are", async () => {
    // A needle-thin box far from the origin: its nodes are one unit in the last place of single precision apart.
    const wide = boxSurface(2, [1e6, 0, 0], [1e6 + 1, 1, 1]);
    const thin = boxSurface(1, [1e6, 2, 0], [stepped(1e6, 1), 3, 1]);
    const read = await surfaceIn(stlBinary(soupOf(joined(wide, thin), (x) => x)), "two.stl");
    expect(read.points.length / 3).toBe(wide.points.length / 3 + 8);
    expect(read.notes).toBeUndefined();
  });

  test("stay apart around a hole: no triangle is lost", async () => {
    const small = boxSurface(3, [0, 0, 0], [1e-7, 1e-7, 1e-7]);
    const all = joined(boxSurface(1, [0, 0, 1], [1, 1, 2]), small);
    const open = { points: all.points, triangles: all.triangles.slice(0, -3) };
    const read = await surfaceIn(stlText(soupOf(open, (x) => x)), "hole.stl");
    expect(read.triangles.length).toBe(open.triangles.length);
    for (let t = 0; t < read.triangles.length; t += 3) {
      expect(new Set(read.triangles.subarray(t, t + 3)).size).toBe(3);
    }
  });

  test("stay apart in files whose triangles share nodes", async () => {
    const { points, triangles } = boxSurface(2);
    const crack = triangles.slice();
    const copied = crack[0] ?? 0;
    crack[0] = points.length / 3;
    const moved = [...points.subarray(3 * copied, 3 * copied + 3)].map((x) => x + 1e-16);
    const cracked = { points: Float64Array.from([...points, ...moved]), triangles: crack };
    const read = await surfaceIn(offFile(cracked), "crack.off");
    expect([read.points.length, read.notes]).toEqual([cracked.points.length, undefined]);
  });

  test("stay apart beyond rounding", async () => {
    let corner = 0;
    const soup = soupOf(boxSurface(1), (x) => (corner++ < 18 ? x + 1e-4 : x));
    const read = await surfaceIn(stlBinary(soup), "box.stl");
    expect([read.points.length / 3, read.notes]).toEqual([12, undefined]);
  });
});

describe("the command line", () => {
  const { save, run, inFolder } = temporaryFolder();

  test("meshes a cube with noise, and says what was welded", async () => {
    let corner = 0;
    const soup = soupOf(boxSurface(1), (x) => (corner++ < 18 && x === 0 ? -2.7e-16 : x));
    save("cube.stl", stlBinary(soup));
    const { code, stderr } = await run("mesh", "cube.stl", "-o", "cube.vtu");
    expect([code, stderr]).toEqual([0, expect.stringContaining("cube.stl: done")]);
    expect(stderr).toMatch(/note: cube\.stl: 4 nodes were welded to others .* by at most \d\.\de-16/);
    const checked = await run("check", "cube.stl");
    expect([checked.code, checked.stdout]).toEqual([
      0,
      expect.stringMatching(/note: cube\.stl: 4 nodes were welded/),
    ]);
  });

  test.each([1e-6, 2e-5, 3e-4])(
    "check names nodes %d apart, and the distance with which they are welded",
    async (noise) => {
      const random = randomSource(3);
      const box = boxSurface(3);
      const soup = soupOf(box, (x) => x + noise * ((random() % 1000) / 1000 - 0.5));
      save("noisy.stl", stlText(soup));
      const { code, stdout } = await run("check", "noisy.stl");
      // The mesh welds them by itself.
      expect(code).toBe(0);
      expect(stdout).toMatch(
        /note: noisy\.stl: \d+ pairs of nodes nearly coincide, at most [\d.e-]+ apart: surface node \d+ and surface node \d+ \([\d.e-]+ apart\), .* and \d+ more\./,
      );
      const [, distance = ""] = /use --weld ([\d.e-]+),/.exec(stdout) ?? [];
      // The corners of a cube of this side are at most √3 of it apart.
      expect(Number(distance)).toBeGreaterThan(noise / 2);
      expect(Number(distance)).toBeLessThan(1.1 * Math.sqrt(3) * noise);
      const welded = await run("check", "noisy.stl", "--weld", distance);
      expect([welded.code, welded.stdout]).toEqual([0, expect.stringContaining("closed, manifold")]);
    },
  );

  test.each([1e-6, 2e-5, 3e-4])("mesh welds nodes %d apart, and keeps the triangles", async (noise) => {
    const random = randomSource(5);
    const box = boxSurface(3);
    save("noisy.stl", stlText(soupOf(box, (x) => x + noise * ((random() % 1000) / 1000 - 0.5))));
    const { code, stderr } = await run("mesh", "noisy.stl", "-o", "noisy.vtu", "--report", "noisy.json");
    expect([code, stderr]).toEqual([0, expect.stringMatching(/repair: noisy\.stl: welded \d+ nodes/)]);
    const report = JSON.parse(readFileSync(inFolder("noisy.json"), "utf8")) as Record<string, number>;
    expect(report["triangles"]).toBe(box.triangles.length / 3);
    expect(report["volume"]).toBeCloseTo(1, 2);
  });

  test("an open scan with a stray triangle far away is read and checked soon", async () => {
    const count = 6000;
    const random = randomSource(9);
    const one = () => (10 * (random() % 1e6)) / 1e6;
    const corner = (x: number, y: number, z: number) => `vertex ${x} ${y} ${z}`;
    const facets = Array.from({ length: count }, () => {
      const [x, y, z] = [one(), one(), one()];
      return [corner(x, y, z), corner(x + 0.1, y, z), corner(x, y + 0.1, z)];
    });
    facets.push([corner(1e7, 0, 0), corner(1e7, 1, 0), corner(1e7, 0, 1)]);
    const text = facets.map(
      (corners) => `facet normal 0 0 0\nouter loop\n${corners.join("\n")}\nendloop\nendfacet`,
    );
    save("scan.stl", `solid scan\n${text.join("\n")}\nendsolid scan\n`);
    const began = performance.now();
    const { code } = await run("info", "scan.stl");
    expect(code).toBe(0);
    // The search for near nodes was quadratic: minutes.
    expect(performance.now() - began).toBeLessThan(20_000);
  });

  test("check names no nodes of a surface with a hole", async () => {
    const { points, triangles } = sphereSurface(6);
    save("hole.off", offFile({ points, triangles: triangles.slice(9) }));
    const { code, stdout } = await run("check", "hole.off");
    expect([code, stdout]).toEqual([2, expect.not.stringContaining("nearly coincide")]);
  });

  test("check names nodes of files whose triangles share nodes", async () => {
    const { points, triangles } = boxSurface(2);
    const crack = triangles.slice();
    const copied = crack[0] ?? 0;
    crack[0] = points.length / 3;
    const moved = [...points.subarray(3 * copied, 3 * copied + 3)].map((x) => x + 1e-9);
    save("crack.off", offFile({ points: Float64Array.from([...points, ...moved]), triangles: crack }));
    const { stdout } = await run("check", "crack.off");
    expect(stdout).toMatch(/1 pair of nodes nearly coincides, at most 1\.7e-9 apart: .* use --weld 1\.8e-9,/);
  });
});
