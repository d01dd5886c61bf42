/** The bundled models: each is valid, and together they use everything that can be drawn. */
import { readdirSync, readFileSync } from "node:fs";

import { createMesher, type Mesher, type MeshResult } from "tetrafront";
import { isInterface } from "tetrafront/internal";
import { readProject, type Project } from "tetrafront/project";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import type { Gallery } from "../../../web/session/gallery";
import { regionVolumes, tetrahedronVolumes } from "../../support/check-mesh.js";
import { expectValid } from "../../support/expect-valid.js";

const publicFolder = new URL("../../../public/", import.meta.url);
const gallery = JSON.parse(readFileSync(new URL("index.json", publicFolder), "utf8")) as Gallery;

function load(file: string): Project {
  const read = readProject(readFileSync(new URL(file, publicFolder), "utf8"));
  if (!read.success) throw new Error(`${file}: ${read.errors[0].message}`);
  return read.value;
}

const projects = new Map(gallery.models.map(({ id, file }) => [id, load(file)]));
const results = new Map<string, MeshResult>();
let mesher: Mesher;
beforeAll(async () => void (mesher = await createMesher()));
afterAll(() => mesher.dispose());

function projectOf(id: string): Project {
  const project = projects.get(id);
  if (!project) throw new Error(`${id} is not in the gallery`);
  return project;
}

/** Meshes each model once, for the first test that needs it. */
async function meshOf(id: string): Promise<MeshResult> {
  const known = results.get(id);
  if (known) return known;
  const result = await mesher.meshProject(projectOf(id));
  results.set(id, result);
  return result;
}

/** Returns the same model with all sizes multiplied by `factor`. */
function coarser({ background, ...rest }: Project, factor: number): Project {
  const scaled = <T extends { size: number }>(sized: T): T => ({ ...sized, size: sized.size * factor });
  const { nodes, sources } = background;
  return {
    ...rest,
    background: { ...background, nodes: nodes.map(scaled), ...(sources && { sources: sources.map(scaled) }) },
  };
}

const isStretched = ({ background }: Project): boolean =>
  background.nodes.some(({ stretching = 1 }) => stretching > 1);

describe("the list", () => {
  test("names every file once, under the title of its project", () => {
    const files = readdirSync(new URL("models/", publicFolder)).map((file) => `models/${file}`);
    expect(gallery.models.map(({ file }) => file).sort()).toEqual(files.sort());
    for (const { id, title, blurb } of gallery.models) {
      expect(projectOf(id).name).toBe(title);
      expect(blurb).toMatch(/^[A-Z][^\n]+[.]$/);
    }
    expect(new Set(gallery.models.map(({ title }) => title)).size).toBe(files.length);
    expect(gallery.models.map(({ id }) => id)).toContain(gallery.opening);
  });

  test("keeps the models of a group together", () => {
    const groups = gallery.models.map(({ group }) => group);
    const heads = groups.filter((group, i) => group !== groups[i - 1]);
    expect(heads).toHaveLength(new Set(groups).size);
    expect([...heads].sort()).toEqual([
      "Background grid",
      "Curved patches",
      "First steps",
      "Regions and cavities",
      "The paper's examples",
    ]);
  });
});

describe.each(gallery.models.map(({ id }) => id))("%s", (id) => {
  test("has named patches and no errors or warnings", async () => {
    const names = projectOf(id).patches.map(({ name }) => name);
    expect(names).not.toContain(undefined);
    expect(new Set(names).size).toBe(names.length);
    const { diagnostics } = await mesher.previewProject(projectOf(id));
    expect(diagnostics.filter(({ severity }) => severity !== "information")).toEqual([]);
  });

  test("is meshed well", async () => {
    const result = await meshOf(id);
    expectValid(result);
    const { diagnostics, dihedral, quality, radiusRatio, tetrahedra } = result.report;
    expect(diagnostics.filter(({ severity }) => severity === "warning")).toEqual([]);
    expect(diagnostics.map(({ code }) => code)).not.toContain("reoriented-patch");
    expect(tetrahedra).toBeGreaterThan(1000);
    // Stretched elements are intentionally flat: a stretching of 4 gives angles of about 10 degrees.
    expect(dihedral.min).toBeGreaterThan(isStretched(projectOf(id)) ? 5 : 28);
    expect(radiusRatio.mean).toBeGreaterThan(isStretched(projectOf(id)) ? 0.7 : 0.85);
    expect(Math.abs(quality.edges.mean - 1)).toBeLessThan(0.12);
    expect(quality.edges.nearTarget).toBeGreaterThan(0.95);
  });

  // With twice the size, thin parts are about one and a half elements thick.
  test.each([1.5, 2])("also has elements of the target size with %d times that size", async (factor) => {
    const { quality } = (await mesher.meshProject(coarser(projectOf(id), factor))).report;
    expect(Math.abs(quality.edges.mean - 1)).toBeLessThan(0.12);
    expect(quality.edges.nearTarget).toBeGreaterThan(0.95);
  });
});

test("the meshes of all models are the stored ones", async () => {
  const lines: string[] = [];
  for (const id of projects.keys()) lines.push(`${id} ${(await meshOf(id)).report.fingerprint}\n`);
  // If a change of a mesh is right: npm run fingerprints.
  await expect(lines.join("")).toMatchFileSnapshot("../../fingerprints/gallery.txt");
});

/**
 * Patches with fewer triangles than this, at the sizes of the model, have lower limits: one side more or less
 * on a line already affects their statistics. tests/cpp/surface_gallery_patches_test.cpp tests every patch at
 * a size that is small compared with the patch.
 */
const fewTriangles = 40;

describe.each(gallery.models.map(({ id }) => id))("the patches of %s", (id) => {
  test("have triangles of the target size and shape", async () => {
    const { patches } = (await meshOf(id)).report;
    const shown = patches.map(({ triangles, minAngle, meanRadiusRatio, meanEdge }) => {
      const isSmall = triangles < fewTriangles;
      const shaped = minAngle >= 20 && meanRadiusRatio >= (isSmall ? 0.8 : 0.93);
      // Stretched triangles intentionally have other shapes, and smaller angles where lines meet at 18°.
      return {
        shaped: shaped || isStretched(projectOf(id)),
        sized: Math.abs(meanEdge - 1) <= (isSmall ? 0.15 : 0.1),
      };
    });
    expect(shown).toEqual(patches.map(() => ({ shaped: true, sized: true })));
  });

  test("seldom have too few triangles for the full quality", async () => {
    const { patches } = (await meshOf(id)).report;
    const missing = patches.filter(
      ({ meanRadiusRatio, meanEdge }) => meanRadiusRatio < 0.93 || Math.abs(meanEdge - 1) > 0.1,
    );
    const few = missing.filter(({ triangles }) => triangles < fewTriangles);
    const countIn = (list: typeof patches) => list.reduce((sum, { triangles }) => sum + triangles, 0);
    expect(countIn(few)).toBeLessThan(0.08 * countIn(patches));
  });
});

/** Returns the shells of a surface: sets of triangles connected by nodes. */
function shellCount({ mesh, surfaceNodes }: MeshResult): number {
  const parent = Array.from({ length: surfaceNodes }, (_, node) => node);
  const rootOf = (node: number): number => {
    let at = node;
    for (let up = parent[at] ?? at; up !== at; up = parent[at] ?? at) at = up;
    return at;
  };
  for (let i = 0; i < mesh.triangles.length; ++i) {
    if (i % 3 === 0) continue;
    const [a = 0, b = 0] = mesh.triangles.subarray(i - 1, i + 1);
    parent[rootOf(a)] = rootOf(b);
  }
  return new Set(parent.map((_, node) => rootOf(node))).size;
}

const regionCount = ({ mesh }: MeshResult): number => new Set(mesh.tetrahedronRegion).size;

describe("together the models use", () => {
  const all = [...projects.values()];

  test("every type of line and of patch, and holes", () => {
    const lines = all.flatMap((project) => project.lines.map(({ type }) => type));
    const patches = all.flatMap((project) => project.patches.map(({ type }) => type));
    expect([...new Set(lines)].sort()).toEqual([
      "arc",
      "circle",
      "hermite",
      "parabolic",
      "spline",
      "straight",
    ]);
    expect([...new Set(patches)].sort()).toEqual([
      "barnhill-gregory-nielson",
      "coons",
      "gregory",
      "isoparametric-triangle",
      "loft",
      "nielson",
      "planar",
      "serendipity",
      "tube",
    ]);
    expect(all.some(({ patches }) => patches.some(({ loops }) => loops.length > 1))).toBe(true);
  });

  test("stretching, and sources of every type", () => {
    expect(all.some(isStretched)).toBe(true);
    const sources = all.flatMap(({ background }) => background.sources ?? []);
    expect([...new Set(sources.map(({ type }) => type))].sort()).toEqual(["point", "segment", "triangle"]);
  });

  test("a cavity, and several regions next to and inside each other", async () => {
    const [box, core, chain] = [
      await meshOf("sphere-in-a-box"),
      await meshOf("core-in-a-shell"),
      await meshOf("chain"),
    ];
    expect([shellCount(box), regionCount(box)]).toEqual([2, 1]);
    expect([shellCount(core), regionCount(core)]).toEqual([3, 2]);
    expect([shellCount(chain), regionCount(chain)]).toEqual([2, 2]);
  });

  test("an interface between two regions, whose volumes follow from its triangles", async () => {
    const { mesh, report } = await meshOf("pipe-and-flow");
    expect(report.quality.regions.map(({ region }) => region)).toEqual([0, 1]);
    const walls = mesh.trianglePatch.filter((_, triangle) => isInterface(mesh, triangle));
    const { patches } = projectOf("pipe-and-flow");
    expect(new Set([...walls].map((patch) => patches[patch]?.name))).toEqual(
      new Set(["wall right", "wall top", "wall left", "wall bottom"]),
    );
    const volumes = tetrahedronVolumes(mesh);
    for (const [region, expected] of regionVolumes(mesh).entries()) {
      const filled = volumes
        .filter((_, t) => mesh.tetrahedronRegion[t] === region)
        .reduce((sum, v) => sum + v, 0);
      expect(Math.abs(filled / expected - 1)).toBeLessThan(1e-10);
    }
  });
});

interface Range {
  readonly ratio: number;
  readonly centroidOfSmallest: readonly number[];
}

function volumeRange(mesh: MeshResult["mesh"]): Range {
  const { points, tetrahedra } = mesh;
  const volumes = tetrahedronVolumes(mesh);
  const least = volumes.reduce((best, volume) => Math.min(best, volume));
  const most = volumes.reduce((best, volume) => Math.max(best, volume));
  const smallest = volumes.indexOf(least);
  const nodes = [...tetrahedra.subarray(4 * smallest, 4 * smallest + 4)];
  const coordinate = (k: number) => nodes.reduce((sum, node) => sum + (points[3 * node + k] ?? NaN) / 4, 0);
  return { ratio: most / least, centroidOfSmallest: [0, 1, 2].map(coordinate) };
}

/** Löhner & Parikh 1988, section 7; docs/PAPER.md has the whole comparison. */
describe("the paper's examples", () => {
  test.each([
    ["engine-intake", 4381, 22743],
    ["missile-launcher", 3465, 17572],
  ])("%s has the printed counts within ten per cent", async (id, points, tetrahedra) => {
    const { report } = await meshOf(id);
    expect(Math.abs(report.nodes / points - 1)).toBeLessThan(0.1);
    expect(Math.abs(report.tetrahedra / tetrahedra - 1)).toBeLessThan(0.1);
  });

  test("the intake's volumes vary by more than 10⁴, the smallest at the nose of the centrebody", async () => {
    const nose = projectOf("engine-intake").points.find(({ name }) => name === "nose of the centrebody");
    const { ratio, centroidOfSmallest } = volumeRange((await meshOf("engine-intake")).mesh);
    expect(ratio).toBeGreaterThan(1e4);
    const distance = Math.hypot(...centroidOfSmallest.map((c, k) => c - (nose?.position[k] ?? NaN)));
    // The distance is a few edges of the smallest elements; the intake has a length of 5.
    expect(distance).toBeLessThan(0.05);
  });
});
