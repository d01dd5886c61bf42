/** Solids of one STL file that touch or intersect: with names, as "solid" blocks, and without, as shells of a binary file. */
import { createMesher, type Mesh, type Mesher, meshFile, type SurfaceInput } from "tetrafront";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { tetrahedronVolumes } from "../../support/check-mesh.js";
import { stlBinary, stlText } from "../../support/surface-files.js";
import { boxSurface, joined } from "../../support/surfaces.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

const base = boxSurface(1, [0, 0, 0], [2, 2, 2]);
/** On the middle of the base's upper face. */
const post = boxSurface(1, [0.5, 0.5, 2], [1.5, 1.5, 3.5]);
/** In a corner of the base, by a volume of 1. */
const corner = boxSurface(1, [1, 1, 1], [3, 3, 3]);

function named(solids: Readonly<Record<string, SurfaceInput>>): Uint8Array {
  const texts = Object.entries(solids).map(([name, solid]) => new TextDecoder().decode(stlText(solid, name)));
  return new TextEncoder().encode(texts.join(""));
}

async function meshed(bytes: Uint8Array) {
  const result = await meshFile(bytes, { fileName: "solids.stl", mesher });
  if (!result.success) throw new Error(result.message);
  const { report, mesh } = result;
  expect(report.diagnostics.map(({ code }) => code)).not.toContain("changed-volume");
  const volumes = volumesOf(mesh).map((volume) => Number(volume.toFixed(9)));
  return {
    smallest: report.quality.shapes.dihedral.min,
    names: mesh.regions.map(({ name }) => name),
    volumes,
  };
}

function volumesOf(mesh: Mesh): number[] {
  const volumes = mesh.regions.map(() => 0);
  tetrahedronVolumes(mesh).forEach((volume, t) => {
    const region = mesh.tetrahedronRegion[t] ?? 0;
    volumes[region] = (volumes[region] ?? 0) + volume;
  });
  return volumes;
}

describe("solids that touch in a part of a face", () => {
  test("with names become regions with them", async () => {
    const { names, volumes, smallest } = await meshed(named({ base, post }));
    expect([names, volumes]).toEqual([
      ["base", "post"],
      [8, 1.5],
    ]);
    expect(smallest).toBeGreaterThan(25);
  });

  test("without names become regions with the same elements", async () => {
    const { volumes, smallest } = await meshed(stlBinary(joined(base, post)));
    expect(volumes).toEqual([8, 1.5]);
    expect(smallest).toBe((await meshed(named({ base, post }))).smallest);
  });
});

describe("solids that share a volume", () => {
  test("with names keep their regions, and the first gets the volume", async () => {
    const { names, volumes } = await meshed(named({ base, corner }));
    expect([names, volumes]).toEqual([
      ["base", "corner"],
      [8, 7],
    ]);
  });

  test("without names become one region", async () => {
    const { volumes } = await meshed(stlBinary(joined(base, corner)));
    expect(volumes).toEqual([15]);
  });
});

test("a shell that intersects itself is refused, unless a repair is asked for", async () => {
  const { points, triangles } = joined(base, corner);
  // A node of the one box is one of the other, too: both are one shell.
  const upper = triangles.map((node) => (node === base.points.length / 3 ? 0 : node));
  const file = stlBinary({ points, triangles: upper });
  const refused = await meshFile(file, { fileName: "shell.stl", mesher });
  expect(refused.success ? "" : refused.message).toContain("intersects itself");
  const repaired = await meshFile(file, { fileName: "shell.stl", mesher, repair: true });
  expect(repaired.success).toBe(true);
});
