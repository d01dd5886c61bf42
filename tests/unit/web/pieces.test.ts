import { createMesher, type Mesher } from "tetrafront";
import type { Project } from "tetrafront/project";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { box } from "../../../web/document/pieces/box";
import { cone } from "../../../web/document/pieces/cone";
import { cylinder } from "../../../web/document/pieces/cylinder";
import { sphere } from "../../../web/document/pieces/sphere";
import { torus } from "../../../web/document/pieces/torus";
import { onSection, wing } from "../../../web/document/pieces/wing";
import { prism } from "../../../web/document/pieces/prism";
import type { Position } from "../../../web/document/position";
import { placedIn, type Shape } from "../../../web/document/shape";
import { frameAlong } from "../../../web/document/vectors";
import { regionVolumes } from "../../support/check-mesh";
import { expectValid } from "../../support/expect-valid";
import { moved, projectOf } from "../../support/pieces";

let mesher: Mesher;
beforeAll(async () => void (mesher = await createMesher()));
afterAll(() => mesher.dispose());

/** Meshes a project, checks the mesh, and returns the volume of each region. */
async function volumesOf(project: Project): Promise<number[]> {
  const result = await mesher.meshProject(project);
  expect(result.report.diagnostics.filter(({ severity }) => severity !== "information")).toEqual([]);
  expectValid(result);
  return regionVolumes(result.mesh);
}

const volumeOf = async (shape: Shape, size: number): Promise<number> => {
  const volumes = await volumesOf(projectOf([shape], size));
  expect(volumes).toHaveLength(1);
  return volumes[0] ?? 0;
};

/** Area of a NACA section with chord 1, as that of a polygon of many corners. */
function sectionArea(digits: number): number {
  const steps = 20_000;
  const corners = (sign: 1 | -1) =>
    Array.from({ length: steps }, (_, i) => onSection(digits, (i + 0.5) / steps, sign));
  const outline = [...corners(1), ...corners(-1).toReversed()];
  const twice = outline.reduce((sum, [ax, ay], i) => {
    const [bx, by] = outline[(i + 1) % outline.length] ?? [ax, ay];
    return sum + ax * by - bx * ay;
  }, 0);
  return Math.abs(twice) / 2;
}

describe("pieces", () => {
  it("a box has its volume, along any axis", async () => {
    expect(await volumeOf(box(1, 2, 3), 0.7)).toBeCloseTo(6, 12);
    expect(await volumeOf(placedIn(box(1, 2, 3), frameAlong([1, 2, 3], [9, 8, 7])), 0.7)).toBeCloseTo(6, 9);
  });

  it.each([3, 5, 6, 12])("a prism of %i sides has its volume", async (sides) => {
    const area = (sides / 2) * 4 * Math.sin((2 * Math.PI) / sides);
    expect(await volumeOf(prism(sides, 2, 1.5), 0.8)).toBeCloseTo(area * 1.5, 9);
  });

  // The triangles of a mesh lie inside round surfaces, by about a twelfth of the squared size per squared radius.
  it.each([
    ["cylinder", cylinder(1, 1, 2), 2 * Math.PI],
    ["frustum", cylinder(1, 0.4, 2), (2 * Math.PI * 1.56) / 3],
    ["cone", cone(1, 2), (2 * Math.PI) / 3],
    ["sphere", sphere(1), (4 * Math.PI) / 3],
    ["ring", torus(2, 1, 360), 4 * Math.PI ** 2],
    ["sector of a ring", torus(2, 1, 100), 4 * Math.PI ** 2 * (100 / 360)],
  ])("a %s has its volume but for the chords of its triangles", async (_, shape, expected) => {
    const share = (await volumeOf(shape, 0.2)) / expected;
    expect(share).toBeGreaterThan(0.975);
    expect(share).toBeLessThan(1);
  });

  it("a wing has the volume of its section times the span", async () => {
    const sizes = { digits: 2412, chord: 1, tipChord: 1, span: 1, sweep: 20, twist: 0 };
    expect((await volumeOf(wing(sizes), 0.05)) / sectionArea(2412)).toBeCloseTo(1, 1.8);
  });

  const inTorus = ([x, y, z]: Position): number => 1 - Math.hypot(Math.hypot(x, y) - 2, z);
  it.each([
    ["cylinder", cylinder(1, 1, 2), ([x, y]: Position) => 1 - Math.hypot(x, y), 1e-12],
    ["cone", cone(1, 2), ([x, y, z]: Position) => 1 - z / 2 - Math.hypot(x, y), 0.0029],
    ["sphere", sphere(1), (position: Position) => 1 - Math.hypot(...position), 0.0034],
    ["ring", torus(2, 1, 360), inTorus, 0.0037],
  ])("the nodes of a %s deviate from it by no more than documented", async (_, shape, inside, limit) => {
    const { mesh: surface } = await mesher.meshProject(projectOf([shape], 0.15));
    const { points } = surface;
    let deepest = 0;
    let highest = 0;
    for (const [triangle, patch] of surface.trianglePatch.entries()) {
      if (shape.patches[patch]?.type === "planar") continue;
      for (const node of surface.triangles.subarray(3 * triangle, 3 * triangle + 3)) {
        const [x = 0, y = 0, z = 0] = points.subarray(3 * node, 3 * node + 3);
        deepest = Math.max(deepest, inside([x, y, z]));
        highest = Math.max(highest, -inside([x, y, z]));
      }
    }
    expect(deepest).toBeLessThan(limit);
    expect(highest).toBeLessThan(1e-12);
  });

  it("pieces that touch share points, lines and the patch between them", async () => {
    const cube = box(1, 1, 1);
    const project = projectOf([cube, moved(cube, [0, 0, 1]), moved(cube, [1, 0, 0])], 0.4);
    expect([project.points.length, project.lines.length, project.patches.length]).toEqual([16, 28, 16]);
    const volumes = await volumesOf(project);
    expect(volumes).toHaveLength(3);
    for (const volume of volumes) expect(volume).toBeCloseTo(1, 12);
  });
});
