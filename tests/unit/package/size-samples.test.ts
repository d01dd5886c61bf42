/** Target sizes at positions and the expected number of elements, before a project is meshed. */
import { createMesher, type Mesher } from "tetrafront";
import { createBody, type Project, type ProjectSource } from "tetrafront/project";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { cubeProject } from "../../support/projects.js";
import { sphereSurface } from "../../support/surfaces.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

const at = (...positions: readonly (readonly [number, number, number])[]): Float64Array =>
  Float64Array.from(positions.flat());

/** The unit cube whose background grid has sizes and stretchings by node. */
function withNodes(change: (node: Project["background"]["nodes"][number]) => object): Project {
  const project = cubeProject();
  const { background } = project;
  return {
    ...project,
    background: { ...background, nodes: background.nodes.map((node) => ({ ...node, ...change(node) })) },
  };
}

describe("the size at a position", () => {
  test("is the uniform size, or that of the nearest source", async () => {
    const source: ProjectSource = { id: 1, type: "point", positions: [[0, 0, 0]], size: 0.01, growth: 0.5 };
    const { background, ...rest } = cubeProject();
    const project: Project = {
      ...rest,
      meshing: { size: 0.2 },
      background: { ...background, sources: [source] },
    };
    const { sizes } = await mesher.sampleSizes(project, at([1, 1, 1], [0, 0, 0], [0.1, 0, 0]));
    expect(sizes[0]).toBeCloseTo(0.2, 12);
    expect(sizes[1]).toBeCloseTo(0.01, 12);
    expect(sizes[2]).toBeCloseTo(0.06, 12);
  });

  test("is linear in a tetrahedron of the background grid", async () => {
    const slope = [0.01, 0.02, 0.03] as const;
    const sizeOf = (p: readonly number[]): number =>
      0.3 + slope.reduce((sum, s, k) => sum + s * (p[k] ?? 0), 0);
    const project = withNodes(({ position }) => ({ size: sizeOf(position) }));
    const positions = [0.1, 0.35, 0.6].flatMap((x) => [[x, 0.2, 0.4] as const, [0.3, x, 0.7] as const]);
    const { sizes } = await mesher.sampleSizes(project, at(...positions));
    positions.forEach((position, i) => expect(sizes[i]).toBeCloseTo(sizeOf(position), 9));
  });

  test("is that of an element with the same volume where sizes are stretched", async () => {
    const project = withNodes(() => ({ size: 0.1, stretching: 8, direction: [0, 0, 1] }));
    const { sizes } = await mesher.sampleSizes(project, at([0.5, 0.5, 0.5]));
    expect(sizes[0]).toBeCloseTo(0.1 * 8 ** (1 / 3), 9);
  });

  test("is not known if the project has no valid sizes, and positions outside the grid have that of its edge", async () => {
    const { background: _, ...rest } = cubeProject();
    const without: Project = { ...rest, background: { nodes: [], tetrahedra: [] } };
    expect(await mesher.sampleSizes(without, at([0, 0, 0]))).toEqual({
      sizes: new Float64Array(),
      tetrahedra: null,
    });
    const { sizes } = await mesher.sampleSizes(cubeProject(0.3), at([100, 100, 100]));
    expect(sizes[0]).toBeCloseTo(0.3, 9);
  });
});

describe("the expected number of tetrahedra", () => {
  test.each([
    ["of one size", cubeProject(0.12)],
    ["growing sizes", withNodes(({ position: [x] }) => ({ size: 0.08 + 0.05 * Math.max(0, x) }))],
    ["stretched", withNodes(() => ({ size: 0.06, stretching: 4, direction: [1, 0, 0] }))],
    ["stretched obliquely", withNodes(() => ({ size: 0.06, stretching: 3, direction: [1, 2, 2] }))],
  ])("is within 40 % of a mesh: %s", async (_, project) => {
    const { tetrahedra } = await mesher.sampleSizes(project, new Float64Array());
    const { report } = await mesher.meshProject(project, { optimization: "fast" });
    expect(report.status).toBe("done");
    expect((tetrahedra ?? 0) / report.tetrahedra).toBeGreaterThan(0.6);
    expect((tetrahedra ?? 0) / report.tetrahedra).toBeLessThan(1.4);
  });

  test("is not known of an open surface, whose sizes are", async () => {
    const cube = cubeProject();
    const open = { ...cube, patches: cube.patches.slice(1) };
    const { sizes, tetrahedra } = await mesher.sampleSizes(open, at([0.5, 0.5, 0.5]));
    expect(tetrahedra).toBeNull();
    expect(sizes).toHaveLength(1);
  });

  test("includes bodies that are prepared, and is not known without them", async () => {
    const ball = createBody(sphereSurface(8, 0.3, [2, 0.5, 0.5]), { id: 1, firstPatchId: 20 });
    const cube = { ...cubeProject(), meshing: { size: 0.15 } };
    const project: Project = { ...cube, bodies: [ball] };
    const nothing = new Float64Array();
    expect((await mesher.sampleSizes(project, nothing)).tetrahedra).toBeNull();
    const prepared = await mesher.prepareBody(project, 1);
    const { tetrahedra } = await mesher.sampleSizes(project, nothing, { preparedBodies: [prepared] });
    const ofCube = await mesher.sampleSizes(cube, nothing);
    const { report } = await mesher.meshProject(project, { preparedBodies: [prepared] });
    expect(tetrahedra ?? 0).toBeGreaterThan(ofCube.tetrahedra ?? Infinity);
    expect((tetrahedra ?? 0) / report.tetrahedra).toBeGreaterThan(0.5);
    expect((tetrahedra ?? 0) / report.tetrahedra).toBeLessThan(2);
    // A body alone has sizes of its own edges.
    const alone: Project = { ...project, points: [], lines: [], patches: [], meshing: {} };
    const bare = { ...alone, background: { nodes: [], tetrahedra: [] } };
    const own = await mesher.prepareBody(bare, 1);
    const found = await mesher.sampleSizes(bare, Float64Array.of(2, 0.5, 0.5), { preparedBodies: [own] });
    expect(found.sizes[0]).toBeGreaterThan(0);
    expect(found.tetrahedra).toBeGreaterThan(50);
  });
});
