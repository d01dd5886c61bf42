import { describe, expect, it } from "vitest";
import { createMesher, type ProjectSource } from "tetrafront";
import { estimateTetrahedra, sizeAt } from "../../../web/document/estimate";
import { cubeProject } from "../../support/projects";

describe("sizeAt", () => {
  const source: ProjectSource = {
    id: 1,
    type: "segment",
    positions: [
      [0, 0, 0],
      [2, 0, 0],
    ],
    size: 0.1,
    distance: 0.5,
    growth: 0.2,
  };

  it("follows size + growth · max(0, r - distance), and the smallest wins", () => {
    expect(sizeAt([1, 0.4, 0], 1, [source])).toBeCloseTo(0.1, 12);
    expect(sizeAt([1, 1.5, 0], 1, [source])).toBeCloseTo(0.3, 12);
    expect(sizeAt([4, 0, 0], 1, [source])).toBeCloseTo(0.4, 12);
    expect(sizeAt([100, 0, 0], 1, [source])).toBe(1);
    expect(sizeAt([1, 1.5, 0], 1, [source, { ...source, id: 2, size: 0.05 }])).toBeCloseTo(0.25, 12);
  });
});

describe("sizeAt beside a triangle", () => {
  const places = [[0, 0, 0], [10, 0, 0], [0, 10, 0]] as const; // prettier-ignore
  const source: ProjectSource = { id: 1, type: "triangle", positions: places, size: 0.1, growth: 0.2 };

  it("counts from its inside, its sides and its corners", () => {
    for (const turned of [source, { ...source, positions: places.toReversed() }]) {
      expect(sizeAt([2, 3, 0.5], 9, [turned])).toBeCloseTo(0.2, 12);
      expect(sizeAt([2, 3, -1], 9, [turned])).toBeCloseTo(0.3, 12);
      expect(sizeAt([5, -3, 4], 9, [turned])).toBeCloseTo(1.1, 12);
      expect(sizeAt([-2, -3, 6], 9, [turned])).toBeCloseTo(1.5, 12);
    }
  });
});

describe("estimateTetrahedra", () => {
  it("comes within a fifth of the mesh, with and without a source", async () => {
    const mesher = await createMesher();
    const size = 0.12;
    const near: ProjectSource = { id: 1, type: "point", positions: [[0, 0, 0]], size: 0.03, distance: 0.1 };
    for (const sources of [[], [near]]) {
      const cube = cubeProject();
      const project = { ...cube, background: { ...cube.background, sources } };
      const preview = await mesher.previewProject(project);
      const expected = await estimateTetrahedra(preview, size, sources);
      const { report } = await mesher.meshProject(project, { size });
      expect(report.status).toBe("done");
      expect((expected ?? 0) / report.tetrahedra).toBeGreaterThan(0.8);
      expect((expected ?? 0) / report.tetrahedra).toBeLessThan(1.25);
    }
    mesher.dispose();
  });

  it("gives up where nothing is enclosed, or nobody waits", async () => {
    const mesher = await createMesher();
    const project = cubeProject();
    const preview = await mesher.previewProject(project);
    const empty = await mesher.previewProject({ ...project, patches: [] });
    mesher.dispose();
    expect(await estimateTetrahedra(empty, 0.1, [])).toBeNull();
    expect(await estimateTetrahedra(preview, 0, [])).toBeNull();
    expect(await estimateTetrahedra(preview, 0.0002, [], () => true)).toBeNull();
  });
});
