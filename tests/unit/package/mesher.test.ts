import { readFileSync } from "node:fs";

import {
  createMesher,
  NO_REGION,
  type Mesher,
  type MeshOptions,
  type MeshResult,
  type CallProgress,
  type SurfaceInput,
} from "tetrafront";
import { readProject, type Project } from "tetrafront/project";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { expectValid } from "../../support/expect-valid.js";
import { cubeProject } from "../../support/projects.js";
import {
  boxSurface,
  cavitySurface,
  joined,
  needleGearSurface,
  sphereSurface,
  torusSurface,
  turned,
} from "../../support/surfaces.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

/**
 * Returns the number of elements of the unit cube whose centroid lies within 0.2 of its centre along every
 * axis.
 */
function elementsInTheMiddle({ mesh: { points, tetrahedra } }: MeshResult): number {
  let count = 0;
  for (let t = 0; t < tetrahedra.length; t += 4) {
    const corners = tetrahedra.subarray(t, t + 4);
    const isInside = [0, 1, 2].every((axis) => {
      const sum = corners.reduce((total, node) => total + (points[3 * node + axis] ?? NaN), 0);
      return Math.abs(sum / 4 - 0.5) < 0.2;
    });
    if (isInside) ++count;
  }
  return count;
}

test("lattices fill the deep inside where that is asked for, but not in a recorded run", async () => {
  const filled = async (options: MeshOptions, control = {}) =>
    (await mesher.fillSurface(sphereSurface(12), options, control)).report;
  const front = await filled({ interior: "front" });
  const lattice = await filled({ interior: "lattice" });
  expect(front.interior).toEqual({ lattice: 0 });
  expect(lattice.interior.lattice).toBeGreaterThan(0.2 * lattice.tetrahedra);
  expect(lattice.radiusRatio.mean).toBeGreaterThan(front.radiusRatio.mean);
  const recorded = await filled({ interior: "lattice" }, { onTrace: () => undefined });
  expect(recorded.fingerprint).toBe(front.fingerprint);
});

test("thorough optimization reports that it found no better mesh, and only then", async () => {
  const both = async (surface: SurfaceInput) => {
    const { report } = await mesher.fillSurface(surface);
    const thorough = (await mesher.fillSurface(surface, { optimization: "thorough" })).report;
    const found = thorough.diagnostics.filter(({ code }) => code === "no-improvement");
    return {
      isSame: report.fingerprint === thorough.fingerprint,
      severities: found.map(({ severity }) => severity),
    };
  };
  expect(await both(boxSurface(2))).toEqual({ isSame: true, severities: ["information"] });
  expect(await both(sphereSurface(4))).toEqual({ isSame: false, severities: [] });
});

describe("fillSurface", () => {
  test.each<[string, SurfaceInput, number]>([
    [
      "a tetrahedron",
      {
        points: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1),
        triangles: Uint32Array.of(0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3),
      },
      1,
    ],
    ["a cube of 12 triangles", boxSurface(1), 5],
    ["a cube", boxSurface(10), 4000],
    ["a sphere", sphereSurface(12), 3000],
    ["a torus", torusSurface(60, 24), 4000],
    ["a cube with a cavity", cavitySurface(12), 5000],
    [
      "a box of edge 1e-3 at a distance of a million",
      boxSurface(4, [1e6, 1e6, 1e6], [1e6 + 1e-3, 1e6 + 1e-3, 1e6 + 1e-3]),
      50,
    ],
  ])("fills %s and keeps every triangle", async (_, surface, least) => {
    const result = await mesher.fillSurface(surface);
    expectValid(result, surface);
    expect(result.report.tetrahedra).toBeGreaterThanOrEqual(least);
  });

  test("makes two regions of two separate spheres", async () => {
    const surface = joined(sphereSurface(6), sphereSurface(5, 0.7, [4, 0, 0]));
    const result = await mesher.fillSurface(surface);
    expectValid(result, surface);
    expect([...new Set(result.mesh.tetrahedronRegion)].sort()).toEqual([0, 1]);
    expect([...new Set(result.mesh.trianglePatch)].sort()).toEqual([0, 1]);
  });

  test("flips an inverted surface and reports it", async () => {
    const surface = sphereSurface(6);
    const result = await mesher.fillSurface(turned(surface));
    expectValid(result, surface);
    expect(result.report.diagnostics).toMatchObject([{ code: "reoriented-patch", severity: "information" }]);
  });

  test("with a size limits elements away from a coarser boundary", async () => {
    const surface = boxSurface(10);
    const [free, fine] = [
      await mesher.fillSurface(surface),
      await mesher.fillSurface(surface, { size: 0.04 }),
    ];
    expectValid(fine, surface);
    expect(elementsInTheMiddle(fine)).toBeGreaterThan(8 * elementsInTheMiddle(free));
  });

  test("fills a surface in the order of the paper", async () => {
    const surface = sphereSurface(8);
    expectValid(await mesher.fillSurface(surface, { order: "smallest-first" }), surface);
  });

  test("without filters does more work and gives the same mesh", async () => {
    const surface = sphereSurface(8);
    const options = { order: "smallest-first", optimization: "none" } as const;
    const [filtered, analysed] = [
      (await mesher.fillSurface(surface, options)).report,
      (await mesher.fillSurface(surface, { ...options, filters: false })).report,
    ];
    expect(analysed.fingerprint).toBe(filtered.fingerprint);
    expect(analysed.front.facesTested).toBe(filtered.front.facesTested);
    expect(analysed.front.facesAnalysed).toBeGreaterThan(5 * filtered.front.facesAnalysed);
  });

  test("improves the elements by optimization and keeps the boundary", async () => {
    const surface = cavitySurface(8);
    const [raw, fast, full] = await Promise.all([
      mesher.fillSurface(surface, { optimization: "none" }),
      mesher.fillSurface(surface, { optimization: "fast" }),
      mesher.fillSurface(surface),
    ]);
    for (const result of [raw, fast, full]) expectValid(result, surface);
    expect(raw.report.seconds.optimize).toBeLessThan(0.01);
    expect(full.report.seconds.optimize).toBeGreaterThan(0);
    expect(fast.report.dihedral.min).toBeGreaterThan(raw.report.dihedral.min + 5);
    expect(full.report.radiusRatio.mean).toBeGreaterThan(raw.report.radiusRatio.mean + 0.05);
  });

  test("does not change the caller's arrays", async () => {
    const surface = boxSurface(2);
    const before = { points: [...surface.points], triangles: [...surface.triangles] };
    await mesher.fillSurface(surface);
    expect({ points: [...surface.points], triangles: [...surface.triangles] }).toEqual(before);
  });
});

describe("meshProject meshes", () => {
  test("the unit cube", async () => {
    const result = await mesher.meshProject(cubeProject(0.2));
    expectValid(result);
    expect(Math.abs(result.report.volume - 1)).toBeLessThan(1e-12);
    // Twelve lines of five sides, and all six patches.
    expect(result.sideLine).toHaveLength(60);
    expect([...new Set(result.mesh.trianglePatch)].sort()).toEqual([0, 1, 2, 3, 4, 5]);
  });

  test("a project without background grid with a uniform size", async () => {
    const bare = { ...cubeProject(), background: { nodes: [], tetrahedra: [] } };
    const [coarse, fine] = [
      await mesher.meshProject(bare, { size: 0.25 }),
      await mesher.meshProject(bare, { size: 0.125 }),
    ];
    expectValid(coarse);
    expectValid(fine);
    // Half the size gives about eight times as many elements.
    expect(fine.report.tetrahedra / coarse.report.tetrahedra).toBeGreaterThan(4);
    expect(fine.report.tetrahedra / coarse.report.tetrahedra).toBeLessThan(16);
  });

  test("the example in docs/FORMAT.md", async () => {
    const text = readFileSync(new URL("../../../docs/FORMAT.md", import.meta.url), "utf8");
    const read = readProject(/```json\n([^]*?)```/.exec(text)?.[1] ?? "");
    if (!read.success) throw new Error(read.errors[0].message);
    const result = await mesher.meshProject(read.value);
    expectValid(result);
    expect(Math.abs(result.report.volume - 8 / 6)).toBeLessThan(1e-12);
  });
});

describe("inner shells", () => {
  test("are cavities, or regions on request", async () => {
    const surface = cavitySurface(6);
    const [empty, filled] = await Promise.all([
      mesher.fillSurface(surface),
      mesher.fillSurface(surface, { innerShells: "regions" }),
    ]);
    expectValid(empty, surface);
    expect(empty.report.quality.regions).toHaveLength(1);
    expect(filled.report.status).toBe("done");
    const volumes = filled.report.quality.regions.map(({ volume }) => volume);
    expect(volumes).toHaveLength(2);
    // The outer region is what was filled before.
    expect(volumes[0]).toBeCloseTo(empty.report.volume, 12);
    expect(filled.report.volume).toBeCloseTo(Number(volumes[0]) + Number(volumes[1]), 12);
    // Both sides of the inner sphere's triangles, and of no others, belong to a region.
    const { triangleRegions = new Uint32Array() } = filled.mesh;
    const isInterface = (triangle: number): boolean =>
      [0, 1].every((side) => triangleRegions[2 * triangle + side] !== NO_REGION);
    const box = boxSurface(6).triangles.length / 3;
    for (let t = 0; t < triangleRegions.length / 2; ++t) expect(isInterface(t)).toBe(t >= box);
  });
});

describe("the meshing settings of a project", () => {
  const coarse = cubeProject(0.5);
  const meshing = { size: 0.2, order: "smallest-first", optimization: "none", gradation: 0 } as const;

  test("are applied", async () => {
    const [bySettings, byOptions] = await Promise.all([
      mesher.meshProject({ ...coarse, meshing }),
      mesher.meshProject(coarse, {
        size: 0.2,
        order: "smallest-first",
        optimization: "none",
        growth: Infinity,
      }),
    ]);
    expectValid(bySettings);
    expect(bySettings.report.fingerprint).toBe(byOptions.report.fingerprint);
    expect(bySettings.report.seconds.optimize).toBeLessThan(0.01);
  });

  test("a gradation is 1 + growth", async () => {
    const [first, ...others] = coarse.background.nodes;
    if (first === undefined) throw new Error("the grid has no nodes");
    const nodes = [{ ...first, size: 0.1 }, ...others];
    const graded = { ...coarse, background: { ...coarse.background, nodes } };
    const fingerprintOf = async (gradation: number | undefined, growth?: number) => {
      const project = { ...graded, ...(gradation !== undefined && { meshing: { gradation } }) };
      return (await mesher.meshProject(project, { growth })).report.fingerprint;
    };
    const steep = await fingerprintOf(1.1);
    expect(steep).toHaveLength(16);
    expect(await fingerprintOf(undefined, 0.1)).toBe(steep);
    expect(await fingerprintOf(1.5, 0.1)).toBe(steep);
    expect(await fingerprintOf(undefined)).not.toBe(steep);
    expect(await fingerprintOf(undefined, 0.3)).toBe(await fingerprintOf(undefined));
    expect(await fingerprintOf(undefined, Infinity)).toBe(await fingerprintOf(0));
  });

  test("a gradation that lets sizes shrink is refused", async () => {
    const { report } = await mesher.meshProject({ ...coarse, meshing: { gradation: 0.5 } });
    expect(report.diagnostics[0]?.message).toMatch(/gradation is 0\.5/);
  });

  test("are overridden by the options of the call", async () => {
    const project = { ...coarse, meshing: { size: 0.1 } };
    const { nodes, tetrahedra } = coarse.background;
    const grid = {
      points: Float64Array.from(nodes.flatMap(({ position }) => position)),
      sizes: Float64Array.from(nodes, ({ size }) => size),
      tetrahedra: Uint32Array.from(tetrahedra.flat(), (id) => id - 1),
    };
    const expected = await mesher.meshProject(coarse);
    const [bySize, byGrid] = await Promise.all([
      mesher.meshProject(project, { size: 0.2 }),
      mesher.meshProject(project, { background: grid }),
    ]);
    expect(bySize.report.fingerprint).toBe(
      (await mesher.meshProject(coarse, { size: 0.2 })).report.fingerprint,
    );
    expect(byGrid.report.fingerprint).toBe(expected.report.fingerprint);
  });

  test("are used by a preview, which reports an invalid size", async () => {
    const bare = { ...coarse, background: { nodes: [], tetrahedra: [] } };
    const codes = async (size: number) => {
      const { diagnostics } = await mesher.previewProject({ ...bare, meshing: { size } });
      return diagnostics.map(({ code }) => code);
    };
    expect(await codes(0.2)).toEqual([]);
    expect(await codes(-1)).toContain("invalid-option");
    const { report } = await mesher.meshProject({ ...bare, meshing: { size: -1 } });
    expect(report).toMatchObject({ status: "invalid-input", diagnostics: [{ code: "invalid-option" }] });
  });
});

describe("invalid input gives a result with diagnostics:", () => {
  const { points, triangles } = boxSurface(2);
  const withPatches = (change: (cube: Project) => Partial<Project>): Project => {
    const cube = cubeProject();
    return { ...cube, ...change(cube) };
  };

  test.each<[string, SurfaceInput, string]>([
    ["an open surface", { points, triangles: triangles.subarray(3) }, "open-edge"],
    ["a coordinate that is not finite", { points: points.with(4, NaN), triangles }, "not-finite"],
    ["a node index out of range", { points, triangles: triangles.with(7, 1000) }, "index-out-of-range"],
    [
      "two intersecting spheres",
      joined(sphereSurface(4), sphereSurface(4, 1, [0.9, 0, 0])),
      "self-intersection",
    ],
    ["no triangle", { points: new Float64Array(), triangles: new Uint32Array() }, "empty-model"],
    ["half a triangle", { points, triangles: triangles.subarray(1) }, "invalid-arrays"],
    [
      "plain lists",
      { points: [...points], triangles: [...triangles] } as unknown as SurfaceInput,
      "invalid-arrays",
    ],
  ])("%s", async (_, surface, code) => {
    const { report, mesh: volume } = await mesher.fillSurface(surface);
    expect(report.status).toBe("invalid-input");
    expect(report.diagnostics.map((diagnostic) => diagnostic.code)).toContain(code);
    expect(volume.tetrahedra).toHaveLength(0);
  });

  test.each<[string, Project, string, RegExp]>([
    ["a missing patch", withPatches((cube) => ({ patches: cube.patches.slice(1) })), "open-edge", /line \d+/],
    [
      "a corner outside the plane of a patch",
      withPatches((cube) => ({
        points: cube.points.map((p) => (p.id === 8 ? { ...p, position: [1, 1, 1.5] } : p)),
      })),
      "not-planar",
      /patch "(top|back|right)" is planar, but point 8 is 0.5 away from its plane/i,
    ],
    [
      "a loop with a gap",
      withPatches((cube) => ({
        patches: cube.patches.map((p) => (p.id === 3 ? { ...p, loops: [p.loops[0]?.slice(1) ?? []] } : p)),
      })),
      "loop-not-closed",
      /patch "front"/,
    ],
    [
      "a size of 0 at a node",
      withPatches((cube) => ({
        background: {
          ...cube.background,
          nodes: cube.background.nodes.map((n) => (n.id === 4 ? { ...n, size: 0 } : n)),
        },
      })),
      "size-out-of-range",
      /^Background node 4 /,
    ],
    [
      "a grid that does not cover the model",
      withPatches((cube) => ({
        background: { ...cube.background, tetrahedra: cube.background.tetrahedra.slice(0, 1) },
      })),
      "outside-background-grid",
      / at \(/,
    ],
    [
      "no grid and no size",
      withPatches(() => ({ background: { nodes: [], tetrahedra: [] } })),
      "empty-background-grid",
      /background/,
    ],
    ["no patches", withPatches(() => ({ patches: [] })), "empty-model", /nothing to mesh/],
    [
      "an id used twice",
      withPatches((cube) => ({ points: [...cube.points, { id: 1, position: [0, 0, 0] }] })),
      "invalid-project",
      /points\[8\]\.id/,
    ],
  ])("%s", async (_, project, code, message) => {
    const { report } = await mesher.meshProject(project);
    expect(report.status).toBe("invalid-input");
    const found = report.diagnostics.find((diagnostic) => diagnostic.code === code);
    expect(report.diagnostics.map((diagnostic) => diagnostic.code)).toContain(code);
    expect(found?.message).toMatch(message);
  });

  test.each([
    { size: NaN },
    { size: 0 },
    { size: -1 },
    { size: Infinity },
    { growth: -0.1 },
    { growth: NaN },
  ])("the options %j", async (options) => {
    const { report } = await mesher.fillSurface(boxSurface(2), options);
    expect(report).toMatchObject({ status: "invalid-input", diagnostics: [{ code: "invalid-option" }] });
  });
});

describe("a preview", () => {
  test("samples every line and patch", async () => {
    const preview = await mesher.previewProject(cubeProject());
    expect(preview.diagnostics).toEqual([]);
    expect(preview.lineOffsets).toHaveLength(13);
    expect(preview.patchOffsets).toHaveLength(7);
    expect(preview.patchOffsets[6]).toBe(preview.patchTriangles.length / 3);
    expect(Math.max(...preview.linePoints)).toBe(1);
  });

  test("of an invalid project shows the valid parts and reports the rest", async () => {
    const cube = cubeProject();
    const patches = cube.patches.map((p) => (p.id === 1 ? { ...p, loops: [[1, 2]] } : p));
    const preview = await mesher.previewProject({ ...cube, patches });
    expect(preview.lineOffsets).toHaveLength(13);
    expect(preview.patchTriangles.length).toBeGreaterThan(0);
    expect(preview.diagnostics.map(({ entities }) => entities[0]?.label)).toContain('patch "bottom"');
  });

  test("of samples only has the same samples, and the problems of single parts alone", async () => {
    const cube = cubeProject();
    const patches = cube.patches.flatMap((p) =>
      p.id === 1 ? [] : p.id === 2 ? [{ ...p, loops: [[1, 2]] }] : [p],
    );
    const broken = { ...cube, patches };
    const { diagnostics, ...samples } = await mesher.previewProject(broken, { samplesOnly: true });
    const { diagnostics: all, ...expected } = await mesher.previewProject(broken);
    expect(samples).toEqual(expected);
    const codes = new Set(diagnostics.map(({ code }) => code));
    expect(codes).toContain("loop-not-closed");
    expect(codes).not.toContain("open-edge");
    expect(all.map(({ code }) => code)).toContain("open-edge");
  });

  test("names a missing background node", async () => {
    const cube = cubeProject();
    const [first = [1, 2, 3, 4], ...rest] = cube.background.tetrahedra;
    const tetrahedra = [[first[0], first[1], 4711, first[3]] as const, ...rest];
    const { diagnostics } = await mesher.previewProject({
      ...cube,
      background: { ...cube.background, tetrahedra },
    });
    const missing = diagnostics.find(({ code }) => code === "index-out-of-range");
    expect(missing?.message).toMatch(/tetrahedron 0.* refers to background node 4711, which does not exist/);
  });

  test("is returned while a run is active", async () => {
    let running = true;
    const run = mesher.fillSurface(sphereSurface(24)).finally(() => (running = false));
    await mesher.previewProject(cubeProject());
    expect(running).toBe(true);
    expect((await run).report.status).toBe("done");
  });
});

test("the same input gives the same mesh in the same worker and in another", async () => {
  const surface = cavitySurface(8);
  const other = await createMesher();
  const results = [
    await mesher.fillSurface(surface),
    await mesher.fillSurface(surface),
    await other.fillSurface(surface),
  ];
  other.dispose();
  const [first, ...rest] = results.map(({ mesh, report }) => ({ mesh, fingerprint: report.fingerprint }));
  for (const same of rest) expect(same).toEqual(first);
});

describe("progress", () => {
  test("never decreases and is reported at most ten times per second and once at the end", async () => {
    const seen: { progress: CallProgress; at: number }[] = [];
    const { report } = await mesher.fillSurface(
      sphereSurface(24),
      {},
      {
        onProgress: (progress) => seen.push({ progress, at: progress.elapsedSeconds }),
      },
    );
    expect(seen.length).toBeGreaterThan(0);
    expect(seen.length).toBeLessThanOrEqual(2 + 10 * report.seconds.total);
    seen.reduce((before, after) => {
      expect(after.progress.fraction).toBeGreaterThanOrEqual(before.progress.fraction);
      expect(after.at).toBeGreaterThanOrEqual(before.at);
      return after;
    });
    expect(seen.at(-1)?.progress.tetrahedra).toBe(report.tetrahedra);
    expect(Math.max(...seen.map(({ progress }) => progress.fraction))).toBeLessThanOrEqual(1);
  });

  test("reports phase times that add up to at most the total", async () => {
    const { total, ...phases } = (await mesher.meshProject(cubeProject(0.1))).report.seconds;
    const sum = Object.values(phases).reduce((a, b) => a + b, 0);
    expect(sum).toBeGreaterThan(0);
    expect(sum).toBeLessThanOrEqual(total);
  });
});

describe("cancelling", () => {
  /** Large enough to run for a long time on any machine. */
  const large = sphereSurface(90);
  /** The limit is 100 ms; a loaded machine delays timers and messages. */
  const LENIENT_MS = 400;

  // If the machine is so loaded that the worker misses its limit of 0.5 s, the partial mesh is lost, as
  // documented. Then retry.
  test("ends a run and returns the partial mesh", { retry: 3 }, async () => {
    const stop = new AbortController();
    let abortedAt = NaN;
    const result = await mesher.fillSurface(
      large,
      { interior: "front" },
      {
        signal: stop.signal,
        onProgress: ({ tetrahedra }) => {
          if (tetrahedra === 0 || stop.signal.aborted) return;
          abortedAt = performance.now();
          stop.abort();
        },
      },
    );
    expect(performance.now() - abortedAt).toBeLessThan(LENIENT_MS);
    expect(result.report.status).toBe("cancelled");
    expect(result.report.tetrahedra).toBeGreaterThan(0);
    expect(result.front.length).toBeGreaterThan(0);
    const [region, ...others] = result.report.regions;
    expect(others).toEqual([]);
    expect(region?.tetrahedra).toBe(result.report.tetrahedra);
    expect(region?.volume).toBeCloseTo(result.report.volume, 9);
  });

  test("ends the exact fill, which reports its progress", { retry: 3 }, async () => {
    const stop = new AbortController();
    const seen: number[] = [];
    let abortedAt = NaN;
    const result = await mesher.fillSurface(
      needleGearSurface(600),
      { exactFillOnly: true },
      {
        signal: stop.signal,
        onProgress: ({ exactFillFraction }) => {
          if (exactFillFraction === 0 || stop.signal.aborted) return;
          seen.push(exactFillFraction);
          if (exactFillFraction < 0.3) return;
          abortedAt = performance.now();
          stop.abort();
        },
      },
    );
    expect(performance.now() - abortedAt).toBeLessThan(LENIENT_MS);
    expect(result.report.status).toBe("cancelled");
    expect(seen.length).toBeGreaterThan(1);
    expect(new Set(seen).size).toBe(seen.length);
    expect(seen).toEqual(seen.toSorted((a, b) => a - b));
  });

  test("before the start, at the start or in the queue ends a run at once", async () => {
    const before = await mesher.fillSurface(large, {}, { signal: AbortSignal.abort() });
    expect(before.report).toMatchObject({ status: "cancelled", tetrahedra: 0 });
    const stops = [new AbortController(), new AbortController()] as const;
    const runs = stops.map(({ signal }) => mesher.fillSurface(large, {}, { signal }));
    stops[1].abort();
    expect((await runs[1])?.report.status).toBe("cancelled");
    stops[0].abort();
    expect((await runs[0])?.report.status).toBe("cancelled");
  });

  test("leaves the mesher usable for the next run", async () => {
    const stop = new AbortController();
    const run = mesher.fillSurface(large, {}, { signal: stop.signal });
    setTimeout(() => stop.abort(), 30);
    expect((await run).report.status).toBe("cancelled");
    expectValid(await mesher.fillSurface(boxSurface(3)), boxSurface(3));
  });
});

describe("an onProgress callback", () => {
  const surface = boxSurface(6);
  const failure = new Error("the caller's own");

  test.each<[string, () => void]>([
    [
      "throws",
      () => {
        throw failure;
      },
    ],
    ["returns a rejected promise", () => Promise.reject(failure)],
  ])("that %s rejects its own call with its error, and no other", async (_, onProgress) => {
    const next = mesher.fillSurface(surface);
    const failing = mesher.fillSurface(surface, { size: 0.02 }, { onProgress });
    const after = mesher.fillSurface(surface);
    await expect(failing).rejects.toBe(failure);
    await expect(mesher.inspectSurface(surface, {}, { onProgress })).rejects.toBe(failure);
    await expect(mesher.repairSurface(surface, {}, { onProgress })).rejects.toBe(failure);
    const { mesh } = await next;
    await expect(mesher.inspectMesh(mesh, { onProgress })).rejects.toBe(failure);
    expect((await after).report).toMatchObject({
      status: "done",
      fingerprint: (await next).report.fingerprint,
    });
    expect((await mesher.inspectSurface(surface)).isFillable).toBe(true);
  });
});
