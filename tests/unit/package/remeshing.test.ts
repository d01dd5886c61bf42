/** `remeshSurface` and `tetrafront remesh`: valid surfaces, named patches, figures, errors, rounding. */
import { readFileSync } from "node:fs";

import {
  createMesher,
  type Mesher,
  MesherError,
  type MeshReport,
  readSurface,
  type Mesh,
  type SurfaceInput,
  type SurfaceRemesh,
} from "tetrafront";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { enclosedVolume } from "../../support/check-mesh.js";
import { expectValid } from "../../support/expect-valid.js";
import { offFile, stlBinary } from "../../support/surface-files.js";
import {
  boxSurface,
  cavitySurface,
  dividedSurface,
  joined,
  needleGearSurface,
  sphereSurface,
  steppedBlock,
  torusSurface,
} from "../../support/surfaces.js";
import { temporaryFolder } from "../../support/temporary-folder.js";
import { completeSurface } from "../../../wasm/src/api/carried-mesh.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

const folder = temporaryFolder();
const { inFolder, save, run } = folder;

const codeOf = (call: Promise<unknown>) =>
  call.then(
    () => "no error",
    (failure: { data?: { diagnostics?: readonly { code: string }[] } }) =>
      failure.data?.diagnostics?.[0]?.code,
  );

/** Returns the area of the triangles of each patch. */
function patchAreas({ points, triangles, trianglePatch, patches }: Mesh): number[] {
  const areas = patches.map(() => 0);
  trianglePatch.forEach((patch, t) => {
    const [a, b, c] = [0, 1, 2].map((i) => {
      const node = triangles[3 * t + i] ?? 0;
      return [...points.subarray(3 * node, 3 * node + 3)];
    });
    const side = (to: number[] | undefined, axis: number) => (to?.[axis] ?? 0) - (a?.[axis] ?? 0);
    const cross = [0, 1, 2].map((axis) => {
      const [j, k] = [(axis + 1) % 3, (axis + 2) % 3];
      return side(b, j) * side(c, k) - side(b, k) * side(c, j);
    });
    areas[patch] = (areas[patch] ?? 0) + 0.5 * Math.hypot(...cross);
  });
  return areas;
}

describe("remeshSurface", () => {
  test.each<[string, SurfaceInput]>([
    ["a gear of needles", needleGearSurface(12, 0.2)],
    ["a torus of needles", torusSurface(120, 4)],
    ["a cube with a cavity", cavitySurface(4)],
  ])("makes %s of well-shaped triangles near the given ones, and a good mesh", async (_, given) => {
    const remesh = await mesher.remeshSurface(given);
    const { mesh: surface, origin } = remesh;
    const found = await mesher.inspectSurface(surface);
    expect(found).toMatchObject({ isFillable: true, isClosed: true, isEmbedded: true });
    expect(found.diagnostics.filter(({ severity }) => severity !== "information")).toEqual([]);
    expect(origin).toHaveLength(surface.triangles.length / 3);
    expect(remesh.triangleDeviation).toHaveLength(surface.triangles.length / 3);
    expect(Math.max(...remesh.triangleDeviation)).toBeLessThanOrEqual(remesh.deviation);
    expect(Math.max(...origin)).toBeLessThan(given.triangles.length / 3);
    const { area } = await mesher.inspectSurface(given);
    const change = Math.abs(enclosedVolume(surface) - enclosedVolume(given));
    expect(change).toBeLessThan(1.05 * area * remesh.tolerance);
    const worst = Math.min(...found.worst.map((one) => one.smallestAngle));
    expect(remesh.smallestAngle).toBeLessThan(worst + 1e-6);
    expect(remesh.smallestAngle).toBeGreaterThan(10);
    expect(remesh.meanRadiusRatio).toBeGreaterThan(0.82);
    expect(remesh.minSize).toBeLessThan(remesh.size);
    expect(remesh.deviation).toBeLessThanOrEqual(remesh.tolerance);
    expect(remesh.patches).toBeGreaterThan(1);
    const result = await mesher.fillSurface(surface);
    expectValid(result);
    expect(result.report.dihedral.min).toBeGreaterThan(10);
  });

  test("follows no steps between faces that nearly coincide, if a repair has welded their intersections", async () => {
    const [one, other] = [boxSurface(2), boxSurface(2, [0.5, 2e-6, 1e-6], [1.5, 1 + 2e-6, 1 + 1e-6])];
    const nodes = one.points.length / 3;
    const both = {
      points: Float64Array.of(...one.points, ...other.points),
      triangles: Uint32Array.of(...one.triangles, ...other.triangles.map((node) => node + nodes)),
    };
    const exact = await mesher.repairSurface(both);
    const welded = await mesher.repairSurface(both, { weldIntersections: 5e-4 });
    const [before, after] = [
      await mesher.inspectSurface(exact.mesh),
      await mesher.inspectSurface(welded.mesh),
    ];
    expect([exact.deviation, before.isFillable, after.isFillable]).toEqual([0, true, true]);
    expect(before.edgeLengths.shortest).toBeLessThan(1e-5);
    expect(after.edgeLengths.shortest).toBeCloseTo(0.5, 5);
    expect(welded.deviation).toBeGreaterThan(0);
    expect(welded.deviation).toBeLessThan(5e-6);
    expect(after.volume).toBeCloseTo(1.5, 5);
    const { smallestAngle } = await mesher.remeshSurface(welded.mesh);
    expect(smallestAngle).toBeGreaterThan(30);
  });

  test("drops details by itself only if an angle would be below 10°, within the tolerance", async () => {
    const given = steppedBlock(1e-4);
    const kept = await mesher.remeshSurface(given, { dropDetails: 0 });
    const fractions: number[] = [];
    const automatic = await mesher.remeshSurface(
      given,
      {},
      { onProgress: ({ fraction }) => fractions.push(fraction) },
    );
    expect(kept.smallestAngle).toBeLessThan(10);
    expect(automatic.smallestAngle).toBeGreaterThan(20);
    expect(automatic.mergedDetails.length).toBeGreaterThan(1);
    expect(fractions).toEqual([...fractions].sort((a, b) => a - b));
    expect(automatic.deviation).toBeLessThanOrEqual(automatic.tolerance);
    // A source far away changes no size, and so no triangle.
    const none = new Float64Array();
    const source = { id: 1, type: "point", positions: [[1e3, 1e3, 1e3]], size: 0.1, distance: 1 } as const;
    const background = { points: none, sizes: none, tetrahedra: new Uint32Array(), sources: [source] };
    const far = await mesher.remeshSurface(given, { background });
    expect(far.smallestAngle).toBeGreaterThan(20);
    const visible = await mesher.remeshSurface(steppedBlock(0.2));
    expect([visible.mergedDetails, visible.smallestAngle > 10]).toEqual([[], true]);
  });

  test("drops details on request, and lists them", async () => {
    const given = steppedBlock(1e-4);
    const kept = await mesher.remeshSurface(given, { dropDetails: 0 });
    expect(kept.mergedDetails).toEqual([]);
    expect(kept.smallestAngle).toBeLessThan(15);
    const dropped = await mesher.remeshSurface(given, { dropDetails: 0.01 });
    expect(dropped.smallestAngle).toBeGreaterThan(20);
    expect(dropped.mergedDetails.length).toBeGreaterThan(1);
    for (const { from, onto } of dropped.mergedDetails) {
      expect(Math.hypot(...from.map((x, k) => x - (onto[k] ?? 0)))).toBeLessThanOrEqual(0.01);
    }
    expect(await mesher.inspectSurface(dropped.mesh)).toMatchObject({ isFillable: true });
  });

  test("keeps named patches, with their areas, and the interface between two regions", async () => {
    const given = dividedSurface(4);
    // Patches that meet in the middle of flat faces, where no edge is sharp.
    const count = given.triangles.length / 3;
    const file = completeSurface({
      ...given,
      trianglePatch: Uint32Array.from({ length: count }, (_, t) => {
        const node = given.triangles[3 * t] ?? 0;
        return (given.points[3 * node + 2] ?? 0) > 0.4 ? 1 : 0;
      }),
      patches: [
        { name: "inlet", tag: 7 },
        { name: "wall", tag: 9 },
      ],
    });
    const remesh = await mesher.remeshSurface(file, { size: 0.2 });
    const surface = remesh.mesh;
    expect(surface.patches).toEqual(file.patches);
    const [before, after] = [patchAreas(file), patchAreas(surface)];
    before.forEach((area, patch) => expect(after[patch]).toBeCloseTo(area, 10));
    const result = await mesher.fillSurface(surface);
    expectValid(result);
    expect(new Set(result.mesh.tetrahedronRegion).size).toBe(2);
    expect(result.mesh.patches.map(({ name }) => name)).toEqual(["inlet", "wall"]);
    // Without patches, the whole face is one, and the line between them is lost.
    const { points, triangles } = given;
    const plain = await mesher.remeshSurface({ points, triangles }, { size: 0.2 });
    expect(plain.patches).toBeLessThan(remesh.patches);
  });

  test("gives the same result again, and does not change its arguments", async () => {
    const given = needleGearSurface(5, 0.2);
    const copy = structuredClone(given);
    const first = await mesher.remeshSurface(given);
    expect(given).toEqual(copy);
    expect(await mesher.remeshSurface(given)).toEqual(first);
  });

  test("reaches a given size, and sources limit it around a position", async () => {
    const box = boxSurface(1);
    const { mesh: surface, size } = await mesher.remeshSurface(box, { size: 0.1 });
    expect(size).toBe(0.1);
    const { edgeLengths } = await mesher.inspectSurface(surface);
    expect(edgeLengths.mean).toBeGreaterThan(0.085);
    expect(edgeLengths.mean).toBeLessThan(0.115);
    const none = new Float64Array();
    const source = { id: 1, type: "point", positions: [[0, 0, 0]], size: 0.02, distance: 0.2 } as const;
    const background = { points: none, sizes: none, tetrahedra: new Uint32Array(), sources: [source] };
    const refined = await mesher.remeshSurface(box, { size: 0.1, background });
    expect(refined.mesh.triangles.length).toBeGreaterThan(1.5 * surface.triangles.length);
  });

  test("reports progress and can be cancelled while it works", async () => {
    const sphere = sphereSurface(60);
    const fractions: number[] = [];
    const stop = new AbortController();
    const remeshing = mesher.remeshSurface(
      sphere,
      { size: 0.02 },
      {
        signal: stop.signal,
        onProgress: ({ fraction }) => {
          fractions.push(fraction);
          if (fractions.length === 3) stop.abort();
        },
      },
    );
    await expect(remeshing).rejects.toMatchObject({ code: "cancelled" });
    expect(fractions).toEqual(fractions.toSorted((a, b) => a - b));
    expect(fractions[2]).toBeLessThan(1);
  });

  test("rejects surfaces that cannot be meshed, by the indices of the surface before a repair", async () => {
    const box = boxSurface(2);
    const open = { points: box.points, triangles: box.triangles.slice(0, -3) };
    expect(await codeOf(mesher.remeshSurface(open))).toBe("open-edge");
    expect(await codeOf(mesher.remeshSurface(joined(box, boxSurface(1, [0.5, 0.5, 0.5], [2, 2, 2]))))).toBe(
      "self-intersection",
    );
    const origin = Uint32Array.from({ length: open.triangles.length / 3 }, (_, t) => t + 1000);
    const failure: unknown = await mesher.remeshSurface({ ...open, origin }).catch((error: unknown) => error);
    if (!(failure instanceof MesherError) || failure.code !== "invalid-input") throw failure;
    const [first] = failure.data.diagnostics;
    expect(first?.entities[0]?.index).toBeGreaterThanOrEqual(1000);
  });

  test.each([
    { size: 0 },
    { minSize: -1 },
    { maxSize: Infinity },
    { tolerance: 0 },
    { featureAngle: 0.5 },
    { anglePerEdge: 181 },
    { layers: -1 },
    { growth: 11 },
    { size: 1, maxSize: 2 },
    { size: 1, minSize: 2 },
    { maxSize: 1, minSize: 2 },
    { smoothness: 1 },
  ])("rejects the options %j", async (options) => {
    expect(await codeOf(mesher.remeshSurface(boxSurface(1), options))).toBe("invalid-option");
  });

  test("rejects a list of patches of another length", async () => {
    const surface = { ...boxSurface(1), trianglePatch: new Uint32Array(11) };
    expect(await codeOf(mesher.remeshSurface(surface))).toBe("invalid-arrays");
  });
});

interface RemeshOutput {
  readonly output: string | null;
  readonly remesh?: Omit<SurfaceRemesh, "surface" | "origin"> & { given: number; triangles: number };
  readonly diagnostics: readonly { code: string }[];
}

async function surfaceIn(name: string): Promise<Mesh> {
  const read = await readSurface(readFileSync(inFolder(name)), { fileName: name });
  if (!read.success) throw new Error(read.errors[0].message);
  return read.value;
}

const gear = needleGearSurface(12, 0.2);

describe("tetrafront remesh", () => {
  test("writes the same surface as the API and prints what it chose", async () => {
    save("gear.off", offFile(gear));
    const { code, stdout, stderr } = await run("remesh", "gear.off", "-o", "made.off");
    expect(code).toBe(0);
    expect(stdout).toBe("");
    const { mesh: surface, ...figures } = await mesher.remeshSurface(gear);
    const made = await surfaceIn("made.off");
    expect(made.points).toEqual(surface.points);
    expect(made.triangles).toEqual(surface.triangles);
    const count = surface.triangles.length / 3;
    expect(stderr).toContain(`remeshed: ${gear.triangles.length / 3} triangles before, ${count} after`);
    expect(stderr).toContain(`smallest angle ${figures.smallestAngle.toFixed(1)}°`);
    expect(stderr).toMatch(
      /target sizes [\d.]+ to [\d.]+;.*deviation at most [\d.e-]+ \(tolerance [\d.e-]+\)/,
    );
  });

  test("keeps all details, or drops and lists them", async () => {
    save("step.off", offFile(steppedBlock(1e-4)));
    const kept = await run("remesh", "step.off", "-o", "made.off", "--drop-details", "0");
    expect(kept.stderr).toContain("smallest angle");
    expect(kept.stderr).not.toContain("dropped");
    const dropped = await run("remesh", "step.off", "-o", "made.off", "--drop-details", "0.01");
    expect([kept.code, dropped.code]).toEqual([0, 0]);
    expect(dropped.stderr).toMatch(/\d+ details dropped: \([^()]+\) onto \(2, 1[^()]*\)/);
    expect(dropped.stderr).toMatch(
      /warning: step\.off: The deviation from the given surface is at most [\d.]+, but the tolerance is [\d.]+, because details were dropped\. Drop smaller/,
    );
    expect(kept.stderr).not.toContain("warning");
    const refused = await run("remesh", "step.off", "-o", "made.off", "--drop-details", "-1");
    expect(refused.code).toBe(2);
    expect(refused.stderr).toContain("The length of dropped details is -1");
  });

  test("prints JSON, and nothing else, with --json", async () => {
    save("gear.off", offFile(gear));
    const { code, stdout, stderr } = await run(
      "remesh",
      "gear.off",
      "-o",
      "made.ply",
      "--json",
      "--layers",
      "2",
    );
    expect([code, stderr]).toEqual([0, ""]);
    const { output, remesh, diagnostics } = JSON.parse(stdout) as RemeshOutput;
    const {
      mesh: surface,
      origin: _,
      triangleDeviation: _deviation,
      diagnostics: _diagnostics,
      ...figures
    } = await mesher.remeshSurface(gear, { layers: 2 });
    const [given, triangles] = [gear, surface].map((one) => one.triangles.length / 3);
    expect(remesh).toEqual({ given, triangles, ...figures });
    expect(output).toBe("made.ply");
    expect(diagnostics).toEqual([]);
  });

  test("keeps the names of patches, repairs on request, and reads and writes streams", async () => {
    const box = boxSurface(1);
    const named = [
      "o box",
      ...Array.from(box.points, (_, i) => i)
        .filter((i) => i % 3 === 0)
        .map((i) => `v ${box.points.subarray(i, i + 3).join(" ")}`),
    ];
    for (let t = 0; t < box.triangles.length; t += 3) {
      if (t === 0) named.push("g inlet");
      if (t === 6) named.push("g wall");
      named.push(`f ${Array.from(box.triangles.subarray(t, t + 3), (node) => node + 1).join(" ")}`);
    }
    save("box.obj", named.join("\n"));
    const { code } = await run("remesh", "box.obj", "-o", "made.obj", "--size", "0.3", "-q");
    expect(code).toBe(0);
    const made = await surfaceIn("made.obj");
    expect(made.patches.map(({ name }) => name)).toEqual(["inlet", "wall"]);
    const [inlet = 0, wall = 0] = patchAreas(made);
    expect(inlet).toBeCloseTo(1, 6);
    expect(wall).toBeCloseTo(5, 6);

    const open = { points: box.points, triangles: box.triangles.slice(0, -3) };
    save("open.off", offFile(open));
    const implied = await run("remesh", "open.off", "-o", "closed.off");
    expect(implied.code).toBe(0);
    expect(implied.stderr).toContain("filled a hole with 1 triangle");
    const closed = await surfaceIn("closed.off");
    // The filled triangle has the patch of the triangles around it, so no feature line surrounds it.
    expect(implied.stderr).toContain("6 smooth patches, 12 feature lines");
    expect(enclosedVolume(closed)).toBeCloseTo(1, 6);

    save("sheet.off", offFile({ points: box.points, triangles: box.triangles.slice(0, 6) }));
    const refused = await run("remesh", "sheet.off", "-o", "closed.off", "--json");
    expect(refused.code).toBe(2);
    const { output, diagnostics } = JSON.parse(refused.stdout) as RemeshOutput;
    expect(output).toBeNull();
    expect(diagnostics[0]?.code).toBe("open-edge");
    const repaired = await run("remesh", "open.off", "-o", "-", "--to", "off", "--fill-holes", "3");
    expect(repaired.code).toBe(0);
    expect(repaired.stderr).toContain("filled a hole with 1 triangle");
    expect(repaired.stdout).toMatch(/^OFF/);
  });

  test("says so if the rounding of a file makes the surface invalid", async () => {
    // At this distance from the origin, single precision has steps of 1/128, so the steps of the wall become equal.
    const far = boxSurface(1, [1e5, 1e5, 1e5], [1e5 + 0.25, 1e5 + 0.25, 1e5 + 0.003]);
    save("far.off", offFile(far));
    const stl = await run("remesh", "far.off", "-o", "made.stl", "--size", "0.2");
    expect(stl.code).toBe(1);
    expect(stl.stderr).toMatch(
      /error: made\.stl: The surface is no longer valid after the rounding of its file/,
    );
    expect(stl.stderr).toContain("Use a format with double precision");
    const check = await run("check", "made.stl");
    expect(check.code).toBe(2);
    expect((await run("remesh", "far.off", "-o", "made.ply", "--size", "0.2")).code).toBe(0);
    expect((await run("check", "made.ply")).code).toBe(0);
    save("near.stl", stlBinary(boxSurface(1)));
    expect((await run("remesh", "near.stl", "-o", "made.stl")).code).toBe(0);
  });

  test("remeshes many files", async () => {
    save("a.off", offFile(gear));
    save("b.off", offFile(boxSurface(1)));
    const { code, stdout } = await run("remesh", "*.off", "-o", "{name}-made.ply", "--json");
    expect(code).toBe(0);
    const outputs = (JSON.parse(stdout) as RemeshOutput[]).map(({ output }) => output);
    expect(outputs).toEqual(["a-made.ply", "b-made.ply"]);
  });
});

describe("tetrafront mesh --surface remesh", () => {
  test("gives a good mesh of a surface of needles without any other option", async () => {
    save("gear.stl", stlBinary(gear));
    const kept = await run(
      "mesh",
      "gear.stl",
      "-o",
      "kept.vtu",
      "--surface",
      "keep",
      "--require-angle",
      "10",
    );
    expect(kept.code).toBe(1);
    const args = ["mesh", "gear.stl", "-o", "gear.vtu", "--surface", "remesh", "--require-angle", "10"];
    const { code, stderr } = await run(...args, "--report", "r.json");
    expect(code).toBe(0);
    expect(stderr).toMatch(/gear\.stl: remeshed: \d+ triangles before, \d+ after/);
    expect(stderr).not.toContain("warning");
    const report = JSON.parse(readFileSync(inFolder("r.json"), "utf8")) as MeshReport & RemeshOutput;
    expect(report.remesh).toMatchObject({ given: gear.triangles.length / 3, triangles: report.triangles });
    expect(report.radiusRatio.mean).toBeGreaterThan(0.8);
    const finer = await run(...args, "--layers", "3", "--report", "r3.json", "-q");
    expect([finer.code, finer.stderr]).toEqual([0, ""]);
    const fine = JSON.parse(readFileSync(inFolder("r3.json"), "utf8")) as MeshReport;
    expect(fine.tetrahedra).toBeGreaterThan(1.5 * report.tetrahedra);
  });

  test("reports problems of the given surface", async () => {
    const { points, triangles } = boxSurface(2);
    save("sheet.off", offFile({ points, triangles: triangles.slice(0, 6) }));
    const { code, stderr } = await run("mesh", "sheet.off", "-o", "x.vtu", "--surface", "remesh");
    expect(code).toBe(2);
    expect(stderr).toMatch(/error: sheet\.off: The surface is not closed at triangle \d+/);
  });

  test("repairs a surface that intersects itself, without an option", async () => {
    const { points, triangles } = boxSurface(2);
    const moved = points.map((x, i) => x + ([0.5, 0.25, 0.375][i % 3] ?? 0));
    const both = {
      points: Float64Array.of(...points, ...moved),
      triangles: Uint32Array.of(...triangles, ...triangles.map((node) => node + points.length / 3)),
    };
    save("crossing.off", offFile(both));
    const plain = await run("mesh", "crossing.off", "-o", "x.vtu");
    expect(plain.code).toBe(0);
    expect(plain.stderr).toContain("so they were replaced, as by --surface remesh");
    const { code, stderr } = await run(
      "mesh",
      "crossing.off",
      "-o",
      "x.vtu",
      "--surface",
      "remesh",
      "--report",
      "r.json",
    );
    expect(code).toBe(0);
    expect(stderr).toContain("which intersected others");
    const report = JSON.parse(readFileSync(inFolder("r.json"), "utf8")) as {
      volume: number;
      repair: { kind: string }[];
      repairDeviation: number;
    };
    expect(report.volume).toBeCloseTo(2 - 0.5 * 0.75 * 0.625, 6);
    expect(report.repairDeviation).toBe(0);
    expect(stderr).toMatch(/repair: crossing\.off: \d+ changes; no node was moved\./);
    expect(report.repair.some(({ kind }) => kind === "resolved-intersection")).toBe(true);
  });
});
