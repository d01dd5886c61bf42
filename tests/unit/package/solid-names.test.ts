/** Names of regions: those of the parts of an assembly, and of solids with the same name. */
import { readFileSync } from "node:fs";

import {
  createMesher,
  meshFile,
  readSurface,
  type Mesh,
  type MeshReport,
  type RegionSummary,
  type SurfaceInput,
} from "tetrafront";
import { createBodies, createBody } from "tetrafront/project";
import { expect, test } from "vitest";

import { withoutPause } from "../../../wasm/dist/base/steps.js";
import { productSolids, productsOf } from "../../../wasm/dist/formats/step-products.js";
import { cubeProject } from "../../support/projects.js";
import { boxSolid, stepFile } from "../../support/step-files.js";
import { stlText } from "../../support/surface-files.js";
import { boxSurface } from "../../support/surfaces.js";

async function surfaceIn(file: Uint8Array, fileName: string): Promise<Mesh> {
  const read = await readSurface(file, { fileName });
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

test("solids of sub-assemblies have the names of the parts", async () => {
  const file = new URL(
    "../../../node_modules/occt-import-js/test/testfiles/cax-if/as1_pe_203.stp",
    import.meta.url,
  );
  const { surfaceRegions } = await surfaceIn(readFileSync(file), "as1_pe_203.stp");
  const names = surfaceRegions?.regions.map(({ name }) => name) ?? [];
  expect(names.slice(0, 4)).toEqual(["PLATE", "L-BRACKET", "BOLT", "NUT"]);
  const parts = ["BOLT", "L-BRACKET", "NUT", "PLATE", "ROD"];
  const counts = parts.map((part) => names.filter((name) => name.replace(/ \d+$/, "") === part).length);
  expect(counts).toEqual([6, 2, 8, 1, 1]);
  expect(new Set(names).size).toBe(18);
});

test("products of a file are those of its solids; escapes in names are decoded", () => {
  const solids = ["a", "Geh\\X2\\00E4\\X0\\use", "d''e"].map((name, x) =>
    boxSolid(name, [2 * x, 0, 0], [2 * x + 1, 1, 1]),
  );
  const found = withoutPause(productSolids(stepFile(solids)));
  expect(found).toEqual(["a", "Gehäuse", "d'e"].map((product) => ({ product, faces: 6 })));
});

test("a solid that could be one of several products gets no name", () => {
  const solids = [
    { product: "box", faces: 6 },
    { product: "pin", faces: 3 },
    { product: "nut", faces: 8 },
    { product: "cap", faces: 8 },
  ];
  expect(productsOf([6, 3, 8, 8], solids)).toEqual(["box", "pin", "nut", "cap"]);
  expect(productsOf([3, 8, 6], solids)).toEqual(["pin", undefined, "box"]);
});

test("solids of an STL file with the same name are numbered", async () => {
  const text = [0, 3, 6].map((x) => new TextDecoder().decode(stlText(shifted(x), "x"))).join("");
  const surface = await surfaceIn(new TextEncoder().encode(text), "x.stl");
  const mesher = await createMesher();
  const result = await mesher.fillSurface(surface, { size: 2 });
  expect(result.mesh.regions.map(({ name }) => name)).toEqual(["x", "x 2", "x 3"]);
  mesher.dispose();
});

function shifted(x: number) {
  const { points, triangles } = boxSurface(1);
  return { points: points.map((value, i) => (i % 3 === 0 ? value + x : value)), triangles };
}

const NOTHING_DRAWN = {
  points: [],
  lines: [],
  patches: [],
  background: { nodes: [], tetrahedra: [], sources: [] },
};

const stlOf = (solids: Readonly<Record<string, SurfaceInput>>): Uint8Array =>
  new TextEncoder().encode(
    Object.entries(solids)
      .map(([name, surface]) => new TextDecoder().decode(stlText(surface, name)))
      .join(""),
  );

/** The statistics of regions are those of the regions of the mesh, in their order. */
function expectSameRegions(
  { quality }: Pick<MeshReport, "quality">,
  regions: readonly RegionSummary[],
): void {
  expect(quality.regions.map(({ region }) => region)).toEqual([...regions.keys()]);
  expect(quality.regions.map(({ tetrahedra }) => tetrahedra)).toEqual(
    regions.map(({ tetrahedra }) => tetrahedra),
  );
  quality.regions.forEach(({ volume, smallestDihedral }, r) => {
    expect(volume).toBeCloseTo(regions[r]?.volume ?? NaN, 9);
    expect(smallestDihedral.reduce((sum, count) => sum + count, 0)).toBe(regions[r]?.tetrahedra);
  });
}

async function reportOf(file: Uint8Array) {
  const { report, mesh } = await meshFile(file, { fileName: "a.stl" });
  return { ...report, mesh };
}

test("the only solid of a file names its region, and a cavity does not change that", async () => {
  const box = boxSurface(2, [0, 0, 0], [4, 4, 4]);
  const hole = boxSurface(2, [1, 1, 1], [2, 2, 2]);
  const inward = { ...hole, triangles: hole.triangles.slice().reverse() };
  for (const file of [stlOf({ "outer ring": box }), stlOf({ "outer ring": box, hole: inward })]) {
    expect((await reportOf(file)).regions.map(({ name }) => name)).toEqual(["outer ring"]);
  }
  const unnamed = await reportOf(stlOf({ "": box }));
  expect(unnamed.regions.map(({ name }) => name)).toEqual(["region 1"]);
});

test("a solid in two parts is one region, in the report and in its notes; patches are named after solids", async () => {
  const file = stlOf({
    "beam a": boxSurface(1, [0, 0, 0], [12, 3, 3]),
    "beam b": boxSurface(1, [4.5, -4, 0.7], [7.5, 7, 2.2]),
  });
  const { regions, mesh, diagnostics, quality } = await reportOf(file);
  expectSameRegions({ quality }, regions);
  expect(regions.map(({ name }) => name)).toEqual(["beam a", "beam b"]);
  expect(mesh?.patches.map(({ name }) => name)).toEqual(["beam a", "beam b"]);
  const note = diagnostics.find(({ code }) => code === "nested-regions");
  expect(note).toMatchObject({
    message: "The model has 2 regions in 3 separate parts",
    data: { regions: 2, cavities: 0 },
  });
});

test("regions of bodies have their names, those of a body of several solids the names of these", async () => {
  const solids = [boxSolid("plate", [0, 0, 0], [2, 2, 1]), boxSolid("post", [0, 0, 1], [2, 2, 3])];
  const shared = await surfaceIn(stepFile(solids), "a.step");
  const pair = createBodies(shared, { id: 1, firstPatchId: 1 });
  expect(pair.map(({ name }) => name)).toEqual(["plate + post"]);
  const nextId = 1 + Math.max(...pair.flatMap(({ patches }) => patches.map(({ id }) => id)));
  const part = (id: number, x: number) =>
    createBody(boxSurface(1, [x, 0, 0], [x + 1, 1, 1]), { id, firstPatchId: nextId + id, name: "part" });
  const mesher = await createMesher();
  const project = { ...cubeProject(), ...NOTHING_DRAWN, bodies: [part(3, 9), ...pair, part(2, 5)] };
  const result = await mesher.meshProject(project);
  mesher.dispose();
  expect(result.report.diagnostics.filter(({ severity }) => severity === "error")).toEqual([]);
  const { regions: summary } = result.report;
  expectSameRegions(result.report, summary);
  expect(summary.map(({ name, volume }) => [name, Math.round(volume)])).toEqual([
    ["part", 1],
    ["plate", 4],
    ["post", 8],
    ["part 2", 1],
  ]);
});

test("a patch around two connected solids states neither: they stay two regions", async () => {
  const solids = [boxSolid("plate", [0, 0, 0], [2, 2, 1]), boxSolid("post", [0, 0, 1], [2, 2, 3])];
  const { surfaceRegions, ...shared } = await surfaceIn(stepFile(solids), "a.step");
  const patches = [{ name: "boundary" }];
  const onePatch = { ...shared, surfaceRegions, trianglePatch: shared.trianglePatch.map(() => 0), patches };
  const bodies = createBodies(onePatch, { id: 1, firstPatchId: 1 });
  expect(bodies.flatMap((body) => body.patches.map(({ solid }) => solid))).toEqual([undefined]);
  const mesher = await createMesher();
  const { report } = await mesher.meshProject({ ...cubeProject(), ...NOTHING_DRAWN, bodies });
  mesher.dispose();
  const volumes = report.regions.map(({ volume }) => Math.round(volume));
  expect(volumes.sort((a, b) => a - b)).toEqual([4, 8]);
});

test("a run that ends without statistics keeps the number of regions in its notes", async () => {
  const file = stlOf({
    // Fine enough for a run of seconds: it is cancelled before it can end.
    outer: boxSurface(20, [0, 0, 0], [9, 9, 9]),
    inner: boxSurface(8, [3, 3, 3], [6, 6, 6]),
  });
  const surface = await surfaceIn(file, "a.stl");
  const mesher = await createMesher();
  const controller = new AbortController();
  const { report } = await mesher.fillSurface(
    surface,
    { size: 0.3 },
    {
      signal: controller.signal,
      onProgress: ({ phase }) => {
        if (phase === "volume") controller.abort();
      },
    },
  );
  mesher.dispose();
  expect(report.status).toBe("cancelled");
  const notes = report.diagnostics.filter(({ code }) => code === "nested-regions");
  expect(notes.map(({ data }) => data)).toEqual([{ regions: 2, cavities: 0 }]);
});
