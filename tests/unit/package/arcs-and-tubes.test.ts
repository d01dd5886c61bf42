/** Projects with arcs, circles and tubes, through the package. */
import { createMesher, type Diagnostic, type Mesher } from "tetrafront";
import { parseProject, readProject, writeProject, type Project } from "tetrafront/project";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { expectValid } from "../../support/expect-valid.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

/** A cylinder of radius 1 and height 2: a tube between two circles, with planar caps. */
function cylinder(): Project {
  const rim = (z: number, first: number) => [
    { id: first, position: [1, 0, z] as const },
    { id: first + 1, position: [0, 1, z] as const },
    { id: first + 2, position: [-1, 0, z] as const },
  ];
  return {
    format: "tetrafront-project",
    version: 2,
    name: "Cylinder",
    points: [...rim(0, 1), ...rim(2, 4)],
    lines: [
      { id: 1, type: "circle", points: [1, 2, 3, 1] },
      { id: 2, type: "circle", points: [5, 4, 6, 5] },
    ],
    patches: [
      { id: 1, type: "tube", loops: [[1], [-2]] },
      { id: 2, type: "planar", loops: [[1]] },
      { id: 3, type: "planar", loops: [[2]] },
    ],
    meshing: { size: 0.25 },
    background: { nodes: [], tetrahedra: [] },
  };
}

test("a cylinder is read back unchanged, and previewed without problems", async () => {
  const project = cylinder();
  expect(readProject(writeProject(project))).toEqual({ success: true, value: project });
  const preview = await mesher.previewProject(project);
  expect(preview.diagnostics).toEqual([]);
  for (let i = 0; i < preview.patchPoints.length; i += 3) {
    const [x = 0, y = 0] = preview.patchPoints.subarray(i, i + 2);
    expect(x * x + y * y).toBeLessThan(1 + 1e-12);
  }
});

test("a cylinder is meshed, with its nodes on it and nearly its volume", async () => {
  const result = await mesher.meshProject(cylinder());
  const { mesh: surface, report } = result;
  expectValid(result);
  const ofTube = surface.trianglePatch.reduce<number[]>(
    (found, patch, t) => (patch === 0 ? [...found, t] : found),
    [],
  );
  for (const triangle of ofTube) {
    for (const node of surface.triangles.subarray(3 * triangle, 3 * triangle + 3)) {
      const [x = 0, y = 0] = surface.points.subarray(3 * node, 3 * node + 2);
      expect(Math.abs(Math.hypot(x, y) - 1)).toBeLessThan(1e-14);
    }
  }
  const exact = 2 * Math.PI;
  expect(report.volume).toBeLessThan(exact);
  expect(report.volume).toBeGreaterThan(0.98 * exact);
  const [side] = report.patches;
  expect(side?.minAngle).toBeGreaterThan(30);
});

test("a spline passes through three points, and ends without curvature", async () => {
  const project: Project = {
    ...cylinder(),
    points: [
      { id: 1, position: [-3, 0, 0] },
      { id: 2, position: [0, 1, 0] },
      { id: 3, position: [3, 0, 0] },
    ],
    lines: [{ id: 1, type: "spline", points: [1, 2, 3] }],
    patches: [],
  };
  const { diagnostics, linePoints } = await mesher.previewProject(project);
  const ofLines = diagnostics.filter(({ entities }) => entities.some(({ kind }) => kind === "line"));
  expect(ofLines).toEqual([]);
  // By hand: with the knots 0, 1/2 and 1, the height is 3t - 4t^3 up to the middle; a parabola would have 4t(1 - t).
  const places = Array.from({ length: linePoints.length / 3 }, (_, i) => [
    ...linePoints.slice(3 * i, 3 * i + 3),
  ]);
  expect(places.length).toBeGreaterThan(4);
  for (const [x = NaN, y = NaN] of places) {
    const t = Math.min((x + 3) / 6, (3 - x) / 6);
    expect(y).toBeCloseTo(3 * t - 4 * t ** 3, 12);
  }
});

describe("a project is rejected with a message and a remedy:", () => {
  const damaged = (damage: Partial<Project>) => ({ ...cylinder(), ...damage });
  const { lines, patches, points } = cylinder();

  test.each<[string, Project, Diagnostic["code"], RegExp]>([
    [
      "a circle through three points on a line",
      damaged({
        points: points.map((point) => (point.id === 2 ? { ...point, position: [0, 0, 0] } : point)),
      }),
      "collinear-points",
      /^The points of line 1 lie on one straight line at \(0, 0, 0\), so they define no circle$/,
    ],
    [
      "a circle that does not end at its first point",
      damaged({ lines: lines.map((line) => (line.id === 1 ? { ...line, points: [1, 2, 3, 4] } : line)) }),
      "open-circle",
      /^line 1 is a circle, but its last point is not its first$/i,
    ],
    [
      "an arc of two points",
      damaged({
        lines: lines.map((line) => (line.id === 1 ? { ...line, type: "arc", points: [1, 2] } : line)),
      }),
      "wrong-point-count",
      /line 1 has 2 points/i,
    ],
    [
      "a tube with one loop",
      damaged({ patches: patches.map((patch) => (patch.id === 1 ? { ...patch, loops: [[1]] } : patch)) }),
      "wrong-loop-count",
      /^patch 1 is a tube, which has two loops, but it has 1 loop$/i,
    ],
    [
      "a tube whose rims are one line",
      damaged({
        patches: patches.map((patch) => (patch.id === 1 ? { ...patch, loops: [[1], [1]] } : patch)),
      }),
      "loops-intersect",
      /Loops of patch 1 cross or touch at line 1/,
    ],
  ])("%s", async (_, project, code, message) => {
    expect(parseProject(project).success).toBe(true);
    const { diagnostics } = await mesher.previewProject(project);
    const found = diagnostics.find((diagnostic) => diagnostic.code === code);
    expect(found?.message).toMatch(message);
    expect(found?.remedy).toMatch(/\.$/);
    expect((await mesher.meshProject(project)).report.status).toBe("invalid-input");
  });
});
