/** `improveMesh` and `tetrafront improve`: what is kept, what is better, errors, notes, stopping early. */
import { existsSync, readFileSync } from "node:fs";

import {
  createMesher,
  extensionsFor,
  type Mesh,
  type Mesher,
  type MeshImprovement,
  NO_ORIGIN,
  readMesh,
  readSurface,
  writeMesh,
} from "tetrafront";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { blockMesh } from "../../support/block-mesh.js";
import { defectsOf, NO_DEFECTS } from "../../support/check-mesh.js";
import { signalAtProgress, tetrafront } from "../../support/command-line.js";
import { randomSource } from "../../support/random.js";
import { stlBinary } from "../../support/surface-files.js";
import { boxSurface, sphereSurface } from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

let mesher: Mesher;
/** A sphere as the front left it. */
let rough: Mesh;
beforeAll(async () => {
  mesher = await createMesher();
  rough = (await mesher.fillSurface(sphereSurface(8), { optimization: "none" })).mesh;
});
afterAll(() => mesher.dispose());

const folder = temporaryFolder();
const { save, run, inFolder } = folder;

const improve = (mesh: Mesh) => mesher.improveMesh(mesh);

/** The triangles of each patch by the positions of their corners. */
function trianglesByPatch({ points, triangles, trianglePatch, patches }: Mesh): Record<string, string[]> {
  const found: Record<string, string[]> = {};
  trianglePatch.forEach((patch, t) => {
    const corners = [...triangles.subarray(3 * t, 3 * t + 3)].map((node) =>
      points.subarray(3 * node, 3 * node + 3).join(" "),
    );
    (found[`${patch} ${patches[patch]?.name}`] ??= []).push(corners.join("; "));
  });
  return found;
}

/** Volume of each region. */
function volumes({ points, tetrahedra, tetrahedronRegion, regions }: Mesh): number[] {
  const sums = regions.map(() => 0);
  tetrahedronRegion.forEach((region, t) => {
    const [a = [], b = [], c = [], d = []] = [...tetrahedra.subarray(4 * t, 4 * t + 4)].map((node) => [
      ...points.subarray(3 * node, 3 * node + 3),
    ]);
    const [u, v, w] = [b, c, d].map((p) => p.map((x, k) => x - (a[k] ?? 0)) as [number, number, number]);
    if (u === undefined || v === undefined || w === undefined) return;
    const cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]] as const;
    sums[region] = (sums[region] ?? 0) + (cross[0] * w[0] + cross[1] * w[1] + cross[2] * w[2]) / 6;
  });
  return sums;
}

function expectNoWorse({ before, after }: Pick<MeshImprovement, "before" | "after">, maxGrowth = 0.05): void {
  expect(after.dihedral.min).toBeGreaterThanOrEqual(before.dihedral.min - 1e-9);
  expect(after.dihedral.max).toBeLessThanOrEqual(before.dihedral.max + 1e-9);
  expect(after.radiusRatio.min).toBeGreaterThanOrEqual(before.radiusRatio.min - 1e-9);
  expect(after.radiusRatio.mean).toBeGreaterThanOrEqual(before.radiusRatio.mean - 1e-9);
  expect(after.tetrahedra).toBeLessThanOrEqual((1 + maxGrowth) * before.tetrahedra);
  expect(after.outOfRange / after.tetrahedra).toBeLessThanOrEqual(before.outOfRange / before.tetrahedra);
}

test("improves a mesh and keeps its boundary", async () => {
  const made = await improve(rough);
  expect(made).toMatchObject({ isImproved: true, isPartial: false, orientedTetrahedra: 0, diagnostics: [] });
  expectNoWorse(made);
  expect(made.before.dihedral.min).toBeLessThan(10);
  expect(made.after.dihedral.min).toBeGreaterThan(29);
  expect(made.after.outOfRange).toBe(0);
  const better = made.mesh;
  expect(trianglesByPatch(better)).toEqual(trianglesByPatch(rough));
  const { points, triangles } = rough;
  expect(defectsOf(better, { points, triangles })).toEqual(NO_DEFECTS);
  const inspected = await mesher.inspectMesh(made.mesh);
  expect(inspected).toMatchObject({ isValid: true, dihedral: made.after.dihedral });
});

/** blockMesh(5) as a cube whose inner nodes are moved by up to 0.2 edges; z = 3 is between the regions. */
function shakenBlock(): Mesh {
  const random = randomSource(7);
  const mesh = blockMesh(5);
  const points = mesh.points.map((_, i) => {
    const node = Math.floor(i / 3);
    const grid = [node % 6, Math.floor(node / 6) % 6, Math.floor(node / 36)];
    const isKept = grid.some((x) => x === 0 || x === 5) || grid[2] === 3;
    // The layers of the block lie below each other.
    return (i % 3 === 2 ? -1 : 1) * (grid[i % 3] ?? 0) + (isKept ? 0 : (0.4 * random()) / 2 ** 32 - 0.2);
  });
  return { ...mesh, points };
}

test("keeps patches, regions, names and tags", async () => {
  const given = shakenBlock();
  const made = await improve(given);
  expect(made.isImproved).toBe(true);
  const better = made.mesh;
  expect(better.patches).toEqual(given.patches);
  expect(better.regions).toEqual(given.regions);
  expect(trianglesByPatch(better)).toEqual(trianglesByPatch(given));
  volumes(better).forEach((volume, region) => expect(volume).toBeCloseTo(volumes(given)[region] ?? 0, 12));
  expect(better.nodeData.size).toBe(0);
  made.nodeOrigin.forEach((origin, node) => {
    if (origin === NO_ORIGIN) return;
    expect(made.mesh.points.subarray(3 * node, 3 * node + 3)).toEqual(
      given.points.subarray(3 * origin, 3 * origin + 3),
    );
  });
});

const tetrahedron = {
  points: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 2),
  tetrahedra: Uint32Array.of(0, 1, 2, 3),
};

/** A sphere without nodes inside, where only new nodes would make good elements. */
const hollowSphere = async () =>
  (await mesher.fillSurface(sphereSurface(6), { optimization: "none", exactFillOnly: true })).mesh;

test("adds no more elements than permitted, and says if more might help", async () => {
  const { points, tetrahedra } = await hollowSphere();
  const makeWith = (maxGrowth?: number) => mesher.improveMesh({ points, tetrahedra }, { maxGrowth });
  const byDefault = await makeWith();
  expectNoWorse(byDefault);
  expect(byDefault.isGrowthLimited).toBe(true);
  const note = byDefault.diagnostics.find(({ code }) => code === "growth-limited");
  expect(note?.message).toContain("more elements might help");
  expect(note?.remedy).toContain("maxGrowth");
  expectNoWorse(await makeWith(0), 0);
  const asked = await makeWith(20);
  expectNoWorse(asked, 20);
  expect(asked.after.tetrahedra).toBeGreaterThan(1.5 * asked.before.tetrahedra);
  expect(asked.after.dihedral.min).toBeGreaterThan(byDefault.after.dihedral.min);
  expect(asked.diagnostics).toEqual([]);
});

test.each([-0.1, 101, Number.NaN])("rejects a growth of %d", async (maxGrowth) => {
  const failure: unknown = await mesher
    .improveMesh(tetrahedron, { maxGrowth })
    .catch((reason: unknown) => reason);
  expect(failure).toMatchObject({ code: "invalid-input" });
});

const formats = extensionsFor("read", "volume").filter((extension) =>
  extensionsFor("write", "volume").includes(extension),
);

test.each(formats)("improves meshes of %s files", async (extension) => {
  const files = await writeMesh(rough, `mesh${extension}`);
  const [first] = files;
  const read = await readMesh(first?.bytes ?? new Uint8Array(), {
    fileName: first?.fileName ?? "",
    openOther: (name) => Promise.resolve(files.find(({ fileName }) => fileName === name)?.bytes),
  });
  if (!read.success) throw new Error(read.errors[0].message);
  const made = await improve(read.value);
  expect(made.isImproved).toBe(true);
  expectNoWorse(made);
  expect(trianglesByPatch(made.mesh)).toEqual(trianglesByPatch(read.value));
});

test("says if nothing is better, and returns the given elements", async () => {
  const made = await mesher.improveMesh(tetrahedron);
  expect(made.isImproved).toBe(false);
  expect(made.diagnostics.map(({ code, severity }) => [code, severity])).toEqual([
    ["no-improvement", "information"],
  ]);
  expect(made.mesh.tetrahedra).toEqual(tetrahedron.tetrahedra);
  expect(made.after).toEqual(made.before);
});

test("orients inverted elements with a note", async () => {
  const made = await mesher.improveMesh({ ...tetrahedron, tetrahedra: Uint32Array.of(0, 2, 1, 3) });
  expect(made.orientedTetrahedra).toBe(1);
  expect(made.diagnostics.map(({ code }) => code)).toEqual(["inverted-tetrahedra", "no-improvement"]);
});

test.each([
  ["degenerate-tetrahedron", [0, 1, 2, 3, 0, 3, 4, 3], "Tetrahedron 1"],
  ["overlapping-tetrahedra", [0, 1, 2, 3, 0, 1, 2, 4], "Tetrahedron 0 (counted from 0) and tetrahedron 1"],
  ["overlapping-tetrahedra", [0, 1, 2, 3, 3, 1, 2, 0], "Tetrahedron 0 (counted from 0) and tetrahedron 1"],
  ["non-manifold-face", [0, 1, 2, 3, 0, 1, 2, 4, 0, 1, 2, 5], "tetrahedron 2 share one face at ("],
])("rejects a mesh with %s %j", async (code, corners, words) => {
  const points = Float64Array.of(...tetrahedron.points, 0, 0, -1);
  const failure: unknown = await mesher
    .improveMesh({ points, tetrahedra: Uint32Array.from(corners) })
    .catch((reason: unknown) => reason);
  expect(failure).toMatchObject({ code: "invalid-input" });
  const { diagnostics } = (failure as { data: { diagnostics: { code: string; message: string }[] } }).data;
  expect(diagnostics.map((one) => one.code)).toEqual([code]);
  expect(diagnostics[0]?.message).toContain(words);
});

describe("stopped early", () => {
  test("returns a valid mesh that is no worse", async () => {
    const stop = new AbortController();
    const improving = mesher.improveMesh(
      rough,
      { optimization: "thorough" },
      { signal: stop.signal, partial: true },
    );
    stop.abort();
    const made = await improving;
    expect(made.isPartial).toBe(true);
    expectNoWorse(made);
    expect((await mesher.inspectMesh(made.mesh)).isValid).toBe(true);
  });

  test("returns a valid surface", async () => {
    const given = sphereSurface(24);
    const stop = new AbortController();
    const remeshing = mesher.remeshSurface(given, { size: 0.05 }, { signal: stop.signal, partial: true });
    stop.abort();
    const made = await remeshing;
    expect(made.isPartial).toBe(true);
    const whole = await mesher.remeshSurface(given, { size: 0.05 });
    expect(whole.isPartial).toBe(false);
    expect(made.mesh.triangles).not.toEqual(whole.mesh.triangles);
    expect((await mesher.inspectSurface(made.mesh)).isFillable).toBe(true);
    expect(made.deviation).toBeLessThanOrEqual(1.001 * made.tolerance);
  });
});

describe("the command", () => {
  const saveRough = async (name: string) => {
    const [file] = await writeMesh(rough, name);
    return save(name, file?.bytes ?? new Uint8Array());
  };

  test("prints the shapes before and after", async () => {
    await saveRough("rough.vtu");
    const { code, stderr } = await run("improve", "rough.vtu", "-o", "better.msh");
    expect(code).toBe(0);
    expect(stderr).toMatch(
      /rough\.vtu: improved: \d+ tetrahedra before, \d+ after \([+−][\d.]+ %\); .*-> better\.msh/,
    );
    expect(stderr).toMatch(/smallest dihedral angle [\d.]+° before, (29|3\d)\.\d° after/);
    const again = await run("stats", "better.msh", "--json");
    expect((JSON.parse(again.stdout) as { isValid: boolean }).isValid).toBe(true);
  });

  test("keeps what it promises of second-order files, and prints it", async () => {
    const [file] = await writeMesh(rough, "second.msh", { elementOrder: 2 });
    save("second.msh", file?.bytes ?? new Uint8Array());
    const { code, stderr } = await run("improve", "second.msh", "-o", "better.vtu");
    expect(code).toBe(0);
    expect(stderr).toMatch(
      /least radius ratio 0\.\d{3} before, 0\.\d{3} after; mean radius ratio 0\.\d{3} before/,
    );
    const [given, made] = await Promise.all(
      ["second.msh", "better.vtu"].map(async (name) => {
        const read = await readMesh(readFileSync(inFolder(name)), { fileName: name });
        if (!read.success) throw new Error(read.errors[0].message);
        const { points, tetrahedra } = read.value;
        return { ...(await mesher.inspectMesh({ points, tetrahedra })), count: tetrahedra.length / 4 };
      }),
    );
    expect(made?.dihedral.min).toBeGreaterThanOrEqual(given?.dihedral.min ?? 90);
    expect(made?.radiusRatio.min).toBeGreaterThanOrEqual(given?.radiusRatio.min ?? 1);
    expect(made?.count).toBeLessThanOrEqual(1.05 * (given?.count ?? 0));
  });

  test("adds no element with --max-growth 0, and names the option", async () => {
    const [file] = await writeMesh(await hollowSphere(), "hollow.vtu");
    save("hollow.vtu", file?.bytes ?? new Uint8Array());
    const { code, stdout } = await run(
      "improve",
      "hollow.vtu",
      "-o",
      "same.vtu",
      "--max-growth",
      "0",
      "--json",
    );
    expect(code).toBe(0);
    const report = JSON.parse(stdout) as MeshImprovement;
    expectNoWorse(report, 0);
    expect(report.diagnostics.map(({ remedy }) => remedy).join(" ")).toContain("--max-growth");
    const wrong = await run("improve", "hollow.vtu", "-o", "same.vtu", "--max-growth", "lots");
    expect(wrong.code).toBe(2);
  });

  test("prints JSON", async () => {
    await saveRough("rough.vtu");
    const { code, stdout, stderr } = await run("improve", "rough.vtu", "-o", "better.vtu", "--json");
    expect(code).toBe(0);
    expect(stderr).toMatch(/^(tetrafront: .* so far.*\n)*$/);
    const report = JSON.parse(stdout) as MeshImprovement & { output: string };
    expect(report).toMatchObject({ output: "better.vtu", isImproved: true, isPartial: false });
    expect(report.after.radiusRatio.mean).toBeGreaterThan(report.before.radiusRatio.mean);
  });

  test("writes the given mesh if nothing is better", async () => {
    save(
      "one.vtk",
      Buffer.from(
        "# vtk DataFile Version 3.0\na\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\n" +
          "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n",
      ),
    );
    const { code, stderr } = await run("improve", "one.vtk", "-o", "same.vtk");
    expect(code).toBe(0);
    expect(stderr).toContain("note: one.vtk: No better mesh was found");
    expect(stderr).toContain("one.vtk: unchanged: 1 tetrahedron before, 1 after");
  });

  test("refuses surfaces", async () => {
    save("box.stl", stlBinary(boxSurface(2)));
    const { code, stderr } = await run("improve", "box.stl", "-o", "out.vtu");
    expect(code).toBe(2);
    expect(stderr).toContain("The file contains no tetrahedra");
  });

  test("writes what it has when it is interrupted", async () => {
    const big = (await mesher.fillSurface(sphereSurface(16), { optimization: "none" })).mesh;
    const [file] = await writeMesh(big, "big.vtu");
    save("big.vtu", file?.bytes ?? new Uint8Array());
    const args = ["improve", "big.vtu", "-o", "part.vtu", "--optimize", "thorough"];
    const { code, stderr } = await tetrafront(folder.path, args, {
      env: signalAtProgress("SIGINT", "program", 0.3),
    });
    expect(stderr).toContain("stopped; the mesh made so far is valid, and was written");
    expect(code).toBe(1);
    const read = await readMesh(readFileSync(inFolder("part.vtu")), { fileName: "part.vtu" });
    if (!read.success) throw new Error(read.errors[0].message);
    const { points, tetrahedra } = read.value;
    expect((await mesher.inspectMesh({ points, tetrahedra })).isValid).toBe(true);
  });

  test("remeshing writes what it has when it is interrupted", async () => {
    save("sphere.stl", stlBinary(sphereSurface(24)));
    const args = ["remesh", "sphere.stl", "-o", "part.ply", "--size", "0.03"];
    const { code, stderr } = await tetrafront(folder.path, args, {
      env: signalAtProgress("SIGINT", "program", 0.3),
    });
    expect(stderr).toContain("stopped; the surface made so far is valid, and was written");
    expect(code).toBe(1);
    const read = await readSurface(readFileSync(inFolder("part.ply")), { fileName: "part.ply" });
    if (!read.success) throw new Error(read.errors[0].message);
    expect((await mesher.inspectSurface(read.value)).isFillable).toBe(true);
  });

  test("meshing explains what it has when its remeshing is interrupted", async () => {
    save("sphere.stl", stlBinary(sphereSurface(24)));
    const args = ["mesh", "sphere.stl", "-o", "no.vtu", "--surface", "remesh", "--size", "0.03"];
    const { code, stderr } = await tetrafront(folder.path, [...args, "--report", "no.json"], {
      env: signalAtProgress("SIGINT", "program", 0.3),
    });
    expect(stderr).toMatch(/remeshed: \d+ triangles before, \d+ after/);
    expect(stderr).toContain("stopped while the surface was remeshed");
    expect(stderr).toContain("tetrafront remesh writes the surface");
    expect(code).toBe(1);
    const report = JSON.parse(readFileSync(inFolder("no.json"), "utf8")) as object;
    expect(report).toMatchObject({ status: "cancelled", output: null, remesh: { isPartial: true } });
    expect(existsSync(inFolder("no.vtu"))).toBe(false);
  });
});
