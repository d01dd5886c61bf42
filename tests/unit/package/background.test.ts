/** Sources of element sizes: size sources, covering grids, background grids made from meshes, proposals. */
import type { BackgroundArrays } from "tetrafront";
import {
  createMesher,
  type Mesher,
  type MeshOptions,
  type MeshResult,
  type SurfaceInput,
  type VolumeInput,
} from "tetrafront";
import {
  backgroundArrays,
  projectBackground,
  readProject,
  writeProject,
  type Project,
  type ProjectSource,
} from "tetrafront/project";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { enclosedVolume, defectsOf, meshVolume, NO_DEFECTS } from "../../support/check-mesh.js";
import { cubeProject } from "../../support/projects.js";
import { boxSurface, sphereSurface } from "../../support/surfaces.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

type Position = readonly [number, number, number];

function nodeAt({ points }: VolumeInput, node: number): Position {
  return [points[3 * node] ?? NaN, points[3 * node + 1] ?? NaN, points[3 * node + 2] ?? NaN];
}

/** Returns the mean length of the edges whose midpoint `isIncluded` accepts, counted once per tetrahedron. */
function meanEdge(mesh: VolumeInput, isIncluded: (middle: Position) => boolean): number {
  let sum = 0;
  let count = 0;
  for (let t = 0; t < mesh.tetrahedra.length; t += 4) {
    const corners = [...mesh.tetrahedra.subarray(t, t + 4)].map((node) => nodeAt(mesh, node));
    corners.forEach((a, i) =>
      corners.slice(i + 1).forEach((b) => {
        if (!isIncluded([(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2])) return;
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

describe("a size source", () => {
  const segment: ProjectSource = {
    id: 1,
    type: "segment",
    positions: [
      [0, 0, 0],
      [0, 0, 1],
    ],
    size: 0.06,
    distance: 0.25,
  };
  const isNear = ([x, y]: Position) => Math.hypot(x, y) < 0.15;
  const isFar = ([x, y]: Position) => Math.hypot(x, y) > 1;

  test.each([
    ["background grid", cubeProject(0.25), {}],
    ["uniform size", { ...cubeProject(), background: { nodes: [], tetrahedra: [] } }, { size: 0.25 }],
  ])("gives elements near it its size in a coarser %s", async (_, project, options) => {
    const { report, mesh: volume } = await mesher.meshProject(withSources(project, segment), options);
    expect(report.status).toBe("done");
    expect(meanEdge(volume, isNear) / 0.06).toBeGreaterThan(0.85);
    expect(meanEdge(volume, isNear) / 0.06).toBeLessThan(1.15);
    expect(meanEdge(volume, isFar)).toBeGreaterThan(0.18);
  });

  test("with an invalid size is rejected by its name", async () => {
    const invalid: ProjectSource = { ...segment, name: "lip", size: 0 };
    const { report } = await mesher.meshProject(withSources(cubeProject(), invalid));
    expect(report.status).toBe("invalid-input");
    expect(report.diagnostics).toMatchObject([
      { code: "source-out-of-range", entities: [{ kind: "source", index: 0, id: 1, label: 'source "lip"' }] },
    ]);
    expect(report.diagnostics[0]?.message).toMatch(/^Source "lip" has the size 0/);
  });
});

const bare = (project: Project): Project => ({ ...project, background: { nodes: [], tetrahedra: [] } });

function expectDone({ report, mesh }: MeshResult): void {
  expect(report.diagnostics.filter(({ severity }) => severity === "error")).toEqual([]);
  expect(report.status).toBe("done");
  expect(defectsOf(mesh, mesh)).toEqual(NO_DEFECTS);
  expect(Math.abs(meshVolume(mesh) / enclosedVolume(mesh) - 1)).toBeLessThan(1e-10);
}

describe("a covering grid", () => {
  test.each([
    ["box", 8, 5],
    ["tetrahedron", 4, 1],
  ] as const)("of the shape %s covers the model with the given size", async (shape, nodes, tetrahedra) => {
    const background = await mesher.coverProject(bare(cubeProject()), { size: 0.3, shape });
    expect([background.nodes.length, background.tetrahedra.length]).toEqual([nodes, tetrahedra]);
    const covered = { ...cubeProject(), background };
    expect(readProject(writeProject(covered))).toEqual({ success: true, value: covered });
    const [byGrid, bySize] = [
      await mesher.meshProject(covered),
      await mesher.meshProject(bare(cubeProject()), { size: 0.3 }),
    ];
    expectDone(byGrid);
    expect(Math.abs(byGrid.report.tetrahedra / bySize.report.tetrahedra - 1)).toBeLessThan(0.1);
  });

  test("keeps the sources and derives its size from the model if none is given", async () => {
    const source: ProjectSource = { id: 3, type: "point", positions: [[0, 0, 0]], size: 0.1 };
    const background = await mesher.coverProject(withSources(cubeProject(), source));
    expect(background.sources).toEqual([source]);
    for (const { size } of background.nodes) expect(size).toBeCloseTo(Math.sqrt(3) / 20, 12);
  });

  test.each<[string, Project, object, RegExp]>([
    [
      "an empty drawing",
      { ...cubeProject(), points: [], lines: [], patches: [] },
      {},
      /nothing to cover.*\. Draw /,
    ],
    ["a size below 0", cubeProject(), { size: -1 }, /size is -1\. Use a size from 1e-30 to 1e30/],
    ["an unknown shape", cubeProject(), { shape: "sphere" }, /"sphere"\. Use one of box, tetrahedron/],
    ["an unknown option", cubeProject(), { sise: 1 }, /no option "sise".*size, shape/],
    ["an object that is not a project", {} as Project, {}, /not a Tetrafront project/],
  ])("is rejected for %s", async (_, project, options, message) => {
    const refused = mesher.coverProject(project, options);
    await expect(refused).rejects.toMatchObject({ name: "MesherError", code: "invalid-input" });
    await expect(refused).rejects.toThrow(message);
  });
});

describe("proposed sizes", () => {
  const curved = withBentEdge(cubeProject());

  test("refine curved lines and give a valid mesh", async () => {
    const { size, sources } = await mesher.proposeSizes(curved, { maxSize: 0.5 });
    expect(size).toBe(0.5);
    expect(sources.length).toBeGreaterThan(0);
    expect(sources.map(({ id }) => id)).toEqual(sources.map((_, s) => s + 1));
    for (const source of sources) expect(source.size).toBeLessThan(0.5);
    const [plain, refined] = [
      await mesher.meshProject(bare(curved), { size }),
      await mesher.meshProject(withSources(bare(curved), ...sources), { size }),
    ];
    expectDone(refined);
    expect(refined.report.tetrahedra).toBeGreaterThan(plain.report.tetrahedra);
  });

  test("consist only of the uniform size if curvature and gaps are ignored", async () => {
    const options = { maxSize: 0.5, anglePerEdge: 0, layers: 0 };
    expect(await mesher.proposeSizes(curved, options)).toEqual({ size: 0.5, sources: [] });
  });

  test("are rejected for invalid options", async () => {
    await expect(mesher.proposeSizes(curved, { growth: -1 })).rejects.toThrow(
      /growth is -1\. Use a growth from 0 to 10/,
    );
  });
});

/** Replaces the first edge, between bottom and front, by a curve within the plane of the bottom. */
function withBentEdge(cube: Project): Project {
  const [first] = cube.lines;
  const middle = { id: 100, position: [0.5, 0.2, 0] as const };
  const planeOfFront = new Set(cube.patches.filter(({ name }) => name === "front").map(({ id }) => id));
  return {
    ...cube,
    points: [...cube.points, middle],
    lines: cube.lines.map((line) =>
      line.id === first?.id ? { ...line, type: "parabolic", points: [1, 100, 2] } : line,
    ),
    patches: cube.patches.map((patch) =>
      planeOfFront.has(patch.id) ? { ...patch, type: "coons" as const } : patch,
    ),
  };
}

describe("a background grid made from a mesh", () => {
  test("asks for about as many elements as the mesh has", async () => {
    const first = await mesher.meshProject(cubeProject(0.12));
    const background = await mesher.backgroundFromMesh(first.mesh);
    expect(background.sizes.length).toBe(first.report.nodes);
    expect(background.tetrahedra.length).toBe(first.mesh.tetrahedra.length);
    const again = await mesher.meshProject(bare(cubeProject()), { background });
    expectDone(again);
    expect(again.report.tetrahedra / first.report.tetrahedra).toBeGreaterThan(0.75);
    expect(again.report.tetrahedra / first.report.tetrahedra).toBeLessThan(1.35);
    expect(first.mesh.points.length).toBe(3 * first.report.nodes);
  });

  test("takes sizes per node and omits unused nodes", async () => {
    const { mesh: volume } = await mesher.meshProject(cubeProject(0.5));
    const points = Float64Array.of(9, 9, 9, ...volume.points);
    const tetrahedra = volume.tetrahedra.map((node) => node + 1);
    const sizes = new Float64Array(points.length / 3).fill(0.3);
    const background = await mesher.backgroundFromMesh({ points, tetrahedra }, { sizes });
    expect([...background.points]).toEqual([...volume.points]);
    expect([...new Set(background.sizes)]).toEqual([0.3]);
    const [byGrid, bySize] = [
      await mesher.meshProject(cubeProject(), { background }),
      await mesher.meshProject(cubeProject(), { size: 0.3 }),
    ];
    expectDone(byGrid);
    // Interpolated sizes differ from a uniform size by rounding, which can change the choice of a candidate.
    expect(byGrid.report.tetrahedra / bySize.report.tetrahedra).toBeCloseTo(1, 1);
  });

  test("gives the same mesh as arrays and as the grid of a project", async () => {
    const { mesh: volume } = await mesher.meshProject(cubeProject(0.4));
    const background = await mesher.backgroundFromMesh(volume);
    const project = { ...cubeProject(), background: projectBackground(background) };
    expect(readProject(writeProject(project))).toEqual({ success: true, value: project });
    const [byArrays, byProject] = [
      await mesher.meshProject(cubeProject(), { background }),
      await mesher.meshProject(project),
    ];
    expect(byArrays.report.fingerprint).toBe(byProject.report.fingerprint);
  });

  const corner = {
    points: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1),
    tetrahedra: Uint32Array.of(0, 1, 2, 3),
  };

  test.each<[string, object, object, RegExp]>([
    [
      "a mesh without tetrahedra",
      { points: corner.points, tetrahedra: new Uint32Array() },
      {},
      /no tetrahedron\. Mesh/,
    ],
    [
      "plain lists",
      { points: [0, 0, 0], tetrahedra: [0] },
      {},
      /mesh\.points .*expected a Float64Array, received a list/,
    ],
    [
      "a node index out of range",
      { ...corner, tetrahedra: Uint32Array.of(0, 1, 2, 9) },
      {},
      /tetrahedron 0 .* node 9, but there are 4 nodes/,
    ],
    [
      "a wrong number of sizes",
      corner,
      { sizes: Float64Array.of(1, 1) },
      /expected one size for each of 4 nodes/,
    ],
    ["a size of 0", corner, { sizes: Float64Array.of(1, 1, 0, 1) }, /node 2 .*size 0\. Pass/i],
  ])("is rejected for %s", async (_, mesh, options, message) => {
    const refused = mesher.backgroundFromMesh(mesh as VolumeInput, options);
    await expect(refused).rejects.toMatchObject({ code: "invalid-input" });
    await expect(refused).rejects.toThrow(message);
  });

  test("is returned while a run is active", async () => {
    let isOver = false;
    const run = mesher.fillSurface(sphereSurface(24)).then(() => (isOver = true));
    const { coverageMargin } = await mesher.backgroundFromMesh(corner);
    expect([coverageMargin ?? 0, isOver]).toEqual([expect.closeTo(0.25, 12), false]);
    await run;
  });
});

/** One tetrahedron around the model, with one size. */
function around(size: number, more: Partial<BackgroundArrays> = {}): BackgroundArrays {
  return {
    points: Float64Array.of(-4, -4, -4, 20, -4, -4, -4, 20, -4, -4, -4, 20),
    sizes: new Float64Array(4).fill(size),
    tetrahedra: Uint32Array.of(0, 1, 2, 3),
    ...more,
  };
}

/** Refines the surface to the sizes of the elements before meshing. */
async function refinedAndFilled(given: SurfaceInput, options: MeshOptions) {
  const { mesh: surface } = await mesher.refineSurface(given, options);
  return mesher.fillSurface(surface, options);
}

describe("a background grid passed as arrays", () => {
  test("determines the sizes in a given surface", async () => {
    const surface = boxSurface(6);
    const [own, coarse, fine] = [
      await mesher.fillSurface(surface),
      await mesher.fillSurface(surface, { background: around(0.4) }),
      await refinedAndFilled(surface, { background: around(0.1) }),
    ];
    for (const result of [own, coarse, fine]) expectDone(result);
    expect(coarse.report.tetrahedra).toBeLessThan(own.report.tetrahedra);
    expect(fine.report.tetrahedra).toBeGreaterThan(2 * own.report.tetrahedra);
  });

  test("stretches elements along its directions", async () => {
    const surface = boxSurface(6);
    const directions = Float64Array.from({ length: 12 }, (_, i) => (i % 3 === 0 ? 2 : 0));
    const stretched = around(0.1, { stretchings: new Float64Array(4).fill(3), directions });
    const [round, long] = [
      await refinedAndFilled(surface, { background: around(0.1), optimization: "none" }),
      await refinedAndFilled(surface, { background: stretched }),
    ];
    expectDone(long);
    expect(1.8 * long.report.tetrahedra).toBeLessThan(round.report.tetrahedra);
  });

  test("makes elements thin in one direction and wide in two", async () => {
    const axis = (k: number) => Float64Array.from({ length: 12 }, (_, i) => (i % 3 === k ? 2 : 0));
    const four = new Float64Array(4).fill(4);
    const thin = around(0.12, {
      stretchings: four,
      directions: axis(0),
      secondStretchings: four,
      secondDirections: axis(1),
    });
    const surface = boxSurface(1);
    const remeshed = (background: BackgroundArrays) => mesher.remeshSurface(surface, { background });
    const [{ mesh: flat }, { mesh: round }] = [await remeshed(thin), await remeshed(around(0.12))];
    const run = await mesher.fillSurface(flat, { background: thin });
    expectDone(run);
    const { report } = await mesher.fillSurface(round, { background: around(0.12), optimization: "none" });
    const ratio = report.tetrahedra / run.report.tetrahedra;
    expect(ratio).toBeGreaterThan(11);
    expect(ratio).toBeLessThan(21);
    // The grid of a project has the same second stretchings.
    const project = { ...cubeProject(), background: projectBackground(thin) };
    expect(readProject(writeProject(project))).toEqual({ success: true, value: project });
    const { secondStretchings, secondDirections } = backgroundArrays(project.background);
    expect({ secondStretchings, secondDirections }).toEqual({
      secondStretchings: four,
      secondDirections: axis(1),
    });
    const [byArrays, byProject] = [
      await mesher.meshProject(cubeProject(), { background: thin }),
      await mesher.meshProject(project),
    ];
    expect(byArrays.report.fingerprint).toBe(byProject.report.fingerprint);
  });

  test("keeps the sources of a project and the caller's arrays", async () => {
    const source: ProjectSource = { id: 1, type: "point", positions: [[0, 0, 0]], size: 0.08, distance: 0.3 };
    const background = around(0.5);
    const [plain, refined] = [
      await mesher.meshProject(cubeProject(), { background }),
      await mesher.meshProject(withSources(cubeProject(), source), { background }),
    ];
    expect(refined.report.tetrahedra).toBeGreaterThan(2 * plain.report.tetrahedra);
    expect(background.sizes).toHaveLength(4);
  });

  test("can include sources, or consist only of sources for a surface", async () => {
    const sources: ProjectSource[] = [
      { id: 1, type: "point", positions: [[0, 0, 0]], size: 0.1, distance: 0.2 },
    ];
    const alone = {
      points: new Float64Array(),
      sizes: new Float64Array(),
      tetrahedra: new Uint32Array(),
      sources,
    };
    const [own, refined] = [
      await mesher.fillSurface(boxSurface(3)),
      await refinedAndFilled(boxSurface(3), { background: alone }),
    ];
    expectDone(refined);
    expect(refined.report.tetrahedra).toBeGreaterThan(1.3 * own.report.tetrahedra);
    const project = {
      ...cubeProject(),
      background: { ...cubeProject().background, sources, coverageMargin: 0.1 },
    };
    const read = backgroundArrays(project.background);
    expect(projectBackground(read)).toEqual(project.background);
  });

  test.each<[string, object, string, RegExp]>([
    [
      "with a point source that has two positions",
      {
        background: around(1, {
          sources: [
            {
              id: 1,
              type: "point",
              positions: [
                [0, 0, 0],
                [1, 0, 0],
              ],
              size: 1,
            },
          ],
        }),
      },
      "invalid-arrays",
      /"point" needs 1 position, found 2/,
    ],
    ["together with a size", { background: around(0.3), size: 0.2 }, "invalid-option", /both/i],
    [
      "that is not an object",
      { background: null },
      "invalid-arrays",
      /background is invalid: expected an object, received null/,
    ],
    [
      "with a missing size",
      { background: around(1, { sizes: new Float64Array(3).fill(1) }) },
      "invalid-arrays",
      /3 sizes/,
    ],
    [
      "with missing directions",
      { background: around(1, { directions: new Float64Array(6) }) },
      "invalid-arrays",
      /fit/,
    ],
    ["with a size of 0", { background: around(0) }, "size-out-of-range", /^Background node 0 .*size 0/],
    [
      "with a stretching of 0",
      { background: around(1, { stretchings: new Float64Array(4) }) },
      "stretching-out-of-range",
      /node 0 .*stretching 0/,
    ],
    [
      "with directions that are not orthogonal",
      {
        background: around(1, {
          stretchings: new Float64Array(4).fill(2),
          directions: Float64Array.from({ length: 12 }, (_, i) => Number(i % 3 === 0)),
          secondStretchings: new Float64Array(4).fill(3),
          secondDirections: Float64Array.from({ length: 12 }, (_, i) => Number(i % 3 < 2)),
        }),
      },
      "second-stretching-out-of-range",
      /node 0 .*two directions at an angle of 45°/,
    ],
    [
      "with too few second stretchings",
      { background: around(1, { secondStretchings: new Float64Array(3).fill(1) }) },
      "invalid-arrays",
      /fit/,
    ],
    [
      "with a node index out of range",
      { background: around(1, { tetrahedra: Uint32Array.of(0, 1, 2, 4) }) },
      "index-out-of-range",
      /tetrahedron 0 .*(index|node) 4/,
    ],
    [
      "that does not cover the cube",
      { background: around(1, { points: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1) }) },
      "outside-background-grid",
      /outside the background grid/,
    ],
    [
      "with a negative coverage margin",
      { background: around(1, { coverageMargin: -1 }) },
      "invalid-arrays",
      /coverageMargin .*expected a finite number from 0 on, received -1/,
    ],
  ])("is rejected %s, for projects and surfaces", async (_, options, code, message) => {
    for (const run of [
      mesher.meshProject(cubeProject(), options),
      mesher.fillSurface(boxSurface(2), options),
    ]) {
      const { report } = await run;
      expect(report.status).toBe("invalid-input");
      expect(report.diagnostics[0]?.code).toBe(code);
      expect(report.diagnostics[0]?.message).toMatch(message);
      expect(report.diagnostics[0]?.remedy).toMatch(/^[A-Z].*\.$/);
    }
  });
});

describe("a preview", () => {
  test("does not report a missing grid if a uniform size is given", async () => {
    const project = bare(cubeProject());
    const codes = async (options?: object) =>
      (await mesher.previewProject(project, options)).diagnostics.map(({ code }) => code);
    expect(await codes()).toEqual(["empty-background-grid"]);
    expect(await codes({ size: 0.2 })).toEqual([]);
    expect(await codes({ size: 0 })).toEqual(["invalid-option", "empty-background-grid"]);
  });

  test("checks a grid of arrays like the grid of a project", async () => {
    const { nodes, ...rest } = cubeProject().background;
    const withNegativeSize = nodes.map((node, i) => (i === 2 ? { ...node, size: -1 } : node));
    for (const background of [
      { ...rest, nodes },
      { ...rest, nodes: withNegativeSize },
    ]) {
      const own = (await mesher.previewProject({ ...cubeProject(), background })).diagnostics;
      const project = bare(cubeProject());
      const given = await mesher.previewProject(project, { background: backgroundArrays(background) });
      expect(
        given.diagnostics.map(({ code, entities }) => [code, entities.map(({ index }) => index)]),
      ).toEqual(own.map(({ code, entities }) => [code, entities.map(({ index }) => index)]));
      expect(own.length > 0).toBe(background.nodes === withNegativeSize);
    }
    const unusable = { background: { ...backgroundArrays(cubeProject().background), sizes: [1] } } as never;
    const { diagnostics } = await mesher.previewProject(bare(cubeProject()), unusable);
    expect(diagnostics.map(({ code }) => code)).toContain("invalid-arrays");
  });
});

test("the report lists every patch", async () => {
  const { report } = await mesher.meshProject(cubeProject(0.2));
  expect(report.patches.map(({ patch }) => patch)).toEqual([0, 1, 2, 3, 4, 5]);
  expect(report.patches.reduce((sum, { triangles }) => sum + triangles, 0)).toBe(report.triangles);
  for (const quality of report.patches) {
    expect(quality.minAngle).toBeGreaterThan(20);
    expect(quality.meanRadiusRatio).toBeGreaterThan(0.9);
    expect(Math.abs(quality.meanEdge - 1)).toBeLessThan(0.15);
    expect(quality.chordDeviation ?? NaN).toBeLessThan(1e-12);
  }
});
