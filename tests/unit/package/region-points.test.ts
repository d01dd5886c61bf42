/** Hole points and region points of TetGen's files decide what is meshed. The volumes are those of boxes. */
import { createMesher, type Mesher, readMesh, readSurface, type Mesh, writeMesh } from "tetrafront";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { randomSource } from "../../support/random.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

type Position = readonly [number, number, number];
type Box = readonly [low: Position, high: Position];
type Facet = readonly number[];

const FACETS: readonly Facet[] = [
  [0, 2, 3, 1],
  [4, 5, 7, 6],
  [0, 1, 5, 4],
  [1, 3, 7, 5],
  [3, 2, 6, 7],
  [2, 0, 4, 6],
];

/** Corners of each box in turn, x fastest. */
function corners(boxes: readonly Box[]): Position[] {
  return boxes.flatMap(([low, high]) =>
    Array.from({ length: 8 }, (_, i): Position => [
      (i & 1 ? high : low)[0],
      (i & 2 ? high : low)[1],
      (i & 4 ? high : low)[2],
    ]),
  );
}

/** A `.smesh` of boxes that do not touch. `isFlipped`: whether a facet is listed backwards. */
function boxesFile(
  boxes: readonly Box[],
  marks: string,
  isFlipped: (facet: number) => boolean = () => false,
) {
  const facets = boxes.flatMap((_, b) => FACETS.map((facet) => facet.map((corner) => corner + 8 * b)));
  return smesh(
    corners(boxes),
    facets.map((facet, f) => (isFlipped(f) ? [...facet].reverse() : facet)),
    marks,
  );
}

function smesh(points: readonly Position[], facets: readonly Facet[], marks: string): Uint8Array {
  const rows = [
    `${points.length} 3 0 0`,
    ...points.map((point, n) => `${n} ${point.join(" ")}`),
    `${facets.length} 1`,
    ...facets.map((facet, f) => `${facet.length} ${facet.join(" ")} ${f + 1}`),
    marks,
  ];
  return new TextEncoder().encode(rows.join("\n"));
}

async function surfaceIn(file: Uint8Array): Promise<Mesh> {
  const read = await readSurface(file, { fileName: "model.smesh" });
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

/** Volume and largest tetrahedron of each region by its tag, as in the `.ele` file that is written. */
async function meshedRegions(surface: Mesh) {
  const result = await mesher.fillSurface(surface);
  expect(result.report.status, JSON.stringify(result.report.diagnostics)).toBe("done");
  const files = await writeMesh(result.mesh, "model.ele");
  const openOther = (name: string) => Promise.resolve(files.find(({ fileName }) => fileName === name)?.bytes);
  const read = await readMesh(files[0]?.bytes ?? new Uint8Array(), {
    fileName: files[0]?.fileName ?? "",
    openOther,
  });
  if (!read.success) throw new Error(read.errors[0].message);
  const { points, tetrahedra, tetrahedronRegion, regions } = read.value;
  const found: Record<number, { volume: number; largest: number }> = {};
  for (let t = 0; 4 * t < tetrahedra.length; t++) {
    const [a = [], b = [], c = [], d = []] = [...tetrahedra.subarray(4 * t, 4 * t + 4)].map((node) => [
      ...points.subarray(3 * node, 3 * node + 3),
    ]);
    const [u, v, w] = [b, c, d].map((p) => p.map((x, axis) => x - (a[axis] ?? 0))) as [
      number[],
      number[],
      number[],
    ];
    const volume = Math.abs(determinant(u, v, w)) / 6;
    const own = (found[regions[tetrahedronRegion[t] ?? 0]?.tag ?? NaN] ??= { volume: 0, largest: 0 });
    own.volume += volume;
    own.largest = Math.max(own.largest, volume);
  }
  return found;
}

function determinant(
  [a = 0, b = 0, c = 0]: number[],
  [d = 0, e = 0, f = 0]: number[],
  [g = 0, h = 0, i = 0]: number[],
) {
  return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
}

const OUTER: Box = [
  [0, 0, 0],
  [4, 4, 4],
];
const INNER: Box = [
  [1, 1, 1],
  [3, 3, 3],
];
const CORE: Box = [
  [1.5, 1.5, 1.5],
  [2.5, 2.5, 2.5],
];

describe("a box in a box", () => {
  test("is a second region if no point marks it as a hole, whatever the orientation of the facets", async () => {
    const random = randomSource(3);
    for (const isFlipped of [() => false, (f: number) => f > 5, () => random() < 0.5]) {
      const { mesh: surface, diagnostics } = await mesher.locateRegions(
        await surfaceIn(boxesFile([OUTER, INNER], "0\n0\n", isFlipped)),
      );
      expect(diagnostics).toEqual([]);
      const found = await meshedRegions(surface);
      expect(found[1]?.volume).toBeCloseTo(56, 9);
      expect(found[2]?.volume).toBeCloseTo(8, 9);
    }
  });

  test("is a hole if a point lies in it", async () => {
    const { mesh: surface } = await mesher.locateRegions(
      await surfaceIn(boxesFile([OUTER, INNER], "1\n1 2 2 2\n0\n")),
    );
    const found = await meshedRegions(surface);
    expect(Object.keys(found)).toEqual(["1"]);
    expect(found[1]?.volume).toBeCloseTo(56, 9);
  });

  test("is meshed alone if the outer region is the hole", async () => {
    const { mesh: surface } = await mesher.locateRegions(
      await surfaceIn(boxesFile([OUTER, INNER, CORE], "2\n1 .5 .5 .5\n2 2 2 2\n1\n1 1.2 1.2 1.2 42\n")),
    );
    expect(surface.triangles.length).toBe(3 * 24);
    const found = await meshedRegions(surface);
    expect(Object.keys(found)).toEqual(["42"]);
    expect(found[42]?.volume).toBeCloseTo(7, 9);
  });

  test("has the attributes and volume limits of the region points", async () => {
    const { mesh: surface } = await mesher.locateRegions(
      await surfaceIn(boxesFile([OUTER, INNER], "0\n2\n1 .5 .5 .5 7 0\n2 2 2 2 3 .02\n")),
    );
    expect(surface.surfaceRegions?.regions).toEqual([
      { name: "region 7", tag: 7 },
      { name: "region 3", tag: 3 },
    ]);
    const found = await meshedRegions(surface);
    expect(found[7]?.volume).toBeCloseTo(56, 9);
    expect(found[3]?.volume).toBeCloseTo(8, 9);
    expect(found[3]?.largest).toBeLessThanOrEqual(0.02);
    expect(found[7]?.largest).toBeGreaterThan(0.02);
  });

  test("is one region with the outer one if both points have the same attribute", async () => {
    const { mesh: surface } = await mesher.locateRegions(
      await surfaceIn(boxesFile([OUTER, INNER], "0\n2\n1 .5 .5 .5 7\n2 2 2 2 7\n")),
    );
    const found = await meshedRegions(surface);
    expect(Object.keys(found)).toEqual(["7"]);
    expect(found[7]?.volume).toBeCloseTo(64, 9);
  });
});

describe("a box divided by a wall", () => {
  const points = corners([
    [
      [0, 0, 0],
      [1, 2, 3],
    ],
    [
      [1, 0, 0],
      [4, 2, 3],
    ],
  ]);
  // Facet 3 of the first box is the wall, which replaces facet 5 of the second one.
  const facets = [
    ...FACETS,
    ...FACETS.filter((_, f) => f !== 5).map((facet) => facet.map((corner) => corner + 8)),
  ];

  test("has two regions", async () => {
    const { mesh: surface } = await mesher.locateRegions(
      await surfaceIn(smesh(points, facets, "0\n1\n1 2 1 1 5\n")),
    );
    const found = await meshedRegions(surface);
    expect(found[5]?.volume).toBeCloseTo(18, 9);
    expect(found[6]?.volume).toBeCloseTo(6, 9);
  });

  test("loses the side with a hole point, and the facets around it", async () => {
    const { mesh: surface } = await mesher.locateRegions(
      await surfaceIn(smesh(points, facets, "1\n1 2 1 1\n0\n")),
    );
    expect(surface.triangles.length).toBe(3 * 12);
    const remeshed = await mesher.inspectSurface(surface);
    expect(remeshed).toMatchObject({ isFillable: true, flippedTriangles: 0, regions: 1 });
    const found = await meshedRegions(surface);
    expect(found[1]?.volume).toBeCloseTo(6, 9);
  });
});

describe("points", () => {
  const located = async (marks: string) =>
    mesher.locateRegions(await surfaceIn(boxesFile([OUTER, INNER], marks)));

  test("without effect are named in warnings", async () => {
    const { diagnostics } = await located("2\n1 9 9 9\n2 2 2 2\n3\n1 .5 .5 .5 1\n2 2 2 2 8\n3 3.5 .5 .5 2\n");
    expect(diagnostics.map(({ severity, message }) => `${severity}: ${message}`)).toEqual([
      "warning: Hole point 1 at (9, 9, 9) lies outside the surface and has no effect",
      "warning: Region point 2 at (2, 2, 2) lies in a hole and has no effect",
      "warning: Region points 1 and 3 at (0.5, 0.5, 0.5) and (3.5, 0.5, 0.5) lie in the same region; the first one counts",
    ]);
  });

  test("on the surface are refused", async () => {
    await expect(located("1\n1 1 2 2\n0\n")).rejects.toThrow(
      /Hole point 1 at \(1, 2, 2\) lies on the surface/,
    );
  });

  test("in every volume leave nothing to mesh", async () => {
    await expect(located("2\n1 2 2 2\n2 .5 .5 .5\n0\n")).rejects.toThrow(/every volume/i);
  });

  test("that a file does not have need not be located, and inner shells are regions", async () => {
    const surface = await surfaceIn(boxesFile([OUTER, INNER], "0\n0\n"));
    const volumeWith = async (innerShells?: "cavities") => {
      const { report } = await mesher.fillSurface(surface, { innerShells });
      expect(report.status, JSON.stringify(report.diagnostics)).toBe("done");
      return report.volume;
    };
    const both = await volumeWith();
    expect(both).toBeCloseTo(64, 9);
    expect(await volumeWith("cavities")).toBeCloseTo(64 - 8, 9);
    expect((await mesher.remeshSurface(surface)).mesh.triangles.length).toBeGreaterThan(0);
  });

  test("must be located before meshing", async () => {
    const surface = await surfaceIn(boxesFile([OUTER, INNER], "1\n1 2 2 2\n0\n"));
    const { report } = await mesher.fillSurface(surface);
    expect(report.status).toBe("invalid-input");
    expect(report.diagnostics[0]).toMatchObject({ code: "unlocated-regions" });
    await expect(mesher.remeshSurface(surface)).rejects.toThrow(/locateRegions/);
  });
});

test("a remeshed surface keeps its holes and regions", async () => {
  const { mesh: surface } = await mesher.locateRegions(
    await surfaceIn(boxesFile([OUTER, INNER, CORE], "1\n1 1.2 1.2 1.2\n2\n1 .5 .5 .5 4\n2 2 2 2 9\n")),
  );
  const remesh = await mesher.remeshSurface(surface, { size: 0.8 });
  const found = await meshedRegions(remesh.mesh);
  expect(found[4]?.volume).toBeCloseTo(56, 9);
  expect(found[9]?.volume).toBeCloseTo(1, 9);
});
