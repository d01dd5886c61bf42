/** Where element sizes come from: sources, grids around a model, meshes used as grids, proposals. */
import { createMesher, type Mesher, type Project, type ProjectSource, type VolumeMesh } from "tetrafront";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { cubeProject } from "../../support/projects.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

type Place = readonly [number, number, number];

function nodeAt({ points }: VolumeMesh, node: number): Place {
  return [points[3 * node] ?? NaN, points[3 * node + 1] ?? NaN, points[3 * node + 2] ?? NaN];
}

/** Mean length of the edges whose midpoint is where `isWanted` says; each as often as it is used. */
function meanEdge(mesh: VolumeMesh, isWanted: (middle: Place) => boolean): number {
  let sum = 0;
  let count = 0;
  for (let t = 0; t < mesh.tetrahedra.length; t += 4) {
    const corners = [...mesh.tetrahedra.subarray(t, t + 4)].map((node) => nodeAt(mesh, node));
    corners.forEach((a, i) =>
      corners.slice(i + 1).forEach((b) => {
        if (!isWanted([(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2])) return;
        sum += Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
        count++;
      }),
    );
  }
  return sum / count;
}

function withSources(project: Project, ...sources: ProjectSource[]): Project {
  return { ...project, background: { ...project.background, sources } };
}

describe("a source of size", () => {
  const segment: ProjectSource = {
    id: 1,
    type: "segment",
    places: [
      [0, 0, 0],
      [0, 0, 1],
    ],
    size: 0.06,
    distance: 0.25,
  };
  const isNear = ([x, y]: Place) => Math.hypot(x, y) < 0.15;
  const isFar = ([x, y]: Place) => Math.hypot(x, y) > 1;

  test.each([
    ["of the background grid", cubeProject(0.25), {}],
    ["of a uniform size", { ...cubeProject(), background: { nodes: [], tetrahedra: [] } }, { size: 0.25 }],
  ])("makes elements near it as small as it says, inside that %s", async (_, project, options) => {
    const { report, volume } = await mesher.meshProject(withSources(project, segment), options);
    expect(report.status).toBe("done");
    expect(meanEdge(volume, isNear) / 0.06).toBeGreaterThan(0.85);
    expect(meanEdge(volume, isNear) / 0.06).toBeLessThan(1.15);
    expect(meanEdge(volume, isFar)).toBeGreaterThan(0.18);
  });

  test("without a sensible size is refused by its name", async () => {
    const lip: ProjectSource = { ...segment, name: "lip", size: 0 };
    const { report } = await mesher.meshProject(withSources(cubeProject(), lip));
    expect(report.status).toBe("invalid-input");
    expect(report.diagnostics).toMatchObject([
      { code: "bad-source", entities: [{ kind: "source", index: 0, id: 1, label: 'source "lip"' }] },
    ]);
    expect(report.diagnostics[0]?.message).toMatch(/^Source "lip" has the size 0/);
  });
});
