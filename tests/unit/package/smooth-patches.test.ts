/** Hermite lines, tangents, smooth patches and lofts, from the project file to the mesh. */
import { createMesher, type Mesher } from "tetrafront";
import { parseProject, type Project, readProject, writeProject } from "tetrafront/project";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { meshVolume } from "../../support/check-mesh.js";
import { expectValid } from "../../support/expect-valid.js";
import { cubeProject } from "../../support/projects.js";

let mesher: Mesher;
beforeAll(async () => void (mesher = await createMesher()));
afterAll(() => mesher.dispose());

type Line = Project["lines"][number];
type Patch = Project["patches"][number];

function project(
  points: readonly (readonly [number, number, number])[],
  lines: readonly Omit<Line, "id">[],
  patches: readonly Omit<Patch, "id">[],
): Project {
  return {
    format: "tetrafront-project",
    version: 2,
    name: "Test",
    points: points.map((position, i) => ({ id: i + 1, position })),
    lines: lines.map((line, i) => ({ ...line, id: i + 1 })),
    patches: patches.map((patch, i) => ({ ...patch, id: i + 1 })),
    background: { nodes: [], tetrahedra: [] },
    meshing: { size: 0.25 },
  };
}

/** An octahedron with corners at a distance of 1. */
function octahedron(line: Line["type"], patch: Patch["type"]): Project {
  const corners = [
    [1, 0, 0],
    [-1, 0, 0],
    [0, 1, 0],
    [0, -1, 0],
    [0, 0, 1],
    [0, 0, -1],
  ] as const;
  const lines: Omit<Line, "id">[] = [];
  const edge = (from: number, to: number): number => {
    const known = lines.findIndex(
      ({ points: [a, b] }) => (a === from && b === to) || (a === to && b === from),
    );
    if (known < 0) return lines.push({ type: line, points: [from, to] });
    return lines[known]?.points[0] === from ? known + 1 : -known - 1;
  };
  const patches = [1, 2].flatMap((x) =>
    [3, 4].flatMap((y) =>
      [5, 6].map((z) => ({ type: patch, loops: [[edge(x, y), edge(y, z), edge(z, x)]] })),
    ),
  );
  return project(corners, lines, patches);
}

/** A box of 1 x 2 x 1 whose top is a loft over three lines, the middle one raised. */
function hill(raise: number): Project {
  const points = [
    [0, 0, 0], [1, 0, 0], [1, 2, 0], [0, 2, 0],
    [0, 0, 1], [1, 0, 1], [1, 2, 1], [0, 2, 1],
    [0, 1, 1], [0.5, 1, 1 + raise], [1, 1, 1],
  ] as const; // prettier-ignore
  const straight = (from: number, to: number) => ({ type: "straight" as const, points: [from, to] });
  const lines = [
    straight(1, 2), straight(2, 3), straight(3, 4), straight(4, 1),
    straight(1, 5), straight(2, 6), straight(3, 7), straight(4, 8),
    straight(5, 6), straight(8, 7),
    { type: "spline" as const, points: [6, 11, 7] },
    { type: "spline" as const, points: [5, 9, 8] },
    { type: "spline" as const, points: [9, 10, 11] },
  ]; // prettier-ignore
  return project(points, lines, [
    { type: "planar", loops: [[1, 2, 3, 4]] },
    { type: "planar", loops: [[1, 6, -9, -5]] },
    { type: "planar", loops: [[3, 8, 10, -7]] },
    { type: "planar", loops: [[2, 7, -11, -6]] },
    { type: "planar", loops: [[4, 5, 12, -8]] },
    { type: "loft", loops: [[9, 11, -10, -12], [13]] },
  ]);
}

describe("smooth patches", () => {
  test("make a round body of an octahedron, with one normal along each line", async () => {
    const round = octahedron("hermite", "nielson");
    const result = await mesher.meshProject(round);
    expectValid(result);
    const edged = await mesher.meshProject(octahedron("straight", "barnhill-gregory-nielson"));
    expect(meshVolume(edged.mesh)).toBeCloseTo(4 / 3, 10);
    // The sphere around it has 4.19; cubics with tangents of the chords' length lie slightly inside.
    expect(meshVolume(result.mesh)).toBeGreaterThan(3);
    expect(meshVolume(result.mesh)).toBeLessThan(4.19);

    const { points, normals, triangles, patchOffsets } = await mesher.sampleCurvature(round);
    const at = new Map<string, number[]>();
    for (let patch = 0; patch + 1 < patchOffsets.length; ++patch) {
      const corners = triangles.subarray(3 * (patchOffsets[patch] ?? 0), 3 * (patchOffsets[patch + 1] ?? 0));
      for (const vertex of new Set(corners)) {
        const key = [...points.subarray(3 * vertex, 3 * vertex + 3)]
          .map((x) => Math.round(x * 1e9) + 0)
          .join();
        at.set(key, [...(at.get(key) ?? []), vertex]);
      }
    }
    const shared = [...at.values()].filter((vertices) => vertices.length > 1);
    expect(shared.length).toBeGreaterThan(12 * 20);
    for (const [first = 0, ...others] of shared) {
      for (const other of others) {
        const cosine = [0, 1, 2].reduce(
          (sum, k) => sum + (normals[3 * first + k] ?? 0) * (normals[3 * other + k] ?? 0),
          0,
        );
        expect(Math.abs(cosine)).toBeGreaterThan(1 - 1e-12);
      }
    }
  });

  test("give the same mesh when the lines are drawn the other way round", async () => {
    const one = octahedron("hermite", "nielson");
    const other = {
      ...one,
      lines: one.lines.map((line) => ({ ...line, points: line.points.toReversed() })),
      patches: one.patches.map((patch) => ({
        ...patch,
        loops: patch.loops.map((loop) => loop.map((step) => -step)),
      })),
    };
    const [first, second] = [await mesher.meshProject(one), await mesher.meshProject(other)];
    expect(first.report.fingerprint).toBe(second.report.fingerprint);
  });
});

describe("tangents", () => {
  test("change the course of a spline, and their length does not matter", async () => {
    const along = (startTangent?: readonly [number, number, number]): Project =>
      project(
        [[0, 0, 0], [1, 0, 0], [2, 0, 0]],
        [{ type: "spline", points: [1, 2, 3], ...(startTangent && { startTangent }) }],
        [],
      ); // prettier-ignore
    const sampled = async (one: Project) => (await mesher.previewProject(one)).linePoints;
    const heights = (points: Float64Array) => points.filter((_, i) => i % 3 === 1);
    expect(Math.max(...heights(await sampled(along())))).toBe(0);
    const bent = await sampled(along([1, 1, 0]));
    expect(Math.max(...heights(bent))).toBeGreaterThan(0.1);
    expect(await sampled(along([3, 3, 0]))).toEqual(bent);
  });

  test("are kept by the file, and unknown fields beside them are refused", () => {
    const one = octahedron("hermite", "nielson");
    const [line] = one.lines;
    if (!line) throw new Error("no line");
    const given = {
      ...one,
      lines: [
        { ...line, startTangent: [0, 1, 2] as const, endTangent: [1, 0, 0] as const },
        ...one.lines.slice(1),
      ],
    };
    const read = readProject(writeProject(given));
    if (!read.success) throw new Error(read.errors[0].message);
    expect(read.value.lines).toEqual(given.lines);
    expect(parseProject({ ...given, lines: [{ ...line, tangent: [0, 1, 2] }] }).success).toBe(false);
    expect(parseProject({ ...given, lines: [{ ...line, startTangent: [0, 1] }] }).success).toBe(false);
  });
});

describe("lofts", () => {
  test("follow their sections, which need no other patch", async () => {
    const flat = await mesher.meshProject(hill(0));
    expectValid(flat);
    expect(meshVolume(flat.mesh)).toBeCloseTo(2, 9);
    const raised = await mesher.meshProject(hill(0.4));
    expectValid(raised);
    expect(meshVolume(raised.mesh)).toBeGreaterThan(2.2);
    const top = Math.max(...raised.mesh.points.filter((_, i) => i % 3 === 2));
    expect(top).toBeGreaterThan(1.35);
  });

  test("name a section that does not begin on their fourth line", async () => {
    const good = hill(0.4);
    const patches = good.patches.map((patch) =>
      patch.type === "loft" ? { ...patch, loops: [patch.loops[0] ?? [], [1]] } : patch,
    );
    const { diagnostics } = await mesher.previewProject({ ...good, patches });
    const found = diagnostics.find(({ code }) => code === "misplaced-section");
    expect(found?.message).toContain("Line 1 is a section of patch 6");
  });
});

describe("sampleCurvature", () => {
  test("finds none on a cube, and leaves out patches that cannot be evaluated", async () => {
    const cube = cubeProject();
    const { largest, patchOffsets } = await mesher.sampleCurvature(cube);
    expect(Math.max(...largest)).toBe(0);
    expect(patchOffsets).toHaveLength(cube.patches.length + 1);
    const broken = { ...cube, patches: [{ id: 99, type: "coons" as const, loops: [[1]] }] };
    expect((await mesher.sampleCurvature(broken)).triangles).toHaveLength(0);
  });

  test("has as many rows and columns as asked for, and refuses others", async () => {
    const top = { ...hill(0.3), patches: hill(0.3).patches.slice(-1) };
    const { points, triangles } = await mesher.sampleCurvature(top, { cells: 5 });
    expect(points).toHaveLength(3 * 6 * 6);
    expect([...triangles.slice(0, 3)]).toEqual([0, 1, 6]);
    for (const cells of [0, 2.5, 385])
      await expect(mesher.sampleCurvature(top, { cells })).rejects.toThrow("cells");
  });
});
