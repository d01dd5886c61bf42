/** One call from a file to a fit mesh: what it keeps, replaces and repairs, and how it fails. */
import { execFile } from "node:child_process";
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";

import {
  createMesher,
  type MeshedFile,
  type Mesher,
  MesherError,
  meshFile,
  type MeshFileOptions,
  readSurface,
  type SurfaceInput,
  writeMesh,
} from "tetrafront";
import { writeProject } from "tetrafront/project";
import { meshFile as meshPath } from "tetrafront/node";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { cubeProject } from "../../support/projects.js";
import { offFile, stlBinary } from "../../support/surface-files.js";
import {
  boxSurface,
  joined,
  needleGearSurface,
  sphereSurface,
  torusSurface,
} from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

const { save, run, inFolder } = temporaryFolder();

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

const meshed = (surface: SurfaceInput, options: MeshFileOptions = {}) =>
  meshFile(offFile(surface), { fileName: "part.off", mesher, ...options });

function made(result: MeshedFile) {
  expect(result.success ? "" : result.message).toBe("");
  if (!result.success) throw new Error(result.message);
  return result;
}

/** Volume by the divergence theorem, from the boundary that the file lists. */
function enclosed({ points, triangles }: SurfaceInput): number {
  let sixfold = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => {
      const node = 3 * (triangles[t + k] ?? 0);
      return [points[node] ?? 0, points[node + 1] ?? 0, points[node + 2] ?? 0] as const;
    });
    if (!a || !b || !c) continue;
    sixfold += a[0] * (b[1] * c[2] - b[2] * c[1]);
    sixfold += a[1] * (b[2] * c[0] - b[0] * c[2]);
    sixfold += a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sixfold / 6;
}

/** A tube of n sides, with caps whose triangles meet in one node of the rim: needles, as CAD programs export them. */
function rod(n: number, length: number): SurfaceInput {
  const points: number[] = [];
  const triangles: number[] = [];
  for (const z of [0, length]) {
    for (let i = 0; i < n; i++) {
      points.push(Math.cos((2 * Math.PI * i) / n), Math.sin((2 * Math.PI * i) / n), z);
    }
  }
  for (let i = 0; i < n; i++) {
    const j = (i + 1) % n;
    triangles.push(i, j, n + i, j, n + j, n + i);
    if (i > 0 && i < n - 1) triangles.push(0, i + 1, i, n, n + i, n + i + 1);
  }
  return { points: Float64Array.from(points), triangles: Uint32Array.from(triangles) };
}

/** A disc of n sides with radius 1, its faces fans around their centres. */
function disc(n: number, thickness: number): SurfaceInput {
  const rim = Array.from({ length: n }, (_, i) => (2 * Math.PI * i) / n);
  const points = [0, thickness].flatMap((z) => [
    ...rim.flatMap((angle) => [Math.cos(angle), Math.sin(angle), z]),
    ...[0, 0, z],
  ]);
  const triangles = rim.flatMap((_, i) => {
    const j = (i + 1) % n;
    const [a, b, c, d] = [i, j, n + 1 + i, n + 1 + j];
    return [...[n, b, a], ...[2 * n + 1, c, d], ...[a, b, d], ...[a, d, c]];
  });
  return { points: Float64Array.from(points), triangles: Uint32Array.from(triangles) };
}

/** A surface with its axes in another order, moved along the first. */
function turnedUp({ points, triangles }: SurfaceInput): SurfaceInput {
  const moved = points.map(
    (_, i) => (points[3 * Math.floor(i / 3) + ((i + 2) % 3)] ?? 0) + (i % 3 === 2 ? 4.1 : -0.3),
  );
  return { points: moved, triangles };
}

const needles: readonly (readonly [string, SurfaceInput])[] = [
  ["a gear", needleGearSurface(9, 0.3)],
  ["a torus", torusSurface(120, 4)],
  ["a rod", rod(48, 20)],
  ["a bar 100 times as long as wide", boxSurface(1, [0, 0, 0], [100, 1, 1])],
];

describe("needles", () => {
  test.each(needles)("are replaced: %s", async (_, surface) => {
    const { mesh, report, notes } = made(await meshed(surface));
    expect(report.dihedral.min).toBeGreaterThan(10);
    expect(report.remesh?.given).toBe(surface.triangles.length / 3);
    expect(report.volume / enclosed(surface)).toBeCloseTo(1, 1);
    expect(mesh.tetrahedra.length / 4).toBe(report.tetrahedra);
    expect(notes.filter((note) => note.includes('surface: "keep"'))).toHaveLength(1);
  });

  test.each(needles)("are kept if that is asked for: %s", async (_, surface) => {
    const result = await meshed(surface, { surface: "keep" });
    const direct = await mesher.fillSurface(surface);
    expect(result.report.fingerprint).toBe(direct.report.fingerprint);
    expect(result.report.triangles).toBe(surface.triangles.length / 3);
  });
});

describe("fit triangles", () => {
  test.each([
    ["a cube of 12 triangles", boxSurface(1)],
    ["a coarse ball", sphereSurface(6)],
    ["a ball", sphereSurface(10)],
    ["a torus of squares", torusSurface(32, 12)],
    ["a box 1:2:4", boxSurface(1, [0, 0, 0], [1, 2, 4])],
  ])("are kept, bit for bit as by keep: %s", async (_, surface) => {
    const auto = made(await meshed(surface));
    const kept = made(await meshed(surface, { surface: "keep" }));
    expect(auto.report.fingerprint).toBe(kept.report.fingerprint);
    expect(auto.report.triangles).toBe(surface.triangles.length / 3);
    expect(auto.report.remesh).toBeUndefined();
  });

  test("are kept if some face the wrong way, and the report lists those that were flipped", async () => {
    const { points, triangles } = sphereSurface(8);
    const [a = 0, b = 0, c = 0, d = 0, e = 0, f = 0, ...others] = triangles;
    const { report } = made(await meshed({ points, triangles: Uint32Array.of(a, c, b, d, e, f, ...others) }));
    expect(report.repair?.map(({ kind }) => kind)).toEqual(["flipped-triangle"]);
    expect(report.triangles).toBe(triangles.length / 3);
    expect(report.volume).toBeCloseTo(enclosed({ points, triangles }), 12);
  });

  test.each([
    ["a disc of 14 sides", disc(14, 0.1)],
    ["a disc of 24 sides", disc(24, 0.05)],
  ])("are replaced if the body is thin for them, unless a size or keep is given: %s", async (_, surface) => {
    const given = surface.triangles.length / 3;
    const kept = made(await meshed(surface, { surface: "keep" }));
    const { report, notes } = made(await meshed(surface));
    expect(report.remesh?.given).toBe(given);
    expect(report.dihedral.min).toBeGreaterThan(20);
    expect(report.radiusRatio.mean).toBeGreaterThan(kept.report.radiusRatio.mean + 0.2);
    expect(report.volume).toBeCloseTo(kept.report.volume, 2);
    expect(notes.filter((note) => note.includes('surface: "keep"'))).toHaveLength(1);
    const sized = made(await meshed(surface, { size: 4 }));
    expect(sized.report.triangles).toBe(given);
  });

  test("of a remeshing are kept", async () => {
    const { mesh: surface } = await mesher.remeshSurface(needleGearSurface(9, 0.3));
    const auto = made(await meshed(surface));
    expect(auto.report.triangles).toBe(surface.triangles.length / 3);
  });

  test("are split if the size is far smaller, and replaced if an option of a remeshing is given", async () => {
    const split = made(await meshed(boxSurface(1), { size: 0.2 }));
    expect(split.report.refinement).toMatchObject({ given: 12 });
    const replaced = made(await meshed(boxSurface(1), { maxSize: 0.2 }));
    expect(replaced.report.remesh).toMatchObject({ given: 12 });
  });
});

describe("repairs before needles are replaced", () => {
  test("are made if nothing visible changes: a flipped, a duplicate and a degenerate triangle", async () => {
    const { points, triangles } = needleGearSurface(9, 0.3);
    const [a = 0, b = 0, c = 0, ...others] = triangles;
    const damaged = {
      points,
      triangles: Uint32Array.from([a, c, b, ...others, ...others.slice(0, 3), a, a, b]),
    };
    const { report } = made(await meshed(damaged));
    expect(report.repair?.map(({ kind }) => kind).sort()).toEqual([
      "flipped-triangle",
      "removed-duplicate",
      "removed-triangle",
    ]);
    expect(report.repairDeviation).toBe(0);
  });

  test("are made if parts intersect: the boundary of all stays", async () => {
    const { report } = made(await meshed(joined(rod(48, 8), turnedUp(rod(48, 8)))));
    expect(report.repair?.some(({ kind }) => kind === "resolved-intersection")).toBe(true);
  });

  test("are not made if a sheet that is seen would be removed", async () => {
    const fin = {
      points: Float64Array.of(0, 0, 5, 0.5, 3, 5, 0.3, 3, 6),
      triangles: Uint32Array.of(0, 1, 2),
    };
    // The rod winds around the corner of the fin at its axis; the box of the other one contains the fin.
    const two = joined(rod(48, 20), boxSurface(1, [-4, 4, 0], [4, 5, 20]));
    const result = await meshed(joined(two, fin));
    expect(result.success).toBe(false);
    expect((await meshed(joined(two, fin), { surface: "remesh" })).success).toBe(true);
  });

  test("are not made if a large hole would be filled", async () => {
    const whole = rod(48, 20);
    const open = { ...whole, triangles: whole.triangles.slice(0, -6 * 46) };
    const result = await meshed(open);
    expect(result.success).toBe(false);
    expect(result.report.diagnostics[0]?.code).toBe("open-edge");
    const asked = made(await meshed(open, { surface: "remesh" }));
    expect(asked.report.repair?.some(({ kind }) => kind === "filled-hole")).toBe(true);
  });
});

test("regions are listed with their elements and volumes", async () => {
  const two = joined(boxSurface(3), boxSurface(3, [2, 0, 0], [3, 1, 2]));
  const { report, mesh } = made(await meshed(two));
  expect(report.regions.map(({ name }) => name)).toEqual(mesh.regions.map(({ name }) => name));
  expect(report.regions.map(({ volume }) => Number(volume.toFixed(9)))).toEqual([1, 2]);
  expect(report.regions.reduce((sum, { tetrahedra }) => sum + tetrahedra, 0)).toBe(report.tetrahedra);
  save("two.off", offFile(two));
  await run("mesh", "two.off", "-o", "two.vtu", "--report", "two.json");
  const printed = JSON.parse(readFileSync(inFolder("two.json"), "utf8")) as { regions: unknown };
  expect(printed.regions).toEqual(report.regions);
});

test("the command line makes the same mesh, and a file at a path too", async () => {
  const gear = needleGearSurface(9, 0.3);
  save("gear.stl", stlBinary(gear));
  await run("mesh", "gear.stl", "-o", "gear.vtu", "--report", "gear.json", "--split-patches", "30");
  const printed = JSON.parse(readFileSync(inFolder("gear.json"), "utf8")) as { fingerprint: string };
  const { report, mesh } = made(await meshPath(inFolder("gear.stl"), { splitPatches: 30, mesher }));
  expect(report.fingerprint).toBe(printed.fingerprint);
  const [written] = await writeMesh(mesh, "gear.vtu");
  expect(Buffer.from(written?.bytes ?? []).equals(readFileSync(inFolder("gear.vtu")))).toBe(true);
});

test("a project is meshed, a body by its own treatment; options for surfaces are refused", async () => {
  const text = new TextEncoder().encode(writeProject(cubeProject()));
  const { report, mesh } = made(await meshFile(text, { fileName: "a.json", size: 0.5, mesher }));
  expect(report.volume).toBeCloseTo(1, 9);
  expect(mesh.patches).toHaveLength(6);
  const refused = await meshFile(text, { fileName: "a.json", surface: "keep", mesher });
  expect(refused).toMatchObject({
    success: false,
    message: expect.stringMatching(/^`surface` is for surfaces/) as string,
  });
});

describe("a failure is a value with a message of a few sentences", () => {
  const soup = (): SurfaceInput => ({
    points: Float64Array.from({ length: 9 * 2000 }, (_, i) => Math.sin(1e4 * i + i * i)),
    triangles: Uint32Array.from({ length: 3 * 2000 }, (_, i) => i),
  });

  test("for thousands of problems: an example of each kind and a count", async () => {
    const result = await meshed(soup(), { surface: "keep" });
    if (result.success) throw new Error("it was meshed");
    expect(result.message.length).toBeLessThan(1500);
    expect(result.message).toMatch(/and \d{4,} more "open-edge"/);
    expect(result.message.match(/Close the surface/g)).toHaveLength(1);
    expect(result.message).not.toMatch(/--[a-z]/);
  });

  test("for files that cannot be read", async () => {
    const result = await meshPath(inFolder("missing.stl"));
    expect(result).toMatchObject({
      success: false,
      message: expect.stringMatching(/cannot be read/) as string,
    });
    const unknown = await meshFile(Uint8Array.of(1), { fileName: "a.xyz" });
    expect(unknown).toMatchObject({ success: false, report: { status: "invalid-input" } });
  });

  test("for invalid options, named as in the call", async () => {
    const result = await meshed(boxSurface(1), { surface: "keep", layers: 2 });
    expect(result).toMatchObject({
      success: false,
      message: '`layers` is for surfaces that are remeshed. Use `surface: "remesh"`, or omit `layers`.',
    });
  });

  test.each([0, 50])("for a signal that is aborted after %i ms", async (wait) => {
    const stop = new AbortController();
    const running = meshFile(
      offFile(needleGearSurface(24)),
      { fileName: "a.off", mesher },
      { signal: stop.signal },
    );
    setTimeout(() => stop.abort(), wait);
    expect(await running).toMatchObject({
      success: false,
      message: "The call was cancelled.",
      report: { status: "cancelled" },
    });
  });
});

test("progress never decreases, and reaches 1", async () => {
  const fractions: number[] = [];
  const onProgress = ({ fraction }: { fraction: number }) => void fractions.push(fraction);
  await meshFile(offFile(needleGearSurface(9, 0.3)), { fileName: "a.off", mesher }, { onProgress });
  expect(fractions).toEqual([...fractions].sort((a, b) => a - b));
  expect(fractions.at(-1)).toBe(1);
});

test("an error that nobody catches prints its message, not its diagnostics", async () => {
  const { success, ...read } = await readSurface(offFile(boxSurface(1)), { fileName: "a.off" });
  expect(success && "value" in read).toBe(true);
  const diagnostics = Array.from({ length: 2000 }, (_, i) => ({
    code: "open-edge" as const,
    severity: "error" as const,
    message: `The surface is not closed at triangle ${i}`,
    remedy: "Close it.",
    entities: [],
    data: { count: 2000 },
  }));
  const error = new MesherError("invalid-input", "It is open. Close it.", { diagnostics });
  expect(error.data.diagnostics).toHaveLength(2000);
  const entry = fileURLToPath(import.meta.resolve("tetrafront"));
  const script = `
    import { createMesher, readSurface } from ${JSON.stringify(entry)};
    const points = Float64Array.from({ length: 18000 }, (_, i) => Math.sin(1e4 * i + i * i));
    const mesher = await createMesher();
    await mesher.remeshSurface({ points, triangles: Uint32Array.from({ length: 6000 }, (_, i) => i) });
  `;
  const failure: unknown = await promisify(execFile)(process.execPath, [
    "--input-type=module",
    "-e",
    script,
  ]).catch((thrown: unknown) => thrown);
  const { stderr } = failure as { stderr: string };
  expect(stderr).toMatch(/MesherError: The surface is not closed/);
  expect(stderr).toMatch(/more problems/);
  expect(stderr.length).toBeLessThan(3000);
});
