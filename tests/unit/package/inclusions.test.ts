/** Orientation is evidence: of two nested shells that face the same way, the inner one is a body; else it bounds a void. */
import { readFileSync } from "node:fs";
import { createMesher, type Mesher, type SurfaceInput } from "tetrafront";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { enclosedVolume } from "../../support/check-mesh.js";
import { plyText, stlText } from "../../support/surface-files.js";
import { boxSurface, joined, sphereSurface, turned } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const { save, run, inFolder } = temporaryFolder();

interface Report {
  readonly status: string;
  readonly regions: readonly {
    readonly name: string;
    readonly tetrahedra: number;
    readonly volume: number;
  }[];
}

const reportIn = (name: string) => JSON.parse(readFileSync(inFolder(name), "utf8")) as Report;

const matrix = boxSurface(2, [-2, -2, -2], [2, 2, 2]);
const ball = sphereSurface(3);
const core = sphereSurface(2, 0.4);
const other = sphereSurface(2, 0.3, [1.5, 1.5, 1.5]);
const volumeOf = enclosedVolume;
const [inMatrix, inBall, inCore, inOther] = [matrix, ball, core, other].map(volumeOf) as [
  number,
  number,
  number,
  number,
];

type Part = readonly [name: string, surface: SurfaceInput];

const solids = (...parts: readonly Part[]) =>
  Buffer.concat(parts.map(([name, surface]) => stlText(surface, name)));

/** Returns an OBJ file of several objects. */
function objects(...parts: readonly Part[]): string {
  let first = 1;
  const lines = parts.flatMap(([name, { points, triangles }]) => {
    const rows = (word: string, values: readonly number[]) =>
      Array.from(
        { length: values.length / 3 },
        (_, i) => `${word} ${values.slice(3 * i, 3 * i + 3).join(" ")}`,
      );
    const faces = Array.from(triangles, (node) => node + first);
    first += points.length / 3;
    return [`o ${name}`, ...rows("v", [...points]), ...rows("f", faces)];
  });
  return `${lines.join("\n")}\n`;
}

async function meshed(file: string, ...options: readonly string[]): Promise<Report> {
  const result = await run("mesh", file, "-o", "out.msh", "--report", "report.json", ...options);
  expect([result.code, result.stderr]).toEqual([0, expect.not.stringContaining("error")]);
  return reportIn("report.json");
}

const volumesOf = ({ regions }: Report) =>
  Object.fromEntries(regions.map(({ name, volume }) => [name, volume]));

const near = (volume: number) => expect.closeTo(volume, 9) as number;

describe("nested solids of a file", () => {
  const cases: readonly [string, readonly Part[], Readonly<Record<string, number>>][] = [
    [
      "inclusion",
      [
        ["matrix", matrix],
        ["inclusion", ball],
      ],
      { matrix: inMatrix - inBall, inclusion: inBall },
    ],
    [
      "void",
      [
        ["matrix", matrix],
        ["hole", turned(ball)],
      ],
      { matrix: inMatrix - inBall },
    ],
    [
      "two inclusions",
      [
        ["matrix", matrix],
        ["a", ball],
        ["b", other],
      ],
      { matrix: inMatrix - inBall - inOther, a: inBall, b: inOther },
    ],
    [
      "inclusion in an inclusion",
      [
        ["core", core],
        ["ball", ball],
        ["matrix", matrix],
      ],
      { core: inCore, ball: inBall - inCore, matrix: inMatrix - inBall },
    ],
    [
      "body in a void",
      [
        ["matrix", matrix],
        ["hole", turned(ball)],
        ["pebble", core],
      ],
      { matrix: inMatrix - inBall, pebble: inCore },
    ],
    [
      "all inverted",
      [
        ["matrix", turned(matrix)],
        ["inclusion", turned(ball)],
      ],
      { matrix: inMatrix - inBall, inclusion: inBall },
    ],
  ];

  test.each(cases)("%s: STL and OBJ", async (_, parts, expected) => {
    const wanted = Object.fromEntries(Object.entries(expected).map(([name, volume]) => [name, near(volume)]));
    for (const [file, content] of [
      ["solids.stl", solids(...parts)],
      ["objects.obj", objects(...parts)],
    ] as const) {
      save(file, content);
      for (const option of [[], ["--repair"]]) {
        expect(volumesOf(await meshed(file, ...option)), `${file} ${option.join()}`).toEqual(wanted);
      }
    }
  });

  test("that all face inward: each is turned as a whole", async () => {
    save("solids.stl", solids(["matrix", turned(matrix)], ["inclusion", turned(ball)]));
    const { stderr } = await run("mesh", "solids.stl", "-o", "a.vtu", "--surface", "keep");
    const count = ({ triangles }: SurfaceInput) => triangles.length / 3;
    for (const triangles of [count(matrix), count(ball)])
      expect(stderr).toContain(`was inside out: in the mesh, its ${triangles} triangles face outward`);
  });

  test.each([
    ["an inner one", [] as number[], [0]],
    ["an inner one of an inverted whole", [0, 1], [0]],
  ])("with a single triangle of %s turned are refused", async (_, inverted, single) => {
    const parts = [matrix, ball].map((part, p) => (inverted.includes(p) ? turned(part) : part));
    const [outer = matrix, inner = ball] = parts;
    const triangles = inner.triangles.slice();
    for (const t of single) triangles.set([triangles[3 * t + 1] ?? 0, triangles[3 * t] ?? 0], 3 * t);
    save("solids.stl", solids(["matrix", outer], ["inclusion", { points: inner.points, triangles }]));
    const { code, stderr } = await run("mesh", "solids.stl", "-o", "a.vtu", "--surface", "keep");
    expect([code, stderr]).toEqual([2, expect.stringContaining("faces inward, but other triangles")]);
  });

  test("keep their names and regions when they are remeshed, within the tolerance", async () => {
    save("solids.stl", solids(["matrix", matrix], ["inclusion", ball]));
    const { matrix: outer, inclusion } = volumesOf(await meshed("solids.stl", "--surface", "remesh"));
    expect([outer, inclusion]).toEqual([expect.closeTo(inMatrix - inBall, 1), expect.closeTo(inBall, 1)]);
    const made = await run("remesh", "solids.stl", "-o", "again.stl");
    expect(made.code).toBe(0);
    expect(Object.keys(volumesOf(await meshed("again.stl")))).toEqual(["matrix", "inclusion"]);
  });

  test("are regions without names if the format has none, and from several files those of the files", async () => {
    save("both.ply", plyText(joined(matrix, ball)));
    expect(volumesOf(await meshed("both.ply"))).toEqual({
      "region 1": near(inMatrix - inBall),
      "region 2": near(inBall),
    });
    save("matrix.stl", stlText(matrix));
    save("inclusion.stl", stlText(ball));
    const args = ["mesh", "matrix.stl", "inclusion.stl", "--join", "-o", "o.msh", "--report", "j.json"];
    expect((await run(...args)).code).toBe(0);
    const found = volumesOf(reportIn("j.json"));
    expect(Object.keys(found).sort()).toEqual(["inclusion", "matrix"]);
    expect(found["inclusion"]).toBeCloseTo(inBall, 5);
  });

  test("are counted by check, and --inner-shells still decides", async () => {
    save("solids.stl", solids(["matrix", matrix], ["inclusion", ball]));
    const check = await run("check", "solids.stl");
    expect([check.code, check.stdout + check.stderr]).toEqual([
      0,
      expect.stringContaining("2 regions, 0 cavities"),
    ]);
    expect(volumesOf(await meshed("solids.stl", "--inner-shells", "cavities"))).toEqual({
      matrix: near(inMatrix - inBall),
    });
  });
});

describe("the report of a mesh", () => {
  test("lists its regions also if there is one", async () => {
    save("ball.stl", stlText(ball));
    const { regions } = await meshed("ball.stl");
    expect(regions).toEqual([
      {
        name: "part",
        tetrahedra: expect.any(Number) as number,
        volume: expect.closeTo(inBall, 5) as number,
      },
    ]);
  });
});

describe("the API", () => {
  let mesher: Mesher;
  beforeAll(async () => {
    mesher = await createMesher();
  });
  afterAll(() => mesher.dispose());

  test("tells the same by inspection, repair, remeshing and filling", async () => {
    const both = joined(matrix, ball);
    const hollow = joined(matrix, turned(ball));
    for (const [surface, regions, volume] of [
      [both, 2, inMatrix],
      [hollow, 1, inMatrix - inBall],
    ] as const) {
      const found = await mesher.inspectSurface(surface);
      expect([found.isFillable, found.regions, found.volume]).toEqual([true, regions, near(volume)]);
      expect((await mesher.repairSurface(surface)).changes).toEqual([]);
      const remesh = await mesher.remeshSurface(surface);
      expect((await mesher.inspectSurface(remesh.mesh)).regions).toBe(regions);
      const { report } = await mesher.fillSurface(surface);
      expect(report.volume).toBeCloseTo(volume, 9);
    }
  });

  test("keeps a body in a body when a repair resolves intersections elsewhere", async () => {
    const crossing = joined(sphereSurface(2, 1, [6, 0, 0]), sphereSurface(2, 1, [7, 0.2, 0.1]));
    const { mesh: surface } = await mesher.repairSurface(joined(joined(matrix, ball), crossing));
    const found = await mesher.inspectSurface(surface);
    expect([found.isFillable, found.regions]).toEqual([true, 3]);
  });
});
